//! QPS: quadratic programs, an extension of the MPS format of linear programming.
//!
//! Defined by Maros & Mészáros, *A Repository of Convex Quadratic Programming Problems* (1999), the
//! section `QUADOBJ`, and by current solvers (CPLEX, Gurobi, HiGHS), which add `QMATRIX`. Words are
//! separated by spaces ("free MPS"); columns are numbered in order of first appearance.
//!
//! ```text
//! NAME box                     min  ½ xᵀQx + cᵀx    with lo ≤ x ≤ hi
//! ROWS
//!  N obj                       the objective
//!  G sum                       a constraint: L at most, G at least, E equal
//! COLUMNS
//!  x0 obj -1 sum 1             c, and the entries of the constraints
//! RHS
//!  rhs sum 2 obj 5             the limits; minus a constant of the objective, which is ignored
//! RANGES
//!  rng sum 1                   a second limit: 2 ≤ x0 ≤ 3
//! BOUNDS
//!  UP bnd x0 4                 UP LO FX FR MI PL; the default is 0 ≤ x
//! QUADOBJ
//!  x0 x0 2                     Q: each entry of one triangle once
//! ENDATA
//! ```
//!
//! For symmetric Q, w = Q x + c is 0 at the minimum if it is inside the box, and points outward at
//! the sides of the box: A = Q, b = c. Constraints add a multiplier each (`multipliers`). A problem
//! can be written if A is symmetric and no row is coupled.
//!
//! Traps: Q contains the factor 2 of x² (the objective is *half* of xᵀQx). `QUADOBJ` is one
//! triangle and must not contain the other one, `QMATRIX` is all of Q. For a negative `UP` without
//! an `LO` some readers assume 0 ≤ x and others −∞: it is rejected. Bounds of 1e20 or more are
//! infinite, as in HiGHS and CPLEX. Integers and `OBJSENSE MAX` are rejected.

mod constraints;
mod program;
mod reader;
mod writer;

use super::Format;

/// Quadratic programs.
pub const FORMAT: Format = Format {
    name: "qps",
    about: "QPS: quadratic programs with linear constraints",
    endings: &[".qps", ".mps"],
    in_folder: None,
    beside: &[],
    carries: "any bounds; constraints as rows of their multipliers when read, only symmetric A when written; no friction; sparse",
    law: None,
    trap: "QUADOBJ is one triangle of Q, and the objective half of xᵀQx",
    read: reader::read,
    write: Some(writer::write),
};
