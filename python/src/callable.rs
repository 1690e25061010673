//! A function of Python's as a solver.

use std::collections::HashMap;
use std::sync::{Mutex, PoisonError};

use lcplab::lcp::Lcp;
use lcplab::solver::{
    Class, Cost, Entry, Event, Group, Iterate, MatrixClass, Observer, Options, Settings, Solution,
    Solver, Start, Status,
};
use numpy::{PyArray1, PyReadonlyArray1};
use pyo3::exceptions::{PyException, PyTypeError};
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::{arrays, refused, waiting};

/// `solver(A, b, lo, hi, **settings)`, which returns x, or yields iterates of which the last one is x, or returns
/// `None` where it found nothing.
struct Callable {
    name: &'static str,
    function: Py<PyAny>,
    settings: Settings,
}

/// Functions as solvers, by their addresses.
type Known = HashMap<usize, (Py<PyAny>, Entry)>;

/// Those that were used. They are kept, and so is their place.
static KNOWN: Mutex<Option<Known>> = Mutex::new(None);

/// A solver by its name, or a function as one.
pub fn entry(solver: &Bound<'_, PyAny>) -> PyResult<Entry> {
    if let Ok(name) = solver.extract::<String>() {
        return lcplab::report::methods::entry(&name).map_err(refused);
    }
    if !solver.is_callable() {
        return Err(PyTypeError::new_err("a solver is a name or a function of A, b, lo, hi"));
    }
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let known = known.get_or_insert_with(HashMap::new);
    if let Some((_, entry)) = known.get(&(solver.as_ptr() as usize)) {
        return Ok(*entry);
    }
    let made = made(solver)?;
    known.insert(solver.as_ptr() as usize, (solver.clone().unbind(), made));
    Ok(made)
}

fn made(function: &Bound<'_, PyAny>) -> PyResult<Entry> {
    let name = function.getattr("__name__").and_then(|name| name.extract::<String>());
    let name: &'static str =
        Box::leak(name.unwrap_or_else(|_| "my_solver".into()).into_boxed_str());
    let function = function.clone().unbind();
    let build = move |options: &Options| -> Box<dyn Solver> {
        let function = Python::attach(|py| function.clone_ref(py));
        Box::new(Callable { name, function, settings: options.settings.clone() })
    };
    Ok(Entry {
        name,
        method: "a function in Python",
        class: Class { divides_by_diagonal: true, ..Class::of(MatrixClass::General) },
        group: Group::Plugin,
        cost: Cost::UNKNOWN,
        source: "a function in Python",
        uses: &[],
        build: Box::leak(Box::new(build)),
    })
}

impl Solver for Callable {
    fn name(&self) -> &'static str {
        self.name
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let first = start.point(lcp);
        let begun = Iterate { iteration: 0, x: &first, event: Event::Start };
        if waiting::is_interrupted() || observer.observe(&begun).is_break() {
            return Solution::new(lcp, first, Status::Stopped, 0);
        }
        let mut told = Told { lcp, observer, x: first, iterations: 0, is_stopped: false };
        let outcome = Python::attach(|py| match self.answer(py, lcp, start, &mut told) {
            Ok(found) => Ok(found),
            Err(error) => Err(reason(py, &error)),
        });
        let status = match outcome {
            Err(reason) => Status::NoAnswer { reason },
            Ok(_) if told.is_stopped => Status::Stopped,
            Ok(true) => Status::Solved,
            Ok(false) => Status::IterationLimit,
        };
        Solution::new(lcp, told.x, status, told.iterations)
    }
}

/// What was told of the way to x.
struct Told<'a> {
    lcp: &'a Lcp,
    observer: &'a mut dyn Observer,
    x: Vec<f64>,
    iterations: usize,
    is_stopped: bool,
}

impl Told<'_> {
    /// Hears an iterate.
    fn hear(&mut self, x: &Bound<'_, PyAny>) -> PyResult<()> {
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

impl Callable {
    /// Asks the function; whether it found something.
    fn answer(
        &self,
        py: Python<'_>,
        lcp: &Lcp,
        start: &Start<'_>,
        told: &mut Told<'_>,
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
        if let Some(x) = start.x {
            settings.set_item("start", vector(x))?;
        }
        let arguments = (a, vector(lcp.b()), vector(lcp.lo()), vector(lcp.hi()));
        let answer = self.function.bind(py).call(arguments, Some(&settings))?;
        if answer.is_none() {
            return Ok(false);
        }
        if !answer.hasattr("__next__")? {
            told.hear(&answer)?;
            return Ok(true);
        }
        for x in answer.try_iter()? {
            told.hear(&x?)?;
            if told.is_stopped || told.iterations >= self.settings.max_iterations {
                break;
            }
        }
        Ok(told.iterations > 0)
    }
}

/// A list of real numbers, whatever holds it.
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

/// An exception in a line. One that is no error of the function but ends what called it, as Ctrl-C
/// and `sys.exit` do, is kept for who waits.
fn reason(py: Python<'_>, error: &PyErr) -> String {
    if !error.is_instance_of::<PyException>(py) {
        waiting::interrupt(error.clone_ref(py));
    }
    error.to_string()
}
