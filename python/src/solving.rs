//! Solve, judge, explain and compare.

use lcplab::document::Format;
use lcplab::error::Error;
use lcplab::explain::{Method as Explained, problem as explained};
use lcplab::judge::{Demand, Verdict};
use lcplab::lcp::Lcp;
use lcplab::lcp::Question;
use lcplab::lcp::friction::Model;
use lcplab::number::plain;
use lcplab::report::answer::{Answer, attempts_json, json_object, searched};
use lcplab::report::friction::{self, JudgedAnswer};
use lcplab::report::study::families::{self, Contender, Models};
use lcplab::report::{methods, terminal, view};
use lcplab::solver::{
    Entry, Method, Observer, Options, Registry, SequenceAnswer, Settings, Solution, Start, Stop,
    default_for, solve_boxed_by_sequence,
};
use lcplab::trace::Convergence;
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use serde_json::Value;

use crate::problem::Problem;
use crate::waiting::{quickly, wait};
use crate::{callable, refused};

/// Smaller problems are solved on the calling thread, too fast to be interrupted.
const QUICK_ROWS: usize = 200;

/// The settings of a solver.
#[derive(FromPyObject)]
pub struct SolverSettings {
    #[pyo3(item("tolerance"))]
    tolerance: f64,
    #[pyo3(item("max_iterations"))]
    max_iterations: usize,
    #[pyo3(item("omega"))]
    omega: Option<f64>,
}

impl SolverSettings {
    pub fn options(&self) -> PyResult<Options> {
        let settings = Settings::default()
            .with_tolerance(self.tolerance)
            .with_max_iterations(self.max_iterations);
        let mut options = Options::default().with_settings(settings);
        options.omega = self.omega.unwrap_or(options.omega);
        options.validate().map_err(refused)?;
        Ok(options)
    }
}

/// The answer as a dictionary: x and w as arrays, the certificate as JSON.
#[pyfunction]
pub fn solve<'py>(
    py: Python<'py>,
    problem: &Problem,
    solver: Option<Bound<'py, PyAny>>,
    given: SolverSettings,
    model: Option<String>,
    prove: Option<bool>,
    trace: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let prove_up_to = match prove {
        Some(true) => Demand::EXACT_ROWS,
        Some(false) => 0,
        None => Demand::default().prove_up_to,
    };
    let demand = Demand { tolerance: given.tolerance, prove_up_to };
    let options = given.options()?;
    let name = solver.as_ref().and_then(|solver| solver.extract::<String>().ok());
    let question = question(problem, model, name.as_deref())?;
    if let Some(model) = question.model() {
        if trace {
            let reason = "keeps the iterates of a problem that is solved without a friction model";
            return Err(refused(Error::invalid("options", "trace", reason)));
        }
        return solve_modelled(py, &question, model, solver, &options, &demand);
    }
    let lcp = &problem.0.lcp;
    let method = match solver {
        Some(solver) => Some(callable::method(&solver, None)?),
        // With a trace, one method runs.
        None if trace => {
            let default = methods::with_reference().method(default_for(lcp), None);
            Some(default.map_err(refused)?.clone())
        }
        None => None,
    };
    let entry = method.as_ref().and_then(Method::boxed);
    let stop = Stop::default();
    let work = || answered(lcp, entry, &options, &demand, trace, &stop);
    let (answer, records) = match lcp.len() <= QUICK_ROWS && !trace {
        true => quickly(py, work)?,
        false => wait(py, &stop, work)?,
    };
    let certificate = &answer.certificate;
    let fields = fields(py, &answer.solution, &certificate.w, &certificate.verdict)?;
    fields.set_item("status", answer.status_word())?;
    fields.set_item("message", answer.message())?;
    fields.set_item("solver", answer.solver)?;
    let mut object = json_object(certificate);
    object.extend(attempts_json(&answer.attempts));
    fields.set_item("certificate", Value::Object(object).to_string())?;
    if trace {
        let column =
            |of: fn(&lcplab::trace::Record) -> f64| PyArray1::from_iter(py, records.iter().map(of));
        let columns = PyDict::new(py);
        columns.set_item("iteration", column(|record| record.iteration as f64))?;
        columns.set_item("scaled_residual", column(|record| record.scaled_residual))?;
        columns.set_item("natural_residual", column(|record| record.natural_residual))?;
        columns.set_item("objective", column(|record| record.objective))?;
        fields.set_item("trace", columns)?;
    }
    Ok(fields)
}

/// The keys that every answer has.
fn fields<'py>(
    py: Python<'py>,
    solution: &Solution,
    w: &[f64],
    verdict: &Verdict,
) -> PyResult<Bound<'py, PyDict>> {
    let fields = PyDict::new(py);
    fields.set_item("x", PyArray1::from_slice(py, &solution.x))?;
    fields.set_item("w", PyArray1::from_slice(py, w))?;
    fields.set_item("iterations", solution.iterations)?;
    fields.set_item("is_solution", verdict.is_solution())?;
    Ok(fields)
}

/// The problem under the requested friction model, or under the one that it states.
pub fn question(
    problem: &Problem,
    model: Option<String>,
    solver: Option<&str>,
) -> PyResult<Question> {
    let asked = model.map(|model| model.parse()).transpose().map_err(refused)?;
    let model = friction::model(asked, solver, &problem.0, methods::with_reference());
    Question::new(&problem.0, model, "problem").map_err(refused)
}

fn solve_modelled<'py>(
    py: Python<'py>,
    question: &Question,
    model: Model,
    solver: Option<Bound<'py, PyAny>>,
    options: &Options,
    demand: &Demand,
) -> PyResult<Bound<'py, PyDict>> {
    let method = solver.map(|solver| callable::method(&solver, Some(model))).transpose()?;
    let stop = Stop::default();
    let (answered, judged) = wait(py, &stop, || {
        let mut nobody = ();
        let observer = &mut stop.watch(&mut nobody);
        match &method {
            Some(method) => {
                let (solution, judged) =
                    friction::solve(question, method, options, demand, observer);
                let solver = method.name().to_string();
                (SequenceAnswer { solver, solution, attempts: Vec::new() }, judged)
            }
            None => friction::solve_by_default(question, options, demand, observer),
        }
    })?;
    let SequenceAnswer { solver, solution, attempts } = answered;
    let certificate = &judged.certificate;
    let (status, message) = judged.claim(&solution.status, None);
    let fields = fields(py, &solution, &certificate.w, &certificate.verdict)?;
    fields.set_item("status", status)?;
    fields.set_item("message", message)?;
    fields.set_item("solver", solver)?;
    let mut certificate = judged.json();
    certificate.extend(attempts_json(&attempts));
    fields.set_item("certificate", Value::Object(certificate).to_string())?;
    Ok(fields)
}

fn answered(
    lcp: &Lcp,
    entry: Option<&Entry>,
    options: &Options,
    demand: &Demand,
    trace: bool,
    stop: &Stop,
) -> (Answer, Vec<lcplab::trace::Record>) {
    let mut convergence = Convergence::of(lcp);
    let observer: &mut dyn Observer = if trace { &mut convergence } else { &mut () };
    let (observer, start) = (&mut stop.watch(observer), Start::default());
    let SequenceAnswer { solver, solution, attempts } = match entry {
        Some(entry) => SequenceAnswer {
            solver: entry.name.to_string(),
            solution: entry.build(options).solve(lcp, &start, observer),
            attempts: Vec::new(),
        },
        None => solve_boxed_by_sequence(lcp, &start, options, observer),
    };
    let answer = Answer::judged(lcp, solver, solution, demand).searched(lcp, demand);
    (answer.after(attempts), convergence.records)
}

/// The judge's certificate, as JSON, with whether x is accepted.
#[pyfunction]
pub fn judge(
    py: Python<'_>,
    problem: &Problem,
    x: PyReadonlyArray1<'_, f64>,
    tolerance: f64,
    model: Option<String>,
) -> PyResult<(bool, String)> {
    let (lcp, x) = (&problem.0.lcp, x.as_array().to_vec());
    if x.len() != lcp.len() {
        let reason = format!("has length {}, the problem has {} rows", x.len(), lcp.len());
        return Err(refused(Error::invalid("answer", "x", reason)));
    }
    Settings::default().with_tolerance(tolerance).validate().map_err(refused)?;
    let demand = Demand { tolerance, prove_up_to: Demand::EXACT_ROWS };
    let question = question(problem, model, None)?;
    let (verdict, object) = match question.model() {
        Some(_) => {
            let judged = py.detach(|| {
                JudgedAnswer::of(&question, &x, &demand).searched(question.posed(), &demand)
            });
            (judged.certificate.verdict, judged.json())
        }
        None => {
            let certificate =
                py.detach(|| searched(lcp, lcplab::judge::judge(lcp, &x, &demand), &demand));
            (certificate.verdict, json_object(&certificate))
        }
    };
    Ok((verdict.is_solution(), Value::Object(object).to_string()))
}

/// What the command `judge` prints about x.
#[pyfunction]
pub fn judge_text(
    py: Python<'_>,
    problem: &Problem,
    x: PyReadonlyArray1<'_, f64>,
    tolerance: f64,
    model: Option<String>,
) -> PyResult<String> {
    let x = x.as_array().to_vec();
    let demand = Demand { tolerance, prove_up_to: Demand::EXACT_ROWS };
    let question = question(problem, model, None)?;
    Ok(py.detach(|| plain(&lcplab::cli::judged_text(&question, &x, &demand))))
}

/// The derivation of a solution: as text, as Markdown and as a page.
#[pyfunction]
pub fn explain(
    py: Python<'_>,
    problem: &Problem,
    solver: Option<String>,
    given: SolverSettings,
    model: Option<String>,
) -> PyResult<[String; 3]> {
    let name = solver.unwrap_or_else(|| default_for(&problem.0.lcp).into());
    let options = given.options()?;
    let question = question(problem, model, None)?;
    let written = py.detach(|| {
        let document = explained(&question, &Explained::with(&name, options)?)?;
        let form = |format| document.written(format);
        Ok([form(Format::Text)?, form(Format::Markdown)?, form(Format::Html)?])
    });
    written.map_err(refused)
}

/// The rows of a comparison, as JSON, and its table as text. Problems of one name are one row.
#[pyfunction]
pub fn compare(
    py: Python<'_>,
    problems: Vec<(String, Vec<PyRef<'_, Problem>>)>,
    solvers: Vec<Bound<'_, PyAny>>,
    models: Vec<String>,
    given: SolverSettings,
) -> PyResult<(String, String)> {
    let mut chosen = Vec::new();
    let usual = if solvers.is_empty() { methods::USUAL.as_slice() } else { &[] };
    for name in usual {
        let contender = Contender::named(name, methods::with_reference()).map_err(refused)?;
        chosen.push(Contender { is_named: false, ..contender });
    }
    for solver in &solvers {
        chosen.push(Contender { methods: callable::methods(solver)?, is_named: true });
    }
    let models = models
        .iter()
        .map(|model| model.parse())
        .collect::<Result<Vec<Model>, _>>()
        .map_err(refused)?;
    let problems: Vec<(String, Vec<_>)> = problems
        .into_iter()
        .map(|(name, list)| (name, list.iter().map(|problem| problem.0.clone()).collect()))
        .collect();
    let (options, stop) = (given.options()?, Stop::default());
    let rows = wait(py, &stop, || {
        let limits =
            families::Limits { stop: &stop, each: None, motion: None, search: false, tick: &|| () };
        families::run_on(&problems, Models::Stated(&models), &chosen, &options, &limits)
    })?;
    let table = terminal::table(&view::families_table(&rows));
    let json = serde_json::to_string(&rows).unwrap_or_default();
    Ok((json, table))
}

/// The named solvers: name, description, and the class of matrices.
#[pyfunction]
pub fn solvers() -> Vec<(&'static str, &'static str, String)> {
    let all = Registry::standard().entries();
    all.map(|entry| (&*entry.name, entry.method, entry.class.to_string())).collect()
}
