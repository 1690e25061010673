//! Dry friction at contacts: one problem, four models.
//!
//! A contact has three rows of A, its normal n and two tangents t1, t2. x_n is the normal and x_t
//! the friction impulse or force; w_n and w_t are the resulting velocities or accelerations.
//! Coulomb's law for each contact:
//!
//! ```text
//! x_n ≥ 0,  w_n ≥ 0,  x_n w_n = 0          no tension, no penetration
//! |x_t| ≤ μ x_n                            friction lies within a cone
//! w_t ≠ 0  ⇒  x_t = −μ x_n w_t / |w_t|     full friction opposite to the slip
//! ```
//!
//! The third line makes the problem hard: it is neither linear nor the optimality condition of a
//! minimization. Each model gives up one property:
//!
//! | model | x_t lies in | gives up | becomes |
//! | --- | --- | --- | --- |
//! | 1 [`FrictionProblem::frozen_box`] | a square of fixed size | the present x_n | a boxed LCP, symmetric |
//! | 2 [`FrictionProblem::coupled_box`] | a square of half-width μ x_n | isotropy | a boxed LCP with [`Coupling`] |
//! | 3 [`Polyhedral`] | a polygon with k corners | all but k directions | an LCP, not symmetric |
//! | 4a [`ConeProblem`], [`Law::Associated`] | the disk | w_n = 0 while sliding | a convex cone program |
//! | 4b [`ConeProblem`], [`Law::Coulomb`] | the disk | nothing | a cone problem, not convex |
//!
//! [`Model`] lists them, and [`Model::pose`] states a problem under one of them.
//!
//! Along an edge of the square the box model gives the resistance μ x_n, along its diagonal √2 μ
//! x_n: 41 % too much. A polygon with four corners on the disk gives 29 % too little across an
//! edge, one with k corners a fraction 1 − cos(π/k) too little.
//!
//! ```
//! use lcplab_lcp::{Lcp, Matrix};
//! use lcplab_lcp::friction::{Contact, FrictionProblem};
//!
//! // A unit mass, pressed to the floor with 2 N s and pushed along t1 with 3 N s; μ = ½.
//! let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
//! let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
//! let lcp = Lcp::new(a, vec![-2.0, -3.0, 0.0], lo, hi)?;
//! let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
//! assert_eq!(problem.coupled_box().bounds(1, &[2.0, 0.0, 0.0]), (-1.0, 1.0));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod cone;
mod coupled_box;
mod frozen_box;
mod model;
mod polyhedral;
mod tangents;

pub use cone::{ConeProblem, Law, project};
pub use model::{Form, Model, ProblemForm};
pub use polyhedral::{Polyhedral, Unknowns};

use super::{Coupling, Lcp};
use crate::error::{Defects, Result};

/// A contact with friction.
///
/// ```
/// use lcplab_lcp::friction::Contact;
///
/// let contact = Contact { rows: [3, 4, 5], mu: 0.5 };
/// let mut x = [0.0; 6];
/// contact.put([2.0, 1.0, 0.0], &mut x);
/// assert_eq!(x, [0.0, 0.0, 0.0, 2.0, 1.0, 0.0]);
/// assert_eq!(contact.of(&x), [2.0, 1.0, 0.0]);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Its rows n, t1, t2 of A. The tangents are orthogonal.
    pub rows: [usize; 3],
    /// Its coefficient of friction μ ≥ 0.
    pub mu: f64,
}

impl Contact {
    /// The contact's entries n, t1, t2 of a vector with one entry per row.
    pub fn of(&self, values: &[f64]) -> [f64; 3] {
        self.rows.map(|i| values[i])
    }

    /// Writes the contact's entries n, t1, t2 into a vector with one entry per row.
    pub fn put(&self, entries: [f64; 3], values: &mut [f64]) {
        for (i, entry) in self.rows.into_iter().zip(entries) {
            values[i] = entry;
        }
    }
}

/// w = A x + b with some contacts; the other rows have their own bounds. The constructor checks
/// that each contact has rows of its own, that x_n ≥ 0 is the only bound of x_n, and that only
/// friction bounds x_t.
///
/// ```
/// use lcplab_lcp::friction::{Contact, FrictionProblem};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Row 0 is a joint, rows 1 to 3 are a contact.
/// let a = Matrix::sparse(4, &[(0, 0, 1.0), (1, 1, 2.0), (2, 2, 2.0), (3, 3, 2.0)]);
/// let free = f64::INFINITY;
/// let lo = vec![-free, 0.0, -free, -free];
/// let lcp = Lcp::new(a, vec![-1.0; 4], lo, vec![free; 4])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [1, 2, 3], mu: 0.5 }])?;
/// assert_eq!(problem.others(), [0]);
/// assert_eq!(problem.softened(0.25)?.lcp().matrix().diagonal(1), 2.5);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct FrictionProblem {
    /// A, b and the bounds without friction; no coupling.
    lcp: Lcp,
    contacts: Vec<Contact>,
    /// The rows that belong to no contact.
    others: Vec<usize>,
}

impl FrictionProblem {
    /// The problem with these contacts among the rows of an uncoupled LCP.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// assert_eq!(problem.coupled_box().bounds(1, &[2.0, 0.0, 0.0]), (-1.0, 1.0));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Lists each contact with a row that does not exist, belongs to another contact or has bounds
    /// other than 0 ≤ x_n, x_t free, and each μ that is negative or not finite.
    pub fn new(lcp: Lcp, contacts: Vec<Contact>) -> Result<Self> {
        let mut defects = Defects::default();
        if lcp.coupling().is_some() {
            defects.add("friction_index", "is given, and so are contacts: one of them is enough");
        }
        let mut is_free = vec![true; lcp.len()];
        for (c, contact) in contacts.iter().enumerate() {
            if !(contact.mu.is_finite() && contact.mu >= 0.0) {
                defects.add(format!("contact {c}"), format!("mu must be ≥ 0, is {}", contact.mu));
            }
            for (name, &i) in ["n", "t1", "t2"].iter().zip(&contact.rows) {
                if let Some(reason) = take_row(&lcp, &mut is_free, i, *name == "n") {
                    defects.add(format!("contact {c}"), format!("row {name} = {i} {reason}"));
                }
            }
        }
        defects.into_result("contacts")?;
        let others = (0..lcp.len()).filter(|&i| is_free[i]).collect();
        Ok(FrictionProblem { lcp, contacts, others })
    }

    /// The problem with an LCP's [contacts](Lcp::contacts); its box model is that LCP.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem};
    /// use lcplab_lcp::{Coupling, Lcp, Matrix};
    ///
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let free = f64::INFINITY;
    /// let lcp = Lcp::new(a, vec![-2.0, -3.0, 0.0], vec![0.0, -free, -free], vec![free; 3])?
    ///     .with_coupling(Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5])?)?;
    /// let problem = FrictionProblem::of(&lcp)?;
    /// assert_eq!(problem.contacts(), [Contact { rows: [0, 1, 2], mu: 0.5 }]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Lists each row that bounds others, but not exactly two with the same μ; otherwise as
    /// [`FrictionProblem::new`].
    pub fn of(lcp: &Lcp) -> Result<Self> {
        let mut defects = Defects::default();
        let mut tangents = lcp.coupling().map_or_else(Vec::new, Coupling::tangents);
        for contact in lcp.contacts() {
            tangents[contact.rows[0]].clear();
        }
        let mu = |i: usize| lcp.coupling().map_or(0.0, |coupling| coupling.mu(i));
        for (n, rows) in tangents.iter().enumerate().filter(|(_, rows)| !rows.is_empty()) {
            let reason = match rows[..] {
                [t1, t2] => format!(
                    "mu is {} along t1, {} along t2: multiply row and column {t2} of A, and \
                     b[{t2}], by their ratio {}, and give both rows the mu of t1",
                    mu(t1),
                    mu(t2),
                    mu(t2) / mu(t1)
                ),
                [_, _, _, ..] => format!(
                    "bounds {} friction rows, not 2; rolling and torsional friction are supported \
                     as boxes alone, by the model coupled-box",
                    rows.len()
                ),
                _ => format!("bounds {} friction rows, not 2", rows.len()),
            };
            defects.add(format!("row {n}"), reason);
        }
        defects.into_result("contacts")?;
        FrictionProblem::new(Lcp { coupling: None, ..lcp.clone() }, lcp.contacts().to_vec())
    }

    /// A, b and the bounds without friction: 0 ≤ x_n, x_t free.
    pub fn lcp(&self) -> &Lcp {
        &self.lcp
    }

    /// The problem with each diagonal entry of A increased by this fraction of itself: every row
    /// becomes slightly compliant, which makes the distribution of the load unique.
    ///
    /// # Errors
    /// If an increased entry is not finite.
    pub fn softened(&self, part: f64) -> Result<Self> {
        let lcp = self.lcp.softened(part)?;
        Ok(FrictionProblem { lcp, ..self.clone() })
    }

    /// The contacts.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// The rows that belong to no contact, ascending.
    pub fn others(&self) -> &[usize] {
        &self.others
    }
}

/// Marks row i as used; returns the reason if a contact cannot use it.
fn take_row(lcp: &Lcp, is_free: &mut [bool], i: usize, is_normal: bool) -> Option<String> {
    match is_free.get_mut(i) {
        None => return Some(format!("does not exist, there are only {} rows", lcp.len())),
        Some(false) => return Some("is used twice".to_string()),
        Some(free) => *free = false,
    }
    let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
    let expected = if is_normal { 0.0 } else { f64::NEG_INFINITY };
    let fits = (lo, hi) == (expected, f64::INFINITY);
    (!fits).then(|| format!("has bounds {lo} and {hi}, not {expected} and inf"))
}
