//! Tests solvers for false claims, and tests that the hunt detects false claims.

use lcplab_analysis::hunt::cone::{ConeTruth, contact};
use lcplab_analysis::hunt::{Claim, FalseClaim, Hunt, KINDS, Progress, Tally, claims, problem};
use lcplab_judge::{Demand, judge_cone};
use lcplab_lcp::{Complementarity, Lcp};
use lcplab_solver::{
    Enumeration, Observer, Options, Pgs, Registry, Settings, Solution, Solver, Start, Status, Stop,
    all_solutions,
};

use lcplab_testing::{INF, boxed};

/// Always gives the same answer.
struct Liar(Status, f64);

impl Solver for Liar {
    fn name(&self) -> &str {
        "liar"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        Solution::new(lcp, vec![self.1; lcp.len()], self.0.clone(), 1)
    }
}

fn said(lcp: &Lcp, status: Status, x: f64) -> Claim {
    let honest = Box::new(Enumeration::default());
    let solvers: [Box<dyn Solver>; 2] = [Box::new(Liar(status, x)), honest];
    claims(lcp, None, &solvers, 1e-8).swap_remove(0).1
}

#[test]
fn no_solver_lies_about_ten_thousand_hostile_problems() {
    let settings = Settings::default().with_max_iterations(500);
    let options = Options::default().with_settings(settings);
    let solvers: Vec<_> =
        Registry::standard().entries().map(|entry| entry.build(&options)).collect();
    let record = Hunt { numbers: 0..10_000, seed: 8, tolerance: 1e-8 }.of(&solvers, &|| ());
    assert_eq!(record.problems, 10_000);
    for tally in &record.tallies {
        assert_eq!(tally.false_claim_count, 0, "{} {:?}", tally.solver, tally.false_claims);
        assert!(tally.proved > 2_000, "{} proved {} only", tally.solver, tally.proved);
    }
}

#[test]
fn a_wrong_answer_called_solved_is_noticed() {
    let lcp = boxed(&[&[2.0]], &[-6.0], &[0.0], &[INF]); // x = 3
    assert_eq!(said(&lcp, Status::Solved, 3.0), Claim::Proved);
    assert_eq!(said(&lcp, Status::Solved, 3.0 + 3e-9), Claim::Proved); // the active set is right
    let lie = FalseClaim::Rejected { row: 0, amount: 0.5 }; // |x − 0|·2 over 2 + 6 … of 1: (6 − 2)/8
    assert_eq!(said(&lcp, Status::Solved, 1.0), Claim::FalseClaim(lie));
    assert_eq!(said(&lcp, Status::Solved, f64::NAN), Claim::FalseClaim(FalseClaim::NotFinite));
    assert_eq!(said(&lcp, Status::Inaccurate, 1.0), Claim::Unsolved);
}

#[test]
fn a_denied_solution_is_noticed() {
    let lcp = boxed(&[&[2.0]], &[-6.0], &[0.0], &[INF]);
    assert_eq!(said(&lcp, Status::NoSolution, 0.0), Claim::FalseClaim(FalseClaim::DeniedASolution));
    // w = −1 for any x: no solution, and 1 is the Farkas vector.
    let lcp = boxed(&[&[0.0]], &[-1.0], &[0.0], &[INF]);
    assert_eq!(said(&lcp, Status::NoSolution, 0.0), Claim::Impossible);
    let ray = Status::Ray { row: 0, direction: vec![1.0] };
    assert_eq!(said(&lcp, ray, 0.0), Claim::Impossible);
    // A wrong vector leads the judge to the right one, and to nothing if there is a solution.
    let ray = || Status::Ray { row: 0, direction: vec![-1.0] };
    assert_eq!(said(&lcp, ray(), 0.0), Claim::Impossible);
    let lcp = boxed(&[&[2.0]], &[-6.0], &[0.0], &[INF]);
    assert_eq!(said(&lcp, ray(), 0.0), Claim::Unsolved);
}

#[test]
fn an_answer_far_away_to_a_problem_without_one_is_no_answer() {
    // w = (x1 − x2 − 1, x2 − x1 − 1) ≥ 0 asks for x1 − x2 ≥ 1 and ≤ −1; 1e9 loses both in its
    // terms.
    let lcp = boxed(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -1.0], &[0.0; 2], &[INF; 2]);
    assert_eq!(all_solutions(&lcp).unwrap().len(), 0);
    assert_eq!(said(&lcp, Status::Solved, 1e9), Claim::FalseClaim(FalseClaim::Worthless));
}

#[test]
fn an_answer_to_a_problem_that_misses_a_solution_by_less_than_the_tolerance_is_refused() {
    // x1 = 1 and x1 = 1 + 1e-10: the residual of x = 1 is 5e-11, and no x solves both.
    let lcp = boxed(&[&[1.0, 0.0], &[1.0, 0.0]], &[-1.0, -1.0 - 1e-10], &[-INF; 2], &[INF; 2]);
    assert_eq!(said(&lcp, Status::Solved, 1.0), Claim::Refused);
    assert_eq!(said(&lcp, Status::NoSolution, 0.0), Claim::Impossible);
}

#[test]
fn a_bound_that_is_missed_is_seen_beside_terms_of_any_size() {
    // w1 = −1e300 x1 + e x2, w2 = e x1 + 3, x1 ≥ 0, x2 ≥ −2, e = 5e-324: w2 > 0 requires x2 = −2,
    // and then w1 < 0 for any x1. At 0 row 2 violates its bound completely, though in units of 3/e
    // hardly at all.
    let (a, e) = (-1e300, 5e-324);
    let lcp = boxed(&[&[a, e], &[e, 0.0]], &[0.0, 3.0], &[0.0, -2.0], &[INF; 2]);
    assert_eq!(all_solutions(&lcp).unwrap().len(), 0);
    assert_eq!(said(&lcp, Status::NoSolution, 0.0), Claim::Impossible);
    let rejected = FalseClaim::Rejected { row: 1, amount: 1.0 };
    assert_eq!(said(&lcp, Status::Solved, 0.0), Claim::FalseClaim(rejected));
}

#[test]
fn the_judge_of_cones_knows_a_contact_in_any_units() {
    let accepts = |truth: &ConeTruth, x: [f64; 3]| {
        judge_cone(&truth.problem, &x, &Demand::default()).verdict.is_solution()
    };
    let truths: Vec<ConeTruth> = (0..3000).map(|k| contact(1, k)).collect();
    for (k, truth) in truths.iter().enumerate() {
        let [n, t1, t2] = truth.x;
        assert!(accepts(truth, truth.x), "{k}: {truth:?}");
        // Friction that changes the slip by less than the tolerance cannot be detected in it.
        let slip = truth.problem.lcp().b()[1].hypot(truth.problem.lcp().b()[2]);
        let brake = truth.problem.lcp().matrix().diagonal(1) * t1.hypot(t2);
        if truth.slides && brake > 1e-6 * slip {
            for wrong in [[n, 0.0, 0.0], [n, -t1, -t2], [n, 0.5 * t1, 0.5 * t2], [n, t2, -t1]] {
                assert!(!accepts(truth, wrong), "{k}: {wrong:?} {truth:?}");
            }
        }
        if n > 0.0 {
            assert!(!accepts(truth, [0.5 * n, t1, t2]), "{k}: {truth:?}");
        }
    }
    assert!(truths.iter().filter(|truth| truth.slides).count() > 300);
}

#[test]
fn no_solver_of_cones_lies_about_a_contact_in_any_units() {
    for entry in Registry::standard().cone_entries() {
        let solver = entry.build(&Settings::default());
        let mut solved = 0;
        for (k, truth) in (0..1000).map(|k| (k, contact(2, k))) {
            let solution = solver.solve(&truth.problem, &Start::default(), &mut ());
            if solution.status != Status::Solved {
                continue;
            }
            solved += 1;
            let size = truth.x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            for (x, exact) in solution.x.iter().zip(truth.x) {
                assert!((x - exact).abs() <= 1e-6 * size, "{} {k}: {x} {truth:?}", entry.name);
            }
        }
        assert!(solved > 700, "{} solved {solved} of 1000 only", entry.name);
    }
}

#[test]
fn a_hunt_counts_each_contact_of_each_solver_of_cones_once() {
    let settings = Settings::default().with_max_iterations(2000);
    let tallies = |contacts, settings| -> Vec<Tally> {
        let hunt = Hunt { numbers: 0..0, seed: 6, tolerance: 1e-8 };
        hunt.with_cones(contacts, &Stop::default(), settings, &Progress::default()).tallies
    };
    let [few, all] = [100, 200].map(|contacts| tallies(contacts, &settings));
    for (few, all) in few.iter().zip(&all) {
        assert_eq!(few.within + few.unsolved, 100);
        assert_eq!(
            (all.within + all.unsolved, all.false_claim_count),
            (200, 0),
            "{:?}",
            all.false_claims
        );
        assert!(all.within >= few.within && all.within > 140, "{}: {}", all.solver, all.within);
    }
    // Without any steps only a start that is the answer is claimed.
    let none = Settings::default().with_max_iterations(0);
    assert!(
        tallies(200, &none).iter().all(|tally| tally.unsolved > 50 && tally.false_claim_count == 0)
    );
}

#[test]
fn a_problem_depends_on_its_seed_and_number_alone() {
    for k in [0, 7, 123] {
        let [(one, start), (other, again)] = [problem(3, k), problem(3, k)];
        assert_eq!(one.b(), other.b());
        assert_eq!(start, again);
    }
    let different = (0..100).filter(|&k| problem(3, k).0.b() != problem(4, k).0.b()).count();
    assert!(different > 80, "{different}");
}

#[test]
fn the_kinds_hold_what_they_promise() {
    let of = |name: &str| {
        let first = KINDS.iter().position(|kind| kind.name == name).unwrap();
        (0..60).map(move |k| problem(5, first + k * KINDS.len()).0)
    };
    let impossible = |lcp: &Lcp| all_solutions(lcp).is_some_and(|all| all.is_empty());
    assert_eq!(of("solvable").filter(impossible).count(), 0);
    assert_eq!(of("dominant").filter(impossible).count(), 0); // P-matrices: exactly one solution
    assert!(of("dominant").all(|lcp| all_solutions(&lcp).unwrap().len() == 1));
    assert!(of("contacts").filter(impossible).count() > 3);
    assert!(of("any").filter(|lcp| !lcp.matrix().is_symmetric()).count() > 30);
    assert!(of("friction").all(|lcp| lcp.coupling().is_some()));
}

#[test]
fn the_record_is_the_same_on_any_number_of_threads() {
    let record = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        let options = Options::default();
        let liar: [Box<dyn Solver>; 2] = [
            Box::new(Liar(Status::Solved, 1.0)),
            Box::new(Pgs { settings: options.settings, ..Pgs::default() }),
        ];
        pool.install(|| Hunt { numbers: 0..200, seed: 2, tolerance: 1e-8 }.of(&liar, &|| ()))
    };
    assert_eq!(record(1), record(2));
    assert_eq!(record(1), record(4));
    assert!(record(1).tallies[0].false_claim_count > 50);
}
