use lcplab::storage::{LinkedList, Storage};

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
