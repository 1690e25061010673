//! The animation: one scene by several solvers, instant by instant, seen by one camera at one
//! scale.
//!
//! ```text
//! simulation ─→ recordings ─→ poses, order, forces, measures as numbers ─→ a player
//!               samples          rounded to the visible precision
//! ```

mod chart;
mod data;
mod stage;

use super::extent;
use super::frame::{Frame, instants};
use super::strip::Strip;
use super::{Camera, View};
use crate::body::{Body, Mass};
use crate::number::readable;
use crate::page::{Chart, DrawnAnimation, Pane};
use crate::plot::canvas::hex;
use crate::plot::{Figure as _, style};
use crate::scene::Scene;
use crate::simulation::{Cause, Failure, Motion, Simulation, Step};
use crate::solver::Stop;
pub use chart::Measure;
use stage::Stage;

/// Maximum number of instants in a recording, and in all recordings of an animation.
const SAMPLES: (usize, usize) = (151, 600);
/// The part of the largest forces from which an instant shows them.
const CLEAR: f64 = 0.75;
/// Number of instants in the strip shown where the animation cannot be played, of one recording
/// and of each of several.
const STILLS: (usize, usize) = (6, 5);
/// Motions up to this many times the size of the smallest share the scale of their strips.
const CALM: f64 = 2.5;
/// The largest number of moving bodies whose motion is visible in one picture.
const FEW: usize = 2;
/// Names whose colors are used for variants of one name.
const SPARE: [&str; 5] = ["acceleration", "soft", "penalty", "position", "exact answers"];

/// One scene, simulated in several ways.
///
/// ```
/// use lcplab::animation::{Animation, Recording};
/// use lcplab::{scene::Scene, simulation::Simulation, solver};
///
/// let scene = Scene::load("stack")?;
/// let solver = Box::new(solver::Dantzig::default());
/// let mut simulation = Simulation::new(scene.clone(), solver);
/// let animation = Animation::new("stack", &scene, vec![Recording::of("dantzig", &mut simulation, 10, 11)]);
/// assert_eq!(animation.times().len(), 11);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Animation {
    /// A name without spaces, unique on a page.
    pub id: String,
    /// The scene.
    pub scene: Scene,
    /// The recordings, one per solver; all have their samples after the same steps.
    pub recordings: Vec<Recording>,
    /// The view.
    pub view: View,
    /// The step of the instant to show first; the most telling one without it.
    pub start: Option<usize>,
}

/// An energy within this fraction of its change from its last value has settled.
const SETTLED: f64 = 0.01;
/// Errors whose ratio is above this differ clearly.
const DIFFERENT: f64 = 2.0;

/// A scene as simulated by one solver.
#[derive(Debug, Clone, PartialEq)]
pub struct Recording {
    /// The solver, and after a comma its settings.
    pub name: String,
    /// Its instants from the start on.
    pub samples: Vec<Sample>,
    /// Why it ended early, if it did.
    pub ending: Option<String>,
}

/// An instant with its measures.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The poses and forces.
    pub frame: Frame,
    /// Energy, momentum and errors.
    pub motion: Motion,
}

impl Recording {
    /// A recording at the start of a simulation.
    pub(crate) fn start(name: impl Into<String>, simulation: &Simulation) -> Self {
        let (frame, motion) = (Frame::now(simulation), simulation.motion());
        Recording { name: name.into(), samples: vec![Sample { frame, motion }], ending: None }
    }

    /// Adds the end of a step.
    pub(crate) fn add(&mut self, scene: &Scene, step: &Step) {
        let (frame, motion) = (Frame::after(scene, step), step.motion.clone());
        self.samples.push(Sample { frame, motion });
    }

    /// Records why the simulation ended early, if it did.
    pub(crate) fn end(&mut self, failure: Option<&Failure>) {
        self.ending = failure.map(|own| match own.cause {
            Cause::NoSolution { .. } => {
                let time = readable(own.time, 6);
                format!("step {}, at {time} s: no forces satisfy the sliding contact", own.step)
            }
            _ => own.to_string(),
        });
    }

    /// The instants that a strip shows.
    fn stills(&self, count: usize) -> Vec<Frame> {
        let kept = instants(self.samples.len().saturating_sub(1), count).into_iter();
        kept.filter_map(|k| Some(self.samples.get(k)?.frame.clone())).collect()
    }

    /// Runs a simulation and keeps this number of instants.
    pub fn of(name: &str, simulation: &mut Simulation, steps: usize, samples: usize) -> Self {
        Recording::until(&Stop::default(), name, simulation, [steps, samples], |_| ())
    }

    /// The same with a stop condition; `see` sees each step.
    pub(crate) fn until(
        stop: &Stop,
        name: &str,
        simulation: &mut Simulation,
        [steps, samples]: [usize; 2],
        mut see: impl FnMut(&Step),
    ) -> Self {
        let mut recording = Recording::start(name, simulation);
        let (scene, kept) = (simulation.scene().clone(), instants(steps, samples));
        for _ in 0..steps {
            match simulation.step_before(stop) {
                Ok(step) => {
                    see(&step);
                    if kept.binary_search(&step.number).is_ok() {
                        recording.add(&scene, &step);
                    }
                }
                Err(failure) => {
                    recording.end(Some(&failure));
                    break;
                }
            }
        }
        recording
    }

    fn frames(&self) -> Vec<Frame> {
        self.samples.iter().map(|sample| sample.frame.clone()).collect()
    }

    /// The largest value of a measure over the recording.
    fn worst(&self, measure: Measure) -> f64 {
        let values = chart::values(self, measure);
        values.into_iter().fold(0.0, |worst: f64, x| if x.abs() > worst.abs() { x } else { worst })
    }
}

impl Animation {
    /// An animation of these recordings, with the best view for all of them.
    pub fn new(id: impl Into<String>, scene: &Scene, recordings: Vec<Recording>) -> Self {
        let frames: Vec<_> = recordings.iter().flat_map(Recording::frames).collect();
        let view = View::of(scene, &frames);
        Animation { id: id.into(), scene: scene.clone(), recordings, view, start: None }
    }

    /// The number of instants for each of this number of recordings.
    pub(crate) fn samples_each(recordings: usize) -> usize {
        SAMPLES.0.min(SAMPLES.1 / recordings.max(1))
    }

    /// The instants (s), up to the end of the longest recording.
    pub fn times(&self) -> Vec<f64> {
        self.longest().iter().map(|sample| sample.motion.time).collect()
    }

    /// The first instant to show: the one with the largest difference between recordings or, for a
    /// single recording, the first with forces of [`CLEAR`] times the largest ones.
    pub(crate) fn first_shown(&self) -> usize {
        if let Some(step) = self.start {
            let is_before =
                |own: &Sample| own.motion.time < (step as f64 - 0.5) * self.scene.step.dt;
            return self.longest().iter().filter(|own| is_before(own)).count();
        }
        let sample = |recording: &Recording, k: usize| {
            recording.samples.get(k).map(|sample| sample.frame.clone())
        };
        let apart = |one: &Frame, other: &Frame| {
            let pairs = one.states.iter().zip(&other.states);
            pairs.map(|(a, b)| (a.pose.p - b.pose.p).norm()).fold(0.0, f64::max)
        };
        let size = |k: usize| match self.recordings.as_slice() {
            [only] => sample(only, k)
                .map_or(0.0, |frame| frame.forces.iter().map(|own| own.force.norm()).sum()),
            recordings => {
                let frames: Vec<Frame> =
                    recordings.iter().filter_map(|recording| sample(recording, k)).collect();
                let pairs = frames.iter().flat_map(|a| frames.iter().map(move |b| (a, b)));
                pairs.map(|(a, b)| apart(a, b)).fold(0.0, f64::max)
            }
        };
        let sizes: Vec<f64> = (0..self.longest().len()).map(size).collect();
        let most = sizes.iter().copied().filter(|size| size.is_finite()).fold(0.0, f64::max);
        let enough = if self.recordings.len() == 1 { CLEAR * most } else { most };
        let first = sizes.iter().position(|size| *size >= enough && size.is_finite());
        first.filter(|_| most > 0.0).unwrap_or(0)
    }

    fn longest(&self) -> &[Sample] {
        let longest = self.recordings.iter().max_by_key(|recording| recording.samples.len());
        longest.map_or(&[], |recording| &recording.samples)
    }

    /// The animation, drawn for a page.
    pub fn drawn(&self) -> DrawnAnimation {
        let chart = |measure: Measure| Chart {
            name: measure.name().into(),
            unit: measure.unit().into(),
            svg: chart::svg(self, measure),
        };
        DrawnAnimation {
            title: self.finding().map(|(_, title)| title).unwrap_or_default(),
            columns: self.columns(),
            size: self.size(),
            times: self.times(),
            panes: self.panes(),
            charts: self.measures().into_iter().map(chart).collect(),
            strips: self.strips().iter().map(Strip::svg).collect(),
            data: self.data(),
        }
    }

    /// The finding, with its measure: an error in which recordings that did not end early differ
    /// clearly, where it is smallest and largest.
    fn finding(&self) -> Option<(Measure, String)> {
        let complete = || self.recordings.iter().filter(|own| own.ending.is_none());
        let said = |measure: Measure| {
            let rounding = chart::least(self, measure);
            let worst = |own: &&Recording| own.worst(measure).abs().max(rounding);
            let by_worst = |a: &&Recording, b: &&Recording| worst(a).total_cmp(&worst(b));
            let (best, most) = (complete().min_by(by_worst)?, complete().max_by(by_worst)?);
            let amount = |own: &Recording| match worst(&own) {
                value if value <= rounding => "0".into(),
                value => format!("{} {}", readable(value, 2), measure.unit()),
            };
            let is_clear = worst(&most) > DIFFERENT * worst(&best) && worst(&most).is_finite();
            let title = format!(
                "Within {} s the largest {} is {} with {}, {} with {}",
                readable(chart::end(self), 3),
                measure.name(),
                amount(best),
                best.name,
                amount(most),
                most.name
            );
            is_clear.then_some((measure, title))
        };
        let measures = chart::measures(self).into_iter().rev();
        measures.clone().find_map(said).or_else(|| Some((Measure::Energy, self.settling()?)))
    }

    /// The recordings that dissipate energy for the longest and the shortest time, if these differ
    /// clearly.
    fn settling(&self) -> Option<String> {
        let settled = |own: &Recording| {
            let energies = chart::values(own, Measure::Energy);
            let end =
                *energies.last().filter(|end| -**end > chart::least(self, Measure::Energy))?;
            let k = energies.iter().rposition(|energy| (energy - end).abs() > SETTLED * -end)? + 1;
            Some((own.samples.get(k)?.motion.time, own.name.clone()))
        };
        let complete = self.recordings.iter().filter(|own| own.ending.is_none());
        let mut times = complete.map(settled).collect::<Option<Vec<_>>>()?;
        times.sort_by(|a, b| b.0.total_cmp(&a.0));
        let ([(long, slow), ..], (short, fast)) = (&times[..], times.last()?) else { return None };
        (*long > DIFFERENT * short).then(|| {
            let [long, short] = [long, short].map(|time| readable(*time, 2));
            format!("Dissipation ends after about {long} s with {slow}, {short} s with {fast}")
        })
    }

    /// The number of recordings side by side.
    fn columns(&self) -> usize {
        match self.recordings.len() {
            4 => 2,
            recordings => recordings.clamp(1, 3),
        }
    }

    /// The measures that are available and not 0 in every recording, that of the finding first.
    pub(crate) fn measures(&self) -> Vec<Measure> {
        let (mut measures, first) = (chart::measures(self), self.finding());
        measures.sort_by_key(|own| first.as_ref().is_none_or(|(first, _)| own != first));
        measures
    }

    /// A measure over time, one curve per recording, as an SVG element for a page that defines the
    /// colors.
    pub fn chart(&self, measure: Measure) -> String {
        chart::svg(self, measure)
    }

    /// The width and height of the picture in px.
    pub(crate) fn size(&self) -> (f64, f64) {
        let lens = self.stage().lens;
        (lens.width, lens.height)
    }

    /// The recordings as a page shows them.
    pub fn panes(&self) -> Vec<Pane> {
        let (backdrop, colors) = (self.stage().backdrop(), self.colors());
        let pane = |(recording, color): (&Recording, String)| Pane {
            name: recording.name.clone(),
            color,
            backdrop: backdrop.clone(),
            description: self.description(recording),
            has_curve: recording.samples.len() > 1,
        };
        self.recordings.iter().zip(colors).map(pane).collect()
    }

    /// The data for the player, as one JSON object. Positions are in units of `unit` (m),
    /// quaternion components in 1/10000; each list has the first number and then the differences,
    /// without trailing zeros.
    ///
    /// ```
    /// use lcplab::animation::{Animation, Measure, Recording};
    /// use lcplab::{scene::Scene, simulation::Simulation, solver::Dantzig};
    ///
    /// let scene = Scene::load("pendulum")?;
    /// let mut simulation = Simulation::new(scene.clone(), Box::new(Dantzig::default()));
    /// let recordings = vec![Recording::of("dantzig", &mut simulation, 10, 11)];
    /// let animation = Animation::new("pendulum", &scene, recordings);
    /// assert_eq!(animation.panes()[0].name, "dantzig");
    /// assert!(animation.chart(Measure::Drift).starts_with("<svg"));
    /// assert!(animation.data().starts_with('{')); // JSON for the player
    /// # Ok::<(), lcplab::error::Error>(())
    /// ```
    pub fn data(&self) -> String {
        data::json(self).to_string()
    }

    /// A small picture of the first recording: of the motion if few bodies move, so that the
    /// earlier instants hide nothing, and of its middle otherwise.
    pub(crate) fn thumbnail(&self, size: (f64, f64)) -> String {
        let first = self.recordings.first();
        let mut frames = first.map(|own| own.stills(STILLS.1)).unwrap_or_default();
        let is_moving = |body: &&Body| body.mass != Mass::Fixed;
        if self.scene.bodies.iter().filter(is_moving).count() > FEW {
            frames = frames.get(frames.len() / 2).cloned().into_iter().collect();
        }
        Strip { view: self.view, ..Strip::new(&self.scene, frames) }.thumbnail(size)
    }

    /// The pictures that are printed: some instants of each recording, or the one shown first, as
    /// under each other frames are too small for the forces on several bodies.
    fn strips(&self) -> Vec<Strip> {
        let is_moving = |body: &&Body| body.mass != Mass::Fixed;
        let moving = self.scene.bodies.iter().filter(is_moving).count();
        let is_moved = |own: &&Recording| own.samples.len() > 1;
        if self.recordings.len() <= FEW || moving <= FEW {
            let strips = (0..self.recordings.len()).filter(|&k| is_moved(&&self.recordings[k]));
            return strips.map(|k| self.strip(k)).collect();
        }
        let k = self.first_shown();
        let shown: Vec<_> =
            self.recordings.iter().filter_map(|own| Some((own, own.samples.get(k)?))).collect();
        let frames: Vec<Frame> = shown.iter().map(|(_, sample)| sample.frame.clone()).collect();
        let time = readable(self.times()[k], 3);
        let strip = Strip {
            title: format!("After {time} s"),
            others: self
                .recordings
                .iter()
                .flat_map(Recording::frames)
                .filter(Frame::is_finite)
                .collect(),
            labels: shown.iter().map(|(own, _)| own.name.clone()).collect(),
            view: self.view,
            ..Strip::new(&self.scene, frames)
        };
        vec![strip.named(&self.id).with_forces()]
    }

    /// Some instants of a recording as a picture.
    fn strip(&self, recording: usize) -> Strip {
        let count = if self.recordings.len() == 1 { STILLS.0 } else { STILLS.1 };
        let stills: Vec<Vec<Frame>> = self.recordings.iter().map(|own| own.stills(count)).collect();
        let sizes: Vec<f64> = stills
            .iter()
            .map(|frames| extent::size(&extent::landmarks(&self.scene, frames)))
            .collect();
        // A motion that explodes has a scale of its own.
        let least = sizes.iter().copied().fold(f64::INFINITY, f64::min);
        let is_calm = |k: usize| sizes[k] <= CALM * least;
        let others = (0..stills.len()).filter(|&k| is_calm(recording) && is_calm(k));
        Strip {
            id: format!("{}-{recording}", self.id),
            title: self.recordings[recording].name.clone(),
            view: self.view,
            others: others
                .flat_map(|k| stills[k].iter().filter(|frame| frame.is_finite()).cloned())
                .collect(),
            ..Strip::new(&self.scene, stills[recording].clone())
        }
        .with_forces()
    }

    fn stage(&self) -> Stage {
        let motions: Vec<_> = self.recordings.iter().map(Recording::frames).collect();
        let landmarks = extent::shared(&self.scene, &motions);
        Stage::new(self, Camera::new(self.view), landmarks)
    }

    /// The colors of the recordings' names; variants of one name get other unused colors.
    fn colors(&self) -> Vec<String> {
        let mut taken = Vec::new();
        for recording in &self.recordings {
            let own = style::style(&recording.name).color;
            let spare = || SPARE.map(|name| style::style(name).color);
            let free = [own].into_iter().chain(spare()).find(|color| !taken.contains(color));
            taken.push(free.unwrap_or(own));
        }
        taken.into_iter().map(hex).collect()
    }

    fn description(&self, recording: &Recording) -> String {
        let worst = |measure: &Measure| {
            let value = readable(recording.worst(*measure), 2);
            format!("{} {value} {} at most", measure.name(), measure.unit())
        };
        let measures: Vec<_> = self.measures().iter().map(worst).collect();
        let end = recording.samples.last().map_or(0.0, |sample| sample.motion.time);
        let ending =
            recording.ending.as_ref().map_or(String::new(), |why| format!("; ended: {why}"));
        format!(
            "{} by {}, {} instants to {} s, seen {}: {}{ending}",
            self.scene.title,
            recording.name,
            recording.samples.len(),
            readable(end, 3),
            self.view.name(),
            measures.join(", ")
        )
    }
}
