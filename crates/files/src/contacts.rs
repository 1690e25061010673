//! The row order of friction formats: one contact after the other, each as n, t1, t2 or, in the
//! plane, as n, t, then the equations.

use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Parts, Problem};
use lcplab_lcp::friction::Model;

/// A problem whose first rows are contacts, `dimension` rows and one mu each; the remaining rows
/// are equations. There must be that many rows for each mu.
pub(super) fn coulomb(entries: Entries, b: Vec<f64>, mu: &[f64], dimension: usize) -> Parts {
    let (n, friction) = (b.len(), dimension * mu.len());
    let is_normal = |i: usize| i < friction && i.is_multiple_of(dimension);
    let is_tangent = |i: usize| i < friction && !i.is_multiple_of(dimension);
    Parts {
        lo: Some((0..n).map(|i| if is_normal(i) { 0.0 } else { -f64::INFINITY }).collect()),
        hi: None,
        index: Some((0..n).map(|i| is_tangent(i).then_some(i - i % dimension)).collect()),
        mu: Some((0..n).map(|i| if is_tangent(i) { mu[i / dimension] } else { 0.0 }).collect()),
        entries,
        b,
    }
}

/// The friction model of a file's contacts, if it has any: Coulomb's law, which in the plane is the
/// coupled box.
pub(super) fn law(lcp: &Lcp, dimension: usize) -> Option<Model> {
    lcp.coupling()?;
    (dimension == 3).then_some(Model::CoulombCone)
}

/// Rows in the order of a friction format.
pub(super) struct Arrangement {
    /// The problem's row at each position.
    pub rows: Vec<usize>,
    /// The coefficient of friction of each contact.
    pub mu: Vec<f64>,
}

impl Arrangement {
    /// The order of a problem's rows in a format.
    ///
    /// # Errors
    /// If a row is neither a contact row nor an equation.
    pub fn of(problem: &Problem, format: &str) -> Result<Self> {
        let friction = problem.friction().unwrap_or_else(|| {
            Err(Error::invalid(format, "friction_index", "is missing: there are no contacts"))
        })?;
        let lcp = friction.lcp();
        let is_equation = |i: usize| lcp.lo()[i] == -f64::INFINITY && lcp.hi()[i] == f64::INFINITY;
        if let Some(i) = friction.others().iter().find(|i| !is_equation(**i)) {
            let reason = format!("is neither a contact with friction nor an equation for {format}");
            return Err(Error::invalid(format, format!("row {i}"), reason));
        }
        let contacts = friction.contacts().iter().flat_map(|contact| contact.rows);
        Ok(Arrangement {
            rows: contacts.chain(friction.others().iter().copied()).collect(),
            mu: friction.contacts().iter().map(|contact| contact.mu).collect(),
        })
    }

    /// The rows that belong to no contact.
    pub fn equations(&self) -> &[usize] {
        &self.rows[3 * self.mu.len()..]
    }

    /// A note for the user if the rows are written in another order.
    pub fn notes(order: &[usize]) -> Vec<String> {
        let is_kept = order.iter().enumerate().all(|(k, i)| k == *i);
        if is_kept { Vec::new() } else { vec![format!("rows are written in the order {order:?}")] }
    }
}
