//! Regular structures: sizes and positions.

use lcplab_mechanics::body::Shape;
use lcplab_mechanics::scene::generate::Rope;
use lcplab_mechanics::scene::{Scene, contacts};

fn scene(generator: &str) -> Scene {
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    Scene::from_toml("made.toml", &format!("[generate]\n{generator}\n{ground}")).unwrap()
}

#[test]
fn the_tower_has_the_chapters_700_cubes_each_on_its_neighbors() {
    let tower = scene("kind = \"circular_tower\"\ncount = 700\nsize = 1\nmass = 1");
    assert_eq!(tower.bodies.len(), 701);
    let found = contacts(&tower, &tower.states, 1e-9);
    let pairs: std::collections::BTreeSet<_> = found.iter().map(|found| found.id.bodies).collect();
    // 35 cubes touch the ground, each of the 665 others the two below it, and none its neighbors.
    assert_eq!(pairs.len(), 35 + 2 * 665);
    assert!(found.iter().all(|found| found.gap.abs() < 1e-9 && found.normal.z.abs() > 1.0 - 1e-9));
}

#[test]
fn cards_touch_and_do_not_enter_each_other() {
    let house =
        scene("kind = \"card_house\"\nlevels = 3\nsize = [0.01, 0.4, 0.6]\nlean = 25\nmass = 0.1");
    assert_eq!(house.bodies.len(), 1 + 12 + 3);
    let found = contacts(&house, &house.states, 1e-9);
    assert!(found.iter().all(|found| found.gap > -1e-9));
    let touches = |a: &str, b: &str| {
        let pair = [house.body(a).unwrap(), house.body(b).unwrap()];
        found.iter().any(|found| found.id.bodies == [pair[0].min(pair[1]), pair[0].max(pair[1])])
    };
    assert!(touches("ground", "left 0 0") && touches("left 0 0", "right 0 0"));
    assert!(touches("right 0 0", "level 0 1") && touches("level 0 1", "left 1 0"));
}

#[test]
fn a_leaning_domino_stands_on_its_edge() {
    let row = scene(
        "kind = \"dominoes\"\ncount = 3\nsize = [0.1, 0.5, 1]\nspacing = 0.5\nmass = 1\nlean = 20",
    );
    let found = contacts(&row, &row.states, 1e-9);
    let lowest = |name: &str| {
        let body = row.body(name).unwrap();
        let gaps = found.iter().filter(|found| found.id.bodies.contains(&body));
        gaps.map(|found| found.gap).fold(f64::INFINITY, f64::min)
    };
    assert!(lowest("domino1").abs() < 1e-12 && lowest("domino2").abs() < 1e-12);
    assert!(row.states[row.body("domino1").unwrap()].pose.p.x > 0.0);
}

#[test]
fn a_rope_spans_its_ends_with_links_of_one_length() {
    let text = "kind = \"rope\"\nlinks = 9\nlength = 3\nspan = 2\nmass = 0.1";
    let rope = scene(text);
    let points: Vec<_> = rope.bodies.iter().zip(&rope.states).collect();
    let points: Vec<_> = points
        .iter()
        .filter(|(body, _)| body.shape == Shape::Point)
        .map(|(_, state)| state.pose.p)
        .collect();
    assert_eq!(points.len(), 8);
    for pair in points.windows(2) {
        assert!(((pair[1] - pair[0]).norm() - 3.0 / 9.0).abs() < 1e-12);
    }
    assert!((points[0].norm() - 3.0 / 9.0).abs() < 1e-12);
    // Symmetric: the last point mirrors the first.
    assert!((points[7].x + points[0].x - 2.0).abs() < 1e-12);
    assert!((points[7].z - points[0].z).abs() < 1e-12);
}

#[test]
fn the_links_of_a_rope_balance_at_every_mass() {
    // Horizontal force H = m g / κ on either side, vertical difference m g.
    let rope = Rope { links: 8, length: 2.0, span: 1.0, mass: 0.3 };
    let (slopes, kappa) = rope.catenary();
    for pair in slopes.windows(2) {
        assert!((pair[1] - pair[0] - kappa).abs() < 1e-12 * kappa);
    }
    let width: f64 = slopes.iter().map(|slope| 0.25 * slope.atan().cos()).sum();
    assert!((width - 1.0).abs() < 1e-12);
}

#[test]
fn a_pyramid_has_a_triangular_number_of_cubes() {
    let text = "kind = \"pyramid\"\nbase = 5\nsize = 1\nspacing = 1.1\nmass = 1";
    assert_eq!(scene(text).bodies.len(), 1 + 15);
}
