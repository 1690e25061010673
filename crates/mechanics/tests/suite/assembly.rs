//! Matrices of a scene at one instant.

use lcplab_mechanics::assembly::{Assembly, ConstraintFilter, RowId, Source};
use lcplab_mechanics::constraint::Bounds;
use lcplab_mechanics::scene::{Scene, step_contacts};
use nalgebra::DMatrix;

fn assembled(name: &str, entering: ConstraintFilter) -> (Scene, Assembly) {
    let scene = Scene::load(name).unwrap();
    let found = step_contacts(&scene, &scene.states);
    let assembly = Assembly::new(&scene, &scene.states, &found, entering).unwrap();
    (scene, assembly)
}

fn jacobian(assembly: &Assembly) -> DMatrix<f64> {
    let mut dense = DMatrix::zeros(assembly.rows.len(), assembly.columns());
    for i in 0..assembly.rows.len() {
        for (j, value) in assembly.jacobian_row(i) {
            dense[(i, j)] = value;
        }
    }
    dense
}

#[test]
fn degrees_of_freedom_are_counted_by_rank_and_not_by_rows() {
    let counts = |name| {
        let (_, assembly) = assembled(name, ConstraintFilter::Near);
        (assembly.columns(), assembly.rows.len(), assembly.degrees_of_freedom())
    };
    assert_eq!(counts("dzhanibekov"), (6, 0, 6));
    assert_eq!(counts("pendulum"), (3, 1, 2)); // a point on a sphere
    assert_eq!(counts("bricard"), (30, 30, 1)); // overconstrained, and yet it moves
}

#[test]
fn fixed_bodies_have_no_columns_and_point_masses_three() {
    let (_, fig6) = assembled("fig6", ConstraintFilter::Near);
    assert_eq!((fig6.columns(), fig6.rows.len()), (3, 1));
    let (_, stack) = assembled("stack", ConstraintFilter::Near);
    assert_eq!((stack.columns(), stack.rows.len()), (30, 5 * 4 * 3));
}

#[test]
fn the_jacobian_of_figure_7_is_that_of_the_gap_rates() {
    // Rows ground-bottom, bottom-middle, middle-top; the columns of v_z.
    let (_, fig7) = assembled("fig7", ConstraintFilter::Near);
    let j = jacobian(&fig7);
    let v_z = DMatrix::from_fn(3, 3, |i, body| j[(i, 6 * body + 2)]);
    let expected = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0]);
    assert_eq!(v_z, expected);
    assert_eq!(j.iter().filter(|&&entry| entry != 0.0).count(), 5);
}

#[test]
fn pulling_back_is_the_transpose_of_pushing_forward() {
    let (_, stack) = assembled("stack", ConstraintFilter::Near);
    let x: Vec<f64> = (0..stack.rows.len()).map(|i| (i as f64).sin()).collect();
    let u: Vec<f64> = (0..stack.columns()).map(|j| (j as f64).cos()).collect();
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    let (left, right) = (dot(&stack.pull_back(&x), &u), dot(&x, &stack.push_forward(&u)));
    assert!((left - right).abs() < 1e-12);
    let dense = jacobian(&stack) * DMatrix::from_column_slice(u.len(), 1, &u);
    assert!((dense - DMatrix::from_vec(x.len(), 1, stack.push_forward(&u))).norm() < 1e-12);
}

#[test]
fn contact_rows_come_as_normal_and_two_tangents_bound_by_it() {
    let (_, stack) = assembled("stack", ConstraintFilter::Near);
    for (i, row) in stack.rows.iter().enumerate() {
        assert_eq!(row.id.component, i % 3);
        let expected = match i % 3 {
            0 => Bounds::Unilateral,
            component => Bounds::Friction { normal: i - component, mu: 0.5 },
        };
        assert_eq!(row.bounds, expected);
    }
}

#[test]
fn resting_contacts_enter_and_hitting_ones_only_touch() {
    // The middle body of Figure 7 leaves the top one and hits the bottom one.
    let count = |entering| assembled("fig7", entering).1.rows.len();
    assert_eq!(count(ConstraintFilter::Touching), 3);
    assert_eq!(count(ConstraintFilter::Resting), 2); // the row between middle and top parts
}

#[test]
fn rows_have_labels_and_names() {
    let (scene, pendulum) = assembled("pendulum", ConstraintFilter::Near);
    assert_eq!(pendulum.rows[0].label(&scene), "distance world bob 0");
    assert_eq!(pendulum.rows[0].id, RowId { source: Source::Constraint(0), component: 0 });
}
