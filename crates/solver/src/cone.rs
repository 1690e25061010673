//! Methods for circular friction cones, with their own trait.
//!
//! They differ from box solvers only in the feasible set: they project onto a cone instead of an
//! interval. Under [`Law::Associated`] both are descent methods for the same convex problem. Under
//! [`Law::Coulomb`] one freezes the De Saxcé shift, the other updates it in every sweep.

use std::borrow::Cow;
use std::fmt;

use super::entry::Build;
use super::{Apgd, Class, ConePgs, Group, MatrixClass, Observer, Settings, Solution, Start};
use lcplab_lcp::friction::{ConeProblem, Law};

/// A method that solves friction problems with circular cones.
///
/// ```
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{ConePgs, ConeSolver, Start, Status};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s; μ = 0.5.
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let solver = ConePgs::default();
/// assert_eq!(solver.name(), "cone-pgs");
/// let solution =
///     solver.solve(&ConeProblem::new(friction, Law::Coulomb), &Start::default(), &mut ());
/// assert_eq!(solution.status, Status::Solved);
/// for (x, expected) in solution.x.iter().zip([2.0, 1.0, 0.0]) {
///     assert!((x - expected).abs() < 1e-7); // N s: the weight, and μ times it
/// }
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait ConeSolver: Send + Sync {
    /// The name in the registry.
    fn name(&self) -> &str;

    /// Solves the problem from a start and reports each iterate to the observer. Returns `Solved`
    /// only if the scaled residual
    /// ([`Complementarity::scaled_residual`](lcplab_lcp::Complementarity::scaled_residual)) is
    /// within the tolerance.
    fn solve(
        &self,
        problem: &ConeProblem,
        start: &Start<'_>,
        observer: &mut dyn Observer,
    ) -> Solution;
}

/// A cone solver in the registry.
///
/// ```
/// use lcplab_lcp::friction::Law;
/// use lcplab_solver::{Apgd, ConeEntry, Settings};
///
/// let laws = vec![Law::Associated];
/// let entry =
///     ConeEntry::new("mine", laws, |settings| Box::new(Apgd { settings: settings.clone() }));
/// assert_eq!(entry.laws.as_ref(), [Law::Associated]);
/// assert_eq!(entry.build(&Settings::default()).name(), "apgd");
/// ```
#[derive(Clone)]
#[non_exhaustive]
pub struct ConeEntry {
    /// The name that selects it.
    pub name: Cow<'static, str>,
    /// A one-line description of the method.
    pub method: &'static str,
    /// The class of A that it is made for.
    pub class: Class,
    /// The friction laws that it supports.
    pub laws: Cow<'static, [Law]>,
    /// What kind of method it is.
    pub group: Group,
    /// The source of the method.
    pub source: &'static str,
    /// Builds the solver.
    pub(crate) build: Build<Settings, dyn ConeSolver>,
}

impl ConeEntry {
    /// A solver for any A under these friction laws that is no method of this crate. Change the
    /// other fields as needed.
    pub fn new(
        name: impl Into<Cow<'static, str>>,
        laws: impl Into<Cow<'static, [Law]>>,
        build: impl Fn(&Settings) -> Box<dyn ConeSolver> + Send + Sync + 'static,
    ) -> Self {
        ConeEntry {
            name: name.into(),
            method: "a user's solver",
            class: Class::of(MatrixClass::General),
            laws: laws.into(),
            group: Group::Plugin,
            source: "the user",
            build: Build::of(build),
        }
    }

    /// Builds the solver with these settings, which [`Settings::validate`] accepts.
    pub fn build(&self, settings: &Settings) -> Box<dyn ConeSolver> {
        self.build.call(settings)
    }
}

impl fmt::Debug for ConeEntry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let ConeEntry { name, class, laws, .. } = self;
        f.debug_struct("ConeEntry")
            .field("name", name)
            .field("class", class)
            .field("laws", laws)
            .finish()
    }
}

/// Both laws.
const BOTH: Cow<'static, [Law]> = Cow::Borrowed(&[Law::Associated, Law::Coulomb]);

/// The cone solvers of this crate.
pub(crate) static CONES: &[ConeEntry] = &[
    ConeEntry {
        name: Cow::Borrowed(ConePgs::NAME),
        method: "projected Gauss-Seidel by contacts, iterative",
        class: Class::of(MatrixClass::Semidefinite),
        laws: BOTH,
        group: Group::Sweeps,
        source: "De Saxcé & Feng 1991; Tasora & Anitescu 2011",
        build: Build::Function(|settings| Box::new(ConePgs { settings: settings.clone() })),
    },
    ConeEntry {
        name: Cow::Borrowed(Apgd::NAME),
        method: "accelerated projected gradients with restart, De Saxcé's shift updated between solves, iterative",
        class: Class::of(MatrixClass::Semidefinite).with_positive_diagonal(),
        laws: BOTH,
        group: Group::FirstOrder,
        source: "Mazhar, Heyn, Negrut & Tasora 2015; Acary, Cadoux, Lemaréchal & Malick 2011",
        build: Build::Function(|settings| Box::new(Apgd { settings: settings.clone() })),
    },
];
