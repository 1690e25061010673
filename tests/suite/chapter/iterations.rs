//! E61 to E67: what sweeps do, against theory and other ways to compute it.

use lcplab::chapter::exhibit::Outcome;
use lcplab::solver::{Pgs, Settings};
use proptest::prelude::*;

use super::{assert_near, both, measure, outcomes};
use lcplab_testing::{cases, contacts, iterates};

#[test]
fn contradicting_rows_gain_half_the_rods_demand_in_every_sweep() {
    // β/dt · 2 m = 24 m/s, of which each mass gets one half.
    let [at_ten, at_thousand] = both("E61", "|x| after 1000 sweeps");
    assert!((at_ten - 120.0).abs() < 1e-9 && (at_thousand - 12_000.0).abs() < 1e-9);
}

#[test]
fn the_order_of_the_rows_decides_and_compliance_ends_that() {
    for (quantity, u) in [("u, rod last", [12.0, -12.0]), ("u, rod first", [0.0, 0.0])] {
        let measured = measure("E61", quantity);
        assert!(measured.truth.iter().zip(u).all(|(a, b)| (a - b).abs() < 1e-9), "{measured:?}");
    }
    for quantity in ["CFM, rod last", "CFM, rod first"] {
        // (JᵀJ + γ) u = Jᵀ b leaves 24/(3 + γ): the same in both orders, 8 for γ → 0.
        let [_, Outcome::Numbers(u)] = outcomes("E61", quantity) else { panic!("no numbers") };
        assert_near(u[0], 24.0 / 3.000001, 1e-8);
        assert_near(u[1], -24.0 / 3.000001, 1e-8);
    }
}

#[test]
fn the_pendulums_length_drifts_by_these_amounts_in_ten_seconds() {
    // By the formulas of one rod, worked out apart from this library.
    let expected = [
        ("velocity, no feedback", 0.4747),
        ("velocity, β c", 0.3056),
        ("velocity, β c/dt", 0.0226),
        ("acceleration", 1.3739),
    ];
    for (name, length) in expected {
        let drift = both("E64", name)[1];
        assert!((drift - length).abs() < 5e-5, "{name}: {drift}");
    }
}

#[test]
fn a_force_scales_with_its_units_and_a_strain_would_not() {
    for (quantity, factor) in
        [("mm instead of m", 1e3), ("ms instead of s", 1e-6), ("g instead of kg", 1e3)]
    {
        let [strain, force] = both("E63", quantity);
        assert_eq!(strain, 1.0);
        assert!((force / factor - 1.0).abs() < 1e-12, "{quantity}: {force}");
    }
}

#[test]
fn the_first_sweep_leads_away_from_the_solution() {
    // x = (2, 1/5), x* = (0, 1): √(4 + 16/25). The residual goes from √11 to √11 · 2.921.
    let [before, after] = both("E67", "|x − x*| after a sweep");
    assert!((before - 1.0).abs() < 1e-15 && (after - 4.64f64.sqrt()).abs() < 1e-12);
}

proptest! {
    #![proptest_config(cases(50))]

    /// E66: impulses on the bodies, the total of each contact clamped, are projected Gauss-Seidel.
    #[test]
    fn sequential_impulses_are_projected_gauss_seidel_sweep_by_sweep(
        j in proptest::collection::vec(-2.0..2.0f64, 24),
        u in proptest::collection::vec(-1.0..1.0f64, 4),
    ) {
        let rows: Vec<&[f64]> = j.chunks(4).collect();
        let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        prop_assume!(rows.iter().all(|row| dot(row, row) > 0.1));
        let a: Vec<Vec<f64>> =
            rows.iter().map(|one| rows.iter().map(|other| dot(one, other)).collect()).collect();
        let a: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
        let b: Vec<f64> = rows.iter().map(|row| dot(row, &u)).collect();
        let settings = Settings::default().with_tolerance(0.0).with_max_iterations(20);
        let system = iterates(&Pgs { settings, ..Pgs::default() }, &contacts(&a, &b));

        let (mut x, mut v) = (vec![0.0; 6], u.clone());
        for iterate in &system[1..] {
            for (i, row) in rows.iter().enumerate() {
                let total = (x[i] - dot(row, &v) / dot(row, row)).max(0.0);
                v.iter_mut().zip(*row).for_each(|(v, j)| *v += j * (total - x[i]));
                x[i] = total;
            }
            let size = x.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            prop_assert!(x.iter().zip(iterate).all(|(a, b)| (a - b).abs() < 1e-11 * size));
        }
    }
}
