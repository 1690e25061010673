//! Answers that differ from a solution by rounding of their own digits are accepted, and no others.

use lcplab_judge::{Demand, Verdict, judge, judge_cone, judge_friction};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law, Model};
use lcplab_lcp::{Complementarity, Lcp};
use lcplab_testing::{INF, boxed, cases, contacts, manufactured};
use proptest::prelude::*;

fn accepts(lcp: &Lcp, x: &[f64]) -> bool {
    judge(lcp, x, &Demand::default()).verdict.is_solution()
}

#[test]
fn a_row_without_load_is_not_compared_with_its_own_rounding_error() {
    // x = (½, 0): row 1 is an equation 3 x_1 = 0.
    let lcp = boxed(&[&[2.0, 0.0], &[0.0, 3.0]], &[-1.0, 0.0], &[0.0, -INF], &[INF; 2]);
    let certificate = judge(&lcp, &[0.5, 2e-17], &Demand::default());
    assert_eq!(certificate.verdict, Verdict::Proved { distance: 2e-17 });
    assert_eq!(certificate.scaled_residual, 1.0); // the residual is that of x as it is
    assert_eq!(certificate.rounded_by, Some(2e-17));
    // Ten thousand times as much is no rounding error.
    assert!(!accepts(&lcp, &[0.5, 2e-13]));
    // Saddle-point equations x_1 = 0, x_0 + x_1 = 1.
    let lcp = boxed(&[&[0.0, 1.0], &[1.0, 1.0]], &[0.0, -1.0], &[-INF; 2], &[INF; 2]);
    assert!(accepts(&lcp, &[1.0, 1e-17]));
    assert!(!accepts(&lcp, &[1.0, 1e-12]));
}

#[test]
fn without_a_proof_the_rounded_neighbor_decides_and_says_how_far_it_is() {
    let lcp = boxed(&[&[2.0, 0.0], &[0.0, 3.0]], &[-1.0, 0.0], &[0.0, -INF], &[INF; 2]);
    let demand = Demand { prove_up_to: 0, ..Demand::default() };
    let certificate = judge(&lcp, &[0.5, 2e-17], &demand);
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
    assert_eq!(certificate.rounded_by, Some(2e-17));
}

#[test]
fn a_small_entry_of_a_component_of_its_own_is_not_rounding() {
    // Two bodies that are not in contact: x = (1, 1e-16), and 0 is not the answer of the second.
    let lcp = contacts(&[&[1.0, 0.0], &[0.0, 1.0]], &[-1.0, -1e-16]);
    assert!(accepts(&lcp, &[1.0, 1e-16]));
    let lone = contacts(
        &[
            &[1.0, 0.0, 0.0, 0.0],
            &[0.0, 1.0, 0.5, 0.0],
            &[0.0, 0.5, 1.0, 0.0],
            &[0.0, 0.0, 0.0, 1.0],
        ],
        &[-1.0, -1.5e-16, -1.5e-16, -1.0],
    );
    assert!(accepts(&lone, &[1.0, 1e-16, 1e-16, 1.0]));
    assert!(!accepts(&lone, &[1.0, 0.0, 0.0, 1.0])); // rows 1 and 2 have sizes of their own
}

#[test]
fn a_tie_is_read_in_the_way_that_has_a_solution_next_to_x() {
    // Found by Dantzig's rule: the active set {0, 1, 3, 4} has a solution 1.6e-16 away.
    let a: [&[f64]; 5] = [
        &[
            0.13550234981836556,
            0.04066953618190222,
            0.06146163396696891,
            -0.1345599158951177,
            0.06725874818117743,
        ],
        &[
            0.04066953618190222,
            0.2210787919061224,
            0.21374478903115854,
            0.03324021755241007,
            0.10226679320976667,
        ],
        &[
            0.06146163396696891,
            0.21374478903115854,
            0.2528588704896322,
            -0.038542732861080974,
            0.01752100103384186,
        ],
        &[
            -0.1345599158951177,
            0.03324021755241007,
            -0.038542732861080974,
            0.5205142012354109,
            0.06029121807104228,
        ],
        &[
            0.06725874818117743,
            0.10226679320976667,
            0.01752100103384186,
            0.06029121807104228,
            0.2556510771528078,
        ],
    ];
    let b = [-0.0981, -0.0981, -0.0981, 0.06163207755851065, -0.0981];
    let lcp = contacts(&a, &b);
    let solver =
        lcplab_solver::Registry::standard().entry("dantzig").unwrap().build(&Default::default());
    let x = solver.solve(&lcp, &Default::default(), &mut ()).x;
    let verdict = judge(&lcp, &x, &Demand::default()).verdict;
    let Verdict::Proved { distance } = verdict else { panic!("{verdict}") };
    assert!(distance < 1e-15, "{distance}");
}

/// A contact with A = diag(a_n, 1, 1).
fn contact(law: Law, a_n: f64, b: [f64; 3], mu: f64) -> ConeProblem {
    let a: [&[f64]; 3] = [&[a_n, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
    let lcp = boxed(&a, &b, &[0.0, -INF, -INF], &[INF; 3]);
    let contact = Contact { rows: [0, 1, 2], mu };
    ConeProblem::new(FrictionProblem::new(lcp, vec![contact]).unwrap(), law)
}

/// A unit mass on the floor, pressed and pushed; μ = ½.
fn pushed(law: Law, b: [f64; 3]) -> ConeProblem {
    contact(law, 1.0, b, 0.5)
}

#[test]
fn a_force_of_any_size_hides_no_approach_that_it_cannot_change() {
    // w_n = −1 for every x.
    for law in [Law::Coulomb, Law::Associated] {
        let problem = contact(law, 0.0, [-1.0, 0.0, 0.0], 0.5);
        for x in [0.0, 1.0, 1e17, 1e300] {
            let certificate = judge_cone(&problem, &[x, 0.0, 0.0], &Demand::default());
            assert!(!certificate.verdict.is_solution(), "{law:?}, {x:e}");
            assert!(problem.scaled_residual(&[x, 0.0, 0.0]) > 0.5, "{law:?}, {x:e}");
        }
    }
}

#[test]
fn friction_that_is_one_rounding_outside_its_disk_is_accepted() {
    // w_n = 0 for every x, and b_t is μ x_n long: between sticking and sliding.
    let b = [0.0, 0.226_386_605_597_767_44, 0.135_396_768_623_593_57];
    let normal = lcplab_lcp::hypot(b[1], b[2]);
    for law in [Law::Coulomb, Law::Associated] {
        let problem = contact(law, 0.0, b, 1.0);
        for normal in [normal, normal.next_down(), normal.next_up()] {
            let x = [normal, -b[1], -b[2]];
            let verdict = judge_cone(&problem, &x, &Demand::default()).verdict;
            assert!(verdict.is_solution(), "{law:?}, {normal}: {verdict}");
        }
        let x = [0.999 * normal, -b[1], -b[2]];
        assert!(!judge_cone(&problem, &x, &Demand::default()).verdict.is_solution());
    }
}

#[test]
fn a_small_residual_is_refused_where_the_limits_of_friction_exclude_a_solution() {
    // w_0 = −x_0 + 2 x_1 − 1e-10, and |x_1| ≤ x_0/2.
    let a: [&[f64]; 4] = [
        &[-1.0, 2.0, 0.0, 0.0],
        &[0.0, 1.0, 0.0, 0.0],
        &[0.0, 0.0, 1.0, 0.0],
        &[0.0, 0.0, 0.0, 1.0],
    ];
    let b = [-1e-10, -5.0, 0.0, -1.0];
    let lcp = boxed(&a, &b, &[0.0, -INF, -INF, 0.0], &[INF; 4]);
    let contact = Contact { rows: [0, 1, 2], mu: 0.5 };
    for scale in [0.0, 1e-12] {
        let lcp = lcp.clone().with_scale(scale).unwrap();
        let friction = FrictionProblem::new(lcp, vec![contact]).unwrap();
        for model in [Model::CoupledBox, Model::CoulombCone, Model::AssociatedCone] {
            let problem = model.pose(&friction, None).unwrap();
            let certificate = judge_friction(&problem, &[1.0, 0.5, 0.0, 1.0], &Demand::default());
            assert!(!certificate.verdict.is_solution(), "{model}");
            let is_near = certificate.scaled_residual < 1e-10;
            assert!(certificate.refutation().is_some() || !is_near, "{model}");
        }
    }
}

#[test]
fn a_sticking_and_an_open_contact_are_proved_under_both_laws_of_cones() {
    for law in [Law::Coulomb, Law::Associated] {
        let demand = Demand::default();
        let sticks = pushed(law, [-2.0, -0.75, 0.5]);
        let verdict = |x: [f64; 3]| judge_cone(&sticks, &x, &demand).verdict;
        assert_eq!(verdict([2.0, 0.75, -0.5]), Verdict::Proved { distance: 0.0 });
        assert!(!verdict([2.0, 0.7, -0.5]).is_solution());
        let open = pushed(law, [3.0, 4.0, 0.0]);
        assert_eq!(
            judge_cone(&open, &[0.0; 3], &demand).verdict,
            Verdict::Proved { distance: 0.0 }
        );
        // Under the associated law the contact must separate with at least half its slip.
        let slow = pushed(law, [1.0, 4.0, 0.0]);
        let is_solved = judge_cone(&slow, &[0.0; 3], &demand).verdict.is_solution();
        assert_eq!(is_solved, law == Law::Coulomb);
        // A rounding error where nothing pushes along the second tangent.
        let loaded = pushed(law, [-2.0, -0.75, 0.0]);
        assert!(judge_cone(&loaded, &[2.0, 0.75, 3e-17], &demand).verdict.is_solution());
        assert!(!judge_cone(&loaded, &[2.0, 0.75, 3e-7], &demand).verdict.is_solution());
    }
}

/// The connected components of a problem, as a list of rows each: through A and friction, found
/// independently by flood fill.
fn component(lcp: &Lcp, i: usize) -> Vec<usize> {
    let mut found = vec![i];
    let mut next = 0;
    while let Some(&row) = found.get(next) {
        for j in 0..lcp.len() {
            let (a, b) = (lcp.matrix().entry(row, j), lcp.matrix().entry(j, row));
            let is_coupled = [(row, j), (j, row)]
                .iter()
                .any(|&(t, n)| lcp.coupled_to(t).is_some_and(|(k, _)| k == n));
            if (a != 0.0 || b != 0.0 || is_coupled) && !found.contains(&j) {
                found.push(j);
            }
        }
        next += 1;
    }
    found
}

fn size(lcp: &Lcp, x: &[f64], i: usize) -> f64 {
    let rows = component(lcp, i);
    let rows = if rows.len() > 1 { rows } else { (0..x.len()).collect() };
    rows.iter().map(|&j| x[j].abs()).fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn an_accepted_answer_stays_accepted_when_an_entry_moves_by_rounding(
        m in prop_oneof![manufactured(6, 6, 1.0), manufactured(5, 3, 0.0), manufactured(4, 2, 0.0)],
        at in any::<prop::sample::Index>(),
        sign in prop::sample::select(vec![-1.0, 1.0]),
    ) {
        let i = at.index(m.x.len());
        let mut x = m.x.clone();
        x[i] += sign * 1e-15 * size(&m.lcp, &m.x, i);
        let certificate = judge(&m.lcp, &x, &Demand::default());
        prop_assert!(certificate.verdict.is_solution(), "{} {x:?}", certificate.verdict);
    }

    #[test]
    fn no_false_answer_is_accepted_as_a_rounding_of_a_true_one(
        m in manufactured(5, 5, 1.0),
        at in any::<prop::sample::Index>(),
        exponent in -7.0f64..-3.0,
    ) {
        // A is definite, so that x* is the unique solution.
        let i = at.index(m.x.len());
        let mut x = m.x.clone();
        x[i] += 10f64.powf(exponent) * size(&m.lcp, &m.x, i);
        let residual = lcplab_lcp::merit::scaled_residual(&m.lcp, &x);
        let accepted = judge(&m.lcp, &x, &Demand::default()).verdict.is_solution();
        prop_assert_eq!(accepted, residual <= 1e-8 && x != m.x || x == m.x, "{} {:?}", residual, x);
    }

    #[test]
    fn an_entry_that_is_wrongly_put_to_its_bound_is_not_accepted(
        m in manufactured(5, 5, 1.0),
        at in any::<prop::sample::Index>(),
    ) {
        let i = at.index(m.x.len());
        let (lo, hi) = (m.lcp.lo()[i], m.lcp.hi()[i]);
        let bound = if lo.is_finite() { lo } else { 0.0 };
        let mut x = m.x.clone();
        x[i] = if x[i] == bound && hi.is_finite() { hi } else { bound };
        let accepted = judge(&m.lcp, &x, &Demand::default()).verdict.is_solution();
        prop_assert_eq!(accepted, x == m.x);
    }
}
