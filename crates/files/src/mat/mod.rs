//! MATLAB's `.mat`: quadratic programs and LCPs as variables, in the formats 5 and 7.3.
//!
//! Format 5 is defined by MathWorks, *MAT-File Format*, and is what `scipy.io.savemat` and MATLAB's
//! `save` write; format 7.3 is an HDF5 file with attributes (`save -v7.3`). Format 4 is rejected.
//!
//! | variables | problem |
//! | --- | --- |
//! | `P`, `q`; `A`, `l`, `u`; `r`, `n`, `m` | min ½ xᵀP x + qᵀx with l ≤ A x ≤ u, as OSQP and the Maros-Mészáros files of qpsolvers store it; `r`, a constant of the objective, is ignored, `n` and `m` must be the sizes |
//! | `P`, `q`; `G`, `h`; `A`, `b`; `lb`, `ub` | min ½ xᵀP x + qᵀx with G x ≤ h, A x = b, lb ≤ x ≤ ub, the arguments of qpsolvers |
//! | `A`, `b`; `lo`, `hi`; `friction_index`, `mu` | w = A x + b, as in [`file`](lcplab_lcp::file); friction rows from 0, −1 for none |
//!
//! P is all of a symmetric matrix, and the objective contains half of xᵀP x. A constraint adds a
//! row for its multiplier (`multipliers`); a row of A with a single entry 1 between `l` and `u` is
//! a bound of its x instead. Limits of 1e20 or more are infinite. A and P may be sparse. Vectors
//! may be rows or columns.
//!
//! A file with any other variable, with complex numbers, texts, cells or structures is rejected.

#[cfg(feature = "fclib")]
mod hdf5;
mod level5;
mod program;
mod variables;

use super::Format;
use super::Input;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;
use variables::Variables;

/// MATLAB's files.
pub const FORMAT: Format = Format {
    name: "mat",
    about: "MATLAB, formats 5 and 7.3: quadratic programs P, q, … of OSQP and qpsolvers, or A, b, lo, hi",
    endings: &[".mat"],
    in_folder: None,
    beside: &[],
    carries: "any bounds, coupled rows; constraints as rows of their multipliers; dense and sparse",
    law: None,
    trap: "P is all of a symmetric matrix, and the objective half of xᵀPx",
    read,
    write: None,
};

/// The first bytes of an HDF5 file, which follow a block of 512 bytes in format 7.3.
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";
const BLOCK: usize = 512;

fn read(input: &Input) -> Result<Problem> {
    let (name, bytes) = (input.name(), input.bytes()?);
    let is_hdf5 = bytes.get(BLOCK..).is_some_and(|rest| rest.starts_with(HDF5));
    let variables = match is_hdf5 {
        true => hierarchical(bytes, &name, input)?,
        false => level5::read(&bytes, &name, input.most())?,
    };
    program::problem(variables, input.stem(), &name)
}

#[cfg(feature = "fclib")]
fn hierarchical(bytes: Vec<u8>, name: &str, input: &Input) -> Result<Variables> {
    hdf5::read(bytes, name, input.most())
}

#[cfg(not(feature = "fclib"))]
fn hierarchical(_: Vec<u8>, name: &str, _: &Input) -> Result<Variables> {
    let reason =
        "is a MATLAB file of format 7.3, and this build has no HDF5: build with the feature fclib";
    Err(Error::invalid(name, "format", reason))
}

/// An error about a variable.
fn fault(input: &str, variable: &str, reason: impl Into<String>) -> Error {
    Error::invalid(input, variable, reason)
}
