//! The interior point on velocities, and by rows in another order: the same steps, eliminated
//! otherwise.

use lcplab::formulation::Problem;
use lcplab::lcp::{Lcp, Matrix, merit};
use lcplab::reference::{box_qp, velocity_qp_to};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::kernel::impulses::{Row, System, WIDTH};
use lcplab::solver::linalg::elimination::Lu;
use lcplab::solver::{InteriorPoint, Options, Registry, Settings, Solution, Solver, Start, Status};
use lcplab::storage::Factors;
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// The third step of a scene.
fn step(scene: Scene) -> Problem {
    let settings = Settings::default().with_max_iterations(30);
    let pgs = Registry::standard()
        .entry("pgs")
        .unwrap()
        .build(&Options::default().with_settings(settings));
    let mut simulation = Simulation::new(scene, pgs);
    let mut steps = (0..3).map(|_| simulation.step().unwrap());
    steps.next_back().unwrap().solves.remove(0).problem
}

fn generated(kind: &str) -> Problem {
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let text =
        format!("generate = {{ {kind} }}\n[contact]\nfriction = 0.5\nmargin = 0.01\n{ground}");
    step(Scene::from_toml("pile.toml", &text).unwrap())
}

fn tower(count: usize, ring: usize) -> Problem {
    let size = "size = 1, mass = 1";
    generated(&format!("kind = \"circular_tower\", count = {count}, ring = {ring}, {size}"))
}

/// Friction bounds as under an even load.
fn frozen(lcp: &Lcp) -> Lcp {
    lcp.frozen_at(&vec![0.01; lcp.len()])
}

fn to(tolerance: f64) -> InteriorPoint {
    InteriorPoint { settings: Settings::default().with_tolerance(tolerance) }
}

fn by_velocities(factors: &Factors, lcp: &Lcp, tolerance: f64) -> Solution {
    let rows = factors.scaled_rows();
    let system = System::new(factors.bodies(), &rows, lcp).unwrap();
    to(tolerance).solve_factored(lcp, &system, &Start::default(), &mut ())
}

/// w is the same for all solutions, whatever x.
#[track_caller]
fn assert_same_w(lcp: &Lcp, found: &Solution, expected: &[f64], part: f64) {
    assert_eq!(found.status, Status::Solved);
    let size = lcp.b().iter().fold(0.0, |size, b| f64::max(size, b.abs()));
    for (i, (w, expected)) in found.w.iter().zip(expected).enumerate() {
        assert!((w - expected).abs() <= part * size, "row {i}: w = {w} for {expected}");
    }
}

#[test]
fn a_pile_moves_by_velocities_as_by_rows_and_as_clarabel_says() {
    let stack = generated("kind = \"stack\", count = 6, size = 1, mass = 1");
    for problem in [stack, tower(36, 12)] {
        let (factors, lcp) = (Factors::of(&problem.assembly), frozen(&problem.lcp));
        let velocities = by_velocities(&factors, &lcp, 1e-11);
        let rows = to(1e-11).solve(&lcp, &Start::default(), &mut ());
        assert_same_w(&lcp, &velocities, &rows.w, 1e-9);
        let clarabel = lcp.w(&box_qp(&lcp).unwrap().point);
        assert_same_w(&lcp, &velocities, &clarabel, 1e-5);
    }
}

#[test]
fn clarabel_finds_the_same_w_with_a_in_factors() {
    let problem = tower(36, 12);
    let (factors, lcp) = (Factors::of(&problem.assembly), frozen(&problem.lcp));
    let mut entries = Vec::new();
    for (i, row) in factors.scaled_rows().iter().enumerate() {
        for (body, part) in row.bodies.iter().zip(&row.jacobian) {
            entries.extend(part.iter().enumerate().map(|(k, j)| (i, WIDTH * body + k, *j)));
        }
    }
    let reference = velocity_qp_to(&lcp, &entries, WIDTH * factors.bodies(), 1e-10).unwrap();
    assert!(reference.solved);
    assert_eq!(reference.point.len(), lcp.len());
    let velocities = by_velocities(&factors, &lcp, 1e-11);
    assert_same_w(&lcp, &velocities, &lcp.w(&reference.point), 1e-5);
    assert!(velocity_qp_to(&problem.lcp, &entries, WIDTH * factors.bodies(), 1e-8).is_none());
}

#[test]
fn friction_that_follows_the_normal_force_is_found() {
    let problem = generated("kind = \"stack\", count = 3, size = 1, mass = 1");
    let solution = by_velocities(&Factors::of(&problem.assembly), &problem.lcp, 1e-10);
    assert_eq!(solution.status, Status::Solved);
    assert!(merit::scaled_residual(&problem.lcp, &solution.x) <= 1e-10);
}

#[test]
fn a_net_is_solved_as_by_dense_elimination() {
    let hung = "generate = { kind = \"net\", rows = 8, columns = 8, spacing = 0.1, hang = 1, \
                mass = 0.01 }\n";
    let problem = step(Scene::from_toml("net.toml", hung).unwrap());
    let lcp = &problem.lcp;
    let mut expected: Vec<f64> = lcp.b().iter().map(|b| -b).collect();
    Lu::of(lcp.len(), |r, c| lcp.matrix().entry(r, c)).unwrap().solve(&mut expected);
    let size = expected.iter().fold(0.0, |size, x| f64::max(size, x.abs()));
    let rows = to(1e-11).solve(lcp, &Start::default(), &mut ());
    let velocities = by_velocities(&Factors::of(&problem.assembly), lcp, 1e-11);
    for solution in [rows, velocities] {
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.iterations <= 3, "{}", solution.iterations);
        for (x, expected) in solution.x.iter().zip(&expected) {
            assert!((x - expected).abs() <= 1e-8 * size, "{x} for {expected}");
        }
    }
}

/// 200 points in a row, numbered so that neighbors are far apart: an envelope would be half of n².
fn scattered(lo: f64, hi: f64) -> (Lcp, Vec<f64>) {
    let n = 200;
    let place = |i: usize| 67 * i % n;
    let mut entries: Vec<_> = (0..n).map(|i| (i, i, 2.5)).collect();
    for (i, j) in (1..n).map(|i| (place(i - 1), place(i))) {
        entries.extend([(i, j, -1.0), (j, i, -1.0)]);
    }
    let matrix = Matrix::sparse(n, &entries);
    let x: Vec<f64> = (0..n).map(|i| f64::from(i as u32 % 5) - 2.0).collect();
    let w = |x: f64| if x == lo { 0.5 } else { 0.0 }; // a lower bound that holds pushes back
    let b = (0..n).map(|i| w(x[i]) - matrix.row_dot(i, &x)).collect();
    (Lcp::new(matrix, b, vec![lo; n], vec![hi; n]).unwrap(), x)
}

#[test]
fn rows_that_reach_far_are_reordered_and_the_known_solution_is_found() {
    for (lo, hi) in [(-INF, INF), (-2.0, INF), (-2.0, 5.0)] {
        let (lcp, expected) = scattered(lo, hi);
        let solution = to(1e-11).solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        for (x, expected) in solution.x.iter().zip(&expected) {
            assert!((x - expected).abs() < 1e-9, "{x} for {expected}");
        }
    }
}

#[test]
fn a_pinned_row_stays_where_it_is_in_every_form() {
    let (lcp, expected) = scattered(-INF, INF);
    let pinned = |i: usize| i.is_multiple_of(3);
    let x = &expected;
    let bound = |open: f64| (0..lcp.len()).map(move |i| if pinned(i) { x[i] } else { open });
    let (lo, hi) = (bound(-INF).collect(), bound(INF).collect());
    let lcp = Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), lo, hi).unwrap();
    let solution = to(1e-11).solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    for (i, (x, expected)) in solution.x.iter().zip(&expected).enumerate() {
        assert!(if pinned(i) { x == expected } else { (x - expected).abs() < 1e-9 });
    }
}

#[test]
fn the_iterations_of_a_tower_hardly_depend_on_its_height() {
    for rings in [1, 3, 6] {
        let problem = tower(12 * rings, 12);
        let lcp = frozen(&problem.lcp);
        let solution = by_velocities(&Factors::of(&problem.assembly), &lcp, 1e-7);
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.iterations <= 30, "{rings} rings: {}", solution.iterations);
    }
}

#[test]
fn a_start_that_is_a_solution_is_returned() {
    let problem = tower(24, 12);
    let (factors, lcp) = (Factors::of(&problem.assembly), frozen(&problem.lcp));
    let solution = by_velocities(&factors, &lcp, 1e-9);
    let rows = factors.scaled_rows();
    let system = System::new(factors.bodies(), &rows, &lcp).unwrap();
    let start = Start { x: Some(&solution.x), ..Start::default() };
    let again = to(1e-9).solve_factored(&lcp, &system, &start, &mut ());
    assert_eq!((again.status, again.iterations), (Status::Solved, 0));
    assert_eq!(again.x, solution.x);
}

#[test]
fn factors_of_another_matrix_are_refused() {
    let problem = generated("kind = \"stack\", count = 2, size = 1, mass = 1");
    let lcp = frozen(&problem.lcp);
    let entries =
        (0..lcp.len()).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let softer = entries.chain((0..lcp.len()).map(|i| (i, i, 1e-3))).collect::<Vec<_>>();
    let softer = Matrix::sparse(lcp.len(), &softer);
    let softer = Lcp::new(softer, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec()).unwrap();
    let solution = by_velocities(&Factors::of(&problem.assembly), &softer, 1e-8);
    assert!(matches!(solution.status, Status::OutsideClass { .. }), "{}", solution.status);
}

#[test]
fn what_would_take_too_much_memory_is_refused_in_both_forms() {
    let problem = tower(24, 12);
    let (factors, lcp) = (Factors::of(&problem.assembly), frozen(&problem.lcp));
    let rows = factors.scaled_rows();
    let system = System::new(factors.bodies(), &rows, &lcp).unwrap();
    let memory = lcplab::memory::Memory::bytes(1000);
    let short = InteriorPoint { settings: Settings::default().with_memory(memory) };
    let by_rows = short.solve(&lcp, &Start::default(), &mut ());
    let by_velocities = short.solve_factored(&lcp, &system, &Start::default(), &mut ());
    for solution in [by_rows, by_velocities] {
        assert!(matches!(solution.status, Status::TooLarge { .. }), "{}", solution.status);
    }
}

/// D = 10⁻⁸ a_ii moves x by that part, and costs the elimination digits worth 2⁻⁵³/10⁻⁸, as much
/// again.
#[test]
fn a_single_step_meets_equations_to_seven_digits() {
    let entry = |i: usize| 0.7 + 0.1 * i as f64;
    let row = |i| Row { bodies: [i; 2], jacobian: [[entry(i); WIDTH], [0.0; WIDTH]] };
    let rows: Vec<Row> = (0..20).map(row).collect();
    let diagonal: Vec<f64> = (0..20).map(|i| 6.0 * entry(i) * entry(i)).collect();
    let entries: Vec<_> = diagonal.iter().enumerate().map(|(i, a)| (i, i, *a)).collect();
    let free = |bound| vec![bound; 20];
    let lcp =
        Lcp::new(Matrix::sparse(20, &entries), vec![-0.9; 20], free(-INF), free(INF)).unwrap();
    let system = System::new(20, &rows, &lcp).unwrap();
    let settings = Settings::default().with_max_iterations(1);
    let one_step = InteriorPoint { settings };
    let solution = one_step.solve_factored(&lcp, &system, &Start::default(), &mut ());
    for (x, a) in solution.x.iter().zip(&diagonal) {
        assert!((a * x / 0.9 - 1.0).abs() <= 1e-7, "{x} for {}", 0.9 / a);
    }
}

/// Rows between random bodies, A = Ĵ Ĵᵀ, and x*, w* chosen first; entries are quarters, so A is
/// exact.
fn manufactured(bodies: usize, n: usize) -> impl Strategy<Value = (Vec<Row>, Lcp, Vec<f64>)> {
    let quarter = |range: std::ops::RangeInclusive<i32>| range.prop_map(|k| f64::from(k) / 4.0);
    let jacobian = proptest::array::uniform12(quarter(-4..=4));
    let row = (0..bodies, 0..bodies, jacobian, 0..4u8, quarter(0..=8), quarter(-8..=8));
    proptest::collection::vec(row, n).prop_map(move |drawn| {
        let (mut rows, mut columns) = (Vec::new(), Vec::new());
        let (mut lo, mut hi, mut x, mut w) = (vec![], vec![], vec![], vec![]);
        for (p, q, entries, kind, slack, at) in drawn {
            let (mut jacobian, mut column) = ([[0.0; WIDTH]; 2], vec![0.0; WIDTH * bodies]);
            for (k, entry) in entries.into_iter().enumerate().filter(|(k, _)| p != q || *k < WIDTH)
            {
                jacobian[k / WIDTH][k % WIDTH] = entry;
                column[WIDTH * [p, q][k / WIDTH] + k % WIDTH] = entry;
            }
            jacobian[0][0] += 1.5; // no row of zeros
            column[WIDTH * p] += 1.5;
            rows.push(Row { bodies: [p, q], jacobian });
            columns.push(column);
            let (l, h, x_i, w_i) = match kind {
                0 => (-INF, INF, at, 0.0),
                1 => (at, INF, at, slack),
                2 => (at - 1.0, at + 1.0, at, 0.0),
                _ => (at, at, at, slack),
            };
            lo.push(l);
            hi.push(h);
            x.push(x_i);
            w.push(w_i);
        }
        let inner = |p: &[f64], q: &[f64]| p.iter().zip(q).map(|(p, q)| p * q).sum::<f64>();
        let a: Vec<f64> =
            columns.iter().flat_map(|p| columns.iter().map(move |q| inner(p, q))).collect();
        let matrix = Matrix::dense(n, &a);
        let b = (0..n).map(|i| w[i] - matrix.row_dot(i, &x)).collect();
        (rows, Lcp::new(matrix, b, lo, hi).unwrap(), w)
    })
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn any_rows_between_any_bodies_get_the_known_w((rows, lcp, w) in manufactured(4, 14)) {
        let system = System::new(4, &rows, &lcp).unwrap();
        let solution = to(1e-9).solve_factored(&lcp, &system, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved);
        for (found, expected) in solution.w.iter().zip(&w) {
            prop_assert!((found - expected).abs() <= 1e-5, "{} for {}", found, expected);
        }
    }
}
