//! Checks a proof, by the definitions and in exact arithmetic.

use dashu_ratio::RBig;

use lcplab_judge::ConeProof;
use lcplab_judge::cases::Tree;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, rational, whole};
use lcplab_lcp::exact::{Exact, Point};
use lcplab_lcp::friction::{ConeProblem, Model, ProblemForm};
use lcplab_lcp::{Gauss, Lcp, Question};

use crate::claim::{Bounded, Claim, Entry, Kind, Near, Proof, Reason, Vector};
use crate::hash::{model, rows};
use crate::motion::{NO_BODIES, Squares};
use crate::{cases, cone, cone_motion, hash, minors, residual};

/// Proofs by definiteness with more rows are rejected: checking them takes minutes.
pub(crate) const MOST_ROWS_OF_DEFINITE: usize = 500;
/// With more rows, not all principal minors can be checked.
pub(crate) const MOST_ROWS_OF_P: usize = 12;

/// Checks a proof of a problem under its friction model.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix, Question};
/// use lcplab_proof::{check, prove};
///
/// let question = |b: f64| {
///     let lcp = Lcp::new(Matrix::from([[2.0]]), vec![b], vec![0.0], vec![f64::INFINITY])?;
///     Question::new(&Problem::new("one contact", lcp), None, "one.json")
/// };
/// let proof = prove(&question(-1.0)?, &[0.5]).proof.expect("a proof");
/// assert_eq!(check(&question(-1.0)?, &proof), Ok(()));
/// let other = check(&question(-2.0)?, &proof);
/// assert_eq!(other, Err("the proof is about another problem".into()));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// Why it proves nothing about this problem.
pub fn check(question: &Question, proof: &Proof) -> Result<(), String> {
    let (own, other) = (model(question), proof.model.unwrap_or_default());
    if own != other {
        return Err(format!(
            "the proof is about the model {other}, but the problem's model is {own}"
        ));
    }
    if proof.problem != hash(question) {
        return Err("the proof is about another problem".into());
    }
    match question.boxed() {
        Some(lcp) => of_boxes(lcp, question.problem().motion.as_ref(), &proof.claim),
        None => match (question.posed(), &proof.claim) {
            (
                ProblemForm::Cone(problem),
                claim @ (Claim::Solution { .. }
                | Claim::NotUnique { .. }
                | Claim::ConeSolution { .. }
                | Claim::BodySolution { .. }
                | Claim::Motion(_)),
            ) => of_cones(problem, rows(question), question.problem().motion.as_ref(), claim),
            (_, claim) => of_any_model(rows(question), own, claim),
        },
    }
}

/// Checks the claim that a problem with friction cones has a solution.
fn of_cones(
    problem: &ConeProblem,
    rows: &Lcp,
    bodies: Option<&Gauss>,
    claim: &Claim,
) -> Result<(), String> {
    match claim {
        Claim::Solution { x, near } => {
            let point = point(rows, x)?;
            ConeProof::Point(point.clone()).check(problem)?;
            near.as_ref().map_or(Ok(()), |near| is_near(&point, near))
        }
        Claim::NotUnique { x, y } => {
            let (x, y) = (point(rows, x)?, point(rows, y)?);
            ConeProof::Point(x.clone()).check(problem)?;
            ConeProof::Point(y.clone()).check(problem)?;
            are_different(&x, &y)
        }
        Claim::ConeSolution { region, near } => {
            cone::check(problem, rows, None, region, near.as_ref())
        }
        Claim::BodySolution { region, near } => {
            let bodies = Some(bodies.ok_or(NO_BODIES)?);
            cone::check(problem, rows, bodies, region, near.as_ref())
        }
        Claim::Motion(bounded) => cone_motion::check(problem, rows, bodies, bounded),
        _ => Err("the claim is none about friction cones".into()),
    }
}

/// Checks a claim about boxes, coupled or frozen.
fn of_boxes(lcp: &Lcp, bodies: Option<&Gauss>, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::Solution { x, near } => {
            let point = solution(lcp, x)?;
            near.as_ref().map_or(Ok(()), |near| is_near(&point, near))
        }
        Claim::ConeSolution { .. } | Claim::BodySolution { .. } => Err(about_cones()),
        Claim::Unique { x, by } => {
            solution(lcp, x)?;
            is_unique(lcp, *by)
        }
        Claim::NotUnique { x, y } => {
            let (x, y) = (solution(lcp, x)?, solution(lcp, y)?);
            are_different(&x, &y)
        }
        Claim::NoSolution { tree } => cases::check(lcp, tree),
        Claim::Motion(_) if lcp.has_coupled_rows() => Err("rows are coupled".into()),
        Claim::FrozenMotion(_) if !lcp.has_coupled_rows() => Err("no rows are coupled".into()),
        Claim::Motion(bounded) | Claim::FrozenMotion(bounded) => is_bounded(lcp, bodies, bounded),
        Claim::Within { answer, residual } => {
            has_rows(lcp, answer.len())?;
            match residual::scaled(lcp, answer) {
                Some(own)
                    if &own.numerator * &residual.denominator
                        == &residual.numerator * &own.denominator =>
                {
                    Ok(())
                }
                Some(own) => Err(format!("the scaled residual is {:e}", own.rounded_up())),
                None => Err("the scaled residual is not finite".into()),
            }
        }
    }
}

fn are_different(x: &Point, y: &Point) -> Result<(), String> {
    let is_same = |i| x.scaled(i) * y.denominator() == y.scaled(i) * x.denominator();
    match (0..x.len()).all(is_same) {
        true => Err("the two solutions are the same".into()),
        false => Ok(()),
    }
}

/// Checks a claim that is valid under every friction model: no solution exists, proved by a
/// Farkas vector.
fn of_any_model(rows: &Lcp, model: Model, claim: &Claim) -> Result<(), String> {
    match claim {
        Claim::NoSolution { tree: tree @ Tree::Leaf(_) } => cases::check(rows, tree),
        Claim::NoSolution { tree: Tree::Branch { .. } } => Err(format!(
            "the cases of a tree are sides of boxes, but the problem's model is {model}"
        )),
        Claim::ConeSolution { .. } | Claim::BodySolution { .. } => Err(about_cones()),
        claim => Err(about_boxes(claim.kind(), model)),
    }
}

/// Why a model other than a box has no proofs of this kind.
pub(crate) fn about_boxes(kind: Kind, model: Model) -> String {
    format!("proofs of the kind {kind} are about boxes, but the problem's model is {model}")
}

/// Why a model other than a cone has no proofs of the kinds `cone-solution` and `body-solution`.
pub(crate) fn about_cones() -> String {
    "proofs of the kinds cone-solution and body-solution are about friction cones".into()
}

fn has_rows(lcp: &Lcp, entries: usize) -> Result<(), String> {
    match entries == lcp.len() {
        true => Ok(()),
        false => Err(format!("{entries} entries, the problem has {} rows", lcp.len())),
    }
}

/// The point, if it is a solution.
fn solution(lcp: &Lcp, x: &Vector) -> Result<Point, String> {
    let point = point(lcp, x)?;
    match Exact::new(lcp).is_solved_by(&point) {
        true => Ok(point),
        false => Err("the point is not a solution".into()),
    }
}

/// The exact point of a vector: entries at bounds are evaluated, those of coupled rows last.
pub(crate) fn point(lcp: &Lcp, x: &Vector) -> Result<Point, String> {
    has_rows(lcp, x.entries.len())?;
    let denominator = whole(x.denominator.clone());
    let mut numerators = vec![Dyadic::ZERO; lcp.len()];
    let (bounded, others): (Vec<usize>, Vec<usize>) =
        (0..lcp.len()).partition(|&i| lcp.is_coupled(i));
    for i in others.into_iter().chain(bounded) {
        let at = |is_hi: bool| match lcp.coupled_to(i) {
            Some((k, mu)) => {
                let reach = dyadic(mu) * numerators[k].clone().max(Dyadic::ZERO);
                Ok(if is_hi { reach } else { -reach })
            }
            None => match if is_hi { lcp.hi()[i] } else { lcp.lo()[i] } {
                bound if bound.is_finite() => Ok(dyadic(bound) * &denominator),
                _ => Err(format!("row {i} has no such bound")),
            },
        };
        numerators[i] = match &x.entries[i] {
            Entry::Numerator(numerator) => whole(numerator.clone()),
            Entry::Lo => at(false)?,
            Entry::Hi => at(true)?,
        };
    }
    Ok(Point::new(numerators, denominator))
}

fn is_near(point: &Point, near: &Near) -> Result<(), String> {
    let most = dyadic(near.distance) * point.denominator();
    let is_near = |(i, &answer): (usize, &f64)| {
        let miss = dyadic(answer) * point.denominator() - point.scaled(i);
        miss <= most && -miss <= most
    };
    match near.answer.len() {
        n if n != point.len() => Err(format!("the answer has {n} entries")),
        _ if near.answer.iter().enumerate().all(is_near) => Ok(()),
        _ => Err("the answer is farther from the solution than the distance".into()),
    }
}

fn is_bounded(lcp: &Lcp, bodies: Option<&Gauss>, bounded: &Bounded) -> Result<(), String> {
    let data = bodies.ok_or(NO_BODIES)?;
    if bounded.force.is_some() {
        return Err("forces belong to a proof about cones".into());
    }
    has_rows(lcp, bounded.answer.len())?;
    if bounded.motion.numerators.len() != data.target.len() {
        return Err(format!("the motion must have {} entries", data.target.len()));
    }
    let x: Vec<RBig> = bounded.answer.iter().map(|&x| rational(&dyadic(x))).collect();
    match Squares::of(lcp, data, &x, &bounded.motion.entries())?.prove(bounded.bound) {
        true => Ok(()),
        false => Err("the motion shows a larger bound only".into()),
    }
}

fn is_unique(lcp: &Lcp, by: Reason) -> Result<(), String> {
    if lcp.has_coupled_rows() {
        return Err("rows are coupled".into());
    }
    match by {
        Reason::Definite if lcp.len() > MOST_ROWS_OF_DEFINITE => {
            Err(format!("more than {MOST_ROWS_OF_DEFINITE} rows"))
        }
        Reason::Definite if minors::is_definite(lcp) => Ok(()),
        Reason::Definite => Err("A + Aᵀ is not positive definite".into()),
        Reason::PMatrix if lcp.len() > MOST_ROWS_OF_P => {
            Err(format!("more than {MOST_ROWS_OF_P} rows"))
        }
        Reason::PMatrix if minors::is_p(lcp) => Ok(()),
        Reason::PMatrix => Err("a principal minor of A is not positive".into()),
    }
}
