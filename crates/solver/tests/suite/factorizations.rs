//! The factorizations used by the solvers, compared with matrices multiplied by hand.

use lcplab_lcp::Matrix;
use lcplab_solver::linalg::elimination::Lu;
use lcplab_solver::linalg::envelope::Envelope;
use lcplab_solver::linalg::ldlt::Ldlt;
use lcplab_solver::linalg::reordered::Reordered;

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
    for (i, column) in [vec![], vec![1.0], vec![2.0, 0.5]].into_iter().enumerate() {
        let (direction, product) = factor.eliminate(column);
        factor.enter(&direction, a[i][i] - product);
    }
    factor.remove(0);
    let rhs = vec![a[1][1] + 2.0 * a[1][2], a[2][1] + 2.0 * a[2][2]]; // A_CC (1, 2)
    let (x, _) = factor.eliminate(rhs);
    assert!((x[0] + 1.0).abs() < 1e-14 && (x[1] + 2.0).abs() < 1e-14, "{x:?}");
    assert_eq!(x[2..], [0.0; 6]);
}

#[test]
fn the_factors_solve_the_system_and_a_unit_row_stands_apart() {
    // Rows 0 and 3 are coupled, 1 is alone, 2 is coupled with 3; 1 is added to each diagonal entry.
    let entries = [(0, 0, 3.0), (0, 3, 1.0), (1, 1, 4.0), (2, 2, 2.0), (2, 3, -1.0), (3, 3, 5.0)];
    let mirrored = entries.iter().filter(|e| e.0 != e.1).map(|&(i, j, a)| (j, i, a));
    let matrix = Matrix::sparse(4, &entries.iter().copied().chain(mirrored).collect::<Vec<_>>());
    assert_eq!(Envelope::entries(&matrix), 3); // row 3 reaches from 0 to 2
    let mut factor = Envelope::of(&matrix);
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
}

/// A grid of points, each coupled to its neighbors and weakly to the ground, in random order.
fn grid(side: usize) -> Matrix {
    let n = side * side;
    let mut number: Vec<usize> = (0..n).collect();
    let mut random = oorandom::Rand64::new(3);
    (1..n).for_each(|k| number.swap(k, random.rand_range(0..k as u64 + 1) as usize));
    let mut entries: Vec<_> = (0..n).map(|i| (i, i, 4.5)).collect();
    for (i, j) in (0..side).flat_map(|i| (1..side).map(move |j| (i, j))) {
        for (p, q) in [(i * side + j - 1, i * side + j), ((j - 1) * side + i, j * side + i)] {
            entries.extend([(number[p], number[q], -1.0), (number[q], number[p], -1.0)]);
        }
    }
    Matrix::sparse(n, &entries)
}

/// The factors, if all pivots are positive.
fn factors(matrix: &Matrix) -> Option<Reordered> {
    let mut factor = Reordered::of(matrix);
    factor.factor(matrix, &vec![0.0; matrix.len()], |_| false).then_some(factor)
}

#[test]
fn reordered_factors_solve_as_dense_elimination_does() {
    for side in [1, 2, 12] {
        let matrix = grid(side);
        let b: Vec<f64> = (0..matrix.len()).map(|i| (i as f64).sin()).collect();
        let mut factor = factors(&matrix).unwrap();
        let (mut z, mut expected) = (b.clone(), b);
        factor.solve(&mut z);
        Lu::of(matrix.len(), |r, c| matrix.entry(r, c)).unwrap().solve(&mut expected);
        for (z, expected) in z.iter().zip(&expected) {
            assert!((z - expected).abs() < 1e-14, "{z} for {expected}");
        }
    }
}

#[test]
fn a_large_matrix_has_the_same_factors_in_dense_blocks() {
    let matrix = grid(60);
    let mut factor = factors(&matrix).unwrap();
    let x: Vec<f64> = (0..matrix.len()).map(|i| f64::from(i as u32 % 7) - 3.0).collect();
    let mut z: Vec<f64> = (0..matrix.len()).map(|i| matrix.row_dot(i, &x)).collect();
    factor.solve(&mut z);
    for (z, x) in z.iter().zip(&x) {
        assert!((z - x).abs() < 1e-13, "{z} for {x}");
    }
}

#[test]
fn the_hub_of_a_star_is_eliminated_last() {
    // If it is eliminated first, it couples all others with each other.
    let n = 20;
    let rays = (1..n).flat_map(|i| [(0, i, 1.0), (i, 0, 1.0)]);
    let star: Vec<_> = (0..n).map(|i| (i, i, 25.0)).chain(rays).collect();
    assert_eq!(Reordered::of(&Matrix::sparse(n, &star)).entries(), 2 * n - 1);
}

#[test]
fn a_matrix_without_positive_pivots_has_no_reordered_factors() {
    let matrix = |a: f64| Matrix::sparse(2, &[(0, 0, 1.0), (0, 1, 2.0), (1, 0, 2.0), (1, 1, a)]);
    assert!(factors(&matrix(4.5)).is_some());
    assert!(factors(&matrix(4.0)).is_none()); // singular
    assert!(factors(&matrix(3.0)).is_none()); // indefinite
    factors(&Matrix::sparse(0, &[])).unwrap().solve(&mut []);
}
