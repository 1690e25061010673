//! Records a simulation step by step: the output of `simulate`.

mod energy_totals;
mod refused;
mod tables;
mod text;

use std::path::Path;

use nalgebra::Vector3;
use serde_json::{Value, json};

use energy_totals::EnergyTotals;
use refused::{Refused, proof};
use tables::Tables;

use crate::body::{Body, State};
use crate::error::Result;
use crate::file;
use crate::lcp::file::number;
use crate::memory::Memory;
use crate::report::study::tally::Tally;
use crate::scene::Scene;
use crate::simulation::{
    Cause, Failure, Impact, Impacts, LawErrors, LostBounces, Motion, Simulation, Slips, Step,
    Warnings, carried,
};

/// The text instead of the work if the forces were not recorded.
const NOT_ACCOUNTED: &str = "not accounted";

/// The record of a simulation so far.
#[derive(Debug, Clone)]
pub struct Record {
    scene: Scene,
    /// `None` if only totals are kept.
    tables: Option<Tables>,
    /// Every `every`-th step is written to the tables.
    every: usize,
    first: Motion,
    last: Motion,
    /// The current states.
    states: Vec<State>,
    steps: usize,
    tally: Tally,
    /// The solvers that gave the answers, in the order of their first answer.
    solvers: Vec<String>,
    worst_drift: f64,
    /// The largest angle (rad) by which a joint was misaligned.
    worst_angular_drift: f64,
    worst_penetration: f64,
    /// The largest kinetic energy (J).
    most_kinetic: f64,
    /// The least and the largest change of the energy since the start (J).
    energy_changes: [f64; 2],
    /// Whether bodies touched.
    touched: bool,
    /// The step with the smallest supported fraction of the weight, and that fraction.
    least_carried: Option<(usize, f64)>,
    laws: LawErrors,
    slips: Slips,
    impacts: Impacts,
    lost_bounces: LostBounces,
    /// The impact that missed the law of restitution by most.
    worst_impact: Option<Impact>,
    energy_totals: Option<EnergyTotals>,
    conflict: Vec<String>,
    /// Problems of the motion although every LCP was solved.
    warnings: Warnings,
    /// The first answer that the judge rejected.
    refused: Option<Refused>,
    failure: Option<String>,
    /// Whether it ended because a body diverged.
    has_diverged: bool,
    /// The proof that the failed step had no solution.
    proof: Option<Value>,
}

impl Record {
    /// An empty record at the start of a simulation, for totals only.
    pub fn start(scene: &Scene, simulation: &Simulation) -> Self {
        let motion = simulation.motion();
        let mut record = Record {
            scene: scene.clone(),
            tables: None,
            every: 1,
            first: motion.clone(),
            last: motion.clone(),
            states: simulation.states().to_vec(),
            steps: 0,
            tally: Tally::default(),
            solvers: Vec::new(),
            worst_drift: 0.0,
            worst_angular_drift: 0.0,
            worst_penetration: 0.0,
            most_kinetic: 0.0,
            energy_changes: [0.0; 2],
            touched: false,
            least_carried: None,
            laws: LawErrors::default(),
            slips: Slips::default(),
            impacts: Impacts::default(),
            lost_bounces: LostBounces::default(),
            worst_impact: None,
            energy_totals: Some(EnergyTotals::default()),
            conflict: Vec::new(),
            warnings: Warnings::default(),
            refused: None,
            failure: None,
            has_diverged: false,
            proof: None,
        };
        record.note(&motion);
        record
    }

    /// The same with tables of every pose, motion and force of each `every`th step; they grow with
    /// every step.
    pub fn with_tables(mut self, simulation: &Simulation, every: usize) -> Self {
        self.every = every;
        let mut tables = Tables::new();
        tables.start(&self.scene, &simulation.motion(), simulation.states());
        self.tables = Some(tables);
        self
    }

    /// The current memory of the tables.
    pub(crate) fn memory(&self) -> Memory {
        self.tables.as_ref().map_or(Memory::bytes(0), Tables::memory)
    }

    /// Adds a step and judges every answer in it.
    pub fn add(&mut self, step: &Step) {
        let Record { scene, tally, solvers, refused, conflict, .. } = self;
        tally.add_step(step, scene.solver.tolerance, |solve, certificate| {
            let holds = certificate.verdict.is_solution();
            if !solvers.contains(&solve.solver) {
                solvers.push(solve.solver.clone());
            }
            if !holds && refused.is_none() {
                *refused = Some(Refused::of(scene, step.number, solve, certificate));
            }
            if !holds && conflict.is_empty() {
                *conflict = solve.conflict(scene);
            }
        });
        self.warnings.add(&self.scene, step);
        if let Some(part) = carried(&self.scene, &self.last, &step.motion)
            && self.least_carried.is_none_or(|(_, least)| part < least)
        {
            self.least_carried = Some((step.number, part));
        }
        self.steps = step.number;
        self.states.clone_from(&step.states);
        if let Some(tables) =
            self.tables.as_mut().filter(|_| step.number.is_multiple_of(self.every))
        {
            tables.add(&self.scene, step);
        }
        self.touched |= !step.contacts.is_empty();
        self.laws = self.laws.worse(step.laws);
        self.slips.add(step);
        let ended = self.impacts.add(&self.scene, step);
        self.lost_bounces.add(&self.scene, step);
        self.worst_impact = worse_of(self.worst_impact.into_iter().chain(ended));
        self.energy_totals = self
            .energy_totals
            .zip(step.ledger)
            .map(|(energy_totals, ledger)| energy_totals.with(&ledger));
        self.note(&step.motion);
    }

    /// The impact, ended or not, that missed the coefficient of restitution by most.
    fn worst_impact(&self) -> Option<Impact> {
        worse_of(self.worst_impact.into_iter().chain(self.impacts.unfinished()))
    }

    /// Records why the simulation ended early.
    pub(crate) fn end(&mut self, failure: &Failure) {
        self.cut(&failure.to_string());
        self.proof = proof(&failure.cause);
        self.has_diverged = matches!(failure.cause, Cause::Diverged { .. });
    }

    /// Records that recording ended early for another reason.
    pub(crate) fn cut(&mut self, reason: &str) {
        self.failure = Some(format!("{}: {reason}", self.scene.name));
    }

    /// The number of steps so far.
    pub(crate) fn steps(&self) -> usize {
        self.steps
    }

    /// Whether all steps were taken and the judge accepts every answer.
    pub fn is_good(&self) -> bool {
        self.failure.is_none() && self.tally.rejected() == 0
    }

    /// Writes results.json, and trajectory.csv, ledger.csv and forces.csv if there are tables.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        if let Some(Tables { trajectory, ledger, forces }) = &self.tables {
            file::write_in(folder, "trajectory.csv", trajectory)?;
            file::write_in(folder, "ledger.csv", ledger)?;
            file::write_in(folder, "forces.csv", forces)?;
        }
        file::write_in(folder, "results.json", format!("{:#}\n", self.summary()))
    }

    /// The totals as JSON.
    pub fn summary(&self) -> Value {
        let measured = |value: f64| (!self.scene.solver.fixed_sweeps).then(|| number(value));
        json!({
            "scene": self.scene.name,
            "scheme": self.scene.step.scheme.name(),
            "solver": self.solver(),
            "model": self.scene.contact.model.to_string(),
            "dt": number(self.scene.step.dt),
            "steps": self.steps,
            "time": number(self.last.time),
            "problems": self.tally.solves,
            "accepted": self.tally.accepted,
            "rejected_claims": self.tally.rejected_claims,
            "worst_residual": (self.tally.solves > 0).then(|| number(self.tally.worst_residual)),
            "energy_start": number(self.first.energy()),
            "energy_end": number(self.last.energy()),
            "drift": number(self.worst_drift),
            "angular_drift": number(self.worst_angular_drift),
            "penetration": number(self.worst_penetration),
            "carried": self.carried().map(|[mean, least]| json!({ "mean": number(mean), "least": number(least) })),
            "work": self.accounted(|energy_totals| energy_totals.by_account()),
            "remainder": self.accounted(|energy_totals| number(energy_totals.remainder)),
            "laws": {
                "attraction": measured(self.laws.attraction),
                "cone_excess": number(self.laws.cone_excess),
                "friction_angle":
                    self.slips.friction_angle.and_then(|slip| slip.angle).map(number),
                "friction_speed_error":
                    self.slips.speed_error(&self.scene).map(|(_, error)| number(error)),
                "friction_creep":
                    self.slips.notable_creep(&self.scene).map(|creep| number(creep.path.norm())),
                "restitution_error": self.worst_impact().map(|impact| number(impact.error())),
                "friction_gain": self.accounted(|_| number(self.laws.friction_gain)),
                "internal_impulse": measured(self.laws.internal_impulse),
                "internal_torque": measured(self.laws.internal_torque),
            },
            "conflict": self.conflict,
            "first_passage": self.first_passage(),
            "first_refused": self.refused.as_ref().map(Refused::to_json),
            "notes": self.notes(),
            "warnings": self.warnings.to_json(),
            "states": self.states_json(),
            "failure": self.failure,
            "certificate": self.proof,
        })
    }

    /// The first step in which a body passed through another one, and both names.
    fn first_passage(&self) -> Option<Value> {
        let passage = self.warnings.as_slice().iter().find(|own| own.word == "passed_through")?;
        Some(json!({ "step": passage.step, "bodies": passage.bodies }))
    }

    /// The solver of the answers, or of a step with a problem if there was none; `None` if the
    /// scheme has no LCP.
    fn solver(&self) -> Option<String> {
        let asked = match self.solvers.as_slice() {
            [] => self.scene.solver.name.clone(),
            [only] => only.to_string(),
            [first, others @ ..] => format!("{first}; in some steps {}", others.join(", ")),
        };
        self.scene.step.scheme.solves_lcps().then_some(asked)
    }

    /// The fraction of the weight that contacts, joints and springs support, on average and at
    /// least.
    fn carried(&self) -> Option<[f64; 2]> {
        Some([carried(&self.scene, &self.first, &self.last)?, self.least_carried?.1])
    }

    /// A value from the energy balance, or the text that there is none.
    fn accounted(&self, says: impl Fn(&EnergyTotals) -> Value) -> Value {
        self.energy_totals.as_ref().map_or(Value::from(NOT_ACCOUNTED), says)
    }

    /// The current positions and velocities of the bodies.
    fn states_json(&self) -> Value {
        let vector = |v: &Vector3<f64>| [v.x, v.y, v.z].map(number);
        let state = |(body, state): (&Body, &State)| {
            let q = state.pose.q.quaternion();
            let rotation = [q.w, q.i, q.j, q.k].map(number);
            json!({
                "body": body.name,
                "position": vector(&state.pose.p),
                "rotation": rotation,
                "velocity": vector(&state.v),
                "angular_velocity": vector(&state.omega),
            })
        };
        self.scene.bodies.iter().zip(&self.states).map(state).collect()
    }

    fn note(&mut self, motion: &Motion) {
        self.worst_drift = self.worst_drift.max(motion.drift);
        self.worst_angular_drift = self.worst_angular_drift.max(motion.angular_drift);
        self.worst_penetration = self.worst_penetration.max(motion.penetration);
        self.most_kinetic = self.most_kinetic.max(motion.kinetic);
        let change = motion.energy() - self.first.energy();
        self.energy_changes =
            [self.energy_changes[0].min(change), self.energy_changes[1].max(change)];
        self.last = motion.clone();
    }
}

/// The one with the largest error.
fn worse_of(impacts: impl Iterator<Item = Impact>) -> Option<Impact> {
    impacts.max_by(|a, b| a.error().abs().total_cmp(&b.error().abs()))
}
