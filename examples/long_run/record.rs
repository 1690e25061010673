//! What many steps of a scene do to its energy, its joints and its memory.

use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};
use lcplab::simulation::{Failure, Motion};

/// Sweeps a step: enough that what they leave undone is far below the bounds.
const SWEEPS: usize = 100;
/// From here on a run asks for no more memory.
const WARM: usize = 1000;
/// The motion is measured every so many steps.
const EVERY: usize = 10;

/// A scene, and what must not be exceeded in it however long it runs.
pub struct LongRun {
    /// The shipped scene.
    pub scene: &'static str,
    /// How far the energy may rise above that of the start (J).
    pub gain: f64,
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The largest error of a joint (m).
    pub drift: f64,
    /// How far a body may get from where it began (m).
    pub creep: f64,
}

/// The runs. What the first step leaves undone, from impulses 0, stays: the shipped stack and pile
/// feed no error back. The chain falls from level and cannot get farther than twice its length, 2
/// m.
pub const RUNS: [LongRun; 3] = [
    LongRun { scene: "stack", gain: 1e-9, penetration: 2e-3, drift: 0.0, creep: 2e-3 },
    LongRun { scene: "chain", gain: 1e-9, penetration: 0.0, drift: 4e-2, creep: 4.1 },
    LongRun { scene: "pyramid", gain: 1e-9, penetration: 1e-4, drift: 0.0, creep: 1e-3 },
];

/// What was found.
#[derive(Debug)]
pub struct Record {
    /// Energy at the start, the highest one and the last one (J).
    pub energy: [f64; 3],
    /// The deepest overlap (m).
    pub penetration: f64,
    /// The largest error of a joint (m).
    pub drift: f64,
    /// The farthest way of a body from where it began (m).
    pub creep: f64,
    /// What the stepper's arrays hold when they are warm and at the end.
    pub bytes: [usize; 2],
}

impl LongRun {
    /// Takes so many steps.
    pub fn record(&self, steps: usize) -> Result<Record, Failure> {
        let scene = Scene::load(self.scene).expect("a shipped scene");
        let mut stepper = Stepper::new(scene, SWEEPS, Kernel::RowByRow).expect("velocity level");
        let start = Motion::of(stepper.scene(), stepper.states(), 0).energy();
        let mut record =
            Record { energy: [start; 3], penetration: 0.0, drift: 0.0, creep: 0.0, bytes: [0; 2] };
        for step in 1..=steps {
            stepper.step()?;
            if step == WARM.min(steps) {
                record.bytes = [stepper.bytes(); 2];
            }
            if step % EVERY == 0 {
                record.look(&stepper, step);
            }
        }
        record.bytes[1] = stepper.bytes();
        Ok(record)
    }

    /// Which bounds were exceeded.
    pub fn broken(&self, record: &Record) -> Vec<&'static str> {
        let [start, highest, last] = record.energy;
        let is_kept = [
            ("energy", highest - start <= self.gain && last.is_finite()),
            ("penetration", record.penetration <= self.penetration),
            ("drift", record.drift <= self.drift),
            ("creep", record.creep <= self.creep),
            ("memory", record.bytes[0] == record.bytes[1]),
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
