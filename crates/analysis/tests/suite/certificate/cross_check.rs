use lcplab_judge::cross_check::cross_check;
use lcplab_lcp::merit;
use proptest::prelude::*;

use lcplab_testing::{cases, manufactured};

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn clarabel_finds_the_manufactured_solution(m in manufactured(5, 5, 1.0)) {
        let check = cross_check(&m.lcp, &m.x).expect("a quadratic program");
        let optimum = merit::objective(&m.lcp, &m.x);
        prop_assert!((check.objective - optimum).abs() < 1e-7 * (1.0 + optimum.abs()), "{check:?}");
        // Newton's steps leave rounding times the condition number, not the root of the gap.
        prop_assert!(check.x_difference < 1e-9, "{check:?}");
    }

    #[test]
    fn on_singular_problems_w_agrees_though_x_need_not(m in manufactured(6, 3, 0.0)) {
        let check = cross_check(&m.lcp, &m.x).expect("a quadratic program");
        prop_assert!(check.w_difference < 1e-9, "{check:?}");
    }
}
