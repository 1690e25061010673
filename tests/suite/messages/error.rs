//! Input that cannot be used.

use std::path::Path;

use lcplab::error::Error;
use lcplab::file;
use lcplab::lcp::{Lcp, Matrix};
use lcplab::memory::Memory;
use lcplab::solver::MatrixClass;

#[test]
fn every_error_is_made_and_says_what_is_wrong_where() {
    let manifest = Path::new("Cargo.toml"); // tests run beside it
    each_variant! { Error in "crates/lcp/src/error.rs":
        Error::File { .. } => file::read(manifest, Memory::bytes(3)).unwrap_err(),
            "Cargo.toml: is larger than 3 B, the limit for reading";
        Error::Unknown { .. } => MatrixClass::by_word("magic").unwrap_err(),
            "there is no class of matrices named \"magic\"; there are definite, semidefinite, p, p-or-semidefinite, \
             p0, copositive-plus, general";
        Error::Invalid { .. } =>
            Lcp::new(Matrix::dense(1, &[1.0]), vec![0.0], vec![2.0], vec![1.0]).unwrap_err(),
            "problem: lo[0]: is 2, above hi[0] = 1";
        Error::TooLarge { .. } =>
            Memory::bytes(1000).check("a square of 20 rows", Memory::square(20)).unwrap_err(),
            "a square of 20 rows needs 3.2 kB; the limit is 1 kB";
    }
}
