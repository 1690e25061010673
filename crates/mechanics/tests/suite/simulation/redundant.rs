//! Mechanisms with redundant rows in random orientations: their rows are consistent up to rounding
//! and drift.

use lcplab_judge::{Demand, judge};
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::Simulation;
use lcplab_testing::{EFFORTS, MECHANISMS, cases, machine};
use proptest::prelude::*;

/// The steps of a machine that are rejected, one line each.
///
/// A ring of Bricard that has drifted from its exact positions has no degree of freedom left. At
/// velocity level it locks, so its motor is stuck; at acceleration level the forces on it grow
/// until the run ends. Which of its rows are redundant is then a matter of rounding, so another
/// method of the fallback sequence may answer. Its answers must be accepted like all others.
fn refused(
    (mechanism, text): (&str, &str),
    scheme: Scheme,
    solver: &str,
    steps: usize,
) -> Vec<String> {
    let locks = mechanism == "a ring of Bricard";
    let mut scene = Scene::from_toml("machine.toml", text).unwrap();
    scene.step.scheme = scheme;
    scene.solver.name = solver.to_string();
    scene.solver.tolerance = 1e-8;
    let demand = Demand { tolerance: scene.solver.tolerance, prove_up_to: 0 };
    let mut simulation = Simulation::of(&scene).unwrap();
    let mut refused = Vec::new();
    let is_strong = text.contains(&format!("effort = {}\n", EFFORTS[0]));
    for number in 1..=steps {
        let step = match simulation.step() {
            Ok(step) => step,
            Err(_) if locks && scheme == Scheme::Acceleration => break,
            Err(failure) => {
                refused.push(format!("step {number}: {failure}"));
                break;
            }
        };
        for solve in step.solves {
            let verdict = judge(&solve.problem.lcp, &solve.solution.x, &demand).verdict;
            if !verdict.is_solution() {
                refused.push(format!("step {number}: {verdict}, {}", solve.solution.status));
            }
            if solve.solver != solver && !locks {
                refused.push(format!("step {number}: answered by {}", solve.solver));
            }
            let (motor, hi) = (solve.solution.x.last(), solve.problem.lcp.hi().last());
            let is_at_limit = motor.zip(hi).is_some_and(|(x, hi)| x.abs() >= *hi);
            if is_at_limit && is_strong && !locks {
                refused.push(format!("step {number}: the motor, which is strong enough, is stuck"));
            }
        }
    }
    refused
}

fn solver() -> impl Strategy<Value = &'static str> {
    prop::sample::select(&["dantzig", "lemke", "block-pivoting", "newton", "interior-point"])
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn no_step_of_a_mechanism_with_redundant_joints_is_refused(
        machine in machine(),
        scheme in prop_oneof![Just(Scheme::Velocity), Just(Scheme::Acceleration)],
        solver in solver(),
    ) {
        let (name, text) = (MECHANISMS[machine.kind], machine.scene());
        let refused = refused((name, &text), scheme, solver, 20);
        prop_assert!(refused.is_empty(), "{name}, {scheme:?}, {solver}: {refused:?}\n{text}");
    }

    /// All rows are rounding: nothing acts and nothing moves, or a body only turns.
    #[test]
    fn no_step_without_forces_of_a_mechanism_with_redundant_joints_is_refused(
        machine in machine(),
        spins in any::<bool>(),
        scheme in prop_oneof![Just(Scheme::Velocity), Just(Scheme::Acceleration)],
        solver in solver(),
    ) {
        let (name, text) = (MECHANISMS[machine.kind], machine.scene());
        let start = text.find("kind = \"motor").map_or(text.len(), |at| {
            text[..at].rfind("[[constraints]]").unwrap()
        });
        let (_, rest) = text.split_once('\n').unwrap();
        let rest = &rest[..start - (text.len() - rest.len())];
        let mut still = format!("gravity = [0, 0, 0]\n{rest}");
        if spins {
            let body = "[[bodies]]\nname = \"alone\"\nshape = { sphere = 0.02 }\nmass = 1.5\n\
                        position = [9, 0, 0]\nangular_velocity = [0, 0, 3]\n";
            still += body;
        }
        let refused = refused((name, &still), scheme, solver, 20);
        prop_assert!(refused.is_empty(), "{name}, {scheme:?}, {solver}: {refused:?}\n{still}");
    }
}
