//! The keys of a problem file one by one, and the LCP they form.

use serde_json::{Map, Value};

use super::matrix::Entries;
use super::value::{brief, numbers};
use crate::error::{Defects, Error, Result};
use crate::friction::Model;
use crate::number::counted;
use crate::{Coupling, Lcp};

/// The keys of a problem file, each valid by itself; n is the length of b.
///
/// ```
/// use lcplab_lcp::file::{Entries, Parts};
///
/// let entries = Entries::Sparse(vec![(0, 0, 2.0), (1, 1, 2.0)]);
/// assert_eq!(entries.matrix(2).stored(), 2);
/// let (b, hi) = (vec![-1.0; 2], Some(vec![9.0; 2]));
/// let parts = Parts { entries, b, lo: None, hi, index: None, mu: None };
/// let lcp = parts.into_lcp()?;
/// assert_eq!((lcp.lo(), lcp.hi()), (&[0.0; 2][..], &[9.0; 2][..]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub struct Parts {
    /// A.
    pub entries: Entries,
    /// b, n numbers.
    pub b: Vec<f64>,
    /// lo; 0 if absent.
    pub lo: Option<Vec<f64>>,
    /// hi; ∞ if absent.
    pub hi: Option<Vec<f64>>,
    /// The key `friction_index`.
    pub index: Option<Vec<Option<usize>>>,
    /// The key `mu`.
    pub mu: Option<Vec<f64>>,
}

impl Parts {
    /// Reads the keys and collects their defects; A and b must be present.
    pub(crate) fn read(object: &Map<String, Value>, defects: &mut Defects) -> Self {
        let b = numbers(object, "b", defects).unwrap_or_default();
        let entries = Entries::read(&object["A"], b.len(), defects);
        Parts {
            entries,
            lo: numbers(object, "lo", defects),
            hi: numbers(object, "hi", defects),
            index: object.get("friction_index").map(|value| indices(value, defects)),
            mu: numbers(object, "mu", defects),
            b,
        }
    }

    /// The LCP that the keys form.
    ///
    /// # Errors
    /// If the keys contradict each other.
    pub fn into_lcp(self) -> Result<Lcp> {
        let n = self.b.len();
        let matrix = self.entries.matrix(n);
        let coupled = |i: usize| {
            self.index.as_ref().is_some_and(|index| matches!(index.get(i), Some(Some(_))))
        };
        let lo = self.lo.unwrap_or_else(|| {
            (0..n).map(|i| if coupled(i) { f64::NEG_INFINITY } else { 0.0 }).collect()
        });
        let hi = self.hi.unwrap_or_else(|| vec![f64::INFINITY; n]);
        let lcp = Lcp::new(matrix, self.b, lo, hi)?;
        match (self.index, self.mu) {
            (None, None) => Ok(lcp),
            (Some(index), Some(mu)) => lcp.with_coupling(Coupling::new(index, mu)?),
            (Some(_), None) => Err(Error::invalid("problem", "mu", "is missing")),
            (None, Some(_)) => Err(Error::invalid("problem", "friction_index", "is missing")),
        }
    }
}

/// The positive number under the key `scale`; 0 if absent.
pub(super) fn scale(object: &Map<String, Value>, defects: &mut Defects) -> f64 {
    match object.get("scale").map(|value| (value.as_f64(), value)) {
        None => 0.0,
        Some((Some(scale), _)) if scale > 0.0 && scale.is_finite() => scale,
        Some((_, value)) => {
            defects.add("scale", format!("must be a positive number, is {}", brief(value)));
            0.0
        }
    }
}

/// Checks the keys that describe a problem of n rows: `rows` with an object for each row, from the
/// first on, the time step `dt` (s), and `objective`.
pub(super) fn descriptions(object: &Map<String, Value>, n: usize, defects: &mut Defects) {
    if object.get("objective").is_some_and(|value| !value.is_boolean()) {
        defects.add("objective", "must be true or false");
    }
    if let Some(dt) = object.get("dt")
        && !dt.as_f64().is_some_and(|dt| dt > 0.0)
    {
        defects.add("dt", format!("must be a positive number of seconds, is {}", brief(dt)));
    }
    match object.get("rows").map(Value::as_array) {
        None => {}
        Some(Some(rows)) if rows.len() > n => {
            let reason =
                format!("has length {}, the problem has {}", rows.len(), counted(n, "row"));
            defects.add("rows", reason);
        }
        Some(Some(rows)) if rows.iter().all(Value::is_object) => {}
        Some(_) => defects.add("rows", "must be a list of objects"),
    }
}

/// The friction model under the key `model`.
pub(super) fn model(object: &Map<String, Value>, defects: &mut Defects) -> Option<Model> {
    let value = object.get("model")?;
    let model = value.as_str().map(str::parse::<Model>);
    match model {
        Some(Ok(model)) if object.contains_key("friction_index") => return Some(model),
        Some(Ok(_)) => defects.add("model", "is given, but there is no friction_index"),
        Some(Err(error)) => defects.add("model", error.to_string()),
        None => defects.add("model", format!("must be a name, is {}", brief(value))),
    }
    None
}

/// The x under the key `frozen_at`, n finite numbers.
pub(super) fn frozen_at(
    object: &Map<String, Value>,
    n: usize,
    defects: &mut Defects,
) -> Option<Vec<f64>> {
    let x = numbers(object, "frozen_at", defects)?;
    if x.len() != n {
        defects.add("frozen_at", format!("has {} entries, b has {n}", x.len()));
    }
    for (i, x) in x.iter().enumerate().filter(|(_, x)| !x.is_finite()) {
        defects.add(format!("frozen_at[{i}]"), format!("must be finite, is {x}"));
    }
    Some(x)
}

fn indices(value: &Value, defects: &mut Defects) -> Vec<Option<usize>> {
    let Value::Array(values) = value else {
        defects.add("friction_index", "must be a list of row indices, -1 for none");
        return Vec::new();
    };
    let index = |(i, value): (usize, &Value)| match value.as_i64() {
        Some(-1) => None,
        Some(k) if k >= 0 => Some(k as usize),
        _ => {
            let reason = format!("must be a row index or -1, is {}", brief(value));
            defects.add(format!("friction_index[{i}]"), reason);
            None
        }
    };
    values.iter().enumerate().map(index).collect()
}
