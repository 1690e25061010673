use lcplab_page::plot::plane::{Path, Plane};
use lcplab_page::plot::{Axis, Figure};

use super::assert_well_formed;

fn plane(bounds: (f64, f64), points: Vec<(f64, f64)>) -> Plane {
    let path = |name: &str| Path { name: name.into(), points: points.clone() };
    Plane {
        id: "test".into(),
        title: "A title".into(),
        caption: "A caption.".into(),
        x: Axis::linear("x", "N s"),
        w: Axis::linear("w", "m/s"),
        bounds,
        paths: vec![path("pgs"), path("dantzig"), path("sor")],
    }
}

/// The segments of the law in the first panel: (horizontal, vertical).
fn segments(figure: &Plane) -> (usize, usize) {
    let svg = figure.svg();
    let law = svg.split("class=\"law\"").nth(1).unwrap().split("</g>").next().unwrap();
    let points = law.split("points=\"").skip(1).map(|line| line.split('"').next().unwrap());
    let corners = points.map(|points| {
        let place =
            |pair: &str| -> Vec<f64> { pair.split(',').map(|v| v.parse().unwrap()).collect() };
        points.split_whitespace().map(place).collect::<Vec<_>>()
    });
    corners.fold((0, 0), |(level, upright), corners| {
        let same = |k: usize| corners.windows(2).filter(|ends| ends[0][k] == ends[1][k]).count();
        (level + same(1), upright + same(0))
    })
}

#[test]
fn the_law_has_the_segments_that_its_bounds_give_it() {
    let points = vec![(0.0, -1.0), (0.5, -0.2), (1.0, 0.0)];
    let unbounded = f64::INFINITY;
    assert_eq!(segments(&plane((0.0, unbounded), points.clone())), (1, 1)); // a contact: an L
    assert_eq!(segments(&plane((-1.0, 1.0), points.clone())), (1, 2)); // friction: a Z
    assert_eq!(segments(&plane((-unbounded, unbounded), points.clone())), (1, 0)); // a joint
    assert_eq!(segments(&plane((-1e6, unbounded), points)), (1, 0)); // the corner is far away
}

#[test]
fn every_path_is_in_the_picture_its_words_and_its_data() {
    let figure = plane((0.0, f64::INFINITY), vec![(0.0, -1.0), (1.0, 0.0)]);
    assert_well_formed(&figure);
    for name in ["pgs", "dantzig", "sor"] {
        assert!(figure.svg().contains(&format!(">{name}</text>")));
        assert!(figure.svg().contains(&format!("{name} goes from (0, −1) to (1, 0) in 1 steps")));
    }
    assert_eq!(figure.csv().lines().count(), 7);
    assert_eq!(figure.csv().lines().nth(2), Some("pgs,1,1,0"));
}

#[test]
fn paths_that_are_not_finite_still_have_a_picture() {
    for points in [vec![], vec![(f64::NAN, 0.0)], vec![(0.0, 0.0)], vec![(f64::INFINITY, 1.0)]] {
        assert_well_formed(&plane((0.0, f64::INFINITY), points));
    }
}
