//! The judge of circular cones rejects answers that violate Coulomb's law, and names the contact.

use lcplab_judge::{Demand, Verdict, judge_cone};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};

use lcplab_testing::{INF, boxed, pushed_mass};

fn verdict(press: f64, push: f64, law: Law, x: [f64; 3]) -> Verdict {
    let problem = ConeProblem::new(pushed_mass(press, push, 0.0), law);
    judge_cone(&problem, &x, &Demand::default()).verdict
}

#[test]
fn each_line_of_coulombs_law_is_required() {
    let law = Law::Coulomb;
    assert_eq!(verdict(2.0, 3.0, law, [2.0, 1.0, 0.0]), Verdict::Proved { distance: 0.0 });
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

/// An equation in row 0, then two masses that slide equally; μ = ½.
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
    assert_eq!(second.worst_contact, Some(1)); // its tangents, which have one residual
    assert!(matches!(second.verdict, Verdict::NotASolution { row: 5 | 6, .. }));
    assert_eq!(second.cone_violation, 0.25);
    assert_eq!(second.contact_residuals[0], 0.0);

    let equation = judged([0.5, 2.0, 1.0, 0.0, 2.0, 1.0, 0.0]);
    assert_eq!((equation.worst_contact, equation.worst_row), (None, 0));
}

#[test]
fn a_slip_under_a_heavy_load_is_seen_beside_its_own_terms() {
    // 10⁸ N s on a body that slides at 0.5 m/s with friction along the slip; it should stick.
    for load in [1.0, 1e3, 1e6, 1e8, 1e12] {
        let a: [&[f64]; 3] = [&[load, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
        let lcp = boxed(&a, &[-load, 1e-3, 0.0], &[0.0, -INF, -INF], &[INF; 3]);
        let contact = Contact { rows: [0, 1, 2], mu: 0.5 };
        let friction = FrictionProblem::new(lcp, vec![contact]).unwrap();
        for law in [Law::Coulomb, Law::Associated] {
            let problem = ConeProblem::new(friction.clone(), law);
            let accepts =
                |x: [f64; 3]| judge_cone(&problem, &x, &Demand::default()).verdict.is_solution();
            assert!(accepts([1.0, -1e-3, 0.0]), "{load} {law:?}");
            for wrong in [[1.0, 0.5, 0.0], [1.0, 0.0, 0.0], [1.0, 1e-3, 0.0], [1.0, 0.0, 1e-3]] {
                assert!(!accepts(wrong), "{load} {law:?} {wrong:?}");
            }
        }
    }
}

#[test]
fn no_size_of_the_terms_hides_friction_outside_the_cone() {
    for unit in [1e-300, 1e-260, 1e-150, 1.0, 1e150, 1e260] {
        let a: [&[f64]; 3] = [&[unit, 0.0, 0.0], &[0.0, unit, 0.0], &[0.0, 0.0, unit]];
        let b = [-unit, -20.0 * unit, 0.0];
        let lcp = boxed(&a, &b, &[0.0, -INF, -INF], &[INF; 3]);
        let contact = Contact { rows: [0, 1, 2], mu: 1.0 };
        let friction = FrictionProblem::new(lcp, vec![contact]).unwrap();
        let problem = ConeProblem::new(friction, Law::Coulomb);
        let accepts =
            |x: [f64; 3]| judge_cone(&problem, &x, &Demand::default()).verdict.is_solution();
        assert!(accepts([1.0, 1.0, 0.0]), "{unit}");
        assert!(!accepts([1.0, 10.0, 0.0]), "{unit}");
        assert!(!accepts([1.0, 0.0, 0.0]), "{unit}");
    }
}

#[test]
fn an_x_far_along_a_null_direction_is_worth_nothing() {
    // Two contacts that press against each other, walls that close in: w_n = −1 each, for any x.
    let mut a = vec![0.0; 36];
    (a[0], a[3], a[18], a[21]) = (1.0, -1.0, -1.0, 1.0);
    for i in [1, 2, 4, 5] {
        a[7 * i] = 1.0;
    }
    let rows: Vec<&[f64]> = a.chunks(6).collect();
    let b = [-1.0, 0.0, 0.0, -1.0, 0.0, 0.0];
    let lo = [0.0, -INF, -INF, 0.0, -INF, -INF];
    let contacts = [[0, 1, 2], [3, 4, 5]].map(|rows| Contact { rows, mu: 0.5 });
    let friction =
        FrictionProblem::new(boxed(&rows, &b, &lo, &[INF; 6]), contacts.to_vec()).unwrap();
    for law in [Law::Coulomb, Law::Associated] {
        let problem = ConeProblem::new(friction.clone(), law);
        let certificate = judge_cone(&problem, &[1e9, 0.0, 0.0, 1e9, 0.0, 0.0], &Demand::default());
        assert!(certificate.scaled_residual < 1e-8);
        assert!(!certificate.verdict.is_solution(), "{law:?}");
    }
}
