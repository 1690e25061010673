//! QPS: quadratic programs over boxes, an extension of the linear programmers' MPS.
//!
//! Defined by Maros & Mészáros, *A Repository of Convex Quadratic Programming Problems* (1999), the
//! section `QUADOBJ`, and by today's solvers (CPLEX, Gurobi, HiGHS), which add `QMATRIX`. Words are
//! separated by spaces ("free MPS"); columns are numbered as they first appear.
//!
//! ```text
//! NAME box                     min  ½ xᵀQx + cᵀx    with lo ≤ x ≤ hi
//! ROWS
//!  N obj                       the objective, and no row else
//! COLUMNS
//!  x0 obj -1                   c
//! RHS
//!  rhs obj 5                   minus a constant of the objective: no matter
//! BOUNDS
//!  UP bnd x0 4                 UP LO FX FR MI PL; 0 ≤ x where nothing is said
//! QUADOBJ
//!  x0 x0 2                     Q: each entry of one triangle once
//! ENDATA
//! ```
//!
//! For symmetric Q the minimum is where w = Q x + c is 0 inside the box and points outwards at its
//! sides: A = Q, b = c. So a problem can be written if A is symmetric and no row is coupled.
//!
//! Traps: Q already holds the 2 of x² (the objective is *half* of xᵀQx). `QUADOBJ` is one triangle
//! and must not hold the other one, `QMATRIX` is all of Q. An `UP` below 0 without an `LO` means 0
//! ≤ x for some readers and x free below for others: it is refused. Bounds from 1e20 on are
//! infinite, as HiGHS and CPLEX have it. Refused are rows of constraints, integers and `OBJSENSE
//! MAX`.

mod reader;
mod writer;

use super::Format;

/// Quadratic programs over boxes.
pub const FORMAT: Format = Format {
    name: "qps",
    about: "QPS: convex programmers' quadratic programs, over boxes only",
    endings: &[".qps", ".mps"],
    in_folder: None,
    beside: &[],
    carries: "any bounds, symmetric A, no friction; sparse",
    law: None,
    trap: "QUADOBJ is one triangle of Q, and the objective half of xᵀQx",
    read: reader::read,
    write: Some(writer::write),
};
