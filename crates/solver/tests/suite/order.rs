use lcplab_solver::theory::{ordered_iteration_matrix, spectral_radius};
use lcplab_solver::trace::Convergence;
use lcplab_solver::{Order, Pgs, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{assert_certified, cases, chain, contacts, manufactured};

const ORDERS: [Order; 5] =
    [Order::Natural, Order::Reverse, Order::Symmetric, Order::Shuffled { seed: 7 }, Order::Colored];

#[test]
fn a_chain_is_colored_red_and_black() {
    assert_eq!(Order::Colored.rows(&chain(7)), [0, 2, 4, 6, 1, 3, 5]);
}

#[test]
fn rows_of_a_color_do_not_touch() {
    let a: [&[f64]; 4] = [
        &[4.0, 0.0, 1.0, 0.0],
        &[0.0, 4.0, 1.0, 1.0],
        &[1.0, 1.0, 4.0, 0.0],
        &[0.0, 1.0, 0.0, 4.0],
    ];
    // 0 and 1 red; 2 is coupled with both, 3 with 1: both black.
    assert_eq!(Order::Colored.rows(&contacts(&a, &[0.0; 4])), [0, 1, 2, 3]);
}

#[test]
fn a_shuffled_order_is_a_permutation_that_its_seed_determines() {
    let rows = |seed| Order::Shuffled { seed }.rows(&chain(30));
    assert_eq!(rows(1), rows(1));
    assert_ne!(rows(1), rows(2));
    let mut sorted = rows(1);
    sorted.sort_unstable();
    assert_eq!(sorted, (0..30).collect::<Vec<_>>());
}

#[test]
fn errors_shrink_by_the_spectral_radius_in_every_order() {
    let lcp = chain(10);
    for order in ORDERS {
        for omega in [0.8, 1.0, 1.3] {
            let mut trace = Convergence::of(&lcp);
            Pgs { omega, order, ..Pgs::default() }.solve(&lcp, &Start::default(), &mut trace);
            let g = ordered_iteration_matrix(lcp.matrix(), omega, order.rows(&lcp));
            let (predicted, measured) = (spectral_radius(&g), trace.rate().unwrap());
            let what = format!("{order:?}, ω = {omega}: {measured} for {predicted}");
            assert!((measured - predicted).abs() < 5e-3, "{what}");
        }
    }
}

#[test]
fn natural_and_colored_order_of_a_chain_have_the_same_rate() {
    let lcp = chain(12);
    let radius = |order: Order| {
        spectral_radius(&ordered_iteration_matrix(lcp.matrix(), 1.2, order.rows(&lcp)))
    };
    assert!((radius(Order::Natural) - radius(Order::Colored)).abs() < 1e-10);
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_order_finds_the_solution(m in manufactured(6, 6, 1.0), omega in 0.5f64..1.5) {
        for order in ORDERS {
            let solver = Pgs { omega, order, ..Pgs::default() };
            let solution = solver.solve(&m.lcp, &Start::default(), &mut ());
            prop_assert_eq!(&solution.status, &Status::Solved, "{:?}", order);
            assert_certified(&m.lcp, &solution.x);
        }
    }
}
