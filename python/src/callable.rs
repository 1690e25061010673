//! A Python function as a solver.

use std::sync::Arc;

use lcplab::error::Error;
use lcplab::lcp::Lcp;
use lcplab::lcp::friction::{ConeProblem, Law, Model};
use lcplab::report::methods::with_reference;
use lcplab::report::study::families::Contender;
use lcplab::solver::{
    ConeEntry, ConeSolver, Entry, Event, Iterate, Method, Observer, Settings, Solution, Solver,
    Start, Status, why_none_takes,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyException, PyNotImplementedError, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{arrays, refused, waiting};

/// `solver(A, b, lo, hi, **settings)`, which returns x, or yields iterates of which the last one is
/// x, or returns `None` if it found no solution.
#[derive(Clone)]
struct Callable {
    name: String,
    function: Arc<Py<PyAny>>,
    /// Whether it has a parameter `model`; it is then also given friction cones.
    takes_models: bool,
}

/// A function with the settings of a solve.
struct Set {
    callable: Callable,
    settings: Settings,
}

/// The methods of a solver by its name, or of a function: for boxes, and for cones if it has a
/// parameter `model`.
pub fn methods(solver: &Bound<'_, PyAny>) -> PyResult<Vec<Method>> {
    if let Ok(name) = solver.extract::<String>() {
        let named = Contender::named(&name, with_reference()).map_err(refused)?;
        return Ok(named.methods);
    }
    if !solver.is_callable() {
        return Err(PyTypeError::new_err("a solver is a name or a function of A, b, lo, hi"));
    }
    Ok(Callable::new(solver).methods())
}

/// The method of a solver by its name, or of a function, for a friction model, or for LCPs
/// without any.
pub fn method(solver: &Bound<'_, PyAny>, model: Option<Model>) -> PyResult<Method> {
    if let Ok(name) = solver.extract::<String>() {
        return with_reference().method(&name, model).cloned().map_err(refused);
    }
    let methods = methods(solver)?;
    let reason = why_none_takes(&methods, model).unwrap_or_default();
    let name = methods.first().map_or(String::new(), |method| method.name().to_string());
    methods.into_iter().find(|method| method.takes(model)).ok_or_else(|| {
        let reason =
            format!("{reason}; a function that has a parameter named model gets friction cones");
        refused(Error::invalid(format!("solver {name}"), "model", reason))
    })
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

impl Callable {
    fn new(function: &Bound<'_, PyAny>) -> Self {
        let name = function.getattr("__name__").and_then(|name| name.extract::<String>());
        Callable {
            name: name.unwrap_or_else(|_| "my_solver".into()),
            function: Arc::new(function.clone().unbind()),
            takes_models: has_parameter(function, "model"),
        }
    }

    fn methods(self) -> Vec<Method> {
        let cone = self.takes_models.then(|| Method::Cone(self.cone_entry()));
        [Method::Boxed(self.entry())].into_iter().chain(cone).collect()
    }

    fn entry(&self) -> Entry {
        let callable = self.clone();
        let mut entry = Entry::new(self.name.clone(), move |options| {
            Box::new(Set { callable: callable.clone(), settings: options.settings.clone() })
        });
        (entry.method, entry.source) = (KIND, KIND);
        entry.class.divides_by_diagonal = true;
        entry
    }

    fn cone_entry(&self) -> ConeEntry {
        let callable = self.clone();
        let laws = [Law::Associated, Law::Coulomb].to_vec();
        let mut entry = ConeEntry::new(self.name.clone(), laws, move |settings| {
            Box::new(Set { callable: callable.clone(), settings: settings.clone() })
        });
        (entry.method, entry.source) = (KIND, KIND);
        entry.class.divides_by_diagonal = true;
        entry
    }
}

/// What it is in a list of methods.
const KIND: &str = "a function in Python";

impl Solver for Set {
    fn name(&self) -> &str {
        &self.callable.name
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let model = lcp.coupling().map(|_| Model::CoupledBox);
        self.answered(lcp, model, start.point(lcp), start, observer)
    }
}

impl ConeSolver for Set {
    fn name(&self) -> &str {
        &self.callable.name
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
                format!("x has length {}, the problem has {} rows", x.len(), self.lcp.len());
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
    let kind = array.getattr("dtype")?.getattr("kind")?.extract::<char>()?;
    if kind == 'c' {
        return Err(PyTypeError::new_err("x is complex, must be real"));
    }
    let shape = array.getattr("shape")?.extract::<Vec<usize>>()?;
    if shape.len() != 1 && matches!(kind, 'f' | 'i' | 'u') {
        let own = array.getattr("shape")?.str()?;
        let reason = format!("x has the shape {own}, must be one-dimensional");
        return Err(pyo3::exceptions::PyValueError::new_err(reason));
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
