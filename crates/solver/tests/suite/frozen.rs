use lcplab_lcp::{Coupling, Lcp};
use lcplab_solver::{Options, Registry, Status, StepDetail};

use lcplab_testing::{INF, boxed, parts};

/// A normal row coupled with a friction row. As x_n alternates 1, 0, 1, 0, …, friction of μ x_n
/// supports the load in every other round: with A = [1 c; c 1] a round maps x_n to max(0, 1 − c μ
/// x_n).
fn rubbing(c: f64, mu: f64) -> Lcp {
    let a: [&[f64]; 2] = [&[1.0, c], &[c, 1.0]];
    let lcp = boxed(&a, &[-1.0, -10.0], &[0.0, -INF], &[INF; 2]);
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, mu]).unwrap();
    lcp.with_coupling(coupling).unwrap()
}

/// The bounds of the friction row in each round, and the final status.
fn rounds(lcp: &Lcp) -> (Vec<f64>, Status) {
    let dantzig = Registry::standard().entry("dantzig").unwrap().build(&Options::default());
    let (solution, _, bounds) = parts(dantzig.as_ref(), lcp, |part| match part {
        StepDetail::Frozen(frozen) => Some(frozen.hi()[1]),
        _ => None,
    });
    (bounds, solution.status)
}

#[test]
fn rounds_that_come_back_end_at_once() {
    let (bounds, status) = rounds(&rubbing(0.75, 2.0)); // 1 − 1.5 < 0
    assert_eq!((bounds, status), (vec![0.0, 2.0, 0.0, 2.0], Status::Stalled));
}

#[test]
fn rounds_that_contract_go_on_to_the_fixed_point() {
    let (bounds, status) = rounds(&rubbing(0.75, 0.5));
    let fixed_point = 0.5 / (1.0 + 0.75 * 0.5); // μ x_n with x_n = 1 − c μ x_n
    let mut error = 0.5 - fixed_point;
    for bound in &bounds[1..] {
        assert!((bound - fixed_point - error).abs() < 1e-15, "{bounds:?}");
        error *= -0.375; // by c μ a round
    }
    assert_eq!(status, Status::Solved);
}
