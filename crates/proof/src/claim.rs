//! The claims of proofs, with the numbers that prove them.

use std::fmt;
use std::str::FromStr;

use dashu_int::IBig;
use dashu_int::ops::Gcd;
use dashu_ratio::RBig;

use lcplab_judge::cases::Tree;
use lcplab_judge::{Dependence, RowState, upper_bound};
use lcplab_lcp::error::Error;
use lcplab_lcp::friction::Model;

/// A claim about the problem with this hash.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix, Question};
/// use lcplab_proof::{Kind, exact_residual, prove, prove_kind};
///
/// // w = 3 x − 1: x = 1/3 and no other.
/// let lcp = Lcp::new(Matrix::from([[3.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let question = Question::new(&Problem::new("a third", lcp.clone()), None, "third.json")?;
/// let found = prove(&question, &[1.0 / 3.0]);
/// assert_eq!(found.refusal(&question), None);
/// let proof = found.proof.expect("a proof");
/// assert_eq!(proof.claim.kind().name(), "unique");
/// assert!(!proof.sentence().is_empty());
/// // That there is no solution cannot be proved.
/// assert!(prove_kind(&question, &[1.0 / 3.0], Kind::NoSolution).proof.is_none());
///
/// // At x = ½, w is ½, of the terms 3/2 + 1.
/// let residual = exact_residual(&lcp, &[0.5]).unwrap();
/// assert_eq!(residual.rounded_up(), 0.2);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The [hash](crate::hash) of the problem.
    pub problem: String,
    /// The friction model of the problem; `None` stands for the coupled box, and for problems
    /// without friction.
    pub model: Option<Model>,
    /// The claim about it.
    pub claim: Claim,
}

impl Proof {
    /// The claim as a sentence, with the friction model if the proof states one.
    pub fn sentence(&self) -> String {
        let claim = self.claim.sentence();
        match self.model {
            Some(model) => format!("{claim}, under the friction model {model}"),
            None => claim,
        }
    }
}

/// A claim with its proof.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// x is a solution.
    Solution {
        /// The solution.
        x: Vector,
        /// A floating-point answer and its distance from x.
        near: Option<Near>,
    },
    /// A box contains a solution of a problem with friction cones.
    ConeSolution {
        /// The box.
        region: Region,
        /// A floating-point answer and its distance from every point of the box.
        near: Option<Near>,
    },
    /// The same for the exact numbers of the bodies; the last entries of the box are the motion.
    BodySolution {
        /// The box.
        region: Region,
        /// A floating-point answer and its distance from every x of the box.
        near: Option<Near>,
    },
    /// x is the only solution.
    Unique {
        /// The solution.
        x: Vector,
        /// Why there is no other.
        by: Reason,
    },
    /// There are at least two solutions.
    NotUnique {
        /// One solution.
        x: Vector,
        /// Another solution.
        y: Vector,
    },
    /// There is no solution.
    NoSolution {
        /// The case distinction; a vector excludes each case.
        tree: Tree,
    },
    /// The motion of an answer is close to the exact one.
    Motion(Bounded),
    /// The same if coupled rows have the bounds that the answer gives them.
    FrozenMotion(Bounded),
    /// The scaled residual of an answer is this fraction.
    Within {
        /// The answer.
        answer: Vec<f64>,
        /// Its scaled residual.
        residual: Fraction,
    },
}

impl Claim {
    /// Its kind.
    pub fn kind(&self) -> Kind {
        match self {
            Claim::Solution { .. } => Kind::Solution,
            Claim::ConeSolution { .. } => Kind::ConeSolution,
            Claim::BodySolution { .. } => Kind::BodySolution,
            Claim::Unique { .. } => Kind::Unique,
            Claim::NotUnique { .. } => Kind::NotUnique,
            Claim::NoSolution { .. } => Kind::NoSolution,
            Claim::Motion(_) => Kind::Motion,
            Claim::FrozenMotion(_) => Kind::FrozenMotion,
            Claim::Within { .. } => Kind::Within,
        }
    }

    /// The claim as a sentence.
    fn sentence(&self) -> String {
        match self {
            Claim::Solution { near: Some(near), .. } if near.distance == 0.0 => {
                "the answer is an exact solution".into()
            }
            Claim::Solution { near: Some(near), .. }
            | Claim::ConeSolution { near: Some(near), .. } => {
                let distance = upper_bound(near.distance);
                format!("an exact solution exists, and the answer lies within {distance} of it")
            }
            Claim::Solution { near: None, .. } | Claim::ConeSolution { near: None, .. } => {
                "an exact solution exists".into()
            }
            Claim::BodySolution { region, near } => {
                let change = match region.bias_change {
                    0.0 => String::new(),
                    change => {
                        format!(", with a bias that differs by at most {}", upper_bound(change))
                    }
                };
                let near = near.as_ref().map_or(String::new(), |near| {
                    format!(", and the answer lies within {} of it", upper_bound(near.distance))
                });
                format!(
                    "an exact solution exists for the exact numbers of the bodies{change}{near}"
                )
            }
            Claim::Unique { .. } => "exactly one solution exists".into(),
            Claim::NotUnique { .. } => "two different solutions exist".into(),
            Claim::NoSolution { tree } => match tree.leaves() {
                1 => "no solution exists, proved by a Farkas vector".into(),
                leaves => format!("no solution exists, proved in {leaves} cases"),
            },
            Claim::Motion(Bounded { bound, .. }) => {
                format!(
                    "the motion of the answer lies within {} of the exact one, in the norm √(uᵀM u)",
                    upper_bound(*bound)
                )
            }
            Claim::FrozenMotion(Bounded { bound, .. }) => format!(
                "with the friction limits of the answer, its motion lies within {} of the exact one, \
                 in the norm √(uᵀM u)",
                upper_bound(*bound)
            ),
            Claim::Within { residual, .. } => {
                let residual = upper_bound(residual.rounded_up());
                format!("the scaled residual of the answer is at most {residual}")
            }
        }
    }
}

/// The kinds of claims, strongest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Kind {
    /// There is no solution.
    NoSolution,
    /// There is exactly one solution.
    Unique,
    /// There are several solutions.
    NotUnique,
    /// There is at least one solution.
    Solution,
    /// There is a solution of a problem with friction cones, in a box.
    ConeSolution,
    /// There is a solution for the exact numbers of the bodies, in a box.
    BodySolution,
    /// A bound on the motion of an answer.
    Motion,
    /// The residual of an answer.
    Within,
    /// A bound on the motion under frozen friction, which proves nothing about the original
    /// problem.
    FrozenMotion,
}

impl Kind {
    /// All kinds, strongest first.
    pub const ALL: [Kind; 9] = [
        Kind::NoSolution,
        Kind::Unique,
        Kind::NotUnique,
        Kind::Solution,
        Kind::ConeSolution,
        Kind::BodySolution,
        Kind::Motion,
        Kind::Within,
        Kind::FrozenMotion,
    ];

    /// Its name in files.
    pub fn name(self) -> &'static str {
        match self {
            Kind::NoSolution => "no-solution",
            Kind::Unique => "unique",
            Kind::NotUnique => "not-unique",
            Kind::Solution => "solution",
            Kind::ConeSolution => "cone-solution",
            Kind::BodySolution => "body-solution",
            Kind::Motion => "motion",
            Kind::Within => "within",
            Kind::FrozenMotion => "frozen-motion",
        }
    }
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}

impl FromStr for Kind {
    type Err = Error;

    fn from_str(name: &str) -> Result<Kind, Error> {
        let kind = Kind::ALL.into_iter().find(|kind| kind.name() == name);
        kind.ok_or_else(|| {
            let names = Kind::ALL.map(Kind::name).join(", ");
            Error::invalid("options", "kind", format!("is {name:?}, must be one of {names}"))
        })
    }
}

/// An answer, and the proof of how far its motion is from the exact one.
#[derive(Debug, Clone, PartialEq)]
pub struct Bounded {
    /// The answer.
    pub answer: Vec<f64>,
    /// Forces inside their cones, of a problem under the associated law.
    pub force: Option<Vector>,
    /// A motion that satisfies all rows.
    pub motion: Motion,
    /// |u(answer) − û|_M is at most this; finite and nonnegative.
    pub bound: f64,
}

/// Velocities over a common denominator.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    /// Always positive.
    pub denominator: IBig,
    /// One entry per column of M.
    pub numerators: Vec<IBig>,
}

impl Motion {
    /// These velocities, with the smallest common denominator.
    ///
    /// ```
    /// use lcplab_proof::Motion;
    ///
    /// // (1/2, 2/3) m/s as integers over 6.
    /// let motion = Motion::of(&["1/2".parse().unwrap(), "2/3".parse().unwrap()]);
    /// assert_eq!(motion.denominator, 6.into());
    /// assert_eq!(motion.numerators, [3.into(), 4.into()]);
    /// ```
    pub fn of(entries: &[RBig]) -> Motion {
        let (numerators, denominator) = over_one_denominator(entries);
        Motion { denominator, numerators }
    }

    /// Each velocity as a fraction.
    pub(crate) fn entries(&self) -> Vec<RBig> {
        let denominator = RBig::from(self.denominator.clone());
        self.numerators.iter().map(|own| RBig::from(own.clone()) / &denominator).collect()
    }
}

/// The fractions as integers over their smallest common denominator.
pub fn over_one_denominator(x: &[RBig]) -> (Vec<IBig>, IBig) {
    let denominator = x.iter().fold(IBig::ONE, |common, x| {
        let own = IBig::from(x.denominator().clone());
        let shared = IBig::from((&common).gcd(&own));
        common * (own / shared)
    });
    let numerator = |x: &RBig| x.numerator() * (&denominator / IBig::from(x.denominator().clone()));
    (x.iter().map(numerator).collect(), denominator)
}

/// A box around an approximate solution of a cone problem, with what shows that it contains one.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// The state of each row.
    pub states: Vec<RowState>,
    /// The equations w = 0 that follow from others.
    pub redundant: Vec<Dependence>,
    /// How much the bias of redundant rows may differ from that of the bodies; finite and
    /// nonnegative.
    pub bias_change: f64,
    /// The center.
    pub center: Vector,
    /// The half-width of each row times the denominator of the center, never negative.
    pub radius: Vec<IBig>,
    /// An approximate inverse of the derivatives of the equations.
    pub inverse: Vec<Vec<f64>>,
}

/// A floating-point answer near an exact solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Near {
    /// The answer.
    pub answer: Vec<f64>,
    /// Upper bound on the distance of each entry; finite and nonnegative.
    pub distance: f64,
}

/// Why a solution is the only one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// A + Aᵀ is positive definite.
    Definite,
    /// All principal minors of A are positive.
    PMatrix,
}

/// An exact vector.
#[derive(Debug, Clone, PartialEq)]
pub struct Vector {
    /// Always positive.
    pub denominator: IBig,
    /// One entry per row.
    pub entries: Vec<Entry>,
}

/// An entry of an exact vector.
#[derive(Debug, Clone, PartialEq)]
pub enum Entry {
    /// This over the denominator.
    Numerator(IBig),
    /// The lower bound of its row.
    Lo,
    /// The upper bound of its row.
    Hi,
}

/// A nonnegative fraction of integers; the denominator is positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Fraction {
    /// The numerator.
    pub numerator: IBig,
    /// The denominator.
    pub denominator: IBig,
}

impl Fraction {
    /// The smallest `f64` that is at least the fraction.
    pub fn rounded_up(&self) -> f64 {
        use dashu_int::ops::UnsignedAbs;
        let (p, q) = (self.numerator.clone(), self.denominator.clone().unsigned_abs());
        lcplab_lcp::exact::rounded_up(&dashu_ratio::RBig::from_parts(p, q))
    }
}
