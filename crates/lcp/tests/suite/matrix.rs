use lcplab_lcp::{Matrix, dot};
use proptest::prelude::*;

use lcplab_testing::cases;

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn dense_and_sparse_storage_agree_on_every_operation(
        entries in proptest::collection::vec((0..7usize, 0..7usize, -4i32..5), 0..30),
        x in proptest::collection::vec(-4i32..5, 7),
    ) {
        let entries: Vec<_> = entries.iter().map(|&(i, j, v)| (i, j, f64::from(v))).collect();
        let x: Vec<f64> = x.iter().map(|&v| f64::from(v)).collect();
        let sparse = Matrix::sparse(7, &entries);
        let dense = Matrix::from(sparse.to_dense().as_view());
        for i in 0..7 {
            prop_assert_eq!(dense.row_dot(i, &x), sparse.row_dot(i, &x)); // small integers: exact
            prop_assert_eq!(dense.diagonal(i), sparse.diagonal(i));
        }
        prop_assert_eq!(dense.pattern(), sparse.pattern());
        prop_assert_eq!(dense.is_symmetric(), sparse.is_symmetric());
        prop_assert_eq!(dense.is_nearly_symmetric(), sparse.is_nearly_symmetric());
        prop_assert_eq!(dense.is_nearly_symmetric(), dense.is_symmetric()); // whole numbers
    }

    #[test]
    fn the_eight_lane_product_is_the_sum_of_products(x in proptest::collection::vec(-9i32..9, 0..40)) {
        let x: Vec<f64> = x.iter().map(|&v| f64::from(v)).collect();
        prop_assert_eq!(dot(&x, &x), x.iter().map(|v| v * v).sum::<f64>());
    }
}
