use lcplab::formulation::Problem;
use lcplab::lcp::{Coupling, Lcp, Matrix};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{Row, RowByRow, SimdPairs, System};
use lcplab::solver::{Options, Settings};
use lcplab::solver::{Registry, Status};
use lcplab::storage::scaled_rows;

use lcplab_testing::INF;
use lcplab_testing::{assert_close, plain, reordered};

const SWEEPS: usize = 20;

/// The LCP of a step, with what it is made of; friction rows follow their normals.
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

/// Three rings of twelve cubes, each on two others.
fn tower() -> Problem {
    generated("kind = \"circular_tower\", count = 36, ring = 12, size = 1, mass = 1")
}

fn stack() -> Problem {
    generated("kind = \"stack\", count = 6, size = 1, mass = 1")
}

/// A problem with friction that follows the normal force and with frozen friction.
fn cases(problem: &Problem) -> [Lcp; 2] {
    let lcp = &problem.lcp;
    let load: Vec<f64> = (0..lcp.len()).map(|i| 0.01 * (1 + i % 5) as f64).collect();
    [lcp.clone(), lcp.frozen_at(&load)]
}

/// The LCP of a problem, with the rows of Ĵ.
fn system(problem: &Problem, lcp: &Lcp) -> System {
    System::new(problem.assembly.blocks.len(), &scaled_rows(&problem.assembly), lcp).unwrap()
}

/// What a kernel has after some sweeps.
fn swept<K>(mut kernel: K, sweep: impl Fn(&mut K), x: impl Fn(&K) -> Vec<f64>) -> Vec<f64> {
    (0..SWEEPS).for_each(|_| sweep(&mut kernel));
    x(&kernel)
}

#[test]
fn the_scaled_rows_make_a() {
    for problem in [tower(), stack(), step(Scene::load("ragdoll").unwrap())] {
        let rows = scaled_rows(&problem.assembly);
        let dense = |row: &Row| {
            let mut j = vec![0.0; problem.assembly.blocks.len() * 6];
            for (body, part) in row.bodies.iter().zip(&row.jacobian) {
                part.iter().enumerate().for_each(|(k, value)| j[6 * body + k] += value);
            }
            j
        };
        let j: Vec<Vec<f64>> = rows.iter().map(dense).collect();
        for i in 0..rows.len() {
            let own: Vec<usize> = (0..j[i].len()).filter(|&q| j[i][q] != 0.0).collect();
            for k in 0..rows.len() {
                let a: f64 = own.iter().map(|&q| j[i][q] * j[k][q]).sum();
                let expected = problem.lcp.matrix().entry(i, k);
                let size = problem.lcp.matrix().diagonal(i).max(1e-3);
                assert!((a - expected).abs() < 1e-12 * size, "{i} {k}: {a} for {expected}");
            }
        }
    }
}

#[test]
fn row_by_row_sweeps_as_the_assembled_matrix_does() {
    for problem in [tower(), stack()] {
        for lcp in cases(&problem) {
            let system = system(&problem, &lcp);
            let expected = plain(&lcp, 1.0, SWEEPS);
            let x = swept(RowByRow::new(&system), |k| k.sweep(&system), |k| k.x().to_vec());
            assert_close(&x, &expected, 1e-12);
        }
    }
}

#[test]
fn eight_pairs_sweep_as_the_assembled_matrix_does_in_their_order() {
    for problem in [tower(), stack()] {
        for lcp in cases(&problem) {
            let system = system(&problem, &lcp);
            let kernel = SimdPairs::new(&system, Width::widest()).unwrap();
            let order = kernel.order();
            let expected = plain(&reordered(&lcp, &order), 1.0, SWEEPS);
            let x = swept(kernel, SimdPairs::sweep, SimdPairs::x);
            let found: Vec<f64> = order.iter().map(|&i| x[i]).collect();
            assert_close(&found, &expected, 1e-12);
        }
    }
}

#[test]
fn all_of_a_tower_of_equal_pairs_is_swept_in_every_order() {
    let problem = tower();
    let rows = scaled_rows(&problem.assembly);
    let system = system(&problem, &problem.lcp);
    let mut order = SimdPairs::new(&system, Width::Portable).unwrap().order();
    assert_ne!(order, (0..rows.len()).collect::<Vec<_>>());
    order.sort_unstable();
    assert_eq!(order, (0..rows.len()).collect::<Vec<_>>());
}

/// The layer of each row of a tower in the order of a sweep, 0 at the ground, above it that of its
/// lower body; the bodies have other numbers in the system.
fn layers(problem: &Problem, renumbered: impl Fn(usize) -> usize) -> Vec<usize> {
    let rows = scaled_rows(&problem.assembly);
    let other: Vec<Row> = rows
        .iter()
        .map(|row| Row { bodies: row.bodies.map(&renumbered), jacobian: row.jacobian })
        .collect();
    let system = System::new(problem.assembly.blocks.len(), &other, &problem.lcp).unwrap();
    let order = SimdPairs::new(&system, Width::widest()).unwrap().order();
    let ring = 12;
    let layer = |row: &Row| match row.bodies {
        [p, q] if p == q => 0,
        [p, q] => p.min(q) / ring,
    };
    order.iter().map(|&i| layer(&rows[i])).collect()
}

/// So a sweep carries what moves at the ground to the top.
#[test]
fn a_tower_is_swept_from_the_ground_up_whatever_its_bodies_numbers() {
    let tower = tower();
    for renumbered in [|body| body, |body| 35 - body, |body| 7 * body % 36] {
        let layers = layers(&tower, renumbered);
        assert!(layers.is_sorted(), "{layers:?}");
        assert_eq!(layers.last(), Some(&2));
    }
}

/// Cubes one on another: by layers every octet would hold one pair, by colors it holds up to
/// eight.
#[test]
fn a_lone_stack_is_swept_by_colors() {
    let problem = stack();
    let rows = scaled_rows(&problem.assembly);
    let system = system(&problem, &problem.lcp);
    let order = SimdPairs::new(&system, Width::widest()).unwrap().order();
    let color =
        |row: &Row| if row.bodies[0] == row.bodies[1] { 0 } else { (row.bodies[0] + 1) % 2 };
    let colors: Vec<usize> = order.iter().map(|&i| color(&rows[i])).collect();
    assert!(colors.is_sorted(), "{colors:?}");
}

#[test]
fn the_bits_are_the_same_with_all_instructions() {
    let problem = tower();
    for lcp in cases(&problem) {
        let system = system(&problem, &lcp);
        let run = |width| {
            let eight = SimdPairs::new(&system, width).unwrap();
            swept(eight, SimdPairs::sweep, SimdPairs::x)
        };
        let portable = run(Width::Portable);
        for width in Width::available() {
            assert_eq!(run(width), portable, "{width:?}");
        }
    }
}

#[test]
fn rows_between_other_bodies_cannot_bound_a_pair() {
    // Row 1 slides on body 1, bounded by what presses on body 0.
    let row =
        |body| Row { bodies: [body; 2], jacobian: [[1.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]] };
    let rows = [row(0), row(1)];
    let identity = Matrix::sparse(2, &[(0, 0, 1.0), (1, 1, 1.0)]);
    let lcp = Lcp::new(identity, vec![-2.0, -3.0], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap();
    let system = System::new(2, &rows, &lcp).unwrap();
    let refused = SimdPairs::new(&system, Width::widest()).unwrap_err();
    assert!(matches!(refused, Status::OutsideClass { .. }), "{refused}");
    let mut by_rows = RowByRow::new(&system);
    by_rows.sweep(&system);
    assert_eq!(by_rows.x(), [2.0, 1.0]); // 1 = μ · 2
}

#[test]
fn a_row_of_zeros_is_refused() {
    let rows = [Row { bodies: [0; 2], jacobian: [[0.0; 6]; 2] }];
    let zero = Matrix::sparse(1, &[]);
    let lcp = Lcp::new(zero, vec![-1.0], vec![0.0], vec![INF]).unwrap();
    assert_eq!(System::new(1, &rows, &lcp).unwrap_err(), Status::ZeroDiagonal { row: 0 });
}

/// A crowd of bodies that all touch the first: more colors than a word has bits, pairs of all
/// lengths.
fn star(pairs: usize) -> (usize, Vec<Row>, Lcp) {
    let mut rows = Vec::new();
    for pair in 1..=pairs {
        for r in 0..1 + pair % 5 {
            let entry = |k: usize| 1.0 + ((7 * pair + 3 * r + 5 * k) % 11) as f64 / 10.0;
            let part = |side: usize| std::array::from_fn(|k| entry(6 * side + k));
            rows.push(Row { bodies: [0, pair], jacobian: [part(0), part(1)] });
        }
    }
    let n = rows.len();
    let b = (0..n).map(|i| -1.0 + 0.3 * (i % 7) as f64).collect();
    let lcp = Lcp::new(Matrix::sparse(n, &[]), b, vec![0.0; n], vec![INF; n]).unwrap();
    (1 + pairs, rows, lcp)
}

/// All pairs share a body: every color has one pair, and the order is theirs.
#[test]
fn a_body_may_have_more_neighbors_than_a_word_has_bits() {
    let (bodies, rows, lcp) = star(150);
    let system = System::new(bodies, &rows, &lcp).unwrap();
    let kernel = SimdPairs::new(&system, Width::widest()).unwrap();
    assert_eq!(kernel.order(), (0..rows.len()).collect::<Vec<_>>());
    let x = swept(kernel, SimdPairs::sweep, SimdPairs::x);
    let plain = swept(RowByRow::new(&system), |k| k.sweep(&system), |k| k.x().to_vec());
    assert_close(&x, &plain, 1e-12);
}

#[test]
fn the_bits_are_the_same_on_any_number_of_threads() {
    let problem = tower();
    for lcp in cases(&problem) {
        let system = system(&problem, &lcp);
        let run = |threads| {
            let mut kernel = SimdPairs::on_threads(&system, Width::widest(), threads).unwrap();
            assert_eq!(kernel.threads(), threads);
            kernel.sweeps(SWEEPS);
            kernel.x()
        };
        let alone = run(1);
        for threads in 2..=4 {
            assert_eq!(run(threads), alone, "{threads} threads");
        }
    }
}

/// v − Ĵᵀx stays what it was, so that a step's velocities need no x.
#[test]
fn the_velocities_are_those_that_x_makes() {
    let problem = tower();
    let rows = scaled_rows(&problem.assembly);
    let system = system(&problem, &problem.lcp);
    let start: Vec<f64> = (0..rows.len()).map(|i| 0.01 * (i % 3) as f64).collect();
    let bodies = problem.assembly.blocks.len();
    let free: Vec<[f64; 6]> =
        (0..bodies).map(|b| std::array::from_fn(|k| (b * k % 5) as f64)).collect();
    let mut eight = SimdPairs::idle(Width::widest(), 2);
    eight.start(&system, &start, &free).unwrap();
    eight.sweeps(SWEEPS);
    let mut v = free.clone();
    eight.write_v(&mut v);
    let mut expected = free;
    system.push_velocities(&eight.x(), &mut expected);
    assert_close(v.as_flattened(), expected.as_flattened(), 1e-12);
}

/// Systems one after the other in the same memory: with other rows, with other pairs, with fewer
/// bodies.
#[test]
fn a_kernel_that_is_started_again_sweeps_as_a_new_one() {
    let mut kept = SimdPairs::idle(Width::widest(), 2);
    for problem in [tower(), tower(), stack(), tower()] {
        let rows = scaled_rows(&problem.assembly);
        let system = system(&problem, &problem.lcp);
        let (x, v) = (vec![0.0; rows.len()], vec![[0.0; 6]; problem.assembly.blocks.len()]);
        kept.start(&system, &x, &v).unwrap();
        kept.sweeps(SWEEPS);
        let new = SimdPairs::new(&system, Width::widest()).unwrap();
        assert_eq!(kept.x(), swept(new, SimdPairs::sweep, SimdPairs::x));
    }
}

#[test]
fn a_start_at_an_x_is_at_the_velocities_that_x_adds() {
    let problem = stack();
    let (lcp, bodies) = (&problem.lcp, problem.assembly.blocks.len());
    let rows = scaled_rows(&problem.assembly);
    let system = System::new(bodies, &rows, lcp).unwrap();
    let mut whole = RowByRow::new(&system);
    (0..SWEEPS).for_each(|_| whole.sweep(&system));
    let x = whole.x().to_vec();
    let mut again = RowByRow::default();
    again.start(&system, &x, &vec![[0.0; 6]; bodies]);
    assert_eq!(again.x(), x);
    // w = A x + b = Ĵ v + b
    for (i, row) in rows.iter().enumerate() {
        let size: f64 = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs()).sum();
        let w = row.rate(again.v()) + system.aims()[i].b;
        assert!((w - lcp.row_w(i, &x)).abs() <= 1e-14 * size, "row {i}");
        assert!((row.rate(whole.v()) - row.rate(again.v())).abs() <= 1e-13 * size, "row {i}");
    }
}

#[test]
fn another_aim_moves_the_solution_and_not_the_rows() {
    // One row of one body: x = −b / a_ii with a_ii = 4, clamped.
    let row = Row { bodies: [0, 0], jacobian: [[2.0, 0.0, 0.0, 0.0, 0.0, 0.0], [0.0; 6]] };
    let lcp = Lcp::new(Matrix::dense(1, &[4.0]), vec![-8.0], vec![0.0], vec![INF]).unwrap();
    let mut system = System::new(1, &[row], &lcp).unwrap();
    let solved = |system: &System| {
        let mut kernel = RowByRow::new(system);
        kernel.sweep(system);
        (kernel.x()[0], kernel.v()[0][0])
    };
    assert_eq!(solved(&system), (2.0, 4.0));
    system.aims_mut()[0].hi = 1.5;
    assert_eq!(solved(&system), (1.5, 3.0));
    system.aims_mut()[0].b = 8.0;
    assert_eq!(solved(&system), (0.0, 0.0));
}
