//! The soft step: every row a spring on the mass that it feels, small steps, one sweep each.
//!
//! ```text
//! m = 1/(J M⁻¹Jᵀ),   ω = 2π f,   k = m ω²,   d = 2 m ζ ω         a spring, taken implicitly over h:
//! w = J u + (β/h) c + γ x,   γ = 1/(h (d + h k)),   β = h k/(d + h k)
//! each substep:   u ← u + h M⁻¹F + M⁻¹Jᵀx;   sweep(β, γ);   s ← s + h S u;   relax: sweep(0, 0)
//! ```
//!
//! The spring pulls errors in at its own pace, however heavy what it holds, and the relaxing sweep
//! takes the speed of that out of u again. An impulse x is kept from sweep to sweep. A gap may
//! close within a substep (bias c/h). One sweep a substep makes a spring on a light body under a
//! heavy one unstable above some f: two particles with inverse masses 0.167 and 0.000995 at h =
//! 1/60 s, ζ = 0, above 13.57 Hz, with one relaxing sweep above 20.94 Hz; hence `rate_limit`.
//!
//! Restitution: contacts that pushed in a substep get the rest of e J u⁻ at its end, u⁻ at its
//! beginning, and friction up to μ times it. (Published is the end of the step: until then a body
//! that is hit at a corner has turned, and with steps of 10 ms boxes that fell at 1 to 4 m/s parted
//! with a normal speed up to 15 % of the approach too low.) Springs of the scene keep their own k
//! and d. Catto, *Solver2D*, 2024 ("TGS soft").

use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::TAU;

use super::{substepped, supported};
use crate::assembly::{Assembly, ConstraintFilter, Row, RowId};
use crate::body::State;
use crate::constraint::{Bounds, Kind, Spring};
use crate::formulation::Stage;
use crate::scene::{DetectedContact, Scene};
use crate::simulation::solving::{Solving, assembled};
use crate::simulation::sweep::{RowTarget, Sweeper};
use crate::simulation::{Cause, StepEvent, VelocityUpdate};

/// A bounce is swept so often at most.
const MOST_SWEEPS: usize = 100;
/// A gap below this part of the distance of a substep, and a change of velocity below this part of
/// the approach, are rounding: bodies may arrive exactly at the end of a substep.
const ROUNDING: f64 = 1e-9;
/// A bounce has settled when a sweep changes velocities by less than this part of the fastest.
const SETTLED: f64 = 1e-10;

/// The impulse of each row so far, by name.
type Impulses = BTreeMap<RowId, f64>;

pub(super) fn step(
    solving: &mut Solving,
    states: &[State],
    found: &[DetectedContact],
) -> Result<Vec<State>, Cause> {
    let scene = substepped(solving.scene);
    let first = assembled(&scene, states, found, ConstraintFilter::Near)?;
    let mut impulses = named(&first, &solving.start(Stage::Velocity, &first));
    let parts = |row: &&Row| row.kind == Kind::Normal && row.velocity > scene.resting().speed;
    drop_parted(first.rows.iter().filter(parts).map(|row| &row.id), &mut impulses);
    let mut states = states.to_vec();
    for number in 0..scene.step.substeps {
        states = supported(solving, &scene, &states, number);
        let (moved, push) = substep(&scene, &states, found, &mut impulses)?;
        states = moved;
        let rows = push.assembly.rows.iter().filter(|row| is_fast(&scene, row));
        let approach: Impulses = rows.map(|row| (row.id, row.velocity)).collect();
        solving.note(StepEvent::VelocityUpdate(push));
        solving.note(StepEvent::Advance(scene.step.dt));
        let mut pushed = impulses.clone();
        for _ in 0..scene.step.soft.relax {
            let (relaxed, push) = swept(&scene, &states, found, &mut impulses, relaxed_aim)?;
            states = relaxed;
            solving.note(StepEvent::VelocityUpdate(push));
            // This may also close a gap and cause an impact.
            raise(&mut pushed, &impulses);
        }
        if approach.is_empty() {
            continue;
        }
        let end = assembled(&scene, &states, found, ConstraintFilter::Near)?;
        let x = placed(&end, &impulses);
        if let Some((bounced, push)) = bounced(&scene, end, &states, x, &approach, &pushed) {
            states = bounced;
            solving.note(StepEvent::VelocityUpdate(push));
            drop_parted(approach.keys(), &mut impulses);
        }
    }
    let last = assembled(&scene, &states, found, ConstraintFilter::Near)?;
    solving.remember(Stage::Velocity, &last, &placed(&last, &impulses));
    Ok(states)
}

/// Forces, the impulses so far, a soft sweep, and the move; what pushed in it.
fn substep(
    scene: &Scene,
    states: &[State],
    found: &[DetectedContact],
    impulses: &mut Impulses,
) -> Result<(Vec<State>, VelocityUpdate), Cause> {
    let h = scene.step.dt;
    let assembly = assembled(scene, states, found, ConstraintFilter::Near)?;
    let rates = assembly.accelerate(&assembly.force);
    let push = assembly.accelerate(&assembly.pull_back(&placed(&assembly, impulses)));
    let kicked =
        assembly.u.iter().zip(rates).zip(push).map(|((u, rate), push)| u + h * rate + push);
    let kicked = assembly.with_velocities(states, &kicked.collect::<Vec<_>>());
    let (swept, push) = swept(scene, &kicked, found, impulses, soft_aim)?;
    let states = assembly.advanced(&swept, h);
    let push = VelocityUpdate { h, impulses: placed(&assembly, impulses), assembly, ..push };
    Ok((states, push))
}

/// Drops the impulses of the contacts of these rows, which separate: taken back corner by corner
/// they would leave the body rotating.
fn drop_parted<'r>(rows: impl Iterator<Item = &'r RowId>, impulses: &mut Impulses) {
    let parted: BTreeSet<_> = rows.map(|id| id.source).collect();
    let own = impulses.iter_mut().filter(|(id, _)| parted.contains(&id.source));
    own.for_each(|(_, x)| *x = 0.0);
}

/// The states after one sweep, and what it added to the impulses.
fn swept(
    scene: &Scene,
    states: &[State],
    found: &[DetectedContact],
    impulses: &mut Impulses,
    aim: impl Fn(&Row, f64, &Scene) -> RowTarget,
) -> Result<(Vec<State>, VelocityUpdate), Cause> {
    let assembly = assembled(scene, states, found, ConstraintFilter::Near)?;
    let sweeper = Sweeper::new(&assembly, scene.step.dt);
    let rows = assembly.rows.iter().enumerate();
    let of_row = |(i, row): (usize, &Row)| {
        let aim = aim(row, sweeper.diagonal(i), scene);
        RowTarget { bias: aim.bias + row.drift, ..aim }
    };
    let aims: Vec<RowTarget> = rows.map(of_row).collect();
    let (before, mut u) = (placed(&assembly, impulses), assembly.u.clone());
    let mut x = before.clone();
    sweeper.sweep(&aims, &mut x, &mut u);
    *impulses = named(&assembly, &x);
    let states = assembly.with_velocities(states, &u);
    let own =
        |((aim, x), row): ((&RowTarget, &f64), &Row)| aim.bias - row.drift + aim.compliance * x;
    let feedback = aims.iter().zip(&x).zip(&assembly.rows).map(own).collect();
    let added = x.iter().zip(before).map(|(x, before)| x - before).collect();
    Ok((states, VelocityUpdate { assembly, h: 0.0, impulses: added, feedback, bounces: false }))
}

/// A row as a spring; `a` is J M⁻¹ Jᵀ.
fn soft_aim(row: &Row, a: f64, scene: &Scene) -> RowTarget {
    let (h, soft, contact) = (scene.step.dt, &scene.step.soft, row.kind == Kind::Normal);
    let (hertz, ratio) = match row.bounds {
        Bounds::Unilateral => (soft.contact_hertz, soft.contact_damping),
        _ => (soft.joint_hertz, soft.joint_damping),
    };
    let slop = if contact { scene.contact.slop } else { 0.0 };
    let error = match row.bounds {
        Bounds::Unilateral => (row.c + slop).min(0.0),
        _ => row.c,
    };
    let omega = TAU * hertz.min(soft.rate_limit / h);
    let spring = Spring { stiffness: omega * omega / a, damping: 2.0 * ratio * omega / a };
    let push = if contact { soft.push_speed } else { f64::INFINITY };
    match firm_aim(row, h) {
        Some(aim) => aim,
        None => RowTarget {
            bias: (spring.feedback(h) * error).max(-push),
            compliance: spring.compliance(h),
        },
    }
}

/// The same row without feedback.
fn relaxed_aim(row: &Row, _: f64, scene: &Scene) -> RowTarget {
    firm_aim(row, scene.step.dt).unwrap_or(RowTarget { bias: 0.0, compliance: 0.0 })
}

/// What springs, gaps, friction and motors aim at in every sweep; `None` for the others.
fn firm_aim(row: &Row, h: f64) -> Option<RowTarget> {
    let firm = |bias| Some(RowTarget { bias, compliance: 0.0 });
    match (row.spring, row.bounds) {
        (Some(spring), _) => {
            let (bias, compliance) = (spring.feedback(h) * row.c, spring.compliance(h));
            Some(RowTarget { bias, compliance })
        }
        (None, Bounds::Friction { .. } | Bounds::Effort(_)) => firm(-row.speed),
        (None, Bounds::Unilateral) if row.c > 0.0 => firm(row.c / h),
        _ => None,
    }
}

/// Whether a contact with restitution approaches so fast that it bounces.
fn is_fast(scene: &Scene, row: &Row) -> bool {
    row.kind == Kind::Normal
        && scene.contact.bounces(-row.velocity)
        && scene.restitution(row.bodies) > 0.0
}

/// The states with the bounce of contacts that were hit: J u⁺ = −e J u⁻ where that is faster, with
/// friction up to μ times what bounces. Swept until it settles, for corners of a body turn each
/// other's approach.
fn bounced(
    scene: &Scene,
    assembly: Assembly,
    states: &[State],
    x: Vec<f64>,
    approach: &Impulses,
    pushed: &Impulses,
) -> Option<(Vec<State>, VelocityUpdate)> {
    let sweeper = Sweeper::new(&assembly, scene.step.dt);
    let aim = |(i, row): (usize, &Row)| {
        let before = approach.get(&row.id)?;
        let rounding = ROUNDING * before.abs();
        // The impulse of another corner may have taken the approach of this one.
        let touches = row.c <= scene.step.dt * rounding;
        let stopped = pushed.get(&row.id).map_or(0.0, |x| x * sweeper.diagonal(i));
        (touches || stopped > rounding).then(|| scene.restitution(row.bodies) * before)
    };
    let aims: Vec<Option<f64>> = assembly.rows.iter().enumerate().map(aim).collect();
    let fastest = aims.iter().flatten().map(|aim| aim.abs()).reduce(f64::max)?;
    let mut impulses = vec![0.0_f64; x.len()];
    let mut u = assembly.u.clone();
    for _ in 0..MOST_SWEEPS {
        let mut change = 0.0_f64;
        for (i, row) in assembly.rows.iter().enumerate() {
            let (aim, lo, hi) = match (aims[i], row.bounds) {
                (Some(aim), _) => (aim, -x[i], f64::INFINITY),
                (None, Bounds::Friction { normal, mu }) if aims[normal].is_some() => {
                    let limit = mu * impulses[normal].max(0.0);
                    (-row.speed, -limit, limit)
                }
                _ => continue,
            };
            if sweeper.diagonal(i) > 0.0 {
                let w = sweeper.velocity(i, &u) + row.drift + aim;
                let next = (impulses[i] - w / sweeper.diagonal(i)).clamp(lo, hi);
                change = change.max(sweeper.diagonal(i) * (next - impulses[i]).abs());
                sweeper.push(i, next - impulses[i], &mut u);
                impulses[i] = next;
            }
        }
        if change <= SETTLED * fastest {
            break;
        }
    }
    let feedback = aims.into_iter().map(|aim| aim.unwrap_or(0.0)).collect();
    let states = assembly.with_velocities(states, &u);
    Some((states, VelocityUpdate { assembly, h: 0.0, impulses, feedback, bounces: true }))
}

/// The most that each row has pushed.
fn raise(pushed: &mut Impulses, impulses: &Impulses) {
    for (&id, &x) in impulses {
        let most = pushed.entry(id).or_insert(x);
        *most = most.max(x);
    }
}

/// x by name.
fn named(assembly: &Assembly, x: &[f64]) -> Impulses {
    assembly.rows.iter().zip(x).map(|(row, &x)| (row.id, x)).collect()
}

/// x by row, 0 for new rows.
fn placed(assembly: &Assembly, impulses: &Impulses) -> Vec<f64> {
    let x = |row: &Row| impulses.get(&row.id).copied().unwrap_or(0.0);
    assembly.rows.iter().map(x).collect()
}
