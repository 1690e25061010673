//! Overrides fields of a scene file, as `--set key=value` does.

use toml::{Table, Value};

use super::Description;
use lcplab_lcp::error::{Error, Result};

/// Short names for the most common fields.
const SHORT: [(&str, &str); 3] =
    [("mu", "contact.friction"), ("dt", "step.dt"), ("angle", "tilt.y")];

/// The description in a text with these overrides.
pub(super) fn changed(path: &str, text: &str, changes: &[(String, String)]) -> Result<Description> {
    // Defects of the file have line numbers; those of the changed description do not.
    Description::from_toml(path, text)?;
    let mut table = table(path, text, &[])?;
    let mut description = None;
    for change in changes {
        let (key, _) = change;
        apply(path, &mut table, change)?;
        let text = toml::to_string(&table).map_err(|e| Error::invalid(path, key, e.to_string()))?;
        description = Some(Description::from_toml(path, &text).map_err(|e| of_change(e, key))?);
    }
    description.map_or_else(|| Description::from_toml(path, text), Ok)
}

/// Adapts the error of a modified text: its line numbers are meaningless, and the cause is the
/// override.
fn of_change(error: Error, key: &str) -> Error {
    match error {
        Error::Invalid { input, defects } => {
            let mut reasons: Vec<String> =
                defects.into_iter().map(|defect| defect.reason).collect();
            if !key.contains('.') && reasons.iter().any(|reason| reason.contains("unknown field")) {
                let short = SHORT.map(|(short, long)| format!("{short} for {long}"));
                reasons.push(format!("short names are {}", short.join(", ")));
            }
            Error::invalid(input, key, reasons.join("; "))
        }
        error => error,
    }
}

/// The fields of a text with these overrides.
pub(super) fn table(path: &str, text: &str, changes: &[(String, String)]) -> Result<Table> {
    let mut table: Table = text
        .parse()
        .map_err(|error: toml::de::Error| Error::invalid(path, "the file", error.message()))?;
    changes.iter().try_for_each(|change| apply(path, &mut table, change))?;
    Ok(table)
}

/// Sets a field, which may have a short name.
fn apply(path: &str, table: &mut Table, (key, value): &(String, String)) -> Result<()> {
    let short = SHORT.iter().find(|(short, _)| short == key);
    let key = short.map_or(key.as_str(), |(_, long)| long);
    let is_generated = table.contains_key("generate");
    set(table, key, value).map_err(|reason| {
        let hint = match (is_generated, key.split_once('.')) {
            (true, Some(("bodies", own))) => {
                let field = own.rsplit('.').next().unwrap_or(own);
                format!(": it is made by [generate]; set generate.{field}, or list the bodies")
            }
            _ => String::new(),
        };
        Error::invalid(path, key, reason + &hint)
    })
}

/// Sets the field with this name; creates missing tables.
fn set(table: &mut Table, key: &str, value: &str) -> std::result::Result<(), String> {
    let (parents, last) = key.rsplit_once('.').map_or(("", key), |(parents, last)| (parents, last));
    let mut place = table;
    let mut names = parents.split('.').filter(|name| !name.is_empty());
    while let Some(name) = names.next() {
        let next = place.entry(name).or_insert_with(|| Value::Table(Table::new()));
        place = match next {
            Value::Table(table) => table,
            Value::Array(items) => {
                let item = names.next().ok_or("names a list, of which an item must follow")?;
                item_of(items, item).ok_or_else(|| format!("has no item {item:?}"))?
            }
            _ => return Err(format!("{name:?} is a value and has no fields")),
        };
    }
    place.insert(last.into(), parsed(value));
    Ok(())
}

/// The item with this number or name.
fn item_of<'a>(items: &'a mut [Value], name: &str) -> Option<&'a mut Table> {
    let has_name = |item: &Value| item.get("name").and_then(Value::as_str) == Some(name);
    let index = name.parse().ok().or_else(|| items.iter().position(has_name))?;
    items.get_mut(index)?.as_table_mut()
}

/// A TOML value, or a string if it is not valid TOML.
fn parsed(value: &str) -> Value {
    let table = format!("value = {value}").parse::<Table>().ok();
    let value_of = |mut table: Table| table.remove("value").filter(|_| table.is_empty());
    table.and_then(value_of).unwrap_or_else(|| Value::String(value.into()))
}
