//! Extended position-based dynamics (XPBD): bodies fall freely for a small step, then positions are
//! corrected row by row, and velocities are what the positions did.
//!
//! ```text
//! u = u⁻ + h M⁻¹F,   s = s⁻ + h S u
//! each row:   Δx = −((1 − β) J u + (β/h) c + γ x)/(J M⁻¹Jᵀ + γ),   x ← Π(x + Δx)
//!             s ← s + h S M⁻¹Jᵀ Δx,   u ← u + M⁻¹Jᵀ Δx                  J, c at the newest s and u
//! u = (s − s⁻)/h,   ω = the rotation vector of q (q⁻)⁻¹, full turns included, divided by h
//! ```
//!
//! The published multiplier is h x. A row of compliance α has β = 1 and γ = α/h²: rigid for α = 0.
//! A spring k, d has the β and γ of the implicit spring, friction and motors have β = 0: they hold
//! the slip of the substep. Contacts and limits keep x ≥ 0.
//!
//! Sweeps that end early leave errors that become velocities. The published method begins every
//! substep with x = 0, and then a stack of ten boxes under friction gains 0.3 J in two seconds,
//! with 20 sweeps in each of 8 substeps, until it falls. Here the x of a contact begins with that
//! of the substep before, unless the contact separates: after a bounce the old impulses would lift
//! the body at one corner after the other, and the rotations do not cancel (a box that landed flat
//! turned at 0.2 rad/s).
//!
//! A correction is a velocity: a joint that starts torn apart snaps together, with the speed c/h.
//! At contacts the velocity is set afterwards, to −e J u⁻ if that bounces, else to 0, and the slip
//! to 0 as far as μ x goes, so that bodies that overlap are moved and not thrown. Macklin, Müller &
//! Chentanez 2016; Müller et al. 2020.

use std::collections::BTreeMap;
use std::f64::consts::{PI, TAU};

use super::{substepped, supported};
use crate::assembly::{ConstraintFilter, RowId, Source};
use crate::body::State;
use crate::constraint::{Bounds, Constraint, Kind, Row};
use crate::formulation::Stage;
use crate::scene::{DetectedContact, Scene};
use crate::simulation::Cause;
use crate::simulation::correction::{Lever, rows, sources};
use crate::simulation::solving::{Solving, assembled};

/// Velocities of contacts that bounce are swept so often at most.
const MOST_SWEEPS: usize = 100;
/// And until a sweep changes them by less than this part of the approach.
const SETTLED: f64 = 1e-10;
/// A contact also bounces if its remaining gap is below this fraction of the distance it travels in
/// the substep. A flat face may arrive with rounding-size gaps, and then only some of its corners
/// have an impulse.
const ARRIVED: f64 = 1e-6;
/// A rotation by a smaller angle (rad) has no reliable direction: rounding would turn it by more
/// than 1e-10.
const DIRECTED: f64 = 1e-6;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let scene = substepped(solving.scene);
    let first = assembled(&scene, states, found, ConstraintFilter::Near)?;
    let start = solving.start(Stage::Velocity, &first);
    let mut x: Impulses = first.rows.iter().zip(start).map(|(row, x)| (row.id, x)).collect();
    let before = states;
    let mut states = states.to_vec();
    let mut sums = Impulses::new();
    for number in 0..scene.step.substeps {
        states = supported(solving, &scene, &states, number);
        substep(&scene, &mut states, found, &mut x)?;
        for (&id, x) in &x {
            *sums.entry(id).or_default() += x;
        }
    }
    let ids: Vec<RowId> = x.keys().copied().collect();
    let assembly = assembled(&scene, &states, found, ConstraintFilter::Only(&ids))?;
    let of_rows = |x: &Impulses| assembly.rows.iter().map(|row| x[&row.id]).collect::<Vec<_>>();
    solving.remember(Stage::Velocity, &assembly, &of_rows(&x));
    // The rows that pushed are reported as at the beginning of the step, as under other schemes:
    // their speeds are those of the approach.
    let assembly = assembled(&scene, before, found, ConstraintFilter::Only(&ids))?;
    let pushed = assembly.rows.iter().map(|row| sums[&row.id]).collect::<Vec<_>>();
    solving.pushed = assembly.rows.into_iter().zip(pushed).collect();
    Ok(states)
}

/// The impulse of each row (N s, N m s), by name.
type Impulses = BTreeMap<RowId, f64>;

/// Moves the states by a substep; x are the impulses of the substep before, then those of this one.
fn substep(
    scene: &Scene,
    states: &mut Vec<State>,
    found: &[DetectedContact],
    named: &mut Impulses,
) -> Result<(), Cause> {
    let sources = sources(scene, found);
    let free = free(scene, states)?;
    let before = std::mem::replace(states, free.clone());
    let mut x = Vec::with_capacity(sources.len());
    for &(source, constraint) in &sources {
        x.push(begin(scene, source, constraint, named, &before, states)?);
    }
    for _ in 0..scene.step.xpbd.sweeps {
        for (&(source, constraint), x) in sources.iter().zip(&mut x) {
            correct(scene, source, constraint, x, states)?;
        }
    }
    for (k, (state, before)) in states.iter_mut().zip(&before).enumerate() {
        // A body that no row moved keeps the velocity of its free motion.
        if state.pose != free[k].pose {
            *state = with_rate(scene, k, before, state);
        }
    }
    for sweep in 1..=MOST_SWEEPS.max(scene.step.xpbd.sweeps) {
        let mut left = 0.0_f64;
        for (&(source, constraint), x) in sources.iter().zip(&mut x) {
            left =
                left.max(correct_contact_velocity(scene, source, constraint, x, &before, states)?);
        }
        if sweep >= scene.step.xpbd.sweeps && left <= SETTLED {
            break;
        }
    }
    *named = by_name(&sources, x);
    Ok(())
}

fn by_name(sources: &[(Source, &dyn Constraint)], x: Vec<Vec<f64>>) -> Impulses {
    let named = |(&(source, _), x): (&(Source, &dyn Constraint), Vec<f64>)| {
        let rows = x.into_iter().enumerate();
        rows.map(move |(component, x)| (RowId { source, component }, x))
    };
    sources.iter().zip(x).flat_map(named).collect()
}

/// The states after h without constraints.
fn free(scene: &Scene, states: &[State]) -> Result<Vec<State>, Cause> {
    let h = scene.step.dt;
    let mut assembly = assembled(scene, states, &[], ConstraintFilter::Near)?;
    assembly.rows.clear();
    let rates = assembly.accelerate(&assembly.force);
    let u: Vec<f64> = assembly.u.iter().zip(rates).map(|(u, rate)| u + h * rate).collect();
    let kicked = assembly.with_velocities(states, &u);
    Ok(assembly.advanced(&kicked, h))
}

/// Starts the rows of a contact with the x of the substep before; new ones, those of joints, and of
/// contacts that part faster than the body falls back, with 0.
fn begin(
    scene: &Scene,
    source: Source,
    constraint: &dyn Constraint,
    named: &Impulses,
    before: &[State],
    states: &mut [State],
) -> Result<Vec<f64>, Cause> {
    let old = rows(source, constraint, before)?;
    let mut start = vec![0.0; old.len()];
    let parts = |row: &Row| {
        let speed = Lever::new(scene, constraint, row, before).velocity;
        row.kind == Kind::Normal && speed > scene.resting().speed
    };
    if matches!(source, Source::Contact(_)) && !old.iter().any(parts) {
        for (component, (row, x)) in old.iter().zip(&mut start).enumerate() {
            *x = named.get(&RowId { source, component }).copied().unwrap_or(0.0);
            let lever = Lever::new(scene, constraint, row, states);
            lever.shift(scene.step.dt * *x, states);
            lever.push(*x, states);
        }
    }
    Ok(start)
}

/// Corrects the rows of a constraint, one after the other; x are their impulses so far (N s).
fn correct(
    scene: &Scene,
    source: Source,
    constraint: &dyn Constraint,
    x: &mut [f64],
    states: &mut [State],
) -> Result<(), Cause> {
    let h = scene.step.dt;
    for k in 0..x.len() {
        let row = rows(source, constraint, states)?[k];
        let (beta_per_h, gamma) = softness(&row, scene);
        let lever = Lever::new(scene, constraint, &row, states);
        if lever.mobility > 0.0 {
            let slip = (1.0 - h * beta_per_h) * (lever.velocity - row.speed);
            let w = slip + beta_per_h * error(&row, scene) + gamma * x[k];
            let next = project(&row, x[k] - w / (lever.mobility + gamma), x, h);
            lever.shift(h * (next - x[k]), states);
            lever.push(next - x[k], states);
            x[k] = next;
        }
    }
    Ok(())
}

/// β/h (1/s) and γ of a row.
fn softness(row: &Row, scene: &Scene) -> (f64, f64) {
    let h = scene.step.dt;
    match (row.spring, row.bounds) {
        (Some(spring), _) => (spring.feedback(h), spring.compliance(h)),
        (None, Bounds::Friction { .. } | Bounds::Effort(_)) => (0.0, 0.0),
        (None, _) => (1.0 / h, scene.step.xpbd.compliance / (h * h)),
    }
}

/// What of c is to go (m or rad); overlap up to the slop may stay.
fn error(row: &Row, scene: &Scene) -> f64 {
    let slop = if row.kind == Kind::Normal && row.c < 0.0 { scene.contact.slop } else { 0.0 };
    if row.c < 0.0 { (row.c + slop).min(0.0) } else { row.c }
}

/// Π of a row, after the x of the rows before it.
fn project(row: &Row, value: f64, before: &[f64], h: f64) -> f64 {
    let (lo, hi) = match row.bounds {
        Bounds::Friction { normal, mu } => (-mu * before[normal], mu * before[normal]),
        Bounds::Effort(effort) => (-effort * h, effort * h),
        bounds => bounds.interval(),
    };
    value.max(lo).min(hi)
}

/// The new pose with the velocity that led to it: ω is the rotation vector of q (q⁻)⁻¹, divided by
/// h. Poses do not show full turns: of the vectors with this direction, that nearest to h ω counts
/// if the body turns by more than half a turn.
fn with_rate(scene: &Scene, body: usize, old: &State, new: &State) -> State {
    let h = scene.step.dt;
    let shown = (new.pose.q * old.pose.q.inverse()).scaled_axis();
    let expected = h * new.omega;
    let turned = match expected.norm() < PI {
        true => shown,
        false => {
            let axis = shown.try_normalize(DIRECTED).unwrap_or_else(|| expected.normalize());
            let turns = ((expected - shown).dot(&axis) / TAU).round();
            shown + TAU * turns * axis
        }
    };
    let mean = State { v: (new.pose.p - old.pose.p) / h, omega: turned / h, ..*new };
    scene.step.gyroscopic().arrived(&scene.bodies[body].mass, &mean, h)
}

/// A contact that pushed, or just arrived, neither throws nor holds: J u = −e J u⁻ where that
/// bounces, else 0, as far as x stays a push; and it does not slip, as far as friction holds.
/// Returns how much of a bounce was missing, as a part of the approach.
fn correct_contact_velocity(
    scene: &Scene,
    source: Source,
    constraint: &dyn Constraint,
    x: &mut [f64],
    before: &[State],
    states: &mut [State],
) -> Result<f64, Cause> {
    let old = rows(source, constraint, before)?;
    let mut left = 0.0_f64;
    for (k, row) in rows(source, constraint, states)?.into_iter().enumerate() {
        let mut approach = 0.0;
        let aim = match row.kind {
            Kind::Friction => row.speed,
            Kind::Normal => {
                approach = Lever::new(scene, constraint, &old[k], before).velocity;
                let bounces = scene.contact.bounces(-approach);
                let arrives = bounces && row.c <= ARRIVED * scene.step.dt * -approach;
                if x[k] <= 0.0 && !arrives {
                    continue;
                }
                if bounces { -scene.restitution(constraint.bodies()) * approach } else { 0.0 }
            }
            _ => continue,
        };
        let lever = Lever::new(scene, constraint, &row, states);
        if lever.mobility > 0.0 {
            let wanted = x[k] + (aim - lever.velocity) / lever.mobility;
            let next = project(&row, wanted, x, scene.step.dt);
            lever.push(next - x[k], states);
            if row.kind == Kind::Normal && aim > 0.0 {
                left = left.max((lever.mobility * (next - x[k]) / approach).abs());
            }
            x[k] = next;
        }
    }
    Ok(left)
}
