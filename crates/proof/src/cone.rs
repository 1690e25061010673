//! Proofs about problems with friction cones: a rational solution, or a box that contains one.

use dashu_int::IBig;
use dashu_ratio::RBig;

use lcplab_judge::{
    ConeProof, Enclosure, RowState, another_cone_solution, cone_body_proof, nearest_cone_proof,
};
use lcplab_lcp::exact::Point;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, whole};
use lcplab_lcp::friction::ConeProblem;
use lcplab_lcp::{Gauss, Lcp};

use crate::check::point;
use crate::claim::{Claim, Entry, Kind, Near, Region, Vector};
use crate::motion::NO_BODIES;
use crate::prove::is_near;

/// With more rows no solution is searched for: its test takes minutes.
const MOST_ROWS: usize = 200;

/// Checks that a box contains a solution, for the exact numbers of the bodies if these are given,
/// and that the answer is near enough.
///
/// # Errors
/// Why the box proves nothing.
pub fn check(
    problem: &ConeProblem,
    rows: &Lcp,
    bodies: Option<&Gauss>,
    region: &Region,
    near: Option<&Near>,
) -> Result<(), String> {
    let Region { states, redundant, bias_change, center, radius, inverse } = region;
    let enclosure = Enclosure {
        states: states.clone(),
        redundant: redundant.clone(),
        bias_change: *bias_change,
        center: with_motion(rows, bodies.map_or(0, |bodies| bodies.target.len()), center)?,
        radius: radius.iter().map(|radius| whole(radius.clone())).collect(),
        inverse: inverse.clone(),
    };
    match bodies {
        Some(bodies) => enclosure.check_bodies(problem, bodies)?,
        None => enclosure.check(problem)?,
    }
    match near {
        Some(near) if near.answer.len() != rows.len() => {
            Err(format!("the answer has {} entries", near.answer.len()))
        }
        Some(near) if enclosure.distance(&near.answer) > near.distance => {
            Err("the answer is farther from the box than the distance".into())
        }
        _ => Ok(()),
    }
}

/// The point of a vector whose last entries are those of a motion.
fn with_motion(rows: &Lcp, motion: usize, center: &Vector) -> Result<Point, String> {
    let n = rows.len();
    if center.entries.len() != n + motion {
        return Err(format!("the center must have {} entries", n + motion));
    }
    let (of_x, of_u) = center.entries.split_at(n);
    let denominator = center.denominator.clone();
    let x = point(rows, &Vector { denominator, entries: of_x.to_vec() })?;
    let u = of_u.iter().map(|entry| match entry {
        Entry::Numerator(numerator) => Ok(whole(numerator.clone())),
        Entry::Lo | Entry::Hi => Err("a motion has no bounds".to_string()),
    });
    let x = (0..n).map(|i| Ok(x.scaled(i).clone()));
    Ok(Point::new(x.chain(u).collect::<Result<_, String>>()?, whole(center.denominator.clone())))
}

/// A claim of the kind `body-solution`.
///
/// # Errors
/// Why there is none.
pub fn search_bodies(
    problem: &ConeProblem,
    bodies: Option<&Gauss>,
    answer: &[f64],
) -> Result<Claim, String> {
    let bodies = bodies.ok_or(NO_BODIES)?;
    is_possible(answer)?;
    let enclosure = cone_body_proof(problem, bodies, answer)
        .ok_or("no exact solution was found from the states of the contacts in the answer")?;
    let distance = enclosure.distance(answer);
    let near = distance.is_finite().then(|| Near { answer: answer.to_vec(), distance });
    Ok(Claim::BodySolution { region: region(enclosure), near })
}

fn is_possible(answer: &[f64]) -> Result<(), String> {
    if answer.len() > MOST_ROWS {
        return Err(format!("{} rows are too many: at most {MOST_ROWS} are tried", answer.len()));
    }
    if !answer.iter().all(|x| x.is_finite()) {
        return Err("the answer is not finite".into());
    }
    Ok(())
}

/// A claim of one of the kinds `solution` and `cone-solution`.
///
/// # Errors
/// Why there is none.
pub fn search(
    problem: &ConeProblem,
    answer: &[f64],
    kind: Kind,
    vector: impl FnOnce(&[RBig]) -> Vector,
) -> Result<Claim, String> {
    is_possible(answer)?;
    let proof = nearest_cone_proof(problem, answer)
        .ok_or("no exact solution was found from the states of the contacts in the answer")?;
    let distance = proof.distance(answer);
    let near = distance.is_finite().then(|| Near { answer: answer.to_vec(), distance });
    match (kind, proof) {
        (Kind::Solution, ConeProof::Point(x)) => {
            Ok(Claim::Solution { x: vector(&x.entries()), near })
        }
        (Kind::Solution, ConeProof::Enclosure(_)) => {
            Err("contacts slide, and no rational solution was found".into())
        }
        (_, ConeProof::Enclosure(enclosure)) => {
            Ok(Claim::ConeSolution { region: region(enclosure), near })
        }
        (_, ConeProof::Point(_)) => {
            Err("the solution is rational: the kind solution proves it".into())
        }
    }
}

/// A claim of the kind `not-unique`: the solution next to the answer, and another one.
///
/// # Errors
/// Why there is none.
pub fn second(
    problem: &ConeProblem,
    answer: &[f64],
    vector: impl Fn(&[RBig]) -> Vector,
) -> Result<Claim, String> {
    let (x, _) = rational(problem, answer, "the")?;
    let y = another_cone_solution(problem, &x)
        .ok_or("no other way was found in which the contacts can share their loads")?;
    Ok(Claim::NotUnique { x: vector(&x.entries()), y: vector(&y.entries()) })
}

/// A claim of the kind `not-unique`: the solutions next to two answers.
///
/// # Errors
/// Why there is none.
pub fn different(
    problem: &ConeProblem,
    [first, second]: [&[f64]; 2],
    vector: impl Fn(&[RBig]) -> Vector,
) -> Result<Claim, String> {
    let near = |answer, which| {
        let (x, distance) = rational(problem, answer, which)?;
        is_near(answer, distance, which).map(|()| vector(&x.entries()))
    };
    let (x, y) = (near(first, "the first")?, near(second, "the second")?);
    match x == y {
        true => Err("both answers lie next to the same exact solution".into()),
        false => Ok(Claim::NotUnique { x, y }),
    }
}

/// The rational solution next to an answer, and its distance.
fn rational(problem: &ConeProblem, answer: &[f64], which: &str) -> Result<(Point, f64), String> {
    is_possible(answer)?;
    match nearest_cone_proof(problem, answer) {
        Some(ConeProof::Point(x)) => {
            let distance = x.distance(answer);
            Ok((x, distance))
        }
        Some(ConeProof::Enclosure(_)) => {
            Err(format!("contacts slide in {which} answer, so that its solution is not rational"))
        }
        None => Err(format!("no exact solution was found next to {which} answer")),
    }
}

/// A box as integers over a common power of two.
fn region(enclosure: Enclosure) -> Region {
    let Enclosure { states, redundant, bias_change, center, radius, inverse } = enclosure;
    let is_bound = |i: usize| matches!(states[i], RowState::Lower | RowState::Upper);
    let numbers = (0..states.len()).filter(|&i| !is_bound(i)).map(|i| center.scaled(i));
    let nonzero = numbers.chain(&radius).filter(|x| **x != Dyadic::ZERO);
    let last = nonzero.map(|x| x.repr().exponent()).min().unwrap_or(0).min(0);
    let integer = |x: &Dyadic| -> IBig { (x.clone() << -last).to_int().value() };
    let entry = |i: usize| match states[i] {
        RowState::Lower => Entry::Lo,
        RowState::Upper => Entry::Hi,
        _ => Entry::Numerator(integer(center.scaled(i))),
    };
    let entries = (0..states.len()).map(entry).collect();
    let denominator = integer(&dyadic(1.0));
    let radius = radius.iter().map(integer).collect();
    let center = Vector { denominator, entries };
    Region { states, redundant, bias_change, center, radius, inverse }
}
