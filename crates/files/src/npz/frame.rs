//! Frames: one step of an engine as bodies and rows, from which A and b are computed.
//!
//! ```text
//! w = A x + b,   A = J M⁻¹ Jᵀ + diag(R),   b = J u* + bias,   x ≥ 0 pushes bodies apart
//! ```
//!
//! | array | type | meaning |
//! | --- | --- | --- |
//! | `J_data`, `J_indices`, `J_indptr` | numbers, integers | J, n × k, by rows |
//! | `M_data`, `M_indices`, `M_indptr` | numbers, integers | M, k × k, both triangles, by rows |
//! | `R` | numbers, n | compliance of each row |
//! | `u_star` | numbers, k | the velocity (or acceleration) without the rows |
//! | `bias` | numbers, n | what is added to J u |
//! | `lo`, `hi`, `friction_index`, `mu` | numbers, n | as in a problem file |
//! | `cone` | word | the law of friction, a name of a model; `box` where no rows are coupled |
//! | `level` | word | `velocity`, x in N s, or `acceleration`, x in N |
//! | `dt`, `scale` | numbers | as in a problem file |
//! | `source` | word | a JSON object: engine, version, scene, step and more |
//! | `x`, `v` | numbers, n and k | optional: the engine's own answer, forces (or impulses) and the new velocity (or acceleration); the key `answer` of the problem |

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Gauss, Lcp, Level};
use serde_json::{Map, Value, json};

use super::array::Array;
use super::{Arrays, unpacked};
use crate::delassus::{Entry, Motion};
use crate::table::{Table, parts};

/// The names of the arrays.
pub(super) const ARRAYS: [&str; 20] = [
    "J_data",
    "J_indices",
    "J_indptr",
    "M_data",
    "M_indices",
    "M_indptr",
    "R",
    "u_star",
    "bias",
    "lo",
    "hi",
    "friction_index",
    "mu",
    "cone",
    "level",
    "dt",
    "scale",
    "source",
    "x",
    "v",
];

/// The problem stored in these arrays, with the bodies and rows under the key `motion`.
pub(super) fn problem(
    arrays: &Arrays<'_>,
    name: String,
    input: &str,
    most: Memory,
) -> Result<Problem> {
    let frame = Frame { arrays, input };
    let (target, bias) = (frame.numbers("u_star")?, frame.numbers("bias")?);
    let compliance = frame.numbers("R")?;
    let (n, k) = (bias.len(), target.len());
    frame.check("R", compliance.len(), n)?;
    if let Some(row) = compliance.iter().position(|&value| value < 0.0) {
        let reason = format!("must not be negative, is {}", compliance[row]);
        return Err(frame.fault(&format!("R[{row}]"), reason));
    }
    let mass = frame.matrix(["M_data", "M_indices", "M_indptr"], k, k)?;
    let mut jacobian = vec![Vec::new(); n];
    let entries = frame.matrix(["J_data", "J_indices", "J_indptr"], n, k)?;
    entries.into_iter().for_each(|(i, j, value)| jacobian[i].push((j, value)));
    let along =
        |row: &Vec<(usize, f64)>| row.iter().map(|&(j, value)| value * target[j]).sum::<f64>();
    let b = jacobian.iter().zip(&bias).map(|(row, bias)| along(row) + bias).collect();
    let motion = Motion { mass, jacobian, force: vec![0.0; k] };
    let (entries, _) = motion.dual(&compliance, "M", input, most)?;
    let lcp = frame.lcp(Table { rows: n, cols: n, entries }, b)?;
    let mass = motion.mass.into_iter().filter(|(i, j, _)| i <= j).collect();
    let (lo, hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    let jacobian = motion.jacobian;
    let level = None;
    let gauss = Gauss { mass, jacobian, bias, compliance, target, lo, hi, level };
    let problem = Problem { motion: Some(gauss), ..Problem::new(name, lcp) };
    frame.with_words(Problem { extra: frame.answer(n, k)?, ..problem })
}

struct Frame<'a> {
    arrays: &'a Arrays<'a>,
    input: &'a str,
}

impl Frame<'_> {
    fn fault(&self, part: &str, reason: impl Into<String>) -> Error {
        Error::invalid(self.input, part, reason.into())
    }

    fn get(&self, part: &str) -> Result<&Array> {
        self.arrays.get(part).ok_or_else(|| self.fault(part, "is missing beside J_data"))
    }

    fn numbers(&self, part: &str) -> Result<Vec<f64>> {
        let values = self.get(part)?.vector().map_err(|reason| self.fault(part, reason))?;
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(values),
            Some(i) => Err(self.fault(part, format!("must be finite, is {} at {i}", values[i]))),
        }
    }

    fn wholes(&self, part: &str) -> Result<Vec<usize>> {
        self.get(part)?.wholes().map_err(|reason| self.fault(part, reason))
    }

    fn word(&self, part: &str) -> Result<String> {
        self.get(part)?.text().map_err(|reason| self.fault(part, reason))
    }

    fn check(&self, part: &str, length: usize, n: usize) -> Result<()> {
        match length == n {
            true => Ok(()),
            false => Err(self.fault(part, format!("has {length} entries, bias has {n} rows"))),
        }
    }

    /// The entries of a matrix stored by rows.
    fn matrix(&self, parts: [&str; 3], rows: usize, cols: usize) -> Result<Vec<Entry>> {
        let [data, indices, indptr] = parts;
        let (values, columns) = (self.numbers(data)?, self.wholes(indices)?);
        if values.len() != columns.len() {
            let reason = format!("has {} entries, {data} has {}", columns.len(), values.len());
            return Err(self.fault(indices, reason));
        }
        let lines = unpacked(&self.wholes(indptr)?, rows, values.len(), indptr, self.input)?;
        if let Some(column) = columns.iter().find(|&&column| column >= cols) {
            return Err(self.fault(indices, format!("has {column}, there are {cols} columns")));
        }
        let mut places: Vec<_> = lines.iter().zip(&columns).collect();
        places.sort_unstable();
        if places.windows(2).any(|two| two[0] == two[1]) {
            return Err(self.fault(indices, "has a column twice in one row"));
        }
        Ok(lines.into_iter().zip(columns).zip(values).map(|((i, j), v)| (i, j, v)).collect())
    }

    fn lcp(&self, table: Table, b: Vec<f64>) -> Result<Lcp> {
        let vector = |part: &str| match part {
            "b" => Ok(Some(b.clone())),
            _ => {
                let vector = self.arrays.get(part).map(Array::vector).transpose();
                vector.map_err(|reason| self.fault(part, reason))
            }
        };
        parts(table, vector, self.input)?.into_lcp().map_err(|error| error.within(self.input))
    }

    /// The key `answer`, if the frame has the engine's own x. Its numbers may be not finite: then
    /// they are what is wrong with the step.
    fn answer(&self, n: usize, k: usize) -> Result<Map<String, Value>> {
        let mut answer = Map::new();
        for (part, key, length) in [("x", "x", n), ("v", "motion", k)] {
            let Some(array) = self.arrays.get(part) else { continue };
            let values = array.vector().map_err(|reason| self.fault(part, reason))?;
            if values.len() != length {
                let reason = format!("has {} entries, must have {length}", values.len());
                return Err(self.fault(part, reason));
            }
            answer.insert(key.into(), values.into_iter().map(number).collect());
        }
        match (answer.contains_key("x"), answer.is_empty()) {
            (true, _) => Ok(Map::from_iter([("answer".into(), Value::Object(answer))])),
            (false, true) => Ok(answer),
            (false, false) => Err(self.fault("x", "is missing beside v")),
        }
    }

    /// The problem with its model, its scale and the other keys that are kept.
    fn with_words(&self, problem: Problem) -> Result<Problem> {
        let cone = self.word("cone")?;
        let model = match (cone.as_str(), problem.lcp.coupling()) {
            ("box", None) => None,
            ("box", Some(_)) => return Err(self.fault("cone", "is box, but rows are coupled")),
            _ => {
                Some(cone.parse().map_err(|reason: Error| self.fault("cone", reason.to_string()))?)
            }
        };
        let level = self.word("level")?;
        if !["velocity", "acceleration"].contains(&level.as_str()) {
            let reason = format!("must be velocity or acceleration, is {level:?}");
            return Err(self.fault("level", reason));
        }
        let level = Level::ALL.into_iter().find(|own| own.name() == level);
        let motion = problem.motion.map(|motion| Gauss { level, ..motion });
        let one = |part: &str| match self.get(part)?.number() {
            Ok(value) if value > 0.0 && value.is_finite() => Ok(value),
            Ok(value) => Err(self.fault(part, format!("must be positive, is {value}"))),
            Err(reason) => Err(self.fault(part, reason)),
        };
        let (dt, scale) = (one("dt")?, one("scale")?);
        let source: Value = serde_json::from_str(&self.word("source")?)
            .map_err(|cause| self.fault("source", cause.to_string()))?;
        let lcp = problem.lcp.with_scale(scale).map_err(|error| error.within(self.input))?;
        let mut extra = problem.extra;
        extra.insert("source".into(), source);
        extra.insert("dt".into(), json!(dt));
        Ok(Problem { lcp, model, motion, extra, ..problem })
    }
}
