//! E40 to E48: Jacobians against difference quotients at random states, and masses against theory.

use lcplab::body::State;
use lcplab::lcp::Matrix;
use lcplab::solver::theory::{sor_iteration_matrix, spectral_radius};
use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::both;
use lcplab_testing::cases;

fn vector() -> impl Strategy<Value = Vector3<f64>> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0].prop_map(Vector3::from)
}

fn state() -> impl Strategy<Value = State> {
    (vector(), vector(), vector(), vector()).prop_map(|(p, turn, v, omega)| {
        let mut state = State { v, omega, ..State::WORLD };
        (state.pose.p, state.pose.q) = (p, UnitQuaternion::from_scaled_axis(turn));
        state
    })
}

/// dc/dt by a central difference along the bodies' motion.
fn rate(states: &[State; 2], c: impl Fn([&State; 2]) -> Vector3<f64>) -> Vector3<f64> {
    let h = 1e-5;
    let at = |t: f64| {
        let moved = states.map(|state| {
            let mut moved = state;
            moved.pose.p += t * state.v;
            moved.pose.q = UnitQuaternion::from_scaled_axis(t * state.omega) * state.pose.q;
            moved
        });
        c([&moved[0], &moved[1]])
    };
    (at(h) - at(-h)) / (2.0 * h)
}

proptest! {
    #![proptest_config(cases(100))]

    /// E41: [−I, [r0]×, I, −[r1]×] is the rate of the gap; with the arms exchanged it is off by
    /// exactly (r1 − r0) × (ω0 + ω1).
    #[test]
    fn the_arms_of_the_ball_joint_belong_to_their_own_bodies(
        s0 in state(), s1 in state(), a0 in vector(), a1 in vector()
    ) {
        let [r0, r1] = [s0.pose.q * a0, s1.pose.q * a1];
        let truth = rate(&[s0, s1], |[s0, s1]| s1.pose.point(&a1) - s0.pose.point(&a0));
        let with = |arm0: Vector3<f64>, arm1: Vector3<f64>| {
            s1.v - s0.v + arm0.cross(&s0.omega) - arm1.cross(&s1.omega)
        };
        prop_assert!((with(r0, r1) - truth).norm() < 1e-7);
        let off = (r1 - r0).cross(&(s0.omega + s1.omega));
        prop_assert!((with(r1, r0) - truth - off).norm() < 1e-7);
    }

    /// E43: whose ω turns the normal, for each of three owners.
    #[test]
    fn the_normal_turns_with_its_owner(
        s0 in state(), s1 in state(), a0 in vector(), a1 in vector(), n in vector()
    ) {
        let [r0, r1] = [s0.pose.q * a0, s1.pose.q * a1];
        let d = (s1.pose.p + r1) - (s0.pose.p + r0);
        let row = |n: Vector3<f64>, arm0: Vector3<f64>, arm1: Vector3<f64>| {
            n.dot(&(s1.v - s0.v)) - arm0.cross(&n).dot(&s0.omega) + arm1.cross(&n).dot(&s1.omega)
        };
        let truth = |normal: &dyn Fn([&State; 2]) -> Vector3<f64>| {
            rate(&[s0, s1], |states| {
                let d = states[1].pose.point(&a1) - states[0].pose.point(&a0);
                Vector3::x() * normal(states).dot(&d)
            })
            .x
        };
        let on_0 = truth(&|[s0, _]| s0.pose.q * n);
        let on_1 = truth(&|[_, s1]| s1.pose.q * n);
        prop_assert!((row(s0.pose.q * n, r0 + d, r1) - on_0).abs() < 1e-6);
        prop_assert!((row(s1.pose.q * n, r0, r1 - d) - on_1).abs() < 1e-6);
        prop_assert!((row(n, r0, r1) - truth(&|_| n)).abs() < 1e-6);
    }

    /// E47: two bodies on a floor, by the eigenvalues of the iteration matrix.
    #[test]
    fn the_factor_of_a_stack_of_two_is_the_share_of_the_upper_mass(
        bottom in 0.01..100.0f64, top in 0.01..100.0f64
    ) {
        let a = Matrix::dense(2, &[1.0 / bottom, -1.0 / bottom, -1.0 / bottom, 1.0 / bottom + 1.0 / top]);
        let radius = spectral_radius(&sor_iteration_matrix(&a, 1.0));
        prop_assert!((radius - top / (bottom + top)).abs() < 1e-9);
    }
}

#[test]
fn the_roll_rate_at_a_pitch_of_60_degrees_is_twice_omega() {
    let [printed, corrected] = both("E40", "roll rate, pitch 60°");
    assert!((printed - 1.0).abs() < 1e-12 && (corrected - 2.0).abs() < 1e-12);
    assert!((both("E40", "yaw rate, pitch 60°")[1] - 3f64.sqrt()).abs() < 1e-12);
}

#[test]
fn the_corner_of_a_box_is_not_among_the_motions_of_the_three_rows() {
    // t = (0, 1, 0, −½, 0, ½) on (0, 1, 0, −½, 0, −½): |t|² − (t·s)²/|s|² = 3/2 − 2/3.
    assert!((both("E45", "distance from c's gradient")[0] - (5.0_f64 / 6.0).sqrt()).abs() < 1e-12);
    assert_eq!(both("E45", "zeros on A's diagonal"), [2.0, 0.0]);
}

#[test]
fn two_forces_upward_make_momentum_out_of_nothing() {
    let [printed, corrected] = both("E48", "momentum afterwards");
    assert!(printed.abs() < 1e-9 && (corrected + 1.0).abs() < 1e-9);
    assert!((both("E48", "sum of both forces")[0] - 4.0).abs() < 1e-9);
}
