use lcplab_page::plot::style::width;
use lcplab_page::plot::{Axis, Figure, Lines, Panel, Scale, Series};

use super::assert_well_formed;

fn figure(x: Scale, y: Scale, series: Vec<Series>) -> Lines {
    let axis = |scale, label: &str| Axis { scale, ..Axis::linear(label, "s") };
    let panels = vec![Panel { y: axis(y, "y"), series }];
    let (title, caption) = ("A title".into(), "A caption.".into());
    Lines { id: "test".into(), title, caption, x: axis(x, "x"), panels }
}

/// The vertices of the polylines in the picture.
fn vertices(svg: &str) -> usize {
    let lines = svg.split("<polyline").skip(1);
    let points = lines.filter_map(|line| line.split("points=\"").nth(1)?.split('"').next());
    points.map(|points| points.split_whitespace().count()).sum()
}

#[test]
fn the_drawing_is_thinned_and_the_csv_is_not() {
    let points: Vec<_> = (0..100_000).map(|k| (k.into(), (f64::from(k) * 0.1).sin())).collect();
    let figure = figure(Scale::Linear, Scale::Linear, vec![Series::measured("pgs", points)]);
    assert_eq!(figure.csv().lines().count(), 100_001);
    assert!(vertices(&figure.svg()) < 4 * 880);
    assert_well_formed(&figure);
}

#[test]
fn points_are_all_marked_none_joined_and_decide_the_range() {
    let points: Vec<_> = (0..40).map(|k| (f64::from(k), f64::from(k % 7))).collect();
    let theory = Series::theory("theory", vec![(-1e3, -1e3), (1e3, 1e3)]);
    let alone = |series| figure(Scale::Linear, Scale::Linear, series).svg();
    let svg = alone(vec![Series::points("pgs", points.clone())]);
    // A marker each and one in the legend, no curve.
    let series = svg.split("class=\"series\"").nth(1).unwrap();
    assert_eq!(series.matches("<polygon").count(), points.len());
    assert_eq!(series.matches("<polyline").count(), 0);
    let both = alone(vec![Series::points("pgs", points), theory]);
    let ticks = |svg: &str| svg.matches(">20</text>").count();
    assert_eq!((ticks(&svg), ticks(&both)), (1, 1));
}

#[test]
fn a_spot_is_a_ring_in_the_color_of_its_curve_and_bands_have_the_key_that_they_state() {
    let points = || vec![(0.0, 1.0), (1.0, 0.0), (2.0, 1.0)];
    let series = vec![
        Series::measured("pgs", points()).labeled(""),
        Series::theory("theory, pgs: closed form", points()).labeled(""),
        Series::spot("pgs", "least", (1.0, 0.0)).labeled("pgs"),
    ];
    let figure = figure(Scale::Linear, Scale::Linear, series);
    let svg = figure.svg();
    // One on the curve, and one in the legend.
    assert_eq!(svg.matches("<circle").count(), 2);
    let ring =
        svg.split("<circle").find(|part| part.contains("#005EAA") || part.contains("#005eaa"));
    assert!(ring.is_some(), "the color of pgs");
    assert_eq!(svg.matches(">closed form</text>").count(), 1);
    assert_eq!(svg.matches(">least</text>").count(), 1);
    assert_eq!(svg.matches(">theory</text>").count(), 0);
    assert_well_formed(&figure);
}

#[test]
fn a_symmetric_axis_has_ticks_within_its_decades_and_long_ones_where_it_ceases_to_be_linear() {
    let ticks = |scale: Scale| {
        let points = vec![(0.0, -30.0), (1.0, 300.0)];
        let svg = figure(Scale::Linear, scale, vec![Series::measured("pgs", points)]).svg();
        let lines = svg.split("points=\"").skip(1).filter_map(|part| part.split('"').next());
        let lengths = lines.filter_map(|line| {
            let ends: Vec<f64> =
                line.split([' ', ',']).filter_map(|number| number.parse().ok()).collect();
            let [x0, y0, x1, y1] = ends[..] else { return None };
            (y0 == y1).then_some(x1 - x0)
        });
        let lengths: Vec<f64> = lengths.collect();
        [120.0, 40.0].map(|long| lengths.iter().filter(|own| **own == long).count())
    };
    // Linear up to 1: −1 and 1 are long; −2, −5, −10, −20, 2, 5, … 200 are short.
    assert_eq!(ticks(Scale::Symmetric(0)), [2, 4 + 7]);
    assert_eq!(ticks(Scale::Linear), [0, 0]);
}

#[test]
fn a_lone_peak_survives_thinning() {
    let heights = |k: i32| if k == 54_321 { 1.0 } else { 0.0 };
    let points = |wide| (0..100_000).map(|k| (k.into(), wide * heights(k))).collect();
    let drawn = |wide| {
        figure(Scale::Linear, Scale::Linear, vec![Series::measured("pgs", points(wide))]).svg()
    };
    assert!(vertices(&drawn(1.0)) > vertices(&drawn(0.0)));
}

#[test]
fn points_without_a_place_neither_panic_nor_leave_the_csv() {
    let wild = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 5e-324, f64::MAX, 1.0];
    let points: Vec<_> = wild.iter().flat_map(|x| wild.map(|y| (*x, y))).collect();
    for x in [Scale::Linear, Scale::Log] {
        for y in [Scale::Linear, Scale::Log] {
            let kinds = [Series::measured, Series::theory, Series::reference];
            let series = kinds.map(|new| new("pgs".to_string(), points.clone())).into();
            let figure = figure(x, y, series);
            assert_well_formed(&figure);
            assert_eq!(figure.csv().lines().count(), 3 * points.len() + 1);
        }
    }
}

#[test]
fn any_range_has_a_picture() {
    for value in [0.0, 1.0, -3.0, 1e-300, 1e300, 5e-324, f64::MAX] {
        for spread in [0.0, 1e-16, 1e-3, 1.0, 1e9] {
            for scale in [Scale::Linear, Scale::Log] {
                let points = vec![(value, value), (value + value * spread, value * spread)];
                assert_well_formed(&figure(scale, scale, vec![Series::measured("pgs", points)]));
            }
        }
    }
}

#[test]
fn a_figure_without_points_is_drawn() {
    let mut figure = figure(Scale::Log, Scale::Log, vec![Series::measured("pgs", Vec::new())]);
    assert_well_formed(&figure);
    figure.panels[0].series.clear();
    assert_well_formed(&figure);
    figure.panels.clear();
    assert_well_formed(&figure);
}

#[test]
fn an_exact_zero_on_a_log_axis_is_marked_and_named() {
    let points = vec![(0.0, 1.0), (1.0, 1e-3), (2.0, 0.0)];
    let log = figure(Scale::Linear, Scale::Log, vec![Series::measured("pgs", points.clone())]);
    assert!(log.svg().contains(">exactly 0</text>"));
    let linear = figure(Scale::Linear, Scale::Linear, vec![Series::measured("pgs", points)]);
    assert!(!linear.svg().contains("exactly 0"));
}

#[test]
fn a_prediction_does_not_widen_the_axis() {
    let fall = |to: i32| (0..=to).map(|k| (k.into(), 10f64.powi(-k))).collect();
    let mut series = vec![Series::measured("pgs", fall(4))];
    let alone = figure(Scale::Linear, Scale::Log, series.clone()).svg();
    series.push(Series::theory("slope", fall(40)));
    let both = figure(Scale::Linear, Scale::Log, series).svg();
    assert!(alone.contains(">10⁻⁴<") && both.contains(">10⁻⁴<") && !both.contains(">10⁻⁸<"));
}

#[test]
fn names_are_escaped() {
    let mut figure = figure(
        Scale::Linear,
        Scale::Linear,
        vec![Series::measured("<b>\"&\u{1}", vec![(0.0, 0.0), (1.0, 1.0)])],
    );
    figure.title = "</title><script>".into();
    figure.caption = "a < b".into();
    assert_well_formed(&figure);
    assert!(figure.svg().contains("&lt;b&gt;&quot;&amp;</text>"));
    assert!(figure.csv().contains("\"<b>\"\"&\u{1}\",measured,1,1\n"));
}

#[test]
fn stacked_panels_share_the_time_and_have_a_column_each() {
    let panel = |label: &str, unit: &str| Panel {
        y: Axis::linear(label, unit),
        series: vec![Series::measured("velocity, dt/2", vec![(0.0, 0.5)])],
    };
    let panels = vec![panel("energy", "J"), panel("drift", "m")];
    let (title, caption) = ("Pendulum".into(), String::new());
    let figure =
        Lines { id: "energy".into(), title, caption, x: Axis::linear("time", "s"), panels };
    assert_well_formed(&figure);
    assert_eq!(figure.svg().matches(">time (s)</text>").count(), 1);
    assert_eq!(figure.svg().matches(">velocity, dt/2</text>").count(), 1);
    assert_eq!(
        figure.csv(),
        "series,kind,time (s),energy (J),drift (m)\n\
         \"velocity, dt/2\",measured,0,0.5,\n\
         \"velocity, dt/2\",measured,0,,0.5\n"
    );
}

#[test]
fn labels_at_the_ends_replace_the_legend_and_lie_apart() {
    let curve = |name: &str, end| {
        Series::measured(name, vec![(0.0, 0.0), (1.0, end)]).labeled(format!("{name}: first order"))
    };
    let theory = Series::theory("theory, pgs", vec![(0.0, 0.0), (1.0, 1.0)]);
    let series = vec![curve("pgs", 1.0), curve("sor", 1.0), curve("lemke", 0.999), theory];
    let svg = figure(Scale::Linear, Scale::Linear, series).svg();
    let label = |name: &str| svg.split(&format!(">{name}: first order</text>")).next().unwrap();
    let place = |name: &str, key: &str| -> f64 {
        let tag = label(name).rsplit("<text ").next().unwrap();
        let value = tag.split(&format!("{key}=\"")).nth(1).unwrap();
        value.split('"').next().unwrap().parse().unwrap()
    };
    let mut heights = ["pgs", "sor", "lemke"].map(|name| place(name, "y"));
    heights.sort_by(f64::total_cmp);
    assert!(heights[1] - heights[0] >= 16.0 && heights[2] - heights[1] >= 16.0, "{heights:?}");
    assert!(place("pgs", "x") > 600.0);
    // A switch for each curve, and one for all theories.
    assert_eq!(svg.matches("class=\"entry\"").count(), 4);
    assert_eq!(svg.matches("data-of=\"pgs\"").count(), 1, "the theory of a curve goes with it");
}

#[test]
fn labels_too_wide_for_a_narrow_picture_stand_above_the_panel() {
    let curve = |name: &str, end| {
        let label = format!("{name} with a sentence about it");
        Series::measured(name, vec![(0.0, 0.0), (1.0, end)]).labeled(label)
    };
    let figure = figure(Scale::Linear, Scale::Linear, vec![curve("pgs", 1.0), curve("sor", 0.5)]);
    let svg = figure.narrow().unwrap();
    // Each label is whole, on one line, in a row of its own, above the tick of the largest value.
    let height = |text: &str| -> f64 {
        let tag = svg.split(text).next().unwrap().rsplit("<text ").next().unwrap();
        tag.split(" y=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
    };
    let labels = ["pgs", "sor"].map(|name| height(&format!(">{name} with a sentence about it<")));
    assert!(labels[0] + 14.0 <= labels[1] && labels[1] < height(">1</text>"), "{labels:?}");
}

/// The middle, width and height (px) of a label inside a plot.
fn label(svg: &str, text: &str) -> (f64, f64, f64) {
    let tag =
        svg.split(&format!(">{text}</text>")).next().unwrap().rsplit("<text ").next().unwrap();
    let number = |key: &str| -> f64 {
        let value = tag.split(&format!("{key}=\"")).nth(1).unwrap();
        value.split('"').next().unwrap().parse().unwrap()
    };
    (number("x"), number("y") - 4.5, width(text, number("font-size")))
}

/// The points (px), at most 1 px apart, of all lines in the picture.
fn drawn_points(svg: &str) -> Vec<(f64, f64)> {
    let curves = svg.split("class=\"series\"").skip(1);
    let lines = curves
        .flat_map(|curve| curve.split("</g>\n</g>").next().unwrap().split("<polyline").skip(1));
    let vertices = lines.map(|line| {
        let points = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
        let point = |pair: &str| {
            let (x, y) = pair.split_once(',').unwrap();
            (x.parse::<f64>().unwrap() / 10.0, y.parse::<f64>().unwrap() / 10.0)
        };
        points.split_whitespace().map(point).collect::<Vec<_>>()
    });
    let mut all = Vec::new();
    for line in vertices {
        for ends in line.windows(2) {
            let (a, b) = (ends[0], ends[1]);
            let steps = (b.0 - a.0).hypot(b.1 - a.1).ceil().max(1.0);
            all.extend((0..=steps as usize).map(|k| {
                let part = k as f64 / steps;
                (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1))
            }));
        }
    }
    all
}

#[test]
fn labels_inside_the_plot_cover_no_curve_and_no_other_label() {
    // Eight curves that fall at different times, a vertical and a horizontal line.
    let names = ["pgs", "sor", "lemke", "jacobi", "newton", "apgd", "nncg", "mprgp"];
    let curve = |(k, name): (usize, &&str)| {
        let end = 8.0 + 7.0 * k as f64;
        let points = (0..=40).map(|i| f64::from(i) / 40.0);
        let points = points.map(|t| (end * t, 1.0 - t.powi(4))).collect();
        Series::measured(*name, points).labeled(*name)
    };
    let mut series: Vec<Series> = names.iter().enumerate().map(curve).collect();
    series.push(Series::reference("budget", vec![(20.0, 0.0), (20.0, 1.0)]).labeled("budget"));
    series.push(Series::reference("tolerance", vec![(0.0, 0.1), (90.0, 0.1)]).labeled("tolerance"));
    series.push(Series::measured("late", vec![(0.0, 0.98), (90.0, 0.9)]));
    let labels = [&names[..], &["budget", "tolerance"]].concat();
    let svg = figure(Scale::Linear, Scale::Linear, series).svg();
    assert_eq!(svg.matches("rotate(-90").count(), 0);
    let curves = drawn_points(&svg);
    assert!(curves.len() > 1000);
    let boxes: Vec<_> = labels.iter().map(|text| label(&svg, text)).collect();
    for (text, (x, y, wide)) in labels.iter().zip(&boxes) {
        let is_covered =
            |point: &&(f64, f64)| (point.0 - x).abs() < wide / 2.0 && (point.1 - y).abs() < 6.0;
        assert_eq!(curves.iter().find(is_covered), None, "{text}");
        let overlap = |other: &&(f64, f64, f64)| {
            (other.0 - x).abs() < (other.2 + wide) / 2.0 && (other.1 - y).abs() < 14.0
        };
        assert_eq!(boxes.iter().filter(overlap).count(), 1, "{text} and another label");
    }
}

#[test]
fn more_than_four_labels_inside_stand_above_the_panel_of_a_narrow_picture() {
    let early =
        |name: &str, end| Series::measured(name, vec![(0.0, 1.0), (end, 0.0)]).labeled(name);
    let names = ["pgs", "sor", "lemke", "newton", "apgd"];
    let line = Series::reference("tolerance", vec![(0.0, 0.5), (9.0, 0.5)]).labeled("tolerance");
    let late = Series::measured("jacobi", vec![(0.0, 1.0), (9.0, 0.0)]).labeled("jacobi");
    for count in [4, 5] {
        let mut series: Vec<Series> =
            names.iter().zip(1..=count).map(|(name, end)| early(name, end.into())).collect();
        series.extend([line.clone(), late.clone()]);
        let svg = figure(Scale::Linear, Scale::Linear, series).narrow().unwrap();
        let tick = label(&svg, "1").1;
        let above = |name: &&&str| label(&svg, name).1 < tick;
        let above = names.iter().take(count as usize).filter(above).count();
        assert_eq!(above, if count > 4 { count as usize } else { 0 });
        // A line of reference keeps its label.
        assert!(label(&svg, "tolerance").1 > tick);
    }
}

#[test]
fn curves_that_end_together_have_their_labels_where_they_start_apart() {
    let curve =
        |name: &str, start| Series::measured(name, vec![(0.0, start), (9.0, 0.0)]).labeled(name);
    let apart = ["pgs", "sor", "lemke"].iter().zip([1.0, 2.0, 3.0]);
    let svg =
        figure(Scale::Linear, Scale::Linear, apart.map(|(name, y)| curve(name, y)).collect()).svg();
    for name in ["pgs", "sor", "lemke"] {
        assert!(label(&svg, name).0 < 440.0, "{name}");
    }
}

#[test]
fn a_symmetric_axis_is_linear_near_zero_and_logarithmic_beyond_and_odd() {
    // sign(v) lg(1 + |v|/10): 90 is at 1, 990 at 2, −90 at −1.
    let points = vec![(0.0, 0.0), (1.0, 990.0), (2.0, 90.0), (3.0, -990.0), (4.0, -90.0)];
    let svg =
        figure(Scale::Linear, Scale::Symmetric(1), vec![Series::measured("pgs", points)]).svg();
    let line = svg.split("class=\"series\"").nth(1).unwrap();
    let line = line.split("<polyline").nth(1).unwrap();
    let line = line.split("points=\"").nth(1).unwrap().split('"').next().unwrap();
    let y: Vec<f64> = line
        .split_whitespace()
        .map(|pair| pair.split_once(',').unwrap().1.parse::<f64>().unwrap() / 10.0)
        .collect();
    let unit = (y[0] - y[1]) / 2.0;
    assert!(unit > 20.0);
    for (k, at) in [0.0, 2.0, 1.0, -2.0, -1.0].iter().enumerate() {
        assert!((y[0] - y[k] - at * unit).abs() < 0.3, "{k}: {y:?}");
    }
    for tick in ["0", "100", "−100"] {
        assert!(svg.contains(&format!(">{tick}</text>")), "{tick}");
    }
}
