//! What a proof claims, with the numbers that show it.

use dashu_int::IBig;

use lcplab_judge::upper_bound;

/// A claim about the problem with this hash.
#[derive(Debug, Clone, PartialEq)]
pub struct Proof {
    /// The [hash](crate::hash) of the problem.
    pub problem: String,
    /// What is claimed of it.
    pub claim: Claim,
}

/// What is claimed, with what shows it.
#[derive(Debug, Clone, PartialEq)]
pub enum Claim {
    /// x is a solution.
    Solution {
        /// It.
        x: Vector,
        /// An answer in floating point, and how far it is from x.
        near: Option<Near>,
    },
    /// x is the only solution.
    Unique {
        /// It.
        x: Vector,
        /// Why there is no other.
        by: Reason,
    },
    /// There are at least two solutions.
    NotUnique {
        /// One.
        x: Vector,
        /// Another.
        y: Vector,
    },
    /// There is no solution.
    NoSolution {
        /// The ways that a solution could take, and what is wrong at the end of each.
        tree: Tree,
    },
    /// The scaled residual of an answer is this fraction.
    Within {
        /// The answer.
        answer: Vec<f64>,
        /// Its scaled residual.
        residual: Fraction,
    },
}

impl Claim {
    /// The name of its kind in files.
    pub fn kind(&self) -> &'static str {
        match self {
            Claim::Solution { .. } => "solution",
            Claim::Unique { .. } => "unique",
            Claim::NotUnique { .. } => "not-unique",
            Claim::NoSolution { .. } => "no-solution",
            Claim::Within { .. } => "within",
        }
    }

    /// The claim in a sentence.
    pub fn sentence(&self) -> String {
        match self {
            Claim::Solution { near: Some(near), .. } => {
                let distance = upper_bound(near.distance);
                format!("an exact solution exists, and the answer lies within {distance} of it")
            }
            Claim::Solution { near: None, .. } => "an exact solution exists".into(),
            Claim::Unique { .. } => "exactly one solution exists".into(),
            Claim::NotUnique { .. } => "two different solutions exist".into(),
            Claim::NoSolution { tree } => match tree.leaves() {
                1 => "no solution exists, by one vector".into(),
                leaves => format!("no solution exists, in {leaves} cases"),
            },
            Claim::Within { residual, .. } => {
                let residual = upper_bound(residual.rounded_up());
                format!("the scaled residual of the answer is at most {residual}")
            }
        }
    }
}

/// An answer in floating point near an exact solution.
#[derive(Debug, Clone, PartialEq)]
pub struct Near {
    /// The answer.
    pub answer: Vec<f64>,
    /// No entry is farther from the solution's.
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
    /// Positive.
    pub denominator: IBig,
    /// An entry a row.
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

/// The ways that a solution could take.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    /// The end of one: the entries of a vector d other than 0.
    Leaf(Vec<(usize, IBig)>),
    /// The sides on which a row can be; none where the bound is infinite.
    Branch {
        /// The row.
        row: usize,
        /// x at the lower bound, w ≥ 0.
        lo: Option<Box<Tree>>,
        /// w = 0.
        free: Box<Tree>,
        /// x at the upper bound, w ≤ 0.
        hi: Option<Box<Tree>>,
    },
}

impl Tree {
    /// How many ways there are.
    pub fn leaves(&self) -> usize {
        match self {
            Tree::Leaf(_) => 1,
            Tree::Branch { lo, free, hi, .. } => {
                let sides = [lo.as_ref(), Some(free), hi.as_ref()];
                sides.into_iter().flatten().map(|tree| tree.leaves()).sum()
            }
        }
    }
}

/// A fraction of integers; the denominator is positive.
#[derive(Debug, Clone, PartialEq)]
pub struct Fraction {
    /// Above the line.
    pub numerator: IBig,
    /// Below it.
    pub denominator: IBig,
}

impl Fraction {
    /// The least floating-point number that is not below it.
    pub fn rounded_up(&self) -> f64 {
        use dashu_int::ops::UnsignedAbs;
        let (p, q) = (self.numerator.clone(), self.denominator.clone().unsigned_abs());
        lcplab_problem::exact::rounded_up(&dashu_ratio::RBig::from_parts(p, q))
    }
}
