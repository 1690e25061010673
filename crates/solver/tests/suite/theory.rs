//! Iteration matrices compared with closed forms (mathematics §6, benchmarks 4.3) and with sweeps.

use std::f64::consts::PI;
use std::ops::ControlFlow;

use lcplab_lcp::{Lcp, Matrix, merit};
use lcplab_solver::theory::{
    contraction, gauss_seidel_rate, jacobi_iteration_matrix, optimal_omega,
    ordered_iteration_matrix, principal_submatrix, rate, sor_iteration_matrix, spectral_radius,
    sweeps_to,
};
use lcplab_solver::{Iterate, Observer, Options, Pgs, Settings, Solver, Start, Status};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, stack, tridiagonal};

fn jacobi(a: &Matrix) -> f64 {
    spectral_radius(&jacobi_iteration_matrix(a, 1.0))
}

fn sor(a: &Matrix, omega: f64) -> f64 {
    spectral_radius(&sor_iteration_matrix(a, omega))
}

#[track_caller]
fn assert_close(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found}, expected {expected}");
}

#[test]
fn a_chain_of_50_rods_has_the_radii_of_its_closed_form() {
    let a = tridiagonal(50, 2.0);
    let cosine = (PI / 51.0).cos();
    assert_close(jacobi(&a), cosine, 1e-12);
    assert_close(sor(&a, 1.0), cosine * cosine, 1e-10);
    assert_close(sor(&a, 1.0), 0.99621, 5e-6);
    let omega = optimal_omega(cosine);
    assert_close(omega, 1.88402, 5e-6);
    // At ω* two eigenvalues coincide: they are accurate only to the square root of the precision.
    assert_close(sor(&a, omega), omega - 1.0, 1e-6);
    assert_close(sweeps_to(1e-6, cosine * cosine), 3639.0, 1.0); // E07
}

#[test]
fn stacks_have_the_published_radii() {
    for (n, jacobi_radius, gauss_seidel, omega, at_omega) in [
        (5, 0.951057, 0.904508, 1.527864, 0.527864),
        (10, 0.987688, 0.975528, 1.729454, 0.729454),
        (15, 0.994522, 0.989074, 1.810727, 0.810727),
        (20, 0.996917, 0.993844, 1.854498, 0.854498),
        (50, 0.999507, 0.999013, 1.939092, 0.939092),
    ] {
        let a = tridiagonal(n, 1.0);
        assert_close(jacobi(&a), jacobi_radius, 5e-7);
        assert_close(jacobi(&a), (PI / (2 * n) as f64).cos(), 1e-12);
        assert_close(sor(&a, 1.0), gauss_seidel, 5e-7);
        let best = optimal_omega((PI / (2 * n) as f64).cos());
        assert_close(best, omega, 5e-7);
        assert_close(sor(&a, best), at_omega, 2e-6); // the root of the precision, and six digits
    }
}

#[test]
fn two_bodies_converge_at_r_over_one_plus_r() {
    for r in [1.0, 10.0, 1e2, 1e3, 1e4] {
        let a = Matrix::dense(2, &[1.0, -1.0, -1.0, 1.0 + 1.0 / r]); // masses 1 and r
        assert_close(sor(&a, 1.0), r / (1.0 + r), 1e-14);
    }
}

#[test]
fn jacobi_does_not_converge_on_every_definite_matrix() {
    // E09: unit diagonal with 0.9 elsewhere.
    let a = Matrix::dense(3, &[1.0, 0.9, 0.9, 0.9, 1.0, 0.9, 0.9, 0.9, 1.0]);
    assert_close(jacobi(&a), 1.8, 1e-12);
    assert_close(sor(&a, 1.0), 0.854, 5e-4);
    assert_eq!(sweeps_to(1e-6, jacobi(&a)), INF);
    let damped = spectral_radius(&jacobi_iteration_matrix(&a, 2.0 / 3.0));
    assert_close(damped, 1.0 - 0.1 * 2.0 / 3.0, 1e-12); // max |1 − θ λ|, λ = 0.1 and 2.8
}

#[test]
fn omega_star_is_the_best_omega_of_a_chain() {
    let a = tridiagonal(10, 2.0);
    let omega = optimal_omega(jacobi(&a));
    let best = sor(&a, omega);
    for other in [omega - 0.1, omega - 0.02, omega + 0.02, omega + 0.1] {
        assert!(sor(&a, other) > best);
    }
}

#[test]
fn the_symmetric_sweep_is_the_forward_sweep_and_its_mirror_image() {
    // SSOR's matrix is similar to a symmetric semidefinite one: real eigenvalues in [0, 1).
    let a = tridiagonal(12, 2.0);
    for omega in [0.7, 1.0, 1.6] {
        let g = ordered_iteration_matrix(&a, omega, (0..a.len()).chain((0..a.len()).rev()));
        let radius = spectral_radius(&g);
        assert!(radius < 1.0);
        assert!(g.trace() > 0.0 && g.trace() < 12.0 * radius);
    }
}

#[test]
fn a_singular_matrix_keeps_its_null_vectors() {
    let a = Matrix::dense(2, &[1.0, -1.0, -1.0, 1.0]);
    assert_close(sor(&a, 1.0), 1.0, 1e-14);
}

#[test]
fn the_free_rows_alone_decide() {
    let a = tridiagonal(9, 2.0);
    let free = principal_submatrix(&a, &[2, 3, 4, 5]);
    assert_close(jacobi(&free), (PI / 5.0).cos(), 1e-12);
}

#[test]
fn a_matrix_without_diagonal_has_no_radius() {
    assert!(sor(&Matrix::dense(1, &[0.0]), 1.0).is_nan());
}

/// Stops a solver at a given natural residual.
struct Until<'a>(&'a Lcp, f64);

impl Observer for Until<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        if merit::natural_residual(self.0, iterate.x) <= self.1 {
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    }
}

fn sweeps(lcp: &Lcp, residual: f64) -> usize {
    let settings = Settings::default().with_tolerance(0.0).with_max_iterations(200_000);
    let solver = Pgs { settings, ..Pgs::default() };
    let solution = solver.solve(lcp, &Start::default(), &mut Until(lcp, residual));
    assert_eq!(solution.status, Status::Stopped);
    solution.iterations
}

#[test]
fn stacks_take_the_published_number_of_sweeps() {
    // Equal masses fall for one step of 1/60 s: only the bottom contact closes.
    for (n, expected) in [(5, 157), (10, 606), (15, 1329), (20, 2318), (50, 13566)] {
        assert_eq!(sweeps(&stack(n), 1e-8), expected, "n = {n}");
    }
}

#[test]
fn two_bodies_take_the_published_number_of_sweeps() {
    let speed = 9.81 / 60.0;
    for (r, expected) in [(1.0, 24), (10.0, 175), (100.0, 1670), (1000.0, 16619), (1e4, 166106)] {
        let lcp =
            boxed(&[&[1.0, -1.0], &[-1.0, 1.0 + 1.0 / r]], &[-speed, 0.0], &[0.0; 2], &[INF; 2]);
        assert_eq!(sweeps(&lcp, 1e-8), expected, "mass ratio {r}");
    }
}

#[test]
fn null_vectors_do_not_slow_w_down() {
    // Two contacts that share a load, and one more: A = [[2, 2, 1], [2, 2, 1], [1, 1, 2]] has
    // rank 2.
    let a = Matrix::dense(3, &[2.0, 2.0, 1.0, 2.0, 2.0, 1.0, 1.0, 1.0, 2.0]);
    let g = sor_iteration_matrix(&a, 1.0);
    assert_close(spectral_radius(&g), 1.0, 1e-14);
    // With one of the two left out: [[2, 1], [1, 2]], whose Gauss-Seidel radius is 1/4.
    assert_close(contraction(&g), 0.25, 1e-12);
    let regular = jacobi_iteration_matrix(&tridiagonal(9, 2.0), 1.0);
    assert_close(contraction(&regular), (PI / 10.0).cos(), 1e-12);
    let zero = jacobi_iteration_matrix(&Matrix::dense(1, &[0.0]), 1.0);
    assert!(contraction(&zero).is_nan() && spectral_radius(&zero).is_nan());
}

/// J Jᵀ + shift with J of small whole numbers; no entry on the diagonal is 0.
fn gram(n: usize, columns: usize, shift: f64) -> impl Strategy<Value = DMatrix<f64>> {
    let entries = proptest::collection::vec((-3..=3i32).prop_map(f64::from), n * columns);
    entries.prop_map(move |j| {
        let j = DMatrix::from_vec(n, columns, j);
        let a = &j * j.transpose() + DMatrix::identity(n, n) * shift;
        DMatrix::from_fn(n, n, |r, c| if r == c && a[(r, c)] == 0.0 { 1.0 } else { a[(r, c)] })
    })
}

/// S A S with S = diag(2^k_i).
fn in_units(a: &DMatrix<f64>, k: &[i32]) -> Matrix {
    let scaled = |i: usize, j: usize| a[(i, j)] * 2f64.powi(k[i]) * 2f64.powi(k[j]);
    Matrix::from(DMatrix::from_fn(a.nrows(), a.nrows(), scaled).as_view())
}

/// The effect of one sweep on all unit errors, from the definition of the sweep.
fn swept_errors(a: &DMatrix<f64>) -> DMatrix<f64> {
    let n = a.nrows();
    let mut errors = DMatrix::identity(n, n);
    for column in 0..n {
        for i in 0..n {
            let w: f64 = (0..n).map(|j| a[(i, j)] * errors[(j, column)]).sum();
            errors[(i, column)] -= w / a[(i, i)];
        }
    }
    errors
}

/// ρ as the limit of |Gᵏ|^(1/k), Gelfand's formula, at k = 2²⁴, by squaring.
fn radius_by_powers(mut g: DMatrix<f64>) -> f64 {
    const SQUARINGS: i32 = 24;
    let mut log = 0.0;
    for step in 0..SQUARINGS {
        let size = g.norm();
        if size == 0.0 {
            return 0.0;
        }
        log += size.ln() / 2f64.powi(step);
        g /= size;
        g = &g * &g;
    }
    (log + g.norm().ln() / 2f64.powi(SQUARINGS)).exp()
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn gauss_seidel_contracts_every_definite_matrix_alike_in_all_units(
        a in (2..=6usize).prop_flat_map(|n| gram(n, n, 0.25)),
        k in proptest::collection::vec(-500..=500i32, 6),
    ) {
        // Below 1 by the theorem of Ostrowski and Reich.
        let plain = gauss_seidel_rate(&Matrix::from(a.as_view())).unwrap();
        prop_assert_eq!(gauss_seidel_rate(&in_units(&a, &k)), Some(plain));
        let expected = radius_by_powers(swept_errors(&a));
        prop_assert!((plain - expected).abs() <= 1e-6, "{} for {}", plain, expected);
    }

    #[test]
    fn gauss_seidel_contracts_what_w_feels_of_every_semidefinite_matrix(
        a in (3..=6usize).prop_flat_map(|n| gram(n, n - 2, 0.0)),
        k in proptest::collection::vec(-500..=500i32, 6),
    ) {
        let plain = gauss_seidel_rate(&Matrix::from(a.as_view())).unwrap();
        prop_assert_eq!(gauss_seidel_rate(&in_units(&a, &k)), Some(plain));
        // Of dependent rows, those of a basis determine w; their errors are those of a definite
        // matrix only if the others stay fixed, so the effect on w is measured by sweeps.
        let (n, sweeps) = (a.nrows(), sweeps_to(1e-8, plain));
        let mut error = DMatrix::from_fn(n, 1, |i, _| (1.0 + i as f64).sin());
        let size = |error: &DMatrix<f64>| (&a * error).amax();
        let (first, step) = (size(&error), swept_errors(&a));
        let mut counted = 0;
        while size(&error) > 1e-8 * first && counted < 1_000_000 {
            error = &step * error;
            counted += 1;
        }
        prop_assert!(f64::from(counted) <= 2.0 * sweeps + 10.0, "{} for {}", counted, sweeps);
        prop_assert!(f64::from(counted) >= 0.5 * sweeps - 10.0, "{} for {}", counted, sweeps);
    }

    #[test]
    fn no_rate_is_predicted_for_an_indefinite_matrix(
        a in (2..=6usize).prop_flat_map(|n| gram(n, n, 0.25)), beyond in 1.01..3.0f64,
        k in proptest::collection::vec(-500..=500i32, 6),
    ) {
        // |a_01| beyond √(a_00 a_11) makes it so.
        let mut a = a;
        a[(0, 1)] = beyond * (a[(0, 0)] * a[(1, 1)]).sqrt();
        a[(1, 0)] = a[(0, 1)];
        prop_assert_eq!(gauss_seidel_rate(&in_units(&a, &k)), None);
    }
}

#[test]
fn the_rate_of_two_rows_is_the_square_of_their_correlation_in_any_unit() {
    // ρ = a₁₂² / (a₁₁ a₂₂), in units spread over 10³⁰, and where 1/a₁₁ overflows.
    for (a, b, c) in
        [(1.0, 0.5, 1.0), (1e30, 5e14, 1.0), (1e-310, 5e-156, 1.0), (1e-300, 5e-76, 1e150)]
    {
        let expected = (b / f64::sqrt(a) / f64::sqrt(c)).powi(2);
        let found = gauss_seidel_rate(&Matrix::dense(2, &[a, b, b, c])).unwrap();
        assert_close(found, expected, 1e-10); // 1e-310 has 44 bits
    }
    assert_eq!(gauss_seidel_rate(&Matrix::dense(1, &[1e-310])), Some(0.0));
    // For the registered methods too: four rows in units with ratios of 10⁵. In equal units LAPACK
    // finds 0.2901.
    let correlation = [
        [1.0, 0.25, 0.5, 0.125],
        [0.25, 1.0, 0.5, 0.25],
        [0.5, 0.5, 1.0, 0.25],
        [0.125, 0.25, 0.25, 1.0],
    ];
    let in_units = |i: usize, j: usize| correlation[i][j] * 10f64.powi(30 - 5 * (i + j) as i32);
    let a = DMatrix::from_fn(4, 4, in_units);
    let lcp =
        Lcp::new(Matrix::from(a.as_view()), vec![-1.0; 4], vec![0.0; 4], vec![INF; 4]).unwrap();
    let expected =
        radius_by_powers(swept_errors(&DMatrix::from_fn(4, 4, |i, j| correlation[i][j])));
    assert_close(expected, 0.2901, 5e-5);
    let plain = Options::default().with_omega(1.0);
    for method in ["pgs", "sor"] {
        let found = rate(method, &plain, &lcp, &[0, 1, 2, 3]).unwrap();
        assert_close(found, expected, 1e-6);
    }
}
