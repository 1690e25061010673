//! A Python function as a solver.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use lcplab::error::Error;
use lcplab::lcp::Lcp;
use lcplab::lcp::friction::{ConeProblem, Law, Model};
use lcplab::report::methods::{self as library, why_none_takes};
use lcplab::solver::{
    Class, ConeEntry, ConeSolver, Cost, Entry, Event, Group, Iterate, MatrixClass, Method,
    Observer, Options, Settings, Solution, Solver, Start, Status,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyException, PyNotImplementedError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{arrays, refused, waiting};

/// `solver(A, b, lo, hi, **settings)`, which returns x, or yields iterates of which the last one is
/// x, or returns `None` if it found no solution.
#[derive(Clone, Copy)]
struct Callable {
    name: &'static str,
    function: &'static Py<PyAny>,
    /// Whether it has a parameter `model`; it is then also given friction cones.
    takes_models: bool,
}

/// A function with the settings of a solve.
struct Set {
    callable: Callable,
    settings: Settings,
}

/// A function as a solver: for boxes, and for cones if it has a parameter `model`.
#[derive(Clone, Copy)]
struct Function {
    boxed: Entry,
    cone: Option<ConeEntry>,
}

/// Functions as solvers, by their addresses. They are never freed, so addresses are not reused.
static KNOWN: Mutex<Option<HashMap<usize, Function>>> = Mutex::new(None);

/// The methods of a solver by its name, or of a function: for boxes, and for cones if it has a
/// parameter `model`.
pub fn methods(solver: &Bound<'_, PyAny>) -> PyResult<Vec<Method>> {
    if let Ok(name) = solver.extract::<String>() {
        return library::named(&name).map_err(refused);
    }
    Ok(known(solver)?.methods())
}

/// The method of a solver by its name, or of a function, for a friction model, or for LCPs
/// without any.
pub fn method(solver: &Bound<'_, PyAny>, model: Option<Model>) -> PyResult<Method> {
    if let Ok(name) = solver.extract::<String>() {
        let named = match model {
            Some(model) => library::by_name(&name, model),
            None => library::entry(&name).map(Method::Boxed),
        };
        return named.map_err(refused);
    }
    let function = known(solver)?;
    let methods = function.methods();
    if let Some(method) = methods.iter().find(|method| method.takes(model)) {
        return Ok(*method);
    }
    let reason = why_none_takes(&methods, model).unwrap_or_default();
    let reason =
        format!("{reason}; a function that has a parameter named model gets friction cones");
    Err(refused(Error::invalid(format!("solver {}", function.boxed.name), "model", reason)))
}

/// A solver for LCPs by its name, or a function as one.
pub fn entry(solver: &Bound<'_, PyAny>) -> PyResult<Entry> {
    if let Ok(name) = solver.extract::<String>() {
        return library::entry(&name).map_err(refused);
    }
    Ok(known(solver)?.boxed)
}

/// The function, which is stored at its first use.
fn known(solver: &Bound<'_, PyAny>) -> PyResult<Function> {
    if !solver.is_callable() {
        return Err(PyTypeError::new_err("a solver is a name or a function of A, b, lo, hi"));
    }
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_with(HashMap::new);
    let address = solver.as_ptr() as usize;
    Ok(*known.entry(address).or_insert_with(|| Callable::new(solver).into_function()))
}

/// Whether a function has a parameter of this name; `**settings` does not count, because the
/// function may ignore it.
fn has_parameter(function: &Bound<'_, PyAny>, name: &str) -> bool {
    let parameters = || {
        let inspect = function.py().import("inspect")?;
        let signature = inspect.call_method1("signature", (function,))?;
        let parameters = signature.getattr("parameters")?;
        if !parameters.contains(name)? {
            return Ok(false);
        }
        let kind = parameters.get_item(name)?.getattr("kind")?;
        let parameter = inspect.getattr("Parameter")?;
        let takes_keyword =
            [parameter.getattr("POSITIONAL_OR_KEYWORD")?, parameter.getattr("KEYWORD_ONLY")?];
        PyResult::Ok(takes_keyword.iter().any(|other| kind.is(other)))
    };
    // A function in C may have no signature.
    parameters().unwrap_or(false)
}

impl Function {
    fn methods(self) -> Vec<Method> {
        let boxed = std::iter::once(Method::Boxed(self.boxed));
        boxed.chain(self.cone.map(Method::Cone)).collect()
    }
}

impl Callable {
    fn new(function: &Bound<'_, PyAny>) -> Self {
        let name = function.getattr("__name__").and_then(|name| name.extract::<String>());
        let name = name.unwrap_or_else(|_| "my_solver".into());
        Callable {
            name: Box::leak(name.into_boxed_str()),
            function: Box::leak(Box::new(function.clone().unbind())),
            takes_models: has_parameter(function, "model"),
        }
    }

    fn into_function(self) -> Function {
        let cone = self.takes_models.then(|| self.cone_entry());
        Function { boxed: self.entry(), cone }
    }

    fn entry(self) -> Entry {
        let build = move |options: &Options| -> Box<dyn Solver> {
            Box::new(Set { callable: self, settings: options.settings.clone() })
        };
        Entry {
            name: self.name,
            method: "a function in Python",
            class: Class { divides_by_diagonal: true, ..Class::of(MatrixClass::General) },
            group: Group::Plugin,
            cost: Cost::UNKNOWN,
            source: "a function in Python",
            uses: &[],
            build: Box::leak(Box::new(build)),
        }
    }

    fn cone_entry(self) -> ConeEntry {
        let build = move |settings: &Settings| -> Box<dyn ConeSolver> {
            Box::new(Set { callable: self, settings: settings.clone() })
        };
        ConeEntry {
            name: self.name,
            method: "a function in Python",
            class: Class { divides_by_diagonal: true, ..Class::of(MatrixClass::General) },
            laws: &[Law::Associated, Law::Coulomb],
            group: Group::Plugin,
            source: "a function in Python",
            build: Box::leak(Box::new(build)),
        }
    }
}

impl Solver for Set {
    fn name(&self) -> &'static str {
        self.callable.name
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let model = lcp.coupling().map(|_| Model::CoupledBox);
        self.answered(lcp, model, start.point(lcp), start, observer)
    }
}

impl ConeSolver for Set {
    fn name(&self) -> &'static str {
        self.callable.name
    }

    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let model = match problem.law() {
            Law::Associated => Model::AssociatedCone,
            Law::Coulomb => Model::CoulombCone,
        };
        let record = problem.friction().coupled_box();
        self.answered(&record, Some(model), start.point(problem), start, observer)
    }
}

impl Set {
    /// The function's answer as a solution, from the start `first`.
    fn answered(
        &self,
        lcp: &Lcp,
        model: Option<Model>,
        first: Vec<f64>,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution {
        let begun = Iterate { iteration: 0, x: &first, event: Event::Start };
        if waiting::is_interrupted() || observer.observe(&begun).is_break() {
            return Solution::new(lcp, first, Status::Stopped, 0);
        }
        let mut record =
            IterateRecord { lcp, observer, x: first, iterations: 0, is_stopped: false };
        let status = Python::attach(|py| match self.answer(py, lcp, model, start, &mut record) {
            Ok(_) if record.is_stopped => Status::Stopped,
            Ok(true) => Status::Solved,
            Ok(false) => Status::IterationLimit,
            Err(error) if error.is_instance_of::<PyNotImplementedError>(py) => {
                Status::OutsideClass { reason: "the function raises NotImplementedError" }
            }
            Err(error) => Status::NoAnswer { reason: reason(py, &error) },
        });
        // A function returns no status.
        Solution::new(lcp, record.x, status, record.iterations).with_implied_claim(true)
    }
}

/// The iterates that the function returned.
struct IterateRecord<'a> {
    lcp: &'a Lcp,
    observer: &'a mut dyn Observer,
    x: Vec<f64>,
    iterations: usize,
    is_stopped: bool,
}

impl IterateRecord<'_> {
    /// Receives an iterate.
    fn add(&mut self, x: &Bound<'_, PyAny>) -> PyResult<()> {
        let x = numbers(x)?;
        if x.len() != self.lcp.len() {
            let reason =
                format!("x has {} entries, the problem has {} rows", x.len(), self.lcp.len());
            return Err(pyo3::exceptions::PyValueError::new_err(reason));
        }
        if let Some(i) = x.iter().position(|x| !x.is_finite()) {
            let reason = format!("x[{i}] is {}, no finite number", x[i]);
            return Err(pyo3::exceptions::PyValueError::new_err(reason));
        }
        self.x = x;
        self.iterations += 1;
        let iterate = Iterate { iteration: self.iterations, x: &self.x, event: Event::Step };
        self.is_stopped = self.observer.observe(&iterate).is_break();
        Ok(())
    }
}

impl Set {
    /// Calls the function; returns whether it ended with an x, which is false if it yields more
    /// iterates than allowed.
    fn answer(
        &self,
        py: Python<'_>,
        lcp: &Lcp,
        model: Option<Model>,
        start: &Start<'_>,
        record: &mut IterateRecord<'_>,
    ) -> PyResult<bool> {
        let a = arrays::matrix(py, lcp)?;
        let vector = |values: &[f64]| PyArray1::from_slice(py, values);
        let settings = PyDict::new(py);
        settings.set_item("tolerance", self.settings.tolerance)?;
        settings.set_item("max_iterations", self.settings.max_iterations)?;
        if let Some((index, mu)) = arrays::coupling(py, lcp) {
            settings.set_item("friction_index", index)?;
            settings.set_item("mu", mu)?;
        }
        if let Some(model) = model.filter(|_| self.callable.takes_models) {
            settings.set_item("model", model.to_string())?;
        }
        if let Some(x) = start.x {
            settings.set_item("start", vector(x))?;
        }
        let arguments = (a, vector(lcp.b()), vector(lcp.lo()), vector(lcp.hi()));
        let answer = self.callable.function.bind(py).call(arguments, Some(&settings))?;
        if answer.is_none() {
            return Ok(false);
        }
        if !answer.hasattr("__next__")? {
            record.add(&answer)?;
            return Ok(true);
        }
        for x in answer.try_iter()? {
            let x = x?;
            if record.iterations >= self.settings.max_iterations {
                return Ok(false);
            }
            record.add(&x)?;
            if record.is_stopped {
                break;
            }
        }
        Ok(record.iterations > 0)
    }
}

/// A list of real numbers, from any sequence or array.
fn numbers(x: &Bound<'_, PyAny>) -> PyResult<Vec<f64>> {
    if let Ok(array) = x.extract::<PyReadonlyArray1<'_, f64>>() {
        return Ok(array.as_array().to_vec());
    }
    // The numbers of a complex array would lose their imaginary parts one by one.
    let array = x.py().import("numpy")?.call_method1("asarray", (x,))?;
    if array.getattr("dtype")?.getattr("kind")?.extract::<char>()? == 'c' {
        return Err(PyTypeError::new_err("x is complex, must be real"));
    }
    x.extract::<Vec<f64>>()
}

/// An exception as one line. An exception that ends the caller, such as Ctrl-C or `sys.exit`, is
/// stored and raised there.
fn reason(py: Python<'_>, error: &PyErr) -> String {
    if !error.is_instance_of::<PyException>(py) {
        waiting::interrupt(error.clone_ref(py));
    }
    error.to_string()
}
