//! Benchmarks 4.3: the published rates and sweeps.

use lcplab::error::Result;
use lcplab::report::page::{Mark, Table};
use lcplab::report::study::Study;
use lcplab::report::study::rates::{Method, Plan, System};
use lcplab::report::view::Document;

use super::standard;

fn run(bodies: &[usize], ratios: &[f64]) -> Result<Vec<System>> {
    let plan = Plan { bodies: bodies.to_vec(), ratios: ratios.to_vec() };
    (0..plan.tasks().len()).map(|task| Ok(plan.run(task)?.0)).collect()
}

/// n, then ρ_J, ρ_GS, ω*, ρ(ω*), and the sweeps of Gauss-Seidel to 1e-8.
const COLUMNS: [(usize, [f64; 4], usize); 5] = [
    (5, [0.951057, 0.904508, 1.527864, 0.527864], 157),
    (10, [0.987688, 0.975528, 1.729454, 0.729454], 606),
    (15, [0.994522, 0.989074, 1.810727, 0.810727], 1329),
    (20, [0.996917, 0.993844, 1.854498, 0.854498], 2318),
    (50, [0.999507, 0.999013, 1.939092, 0.939092], 13566),
];

fn columns() -> Vec<System> {
    run(&COLUMNS.map(|(n, ..)| n), &[]).unwrap()
}

/// How much faster or slower the digits come than they should, as a part.
fn lag(measured: f64, expected: f64) -> f64 {
    1.0 - measured.ln() / expected.ln()
}

#[test]
fn columns_have_the_published_rates_in_closed_form_and_as_eigenvalues() {
    for (system, (n, [jacobi, gauss_seidel, omega, best], _)) in columns().iter().zip(COLUMNS) {
        assert_eq!(system.bodies, n);
        for (rate, published) in system.rates.iter().zip([jacobi, gauss_seidel, best]) {
            assert!((rate.closed_form - published).abs() < 5e-7, "n = {n}: {rate:?}");
            assert!((rate.eigenvalue - published).abs() < 2e-6, "n = {n}: {rate:?}");
        }
        let Method::BestSor { omega: found } = system.rates[2].method else { panic!("no SOR") };
        assert!((found - omega).abs() < 5e-7);
    }
}

#[test]
fn residuals_fall_at_the_published_rates_and_late_at_the_best_omega() {
    for (system, (n, [jacobi, gauss_seidel, _, best], _)) in columns().iter().zip(COLUMNS) {
        let measured: Vec<f64> = system.rates.iter().map(|rate| rate.measured.unwrap()).collect();
        assert!(lag(measured[0], jacobi).abs() < 0.01, "n = {n}");
        assert!(lag(measured[1], gauss_seidel).abs() < 0.01, "n = {n}");
        // k ρ^k over the sweeps K/2 … K gains ln 2 / (K/2) less a sweep; ρ^K is about 1e-11.
        let late = 2f64.ln() / (-1e-11f64.ln() / 2.0);
        let found = lag(measured[2], best);
        assert!(0.5 * late < found && found < 2.0 * late, "n = {n}: {found}, not {late}");
    }
}

#[test]
fn columns_take_the_published_sweeps_as_predicted() {
    for (system, (n, _, published)) in columns().iter().zip(COLUMNS) {
        assert_eq!(system.sweeps.measured, Some(published), "n = {n}");
        let predicted = system.sweeps.predicted.ceil() as usize;
        assert!(predicted.abs_diff(published) <= 1, "n = {n}: {predicted}");
        assert!(system.sweeps.by_rate > system.sweeps.predicted);
    }
}

#[test]
fn two_bodies_take_the_published_sweeps_and_keep_the_published_error() {
    let published = [(1.0, 24), (10.0, 175), (100.0, 1670), (1000.0, 16619), (1e4, 166106)];
    let systems = run(&[], &published.map(|(r, _)| r)).unwrap();
    for (system, (r, sweeps)) in systems.iter().zip(published) {
        assert_eq!(system.sweeps.measured, Some(sweeps), "r = {r}");
        assert_eq!(system.sweeps.predicted.ceil() as usize, sweeps, "r = {r}");
        assert!(lag(system.rates[0].measured.unwrap(), r / (1.0 + r)).abs() < 0.01, "r = {r}");
        for &(k, error) in &system.errors {
            let expected = (r / (1.0 + r)).powi(k as i32);
            assert!((error - expected).abs() < 1e-9, "r = {r}, k = {k}: {error}");
        }
    }
    // 0.905 and 0.608 of the error are left at r = 100.
    let left = |k: usize| systems[2].errors.iter().find(|(at, _)| *at == k).unwrap().1;
    assert!((left(10) - 0.905).abs() < 5e-4 && (left(50) - 0.608).abs() < 5e-4);
}

#[test]
fn a_column_that_cannot_be_built_is_an_error() {
    for (bodies, ratio, named) in [(0, 1.0, "n: must lie"), (5, -1.0, "ratio: must lie")] {
        let error = run(&[bodies], &[ratio]).unwrap_err().to_string();
        assert!(error.contains(named), "{error}");
    }
}

#[test]
fn the_table_flags_what_disagrees_but_for_the_slope_at_the_best_omega() {
    let flagged = |table: &Table| -> Vec<usize> {
        let stands_out =
            |row: &usize| matches!(table.rows[*row].last().unwrap().mark, Mark::Note | Mark::Bad);
        (0..table.rows.len()).filter(stands_out).collect()
    };
    let plan = Plan { bodies: vec![5], ratios: vec![10.0] };
    let mut systems: Vec<System> = (0..2).map(|k| plan.run(k).unwrap().0).collect();
    let table = |systems: &[System], name| standard::table(&Document::of(&plan, systems), name);
    assert!(flagged(&table(&systems, "rates_contraction")).is_empty());
    assert!(flagged(&table(&systems, "rates_sweeps")).is_empty());
    let column = &mut systems[0];
    column.rates[1].measured = column.rates[1].measured.map(|rate| rate.powf(0.98));
    column.sweeps.measured = column.sweeps.measured.map(|sweeps| sweeps + 4);
    assert_eq!(flagged(&table(&systems, "rates_contraction")), [1]);
    assert_eq!(flagged(&table(&systems, "rates_sweeps")), [0]);
}
