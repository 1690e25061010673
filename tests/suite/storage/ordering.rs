use lcplab::storage::{Graph, Ordering};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::cases;

/// The entries of L by elimination on a dense pattern, the textbook way.
fn eliminated(n: usize, pairs: &[(usize, usize)], order: &[usize]) -> Vec<(usize, usize)> {
    let mut pattern = DMatrix::from_element(n, n, false);
    let place = |row| order.iter().position(|&other| other == row).unwrap();
    for &(i, j) in pairs {
        let (i, j) = (place(i), place(j));
        (pattern[(i, j)], pattern[(j, i)]) = (true, true);
    }
    for k in 0..n {
        pattern[(k, k)] = true;
        for i in k + 1..n {
            for j in k + 1..n {
                pattern[(i, j)] |= pattern[(i, k)] && pattern[(k, j)];
            }
        }
    }
    let lower = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j)));
    lower.filter(|place| pattern[*place]).collect()
}

fn factor(graph: &Graph, order: &[usize]) -> Vec<(usize, usize)> {
    let mut places = Vec::new();
    graph.visit_factor(order, &mut |i, j| places.push((i, j)));
    places.sort_unstable();
    places
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn the_factor_is_that_of_plain_elimination_in_every_order(
        pairs in proptest::collection::vec((0..11usize, 0..11usize), 0..25),
    ) {
        let graph = Graph::of(11, pairs.iter().copied());
        for ordering in Ordering::ALL {
            let order = ordering.rows(&graph);
            let mut sorted = order.clone();
            sorted.sort_unstable();
            prop_assert_eq!(sorted, (0..11).collect::<Vec<_>>(), "{} is no order", ordering.name());
            prop_assert_eq!(factor(&graph, &order), eliminated(11, &pairs, &order));
        }
    }

    #[test]
    fn a_tree_has_an_order_without_fill_and_minimum_degree_finds_it(
        parents in proptest::collection::vec(0..1000usize, 1..30),
    ) {
        // Leaves first: Parter 1961.
        let edges = parents.iter().enumerate().map(|(k, parent)| (k + 1, parent % (k + 1)));
        let tree = Graph::of(parents.len() + 1, edges);
        let order = Ordering::MinimumDegree.rows(&tree);
        prop_assert_eq!(tree.factor_entries(&order), tree.lower_entries());
    }
}

#[test]
fn reverse_cuthill_mckee_finds_the_band_of_a_shuffled_chain() {
    let shuffled = |k: usize| k * 37 % 101;
    let chain = Graph::of(101, (1..101).map(|k| (shuffled(k - 1), shuffled(k))));
    let [natural, banded, _] = Ordering::ALL.map(|ordering| ordering.rows(&chain));
    assert!(chain.bandwidth(&natural) > 30);
    assert_eq!(chain.bandwidth(&banded), 1);
    assert_eq!(chain.factor_entries(&banded), 201); // no fill
}

#[test]
fn a_grid_keeps_its_band_under_rcm_and_fills_less_under_minimum_degree() {
    // k × k points by rows: behind the first row, of 2 entries each, every row of L is a full band.
    let k = 20;
    let at = |r: usize, c: usize| k * r + c;
    let edges = (0..k).flat_map(|r| {
        let across = (1..k).map(move |c| (at(r, c - 1), at(r, c)));
        across.chain((0..k).filter(move |_| r > 0).map(move |c| (at(r - 1, c), at(r, c))))
    });
    let grid = Graph::of(k * k, edges);
    let entries = |ordering: Ordering| grid.factor_entries(&ordering.rows(&grid));
    assert_eq!(grid.lower_entries(), k * k + 2 * k * (k - 1));
    assert_eq!(entries(Ordering::Natural), 2 * k - 1 + k * (k - 1) * (k + 1));
    assert!(entries(Ordering::ReverseCuthillMcKee) < entries(Ordering::Natural));
    assert!(entries(Ordering::MinimumDegree) < entries(Ordering::ReverseCuthillMcKee));
}
