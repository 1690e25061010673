use lcplab_judge::error_bound::error_bound;
use lcplab_lcp::{Lcp, Matrix};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts, manufactured};

#[test]
fn a_singular_matrix_has_no_bound() {
    assert_eq!(
        error_bound(&contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -1.0]), &[0.5, 0.5]),
        None
    );
}

#[test]
fn a_matrix_that_is_definite_only_by_rounding_has_no_bound() {
    // det = 2⁻⁵², so λ_min is about 2⁻⁵³: indistinguishable from 0 by rounding.
    let lcp = contacts(&[&[1.0 + f64::EPSILON, 1.0], &[1.0, 1.0]], &[-1.0, -1.0]);
    assert_eq!(error_bound(&lcp, &[0.5, 0.5]), None);
}

#[test]
fn a_factor_proves_nothing_below_its_own_rounding() {
    // Pairs of nearly identical contacts: λ_min = ε, and a Cholesky factor of 200 rows with trace
    // 200 exists down to −4 · 202 · 2⁻⁵³ · 200 = −1.8e-11 (Rump 2006).
    let pairs = |epsilon: f64| {
        let beside = |i: usize| if i.is_multiple_of(2) { i + 1 } else { i - 1 };
        let row = |i| [(i, i, 1.0), (i, beside(i), 1.0 - epsilon)];
        let a = Matrix::sparse(200, &(0..200).flat_map(row).collect::<Vec<_>>());
        Lcp::new(a, vec![-1.0; 200], vec![0.0; 200], vec![INF; 200]).unwrap()
    };
    assert_eq!(error_bound(&pairs(1e-11), &[0.5; 200]), None);
    assert!(error_bound(&pairs(1e-10), &[0.5; 200]).is_some());
}

#[test]
fn a_w_that_twice_the_precision_does_not_see_is_within_the_bound() {
    // w_0 = 1 + 2⁻⁶⁰ + 2⁻¹²⁰ − 2⁻⁶⁰ − 1 is summed to 0, and x_0* = 1 − 2⁻¹²⁰; the other x are
    // pinned.
    let (small, tiny) = (2f64.powi(-60), 2f64.powi(-120));
    let a: [&[f64]; 4] = [
        &[1.0, small, tiny, -small],
        &[small, 1.0, 0.0, 0.0],
        &[tiny, 0.0, 1.0, 0.0],
        &[-small, 0.0, 0.0, 1.0],
    ];
    let lcp = boxed(&a, &[-1.0; 4], &[-INF, 1.0, 1.0, 1.0], &[INF, 1.0, 1.0, 1.0]);
    assert!(error_bound(&lcp, &[1.0; 4]).unwrap() >= tiny);
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn the_distance_to_the_solution_is_below_the_bound_and_not_far_below(
        m in manufactured(6, 6, 1.0),
        moved in proptest::collection::vec(-1.0f64..1.0, 6),
        size in -12i32..0,
    ) {
        let moved: Vec<f64> = moved.iter().map(|d| d * 10f64.powi(size)).collect();
        let x: Vec<f64> = (0..6).map(|i| (m.x[i] + moved[i]).clamp(m.lcp.lo()[i], m.lcp.hi()[i])).collect();
        let distance = x.iter().zip(&m.x).map(|(x, s)| (x - s).abs()).fold(0.0, f64::max);
        let bound = error_bound(&m.lcp, &x).expect("a definite problem");
        prop_assert!(distance <= bound, "{distance} {bound}");
        // (1 + |A|) |r| / λ with λ ≥ 1, |A| ≤ 13 and |r| ≤ (1 + |A|) |x − x*|, and n from the norms
        prop_assert!(bound <= 2e4 * distance + 1e-12, "{distance} {bound}");
    }

    #[test]
    fn units_do_not_spoil_the_bound(m in manufactured(4, 4, 1.0), powers in proptest::collection::vec(-20i32..20, 4)) {
        // Scaled to D A D, D b, bounds and x by D⁻¹, the bound moves at most with the largest 1/D.
        let d: Vec<f64> = powers.iter().map(|&k| 2f64.powi(k)).collect();
        let entries: Vec<f64> = (0..16).map(|k| d[k / 4] * m.lcp.matrix().entry(k / 4, k % 4) * d[k % 4]).collect();
        let scale = |v: &[f64], times: bool| v.iter().zip(&d).map(|(v, d)| if times { v * d } else { v / d }).collect::<Vec<_>>();
        let lcp = Lcp::new(Matrix::dense(4, &entries), scale(m.lcp.b(), true), scale(m.lcp.lo(), false), scale(m.lcp.hi(), false)).unwrap();
        let mut x = m.x.clone();
        x[0] = (x[0] + 1e-6).min(m.lcp.hi()[0]);
        let (plain, scaled) = (error_bound(&m.lcp, &x).unwrap(), error_bound(&lcp, &scale(&x, false)).unwrap());
        let largest = d.iter().map(|d| 1.0 / d).fold(0.0, f64::max);
        prop_assert!(scaled <= 4.0 * plain * largest + 1e-300);
    }
}
