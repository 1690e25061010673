//! Pivoting methods: a solution is determined by which rows are at which bound.
//!
//! These methods guess that active set, find a row that violates its conditions, and exchange it.
//! They end after finitely many exchanges with an answer that is exact up to rounding, or with a
//! [ray](crate::Status::Ray). [`dantzig`] is for symmetric semidefinite A, [`lemke`] for many more,
//! [`murty`] and [`block_pivoting`] for P-matrices, [`enumeration`] for small problems of any kind.
//! In the worst case they need 2ⁿ exchanges, but contacts are far from the worst case.

pub(crate) mod active_set;
mod basic;
pub mod block_pivoting;
pub mod dantzig;
mod dictionary;
pub mod enumeration;
pub(crate) mod free_rows;
pub mod lemke;
pub mod murty;
mod opening;
mod principal;
pub(crate) mod proximal;
mod ratio_test;
mod refinement;
mod standard_form;
mod variable;

pub use block_pivoting::BlockPivoting;
pub use dantzig::{Dantzig, Side};
pub use enumeration::Enumeration;
pub use lemke::Lemke;
pub use murty::Murty;
pub use variable::Variable;

use std::borrow::Cow;

use crate::entry::Build;
use crate::{Class, Cost, Effort, Entry, Group, MatrixClass};

/// One factorization of the free rows per exchange, and one for the first active set; an upper
/// bound if A is symmetric.
const ACTIVE_SET: Cost = Cost {
    formula: "f³/3 + f² + s, and once before the first",
    start: factorization,
    iteration: factorization,
};

fn factorization(i: &Effort<'_>) -> f64 {
    let f = i.free();
    f.powi(3) / 3.0 + f * f + i.stored
}

/// All entries of a table with the covering variable and the constants, or of a triangle of it.
fn lemke_pivot(i: &Effort<'_>) -> f64 {
    let table = i.n * (i.n + 2.0);
    if i.is_symmetric() { table / 2.0 } else { table }
}

/// The methods of this group.
pub(crate) static ENTRIES: &[Entry] = &[
    Entry {
        name: Cow::Borrowed(Dantzig::NAME),
        method: "Dantzig pivoting with updated LDLᵀ, finite",
        class: Class::of(MatrixClass::Semidefinite),
        group: Group::Pivoting,
        cost: Cost::each("n²/2", |i| i.n * i.n / 2.0),
        source: "Cottle & Dantzig 1968; Baraff 1994",
        uses: &[],
        build: Build::Function(|options| Box::new(Dantzig { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(Lemke::NAME),
        method: "Lemke's complementary pivoting, lexicographic ties, finite",
        class: Class::of(MatrixClass::CopositivePlus),
        group: Group::Pivoting,
        cost: Cost {
            formula: "n (n + 2), half of it where A is symmetric, and once for each row without bounds",
            start: |i| i.free() * lemke_pivot(i),
            iteration: lemke_pivot,
        },
        source: "Lemke 1965; Cottle, Pang & Stone 1992",
        uses: &[],
        build: Build::Function(|options| Box::new(Lemke { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(Murty::NAME),
        method: "least-index principal pivoting, finite",
        class: Class::of(MatrixClass::P),
        group: Group::Pivoting,
        cost: ACTIVE_SET,
        source: "Murty 1974",
        uses: &[],
        build: Build::Function(|options| Box::new(Murty { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(BlockPivoting::NAME),
        method: "block principal pivoting, then Murty's rule (finite) or proximal steps",
        class: Class::of(MatrixClass::POrSemidefinite),
        group: Group::Pivoting,
        cost: Cost {
            formula: "f³/3 + f² + s, and once before the first with 3 s more for the sweeps",
            start: |i| factorization(i) + 3.0 * i.stored,
            iteration: factorization,
        },
        source: "Kostreva 1978; Júdice & Pires 1994",
        uses: &[],
        build: Build::Function(|options| {
            let settings = options.settings.clone();
            Box::new(BlockPivoting { settings, ..BlockPivoting::default() })
        }),
    },
    Entry {
        name: Cow::Borrowed(Enumeration::NAME),
        method: "up to 65,536 active sets in exact arithmetic, finite",
        class: Class::of(MatrixClass::General),
        group: Group::Pivoting,
        cost: Cost::each("n³/3, of fractions", |i| i.n.powi(3) / 3.0),
        source: "the definition of a solution",
        uses: &[],
        build: Build::Function(|options| {
            Box::new(Enumeration { settings: options.settings.clone() })
        }),
    },
];
