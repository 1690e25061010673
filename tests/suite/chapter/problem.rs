//! Errata of the problem statement and the solvers, E01 to E12: their figures, from theory.

use std::f64::consts::PI;

use dashu_ratio::RBig;
use lcplab::lcp::merit;
use lcplab::solver::theory::{
    jacobi_iteration_matrix, sor_iteration_matrix, spectral_radius, sweeps_to,
};
use lcplab::solver::{Options, Registry, Start};

use super::{assert_near, both};
use lcplab_testing::{assert_proved, contacts, tridiagonal};

#[test]
fn e01_no_number_obeys_the_printed_conditions_unless_it_is_at_a_limit() {
    // At y = 0 the third line excludes what the first demands; x = 10 with y = −10 obeys all three.
    assert_eq!(both("E01", "solutions of y = 2x − 4"), [0.0, 1.0]);
    assert_eq!(both("E01", "the same, strict signs"), [0.0, 1.0]);
    assert_eq!(both("E01", "solutions of y = 2x − 30"), [1.0, 1.0]);
}

#[test]
fn e02_the_wrong_answer_solves_the_problem_with_the_other_sign() {
    let a: [&[f64]; 2] = [&[2.0, -1.0], &[-1.0, 2.0]];
    assert_proved(&contacts(&a, &[-1.0, 2.0]), &[0.5, 0.0]);
    assert_proved(&contacts(&a, &[1.0, -2.0]), &[0.0, 1.0]);
}

#[test]
fn e03_without_coefficients_the_first_unknown_is_off_by_61_of_153() {
    // (b_i − Σ x_j)/a_ii has the fixed point (−3/17, 4/17, 25/17); A x = b has (2/9, 1/9, 13/9).
    let [printed, corrected] = both("E03", "x₁, A₁, no coefficients");
    assert_near(printed, -3.0 / 17.0, 1e-15);
    assert_near(corrected - printed, 61.0 / 153.0, 1e-15);
    let [exchanged, corrected] = both("E03", "x₁, A₂, i and j exchanged");
    assert_near(exchanged, 5.0 / 14.0, 1e-15);
    assert_near(corrected, -1.0 / 14.0, 1e-15);
}

#[test]
fn e04_at_the_solution_the_printed_test_is_the_slack_over_b() {
    let [printed, corrected] = both("E04", "value at x = (½, 0)");
    assert_near(printed, 2.5 / 10f64.sqrt(), 1e-15);
    assert_eq!(corrected, 0.0);
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 3.0]);
    assert!(merit::km4(&lcp.homogeneous(), &[0.0; 2]).is_nan());
}

#[test]
fn e05_the_inequalities_leave_43_of_81_points() {
    // In quarters: 2i − j ≥ 4 and 2j − i ≥ −12, counted in whole numbers.
    let allowed = |i: i32, j: i32| 2 * i - j >= 4 && 2 * j - i >= -12;
    let points = (0..9).flat_map(|i| (0..9).map(move |j| (i, j)));
    let count = points.filter(|&(i, j)| allowed(i, j)).count();
    assert_eq!(count, 43);
    assert_eq!(both("E05", "accepted, n = 2"), [count as f64, 1.0]);
    assert_eq!(both("E05", "accepted, n = 1"), [3.0, 1.0]);
}

#[test]
fn e07_the_error_is_a_power_of_a_quarter_in_exact_fractions() {
    let (mut x, mut error) = (RBig::ZERO, RBig::ONE);
    for _ in 0..40 {
        for _ in 0..2 {
            x = (RBig::ONE + x) / RBig::from(2);
        }
        error /= RBig::from(4);
        assert_eq!(RBig::ONE - &x, error);
    }
    assert_eq!(both("E07", "error after 40 sweeps"), [0.0, 2f64.powi(-80)]);
}

#[test]
fn e07_a_chain_contracts_by_the_square_of_a_cosine() {
    for (n, sweeps) in [(10, 168.0), (50, 3639.0)] {
        let rho = spectral_radius(&sor_iteration_matrix(&tridiagonal(n, 2.0), 1.0));
        assert_near(rho, (PI / (n + 1) as f64).cos().powi(2), 1e-10);
        assert_eq!(sweeps_to(1e-6, rho).ceil(), sweeps);
    }
    assert_near(both("E07", "sweeps to 10⁻⁶, n = 50")[1], 3639.0, 1.0);
}

#[test]
fn e09_jacobi_overshoots_where_gauss_seidel_converges() {
    let a = contacts(&[&[1.0, 0.9, 0.9], &[0.9, 1.0, 0.9], &[0.9, 0.9, 1.0]], &[0.0; 3]);
    assert_near(spectral_radius(&jacobi_iteration_matrix(a.matrix(), 1.0)), 1.8, 1e-12);
    // λ² − (3a² − a³) λ + a³ = 0 has a complex pair for a = 0.9: |λ|² = a³.
    let gauss_seidel = spectral_radius(&sor_iteration_matrix(a.matrix(), 1.0));
    assert_near(gauss_seidel, 0.9f64.powf(1.5), 1e-9);
    let [printed, _] = both("E09", "x₁ after the sweeps");
    // The error is (−1, −1, −1) times (−1.8)³⁰.
    assert_near(printed / (1.0 - 1.8f64.powi(30)), 1.0, 1e-9);
}

#[test]
fn e10_from_zero_the_corners_share_the_weight_though_they_need_not() {
    let a: [&[f64]; 4] = [
        &[4.0, 1.0, 1.0, -2.0],
        &[1.0, 4.0, -2.0, 1.0],
        &[1.0, -2.0, 4.0, 1.0],
        &[-2.0, 1.0, 1.0, 4.0],
    ];
    let lcp = contacts(&a, &[-9.81 / 60.0; 4]);
    let mut eigenvalues: Vec<f64> =
        lcp.matrix().to_dense().symmetric_eigenvalues().iter().copied().collect();
    eigenvalues.sort_by(f64::total_cmp);
    for (found, exact) in eigenvalues.iter().zip([0.0, 4.0, 6.0, 6.0]) {
        assert_near(*found, exact, 1e-12);
    }
    let pgs = Registry::standard().entry("pgs").unwrap().build(&Options::default());
    for x in pgs.solve(&lcp, &Start::default(), &mut ()).x {
        assert_near(x, 9.81 / 240.0, 1e-8);
    }
    assert_near(both("E10", "growth of x₁ per sweep")[1], 0.125, 1e-9);
}

#[test]
fn e11_the_inverse_of_a_chain_is_full() {
    // (A⁻¹)_ij = min(i, j) (n + 1 − max(i, j)) / (n + 1) > 0 for 1 ≤ i, j ≤ n.
    assert_eq!(both("E11", "entries, n = 50"), [2500.0, 148.0]);
}

#[test]
fn e12_ten_sweeps_from_nothing_carry_a_third_of_the_weight() {
    // x_1 ← x_2 + 1 and x_i ← (x_{i−1} + x_{i+1})/2 in units of one body's weight.
    let mut x = [0.0; 11];
    for _ in 0..10 {
        x[0] = x[1] + 1.0;
        for i in 1..10 {
            x[i] = (x[i - 1] + x[i + 1]) / 2.0;
        }
    }
    let [printed, corrected] = both("E12", "weight supported by the floor");
    assert_near(printed, x[0] / 10.0, 1e-12);
    assert_near(printed, 0.352, 5e-4);
    assert_near(corrected, 1.0, 1e-9);
}
