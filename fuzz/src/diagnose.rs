//! What the diagnosis says of a problem, against all solutions in exact arithmetic.

use arbitrary::{Result, Unstructured};
use lcplab::diagnosis::{self, Cause, Proof};
use lcplab::lcp::file::Problem;
use lcplab::solver::all_solutions;

use crate::problem::problem;

/// Makes a problem of the bytes and has it examined.
pub fn diagnose(bytes: &[u8]) -> Result<()> {
    let lcp = problem(&mut Unstructured::new(bytes))?;
    let Ok(found) = diagnosis::problem(&Problem::new("fuzz", lcp.clone())) else {
        return Ok(()); // singular values that overflow
    };
    let all = all_solutions(&lcp).expect("few pieces");
    let is_proof = |proof: &Proof| matches!(proof, Proof::Vector | Proof::CaseSplit { .. });
    let is_refuted = found
        .causes
        .iter()
        .any(|cause| matches!(cause, Cause::Impossible { proof, .. } if is_proof(proof)));
    assert!(!is_refuted || all.is_empty(), "{found:?} of {lcp:?} with {all:?}");
    assert!(!found.is_unique || all.len() == 1, "{found:?} of {lcp:?} with {all:?}");
    Ok(())
}
