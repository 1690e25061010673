//! The examples of the documentation.

use std::path::{Path, PathBuf};
use std::process::Command;

use lcplab_judge::{Demand, judge_cone};
use lcplab_lcp::friction::{ConeProblem, Law};
use lcplab_lcp::library;
use lcplab_plugin::Plugin;
use lcplab_solver::{Settings, Start, Status};
use lcplab_testing::{contacts, pushed_mass};

use super::{LONG, cone_entry, pushed, solve, start};

fn example(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/plugins").join(name)
}

/// Its answers to two problems are right to the last digits.
fn solves(plugin: &Plugin) {
    let definite = library::by_name("pd").unwrap().generate(&[("n", 8.0)]).unwrap().lcp;
    for lcp in [pushed(), definite] {
        let (solution, certificate) = solve(plugin, &lcp);
        assert_eq!(solution.status, Status::Solved);
        assert!(certificate.scaled_residual < 1e-12, "{certificate:?}");
    }
    let (solution, _) = solve(plugin, &pushed());
    assert_eq!(solution.x, [0.5, 0.0]);
}

/// A row with a_ii = 0 has no sweep: the answer is no claim, and the next one is right again.
fn claims_nothing_of_a_zero_diagonal(plugin: &Plugin) {
    let zero = contacts(&[&[2.0, 1.0], &[1.0, 0.0]], &[-1.0, -1.0]);
    assert_eq!(solve(plugin, &zero).0.status, Status::IterationLimit);
    assert_eq!(solve(plugin, &pushed()).0.status, Status::Solved);
}

#[test]
fn seventeen_lines_of_python_are_a_solver() {
    let text = std::fs::read_to_string(example("sweeps.py")).unwrap();
    assert_eq!(text.lines().count(), 17);
    let plugin = start(&example("sweeps.py"), LONG);
    assert_eq!(plugin.name(), "sweeps");
    solves(&plugin);
    claims_nothing_of_a_zero_diagonal(&plugin);
}

#[test]
fn fifty_lines_of_c_plus_plus_are_a_solver() {
    let text = std::fs::read_to_string(example("sweeps.cpp")).unwrap();
    assert!(text.lines().count() <= 52);
    let folder = tempfile::tempdir().unwrap();
    let program = folder.path().join("sweeps_cpp");
    let compiler = Command::new("c++")
        .args(["-std=c++17", "-O2", "-o"])
        .args([&program, &example("sweeps.cpp")])
        .output()
        .expect("a C++ compiler");
    assert!(compiler.status.success(), "{}", String::from_utf8_lossy(&compiler.stderr));
    let plugin = Plugin::start(&program.display().to_string(), LONG.as_secs_f64()).unwrap();
    solves(&plugin);
    claims_nothing_of_a_zero_diagonal(&plugin);
}

#[test]
fn sixty_lines_of_python_are_a_solver_of_friction_cones() {
    let plugin = start(&example("cones.py"), LONG);
    let entry = cone_entry(&plugin).unwrap();
    let solver = entry.build(&Settings::default());
    // A unit mass, pressed with 2 and pushed with 3, µ = ½: friction takes 1 of the push, along it.
    for degrees in [0.0_f64, 10.0, -45.0, 90.0, 200.0] {
        let problem = ConeProblem::new(pushed_mass(2.0, 3.0, degrees), Law::Coulomb);
        let solution = solver.solve(&problem, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert!(judge_cone(&problem, &solution.x, &Demand::default()).verdict.is_solution());
        let (sin, cos) = degrees.to_radians().sin_cos();
        for (x, exact) in solution.x.iter().zip([2.0, cos, sin]) {
            assert!((x - exact).abs() < 1e-9, "{degrees}: {:?}", solution.x);
        }
    }
    // Boxes are not its business, and it says so.
    let (solution, _) = solve(&plugin, &pushed_mass(2.0, 3.0, 30.0).coupled_box());
    assert!(matches!(solution.status, Status::OutsideClass { .. }));
}
