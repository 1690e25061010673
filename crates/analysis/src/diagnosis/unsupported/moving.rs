//! Causes of wrong motion although every problem is solved: the run is repeated without each
//! suspect.

use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{Form, Model};
use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Persistence, Scene, Scheme};

use super::cause::Moving;
use super::run::{End, end_of, exact, is_of_impulses, sunk};
use super::suspect::{Suspect, test_all};
use super::thresholds::{
    CREDIBLE, EXAMINED_COMPLIANCE, FEEDBACK_HELPS, HEALTHY, REPORTED_LENGTH, REPORTED_SLIDE,
};

/// A run, and the same with exact answers.
struct Case<'a> {
    scene: &'a Scene,
    /// The number of steps.
    count: usize,
    own: &'a End,
    exactly: &'a End,
    /// The thickness (m) of the thinnest body.
    size: f64,
}

/// What the measure of a suspect finds.
enum Finding {
    /// A cause, with its strength.
    Cause(f64, Moving),
    /// The suspect is ruled out, in words.
    RuledOut(&'static str),
}

type Row<'a> = Suspect<Case<'a>, Result<End>, Result<Vec<Finding>>>;

/// The suspects of a run.
fn suspects<'a>() -> [Row<'a>; 4] {
    [
        Suspect { intervention: Case::warm, measure: |case, end| Ok(case.cold_start(&end?)) },
        Suspect {
            intervention: Case::without_feedback,
            measure: |case, end| Ok(case.feedback(&end?)),
        },
        Suspect { intervention: Case::with_cone, measure: |case, end| Ok(case.friction(&end?)) },
        Suspect { intervention: Case::rigid, measure: |case, end| Ok(case.compliance(&end?)) },
    ]
}

/// The causes of a run of this number of steps, the strongest first, and the suspects that were
/// ruled out.
pub(super) fn causes(
    scene: &Scene,
    count: usize,
    own: &End,
    exactly: &End,
) -> Result<(Vec<Moving>, Vec<String>)> {
    let size = scene.thinnest().unwrap_or(1.0);
    let case = Case { scene, count, own, exactly, size };
    let (mut causes, mut ruled_out) = (Vec::new(), Vec::new());
    let findings: Result<Vec<_>> = test_all(&suspects(), &case).into_iter().collect();
    for finding in findings?.into_iter().flatten() {
        match finding {
            Finding::Cause(strength, cause) => causes.push((strength, cause)),
            Finding::RuledOut(what) => ruled_out.push(what.to_string()),
        }
    }
    // Another law of friction moves the bodies elsewhere, so their depths cannot be compared.
    if causes.iter().any(|(_, cause)| matches!(cause, Moving::Friction { .. })) {
        causes.retain(|(_, cause)| !matches!(cause, Moving::Soft { .. }));
    }
    causes.sort_by(|a, b| b.0.total_cmp(&a.0));
    Ok((causes.into_iter().map(|(_, cause)| cause).collect(), ruled_out))
}

impl Case<'_> {
    /// The end of the run of a changed scene.
    fn end(&self, scene: &Scene) -> Option<Result<End>> {
        Some(end_of(scene, self.count))
    }

    /// The run with every step from the last answer, if steps start from 0 and that costs accuracy.
    fn warm(&self) -> Option<Result<End>> {
        let is_cold = self.scene.contact.persistence == Persistence::None;
        if !is_cold || self.own.missing <= HEALTHY {
            return None;
        }
        let mut warm = self.scene.clone();
        warm.contact.persistence = Persistence::Features;
        self.end(&warm)
    }

    fn cold_start(&self, warm: &End) -> Vec<Finding> {
        let (with, without) = (self.own.missing, warm.missing);
        match without < CREDIBLE * with {
            true => vec![Finding::Cause(with / without, Moving::Cold { with, without })],
            false => vec![Finding::RuledOut("the cold start")],
        }
    }

    fn without_feedback(&self) -> Option<Result<End>> {
        if self.scene.step.baumgarte <= 0.0 {
            return None;
        }
        let mut plain = self.scene.clone();
        plain.step.baumgarte = 0.0;
        self.end(&plain)
    }

    /// Feedback that adds energy, or drives rows away from their targets.
    fn feedback(&self, plain: &End) -> Vec<Finding> {
        let (own, exactly) = (self.own, self.exactly);
        let [energy, length] = [self.reported_energy(), self.reported_length()];
        let gains = own.gained > energy;
        let errs = exactly.error > length;
        if !gains && !errs {
            return vec![Finding::RuledOut("Baumgarte feedback (it adds no energy)")];
        }
        let mut found = Vec::new();
        let (with, without) = (own.gained, plain.gained.max(0.0));
        if gains && without < CREDIBLE * with {
            let exactly = exactly.gained.max(0.0);
            let cause = Moving::Feedback { with, without, exactly };
            found.push(Finding::Cause(with / energy, cause));
        }
        let (with, without) = (own.error, plain.error);
        if errs && with > length && without < FEEDBACK_HELPS * with {
            found.push(Finding::Cause(with / length, Moving::Away { with, without }));
        }
        found
    }

    /// The run with Coulomb's cone, if friction has another law, and the end of the run is known to
    /// depend on that law alone.
    fn with_cone(&self) -> Option<Result<End>> {
        let scene = self.scene;
        let has_friction = scene.bodies.iter().any(|body| body.friction > 0.0);
        let is_cone = matches!(scene.contact.model.form(), Form::Cone(_));
        if !has_friction || is_cone || self.compared_states().is_none() {
            return None;
        }
        let mut round = exact(scene);
        round.contact.model = Model::CoulombCone;
        if round.validate().is_err() {
            round = round.at_level(Scheme::Velocity);
        }
        if round.validate().is_err() { None } else { self.end(&round) }
    }

    /// The final states that are compared with those under Coulomb's cone: with exact answers if
    /// the scheme solves problems, otherwise its own if they contradict Coulomb's law.
    fn compared_states(&self) -> Option<&[State]> {
        match self.scene.step.scheme.solves_lcps() {
            true => Some(&self.exactly.states),
            false => {
                let slips = &self.own.slips;
                let is_wrong = slips.speed_error(self.scene).is_some()
                    || slips.notable_creep(self.scene).is_some();
                is_wrong.then_some(self.own.states.as_slice())
            }
        }
    }

    fn friction(&self, round: &End) -> Vec<Finding> {
        let (scene, scheme) = (self.scene, self.scene.step.scheme);
        let Some(states) = self.compared_states() else { return Vec::new() };
        let (distance, moved) = (apart(states, &round.states), apart(states, &scene.states));
        let off = |k: &usize| (states[*k].pose.p - round.states[*k].pose.p).norm();
        let farthest = (0..states.len()).max_by(|a, b| off(a).total_cmp(&off(b)));
        let is_far = distance > self.reported_length().max(REPORTED_SLIDE * moved);
        let Some(body) = farthest.filter(|_| is_far) else {
            let is_tested = scheme.solves_lcps();
            let words = "the friction model (with exact answers, Coulomb's cone leads to nearly the same positions)";
            return is_tested.then_some(Finding::RuledOut(words)).into_iter().collect();
        };
        let cause = Moving::Friction {
            is_polygon: matches!(scene.contact.model.form(), Form::Polygon { .. }),
            only_of: (!scheme.poses_friction()).then(|| scheme.name()),
            body: scene.bodies[body].name.clone(),
            distance,
            way: (states[body].pose.p - scene.states[body].pose.p).norm(),
        };
        vec![Finding::Cause(distance / self.reported_length(), cause)]
    }

    /// The run with rigid constraints, if the scheme's are compliant.
    fn rigid(&self) -> Option<Result<End>> {
        if is_of_impulses(self.scene.step.scheme) {
            return None;
        }
        self.end(&exact(self.scene).at_level(Scheme::Velocity))
    }

    fn compliance(&self, rigid: &End) -> Vec<Finding> {
        let (own, length) = (self.own, self.reported_length());
        let is_worse = own.error > rigid.error / CREDIBLE;
        let is_compliant = is_worse && own.error > EXAMINED_COMPLIANCE * length;
        let deepest = sunk(self.scene, &own.states, &rigid.states);
        let found = deepest.filter(|(_, depth)| is_compliant && *depth > length);
        let scheme = self.scene.step.scheme.name();
        let cause =
            |(body, depth)| Finding::Cause(depth / length, Moving::Soft { scheme, body, depth });
        found.map(cause).into_iter().collect()
    }

    /// The length (m) from which on a position error is reported.
    fn reported_length(&self) -> f64 {
        REPORTED_LENGTH * self.size
    }

    /// The energy (J) from which on a gain is reported: the same part of the work of all weights
    /// over the thickness of the thinnest body; without gravity of the kinetic energy, or that of
    /// all bodies when they move by this thickness during the run.
    fn reported_energy(&self) -> f64 {
        let Case { scene, own, size, .. } = self;
        let mass: f64 = scene.bodies.iter().map(|body| body.mass.mass()).sum();
        let weight = mass * scene.gravity.norm();
        let speed = size / (own.steps as f64 * scene.step.dt);
        let energy = || own.kinetic.max(0.5 * mass * speed * speed);
        REPORTED_LENGTH * if weight > 0.0 { weight * size } else { energy() }
    }
}

/// The distance between the ends of two runs (m).
pub(super) fn apart(one: &[State], other: &[State]) -> f64 {
    let distance = |(a, b): (&State, &State)| (a.pose.p - b.pose.p).norm();
    one.iter().zip(other).map(distance).fold(0.0, f64::max)
}
