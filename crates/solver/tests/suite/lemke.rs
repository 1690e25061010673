use std::ops::ControlFlow;

use lcplab_judge::ray::refute;
use lcplab_lcp::{Lcp, Matrix, library};
use lcplab_solver::{
    Event, Fallback, Iterate, Lemke, Observer, Settings, Solution, Solver, Start, Status,
    StepDetail,
};
use proptest::prelude::*;

use lcplab_testing::{
    INF, Manufactured, assert_certified, assert_proved, boxed, cases, contacts, events, iterates,
    manufactured, parts,
};

/// The solution and the rows of its pivots: by tableaux, which are built if an observer wants them,
/// or by principal pivots if those are reliable.
fn followed(lcp: &Lcp, asks: bool) -> (Solution, Vec<Event>) {
    if !asks {
        return events(&Lemke::default(), lcp);
    }
    let (solution, events, _) = parts(&Lemke::default(), lcp, |_| None::<()>);
    (solution, events)
}

/// Rows of a problem with x at a bound and w = 0.
fn degenerate(m: &Manufactured) -> usize {
    let (lcp, w) = (&m.lcp, m.lcp.w(&m.x));
    let is_at_bound = |i: usize| m.x[i] == lcp.lo()[i] || m.x[i] == lcp.hi()[i];
    (0..lcp.len()).filter(|&i| is_at_bound(i) && w[i].abs() < 1e-9).count()
}

#[test]
fn ties_of_a_stack_are_broken_alike_by_principal_pivots_and_by_the_table() {
    for (boxes, compliance) in [(1.0, 0.0), (5.0, 0.0), (10.0, 0.0), (10.0, 1e-8)] {
        let family = library::by_name("box-stack").unwrap();
        let lcp = family.generate(&[("boxes", boxes)]).unwrap().lcp.softened(compliance).unwrap();
        let (solution, pivots) = followed(&lcp, false);
        assert_eq!(pivots, followed(&lcp, true).1, "{boxes} {compliance}");
        assert_eq!(solution.status, Status::Solved);
        assert_certified(&lcp, &solution.x);
    }
}

/// The numbers of the reported iterates, and of the tableaux those with a leaving variable.
#[derive(Default)]
struct Reported {
    wants_details: bool,
    numbers: Vec<usize>,
    exchanges: usize,
}

impl Observer for Reported {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.numbers.push(iterate.iteration);
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        self.wants_details
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        let leaves = matches!(part, StepDetail::Tableau(table) if table.leaving.is_some());
        self.exchanges += usize::from(leaves);
    }
}

#[test]
fn every_pivot_is_reported_once_on_whichever_path_it_is_made() {
    let of_library = library::all().map(|family| family.generate(&[]).unwrap().lcp);
    // Coupled rows are frozen several times; every second row of these depends on others.
    let stack = |boxes: f64, mu: f64| {
        let family = library::by_name("box-stack").unwrap();
        family.generate(&[("boxes", boxes), ("mu", mu)]).unwrap().lcp
    };
    let stacks = [(5.0, 0.0), (3.0, 0.5), (12.0, 0.5), (20.0, 0.5)].map(|(n, mu)| stack(n, mu));
    let mut second_paths = 0;
    for lcp in of_library.filter(|lcp| lcp.len() <= 200).chain(stacks) {
        for wants_details in [false, true] {
            let mut reported = Reported { wants_details, ..Reported::default() };
            let solution = Lemke::default().solve(&lcp, &Start::default(), &mut reported);
            let last = reported.numbers.last().copied().unwrap_or(0);
            assert_eq!(reported.numbers, (0..=last).collect::<Vec<_>>());
            match solution.fallback {
                // The proximal steps count, and are not reported.
                Some(Fallback::Proximal) => assert!(last <= solution.iterations),
                _ => assert_eq!(last, solution.iterations, "{wants_details} {}", solution.status),
            }
            if wants_details {
                assert_eq!(reported.exchanges, last, "{}", solution.status);
            }
            second_paths += usize::from(solution.fallback == Some(Fallback::SecondPath));
        }
    }
    assert!(second_paths > 0);
}

#[test]
fn a_second_path_is_named() {
    // Twenty cubes on four corners each, with friction: 240 rows of which every second depends on
    // the others, so that rounding leads the first tableau path to a wrong end.
    let stack = |boxes: f64| {
        let family = library::by_name("box-stack").unwrap();
        family.generate(&[("boxes", boxes), ("mu", 0.5)]).unwrap().lcp
    };
    let named = |boxes: f64, asks: bool| {
        let solution = followed(&stack(boxes), asks).0;
        (solution.status, solution.fallback)
    };
    assert_eq!(named(1.0, true), (Status::Solved, None));
    assert_eq!(named(20.0, true), (Status::Solved, Some(Fallback::SecondPath)));
    assert_eq!(named(20.0, false), (Status::Solved, None));
}

#[test]
fn yielding_contacts_of_fifty_boxes_with_friction_are_solved() {
    // A has a condition number of 10¹⁰; the tableau loses all accuracy there.
    let family = library::by_name("box-stack").unwrap();
    let lcp = family.generate(&[("boxes", 50.0), ("mu", 0.5)]).unwrap().lcp;
    let lcp = lcp.softened(1e-8).unwrap();
    let solution = lemke(&lcp);
    assert_eq!((solution.status, solution.fallback), (Status::Solved, None));
    assert_certified(&lcp, &solution.x);
}

fn lemke(lcp: &Lcp) -> Solution {
    Lemke::default().solve(lcp, &Start::default(), &mut ())
}

#[test]
fn published_problems_take_the_published_number_of_pivots() {
    // Counted in exact arithmetic with the covering vector of ones and lexicographic ties,
    // including the first entering step. The solutions are in the library and are proved here.
    for (name, pivots) in [
        ("murty", 2),
        ("murty-exponential", 64),
        ("cps-1", 2),
        ("cps-2", 5),
        ("cps-4", 5),
        ("cps-4bis", 5),
        ("cps-5", 2),
        ("kostreva-1", 4),
        ("pang-isolated", 3),
        ("pang-other", 5),
        ("deudeu", 3),
        ("ortiz", 3),
        ("trivial", 10),
        ("path", 4),
    ] {
        let lcp = library::by_name(name).unwrap().generate(&[]).unwrap().lcp;
        let solution = lemke(&lcp);
        assert_eq!((solution.status, solution.iterations), (Status::Solved, pivots), "{name}");
        assert_proved(&lcp, &solution.x);
    }
}

#[test]
fn published_rays_are_met_after_the_published_number_of_pivots() {
    // The bimatrix game nevertheless has three solutions; the perturbed problem has none.
    for (name, pivots) in [("cps-3", 1), ("pang-perturbed", 4)] {
        let lcp = library::by_name(name).unwrap().generate(&[]).unwrap().lcp;
        let solution = lemke(&lcp);
        assert!(matches!(solution.status, Status::Ray { .. }), "{name}: {}", solution.status);
        assert_eq!(solution.iterations, pivots, "{name}");
    }
}

#[test]
fn ties_do_not_make_it_cycle() {
    let lcp = library::by_name("kostreva-2").unwrap().generate(&[]).unwrap().lcp;
    assert!(matches!(lemke(&lcp).status, Status::Ray { .. }));
    // All b equal and every row the same: each ratio is tied with all others.
    let lcp = contacts(&[&[1.0; 6][..]; 6], &[-1.0; 6]);
    let solution = lemke(&lcp);
    assert_eq!((solution.status, solution.iterations), (Status::Solved, 2));
}

#[test]
fn all_intervals_with_the_seven_kinds_of_bounds_are_solved() {
    let lcp = library::by_name("mcp09").unwrap().generate(&[]).unwrap().lcp;
    assert_eq!(lemke(&lcp).x, [4.0, 2.0, 3.0, 4.0, 2.0, 4.0, 2.0]);
}

#[test]
fn free_rows_are_eliminated_whatever_their_diagonal() {
    // Equations x2 = 1 and x1 = 2: A_EE has no diagonal, and is regular.
    let lcp = boxed(&[&[0.0, 1.0], &[1.0, 0.0]], &[-1.0, -2.0], &[-INF; 2], &[INF; 2]);
    assert_eq!(lemke(&lcp).x, [2.0, 1.0]);
    // A joint (free) that supports a contact: x1 − x2 = 1, −x1 + 2 x2 + 1 ≥ 0 with x2 ≥ 0.
    let lcp = boxed(&[&[1.0, -1.0], &[-1.0, 2.0]], &[-1.0, -1.0], &[-INF, 0.0], &[INF; 2]);
    let solution = lemke(&lcp);
    assert_proved(&lcp, &solution.x); // x = (3, 2)
    assert_eq!(solution.x, [3.0, 2.0]);
}

#[test]
fn a_free_row_without_a_pivot_may_become_negative_on_the_path() {
    // x2 = 2 is the equation of row 1, and −x1 + x2 − 5 = 0 there: A_EE = 0, so x1 = −3 is split.
    let lcp = boxed(&[&[0.0, 1.0], &[-1.0, 1.0]], &[-2.0, -5.0], &[-INF, 0.0], &[INF; 2]);
    assert_eq!(iterates(&Lemke::default(), &lcp).last().unwrap(), &[-3.0, 2.0]);
    assert_proved(&lcp, &lemke(&lcp).x);
}

#[test]
fn a_free_row_listed_twice_is_solved_and_a_contradiction_is_refuted() {
    let twice = |b2: f64| boxed(&[&[2.0, 2.0], &[2.0, 2.0]], &[-3.0, b2], &[-INF; 2], &[INF; 2]);
    assert_proved(&twice(-3.0), &lemke(&twice(-3.0)).x);
    let torn = twice(-4.0);
    let Status::Ray { row, direction } = lemke(&torn).status else { panic!("no ray") };
    assert!(refute(&torn, row, &direction).is_some());
}

#[test]
fn a_full_box_has_no_second_ray_even_for_an_indefinite_matrix() {
    let a: [&[f64]; 3] = [&[-1.0, 3.0, 0.0], &[2.0, -4.0, 1.0], &[0.0, -5.0, 0.0]];
    let lcp = boxed(&a, &[-1.0, 2.0, 1.0], &[-1.0, 0.0, -2.0], &[1.0, 3.0, 5.0]);
    assert_proved(&lcp, &lemke(&lcp).x);
}

#[test]
fn wedged_bodies_are_refuted_by_the_ray() {
    let lcp = library::by_name("wedged").unwrap().generate(&[("n", 12.0)]).unwrap().lcp;
    let Status::Ray { row, direction } = lemke(&lcp).status else { panic!("no ray") };
    assert!(refute(&lcp, row, &direction).is_some());
}

#[test]
fn polyhedral_friction_is_solved() {
    for (seed, contacts) in [(1, 8.0), (2, 8.0), (3, 15.0), (4, 15.0), (5, 25.0), (6, 40.0)] {
        let given = [("contacts", contacts), ("seed", f64::from(seed))];
        let lcp = library::by_name("friction-blocks").unwrap().generate(&given).unwrap().lcp;
        let solution = lemke(&lcp);
        assert_eq!(solution.status, Status::Solved, "seed {seed}");
        assert_certified(&lcp, &solution.x);
    }
}

#[test]
fn masses_from_1_to_1e12_and_copied_contacts_are_solved_tightly() {
    let settings = Settings::default().with_tolerance(1e-10);
    for (name, given) in [
        ("stack", [("n", 20.0), ("ratio", 1e12)]),
        ("near-duplicate", [("n", 20.0), ("bits", 20.0)]),
        ("contact-graph", [("contacts", 40.0), ("decades", 12.0)]),
    ] {
        let lcp = library::by_name(name).unwrap().generate(&given).unwrap().lcp;
        let solution = Lemke { settings: settings.clone() }.solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{name}");
    }
}

#[test]
fn the_unit_of_w_changes_no_pivot() {
    // Masses over 12 decades, so that the covering vector is that of the rows' units.
    let given = [("contacts", 40.0), ("decades", 12.0)];
    let lcp = library::by_name("contact-graph").unwrap().generate(&given).unwrap().lcp;
    for unit in [2f64.powi(-60), 2f64.powi(60)] {
        let row = |i: usize| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a * unit));
        let a = Matrix::sparse(40, &(0..40).flat_map(row).collect::<Vec<_>>());
        let b = lcp.b().iter().map(|b| b * unit).collect();
        let scaled = Lcp::new(a, b, lcp.lo().to_vec(), lcp.hi().to_vec()).unwrap();
        let lemke = Lemke::default();
        assert_eq!(iterates(&lemke, &scaled), iterates(&lemke, &lcp), "{unit}");
    }
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn principal_pivots_follow_the_path_of_the_table(
        m in prop_oneof![manufactured(12, 12, 0.25), manufactured(30, 30, 0.25)],
    ) {
        let (solution, pivots) = followed(&m.lcp, false);
        let (of_table, by_table) = followed(&m.lcp, true);
        // Rows with x at a bound and w = 0 at the solution end the path together with z₀, and
        // rounding decides which comes first.
        let common = pivots.len().min(by_table.len()) - 1;
        prop_assert_eq!(&pivots[..common], &by_table[..common]);
        prop_assert!(pivots.len().abs_diff(by_table.len()) <= degenerate(&m), "{:?}", (pivots, by_table));
        prop_assert_eq!((solution.status, of_table.status), (Status::Solved, Status::Solved));
        for (found, x) in solution.x.iter().zip(&m.x) {
            prop_assert!((found - x).abs() <= 1e-9 * x.abs().max(1.0), "{} {}", found, x);
        }
    }

    #[test]
    fn every_semidefinite_problem_with_a_solution_is_solved(m in manufactured(8, 4, 0.0)) {
        let solution = lemke(&m.lcp);
        prop_assert_eq!(&solution.status, &Status::Solved, "x* = {:?}", m.x);
        assert_certified(&m.lcp, &solution.x);
    }

    #[test]
    fn units_do_not_matter(m in manufactured(5, 5, 1.0), k in proptest::collection::vec(-30i32..30, 5)) {
        // x → x / d, w → d w with d = 2^k. The covering vector is not scaled, so the path differs;
        // the solution is the same, bit for bit if the path is short.
        let d: Vec<f64> = k.iter().map(|&k| 2f64.powi(k)).collect();
        let a: Vec<f64> = (0..25).map(|e| d[e / 5] * m.lcp.matrix().entry(e / 5, e % 5) * d[e % 5]).collect();
        let row = |v: &[f64], scale: fn(f64, f64) -> f64| v.iter().zip(&d).map(|(&v, &d)| scale(v, d)).collect::<Vec<f64>>();
        let (b, lo, hi) = (row(m.lcp.b(), |v, d| v * d), row(m.lcp.lo(), |v, d| v / d), row(m.lcp.hi(), |v, d| v / d));
        let scaled = Lcp::new(Matrix::dense(5, &a), b, lo, hi).unwrap();
        let solution = lemke(&scaled);
        prop_assert_eq!(&solution.status, &Status::Solved);
        for i in 0..5 {
            prop_assert!((solution.x[i] * d[i] - m.x[i]).abs() < 1e-9 * (1.0 + m.x[i].abs()));
        }
    }
}
