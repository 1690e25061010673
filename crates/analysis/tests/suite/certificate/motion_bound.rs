use lcplab_judge::motion_bound::{Unproved, inconsistent_row, motion_bound};
use lcplab_lcp::{Gauss, Lcp, Matrix};
use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
use lcplab_mechanics::formulation::Problem;
use lcplab_mechanics::scene::{Scene, step_contacts};
use lcplab_solver::{Options, Registry, Start};
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// A table of 3 kg and inertias 2, 2 kg m² on side × side points falls at 1 m/s: it must stop.
fn table(side: usize) -> Gauss {
    let place = |k: usize| 0.1 * (k as f64 - (side - 1) as f64 / 2.0);
    let n = side * side;
    Gauss {
        mass: vec![(0, 0, 3.0), (1, 1, 2.0), (2, 2, 2.0)],
        jacobian: (0..n)
            .map(|k| vec![(0, 1.0), (1, place(k / side)), (2, -place(k % side))])
            .collect(),
        bias: vec![0.0; n],
        compliance: vec![0.0; n],
        target: vec![-1.0, 0.0, 0.0],
        lo: vec![0.0; n],
        hi: vec![INF; n],
        level: None,
    }
}

/// u* + M⁻¹Jᵀx for a diagonal M.
fn motion(gauss: &Gauss, x: &[f64]) -> Vec<f64> {
    let mut u = gauss.target.clone();
    for (row, x) in gauss.jacobian.iter().zip(x) {
        row.iter().for_each(|&(j, value)| u[j] += value * x / gauss.mass[j].2);
    }
    u
}

/// |u* + M⁻¹Jᵀx − u|_M for a diagonal M.
fn distance(gauss: &Gauss, x: &[f64], u: &[f64]) -> f64 {
    let motion = motion(gauss, x);
    let square = |&(j, _, m): &(usize, usize, f64)| m * (motion[j] - u[j]).powi(2);
    gauss.mass.iter().map(square).sum::<f64>().sqrt()
}

/// A of a motion with dense rows and a diagonal M, times a factor, with this b.
fn assembled(gauss: &Gauss, factor: f64, b: Vec<f64>) -> Lcp {
    let n = b.len();
    let entry = |i: usize, j: usize| {
        let products =
            |&(k, _, m): &(usize, usize, f64)| gauss.jacobian[i][k].1 * gauss.jacobian[j][k].1 / m;
        factor * gauss.mass.iter().map(products).sum::<f64>()
    };
    let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
    Lcp::new(Matrix::dense(n, &a), b, vec![0.0; n], vec![INF; n]).unwrap()
}

#[test]
fn a_and_b_of_other_bodies_are_told_from_those_of_the_masses_and_rows() {
    let gauss = table(2);
    let row = |factor: f64, speed: f64, x: &[f64]| {
        inconsistent_row(&gauss, &assembled(&gauss, factor, vec![-speed; 4]), x)
    };
    for x in [[0.0; 4], [0.75; 4], [3.0, 0.0, -7.0, 1e6]] {
        assert_eq!(row(1.0, 1.0, &x), None, "{x:?}");
        assert_eq!(row(1.0 + 1e-7, 1.0, &x), None, "{x:?}");
    }
    // At rest A x = 1 and J u = 0. b = −2 instead of −1 differs by 1, from terms of 1 + 2.
    let (_, difference) = row(1.0, 2.0, &[0.75; 4]).unwrap();
    assert!((difference - 1.0 / 3.0).abs() < 1e-12, "{difference}");
    // A of half the mass: A x = 2, so by 1 from terms of 2 + 1.
    let (_, difference) = row(2.0, 1.0, &[0.75; 4]).unwrap();
    assert!((difference - 1.0 / 3.0).abs() < 1e-12, "{difference}");
}

#[test]
fn rounding_errors_of_a_row_without_load_are_no_inconsistency() {
    let mut gauss = table(2);
    gauss.jacobian.push(vec![(0, 0.0), (1, 1.0), (2, 0.0)]);
    (gauss.bias, gauss.compliance) = (vec![0.0; 5], vec![0.0; 5]);
    (gauss.lo, gauss.hi) = (vec![0.0; 5], vec![INF; 5]);
    let lcp = assembled(&gauss, 1.0, vec![-1.0, -1.0, -1.0, -1.0, 1e-18]);
    assert_eq!(inconsistent_row(&gauss, &lcp, &[0.75, 0.75, 0.75, 0.75, 0.0]), None);
}

#[test]
fn a_redundant_table_has_a_sharp_bound_that_shrinks_with_the_error() {
    for side in [2, 3, 4, 10] {
        let (gauss, n) = (table(side), side * side);
        let mut last = INF;
        for decade in 1..=12 {
            let size = 10f64.powi(-decade);
            // The load is uneven too: A has rank 3, so a checkerboard of ± has no effect.
            let uneven =
                |k: usize| if (k / side + k % side).is_multiple_of(2) { 0.5 } else { -0.5 };
            let even = if side % 2 == 0 { 1.0 } else { 0.0 };
            let x: Vec<f64> = (0..n)
                .map(|k| 3.0 / n as f64 * (1.0 + even * uneven(k) + size * (k as f64).sin()))
                .collect();
            let (bound, exact) =
                (motion_bound(&gauss, &x).unwrap(), distance(&gauss, &x, &[0.0; 3]));
            let floor = 1e-12; // rounding: u is so small that a margin of its size costs nothing
            assert!(bound.energy_norm >= exact * (1.0 - 1e-12) - 1e-15, "{side} {decade}");
            assert!(
                bound.energy_norm <= exact * 1.000001 + floor,
                "{side} {decade} {bound:?} {exact}"
            );
            assert!(bound.energy_norm < last || bound.energy_norm < floor);
            last = bound.energy_norm;
        }
    }
}

#[test]
fn doing_nothing_is_as_far_off_as_the_motion_it_does_not_stop() {
    let bound = motion_bound(&table(2), &[0.0; 4]).unwrap();
    let missing = 3f64.sqrt(); // √(3 kg) · 1 m/s
    assert!((missing..1.001 * missing).contains(&bound.energy_norm), "{bound:?}");
    assert!(bound.largest_entry >= 1.0 && bound.largest_entry < 1.5, "{bound:?}");
}

#[test]
fn an_answer_beyond_its_bounds_is_as_far_off_as_its_own_motion() {
    // One mass m on a row with bounds: x* = Π(−m u*), û = u* + x*/m, and |u(x) − û|_M = |x − x*|/√m
    // for every x.
    for (mass, target, lo, hi) in
        [(1.0, 5.0, -1.0, 1.0), (4.0, -2.0, 0.0, 3.0), (0.25, 1.0, -2.0, 0.0)]
    {
        let gauss = Gauss {
            mass: vec![(0, 0, mass)],
            jacobian: vec![vec![(0, 1.0)]],
            bias: vec![0.0],
            compliance: vec![0.0],
            target: vec![target],
            lo: vec![lo],
            hi: vec![hi],
            level: None,
        };
        let solution = (-mass * target).clamp(lo, hi);
        for x in [-20.0, lo - 1e-6, lo, 0.5 * (lo + hi), hi, hi + 0.5, 1e9] {
            let exact = (x - solution).abs() / mass.sqrt();
            let inside = x.clamp(lo, hi);
            let bound = motion_bound(&gauss, &[x]).unwrap().energy_norm;
            let parts = (x - inside).abs() / mass.sqrt()
                + motion_bound(&gauss, &[inside]).unwrap().energy_norm;
            assert!(bound >= exact, "{bound} {exact}");
            assert!(bound <= parts * (1.0 + 1e-9), "{bound} {parts}");
        }
    }
}

#[test]
fn too_much_push_is_refuted_as_well() {
    // An excess of 3 N s lifts the table at 1 m/s.
    let bound = motion_bound(&table(3), &[6.0 / 9.0; 9]).unwrap();
    assert!(bound.energy_norm >= 3f64.sqrt() && bound.energy_norm < 1.001 * 3f64.sqrt());
}

#[test]
fn units_of_motion_and_impulses_do_not_loosen_the_bound() {
    // Each u_j in another unit, and each w_i and x_i: the kinetic energy is unchanged.
    let (plain, x) = (table(2), [0.75, 0.5, 1.0, 0.25]);
    let (motion, row) =
        ([20, 0, -20].map(|k| 2f64.powi(k)), [15, -15, 0, 10].map(|k| 2f64.powi(k)));
    let mut scaled = plain.clone();
    scaled.mass.iter_mut().for_each(|(j, _, m)| *m /= motion[*j] * motion[*j]);
    for (entries, unit) in scaled.jacobian.iter_mut().zip(row) {
        entries.iter_mut().for_each(|(j, value)| *value *= unit / motion[*j]);
    }
    scaled.target.iter_mut().zip(motion).for_each(|(u, unit)| *u *= unit);
    let in_units: Vec<f64> = x.iter().zip(row).map(|(x, unit)| x / unit).collect();
    let [plain, scaled] = [motion_bound(&plain, &x), motion_bound(&scaled, &in_units)]
        .map(|bound| bound.unwrap().energy_norm);
    assert!((scaled / plain - 1.0).abs() < 1e-6, "{scaled} for {plain}");
}

/// One unit mass on a line with these rows.
fn line(rows: &[(f64, f64, f64, f64)], target: f64) -> Gauss {
    Gauss {
        mass: vec![(0, 0, 1.0)],
        jacobian: rows.iter().map(|row| vec![(0, row.0)]).collect(),
        bias: rows.iter().map(|row| row.1).collect(),
        compliance: vec![0.0; rows.len()],
        target: vec![target],
        lo: rows.iter().map(|row| row.2).collect(),
        hi: rows.iter().map(|row| row.3).collect(),
        level: None,
    }
}

#[test]
fn a_pinched_body_is_proved_where_nothing_rounds_and_not_elsewhere() {
    let [exact, rounded] =
        [1.0, 0.1].map(|j| line(&[(j, 0.3 * j, 0.0, INF), (-j, -0.3 * j, 0.0, INF)], 0.7));
    let u = motion_bound(&exact, &[0.0, 1.0]).map(|bound| bound.motion);
    assert_eq!(u, Ok(vec![-0.3]));
    // 0.1 u + 0.03 is 0 for no floating-point u, and its opposite must not be negative either.
    let why = motion_bound(&rounded, &[0.0, 10.0]);
    assert!(matches!(why, Err(Unproved::NoRoom { .. })), "{why:?}");
}

#[test]
fn rows_that_contradict_each_other_have_no_motion_and_no_bound() {
    let apart = line(&[(1.0, -1.0, 0.0, INF), (-1.0, -1.0, 0.0, INF)], 0.0); // u ≥ 1 and u ≤ −1
    assert!(matches!(motion_bound(&apart, &[1.0, 1.0]), Err(Unproved::NoRoom { .. })));
    let twice = line(&[(0.1, 0.3, -INF, INF), (0.3, 0.9, -INF, INF)], 0.7);
    assert_eq!(motion_bound(&twice, &[0.0, 0.0]), Err(Unproved::DependentEquations));
}

#[test]
fn an_equation_costs_no_more_than_its_rounding() {
    // u = −3 is not an exact multiple of 0.1: it is proved to be near one.
    let held = line(&[(0.1, 0.3, -INF, INF)], 0.7);
    let bound = motion_bound(&held, &[-37.0]).unwrap();
    assert!(bound.energy_norm < 1e-13 && (bound.motion[0] + 3.0).abs() < 1e-14, "{bound:?}");
}

#[test]
fn bad_numbers_are_refused() {
    assert_eq!(motion_bound(&table(2), &[f64::NAN; 4]), Err(Unproved::NotFinite));
    let mut broken = table(2);
    broken.mass[1].2 = -1.0;
    assert_eq!(motion_bound(&broken, &[0.0; 4]), Err(Unproved::Mass));
}

#[test]
fn every_sweep_tightens_the_bound_of_a_stack() {
    let scene = Scene::load("stack").unwrap();
    let found = step_contacts(&scene, &scene.states);
    let assembly = Assembly::new(&scene, &scene.states, &found, ConstraintFilter::Near).unwrap();
    let problem = Problem::velocity(&scene, assembly).unwrap();
    let bound = |tolerance: f64| {
        let mut options = Options::default();
        options.settings.tolerance = tolerance;
        let solver = Registry::standard().entry("pgs").unwrap().build(&options);
        let x = solver.solve(&problem.lcp, &Start::default(), &mut ()).x;
        motion_bound(&problem.gauss(&x), &x).unwrap().largest_entry
    };
    let bounds = [1e-2, 1e-4, 1e-6, 1e-8].map(bound);
    assert!(bounds.windows(2).all(|b| b[1] < 0.2 * b[0]), "{bounds:?}");
    assert!(bounds[3] < 1e-6, "{bounds:?}"); // m/s
}

/// A problem with known motion.
#[derive(Debug, Clone)]
struct Known {
    gauss: Gauss,
    x: Vec<f64>,
    u: Vec<f64>,
}

/// More rows than columns and all kinds of bounds; quarters and powers of two, so all is exact.
fn known(kinds: std::ops::RangeInclusive<u8>) -> impl Strategy<Value = Known> {
    let quarter = |range: std::ops::RangeInclusive<i32>| range.prop_map(|k| f64::from(k) / 4.0);
    let row =
        (kinds, proptest::collection::vec(quarter(-4..=4), 3), quarter(1..=8), 0..3u8, 0..3u8);
    let rows = proptest::collection::vec(row, 7);
    (rows, proptest::collection::vec((0..3i32, quarter(-8..=8)), 3)).prop_map(|(rows, bodies)| {
        let mass: Vec<_> = bodies.iter().enumerate().map(|(j, b)| (j, j, 2f64.powi(b.0))).collect();
        let target: Vec<f64> = bodies.iter().map(|b| b.1).collect();
        let (mut x, mut w, mut u) = (vec![], vec![], target.clone());
        let mut gauss = Gauss { mass, target, ..Gauss::default() };
        for (kind, mut entries, size, state, soft) in rows {
            if kind > 0 {
                entries[0] = 1.0; // a common direction in which all contacts open
            }
            let (lo, hi) = [(-INF, INF), (0.0, INF), (0.0, INF), (-1.0, 1.0)][usize::from(kind)];
            let (xi, wi) = match (kind, state) {
                (0, _) => (size, 0.0),
                (1 | 2, 0) => (0.0, size),
                (1 | 2, _) => (size, 0.0),
                (_, 0) => (-1.0, size),
                (_, 1) => (1.0, -size),
                _ => (0.25, 0.0),
            };
            for j in 0..3 {
                u[j] += entries[j] * xi / gauss.mass[j].2;
            }
            gauss.jacobian.push(entries.into_iter().enumerate().collect());
            gauss.compliance.push(if soft == 0 { 0.5 } else { 0.0 });
            gauss.lo.push(lo);
            gauss.hi.push(hi);
            x.push(xi);
            w.push(wi);
        }
        gauss.bias = (0..7)
            .map(|i| {
                let ju: f64 = gauss.jacobian[i].iter().map(|&(j, value)| value * u[j]).sum();
                w[i] - ju - gauss.compliance[i] * x[i]
            })
            .collect();
        Known { gauss, x, u }
    })
}

fn moved(known: &Known, by: &[f64], size: f64) -> Vec<f64> {
    let x: Vec<f64> = known.x.iter().zip(by).map(|(x, by)| x + size * by).collect();
    within_bounds(&known.gauss, &x)
}

fn within_bounds(gauss: &Gauss, x: &[f64]) -> Vec<f64> {
    (0..x.len()).map(|i| x[i].clamp(gauss.lo[i], gauss.hi[i])).collect()
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn the_motion_is_never_farther_than_the_bound(
        known in known(0..=3), by in proptest::collection::vec(-1.0f64..1.0, 7), decade in 0..12i32,
    ) {
        let x = moved(&known, &by, 10f64.powi(-decade));
        if let Ok(bound) = motion_bound(&known.gauss, &x) {
            let exact = distance(&known.gauss, &x, &known.u);
            prop_assert!(bound.energy_norm >= exact * (1.0 - 1e-12) - 1e-14, "{bound:?} {exact}");
        }
    }

    #[test]
    fn nor_is_that_of_an_x_beyond_its_bounds(
        known in known(0..=3), by in proptest::collection::vec(-1.0f64..1.0, 7), decade in -2..6i32,
    ) {
        let size = 10f64.powi(-decade);
        let x: Vec<f64> = known.x.iter().zip(&by).map(|(x, by)| x + size * by).collect();
        if let Ok(bound) = motion_bound(&known.gauss, &x) {
            let exact = distance(&known.gauss, &x, &known.u);
            prop_assert!(bound.energy_norm >= exact * (1.0 - 1e-12) - 1e-14, "{bound:?} {exact}");
            // The part of x beyond the bounds costs only its own motion.
            let nearest = within_bounds(&known.gauss, &x);
            let within = motion_bound(&known.gauss, &nearest).unwrap().energy_norm;
            let beyond = distance(&known.gauss, &x, &motion(&known.gauss, &nearest));
            let sum = within + beyond;
            prop_assert!(bound.energy_norm <= sum * (1.0 + 1e-12) + 1e-12, "{bound:?} {sum}");
        }
    }

    #[test]
    fn contacts_that_can_open_together_always_have_a_bound_that_vanishes_with_the_error(
        known in known(1..=3), by in proptest::collection::vec(-1.0f64..1.0, 7), decade in 0..12i32,
    ) {
        let size = 10f64.powi(-decade);
        let bound = motion_bound(&known.gauss, &moved(&known, &by, size)).expect("a bound");
        // Second order if the active rows are identified correctly, of order √size at worst.
        prop_assert!(bound.energy_norm <= 40.0 * size.sqrt() + 1e-6, "{bound:?}");
        prop_assert!(motion_bound(&known.gauss, &known.x).unwrap().energy_norm < 1e-6);
    }
}

#[test]
fn why_there_is_no_bound_is_said() {
    for (reason, text) in [
        (Unproved::NotFinite, "numbers are not finite"),
        (Unproved::TooLarge, "too large"),
        (Unproved::Mass, "M is not verifiably definite"),
        (Unproved::DependentEquations, "equations depend on each other"),
        (Unproved::NoRoom { row: 2 }, "the rounding error of row 2 has no bound"),
    ] {
        assert_eq!(reason.to_string(), text);
    }
}
