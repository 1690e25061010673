//! The tables of a simulation as CSV: trajectory, ledger and forces.

use nalgebra::Vector3;

use super::NOT_ACCOUNTED;
use crate::assembly::{Row, Source};
use crate::body::State;
use crate::csv::{number, record};
use crate::formulation::Stage;
use crate::memory::Memory;
use crate::scene::Scene;
use crate::simulation::{LawErrors, Ledger, Motion, Solve, Step};

/// Three tables, one line at a time; names and units are in their first lines.
#[derive(Debug, Clone)]
pub(super) struct Tables {
    /// One line per body and step: pose and velocity at its end.
    pub trajectory: String,
    /// One line per step: energy and momentum, the energy balance, and the deviations from physical
    /// laws.
    pub ledger: String,
    /// One line per row and solve: the force or impulse of every constraint, and the impulse that
    /// acted (0 for an answer that was replaced by another); for a contact also the touching
    /// features, the point, and the direction in which it pushes the second body. Schemes without
    /// an LCP have one line per row and step, with the sum of the substeps.
    pub forces: String,
}

impl Tables {
    pub fn new() -> Self {
        let (mut trajectory, mut ledger, mut forces) =
            (String::new(), String::new(), String::new());
        record(&mut trajectory, TRAJECTORY);
        let accounts = Ledger::default().accounts().map(|(name, _)| format!("{name} (J)"));
        let names = MOTION.map(String::from).into_iter().chain(accounts);
        record(&mut ledger, names.chain(LAWS.map(String::from)));
        record(&mut forces, FORCES);
        Tables { trajectory, ledger, forces }
    }

    /// Adds the state at the start, before any step.
    pub fn start(&mut self, scene: &Scene, motion: &Motion, states: &[State]) {
        self.add_motion(motion, Some(&Ledger::default()), &LawErrors::default());
        self.add_states(scene, motion, states);
    }

    /// Adds a step.
    pub fn add(&mut self, scene: &Scene, step: &Step) {
        self.add_motion(&step.motion, step.ledger.as_ref(), &step.laws);
        self.add_states(scene, &step.motion, &step.states);
        for solve in step.posed(scene).iter().flat_map(|solves| &**solves) {
            self.add_forces(scene, step, solve);
        }
        for (row, impulse) in &step.pushed {
            let unit = Stage::Velocity.unit(row.kind.is_angular());
            let x = number(*impulse);
            self.add_force(scene, step, row, ["substeps", &x, unit, "", &x]);
        }
    }

    /// Their memory; a growing text takes up to twice its length.
    pub fn memory(&self) -> Memory {
        let texts = [&self.trajectory, &self.ledger, &self.forces];
        Memory::bytes(texts.map(|text| text.capacity() as u64).iter().sum())
    }

    fn add_motion(&mut self, motion: &Motion, ledger: Option<&Ledger>, laws: &LawErrors) {
        let [p, l] = [&motion.linear_momentum, &motion.angular_momentum];
        let state = [motion.time, motion.kinetic, motion.potential, motion.energy()];
        let momenta = [p.x, p.y, p.z, l.x, l.y, l.z];
        let errors = [motion.drift, motion.angular_drift, motion.penetration];
        let accounted = |x: f64| ledger.map_or(NOT_ACCOUNTED.into(), |_| number(x));
        let (accounts, remainder) =
            ledger.map_or(Default::default(), |ledger| (ledger.accounts(), ledger.remainder()));
        let mut cells = vec![motion.step.to_string()];
        cells.extend([&state[..], &momenta, &errors].concat().into_iter().map(number));
        cells.extend(accounts.map(|(_, work)| accounted(work)));
        cells.extend([accounted(remainder), number(laws.attraction), number(laws.cone_excess)]);
        cells.push(accounted(laws.friction_gain));
        cells.extend([laws.internal_impulse, laws.internal_torque].map(number));
        record(&mut self.ledger, cells);
    }

    fn add_states(&mut self, scene: &Scene, motion: &Motion, states: &[State]) {
        for (body, State { pose, v, omega }) in scene.bodies.iter().zip(states) {
            let q = pose.q.quaternion();
            let place = [motion.time, pose.p.x, pose.p.y, pose.p.z, q.w, q.i, q.j, q.k];
            let velocity = [v.x, v.y, v.z, omega.x, omega.y, omega.z];
            let numbers = place.into_iter().chain(velocity).map(number);
            let names = [motion.step.to_string(), body.name.clone()].into_iter();
            record(&mut self.trajectory, names.chain(numbers));
        }
    }

    fn add_forces(&mut self, scene: &Scene, step: &Step, solve: &Solve) {
        let Solve { problem, solution, impulse_factor, .. } = solve;
        // Includes the friction that follows from a normal force and is not an unknown.
        let efforts = problem.efforts(&solution.x);
        for (i, row) in problem.assembly.rows.iter().enumerate() {
            let unit = problem.stage.unit(row.kind.is_angular());
            let [x, w] = [efforts[i], solution.w[i]].map(number);
            let acted = match problem.stage {
                Stage::Position => String::new(),
                _ => number(impulse_factor * efforts[i]),
            };
            self.add_force(scene, step, row, [problem.stage.name(), &x, unit, &w, &acted]);
        }
    }

    /// Adds a row with its stage, x, unit, w and the impulse that acted; for a contact also the
    /// touching features, the point if it was known at the beginning of the step, and the row's
    /// direction.
    fn add_force(&mut self, scene: &Scene, step: &Step, row: &Row, of: [&str; 5]) {
        let id = match row.id.source {
            Source::Contact(id) => Some(id),
            Source::Constraint(_) => None,
        };
        let found = id.and_then(|id| step.contacts.iter().find(|found| found.id == id));
        let numbers = |v: Vector3<f64>| [v.x, v.y, v.z].map(number);
        let nothing = || [const { String::new() }; 3];
        let [stage, x, unit, w, acted] = of.map(String::from);
        let mut cells = vec![step.number.to_string(), stage, row.label(scene), x, unit, w, acted];
        cells.push(id.map_or(String::new(), |id| id.to_string()));
        cells.extend(found.map_or_else(nothing, |found| numbers(found.point)));
        cells.extend(id.and_then(|_| row.direction()).map_or_else(nothing, numbers));
        cells.extend(row.names(scene).map(String::from));
        record(&mut self.forces, cells);
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

const MOTION: [&str; 14] = [
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

const LAWS: [&str; 6] = [
    "remainder (J)",
    "attraction (x)",
    "cone excess",
    "friction gain (J)",
    "internal impulse (N s)",
    "internal torque (N m s)",
];

const FORCES: [&str; 16] = [
    "step",
    "stage",
    "row",
    "x",
    "unit of x",
    "w",
    "impulse",
    "features",
    "point x (m)",
    "point y (m)",
    "point z (m)",
    "direction x",
    "direction y",
    "direction z",
    "first body",
    "second body",
];
