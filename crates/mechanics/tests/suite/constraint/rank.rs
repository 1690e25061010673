//! A joint removes as many degrees of freedom as the rank of its J.

use lcplab_mechanics::body::State;
use lcplab_mechanics::constraint::{Joint, Verifiable};
use nalgebra::{DMatrix, Vector6};
use proptest::prelude::*;

use super::dual::{Place, placement, state};
use super::joints::cases;
use lcplab_testing::cases as config;

/// The rank of J for two moving bodies, or for body 1 alone.
fn rank(constraint: &dyn Verifiable, states: [&State; 2], alone: bool) -> usize {
    let rows = constraint.rows(states).expect("a regular state");
    let first = if alone { 6 } else { 0 };
    let entry = |i: usize, j: usize| {
        let column = first + j;
        rows[i].jacobian[column / 6][column % 6]
    };
    let j = DMatrix::from_fn(rows.len(), 12 - first, entry);
    let singular = j.singular_values();
    singular.iter().filter(|value| **value > 1e-9 * singular[0]).count()
}

proptest! {
    #![proptest_config(config(64))]

    #[test]
    fn a_joint_removes_the_right_number_of_degrees_of_freedom(
        at in placement(), a in state(), b in state(),
    ) {
        for case in cases() {
            let joint = Joint::by_name(case.name).unwrap();
            let constraint = (joint.build)(&at.of(joint)).unwrap();
            prop_assume!(constraint.rows([&a, &b]).is_ok());
            for alone in [false, true] {
                prop_assert_eq!(rank(constraint.as_ref(), [&a, &b], alone), case.removes, "{}", case.name);
            }
        }
    }
}

#[test]
fn a_hinge_leaves_the_turn_about_its_axis() {
    let joint = Joint::by_name("hinge").unwrap();
    let hinge = (joint.build)(&Place::plain().of(joint)).unwrap();
    let about = Vector6::ith(5, 1.0);
    for row in hinge.rows([&State::WORLD; 2]).unwrap() {
        assert_eq!(row.jacobian[1].dot(&about), 0.0);
    }
}
