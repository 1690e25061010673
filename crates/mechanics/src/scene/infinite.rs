//! Numbers of a scene that may be infinite. JSON has no infinity: there they are "inf" and "-inf".

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// A number as a file has it.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "expected a number, \"inf\" or \"-inf\"")]
pub(super) enum Number {
    Finite(f64),
    Infinite(Infinite),
}

#[derive(Serialize, Deserialize, JsonSchema)]
pub(super) enum Infinite {
    #[serde(rename = "inf")]
    Positive,
    #[serde(rename = "-inf")]
    Negative,
}

impl From<f64> for Number {
    fn from(value: f64) -> Self {
        match value {
            f64::INFINITY => Number::Infinite(Infinite::Positive),
            f64::NEG_INFINITY => Number::Infinite(Infinite::Negative),
            value => Number::Finite(value),
        }
    }
}

impl From<Number> for f64 {
    fn from(number: Number) -> Self {
        match number {
            Number::Finite(value) => value,
            Number::Infinite(Infinite::Positive) => f64::INFINITY,
            Number::Infinite(Infinite::Negative) => f64::NEG_INFINITY,
        }
    }
}

/// A number that may be absent.
pub(super) mod one {
    use super::{Deserialize, Number, Serialize};
    use serde::{Deserializer, Serializer};

    pub fn serialize<S: Serializer>(value: &Option<f64>, to: S) -> Result<S::Ok, S::Error> {
        value.map(Number::from).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
        Ok(Option::<Number>::deserialize(from)?.map(f64::from))
    }
}

/// Two numbers that may be absent.
pub(super) mod two {
    use super::{Deserialize, Number, Serialize};
    use serde::{Deserializer, Serializer};

    pub fn serialize<S: Serializer>(value: &Option<[f64; 2]>, to: S) -> Result<S::Ok, S::Error> {
        value.map(|pair| pair.map(Number::from)).serialize(to)
    }

    pub fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
        Ok(Option::<[Number; 2]>::deserialize(from)?.map(|pair| pair.map(f64::from)))
    }
}
