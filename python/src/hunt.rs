//! The smallest problem on which a solver is wrong.

use std::time::Duration;

use lcplab::hunt::{Finding, Friction, Given, Measure, Search, Target};
use lcplab::lcp::friction::Model;
use lcplab::solver::{MatrixClass, Stop};
use numpy::PyArray1;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::problem::Problem;
use crate::solving::SolverSettings;
use crate::waiting::wait;
use crate::{callable, refused};

/// The target of the search, and its problems.
#[derive(FromPyObject)]
pub struct SearchArgs {
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
    within: Option<String>,
    #[pyo3(item("model"))]
    model: Option<String>,
    #[pyo3(item("seconds"))]
    seconds: Option<f64>,
    #[pyo3(item("friction"))]
    friction: String,
}

/// The finding, and the number of problems that were tried.
#[pyfunction]
pub fn hunt<'py>(
    py: Python<'py>,
    solver: Bound<'py, PyAny>,
    baseline: Option<Bound<'py, PyAny>>,
    args: SearchArgs,
    given: SolverSettings,
    start: Vec<PyRef<'py, Problem>>,
) -> PyResult<Bound<'py, PyDict>> {
    let measure: Measure = args
        .measure
        .parse()
        .map_err(|reason: String| PyValueError::new_err(format!("measure: {reason}")))?;
    let within = args.within.as_deref().map(MatrixClass::by_word).transpose().map_err(refused)?;
    let model = args.model.as_deref().map(str::parse::<Model>).transpose().map_err(refused)?;
    let start: Vec<_> = start
        .iter()
        .enumerate()
        .map(|(k, problem)| match problem.0.name.as_str() {
            "" => (format!("problem {k}"), problem.0.clone()),
            name => (name.to_string(), problem.0.clone()),
        })
        .collect();
    let start = Given::new(&start, within, model).map_err(refused)?;
    let target = Target {
        measure,
        solver: callable::method(&solver, start.model)?,
        baseline: baseline.map(|baseline| callable::method(&baseline, start.model)).transpose()?,
        options: given.options()?,
        model: start.model,
        within: start.within,
        friction: match args.friction.as_str() {
            "only" => Friction::Only,
            "never" => Friction::Never,
            _ => Friction::Any,
        },
        allows_single_tangents: start.has_single_tangents,
        best_omega: true,
    };
    target.validate().map_err(refused)?;
    let search = Search {
        rows: args.rows.0..=args.rows.1,
        evaluations: args.evaluations,
        seed: args.seed,
        at_least: args.at_least,
        from: start.problems,
    };
    search.validate(&target).map_err(refused)?;
    let limit = args.seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    let stop = limit.map_or_else(Stop::default, Stop::after);
    let (result, finding) = wait(py, &stop, || {
        let result = search.run(&target, &stop, &|_| ());
        let finding = result
            .counterexample
            .as_ref()
            .map(|counterexample| Finding::of(counterexample, &target, args.seed));
        (result, finding)
    })?;
    let fields = PyDict::new(py);
    fields.set_item("evaluations", result.evaluations)?;
    fields.set_item("solved", result.solved)?;
    fields.set_item("useless", result.useless(target.solver.name()))?;
    fields.set_item("notes", start.notes)?;
    if let (Some(counterexample), Some(finding)) = (result.counterexample, finding) {
        fields.set_item("value", counterexample.value)?;
        fields.set_item("evaluation", counterexample.evaluation)?;
        fields.set_item("words", finding.words.clone())?;
        fields.set_item("equations", finding.equations())?;
        fields.set_item("answers", finding.answers())?;
        let vector = |x: &[f64]| PyArray1::from_slice(py, x);
        fields.set_item("x", finding.answer.as_deref().map(vector))?;
        fields.set_item("right_x", finding.right.as_ref().map(|right| vector(&right.x)))?;
        fields.set_item("problem", Bound::new(py, Problem(finding.problem))?)?;
    }
    Ok(fields)
}
