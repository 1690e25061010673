//! A problem: made from arrays, read from a file, or a family of the library.

use std::path::PathBuf;

use lcplab::card::Card;
use lcplab::files;
use lcplab::lcp::{file, library};
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

use crate::arrays::{self, Given, Vectors};
use crate::refused;

/// A boxed linear complementarity problem.
#[pyclass(frozen, module = "lcplab._lcplab", subclass)]
pub struct Problem(pub file::Problem);

/// The rows, the columns and the values of the entries of A.
type Triplets<'py> =
    (Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>);

#[pymethods]
impl Problem {
    /// The problem of these arrays.
    #[staticmethod]
    fn of(a: Given<'_>, vectors: Vectors<'_>) -> PyResult<Self> {
        arrays::problem(&a, &vectors).map(Problem).map_err(refused)
    }

    /// The problem of a file.
    #[staticmethod]
    fn read(path: PathBuf) -> PyResult<Self> {
        files::read(&path, None).map(Problem).map_err(refused)
    }

    /// A problem of the library.
    #[staticmethod]
    fn generate(family: &str, values: Vec<(String, f64)>) -> PyResult<Self> {
        let values: Vec<(&str, f64)> =
            values.iter().map(|(name, value)| (name.as_str(), *value)).collect();
        let made = library::by_name(family).and_then(|family| family.generate(&values));
        made.map(Problem).map_err(refused)
    }

    /// Writes it to a file; returns warnings for its readers.
    fn write(&self, path: PathBuf) -> PyResult<Vec<String>> {
        files::write(&self.0, &path, None).map_err(refused)
    }

    /// The text of its problem file.
    fn json(&self) -> String {
        self.0.to_json().to_string()
    }

    /// Its properties that are known before it is solved, as JSON.
    fn card(&self) -> String {
        serde_json::to_string(&Card::of(&self.0.lcp)).unwrap_or_default()
    }

    fn __len__(&self) -> usize {
        self.0.lcp.len()
    }

    #[getter]
    fn name(&self) -> &str {
        &self.0.name
    }

    #[getter]
    fn a<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        arrays::matrix(py, &self.0.lcp)
    }

    fn triplets<'py>(&self, py: Python<'py>) -> Triplets<'py> {
        let lcp = &self.0.lcp;
        let (mut rows, mut cols, mut values) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..lcp.len() {
            for (j, value) in lcp.matrix().row(i).iter() {
                rows.push(i as i64);
                cols.push(j as i64);
                values.push(value);
            }
        }
        (PyArray1::from_vec(py, rows), PyArray1::from_vec(py, cols), PyArray1::from_vec(py, values))
    }

    #[getter]
    fn b<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.lcp.b())
    }

    #[getter]
    fn lo<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.lcp.lo())
    }

    #[getter]
    fn hi<'py>(&self, py: Python<'py>) -> Bound<'py, PyArray1<f64>> {
        PyArray1::from_slice(py, self.0.lcp.hi())
    }

    #[getter]
    fn friction_index<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<i64>>> {
        Some(arrays::coupling(py, &self.0.lcp)?.0)
    }

    #[getter]
    fn mu<'py>(&self, py: Python<'py>) -> Option<Bound<'py, PyArray1<f64>>> {
        Some(arrays::coupling(py, &self.0.lcp)?.1)
    }

    #[getter]
    fn model(&self) -> Option<String> {
        self.0.model.map(|model| model.to_string())
    }

    /// Its known solutions, as JSON.
    fn expected(&self) -> Option<String> {
        self.0.extra.get("expected").map(ToString::to_string)
    }
}
