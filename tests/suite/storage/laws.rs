use lcplab::storage::{ALL, Kind, Storage};
use nalgebra::DMatrix;
use proptest::prelude::*;

use super::{in_order, values};
use lcplab_testing::cases;

const ROWS: usize = 9;
const COLUMNS: usize = 14; // two bodies of six columns, and a part of a third

/// The entries of a matrix that are not zero, row by row, by the definition.
fn rows_of(matrix: &DMatrix<f64>) -> Vec<Vec<(usize, f64)>> {
    let row = |i| {
        let entries = (0..matrix.ncols()).map(|j| (j, matrix[(i, j)]));
        entries.filter(|(_, value)| *value != 0.0).collect()
    };
    (0..matrix.nrows()).map(row).collect()
}

fn filled(kind: &Kind, entries: &[(usize, usize, f64)]) -> Box<dyn Storage> {
    let mut storage = (kind.new)(ROWS, COLUMNS);
    entries.iter().for_each(|&(i, j, value)| storage.set(i, j, value).unwrap());
    storage
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn every_storage_holds_what_a_plain_matrix_holds(entries in values(ROWS, COLUMNS)) {
        let mut plain = DMatrix::zeros(ROWS, COLUMNS);
        entries.iter().for_each(|&(i, j, value)| plain[(i, j)] = value);
        let rows = rows_of(&plain);
        for kind in &ALL {
            let storage = filled(kind, &entries);
            for i in 0..ROWS {
                prop_assert_eq!(&storage.row(i).unwrap(), &rows[i], "{} row {}", kind.name, i);
                for j in 0..COLUMNS {
                    prop_assert_eq!(storage.get(i, j).unwrap(), plain[(i, j)], "{}", kind.name);
                }
            }
        }
    }

    #[test]
    fn what_is_loaded_at_once_is_what_is_set_one_by_one(entries in values(ROWS, COLUMNS)) {
        for kind in &ALL {
            let one_by_one = filled(kind, &entries);
            let mut loaded = filled(kind, &[(1, 1, 5.0), (8, 13, 5.0)]);
            loaded.load(&in_order(&entries)).unwrap();
            prop_assert_eq!(loaded.stored(), one_by_one.stored(), "{}", kind.name);
            for i in 0..ROWS {
                prop_assert_eq!(loaded.row(i).unwrap(), one_by_one.row(i).unwrap(), "{}", kind.name);
            }
        }
    }

    #[test]
    fn a_reset_matrix_is_zero_and_takes_another_size(entries in values(ROWS, COLUMNS)) {
        for kind in &ALL {
            let mut storage = filled(kind, &entries);
            storage.reset(3, 20).unwrap();
            prop_assert_eq!((storage.rows(), storage.columns()), (3, 20));
            prop_assert!((0..3).all(|i| storage.row(i).unwrap().is_empty()), "{}", kind.name);
            storage.set(2, 19, 4.0).unwrap();
            prop_assert_eq!(storage.row(2).unwrap(), [(19, 4.0)], "{}", kind.name);
        }
    }
}

#[test]
fn code_11_corrected_clears_and_drops_zeros() {
    use lcplab::storage::MapOfMaps;
    // E52: as printed, 5 stays 5 after SetToZero.
    let mut map = MapOfMaps::new(2, 3);
    map.set(1, 1, 5.0).unwrap();
    map.reset(2, 3).unwrap();
    assert_eq!((map.get(1, 1).unwrap(), map.stored()), (0.0, 0));
    // E54: 100 × 100 written through Set keeps 10000 entries for 100.
    let mut identity = MapOfMaps::new(100, 100);
    for k in 0..10_000 {
        identity.set(k / 100, k % 100, f64::from(u8::from(k % 101 == 0))).unwrap();
    }
    assert_eq!(identity.stored(), 100);
}
