//! Properties of a problem before it is solved: its size, the class of A, rank and condition.

use dashu_ratio::RBig;
use serde::Serialize;

use lcplab_judge::regularity::regularity;
use lcplab_lcp::exact::dyadic::{dyadic, rational};
use lcplab_lcp::number::{counted, readable};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::MatrixClass;

/// Maximum number of rows for which the class is decided in exact arithmetic.
const EXACT_ROWS: usize = 40;
/// Maximum number of rows for which all principal minors are computed.
const MINORS_ROWS: usize = 8;
/// Maximum number of rows for which rank and condition are computed.
const MEASURED_ROWS: usize = 600;

/// The properties of a problem.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Card {
    /// The number of rows.
    pub rows: usize,
    /// The number of stored entries of A.
    pub stored: usize,
    /// The number of rows whose bounds depend on another row's x.
    pub coupled: usize,
    /// The number of rows without bounds: equations.
    pub equations: usize,
    /// The class of A, if it was decided.
    pub class: Option<String>,
    /// The rank of A, if it was computed.
    pub rank: Option<usize>,
    /// The condition number of the independent rows, after scaling to a unit diagonal.
    pub condition: Option<f64>,
}

impl Card {
    /// The properties of this problem.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_analysis::card::Card;
    ///
    /// let a = Matrix::dense(2, &[2.0, 2.0, 2.0, 2.0]);
    /// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let card = Card::of(&lcp);
    /// assert_eq!(card.rank, Some(1));
    /// assert_eq!(card.class.as_deref(), Some("symmetric positive semidefinite"));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn of(lcp: &Lcp) -> Card {
        let n = lcp.len();
        let is_equation = |&i: &usize| {
            !lcp.is_coupled(i) && lcp.lo()[i].is_infinite() && lcp.hi()[i].is_infinite()
        };
        let measured = (n <= MEASURED_ROWS).then(|| regularity(lcp.matrix())).flatten();
        Card {
            rows: n,
            stored: lcp.matrix().stored(),
            coupled: (0..n).filter(|&i| lcp.is_coupled(i)).count(),
            equations: (0..n).filter(is_equation).count(),
            class: class_of(lcp.matrix()).map(|class| class.to_string()),
            rank: measured.as_ref().map(|measured| measured.rank),
            condition: measured.map(|measured| measured.condition),
        }
    }

    /// The properties as a sentence.
    pub(crate) fn words(&self) -> String {
        let mut words = counted(self.rows, "row");
        if self.coupled > 0 {
            words += &format!(", {} of them coupled", self.coupled);
        }
        if self.equations > 0 {
            words += &format!(", {} of them without bounds", self.equations);
        }
        match self.class.as_deref() {
            None => {}
            Some("any") => words += "; A belongs to no class with a theorem about solutions",
            Some(class) => words += &format!("; A is {class}"),
        }
        if let (Some(rank), Some(condition)) = (self.rank, self.condition) {
            words += &format!(
                ", of rank {rank}, condition {} (scaled to unit diagonal)",
                readable(condition, 2)
            );
        }
        words
    }
}

/// The narrowest class that A belongs to, decided in exact arithmetic; [`MatrixClass::General`]
/// means none of definite, semidefinite and P. `None` if A is too large to decide.
pub(crate) fn class_of(a: &Matrix) -> Option<MatrixClass> {
    let n = a.len();
    if n > EXACT_ROWS {
        return None;
    }
    let exact = exact(a, &(0..n).collect::<Vec<_>>());
    if a.is_symmetric() {
        let class = match pivots(exact) {
            Some(0) => MatrixClass::Definite,
            Some(_) => MatrixClass::Semidefinite,
            // A symmetric P-matrix is definite.
            None => MatrixClass::General,
        };
        return Some(class);
    }
    let is_p = || {
        (1..1usize << n).all(|chosen| {
            let rows: Vec<usize> = (0..n).filter(|i| chosen >> i & 1 == 1).collect();
            determinant(self::exact(a, &rows)) > RBig::ZERO
        })
    };
    (n <= MINORS_ROWS).then(|| if is_p() { MatrixClass::P } else { MatrixClass::General })
}

/// These rows and columns of A as fractions.
fn exact(a: &Matrix, rows: &[usize]) -> Vec<Vec<RBig>> {
    let row = |&i: &usize| rows.iter().map(|&j| rational(&dyadic(a.entry(i, j)))).collect();
    rows.iter().map(row).collect()
}

/// The number of zero pivots in symmetric elimination of a symmetric A whose other pivots are
/// positive; `None` if A is not semidefinite.
fn pivots(mut a: Vec<Vec<RBig>>) -> Option<usize> {
    let n = a.len();
    let mut zeros = 0;
    for k in 0..n {
        if a[k][k] < RBig::ZERO {
            return None;
        }
        if a[k][k] == RBig::ZERO {
            if a[k][k..].iter().any(|entry| *entry != RBig::ZERO) {
                return None;
            }
            zeros += 1;
            continue;
        }
        eliminate(&mut a, k);
    }
    Some(zeros)
}

/// Row operations that clear column k below the pivot.
fn eliminate(a: &mut [Vec<RBig>], k: usize) {
    let (above, below) = a.split_at_mut(k + 1);
    let pivot = &above[k];
    for row in below {
        let factor = &row[k] / &pivot[k];
        if factor != RBig::ZERO {
            for (entry, above) in row[k..].iter_mut().zip(&pivot[k..]) {
                *entry = &*entry - &factor * above;
            }
        }
    }
}

fn determinant(mut a: Vec<Vec<RBig>>) -> RBig {
    let n = a.len();
    let mut product = RBig::ONE;
    for k in 0..n {
        let Some(row) = (k..n).find(|&row| a[row][k] != RBig::ZERO) else { return RBig::ZERO };
        if row != k {
            a.swap(row, k);
            product = -product;
        }
        product *= &a[k][k];
        eliminate(&mut a, k);
    }
    product
}
