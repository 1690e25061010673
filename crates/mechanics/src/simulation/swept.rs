//! Steps of a fixed number of sweeps: the [`Stepper`] takes them without forming a matrix, and
//! their problems are posed only for a reader who asks for them.

use std::borrow::Cow;

use super::stepper::{Kernel, Stepper};
use super::{Cause, Failure, ImpactEnergy, LawErrors, Simulation, Solve, Step, measured, solver};
use crate::assembly::{Assembly, ConstraintFilter};
use crate::body::{Mass, State};
use crate::formulation::Problem;
use crate::scene::{DetectedContact, Scene};
use lcplab_lcp::error;
use lcplab_solver::{Pgs, Solution, Status};

/// With more moving bodies than these, pairs that share no body are swept eight at a time.
const FEW_BODIES: usize = 32;

/// What a step of sweeps started from, and its impulses.
#[derive(Debug, Clone)]
pub struct Swept {
    before: Vec<State>,
    sweeps: usize,
    /// Of the first solve, and of the one with bounces if something bounced: the x (N s, N m s)
    /// that it started from, and its answer.
    solves: Vec<[Vec<f64>; 2]>,
}

impl Simulation {
    /// The scene at its start, stepped as it states: with `solver.fixed_sweeps` by a [`Stepper`],
    /// whose steps have no solves and no ledger; otherwise as [`of`](Simulation::of).
    ///
    /// ```
    /// use lcplab_mechanics::{scene::Scene, simulation::Simulation};
    ///
    /// let mut tower = Simulation::unjudged(&Scene::load("tower")?)?;
    /// let step = tower.step().expect("a step that can be taken");
    /// assert!(step.solves.is_empty() && step.contacts.len() > 4000);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If there is no solver of that name, or if the stepper cannot step the scene.
    pub fn unjudged(scene: &Scene) -> error::Result<Self> {
        if !scene.solver.fixed_sweeps {
            return Simulation::of(scene);
        }
        let moving = scene.bodies.iter().filter(|body| body.mass != Mass::Fixed).count();
        let kernel = match moving {
            0..=FEW_BODIES => Kernel::RowByRow,
            _ => Kernel::SimdPairs { threads: 1 },
        };
        let stepper =
            Some(Box::new(Stepper::new(scene.clone(), scene.solver.max_iterations, kernel)?));
        Ok(Simulation { stepper, ..Simulation::new(scene.clone(), solver(scene)?) })
    }

    /// Takes a step of sweeps. The contacts of the next one tell which bodies overlap after it.
    pub(super) fn swept_step(&mut self, stepper: &mut Stepper) -> Result<Step, Failure> {
        stepper.step()?;
        let solves = stepper.solves().into_iter().filter(|[_, x]| !x.is_empty());
        let solves = solves.map(|solve| solve.map(<[f64]>::to_vec)).collect();
        let contacts = stepper.take_found();
        let cone_excess = stepper.cone_excess();
        stepper.find_contacts(&mut |_| ());
        let (number, scene, states) = (self.steps + 1, &self.scene, stepper.states());
        let passages = self.detector.passages(scene, &self.states, states);
        let (interpenetrations, motion) =
            measured(&mut self.overlaps, scene, states, number, &passages, stepper.found());
        let before = std::mem::replace(&mut self.states, states.to_vec());
        self.steps = number;
        let swept = Swept { before, sweeps: scene.solver.max_iterations, solves };
        let impact_energy = swept.impact_energy(scene, &contacts);
        Ok(Step {
            number,
            solves: Vec::new(),
            contacts,
            interpenetrations,
            impact_energy,
            states: self.states.clone(),
            motion,
            events: None,
            pushed: Vec::new(),
            ledger: None,
            laws: LawErrors { cone_excess, ..LawErrors::default() },
            slips: Vec::new(),
            touches: Vec::new(),
            unlocated: Vec::new(),
            joint_work: None,
            swept: Some(swept),
        })
    }
}

impl Step {
    /// The LCPs of the step and their answers; those of a step of sweeps are posed here.
    ///
    /// # Errors
    /// If a problem cannot be posed.
    pub fn posed(&self, scene: &Scene) -> Result<Cow<'_, [Solve]>, Cause> {
        match &self.swept {
            None => Ok(Cow::Borrowed(&self.solves)),
            Some(swept) => swept.posed(scene, &self.contacts).map(Cow::Owned),
        }
    }
}

impl Swept {
    /// The energies to report of a step with bounces. Without bounces nothing is posed: that would
    /// cost as much as many steps.
    fn impact_energy(&self, scene: &Scene, contacts: &[DetectedContact]) -> Vec<ImpactEnergy> {
        if self.solves.len() < 2 {
            return Vec::new();
        }
        let posed = self.posed(scene, contacts).unwrap_or_default();
        ImpactEnergy::of(scene, &self.before, &posed, None)
    }

    fn posed(&self, scene: &Scene, contacts: &[DetectedContact]) -> Result<Vec<Solve>, Cause> {
        let assembly = Assembly::new(scene, &self.before, contacts, ConstraintFilter::Near)
            .map_err(Cause::Undefined)?;
        let mut problem = Problem::velocity(scene, assembly)?;
        let mut solves: Vec<Solve> = Vec::new();
        for [start, x] in &self.solves {
            if let Some(first) = solves.last_mut() {
                first.impulse_factor = 0.0;
                let Some(bounced) = problem.restitution(scene, &first.solution.x)? else { break };
                problem = bounced;
            }
            let solution =
                Solution::new(&problem.lcp, x.clone(), Status::IterationLimit, self.sweeps);
            solves.push(Solve {
                problem: problem.clone(),
                posing: None,
                start: start.clone(),
                solver: Pgs::NAME.into(),
                solution,
                impulse_factor: 1.0,
            });
        }
        Ok(solves)
    }
}
