//! The fallback sequence: after a method that fails the next one is tried, and the answer lists the
//! failed ones.

use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Options, SequenceAnswer, Status, solve_by_sequence};
use lcplab_testing::{INF, boxed, contacts};

fn solve(lcp: Lcp) -> SequenceAnswer {
    solve_by_sequence(&ProblemForm::Boxed(lcp), &Options::default(), &mut ())
}

#[test]
fn the_first_method_that_solves_the_problem_answers() {
    let answer = solve(contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 2.0]));
    assert_eq!((&*answer.solver, answer.solution.x), ("dantzig", vec![0.5, 0.0]));
    assert!(answer.attempts.is_empty());
}

/// The equilibria of a bimatrix game with payoffs as losses: w = (B y − 1, Cᵀx − 1), no column of A
/// on its own diagonal.
fn game(b: [[f64; 2]; 2], c: [[f64; 2]; 2]) -> Lcp {
    let a = [
        [0.0, 0.0, b[0][0], b[0][1]],
        [0.0, 0.0, b[1][0], b[1][1]],
        [c[0][0], c[1][0], 0.0, 0.0],
        [c[0][1], c[1][1], 0.0, 0.0],
    ];
    Lcp::new(Matrix::dense(4, &a.concat()), vec![-1.0; 4], vec![0.0; 4], vec![INF; 4]).unwrap()
}

#[test]
fn a_game_on_which_lemke_ends_on_a_ray_is_solved_by_enumeration() {
    // Every bimatrix game has an equilibrium (Nash 1951), which solves this problem (Lemke & Howson
    // 1964).
    for k in 0..50u32 {
        let payoff = |i: u32| f64::from((7 * k + 5 * i * i + 3 * i) % 6 + 1);
        let b = [[payoff(0), payoff(1)], [payoff(2), payoff(3)]];
        let c = [[payoff(4), payoff(5)], [payoff(6), payoff(7)]];
        let answer = solve(game(b, c));
        assert_eq!(answer.solution.status, Status::Solved, "{b:?} {c:?}");
        if answer.solver != "lemke" {
            assert_eq!(answer.attempts[0].solver, "lemke");
        }
    }
}

#[test]
fn a_problem_without_a_solution_ends_with_that_answer_and_all_attempts() {
    // w_0 = x_1 − 1 with x_1 ≤ ½: negative whatever x, and A is not symmetric.
    let answer = solve(boxed(&[&[0.0, 1.0], &[0.5, 1.0]], &[-1.0, 0.0], &[0.0; 2], &[INF, 0.5]));
    assert_eq!((&*answer.solver, answer.solution.status), ("enumeration", Status::NoSolution));
    let tried: Vec<&str> = answer.attempts.iter().map(|attempt| attempt.solver).collect();
    assert_eq!(tried, ["lemke", "interior-point", "fischer-newton"]);
}

#[test]
fn a_cone_problem_that_is_not_quite_symmetric_is_solved() {
    for part in [0.0, 1e-6, 1e-4, 1e-3] {
        let text = format!(
            r#"{{"A": {{"dense": [[2, {}, -0.2], [0.3, 1.5, 0.1], [-0.2, 0.1, 1.2]]}},
                "b": [-1, -0.8, 0.9], "friction_index": [-1, 0, 0], "mu": [0, 0.4, 0.4]}}"#,
            0.3 * (1.0 + part)
        );
        let friction = Problem::parse(&text, "cone.json").unwrap().friction().unwrap().unwrap();
        let posed = Model::CoulombCone.pose(&friction, None).unwrap();
        let answer = solve_by_sequence(&posed, &Options::default(), &mut ());
        assert_eq!(answer.solution.status, Status::Solved, "{part}");
        // It slides: |x_t| = μ x_n.
        let x = &answer.solution.x;
        assert!((x[1].hypot(x[2]) - 0.4 * x[0]).abs() < 1e-7, "{x:?}");
    }
}

#[test]
fn small_problems_with_an_indefinite_symmetric_matrix_are_solved_or_have_no_solution() {
    for (a, b, bounds, x) in [
        (&[-6.0][..], &[-3.0][..], [-INF, INF], Some(vec![-0.5])),
        // w = (x_1 − 1, x_0 − 1): (1, 1) is one solution.
        (&[0.0, 1.0, 1.0, 0.0], &[-1.0, -1.0], [0.0, INF], Some(vec![1.0, 1.0])),
        // w = −x − 1 < 0 for every x ≥ 0.
        (&[-1.0], &[-1.0], [0.0, INF], None),
    ] {
        let n = b.len();
        let bounds = bounds.map(|bound| vec![bound; n]);
        let [lo, hi] = bounds;
        let answer = solve(Lcp::new(Matrix::dense(n, a), b.to_vec(), lo, hi).unwrap());
        match x {
            Some(x) => assert_eq!((answer.solution.status, answer.solution.x), (Status::Solved, x)),
            None => assert_eq!(answer.solution.status, Status::NoSolution),
        }
    }
}

#[test]
fn a_semidefinite_problem_without_a_solution_is_not_enumerated() {
    // w_0 = x_0 + x_1 and w_1 = x_0 + x_1 + 1 are both to be 0.
    let a: &[&[f64]] = &[&[1.0, 1.0], &[1.0, 1.0]];
    let answer = solve(boxed(a, &[0.0, 1.0], &[-INF; 2], &[INF; 2]));
    assert!(answer.attempts.iter().all(|attempt| attempt.solver != "enumeration"));
    assert_ne!(answer.solution.status, Status::NoSolution);
}
