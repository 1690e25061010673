use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::theory::{jacobi_iteration_matrix, spectral_radius};
use lcplab_solver::trace::Convergence;
use lcplab_solver::{Damping, Jacobi, Settings, Solver, Start, Status};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::{
    INF, assert_certified, boxed, cases, chain, iterates, manufactured, objectives,
};

fn jacobi(damping: Damping) -> Jacobi {
    Jacobi { damping, settings: Settings::default() }
}

#[test]
fn plain_jacobi_diverges_on_a_definite_matrix_and_damped_jacobi_does_not() {
    let a: [&[f64]; 3] = [&[1.0, 0.9, 0.9], &[0.9, 1.0, 0.9], &[0.9, 0.9, 1.0]]; // E09
    let lcp = boxed(&a, &[-1.0, -2.0, -3.0], &[-INF; 3], &[INF; 3]);
    let plain = jacobi(Damping::Factor(1.0)).solve(&lcp, &Start::default(), &mut ());
    assert_eq!(plain.status, Status::Diverged);
    let safe = jacobi(Damping::Safe).solve(&lcp, &Start::default(), &mut ());
    assert_eq!(safe.status, Status::Solved);
    assert_certified(&lcp, &safe.x);
}

#[test]
fn errors_shrink_by_the_spectral_radius() {
    let lcp = chain(10);
    for theta in [0.5, 0.8, 1.0] {
        let mut trace = Convergence::of(&lcp);
        jacobi(Damping::Factor(theta)).solve(&lcp, &Start::default(), &mut trace);
        let predicted = spectral_radius(&jacobi_iteration_matrix(lcp.matrix(), theta));
        let measured = trace.rate().unwrap();
        assert!((measured - predicted).abs() < 1e-3, "θ = {theta}: {measured}, {predicted}");
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn no_safe_sweep_raises_the_objective(m in manufactured(6, 4, 0.5)) {
        for pair in objectives(&Jacobi::default(), &m.lcp).windows(2) {
            prop_assert!(pair[1] <= pair[0] + 1e-12 * (1.0 + pair[0].abs()), "{pair:?}");
        }
    }

    #[test]
    fn the_numbering_of_the_rows_does_not_matter(m in manufactured(5, 5, 1.0)) {
        let (n, lcp) = (m.lcp.len(), &m.lcp);
        let reversed = |v: &[f64]| v.iter().rev().copied().collect::<Vec<_>>();
        let a = DMatrix::from_fn(n, n, |i, j| lcp.matrix().entry(n - 1 - i, n - 1 - j));
        let (b, lo, hi) = (reversed(lcp.b()), reversed(lcp.lo()), reversed(lcp.hi()));
        let mirrored = Lcp::new(Matrix::from(a.as_view()), b, lo, hi).unwrap();
        let (here, there) = (iterates(&Jacobi::default(), lcp), iterates(&Jacobi::default(), &mirrored));
        for (x, y) in here.iter().zip(&there) {
            for (x, y) in x.iter().zip(reversed(y)) {
                prop_assert!((x - y).abs() < 1e-12, "{x} {y}");
            }
        }
    }
}
