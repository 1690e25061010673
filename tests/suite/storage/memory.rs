use lcplab::storage::{ALL, CompressedRows, Dense, Entry, LinkedList, Storage};

/// The first k places of a 100 × 100 matrix, row by row.
fn first(k: usize) -> Vec<Entry> {
    (0..k).map(|k| (k / 100, k % 100, 1.0)).collect()
}

#[test]
fn a_dense_matrix_takes_its_size_whatever_it_holds() {
    // The chapter's 40,000 bytes are right for its 4-byte float; f64 takes twice that.
    assert_eq!(100 * 100 * size_of::<f32>(), 40_000);
    for k in [0, 100, 10_000] {
        assert_eq!(Dense::of(100, 100, &first(k)).bytes(), 80_000);
    }
}

#[test]
fn a_list_breaks_even_at_the_ratio_of_number_to_entry() {
    // E57: the chapter's entry has 28 bytes beside numbers of 4. Full: 280,000 bytes, right, but
    // that is 7 times the dense matrix, not 28; half full 140,000, not 70,000; break-even at 1/7.
    let chapter = |entries: usize| 28 * entries;
    assert_eq!((chapter(10_000), chapter(10_000) / 40_000), (280_000, 7));
    assert_eq!(chapter(5_000), 140_000);
    assert!(chapter(1_428) < 40_000 && 40_000 < chapter(1_429)); // 14.3 %
    // Ours: 24 beside 8. Linear in the entries, break-even at 1/3.
    let list = |k| LinkedList::of(100, 100, &first(k)).bytes();
    assert_eq!((list(0), list(1), list(5_000), list(10_000)), (0, 24, 120_000, 240_000));
    assert!(list(3_333) < 80_000 && 80_000 < list(3_334));
}

#[test]
fn compressed_rows_take_twelve_bytes_an_entry_and_four_a_row() {
    let compressed = |k| CompressedRows::of(100, 100, &first(k)).bytes();
    assert_eq!((compressed(0), compressed(100)), (404, 1_604));
    assert!(compressed(6_633) <= 80_000 && 80_000 < compressed(6_634));
}

#[test]
fn memory_of_every_sparse_storage_grows_with_entries_alone() {
    for kind in ALL.iter().filter(|kind| kind.name != "dense") {
        let at = |size: usize| (kind.of)(size, size, &first(300)).bytes();
        // What is paid for a row: a start of 4 bytes at most.
        assert!(at(1_000_000) - at(100) <= 4 * 999_900, "{}", kind.name);
        assert!(at(100) < 40_000, "{}", kind.name);
    }
}
