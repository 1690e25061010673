//! Several shapes that move as one body: mass by the parallel axis theorem, contacts of every part.

use lcplab_mechanics::body::{Mass, State};
use lcplab_mechanics::scene::{Scene, contacts};
use lcplab_mechanics::simulation::Simulation;
use nalgebra::Vector3;

fn scene(bodies: &str) -> Scene {
    let text = format!(
        "gravity = [0, 0, -10]\nstep = {{ dt = 0.01 }}\ncontact = {{ friction = 0.3 }}\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n{bodies}"
    );
    Scene::from_toml("compound.toml", &text).unwrap()
}

fn body(shape: &str, rest: &str) -> String {
    format!("[[bodies]]\nname = \"body\"\nshape = {shape}\n{rest}\n")
}

const DUMBBELL: &str = "{ compound = [\
    { shape = { sphere = 0.5 }, position = [0, 0, 0] }, \
    { shape = { sphere = 0.5 }, position = [4, 0, 0] }] }";

#[test]
fn a_dumbbell_has_the_moments_of_the_parallel_axis_theorem_about_its_middle() {
    let scene = scene(&body(DUMBBELL, "mass = 2\nposition = [10, 0, 5]"));
    let Mass::Rigid { mass, moments } = scene.bodies[1].mass else { panic!("it turns") };
    // 1 kg each at 2 m from the center: 2/5 m r² along the bar, plus m d² perpendicular to it.
    let own = 2.0 * 0.4 * 0.25;
    let mut found = [moments.x, moments.y, moments.z];
    found.sort_by(f64::total_cmp);
    for (found, expected) in found.into_iter().zip([own, own + 8.0, own + 8.0]) {
        assert!((found - expected).abs() < 1e-14, "{found}, not {expected}");
    }
    assert_eq!(mass, 2.0);
    assert!((scene.states[1].pose.p - Vector3::new(12.0, 0.0, 5.0)).norm() < 1e-14);
}

#[test]
fn turned_parts_have_the_tensor_of_what_they_make() {
    // A bar of 2 by 1 by 1 in one piece, and made of two cubes, one of which is rotated by 90
    // degrees.
    let whole = scene(&body("{ box = [2, 1, 1] }", "density = 3"));
    let halves = "{ compound = [{ shape = { box = [1, 1, 1] }, position = [-0.5, 0, 0] }, \
                  { shape = { box = [1, 1, 1] }, position = [0.5, 0, 0], rotation = { x = 90 } }] }";
    let halves = scene(&body(halves, "density = 3"));
    let [Mass::Rigid { mass: m, moments: i }, Mass::Rigid { mass, moments }] =
        [whole.bodies[1].mass, halves.bodies[1].mass]
    else {
        panic!("both turn")
    };
    assert!((m - mass).abs() < 1e-14 && (i - moments).norm() < 1e-14, "{i} {moments}");
}

#[test]
fn two_halves_move_as_the_whole_in_flight_and_on_the_ground() {
    let motion =
        "density = 1\nposition = [0, 0, 0.52]\nvelocity = [3, 1, 0]\nangular_velocity = [0, 0, 2]";
    let whole = scene(&body("{ box = [2, 1, 1] }", motion));
    let halves = "{ compound = [{ shape = { box = [1, 1, 1] }, position = [-0.5, 0, 0] }, \
                  { shape = { box = [1, 1, 1] }, position = [0.5, 0, 0] }] }";
    let halves = scene(&body(halves, motion));
    let after = |scene: &Scene| -> State {
        let mut simulation = Simulation::of(scene).unwrap();
        (0..30).for_each(|_| drop(simulation.step().unwrap()));
        simulation.states()[1]
    };
    let (a, b) = (after(&whole), after(&halves));
    // Height and velocity are unique; the distribution of friction over twelve points instead of
    // eight is not.
    assert!((a.pose.p.z - b.pose.p.z).abs() < 1e-9 && (a.v.z - b.v.z).abs() < 1e-9);
    assert!(a.v.x > 0.5 && b.v.x > 0.5 && (a.v.x - b.v.x).abs() < 0.2, "{} {}", a.v.x, b.v.x);
    let flight = |scene: &Scene| {
        let mut scene = scene.clone();
        scene.states[1].pose.p.z = 100.0;
        after(&scene)
    };
    let (a, b) = (flight(&whole), flight(&halves));
    assert!((a.pose.p - b.pose.p).norm() < 1e-12 && (a.omega - b.omega).norm() < 1e-12);
}

#[test]
fn a_dumbbell_rests_on_both_its_balls_each_with_half_of_the_weight() {
    let scene = scene(&body(DUMBBELL, "mass = 2\nposition = [0, 0, 0.5]"));
    let found = contacts(&scene, &scene.states, 0.01);
    assert_eq!(found.len(), 2);
    assert_ne!(found[0].id, found[1].id);
    let mut simulation = Simulation::of(&scene).unwrap();
    let step = simulation.step().unwrap();
    let x = &step.solves[0].solution.x;
    let normals = step.solves[0].problem.lcp.contacts().iter().map(|contact| x[contact.rows[0]]);
    for push in normals {
        assert!((push - 0.1).abs() < 1e-12, "{push} N s"); // half of 2 kg × 10 m/s² × 0.01 s
    }
    assert!(simulation.states()[1].v.norm() < 1e-12);
}

#[test]
fn parts_of_one_body_do_not_collide_and_those_of_two_do() {
    let pair = |position: &str| {
        let two = "{ compound = [{ shape = { sphere = 0.5 } }, { shape = { sphere = 0.5 }, position = [0.6, 0, 0] }] }";
        let other =
            body(two, &format!("mass = 1\nposition = {position}")).replace("\"body\"", "\"other\"");
        let scene = scene(&(body(two, "mass = 1\nposition = [0, 0, 5]") + &other));
        contacts(&scene, &scene.states, 0.01).len()
    };
    assert_eq!(pair("[0, 0, 9]"), 0);
    assert_eq!(pair("[0, 1, 5]"), 2); // side by side: ball on ball, twice
    assert_eq!(pair("[1.6, 0, 5]"), 1); // one behind the other
}

/// Boxes over a box, with a corner, edge or face first: the contact points do not depend on the
/// other parts of the body.
#[test]
fn a_part_touches_as_it_does_alone_however_far_from_the_middle_it_is() {
    let alone = "{ box = [1, 1, 1] }";
    let with_rest = "{ compound = [{ shape = { box = [1, 1, 1] } }, \
                     { shape = { box = [0.1, 0.1, 8] }, position = [0, 0, SIDE] }] }";
    let points = |shapes: [String; 2], rest: &str| {
        let [table, mover] = shapes;
        let table = format!(
            "[[bodies]]\nname = \"table\"\nfixed = true\nshape = {table}\nposition = [0, 0, 900]\n"
        );
        let scene = scene(&(table + &body(&mover, rest)));
        let found = contacts(&scene, &scene.states, 0.3);
        let mut points: Vec<[f64; 4]> =
            found.iter().map(|f| [f.point.x, f.point.y, f.point.z, f.gap]).collect();
        points.sort_by(|a, b| a.partial_cmp(b).unwrap());
        points
    };
    let mut some = 0;
    for turn in [
        "x = 3",
        "x = 20",
        "y = 40",
        "z = 30",
        "quaternion = [3, 1, 1, 0]",
        "quaternion = [5, 1, 2, 1]",
    ] {
        for z in [900.9, 901.05, 901.2, 901.27] {
            let rest = format!("mass = 1\nposition = [0.4, 0.3, {z}]\nrotation = {{ {turn} }}");
            let single = points([alone, alone].map(String::from), &rest);
            let sides = ["-200", "200"].map(|side| with_rest.replace("SIDE", side));
            let within = points(sides, &rest);
            assert_eq!(single.len(), within.len(), "{turn} {z}: {single:?} {within:?}");
            for (a, b) in single.iter().flatten().zip(within.iter().flatten()) {
                assert!((a - b).abs() < 1e-9, "{turn} {z}: {single:?} {within:?}");
            }
            some += single.len();
        }
    }
    assert!(some > 30, "{some}");
}

#[test]
fn what_is_no_compound_is_refused_with_the_part() {
    let refused = |shape: &str, rest: &str| {
        let text = body(shape, rest);
        Scene::from_toml("compound.toml", &text).unwrap_err().to_string()
    };
    let plane = "{ compound = [{ shape = { sphere = 1 } }, { shape = { plane = [0, 0, 1] } }] }";
    let message = refused(plane, "mass = 1");
    assert!(message.contains("compound[1].shape: a part is a sphere"), "{message}");
    assert!(refused("{ compound = [] }", "mass = 1").contains("has no parts"));
    let message = refused("{ compound = [{ shape = { sphere = -1 } }] }", "mass = 1");
    assert!(message.contains("compound[0].shape"), "{message}");
}

#[test]
fn with_given_moments_the_parts_lie_in_the_principal_axes_about_the_center_of_mass() {
    let lopsided =
        scene(&body(DUMBBELL, "mass = 2\ninertia = [1, 2, 2.5]\nposition = [0, 0, 0.5]"));
    let Mass::Rigid { moments, .. } = lopsided.bodies[1].mass else { panic!("it turns") };
    assert_eq!(moments, Vector3::new(1.0, 2.0, 2.5));
    assert_eq!(lopsided.states[1].pose.p, Vector3::new(0.0, 0.0, 0.5));
    // The balls touch the ground below 0 and 4, not at both ends of a bar of 4 about its middle.
    let mut touching: Vec<f64> =
        contacts(&lopsided, &lopsided.states, 1e-9).iter().map(|found| found.point.x).collect();
    touching.sort_by(f64::total_cmp);
    assert_eq!(touching, [0.0, 4.0]);
}

#[test]
fn a_hull_with_given_moments_keeps_its_written_axes() {
    let wedge = "{ hull = [[0, 0, 0], [3, 0, 0], [0, 2, 0], [0, 0, 1]] }";
    let given = scene(&body(wedge, "mass = 1\ninertia = [1, 1, 1]"));
    let homogeneous = scene(&body(wedge, "mass = 1"));
    assert_eq!(given.states[1].pose.p, Vector3::zeros());
    // The center of mass of a tetrahedron is the mean of its corners.
    assert!((homogeneous.states[1].pose.p - Vector3::new(0.75, 0.5, 0.25)).norm() < 1e-14);
}

#[test]
fn bodies_and_pairs_without_contact_touch_nothing() {
    let ball = |name: &str, more: &str| {
        format!("[[bodies]]\nname = \"{name}\"\nshape = {{ sphere = 1 }}\nmass = 1\n{more}\n")
    };
    let count = |bodies: String| {
        let scene = scene(&bodies);
        contacts(&scene, &scene.states, 1e-9).len()
    };
    let pair = "[[pairs]]\nbodies = [\"b\", \"a\"]\nwithout_contact = true\n";
    let (none, away) = ("without_contact = true", "position = [1, 0, 0]");
    // Two balls that overlap each other and the ground.
    assert_eq!(count(ball("a", "") + &ball("b", away)), 3);
    assert_eq!(count(ball("a", "") + &ball("b", away) + pair), 2);
    assert_eq!(count(ball("a", none) + &ball("b", away)), 1);
    assert_eq!(count(ball("a", none) + &ball("b", &format!("{away}\n{none}"))), 0);
}
