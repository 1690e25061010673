//! Siconos' `.dat` files: an LCP, a relay, mixed, conic, generic or contact problem as a list of
//! numbers.
//!
//! Defined by the output of Siconos: `linearComplementarity_printInFile`, `relay_printInFile`,
//! `mixedLinearComplementarity_printInFile`, `frictionContact_printInFile` and
//! `globalFrictionContact_printInFile` (numerics/src/LCP, Relay, MLCP, FrictionContact), with
//! `NM_write_in_file` and `SBM_write_in_file` (numerics/src/linalg) for a matrix.
//!
//! | kind | numbers, in this order | read as |
//! | --- | --- | --- |
//! | LCP | n, M, q | 0 ≤ z ⟂ w = M z + q ≥ 0: A = M, b = q, bounds 0 and ∞ |
//! | relay | n, M, q, lb, ub | the same with the bounds lb and ub |
//! | MLCP | 1, 0, n, m, block ends from 0 to n + m, a flag for each block, M, q | rows of blocks with the flag 0 are equations: bounds −∞ and ∞ |
//! | MLCP by parts | 0, 1, n, m, A, B, C, D, a, b, each by rows | M = \[A C; D B\], q = (a, b); the first n rows are equations |
//! | contacts, FC3D | 3, number of contacts, M, q, mu | u = M r + q, r in Coulomb's cone, a contact as n, t1, t2: A = M, b = q |
//! | second-order cones, SOCLCP | n, number of cones, M, q, where each cone of three rows begins and the last ends, tau | K ∋ z ⟂ M z + q ∈ K*: the associated cone, A = M, b = q, μ = tau |
//! | generic mechanical, GMP | M in blocks, q, for each block of rows its kind: 0, an LCP, 2, equations, or 4, a contact, with mu after it | A = M, b = q; bounds 0 and ∞, none, or Coulomb's cone |
//! | contacts with their bodies, GFC3D | 3, number of contacts, M, H, q, b, mu | M v = H r + q, u = Hᵀ v + b: A = Hᵀ M⁻¹ H, b ← Hᵀ M⁻¹ q + b |
//!
//! ```text
//! matrix, dense: storage 0                 matrix, in blocks: storage 1
//! 0 rows columns                           1 rows columns
//! rows columns                             number of blocks, of block rows, of block columns
//! numbers, column by column                the end of each block row, the end of each block column
//!                                          length of the next two lists
//!                                          the first block of each block row, and one more
//!                                          the block column of each block
//!                                          for each block its index and its numbers, by columns
//! ```
//!
//! A file does not state its kind. The reader determines it from the numbers before the first
//! matrix and from how many follow it, and rejects a file unless it understands all of its numbers.
//! Three things may follow a problem: a number 0 or 1 after mu, which ends many of Siconos' own
//! files and which Siconos does not read; n + 2 m − 1 numbers after an MLCP, a known answer, which
//! cause a warning; and lines of text, which count as a comment and cause a warning. An MLCP may
//! contain its matrix in both forms, which must agree.
//!
//! M of a GFC3D is factored in double precision, by Cholesky, or by LU if it is not symmetric; each
//! column of H is one solve with one step of iterative refinement; lcplab's proofs refer to the
//! resulting A. M is rejected if it is singular, symmetric but not positive definite, or so badly
//! conditioned that fewer than eight digits of A would be correct.
//!
//! Contacts in the plane, FC2D and GFC2D, are the same with 2 for 3 and the rows n, t; the friction
//! cone is then the coupled box. A sparse matrix, storage 2, is a listing by CSparse (`listing`)
//! with six digits of each number: a problem read from it is that of these digits.
//!
//! The following are rejected with their name: rolling friction (RFC3D, GRFC3D), plasticity, cones
//! of more or fewer than three rows, other blocks of a GMP, and mixed LCPs with more equations than
//! unknowns.
//!
//! Traps: dense matrices and blocks are listed *column by column*; read by rows, the portfolio
//! problems of Cottle, Pang & Stone in Siconos' own tests have no solution. An affine variational
//! inequality has the same numbers as an LCP. The writer uses dense matrices, with the fewest
//! digits that are read back bitwise, for an LCP, for a relay problem if all bounds are finite, and
//! for contacts.

mod cones;
mod generic;
mod kind;
mod listing;
mod matrix;
mod mixed;
mod reader;
mod writer;

use super::Format;
use lcplab_lcp::friction::Model;

/// Siconos' LCPs, relay problems, mixed LCPs, contacts, and problems over cones or of several
/// kinds.
pub const FORMAT: Format = Format {
    name: "siconos",
    about: "Siconos: LCPs, relay problems, mixed LCPs, contacts (FC2D, FC3D, GFC2D, GFC3D), SOCLCPs and GMPs as lists of numbers",
    endings: &[".dat"],
    in_folder: None,
    beside: &[],
    carries: "bounds 0 and inf, finite bounds, or contacts under Coulomb's law; written densely",
    law: Some(Model::CoulombCone),
    trap: "dense matrices and blocks are listed column by column",
    read: reader::read,
    write: Some(writer::write),
};
