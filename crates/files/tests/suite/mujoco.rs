//! A step of MuJoCo's, written by Python's `lcplab.receipt`, beside the forces that MuJoCo found:
//! A + R is positive definite, so there is one answer.

use std::path::{Path, PathBuf};

use lcplab_files as files;
use lcplab_judge::{Demand, Verdict, judge, judge_friction};
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_lcp::memory::Memory;
use lcplab_solver::{ConePgs, ConeSolver, Options, Registry, Settings, Start, Status};

fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/problems").join(name)
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

/// Forces of up to 122 N.
#[test]
fn with_pyramids_both_forces_are_proved_and_agree_to_thirteen_digits() {
    let lcp = files::read(&file("mujoco_pyramidal.json"), None).unwrap().lcp;
    let theirs =
        files::read_answers(&file("mujoco_pyramidal_answer.json"), lcp.len(), Memory::default());
    let theirs = theirs.unwrap().x;
    let dantzig = Registry::standard().entry("dantzig").unwrap().build(&Options::default());
    let ours = dantzig.solve(&lcp, &Start::default(), &mut ()).x;
    for x in [&theirs, &ours] {
        assert!(matches!(judge(&lcp, x, &Demand::default()).verdict, Verdict::Proved { .. }));
    }
    assert!(distance(&theirs, &ours) < 1e-13 * 122.0, "{}", distance(&theirs, &ours));
}

/// Forces of up to 114 N; the lower box slides, and the associated cone lifts it.
#[test]
fn elliptic_cones_are_the_associated_model_and_not_coulombs_law() {
    let problem = files::read(&file("mujoco_elliptic.json"), None).unwrap();
    let theirs = files::read_answers(
        &file("mujoco_elliptic_answer.json"),
        problem.lcp.len(),
        Memory::default(),
    );
    let theirs = theirs.unwrap().x;
    let friction = problem.friction().unwrap().unwrap();
    let posed = |model: Model| model.pose(&friction, None).unwrap();
    let verdict = |model| judge_friction(&posed(model), &theirs, &Demand::default()).verdict;
    assert_eq!(problem.model, Some(Model::AssociatedCone));
    assert!(verdict(Model::AssociatedCone).is_solution());
    assert!(!verdict(Model::CoulombCone).is_solution());
    let ProblemForm::Cone(cone) = posed(Model::AssociatedCone) else { unreachable!() };
    let settings = Settings::default().with_tolerance(1e-13).with_max_iterations(5000);
    let sweeps = ConePgs { settings };
    let ours = sweeps.solve(&cone, &Start::default(), &mut ());
    assert_eq!(ours.status, Status::Solved);
    assert!(distance(&theirs, &ours.x) < 1e-8);
}
