//! No file makes a reader panic, hang or take more memory than it is worth.

use std::io::{Cursor, Write};
use std::path::Path;

use lcplab_files as files;
use lcplab_files::{ALL, Format};
use lcplab_lcp::error::Error;
use lcplab_lcp::memory::Memory;
use proptest::prelude::*;

use super::{message, sample};
use lcplab_testing::cases;

/// Valid files, each with those beside it.
const SEEDS: [(&str, &str); 14] = [
    ("matrix-market", "scipy.mtx"),
    ("npz", "numpy.npz"),
    ("npz", "scipy.npz"),
    ("qps", "highs.qps"),
    ("chrono", "chrono/dump_Cq.dat"),
    ("siconos", "blocks"),
    ("siconos", "siconos/relay.dat"),
    ("siconos", "siconos/mixed_both.dat"),
    ("siconos", "siconos/global_unsymmetric.dat"),
    ("mat", "matlab/between.mat"),
    ("mat", "matlab/separate.mat"),
    ("mat", "matlab/between_73.mat"),
    ("fclib", "fclib_local.hdf5"),
    ("fclib", "fclib_global.hdf5"),
];

const BLOCKS: &[u8] = b"3 1 3 3 3 2 2 2 3 2 3 3 3 0 2 3 0 1 1 0 1 2 3 4 1 5 6 2 7 -1 -2 -3";

fn seed(name: &str) -> Vec<u8> {
    if name == "blocks" { BLOCKS.to_vec() } else { std::fs::read(sample(name)).unwrap() }
}

fn read(bytes: &[u8], format: &str, beside: Option<&Path>) {
    let folder = tempfile::tempdir().unwrap();
    for file in beside.into_iter().flat_map(|beside| beside.read_dir().unwrap().flatten()) {
        if file.path().is_file() {
            std::fs::copy(file.path(), folder.path().join(file.file_name())).unwrap();
        }
    }
    let format = Format::by_name(format).unwrap();
    let name = match format.name {
        "matrix-market" => "scipy.mtx",
        "chrono" => "dump_Cq.dat",
        _ => "file",
    };
    std::fs::write(folder.path().join(name), bytes).unwrap();
    let _ = files::read(&folder.path().join(name), Some(format));
}

#[test]
fn sizes_are_not_believed() {
    let huge = "1000000000000000000";
    let array = format!("%%MatrixMarket matrix array real general\n{huge} {huge}\n1\n");
    assert!(message("matrix-market", &array).contains("the file ends before row 2, column 1"));
    let three = "%%MatrixMarket matrix array real general\n2 2\n1\n2\n3\n";
    assert!(message("matrix-market", three).contains("the file ends before row 2, column 2"));
    let none = format!("%%MatrixMarket matrix array real general\n0 {huge}\n");
    assert!(message("matrix-market", &none).contains("_b: is missing"));
    let entries = format!("%%MatrixMarket matrix coordinate real general\n{huge} {huge} {huge}\n");
    assert!(message("matrix-market", &entries).contains("the file ends before row of entry 1"));
    let dense = format!("{huge} 0 {huge} {huge} {huge} {huge} 1");
    assert!(message("siconos", &dense).contains("the file ends before M[1]"));
    let mixed =
        format!("1 0 0 {huge} 0 {huge} 1 1 {huge} {huge} 1 1 1 {huge} {huge} 2 1 0 1 0 0 5");
    assert!(message("siconos", &mixed).contains("the file ends before block 0, number 1"));
    let parts = format!("0 1 {huge} 0 1 2 3");
    assert!(message("siconos", &parts).contains("fewer numbers than A, B, C, D, a and b have"));
    let columns = "3000000000000000000";
    let bodies = format!("3 {huge} 0 0 0 0 0 0 0 {columns} 0 {columns}");
    assert!(message("siconos", &bodies).contains("the file ends before b[0]"));
    let blocks = format!("{huge} 1 {huge} {huge} 1 1 1 {huge} {huge} 2 1 0 1 0 0 5");
    assert!(message("siconos", &blocks).contains("the file ends before block 0, number 1"));
}

/// An archive with one array, whose head says this shape.
fn archive(shape: &str) -> Vec<u8> {
    let dictionary = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': {shape}, }}\n");
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    zip.start_file("A.npy", zip::write::SimpleFileOptions::default()).unwrap();
    zip.write_all(b"\x93NUMPY\x01\x00").unwrap();
    zip.write_all(&(dictionary.len() as u16).to_le_bytes()).unwrap();
    zip.write_all(dictionary.as_bytes()).unwrap();
    zip.finish().unwrap().into_inner()
}

#[test]
fn arrays_are_not_unpacked_beyond_the_limit() {
    let message = |shape: &str| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.npz");
        std::fs::write(&path, archive(shape)).unwrap();
        files::read(&path, None).unwrap_err().to_string()
    };
    let whole = |text: String| text.split_once("p.npz: ").unwrap().1.to_string();
    assert_eq!(
        whole(message("(100000, 100000)")),
        "A of the shape [100000, 100000] needs 560 GB; the limit is 4 GB"
    );
    assert!(message("(9999999999, 9999999999, 9999999999)").contains("; the limit is "));
    assert_eq!(whole(message("(2, 2)")), "A: has 0 bytes, the shape [2, 2] needs 32");
}

#[test]
fn arrays_that_are_small_one_by_one_are_refused_together() {
    let count = 100_000;
    let head = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({count},), }}\n");
    let head = [&b"\x93NUMPY\x01\x00"[..], &(head.len() as u16).to_le_bytes(), head.as_bytes()];
    let array = [head.concat(), vec![0; 8 * count]].concat();
    let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
    for part in ["b", "lo", "hi", "data"] {
        zip.start_file(format!("{part}.npy"), zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(&array).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.npz");
    std::fs::write(&path, zip.finish().unwrap().into_inner()).unwrap();
    assert!(path.metadata().unwrap().len() < 10_000);
    let read = |most| files::read_within(&path, None, Memory::bytes(most)).unwrap_err();
    assert!(matches!(read(16_000_000), Error::TooLarge { limit: 16_000_000, .. }));
    assert!(matches!(read(100_000_000), Error::Invalid { .. }), "there is no A");
}

/// Rows on one mass: their A is full, and larger than the file by the square of it.
#[test]
fn a_matrix_that_a_file_only_asks_for_is_refused() {
    let (folder, rows) = (tempfile::tempdir().unwrap(), 1000);
    let lines = |line: &dyn Fn(usize) -> String| (0..rows).map(line).collect::<String>();
    for (part, text) in [
        ("Cq", lines(&|i| format!("{i} 0 1\n"))),
        ("H", "0 0 1\n".into()),
        ("f", "1\n".into()),
        ("b", lines(&|_| "0\n".into())),
        ("fric", lines(&|_| "-2\n".into())),
    ] {
        std::fs::write(folder.path().join(format!("dump_{part}.dat")), text).unwrap();
    }
    let refused = files::read_within(folder.path(), None, Memory::bytes(1_000_000));
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("A of 1000 rows needs 1.01 MB; the limit is 1 MB"), "{message}");
}

#[test]
fn empty_files_make_no_reader_panic() {
    let folder = tempfile::tempdir().unwrap();
    for part in ["H", "Cq", "E", "f", "b", "fric"] {
        std::fs::write(folder.path().join(format!("dump_{part}.dat")), "").unwrap();
    }
    let _ = files::read(folder.path(), None);
    for format in ALL {
        read(b"", format.name, None);
        read(b"0 0 0 0 0 0 0 0 0 0", format.name, None);
    }
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn no_bytes_make_a_reader_panic(
        bytes in proptest::collection::vec(any::<u8>(), 0..200),
        text in "[%MatrixkcoordnelgshyNEUAQPSB0-9.\\-+\\n ]{0,200}",
    ) {
        for format in ALL {
            read(&bytes, format.name, None);
            read(text.as_bytes(), format.name, None);
        }
    }

    #[test]
    fn no_change_to_a_valid_file_makes_a_reader_panic(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 1..4),
        cut in any::<prop::sample::Index>(),
        is_cut in any::<bool>(),
    ) {
        for (format, name) in SEEDS {
            let mut bytes = seed(name);
            for (place, byte) in &changes {
                let place = place.index(bytes.len());
                bytes[place] = *byte;
            }
            if is_cut {
                bytes.truncate(cut.index(bytes.len()));
            }
            let beside = sample(name);
            read(&bytes, format, beside.parent().filter(|_| format != "siconos"));
        }
    }

    /// As above, but digits stay digits, so that the change is of sizes, indices and numbers.
    #[test]
    fn no_change_of_numbers_makes_a_reader_panic(
        changes in proptest::collection::vec((any::<prop::sample::Index>(), b'0'..=b'9'), 1..4),
    ) {
        for (format, name) in SEEDS.into_iter().filter(|(_, name)| !name.ends_with("z")) {
            let mut bytes = seed(name);
            let digits: Vec<usize> =
                (0..bytes.len()).filter(|k| bytes[*k].is_ascii_digit()).collect();
            for (place, digit) in &changes {
                bytes[digits[place.index(digits.len())]] = *digit;
            }
            let beside = sample(name);
            read(&bytes, format, beside.parent().filter(|_| format != "siconos"));
        }
    }
}
