//! Matrices and vectors from Python's arrays, and to them.

use lcplab::error::{Error, Result};
use lcplab::lcp::Lcp;
use lcplab::lcp::file::{Entries, Parts, Problem};
use numpy::{PyArray1, PyArray2, PyArrayMethods, PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// A dense matrix, or the rows, columns and values of a sparse one with this number of rows.
#[derive(FromPyObject)]
pub enum Given<'py> {
    Dense(PyReadonlyArray2<'py, f64>),
    Sparse(
        usize,
        PyReadonlyArray1<'py, i64>,
        PyReadonlyArray1<'py, i64>,
        PyReadonlyArray1<'py, f64>,
    ),
}

impl Given<'_> {
    /// The entries of the matrix of a problem of n rows.
    fn entries(&self, n: usize) -> Result<Entries> {
        let wrong = |reason: String| Err(Error::invalid("problem", "A", reason));
        let (rows, cols) = match self {
            Given::Dense(entries) => entries.as_array().dim(),
            Given::Sparse(size, ..) => (*size, *size),
        };
        if (rows, cols) != (n, n) {
            return wrong(format!("is {rows} × {cols}, b has {n} entries"));
        }
        let (rows, cols, values) = match self {
            Given::Dense(entries) => {
                return Ok(Entries::Dense(entries.as_array().iter().copied().collect()));
            }
            Given::Sparse(_, rows, cols, values) => (rows, cols, values),
        };
        let places = rows.as_array().into_iter().zip(cols.as_array());
        let place = |k: &i64| usize::try_from(*k).ok().filter(|&k| k < n);
        let mut entries = Vec::new();
        for ((i, j), value) in places.zip(values.as_array()) {
            match (place(i), place(j)) {
                (Some(i), Some(j)) => entries.push((i, j, *value)),
                _ => return wrong(format!("has an entry at {i}, {j}")),
            }
        }
        Ok(Entries::Sparse(entries))
    }
}

/// The vectors of a problem.
#[derive(FromPyObject)]
pub struct Vectors<'py> {
    #[pyo3(item("b"))]
    b: PyReadonlyArray1<'py, f64>,
    #[pyo3(item("lo"))]
    lo: Option<PyReadonlyArray1<'py, f64>>,
    #[pyo3(item("hi"))]
    hi: Option<PyReadonlyArray1<'py, f64>>,
    #[pyo3(item("friction_index"))]
    friction_index: Option<PyReadonlyArray1<'py, i64>>,
    #[pyo3(item("mu"))]
    mu: Option<PyReadonlyArray1<'py, f64>>,
    #[pyo3(item("model"))]
    model: Option<String>,
    #[pyo3(item("scale"))]
    scale: Option<f64>,
    #[pyo3(item("name"))]
    name: String,
}

/// The problem of these arrays.
pub fn problem(a: &Given<'_>, vectors: &Vectors<'_>) -> Result<Problem> {
    let numbers = |array: &Option<PyReadonlyArray1<'_, f64>>| {
        array.as_ref().map(|array| array.as_array().to_vec())
    };
    let index = vectors
        .friction_index
        .as_ref()
        .map(|index| index.as_array().iter().map(|&k| row(k)).collect::<Result<Vec<_>>>());
    let b = vectors.b.as_array().to_vec();
    let parts = Parts {
        entries: a.entries(b.len())?,
        b,
        lo: numbers(&vectors.lo),
        hi: numbers(&vectors.hi),
        index: index.transpose()?,
        mu: numbers(&vectors.mu),
    };
    let lcp = parts.into_lcp()?.with_scale(vectors.scale.unwrap_or(0.0))?;
    let model = vectors.model.as_ref().map(|model| model.parse()).transpose()?;
    Ok(Problem { model, ..Problem::new(&vectors.name, lcp) })
}

/// The row to which an entry of `friction_index` refers; −1 for none.
fn row(k: i64) -> Result<Option<usize>> {
    match k {
        -1 => Ok(None),
        k => usize::try_from(k).map(Some).map_err(|_| {
            Error::invalid("problem", "friction_index", format!("must be a row or -1, is {k}"))
        }),
    }
}

/// A in full.
pub fn matrix<'py>(py: Python<'py>, lcp: &Lcp) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let n = lcp.len();
    let entries = (0..n).flat_map(|i| (0..n).map(move |j| lcp.matrix().entry(i, j)));
    PyArray1::from_vec(py, entries.collect()).reshape([n, n])
}

/// The row that bounds each row, −1 for none, and its μ; `None` without friction.
#[expect(clippy::type_complexity, reason = "two arrays")]
pub fn coupling<'py>(
    py: Python<'py>,
    lcp: &Lcp,
) -> Option<(Bound<'py, PyArray1<i64>>, Bound<'py, PyArray1<f64>>)> {
    let coupling = lcp.coupling()?;
    let index = (0..lcp.len()).map(|i| coupling.index(i).map_or(-1, |k| k as i64));
    let mu = (0..lcp.len()).map(|i| coupling.mu(i));
    Some((PyArray1::from_iter(py, index), PyArray1::from_iter(py, mu)))
}
