//! The identifiers of rows: unique for each row, with one order for the two bodies of a pair.

use std::collections::BTreeMap;

use lcplab_mechanics::assembly::{Row, Source};
use lcplab_mechanics::body::linear;
use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_testing::{cases, pile};
use proptest::prelude::*;

/// The rows of each problem of a step, and those handled without a problem.
fn rows(step: &Step) -> Vec<Vec<&Row>> {
    let solved = step.solves.iter().map(|solve| solve.problem.assembly.rows.iter().collect());
    solved.chain([step.pushed.iter().map(|(row, _)| row).collect()]).collect()
}

fn unlike(scene: &Scene, rows: &[&Row]) -> Result<(), TestCaseError> {
    let mut labels: Vec<String> = rows.iter().map(|row| row.label(scene)).collect();
    labels.sort_unstable();
    let twice = labels.windows(2).find(|pair| pair[0] == pair[1]);
    prop_assert!(twice.is_none(), "{}: {twice:?}", scene.name);
    Ok(())
}

/// The order in which contacts name the two bodies of each pair.
fn orders(rows: &[&Row]) -> Result<(), TestCaseError> {
    let mut seen = BTreeMap::new();
    for row in rows.iter().filter(|row| matches!(row.id.source, Source::Contact(_))) {
        let [first, second] = row.bodies;
        let pair = [first.min(second), first.max(second)];
        prop_assert_eq!(*seen.entry(pair).or_insert(row.bodies), row.bodies);
    }
    Ok(())
}

/// x = 1 in a row gives its second body an impulse along the direction, and the first one the
/// opposite.
fn directions(step: &Step) -> Result<(), TestCaseError> {
    for assembly in step.solves.iter().map(|solve| &solve.problem.assembly) {
        let contacts =
            assembly.rows.iter().filter(|row| matches!(row.id.source, Source::Contact(_)));
        for row in contacts {
            let direction = row.direction().unwrap();
            for part in row.parts() {
                let body = assembly.blocks[part.block].body;
                let sign = if row.bodies[1] == Some(body) { 1.0 } else { -1.0 };
                prop_assert!(row.bodies.contains(&Some(body)));
                prop_assert_eq!(linear(&part.jacobian), direction * sign);
            }
        }
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(20))]

    #[test]
    fn no_two_rows_of_a_pile_have_one_label_and_contacts_name_a_pair_in_one_order(
        text in pile(),
        scheme in prop_oneof![
            Just(Scheme::Velocity),
            Just(Scheme::Acceleration),
            Just(Scheme::SplitImpulse),
            Just(Scheme::Soft),
            Just(Scheme::SequentialImpulses),
        ],
    ) {
        let mut scene = Scene::from_toml("pile.toml", &text).unwrap();
        scene.step.scheme = scheme;
        let mut simulation = Simulation::of(&scene).unwrap();
        for _ in 0..8 {
            let Ok(step) = simulation.step() else { break };
            for rows in rows(&step) {
                unlike(&scene, &rows)?;
                orders(&rows)?;
            }
            directions(&step)?;
        }
    }
}

#[test]
fn no_two_rows_of_a_shipped_scene_have_one_label() {
    let mut stepped = 0;
    for shipped in catalogue::SHIPPED {
        let scene = shipped.scene().unwrap();
        let Ok(step) = Simulation::of(&scene).unwrap().step() else { continue };
        rows(&step).iter().try_for_each(|rows| unlike(&scene, rows)).unwrap();
        stepped += 1;
    }
    assert!(stepped > 50, "{stepped}");
}

/// A hinge, its motor and its limit are three angular constraints between the same two bodies.
#[test]
fn constraints_between_the_same_bodies_are_distinguished() {
    let text = r#"
        [[bodies]]
        name = "A"
        shape = { box = [1, 1, 1] }
        mass = 1
        [[bodies]]
        name = "B"
        shape = { box = [1, 1, 1] }
        mass = 1
        position = [2, 0, 0]
        [[constraints]]
        kind = "hinge"
        bodies = ["A", "B"]
        axis = [0, 0, 1]
        point = [1, 0, 0]
        [[constraints]]
        kind = "motor_rotation"
        bodies = ["B", "A"]
        axis = [0, 0, 1]
        speed = 1
        effort = 1
        [[constraints]]
        kind = "motor_rotation"
        bodies = ["A", "B"]
        axis = [0, 0, 1]
        speed = 1
        effort = 1
    "#;
    let scene = Scene::from_toml("arm.toml", text).unwrap();
    let step = Step::of(&scene, 1).unwrap();
    rows(&step).iter().try_for_each(|rows| unlike(&scene, rows)).unwrap();
    let last = rows(&step)[0].last().unwrap().label(&scene);
    assert_eq!(last, "rotation A B 0 of constraints[2]");
}

#[test]
fn rows_of_bodies_with_blanks_in_their_names_or_the_name_of_the_world_have_labels_of_their_own() {
    // "a b" with "c" and "a" with "b c"; a body named world, and a joint to the world itself.
    let ball = |name: &str, x: f64| {
        format!(
            "[[bodies]]\nname = {name:?}\nshape = {{ sphere = 0.5 }}\nmass = 1\nposition = [{x}, 0, 0]\n"
        )
    };
    let joint = |bodies: &str| {
        format!("[[constraints]]\nkind = \"hinge\"\nbodies = {bodies}\naxis = [0, 0, 1]\n")
    };
    let names = ["a b", "c", "a", "b c", "world"];
    let text: String =
        names.iter().zip(0..).map(|(name, k)| ball(name, 3.0 * f64::from(k))).collect();
    let joints = [r#"["a b", "c"]"#, r#"["a", "b c"]"#, r#"["c"]"#, r#"["world", "c"]"#];
    let text = text + &joints.map(joint).concat();
    let scene = Scene::from_toml("names.toml", &text).unwrap();
    let mut simulation = Simulation::of(&scene).unwrap();
    let step = simulation.step().unwrap();
    for rows in rows(&step) {
        unlike(&scene, &rows).unwrap();
    }
}
