//! The smallest problem on which a solver is wrong.

use std::time::Duration;

use lcplab::hunt::{Finding, Measure, Search, Trial};
use lcplab::solver::{MatrixClass, Stop};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::problem::Problem;
use crate::solving::SolverSettings;
use crate::waiting::wait;
use crate::{callable, refused};

/// What is hunted, and where.
#[derive(FromPyObject)]
pub struct Quarry {
    #[pyo3(item("measure"))]
    measure: String,
    #[pyo3(item("rows"))]
    rows: (usize, usize),
    #[pyo3(item("evaluations"))]
    evaluations: usize,
    #[pyo3(item("seed"))]
    seed: u64,
    #[pyo3(item("at_least"))]
    at_least: Option<f64>,
    #[pyo3(item("within"))]
    within: String,
    #[pyo3(item("seconds"))]
    seconds: Option<f64>,
    #[pyo3(item("with_friction"))]
    with_friction: bool,
}

/// What was found, or how many problems were tried in vain.
#[pyfunction]
pub fn hunt<'py>(
    py: Python<'py>,
    solver: Bound<'py, PyAny>,
    rival: Option<Bound<'py, PyAny>>,
    quarry: Quarry,
    given: SolverSettings,
    start: Vec<PyRef<'py, Problem>>,
) -> PyResult<Bound<'py, PyDict>> {
    let measure: Measure = quarry
        .measure
        .parse()
        .map_err(|reason: String| PyValueError::new_err(format!("measure: {reason}")))?;
    let within = MatrixClass::by_word(&quarry.within).map_err(refused)?;
    let trial = Trial {
        measure,
        solver: callable::entry(&solver)?,
        rival: rival.map(|rival| callable::entry(&rival)).transpose()?,
        options: given.options()?,
        within,
        with_friction: quarry.with_friction,
        best_omega: true,
    };
    trial.validate().map_err(refused)?;
    let search = Search {
        rows: quarry.rows.0..=quarry.rows.1,
        evaluations: quarry.evaluations,
        seed: quarry.seed,
        at_least: quarry.at_least,
        from: start.iter().map(|problem| problem.0.lcp.clone()).collect(),
    };
    search.validate().map_err(refused)?;
    let limit = quarry.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let stop = limit.map_or_else(Stop::default, Stop::after);
    let (searched, finding) = wait(py, &stop, || {
        let searched = search.run(&trial, &stop, &|_| ());
        let finding = searched.catch.as_ref().map(|catch| Finding::of(catch, &trial, quarry.seed));
        (searched, finding)
    })?;
    let told = PyDict::new(py);
    told.set_item("evaluations", searched.evaluations)?;
    if let (Some(catch), Some(finding)) = (searched.catch, finding) {
        told.set_item("value", catch.value)?;
        told.set_item("evaluation", catch.evaluation)?;
        told.set_item("words", finding.words.clone())?;
        told.set_item("equations", finding.equations())?;
        told.set_item("problem", Bound::new(py, Problem(finding.problem))?)?;
    }
    Ok(told)
}
