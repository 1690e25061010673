//! Moves the shares of redundant contacts inside their cones.
//!
//! The motion determines the forces of redundant contacts only up to a subspace. An answer often
//! lies on the boundary of this set of forces, for example if a solver projects onto the cones,
//! and the strict inequalities of a box do not hold there. Alternating projections between the
//! subspace and slightly narrower cones move it inside.

use super::redundant::Dependence;
use super::state::RowState;
use super::system::System;
use crate::inverse::inverse;

/// The cones are narrower by these fractions: first near the answer, then farther away.
const MARGINS: [f64; 2] = [1e-10, 1e-6];
const MOST_ROUNDS: usize = 1000;

/// Forces x with the same motion, inside the cones of all sticking contacts up to the given margin;
/// one for each margin for which they were found.
pub(super) fn moved(system: &System<'_>, dependences: &[Dependence], x: &[f64]) -> Vec<Vec<f64>> {
    let directions: Vec<Vec<(usize, f64)>> = dependences.iter().map(direction).collect();
    let dot = |p: &[(usize, f64)], q: &[(usize, f64)]| -> f64 {
        let other = |i: usize| q.iter().find(|(j, _)| *j == i).map_or(0.0, |(_, value)| *value);
        p.iter().map(|&(i, value)| value * other(i)).sum()
    };
    let products = directions.iter().map(|p| directions.iter().map(|q| dot(p, q)).collect());
    let Some(inverse) = inverse(products.collect()) else { return Vec::new() };
    let within = |margin: f64| {
        let mut x = x.to_vec();
        for _ in 0..MOST_ROUNDS {
            let target = narrowed(system, margin, &x);
            if narrowed(system, margin / 2.0, &x) == x {
                return Some(x);
            }
            let along = |d: &Vec<(usize, f64)>| -> f64 {
                d.iter().map(|&(i, value)| value * (target[i] - x[i])).sum()
            };
            let right: Vec<f64> = directions.iter().map(along).collect();
            for (row, direction) in inverse.iter().zip(&directions) {
                let step: f64 = row.iter().zip(&right).map(|(a, b)| a * b).sum();
                direction.iter().for_each(|&(i, value)| x[i] += step * value);
            }
        }
        None
    };
    MARGINS.into_iter().filter_map(within).collect()
}

/// The change of forces that belongs to one more unit in a redundant row and leaves the motion as
/// it is.
fn direction(dependence: &Dependence) -> Vec<(usize, f64)> {
    let Dependence { row, factors } = dependence;
    let own = factors.iter().find(|(i, _)| i == row).map(|(_, factor)| factor.clone());
    let own = dashu_ratio::RBig::from(own.unwrap_or_default());
    let entry = |(i, factor): &(usize, dashu_int::IBig)| {
        (*i, (dashu_ratio::RBig::from(factor.clone()) / &own).to_f64().value())
    };
    factors.iter().map(entry).collect()
}

/// The nearest friction within narrower cones of the sticking contacts.
fn narrowed(system: &System<'_>, margin: f64, x: &[f64]) -> Vec<f64> {
    let mut x = x.to_vec();
    for contact in system.contacts() {
        let [n, t1, t2] = contact.rows;
        if system.states()[n] != RowState::Sticks {
            continue;
        }
        x[n] = f64::max(x[n], 0.0);
        let (limit, length) = (contact.mu * x[n] * (1.0 - margin), f64::hypot(x[t1], x[t2]));
        if length > limit {
            [x[t1], x[t2]] = [x[t1] * (limit / length), x[t2] * (limit / length)];
        }
    }
    x
}
