//! Properties of every cone solver, under both laws of sliding.

use lcplab_judge::reference::cone_qp;
use lcplab_judge::{Demand, judge_cone};
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
use lcplab_lcp::{Complementarity, merit};
use lcplab_solver::{ConeNewton, ConeSolver, Registry, Settings, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, pushed_mass, rubbing};

fn all() -> Vec<Box<dyn ConeSolver>> {
    let settings = Settings::default().with_tolerance(1e-9).with_max_iterations(100_000);
    Registry::standard().cone_entries().map(|entry| entry.build(&settings)).collect()
}

/// The solution by a solver, accepted by the judge; `None` if freezing Coulomb's shift stalls or
/// takes too many steps, since it is slow and may not terminate.
fn answer(solver: &dyn ConeSolver, problem: &ConeProblem) -> Option<Vec<f64>> {
    let solution = solver.solve(problem, &Start::default(), &mut ());
    let has_given_up = matches!(solution.status, Status::Stalled | Status::IterationLimit);
    if has_given_up && (solver.name(), problem.law()) == ("apgd", Law::Coulomb) {
        return None;
    }
    assert_eq!(solution.status, Status::Solved, "{} {:?}", solver.name(), problem.law());
    let verdict = judge_cone(problem, &solution.x, &Demand::default()).verdict;
    assert!(verdict.is_solution(), "{}: {verdict}", solver.name());
    Some(solution.x)
}

/// The same if nothing stalls.
fn solved(solver: &dyn ConeSolver, problem: &ConeProblem) -> Vec<f64> {
    answer(solver, problem).expect("does not stall")
}

fn assert_near(found: &[f64], expected: &[f64]) {
    assert_near_to(found, expected, 1e-8);
}

fn assert_near_to(found: &[f64], expected: &[f64], tolerance: f64) {
    let is_near = found.iter().zip(expected).all(|(a, b)| (a - b).abs() < tolerance);
    assert!(is_near && found.len() == expected.len(), "{found:?} is not {expected:?}");
}

#[test]
fn a_mass_sticks_inside_the_cone_under_either_law() {
    for solver in all() {
        for law in [Law::Associated, Law::Coulomb] {
            let problem = ConeProblem::new(pushed_mass(2.0, 0.75, 0.0), law);
            assert_near(&solved(solver.as_ref(), &problem), &[2.0, 0.75, 0.0]);
        }
    }
}

#[test]
fn a_sliding_mass_stays_on_the_floor_only_under_coulombs_law() {
    // Pressed with 2, pushed with 3. Coulomb: x = (2, 1), w = (0, −2). Associated: x is the nearest
    // point to (2, 3) on the side of the cone, x_n = (2 + 3/2)/(1 + 1/4) = 2.8, and w_n = μ |w_t|.
    for solver in all() {
        let problem = ConeProblem::new(pushed_mass(2.0, 3.0, 0.0), Law::Coulomb);
        let x = solved(solver.as_ref(), &problem);
        assert_near(&x, &[2.0, 1.0, 0.0]);
        assert_near(&problem.lcp().w(&x), &[0.0, -2.0, 0.0]);

        let problem = ConeProblem::new(pushed_mass(2.0, 3.0, 0.0), Law::Associated);
        let x = solved(solver.as_ref(), &problem);
        assert_near(&x, &[2.8, 1.4, 0.0]);
        assert_near(&problem.lcp().w(&x), &[0.8, -1.6, 0.0]);
    }
}

#[test]
fn a_mass_that_lifts_off_is_let_go() {
    for solver in all() {
        for law in [Law::Associated, Law::Coulomb] {
            let problem = ConeProblem::new(pushed_mass(-2.0, 1.0, 20.0), law);
            assert_eq!(solved(solver.as_ref(), &problem), [0.0; 3]);
        }
    }
    // Rising more slowly than the slope of its cone, 0.25 < ½·1: only the associated law keeps it.
    for solver in all() {
        let coulomb = ConeProblem::new(pushed_mass(-0.25, 1.0, 0.0), Law::Coulomb);
        assert_near(&solved(solver.as_ref(), &coulomb), &[0.0; 3]);
        let associated = ConeProblem::new(pushed_mass(-0.25, 1.0, 0.0), Law::Associated);
        assert!(solved(solver.as_ref(), &associated)[0] > 0.1);
    }
}

#[test]
fn the_empty_problem_is_solved() {
    let empty = FrictionProblem::new(boxed(&[], &[], &[], &[]), vec![]).unwrap();
    for solver in all() {
        assert!(solved(solver.as_ref(), &ConeProblem::new(empty.clone(), Law::Coulomb)).is_empty());
    }
}

#[test]
fn a_row_that_does_not_move_itself_is_named() {
    let rows: [&[f64]; 3] = [&[0.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
    let lcp = boxed(&rows, &[-1.0; 3], &[0.0, -INF, -INF], &[INF; 3]);
    let contacts = vec![Contact { rows: [0, 1, 2], mu: 0.5 }];
    let problem = ConeProblem::new(FrictionProblem::new(lcp, contacts).unwrap(), Law::Associated);
    for solver in all() {
        let solution = solver.solve(&problem, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::ZeroDiagonal { row: 0 }, "{}", solver.name());
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn both_laws_are_solved_and_friction_takes_energy(problem in rubbing(3, 10, 0.25)) {
        for law in [Law::Associated, Law::Coulomb] {
            let problem = ConeProblem::new(problem.clone(), law);
            let answers = all();
            let answers = answers.iter().filter_map(|solver| answer(solver.as_ref(), &problem));
            for x in answers {
                let (x, w) = (&x, problem.lcp().w(&x));
                prop_assert!(merit::objective(problem.lcp(), x) <= 1e-7); // ½ xᵀ(b + w)
                for contact in problem.friction().contacts() {
                    let ([x_n, x1, x2], [w_n, w1, w2]) = (contact.of(x), contact.of(&w));
                    prop_assert!(x1 * w1 + x2 * w2 <= 1e-7);
                    prop_assert!(x1.hypot(x2) <= contact.mu * x_n + 1e-7);
                    prop_assert!(w_n >= -1e-7);
                    if law == Law::Coulomb {
                        prop_assert!(f64::abs(x_n * w_n) < 1e-6);
                        let power = x1 * w1 + x2 * w2 + contact.mu * x_n * w1.hypot(w2);
                        prop_assert!(power.abs() < 1e-6); // full force against the slip
                    }
                }
            }
        }
    }

    #[test]
    fn clarabel_finds_the_same_impulses(problem in rubbing(2, 7, 0.25)) {
        for law in [Law::Associated, Law::Coulomb] {
            let problem = ConeProblem::new(problem.clone(), law);
            for solver in all() {
                let Some(x) = answer(solver.as_ref(), &problem) else { continue };
                let reference = cone_qp(&problem.frozen_at(&x)).unwrap();
                prop_assert!(reference.solved);
                for (x, reference) in x.iter().zip(&reference.point) {
                    prop_assert!((x - reference).abs() < 1e-4, "{} {:?}", solver.name(), law);
                }
            }
        }
    }

    #[test]
    fn turning_the_tangents_turns_the_friction(problem in rubbing(2, 7, 0.25)) {
        for law in [Law::Associated, Law::Coulomb] {
            for solver in all() {
                let straight = ConeProblem::new(problem.clone(), law);
                let turned = ConeProblem::new(turned(&problem), law);
                let answers = [&straight, &turned].map(|p| answer(solver.as_ref(), p));
                let [Some(x), Some(x_turned)] = answers else { continue };
                assert_near_to(&x_turned, &turn(&x), 1e-5);
            }
        }
    }

    #[test]
    fn redundant_contacts_share_and_move_as_one(problem in rubbing(1, 4, 0.25)) {
        for law in [Law::Associated, Law::Coulomb] {
            let single = ConeProblem::new(problem.clone(), law);
            let doubled = ConeProblem::new(twice(&problem), law);
            for solver in all() {
                let answers = [&single, &doubled].map(|p| answer(solver.as_ref(), p));
                let [Some(x), Some(x_doubled)] = answers else { continue };
                let (w, w_doubled) = (single.lcp().w(&x), doubled.lcp().w(&x_doubled));
                for (i, found) in w_doubled.iter().enumerate() {
                    prop_assert!((found - w[i % w.len()]).abs() < 1e-6, "{}", solver.name());
                }
            }
        }
    }
}

/// The problem with its rows repeated.
fn twice(problem: &FrictionProblem) -> FrictionProblem {
    let (lcp, n) = (problem.lcp(), problem.lcp().len());
    let rows: Vec<Vec<f64>> = (0..2 * n)
        .map(|i| (0..2 * n).map(|j| lcp.matrix().entry(i % n, j % n)).collect())
        .collect();
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let doubled = boxed(&rows, &lcp.b().repeat(2), &lcp.lo().repeat(2), &lcp.hi().repeat(2));
    let copy = problem.contacts().iter().map(|c| Contact { rows: c.rows.map(|i| i + n), ..*c });
    let contacts = problem.contacts().iter().copied().chain(copy).collect();
    FrictionProblem::new(doubled, contacts).unwrap()
}

/// Components along tangents rotated by the angle of the 3-4-5 triangle; row 0 belongs to no
/// contact.
fn turn(values: &[f64]) -> Vec<f64> {
    let mut turned = values.to_vec();
    for contact in turned[1..].chunks_mut(3) {
        let (t1, t2) = (contact[1], contact[2]);
        (contact[1], contact[2]) = (0.8 * t1 + 0.6 * t2, 0.8 * t2 - 0.6 * t1);
    }
    turned
}

/// The problem with rotated tangents, R A Rᵀ and R b.
fn turned(problem: &FrictionProblem) -> FrictionProblem {
    let lcp = problem.lcp();
    let a = lcp.matrix().to_dense();
    let half: Vec<Vec<f64>> = a.column_iter().map(|column| turn(column.as_slice())).collect();
    let transposed = |rows: &[Vec<f64>]| -> Vec<Vec<f64>> {
        (0..rows.len()).map(|j| rows.iter().map(|row| row[j]).collect()).collect()
    };
    let mut rows: Vec<Vec<f64>> = transposed(&half).iter().map(|row| turn(row)).collect();
    for i in 0..rows.len() {
        for j in 0..i {
            rows[i][j] = rows[j][i]; // symmetric in spite of rounding
        }
    }
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let lcp = boxed(&rows, &turn(lcp.b()), lcp.lo(), lcp.hi());
    FrictionProblem::new(lcp, problem.contacts().to_vec()).unwrap()
}

/// Newton's method of the fallback sequence, on the same closed forms.
#[test]
fn newtons_method_sticks_slides_and_lifts_off_under_coulombs_law() {
    let solver = ConeNewton { settings: Settings::default().with_tolerance(1e-12) };
    let of_5_12_13 = 12f64.atan2(5.0).to_degrees();
    for ([down, push, degrees], expected) in [
        ([2.0, 0.75, 0.0], [2.0, 0.75, 0.0]),
        ([2.0, 3.0, 0.0], [2.0, 1.0, 0.0]),
        ([2.0, 13.0, of_5_12_13], [2.0, 5.0 / 13.0, 12.0 / 13.0]),
        ([-2.0, 1.0, 20.0], [0.0; 3]),
        ([-0.25, 1.0, 0.0], [0.0; 3]),
    ] {
        let problem = ConeProblem::new(pushed_mass(down, push, degrees), Law::Coulomb);
        let solution = solver.solve(&problem, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert_near_to(&solution.x, &expected, 1e-11);
    }
    let problem = ConeProblem::new(pushed_mass(2.0, 3.0, 0.0), Law::Associated);
    let refused = solver.solve(&problem, &Start::default(), &mut ());
    assert!(matches!(refused.status, Status::OutsideClass { .. }));
}

/// Four feet of one table: J J^T has rank 6 of 12 rows. The feet share the load in infinitely many
/// ways, and slide together under a push above μ m g.
#[test]
fn newtons_method_solves_redundant_contacts() {
    let feet = [[1.0, 0.7], [-1.0, 0.7], [-1.0, -0.7], [1.0, -0.7]];
    let height = 0.2;
    // The rows n, x and y of a foot at (p, q, −h), for a unit mass with unit inertia.
    let row = |[p, q]: [f64; 2], k: usize| -> [f64; 6] {
        let axis = |i: usize| if i == k { 1.0 } else { 0.0 };
        let [z, x, y] = [axis(0), axis(1), axis(2)];
        [x, y, z, q * z + height * y, -height * x - p * z, p * y - q * x]
    };
    let rows: Vec<[f64; 6]> =
        feet.into_iter().flat_map(|foot| [0, 1, 2].map(|k| row(foot, k))).collect();
    let dot = |u: &[f64; 6], v: &[f64; 6]| -> f64 { u.iter().zip(v).map(|(u, v)| u * v).sum() };
    let a: Vec<Vec<f64>> = rows.iter().map(|u| rows.iter().map(|v| dot(u, v)).collect()).collect();
    let a: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
    for (push, slip) in [(0.3, 0.0), (0.9, 0.4)] {
        let free = [push, 0.0, -1.0, 0.0, 0.0, 0.0];
        let b: Vec<f64> = rows.iter().map(|row| dot(row, &free)).collect();
        let lo: Vec<f64> = (0..12).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
        let contacts = (0..4).map(|k| Contact { rows: [3 * k, 3 * k + 1, 3 * k + 2], mu: 0.5 });
        let lcp = boxed(&a, &b, &lo, &[INF; 12]);
        let friction = FrictionProblem::new(lcp, contacts.collect()).unwrap();
        let problem = ConeProblem::new(friction, Law::Coulomb);
        let solver = ConeNewton { settings: Settings::default().with_tolerance(1e-10) };
        let solution = solver.solve(&problem, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        let verdict = judge_cone(&problem, &solution.x, &Demand::default()).verdict;
        assert!(verdict.is_solution(), "{verdict}");
        let w = problem.lcp().w(&solution.x);
        (0..4).for_each(|k| assert!((w[3 * k + 1] - slip).abs() < 1e-9, "{w:?}"));
    }
}
