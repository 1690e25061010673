//! The answer of a solver to one problem, as JSON and as text.

use std::fmt;

use dashu_ratio::RBig;
use serde::Serialize;
use serde_json::{Map, Value, json};

use lcplab_judge::{
    Certificate, Demand, Evidence, Refutation, Verdict, error_bound, judge, printed_up, ray,
    refutation, upper_bound,
};
use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::{Lcp, Question};
use lcplab_page::number::{counted, plain, readable};
use lcplab_solver::{Attempt, Options, Reason, Solution, Status, solve_by_sequence};

/// Maximum number of entries of an exact vector that are printed.
const SHOWN: usize = 12;

/// A solver's answer with its claim and the judge's verdict.
#[derive(Debug, Clone)]
pub struct Answer {
    /// The solver.
    pub solver: String,
    /// What it returned.
    pub solution: Solution,
    /// The judge's verdict on it, or on the claim that there is no solution.
    pub certificate: Certificate,
    /// An upper bound on max |x − x*|, if A is verified to be definite and nothing stronger was
    /// proved.
    pub error_bound: Option<f64>,
    /// Why the solver was stopped, if it was.
    pub stopped: Option<Reason>,
    /// The methods that were tried before this one, if no solver was named.
    pub attempts: Vec<Attempt>,
}

impl Answer {
    /// Judges a solution; if the solver ended on a ray or reports that there is no solution, the
    /// judge looks for a proof of that.
    pub fn judged(
        lcp: &Lcp,
        solver: impl Into<String>,
        solution: Solution,
        demand: &Demand,
    ) -> Self {
        let certificate = judge(lcp, &solution.x, demand);
        let certificate = match proof_of_denial(lcp, &solution.status, demand) {
            Some(refutation) => certificate.refuted_by(refutation),
            None => certificate,
        };
        let error_bound = bound(lcp, &solution.x, &certificate);
        Answer {
            solver: solver.into(),
            solution,
            certificate,
            error_bound,
            stopped: None,
            attempts: Vec::new(),
        }
    }

    /// The same answer; if it is rejected, with a proof that no x solves the problem, where the
    /// judge finds one.
    pub fn searched(self, lcp: &Lcp, demand: &Demand) -> Self {
        Answer { certificate: searched(lcp, self.certificate, demand), ..self }
    }

    /// The same answer with the reason why the solver was stopped.
    pub fn stopped(self, stopped: Option<Reason>) -> Self {
        Answer { stopped, ..self }
    }

    /// The same answer with the methods that were tried before.
    pub fn after(self, attempts: Vec<Attempt>) -> Self {
        Answer { attempts, ..self }
    }

    /// The solver's claim as one of four words. `infeasible` requires a proof.
    pub fn status_word(&self) -> &'static str {
        self.claim().0
    }

    /// The status as text.
    pub fn message(&self) -> String {
        self.claim().1
    }

    fn claim(&self) -> (&'static str, String) {
        let Certificate { verdict, .. } = &self.certificate;
        claim(&self.solution.status, verdict, self.certificate.refutation(), self.stopped)
    }

    /// The object that `solve --json` prints.
    pub fn to_json(&self) -> Map<String, Value> {
        let mut fields = json_object(&self.solution);
        let fallback = fields.shift_remove_entry("fallback");
        fields.shift_remove("message");
        fields.insert("status".into(), json!(self.status_word()));
        fields.insert("w".into(), self.certificate.w.iter().map(|&w| number(w)).collect());
        fields.insert("solver".into(), json!(self.solver));
        fields.extend(json_object(&self.certificate));
        fields.insert("message".into(), json!(self.message()));
        fields.extend(fallback);
        fields.extend(attempts_json(&self.attempts));
        if let Some(bound) = self.error_bound {
            fields.insert("error_bound".into(), number(printed_up(bound)));
        }
        fields
    }
}

/// The key `attempts`: the methods of a fallback sequence that failed to solve the problem.
pub fn attempts_json(attempts: &[Attempt]) -> Option<(String, Value)> {
    let object = |Attempt { solver, status, iterations }: &Attempt| {
        json!({
            "solver": solver, "status": status.word(), "message": status.to_string(),
            "iterations": iterations,
        })
    };
    let all: Vec<Value> = attempts.iter().map(object).collect();
    (!all.is_empty()).then(|| ("attempts".into(), Value::Array(all)))
}

/// The same as lines of text.
pub fn attempts_text(attempts: &[Attempt]) -> String {
    let line = |Attempt { solver, status, iterations }: &Attempt| {
        format!("tried      {solver}: {status}, {}\n", counted(*iterations, "iteration"))
    };
    attempts.iter().map(line).collect()
}

/// The x of the fallback sequence under the question's friction model.
pub fn first_answer(question: &Question) -> Vec<f64> {
    solve_by_sequence(question.posed(), &Options::default(), &mut ()).solution.x
}

/// A verdict with the label of its row and the physical value of its w, if the problem states them:
/// `normal ground box1 0: approach velocity 0.017 m/s, 0.17 mm per step`.
pub fn labelled(verdict: &Verdict, w: &[f64], problem: &Problem) -> String {
    let Verdict::NotASolution { row, .. } = *verdict else { return verdict.to_string() };
    let known = |key: &str| problem.extra.get("rows")?.get(row)?.get(key)?.as_str();
    let (Some(label), Some(&w)) = (known("label"), w.get(row)) else { return verdict.to_string() };
    let unit = match known("unit") {
        Some("N s") => "m/s",
        Some("N") => "m/s²",
        Some("N m s") => "rad/s",
        Some("N m") => "rad/s²",
        _ => return format!("{verdict} ({label})"),
    };
    let mut meaning = match known("kind") {
        Some("normal") if w < 0.0 => format!("approach velocity {} {unit}", readable(-w, 2)),
        _ => format!("w = {} {unit}", readable(w, 2)),
    };
    let step = problem.extra.get("dt").and_then(Value::as_f64);
    if let ("m/s", Some(dt)) = (unit, step) {
        meaning += &format!(", {} mm per step", readable(1e3 * w.abs() * dt, 2));
    }
    format!("{verdict} ({label}: {meaning})")
}

/// The certificate; if x is rejected, with a proof that no x solves the problem, where the judge
/// finds one.
///
/// ```
/// use lcplab_judge::{Demand, Refutation, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = −x − 1 is negative for every x ≥ 0.
/// let lcp = Lcp::new(Matrix::dense(1, &[-1.0]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let demand = Demand::default();
/// let certificate = lcplab_analysis::answer::searched(&lcp, judge(&lcp, &[0.0], &demand), &demand);
/// assert!(matches!(certificate.refutation(), Some(Refutation::Vector(_))));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn searched(lcp: &Lcp, certificate: Certificate, demand: &Demand) -> Certificate {
    let is_open = !certificate.verdict.is_solution() && certificate.refutation().is_none();
    match impossible(lcp, is_open, demand) {
        Some(refutation) => certificate.refuted_by(refutation),
        None => certificate,
    }
}

/// A proof that a problem has no solution, if this is open and the problem is small enough.
pub(crate) fn impossible(lcp: &Lcp, is_open: bool, demand: &Demand) -> Option<Refutation> {
    let is_looked_for = is_open && lcp.len() <= demand.prove_up_to;
    is_looked_for.then(|| refutation(lcp, &[], demand.tolerance)).flatten()
}

/// The judge's result for a solver that ended on a ray or reports that there is no solution: its
/// own vector can prove it at any size; another proof is searched for if the problem is small
/// enough.
pub fn proof_of_denial(lcp: &Lcp, status: &Status, demand: &Demand) -> Option<Refutation> {
    let vector = match status {
        Status::Ray { direction, .. } => Some(direction.as_slice()),
        Status::NoSolution => None,
        _ => return None,
    };
    if lcp.len() <= demand.prove_up_to {
        return refutation(lcp, vector.as_slice(), demand.tolerance);
    }
    let proof = vector.and_then(|vector| ray::checked(lcp, vector));
    proof.filter(|farkas| farkas.is_significant(demand.tolerance)).map(Refutation::Vector)
}

/// A solver's claim, as one of four words and as a sentence. `infeasible` requires a proof. The
/// sentence says so if the judge accepts the x of a solver that does not claim a solution.
pub fn claim(
    status: &Status,
    verdict: &Verdict,
    refutation: Option<&Refutation>,
    stopped: Option<Reason>,
) -> (&'static str, String) {
    match (status, refutation) {
        (Status::Ray { .. } | Status::NoSolution, Some(refutation)) => {
            ("infeasible", format!("no solution exists, {}", how(refutation)))
        }
        (Status::Solved, Some(refutation)) => {
            let how = how(refutation);
            ("solved", format!("solved within the tolerance, but no solution exists, {how}"))
        }
        _ => {
            let message = match stopped {
                Some(reason) => reason.to_string(),
                None if verdict.is_solution() && *status != Status::Solved => {
                    format!("{status}; the judge nevertheless accepts x")
                }
                None => status.to_string(),
            };
            (status.word(), message)
        }
    }
}

/// How it was shown that there is no solution.
fn how(refutation: &Refutation) -> String {
    match refutation {
        Refutation::Vector(_) => "proved by an exactly checked vector".to_string(),
        Refutation::CaseSplit { pieces: 1 } => {
            "proved in exact arithmetic by the bounds and the limits of friction".to_string()
        }
        Refutation::CaseSplit { pieces } => {
            format!("proved in exact arithmetic for each of {pieces} active sets")
        }
    }
}

/// The bound that certifies x to ε, if the verdict is within tolerance and not stronger.
pub fn bound(lcp: &Lcp, x: &[f64], certificate: &Certificate) -> Option<f64> {
    match certificate.verdict {
        Verdict::WithinTolerance => error_bound::error_bound(lcp, x),
        _ => None,
    }
}

/// The keys of a value that is an object in JSON, such as a certificate or a verdict.
pub fn json_object(value: &impl Serialize) -> Map<String, Value> {
    match serde_json::to_value(value) {
        Ok(Value::Object(object)) => object,
        _ => Map::new(),
    }
}

/// The key `rounded_by`, if the verdict is about a point that differs from x by rounding.
pub fn rounding_json(rounded_by: Option<f64>) -> Option<(String, Value)> {
    rounded_by.map(|by| ("rounded_by".into(), number(printed_up(by))))
}

/// The same as a measured value.
pub(crate) fn rounding(rounded_by: Option<f64>) -> Option<Measured> {
    let meaning = "distance of x from the accepted point, a rounding error";
    rounded_by.map(|by| ("rounding", plain(&upper_bound(by)), meaning))
}

/// A number in a column of a terminal: its powers of ten are as wide as they are printed.
pub fn cell(value: f64, digits: usize) -> String {
    plain(&readable(value, digits))
}

/// The name of a value, the value, and its meaning.
pub type Measured = (&'static str, String, &'static str);

/// A measured value as a line of text.
pub(crate) fn line((name, value, meaning): &Measured) -> String {
    format!("  {name:<17}{value:>10}  {meaning}\n")
}

/// A certificate in words; displayed as lines of text.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CertificateText {
    /// The verdict.
    pub verdict: String,
    /// The residuals, and the [`bound`] on the error of x if there is one.
    pub measured: Vec<Measured>,
    /// What exact arithmetic showed in addition, a line each.
    pub remarks: String,
}

impl fmt::Display for CertificateText {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        let measured: String = self.measured.iter().map(line).collect();
        write!(out, "verdict    {}\n{measured}{}", self.verdict, self.remarks)
    }
}

/// The verdict, the residuals and the [`bound`] on the error of x in words.
pub fn certificate_text(
    certificate: &Certificate,
    error_bound: Option<f64>,
    problem: &Problem,
) -> CertificateText {
    let residual = |name, value: f64, meaning| {
        let value = if value.is_nan() { "–".into() } else { cell(value, 3) };
        (name, value, meaning)
    };
    let mut measured = vec![
        residual(
            "scaled residual",
            certificate.scaled_residual,
            "error of the worst row relative to its terms",
        ),
        residual("natural residual", certificate.natural_residual, "max |x − Π(x − w)|"),
        residual(
            "bound violation",
            certificate.bound_violation,
            "largest distance of x outside its bounds",
        ),
        residual(
            "complementarity",
            certificate.complementarity_gap,
            "largest product of w and distance to bound",
        ),
        residual(
            "duality gap",
            certificate.duality_gap,
            "bound on the error of the objective, up to the tolerance; – if there is none",
        ),
    ];
    if certificate.scale > 0.0 {
        measured.push(residual(
            "scale",
            certificate.scale,
            "residuals are relative to at least this |x|",
        ));
    }
    measured.extend(rounding(certificate.rounded_by));
    let bound =
        |bound| ("error bound", plain(&upper_bound(bound)), "no entry of x has a larger error");
    measured.extend(error_bound.map(bound));
    let verdict = match certificate.evidence {
        Some(Evidence::NoSolution(_)) => "not a solution: no solution exists".into(),
        _ => labelled(&certificate.verdict, &certificate.w, problem),
    };
    // There is a bound only if the solution is unique.
    let evidence = certificate.evidence.as_ref();
    let remarks = evidence.map(|own| evidence_text(own, error_bound.is_some())).unwrap_or_default();
    CertificateText { verdict, measured, remarks }
}

/// What exact arithmetic showed in addition to the verdict, as a line of text.
pub(crate) fn evidence_text(evidence: &Evidence, is_unique: bool) -> String {
    let listed = |vector: &[RBig]| {
        let shown: Vec<String> = vector.iter().take(SHOWN).map(RBig::to_string).collect();
        shown.join(" ") + if vector.len() > SHOWN { " …" } else { "" }
    };
    match evidence {
        Evidence::NotUnique(direction) => {
            format!("  not unique: moving x along ({}) does not change w\n", listed(direction))
        }
        Evidence::FarSolution { distance } => {
            let distance = upper_bound(*distance);
            match is_unique {
                true => format!("  the only exact solution is at the distance {distance} from x\n"),
                false => format!(
                    "  an exact solution exists at the distance {distance} from x; others may be closer\n"
                ),
            }
        }
        Evidence::NoExactSolution(Refutation::Vector(farkas)) => format!(
            "  no exact solution exists, but the contradiction is below the tolerance: {} of the scale\n",
            upper_bound(farkas.significance)
        ),
        Evidence::NoExactSolution(_) => {
            "  no exact solution exists, but a change of b below the tolerance times the scale allows one\n"
                .into()
        }
        Evidence::NoSolution(Refutation::Vector(farkas)) => {
            format!("  no solution exists: proved by d = ({})\n", listed(&farkas.vector))
        }
        Evidence::NoSolution(refutation) => format!("  no solution exists, {}\n", how(refutation)),
    }
}
