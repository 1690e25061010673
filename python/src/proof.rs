//! Proofs as JSON.

use lcplab::error::Error;
use lcplab::lcp::exact::SolutionSet;
use lcplab::proof::{self, Kind, ProofSearch};
use lcplab::report::answer::first_answer;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::problem::Problem;
use crate::refused;
use crate::solving::question;

/// The strongest proof with its claim, and why there is no stronger one.
type Proved = (Option<(String, String)>, Vec<(&'static str, String)>);

/// Proves the strongest statement that it can, starting from this answer or that of a solver.
#[pyfunction]
pub fn prove(
    py: Python<'_>,
    problem: &Problem,
    answer: Option<PyReadonlyArray1<'_, f64>>,
    second: Option<PyReadonlyArray1<'_, f64>>,
    kind: Option<&str>,
    model: Option<String>,
) -> PyResult<Proved> {
    let kind: Option<Kind> = kind.map(str::parse).transpose().map_err(refused)?;
    let lcp = &problem.0.lcp;
    let [answer, second] = [answer, second].map(|own| own.map(|own| own.as_array().to_vec()));
    let wrong = [&answer, &second].into_iter().flatten().map(Vec::len).find(|n| *n != lcp.len());
    if let Some(n) = wrong {
        let reason = format!("has length {n}, the problem has {} rows", lcp.len());
        return Err(refused(Error::invalid("answer", "x", reason)));
    }
    let question = question(problem, model, None)?;
    let found = py.detach(|| {
        let answer = answer.unwrap_or_else(|| first_answer(&question));
        match (second, kind) {
            (Some(second), _) => proof::prove_different(&question, &answer, &second),
            (None, None) => proof::prove(&question, &answer),
            (None, Some(kind)) => proof::prove_kind(&question, &answer, kind),
        }
    });
    if let Some(reason) = found.refusal(&question) {
        let reason = format!("{reason}; model=\"coupled-box\" asks about the coupled box");
        return Err(refused(Error::invalid("problem", "model", reason)));
    }
    let ProofSearch { proof, missing } = found;
    let json_and_sentence = |proof: &proof::Proof| (proof.to_json().to_string(), proof.sentence());
    let missing = missing.into_iter().map(|(kind, reason)| (kind.name(), reason));
    Ok((proof.as_ref().map(json_and_sentence), missing.collect()))
}

/// The reason why a proof is not valid for this problem, or none.
#[pyfunction]
pub fn check(
    py: Python<'_>,
    problem: &Problem,
    text: &str,
    model: Option<String>,
) -> PyResult<Option<String>> {
    let proof = proof::Proof::parse(text, "proof").map_err(refused)?;
    let question = question(problem, model, None)?;
    Ok(py.detach(|| proof::check(&question, &proof)).err())
}

/// The corners and the rays as fractions, and the indices of those of each face.
type Faces = (Vec<Vec<String>>, Vec<Vec<String>>, Vec<(Vec<usize>, Vec<usize>)>);

/// All solutions, in exact arithmetic.
#[pyfunction]
pub fn solutions(py: Python<'_>, problem: &Problem, model: Option<String>) -> PyResult<Faces> {
    let question = question(problem, model, None)?;
    let lcp = question.require_boxed("all solutions can be listed", "problem").map_err(refused)?;
    let set = py
        .detach(|| SolutionSet::of(lcp))
        .map_err(|many| refused(Error::invalid("problem", "rows", many.to_string())))?;
    let exact = |points: &[Vec<_>]| {
        let point = |point: &Vec<_>| point.iter().map(ToString::to_string).collect();
        points.iter().map(point).collect()
    };
    let faces = set.faces.iter().map(|face| (face.corners.clone(), face.rays.clone())).collect();
    Ok((exact(&set.corners), exact(&set.rays), faces))
}
