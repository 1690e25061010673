//! The coefficient of restitution that impacts show, whatever the scheme.
//!
//! An impact begins in a step in which two bodies that approach push each other, and ends with the
//! last step in which they do: it may take several. Newton's law asks for v⁺ = −e v⁻. It is
//! measured where two bodies touch at one point, touch no others and have no joints, for there
//! nothing but the impact and gravity changes v.

use std::collections::BTreeMap;

use super::Step;
use super::slip::Totals;
use super::turned::NormalShifts;
use crate::body::State;
use crate::scene::Scene;

/// An approach faster than this many times the speed that gravity adds in a step is an impact.
const FAST: f64 = 4.0;
/// The number of steps of slower approach after which bodies have come to rest.
const RESTING: usize = 10;

/// Two bodies that push each other in a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Both bodies, in the order of the scene.
    pub bodies: [usize; 2],
    /// In how many places.
    pub points: usize,
    /// The speed of approach before the step, −J u⁻ (m/s), of the fastest place.
    pub approach: f64,
    /// The speed of parting after the step there, J u⁺ (m/s).
    pub parting: f64,
    /// The largest gap or overlap |c| of its places at the beginning of the step (m).
    pub largest_gap: f64,
}

impl Touch {
    /// Those of a step that led to these states.
    pub(super) fn of(totals: &Totals, shifts: &NormalShifts, after: &[State]) -> Vec<Touch> {
        let mut pairs: BTreeMap<[usize; 2], Touch> = BTreeMap::new();
        for contact in totals.contacts() {
            let (row, impulse) = contact.normal;
            if *impulse <= 0.0 {
                continue;
            }
            let bodies = contact.bodies;
            let [before, parting] = shifts.velocities(bodies, row, after);
            let approach = -before;
            let new = Touch { bodies, points: 0, approach, parting, largest_gap: 0.0 };
            let touch = pairs.entry(bodies).or_insert(new);
            touch.points += 1;
            touch.largest_gap = touch.largest_gap.max(row.c.abs());
            if approach > touch.approach {
                (touch.approach, touch.parting) = (approach, parting);
            }
        }
        pairs.into_values().collect()
    }
}

/// An impact between two bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Impact {
    /// Both bodies, in the order of the scene.
    pub bodies: [usize; 2],
    /// The number of the step in which it began, from 1.
    pub step: usize,
    /// The speed of approach before it, −v⁻ (m/s).
    pub approach: f64,
    /// The speed of parting after it, v⁺ (m/s).
    pub parting: f64,
    /// e of the pair.
    pub restitution: f64,
    /// What gravity may have changed of v meanwhile (m/s).
    pub slack: f64,
}

impl Impact {
    /// v⁺ + e v⁻ as a part of the approach, what gravity may have done left out: 0 where Newton's
    /// law holds, negative where the bounce is too weak.
    pub fn error(&self) -> f64 {
        let error = self.parting - self.restitution * self.approach;
        error.signum() * (error.abs() - self.slack).max(0.0) / self.approach
    }
}

/// The impacts of a run, taken from one step after the other.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::{Impact, Impacts, Simulation};
/// use lcplab_solver::Dantzig;
///
/// // Newton's law with e = ½: 2 m/s before, 1 m/s after the impact. Half a meter per second is
/// // missing in the second one, a quarter of the approach.
/// let (approach, parting, restitution) = (2.0, 1.0, 0.5);
/// let impact = Impact { bodies: [0, 1], step: 1, approach, parting, restitution, slack: 0.0 };
/// assert_eq!(impact.error(), 0.0);
/// assert_eq!(Impact { parting: 0.5, ..impact }.error(), -0.25);
///
/// // The impacts of a ball that bounces.
/// let mut simulation =
///     Simulation::new(Scene::load("bouncing_ball")?, Box::new(Dantzig::default()));
/// let (mut impacts, mut ended) = (Impacts::default(), Vec::new());
/// for _ in 0..200 {
///     let step = simulation.step().expect("a step that can be taken");
///     ended.extend(impacts.add(simulation.scene(), &step));
/// }
/// ended.extend(impacts.unfinished());
/// assert!(!ended.is_empty() && ended.iter().all(|impact| impact.error().abs() < 0.01));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Impacts {
    open: BTreeMap<[usize; 2], Open>,
}

/// An impact that has not ended.
#[derive(Debug, Clone, Copy)]
struct Open {
    impact: Impact,
    /// For how many steps nothing has moved.
    still: usize,
}

impl Impacts {
    /// Those that have not ended, as they are so far.
    pub fn unfinished(&self) -> impl Iterator<Item = Impact> {
        self.open.values().map(|open| open.impact)
    }

    /// Takes a step into account; returns the impacts that have ended.
    pub fn add(&mut self, scene: &Scene, step: &Step) -> Vec<Impact> {
        let slack = scene.gravity.norm() * scene.step.dt;
        let before = std::mem::take(&mut self.open);
        let mut ended = Vec::new();
        for touch in step.touches.iter().filter(|touch| is_alone(scene, touch, &step.touches)) {
            let mut open = match before.get(&touch.bodies) {
                Some(open) => *open,
                None if touch.approach > FAST * slack && scene.contact.bounces(touch.approach) => {
                    Open { impact: begun(scene, touch, step.number), still: 0 }
                }
                None => continue,
            };
            open.impact.parting = touch.parting;
            open.impact.slack += slack;
            open.still = if touch.parting.abs() > FAST * slack { 0 } else { open.still + 1 };
            match open.still >= RESTING {
                true => ended.push(open.impact),
                false => drop(self.open.insert(touch.bodies, open)),
            }
        }
        let touching = |bodies: &[usize; 2]| step.touches.iter().any(|own| own.bodies == *bodies);
        ended.extend(before.into_iter().filter(|(pair, _)| !touching(pair)).map(|(_, o)| o.impact));
        ended
    }
}

fn begun(scene: &Scene, touch: &Touch, step: usize) -> Impact {
    let Touch { bodies, approach, parting, .. } = *touch;
    let restitution = scene.restitution(bodies.map(Some));
    let slack = scene.gravity.norm() * scene.step.dt;
    Impact { bodies, step, approach, parting, restitution, slack }
}

/// Whether two bodies touch at one point, and nothing else acts on those of them that move.
fn is_alone(scene: &Scene, touch: &Touch, touches: &[Touch]) -> bool {
    let moves = |body: &usize| scene.bodies[*body].mass.dof() > 0;
    let is_free = |body: usize| {
        let joined = scene.constraints.iter().any(|own| own.bodies().contains(&Some(body)));
        let touched = touches.iter().filter(|own| own.bodies.contains(&body)).count();
        !joined && touched == 1
    };
    touch.points == 1 && touch.bodies.into_iter().filter(moves).all(is_free)
}
