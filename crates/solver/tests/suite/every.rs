//! Properties of every registered solver.

use std::collections::HashMap;

use lcplab_judge::ray::refute;
use lcplab_judge::{Demand, judge};
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_solver::trace::Provenance;
use lcplab_solver::{KNOWN_WRONG, Options, Registry, Settings, Solver, Start, Status};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::{INF, Manufactured, assert_certified, boxed, cases, contacts, manufactured};

fn all() -> Vec<Box<dyn Solver>> {
    Registry::standard().entries().map(|entry| entry.build(&Options::default())).collect()
}

#[test]
fn an_unknown_name_is_answered_with_names_that_are_taken() {
    let error = Registry::standard().entry("gauss").unwrap_err().to_string();
    let (begins, names) = error.split_once("; there are ").unwrap();
    assert_eq!(begins, "there is no solver named \"gauss\"");
    let names: Vec<&str> = names.split(", ").collect();
    assert!(names.len() >= 20 && names.contains(&"dantzig"), "{error}");
    for name in names {
        assert!(Registry::standard().entry(name).is_ok(), "{name}");
    }
}

#[test]
fn no_two_take_the_same_path() {
    // Contacts of unequal weight, some of which open; the first sweep is on the wrong side of
    // several.
    let a: [&[f64]; 5] = [
        &[4.0, -1.5, 0.5, 0.0, 0.25],
        &[-1.5, 3.0, -1.0, 0.5, 0.0],
        &[0.5, -1.0, 2.0, -0.75, 0.5],
        &[0.0, 0.5, -0.75, 5.0, -2.0],
        &[0.25, 0.0, 0.5, -2.0, 2.5],
    ];
    let lcp = boxed(&a, &[-1.0, 0.75, -2.0, 1.5, -3.0], &[0.0; 5], &[INF, INF, INF, 0.5, 1.75]);
    let mut paths: HashMap<u64, &str> = HashMap::new();
    for entry in Registry::standard().entries().chain(KNOWN_WRONG) {
        let solver = entry.build(&Options::default());
        let mut provenance = Provenance::of(&lcp);
        let solution = solver.solve(&lcp, &Start::default(), &mut provenance);
        assert_eq!(provenance.iterations, solution.iterations, "{}", entry.name);
        assert!(provenance.iterations > 0, "{}", entry.name);
        let other = paths.insert(provenance.fingerprint, &entry.name);
        assert_eq!(other, None, "{} does the same", entry.name);
    }
}

#[test]
fn a_matrix_that_is_symmetric_but_for_rounding_is_taken_by_all_and_one_beyond_is_not() {
    // A dump's J M⁻¹ Jᵀ: a_01 and a_10 differ in the last bit. A x + b = 0 at (1, 2, 1).
    let dumped = |other: f64| {
        contacts(
            &[&[2.0, other, 0.0], &[-1.0, 2.0, -1.0], &[0.0, -1.0, 2.0]],
            &[-2.0 - 2.0 * other, -2.0, 0.0],
        )
    };
    let lcp = dumped(-1.0 - f64::EPSILON);
    assert!(!lcp.matrix().is_symmetric() && lcp.matrix().is_nearly_symmetric());
    for solver in all() {
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{}", solver.name());
        assert_certified(&lcp, &solution.x);
    }
    assert!(!dumped(-1.0 - 1e-9).matrix().is_nearly_symmetric());
}

#[test]
fn the_empty_problem_is_solved() {
    for solver in all() {
        let solution = solver.solve(&contacts(&[], &[]), &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{}", solver.name());
    }
}

#[test]
fn a_start_that_is_a_solution_is_solved_outside_the_class_too() {
    for a in [
        &[&[0.0, 0.0][..], &[0.0, 0.0]], // no diagonal
        &[&[0.0, 1.0], &[-1.0, 0.0]],    // and not symmetric
        &[&[-1.0, 2.0], &[2.0, -1.0]],   // indefinite
        &[&[1.0, 3.0], &[-2.0, 1.0]],
    ] {
        let lcp = contacts(a, &[1.0, 2.0]); // 0 ≤ w = b at x = 0
        for solver in all() {
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            assert_eq!(solution.status, Status::Solved, "{}: {a:?}", solver.name());
            assert_eq!(solution.x, [0.0, 0.0], "{}: {a:?}", solver.name());
        }
    }
}

#[test]
fn one_row_is_clamped_to_its_box() {
    // 2 (x − 3) on [lo, hi]: x = clamp(3, lo, hi), the cases of GAMS mcp09.
    for (lo, hi, x) in [
        (4.0, INF, 4.0),
        (-INF, 2.0, 2.0),
        (0.0, INF, 3.0),
        (4.0, 8.0, 4.0),
        (0.0, 2.0, 2.0),
        (4.0, 4.0, 4.0),
        (2.0, 2.0, 2.0),
        (-INF, INF, 3.0),
    ] {
        let lcp = boxed(&[&[2.0]], &[-6.0], &[lo], &[hi]);
        for solver in all() {
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            assert_eq!(solution.status, Status::Solved, "{} on [{lo}, {hi}]", solver.name());
            assert!(
                (solution.x[0] - x).abs() < 1e-7,
                "{} on [{lo}, {hi}]: {:?}",
                solver.name(),
                solution.x
            );
        }
    }
}

#[test]
fn a_problem_without_solution_is_never_called_solved() {
    // w = −1 whatever x is; and x1 + x2 must equal 1 and 2.
    let flat = contacts(&[&[0.0]], &[-1.0]);
    let torn = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -2.0], &[-INF; 2], &[INF; 2]);
    for lcp in [flat, torn] {
        for solver in all() {
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            assert_ne!(solution.status, Status::Solved, "{}", solver.name());
            assert!(solution.x.iter().all(|x| x.is_finite()), "{}", solver.name());
        }
    }
}

#[test]
fn a_box_on_a_slope_is_held_by_friction_below_the_cone_and_slides_above() {
    // One contact, unit mass: rows n, t. Weight (gn, gt) per step; held if gt ≤ μ gn.
    let slope = |gn: f64, gt: f64| {
        let lcp = boxed(&[&[1.0, 0.0], &[0.0, 1.0]], &[-gn, -gt], &[0.0, -INF], &[INF, INF]);
        lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap()).unwrap()
    };
    for solver in all() {
        let held = solver.solve(&slope(2.0, 0.9), &Start::default(), &mut ());
        let slides = solver.solve(&slope(2.0, 1.5), &Start::default(), &mut ());
        for (solution, x, w) in [(held, 0.9, 0.0), (slides, 1.0, -0.5)] {
            assert_eq!(solution.status, Status::Solved, "{}", solver.name());
            assert!((solution.x[1] - x).abs() < 1e-7 && (solution.w[1] - w).abs() < 1e-7);
        }
    }
}

#[test]
fn a_mass_ratio_of_1e12_is_no_ray() {
    let a: [&[f64]; 2] = [&[1.0, -1.0], &[-1.0, 1.0 + 1e-12]];
    let lcp = boxed(&a, &[-0.1635, 0.0], &[-INF; 2], &[INF; 2]);
    for solver in all() {
        let status = solver.solve(&lcp, &Start::default(), &mut ()).status;
        assert!(!matches!(status, Status::Ray { .. }), "{}: {status}", solver.name());
    }
}

/// Whether each row has nonzero terms at x*: if all vanish, the rounding of other rows is never
/// small relative to them, and a solver that cannot reach 0 reports that it failed.
fn is_measurable(m: &Manufactured) -> bool {
    (0..m.x.len()).all(|i| RowTerms::at(&m.lcp, i, &m.x).magnitude > 0.0)
}

#[test]
fn an_answer_beyond_the_largest_number_is_a_status_and_no_answer() {
    // x = −b/a = −1e600, and x₁ = 1e318 next to x₀ = 0: neither is a 64-bit number.
    let alone = boxed(&[&[-1e-300]], &[-1e300], &[-INF], &[INF]);
    let beside = contacts(&[&[1.0, 0.0], &[0.0, 1e-308]], &[0.0, -1e10]);
    for lcp in [alone, beside] {
        for solver in all() {
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            assert_ne!(solution.status, Status::Solved, "{}", solver.name());
            assert!(solution.x.iter().all(|x| x.is_finite()), "{}", solver.name());
        }
    }
}

/// Numbers of all sizes, from subnormal ones to the largest.
fn of_any_size() -> impl Strategy<Value = f64> {
    prop_oneof![
        2 => Just(0.0),
        3 => -2.0f64..2.0,
        6 => (-2.0f64..2.0, -310i32..308).prop_map(|(v, power)| v * 10f64.powi(power)),
    ]
}

/// A symmetric problem of three rows with such numbers, whose last row may be friction of the
/// first.
fn overflowing() -> impl Strategy<Value = Lcp> {
    let numbers = proptest::collection::vec(of_any_size(), 9);
    let bounds =
        proptest::sample::select(vec![(0.0, INF), (-INF, INF), (-1.0, 1.0), (-1.0, 1e308)]);
    (numbers, bounds, any::<bool>()).prop_map(|(v, (lo, hi), is_coupled)| {
        let a: [&[f64]; 3] = [&[v[0], v[1], v[2]], &[v[1], v[3], v[4]], &[v[2], v[4], v[5]]];
        if !is_coupled {
            return boxed(&a, &v[6..], &[lo; 3], &[hi; 3]);
        }
        let lcp = boxed(&a, &v[6..], &[0.0, lo, -INF], &[INF, hi, INF]);
        let friction = Coupling::new(vec![None, None, Some(0)], vec![0.0, 0.0, 0.5]);
        lcp.with_coupling(friction.unwrap()).unwrap()
    })
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn x_is_finite_whatever_overflows(lcp in overflowing()) {
        for solver in all() {
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            let is_finite = solution.x.iter().all(|x| x.is_finite());
            prop_assert!(is_finite, "{}: {} {:?}", solver.name(), solution.status, solution.x);
        }
    }
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn what_is_called_solved_is_never_refuted(m in manufactured(6, 4, 0.0)) {
        for solver in all() {
            let solution = solver.solve(&m.lcp, &Start::default(), &mut ());
            if solution.status == Status::Solved {
                let verdict = judge(&m.lcp, &solution.x, &Demand::default()).verdict;
                prop_assert!(verdict.is_solution(), "{}: {verdict}", solver.name());
            }
        }
    }

    #[test]
    fn all_find_the_one_solution_of_a_definite_problem(m in manufactured(6, 6, 1.0)) {
        prop_assume!(is_measurable(&m));
        for solver in all() {
            let solution = solver.solve(&m.lcp, &Start::default(), &mut ());
            prop_assert_eq!(&solution.status, &Status::Solved, "{}", solver.name());
            for (found, x) in solution.x.iter().zip(&m.x) {
                prop_assert!((found - x).abs() < 1e-5, "{}: {:?} for {:?}", solver.name(), solution.x, m.x);
            }
        }
    }

    #[test]
    fn a_singular_system_with_a_solution_is_no_ray(
        j in proptest::collection::vec(-1.0f64..1.0, 18),
        x in proptest::collection::vec(-1.0f64..1.0, 6),
    ) {
        let j = DMatrix::from_vec(6, 3, j);
        let a = Matrix::from((&j * j.transpose()).as_view());
        let b = (0..6).map(|i| -a.row_dot(i, &x)).collect();
        let lcp = Lcp::new(a, b, vec![-INF; 6], vec![INF; 6]).unwrap();
        for solver in all() {
            let status = solver.solve(&lcp, &Start::default(), &mut ()).status;
            // Lemke eliminates the equations first and takes their rounding for a contradiction,
            // which cannot be proved.
            let Status::Ray { row, direction } = &status else { continue };
            prop_assert!(solver.name() == "lemke", "{}: {status}", solver.name());
            prop_assert!(refute(&lcp, *row, direction).is_none());
        }
    }

    #[test]
    fn units_do_not_matter(m in manufactured(6, 6, 1.0), k in proptest::collection::vec(-9..=9i32, 7)) {
        // Powers of two, so that arithmetic is exact: b and w in another unit, each row in its own.
        let (lcp, unit): (_, Vec<f64>) = (&m.lcp, k.iter().map(|&k| 2f64.powi(k)).collect());
        let of_w = |v: &[f64]| (0..6).map(|i| v[i] * unit[i] * unit[6]).collect::<Vec<_>>();
        let of_x = |v: &[f64]| (0..6).map(|i| v[i] / unit[i] * unit[6]).collect::<Vec<_>>();
        let a: Vec<f64> = (0..36)
            .map(|k| lcp.matrix().entry(k / 6, k % 6) * unit[k / 6] * unit[k % 6])
            .collect();
        let scaled = Lcp::new(Matrix::dense(6, &a), of_w(lcp.b()), of_x(lcp.lo()), of_x(lcp.hi()));
        let scaled = scaled.unwrap();
        for solver in all() {
            let here = solver.solve(lcp, &Start::default(), &mut ());
            let there = solver.solve(&scaled, &Start::default(), &mut ());
            // Lemke's covering vector of ones, and pivots chosen by size, lead to another path in
            // other units; all others do the same arithmetic.
            if ["lemke", "murty", "block-pivoting", "enumeration"].contains(&solver.name()) {
                prop_assert_eq!(here.status, there.status, "{}", solver.name());
                continue;
            }
            prop_assert_eq!(there.x, of_x(&here.x), "{}", solver.name());
        }
    }

    #[test]
    fn a_start_at_the_solution_stays_there(m in manufactured(5, 5, 1.0)) {
        for solver in all() {
            let start = Start::at(&m.x);
            let solution = solver.solve(&m.lcp, &start, &mut ());
            prop_assert_eq!(&solution.x, &m.x, "{}", solver.name());
        }
    }

    #[test]
    fn dense_and_sparse_storage_give_the_same_answer(m in manufactured(5, 5, 1.0)) {
        prop_assume!(is_measurable(&m));
        let entries: Vec<_> = (0..25).map(|k| (k / 5, k % 5, m.lcp.matrix().entry(k / 5, k % 5)))
            .filter(|entry| entry.2 != 0.0).collect();
        let (b, lo, hi) = (m.lcp.b().to_vec(), m.lcp.lo().to_vec(), m.lcp.hi().to_vec());
        let sparse = Lcp::new(Matrix::sparse(5, &entries), b, lo, hi).unwrap();
        for solver in all() {
            let solution = solver.solve(&sparse, &Start::default(), &mut ());
            assert_certified(&m.lcp, &solution.x);
        }
    }
}

#[test]
fn an_iteration_limit_is_a_status_and_not_a_solution() {
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, -1.0]);
    for entry in Registry::standard().entries() {
        let settings = Settings::default().with_max_iterations(1).with_tolerance(0.0);
        let solver = entry.build(&Options::default().with_settings(settings));
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        let is_exact = solution.w == [0.0; 2]; // by a method that takes both rows at once
        let status = match &*entry.name {
            _ if is_exact => Status::Solved,
            // Each of the two rows is at its bound or free.
            "enumeration" => Status::SetsLeft { tried: 1, count: 4 },
            _ => Status::IterationLimit,
        };
        assert_eq!(solution.status, status, "{}", entry.name);
        assert_eq!(solution.iterations, 1, "{}", entry.name);
    }
}
