//! Codes 8 to 11 as printed do what the errata say, and their corrected forms what a matrix does.

use lcplab::chapter::code::code08_matrix_program as code08;
use lcplab::chapter::code::code09_10_dense_matrix as code10;
use lcplab::chapter::code::code11_map_matrix as code11;
use nalgebra::{DMatrix, dmatrix};

#[test]
fn code_8_as_printed_has_an_empty_matrix_whatever_j_is() {
    let j = dmatrix![1.0, -1.0, 0.0; 0.0, 1.0, -1.0];
    let inverse_mass = DMatrix::identity(3, 3);
    let nothing = DMatrix::zeros(3, 6);
    let system = code08::printed::system(&inverse_mass, &nothing, &nothing, &j);
    assert_eq!(system.a, DMatrix::zeros(2, 2));
    assert_eq!(system.b.shape(), (2, 6));
}

#[test]
fn code_8_corrected_is_the_chain_of_two_rods_and_has_one_column() {
    // Three unit masses along x: entries 0, 6 and 12 of u.
    let along_x =
        |row: [f64; 3]| DMatrix::from_fn(1, 18, |_, c| if c % 6 == 0 { row[c / 6] } else { 0.0 });
    let [upper, lower] = [along_x([1.0, -1.0, 0.0]), along_x([0.0, 1.0, -1.0])];
    let j = DMatrix::from_fn(2, 18, |r, c| if r == 0 { upper[c] } else { lower[c] });
    let u = along_x([0.5, 1.0, 4.0]).transpose();
    let force = along_x([10.0, 0.0, 0.0]).transpose();
    let system = code08::corrected::system(&DMatrix::identity(18, 18), &u, &force, &j, 0.1);
    assert_eq!(system.a, dmatrix![2.0, -1.0; -1.0, 2.0]);
    assert_eq!(system.b, dmatrix![0.5; -3.0]);
}

#[test]
fn code_10_reads_by_rows_and_checks_every_place() {
    let data = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
    let mut printed = code10::printed::DenseMatrix::new(2, 3, Some(&data)).unwrap();
    let mut corrected = code10::corrected::DenseMatrix::new(2, 3, &data).unwrap();
    for (k, &value) in data.iter().enumerate() {
        assert_eq!(printed.get(k as i32 / 3, k as i32 % 3).unwrap(), value);
        assert_eq!(corrected.get(k / 3, k % 3), Some(value));
    }
    *printed.set(1, 2).unwrap() = 9.0;
    *corrected.get_mut(1, 2).unwrap() = 9.0;
    assert_eq!((printed.get(1, 2).unwrap(), corrected.get(1, 2)), (9.0, Some(9.0)));
    assert_eq!(printed.get(2, 0).unwrap_err().to_string(), "Code 10: (2, 0): outside 2 × 3");
    assert!(printed.get(0, -1).is_err());
    assert_eq!(corrected.get(0, 3), None);
}

#[test]
fn code_10_stops_at_500_and_at_one_zero_size_but_not_at_two() {
    let made = |rows, cols| code10::printed::DenseMatrix::new(rows, cols, None).is_ok();
    assert!(made(499, 499) && made(0, 0));
    assert!(!made(500, 1) && !made(1, 500) && !made(-1, 1) && !made(0, 18) && !made(18, 0));
    let j = code10::corrected::DenseMatrix::zeros(0, 18);
    assert_eq!((j.num_rows(), j.num_cols()), (0, 18));
}

#[test]
fn code_11_as_printed_transposes_square_data_and_keeps_what_it_was_told_to_forget() {
    let data = [1.0, 2.0, 3.0, 4.0];
    let mut printed = code11::printed::MapMatrix::new(2, 2, Some(&data)).unwrap();
    let corrected = code11::corrected::MapMatrix::new(2, 2, &data).unwrap();
    for (i, k) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
        assert_eq!(printed.get(i, k).unwrap(), corrected.get(k, i));
    }
    assert!(!printed.set_to_zero());
    assert_eq!(printed.get(0, 1).unwrap(), 3.0);
    assert!(printed.get(2, 0).is_err());
}

#[test]
fn code_11_corrected_stores_exactly_what_is_not_zero() {
    let mut matrix = code11::corrected::MapMatrix::zeros(4, 4);
    for (row, col) in [(0, 0), (0, 3), (2, 1)] {
        matrix.set(row, col, 1.0).unwrap();
    }
    assert_eq!((matrix.stored(), matrix.nodes()), (3, 5));
    matrix.set(2, 1, 0.0).unwrap();
    assert_eq!((matrix.stored(), matrix.nodes()), (2, 3));
    assert!(matrix.set(4, 0, 1.0).is_err());
    matrix.set_to_zero();
    assert_eq!((matrix.stored(), matrix.nodes(), matrix.get(0, 3)), (0, 0, 0.0));
}
