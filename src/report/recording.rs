//! One simulation, recorded step by step: what `simulate` prints and writes.

use std::path::Path;

use serde_json::{Value, json};

use super::write;
use crate::body::State;
use crate::certificate::{Demand, judge};
use crate::error::Result;
use crate::lcp::file::number;
use crate::plot::csv;
use crate::scene::Scene;
use crate::simulation::{Failure, Motion, Simulation, Step};
use crate::solver::Status;

/// The record of a simulation so far.
#[derive(Debug, Clone)]
pub struct Record {
    scene: Scene,
    trajectory: String,
    ledger: String,
    first: Motion,
    last: Motion,
    steps: usize,
    problems: usize,
    accepted: usize,
    refuted_claims: usize,
    worst_residual: f64,
    worst_drift: f64,
    worst_penetration: f64,
    failure: Option<String>,
}

impl Record {
    /// An empty record of a simulation at its start.
    pub fn start(scene: &Scene, simulation: &Simulation) -> Self {
        let motion = simulation.motion();
        let mut record = Record {
            scene: scene.clone(),
            trajectory: String::new(),
            ledger: String::new(),
            first: motion.clone(),
            last: motion.clone(),
            steps: 0,
            problems: 0,
            accepted: 0,
            refuted_claims: 0,
            worst_residual: 0.0,
            worst_drift: 0.0,
            worst_penetration: 0.0,
            failure: None,
        };
        csv::record(&mut record.trajectory, TRAJECTORY);
        csv::record(&mut record.ledger, LEDGER);
        record.note(&motion, simulation.states());
        record
    }

    /// Adds a step; every answer in it is judged.
    pub fn add(&mut self, step: &Step) {
        let demand = Demand { tolerance: self.scene.solver.tolerance, prove_up_to: 0 };
        for solve in &step.solves {
            let certificate = judge(&solve.problem.lcp, &solve.solution.x, &demand);
            let holds = certificate.verdict.is_solution();
            self.problems += 1;
            self.accepted += usize::from(holds);
            self.refuted_claims += usize::from(solve.solution.status == Status::Solved && !holds);
            self.worst_residual = self.worst_residual.max(certificate.scaled_residual);
        }
        self.steps = step.number;
        self.note(&step.motion, &step.states);
    }

    /// Notes why the simulation ended early, if it did.
    pub fn end(&mut self, failure: Option<&Failure>) {
        self.failure = failure.map(|failure| format!("{}: {failure}", self.scene.name));
    }

    /// Whether all steps were taken and the judge accepts every answer.
    pub fn is_good(&self) -> bool {
        self.failure.is_none() && self.accepted == self.problems
    }

    /// Writes trajectory.csv, ledger.csv and results.json.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        write::file(&folder.join("trajectory.csv"), &self.trajectory)?;
        write::file(&folder.join("ledger.csv"), &self.ledger)?;
        write::file(&folder.join("results.json"), &format!("{:#}\n", self.summary()))
    }

    /// The totals as JSON.
    pub fn summary(&self) -> Value {
        json!({
            "scene": self.scene.name,
            "formulation": self.scene.step.formulation.name(),
            "solver": self.scene.solver.name,
            "dt": number(self.scene.step.dt),
            "steps": self.steps,
            "time": number(self.last.time),
            "problems": self.problems,
            "accepted": self.accepted,
            "refuted_claims": self.refuted_claims,
            "worst_residual": number(self.worst_residual),
            "energy_start": number(self.first.energy()),
            "energy_end": number(self.last.energy()),
            "drift": number(self.worst_drift),
            "penetration": number(self.worst_penetration),
            "failure": self.failure,
        })
    }

    /// The totals for people.
    pub fn text(&self) -> String {
        let Scene { name, title, .. } = &self.scene;
        let level = self.scene.step.formulation.name();
        let (start, end) = (self.first.energy(), self.last.energy());
        let mut text = format!(
            "{name}: {title}\n\
             level        {level}, solver {}, dt {} s\n\
             steps        {} ({} s)\n\
             problems     {}, accepted by the judge {}\n\
             residual     {:.1e} at worst\n\
             energy       {start:.6} J at the start, {end:.6} J at the end\n\
             drift        {:.2e} m at worst\n\
             penetration  {:.2e} m at worst\n",
            self.scene.solver.name,
            self.scene.step.dt,
            self.steps,
            self.last.time,
            self.problems,
            self.accepted,
            self.worst_residual,
            self.worst_drift,
            self.worst_penetration,
        );
        if let Some(failure) = &self.failure {
            text += &format!("failed       {failure}\n");
        }
        text
    }

    fn note(&mut self, motion: &Motion, states: &[State]) {
        self.worst_drift = self.worst_drift.max(motion.drift);
        self.worst_penetration = self.worst_penetration.max(motion.penetration);
        let [p, l] = [&motion.linear_momentum, &motion.angular_momentum];
        let numbers = [
            motion.time,
            motion.kinetic,
            motion.potential,
            motion.energy(),
            p.x,
            p.y,
            p.z,
            l.x,
            l.y,
            l.z,
            motion.drift,
            motion.angular_drift,
            motion.penetration,
        ];
        let step = [motion.step.to_string()].into_iter();
        csv::record(&mut self.ledger, step.chain(numbers.map(csv::number)));
        for (body, state) in self.scene.bodies.iter().zip(states) {
            let (pose, v, omega) = (&state.pose, &state.v, &state.omega);
            let q = pose.q.quaternion();
            let numbers = [
                motion.time,
                pose.p.x,
                pose.p.y,
                pose.p.z,
                q.w,
                q.i,
                q.j,
                q.k,
                v.x,
                v.y,
                v.z,
                omega.x,
                omega.y,
                omega.z,
            ];
            let names = [motion.step.to_string(), body.name.clone()].into_iter();
            csv::record(&mut self.trajectory, names.chain(numbers.map(csv::number)));
        }
        self.last = motion.clone();
    }
}

const TRAJECTORY: [&str; 16] = [
    "step",
    "body",
    "time (s)",
    "x (m)",
    "y (m)",
    "z (m)",
    "qw",
    "qx",
    "qy",
    "qz",
    "vx (m/s)",
    "vy (m/s)",
    "vz (m/s)",
    "wx (rad/s)",
    "wy (rad/s)",
    "wz (rad/s)",
];

const LEDGER: [&str; 14] = [
    "step",
    "time (s)",
    "kinetic (J)",
    "potential (J)",
    "energy (J)",
    "px (kg m/s)",
    "py (kg m/s)",
    "pz (kg m/s)",
    "Lx (kg m²/s)",
    "Ly (kg m²/s)",
    "Lz (kg m²/s)",
    "drift (m)",
    "angular drift (rad)",
    "penetration (m)",
];
