//! Principal pivoting (Murty, block) and enumeration.

use dashu_ratio::RBig;
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Lcp, Matrix, library};
use lcplab_solver::{
    BlockPivoting, Enumeration, Event, Fallback, Murty, Settings, Solver, Start, Status,
    all_solutions,
};

use lcplab_testing::{INF, assert_proved, boxed, contacts, events};

#[test]
fn the_safeguard_takes_over_where_blocks_cycle_and_is_seen() {
    // A P-matrix on which exchanging all wrong rows cycles.
    let lcp =
        contacts(&[&[3.0, 0.0, -3.0], &[3.0, 1.0, -3.0], &[1.0, 3.0, 1.0]], &[2.0, 1.0, -1.0]);
    let (solution, events) = events(&BlockPivoting::default(), &lcp);
    assert_eq!(solution.status, Status::Solved);
    assert_proved(&lcp, &solution.x);
    assert!(events.iter().filter(|event| matches!(event, Event::Exchange { .. })).count() > 10);
    assert!(events.iter().any(|event| matches!(event, Event::Pivot { .. })));
    assert_eq!(solution.fallback, Some(Fallback::LeastIndex));
    let endless = BlockPivoting { patience: usize::MAX, ..BlockPivoting::default() };
    let status = endless.solve(&lcp, &Start::default(), &mut ()).status;
    assert_eq!(status, Status::IterationLimit);
}

#[test]
fn sweeps_pass_the_load_on_that_exchanges_pass_on_contact_by_contact() {
    // A column of n masses of 1 kg that fall at 1 m/s: contact k carries (n − k) N s. Only the
    // contact with the ground closes at first, and each exchange loads the next one (more than
    // ten that leave one row wrong would end in the safeguard).
    let n = 8;
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 if i == 0 => 1.0,
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
    let b = (0..n).map(|i| if i == 0 { -1.0 } else { 0.0 }).collect();
    let lcp = Lcp::new(Matrix::dense(n, &a), b, vec![0.0; n], vec![INF; n]).unwrap();
    let zero = vec![0.0; n];
    for (start, exchanges) in [(Start::at(&zero), n), (Start::default(), 0)] {
        let solution = BlockPivoting::default().solve(&lcp, &start, &mut ());
        assert_eq!((&solution.status, solution.iterations), (&Status::Solved, exchanges));
        let is_exact = |(k, x): (usize, &f64)| (x - (n - k) as f64).abs() < 1e-9;
        assert!(solution.x.iter().enumerate().all(is_exact), "{:?}", solution.x);
    }
}

#[test]
fn a_singular_block_of_a_symmetric_matrix_is_solved_by_proximal_steps() {
    // From x = (0, 0) both rows become free; their equations contradict each other. x = (0, 2).
    let lcp = contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -2.0]);
    let block = BlockPivoting::default().solve(&lcp, &Start::at(&[0.0, 0.0]), &mut ());
    assert_eq!((&block.status, block.fallback), (&Status::Solved, Some(Fallback::Proximal)));
    assert_proved(&lcp, &block.x);
}

#[test]
fn a_singular_block_of_another_matrix_is_named() {
    let lcp = contacts(&[&[1.0, 1.0], &[2.0, 2.0]], &[-1.0, -3.0]);
    let block = BlockPivoting::default().solve(&lcp, &Start::at(&[0.0, 0.0]), &mut ());
    assert_eq!(block.status, Status::Singular { row: 1 });
    assert_eq!(block.x, [0.0, 0.0]);
}

#[test]
fn a_zero_on_the_diagonal_is_outside_the_class() {
    let lcp = contacts(&[&[0.0, 1.0], &[-1.0, 0.0]], &[-1.0, 1.0]);
    for solver in [&Murty::default() as &dyn Solver, &BlockPivoting::default()] {
        let status = solver.solve(&lcp, &Start::default(), &mut ()).status;
        assert!(matches!(status, Status::OutsideClass { .. }), "{}: {status}", solver.name());
    }
}

#[test]
fn a_good_guess_of_the_active_set_saves_pivots() {
    let lcp = library::by_name("murty").unwrap().generate(&[("n", 8.0)]).unwrap().lcp;
    let mut guess = [0.0; 8];
    guess[7] = 0.9; // only row 8 is free
    let solution = Murty::default().solve(&lcp, &Start::at(&guess), &mut ());
    assert_eq!((solution.status, solution.iterations), (Status::Solved, 0));
    assert_eq!(solution.x[7], 1.0);
}

fn fractions(x: &[(i64, u64)]) -> Vec<RBig> {
    x.iter().map(|&(n, d)| RBig::from_parts(n.into(), d.into())).collect()
}

#[test]
fn enumeration_finds_solutions_that_no_regular_active_set_carries() {
    // w1 = x2 − 1, w2 = 0: every x with x2 = 1, or x1 = 0 and x2 ≥ 1. All sets with x2 free are
    // singular; the vertex is (0, 1).
    let lcp = contacts(&[&[0.0, 1.0], &[0.0, 0.0]], &[-1.0, 0.0]);
    assert_eq!(all_solutions(&lcp).unwrap(), [fractions(&[(0, 1), (1, 1)])]);
    // The same row twice, free: x1 + x2 = 1 has no vertex; the dependent x2 is 0.
    let line = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0; 2], &[-INF; 2], &[INF; 2]);
    assert_eq!(all_solutions(&line).unwrap(), [fractions(&[(1, 1), (0, 1)])]);
}

#[test]
fn enumeration_proves_that_there_is_none() {
    for name in ["pang-perturbed", "kostreva-2", "wedged"] {
        let lcp = library::by_name(name).unwrap().generate(&[]).unwrap().lcp;
        let solution = Enumeration::default().solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::NoSolution, "{name}");
    }
}

#[test]
fn too_many_active_sets_are_refused() {
    let lcp = library::by_name("murty").unwrap().generate(&[("n", 17.0)]).unwrap().lcp;
    let status = Enumeration::default().solve(&lcp, &Start::default(), &mut ()).status;
    assert!(matches!(status, Status::OutsideClass { .. }), "{status}");
    assert_eq!(all_solutions(&lcp), None);
}

/// tridiag(−1, 4, −1) with the rows in another order: neighbors are 4801 rows apart, so that the
/// envelope is nearly full. n has no common factor with 4801.
fn scattered_chain(n: usize) -> Matrix {
    let row = |k: usize| k * 4_801 % n;
    let mut entries = Vec::new();
    for k in 0..n {
        entries.push((row(k), row(k), 4.0));
        if k + 1 < n {
            entries.push((row(k), row(k + 1), -1.0));
            entries.push((row(k + 1), row(k), -1.0));
        }
    }
    Matrix::sparse(n, &entries)
}

#[test]
fn block_pivoting_solves_a_sparse_problem_of_ten_thousand_rows() {
    let n = 10_000;
    let a = scattered_chain(n);
    // x and w are chosen first: A is definite, so x is the only solution.
    let x: Vec<f64> = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { 1.0 + (i % 7) as f64 }).collect();
    let b = (0..n).map(|i| if i % 3 == 0 { 1.0 } else { 0.0 } - a.row_dot(i, &x));
    let lcp = Lcp::new(a.clone(), b.collect(), vec![0.0; n], vec![f64::INFINITY; n]).unwrap();
    let solution = BlockPivoting::default().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    let error = solution.x.iter().zip(&x).map(|(x, own)| (x - own).abs()).fold(0.0, f64::max);
    assert!(error < 1e-12, "{error:e}");

    let little = Settings::default().with_memory(Memory::bytes(100_000));
    let refused = BlockPivoting { settings: little, ..BlockPivoting::default() };
    let status = refused.solve(&lcp, &Start::default(), &mut ()).status;
    assert!(matches!(status, Status::TooLarge { .. }), "{status}");
}
