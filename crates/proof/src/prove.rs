//! The strongest claim that can be proved.

use dashu_int::IBig;
use dashu_int::ops::Gcd;
use dashu_ratio::RBig;

use lcplab_judge::{exact, refuting_vector};
use lcplab_problem::Lcp;
use lcplab_problem::exact::dyadic::{dyadic, rational};
use lcplab_problem::exact::{Exact, Point, all_solutions};

use crate::cases::{self, Search};
use crate::check::{MOST_ROWS_OF_P, check};
use crate::claim::{Claim, Entry, Near, Proof, Reason, Tree, Vector};
use crate::{hash, minors, pivot, residual};

/// With more rows it is not decided whether A + Aᵀ is definite: elimination takes too long.
const MOST_ROWS_OF_DEFINITE: usize = 150;
/// With more rows a second solution is not looked for in all pieces.
const MOST_ROWS_OF_PIECES: usize = 8;

/// What was found.
#[derive(Debug, Clone)]
pub struct Found {
    /// The strongest proof; `None` if there is not even a finite residual.
    pub proof: Option<Proof>,
    /// The stronger kinds, and why there is no proof of them.
    pub missing: Vec<(&'static str, String)>,
}

/// Looks for the strongest proof: `no-solution`, `unique`, `not-unique`, `solution`, `within`, in this order. The
/// answer is where it begins.
///
/// # Panics
/// If the answer has not an entry a row.
pub fn prove(lcp: &Lcp, answer: &[f64]) -> Found {
    assert_eq!(answer.len(), lcp.len(), "an answer needs one entry a row");
    let mut missing = Vec::new();
    let claim = match solvable(lcp, answer) {
        Ok(Solvable::No(tree)) => Some(Claim::NoSolution { tree }),
        Ok(Solvable::Yes(solution)) => {
            missing.push(("no-solution", "a solution exists".to_string()));
            Some(solved(lcp, answer, &solution, &mut missing))
        }
        Err(reason) => {
            missing.push(("no-solution", reason));
            for kind in ["unique", "not-unique", "solution"] {
                missing.push((kind, "no exact solution was found".into()));
            }
            let is_finite = answer.iter().all(|x| x.is_finite());
            let residual = if is_finite { residual::scaled(lcp, answer) } else { None };
            if residual.is_none() {
                missing.push(("within", "the residual of the answer is not finite".into()));
            }
            residual.map(|residual| Claim::Within { answer: answer.to_vec(), residual })
        }
    };
    let proof = claim.map(|claim| Proof { problem: hash(lcp), claim });
    debug_assert!(proof.as_ref().is_none_or(|proof| check(lcp, proof).is_ok()));
    Found { proof, missing }
}

/// An exact solution, and a direction in which it can be moved if one was seen.
struct Solution {
    x: Vec<RBig>,
    direction: Option<Vec<RBig>>,
}

enum Solvable {
    Yes(Solution),
    No(Tree),
}

/// A solution or a proof that there is none, or why there is neither.
fn solvable(lcp: &Lcp, answer: &[f64]) -> Result<Solvable, String> {
    if answer.iter().all(|x| x.is_finite()) {
        let w = lcp.w(answer);
        if let Some(exact::Proof { x, null_direction, .. }) = exact::prove(lcp, answer, &w) {
            return Ok(Solvable::Yes(Solution { x, direction: null_direction }));
        }
    }
    if let Some(sides) = pivot::sides(lcp) {
        let exact = Exact::new(lcp);
        let point = exact.point(&sides, &vec![0.0; lcp.len()]).map(|(point, _)| point);
        if let Some(point) = point.filter(|point| exact.is_solved_by(point)) {
            return Ok(Solvable::Yes(Solution { x: point.entries(), direction: None }));
        }
    }
    match cases::search(lcp) {
        Some(Search::Solution(point)) => {
            return Ok(Solvable::Yes(Solution { x: point.entries(), direction: None }));
        }
        Some(Search::None(tree)) => return Ok(Solvable::No(tree)),
        None => {}
    }
    match refuting_vector(lcp, &[answer]) {
        Some(farkas) => Ok(Solvable::No(Tree::Leaf(integers(&farkas.vector)))),
        None if lcp.len() > cases::MOST_ROWS => Err(format!(
            "no vector shows it, and {} rows are too many to split into cases",
            lcp.len()
        )),
        None => Err("no vector shows it, and there are too many cases".into()),
    }
}

/// The strongest claim about a problem with this solution.
fn solved(
    lcp: &Lcp,
    answer: &[f64],
    solution: &Solution,
    missing: &mut Vec<(&'static str, String)>,
) -> Claim {
    let x = vector(lcp, &solution.x);
    match unique(lcp) {
        Ok(by) => return Claim::Unique { x, by },
        Err(reason) => missing.push(("unique", reason)),
    }
    match another(lcp, solution) {
        Ok(y) => return Claim::NotUnique { x, y: vector(lcp, &y) },
        Err(reason) => missing.push(("not-unique", reason)),
    }
    let is_finite = answer.iter().all(|x| x.is_finite());
    let distance = || {
        let exact = answer.iter().zip(&solution.x).map(|(&own, x)| rational(&dyadic(own)) - x);
        let most = exact.map(|miss| if miss < RBig::ZERO { -miss } else { miss }).max();
        lcplab_problem::exact::rounded_up(&most.unwrap_or_default())
    };
    let near = is_finite.then(|| Near { answer: answer.to_vec(), distance: distance() });
    Claim::Solution { x, near: near.filter(|near| near.distance.is_finite()) }
}

/// Why there is at most one solution.
fn unique(lcp: &Lcp) -> Result<Reason, String> {
    if lcp.coupling().is_some_and(|coupling| !coupling.is_empty()) {
        return Err("rows are coupled, for which no theorem is at hand".into());
    }
    if lcp.len() <= MOST_ROWS_OF_DEFINITE && minors::is_definite(lcp) {
        return Ok(Reason::Definite);
    }
    if lcp.len() <= MOST_ROWS_OF_P && minors::is_p(lcp) {
        return Ok(Reason::PMatrix);
    }
    Err(match lcp.len() {
        n if n <= MOST_ROWS_OF_P => "A + Aᵀ is not definite, and A is no P-matrix".into(),
        n if n <= MOST_ROWS_OF_DEFINITE => {
            format!("A + Aᵀ is not definite, and {n} rows are too many for all principal minors")
        }
        n => format!("{n} rows are too many"),
    })
}

/// Another solution.
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
    if lcp.len() > MOST_ROWS_OF_PIECES {
        return Err("no direction was found in which the solution can be moved".into());
    }
    let all = all_solutions(lcp).unwrap_or_default();
    let other = all.into_iter().find(|other| *other != solution.x);
    other.ok_or_else(|| "no other solution was found in all pieces".into())
}

/// Fractions as integers over one denominator.
fn common(x: &[RBig]) -> (Vec<IBig>, IBig) {
    let denominator = x.iter().fold(IBig::ONE, |common, x| {
        let own = IBig::from(x.denominator().clone());
        let shared = IBig::from((&common).gcd(&own));
        common * (own / shared)
    });
    let numerator = |x: &RBig| x.numerator() * (&denominator / IBig::from(x.denominator().clone()));
    (x.iter().map(numerator).collect(), denominator)
}

fn point(x: &[RBig]) -> Point {
    use lcplab_problem::exact::dyadic::whole;
    let (numerators, denominator) = common(x);
    Point::new(numerators.into_iter().map(whole).collect(), whole(denominator))
}

/// The shortest way to write it: a bound other than 0 by its name.
fn vector(lcp: &Lcp, x: &[RBig]) -> Vector {
    let exact = |bound: f64| bound.is_finite().then(|| rational(&dyadic(bound)));
    let bounds = |i: usize| match lcp.coupling().and_then(|c| Some((c.index(i)?, c.mu(i)))) {
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
    let (numerators, denominator) = common(&unnamed.collect::<Vec<_>>());
    let mut numerators = numerators.into_iter().map(Entry::Numerator);
    let entries = names.into_iter().filter_map(|name| name.or_else(|| numerators.next())).collect();
    Vector { denominator, entries }
}

/// A direction as integers; entries that are 0 are left out.
fn integers(d: &[RBig]) -> Vec<(usize, IBig)> {
    let (numerators, _) = common(d);
    numerators.into_iter().enumerate().filter(|(_, d)| *d != IBig::ZERO).collect()
}
