use lcplab::storage::{LinkedList, Storage, Tree};

/// Numbers 0..n in a random order (a linear congruential generator and Fisher-Yates).
fn shuffled(n: usize, seed: u64) -> Vec<usize> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut order: Vec<usize> = (0..n).collect();
    for last in (1..n).rev() {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        order.swap(last, (state >> 33) as usize % (last + 1));
    }
    order
}

fn tree(order: &[usize]) -> Tree {
    let mut tree = Tree::new(order.len(), order.len());
    order.iter().for_each(|&i| tree.set(i, i, 1.0).unwrap());
    tree
}

#[test]
fn a_tree_filled_in_order_is_a_list_and_a_shuffled_one_is_not() {
    // E58: 3000 entries, depth 3000 in order and about 27 shuffled. Theory (Reed 2003, Devroye 1986):
    // the mean depth is 4.311 ln n − 1.953 ln ln n + O(1), 30.5 + O(1) here.
    let sorted: Vec<usize> = (0..3000).collect();
    assert_eq!(tree(&sorted).depth(), 3000);
    let depths: Vec<usize> = (0..30).map(|seed| tree(&shuffled(3000, seed)).depth()).collect();
    let mean = depths.iter().sum::<usize>() as f64 / 30.0;
    assert!((25.0..30.0).contains(&mean), "{mean}");
    assert!(depths.iter().all(|depth| (21..40).contains(depth)), "{depths:?}");
}

#[test]
fn a_tree_that_is_loaded_is_as_shallow_as_can_be() {
    for (n, depth) in [(0, 0), (1, 1), (2, 2), (3, 2), (4, 3), (1023, 10), (1024, 11), (3000, 12)] {
        let mut tree = Tree::new(n, n);
        tree.load(&(0..n).map(|i| (i, i, 1.0)).collect::<Vec<_>>()).unwrap();
        assert_eq!(tree.depth(), depth); // ⌈log₂(n + 1)⌉
    }
}

#[test]
fn a_search_in_a_list_looks_at_every_entry_before() {
    // E57: the cost is linear in the entries, not exponential: the k-th takes k looks.
    let mut list = LinkedList::new(200, 200);
    for i in 0..200 {
        list.set(i, 3, 1.0).unwrap();
    }
    let visits: Vec<usize> = (0..200).map(|i| list.visits(i, 3).unwrap()).collect();
    assert_eq!(visits, (1..=200).collect::<Vec<_>>());
    assert_eq!(list.visits(199, 4).unwrap(), 200); // not there: all were looked at
    assert_eq!(list.visits(0, 2).unwrap(), 1);
}

#[test]
fn a_search_in_a_tree_ends_within_its_depth() {
    let order = shuffled(500, 7);
    let tree = tree(&order);
    let visits: Vec<usize> = (0..500).map(|i| tree.visits(i, i).unwrap()).collect();
    assert_eq!(visits.iter().max(), Some(&tree.depth()));
    // The sum of visits over a random tree is 2 (n + 1) H_n − 3 n on average (Knuth, 6.2.2).
    let harmonic: f64 = (1..=500).map(|k| 1.0 / f64::from(k)).sum();
    let expected = 2.0 * 501.0 * harmonic - 3.0 * 500.0;
    let sum = visits.iter().sum::<usize>() as f64;
    assert!((sum / expected - 1.0).abs() < 0.25, "{sum} against {expected}");
}

#[test]
fn a_list_set_backwards_or_mixed_is_sorted_all_the_same() {
    for order in [(0..50).rev().collect(), shuffled(50, 3)] {
        let order: Vec<usize> = order;
        let mut list = LinkedList::new(5, 10);
        order.iter().for_each(|&k| list.set(k / 10, k % 10, k as f64 + 1.0).unwrap());
        let rows: Vec<f64> =
            (0..5).flat_map(|i| list.row(i).unwrap()).map(|(_, value)| value).collect();
        assert_eq!(rows, (1..=50).map(f64::from).collect::<Vec<_>>());
    }
}
