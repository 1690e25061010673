//! lcplab for Python: the extension module of the package `lcplab`.
//!
//! Arrays are passed as NumPy arrays in both directions; all other results are the JSON that the
//! command line prints, which the package reads. While Rust computes, other Python threads run; the
//! interpreter lock is held only during calls of the user's functions.

mod arrays;
mod callable;
mod gradient;
mod hunt;
mod problem;
mod proof;
mod receipt;
mod scene;
mod solving;
mod waiting;

use pyo3::prelude::*;
use pyo3::{create_exception, exceptions::PyValueError};

create_exception!(
    lcplab,
    InputError,
    PyValueError,
    "Invalid input; the message lists every defect."
);

/// An error of lcplab as a Python exception.
fn refused(error: lcplab::error::Error) -> PyErr {
    InputError::new_err(error.to_string())
}

#[pymodule]
fn _lcplab(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("InputError", module.py().get_type::<InputError>())?;
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add_class::<problem::Problem>()?;
    module.add_class::<gradient::Gradient>()?;
    module.add_class::<scene::Scene>()?;
    module.add_class::<scene::SimulatedStep>()?;
    module.add_function(wrap_pyfunction!(scene::describe, module)?)?;
    module.add_function(wrap_pyfunction!(scene::describe_json, module)?)?;
    module.add_function(wrap_pyfunction!(gradient::gradient, module)?)?;
    module.add_function(wrap_pyfunction!(solving::solve, module)?)?;
    module.add_function(wrap_pyfunction!(solving::judge, module)?)?;
    module.add_function(wrap_pyfunction!(solving::judge_text, module)?)?;
    module.add_function(wrap_pyfunction!(solving::explain, module)?)?;
    module.add_function(wrap_pyfunction!(solving::compare, module)?)?;
    module.add_function(wrap_pyfunction!(solving::solvers, module)?)?;
    module.add_function(wrap_pyfunction!(hunt::hunt, module)?)?;
    module.add_function(wrap_pyfunction!(proof::prove, module)?)?;
    module.add_function(wrap_pyfunction!(proof::check, module)?)?;
    module.add_function(wrap_pyfunction!(proof::solutions, module)?)?;
    module.add_class::<receipt::StepReceipt>()?;
    module.add_class::<receipt::RunReport>()?;
    module.add_function(wrap_pyfunction!(receipt::step_receipts, module)?)?;
    module.add_function(wrap_pyfunction!(receipt::frame_files, module)?)?;
    module.add_function(wrap_pyfunction!(receipt::read_frame, module)?)?;
    module.add_function(wrap_pyfunction!(receipt::step_files, module)?)?;
    module.add_function(wrap_pyfunction!(run, module)?)?;
    Ok(())
}

/// Runs the command line; the program's name first. Returns the exit code.
#[pyfunction]
fn run(py: Python<'_>, arguments: Vec<String>) -> u8 {
    py.detach(|| lcplab::cli::run(arguments.into_iter().map(Into::into)))
}
