//! One simulation, recorded step by step: what `simulate` prints and writes.

mod tables;

use std::fmt;
use std::path::Path;

use nalgebra::Vector3;
use serde_json::{Value, json};

use tables::Tables;

use crate::body::{Body, State};
use crate::certificate::{Demand, FrictionCertificate};
use crate::error::Result;
use crate::file;
use crate::lcp::file::number;
use crate::memory::Memory;
use crate::number::readable;
use crate::scene::{Resting, Scene, Scheme};
use crate::simulation::{Cause, Failure, Laws, Ledger, Motion, Simulation, Solve, Step, carried};
use crate::solver::Status;

/// Bodies whose end is printed.
const SHOWN: usize = 12;
/// Friction that is so many percent too strong is worth a word.
const MUCH: f64 = 1.0;
/// A drift or an overlap beyond this part of the scene's size is worth a word.
const DRIFT: f64 = 1e-3;
/// What stands in place of the work where nobody wrote down what acted.
const NOT_ACCOUNTED: &str = "not accounted";

/// The record of a simulation so far.
#[derive(Debug, Clone)]
pub struct Record {
    scene: Scene,
    /// None where only totals are kept.
    tables: Option<Tables>,
    /// Of so many steps one stands in the tables.
    every: usize,
    first: Motion,
    last: Motion,
    /// The states now.
    states: Vec<State>,
    steps: usize,
    problems: usize,
    accepted: usize,
    refuted_claims: usize,
    /// Who gave the answers, in the order of their first.
    solvers: Vec<&'static str>,
    worst_residual: f64,
    worst_drift: f64,
    worst_penetration: f64,
    /// The step in which the least part of the weight was carried, and that part.
    least_carried: Option<(usize, f64)>,
    laws: Laws,
    books: Option<Books>,
    conflict: Vec<String>,
    /// The first step in which a body went through another one, and both names.
    passed: Option<(usize, [String; 2])>,
    /// The first answer that the judge did not accept.
    refused: Option<Refused>,
    failure: Option<String>,
    /// The proof that the failed step had no solution.
    proof: Option<Value>,
}

impl Record {
    /// An empty record of a simulation at its start, of totals alone.
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
            problems: 0,
            accepted: 0,
            refuted_claims: 0,
            solvers: Vec::new(),
            worst_residual: 0.0,
            worst_drift: 0.0,
            worst_penetration: 0.0,
            least_carried: None,
            laws: Laws::default(),
            books: Some(Books::default()),
            conflict: Vec::new(),
            passed: None,
            refused: None,
            failure: None,
            proof: None,
        };
        record.note(&motion);
        record
    }

    /// The same with a table of every pose, motion and force of each `every`th step; they grow from step
    /// to step.
    pub fn with_tables(mut self, simulation: &Simulation, every: usize) -> Self {
        self.every = every;
        let mut tables = Tables::new();
        tables.start(&self.scene, &simulation.motion(), simulation.states());
        self.tables = Some(tables);
        self
    }

    /// What the tables take so far.
    pub fn memory(&self) -> Memory {
        self.tables.as_ref().map_or(Memory::bytes(0), Tables::memory)
    }

    /// Adds a step; every answer in it is judged.
    pub fn add(&mut self, step: &Step) {
        let demand = Demand { tolerance: self.scene.solver.tolerance, prove_up_to: 0 };
        for solve in &step.solves {
            let certificate = solve.judged(&demand);
            let holds = certificate.verdict.is_solution();
            self.problems += 1;
            self.accepted += usize::from(holds);
            self.refuted_claims += usize::from(solve.solution.status == Status::Solved && !holds);
            self.worst_residual = self.worst_residual.max(certificate.scaled_residual);
            if !self.solvers.contains(&solve.solver) {
                self.solvers.push(solve.solver);
            }
            if !holds && self.refused.is_none() {
                self.refused = Some(Refused::of(&self.scene, step.number, solve, &certificate));
            }
            if !holds && self.conflict.is_empty() {
                self.conflict = solve.conflict(&self.scene);
            }
        }
        if let (None, Some(pair)) = (&self.passed, step.passed.first()) {
            self.passed =
                Some((step.number, pair.map(|body| self.scene.bodies[body].name.clone())));
        }
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
        self.laws = self.laws.worse(step.laws);
        self.books = self.books.zip(step.ledger).map(|(books, ledger)| books.with(&ledger));
        self.note(&step.motion);
    }

    /// Notes why the simulation ended early.
    pub fn end(&mut self, failure: &Failure) {
        self.cut(&failure.to_string());
        self.proof = proof(&failure.cause);
    }

    /// Notes that recording ended early for a reason of its own.
    pub fn cut(&mut self, reason: &str) {
        self.failure = Some(format!("{}: {reason}", self.scene.name));
    }

    /// The steps so far.
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Whether all steps were taken and the judge accepts every answer.
    pub fn is_good(&self) -> bool {
        self.failure.is_none() && self.accepted == self.problems
    }

    /// Writes results.json, and trajectory.csv, ledger.csv and forces.csv if there are tables.
    ///
    /// # Errors
    /// If a file cannot be written.
    pub fn write(&self, folder: &Path) -> Result<()> {
        if let Some(Tables { trajectory, ledger, forces }) = &self.tables {
            file::write(&folder.join("trajectory.csv"), trajectory)?;
            file::write(&folder.join("ledger.csv"), ledger)?;
            file::write(&folder.join("forces.csv"), forces)?;
        }
        file::write(&folder.join("results.json"), format!("{:#}\n", self.summary()))
    }

    /// The totals as JSON.
    pub fn summary(&self) -> Value {
        json!({
            "scene": self.scene.name,
            "scheme": self.scene.step.scheme.name(),
            "solver": self.solver(),
            "model": self.scene.contact.model.to_string(),
            "dt": number(self.scene.step.dt),
            "steps": self.steps,
            "time": number(self.last.time),
            "problems": self.problems,
            "accepted": self.accepted,
            "refuted_claims": self.refuted_claims,
            "worst_residual": (self.problems > 0).then(|| number(self.worst_residual)),
            "energy_start": number(self.first.energy()),
            "energy_end": number(self.last.energy()),
            "drift": number(self.worst_drift),
            "penetration": number(self.worst_penetration),
            "carried": self.carried().map(|[mean, least]| json!({ "mean": number(mean), "least": number(least) })),
            "work": self.accounted(|books| books.by_account()),
            "remainder": self.accounted(|books| number(books.remainder)),
            "laws": {
                "attraction": number(self.laws.attraction),
                "cone_excess": number(self.laws.cone_excess),
                "friction_gain": self.accounted(|_| number(self.laws.friction_gain)),
                "internal_impulse": number(self.laws.internal_impulse),
                "internal_torque": number(self.laws.internal_torque),
            },
            "conflict": self.conflict,
            "first_passage": self.passed.as_ref().map(|(step, bodies)| json!({ "step": step, "bodies": bodies })),
            "first_refused": self.refused.as_ref().map(Refused::to_json),
            "notes": self.notes(),
            "states": self.states_json(),
            "failure": self.failure,
            "certificate": self.proof,
        })
    }

    /// Who gave the answers, or would have, had a step posed a problem; nobody where the scheme poses none.
    fn solver(&self) -> Option<String> {
        let asked = match self.solvers.as_slice() {
            [] => self.scene.solver.name.clone(),
            names => names.join(", "),
        };
        self.scene.step.scheme.solves_lcps().then_some(asked)
    }

    /// The part of the weight that contacts, joints and springs carry, on average and at least.
    fn carried(&self) -> Option<[f64; 2]> {
        Some([carried(&self.scene, &self.first, &self.last)?, self.least_carried?.1])
    }

    /// The same in words.
    fn carried_in_words(&self) -> String {
        let (Some([mean, least]), Some((step, _))) = (self.carried(), self.least_carried) else {
            return "–".into();
        };
        let [mean, least] = [mean, least].map(|part| readable((1e4 * part).round() / 100.0, 4));
        format!(
            "contacts, joints and springs carry {mean} % of it, at least {least} % (step {step})"
        )
    }

    /// What the books say, or that there are none.
    fn accounted(&self, says: impl Fn(&Books) -> Value) -> Value {
        self.books.as_ref().map_or(Value::from(NOT_ACCOUNTED), says)
    }

    /// The totals for people.
    pub fn text(&self) -> String {
        let Scene { name, title, .. } = &self.scene;
        let scheme = self.scene.step.scheme.name();
        let [start, end] = [&self.first, &self.last].map(|motion| readable(motion.energy(), 6));
        let mut text = format!(
            "{name}: {title}\n\
             scheme       {scheme}{}, dt {} s\n\
             friction     {}\n\
             steps        {} ({} s)\n\
             problems     {}, accepted by the judge {}\n\
             residual     {}\n\
             energy       {start} J at the start, {end} J at the end\n\
             drift        {} m at worst{}\n\
             penetration  {} m at worst\n\
             weight       {}\n\
             laws         attraction {}, beyond the cone {} %, friction gain {}\n\
             ledger       {}",
            self.solver().map_or_else(String::new, |solver| format!(", solver {solver}")),
            self.scene.step.dt,
            self.scene.contact.model,
            self.steps,
            self.last.time,
            self.problems,
            self.accepted,
            match self.problems {
                0 => "–".into(),
                _ => format!("{} at worst", readable(self.worst_residual, 2)),
            },
            readable(self.worst_drift, 3),
            self.drift_in_words(),
            readable(self.worst_penetration, 3),
            self.carried_in_words(),
            readable(self.laws.attraction, 2),
            readable(100.0 * self.laws.cone_excess, 2),
            match self.books {
                Some(_) => format!("{} J", readable(self.laws.friction_gain, 2)),
                None => NOT_ACCOUNTED.into(),
            },
            self.books.as_ref().map_or(NOT_ACCOUNTED.into(), Books::text),
        );
        text.push('\n');
        if self.scene.step.scheme == Scheme::Acceleration {
            let Resting { gap, speed, .. } = self.scene.resting();
            let [gap, speed] = [gap, speed].map(|most| readable(most, 2));
            text += &format!("resting      gaps up to {gap} m, parting at up to {speed} m/s\n");
        }
        text += &self.states_text();
        for note in self.notes() {
            text += &format!("note         {note}\n");
        }
        if let Some((step, [one, other])) = &self.passed {
            text += &format!(
                "passed       {one:?} went through {other:?}, or the other way round, in step {step}: shorten dt, \
                 or let contact.margin cover a step's way\n"
            );
        }
        if let Some(refused) = &self.refused {
            text += &format!("refused      {refused}\n");
        }
        if !self.conflict.is_empty() {
            text +=
                &format!("conflict     no forces satisfy together: {}\n", self.conflict.join(", "));
        }
        if let Some(failure) = &self.failure {
            text += &format!("failed       {failure}\n");
        }
        text
    }

    /// What the settings, the start and the friction model are worth a word for.
    fn notes(&self) -> Vec<String> {
        let mut notes = self.scene.notes();
        if self.first.penetration > DRIFT * self.scene.thinnest().unwrap_or(f64::INFINITY) {
            let depth = readable(self.first.penetration, 2);
            notes.push(format!("bodies overlap by {depth} m at the start"));
        }
        let excess = 100.0 * self.laws.cone_excess;
        if excess > MUCH {
            let model = self.scene.contact.model;
            notes.push(format!(
                "friction of the model {model} was up to {excess:.0} % beyond Coulomb's cone, where it works askew \
                 to the tangents; --model coulomb-cone keeps to it"
            ));
        }
        notes
    }

    /// The drift beside the scene, and what takes it away, where it can be seen.
    fn drift_in_words(&self) -> String {
        let points = self.states.iter().map(|state| state.pose.p);
        let size = points.clone().flat_map(|p| points.clone().map(move |q| (p - q).norm()));
        let size = size.fold(0.0, f64::max).max(points.map(|p| p.norm()).fold(0.0, f64::max));
        let part = self.worst_drift / size;
        if !(part > DRIFT) {
            return String::new();
        }
        let setting = match self.scene.step.scheme {
            Scheme::Velocity | Scheme::SequentialImpulses => "step.baumgarte",
            Scheme::Acceleration => "step.alpha",
            _ => "a shorter step",
        };
        let percent = readable(100.0 * part, 2);
        format!(", {percent} % of the scene's size; {setting} feeds it back")
    }

    /// Where the bodies that move are now, and how fast.
    fn states_text(&self) -> String {
        let moving = || {
            let bodies = self.scene.bodies.iter().zip(&self.states);
            bodies.filter(|(body, _)| body.mass.dof() > 0)
        };
        let vector = |v: &Vector3<f64>| {
            let short = |x: f64| match x.abs() {
                size if size < 1e5 => format!("{:>11.5}", if size < 5e-6 { 0.0 } else { x }),
                _ => format!("{:>11}", readable(x, 4)),
            };
            let parts = [v.x, v.y, v.z].map(short);
            parts.join(" ")
        };
        let mut text = String::from("at the end   position (m), velocity (m/s)\n");
        for (body, state) in moving().take(SHOWN) {
            let (p, v) = (vector(&state.pose.p), vector(&state.v));
            text += &format!("             {:<12} {p}   {v}\n", body.name);
        }
        match moving().count().saturating_sub(SHOWN) {
            0 => text,
            more => text + &format!("             and {more} more: see --json and --out\n"),
        }
    }

    /// The same of all bodies, for machines.
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
        self.worst_penetration = self.worst_penetration.max(motion.penetration);
        self.last = motion.clone();
    }
}

/// An answer that the judge did not accept.
#[derive(Debug, Clone)]
struct Refused {
    step: usize,
    stage: &'static str,
    row: String,
    residual: f64,
    solver: &'static str,
    status: String,
}

impl Refused {
    fn of(scene: &Scene, step: usize, solve: &Solve, certificate: &FrictionCertificate) -> Self {
        Refused {
            step,
            stage: solve.problem.stage.name(),
            row: solve.problem.assembly.rows[certificate.worst_row].label(scene),
            residual: certificate.scaled_residual,
            solver: solve.solver,
            status: solve.solution.status.to_string(),
        }
    }

    fn to_json(&self) -> Value {
        json!({
            "step": self.step, "stage": self.stage, "row": self.row, "solver": self.solver,
            "residual": number(self.residual), "status": self.status,
        })
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Refused { step, stage, row, residual, solver, status } = self;
        write!(
            f,
            "first in step {step}, {stage} stage, row {row:?}: residual {}, ",
            readable(*residual, 2)
        )?;
        match *solver {
            "none" => write!(f, "{status}"),
            solver => write!(f, "{solver}: {status}"),
        }
    }
}

/// The energy of all steps so far.
#[derive(Debug, Clone, Copy, Default)]
struct Books {
    /// The sum of each account.
    work: Ledger,
    /// The most that was missing in a step (J).
    remainder: f64,
    /// The most that was missing in a step in which more than rounding was (J).
    missed: f64,
}

impl Books {
    fn with(self, ledger: &Ledger) -> Self {
        let remainder = ledger.remainder().abs();
        let missed = if ledger.closes() { 0.0 } else { remainder };
        Books {
            work: self.work + *ledger,
            remainder: self.remainder.max(remainder),
            missed: self.missed.max(missed),
        }
    }

    /// The work of each account (J).
    fn by_account(&self) -> Value {
        let accounts = self.work.accounts();
        accounts.iter().map(|(name, work)| (name.to_string(), number(*work))).collect()
    }

    fn text(&self) -> String {
        let mut text = match self.missed {
            0.0 => format!("closes to {} J a step:", readable(self.remainder, 2)),
            missed => format!("does not close: {} J are missing in a step:", readable(missed, 2)),
        };
        let accounts = self.work.accounts();
        let largest = accounts.iter().fold(0.0f64, |most, (_, work)| most.max(work.abs()));
        for (name, work) in accounts.iter().filter(|(_, work)| work.abs() > 1e-12 * largest) {
            text += &format!("\n             {name:<12} {:>14} J", readable(*work, 6));
        }
        text
    }
}

/// The certificate of a step without solution: the row, and the exact vector d whose dᵀw cannot be
/// what the bounds ask of it; none where all active sets were tried instead.
fn proof(cause: &Cause) -> Option<Value> {
    let Cause::NoSolution { row, proof } = cause else { return None };
    let vector = proof
        .as_ref()
        .map(|farkas| farkas.vector.iter().map(ToString::to_string).collect::<Vec<_>>());
    Some(json!({ "kind": "no_solution", "row": row, "farkas": vector }))
}
