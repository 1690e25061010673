//! Siconos' `.dat` files: an LCP, a relay, mixed or contact problem as a list of numbers.
//!
//! Defined by what Siconos writes: `linearComplementarity_printInFile`, `relay_printInFile`,
//! `mixedLinearComplementarity_printInFile`, `frictionContact_printInFile` and
//! `globalFrictionContact_printInFile` (numerics/src/LCP, Relay, MLCP, FrictionContact), with
//! `NM_write_in_file` and `SBM_write_in_file` (numerics/src/linalg) for a matrix.
//!
//! | kind | its numbers, one after the other | read as |
//! | --- | --- | --- |
//! | LCP | n, M, q | 0 ≤ z ⟂ w = M z + q ≥ 0: A = M, b = q, bounds 0 and ∞ |
//! | relay | n, M, q, lb, ub | the same with the bounds lb and ub |
//! | MLCP | 1, 0, n, m, block ends from 0 to n + m, a flag for each block, M, q | rows of blocks with the flag 0 are equations: bounds −∞ and ∞ |
//! | MLCP by parts | 0, 1, n, m, A, B, C, D, a, b, each by rows | M = \[A C; D B\], q = (a, b), of which the first n rows are equations |
//! | contacts, FC3D | 3, number of contacts, M, q, mu | u = M r + q, r in Coulomb's cone, a contact as n, t1, t2: A = M, b = q |
//! | contacts with their bodies, GFC3D | 3, number of contacts, M, H, q, b, mu | M v = H r + q, u = Hᵀ v + b: A = Hᵀ M⁻¹ H, b ← Hᵀ M⁻¹ q + b |
//!
//! ```text
//! matrix, dense: storage 0                 matrix, in blocks: storage 1
//! 0 rows columns                           1 rows columns
//! rows columns                             number of blocks, of block rows, of block columns
//! numbers, column by column                where each block row ends, where each block column ends
//!                                          length of the next two lists
//!                                          the first block of each block row, and one more
//!                                          the block column of each block
//!                                          for each block its index and its numbers, by columns
//! ```
//!
//! Nothing in a file says which kind it is. It is told from the numbers before the first matrix and
//! from how many follow it, and a file is refused unless all of its numbers are understood. Two
//! things may follow a problem: one number 0 or 1 after mu, with which many of Siconos' own files
//! end and which Siconos leaves unread, and lines of text, which are taken as a comment and
//! reported. An MLCP may hold its matrix in both ways, which must agree.
//!
//! M of a GFC3D is factored in double precision, by Cholesky, or by LU where it is not symmetric,
//! each column of H is solved for with one step of iterative refinement, and what lcplab proves is
//! about the A that comes out. M is refused if it is singular, symmetric and not positive definite,
//! or so badly conditioned that fewer than eight digits of A would be right.
//!
//! Refused by name are contacts in the plane (FC2D, GFC2D), rolling friction (RFC3D, GRFC3D),
//! plasticity, problems over second-order cones (SOCLCP), generic mechanical problems, mixed LCPs
//! with more equations than unknowns, and storage 2, a listing of a sparse matrix with six digits.
//!
//! Traps: dense matrices and blocks are listed *column by column*; read by rows, the portfolio
//! problems of Cottle, Pang & Stone among Siconos' own tests have no solution. An affine
//! variational inequality has the same numbers as an LCP. Written are dense matrices, in the fewest
//! digits that read back as the same bits: an LCP, a relay problem if all bounds are finite, or
//! contacts.

mod kind;
mod matrix;
mod mixed;
mod reader;
mod writer;

use super::Format;
use lcplab_problem::friction::Model;

/// Siconos' LCPs, relay problems, mixed LCPs and contacts.
pub const FORMAT: Format = Format {
    name: "siconos",
    about: "Siconos: LCPs, relay problems, mixed LCPs and contacts (FC3D, GFC3D) as lists of numbers",
    endings: &[".dat"],
    in_folder: None,
    beside: &[],
    carries: "bounds 0 and inf, finite bounds, or contacts under Coulomb's law; written densely",
    law: Some(Model::CoulombCone),
    trap: "dense matrices and blocks are listed column by column",
    read: reader::read,
    write: Some(writer::write),
};
