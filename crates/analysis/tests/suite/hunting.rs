//! The reports of a search are true: the problem is of the requested class, a correct solver is
//! never accused, and the answer shown is the solver's own.

mod definitions;
mod planted;

use lcplab_analysis::diagnosis::MistakeKind;
use lcplab_analysis::hunt::{
    Counterexample, Finding, Friction, Given, Measure, Search, SearchResult, Target,
};
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{Law, Model};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{
    ConeEntry, ConeSolver, Entry, MatrixClass, Method, Observer, Options, Order, Pgs, Registry,
    Settings, Solution, Solver, Start, Status, Stop,
};
use lcplab_testing::boxed;

use definitions::{definiteness, is_p, natural_residual, rational};
use planted::{BUGS, Engine, Exact, Sweeps};

fn method(
    name: &'static str,
    build: impl Fn() -> Box<dyn Solver> + Send + Sync + 'static,
) -> Method {
    let mut entry = Entry::new(name, move |_| build());
    entry.class = Registry::standard().entry("pgs").unwrap().class;
    Method::Boxed(entry)
}

fn engine(sweeps: Sweeps, count: usize, says: bool) -> Method {
    method("engine", move || Box::new(Engine { sweeps, count, says }))
}

fn target(solver: Method, within: MatrixClass, with_friction: bool) -> Target {
    Target {
        measure: Measure::FalseClaim,
        solver,
        baseline: None,
        options: Options::default(),
        model: None,
        within,
        friction: if with_friction { Friction::Only } else { Friction::Any },
        allows_single_tangents: false,
        best_omega: true,
    }
}

fn result(target: &Target, seed: u64, evaluations: usize) -> SearchResult {
    let search = Search { rows: 1..=6, evaluations, seed, at_least: None, from: Vec::new() };
    search.validate(target).unwrap();
    search.run(target, &Stop::default(), &|_| ())
}

#[test]
fn a_thousand_hunts_report_problems_of_their_class_alone() {
    use MatrixClass::{Definite, General, P, Semidefinite};
    let mut reported = 0;
    for k in 0..1000_u64 {
        let class = [Definite, Semidefinite, P, General][k as usize % 4];
        let with_friction = k / 4 % 2 == 0;
        let bug = BUGS[k as usize % BUGS.len()];
        let target = target(engine(bug, 30, k % 3 == 0), class, with_friction);
        let Some(Counterexample { lcp, .. }) = result(&target, k, 40).counterexample else {
            continue;
        };
        reported += 1;
        let a = rational(&lcp);
        let is_in_class = match class {
            Definite => definiteness(a).1,
            Semidefinite => definiteness(a).0,
            P => is_p(&a),
            _ => true,
        };
        assert!(is_in_class, "{k}: {class} {lcp:?}");
        assert!(!with_friction || !lcp.contacts().is_empty(), "{k}: {lcp:?}");
        let tangents = (0..lcp.len()).filter(|&i| lcp.is_coupled(i)).count();
        assert_eq!(tangents, 2 * lcp.contacts().len(), "{k}: {lcp:?}");
    }
    assert!(reported > 500, "{reported}");
}

#[test]
fn a_right_solver_without_a_status_is_never_accused() {
    let exact = || method("exact", || Box::new(Exact));
    for (class, seeds) in [
        (MatrixClass::Definite, 60),
        (MatrixClass::Semidefinite, 40),
        (MatrixClass::P, 40),
        (MatrixClass::General, 40),
    ] {
        for seed in 0..seeds {
            let target = target(exact(), class, seed % 2 == 0);
            let SearchResult { counterexample, solved, .. } = result(&target, seed, 60);
            assert!(
                counterexample.is_none(),
                "{class}, seed {seed}: {:?}",
                counterexample.unwrap().lcp
            );
            assert!(solved > 10, "{class}, seed {seed}: {solved}");
        }
    }
}

#[test]
fn a_solver_that_runs_out_of_sweeps_is_not_accused_of_a_false_claim() {
    for seed in 0..40 {
        for (sweeps, count, says) in [
            (Sweeps::Right, 10, false),
            (Sweeps::Right, 1000, false),
            (Sweeps::Right, 3, true),
            (Sweeps::Right, 50, true),
        ] {
            let target = target(engine(sweeps, count, says), MatrixClass::Definite, seed % 2 == 0);
            let counterexample = result(&target, seed, 60).counterexample;
            assert!(
                counterexample.is_none(),
                "{sweeps:?} {count} {seed}: {:?}",
                counterexample.unwrap().lcp
            );
        }
    }
}

#[test]
fn a_planted_bug_is_found_with_its_own_answer_and_the_right_one() {
    for bug in BUGS {
        for says in [false, true] {
            let target = target(engine(bug, 200, says), MatrixClass::Definite, true);
            let counterexample =
                result(&target, 1, 2000).counterexample.unwrap_or_else(|| panic!("{bug:?}"));
            let finding = Finding::of(&counterexample, &target, 1);
            let lcp = &finding.problem.lcp;
            let own = bug.swept(lcp, 200);
            assert_eq!(finding.answer.as_ref(), Some(&own), "{bug:?}");
            let right = &finding.right.as_ref().expect("a solution").x;
            assert!(natural_residual(lcp, right) < 1e-9, "{bug:?}: {right:?} {lcp:?}");
            let apart = own.iter().zip(right).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max);
            let size = right.iter().fold(1e-300, |most: f64, x| most.max(x.abs()));
            assert!(apart > 1e-3 * size, "{bug:?}: {own:?} {right:?}");
            assert_eq!(lcp.contacts().len(), 1, "{bug:?}: {lcp:?}");
            let output = &finding.problem.to_json()["hunt"];
            assert_eq!(output["solver"], "engine");
            assert_eq!(output["x"].as_array().unwrap().len(), lcp.len());
            assert!(finding.answers().contains("x of engine"), "{}", finding.answers());
            assert!(
                finding.test.starts_with("lcplab solve PROBLEM") && !finding.test.ends_with('\n')
            );
        }
    }
}

/// The planted mistakes that have a name are named under the answers; μ/√2 is a factor of μ.
#[test]
fn the_mistake_behind_what_was_found_is_named() {
    use MistakeKind::{ClampedIncrements, FactorOfMu, FirstFriction};
    for (bug, kind) in [
        (Sweeps::MuSquared, FactorOfMu),
        (Sweeps::FirstBound, FirstFriction),
        (Sweeps::ClampedIncrements, ClampedIncrements),
        (Sweeps::OverRootTwo, FactorOfMu),
    ] {
        let target = target(engine(bug, 200, true), MatrixClass::Definite, true);
        let counterexample = result(&target, 1, 2000).counterexample.expect("a false claim");
        let finding = Finding::of(&counterexample, &target, 1);
        assert!(finding.mistakes.iter().any(|own| own.kind == kind), "{bug:?}: {finding:?}");
        let (text, first) = (finding.answers(), &finding.mistakes[0].what);
        let line = format!("  a known mistake gives the x of engine: {first}\n");
        assert!(text.contains(&line), "{text}");
    }
}

#[test]
fn every_problem_of_the_default_class_has_a_solution() {
    let mut caught = 0;
    for seed in 0..100 {
        let bug = BUGS[seed as usize % BUGS.len()];
        let target = target(engine(bug, 30, true), MatrixClass::Definite, seed % 2 == 0);
        if let Some(counterexample) = result(&target, seed, 60).counterexample {
            assert_ne!(
                all_solutions(&counterexample.lcp).map(|all| all.len()),
                Some(0),
                "{:?}",
                counterexample.lcp
            );
            caught += 1;
        }
    }
    assert!(caught > 0);
}

/// Gauss-Seidel for cones that limits friction by a square.
struct Square;

impl ConeSolver for Square {
    fn name(&self) -> &str {
        "square"
    }

    fn solve(
        &self,
        problem: &lcplab_lcp::friction::ConeProblem,
        _: &Start<'_>,
        _: &mut dyn Observer,
    ) -> Solution {
        let lcp = problem.friction().coupled_box();
        let x = Sweeps::Right.swept(&lcp, 200);
        Solution::new(&lcp, x, Status::Solved, 200).with_implied_claim(true)
    }
}

fn under_cones(solver: Method) -> Target {
    Target { model: Some(Model::CoulombCone), ..target(solver, MatrixClass::Definite, false) }
}

fn square() -> Method {
    let mut entry = ConeEntry::new("square", &[Law::Coulomb], |_| Box::new(Square));
    entry.class = Registry::standard().entry("pgs").unwrap().class;
    Method::Cone(entry)
}

#[test]
fn a_solver_of_cones_is_examined_under_the_cone() {
    let target = under_cones(square());
    let counterexample = result(&target, 1, 2000).counterexample.expect("a box is no cone");
    let finding = Finding::of(&counterexample, &target, 1);
    assert_eq!(finding.problem.model, Some(Model::CoulombCone));
    let lcp = &finding.problem.lcp;
    let contact = lcp.contacts()[0];
    let strength = |x: &[f64]| {
        let [n, t1, t2] = contact.of(x);
        t1.hypot(t2) / (contact.mu * n)
    };
    assert!(strength(finding.answer.as_ref().unwrap()) > 1.001, "{finding:?}");
    assert!(strength(&finding.right.as_ref().unwrap().x) < 1.0 + 1e-9, "{finding:?}");
    assert!(finding.equations().contains("|(x_1, x_2)| ≤"), "{}", finding.equations());
    assert!(finding.words.contains("under coulomb-cone"), "{}", finding.words);
    let honest = Registry::standard().method("cone-pgs", Some(Model::CoulombCone)).unwrap().clone();
    let SearchResult { counterexample, solved, .. } = result(&under_cones(honest), 1, 300);
    assert!(counterexample.is_none() && solved > 100, "{solved} {counterexample:?}");
}

#[test]
fn every_model_can_be_hunted_under() {
    for (name, model) in [
        ("pgs", Model::FrozenBox),
        ("pgs", Model::CoupledBox),
        ("lemke", Model::Polyhedral { directions: 4 }),
        ("lemke", Model::Polyhedral { directions: 8 }),
        ("cone-pgs", Model::AssociatedCone),
        ("cone-pgs", Model::CoulombCone),
    ] {
        let solver = Registry::standard().method(name, Some(model)).unwrap().clone();
        let target = Target { model: Some(model), ..target(solver, MatrixClass::Definite, false) };
        target.validate().unwrap();
        let SearchResult { counterexample, solved, .. } = result(&target, 3, 100);
        assert!(counterexample.is_none() && solved > 20, "{model}: {solved} {counterexample:?}");
    }
    let boxes = Target {
        model: Some(Model::CoulombCone),
        ..target(engine(Sweeps::Right, 9, true), MatrixClass::Definite, true)
    };
    let reason = boxes.validate().unwrap_err().to_string();
    assert_eq!(reason, "solver engine: model: it does not declare support for coulomb-cone");
}

fn given(lcp: &Lcp, within: Option<MatrixClass>) -> Result<Given, String> {
    let problems = [("mine.json".to_string(), Problem::new("mine", lcp.clone()))];
    Given::new(&problems, within, None).map_err(|error| error.to_string())
}

#[test]
fn a_start_outside_the_class_is_refused_and_one_beside_it_is_repaired_with_words() {
    let indefinite =
        boxed(&[&[-1e-6, 0.0], &[0.0, 3e22]], &[-1.0; 2], &[0.0; 2], &[f64::INFINITY; 2]);
    let refused = given(&indefinite, Some(MatrixClass::Semidefinite)).unwrap_err();
    assert_eq!(
        refused,
        "start: mine.json: A is not symmetric positive semidefinite, even allowing for rounding"
    );
    let free = given(&indefinite, None).unwrap();
    assert_eq!((free.within, free.notes.len()), (MatrixClass::General, 1));
    assert!(free.notes[0].ends_with("the search is not restricted to a class"), "{:?}", free.notes);
    // J Jᵀ of J = (0.3, 0.7), rounded, has a determinant below 0.
    let (p, q) = (0.3_f64, 0.7_f64);
    let rounded =
        boxed(&[&[p * p, p * q], &[p * q, q * q]], &[-1.0; 2], &[0.0; 2], &[f64::INFINITY; 2]);
    assert!(!definiteness(rational(&rounded)).1);
    let repaired = given(&rounded, Some(MatrixClass::Definite)).unwrap();
    assert!(definiteness(rational(&repaired.problems[0])).1);
    assert!(repaired.notes[0].contains("only up to rounding"), "{:?}", repaired.notes);
    // Exactly singular matrices are not changed.
    let copies = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0; 2], &[0.0; 2], &[f64::INFINITY; 2]);
    let kept = given(&copies, None).unwrap();
    assert_eq!((kept.within, kept.notes.len()), (MatrixClass::Semidefinite, 0));
    let identity = Matrix::dense(1, &[1.0]);
    let one = Lcp::new(identity, vec![-1.0], vec![0.0], vec![f64::INFINITY]).unwrap();
    assert_eq!(given(&one, None).unwrap().within, MatrixClass::Definite);
}

#[test]
fn the_scale_of_a_given_problem_stays_and_frozen_bounds_that_do_not_are_told() {
    let text = r#"{"A": {"dense": [[2,0,0],[0,1,0],[0,0,1]]}, "b": [-2,-3,0], "scale": 0.25,
                   "friction_index": [-1,0,0], "mu": [0,0.5,0.5],
                   "model": "frozen-box", "frozen_at": [7,0,0]}"#;
    let problem = Problem::parse(text, "frozen.json").unwrap();
    let given = Given::new(&[("frozen.json".into(), problem)], None, None).unwrap();
    assert!(given.notes[0].starts_with("frozen.json: frozen_at is not kept"), "{:?}", given.notes);
    let target =
        Target { model: given.model, ..target(engine(Sweeps::Right, 4, true), given.within, true) };
    let target = Target { measure: Measure::Iterations, ..target };
    let search =
        Search { rows: 3..=3, evaluations: 60, seed: 1, at_least: None, from: given.problems };
    let counterexample = search.run(&target, &Stop::default(), &|_| ()).counterexample.unwrap();
    assert_eq!(counterexample.lcp.scale(), 0.25);
}

#[test]
fn a_hunt_from_an_identity_with_friction_keeps_to_its_class() {
    // Shrinking turned this start into A = diag(−1e-6, 3e22), "semidefinite" relative to its
    // largest entry.
    let text = r#"{"A": {"dense": [[1,0,0],[0,1,0],[0,0,1]]}, "b": [-2,-3,-3],
                   "friction_index": [-1,0,0], "mu": [0,0.5,0.5]}"#;
    let problem = Problem::parse(text, "tiny_box.json").unwrap();
    for bug in BUGS.into_iter().chain([Sweeps::Right]) {
        let given = [("tiny_box.json".to_string(), problem.clone())];
        let given = Given::new(&given, Some(MatrixClass::Semidefinite), None).unwrap();
        let target = target(engine(bug, 100, true), given.within, false);
        let search =
            Search { rows: 1..=6, evaluations: 400, seed: 1, at_least: None, from: given.problems };
        search.validate(&target).unwrap();
        let counterexample = search.run(&target, &Stop::default(), &|_| ()).counterexample;
        assert_eq!(counterexample.is_some(), bug != Sweeps::Right, "{bug:?} {counterexample:?}");
        if let Some(counterexample) = counterexample {
            assert!(definiteness(rational(&counterexample.lcp)).0, "{:?}", counterexample.lcp);
        }
    }
}

/// Ends every problem without an answer.
struct Dead;

impl Solver for Dead {
    fn name(&self) -> &str {
        "dead"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let reason = "IndexError: list index out of range".into();
        Solution::new(lcp, vec![0.0; lcp.len()], Status::NoAnswer { reason }, 0)
    }
}

#[test]
fn a_solver_that_solves_nothing_is_not_passed_for_want_of_false_claims() {
    let dead = target(method("dead", || Box::new(Dead)), MatrixClass::Definite, false);
    let result = result(&dead, 1, 200);
    assert_eq!((result.counterexample.is_none(), result.solved), (true, 0));
    assert_eq!(
        result.useless("dead").unwrap(),
        "dead solves none of 200 problems; reason for the first one: no answer: IndexError: list index out of range"
    );
    let alive = target(engine(Sweeps::Right, 100, true), MatrixClass::Definite, false);
    assert_eq!(self::result(&alive, 1, 200).useless("engine"), None);
}

/// The exact solution of one row, and a crash on more.
struct Crashes;

impl Solver for Crashes {
    fn name(&self) -> &str {
        "crashes"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        if lcp.len() == 1 {
            return Exact.solve(lcp, start, observer);
        }
        let status = Status::NoAnswer { reason: "IndexError".into() };
        Solution::new(lcp, vec![0.0; lcp.len()], status, 0)
    }
}

#[test]
fn a_solver_that_crashes_is_no_honest_one() {
    let target = target(method("crashes", || Box::new(Crashes)), MatrixClass::Definite, false);
    let found = result(&target, 1, 60);
    assert!(found.counterexample.is_none() && found.unanswered > 0, "{found:?}");
    let output = found.useless("crashes").unwrap();
    assert!(output.contains("IndexError"), "{output}");
}

#[test]
fn sweeps_in_another_order_are_not_accused() {
    for order in [Order::Reverse, Order::Symmetric, Order::Shuffled { seed: 1 }] {
        for count in [4, 10, 50] {
            let build = move || -> Box<dyn Solver> { Box::new(Ordered { order, count }) };
            for seed in 0..10 {
                let target = target(method("ordered", build), MatrixClass::Definite, seed % 2 == 0);
                let counterexample = result(&target, seed, 60).counterexample;
                assert!(
                    counterexample.is_none(),
                    "{order:?} {count} {seed}: {:?}",
                    counterexample.unwrap().lcp
                );
            }
        }
    }
}

/// Plain sweeps in some order, without a status.
struct Ordered {
    order: Order,
    count: usize,
}

impl Solver for Ordered {
    fn name(&self) -> &str {
        "ordered"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let settings = Settings::default().with_max_iterations(self.count);
        let pgs = Pgs { settings, order: self.order, ..Pgs::default() };
        let x = pgs.solve(lcp, start, observer).x;
        Solution::new(lcp, x, Status::Solved, self.count).with_implied_claim(true)
    }
}
