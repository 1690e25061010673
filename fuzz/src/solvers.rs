//! Every registered solver on a small problem: what it claims is true.

use arbitrary::{Result, Unstructured};
use lcplab::hunt::{Claim, claims};
use lcplab::solver::{Options, Registry, Settings};

use crate::contact;
use crate::problem::{numbers, problem};

/// Makes a problem of the bytes, a start for a third of them, and a contact of what is left.
pub fn solvers(bytes: &[u8]) -> Result<()> {
    let mut u = Unstructured::new(bytes);
    let lcp = problem(&mut u)?;
    let start = if u.ratio(1, 3)? { Some(numbers(&mut u, lcp.len())?) } else { None };
    let settings = Settings::default().with_max_iterations(200);
    let options = Options::default().with_settings(settings);
    let solvers: Vec<_> =
        Registry::standard().entries().map(|entry| entry.build(&options)).collect();
    for (solver, claim) in claims(&lcp, start.as_deref(), &solvers, Settings::default().tolerance) {
        assert!(
            !matches!(claim, Claim::FalseClaim(_)),
            "{solver}: {claim:?} of {lcp:?} from {start:?}"
        );
    }
    contact::solved(&mut u)
}
