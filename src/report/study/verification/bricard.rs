//! Bricard's mechanism: six hinges in a ring that count as rigid and are not.

use nalgebra::DMatrix;

use super::measure::{Case, Known, Method, first, last};
use super::{Row, Size};
use crate::error::Result;
use crate::report::study::scene_options;
use crate::simulation::Simulation;
use crate::solver::by_name;

/// The rank of J: one below the number of rows, so that one freedom is left. The motion is the same
/// by Dantzig's method and by Lemke's, though forces are not unique, and the energy stays.
pub(super) fn bricard(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("bricard", "bricard", size)?;
    let whole = (0.0, "a whole number; singular values below 1e-9 of the largest count as 0");
    let formula = ["30 - 1", "30 - 1"];
    let known = vec![
        Known::exact(whole, "rows of J", ["6 hinges x 5", "6 \\cdot 5"], "", 30.0),
        Known::exact(whole, "rank of J", formula, "", 29.0),
    ];
    let mut rows = case.rows(Method::Acceleration, known, |scene| {
        let step = first(scene)?;
        let assembly = &step.solves.last()?.problem.assembly;
        let mut j = DMatrix::zeros(assembly.rows.len(), assembly.columns());
        for i in 0..assembly.rows.len() {
            for (k, value) in assembly.jacobian_row(i) {
                j[(i, k)] = value;
            }
        }
        let count = j.nrows() as f64;
        let singular = j.singular_values();
        let rank = singular.iter().filter(|value| **value > 1e-9 * singular[0]).count();
        Some(vec![count, rank as f64])
    });
    let energy = case.rows(
        Method::Rk4,
        vec![Known::order(4.0, "energy after 1 s", ["E0", "E_0"], "J", energy(&case))],
        |scene| Some(vec![last(scene, 1.0)?.motion.energy()]),
    );
    rows.extend(energy);
    let same = (1e-8, "the solvers' tolerance, summed over the steps");
    let what = "distance of the rods by two solvers after 0.5 s";
    let known = vec![Known::exact(same, what, ["0", "0"], "m", 0.0)];
    rows.extend(case.rows(Method::Acceleration, known, |scene| {
        let end = |name: &str| {
            let solver = by_name(name, &scene_options(scene)).ok()?;
            let mut simulation = Simulation::new(scene.clone(), solver);
            for _ in 0..(0.5 / scene.step.dt).round() as usize {
                simulation.step().ok()?;
            }
            Some(simulation.states().to_vec())
        };
        let (ours, theirs) = (end("dantzig")?, end("lemke")?);
        let apart = ours.iter().zip(&theirs).map(|(a, b)| (a.pose.p - b.pose.p).norm());
        Some(vec![apart.fold(0.0, f64::max)])
    }));
    Ok(rows)
}

/// The energy at the start (J): that of the heights, for the mechanism starts at rest.
fn energy(case: &Case) -> f64 {
    let bodies = case.scene.bodies.iter().zip(&case.scene.states);
    bodies.map(|(body, state)| -body.mass.mass() * case.scene.gravity.dot(&state.pose.p)).sum()
}
