use lcplab_lcp::{Coupling, Lcp, accurate, merit};
use lcplab_solver::kernel::{Width, terms};
use lcplab_solver::{Dantzig, Solver, Start};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts, manufactured};

#[test]
fn a_small_relative_residual_far_along_a_ray_is_no_better_than_nothing() {
    // A d = 0 for d = (1, 1), so that w is there what it is at 0, and little beside terms of 10⁹.
    let lcp = |b2| contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-0.125, b2]);
    assert!(merit::scaled_residual(&lcp(0.0625), &[1e9; 2]) < 1e-9);
    assert!(!merit::improves_on_zero(&lcp(0.0625), &[1e9; 2], 1e-8));
    assert!(merit::improves_on_zero(&lcp(0.125), &[0.125, 0.0], 1e-8)); // w = 0
    // Zero solves it, so that nothing has to be gained by another x.
    let rest = contacts(&[&[1.0]], &[1.0]);
    assert!(merit::improves_on_zero(&rest, &[1e-20], 1e-8));
}

#[test]
fn a_bound_is_missed_by_a_part_of_the_bound_and_not_of_the_terms() {
    // Two motors of 1 N m that would need 10⁹ N m: the solution is (1, −1), the residual of 0 is 1.
    let lcp = boxed(&[&[2.0, 1.0], &[1.0, 2.0]], &[-1e9, 1e9], &[-1.0, -1.0], &[1.0, 1.0]);
    assert_eq!(merit::scaled_residual(&lcp, &[1.0, -1.0]), 0.0);
    assert_eq!(merit::scaled_residual(&lcp, &[0.0, 0.0]), 1.0);
    assert!((merit::scaled_residual(&lcp, &[0.75, -1.0]) - 0.25).abs() < 1e-15);
    // A soft row asks for 10¹² and may have 1; 9000 is outside by 8999 times the bound.
    let soft = boxed(&[&[1e-12]], &[-1.0], &[0.0], &[1.0]);
    assert_eq!(merit::scaled_residual(&soft, &[9000.0]), 8999.0);
    // Inside the bounds it is w beside its terms, 1 − 0.5 beside 1.5, however wide the bounds are.
    for hi in [1.0, 2.0, 1e9, INF] {
        let lcp = boxed(&[&[1.0]], &[-1.0], &[0.0], &[hi]);
        assert_eq!(merit::scaled_residual(&lcp, &[0.5]), 1.0 / 3.0);
    }
}

#[test]
fn friction_is_measured_beside_what_its_normal_may_be() {
    // The normal is held at its bound of 1 by w = 10⁹, so that friction is at most ½ and opposes
    // the slip.
    let lcp = coupled(&[&[1.0, 0.0], &[0.0, 1.0]], &[1e9, 1e9], [1.0, -INF], 0.5);
    assert_eq!(merit::scaled_residual(&lcp, &[1.0, -0.5]), 0.0);
    for wrong in [0.0, 0.5, -0.49] {
        assert!(merit::scaled_residual(&lcp, &[1.0, wrong]) > 1e-6, "{wrong}");
    }
    // A row of zeros asks for nothing: any x within the bounds, but for their last digit.
    let nothing = coupled(&[&[3.0, 0.0], &[0.0, 0.0]], &[-1.0, 0.0], [0.0, -INF], 0.3);
    let third = 1.0 / 3.0;
    for x in [0.0, 0.1, -0.1, (0.3f64 * third).next_up()] {
        assert!(merit::scaled_residual(&nothing, &[third, x]) < 1e-9, "{x}");
    }
    assert!(merit::scaled_residual(&nothing, &[third, 0.11]) > 0.1);
}

/// A problem whose second row is friction under the first one.
fn coupled(rows: &[&[f64]], b: &[f64], lo: [f64; 2], mu: f64) -> Lcp {
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, mu]).unwrap();
    boxed(rows, b, &lo, &[INF; 2]).with_coupling(coupling).unwrap()
}

#[test]
fn the_natural_residual_is_its_definition() {
    // w = (2, −1) at x = (1, 0): residuals 1 and −1.
    let lcp = contacts(&[&[4.0, 1.0], &[1.0, 2.0]], &[-2.0, -2.0]);
    let x = [1.0, 0.0];
    assert_eq!(lcp.w(&x), [2.0, -1.0]);
    assert_eq!(merit::natural_residual(&lcp, &x), 1.0);
}

#[test]
fn fischer_and_burmeister_measure_the_distance_to_each_bound() {
    // φ(a, b) = a + b − √(a² + b²): φ(3, 4) = 2, and with a bound at infinity what is left is w.
    let at = |lo: f64, hi: f64, w: f64| {
        merit::fischer_burmeister(&boxed(&[&[1.0]], &[w - 3.0], &[lo], &[hi]), &[3.0])
    };
    assert_eq!(at(0.0, INF, 4.0), 2.0);
    assert_eq!(at(-INF, INF, -4.0), 4.0);
    assert_eq!(at(-INF, 6.0, -4.0), 2.0); // −φ(hi − x, −w)
    // Both bounds (Billups): φ(3, −φ(4, −w)), φ(4, −3) = −4, φ(3, 4) = 2.
    assert_eq!(at(0.0, 7.0, 3.0), 2.0);
    assert_eq!([at(3.0, 9.0, 2.0), at(0.0, 3.0, -2.0), at(0.0, 9.0, 0.0)], [0.0; 3]);
}

#[test]
fn all_but_the_chapters_vanish_at_a_solution() {
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 3.0]);
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    for measure in [merit::scaled_residual, merit::natural_residual] {
        assert_eq!(measure(&lcp, &x), 0.0);
    }
    assert!((merit::km4(&lcp, &x) - 2.5 / 10f64.sqrt()).abs() < 1e-15); // E04
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn a_look_that_stops_at_the_first_row_outside_sees_what_a_whole_one_sees(
        m in manufactured(5, 3, 0.0),
        x in proptest::collection::vec(-2.0..2.0f64, 5),
        start in 0..7usize,
    ) {
        let residual = merit::scaled_residual(&m.lcp, &x);
        for factor in [0.5, 1.0 - 1e-9, 1.0 + 1e-9, 2.0] {
            let tolerance = factor * residual;
            let mut first = start;
            let within = merit::is_within(&m.lcp, &x, tolerance, &mut first);
            prop_assert_eq!(within, residual <= tolerance);
            if !within {
                let terms = merit::RowTerms::at(&m.lcp, first, &x);
                prop_assert!(terms.scaled_residual(&m.lcp, first, &x) > tolerance);
            }
        }
        let mut first = start;
        prop_assert!(!merit::is_within(&m.lcp, &[f64::NAN; 5], 1.0, &mut first));
    }

    #[test]
    fn what_plain_sums_let_pass_is_what_compensated_ones_do(
        m in manufactured(8, 3, 0.0),
        shift in proptest::collection::vec(-1.0..1.0f64, 8),
        digits in 0..16i32,
        mu in 0.0..2.0f64,
    ) {
        // Near x*, so that the residual is anything from rounding to 1; in box form and with a
        // coupled row.
        let x: Vec<f64> = m.x.iter().zip(&shift).map(|(x, d)| x + d * 10f64.powi(-digits)).collect();
        for lcp in [m.lcp.clone(), with_coupled_row(&m.lcp, mu)] {
            let compensated = |i| merit::RowTerms::summed::<accurate::Sum>(&lcp, i, &x).scaled_residual(&lcp, i, &x);
            let residual = (0..8).map(compensated).fold(0.0, f64::max);
            let by_lanes = terms(&lcp, &x, Width::widest());
            for tolerance in [residual.next_down(), residual, residual * (1.0 + 1e-14), 2.0 * residual] {
                let worth = merit::improves_on_zero(&lcp, &x, tolerance);
                let row_residuals = merit::row_residuals(&lcp, &x, &by_lanes);
                let expected = residual <= tolerance && worth;
                prop_assert_eq!(merit::is_solution(&lcp, &x, tolerance), expected);
                prop_assert_eq!(merit::is_solution_by(&lcp, &x, &row_residuals, tolerance), expected);
                let within = merit::is_within(&lcp, &x, tolerance, &mut 0);
                prop_assert!(!within || residual <= tolerance);
            }
        }
    }
}

/// The same with row 1 bounded by ± μ times x_0, and x_0 ≥ 0.
fn with_coupled_row(lcp: &Lcp, mu: f64) -> Lcp {
    let (mut lo, mut hi) = (lcp.lo().to_vec(), lcp.hi().to_vec());
    (lo[0], hi[0], lo[1], hi[1]) = (0.0, INF, -INF, INF);
    let mut follows = vec![None; lcp.len()];
    follows[1] = Some(0);
    let mut mus = vec![0.0; lcp.len()];
    mus[1] = mu;
    let free = Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), lo, hi).unwrap();
    free.with_coupling(Coupling::new(follows, mus).unwrap()).unwrap()
}

/// A contact with friction 5e-324, the smallest number, and no normal force: T_n/s_n = 1e-323/9 is
/// below that, but not 0, so that a friction of 5e-324 has a size.
#[test]
fn the_smallest_friction_without_a_normal_force_has_a_residual() {
    let lcp = boxed(&[&[9.0, 2.0], &[2.0, 13.0]], &[0.0, -6.0], &[0.0, -INF], &[INF; 2]);
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 4.0]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap();
    assert!(merit::scaled_residual(&lcp, &[0.0, 5e-324]) > 0.1);
    assert_eq!(merit::scaled_residual(&lcp, &[0.0, 0.0]), 0.0);
}
