use lcplab_page::plot::profile::{Curve, Group, Profiles};
use lcplab_page::plot::{Axis, Figure};

use super::assert_well_formed;

fn profiles() -> Profiles {
    let curve = |name: &str, counts: [usize; 2]| Curve {
        name: name.into(),
        columns: counts.map(|n| (vec![(1.0, 0.5), (10.0, 1.0)], n)).into(),
    };
    let group = |name: &str, curves| Group { name: name.into(), curves };
    Profiles {
        id: "test".into(),
        title: "A title".into(),
        caption: "A caption.".into(),
        x: Axis::log("τ", ""),
        y: Axis::linear("share", ""),
        columns: vec!["coarse".into(), "fine".into()],
        groups: vec![
            group("Sweeps", vec![curve("pgs", [4, 4])]),
            group("Pivoting", vec![curve("dantzig", [4, 3]), curve("lemke", [4, 4])]),
        ],
    }
}

#[test]
fn each_curve_says_of_how_many_problems_it_is() {
    let figure = profiles();
    assert_well_formed(&figure);
    let svg = figure.svg();
    for label in ["pgs (4)", "dantzig (4, 3)", "lemke (4)"] {
        assert!(svg.contains(&format!(">{label}</text>")), "{label}");
    }
    assert!(svg.contains("coarse: pgs from 0.5 to 1 of 4; dantzig from 0.5 to 1 of 4"));
}

#[test]
fn the_data_have_every_step_of_every_panel() {
    let csv = profiles().csv();
    assert_eq!(csv.lines().count(), 1 + 3 * 2 * 2);
    assert_eq!(csv.lines().next(), Some("panel,method,problems,τ,share"));
    assert!(csv.contains("fine,dantzig,3,10,1\n"));
}

#[test]
fn groups_with_one_panel_stand_side_by_side_without_counts() {
    let mut figure = profiles();
    let two = figure.svg();
    figure.columns.truncate(1);
    for group in &mut figure.groups {
        group.curves.iter_mut().for_each(|curve| curve.columns.truncate(1));
    }
    assert_well_formed(&figure);
    let height = |svg: &str| {
        svg.split("viewBox=\"0 0 ")
            .nth(1)
            .and_then(|own| own.split('"').next()?.split(' ').nth(1)?.parse::<f64>().ok())
    };
    assert!(height(&figure.svg()) < height(&two));
    assert!(figure.svg().contains(">pgs</text>"));
}

#[test]
fn a_solver_that_solves_nothing_has_a_line_at_zero() {
    let mut figure = profiles();
    figure.groups[0].curves[0].columns = vec![(Vec::new(), 4), (Vec::new(), 0)];
    assert_well_formed(&figure);
    assert!(figure.svg().contains("pgs from 0 to 0 of 4"));
}
