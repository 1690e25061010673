use lcplab_lcp::{Coupling, Lcp};
use lcplab_solver::{BlockPgs, Pgs, Settings, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, assert_proved, boxed, cases, iterates, manufactured, objectives, stack};

fn blocks_of(rows_per_block: usize) -> BlockPgs {
    BlockPgs { rows_per_block, settings: Settings::default() }
}

/// One contact: a normal row and two coupled friction rows.
fn contact() -> Lcp {
    let a: [&[f64]; 3] = [&[2.0, 0.5, 0.25], &[0.5, 1.5, 0.5], &[0.25, 0.5, 1.0]];
    let lcp = boxed(&a, &[-2.0, -3.0, 0.25], &[0.0, -INF, -INF], &[INF; 3]);
    let coupling = Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5]).unwrap();
    lcp.with_coupling(coupling).unwrap()
}

#[test]
fn a_contact_with_its_friction_takes_one_sweep() {
    let solution = BlockPgs::default().solve(&contact(), &Start::default(), &mut ());
    assert_eq!((&solution.status, solution.iterations), (&Status::Solved, 1));
    assert_proved(&contact(), &solution.x);
    assert!(Pgs::default().solve(&contact(), &Start::default(), &mut ()).iterations > 1);
}

#[test]
fn one_block_is_the_whole_problem() {
    let solution = blocks_of(8).solve(&stack(8), &Start::default(), &mut ());
    assert_eq!((solution.status, solution.iterations), (Status::Solved, 1));
}

#[test]
fn blocks_of_one_row_are_gauss_seidel() {
    let (blocks, rows) = (iterates(&blocks_of(1), &stack(4)), iterates(&Pgs::default(), &stack(4)));
    for (x, y) in blocks.iter().zip(&rows).take(50) {
        assert!(x.iter().zip(y).all(|(x, y)| (x - y).abs() < 1e-13), "{x:?} {y:?}");
    }
}

#[test]
fn larger_blocks_need_fewer_sweeps_on_a_stack() {
    let sweeps = |k| blocks_of(k).solve(&stack(24), &Start::default(), &mut ()).iterations;
    assert!(sweeps(1) > sweeps(2) && sweeps(2) > sweeps(4) && sweeps(4) > sweeps(8));
}

#[test]
fn a_block_without_solution_gives_a_ray_of_the_whole() {
    let a: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0, 1.0, 1.0], &[0.0, 1.0, 1.0]];
    let lcp = boxed(&a, &[-1.0, -1.0, -2.0], &[-INF; 3], &[INF; 3]);
    let Status::Ray { direction, .. } = blocks_of(3).solve(&lcp, &Start::default(), &mut ()).status
    else {
        panic!("there is no solution")
    };
    assert_eq!((direction[0], direction[1] + direction[2]), (0.0, 0.0));
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn no_block_raises_the_objective(m in manufactured(7, 5, 0.5), k in 1usize..4) {
        for pair in objectives(&blocks_of(k), &m.lcp).windows(2) {
            prop_assert!(pair[1] <= pair[0] + 1e-12 * (1.0 + pair[0].abs()), "{pair:?}");
        }
    }
}
