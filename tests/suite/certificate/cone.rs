//! The judge of circular cones refutes what is not Coulomb's law, and names the contact.

use lcplab::certificate::{Demand, Verdict, judge_cone};
use lcplab::lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};

use crate::common::{INF, boxed, pushed_mass};

fn verdict(press: f64, push: f64, law: Law, x: [f64; 3]) -> Verdict {
    let problem = ConeProblem::new(pushed_mass(press, push, 0.0), law);
    judge_cone(&problem, &x, &Demand::default()).verdict
}

#[test]
fn each_line_of_coulombs_law_is_asked_for() {
    let law = Law::Coulomb;
    assert_eq!(verdict(2.0, 3.0, law, [2.0, 1.0, 0.0]), Verdict::WithinTolerance);
    for (wrong, x) in [
        ("too little friction", [2.0, 0.5, 0.0]),
        ("too much friction", [2.0, 1.1, 0.0]),
        ("friction along the slip", [2.0, -1.0, 0.0]),
        ("friction aslant", [2.0, 0.8, 0.6]),
        ("pressed in", [1.0, 0.5, 0.0]),
        ("pushed off", [3.0, 1.5, 0.0]),
        ("pulled", [-2.0, 0.0, 0.0]),
        ("let go", [0.0, 0.0, 0.0]),
        ("lost", [f64::NAN, 0.0, 0.0]),
    ] {
        assert!(!verdict(2.0, 3.0, law, x).is_solution(), "{wrong}");
    }
}

#[test]
fn a_sticking_contact_may_not_creep() {
    assert!(verdict(2.0, 0.75, Law::Coulomb, [2.0, 0.75, 0.0]).is_solution());
    assert!(!verdict(2.0, 0.75, Law::Coulomb, [2.0, 0.749, 0.0]).is_solution());
}

#[test]
fn the_laws_differ_while_sliding_only() {
    let [coulomb, associated] = [[2.0, 1.0, 0.0], [2.8, 1.4, 0.0]];
    assert!(verdict(2.0, 3.0, Law::Associated, associated).is_solution());
    assert!(!verdict(2.0, 3.0, Law::Associated, coulomb).is_solution());
    assert!(!verdict(2.0, 3.0, Law::Coulomb, associated).is_solution());
}

/// An equation in row 0, then two masses that slide alike; μ = ½.
fn two_masses() -> ConeProblem {
    let identity: Vec<Vec<f64>> =
        (0..7).map(|i| (0..7).map(|j| f64::from(u8::from(i == j))).collect()).collect();
    let rows: Vec<&[f64]> = identity.iter().map(Vec::as_slice).collect();
    let b = [-1.0, -2.0, -3.0, 0.0, -2.0, -3.0, 0.0];
    let lo = [-INF, 0.0, -INF, -INF, 0.0, -INF, -INF];
    let contacts = [1, 4].map(|first| Contact { rows: [first, first + 1, first + 2], mu: 0.5 });
    let lcp = boxed(&rows, &b, &lo, &[INF; 7]);
    ConeProblem::new(FrictionProblem::new(lcp, contacts.to_vec()).unwrap(), Law::Coulomb)
}

#[test]
fn the_worst_contact_or_row_is_named() {
    let judged = |x: [f64; 7]| judge_cone(&two_masses(), &x, &Demand::default());
    assert!(judged([1.0, 2.0, 1.0, 0.0, 2.0, 1.0, 0.0]).verdict.is_solution());

    let second = judged([1.0, 2.0, 1.0, 0.0, 2.0, 1.25, 0.0]);
    assert_eq!((second.worst_contact, second.worst_row), (Some(1), 4));
    assert!(matches!(second.verdict, Verdict::NotASolution { row: 4, .. }));
    assert_eq!(second.cone_violation, 0.25);
    assert_eq!(second.contact_residuals[0], 0.0);

    let equation = judged([0.5, 2.0, 1.0, 0.0, 2.0, 1.0, 0.0]);
    assert_eq!((equation.worst_contact, equation.worst_row), (None, 0));
}
