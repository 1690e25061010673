//! Identifies the algorithm behind an answer by a fingerprint of its iterates.

use std::ops::ControlFlow;

use crate::{Event, Iterate, Observer};
use lcplab_lcp::{Lcp, merit};

/// An observer that condenses all iterates into one hash.
///
/// Two methods that end at the same x have different fingerprints unless their iterates agree bit
/// for bit from the start; this exposes a method that secretly runs another one.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Pgs, Solver, Start};
/// use lcplab_solver::trace::Provenance;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let path = |omega| {
///     let mut provenance = Provenance::of(&lcp);
///     Pgs { omega, ..Pgs::default() }.solve(&lcp, &Start::default(), &mut provenance);
///     provenance
/// };
/// assert_eq!(path(1.0), path(1.0));
/// assert_ne!(path(1.0).fingerprint, path(1.3).fingerprint);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Provenance<'a> {
    lcp: &'a Lcp,
    /// The 64-bit FNV-1a hash of the iterates after the start: the bytes of each x_i, rows
    /// ascending, least significant byte first, −0 as 0.
    pub fingerprint: u64,
    /// The number of iterates after the start.
    pub iterations: usize,
    /// Rows of the last iterate that are at a bound.
    pub active_rows: usize,
}

impl PartialEq for Provenance<'_> {
    fn eq(&self, other: &Self) -> bool {
        let key = |p: &Self| (p.fingerprint, p.iterations, p.active_rows);
        key(self) == key(other)
    }
}

/// The fingerprint of an empty sequence: the initial value of FNV-1a.
pub const NO_ITERATES: u64 = 0xcbf2_9ce4_8422_2325;

const FNV_PRIME: u64 = 0x0000_0100_0000_01b3;

impl<'a> Provenance<'a> {
    /// An empty fingerprint for a solver of this problem.
    pub fn of(lcp: &'a Lcp) -> Self {
        Provenance { lcp, fingerprint: NO_ITERATES, iterations: 0, active_rows: 0 }
    }
}

impl Observer for Provenance<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.active_rows = self.lcp.len() - merit::free_rows(self.lcp, iterate.x);
        if iterate.event == Event::Start {
            return ControlFlow::Continue(());
        }
        self.iterations += 1;
        for x in iterate.x {
            for byte in (x + 0.0).to_le_bytes() {
                self.fingerprint = (self.fingerprint ^ u64::from(byte)).wrapping_mul(FNV_PRIME);
            }
        }
        ControlFlow::Continue(())
    }
}
