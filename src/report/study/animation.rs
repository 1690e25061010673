//! A recorded motion as plain data, from which an animation can be made without solving again.

use nalgebra::{Quaternion, UnitQuaternion, Vector3};
use rayon::prelude::*;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use toml::Table;

use super::Study;
use super::settings::file_name;
use super::variation::Variation;
use crate::animation::{Animation, Force, Frame, Origin, Recording, Sample};
use crate::body::{Pose, State};
use crate::error::Result;
use crate::simulation::{Motion, Simulation};
use crate::solver::Registry;

/// An animation as a separate section.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Plan {
    /// Letters, digits, `-` and `_`; unique in the report.
    #[serde(deserialize_with = "file_name")]
    pub name: String,
    /// A shipped scene or a file.
    pub scene: String,
    /// Fields of the scene that are overridden in every variant.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
    /// Simulated time (s).
    pub duration: f64,
    /// The number of instants kept for each variant.
    #[serde(default = "sample_count")]
    pub samples: usize,
    /// The variants of the scene, shown side by side.
    pub variants: Vec<Variant>,
    /// What to see, one or two sentences.
    pub caption: String,
}

/// A variant of a scene: a name, and the overridden fields.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Variant {
    /// Its name; the part after a comma marks a variant of the name before it.
    pub name: String,
    /// The overridden fields of the scene.
    #[serde(default, skip_serializing_if = "Table::is_empty")]
    #[schemars(with = "serde_json::Map<String, serde_json::Value>")]
    pub change: Table,
}

/// The default number of instants.
fn sample_count() -> usize {
    61
}

/// An animation as numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct AnimationData {
    /// Letters, digits, `-` and `_`.
    #[serde(deserialize_with = "file_name")]
    pub id: String,
    /// The scene.
    pub scene: Variation,
    /// The recorded motions.
    pub recordings: Vec<RecordingData>,
}

/// One recorded motion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RecordingData {
    /// Its name.
    pub name: String,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
    /// Its instants.
    pub samples: Vec<SampleData>,
}

/// An instant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct SampleData {
    /// The number of the step.
    pub step: usize,
    /// The time (s).
    pub time: f64,
    /// Kinetic energy, potential energy (J), drift (m), angular drift (rad), penetration (m).
    pub measures: [f64; 5],
    /// p (m) and q of each body.
    pub poses: Vec<[f64; 7]>,
    /// Origin, point (m) and force (N) of each force.
    pub forces: Vec<(u8, [f64; 6])>,
}

/// The origin of a force, by its number in a sample.
const ORIGINS: [Origin; 3] = [Origin::Normal, Origin::Friction, Origin::Constraint];

impl AnimationData {
    /// The data of recordings of a scene.
    pub fn of(id: impl Into<String>, scene: Variation, recordings: &[Recording]) -> Self {
        AnimationData {
            id: id.into(),
            scene,
            recordings: recordings.iter().map(RecordingData::of).collect(),
        }
    }

    /// The animation.
    ///
    /// # Errors
    /// If the scene no longer exists.
    pub fn animation(&self) -> Result<Animation> {
        let scene = self.scene.scene()?;
        let recordings = self.recordings.iter().map(RecordingData::recording).collect();
        Ok(Animation::new(self.id.clone(), &scene, recordings))
    }
}

impl RecordingData {
    fn of(recording: &Recording) -> Self {
        let samples = recording.samples.iter().map(SampleData::of).collect();
        RecordingData { name: recording.name.clone(), ending: recording.ending.clone(), samples }
    }

    fn recording(&self) -> Recording {
        let samples = self.samples.iter().map(SampleData::sample).collect();
        Recording { name: self.name.clone(), samples, ending: self.ending.clone() }
    }
}

impl SampleData {
    fn of(sample: &Sample) -> Self {
        let Sample { frame, motion } = sample;
        let pose = |state: &State| {
            let (p, q) = (state.pose.p, state.pose.q.quaternion().coords);
            [p.x, p.y, p.z, q.w, q.x, q.y, q.z].map(rounded)
        };
        let force = |force: &Force| {
            let (p, f) = (force.point, force.force);
            let origin = ORIGINS.iter().position(|origin| *origin == force.origin).unwrap_or(0);
            (origin as u8, [p.x, p.y, p.z, f.x, f.y, f.z].map(rounded))
        };
        let Motion { kinetic, drift, angular_drift, penetration, .. } = *motion;
        let potential = motion.potential + motion.elastic;
        SampleData {
            step: motion.step,
            time: motion.time,
            measures: [kinetic, potential, drift, angular_drift, penetration].map(rounded),
            poses: frame.states.iter().map(pose).collect(),
            forces: frame.forces.iter().map(force).collect(),
        }
    }

    fn sample(&self) -> Sample {
        let state = |&[x, y, z, w, i, j, k]: &[f64; 7]| State {
            pose: Pose {
                p: Vector3::new(x, y, z),
                q: UnitQuaternion::new_normalize(Quaternion::new(w, i, j, k)),
            },
            ..State::WORLD
        };
        let force = |&(origin, [x, y, z, fx, fy, fz]): &(u8, [f64; 6])| Force {
            point: Vector3::new(x, y, z),
            force: Vector3::new(fx, fy, fz),
            origin: ORIGINS[usize::from(origin).min(2)],
        };
        let [kinetic, potential, drift, angular_drift, penetration] = self.measures;
        Sample {
            frame: Frame {
                time: self.time,
                states: self.poses.iter().map(state).collect(),
                forces: self.forces.iter().map(force).collect(),
                heat: Vec::new(),
            },
            motion: Motion {
                step: self.step,
                time: self.time,
                kinetic,
                potential,
                // Elastic energy is part of the potential energy.
                elastic: 0.0,
                linear_momentum: Vector3::zeros(),
                angular_momentum: Vector3::zeros(),
                drift,
                angular_drift,
                penetration,
            },
        }
    }
}

/// A number rounded to six significant digits, which is beyond visible differences.
fn rounded(x: f64) -> f64 {
    format!("{x:.5e}").parse().unwrap_or(x)
}

impl Study for Plan {
    const NAME: &'static str = "animation";
    type Finding = AnimationData;
    type Times = ();

    fn tasks(&self) -> Vec<String> {
        vec![self.name.clone()]
    }

    fn run(&self, _: usize, solvers: &Registry) -> Result<(Self::Finding, ())> {
        let base = Variation::of(&self.scene, &self.change);
        let recording = |variant: &Variant| {
            let mut scene = base.and(&variant.change).scene()?;
            scene.solvers = solvers.clone();
            let steps = (self.duration / scene.step.dt).round() as usize;
            Ok(Recording::of(&variant.name, &mut Simulation::of(&scene)?, steps, self.samples))
        };
        let recordings: Vec<Recording> =
            self.variants.par_iter().map(recording).collect::<Result<_>>()?;
        Ok((AnimationData::of(self.name.clone(), base, &recordings), ()))
    }
}
