use lcplab::lcp::exchange;
use lcplab::lcp::friction::{Contact, Model};
use proptest::prelude::*;

use super::{again, assert_same, frictions, message, refusal, rows, sample};
use crate::common::{INF, cases};

#[test]
fn a_local_problem_is_read_with_its_unsymmetric_w() {
    let problem = exchange::read(&sample("fclib_local.hdf5"), None).unwrap();
    let a = rows(problem.lcp.matrix());
    assert_eq!(a[0], [2.0, 0.0, 0.0, 1.0, 0.125, 0.0, 0.0]);
    assert_eq!(a[4], [0.25, 0.0, 0.0, 0.0, 6.0, 0.0, 0.0]);
    assert_eq!(a[6], [0.0, -0.5, 0.0, 0.0, 0.0, 0.0, 1.5]);
    assert_eq!(a[1][6], -0.5);
    assert_eq!(problem.lcp.b(), [-1.0, 2.0, 0.0, -3.0, 0.0, 1.0, 4.0]);
    assert_eq!(problem.lcp.lo(), [0.0, -INF, -INF, 0.0, -INF, -INF, -INF]);
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    let expected = [([0, 1, 2], 0.5), ([3, 4, 5], 0.25)];
    assert_eq!(contacts, expected.map(|(rows, mu)| Contact { rows, mu }));
    assert_eq!((problem.model, problem.name.as_str()), (Some(Model::CoulombCone), "two contacts"));
}

/// The same motion as that of the dump in the tests of Chrono's format, without compliance and with
/// the equation behind the contact.
#[test]
fn a_global_problem_becomes_the_problem_in_impulses() {
    let problem = exchange::read(&sample("fclib_global.hdf5"), None).unwrap();
    let expected = [
        [1.0, 0.0, 0.0, -1.0],
        [0.0, 0.5, 0.0, 0.25],
        [0.0, 0.0, 0.25, 0.0],
        [-1.0, 0.25, 0.0, 1.25],
    ];
    assert_eq!(rows(problem.lcp.matrix()), expected);
    assert_eq!(problem.lcp.b(), [-1.5, 3.0, 0.0, 4.0]);
}

#[test]
fn what_is_no_hdf5_is_refused() {
    assert!(message("fclib", "\u{89}HDF, but nothing else").starts_with("p: file: "));
}

#[test]
fn only_contacts_and_equations_are_written() {
    let boxed = lcplab::lcp::library::by_name("manufactured").unwrap().generate(&[]).unwrap();
    assert_eq!(
        refusal(&boxed, "fclib"),
        "fclib: friction_index: is missing: there are no contacts"
    );
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in (0usize..2).prop_flat_map(frictions)) {
        let back = again(&problem, "fclib");
        assert_same(&problem.lcp, &back.lcp);
        prop_assert_eq!(back.name, "frictions");
    }
}
