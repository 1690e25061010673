use std::io::{Cursor, Write};

use lcplab_files as files;
use lcplab_judge::{Demand, judge_friction};
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use proptest::prelude::*;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

use super::{again, assert_same, boxes, frictions, message, rows, sample};
use lcplab_testing::{INF, cases};

const UPPER: [[f64; 3]; 3] = [[2.0, -1.0, 0.0], [0.0, 2.0, -1.0], [0.0, 0.0, 1.0 / 3.0]];

#[test]
fn what_numpy_stores_by_columns_is_read() {
    let problem = files::read(&sample("numpy.npz"), None).unwrap();
    assert_eq!(rows(problem.lcp.matrix()), UPPER);
    assert_eq!(problem.lcp.b(), [-1.0, 0.1, 3.0]);
    assert_eq!(problem.lcp.hi(), [INF, 7.0, -1.0 / 3.0]);
    assert_eq!((problem.name.as_str(), problem.warnings.len()), ("numpy", 0));
}

#[test]
fn a_compressed_sparse_matrix_of_scipy_and_a_short_big_endian_b_are_read() {
    let lcp = files::read(&sample("scipy.npz"), None).unwrap().lcp;
    assert_eq!(rows(lcp.matrix()), UPPER);
    assert_eq!(lcp.matrix().stored(), 5);
    assert_eq!(lcp.b(), [-1.0, f64::from(0.1f32), 3.0]);
}

#[test]
fn a_matrix_alone_is_no_problem() {
    let error = files::read(&sample("matrix_only.npz"), None).unwrap_err().to_string();
    assert!(error.ends_with("matrix_only.npz: b: is missing"), "{error}");
}

#[test]
fn what_is_no_archive_is_refused() {
    assert!(
        message("npz", "PK, but nothing else").starts_with("p: is no .npz archive, or is cut off")
    );
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in boxes(), friction in frictions(1)) {
        assert_same(&problem.lcp, &again(&problem, "npz").lcp);
        assert_same(&friction.lcp, &again(&friction, "npz").lcp);
    }
}

/// An array of this type and shape with the bytes of its entries.
fn array(descr: &str, shape: &str, bytes: &[u8]) -> Vec<u8> {
    let head = format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': {shape}, }}\n");
    // Version 2, whose head may be long.
    [b"\x93NUMPY\x02\x00", &(head.len() as u32).to_le_bytes()[..], head.as_bytes(), bytes].concat()
}

fn numbers(values: &[f64]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("<f8", &format!("({},)", values.len()), &bytes)
}

fn integers(values: &[i64]) -> Vec<u8> {
    let bytes: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
    array("<i8", &format!("({},)", values.len()), &bytes)
}

/// [[2, 0], [1, 3]] as scipy.sparse stores it by rows, with b = (1, 2); some arrays in place of
/// those.
fn read(other: &[(&str, Vec<u8>)]) -> Result<Problem, String> {
    let by_entries = other.iter().any(|(name, _)| *name == "row");
    let mut arrays = vec![("format", array("|S3", "()", b"csr")), ("shape", integers(&[2, 2]))];
    if !by_entries {
        arrays.push(("indptr", integers(&[0, 1, 3])));
        arrays.push(("indices", integers(&[0, 0, 1])));
    }
    arrays.extend([("data", numbers(&[2.0, 1.0, 3.0])), ("b", numbers(&[1.0, 2.0]))]);
    arrays.retain(|(name, _)| other.iter().all(|(of, _)| of != name));
    arrays.extend_from_slice(other);
    archive(&arrays)
}

/// The problem of an archive of these arrays.
fn archive(arrays: &[(&str, Vec<u8>)]) -> Result<Problem, String> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    for (name, bytes) in arrays {
        zip.start_file(format!("{name}.npy"), SimpleFileOptions::default()).unwrap();
        zip.write_all(bytes).unwrap();
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.npz");
    std::fs::write(&path, zip.finish().unwrap().into_inner()).unwrap();
    let read = files::read(&path, None);
    read.map_err(|error| error.to_string().split_once("p.npz: ").unwrap().1.to_string())
}

#[test]
fn the_three_layouts_of_scipy_hold_the_same_matrix() {
    let expected = [[2.0, 0.0], [1.0, 3.0]];
    let by_columns = [
        ("format", array("|S3", "()", b"csc")),
        ("indptr", integers(&[0, 2, 3])),
        ("indices", integers(&[0, 1, 1])),
    ];
    let by_entries = [
        (
            "format",
            array(
                "<U3",
                "()",
                &"coo".chars().flat_map(|c| (c as u32).to_le_bytes()).collect::<Vec<_>>(),
            ),
        ),
        ("row", integers(&[0, 1, 1])),
        ("col", integers(&[0, 0, 1])),
    ];
    for other in [&[][..], &by_columns, &by_entries] {
        assert_eq!(rows(read(other).unwrap().lcp.matrix()), expected);
    }
}

#[test]
fn each_defect_of_an_array_has_its_message() {
    let long = array("<f8", "(2,)", &[0; 16]);
    let other = [&b"\x93NUMPX"[..], &array("<f8", "(2,)", &[0; 16])[6..]].concat();
    let long = [&long[..8], &(1u32 << 24).to_le_bytes(), &long[12..]].concat();
    for (part, bytes, expected) in [
        ("shape", integers(&[2]), "shape: must be rows and columns"),
        ("format", array("|S3", "()", b"bsr"), "format: must be csr, csc or coo, is \"bsr\""),
        ("format", numbers(&[1.0]), "format: must be a word"),
        ("data", numbers(&[1.0; 2]), "indptr: must rise from 0 to 2 in 2 steps"),
        ("indptr", integers(&[0, 3]), "indptr: must rise from 0 to 3 in 2 steps"),
        ("indptr", integers(&[0, 3, 2]), "indptr: must rise from 0 to 3 in 2 steps"),
        ("indices", integers(&[0, 1]), "data: has 3 numbers, but there are 2 places"),
        ("indices", integers(&[0, 0, 2]), "data[2]: lies at 1, 2 of 2 × 2"),
        ("indices", integers(&[0, 0, -1]), "indices: must not be negative, has -1"),
        ("indices", numbers(&[0.0; 3]), "indices: must be a list of integers"),
        ("b", array("<f8", "(1, 2)", &[0; 16]), "b: must be a list, has the shape [1, 2]"),
        ("b", array("|S1", "(2,)", b"ab"), "b: must be numbers"),
        (
            "A",
            numbers(&[1.0]),
            "data: is not understood: the other arrays of this file may be A, b, lo, hi, mu, friction_index",
        ),
        (
            "low",
            numbers(&[1.0]),
            "low: is not understood: the other arrays of this file may be format, shape, data, _is_array, \
             indices, indptr, b, lo, hi, mu, friction_index",
        ),
        (
            "b",
            [numbers(&[0.0; 2]), vec![0]].concat(),
            "b: has more bytes than the shape [2] needs, 16",
        ),
        (
            "friction_index",
            numbers(&[0.5, -1.0]),
            "friction_index[0]: must be a row index or -1, is 0.5",
        ),
        (
            "b",
            array("<c8", "(1,)", &[0; 8]),
            "b: has entries of the type \"<c8\", not numbers or words",
        ),
        (
            "b",
            array("f", "(1,)", &[0; 8]),
            "b: has entries of the type \"f\", not numbers or words",
        ),
        (
            "indices",
            array("<u8", "(3,)", &[255; 24]),
            "indices: has 18446744073709551615, beyond 2⁶³",
        ),
        ("b", other, "b: is not a .npy file of version 1, 2 or 3"),
        ("b", long, "b: has a head of 16777216 bytes"),
        ("b", numbers(&[0.0; 3]), "A: is 2 × 2, b has 3 rows"),
    ] {
        assert_eq!(read(&[(part, bytes)]).unwrap_err(), expected, "{part}");
    }
    // scipy.sparse stores the blocks of a bsr matrix in an array with three dimensions.
    let blocks =
        [("format", array("|S3", "()", b"bsr")), ("data", array("<f8", "(1, 2, 2)", &[0; 32]))];
    assert_eq!(read(&blocks).unwrap_err(), "format: must be csr, csc or coo, is \"bsr\"");
    let dense = archive(&[("A", numbers(&[1.0])), ("b", numbers(&[1.0]))]);
    assert_eq!(dense.unwrap_err(), "A: must be a matrix, has the shape [1]");
}

#[test]
fn a_contact_of_contact_bench_has_its_normal_last_and_coulombs_cone() {
    // Pressed with 2 and pushed with 3 along t1, μ = ½: friction is 1, and 2 are left to slide.
    let unit: Vec<u8> =
        (0..9).flat_map(|k| f64::from(u8::from(k % 4 == 0)).to_le_bytes()).collect();
    let column: Vec<u8> = [-3.0, 0.0, -2.0].iter().flat_map(|g: &f64| g.to_le_bytes()).collect();
    let arrays = |mus: &[f64]| {
        let g = array("<f8", "(3, 1)", &column);
        vec![("G", array("<f8", "(3, 3)", &unit)), ("g", g), ("mus", numbers(mus))]
    };
    let problem = archive(&arrays(&[0.5])).unwrap();
    let friction = problem.friction().unwrap().unwrap();
    assert_eq!(problem.model, Some(Model::CoulombCone));
    assert_eq!((friction.contacts()[0].rows, friction.contacts()[0].mu), ([2, 0, 1], 0.5));
    let posed = Model::CoulombCone.pose(&friction, None).unwrap();
    let is_solution =
        |x: &[f64]| judge_friction(&posed, x, &Demand::default()).verdict.is_solution();
    assert!(is_solution(&[1.0, 0.0, 2.0]) && !is_solution(&[2.0, 0.0, 1.0]));
    assert_eq!(problem.warnings, [""; 0]);
    let guessed = [arrays(&[0.5]), vec![("lam0", numbers(&[0.0; 3]))]].concat();
    let warnings = archive(&guessed).unwrap().warnings;
    assert!(warnings[0].ends_with("p.npz: not part of the problem: lam0, a first guess"));
    let soft = [arrays(&[0.5]), vec![("R", numbers(&[0.0; 3]))]].concat();
    assert!(archive(&soft).unwrap_err().starts_with("R: is not understood: "));
    let refused = archive(&arrays(&[0.5, 0.5])).unwrap_err();
    assert_eq!(refused, "mus: has 2 contacts, g has 3 rows");
    assert_eq!(archive(&arrays(&[0.5])[..2]).unwrap_err(), "mus: is missing beside G");
}
