//! The studies of solvers, compared with closed forms.

use lcplab::lcp::{Lcp, Matrix};
use lcplab::report::results::Results;
use lcplab::report::study::Study;
use lcplab::report::study::convergence::methods::Mark;
use lcplab::report::study::convergence::{Finding, Plan};
use lcplab::report::study::posed::{Loaded, STEP_SPEED, Source};
use lcplab::report::study::profiles::{self, Cost, costs, of_all, profiles};
use lcplab::report::study::trial::Attempt;
use lcplab::report::view;
use lcplab::solver::{self, Options, Registry, Start};
use lcplab::trace::Work;

use super::standard::{experiment, run_all};

/// Every kind, on problems that take milliseconds.
const SMALL: &str = r#"
title = "small"
lead = "Small."

[[section]]
study = "convergence"

[section.methods]
problems = [{ boxes = 2, ratio = 3.0 }, { family = "murty" }]
solvers = ["pgs", "newton", "dantzig", "lemke"]

[section.rows]
bodies = 5
sweeps = 8

[[section]]
study = "grid"
grid = "column"
timed = true

[[section]]
study = "profiles"
families = ["deudeu", "several", "wedged", "cps-2", "contact-graph"]
seeds = 2
scenes = [{ scene = "fig7", step = 1 }]
"#;

fn small() -> Results {
    run_all(&experiment(SMALL).unwrap())
}

fn settings<P: Study>(text: &str) -> P {
    toml::from_str(text).unwrap()
}

#[test]
fn every_kind_runs_is_drawn_and_refutes_no_claim() {
    let results = small();
    assert!(results.is_good().unwrap(), "{}", results.summary().unwrap());
    let document = view::document(&results).unwrap();
    let page = document.page.render().unwrap();
    for (id, _) in &document.tables {
        assert_eq!(document.tables.iter().filter(|(other, _)| other == id).count(), 1, "{id}");
    }
    for figure in &document.figures {
        let same = document.figures.iter().filter(|other| other.id() == figure.id());
        assert_eq!(same.count(), 1, "{}", figure.id());
        assert!(page.contains(&format!("{}-title", figure.id())));
    }
}

#[test]
fn the_results_are_the_same_every_time_but_for_the_clock() {
    let (first, second) = (small(), small());
    assert_eq!(first.sections, second.sections);
}

#[test]
fn the_top_of_the_page_names_the_cheapest_method_and_shows_the_cost_of_each() {
    let document = view::document(&small()).unwrap();
    let page = document.page.render().unwrap();
    let opening = "The problem is a stack of 2 boxes, the top one 3 times as heavy; dantzig needs the fewest multiplications";
    assert!(page.contains(opening));
    let costs = document.figures.iter().find(|own| own.id().ends_with("_costs")).unwrap().csv();
    let names: Vec<&str> =
        costs.lines().skip(1).map(|line| line.split(',').next().unwrap()).collect();
    // Four solvers, and pgs with ten sweeps.
    assert_eq!((names[0], names.len()), ("dantzig", 5), "{costs}");
}

/// Three problems and three solvers, worked out by hand:
///
/// ```text
///        a        b        c      least
/// p1     2        1        –        1
/// p2     3        failed   3        3
/// p3     failed   failed   failed   ∞
/// ```
#[test]
fn a_profile_is_the_one_worked_out_by_hand() {
    use Cost::{Failed, NotTried, Solved};
    let costs = [
        vec![Solved(2.0), Solved(1.0), NotTried],
        vec![Solved(3.0), Failed, Solved(3.0)],
        vec![Failed, Failed, Failed],
    ];
    let [a, b, c] = &profiles(&costs)[..] else { panic!("three solvers") };
    assert_eq!((a.attempted, b.attempted, c.attempted), (3, 3, 2));
    assert_eq!(a.steps, [(1.0, 1.0 / 3.0), (2.0, 2.0 / 3.0)]);
    assert_eq!(b.steps, [(1.0, 1.0 / 3.0)]);
    assert_eq!(c.steps, [(1.0, 0.5)]);
    assert!(profiles(&[]).is_empty());
    // Of all problems: c has lost p1, which it did not try. Who never tries stays out.
    let [.., c] = &profiles(&of_all(&costs))[..] else { panic!("three solvers") };
    assert_eq!((c.attempted, &c.steps[..]), (3, &[(1.0, 1.0 / 3.0)][..]));
    assert_eq!(profiles(&of_all(&[vec![Solved(1.0), NotTried]]))[1].attempted, 0);
}

#[test]
fn problems_without_solution_are_in_the_tables_and_not_in_the_profiles() {
    let plan: profiles::Plan = settings("families = [\"wedged\", \"deudeu\"]");
    let tried: Vec<_> =
        (0..2).map(|task| plan.run(task, Registry::standard()).unwrap().0).collect();
    assert!(tried[0].problems[0].impossible && !tried[1].problems[0].impossible);
    for (k, _) in plan.tolerances.iter().enumerate() {
        assert_eq!(costs(&tried, k).len(), 1);
        let claimed = |attempt: &Attempt| attempt.outcome.is_claim();
        assert!(!tried[0].problems[0].attempts[k].iter().any(claimed));
    }
}

/// A column of n rows: Dantzig's method frees one row after another, with n²/2 entries of its
/// tableau to bring up to date each time; Gauss-Seidel has 3 n − 2 entries and n divisions a sweep.
#[test]
fn work_is_what_the_formulas_say() {
    let n = 6;
    let mut entries = Vec::new();
    for i in 0..n {
        entries.push((i, i, if i == 0 { 1.0 } else { 2.0 }));
        if i > 0 {
            entries.extend([(i, i - 1, -1.0), (i - 1, i, -1.0)]);
        }
    }
    let mut b = vec![0.0; n];
    b[0] = -1.0;
    let lcp =
        Lcp::new(Matrix::sparse(n, &entries), b, vec![0.0; n], vec![f64::INFINITY; n]).unwrap();
    let work = |name: &'static str| {
        let mut work = Work::of(Registry::standard().entry(name).unwrap(), &lcp);
        let solver = solver::Registry::standard().entry(name).unwrap().build(&Options::default());
        let iterations = solver.solve(&lcp, &Start::default(), &mut work).iterations;
        (work.multiplications, iterations as f64)
    };
    let n = n as f64;
    assert_eq!(work("dantzig"), (n.powi(3) / 2.0, n));
    let (multiplications, sweeps) = work("pgs");
    assert_eq!(multiplications, sweeps * (4.0 * n - 2.0));
    let (multiplications, steps) = work("admm");
    assert_eq!(multiplications, n.powi(3) / 6.0 + steps * n * n);
}

/// From the top down, row i gets the impulse of the ground in sweep i; from the ground up, x_i =
/// b/2ⁱ after one sweep, and row i is off by the x_{i+1} that came after it.
#[test]
fn an_impulse_climbs_one_row_a_sweep_or_the_whole_column_at_once() {
    let plan: Plan = settings("[rows]\nbodies = 8\nsweeps = 9\nmethods = [\"up\", \"down\"]");
    let residuals = |task: usize| match plan.run(task, Registry::standard()).unwrap().0 {
        Finding::Rows(rows) => rows.residuals,
        other => panic!("the residuals of rows: {other:?}"),
    };
    let (up, down) = (residuals(0), residuals(1));
    for i in 0..8 {
        let reached = down[i].iter().position(|residual| *residual != 0.0);
        assert_eq!(reached, Some(i));
        let expected = if i < 7 { STEP_SPEED / 2f64.powi(i as i32 + 1) } else { 0.0 };
        assert!((up[i][1] - expected).abs() < 1e-16, "row {i}");
        assert_eq!(up[i].len(), 10);
    }
}

#[test]
fn a_load_without_mass_is_refused() {
    let error = Source::Stack(Loaded { boxes: 3, ratio: -1.0, friction: 0.5 })
        .posed()
        .err()
        .expect("a message");
    assert!(error.to_string().contains("mass"), "{error}");
}

#[test]
fn marks_go_forward_and_end_below_the_tolerance() {
    let plan: Plan = settings(
        "[methods]\nproblems = [{ family = \"stack\", values = { n = 8 } }]\n\
         solvers = [\"pgs\", \"nncg\", \"interior-point\", \"dantzig\"]",
    );
    let (Finding::Methods(progress), ()) = plan.run(0, Registry::standard()).unwrap() else {
        panic!("the progress of methods")
    };
    for method in &progress.methods {
        let forward = |a: &Mark, b: &Mark| a.iteration < b.iteration && a.work < b.work;
        assert!(method.marks.windows(2).all(|pair| forward(&pair[0], &pair[1])));
        let end = method.marks.last().unwrap();
        assert!(end.residual <= progress.tolerance, "{}", method.solver);
    }
    assert_eq!(progress.methods[3].marks.len(), 1, "of pivoting methods the end alone");
}
