//! All solutions of a small problem, in exact arithmetic.

use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::file::Problem;
use serde::Deserialize;
use serde_json::{Map, Value, json};

use super::Answer;

/// The problem.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// A problem file with a few rows.
    problem: Map<String, Value>,
}

impl Question {
    /// The solutions, or the corners of their set, as numbers and as fractions; `null` if there are
    /// too many active sets to try.
    pub fn answer(self) -> Answer {
        let text = Value::Object(self.problem).to_string();
        let Problem { lcp, .. } = Problem::parse(&text, "problem").map_err(|e| e.to_string())?;
        let Some(all) = all_solutions(&lcp) else { return Ok(json!({ "solutions": null })) };
        let solutions = all.iter().map(|x| {
            let fractions: Vec<String> = x.iter().map(ToString::to_string).collect();
            let numbers: Vec<f64> = x.iter().map(|x| x.to_f64().value()).collect();
            json!({ "x": numbers, "fractions": fractions })
        });
        Ok(json!({ "solutions": solutions.collect::<Vec<_>>() }))
    }
}
