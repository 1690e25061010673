use lcplab_page::plot::{Axis, Figure, Heat, Shaded};

use super::assert_well_formed;

fn heat(panels: Vec<Vec<Vec<f64>>>) -> Heat {
    let shaded = |(k, rows)| Shaded { name: format!("panel {k}"), rows };
    Heat {
        id: "test".into(),
        title: "A title".into(),
        caption: "A caption.".into(),
        across: "sweep".into(),
        upwards: "row".into(),
        value: Axis::log("residual", "m/s"),
        zero: 1e-14,
        panels: panels.into_iter().enumerate().map(shaded).collect(),
    }
}

/// The fills of the cells, without the scale.
fn fills(svg: &str) -> Vec<&str> {
    let paths = svg.split("<path fill=\"").skip(1);
    paths.map(|path| path.split('"').next().unwrap()).collect()
}

fn lightness(hex: &str) -> u32 {
    (1..7).step_by(2).map(|k| u32::from_str_radix(&hex[k..k + 2], 16).unwrap()).sum()
}

#[test]
fn larger_values_are_darker_and_what_is_rounding_is_left_white() {
    let figure = heat(vec![vec![vec![1.0, 1e-2, 1e-4, 1e-15, 0.0]]]);
    assert_well_formed(&figure);
    let svg = figure.svg();
    let fills = fills(&svg);
    assert_eq!(fills.len(), 3); // palest first
    assert!(fills.windows(2).all(|pair| lightness(pair[0]) > lightness(pair[1])), "{fills:?}");
}

#[test]
fn one_scale_serves_all_panels() {
    let alone = heat(vec![vec![vec![1e-3, 1.0]]]).svg();
    let beside = heat(vec![vec![vec![1e-3, 1.0]], vec![vec![1e-3]]]).svg();
    let (alone, beside) = (fills(&alone), fills(&beside));
    assert_eq!(beside, [alone[0], alone[1], alone[0]]);
}

#[test]
fn neighbors_of_one_shade_are_one_rectangle_and_the_csv_has_them_all() {
    let figure = heat(vec![vec![vec![1.0; 50], vec![1.0; 50]]]);
    let svg = figure.svg();
    let path = svg.split("<path").nth(1).unwrap();
    assert_eq!(path.split("/>").next().unwrap().matches('M').count(), 2);
    assert_eq!(figure.csv().lines().count(), 101);
    assert_eq!(figure.csv().lines().nth(1), Some("panel 0,0,0,1"));
}

#[test]
fn values_without_a_place_neither_panic_nor_leave_the_csv() {
    for value in [f64::NAN, f64::INFINITY, f64::MAX, 5e-324, 0.0] {
        let figure = heat(vec![vec![vec![value, 1.0], vec![value]], Vec::new()]);
        assert_well_formed(&figure);
        assert_eq!(figure.csv().lines().count(), 4);
        assert_well_formed(&heat(vec![vec![vec![value]]]));
    }
}
