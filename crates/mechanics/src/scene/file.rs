//! Reads scene files and reports each defect with its line and field.
//!
//! There are two kinds of defects. Text that is not a scene description (syntax, an unknown key, a
//! string for a number) is reported completely by this module. A description that is not a valid
//! scene (a negative mass, an unknown body) is reported by [`Scene::new`], which knows only the
//! field; its line is looked up.

use serde::de::DeserializeOwned;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::source::{self, Source};
use super::{Description, Scene};
use lcplab_lcp::error::{Defects, Result};

/// The JSON schema of the scene format.
pub fn schema() -> serde_json::Value {
    schemars::schema_for!(Description).to_value()
}

pub(super) fn parse(path: &str, text: &str) -> Result<Scene> {
    let table = source::parse(path, text)?;
    let source = Source { text, root: table.get_ref() };
    let description = described(path, &table, &source)?;
    Scene::new(path, &description).map_err(|error| source.with_lines(error))
}

/// Parses the description, without checking whether it is a valid scene.
pub(super) fn description(path: &str, text: &str) -> Result<Description> {
    let table = source::parse(path, text)?;
    described(path, &table, &Source { text, root: table.get_ref() })
}

fn described(path: &str, table: &Spanned<DeTable<'_>>, source: &Source<'_>) -> Result<Description> {
    let mut defects = Defects::default();
    let description = read(table.clone(), source, &mut defects);
    defects.into_result(path)?;
    Ok(description)
}

/// The description, as far as it can be read.
fn read(table: Spanned<DeTable<'_>>, source: &Source<'_>, defects: &mut Defects) -> Description {
    let mut whole = table;
    let mut section = |key: &str| whole.get_mut().remove(key);
    let generate = section("generate").map(|part| list(part, source, defects));
    let bodies = section("bodies").map(|part| list(part, source, defects));
    let constraints = section("constraints").map(|part| list(part, source, defects));
    let pairs = section("pairs").map(|part| list(part, source, defects));
    let step = section("step").map(|part| source.read(part, defects));
    let contact = section("contact").map(|part| source.read(part, defects));
    let solver = section("solver").map(|part| source.read(part, defects));
    let span = whole.span();
    let rest = Spanned::new(span, DeValue::Table(whole.into_inner()));
    let rest: Option<Description> = source.read(rest, defects);
    Description {
        generate: generate.unwrap_or_default(),
        bodies: bodies.unwrap_or_default(),
        constraints: constraints.unwrap_or_default(),
        pairs: pairs.unwrap_or_default(),
        step: step.flatten().unwrap_or_default(),
        contact: contact.flatten().unwrap_or_default(),
        solver: solver.flatten().unwrap_or_default(),
        ..rest.unwrap_or_default()
    }
}

/// The items of an array, or the single item written instead of it.
fn list<T: DeserializeOwned>(
    value: Spanned<DeValue<'_>>,
    source: &Source<'_>,
    defects: &mut Defects,
) -> Vec<T> {
    match value.get_ref() {
        DeValue::Array(items) => {
            items.iter().filter_map(|item| source.read(item.clone(), defects)).collect()
        }
        _ => source.read(value, defects).into_iter().collect(),
    }
}
