//! E47: immovable bodies and heavy ones, note on masses.

use nalgebra::DMatrix;

use super::common::{answer, contacts, delassus, sweeps};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;

/// Bodies of these masses on a floor under gravity, bottom first, after one step of 1/60 s.
fn stack(bottom: f64, top: f64) -> Result<Lcp> {
    let j = DMatrix::from_row_slice(2, 2, &[1.0, 0.0, -1.0, 1.0]);
    contacts(&delassus(&j, &[1.0 / bottom, 1.0 / top]), &[-G * DT, 0.0])
}

/// The converged x: the loads are the weights.
fn loads(bottom: f64, top: f64) -> [f64; 2] {
    [(bottom + top) * G * DT, top * G * DT]
}

/// The factor by which a late sweep reduces the error of the upper contact.
fn measured_factor(bottom: f64, top: f64) -> Result<f64> {
    let x = sweeps(Pgs::NAME, &stack(bottom, top)?, &[0.0; 2], 2)?;
    let [_, load] = loads(bottom, top);
    Ok((x[2][1] - load) / (x[1][1] - load))
}

/// The number of sweeps until both loads are correct to 10⁻⁶.
fn sweeps_needed(bottom: f64, top: f64) -> Result<f64> {
    let loads = loads(bottom, top);
    let is_near =
        |x: &Vec<f64>| x.iter().zip(loads).all(|(x, load)| (x - load).abs() <= 1e-6 * load);
    let x = sweeps(Pgs::NAME, &stack(bottom, top)?, &[0.0; 2], 20_000)?;
    Ok(x.iter().position(is_near).map_or(f64::NAN, |sweep| sweep as f64))
}

pub(super) fn example() -> Result<Finding> {
    let factor = |quantity: &str, bottom: f64, top: f64| -> Result<Measure> {
        // The cost of a heavy body in any position.
        let heavy = 1000.0 / 1001.0;
        let measure = Measure::new(quantity, "", heavy, top / (bottom + top));
        Ok(measure.truth(&[measured_factor(bottom, top)?], "PGS, measured", 1e-6))
    };
    // A ball of 1 kg falls onto a body with this inverse mass; returns the velocity of that body
    // afterwards.
    let floor = |inverse_mass: f64| -> Result<f64> {
        let j = DMatrix::from_row_slice(1, 2, &[-1.0, 1.0]);
        let x = answer(Pgs::NAME, &contacts(&delassus(&j, &[inverse_mass, 1.0]), &[-1.0])?)?;
        Ok(-inverse_mass * x[0])
    };
    let floor = Measure::new("speed of the floor", "m/s", floor(1e-7)?, floor(0.0)?);
    Ok(Finding::new(
        "Two bodies on a floor, one of 1 kg and one of 1000 kg: the factor by which a sweep of projected \
         Gauss-Seidel shrinks the error. The printed column has the factor of the heavy body above in \
         either order. Last, a ball of 1 kg lands at 1 m/s on a floor that is a body of 10⁷ kg, or one \
         of inverse mass 0.",
    )
    .measure(factor("factor, heavy above", 1.0, 1000.0)?.agreeing())
    .measure(factor("factor, heavy below", 1000.0, 1.0)?)
    .measure(floor.truth(&[0.0], "it is immovable", 0.0))
    .plot(&drawing()?))
}

/// The number of sweeps against the mass ratio, for both orders.
fn drawing() -> Result<Lines> {
    let ratios: Vec<f64> = (0..=6).map(|k| 10f64.powf(f64::from(k) / 2.0)).collect();
    let curve = |needed: &dyn Fn(f64) -> Result<f64>| -> Result<Vec<(f64, f64)>> {
        ratios.iter().map(|&ratio| Ok((ratio, needed(ratio)?))).collect()
    };
    let theory = |factor: fn(f64) -> f64| {
        ratios.iter().map(|&ratio| (ratio, (1e-6_f64.ln() / factor(ratio).ln()).max(1.0))).collect()
    };
    Ok(Lines::new(
        "e47",
        "Sweeps until both loads are right to 10⁻⁶",
        "A heavy body above a light one costs sweeps in proportion to the mass \
                 ratio; below it, it makes them fewer. Pale band: ln 10⁻⁶ / ln(m_top / \
                 (m_bottom + m_top)).",
        Axis::log("mass of the heavy body / mass of the light one", ""),
        Axis::log("sweeps", ""),
        vec![
            Series::measured("heavy body above", curve(&|ratio| sweeps_needed(1.0, ratio))?),
            Series::measured("heavy body below", curve(&|ratio| sweeps_needed(ratio, 1.0))?),
            Series::theory("theory, heavy body above", theory(|ratio| ratio / (1.0 + ratio))),
            Series::theory("theory, heavy body below", theory(|ratio| 1.0 / (1.0 + ratio))),
        ],
    ))
}
