//! The chapter's texts are data: TOML files in this folder, each read when it is first asked for.

use serde::de::DeserializeOwned;
use serde::{Deserialize, Deserializer};

/// What a file of this folder says; tests read them all.
pub(super) fn read<T: DeserializeOwned>(name: &str, text: &str) -> T {
    toml::from_str(text).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// A text in one line, however many lines it has in its file.
pub(super) fn one_line<'de, D: Deserializer<'de>>(deserializer: D) -> Result<String, D::Error> {
    Ok(String::deserialize(deserializer)?.replace('\n', " "))
}
