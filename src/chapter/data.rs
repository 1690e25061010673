//! Reads the chapter's texts from the TOML files in this folder, each on first use.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};

/// The entries of a file in this folder, which is one list; tests read all files.
pub(super) fn list<T: DeserializeOwned>(name: &str, text: &str) -> Vec<T> {
    let lists: BTreeMap<String, Vec<T>> =
        toml::from_str(text).unwrap_or_else(|error| panic!("{name}: {error}"));
    lists.into_values().flatten().collect()
}

/// A text with its line breaks replaced by spaces.
pub(super) fn one_line<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Ok(String::deserialize(deserializer)?.replace('\n', " "))
}
