//! Newton methods: complementarity as equations, with a linear system in each step.
//!
//! The equations are not smooth: min(x, w) = 0 or Fischer-Burmeister ([`equations`]). Newton's
//! method solves them in a few steps ([`semismooth`]). [`interior_point`] smooths the corner and
//! reduces the smoothing to zero. [`cone`] solves the equations of friction cones.

pub mod cone;
pub mod equations;
pub mod interior_point;
pub mod semismooth;

pub use cone::ConeNewton;
pub use equations::Equations;
pub use interior_point::InteriorPoint;
pub use semismooth::Newton;

use std::borrow::Cow;

use crate::entry::Build;
use crate::{Class, Cost, Entry, Event, Group, MatrixClass, Options, Solver};

/// The class of the methods that divide by the diagonal of A.
const CLASS: Class = Class::of(MatrixClass::Semidefinite).with_positive_diagonal();
/// A step by Cholesky, used for symmetric A; or a sweep, if the method takes one.
const CHOLESKY: Cost =
    Cost::each("n³/6 + 2 s, and s + n where it takes a sweep", |i| match i.event {
        Event::Step => i.n.powi(3) / 6.0 + 2.0 * i.stored,
        _ => i.stored + i.n,
    });
/// A least-squares step; or a sweep, if the method takes one.
const LEAST_SQUARES: Cost =
    Cost::each("5/3 n³, and s + n where it takes a sweep", |i| match i.event {
        Event::Step => 5.0 / 3.0 * i.n.powi(3),
        _ => i.stored + i.n,
    });

/// The methods of this group.
pub(crate) static ENTRIES: &[Entry] = &[
    Entry {
        name: Cow::Borrowed(Newton::NAME),
        method: "Newton on the minimum map with a watchdog and line search, iterative",
        class: CLASS,
        group: Group::Newton,
        cost: CHOLESKY,
        source: "Pang 1990; Qi & Sun 1993",
        uses: &[],
        build: Build::Function(|options| newton(Equations::MinimumMap, options)),
    },
    Entry {
        name: Cow::Borrowed(Newton::FISCHER_BURMEISTER),
        method: "Newton on the Fischer-Burmeister equations with line search, iterative",
        class: Class::of(MatrixClass::P0).with_positive_diagonal(),
        group: Group::Newton,
        cost: LEAST_SQUARES,
        source: "Fischer 1992; De Luca, Facchinei & Kanzow 1996",
        uses: &[],
        build: Build::Function(|options| newton(Equations::FischerBurmeister, options)),
    },
    Entry {
        name: Cow::Borrowed(InteriorPoint::NAME),
        method: "primal-dual interior point, predictor-corrector, iterative",
        class: CLASS,
        group: Group::Newton,
        cost: Cost::each("n³/6 + 2 n² + s", |i| i.n.powi(3) / 6.0 + 2.0 * i.n * i.n + i.stored),
        source: "Mehrotra 1992",
        uses: &[],
        build: Build::Function(|options| {
            Box::new(InteriorPoint { settings: options.settings.clone() })
        }),
    },
];

fn newton(equations: Equations, options: &Options) -> Box<dyn Solver> {
    Box::new(Newton { equations, settings: options.settings.clone() })
}
