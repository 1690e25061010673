//! Bricard's mechanism: a ring of six hinges that is rigid by counting rows, but can move.

use crate::simulation;
use nalgebra::{DMatrix, DVector};

use super::measure::{Case, Known, Method, first};
use super::{Row, Size};
use crate::assembly::{Assembly, ConstraintFilter};
use crate::error::Result;
use crate::scene::Scene;
use crate::simulation::Simulation;
use crate::solver::{Dantzig, InteriorPoint, Lemke, Registry};

/// Singular values below this fraction of the largest count as 0.
const ZERO: f64 = 1e-9;

/// The rank of J is one below the number of rows, which leaves one degree of freedom n, J n = 0.
/// From rest the mechanism starts with the acceleration n (n·F)/(n·M n), whatever the forces in its
/// hinges: with Dantzig's method, Lemke's method and an interior point.
pub(super) fn bricard(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("bricard", "bricard", size)?;
    let whole = (0.0, "an integer; singular values below 1e-9 of the largest count as 0");
    let known = vec![
        Known::exact(whole, "rows of J", "6 \\cdot 5", "", 30.0),
        Known::exact(whole, "rank of J", "30 - 1", "", 29.0),
    ];
    let mut rows = case.rows(Method::Acceleration, known, |scene| {
        let j = jacobian(&first(scene)?.solves.last()?.problem.assembly);
        let count = j.nrows() as f64;
        let singular = j.singular_values();
        let rank = singular.iter().filter(|value| **value > ZERO * singular[0]).count();
        Some(vec![count, rank as f64])
    });
    let solved = (1e-7, "the tolerance of the interior-point method");
    let formula = "n\\,\\frac{n^T F}{n^T M n}";
    let expected = freedom(&case.scene).unwrap_or(f64::NAN);
    let solvers = [Dantzig::NAME, Lemke::NAME, InteriorPoint::NAME];
    let known = solvers.map(|name| {
        let what = format!("acceleration of rod 3 from rest, {name}");
        Known::exact(solved, what, formula, "m/s²", expected)
    });
    rows.extend(case.rows(Method::Acceleration, known.into(), |scene| {
        let start = |name: &str| {
            let mut options = simulation::options(scene);
            options.settings.tolerance = 1e-9;
            let mut simulation = Simulation::new(
                scene.clone(),
                Registry::standard().entry(name).ok()?.build(&options),
            );
            Some(simulation.step().ok()?.states[2].v.norm() / scene.step.dt)
        };
        Some(solvers.map(|name| start(name).unwrap_or(f64::NAN)).into())
    }));
    Ok(rows)
}

fn jacobian(assembly: &Assembly) -> DMatrix<f64> {
    let mut j = DMatrix::zeros(assembly.rows.len(), assembly.columns());
    for i in 0..assembly.rows.len() {
        for (k, value) in assembly.jacobian_row(i) {
            j[(i, k)] = value;
        }
    }
    j
}

/// The magnitude of rod 3's acceleration (m/s²), from the degree of freedom n alone.
fn freedom(scene: &Scene) -> Option<f64> {
    let assembly = Assembly::new(scene, &scene.states, &[], ConstraintFilter::Resting).ok()?;
    let svd = jacobian(&assembly).svd(false, true);
    let (last, _) = svd.singular_values.argmin();
    let n: DVector<f64> = svd.v_t?.row(last).transpose();
    let force = DVector::from_vec(assembly.force.clone());
    let inertia: f64 = assembly
        .blocks
        .iter()
        .map(|block| {
            let own = block.gather(n.as_slice());
            let (v, omega) = (own.fixed_rows::<3>(0), own.fixed_rows::<3>(3));
            block.mass * v.norm_squared() + omega.dot(&(block.inertia * omega))
        })
        .sum();
    let rate = n.dot(&force) / inertia;
    Some((n.rows(12, 3) * rate).norm())
}
