//! A rejected step as files: its problem and answer, its receipt, and a page.

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::number;
use lcplab_lcp::number::{plain, readable};
use lcplab_lcp::{Gauss, Level};
use serde_json::{Map, Value, json};

use super::bounds::matrix;
use super::{EngineStep, Receipt};

/// The largest number of rows for which A is written.
const MOST_ROWS: usize = 5_000;

impl Receipt {
    /// The files of the folder of a step, by name: the problem and the engine's answer as given
    /// (frame.json, frame.x.json), the receipt as text, as JSON and as a page with a picture
    /// (receipt.html), and if the step can be shrunk, fewer rows that show the same error
    /// (shrunk.json, shrunk.x.json).
    ///
    /// # Errors
    /// If the shrunk step has too many rows for a dense A.
    pub fn folder(&self, problem: &Value, answer: &Value) -> Result<Vec<(&'static str, String)>> {
        let line = |value: &Value| format!("{value}\n");
        let mut files = vec![("frame.json", line(problem)), ("frame.x.json", line(answer))];
        let smaller = self.shrunk();
        if let Some(smaller) = &smaller {
            files.push(("shrunk.json", line(&smaller.to_problem()?)));
            files.push(("shrunk.x.json", line(&smaller.to_answer())));
        }
        files.push(("receipt.html", self.page(smaller.is_some())));
        files.push(("receipt.txt", format!("{}\n", plain(&self.text()))));
        files.push(("receipt.json", format!("{:#}\n", self.to_json())));
        Ok(files)
    }
}

impl EngineStep {
    /// The problem file of the step: A = J M⁻¹Jᵀ + compliance, b = J u* + bias, and the key
    /// `motion`.
    ///
    /// # Errors
    /// If there are too many rows for a dense A.
    pub fn to_problem(&self) -> Result<Value> {
        let n = self.len();
        if n > MOST_ROWS {
            let reason =
                format!("{n} rows are too many for a dense A; at most {MOST_ROWS} are allowed");
            return Err(Error::invalid("step", "rows", reason));
        }
        let Gauss { mass, jacobian, bias, compliance, target, lo, hi, level } = &self.gauss;
        let is_velocity = level.is_none_or(|level| level == Level::Velocity);
        let unit = if is_velocity { "N s" } else { "N" };
        let name =
            if self.source.name.is_empty() { &self.source.engine } else { &self.source.name };
        let time = readable(self.source.time, 4);
        let free = self.along(target);
        let rows = self.rows.iter().map(
            |row| json!({"label": row.label, "kind": row.kind, "unit": unit, "bodies": row.bodies}),
        );
        let a = matrix(self);
        let dense = (0..n).map(|i| {
            let mut line = vec![0.0; n];
            a.row(i).iter().for_each(|(j, value)| line[j] = value);
            numbers(&line)
        });
        // A row of friction has the limits of its cone only.
        let is_friction = |i: usize| self.friction.index[i].is_some();
        let lo = (0..n).map(|i| number(if is_friction(i) { f64::NEG_INFINITY } else { lo[i] }));
        let entry = |(i, j, value): (usize, usize, f64)| json!([i, j, number(value)]);
        let jacobian = jacobian.iter().enumerate();
        let jacobian = jacobian.flat_map(|(i, row)| row.iter().map(move |&(j, v)| (i, j, v)));
        let mut written = json!({
            "name": format!("{name} at {time} s"),
            "source": self.source,
            "A": {"dense": dense.collect::<Vec<_>>()},
            "b": numbers(&free.iter().zip(bias).map(|(free, bias)| free + bias).collect::<Vec<_>>()),
            "lo": lo.collect::<Vec<_>>(), "hi": numbers(hi), "rows": rows.collect::<Vec<_>>(),
            "motion": {
                "mass": mass.iter().map(|&own| entry(own)).collect::<Vec<_>>(),
                "jacobian": jacobian.map(entry).collect::<Vec<_>>(),
                "bias": numbers(bias), "compliance": numbers(compliance),
                "target": numbers(target), "level": level.unwrap_or(Level::Velocity).name(),
            },
        });
        if (0..n).any(is_friction) {
            let index = self.friction.index.iter();
            written["friction_index"] =
                index.map(|row| json!(row.map_or(-1, |row| row as i64))).collect();
            written["mu"] = numbers(&self.friction.mu);
            if let Some(model) = self.friction.model {
                written["model"] = json!(model.to_string());
            }
        }
        Ok(written)
    }

    /// The engine's answer, as a file with it has it.
    pub fn to_answer(&self) -> Value {
        let engine = format!("{} {}", self.source.engine, self.source.version);
        let mut written = Map::new();
        written.insert("x".into(), numbers(&self.answer.forces));
        written.insert("motion".into(), numbers(&self.answer.motion));
        written.insert("solver".into(), json!(engine.trim()));
        if let Some(push) = &self.answer.reported_push {
            written.insert("reported_push".into(), numbers(push));
        }
        Value::Object(written)
    }
}

fn numbers(values: &[f64]) -> Value {
    values.iter().map(|&value| number(value)).collect()
}
