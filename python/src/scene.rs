//! The simulation of a scene.

use std::borrow::Cow;
use std::rc::Rc;

use lcplab::judge::Demand;
use lcplab::lcp::Question;
use lcplab::lcp::friction::Form;
use lcplab::report::loads::Loads;
use lcplab::scene::{Description, Scene as Described, Scheme};
use lcplab::simulation::{self, Simulation, Solve, Step};
use lcplab::solver::Method;
use numpy::{PyArray1, PyArray2, PyArrayMethods};
use pyo3::exceptions::PyRuntimeError;
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::waiting::quickly;
use crate::{callable, refused};

/// A scene that is simulated.
#[pyclass(unsendable, module = "lcplab._lcplab")]
pub struct Scene {
    simulation: Simulation,
    /// The same scene, for the steps that were taken.
    scene: Rc<Described>,
    last: Option<Rc<Step>>,
}

/// A simulated step. It is judged on request, because a proof may take longer than the step.
#[pyclass(unsendable, module = "lcplab._lcplab")]
pub struct SimulatedStep {
    step: Rc<Step>,
    scene: Rc<Described>,
}

impl SimulatedStep {
    /// The solves; those of a step of sweeps are posed now.
    fn solves(&self) -> PyResult<Cow<'_, [Solve]>> {
        self.step.posed(&self.scene).map_err(|cause| PyRuntimeError::new_err(cause.to_string()))
    }
}

#[pymethods]
impl SimulatedStep {
    #[getter]
    fn number(&self) -> usize {
        self.step.number
    }

    #[getter]
    fn solvers(&self) -> PyResult<Vec<String>> {
        Ok(self.solves()?.iter().map(|solve| solve.solver.clone()).collect())
    }

    #[getter]
    fn statuses(&self) -> PyResult<Vec<String>> {
        Ok(self.solves()?.iter().map(|solve| solve.solution.status.to_string()).collect())
    }

    #[getter]
    fn x<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray1<f64>>>> {
        Ok(self.solves()?.last().map(|last| PyArray1::from_slice(py, &last.solution.x)))
    }

    /// The judge's verdict on each solve, and whether it accepts it.
    fn judged(&self) -> PyResult<Vec<(String, bool)>> {
        let solves = self.solves()?;
        let verdicts = solves.iter().map(|solve| solve.judged(&Demand::default()).verdict);
        Ok(verdicts.map(|verdict| (verdict.to_string(), verdict.is_solution())).collect())
    }
}

impl Scene {
    fn started(scene: Described) -> PyResult<Self> {
        let simulation = Simulation::unjudged(&scene).map_err(refused)?;
        Ok(Scene { simulation, scene: Rc::new(scene), last: None })
    }
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
        let own_method = (scene.step.scheme, scene.solver.name.clone());
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
        // A number of sweeps without a test is the scene's choice for its own method only.
        if own_method != (scene.step.scheme, scene.solver.name.clone()) {
            scene.solver.fixed_sweeps = false;
        }
        Scene::started(scene)
    }

    /// A scene of a description in JSON.
    #[staticmethod]
    fn of(text: &str) -> PyResult<Self> {
        let scene = Described::new("scene", &description(text)?).map_err(refused)?;
        Scene::started(scene)
    }

    /// Takes one step, by this solver if one is named.
    fn step(
        &mut self,
        py: Python<'_>,
        solver: Option<Bound<'_, PyAny>>,
    ) -> PyResult<SimulatedStep> {
        if let Some(solver) = solver {
            let scene = self.simulation.scene();
            let options = simulation::options(scene);
            let model = scene.contact.model;
            let model = Some(model).filter(|model| matches!(model.form(), Form::Cone(_)));
            match callable::method(&solver, model)? {
                Method::Cone(entry) => {
                    self.simulation.solve_cones_by(entry.build(&options.settings));
                }
                Method::Boxed(entry) => self.simulation.solve_by(entry.build(&options)),
            }
        }
        let simulation = &mut self.simulation;
        let step = quickly(py, || simulation.step())?;
        py.check_signals()?;
        let step = step.map_err(|failure| PyRuntimeError::new_err(failure.to_string()))?;
        let step = Rc::new(step);
        self.last = Some(Rc::clone(&step));
        Ok(SimulatedStep { step, scene: Rc::clone(&self.scene) })
    }

    /// The last problem of the last step.
    fn problem(&self) -> Option<Problem> {
        let step = self.last.as_ref()?;
        let solves = step.posed(&self.scene).ok()?;
        Some(Problem(solves.last()?.exported(&self.scene, step.number)))
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

    /// The mean force (N, world) of contacts and joints on each body in the last step.
    fn forces<'py>(&self, py: Python<'py>) -> PyResult<Option<Bound<'py, PyArray2<f64>>>> {
        let forces = self.last.as_ref().and_then(|step| step.forces(self.simulation.scene()));
        let Some(forces) = forces else { return Ok(None) };
        let numbers = forces.iter().flat_map(|force| [force.x, force.y, force.z]);
        PyArray1::from_iter(py, numbers).reshape([forces.len(), 3]).map(Some)
    }

    /// The forces of the last problem of the last step by pair, by body and by contact, as JSON.
    fn loads(&self, py: Python<'_>) -> Option<String> {
        let problem = self.problem()?.0;
        let step = self.last.as_ref()?;
        let x = step.posed(&self.scene).ok()?.last()?.solution.x.clone();
        let question = Question::new(&problem, None, "scene").ok()?;
        let loads = py.detach(|| Loads::of(&question, &x))?;
        Some(loads.json().to_string())
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

    /// The current time (s).
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

/// A shipped scene or a file, with fields set, as JSON with everything written out.
#[pyfunction]
pub fn describe(name: &str, set: Vec<(String, String)>) -> PyResult<String> {
    let whole = Description::load_with(name, &set).and_then(|scene| scene.written_out(name));
    Ok(serde_json::json!(whole.map_err(refused)?).to_string())
}

/// The same of a description in JSON.
#[pyfunction]
pub fn describe_json(text: &str) -> PyResult<String> {
    let whole = description(text)?.written_out("scene").map_err(refused)?;
    Ok(serde_json::json!(whole).to_string())
}

fn description(text: &str) -> PyResult<Description> {
    serde_json::from_str(text).map_err(|error| {
        refused(lcplab::error::Error::invalid("scene", "description", error.to_string()))
    })
}
