//! Sweeps beside closed forms.

use std::f64::consts::FRAC_PI_2;

use lcplab::report::grid::{Finding, Grid, Task};

use super::found;

#[test]
fn the_error_left_on_two_bodies_is_that_of_the_closed_form() {
    let shipped = Grid::load("ratio").unwrap();
    let text = include_str!("../../../../grids/ratio.toml");
    assert_eq!(shipped.plan().unwrap().tasks.len(), 55);
    for (task, finding) in found(text) {
        let [r, k] = ["ratio", "solver.max_iterations"].map(|path| task.number(path).unwrap());
        let expected = (r / (1.0 + r)).powf(k);
        let (error, predicted) =
            (finding.get("error").unwrap(), finding.predicted("error").unwrap());
        assert!((error - expected).abs() < 1e-13, "r = {r}, k = {k}: {error}, not {expected}");
        assert!((predicted.value - expected).abs() < 1e-13);
        assert_eq!(predicted.holds(error), Some(true));
        assert_eq!(predicted.holds(error + 1e-9), Some(false), "a wrong error is reported");
    }
}

#[test]
fn benchmarks_of_a_ratio_of_100() {
    let text = "family = 'stack'\n[set]\nn = 2\nratio = 100\nsolver.name = 'pgs'\n\
                solver.tolerance = 0\n[axes]\nsolver.max_iterations = [4, 10, 30, 50]";
    let errors: Vec<String> =
        found(text).iter().map(|(_, f)| format!("{:.3}", f.get("error").unwrap())).collect();
    assert_eq!(errors, ["0.961", "0.905", "0.742", "0.608"]);
}

/// ρ_J of a chain of n rods hung at one end.
fn jacobi(n: f64) -> f64 {
    (FRAC_PI_2 / n).cos()
}

fn optimal_omega(n: f64) -> f64 {
    2.0 / (1.0 + (FRAC_PI_2 / n).sin())
}

#[test]
fn the_fewest_sweeps_on_a_chain_are_at_the_next_point_to_youngs_omega() {
    let text =
        include_str!("../../../../grids/omega.toml").replace("[5, 10, 20, 40]", "[5, 10, 20]");
    let all = found(&text);
    for n in [5.0, 10.0, 20.0] {
        let chain = all.iter().filter(|(task, _)| task.number("generate.links") == Some(n));
        let sweeps = |(_, f): &&(Task, Finding)| f.get("iterations").unwrap() as usize;
        let (task, finding) = chain.min_by_key(sweeps).unwrap();
        let (best, expected) = (task.number("solver.omega").unwrap(), optimal_omega(n));
        assert!((best - expected).abs() <= 0.02, "n = {n}: {best}, not {expected}");
        assert!((finding.get("optimum").unwrap() - expected).abs() < 1e-14);
        assert_eq!((finding.status.as_str(), finding.get("rejected")), ("solved", Some(0.0)));
    }
}

/// Between two tolerances only the slowest kind of error is left: 1e-4 takes ln 1e-4 / ln ρ sweeps.
#[test]
fn four_more_digits_take_as_many_sweeps_as_the_spectral_radius_says() {
    let text = "scene = 'chain'\nsteps = 1\n[set]\ngravity = [9.81, 0, 0]\nsolver.name = 'sor'\n\
                generate.links = 10\n[axes]\nsolver.omega = [1.0, 1.3, 1.6, 1.9]\n\
                solver.tolerance = [1e-5, 1e-9]";
    let all = found(text);
    for pair in all.chunks(2) {
        let omega = pair[0].0.number("solver.omega").unwrap();
        let more = pair[1].1.get("iterations").unwrap() - pair[0].1.get("iterations").unwrap();
        let mu = omega * jacobi(10.0);
        let radius = match mu * mu - 4.0 * (omega - 1.0) {
            root if root > 0.0 => ((mu + root.sqrt()) / 2.0).powi(2),
            _ => omega - 1.0,
        };
        let expected = 1e-4_f64.ln() / radius.ln();
        assert!((more / expected - 1.0).abs() < 0.05, "ω = {omega}: {more}, not {expected:.1}");
    }
}

#[test]
fn a_closed_form_is_silent_where_it_does_not_hold() {
    let text =
        "family = 'contact-graph'\ntheory = 'young'\n[axes]\nsolver.name = ['pgs', 'dantzig']";
    assert!(found(text).iter().all(|(_, finding)| finding.predicted.is_empty()));
}

/// ρ_J, ρ_GS, ω* and ρ(ω*) of benchmarks 4.3.
const COLUMNS: [(f64, [f64; 4]); 3] = [
    (5.0, [0.951057, 0.904508, 1.527864, 0.527864]),
    (10.0, [0.987688, 0.975528, 1.729454, 0.729454]),
    (20.0, [0.996917, 0.993844, 1.854498, 0.854498]),
];

fn column() -> Vec<(Task, Finding)> {
    found(include_str!("../../../../grids/column.toml"))
}

/// What was found for a solver and `n` bodies.
fn at<'a>(all: &'a [(Task, Finding)], solver: &str, n: f64) -> &'a (Task, Finding) {
    let is_it = |(task, _): &&(Task, Finding)| {
        task.text("solver.name") == Some(solver) && task.number("n") == Some(n)
    };
    all.iter().find(is_it).unwrap()
}

#[test]
fn columns_have_the_published_rates_by_theory_as_eigenvalues_and_as_slopes() {
    let all = column();
    for (n, [jacobi, gauss_seidel, omega, best]) in COLUMNS {
        for (solver, published) in [("jacobi", jacobi), ("pgs", gauss_seidel), ("sor", best)] {
            let (task, finding) = at(&all, solver, n);
            let predicted = finding.predicted("rate").unwrap().value;
            // At ω* the root of the precision of ω, which has eleven digits in the file.
            assert!((predicted - published).abs() < 2e-6, "{solver}, n = {n}: {predicted}");
            let eigenvalue = finding.get("eigenvalue").unwrap();
            assert!((eigenvalue - published).abs() < 2e-6, "{solver}, n = {n}: {eigenvalue}");
            let lag = 1.0 - finding.get("rate").unwrap().ln() / published.ln();
            if solver == "sor" {
                assert!((task.number("solver.omega").unwrap() - omega).abs() < 5e-7);
                // The line of least squares through ln k over K/2 … K rises by 1.364/K; there ρ^K
                // is about 1e-11.
                let late = 1.364 / -1e-11f64.ln();
                assert!(0.5 * late < lag && lag < 2.0 * late, "n = {n}: {lag}, not {late}");
            } else {
                assert!(lag.abs() < 1e-3, "{solver}, n = {n}: {lag}");
            }
        }
    }
}

/// The slowest kind of error has 2/n of the start in the ground's row, whose terms add up to 2 n.
#[test]
fn columns_take_the_sweeps_of_the_formula_and_pivots_once_a_body() {
    let all = column();
    for n in [5.0, 10.0, 20.0, 40.0, 80.0] {
        let rate = (FRAC_PI_2 / n).cos().powi(2);
        let expected = ((1e-8 * n * n).ln() / rate.ln()).ceil();
        let (_, pgs) = at(&all, "pgs", n);
        assert_eq!(pgs.predicted("iterations").unwrap().value, expected);
        assert!((pgs.get("iterations").unwrap() - expected).abs() <= 1.0, "n = {n}");
        let (_, dantzig) = at(&all, "dantzig", n);
        assert_eq!(dantzig.get("iterations"), Some(n));
        assert_eq!(dantzig.get("work"), Some(n.powi(3) / 2.0));
        assert!(dantzig.predicted.is_empty() && dantzig.get("rate").is_none());
    }
    assert!(all.iter().all(|(_, finding)| finding.claims().all(|held| held)));
}

/// Left of ω* the product of the two eigenvalues of SOR for ±ρ_J is (ω − 1)², and their sum is
/// ω²ρ_J² − 2(ω − 1).
#[test]
fn the_relaxation_factor_does_what_young_says() {
    let text = "family = 'stack'\ntheory = 'young'\nmeasure = 'rate'\n[set]\nn = 10\n\
                solver.name = 'sor'\nsolver.tolerance = 1e-8\nsolver.max_iterations = 100000\n\
                [axes]\nsolver.omega = [0.5, 1.0, 1.5, 1.9]";
    for (task, finding) in found(text) {
        let omega = task.number("solver.omega").unwrap();
        let predicted = finding.predicted("rate").unwrap().value;
        assert!((finding.get("eigenvalue").unwrap() - predicted).abs() < 1e-6, "ω = {omega}");
        if omega < optimal_omega(10.0) {
            let other = (omega - 1.0).powi(2) / predicted;
            let sum = (omega * jacobi(10.0)).powi(2) - 2.0 * (omega - 1.0);
            assert!((predicted + other - sum).abs() < 1e-12);
            let digits = finding.get("rate").unwrap().ln() / predicted.ln();
            assert!((digits - 1.0).abs() < 1e-3, "ω = {omega}: {digits}");
        } else {
            assert!((predicted - 0.9).abs() < 1e-15);
        }
    }
}

/// Two bodies stop where ρᵏ/(2 (1 + r)) is the tolerance.
#[test]
fn two_bodies_take_the_sweeps_of_their_closed_form() {
    let text = "family = 'stack'\ntheory = 'mass-ratio'\nmeasure = ['iterations', 'rate']\n[set]\n\
                n = 2\nsolver.name = 'pgs'\nsolver.tolerance = 1e-8\n\
                solver.max_iterations = 1000000\n[axes]\nratio = [1, 10, 100, 1000]";
    for (task, finding) in found(text) {
        let r = task.number("ratio").unwrap();
        let expected = ((2.0 * (1.0 + r) * 1e-8).ln() / (r / (1.0 + r)).ln()).ceil();
        let sweeps = finding.get("iterations").unwrap();
        assert!((sweeps - expected).abs() <= 1.0, "r = {r}: {sweeps}, not {expected}");
        assert!(finding.claims().count() == 3 && finding.claims().all(|held| held));
    }
}
