use std::path::Path;

use lcplab_files as files;
use lcplab_files::Format;
use lcplab_lcp::file::Problem;
use lcplab_lcp::memory::Memory;

use super::{assert_same, rows, sample};
use lcplab_testing::{INF, assert_proved};

fn read(name: &str) -> Problem {
    files::read(&sample(&format!("matlab/{name}.mat")), None).unwrap()
}

/// The message about a file without its path.
fn message(path: &Path) -> String {
    let error = files::read(path, None).unwrap_err().to_string();
    error.replace(path.to_str().unwrap(), "p")
}

fn labels(problem: &Problem) -> Vec<&str> {
    let rows = problem.extra["rows"].as_array().unwrap();
    rows.iter().map(|row| row["label"].as_str().unwrap()).collect()
}

// min x² + y² + z² − x with x + y ≥ 2, z = 2 and x, y ≤ 5: x = 1.25, y = 0.75, and the row pushes
// with 2 · 0.75.

#[test]
fn rows_between_two_limits_are_constraints_and_single_ones_bounds() {
    let problem = read("between");
    let a =
        [[2.0, 0.0, 0.0, -1.0], [0.0, 2.0, 0.0, -1.0], [0.0, 0.0, 2.0, 0.0], [1.0, 1.0, 0.0, 0.0]];
    assert_eq!(rows(problem.lcp.matrix()), a);
    assert_eq!(problem.lcp.b(), [-1.0, 0.0, 0.0, -2.0]);
    assert_eq!(problem.lcp.lo(), [-INF, -INF, 2.0, 0.0]);
    assert_eq!(problem.lcp.hi(), [5.0, 5.0, 2.0, INF]);
    assert_eq!(labels(&problem), ["x[0]", "x[1]", "x[2]", "multiplier of A[0]"]);
    assert_proved(&problem.lcp, &[1.25, 0.75, 2.0, 1.5]);
}

#[test]
fn inequalities_equations_and_bounds_are_those_of_qpsolvers() {
    let problem = read("separate");
    assert_eq!(labels(&problem)[3..], ["multiplier of G[0]", "multiplier of A[0]"]);
    assert_eq!(problem.lcp.lo(), [-INF; 5]);
    assert_eq!(problem.lcp.hi(), [5.0, 5.0, INF, 0.0, INF]);
    // −x − y ≤ −2 is held by −1.5, z = 2 by its gradient 4.
    assert_proved(&problem.lcp, &[1.25, 0.75, 2.0, -1.5, 4.0]);
}

/// x − y/3 = 2⁻⁵⁴ stands in the file, and the minimum is at 0.
#[test]
fn limits_that_are_rounding_errors_of_zero_are_named() {
    let path = sample("matlab/rounding.mat");
    let warnings = files::read(&path, None).unwrap().warnings;
    let words = "1 row with limits that are probably rounding errors of 0, such as 5.6e-17 of A[0]";
    assert!(warnings.len() == 1 && warnings[0].contains(words), "{warnings:?}");
    assert!(read("between").warnings.is_empty());
}

/// The problem that NumPy wrote: the upper triangle of tridiag(-1, 2, -1) with a third.
#[test]
fn an_lcp_has_the_numbers_of_the_same_npz() {
    let other = files::read(&sample("numpy.npz"), None).unwrap();
    assert_same(&read("lcp").lcp, &other.lcp);
}

#[test]
#[cfg(feature = "fclib")]
fn format_7_3_holds_the_same_problems() {
    assert_same(&read("lcp_73").lcp, &read("lcp").lcp);
    assert_same(&read("between_73").lcp, &read("between").lcp);
    let reason = "p: problem: is a structure or an object, must be a matrix of numbers";
    assert_eq!(message(&sample("matlab/structure_73.mat")), reason);
}

#[test]
fn numbers_of_every_size_are_read() {
    let lcp = read("integers").lcp;
    assert_eq!(rows(lcp.matrix()), [[2.0, -1.0], [-1.0, 300.0]]);
    assert_eq!(lcp.b(), [-1.0, 2.0]);
    let lcp = read("single").lcp;
    assert_eq!((lcp.matrix().entry(0, 0), lcp.b()), (f64::from(1f32 / 3.0), &[200.0][..]));
}

#[test]
fn what_is_no_matrix_of_real_numbers_is_refused_by_its_name() {
    for (file, reason) in [
        ("structure", "problem: is a structure, must be a matrix of numbers"),
        ("complex", "A: is complex, must be real"),
        ("text", "b: is a text, must be a matrix of numbers"),
        ("cube", "A: has 3 dimensions, must have 2"),
        ("triangle", "P: is not symmetric: all of P is required, not one triangle"),
        ("format_4", "is not a MATLAB file of format 5 or 7.3"),
    ] {
        assert_eq!(message(&sample(&format!("matlab/{file}.mat"))), format!("p: {reason}"));
    }
}

#[test]
fn an_unknown_variable_is_refused() {
    let bytes = std::fs::read(sample("matlab/integers.mat")).unwrap();
    // The name in its tag: one letter.
    let place = bytes.windows(8).position(|w| w == *b"\x01\0\x01\0b\0\0\0").unwrap();
    let with = |letter: u8| {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.mat");
        let mut bytes = bytes.clone();
        bytes[place + 4] = letter;
        std::fs::write(&path, bytes).unwrap();
        message(&path)
    };
    let known = "the variables of this file may be";
    let lcp = format!("p: z: is not understood: {known} A, b, lo, hi, friction_index, mu");
    assert_eq!(with(b'z'), lcp);
    assert_eq!(with(b'q'), "p: P: is missing");
    assert_eq!(with(b'A'), "p: A: appears twice");
}

#[test]
fn limits_that_no_number_can_meet_are_refused() {
    let bytes = std::fs::read(sample("matlab/separate.mat")).unwrap();
    // −x − y ≤ h = −2, z = b = 2, x and y ≤ ub = 5: no other variable after them has these numbers.
    for (old, new, reason) in [
        (-2.0, -1e30, "h[0]: is -1000000000000000000000000000000, which no number can meet"),
        (2.0, INF, "b[0]: is inf, which no number can meet"),
        (5.0, -INF, "ub[1]: is -inf, which no number can meet"),
    ] {
        let place = bytes.windows(8).rposition(|w| *w == f64::to_le_bytes(old)).unwrap();
        let mut changed = bytes.clone();
        changed[place..place + 8].copy_from_slice(&f64::to_le_bytes(new));
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("p.mat");
        std::fs::write(&path, changed).unwrap();
        assert_eq!(message(&path), format!("p: {reason}"));
    }
}

#[test]
fn a_cut_file_is_refused() {
    let bytes = std::fs::read(sample("matlab/separate.mat")).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.mat");
    std::fs::write(&path, &bytes[..bytes.len() - 20]).unwrap();
    assert_eq!(message(&path), "p: ends within an element");
    let bytes = std::fs::read(sample("matlab/between.mat")).unwrap();
    let mut damaged = bytes.clone();
    damaged[160] ^= 0xff;
    std::fs::write(&path, damaged).unwrap();
    assert!(message(&path).starts_with("p: "), "{}", message(&path));
}

#[test]
fn a_compressed_variable_may_not_be_larger_than_the_limit() {
    let format = Format::by_name("mat").unwrap();
    let path = sample("matlab/between.mat");
    let error = files::read_within(&path, Some(format), Memory::bytes(700)).unwrap_err();
    assert!(error.to_string().contains("a variable of"), "{error}");
}
