use lcplab_analysis::loads::Loads;
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_mechanics::scene::Scene;
use lcplab_mechanics::simulation::Simulation;
use lcplab_solver::{Options, Registry, Start};
use serde_json::json;

use lcplab_testing::cases;
use proptest::prelude::*;

#[track_caller]
fn assert_near(value: f64, expected: f64, tolerance: f64) {
    assert!((value - expected).abs() <= tolerance, "{value}, expected {expected}");
}

/// The weight of the table (N).
const WEIGHT: f64 = 40.0 * 9.81;

/// A table of 40 kg on frictionless legs at these places of its plane, 1 m below its center.
fn table(legs: &[[f64; 2]]) -> Question {
    let mut jacobian = Vec::new();
    for (i, [x, y]) in legs.iter().enumerate() {
        jacobian.extend([json!([i, 2, 1]), json!([i, 3, y]), json!([i, 4, -x])]);
    }
    let mass: Vec<_> = (0..6).map(|k| json!([k, k, if k < 3 { 40 } else { 10 }])).collect();
    let entry = |i: usize, j: usize| {
        1.0 / 40.0 + (legs[i][0] * legs[j][0] + legs[i][1] * legs[j][1]) / 10.0
    };
    let n = legs.len();
    let a: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
    let row = |k: usize| json!({ "label": format!("leg {k}"), "kind": "normal", "bodies": ["ground", "table"] });
    let file = json!({
        "A": { "dense": a }, "b": vec![-0.0981; n], "dt": 0.01,
        "rows": (0..n).map(row).collect::<Vec<_>>(),
        "bodies": [{ "name": "table", "first": 0, "count": 6 }], "gravity": [0, 0, -0.0981],
        "motion": {
            "mass": mass, "jacobian": jacobian, "bias": vec![0; n], "compliance": vec![0; n],
            "target": [0, 0, -0.0981, 0, 0, 0], "level": "velocity",
        },
    });
    let problem = Problem::parse(&file.to_string(), "table").unwrap();
    Question::new(&problem, None, "table").unwrap()
}

fn loads_of(question: &Question) -> Loads {
    let solver = Registry::standard().entry("dantzig").unwrap().build(&Options::default());
    let solution = solver.solve(question.boxed().unwrap(), &Start::default(), &mut ());
    Loads::of(question, &solution.x).unwrap()
}

/// On a square only the difference of the diagonals is free: each leg carries from nothing to half
/// of the weight, and a quarter where Σ x² is smallest.
#[test]
fn a_leg_of_four_carries_from_nothing_to_half_of_the_weight() {
    let loads = loads_of(&table(&[[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]));
    let pair = &loads.pairs[0];
    assert_eq!((pair.by.as_str(), pair.on.as_str(), loads.unit), ("ground", "table", "N"));
    assert_near(pair.carried, WEIGHT, 1e-9);
    assert!(pair.range.unwrap().is_unique, "{pair:?}");
    for contact in &pair.contacts {
        let range = contact.range.unwrap();
        assert_near(range.least, 0.0, 1e-4);
        assert_near(range.most, WEIGHT / 2.0, 1e-4);
        assert_near(range.least_norm, WEIGHT / 4.0, 1e-4);
    }
    assert_near(pair.wrench.moment[0], 0.0, 1e-9);
    assert_eq!(loads.bodies[0].weight.map(|w| w[2].round()), Some(-392.0));
    let text = loads.text();
    assert!(text.contains("100 % of its weight; unique"), "{text}");
    assert!(text.contains("0 to 196.2 N, 98.1 N in the least-norm answer"), "{text}");
}

#[test]
fn an_answer_with_a_wrong_motion_has_no_ranges_and_the_reason_is_given() {
    let question = table(&[[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]]);
    // The sum is 4 N s instead of 3.924 N s.
    let loads = Loads::of(&question, &[1.0; 4]).unwrap();
    assert!(loads.pairs[0].range.is_none() && loads.pairs[0].contacts[0].range.is_none());
    let text = loads.text();
    assert!(
        text.contains("no ranges: they need an answer whose motion error is at most 10⁻⁴ of"),
        "{text}"
    );
    assert_eq!(loads.json()["unexamined"], loads.unexamined.unwrap());
}

/// A beam on supports at these places of a line, with its weight at 0: least and largest force of
/// each. At an extreme at most two supports carry, by the law of the lever.
fn lever(places: &[f64]) -> Vec<[f64; 2]> {
    let of = |(i, at): (usize, &f64)| {
        let opposite = places.iter().filter(|other| **other * at < 0.0);
        let parts: Vec<f64> = opposite.map(|p| WEIGHT * p.abs() / (p.abs() + at.abs())).collect();
        let is_alone = places.iter().enumerate().all(|(k, other)| k == i || other * at < 0.0);
        let least = if is_alone { parts.iter().copied().fold(WEIGHT, f64::min) } else { 0.0 };
        [least, parts.iter().copied().fold(0.0, f64::max)]
    };
    places.iter().enumerate().map(of).collect()
}

proptest! {
    #![proptest_config(cases(64))]

    /// Ranges are a property of the problem: a solver that stops at a residual of 1e-8 gets the
    /// same as an exact one, and nothing that is free is called unique.
    #[test]
    fn every_solver_gets_the_ranges_of_the_law_of_the_lever(
        left in proptest::collection::vec(0.2f64..2.0, 1..4),
        right in proptest::collection::vec(0.2f64..2.0, 1..4),
    ) {
        let places: Vec<f64> = left.iter().map(|p| -p).chain(right).collect();
        let question = table(&places.iter().map(|x| [*x, 0.0]).collect::<Vec<_>>());
        for name in ["dantzig", "block-pivoting", "newton", "interior-point", "pgs", "apgd"] {
            let options = Options::default();
            let options = options.with_max_iterations(100_000);
            let solver = Registry::standard().entry(name).unwrap().build(&options);
            let solution = solver.solve(question.boxed().unwrap(), &Start::default(), &mut ());
            let loads = Loads::of(&question, &solution.x).unwrap();
            prop_assert_eq!(&loads.unexamined, &None, "{}", name);
            for (contact, [least, most]) in loads.pairs[0].contacts.iter().zip(lever(&places)) {
                let range = contact.range.unwrap();
                let off = (range.least - least).abs().max((range.most - most).abs());
                prop_assert!(off < 1e-4 * WEIGHT, "{name}: {contact:?}, expected {least} to {most}");
                prop_assert_eq!(range.is_unique, most - least < 1e-6 * WEIGHT, "{}: {:?}", name, contact);
            }
        }
    }

    /// On three legs around the center the forces are its barycentric coordinates.
    #[test]
    fn three_legs_carry_unique_parts(turn in 0.0f64..6.0, wide in 1.8f64..2.4, radius in 0.3f64..3.0) {
        let at = |angle: f64| [radius * angle.cos(), radius * angle.sin()];
        let legs = [at(turn), at(turn + wide), at(turn - wide)];
        let loads = loads_of(&table(&legs));
        let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
        let parts = [cross(legs[1], legs[2]), cross(legs[2], legs[0]), cross(legs[0], legs[1])];
        let sum: f64 = parts.iter().sum();
        for (contact, part) in loads.pairs[0].contacts.iter().zip(parts) {
            prop_assert!((contact.value - WEIGHT * part / sum).abs() < 1e-6, "{contact:?}");
            prop_assert!(contact.range.unwrap().is_unique, "{contact:?}");
        }
    }
}

/// 100 kg on three cubes of 20 kg: whatever the order of the names in a row, forces have one sign.
#[test]
fn pairs_of_bodies_add_up_to_the_weights_above_them() {
    let cube = |name: &str, x: f64, y: f64| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape = {{ box = [0.4, 0.4, 0.4] }}\nmass = 20\nposition = [{x}, {y}, 0.2]\n"
        )
    };
    let text = "[step]\ndt = 0.002\n[contact]\nfriction = 0.8\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n"
        .to_string()
        + &cube("c1", -0.5, -0.5)
        + &cube("c2", 0.5, -0.5)
        + &cube("c3", 0.0, 0.5)
        + "[[bodies]]\nname = \"test\"\nshape = { box = [1.4, 1.4, 0.6] }\nmass = 100\nposition = [0, 0, 0.7]\n";
    let scene = Scene::from_toml("cubes.toml", &text).unwrap();
    let mut simulation = Simulation::unjudged(&scene).unwrap();
    let step = simulation.step().unwrap();
    let solve = step.solves.last().unwrap();
    let problem = solve.exported(&scene, 1);
    let question = Question::new(&problem, None, "cubes").unwrap();
    let loads = Loads::of(&question, &solve.solution.x).unwrap();
    let carried = |is_meant: fn(&str, &str) -> bool| -> f64 {
        let pairs = loads.pairs.iter().filter(|pair| is_meant(&pair.by, &pair.on));
        pairs.map(|pair| pair.carried).sum()
    };
    assert_near(carried(|by, on| by == "ground" && on != "test"), 160.0 * 9.81, 1e-6);
    assert_near(carried(|by, on| by != "ground" && on == "test"), 100.0 * 9.81, 1e-6);
    let body = loads.bodies.iter().find(|body| body.name == "test").unwrap();
    assert_near(body.wrench.force[2], 981.0, 1e-6);
    // The moments of its three supports keep it from turning.
    assert!(body.wrench.moment.iter().all(|m| m.abs() < 1e-6), "{body:?}");
}
