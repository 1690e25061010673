//! Dantzig's method on redundant contacts: x moves to the middle of the solution set.

use lcplab_lcp::{Lcp, library, merit};
use lcplab_solver::{Centering, Dantzig, Solver, Start, StepDetail};
use proptest::prelude::*;

use lcplab_testing::{INF, assert_proved, boxed, cases, contacts, manufactured, parts};

/// A move to the middle: x before and after, and how far it could have moved.
struct Middle {
    before: Vec<f64>,
    after: Vec<f64>,
    ends: [Vec<f64>; 2],
}

impl Middle {
    fn of(own: &Centering<'_>) -> Self {
        let at = |t: f64| {
            let mut x = own.x.to_vec();
            x[own.row] += t;
            for (&j, d) in own.free.iter().zip(own.direction) {
                x[j] += t * d;
            }
            x
        };
        Middle { before: at(0.0), after: at(own.length()), ends: [at(-own.back), at(own.forward)] }
    }
}

fn middles(lcp: &Lcp) -> Vec<Middle> {
    let middle = |part: &StepDetail<'_>| match part {
        StepDetail::Centering(own) => Some(Middle::of(own)),
        _ => None,
    };
    parts(&Dantzig::default(), lcp, middle).2
}

fn box_stack(boxes: f64, mu: f64, seed: f64) -> Lcp {
    let family = library::by_name("box-stack").unwrap();
    family.generate(&[("boxes", boxes), ("mu", mu), ("seed", seed)]).unwrap().lcp
}

#[test]
fn a_box_on_four_corners_rests_on_all_of_them_alike() {
    // The rows of A add up to 4, so x = ¼ for b = −1 is the solution with the box's symmetry (E10).
    let a: [&[f64]; 4] = [
        &[4.0, 1.0, 1.0, -2.0],
        &[1.0, 4.0, -2.0, 1.0],
        &[1.0, -2.0, 4.0, 1.0],
        &[-2.0, 1.0, 1.0, 4.0],
    ];
    let lcp = contacts(&a, &[-1.0; 4]);
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    assert!(x.iter().all(|x| (x - 0.25).abs() < 1e-15), "{x:?}");
    assert_proved(&lcp, &x);
}

#[test]
fn two_contacts_at_one_place_share_the_load() {
    let lcp = contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0; 2]);
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    assert_eq!(x, [0.5; 2]);
    assert_proved(&lcp, &x);
}

#[test]
fn what_has_no_end_has_no_middle() {
    // Two contacts that press against each other: x₀ = x₁ + 1, however large. And two equal
    // equations: x₀ + x₁ = 1.
    let wedge = contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, 1.0]);
    let same = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0; 2], &[-INF; 2], &[INF; 2]);
    for lcp in [wedge, same] {
        assert!(middles(&lcp).is_empty());
        let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
        assert_eq!(x, [1.0, 0.0]);
    }
}

#[test]
fn a_row_at_rest_stays_where_it_is_if_a_is_not_semidefinite() {
    // x = (1, 0) has w = 0; along (−2, 1) the objective would fall by 3/2 t².
    let lcp = contacts(&[&[1.0, 2.0], &[2.0, 1.0]], &[-1.0, -2.0]);
    assert!(middles(&lcp).is_empty());
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    assert_eq!(x, [1.0, 0.0]);
    assert_proved(&lcp, &x);
}

#[test]
fn a_stack_takes_at_most_two_moves_a_row_however_high() {
    // Every row moves x once, to enter C or to become dependent. Without the middle it takes 2.1,
    // 2.7, 3.3 and 5.5.
    for boxes in [5.0, 10.0, 20.0, 50.0] {
        for seed in [1.0, 2.0, 3.0] {
            let lcp = box_stack(boxes, 0.0, seed);
            let moves = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).iterations;
            assert!(moves <= 2 * lcp.len(), "{moves} moves of {} rows", lcp.len());
        }
    }
}

/// A move to the middle changes no w and not the objective, up to rounding, and crosses no bound.
fn assert_nothing_but_x_changes(lcp: &Lcp, middle: &Middle) {
    let (before, after) = (lcp.w(&middle.before), lcp.w(&middle.after));
    for i in 0..lcp.len() {
        let scale = merit::RowTerms::at(lcp, i, &middle.after).magnitude.max(1.0);
        assert!((before[i] - after[i]).abs() <= 1e-10 * scale, "w of row {i}");
    }
    let [before, after] = [&middle.before, &middle.after].map(|x| merit::objective(lcp, x));
    assert!((before - after).abs() <= 1e-9 * before.abs().max(1.0), "{before} and {after}");
    for (i, x) in middle.after.iter().enumerate() {
        let rounding = 1e-12 * middle.before[i].abs().max(1.0);
        assert!(lcp.lo()[i] - rounding <= *x && *x <= lcp.hi()[i] + rounding, "x of row {i}");
    }
}

#[test]
fn the_middle_is_as_far_from_a_bound_behind_as_from_one_ahead() {
    let mut count = 0;
    for (boxes, mu) in [(5.0, 0.0), (10.0, 0.0), (5.0, 0.5)] {
        let lcp = box_stack(boxes, mu, 1.0);
        for middle in middles(&lcp) {
            assert_nothing_but_x_changes(&lcp, &middle);
            for end in &middle.ends {
                let meets = |i: usize| {
                    let off = (end[i] - lcp.lo()[i]).abs().min((end[i] - lcp.hi()[i]).abs());
                    off <= 1e-12 && end[i] != middle.after[i]
                };
                assert!((0..lcp.len()).any(meets));
            }
            for ((after, back), ahead) in
                middle.after.iter().zip(&middle.ends[0]).zip(&middle.ends[1])
            {
                assert!((after - (back + ahead) / 2.0).abs() <= 1e-12);
            }
            count += 1;
        }
    }
    assert!(count > 20, "{count} moves to the middle");
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn a_move_to_the_middle_changes_no_w_nor_the_objective(m in manufactured(8, 3, 0.0)) {
        for middle in middles(&m.lcp) {
            assert_nothing_but_x_changes(&m.lcp, &middle);
        }
    }
}
