//! Contact points: their number, positions, gaps and identifiers.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::Normal;
use lcplab_mechanics::scene::{DetectedContact, Scene, contacts};
use nalgebra::{UnitQuaternion, Vector3};

fn scene(bodies: &[&str]) -> Scene {
    let text: String = bodies
        .iter()
        .enumerate()
        .map(|(k, body)| format!("[[bodies]]\nname = \"{k}\"\n{body}\n"))
        .collect();
    Scene::from_toml("test.toml", &text).unwrap()
}

const PLANE: &str = "fixed = true\nshape = { plane = [0, 0, 1] }";
const BALL: &str = "mass = 1\nshape = { sphere = 0.5 }";
const CUBE: &str = "mass = 1\nshape = { box = [1, 1, 1] }";

fn found(bodies: &[&str], states: impl Fn(&mut [State]), margin: f64) -> Vec<DetectedContact> {
    let scene = scene(bodies);
    let mut moved = scene.states.clone();
    states(&mut moved);
    contacts(&scene, &moved, margin)
}

#[test]
fn a_box_on_a_plane_stands_on_four_corners_and_leans_on_one() {
    let standing = found(&[PLANE, CUBE], |s| s[1].pose.p.z = 0.5, 0.01);
    assert_eq!(standing.len(), 4);
    assert!(standing.iter().all(|c| c.gap.abs() < 1e-15 && c.normal == Vector3::z()));
    let height = 0.75f64.sqrt();
    let tilt = UnitQuaternion::rotation_between(&Vector3::repeat(1.0), &Vector3::z()).unwrap();
    let on_a_corner =
        found(&[CUBE, PLANE], |s| (s[0].pose.p.z, s[0].pose.q) = (height, tilt), 0.01);
    assert_eq!(on_a_corner.len(), 1);
    assert!(on_a_corner[0].gap.abs() < 1e-14 && on_a_corner[0].point.norm() < 1e-14);
    assert_eq!(on_a_corner[0].contact.bodies, [Some(1), Some(0)]); // the plane carries the normal
}

#[test]
fn a_ball_touches_a_face_an_edge_or_a_corner_of_a_box() {
    let r = 0.5;
    let cases = [
        (Vector3::new(0.1, 0.2, 0.5 + r), "face", Vector3::z()),
        (Vector3::new(0.1, 0.5 + 0.6 * r, 0.5 + 0.8 * r), "edge", Vector3::new(0.0, 0.6, 0.8)),
        (Vector3::repeat(0.5 + r / 3f64.sqrt()), "centers", Vector3::repeat(1.0 / 3f64.sqrt())),
        (Vector3::new(0.45, 0.0, 0.0), "face", Vector3::x()), // the center is inside
    ];
    for (center, kind, n) in cases {
        let touching = found(&[CUBE, BALL], |s| s[1].pose.p = center, 0.01);
        let [only] = &touching[..] else { panic!("{} contacts", touching.len()) };
        let found = match only.contact.normal {
            Normal::Face(_) => "face",
            Normal::Edge(_) => "edge",
            Normal::Centers => "centers",
            Normal::Edges(_) => "edges",
            Normal::Rim(_) => "rim",
        };
        assert_eq!(found, kind);
        assert!((only.normal - n).norm() < 1e-14, "{}", only.normal);
    }
}

#[test]
fn two_crossing_edges_touch_in_one_point() {
    // The lower cube is rotated about x, the upper about y, each by 45 degrees: an edge along x of
    // the lower one meets an edge along y of the upper one in the middle.
    let height = 2.0 * 0.5f64.sqrt() + 0.001;
    let turned =
        |axis: Vector3<f64>| UnitQuaternion::from_scaled_axis(axis * std::f64::consts::FRAC_PI_4);
    let states = |s: &mut [State]| {
        s[0].pose.q = turned(Vector3::x());
        s[1].pose.q = turned(Vector3::y());
        s[1].pose.p.z = height;
    };
    let touching = found(&[CUBE, CUBE], states, 0.01);
    assert_eq!(touching.len(), 1);
    assert!(matches!(touching[0].contact.normal, Normal::Edges(_)));
    assert!((touching[0].gap - 0.001).abs() < 1e-12, "{}", touching[0].gap);
    assert!((touching[0].normal - Vector3::z()).norm() < 1e-12);
}

#[test]
fn the_ids_of_one_instant_differ() {
    let stack = Scene::load("stack").unwrap();
    let mut ids: Vec<_> = contacts(&stack, &stack.states, 0.01).iter().map(|c| c.id).collect();
    assert_eq!(ids.len(), 20); // four corners for each of five boxes
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), 20);
}

#[test]
fn joined_bodies_and_fixed_pairs_do_not_collide() {
    let joined = format!(
        "[[bodies]]\nname = \"a\"\n{BALL}\n[[bodies]]\nname = \"b\"\n{BALL}\n\
         [[constraints]]\nkind = \"ball\"\nbodies = [\"a\", \"b\"]\n"
    );
    let scene = Scene::from_toml("test.toml", &joined).unwrap();
    assert!(contacts(&scene, &scene.states, 1.0).is_empty());
    let fixed = "fixed = true\nshape = { sphere = 0.5 }";
    assert!(found(&[PLANE, fixed], |_| (), 1.0).is_empty());
}
