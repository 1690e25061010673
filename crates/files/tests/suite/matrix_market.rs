use lcplab_files as files;
use proptest::prelude::*;

use super::{again, assert_same, boxes, frictions, message, rows, sample};
use lcplab_testing::{INF, cases};

#[test]
fn what_scipy_writes_is_read() {
    let lcp = files::read(&sample("scipy.mtx"), None).unwrap().lcp;
    let third = 1.0 / 3.0;
    assert_eq!(rows(lcp.matrix()), [[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, third]]);
    assert_eq!(lcp.b(), [-1.0, 0.1, 3.0]);
    assert_eq!((lcp.lo(), lcp.hi()), (&[0.0, -INF, -2.5][..], &[INF, 7.0, -third][..]));
}

#[test]
fn an_array_is_listed_by_columns_and_a_folder_has_plain_names() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("A.mtx", "%%MatrixMarket matrix array integer general\n% by columns\n2 2\n1\n2\n3\n4\n");
    write("b.mtx", "%%MatrixMarket matrix array real general\n2 1\n5\n6\n");
    let problem = files::read(folder.path(), None).unwrap();
    assert_eq!(rows(problem.lcp.matrix()), [[1.0, 3.0], [2.0, 4.0]]);
    assert_eq!((problem.lcp.lo(), problem.lcp.hi()), (&[0.0; 2][..], &[INF; 2][..]));
}

#[test]
fn a_symmetric_array_holds_the_lower_triangle_by_columns() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| std::fs::write(folder.path().join(name), text).unwrap();
    write("x.mtx", "%%MatrixMarket matrix array real symmetric\n3 3\n1\n2\n3\n4\n5\n6\n");
    write("x_b.mtx", "%%MatrixMarket matrix coordinate real general\n3 1 1\n2 1 7\n");
    let lcp = files::read(&folder.path().join("x"), None).unwrap().lcp;
    assert_eq!(rows(lcp.matrix()), [[1.0, 2.0, 3.0], [2.0, 4.0, 5.0], [3.0, 5.0, 6.0]]);
    assert_eq!(lcp.b(), [0.0, 7.0, 0.0]);
}

#[test]
fn a_file_that_would_be_read_as_part_of_a_problem_is_not_left_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.mtx");
    std::fs::write(folder.path().join("p_mu.mtx"), "of an older problem").unwrap();
    let problem = files::read(&sample("scipy.mtx"), None).unwrap();
    let error = files::write(&problem, &path, None).unwrap_err().to_string();
    assert!(
        error.ends_with("p_mu.mtx: already exists and would be read as part of the problem; delete it or use another name")
    );
    assert!(!path.exists());
}

#[test]
fn each_defect_has_its_line() {
    let file = |rest: &str| format!("%%MatrixMarket matrix coordinate real {rest}");
    let cases = [
        ("1 2 3", "p: line 1: must be %%MatrixMarket matrix FORMAT FIELD SYMMETRY"),
        (
            &file("hermitian"),
            "p: line 1: the symmetry must be general or symmetric, is \"hermitian\"",
        ),
        (&file("general\n% only comments"), "p: line 2: the file ends before the sizes"),
        (&file("general\n2 2"), "p: line 2: must be 3 sizes, is \"2 2\""),
        (&file("general\n2 2 1\n0 1 5"), "p: line 3: there is no row 0, column 1 in 2 × 2"),
        (&file("general\n2 2 2\n1 1 5"), "p: line 3: the file ends before row of entry 2"),
        (&file("general\n2 2 1\n1 1 x"), "p: line 3: its value must be a number, is \"x\""),
        (
            &file("general\n2 2 1\n1 1 5\n1"),
            "p: line 4: more entries than stated in the sizes: \"1\"",
        ),
        (
            &file("symmetric\n2 2 1\n1 2 5"),
            "p: line 3: row 1, column 2 lies above the diagonal of a symmetric file",
        ),
        (&file("symmetric\n2 3 0"), "p: line 2: 2 × 3 cannot be symmetric"),
        (
            &file("general\n2 2 0\n"),
            "p_b: is missing: a Matrix Market file has one matrix, so b must be in a file next to it",
        ),
        (
            "%%MatrixMarket matrix coordinate pattern general\n1 1 1\n1 1",
            "p: line 1: the field must be real or integer, is \"pattern\"",
        ),
        (
            "%%MatrixMarket matrix array complex general\n1 1\n1 2",
            "p: line 1: the field must be real or integer, is \"complex\"",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(message("matrix-market", text), expected);
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in boxes(), friction in frictions(1)) {
        assert_same(&problem.lcp, &again(&problem, "matrix-market").lcp);
        assert_same(&friction.lcp, &again(&friction, "matrix-market").lcp);
    }
}
