//! √(a² + b²) within the last digit, of numbers of any size.

use dashu_ratio::RBig;
use lcplab_lcp::exact::dyadic::{dyadic, rational};
use lcplab_lcp::hypot;
use oorandom::Rand64;

#[test]
fn the_root_is_within_three_quarters_of_the_last_digit() {
    let mut random = Rand64::new(3);
    let exact = |x: f64| rational(&dyadic(x));
    let square = |x: f64| exact(x) * exact(x);
    for _ in 0..3_000 {
        let exponent = random.rand_range(0..2_000) as i32 - 1_000;
        let a = (1.0 + random.rand_float()) * 2.0_f64.powi(exponent);
        let b =
            (1.0 + random.rand_float()) * 2.0_f64.powi(exponent - random.rand_range(0..12) as i32);
        let (h, sum) = (hypot(a, -b), square(a) + square(b));
        assert_eq!(h, hypot(b, a));
        // The root lies within three quarters of the spacing of h.
        let reach = (exact(h.next_up()) - exact(h)) * RBig::from_parts(3.into(), 4u8.into());
        let (low, high) = (exact(h) - &reach, exact(h) + &reach);
        assert!(&low * &low <= sum && sum <= &high * &high, "{a:e} {b:e}");
    }
}

#[test]
fn what_is_no_number_and_what_is_infinite_stays_so() {
    assert!(hypot(f64::NAN, 1.0).is_nan() && hypot(1.0, f64::NAN).is_nan());
    assert_eq!(hypot(f64::NAN, f64::NEG_INFINITY), f64::INFINITY);
    assert_eq!(hypot(0.0, -0.0), 0.0);
    assert_eq!(hypot(f64::MAX, f64::MAX), f64::INFINITY);
    assert_eq!(hypot(5e-324, 0.0), 5e-324);
}
