//! Numbers without a JSON representation, as "nan", "inf" and "-inf": for serde's `with`.

/// Whether a count is omitted from JSON.
pub(crate) fn is_zero(count: &usize) -> bool {
    *count == 0
}

/// A number.
pub mod always {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
    use serde_json::Value;

    /// Writes a number, or a word if it is not finite.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(value: &f64, serializer: S) -> Result<S::Ok, S::Error> {
        lcplab_lcp::file::number(*value).serialize(serializer)
    }

    /// Reads a number, or a word for one that is not finite.
    ///
    /// # Errors
    /// If the value is anything else.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
        let value = Value::deserialize(deserializer)?;
        lcplab_lcp::file::as_number(&value).ok_or_else(|| D::Error::custom("not a number"))
    }
}

/// An optional number; `None` is null.
pub mod perhaps {
    use serde::{Deserialize, Deserializer, Serialize, Serializer, de::Error};
    use serde_json::Value;

    /// Writes a number, a word if it is not finite, or null.
    ///
    /// # Errors
    /// Those of the serializer.
    pub fn serialize<S: Serializer>(value: &Option<f64>, serializer: S) -> Result<S::Ok, S::Error> {
        value.map(lcplab_lcp::file::number).serialize(serializer)
    }

    /// Reads a number, a word for one that is not finite, or null.
    ///
    /// # Errors
    /// If the value is anything else.
    pub fn deserialize<'de, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<f64>, D::Error> {
        let read = |value: Value| {
            lcplab_lcp::file::as_number(&value).ok_or_else(|| D::Error::custom("not a number"))
        };
        Option::<Value>::deserialize(deserializer)?.map(read).transpose()
    }
}
