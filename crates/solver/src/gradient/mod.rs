//! First-order methods, which use only products with A.
//!
//! For symmetric semidefinite A the problem is a minimization over a box, and any method for that
//! can be used: accelerated and spectral gradients ([`apgd`], [`spectral`]), conjugate gradients
//! with bounds ([`mprgp`], [`nncg`]), mixed sweeps ([`anderson`]), operator splitting ([`admm`]).
//! They need far fewer products than sweep methods need sweeps.

pub mod admm;
pub mod anderson;
pub mod apgd;
pub mod mprgp;
pub mod nncg;
pub mod spectral;

pub use admm::Admm;
pub use anderson::AndersonPgs;
pub use apgd::Apgd;
pub use mprgp::Mprgp;
pub use nncg::Nncg;
pub use spectral::Spectral;

use std::borrow::Cow;

use crate::entry::Build;
use crate::{Class, Cost, Entry, Group, MatrixClass};

/// The class of problems for these methods.
const CLASS: Class = Class::of(MatrixClass::Semidefinite).with_positive_diagonal();
/// Two products with A and the vector operations.
const PRODUCTS: Cost = Cost::each("2 s + 5 n", |i| 2.0 * i.stored + 5.0 * i.n);

/// The methods of this group.
pub(crate) static ENTRIES: &[Entry] = &[
    Entry {
        name: Cow::Borrowed(Nncg::NAME),
        method: "nonsmooth nonlinear conjugate gradients around PGS, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: Cost::each("s + 5 n", |i| i.stored + 5.0 * i.n),
        source: "Silcowitz, Niebe & Erleben 2010",
        uses: &[],
        build: Build::Function(|options| Box::new(Nncg { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(AndersonPgs::NAME),
        method: "PGS with Anderson acceleration over five sweeps, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: Cost::each("3 s + 35 n", |i| 3.0 * i.stored + 35.0 * i.n),
        source: "Anderson 1965; Walker & Ni 2011",
        uses: &[],
        build: Build::Function(|options| {
            Box::new(AndersonPgs { settings: options.settings.clone() })
        }),
    },
    Entry {
        name: Cow::Borrowed(Mprgp::NAME),
        method: "projected conjugate gradients with proportioning, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: PRODUCTS,
        source: "Dostál & Schöberl 2005",
        uses: &[],
        build: Build::Function(|options| Box::new(Mprgp { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(Apgd::NAME),
        method: "accelerated projected gradients with restart, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: PRODUCTS,
        source: "Nesterov 1983; Mazhar, Heyn, Negrut & Tasora 2015",
        uses: &[],
        build: Build::Function(|options| Box::new(Apgd { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(Spectral::NAME),
        method: "projected gradients with Barzilai-Borwein steps, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: PRODUCTS,
        source: "Barzilai & Borwein 1988; Birgin, Martínez & Raydan 2000",
        uses: &[],
        build: Build::Function(|options| Box::new(Spectral { settings: options.settings.clone() })),
    },
    Entry {
        name: Cow::Borrowed(Admm::NAME),
        method: "alternating direction method of multipliers, iterative",
        class: CLASS,
        group: Group::FirstOrder,
        cost: Cost {
            formula: "n², and n³/6 before the first",
            start: |i| i.n.powi(3) / 6.0,
            iteration: |i| i.n * i.n,
        },
        source: "Stellato, Banjac, Goulart, Bemporad & Boyd 2020",
        uses: &[],
        build: Build::Function(|options| {
            Box::new(Admm { settings: options.settings.clone(), ..Admm::default() })
        }),
    },
];
