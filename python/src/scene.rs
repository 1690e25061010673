//! A scene on its way through time.

use lcplab::certificate::Demand;
use lcplab::scene::{Scene as Described, Scheme};
use lcplab::simulation::{self, Simulation, Step};
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::problem::Problem;
use crate::{callable, refused};

/// A scene that is stepped.
#[pyclass(unsendable, module = "lcplab._lcplab")]
pub struct Scene {
    simulation: Simulation,
    last: Option<Step>,
}

#[pymethods]
impl Scene {
    /// A shipped scene or a file, with fields set.
    #[staticmethod]
    fn load(
        name: &str,
        set: Vec<(String, String)>,
        scheme: Option<String>,
        solver: Option<String>,
    ) -> PyResult<Self> {
        let mut scene = Described::load_with(name, &set).map_err(refused)?;
        if let Some(scheme) = scheme {
            scene.step.scheme =
                Scheme::ALL.into_iter().find(|known| known.name() == scheme).ok_or_else(|| {
                    let known = Scheme::ALL.map(Scheme::name).join(", ");
                    refused(lcplab::error::Error::invalid(
                        "options",
                        "scheme",
                        format!("must be one of {known}, is {scheme:?}"),
                    ))
                })?;
        }
        if let Some(solver) = solver {
            scene.solver.name = solver;
        }
        let simulation = Simulation::of(&scene).map_err(refused)?;
        Ok(Scene { simulation, last: None })
    }

    /// Takes one step, by this solver if one is named; what was solved.
    fn step<'py>(
        &mut self,
        py: Python<'py>,
        solver: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyDict>> {
        if let Some(solver) = solver {
            let entry = callable::entry(&solver)?;
            let options = simulation::options(self.simulation.scene());
            self.simulation.solve_by((entry.build)(&options));
        }
        let simulation = &mut self.simulation;
        let step = py.detach(|| simulation.step());
        py.check_signals()?;
        let step = step.map_err(|failure| PyRuntimeError::new_err(failure.to_string()))?;
        let told = told(py, &step)?;
        self.last = Some(step);
        Ok(told)
    }

    /// The last problem of the last step.
    fn problem(&self) -> Option<Problem> {
        let step = self.last.as_ref()?;
        let solve = step.solves.last()?;
        Some(Problem(solve.exported(self.simulation.scene(), step.number)))
    }

    /// Position (m) and unit quaternion (w, x, y, z) of each body.
    #[getter]
    fn poses<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let states = self.simulation.states();
        let pose = |state: &lcplab::body::State| {
            let (p, q) = (state.pose.p, state.pose.q.quaternion());
            [p.x, p.y, p.z, q.w, q.i, q.j, q.k]
        };
        PyArray1::from_iter(py, states.iter().flat_map(pose)).reshape([states.len(), 7])
    }

    /// Velocity (m/s) and angular velocity (rad/s) of each body, in world axes.
    #[getter]
    fn velocities<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let states = self.simulation.states();
        let velocity = |state: &lcplab::body::State| {
            let (v, w) = (state.v, state.omega);
            [v.x, v.y, v.z, w.x, w.y, w.z]
        };
        PyArray1::from_iter(py, states.iter().flat_map(velocity)).reshape([states.len(), 6])
    }

    /// The names of the bodies.
    #[getter]
    fn bodies(&self) -> Vec<String> {
        self.simulation.scene().bodies.iter().map(|body| body.name.clone()).collect()
    }

    #[getter]
    fn name(&self) -> String {
        self.simulation.scene().name.clone()
    }

    #[getter]
    fn title(&self) -> String {
        self.simulation.scene().title.clone()
    }

    /// The time now (s).
    #[getter]
    fn time(&self) -> f64 {
        self.simulation.time()
    }

    /// Kinetic and potential energy (J).
    #[getter]
    fn energy(&self) -> f64 {
        self.simulation.motion().energy()
    }

    /// The largest overlap of two bodies (m).
    #[getter]
    fn penetration(&self) -> f64 {
        self.simulation.motion().penetration
    }

    /// max |c| over the joints' rows (m).
    #[getter]
    fn drift(&self) -> f64 {
        self.simulation.motion().drift
    }
}

/// How the problems of a step were solved.
fn told<'py>(py: Python<'py>, step: &Step) -> PyResult<Bound<'py, PyDict>> {
    let told = PyDict::new(py);
    let judged: Vec<_> = step.solves.iter().map(|solve| solve.judged(&Demand::default())).collect();
    told.set_item("number", step.number)?;
    told.set_item("solvers", step.solves.iter().map(|solve| solve.solver).collect::<Vec<_>>())?;
    let statuses = step.solves.iter().map(|solve| solve.solution.status.to_string());
    told.set_item("statuses", statuses.collect::<Vec<_>>())?;
    let verdicts = judged.iter().map(|certificate| certificate.verdict.to_string());
    told.set_item("verdicts", verdicts.collect::<Vec<_>>())?;
    told.set_item(
        "is_accepted",
        judged.iter().all(|certificate| certificate.verdict.is_solution()),
    )?;
    if let Some(last) = step.solves.last() {
        told.set_item("x", PyArray1::from_slice(py, &last.solution.x))?;
    }
    Ok(told)
}
