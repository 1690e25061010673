//! The factorizations that solvers are built of, against matrices that can be multiplied by hand.

use lcplab::lcp::Matrix;
use lcplab::solver::elimination::Lu;
use lcplab::solver::envelope::Envelope;
use lcplab::solver::ldlt::Ldlt;

#[test]
fn a_dependent_row_is_found_whatever_its_unit() {
    // Row 2 is row 0 plus a third of row 1; rows and columns scaled over forty decades.
    let third = 1.0 / 3.0;
    let a = [[3.0, 1.0, 2.0], [1.0, 7.0, 5.0], [3.0 + third, 1.0 + 7.0 * third, 2.0 + 5.0 * third]];
    let scale = [1.0, 2f64.powi(70), 2f64.powi(-66)];
    assert_eq!(Lu::of(3, |r, c| a[r][c] * scale[r] * scale[c]).unwrap_err(), 2);
    let regular = Lu::of(2, |r, c| a[r][c]).unwrap();
    let mut z = [5.0, 9.0];
    regular.solve(&mut z);
    assert!((3.0 * z[0] + z[1] - 5.0).abs() < 1e-14 && (z[0] + 7.0 * z[1] - 9.0).abs() < 1e-14);
}

#[test]
fn removing_a_row_leaves_the_factors_of_the_smaller_matrix() {
    let a = [[4.0, 1.0, 2.0], [1.0, 3.0, 0.5], [2.0, 0.5, 5.0]];
    let mut factor = Ldlt::default();
    factor.append(&[], 4.0);
    factor.append(&[1.0], 3.0 - 1.0 / 4.0);
    let mut z = [2.0, 0.5];
    factor.solve(&mut z);
    factor.append(&[2.0, 0.5], 5.0 - 2.0 * z[0] - 0.5 * z[1]);
    factor.remove(0);
    let mut z = [a[1][1] + 2.0 * a[1][2], a[2][1] + 2.0 * a[2][2]]; // A_CC (1, 2)
    factor.solve(&mut z);
    assert!((z[0] - 1.0).abs() < 1e-14 && (z[1] - 2.0).abs() < 1e-14, "{z:?}");
}

#[test]
fn the_factors_solve_the_system_and_a_unit_row_stands_apart() {
    // Rows 0 and 3 touch, 1 stands alone, 2 touches 3; 1 is added to each diagonal entry.
    let entries = [(0, 0, 3.0), (0, 3, 1.0), (1, 1, 4.0), (2, 2, 2.0), (2, 3, -1.0), (3, 3, 5.0)];
    let mirrored = entries.iter().filter(|e| e.0 != e.1).map(|&(i, j, a)| (j, i, a));
    let matrix = Matrix::sparse(4, &entries.iter().copied().chain(mirrored).collect::<Vec<_>>());
    let mut factor = Envelope::of(&matrix, 3).unwrap();
    assert_eq!(factor.factor(&matrix, &[1.0; 4], |_| false), Ok(()));
    let mut z = [4.0 + 4.0, 10.0, 9.0 - 4.0, 1.0 - 3.0 + 24.0]; // (A + 1) (1, 2, 3, 4)
    factor.solve(&mut z);
    for (z, expected) in z.iter().zip([1.0, 2.0, 3.0, 4.0]) {
        assert!((z - expected).abs() < 1e-14, "{z}");
    }
    assert_eq!(factor.factor(&matrix, &[1.0; 4], |i| i == 3), Ok(()));
    assert_eq!(factor.pivots()[3], 1.0);
    let mut z = [4.0, 5.0, 3.0, 7.0];
    factor.solve(&mut z);
    assert_eq!(z, [1.0, 1.0, 1.0, 7.0]);
    assert_eq!(factor.factor(&matrix, &[-4.0; 4], |_| false), Err(0)); // a negative pivot
    assert!(Envelope::of(&matrix, 2).is_none()); // row 3 reaches from 0 to 2
}
