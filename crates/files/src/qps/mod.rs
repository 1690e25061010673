//! QPS: quadratic programs over boxes, an extension of the MPS format of linear programming.
//!
//! Defined by Maros & Mészáros, *A Repository of Convex Quadratic Programming Problems* (1999), the
//! section `QUADOBJ`, and by current solvers (CPLEX, Gurobi, HiGHS), which add `QMATRIX`. Words are
//! separated by spaces ("free MPS"); columns are numbered in order of first appearance.
//!
//! ```text
//! NAME box                     min  ½ xᵀQx + cᵀx    with lo ≤ x ≤ hi
//! ROWS
//!  N obj                       the objective; no other rows
//! COLUMNS
//!  x0 obj -1                   c
//! RHS
//!  rhs obj 5                   minus a constant of the objective; ignored
//! BOUNDS
//!  UP bnd x0 4                 UP LO FX FR MI PL; the default is 0 ≤ x
//! QUADOBJ
//!  x0 x0 2                     Q: each entry of one triangle once
//! ENDATA
//! ```
//!
//! For symmetric Q, w = Q x + c is 0 at the minimum if it is inside the box, and points outward at
//! the sides of the box: A = Q, b = c. A problem can therefore be written if A is symmetric and no
//! row is coupled.
//!
//! Traps: Q contains the factor 2 of x² (the objective is *half* of xᵀQx). `QUADOBJ` is one
//! triangle and must not contain the other one, `QMATRIX` is all of Q. For a negative `UP` without
//! an `LO` some readers assume 0 ≤ x and others −∞: it is rejected. Bounds of 1e20 or more are
//! infinite, as in HiGHS and CPLEX. Constraint rows, integers and `OBJSENSE MAX` are rejected.

mod reader;
mod writer;

use super::Format;

/// Quadratic programs over boxes.
pub const FORMAT: Format = Format {
    name: "qps",
    about: "QPS: quadratic programs, over boxes only",
    endings: &[".qps", ".mps"],
    in_folder: None,
    beside: &[],
    carries: "any bounds, symmetric A, no friction; sparse",
    law: None,
    trap: "QUADOBJ is one triangle of Q, and the objective half of xᵀQx",
    read: reader::read,
    write: Some(writer::write),
};
