//! Friction polygons in stacks: they rest, and the solvers of their friction.

use lcplab_judge::Demand;
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_mechanics::scene::Scene;
use lcplab_solver::{PolygonPgs, Settings, Start, Status};
use nalgebra::Vector3;

use super::simulation;

const POLYGON_4: Model = Model::Polyhedral { directions: 4 };
const POLYGON_8: Model = Model::Polyhedral { directions: 8 };

/// A tower of boxes.
fn tower(boxes: usize, model: Model) -> Scene {
    let mut text = "[step]\ndt = 0.01\n[contact]\nfriction = 0.5\n[[bodies]]\nname = \"ground\"\n\
                    fixed = true\nshape = { plane = [0, 0, 1] }\n"
        .to_string();
    for k in 0..boxes {
        text += &format!(
            "[[bodies]]\nname = \"box {k}\"\nshape = {{ box = [1, 1, 0.5] }}\nmass = 1\n\
             position = [0, 0, {}]\n",
            0.25 + 0.5 * k as f64
        );
    }
    let mut scene = Scene::from_toml("tower.toml", &text).unwrap();
    scene.contact.model = model;
    scene
}

#[test]
fn a_tower_of_ten_stands_under_polygons_of_friction() {
    let demand = Demand { tolerance: 1e-8, prove_up_to: 0 };
    let mut tower = simulation(tower(10, POLYGON_8));
    for _ in 0..300 {
        let step = tower.step().unwrap();
        for solve in &step.solves {
            assert!(solve.judged(&demand).verdict.is_solution(), "step {}", step.number);
        }
        assert!(step.motion.penetration < 1e-6, "{}", step.motion.penetration);
    }
    // Ten boxes of 1 kg, none of which moves by a micrometer per second.
    assert!(tower.motion().kinetic < 0.5e-12 * 10.0, "{}", tower.motion().kinetic);
}

#[test]
fn sweeps_and_pivots_find_the_same_friction_in_a_polygon() {
    // The slip is unique if A is definite; three boxes that slide at an angle to the tangents and
    // rub on each other.
    let mut scene = tower(1, POLYGON_8);
    scene.states[1].v = Vector3::new(2.0, 0.7, 0.0);
    let mut block = simulation(scene);
    let step = block.step().unwrap();
    let solve = &step.solves[0];
    let Some(ProblemForm::Polyhedral(polyhedral)) =
        solve.posing.as_ref().map(|posing| &posing.posed)
    else {
        panic!("no polygon");
    };
    let sweeps = PolygonPgs { settings: Settings::default().with_tolerance(1e-10) };
    let swept = sweeps.solve(polyhedral, &Start::default(), &mut ());
    assert_eq!(swept.status, Status::Solved);
    let [u, v] = [&solve.solution.x, &swept.x].map(|x| solve.problem.motion(x));
    for (u, v) in u.iter().zip(&v) {
        assert!((u - v).abs() < 1e-7, "{u} {v}");
    }
}

#[test]
fn a_stack_under_a_polygon_moves_in_the_same_bits_whatever_the_unit_of_mass() {
    // 2⁻¹⁰ times the mass: A grows by 2¹⁰, and x shrinks accordingly; the motion does not depend on
    // the mass.
    let after = |mass: &str| {
        let changes = [("generate.mass".to_string(), mass.to_string())];
        let mut stack = Scene::load_with("stack", &changes).unwrap();
        stack.contact.model = POLYGON_4;
        let mut stack = simulation(stack);
        let steps: Vec<_> = (0..30).map(|_| stack.step().unwrap()).collect();
        let mut solves = steps.iter().flat_map(|step| &step.solves);
        let all_solved = solves.all(|solve| solve.solution.status == Status::Solved);
        (stack.states().to_vec(), all_solved)
    };
    assert_eq!(after("1"), after("0.0009765625"));
    assert!(after("1").1);
}
