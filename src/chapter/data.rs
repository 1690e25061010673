//! The chapter's texts are data: TOML files in this folder, each read when it is first asked for.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};

/// The entries of a file of this folder, which is one list; tests read them all.
pub(super) fn list<T: DeserializeOwned>(name: &str, text: &str) -> Vec<T> {
    let lists: BTreeMap<String, Vec<T>> =
        toml::from_str(text).unwrap_or_else(|error| panic!("{name}: {error}"));
    lists.into_values().flatten().collect()
}

/// A text in one line, however many lines it has in its file.
pub(super) fn one_line<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Ok(String::deserialize(deserializer)?.replace('\n', " "))
}
