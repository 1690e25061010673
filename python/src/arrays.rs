//! Matrices and vectors from Python's arrays.

use lcplab::error::{Error, Result};
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::Model;
use lcplab::lcp::{Coupling, Lcp, Matrix};
use numpy::{PyReadonlyArray1, PyReadonlyArray2};
use pyo3::prelude::*;

/// A dense matrix, or the rows, columns and values of a sparse one.
#[derive(FromPyObject)]
pub enum Entries<'py> {
    Dense(PyReadonlyArray2<'py, f64>),
    Sparse(
        usize,
        PyReadonlyArray1<'py, i64>,
        PyReadonlyArray1<'py, i64>,
        PyReadonlyArray1<'py, f64>,
    ),
}

impl Entries<'_> {
    /// The matrix of a problem of n rows.
    fn matrix(&self, n: usize) -> Result<Matrix> {
        let wrong = |reason: String| Err(Error::invalid("problem", "A", reason));
        match self {
            Entries::Dense(entries) => {
                let view = entries.as_array();
                if view.dim() != (n, n) {
                    let (rows, cols) = view.dim();
                    return wrong(format!("is {rows} × {cols}, b has {n} entries"));
                }
                Ok(Matrix::dense(n, &view.iter().copied().collect::<Vec<f64>>()))
            }
            Entries::Sparse(size, rows, cols, values) => {
                if *size != n {
                    return wrong(format!("is {size} × {size}, b has {n} entries"));
                }
                let (rows, cols, values) = (rows.as_array(), cols.as_array(), values.as_array());
                let place = |k: i64| usize::try_from(k).ok().filter(|&k| k < n);
                let mut entries = Vec::with_capacity(values.len());
                for ((&i, &j), &value) in rows.iter().zip(&cols).zip(&values) {
                    match (place(i), place(j)) {
                        (Some(i), Some(j)) => entries.push((i, j, value)),
                        _ => return wrong(format!("has an entry at {i}, {j}")),
                    }
                }
                Ok(Matrix::sparse(n, &entries))
            }
        }
    }
}

/// The vectors of a problem beside A.
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
    name: Option<String>,
}

/// The problem of these arrays.
pub fn problem(a: &Entries<'_>, vectors: &Vectors<'_>) -> Result<Problem> {
    let b = vectors.b.as_array().to_vec();
    let n = b.len();
    let index: Option<Vec<Option<usize>>> = vectors
        .friction_index
        .as_ref()
        .map(|index| index.as_array().iter().map(|&k| row(k)).collect::<Result<_>>())
        .transpose()?;
    let is_coupled =
        |i: usize| index.as_ref().is_some_and(|index| index.get(i).is_some_and(Option::is_some));
    let given = |bounds: &Option<PyReadonlyArray1<'_, f64>>| {
        bounds.as_ref().map(|bounds| bounds.as_array().to_vec())
    };
    let least = |i: usize| if is_coupled(i) { -f64::INFINITY } else { 0.0 };
    let lo = given(&vectors.lo).unwrap_or_else(|| (0..n).map(least).collect());
    let hi = given(&vectors.hi).unwrap_or_else(|| vec![f64::INFINITY; n]);
    let mut lcp = Lcp::new(a.matrix(n)?, b, lo, hi)?.with_scale(vectors.scale.unwrap_or(0.0))?;
    lcp = match (index, &vectors.mu) {
        (Some(index), Some(mu)) => {
            lcp.with_coupling(Coupling::new(index, mu.as_array().to_vec())?)?
        }
        (None, None) => lcp,
        _ => return Err(Error::invalid("problem", "mu", "friction_index and mu come together")),
    };
    let model: Option<Model> = vectors.model.as_ref().map(|model| model.parse()).transpose()?;
    let name = vectors.name.clone().unwrap_or_default();
    Ok(Problem { model, ..Problem::new(name, lcp) })
}

/// The row that an entry of `friction_index` names; −1 for none.
fn row(k: i64) -> Result<Option<usize>> {
    match k {
        -1 => Ok(None),
        k => usize::try_from(k).map(Some).map_err(|_| {
            Error::invalid("problem", "friction_index", format!("must be a row or -1, is {k}"))
        }),
    }
}
