//! E49 to E59: counts of bytes, entries and steps, each from how the storage is laid out.

use std::cell::Cell;
use std::cmp::Ordering;
use std::collections::{BTreeSet, HashSet};
use std::hash::{BuildHasherDefault, DefaultHasher, Hash, Hasher};

use super::{both, measure};

#[test]
fn without_dt_the_ball_leaves_the_floor_at_the_speed_that_gravity_would_give_it_in_a_second() {
    // x = 1 + g instead of 1 + g dt: v⁺ = g − g dt.
    let [printed, corrected] = both("E49", "velocity after the step");
    assert!((printed - (9.81 - 9.81 / 60.0)).abs() < 1e-12);
    assert!(corrected.abs() < 1e-12);
}

#[test]
fn the_listings_hold_71_and_214_bodies() {
    // The largest m with 7m < 500, and with 7m < 1501.
    assert_eq!(both("E50", "bodies Code 10 holds"), [700.0, 71.0]);
    assert_eq!(both("E50", "bodies Code 11 holds"), [700.0, 214.0]);
}

#[test]
fn writing_every_entry_of_an_identity_stores_all_of_them() {
    assert_eq!(both("E54", "3 × 3 from data"), [9.0, 3.0]);
    assert_eq!(both("E54", "100 × 100 by Set"), [1e4, 100.0]);
    assert_eq!(both("E54", "zeros, only read"), [1e4, 0.0]);
}

#[test]
fn compressed_rows_take_1204_bytes_in_3_arrays_and_nodes_13664_in_200() {
    // 8 bytes an entry and 4 for each of 101 row starts; 136 a row with one entry and 64 more.
    assert_eq!(both("E56", "bytes, 100 entries"), [1204.0, 13664.0]);
    assert_eq!(both("E56", "pieces of memory"), [3.0, 200.0]);
}

#[test]
fn a_full_list_is_seven_dense_matrices_and_breaks_even_at_a_seventh() {
    assert_eq!(both("E57", "full list : dense"), [28.0, 7.0]);
    assert_eq!(both("E57", "bytes, half full"), [70_000.0, 140_000.0]);
    // Of 10000 entries 1428 · 28 = 39984 bytes still fit into 40000.
    assert_eq!(measure("E57", "fill at break-even").truth, [0.1428]);
}

#[test]
fn steps_to_find_an_entry_of_a_list_grow_with_its_length() {
    let steps = measure("E57", "steps to 1 of 1500");
    assert_eq!(steps.truth, [1501.0 / 2.0]);
    let [printed, _] = both("E57", "steps to 1 of 1500");
    assert!((printed - 1001.0 * 1001.0 / 501.0 / 2.0).abs() < 1e-9);
}

#[test]
fn a_tree_filled_row_by_row_is_as_deep_as_it_has_entries() {
    let depth = measure("E58", "depth, row by row");
    assert_eq!(depth.truth, [3000.0]);
    assert_eq!(both("E58", "depth, row by row")[0], 12.0); // 2¹¹ ≤ 3000 < 2¹²
}

thread_local! {
    /// Comparisons of keys so far.
    static COMPARISONS: Cell<usize> = const { Cell::new(0) };
}

/// The place of an entry, which counts how often it is compared with another.
#[derive(Eq)]
struct Place(usize);

impl PartialEq for Place {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl PartialOrd for Place {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Place {
    fn cmp(&self, other: &Self) -> Ordering {
        COMPARISONS.set(COMPARISONS.get() + 1);
        self.0.cmp(&other.0)
    }
}

impl Hash for Place {
    fn hash<H: Hasher>(&self, hasher: &mut H) {
        self.0.hash(hasher);
    }
}

/// The comparisons of a search, the mean over all entries.
fn comparisons(n: usize, contains: impl Fn(&Place) -> bool) -> f64 {
    COMPARISONS.set(0);
    assert!((0..n).all(|k| contains(&Place(k))));
    COMPARISONS.get() as f64 / n as f64
}

#[test]
fn a_hash_table_finds_an_entry_in_one_comparison() {
    // T59: one comparison and hardly ever a second one, at any size. In a sorted map they grow as
    // the logarithm of the entries: twice as many for the square of them.
    let hashed = |n: usize| {
        let table: HashSet<Place, BuildHasherDefault<DefaultHasher>> = (0..n).map(Place).collect();
        comparisons(n, |place| table.contains(place))
    };
    let sorted = |n: usize| {
        let map: BTreeSet<Place> = (0..n).map(Place).collect();
        comparisons(n, |place| map.contains(place))
    };
    for n in [100, 10_000] {
        assert!((1.0..1.1).contains(&hashed(n)), "{}", hashed(n));
    }
    let growth = sorted(10_000) / sorted(100);
    assert!((1.6..2.4).contains(&growth), "{growth}");
}
