//! The mass of capsules and hulls, and the frame of a hull.

use lcplab_mechanics::body::{Mass, Polytope, Shape, inertia};
use lcplab_mechanics::scene::Scene;
use nalgebra::{Matrix3, UnitQuaternion, Vector3};
use proptest::prelude::*;

use lcplab_testing::cases;

fn scene(body: &str) -> Scene {
    let text = format!("[[bodies]]\nname = \"it\"\n{body}\n");
    Scene::from_toml("hull.toml", &text).unwrap()
}

fn hull(points: &[Vector3<f64>]) -> String {
    let points: Vec<String> =
        points.iter().map(|p| format!("[{}, {}, {}]", p.x, p.y, p.z)).collect();
    format!("{{ hull = [{}] }}", points.join(", "))
}

fn corners(edges: Vector3<f64>) -> Vec<Vector3<f64>> {
    let sign = |k: usize, i: usize| if k >> i & 1 == 1 { 0.5 } else { -0.5 };
    (0..8).map(|k| Vector3::from_fn(|i, _| sign(k, i) * edges[i])).collect()
}

fn moments(scene: &Scene) -> Vector3<f64> {
    let Mass::Rigid { moments, .. } = scene.bodies[0].mass else { panic!("a rigid body") };
    moments
}

#[test]
fn a_capsule_is_a_cylinder_between_two_half_balls() {
    // Compared with the integral over disks perpendicular to the axis: ∫π ρ² dz, ∫½ρ⁴π dz,
    // ∫(¼ρ⁴ + ρ²z²)π dz.
    let (l, r) = (0.7, 0.4);
    let n = 200_000;
    let width = 2.0 * (l + r) / f64::from(n);
    let (mut volume, mut along, mut across) = (0.0, 0.0, 0.0);
    for k in 0..n {
        let z = -(l + r) + (f64::from(k) + 0.5) * width;
        let beyond = (z.abs() - l).max(0.0);
        let square = r * r - beyond * beyond;
        let disc = std::f64::consts::PI * square * width;
        volume += disc;
        along += disc * square / 2.0;
        across += disc * (square / 4.0 + z * z);
    }
    let capsule = Shape::Capsule { half_length: l, radius: r };
    let near = |ours: f64, exact: f64| assert!((ours / exact - 1.0).abs() < 1e-9, "{ours} {exact}");
    near(inertia::volume(&capsule).unwrap(), volume);
    let moments = inertia::moments(&capsule, 3.0).unwrap();
    near(moments.z, along * 3.0 / volume);
    near(moments.x, across * 3.0 / volume);
    assert_eq!(moments.x, moments.y);
}

#[test]
fn a_capsule_without_length_weighs_as_a_ball() {
    let near_ball = Shape::Capsule { half_length: 1e-12, radius: 0.5 };
    let ball = Shape::Sphere { radius: 0.5 };
    let [a, b] = [near_ball, ball].map(|shape| inertia::moments(&shape, 2.0).unwrap());
    assert!((a - b).norm() < 1e-11);
}

#[test]
fn a_right_tetrahedron_has_its_textbook_volume_center_and_moments() {
    // Legs of length 1 from the corner at the origin: V = 1/6, center (¼, ¼, ¼); per mass ∫x² =
    // 1/10 and ∫xy = 1/20, so about the center I_xx = 2 (1/10 − 1/16) = 3/40, I_xy = −(1/20 −
    // 1/16) = 1/80.
    let points = [Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let scene = scene(&format!("density = 6\nshape = {}", hull(&points)));
    assert!((scene.bodies[0].mass.mass() - 1.0).abs() < 1e-14);
    assert!((scene.states[0].pose.p - Vector3::repeat(0.25)).norm() < 1e-15);
    let textbook = Matrix3::from_fn(|i, j| if i == j { 3.0 / 40.0 } else { 1.0 / 80.0 });
    let world = scene.bodies[0].mass.world_inertia(&scene.states[0].pose);
    assert!((world - textbook).norm() < 1e-14, "{world}");
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn the_hull_of_a_box_anywhere_is_that_box(
        edges in [0.2..3.0, 0.2..3.0, 0.2..3.0], place in [-5.0..5.0, -5.0..5.0, -5.0..5.0],
        turn in [-2.0..2.0, -2.0..2.0, -2.0..2.0],
    ) {
        let (edges, place) = (Vector3::from(edges), Vector3::from(place));
        let q = UnitQuaternion::from_scaled_axis(Vector3::from(turn));
        let mut points: Vec<_> = corners(edges).iter().map(|p| q * p + place).collect();
        points.push(place); // a point within changes nothing
        let scene = scene(&format!("mass = 2\nshape = {}", hull(&points)));
        let (body, pose) = (&scene.bodies[0], scene.states[0].pose);
        let exact = Shape::Box { half: edges / 2.0 };
        let volume = inertia::volume(&body.shape).unwrap();
        prop_assert!((volume / inertia::volume(&exact).unwrap() - 1.0).abs() < 1e-12);
        prop_assert!((pose.p - place).norm() < 1e-12);
        let sorted = |mut moments: Vec<f64>| { moments.sort_by(f64::total_cmp); moments };
        let exact_moments = inertia::moments(&exact, 2.0).unwrap();
        let ours = sorted(moments(&scene).as_slice().to_vec());
        for (a, b) in ours.iter().zip(sorted(exact_moments.as_slice().to_vec())) {
            prop_assert!((a / b - 1.0).abs() < 1e-10, "{a} {b}");
        }
        let r = q.to_rotation_matrix().into_inner();
        let world = r * Matrix3::from_diagonal(&exact_moments) * r.transpose();
        let difference = body.mass.world_inertia(&pose) - world;
        prop_assert!(difference.norm() < 1e-10 * world.norm());
        // The corners are where they were given, and none was dropped.
        let Shape::Hull(polytope) = &body.shape else { panic!("a hull") };
        prop_assert_eq!(polytope.vertices.len(), 8);
        prop_assert_eq!((polytope.edges.len(), polytope.faces.len()), (12, 6));
        for vertex in &polytope.vertices {
            let world = pose.point(vertex);
            prop_assert!(points.iter().any(|p| (p - world).norm() < 1e-12));
        }
    }

    #[test]
    fn a_hull_is_convex_closed_and_made_the_same_way_twice(
        points in proptest::collection::vec([-1.0..1.0, -1.0..1.0, -1.0..1.0], 5..40),
    ) {
        let points: Vec<Vector3<f64>> = points.into_iter().map(Vector3::from).collect();
        let hull = Polytope::hull(&points).unwrap();
        prop_assert_eq!(&hull, &Polytope::hull(&points).unwrap());
        let (v, e, f) = (hull.vertices.len(), hull.edges.len(), hull.faces.len());
        prop_assert_eq!(v + f, e + 2); // Euler
        // Neighboring faces whose normals differ by less than 1.8e-4 are merged; the corners of the
        // merged face lie out of its plane by that much times their distance, at most √12.
        for face in &hull.faces {
            let corner = hull.vertices[face.corners[0]];
            for point in &points {
                prop_assert!(face.normal.dot(&(point - corner)) < 6.5e-4);
            }
        }
    }
}

#[test]
fn axes_that_are_principal_already_stay() {
    let scene =
        scene(&format!("mass = 1\nshape = {}", hull(&corners(Vector3::new(1.0, 2.0, 3.0)))));
    assert_eq!(scene.states[0].pose.q, UnitQuaternion::identity());
}

#[test]
fn shapes_that_cannot_be_are_refused() {
    let message = |shape: &str| {
        let text = format!("[[bodies]]\nname = \"it\"\nmass = 1\nshape = {shape}\n");
        Scene::from_toml("bad.toml", &text).unwrap_err().to_string()
    };
    assert_eq!(
        message("{ hull = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0]] }"),
        "bad.toml: line 4: bodies[0].shape.hull: 4 points that span no volume"
    );
    assert_eq!(
        message("{ hull = [] }"),
        "bad.toml: line 4: bodies[0].shape.hull: 0 points that span no volume"
    );
    assert_eq!(
        message("{ capsule = { length = 1, radius = -1 } }"),
        "bad.toml: line 4: bodies[0].shape.capsule.radius: must be positive, is -1"
    );
}
