use dashu_ratio::RBig;
use lcplab_judge::exact::prove;
use lcplab_lcp::{Lcp, Matrix};

use lcplab_testing::{INF, contacts};

fn fraction(n: i64, d: u64) -> RBig {
    RBig::from_parts(n.into(), d.into())
}

#[test]
fn the_exact_solution_is_the_fraction_not_the_nearest_number() {
    // The circulant [1 2 0; 0 1 2; 2 0 1] with b = −1 has x = (1/3, 1/3, 1/3).
    let lcp = contacts(&[&[1.0, 2.0, 0.0], &[0.0, 1.0, 2.0], &[2.0, 0.0, 1.0]], &[-1.0; 3]);
    let x = [1.0 / 3.0; 3];
    let proof = prove(&lcp, &x).expect("a solution");
    assert!(proof.x.iter().all(|x| *x == fraction(1, 3)));
    // 1/3 − fl(1/3) = 2⁻⁵⁴/3
    assert!((proof.distance / (2f64.powi(-54) / 3.0) - 1.0).abs() < 1e-9);
}

#[test]
fn a_published_kkt_problem_has_its_published_fractions() {
    // The PATH solver's introductory problem: x = (14/5, 0, 4/5, 6/5).
    let a: [&[f64]; 4] = [
        &[0.0, 0.0, -1.0, -1.0],
        &[0.0, 0.0, 1.0, -2.0],
        &[1.0, -1.0, 2.0, -2.0],
        &[1.0, 2.0, -2.0, 4.0],
    ];
    let lcp = contacts(&a, &[2.0, 2.0, -2.0, -6.0]);
    let x = [2.8, 0.0, 0.8, 1.2];
    let proof = prove(&lcp, &x).expect("a solution");
    assert_eq!(proof.x, [fraction(14, 5), fraction(0, 1), fraction(4, 5), fraction(6, 5)]);
}

#[test]
fn a_redundant_system_is_solved_with_the_open_unknowns_kept() {
    // A box on its four corners (E10): eigenvalues 0, 4, 6, 6; null vector (1, −1, −1, 1).
    let a: [&[f64]; 4] = [
        &[4.0, 1.0, 1.0, -2.0],
        &[1.0, 4.0, -2.0, 1.0],
        &[1.0, -2.0, 4.0, 1.0],
        &[-2.0, 1.0, 1.0, 4.0],
    ];
    let lcp = contacts(&a, &[-1.0; 4]);
    for shift in [0.0, 0.125, -0.125] {
        let x = [0.25 + shift, 0.25 - shift, 0.25 - shift, 0.25 + shift];
        let proof = prove(&lcp, &x).expect("a solution");
        assert_eq!(proof.distance, 0.0);
        let null = proof.null_direction.expect("forces that are not unique");
        let (plus, minus) = (fraction(1, 1), fraction(-1, 1));
        // Any multiple of (1, −1, −1, 1); the unit entry is at the dependent row, the last.
        assert_eq!(null, [plus.clone(), minus.clone(), minus, plus]);
    }
}

#[test]
fn at_the_end_of_a_segment_of_solutions_no_free_direction_is_left() {
    // x1 + x2 = 1: at (1, 0) row 2 is at its bound, so only row 1 is free and A_FF = 1 is regular.
    let lcp = contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -1.0]);
    let x = [1.0, 0.0];
    assert_eq!(prove(&lcp, &x).unwrap().null_direction, None);
}

#[test]
fn an_inconsistent_equality_is_never_proved() {
    // Rows x1 + x2 = 1 and x1 + x2 = 1 + 2⁻⁴⁰: a residual of 1e-12, and no solution.
    let (n, ones) = (2, [1.0; 4]);
    let b = vec![-1.0, -1.0 - 2f64.powi(-40)];
    let lcp = Lcp::new(Matrix::dense(n, &ones), b, vec![-INF; 2], vec![INF; 2]).unwrap();
    let x = [0.5, 0.5];
    assert_eq!(prove(&lcp, &x), None);
}

#[test]
fn entries_over_forty_eight_orders_of_magnitude_are_exact() {
    let lcp = contacts(&[&[1e24, 1.0], &[1.0, 1e-23]], &[-1e24, -3.0]);
    // By Cramer: det = 10 − 1 up to the rounding of 1e24 and 1e-23.
    let x2 = (3e24 - 1e24) / 9.0;
    let x = [(1e24 - x2) / 1e24, x2];
    let proof = prove(&lcp, &x).expect("a solution");
    assert!(proof.distance < 1e-14 * x2);
}
