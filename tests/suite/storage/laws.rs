use lcplab::storage::{ALL, Entry};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::cases;

const ROWS: usize = 9;
const COLUMNS: usize = 14; // two bodies of six columns, and a part of a third

/// Entries in order, some of them zero.
fn entries() -> impl Strategy<Value = Vec<Entry>> {
    let value = prop_oneof![2 => Just(0.0), 5 => -9.0..9.0f64];
    proptest::collection::btree_map((0..ROWS, 0..COLUMNS), value, 0..80)
        .prop_map(|map| map.into_iter().map(|((i, j), value)| (i, j, value)).collect())
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn every_storage_holds_what_a_plain_matrix_holds(entries in entries()) {
        let mut plain = DMatrix::zeros(ROWS, COLUMNS);
        entries.iter().for_each(|&(i, j, value)| plain[(i, j)] = value);
        for kind in &ALL {
            let storage = (kind.of)(ROWS, COLUMNS, &entries);
            prop_assert_eq!(storage.rows(), ROWS);
            for i in 0..ROWS {
                let row = (0..COLUMNS).map(|j| (j, plain[(i, j)]));
                let row: Vec<(usize, f64)> = row.filter(|(_, value)| *value != 0.0).collect();
                prop_assert_eq!(storage.row(i), row, "{} row {}", kind.name, i);
            }
        }
    }
}

#[test]
fn what_is_no_matrix_in_order_is_refused_in_every_storage() {
    let twice = [(0, 1, 1.0), (0, 1, 2.0)];
    let bad: [&[Entry]; 4] = [&[(2, 0, 1.0)], &[(0, 3, 1.0)], &[(0, 0, f64::NAN)], &twice];
    for kind in &ALL {
        for entries in bad {
            assert!(std::panic::catch_unwind(|| (kind.of)(2, 3, entries)).is_err(), "{entries:?}");
        }
    }
}
