//! Frames recorded in engines: `frames/*.npz`.

use std::fs;

use lcplab::files;
use lcplab::judge::{Demand, judge_friction};
use lcplab::lcp::file::Problem;
use lcplab::lcp::friction::{Model, ProblemForm};
use lcplab::reference::{box_qp, cone_qp};
use lcplab::solver::{Options, Settings, Status, solve_by_sequence};
use nalgebra::{DMatrix, DVector};

fn frames() -> impl Iterator<Item = Problem> {
    let folder = format!("{}/frames", env!("CARGO_MANIFEST_DIR"));
    let mut paths: Vec<_> =
        fs::read_dir(folder).unwrap().map(|file| file.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|ending| ending == "npz"));
    paths.sort();
    assert_eq!(paths.len(), 60);
    paths.into_iter().map(|path| files::read(&path, None).unwrap())
}

#[test]
fn a_and_b_follow_from_the_bodies_and_rows() {
    for Problem { name, lcp, motion, .. } in frames() {
        let motion = motion.unwrap();
        let (n, k) = (lcp.len(), motion.target.len());
        let mut mass = DMatrix::zeros(k, k);
        for &(i, j, value) in &motion.mass {
            (mass[(i, j)], mass[(j, i)]) = (value, value);
        }
        let mut jacobian = DMatrix::zeros(n, k);
        for (i, row) in motion.jacobian.iter().enumerate() {
            row.iter().for_each(|&(j, value)| jacobian[(i, j)] = value);
        }
        let solved = mass.cholesky().expect("positive definite").solve(&jacobian.transpose());
        let a = &jacobian * solved
            + DMatrix::from_diagonal(&DVector::from_vec(motion.compliance.clone()));
        let b = &jacobian * DVector::from_vec(motion.target) + DVector::from_vec(motion.bias);
        let largest = a.amax();
        for i in 0..n {
            for j in 0..n {
                let miss = (lcp.matrix().entry(i, j) - a[(i, j)]).abs();
                assert!(miss <= 1e-10 * largest, "{name}: A[{i}, {j}] misses by {miss}");
            }
            assert!((lcp.b()[i] - b[i]).abs() <= 1e-12 * b.amax(), "{name}: b[{i}]");
        }
    }
}

/// How many of every second frame the default methods solve under a law, or under that of their
/// engine; the judge accepts each of these answers.
fn solved(law: Option<Model>) -> usize {
    let settings = Settings::default().with_tolerance(1e-8);
    let options = Options::default().with_settings(settings);
    let demand = Demand { tolerance: 1e-8, prove_up_to: 0 };
    let mut solved = 0;
    for problem in frames().filter(|problem| problem.lcp.coupling().is_some()).step_by(2) {
        let friction = problem.friction().unwrap().unwrap();
        let law = law.or_else(|| files::model(&problem)).unwrap();
        let posed = law.pose(&friction, None).unwrap();
        let answer = solve_by_sequence(&posed, &options, &mut ());
        if answer.solution.status == Status::Solved {
            let verdict = judge_friction(&posed, &answer.solution.x, &demand).verdict;
            assert!(verdict.is_solution(), "{}: {}: {verdict}", problem.name, answer.solver);
            solved += 1;
        }
    }
    solved
}

#[test]
fn boxes_that_are_called_solved_are_accepted_and_few_frames_are_left() {
    assert!(solved(Some(Model::CoupledBox)) >= 23); // of 29
}

#[test]
fn answers_under_the_law_of_the_engine_are_accepted_and_few_frames_are_left() {
    assert!(solved(None) >= 28); // of 29
}

/// The reference is for convex programs: the friction laws of MuJoCo and Drake, and boxes.
#[test]
fn the_reference_solves_every_frame_whose_engine_poses_a_convex_program() {
    let demand = Demand { tolerance: 1e-8, prove_up_to: 0 };
    let mut solved = 0;
    for problem in frames() {
        let posed = match files::model(&problem) {
            None => ProblemForm::Boxed(problem.lcp.clone()),
            Some(law @ Model::AssociatedCone) => {
                law.pose(&problem.friction().unwrap().unwrap(), None).unwrap()
            }
            Some(_) => continue,
        };
        let reference = match &posed {
            ProblemForm::Boxed(lcp) => box_qp(lcp),
            ProblemForm::Cone(cones) => cone_qp(cones),
            ProblemForm::Polyhedral(_) => unreachable!(),
        };
        let verdict = judge_friction(&posed, &reference.unwrap().point, &demand).verdict;
        assert!(verdict.is_solution(), "{}: {verdict}", problem.name);
        solved += 1;
    }
    assert_eq!(solved, 30);
}
