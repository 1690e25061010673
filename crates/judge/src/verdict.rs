//! The verdict on an x, and the printing of its bounds.

use lcplab_lcp::number::{readable, superscript};

/// The judge's decision about x.
///
/// ```
/// use lcplab_judge::{Demand, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let exact = judge(&lcp, &[0.5], &Demand::default()).verdict;
/// assert_eq!((exact.word(), exact.distance()), ("proved", Some(0.0)));
/// let near = judge(&lcp, &[0.5], &Demand { prove_up_to: 0, ..Demand::default() }).verdict;
/// assert_eq!((near.word(), near.distance()), ("within_tolerance", None));
/// let wrong = judge(&lcp, &[0.4], &Demand::default()).verdict;
/// assert_eq!(wrong.word(), "not_a_solution");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Verdict {
    /// x is within the tolerance, or differs from a solution only by rounding, and an exact
    /// solution was shown to exist this far from x (max norm, in the unit of x), at most 1e-6 of
    /// the largest entry of x.
    Proved {
        /// max_i |x_i − x*_i|, rounded up.
        distance: f64,
    },
    /// The scaled residual is at most the tolerance, x is at least ten times closer to a solution
    /// than x = 0, and no proof was found that there is no solution.
    WithinTolerance,
    /// x is not a solution.
    NotASolution {
        /// The row with the largest scaled residual.
        row: usize,
        /// That residual.
        amount: f64,
        /// Why x is rejected.
        why: Refusal,
    },
}

/// Why x is rejected.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// The residual is above the tolerance.
    Residual {
        /// The tolerance.
        tolerance: f64,
    },
    /// The residual is small compared with the terms of x, but the longest step |x_i − Π(x_i −
    /// w_i/s_i)| √s_i is more than a tenth of that at Π(0).
    NoBetterThanZero,
    /// The problem has no solution.
    Impossible,
    /// x is not a finite number in this row.
    NotFinite,
}

impl Verdict {
    /// Whether x counts as a solution.
    ///
    /// ```
    /// use lcplab_judge::{Demand, judge};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-2.0], vec![0.0], vec![f64::INFINITY])?;
    /// assert!(judge(&lcp, &[1.0], &Demand::default()).verdict.is_solution());
    /// assert!(!judge(&lcp, &[0.9], &Demand::default()).verdict.is_solution());
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn is_solution(&self) -> bool {
        match self {
            Verdict::Proved { .. } | Verdict::WithinTolerance => true,
            Verdict::NotASolution { .. } => false,
        }
    }

    /// The largest possible distance of an exact solution from x, if one was proved.
    pub fn distance(&self) -> Option<f64> {
        match self {
            Verdict::Proved { distance } => Some(*distance),
            _ => None,
        }
    }

    /// The verdict on a point at distance `away` from the point with this verdict; `None` if that
    /// one is rejected.
    pub(crate) fn of_point_at(self, away: f64) -> Option<Verdict> {
        match self {
            Verdict::Proved { distance } => {
                let distance = crate::interval::add_up(distance, away);
                Some(Verdict::Proved { distance })
            }
            Verdict::WithinTolerance => Some(Verdict::WithinTolerance),
            Verdict::NotASolution { .. } => None,
        }
    }

    /// The verdict on an x whose residual, which is largest in this row, is above the tolerance.
    pub(crate) fn rejected(x: &[f64], row: usize, amount: f64, tolerance: f64) -> Verdict {
        match x.iter().position(|x| !x.is_finite()) {
            Some(row) => Verdict::NotASolution { row, amount, why: Refusal::NotFinite },
            None => Verdict::NotASolution { row, amount, why: Refusal::Residual { tolerance } },
        }
    }

    /// The verdict once it is known that the problem has no solution. An x with a residual above
    /// the tolerance is still rejected for its residual.
    pub(crate) fn refused(self, row: usize, amount: f64) -> Verdict {
        let why = match self {
            Verdict::NotASolution { why: Refusal::NotFinite, .. } => return self,
            Verdict::NotASolution { why: why @ Refusal::Residual { .. }, .. } => why,
            _ => Refusal::Impossible,
        };
        Verdict::NotASolution { row, amount, why }
    }

    /// The word used in JSON, tables and plots.
    pub fn word(&self) -> &'static str {
        match self {
            Verdict::Proved { .. } => "proved",
            Verdict::WithinTolerance => "within_tolerance",
            Verdict::NotASolution { .. } => "not_a_solution",
        }
    }
}

impl std::fmt::Display for Verdict {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Verdict::Proved { distance: 0.0 } => write!(f, "proved: x is an exact solution"),
            Verdict::Proved { distance } => {
                let distance = upper_bound(*distance);
                write!(f, "proved: an exact solution exists within {distance} of x")
            }
            Verdict::WithinTolerance => write!(f, "within tolerance"),
            Verdict::NotASolution { row, amount, why: Refusal::Residual { tolerance } } => {
                let [amount, tolerance] = [*amount, *tolerance].map(|number| readable(number, 2));
                write!(
                    f,
                    "not a solution: scaled residual {amount} in row {row}, above the tolerance {tolerance}"
                )
            }
            Verdict::NotASolution { row, why: Refusal::NotFinite, .. } => {
                write!(f, "not a solution: x[{row}] is not a finite number")
            }
            Verdict::NotASolution { why: Refusal::NoBetterThanZero, .. } => {
                write!(
                    f,
                    "not a solution: the residual is small compared with the terms of x, but the longest \
                     projected step is more than a tenth of the one at x = 0, and no exact solution \
                     was found near x"
                )
            }
            Verdict::NotASolution { why: Refusal::Impossible, .. } => {
                write!(f, "not a solution: no solution exists")
            }
        }
    }
}

/// A bound with two digits, rounded up: 1.04×10⁻⁹ gives `1.1×10⁻⁹`.
///
/// ```
/// use lcplab_judge::upper_bound;
///
/// assert_eq!(upper_bound(1.04e-9), "1.1×10⁻⁹");
/// assert_eq!(upper_bound(9.96e3), "10,000");
/// assert_eq!(upper_bound(0.25), "0.25"); // exact
/// assert_eq!(upper_bound(f64::from_bits(1)), "5.0×10⁻³²⁴"); // 4.94…×10⁻³²⁴
/// ```
pub fn upper_bound(bound: f64) -> String {
    if bound == 0.0 || !bound.is_finite() {
        return format!("{bound}");
    }
    // All digits of the number.
    let all = format!("{bound:.800e}");
    let (digits, exponent) = all.split_once('e').expect("an exponent");
    let (two, rest) = digits.split_at(3);
    let exponent: i32 = exponent.parse().expect("a whole number");
    let tens: u32 = two.replace('.', "").parse().expect("two digits");
    let is_exact = rest.bytes().all(|digit| digit == b'0');
    let (tens, exponent) = match tens + u32::from(!is_exact) {
        100 => (10, exponent + 1),
        tens => (tens, exponent),
    };
    match (-3..5).contains(&exponent) {
        true => readable(f64::from(tens) * 10f64.powi(exponent - 1), 2),
        false => format!("{}.{}×10{}", tens / 10, tens % 10, superscript(exponent)),
    }
}

/// A number whose shortest decimal form is at least the bound, read as an exact decimal.
///
/// ```
/// use lcplab_judge::printed_up;
///
/// assert_eq!(printed_up(0.25), 0.25); // printed as it is
/// // The number nearest to 0.1 lies above 0.1, so "0.1" would be less than the bound.
/// assert_eq!(printed_up(0.1), 0.1_f64.next_up());
/// ```
pub fn printed_up(bound: f64) -> f64 {
    let (shown, all) = (format!("{bound:e}"), format!("{bound:.800e}"));
    let parts = |text: &str| {
        let (digits, exponent) = text.split_once('e').unwrap_or((text, "0"));
        let digits: String = digits.chars().filter(char::is_ascii_digit).collect();
        (exponent.parse::<i32>().unwrap_or(0), format!("{digits:0<801}"))
    };
    if bound > 0.0 && bound.is_finite() && parts(&shown) < parts(&all) {
        bound.next_up()
    } else {
        bound
    }
}
