//! Searches for the strongest claim that can be proved.

use std::cell::OnceCell;

use dashu_int::IBig;
use dashu_ratio::RBig;

use lcplab_judge::cases::{self, Another, Search, Tree};
use lcplab_judge::{exact, refuting_vector};
use lcplab_lcp::exact::dyadic::{dyadic, rational, whole};
use lcplab_lcp::exact::{Exact, Point};
use lcplab_lcp::friction::ProblemForm;
use lcplab_lcp::number::{counted, readable};
use lcplab_lcp::{Lcp, Question};

use crate::check::{MOST_ROWS_OF_DEFINITE, MOST_ROWS_OF_P, about_boxes, about_cones, check};
use crate::claim::{Claim, Entry, Kind, Near, Proof, Reason, Vector, over_one_denominator};
use crate::hash::{model, rows};
use crate::{cone, cone_motion, hash, minors, motion, pivot, residual};

/// With more rows no exact solution is searched for: it would take hours.
const MOST_ROWS: usize = 500;
/// With more rows it is not decided whether A + Aᵀ is definite: elimination takes too long.
const MOST_ROWS_TO_ELIMINATE: usize = 150;

/// A given answer is a solution if an exact one is within this part of its largest entry.
const MOST_APART: f64 = 1e-6;

/// The result of a search for a proof.
#[derive(Debug, Clone)]
pub struct ProofSearch {
    /// The strongest proof; `None` if there is not even a finite residual.
    pub proof: Option<Proof>,
    /// The stronger kinds that were tried, and why there is no proof of them.
    pub missing: Vec<(Kind, String)>,
}

impl ProofSearch {
    /// Why nothing was proved about a problem whose model is not a box, if that is the case.
    pub fn refusal(&self, question: &Question) -> Option<String> {
        if self.proof.is_some() || question.boxed().is_some() {
            return None;
        }
        let model = model(question);
        Some(match self.missing.as_slice() {
            [(kind, reason)] if *kind != Kind::NoSolution => {
                format!("is {model}: no proof of kind {kind}: {reason}")
            }
            _ if matches!(question.posed(), ProblemForm::Cone(_)) => format!(
                "is {model}: neither a solution near the answer was found, nor a Farkas vector, which would prove that \
                 no solution exists; other proofs are about boxes"
            ),
            _ => format!(
                "is {model}: only the absence of a solution can be proved under it, and no such proof was \
                 found; other proofs are about boxes"
            ),
        })
    }
}

/// Searches for the strongest proof: `no-solution`, `unique`, `not-unique`, `solution`, `motion`,
/// `within`, in this order, starting from the answer. Under a polygon only `no-solution` is
/// possible, by a vector that proves it for every model; under a cone also `not-unique`,
/// `solution`, `cone-solution` and `body-solution`.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix, Question};
/// use lcplab_proof::{Kind, check, prove};
///
/// // w = −x − 1 is negative for every x ≥ 0.
/// let lcp = Lcp::new(Matrix::from([[-1.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let question = Question::new(&Problem::new("no way", lcp), None, "none.json")?;
/// let proof = prove(&question, &[0.0]).proof.expect("a proof");
/// assert_eq!(proof.claim.kind(), Kind::NoSolution);
/// assert_eq!(check(&question, &proof), Ok(()));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If the answer does not have one entry per row.
pub fn prove(question: &Question, answer: &[f64]) -> ProofSearch {
    let prover = Prover::new(question, answer);
    let mut missing = Vec::new();
    let is_cone = matches!(question.posed(), ProblemForm::Cone(_));
    let is_tried = |kind: &Kind| match kind {
        Kind::ConeSolution | Kind::BodySolution => is_cone,
        kind => *kind != Kind::FrozenMotion,
    };
    for kind in Kind::ALL.into_iter().filter(is_tried) {
        match prover.proof(kind) {
            Ok(proof) => {
                if kind == Kind::NotUnique {
                    let unique = missing.iter_mut().filter(|(kind, _)| *kind == Kind::Unique);
                    unique.for_each(|(_, reason)| *reason = "there are several solutions".into());
                }
                return ProofSearch { proof: Some(proof), missing };
            }
            Err(reason) => missing.push((kind, reason)),
        }
    }
    ProofSearch { proof: None, missing }
}

/// Searches for a proof of this kind only.
///
/// # Panics
/// If the answer does not have one entry per row.
pub fn prove_kind(question: &Question, answer: &[f64], kind: Kind) -> ProofSearch {
    match Prover::new(question, answer).proof(kind) {
        Ok(proof) => ProofSearch { proof: Some(proof), missing: Vec::new() },
        Err(reason) => ProofSearch { proof: None, missing: vec![(kind, reason)] },
    }
}

/// Proves that two answers are two different solutions (`not-unique`): each must lie within 10⁻⁶ of
/// its largest entry of an exact solution.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix, Question};
/// use lcplab_proof::{Kind, check, prove_different};
///
/// // The same contact twice: x₀ + x₁ = 1 in any shares.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let question = Question::new(&Problem::new("twice", lcp), None, "twice.json")?;
/// let proof = prove_different(&question, &[1.0, 0.0], &[0.25, 0.75]).proof.expect("a proof");
/// assert_eq!(proof.claim.kind(), Kind::NotUnique);
/// assert_eq!(check(&question, &proof), Ok(()));
/// let none = prove_different(&question, &[1.0, 0.0], &[1.0, 1.0]);
/// let reason = "the second answer is 1 away from the exact solution on its active set";
/// assert_eq!(none.missing, [(Kind::NotUnique, reason.into())]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Panics
/// If an answer does not have one entry per row.
pub fn prove_different(question: &Question, first: &[f64], second: &[f64]) -> ProofSearch {
    let prover = Prover::new(question, first);
    assert_eq!(second.len(), first.len(), "an answer needs one entry per row");
    let claim = match (question.boxed(), question.posed()) {
        (Some(lcp), _) => different(lcp, first, second),
        (None, ProblemForm::Cone(problem)) => {
            cone::different(problem, [first, second], |x| vector(rows(question), x))
        }
        (None, _) => Err(about_boxes(Kind::NotUnique, model(question))),
    };
    match claim.and_then(|claim| prover.checked(claim)) {
        Ok(proof) => ProofSearch { proof: Some(proof), missing: Vec::new() },
        Err(reason) => ProofSearch { proof: None, missing: vec![(Kind::NotUnique, reason)] },
    }
}

fn different(lcp: &Lcp, first: &[f64], second: &[f64]) -> Result<Claim, String> {
    let x = given_solution(lcp, first, "first")?;
    let y = given_solution(lcp, second, "second")?;
    if x == y {
        return Err("both answers lie next to the same exact solution".into());
    }
    Ok(Claim::NotUnique { x: vector(lcp, &x), y: vector(lcp, &y) })
}

/// The exact solution next to an answer.
fn given_solution(lcp: &Lcp, answer: &[f64], which: &str) -> Result<Vec<RBig>, String> {
    if !answer.iter().all(|x| x.is_finite()) {
        return Err(format!("the {which} answer is not finite"));
    }
    let exact::Proof { x, distance, .. } = exact::prove(lcp, answer)
        .ok_or(format!("the {which} answer has no exact solution on its active set"))?;
    is_near(answer, distance, &format!("the {which}"))?;
    Ok(x)
}

/// Whether an answer is so near to its exact solution that it stands for it.
pub(crate) fn is_near(answer: &[f64], distance: f64, which: &str) -> Result<(), String> {
    let size = answer.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    if distance > MOST_APART * size {
        let distance = readable(distance, 3);
        return Err(format!(
            "{which} answer is {distance} away from the exact solution on its active set"
        ));
    }
    Ok(())
}

/// An exact solution, and a direction in which it can move if one was found.
struct Solution {
    x: Vec<RBig>,
    direction: Option<Vec<RBig>>,
}

enum Solvable {
    Yes(Solution),
    No(Tree),
}

struct Prover<'a> {
    question: &'a Question,
    answer: &'a [f64],
    /// Whether there is a solution, computed once.
    solvable: OnceCell<Result<Solvable, String>>,
}

impl<'a> Prover<'a> {
    fn new(question: &'a Question, answer: &'a [f64]) -> Self {
        assert_eq!(answer.len(), rows(question).len(), "an answer needs one entry per row");
        Prover { question, answer, solvable: OnceCell::new() }
    }

    /// The proof of a claim of this kind; it is checked before it is returned.
    fn proof(&self, kind: Kind) -> Result<Proof, String> {
        let claim = match self.question.boxed() {
            Some(lcp) => self.of_boxes(lcp, kind)?,
            None => match (self.question.posed(), kind) {
                (ProblemForm::Cone(problem), Kind::Solution | Kind::ConeSolution) => {
                    cone::search(problem, self.answer, kind, |x| vector(rows(self.question), x))?
                }
                (ProblemForm::Cone(problem), Kind::NotUnique) => {
                    cone::second(problem, self.answer, |x| vector(rows(self.question), x))?
                }
                (ProblemForm::Cone(problem), Kind::BodySolution) => {
                    let bodies = self.question.problem().motion.as_ref();
                    cone::search_bodies(problem, bodies, self.answer)?
                }
                (ProblemForm::Cone(problem), Kind::Motion) => {
                    let bodies = self.question.problem().motion.as_ref();
                    Claim::Motion(cone_motion::search(problem, bodies, self.answer)?)
                }
                _ => self.of_any_model(kind)?,
            },
        };
        self.checked(claim)
    }

    /// The proof with this claim, if the checker accepts it.
    fn checked(&self, claim: Claim) -> Result<Proof, String> {
        let has_friction = rows(self.question).has_coupled_rows();
        let stated = self.question.model().or(has_friction.then(|| model(self.question)));
        let proof = Proof { problem: hash(self.question), model: stated, claim };
        check(self.question, &proof).map_err(|reason| format!("its proof fails: {reason}"))?;
        Ok(proof)
    }

    /// A claim that is valid under every friction model.
    fn of_any_model(&self, kind: Kind) -> Result<Claim, String> {
        if matches!(kind, Kind::ConeSolution | Kind::BodySolution) {
            return Err(about_cones());
        }
        if kind != Kind::NoSolution {
            return Err(about_boxes(kind, model(self.question)));
        }
        let lcp = rows(self.question);
        let refuting =
            || refuting_vector(lcp, &[self.answer], 0.0).map(|farkas| integers(&farkas.vector));
        let vector = cases::single_vector(lcp).or_else(refuting);
        let vector = vector
            .ok_or("no Farkas vector was found (it would be valid under every friction model)")?;
        Ok(Claim::NoSolution { tree: Tree::Leaf(vector) })
    }

    fn of_boxes(&self, lcp: &Lcp, kind: Kind) -> Result<Claim, String> {
        let answer = self.answer;
        let motion = || motion::search(lcp, self.question.problem().motion.as_ref(), answer);
        match kind {
            Kind::NoSolution => match self.solvable(lcp)? {
                Solvable::No(tree) => Ok(Claim::NoSolution { tree: tree.clone() }),
                Solvable::Yes(_) => Err("a solution exists".into()),
            },
            Kind::Unique => {
                let x = vector(lcp, &self.solution(lcp)?.x);
                Ok(Claim::Unique { x, by: unique(lcp)? })
            }
            Kind::NotUnique => {
                let solution = self.solution(lcp)?;
                let y = another(lcp, solution)?;
                Ok(Claim::NotUnique { x: vector(lcp, &solution.x), y: vector(lcp, &y) })
            }
            Kind::Solution => {
                let x = &self.solution(lcp)?.x;
                Ok(Claim::Solution { x: vector(lcp, x), near: near(answer, x) })
            }
            Kind::ConeSolution | Kind::BodySolution => Err(about_cones()),
            Kind::Motion if lcp.has_coupled_rows() => {
                Err("rows are coupled: the LCP is then not equivalent to a minimization; try the kind frozen-motion".into())
            }
            Kind::FrozenMotion if !lcp.has_coupled_rows() => Err("no rows are coupled".into()),
            Kind::Motion => motion().map(Claim::Motion),
            Kind::FrozenMotion => motion().map(Claim::FrozenMotion),
            Kind::Within => {
                let is_finite = answer.iter().all(|x| x.is_finite());
                let residual = if is_finite { residual::scaled(lcp, answer) } else { None };
                let residual = residual.ok_or("the residual of the answer is not finite")?;
                Ok(Claim::Within { answer: answer.to_vec(), residual })
            }
        }
    }

    fn solution(&self, lcp: &Lcp) -> Result<&Solution, String> {
        match self.solvable(lcp) {
            Ok(Solvable::Yes(solution)) => Ok(solution),
            Ok(Solvable::No(_)) => Err("no solution exists".into()),
            Err(_) => Err("no exact solution was found".into()),
        }
    }

    fn solvable(&self, lcp: &Lcp) -> Result<&Solvable, String> {
        let found = self.solvable.get_or_init(|| solvable(lcp, self.answer));
        found.as_ref().map_err(String::clone)
    }
}

/// A solution, a proof that there is none, or the reason why neither was found.
fn solvable(lcp: &Lcp, answer: &[f64]) -> Result<Solvable, String> {
    let at = |x| Ok(Solvable::Yes(Solution { x, direction: None }));
    if lcp.len() > MOST_ROWS {
        return Err(format!(
            "{} are too many: at most {MOST_ROWS} are solved exactly",
            counted(lcp.len(), "row")
        ));
    }
    if answer.iter().all(|x| x.is_finite())
        && let Some(exact::Proof { x, null_direction, .. }) = exact::prove(lcp, answer)
    {
        return Ok(Solvable::Yes(Solution { x, direction: null_direction }));
    }
    if let Some(sides) = pivot::sides(lcp) {
        let exact = Exact::new(lcp);
        let point = exact.point(&sides, &vec![0.0; lcp.len()]).map(|(point, _)| point);
        if let Some(point) = point.filter(|point| exact.is_solved_by(point)) {
            return at(point.entries());
        }
    }
    match cases::search(lcp, cases::MOST_PROGRAMS) {
        Some(Search::Solution(point)) => return at(point.entries()),
        Some(Search::None(tree)) => return Ok(Solvable::No(tree)),
        None => {}
    }
    match refuting_vector(lcp, &[answer], 0.0) {
        Some(farkas) => Ok(Solvable::No(Tree::Leaf(integers(&farkas.vector)))),
        None if lcp.len() > cases::MOST_ROWS => Err(format!(
            "no Farkas vector was found, and {} are too many to split into cases",
            counted(lcp.len(), "row")
        )),
        None => Err("no Farkas vector was found, and there are too many cases".into()),
    }
}

/// The distance of a finite answer from x, if it is a finite number.
fn near(answer: &[f64], x: &[RBig]) -> Option<Near> {
    if !answer.iter().all(|x| x.is_finite()) {
        return None;
    }
    let misses = answer.iter().zip(x).map(|(&own, x)| rational(&dyadic(own)) - x);
    let most = misses.map(|miss| if miss < RBig::ZERO { -miss } else { miss }).max();
    let distance = lcplab_lcp::exact::rounded_up(&most.unwrap_or_default());
    distance.is_finite().then(|| Near { answer: answer.to_vec(), distance })
}

/// Why there is at most one solution.
fn unique(lcp: &Lcp) -> Result<Reason, String> {
    if lcp.has_coupled_rows() {
        return Err("some rows are coupled, and no theorem used here covers them".into());
    }
    let most = MOST_ROWS_TO_ELIMINATE.min(MOST_ROWS_OF_DEFINITE);
    if lcp.len() <= most && minors::is_definite(lcp) {
        return Ok(Reason::Definite);
    }
    if lcp.len() <= MOST_ROWS_OF_P && minors::is_p(lcp) {
        return Ok(Reason::PMatrix);
    }
    Err(match lcp.len() {
        n if n <= MOST_ROWS_OF_P => "A + Aᵀ is not definite, and A is not a P-matrix".into(),
        n if n <= most => {
            format!("A + Aᵀ is not definite, and {n} rows are too many for all principal minors")
        }
        n => format!("{n} rows are too many"),
    })
}

/// Finds another solution.
fn another(lcp: &Lcp, solution: &Solution) -> Result<Vec<RBig>, String> {
    let exact = Exact::new(lcp);
    let moved = |step: &RBig, d: &[RBig]| -> Vec<RBig> {
        solution.x.iter().zip(d).map(|(x, d)| x + step * d).collect()
    };
    if let Some(d) = &solution.direction {
        let mut step = RBig::ONE;
        for _ in 0..2000 {
            let y = moved(&step, d);
            if exact.is_solved_by(&point(&y)) {
                return Ok(y);
            }
            step /= RBig::from(2);
        }
    }
    match cases::another(lcp, &point(&solution.x), programs_for(lcp.len())) {
        Some(Another::Solution(other)) => Ok(other.entries()),
        Some(Another::None) => Err("all cases were tried, and there is no other solution".into()),
        None if lcp.len() > cases::MOST_ROWS => Err(format!(
            "no direction was found in which the solution can be moved, and {} are too many to split into cases",
            counted(lcp.len(), "row")
        )),
        None => Err("no other solution was found, and there are too many cases".into()),
    }
}

/// Limit on the linear programs of a search for another solution. The time of each grows with the
/// cube of the rows: the limit is 20 to 30 seconds.
fn programs_for(rows: usize) -> usize {
    (cases::MOST_PROGRAMS * 12usize.pow(3) / rows.max(12).pow(3)).max(1)
}

fn point(x: &[RBig]) -> Point {
    let (numerators, denominator) = over_one_denominator(x);
    Point::new(numerators.into_iter().map(whole).collect(), whole(denominator))
}

/// The shortest notation: an entry at a nonzero bound is written as that bound.
fn vector(lcp: &Lcp, x: &[RBig]) -> Vector {
    let exact = |bound: f64| bound.is_finite().then(|| rational(&dyadic(bound)));
    let bounds = |i: usize| match lcp.coupled_to(i) {
        Some((k, mu)) => {
            let reach = rational(&dyadic(mu)) * &x[k];
            (Some(-reach.clone()), Some(reach))
        }
        None => (exact(lcp.lo()[i]), exact(lcp.hi()[i])),
    };
    let named = |(i, own): (usize, &RBig)| match bounds(i) {
        _ if *own == RBig::ZERO => None,
        (Some(lo), _) if lo == *own => Some(Entry::Lo),
        (_, Some(hi)) if hi == *own => Some(Entry::Hi),
        _ => None,
    };
    let names: Vec<Option<Entry>> = x.iter().enumerate().map(named).collect();
    let unnamed = x.iter().zip(&names).filter(|(_, name)| name.is_none()).map(|(x, _)| x.clone());
    let (numerators, denominator) = over_one_denominator(&unnamed.collect::<Vec<_>>());
    let mut numerators = numerators.into_iter().map(Entry::Numerator);
    let entries = names.into_iter().filter_map(|name| name.or_else(|| numerators.next())).collect();
    Vector { denominator, entries }
}

/// A direction as integers with their rows; entries equal to 0 are omitted.
fn integers(d: &[RBig]) -> Vec<(usize, IBig)> {
    let (numerators, _) = over_one_denominator(d);
    numerators.into_iter().enumerate().filter(|(_, d)| *d != IBig::ZERO).collect()
}
