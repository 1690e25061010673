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
        let (error, predicted) = (finding.get("error").unwrap(), finding.get("predicted").unwrap());
        assert!((error - expected).abs() < 1e-13, "r = {r}, k = {k}: {error}, not {expected}");
        assert!((predicted - expected).abs() < 1e-13);
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
        assert_eq!((finding.status.as_str(), finding.get("refuted")), ("solved", Some(0.0)));
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
    assert!(found(text).iter().all(|(_, finding)| finding.get("predicted").is_none()));
}
