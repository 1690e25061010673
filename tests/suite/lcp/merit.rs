use lcplab::lcp::merit;
use lcplab::solver::{Dantzig, Solver, Start};

use crate::common::{chain, contacts};

#[test]
fn each_measure_is_its_definition() {
    // w = (2, −1) at x = (1, 0): residuals 1 and −1.
    let lcp = contacts(&[&[4.0, 1.0], &[1.0, 2.0]], &[-2.0, -2.0]);
    let x = [1.0, 0.0];
    assert_eq!(lcp.w(&x), [2.0, -1.0]);
    assert_eq!(merit::natural_residual(&lcp, &x), 1.0);
    assert_eq!(merit::siconos(&lcp, &x), 2f64.sqrt() / 8f64.sqrt());
    assert_eq!(merit::dart(&lcp, &x), 1.0 / 5.0); // |A|∞ = 5, |x|∞ = 1, |b|∞ = 2
}

#[test]
fn all_but_the_chapters_vanish_at_a_solution() {
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 3.0]);
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    for measure in [merit::scaled_residual, merit::natural_residual, merit::siconos, merit::dart] {
        assert_eq!(measure(&lcp, &x), 0.0);
    }
    assert!((merit::km4(&lcp, &x) - 2.5 / 10f64.sqrt()).abs() < 1e-15); // E04
}

#[test]
fn dart_accepts_any_small_impulse() {
    let lcp = chain(3);
    let small = lcp.with_b(lcp.b().iter().map(|b| b * 1e-6).collect()).unwrap();
    assert!(merit::dart(&small, &[0.0; 3]) < 1e-4);
    assert!(merit::scaled_residual(&small, &[0.0; 3]) > 0.9);
}
