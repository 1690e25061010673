//! A search finds known problems from random starts, and shrinks them.

use std::ops::RangeInclusive;

use lcplab_analysis::hunt::{Counterexample, Finding, Friction, Measure, Search, Target};
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::file::Expected;
use lcplab_lcp::library;
use lcplab_lcp::{Lcp, merit};
use lcplab_solver::theory::optimal_omega;
use lcplab_solver::{
    Entry, MatrixClass, Method, Observer, Options, Registry, Settings, Solution, Solver, Start,
    Status, Stop,
};

/// A plain projected Gauss-Seidel with one mistake.
#[derive(Clone, Copy)]
enum Mistaken {
    ClampsAfterTheSweep,
    NeverRenewsTheFrictionBounds,
    AddsInSinglePrecision,
}

impl Solver for Mistaken {
    fn name(&self) -> &str {
        "mistaken"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let n = lcp.len();
        let mut x = vec![0.0; n];
        let first = x.clone();
        for sweep in 1..=1000 {
            let before = x.clone();
            for i in 0..n {
                let w = match self {
                    Mistaken::AddsInSinglePrecision => {
                        let terms = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]) as f32);
                        f64::from(terms.sum::<f32>() + lcp.b()[i] as f32)
                    }
                    _ => lcp.row_w(i, &x),
                };
                if lcp.matrix().diagonal(i) <= 0.0 {
                    return Solution::new(lcp, x, Status::ZeroDiagonal { row: i }, sweep);
                }
                let free = x[i] - w / lcp.matrix().diagonal(i);
                x[i] = match self {
                    Mistaken::ClampsAfterTheSweep => free,
                    Mistaken::NeverRenewsTheFrictionBounds => lcp.project(i, free, &first),
                    Mistaken::AddsInSinglePrecision => lcp.project(i, free, &x),
                };
            }
            if matches!(self, Mistaken::ClampsAfterTheSweep) {
                lcp.project_all(&mut x);
            }
            let moved = x.iter().zip(&before).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            if !moved.is_finite() || x.iter().any(|x| !x.is_finite()) {
                return Solution::new(lcp, before, Status::Diverged, sweep);
            }
            if matches!(self, Mistaken::NeverRenewsTheFrictionBounds) {
                if merit::scaled_residual(&lcp.frozen_at(&first), &x) <= 1e-9 {
                    return Solution::new(lcp, x, Status::Solved, sweep);
                }
                continue;
            }
            if moved <= 1e-14 * x.iter().fold(0.0, |most: f64, x| most.max(x.abs())) {
                return Solution::new(lcp, x, Status::Solved, sweep);
            }
        }
        Solution::new(lcp, x, Status::IterationLimit, 1000)
    }
}

fn mistaken(mistake: Mistaken) -> Entry {
    let mut entry = Entry::new("mistaken", move |_| Box::new(mistake));
    let pgs = Registry::standard().entry("pgs").unwrap();
    (entry.class, entry.group) = (pgs.class, pgs.group);
    entry
}

fn target(
    measure: Measure,
    solver: Entry,
    baseline: Option<&str>,
    max_iterations: usize,
) -> Target {
    let settings = Settings::default().with_max_iterations(max_iterations);
    Target {
        measure,
        solver: Method::Boxed(solver),
        baseline: baseline
            .map(|name| Method::Boxed(Registry::standard().entry(name).unwrap().clone())),
        options: Options::default().with_settings(settings),
        model: None,
        within: MatrixClass::General,
        friction: Friction::Any,
        allows_single_tangents: false,
        best_omega: true,
    }
}

fn search(
    target: &Target,
    rows: RangeInclusive<usize>,
    evaluations: usize,
) -> Option<Counterexample> {
    let search = Search { rows, evaluations, seed: 1, at_least: None, from: Vec::new() };
    search.validate(target).unwrap();
    search.run(target, &Stop::default(), &|_| ()).counterexample
}

#[test]
fn three_planted_mistakes_are_found_and_shrunk_to_a_contact_or_two() {
    for (mistake, rows) in [
        (Mistaken::ClampsAfterTheSweep, 2), // one row clamped late is clamped all the same
        (Mistaken::NeverRenewsTheFrictionBounds, 3), // a normal and two tangents
        (Mistaken::AddsInSinglePrecision, 2),
    ] {
        let target = target(Measure::FalseClaim, mistaken(mistake), None, 1000);
        let counterexample = search(&target, 1..=8, 20_000).expect("a false claim");
        assert!(
            counterexample.lcp.len() <= rows,
            "{} rows: {:?}",
            counterexample.lcp.len(),
            counterexample.lcp
        );
        assert!(target.score(&counterexample.lcp, 1000).is_found);
        assert!(all_solutions(&counterexample.lcp).is_some());
    }
}

#[test]
fn the_wrong_fixed_point_of_code_6_is_found() {
    let target =
        target(Measure::Failure, Registry::standard().entry("code6").unwrap().clone(), None, 1000);
    let counterexample = search(&target, 2..=5, 20_000).expect("a failure");
    assert_eq!(counterexample.lcp.len(), 2);
}

#[test]
fn an_honest_solver_is_not_caught() {
    let target =
        target(Measure::FalseClaim, Registry::standard().entry("pgs").unwrap().clone(), None, 500);
    assert!(search(&target, 1..=4, 4000).is_none());
}

#[test]
fn a_problem_of_ones_own_is_made_smaller_until_only_the_mistake_is_left() {
    // A pile of 36 rows, on which friction bounds that are never updated are wrong.
    let family = library::by_name("friction-pile").unwrap();
    let pile = family.generate(&[("bodies", 8.0), ("contacts", 12.0)]).unwrap().lcp;
    assert!(pile.len() >= 36);
    let solver = mistaken(Mistaken::NeverRenewsTheFrictionBounds);
    let target =
        Target { friction: Friction::Only, ..target(Measure::FalseClaim, solver, None, 1000) };
    let from = vec![pile];
    let search = Search { rows: 1..=6, evaluations: 3000, seed: 1, at_least: None, from };
    let counterexample =
        search.run(&target, &Stop::default(), &|_| ()).counterexample.expect("a false claim");
    assert_eq!((counterexample.evaluation, counterexample.rows_at_first >= 36), (1, true));
    assert_eq!(counterexample.lcp.len(), 3); // a normal and two tangents
    assert_eq!(counterexample.lcp.contacts().len(), 1);
    assert!(counterexample.value >= 0.1 * counterexample.value_at_first);
    let mu = counterexample.lcp.coupling().unwrap();
    assert!((0..3).all(|i| mu.index(i).is_some() || mu.mu(i) == 0.0));
}

#[test]
fn a_small_lie_does_not_end_a_search_for_a_large_one() {
    let solver = mistaken(Mistaken::AddsInSinglePrecision);
    let target = target(Measure::FalseClaim, solver, None, 1000);
    let counterexample = enough(&target, 1..=4, 1e-3);
    assert!(counterexample.value >= 1e-3 && target.score(&counterexample.lcp, 1000).value >= 1e-3);
}

#[test]
fn what_is_within_the_tolerance_that_was_asked_for_is_no_lie() {
    let mut target =
        target(Measure::FalseClaim, mistaken(Mistaken::AddsInSinglePrecision), None, 1000);
    let counterexample = search(&target, 1..=4, 20_000).expect("a false claim");
    target.options.settings.tolerance = 2.0 * counterexample.value;
    assert!(!target.score(&counterexample.lcp, 1000).is_found);
    target.options.settings.tolerance = 0.5 * counterexample.value;
    assert!(target.score(&counterexample.lcp, 1000).is_found);
}

/// The same with an upper limit of the measure; `docs/hunt.md` has the results of the complete
/// search.
fn enough(target: &Target, rows: RangeInclusive<usize>, at_least: f64) -> Counterexample {
    let search =
        Search { rows, evaluations: 20_000, seed: 1, at_least: Some(at_least), from: Vec::new() };
    search.run(target, &Stop::default(), &|_| ()).counterexample.expect("a ratio")
}

#[test]
fn a_matrix_is_found_on_which_least_index_pivoting_takes_many_pivots_and_block_pivoting_few() {
    let target = target(
        Measure::Ratio,
        Registry::standard().entry("murty").unwrap().clone(),
        Some("block-pivoting"),
        1000,
    );
    let counterexample = enough(&target, 6..=6, 12.0);
    let pivots = |name: &str| {
        let solver = Registry::standard().entry(name).unwrap().build(&Options::default());
        solver.solve(&counterexample.lcp, &Start::default(), &mut ()).iterations
    };
    let (murty, block) = (pivots("murty"), pivots("block-pivoting"));
    assert_eq!(murty as f64 / block.max(1) as f64, counterexample.value);
    assert!(counterexample.value >= 12.0, "{murty} {block}");
}

#[test]
fn two_rows_are_found_on_which_gauss_seidel_takes_a_hundred_times_the_sweeps_of_the_best_sor() {
    let target = target(
        Measure::Ratio,
        Registry::standard().entry("pgs").unwrap().clone(),
        Some("sor"),
        10_000_000,
    );
    let counterexample = enough(&target, 2..=3, 100.0);
    assert!(counterexample.value >= 100.0, "{}", counterexample.value);
    // Young: with rho of Jacobi, ln rho^2 of Gauss-Seidel beside ln (omega* - 1) of the best SOR.
    let a = counterexample.lcp.matrix();
    if counterexample.lcp.len() == 2 {
        let jacobi = (a.entry(0, 1) * a.entry(1, 0) / (a.diagonal(0) * a.diagonal(1))).sqrt();
        let best = optimal_omega(jacobi) - 1.0;
        let ratio = best.ln() / (jacobi * jacobi).ln();
        assert!(
            (0.3..3.0).contains(&(counterexample.value / ratio)),
            "{} {ratio}",
            counterexample.value
        );
    }
}

#[test]
fn what_was_found_is_explained_with_its_exact_solution() {
    let target = target(Measure::FalseClaim, mistaken(Mistaken::ClampsAfterTheSweep), None, 1000);
    let counterexample = search(&target, 2..=2, 2000).expect("a false claim");
    let finding = Finding::of(&counterexample, &target, 1);
    let solutions = Expected::of(&finding.problem).unwrap().solutions;
    assert_eq!(solutions.len(), all_solutions(&counterexample.lcp).unwrap().len());
    assert!(
        finding.words.starts_with("mistaken says: solved, but the scaled residual is "),
        "{}",
        finding.words
    );
    assert!(finding.equations().starts_with("  w_0 = "), "{}", finding.equations());
    assert!(finding.test.contains("fn false_claim_of_mistaken()"));
}
