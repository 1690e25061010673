//! Coupled rows: their bounds are ±μ times another row's x, which is the box model of dry friction.
//!
//! Row i is a tangential direction of a contact, row k its normal, and −μ_i max(x_k, 0) ≤ x_i ≤ μ_i
//! max(x_k, 0). Open Dynamics Engine calls k the `findex` of i. Coupled rows need not form
//! contacts: a row k can bound a single tangent, or two with different μ.

use crate::error::{Defects, Result};
use crate::friction::Contact;

/// The contacts of a problem, and for each coupled row i the row k and the coefficient μ that bound
/// it.
///
/// ```
/// use lcplab_lcp::Coupling;
///
/// // Row 0 is a normal row; its friction rows 1 and 2 have μ = 0.5.
/// let coupling = Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5])?;
/// assert!(!coupling.is_empty());
/// assert_eq!(coupling.rows().collect::<Vec<_>>(), [(1, 0), (2, 0)]); // each with its normal row
/// assert_eq!((coupling.index(0), coupling.index(2)), (None, Some(0)));
/// assert_eq!(coupling.mu(2), 0.5);
/// assert_eq!(coupling.contacts()[0].rows, [0, 1, 2]);
///
/// let slippery = coupling.with_mu(|_, _, mu| 0.1 * mu)?;
/// assert_eq!(slippery.bounds(1, &[4.0, 0.0, 0.0]), Some((-0.2, 0.2)));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Coupling {
    contacts: Vec<Contact>,
    /// For each row the index of the row that bounds it, if any.
    index: Vec<Option<usize>>,
    /// For each row its coefficient of friction; unused for rows that are not coupled.
    mu: Vec<f64>,
}

impl Coupling {
    /// The coupling with `index[i] = Some(k)` for −μ_i max(x_k, 0) ≤ x_i ≤ μ_i max(x_k, 0).
    ///
    /// ```
    /// use lcplab_lcp::Coupling;
    ///
    /// // Row 0 is a normal row; its friction rows 1 and 2 have μ = 0.5.
    /// let coupling = Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5])?;
    /// assert_eq!(coupling.bounds(1, &[4.0, 0.0, 0.0]), Some((-2.0, 2.0)));
    ///
    /// let chained = Coupling::new(vec![None, Some(0), Some(1)], vec![0.0, 0.5, 0.5]);
    /// assert_eq!(
    ///     chained.unwrap_err().to_string(),
    ///     "problem: friction_index[2]: is 1, which is a friction row itself"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// Lists each row where k is out of range, k = i, row k is coupled itself, or μ is negative,
    /// and each μ that is not finite.
    pub fn new(index: Vec<Option<usize>>, mu: Vec<f64>) -> Result<Self> {
        let mut defects = Defects::default();
        let n = index.len();
        if mu.len() != n {
            defects.add("mu", format!("has {} rows, friction_index has {n}", mu.len()));
        }
        for (i, k) in index.iter().enumerate().filter_map(|(i, k)| k.map(|k| (i, k))) {
            let place = format!("friction_index[{i}]");
            if k >= n {
                defects.add(place, format!("is {k}, there are only {n} rows"));
            } else if k == i {
                defects.add(place, format!("is {k}: a row cannot bound itself"));
            } else if index[k].is_some() {
                defects.add(place, format!("is {k}, which is a friction row itself"));
            }
            if let Some(mu) = mu.get(i).filter(|mu| **mu < 0.0) {
                defects.add(format!("mu[{i}]"), format!("must be at least 0, is {mu}"));
            }
        }
        for (i, mu) in mu.iter().enumerate().filter(|(_, mu)| !mu.is_finite()) {
            // Whether the row is coupled or not.
            defects.add(format!("mu[{i}]"), format!("must be finite, is {mu}"));
        }
        defects.into_result("problem")?;
        let contacts = contacts(&index, &mu);
        Ok(Coupling { contacts, index, mu })
    }

    /// The coupling of these contacts among n rows; each row belongs to at most one contact.
    pub(crate) fn of_contacts(n: usize, contacts: Vec<Contact>) -> Self {
        let (mut index, mut mu) = (vec![None; n], vec![0.0; n]);
        for Contact { rows: [normal, tangents @ ..], mu: own } in &contacts {
            for &t in tangents {
                (index[t], mu[t]) = (Some(*normal), *own);
            }
        }
        Coupling { contacts, index, mu }
    }

    /// The same rows with other coefficients, computed from the row, its normal row and the old
    /// one.
    ///
    /// # Errors
    /// If a coefficient is negative or not finite.
    pub fn with_mu(&self, mu: impl Fn(usize, usize, f64) -> f64) -> Result<Self> {
        let own = |i: usize| self.index[i].map_or(0.0, |k| mu(i, k, self.mu[i]));
        Coupling::new(self.index.clone(), (0..self.index.len()).map(own).collect())
    }

    /// The coupling among these rows, numbered by their places. A row whose normal row is not one
    /// of them is not coupled.
    pub(crate) fn part(&self, rows: &[usize], places: &[Option<usize>]) -> Self {
        let index: Vec<_> = rows.iter().map(|&i| self.index[i].and_then(|k| places[k])).collect();
        let mu: Vec<_> = rows.iter().map(|&i| self.mu[i]).collect();
        let contacts = contacts(&index, &mu);
        Coupling { contacts, index, mu }
    }

    /// The contacts: a normal row that bounds exactly two rows, both with the same μ.
    pub fn contacts(&self) -> &[Contact] {
        &self.contacts
    }

    /// Whether no row is coupled.
    pub fn is_empty(&self) -> bool {
        self.index.iter().all(Option::is_none)
    }

    /// The coupled rows i with the row k that bounds each.
    pub fn rows(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.index.iter().enumerate().filter_map(|(i, k)| k.map(|k| (i, k)))
    }

    /// The rows that each row bounds.
    ///
    /// ```
    /// use lcplab_lcp::Coupling;
    ///
    /// let contact = Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5])?;
    /// assert_eq!(contact.tangents(), [vec![1, 2], vec![], vec![]]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn tangents(&self) -> Vec<Vec<usize>> {
        tangents(&self.index)
    }

    /// The row that bounds row i, if it is coupled.
    pub fn index(&self, i: usize) -> Option<usize> {
        self.index[i]
    }

    /// The coefficient of row i.
    pub fn mu(&self, i: usize) -> f64 {
        self.mu[i]
    }

    /// The bounds of row i at x, if it is coupled.
    pub fn bounds(&self, i: usize, x: &[f64]) -> Option<(f64, f64)> {
        self.index[i].map(|k| {
            let limit = self.mu[i] * x[k].max(0.0);
            (-limit, limit)
        })
    }

    pub(super) fn check(&self, lo: &[f64], hi: &[f64]) -> Result<()> {
        let mut defects = Defects::default();
        if self.index.len() != lo.len() {
            let reason = format!("has {} rows, A has {}", self.index.len(), lo.len());
            defects.add("friction_index", reason);
            return defects.into_result("problem");
        }
        for (i, k) in self.rows() {
            for (name, bound) in [("lo", lo[i]), ("hi", hi[i])] {
                if bound.is_finite() {
                    let reason = format!(
                        "is {bound}, but row {i} is a friction row with the bounds ±mu[{i}] x[{k}]; leave the \
                         entry infinite"
                    );
                    defects.add(format!("{name}[{i}]"), reason);
                }
            }
            if lo[k] < 0.0 {
                let reason = format!("is {k}, whose lower bound {} is below 0", lo[k]);
                defects.add(format!("friction_index[{i}]"), reason);
            }
        }
        defects.into_result("problem")
    }
}

/// The rows that each row bounds.
fn tangents(index: &[Option<usize>]) -> Vec<Vec<usize>> {
    let mut tangents = vec![Vec::new(); index.len()];
    for (t, normal) in index.iter().enumerate().filter_map(|(t, k)| k.map(|k| (t, k))) {
        tangents[normal].push(t);
    }
    tangents
}

/// The contacts among coupled rows, ordered by their normal rows.
fn contacts(index: &[Option<usize>], mu: &[f64]) -> Vec<Contact> {
    let contact = |(n, tangents): (usize, &Vec<usize>)| match tangents[..] {
        [t1, t2] if mu[t1] == mu[t2] => Some(Contact { rows: [n, t1, t2], mu: mu[t1] }),
        _ => None,
    };
    tangents(index).iter().enumerate().filter_map(contact).collect()
}
