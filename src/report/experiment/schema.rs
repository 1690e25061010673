//! The format of report files as a JSON schema, from the types that read them.

use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde_json::{Value, json};

use super::super::kind::KINDS;
use super::parse::{Head, Title};

/// The JSON schema of report files: a section has only text, or one of the kinds of studies.
pub fn schema() -> Value {
    let mut generator = SchemaSettings::draft2020_12().into_generator();
    let head = Head::json_schema(&mut generator).to_value();
    let mut words = joined(&head, json!({ "required": ["title"] }));
    words["properties"]["study"] = json!(false);
    let mut sections = vec![words];
    for kind in KINDS {
        let settings = (kind.schema)(&mut generator).to_value();
        let mut section = joined(&head, settings);
        let required = section["required"].as_array().cloned().unwrap_or_default();
        section["required"] = std::iter::once("study".into()).chain(required).collect();
        section["properties"]["study"] = json!({ "const": kind.name, "description": kind.title });
        sections.push(section);
    }
    let mut whole = Title::json_schema(&mut generator).to_value();
    whole["$schema"] = "https://json-schema.org/draft/2020-12/schema".into();
    whole["title"] = "A report of lcplab".into();
    whole["properties"]["section"] = json!({ "type": "array", "items": { "oneOf": sections } });
    whole["$defs"] = generator.take_definitions(true).into();
    whole
}

/// A section with the keys of all sections and those of its study.
fn joined(head: &Value, mut settings: Value) -> Value {
    let own = settings["properties"].take();
    let keys = [&head["properties"], &own].into_iter().filter_map(Value::as_object).flatten();
    settings["properties"] = keys.map(|(key, value)| (key.clone(), value.clone())).collect();
    settings["additionalProperties"] = false.into();
    settings
}
