//! What matrices refuse.

use lcplab::storage::{Dense, Error, MapOfMaps, Storage, sweep};

use lcplab_testing::contacts;

#[test]
fn every_refusal_of_a_storage_is_made_and_has_the_numbers() {
    let mut a = Dense::new(2, 3);
    let huge = MapOfMaps::new(usize::MAX, 1);
    let lcp = || contacts(&[&[1.0, 0.0], &[0.0, 0.0]], &[-1.0; 2]);
    let flat = || {
        let mut a = Dense::new(2, 2);
        a.set(0, 0, 1.0).unwrap();
        sweep(&lcp(), &a, &mut [0.0; 2]).unwrap_err()
    };
    each_variant! { Error:
        Error::Outside { .. } => a.get(2, 0).unwrap_err(),
            "entry (2, 0) is outside a 2 × 3 matrix";
        Error::Length { .. } => sweep(&lcp(), &a, &mut [0.0]).unwrap_err(),
            "x has 1 values, but 2 are needed";
        Error::NotFinite { .. } => a.set(0, 1, f64::NAN).unwrap_err(),
            "entry (0, 1) must be finite, is NaN";
        Error::TooLarge { .. } => huge.get(usize::MAX - 1, 0).unwrap_err(),
            "18446744073709551615 × 1 is more than the limit of 4294967295 rows or columns";
        Error::Unordered { .. } => a.load(&[(0, 1, 1.0), (0, 1, 2.0)]).unwrap_err(),
            "entry (0, 1) is out of order, or occurs twice";
        Error::Diagonal { .. } => flat(),
            "row 1 has diagonal 0, it must be positive";
    }
}
