//! Redundant contacts from real simulations: boxes in towers and walls, mass ratios up to 1e12,
//! duplicated contacts. Four corners support a box where three would suffice, so A is always
//! singular.

use lcplab_judge::{Demand, judge};
use lcplab_lcp::Lcp;
use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
use lcplab_mechanics::body::Mass;
use lcplab_mechanics::formulation::Problem;
use lcplab_mechanics::scene::{Scene, step_contacts};
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver::{Fallback, Options, Registry, Settings, Solution, Start, Status};

const TOLERANCE: f64 = 1e-10;

/// How contacts are duplicated before the last LCP is built.
#[derive(Debug, Clone, Copy)]
enum Copies {
    None,
    /// Duplicated exactly.
    Exact,
    /// Duplicated with an offset of 1e-9 m.
    Near,
}

fn options() -> Options {
    Options::default().with_settings(Settings::default().with_tolerance(TOLERANCE))
}

/// A scene of boxes on the ground.
fn scene(boxes: &str, mu: f64) -> Scene {
    let text = format!(
        "{boxes}\n[contact]\nfriction = {mu}\nmargin = 0.01\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n"
    );
    Scene::from_toml("pile.toml", &text).unwrap()
}

/// Cubes on top of each other, four contacts each; the masses increase upwards by a total factor of
/// `ratio`.
fn tower(count: usize, ratio: f64, mu: f64) -> Scene {
    let boxes = format!("generate = {{ kind = \"stack\", count = {count}, size = 1, mass = 1 }}");
    let mut scene = scene(&boxes, mu);
    let moving = scene.bodies.iter_mut().filter(|body| body.mass != Mass::Fixed);
    for (k, body) in moving.enumerate() {
        if let Mass::Rigid { mass, moments } = &mut body.mass {
            let factor = ratio.powf(k as f64 / (count - 1) as f64);
            (*mass, *moments) = (*mass * factor, *moments * factor);
        }
    }
    scene
}

/// Bricks, each on two others, eight contacts each; unordered masses from 1 to `ratio`.
fn wall(layers: usize, ratio: f64, mu: f64) -> Scene {
    let mut bricks = String::new();
    let places = (0..layers).flat_map(|layer| (0..layers - layer).map(move |k| (layer, k)));
    for (count, (layer, k)) in places.enumerate() {
        let (x, z) = (1.05 * k as f64 + 0.525 * layer as f64, 0.25 + 0.5 * layer as f64);
        let mass = ratio.powf((7 * count % 11) as f64 / 10.0);
        bricks += &format!(
            "[[bodies]]\nname = \"{layer} {k}\"\nshape = {{ box = [1, 0.5, 0.5] }}\n\
             mass = {mass:e}\nposition = [{x}, 0, {z}]\n"
        );
    }
    scene(&bricks, mu)
}

/// The LCP of the next step after some steps, so that the positions of the corners have rounding
/// errors.
fn last(scene: Scene, copies: Copies) -> Lcp {
    let mut simulation =
        Simulation::new(scene, Registry::standard().entry("dantzig").unwrap().build(&options()));
    for _ in 0..3 {
        simulation.step().unwrap();
    }
    let (scene, states) = (simulation.scene(), simulation.states());
    let mut found = step_contacts(scene, states);
    let shift = match copies {
        Copies::None => None,
        Copies::Exact => Some(0.0),
        Copies::Near => Some(1e-9),
    };
    if let Some(shift) = shift {
        let mut again = found.clone();
        for anchor in again.iter_mut().flat_map(|found| &mut found.contact.anchors) {
            anchor.x += shift;
        }
        found.extend(again);
    }
    let assembly = Assembly::new(scene, states, &found, ConstraintFilter::Near).unwrap();
    Problem::velocity(scene, assembly).unwrap().lcp
}

/// The answer of a solver; if it claims a solution, the judge must accept it.
#[track_caller]
fn honest(name: &str, lcp: &Lcp) -> Solution {
    let solution = Registry::standard().entry(name).unwrap().build(&options()).solve(
        lcp,
        &Start::default(),
        &mut (),
    );
    let demand = Demand { tolerance: TOLERANCE, prove_up_to: 0 };
    let certificate = judge(lcp, &solution.x, &demand);
    assert!(solution.x.iter().all(|x| x.is_finite()), "{name}");
    if solution.status == Status::Solved {
        assert!(certificate.verdict.is_solution(), "{name}: {}", certificate.verdict);
    }
    solution
}

#[track_caller]
fn dantzig_solves(lcp: &Lcp) {
    let solution = honest("dantzig", lcp);
    assert_eq!(solution.status, Status::Solved, "after {} pivots", solution.iterations);
}

#[test]
fn dantzig_solves_frictionless_piles_of_any_masses_with_copied_contacts() {
    for ratio in [1.0, 1e6, 1e12] {
        for copies in [Copies::None, Copies::Exact, Copies::Near] {
            for scene in [tower(8, ratio, 0.0), tower(8, 1.0 / ratio, 0.0), wall(4, ratio, 0.0)] {
                dantzig_solves(&last(scene, copies));
            }
        }
    }
}

#[test]
fn dantzig_solves_three_hundred_frictionless_contacts() {
    let lcp = last(tower(75, 1.0, 0.0), Copies::None);
    assert_eq!(lcp.len(), 300);
    dantzig_solves(&lcp);
}

#[test]
fn dantzig_solves_piles_with_friction() {
    for ratio in [1.0, 1e3] {
        for scene in [tower(8, ratio, 0.5), tower(8, 1.0 / ratio, 0.5), wall(4, ratio, 0.5)] {
            dantzig_solves(&last(scene, Copies::None));
        }
    }
}

#[test]
fn lemke_solves_piles_of_equal_masses() {
    for scene in [tower(15, 1.0, 0.0), wall(4, 1.0, 0.0)] {
        for copies in [Copies::None, Copies::Exact] {
            assert_eq!(honest("lemke", &last(scene.clone(), copies)).status, Status::Solved);
        }
    }
}

#[test]
fn no_pivoting_solver_claims_what_the_judge_refutes() {
    for (ratio, mu) in [(1.0, 0.0), (1e6, 0.0), (1e12, 0.0), (1.0, 0.5), (1e12, 0.5)] {
        for copies in [Copies::None, Copies::Near] {
            for scene in [tower(5, ratio, mu), tower(5, 1.0 / ratio, mu), wall(3, ratio, mu)] {
                let lcp = last(scene, copies);
                for name in ["dantzig", "lemke", "block-pivoting"] {
                    honest(name, &lcp);
                }
            }
        }
    }
}

#[test]
fn sweeps_that_take_rounding_away_are_named() {
    // Light bricks under heavy ones: C's equations leave more than 1e-10 in rows with small terms.
    let fallback =
        |layers, ratio| honest("dantzig", &last(wall(layers, ratio, 0.0), Copies::None)).fallback;
    assert!((3..=8).any(|layers| fallback(layers, 1e6) == Some(Fallback::Sweeps)));
    assert!((3..=8).all(|layers| fallback(layers, 1.0).is_none()));
}
