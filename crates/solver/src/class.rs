//! The problem class that each method is made for, as data.

use std::fmt;

use lcplab_lcp::error::{Error, Result};

/// Classes of matrices, with what LCP theory guarantees for each.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MatrixClass {
    /// Symmetric, all eigenvalues positive: one solution, the minimum of ½ xᵀAx + bᵀx in the box.
    Definite,
    /// Symmetric, no negative eigenvalue: the solutions are the minima of the same function; w is
    /// unique.
    Semidefinite,
    /// All principal minors positive: one solution for every b.
    P,
    /// [`MatrixClass::P`] or [`MatrixClass::Semidefinite`].
    POrSemidefinite,
    /// No principal minor negative.
    P0,
    /// xᵀAx ≥ 0 for all x ≥ 0, and (A + Aᵀ) x = 0 where equality holds: solvable if some x ≥ 0 has
    /// A x + b ≥ 0. Includes all positive semidefinite matrices, symmetric or not.
    CopositivePlus,
    /// Any square matrix.
    General,
}

impl MatrixClass {
    /// All classes.
    pub const ALL: [MatrixClass; 7] = [
        MatrixClass::Definite,
        MatrixClass::Semidefinite,
        MatrixClass::P,
        MatrixClass::POrSemidefinite,
        MatrixClass::P0,
        MatrixClass::CopositivePlus,
        MatrixClass::General,
    ];

    /// The name of the class in files.
    pub fn word(self) -> &'static str {
        match self {
            MatrixClass::Definite => "definite",
            MatrixClass::Semidefinite => "semidefinite",
            MatrixClass::P => "p",
            MatrixClass::POrSemidefinite => "p-or-semidefinite",
            MatrixClass::P0 => "p0",
            MatrixClass::CopositivePlus => "copositive-plus",
            MatrixClass::General => "general",
        }
    }

    /// The class with this [name](MatrixClass::word).
    ///
    /// # Errors
    /// If no class has this name.
    pub fn by_word(word: &str) -> Result<MatrixClass> {
        let found = MatrixClass::ALL.into_iter().find(|class| class.word() == word);
        found.ok_or_else(|| Error::Unknown {
            kind: "class of matrices",
            name: word.into(),
            known: MatrixClass::ALL.map(|class| class.word().into()).into(),
        })
    }
}

impl fmt::Display for MatrixClass {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            MatrixClass::Definite => "symmetric positive definite",
            MatrixClass::Semidefinite => "symmetric positive semidefinite",
            MatrixClass::P => "P-matrix",
            MatrixClass::POrSemidefinite => "P-matrix, or symmetric positive semidefinite",
            MatrixClass::P0 => "P0 matrix",
            MatrixClass::CopositivePlus => "copositive plus",
            MatrixClass::General => "any",
        })
    }
}

/// The problems that a method is made for.
///
/// On other problems the method may still find a solution, may fail, or may reject the problem
/// (`OutsideClass`). It never reports `Solved` for an x that is not a solution.
///
/// ```
/// use lcplab_solver::{Class, MatrixClass};
///
/// let class = Class::of(MatrixClass::by_word("semidefinite")?).with_positive_diagonal();
/// assert_eq!(class.to_string(), "symmetric positive semidefinite, positive diagonal");
/// assert_eq!(class.matrix.word(), "semidefinite");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Class {
    /// The class that A must belong to.
    pub matrix: MatrixClass,
    /// Whether the method divides by a_ii, which must then be positive.
    pub divides_by_diagonal: bool,
    /// Whether rows may have finite bounds.
    pub bounds: bool,
    /// Whether rows may have no finite bound.
    pub free_rows: bool,
    /// Whether rows may be bounded by ±μ times another row's x.
    pub coupling: bool,
}

impl Class {
    /// A class with this kind of matrix and all kinds of rows.
    pub const fn of(matrix: MatrixClass) -> Self {
        let divides_by_diagonal = false;
        Class { matrix, divides_by_diagonal, bounds: true, free_rows: true, coupling: true }
    }

    /// The same class for a method that divides by a_ii.
    pub const fn with_positive_diagonal(self) -> Self {
        Class { divides_by_diagonal: true, ..self }
    }
}

impl fmt::Display for Class {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.matrix)?;
        for (remark, applies) in [
            (", positive diagonal", self.divides_by_diagonal),
            (", equations only", !self.bounds),
            (", no free rows", !self.free_rows),
            (", no coupled rows", !self.coupling),
        ] {
            if applies {
                f.write_str(remark)?;
            }
        }
        Ok(())
    }
}
