//! The effect of many steps of a scene on its energy and its joints.

use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};
use lcplab::simulation::{Failure, Motion};

/// Sweeps per step, enough to keep the remaining error far below the bounds.
const SWEEPS: usize = 100;
/// The number of steps between two measurements of the motion.
const EVERY: usize = 10;

/// A scene, and its bounds for a run of any length.
pub struct LongRun {
    /// The shipped scene.
    pub scene: &'static str,
    /// The largest allowed increase of the energy above that of the start (J).
    pub gain: f64,
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The largest error of a joint (m).
    pub drift: f64,
    /// The largest allowed displacement of a body (m).
    pub creep: f64,
}

/// The runs. The error of the first step, which starts from zero impulses, remains, because the
/// shipped stack and pile have no error feedback. The chain falls from the horizontal, and no point
/// of it can move farther than twice its length of 2 m.
pub const RUNS: [LongRun; 3] = [
    LongRun { scene: "stack", gain: 1e-9, penetration: 2e-3, drift: 0.0, creep: 2e-3 },
    LongRun { scene: "chain", gain: 1e-9, penetration: 0.0, drift: 4e-2, creep: 4.1 },
    LongRun { scene: "pyramid", gain: 1e-9, penetration: 1e-4, drift: 0.0, creep: 1e-3 },
];

/// The result of a run.
#[derive(Debug)]
pub struct Record {
    /// Energy at the start, the highest one and the last one (J).
    pub energy: [f64; 3],
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The largest error of a joint (m).
    pub drift: f64,
    /// The largest displacement of a body (m).
    pub creep: f64,
}

impl LongRun {
    /// Takes this number of steps.
    pub fn record(&self, steps: usize) -> Result<Record, Failure> {
        let scene = Scene::load(self.scene).expect("a shipped scene");
        let mut stepper = Stepper::new(scene, SWEEPS, Kernel::RowByRow).expect("velocity level");
        let start = Motion::of(stepper.scene(), stepper.states(), 0).energy();
        let mut record = Record { energy: [start; 3], penetration: 0.0, drift: 0.0, creep: 0.0 };
        for step in 1..=steps {
            stepper.step()?;
            if step % EVERY == 0 {
                record.look(&stepper, step);
            }
        }
        Ok(record)
    }

    /// The names of the bounds that were exceeded.
    pub fn broken(&self, record: &Record) -> Vec<&'static str> {
        let [start, highest, last] = record.energy;
        let is_kept = [
            ("energy", highest - start <= self.gain && last.is_finite()),
            ("penetration", record.penetration <= self.penetration),
            ("drift", record.drift <= self.drift),
            ("creep", record.creep <= self.creep),
        ];
        is_kept.into_iter().filter(|(_, kept)| !kept).map(|(what, _)| what).collect()
    }
}

impl Record {
    fn look(&mut self, stepper: &Stepper, step: usize) {
        let motion = Motion::of(stepper.scene(), stepper.states(), step);
        let [_, highest, last] = &mut self.energy;
        *last = motion.energy();
        *highest = highest.max(*last);
        self.penetration = self.penetration.max(motion.penetration);
        self.drift = self.drift.max(motion.drift);
        let ways = stepper.states().iter().zip(&stepper.scene().states);
        self.creep =
            ways.map(|(now, then)| (now.pose.p - then.pose.p).norm()).fold(self.creep, f64::max);
    }
}
