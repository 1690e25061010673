//! Derivatives of a solution.

use lcplab::error::Error;
use lcplab::gradient::{Direction, Gradient as Derivative, Theirs};
use lcplab::report::answer::first_answer;
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;
use serde_json::Value;

use crate::problem::Problem;
use crate::refused;
use crate::solving::question;

/// The derivative of a solution.
#[pyclass(frozen, module = "lcplab._lcplab")]
pub struct Gradient(Derivative);

/// The derivative at the solution next to x, or next to the default method's answer.
#[pyfunction]
pub fn gradient(
    py: Python<'_>,
    problem: &Problem,
    x: Option<PyReadonlyArray1<'_, f64>>,
) -> PyResult<Gradient> {
    let question = question(problem, None, None)?;
    let n = question.require_boxed("derivatives are", "problem").map_err(refused)?.len();
    let x = x.map(|x| x.as_array().to_vec());
    if let Some(x) = x.as_ref().filter(|x| x.len() != n) {
        let reason = format!("has length {}, the problem has {n} rows", x.len());
        return Err(refused(Error::invalid("answer", "x", reason)));
    }
    let inner = py.detach(|| {
        let x = x.unwrap_or_else(|| first_answer(&question));
        Derivative::of(&problem.0, &x)
    });
    inner.map(Gradient).map_err(refused)
}

#[pymethods]
impl Gradient {
    /// The object that the command line prints, as JSON.
    fn json(&self, py: Python<'_>) -> String {
        Value::Object(py.detach(|| self.0.json())).to_string()
    }

    /// The text that the command line prints.
    fn text(&self, py: Python<'_>) -> String {
        py.detach(|| self.0.text())
    }

    /// The gradients of vᵀx + cᵀu, as JSON.
    fn pullback(
        &self,
        py: Python<'_>,
        v: PyReadonlyArray1<'_, f64>,
        c: Option<PyReadonlyArray1<'_, f64>>,
    ) -> PyResult<String> {
        let (v, c) = (v.as_array().to_vec(), c.map(|c| c.as_array().to_vec()));
        let pullback = py.detach(|| self.0.pullback(&v, c.as_deref())).map_err(refused)?;
        Ok(pullback.json().to_string())
    }

    /// The derivatives in a direction, to the right and to the left, as JSON.
    fn directional(&self, py: Python<'_>, direction: &str) -> PyResult<[String; 2]> {
        let direction = Direction::read(direction, "direction").map_err(refused)?;
        let both = py.detach(|| self.0.directional(&direction)).map_err(refused)?;
        Ok(both.map(|derivative| derivative.json().to_string()))
    }

    /// The comparison with a matrix dx/db, as JSON and as text.
    fn compare(
        &self,
        py: Python<'_>,
        dx_db: PyReadonlyArray2<'_, f64>,
        h: Option<f64>,
        tolerance: Option<f64>,
    ) -> PyResult<(String, String)> {
        let dx_db = dx_db.as_array().rows().into_iter().map(|row| row.to_vec()).collect();
        let theirs = Theirs { dx_db, h, tolerance: tolerance.unwrap_or(Theirs::TOLERANCE) };
        let found = py.detach(|| self.0.compare(&theirs)).map_err(refused)?;
        Ok((found.json().to_string(), found.text()))
    }
}
