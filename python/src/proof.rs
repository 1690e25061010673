//! Proofs as JSON.

use lcplab::proof::{self, Kind};
use lcplab::report::answer::first_answer;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::refused;

/// The strongest proof and its sentence, and why there is no stronger one.
type Proved = (Option<(String, String)>, Vec<(&'static str, String)>);

/// Proves what can be proved, beginning with this answer or a solver's.
#[pyfunction]
pub fn prove(
    py: Python<'_>,
    problem: &Problem,
    answer: Option<PyReadonlyArray1<'_, f64>>,
    kind: Option<&str>,
) -> PyResult<Proved> {
    let kind: Option<Kind> = kind.map(str::parse).transpose().map_err(refused)?;
    let lcp = &problem.0.lcp;
    let answer = answer.map(|answer| answer.as_array().to_vec());
    if let Some(n) = answer.as_ref().map(Vec::len).filter(|n| *n != lcp.len()) {
        let reason = format!("has {n} entries, the problem has {} rows", lcp.len());
        return Err(refused(lcplab::error::Error::invalid("answer", "x", reason)));
    }
    Ok(py.detach(|| {
        let answer = answer.unwrap_or_else(|| first_answer(lcp));
        let found = match kind {
            None => proof::prove(&problem.0, &answer),
            Some(kind) => proof::prove_kind(&problem.0, &answer, kind),
        };
        let told = |proof: &proof::Proof| (proof.to_json().to_string(), proof.claim.sentence());
        let missing = found.missing.into_iter().map(|(kind, reason)| (kind.name(), reason));
        (found.proof.as_ref().map(told), missing.collect())
    }))
}

/// Why a proof proves nothing of this problem, or none.
#[pyfunction]
pub fn check(py: Python<'_>, problem: &Problem, text: &str) -> PyResult<Option<String>> {
    let proof = proof::Proof::parse(text, "proof").map_err(refused)?;
    Ok(py.detach(|| proof::check(&problem.0, &proof)).err())
}
