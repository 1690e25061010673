//! The studies of solvers, held against closed forms.

use lcplab::lcp::{Lcp, Matrix};
use lcplab::report::results::Results;
use lcplab::report::study::Study;
use lcplab::report::study::attempt::{Attempt, Outcome};
use lcplab::report::study::posed::{BLOW, Source};
use lcplab::report::study::profiles::{self, Cost, costs, multiplications, of_all, profiles};
use lcplab::report::study::ratio::{self, Stack, System};
use lcplab::report::study::{plane, race, residual_map, warm_start};
use lcplab::report::view;
use lcplab::solver::{self, Options, Start, entry};
use lcplab::trace::Work;

use super::standard::{experiment, run_all};

/// Every kind, on problems that take milliseconds.
const SMALL: &str = r#"
title = "small"
lead = "Small."

[[section]]
study = "mass-ratio"
boxes = 2
ratios = [1.0, 10.0]
about = 10.0
solvers = ["pgs", "sor", "mprgp", "dantzig", "block-pivoting", "enumeration"]

[[section]]
study = "race"
problems = [{ boxes = 2, ratio = 3.0 }, { family = "murty" }]
solvers = ["pgs", "newton", "dantzig", "lemke"]

[[section]]
study = "residual-map"
bodies = 5
sweeps = 8

[[section]]
study = "grid"
grid = "column"
timed = true

[[section]]
study = "plane"
solvers = ["pgs", "dantzig"]
rows = [{ problem = { family = "pushed-rod" }, row = 2, what = "Friction" }]

[[section]]
study = "warm-start"
solvers = ["pgs", "dantzig"]
scenes = [{ scene = "incline", steps = 3 }]

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

fn only<P: Study>(plan: &P) -> P::Finding {
    plan.run(0).unwrap().0
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
fn the_words_on_the_heavy_stack_name_who_solved_it_and_who_did_not() {
    let document = view::document(&small()).unwrap();
    let page = document.page.render().unwrap();
    let from = page.find("Which solver for 2 boxes with a mass ratio of 10?").unwrap();
    let words = &page[from..from + page[from..].find("</p>").unwrap()];
    assert!(words.contains("<em>dantzig</em> with"), "{words}");
    assert!(words.contains("6 of 6 solvers solved it"), "{words}");
    assert!(words.contains("<em>pgs</em> takes"), "{words}");
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

/// p1 has a solution and p2 has none; a solves p1, b fails, c says that p1 is not for it.
#[test]
fn the_clock_of_a_family_counts_what_has_a_solution_and_was_solved() {
    let attempt = |solver: &str, outcome| Attempt {
        solver: solver.into(),
        outcome,
        iterations: 1,
        work: 1.0,
    };
    let attempts = |own: [Outcome; 3]| {
        vec!["a", "b", "c"].into_iter().zip(own).map(|(name, own)| attempt(name, own)).collect()
    };
    let (failed, outside) = (Outcome::Failed("f".into()), Outcome::Outside("o".into()));
    let posed = [
        (false, [Outcome::Accepted, failed.clone(), outside]),
        (true, [failed.clone(), failed.clone(), failed]),
    ]
    .map(|(impossible, own)| profiles::Posed {
        rows: 1,
        impossible,
        attempts: vec![attempts(own)],
    });
    let clocks = [vec![vec![0.25, 0.5, 0.125]], vec![vec![4.0, 4.0, 4.0]]];
    let seconds = profiles::seconds(&posed, &clocks, 0);
    assert_eq!(seconds, [("a".to_string(), Some(0.25)), ("b".to_string(), None)].into());
}

#[test]
fn problems_without_solution_are_in_the_tables_and_not_in_the_profiles() {
    let plan: profiles::Plan = settings("families = [\"wedged\", \"deudeu\"]");
    let tried: Vec<_> = (0..2).map(|task| plan.run(task).unwrap().0).collect();
    assert!(tried[0].problems[0].impossible && !tried[1].problems[0].impossible);
    for (k, _) in plan.tolerances.iter().enumerate() {
        assert_eq!(costs(&tried, k, multiplications).len(), 1);
        let claimed = |attempt: &Attempt| attempt.outcome.is_claim();
        assert!(!tried[0].problems[0].attempts[k].iter().any(claimed));
    }
}

/// A column of n rows: Dantzig's method frees one row after another, with n²/2 entries of its tableau to bring up to
/// date each time; Gauss-Seidel has 3 n − 2 entries and n divisions a sweep.
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
        let mut work = Work::of(entry(name).unwrap(), &lcp);
        let solver = solver::by_name(name, &Options::default()).unwrap();
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

/// Top-down, row i hears of the ground in sweep i; from the ground up, x_i = b/2ⁱ after one sweep, and
/// row i is off by the x_{i+1} that came after it.
#[test]
fn news_climbs_one_row_a_sweep_or_the_whole_column_at_once() {
    let plan: residual_map::Plan = settings("bodies = 8\nsweeps = 9\nmethods = [\"up\", \"down\"]");
    let (up, down) = (plan.run(0).unwrap().0, plan.run(1).unwrap().0);
    for i in 0..8 {
        let heard = down.residuals[i].iter().position(|residual| *residual != 0.0);
        assert_eq!(heard, (i == 0).then_some(0).or(Some(i)));
        let expected = if i < 7 { BLOW / 2f64.powi(i as i32 + 1) } else { 0.0 };
        assert!((up.residuals[i][1] - expected).abs() < 1e-16, "row {i}");
        assert_eq!(up.residuals[i].len(), 10);
    }
}

/// Two bodies: ρ = r/(1 + r); the ground carries all but ρᵏ of the weight after k sweeps; and the
/// scaled residual, ρᵏ/(2 (1 + r)) near the end, decides when it stops.
#[test]
fn two_bodies_carry_their_load_as_fast_as_theory_says() {
    let plan: ratio::Plan = settings(
        "boxes = 2\nratios = [1.0, 10.0, 100.0]\nabout = 10.0\nsolvers = [\"pgs\", \"dantzig\"]",
    );
    for (task, r) in [1.0, 10.0, 100.0].into_iter().enumerate() {
        let Stack { system, ratio, tried, .. } = plan.run(task).unwrap().0;
        assert_eq!((system, ratio), (System::TwoBodies, r));
        let rho: f64 = r / (1.0 + r);
        assert!((tried[0].rate.unwrap() - rho).abs() < 1e-7);
        for (attempt, missing) in tried[0].attempts.iter().zip(&tried[0].missing) {
            let left = rho.powi(attempt.iterations as i32);
            assert!((missing.unwrap() - left).abs() < 1e-9 + 1e-6 * left, "{attempt:?}");
        }
        let expected = ((2.0 * (1.0 + r) * 1e-8).ln() / rho.ln()).ceil() as usize;
        assert!(tried[0].attempts[1].iterations.abs_diff(expected) <= 1);
        assert_eq!(tried[1].attempts[1].outcome, Outcome::Proved);
        assert!(tried[1].missing[1].unwrap().abs() < 1e-12);
    }
}

/// At a ratio of 10⁴ a scaled residual of 1e-4 leaves most of the weight hanging, by the formula above:
/// nobody may claim a solution there. Sweeps go on until the step, which is ρᵏ of the first one, has fallen to a tenth,
/// and then as much of the weight is missing.
#[test]
fn a_residual_that_is_small_because_the_load_is_large_is_not_claimed() {
    let plan: ratio::Plan = settings("boxes = 2\nratios = [1e4]\nabout = 1e4\nsolvers = [\"pgs\"]");
    let found = only(&plan);
    assert!(found.tried[0].attempts[0].outcome.is_solved());
    let missing = found.tried[0].missing[0].unwrap();
    assert!(0.05 < missing && missing < 0.2, "{missing}");
    assert!(found.tried[0].attempts[1].outcome.is_solved());
}

#[test]
fn a_load_on_boxes_is_carried_by_the_ground() {
    let plan: ratio::Plan = settings(
        "boxes = 3\nratios = [20.0]\nabout = 20.0\nsolvers = [\"dantzig\", \"lemke\", \"mprgp\"]",
    );
    let stack = plan.run(1).unwrap().0;
    assert_eq!((stack.system, stack.rows), (System::Boxes, 36));
    for tried in &stack.tried {
        assert!(tried.attempts.iter().all(|attempt| attempt.outcome.is_solved()), "{tried:?}");
        assert!(tried.missing[1].unwrap().abs() < 1e-6, "{tried:?}");
    }
    let error = Source::Stack(lcplab::report::study::posed::Loaded { boxes: 3, ratio: -1.0 }).lcp();
    assert!(error.unwrap_err().to_string().contains("mass"));
}

#[test]
fn the_first_step_of_a_simulation_is_as_cold_as_cold_can_be() {
    let plan: warm_start::Plan = settings(
        "solvers = [\"pgs\"]\nscenes = [{ scene = \"stack\", steps = 4 }]\ntolerance = 1e-5",
    );
    let run = only(&plan);
    assert!(view::View::outcome(&plan, std::slice::from_ref(&run)).good);
    let broken = warm_start::Run { failure: Some("no step".into()), ..run.clone() };
    assert!(!view::View::outcome(&plan, &[broken]).good);
    assert_eq!((run.steps.len(), run.failure), (4, None));
    assert_eq!(run.steps[0].warm, run.steps[0].cold);
    assert!(run.steps[1].warm < run.steps[1].cold);
}

/// The graph of the law is where every solver ends.
#[test]
fn all_paths_end_on_the_law() {
    let plan: plane::Plan = settings(
        "solvers = [\"pgs\", \"apgd\", \"dantzig\"]\n\
         rows = [{ problem = { family = \"pushed-rod\" }, row = 2, what = \"friction\" }]",
    );
    let row = only(&plan);
    let [Some(lo), Some(hi)] = row.bounds else { panic!("friction has bounds: {row:?}") };
    assert!(lo < 0.0 && hi == -lo);
    for path in &row.paths {
        let (x, w) = *path.points.last().unwrap();
        let near = |a: f64, b: f64| (a - b).abs() < 1e-6;
        let sticks = lo <= x && x <= hi && near(w, 0.0);
        assert!(sticks || (near(x, lo) && w > 0.0) || (near(x, hi) && w < 0.0), "{path:?}");
    }
    let missing: plane::Plan = settings(
        "solvers = [\"pgs\"]\nrows = [{ problem = { family = \"deudeu\" }, row = 9, what = \"\" }]",
    );
    assert!(missing.run(0).unwrap_err().to_string().contains("2 rows, this is 9"));
}

#[test]
fn marks_of_a_race_go_forward_and_end_where_it_was_asked() {
    let plan: race::Plan = settings(
        "problems = [{ family = \"stack\", values = { n = 8 } }]\n\
         solvers = [\"pgs\", \"nncg\", \"interior-point\", \"dantzig\"]",
    );
    let (race, clock) = plan.run(0).unwrap();
    for (runner, (name, times)) in race.runners.iter().zip(&clock.runners) {
        assert_eq!(&runner.solver, name);
        assert_eq!(runner.marks.len(), times.len());
        let forward = |a: &race::Mark, b: &race::Mark| a.iteration < b.iteration && a.work < b.work;
        assert!(runner.marks.windows(2).all(|pair| forward(&pair[0], &pair[1])));
        assert!(times.windows(2).all(|pair| pair[0].0 <= pair[1].0));
        assert!(runner.marks.last().unwrap().residual <= race.tolerance, "{name}");
    }
    assert_eq!(race.runners[3].marks.len(), 1, "of pivoting methods the end alone");
}
