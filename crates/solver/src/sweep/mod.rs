//! Splitting methods: solve row i for x_i with the others fixed, clamp, continue with the next row.
//!
//! A sweep is cheap, can be interrupted at any time, and can start from the last step's answer. But
//! information moves one row at a time, so tall stacks and large mass ratios need thousands of
//! sweeps ([`theory`](crate::theory) predicts how many). [`pgs`] includes SOR, symmetric SOR and
//! colored orders, by [`order`]; [`code6`] is the chapter's listing as printed, which is a
//! different method. For friction: [`polygon_pgs`] and [`cone_pgs`], which update contact by
//! contact.

pub mod block_pgs;
pub mod code6;
pub mod cone_pgs;
pub mod jacobi;
pub mod order;
pub mod pgs;
pub mod polygon_pgs;

pub use block_pgs::BlockPgs;
pub use code6::Code6;
pub use cone_pgs::ConePgs;
pub use jacobi::{Damping, Jacobi};
pub use order::Order;
pub use pgs::Pgs;
pub use polygon_pgs::PolygonPgs;

use std::borrow::Cow;

use crate::entry::Build;
use crate::{Choice, Class, Cost, Entry, Group, MatrixClass, Options, Solver};

/// The class of the methods that divide by the diagonal of A.
const CLASS: Class = Class::of(MatrixClass::Semidefinite).with_positive_diagonal();
/// A product A x and n divisions.
const SWEEP: Cost = Cost::each("s + n", |i| i.stored + i.n);

/// The methods of this group.
pub(crate) static ENTRIES: &[Entry] = &[
    Entry {
        name: Cow::Borrowed(Pgs::NAME),
        method: "projected Gauss-Seidel, iterative",
        class: CLASS,
        group: Group::Sweeps,
        cost: SWEEP,
        source: "K&M (2), (3); Cryer 1971",
        uses: &[Choice::Order],
        build: Build::Function(|options| relaxation(1.0, options.order, options)),
    },
    Entry {
        name: Cow::Borrowed(Pgs::RELAXED),
        method: "projected successive over-relaxation, 0 < ω < 2, iterative",
        class: CLASS,
        group: Group::Sweeps,
        cost: SWEEP,
        source: "Cryer 1971; Luo & Tseng 1991",
        uses: &[Choice::Omega, Choice::Order],
        build: Build::Function(|options| relaxation(options.omega, options.order, options)),
    },
    Entry {
        name: Cow::Borrowed(Pgs::SYMMETRIC),
        method: "projected symmetric SOR, sweeps forward and backward, 0 < ω < 2, iterative",
        class: CLASS,
        group: Group::Sweeps,
        cost: Cost::each("2 (s + n)", |i| 2.0 * (i.stored + i.n)),
        source: "Sheldon 1955; Mangasarian 1977",
        uses: &[Choice::Omega],
        build: Build::Function(|options| relaxation(options.omega, Order::Symmetric, options)),
    },
    Entry {
        name: Cow::Borrowed(Pgs::COLORED),
        method: "projected Gauss-Seidel, color by color, iterative",
        class: CLASS,
        group: Group::Sweeps,
        cost: SWEEP,
        source: "Young 1950",
        uses: &[],
        build: Build::Function(|options| relaxation(1.0, Order::Colored, options)),
    },
    Entry {
        name: Cow::Borrowed(Jacobi::NAME),
        method: "projected Jacobi, with safe damping by default, iterative",
        class: CLASS,
        group: Group::Sweeps,
        cost: SWEEP,
        source: "Goldstein 1964; Mangasarian 1977",
        uses: &[Choice::Damping],
        build: Build::Function(|options| {
            Box::new(Jacobi { damping: options.damping, settings: options.settings.clone() })
        }),
    },
    Entry {
        name: Cow::Borrowed(BlockPgs::NAME),
        method: "projected Gauss-Seidel by contacts and joints, iterative",
        class: Class::of(MatrixClass::Semidefinite),
        group: Group::Sweeps,
        cost: Cost::each("s + 10 n", |i| i.stored + 10.0 * i.n),
        source: "Luo & Tseng 1992",
        uses: &[],
        build: Build::Function(|options| {
            Box::new(BlockPgs { settings: options.settings.clone(), ..BlockPgs::default() })
        }),
    },
];

/// Known-wrong variants, kept for comparison with the correct methods.
pub static KNOWN_WRONG: &[Entry] = &[Entry {
    name: Cow::Borrowed(Code6::NAME),
    method: "the chapter's Code 6: Gauss-Seidel, clamped after the whole sweep",
    class: Class { bounds: false, coupling: false, ..CLASS },
    group: Group::Sweeps,
    cost: SWEEP,
    source: "K&M Code 6, E06",
    uses: &[],
    build: Build::Function(|options| Box::new(Code6 { settings: options.settings.clone() })),
}];

fn relaxation(omega: f64, order: Order, options: &Options) -> Box<dyn Solver> {
    Box::new(Pgs { omega, order, settings: options.settings.clone() })
}
