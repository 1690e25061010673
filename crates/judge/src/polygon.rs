//! Checks whether x solves a problem whose friction is a polygon.
//!
//! The judge computes the unknowns β (impulses) and γ (slip speed) for x and the residuals of their
//! LCP ([`residual::polygon`](super::residual::polygon)). Rounding and distances refer to x only,
//! because γ is a speed and not part of an answer. Exact solutions are found for polygons with four
//! corners only: the directions of other polygons are rounded numbers.

use super::certificate::Evidence;
use super::exact::{ExactSolution, is_within, nearest};
use super::neighbor;
use super::refutation::{Existence, Refutation, existence, refuting_vector};
use super::residual::{Residual, Rows, improves_on_zero, polygon, worst};
use super::{Demand, FrictionCertificate, Refusal, Verdict, is_near};
use lcplab_lcp::friction::Polyhedral;

/// The directions of a polygon with this number of corners are exact.
const EXACT_CORNERS: usize = 4;

/// Judges x for a problem whose friction is a polygon. An x that is off only by rounding is
/// accepted as in [`judge`](super::judge()).
pub(super) fn judge_polygon(
    polyhedral: &Polyhedral,
    x: &[f64],
    demand: &Demand,
) -> FrictionCertificate {
    let certificate = judge_as_given(polyhedral, x, demand);
    if certificate.verdict.is_solution() || !x.iter().all(|x| x.is_finite()) {
        return certificate;
    }
    let (lcp, contacts) = (polyhedral.friction().lcp(), polyhedral.friction().contacts());
    let z = polygon::unknowns(polyhedral, x);
    let rounding = neighbor::rounding_of(&neighbor::sizes(lcp, contacts, x));
    let proof = proof(polyhedral, x, &z, demand)
        .filter(|(solved, _)| is_within(x, &polyhedral.exact_x(&solved.x).entries(), &rounding));
    if let Some((_, distance)) = proof {
        let (verdict, rounded_by) = (Verdict::Proved { distance }, Some(distance));
        return FrictionCertificate { verdict, rounded_by, ..certificate };
    }
    let judged = |x: &[f64]| judge_as_given(polyhedral, x, demand).verdict;
    match neighbor::verdict(lcp, contacts, x, judged) {
        Some((verdict, moved)) => {
            FrictionCertificate { verdict, rounded_by: Some(moved), ..certificate }
        }
        None => certificate,
    }
}

/// Judges x itself, without its rounded neighbor.
fn judge_as_given(polyhedral: &Polyhedral, x: &[f64], demand: &Demand) -> FrictionCertificate {
    let z = polygon::unknowns(polyhedral, x);
    let found = polygon::residuals(polyhedral, x, &z);
    let mut residuals = vec![0.0; x.len()];
    for (row, own) in &found {
        residuals[*row] = f64::max(residuals[*row], own.relative);
    }
    let (worst_row, scaled_residual) = worst(residuals.iter().copied());
    let certificate = FrictionCertificate {
        w: Rows::at(polyhedral.friction().lcp(), x).w(),
        residuals,
        scaled_residual,
        worst_row,
        verdict: Verdict::rejected(x, worst_row, scaled_residual, demand.tolerance),
        rounded_by: None,
        evidence: None,
    };
    if !x.iter().all(|x| x.is_finite()) || !(scaled_residual <= demand.tolerance) {
        return certificate;
    }
    let proof = proof(polyhedral, x, &z, demand).map(|(_, distance)| distance);
    let verdict = match proof.filter(|&distance| is_near(x, distance)) {
        Some(distance) => Verdict::Proved { distance },
        None if !polygon_improves_on_zero(polyhedral, &found, demand.tolerance) => {
            refusal(worst_row, scaled_residual, Refusal::NoBetterThanZero)
        }
        // The solution is too far from x.
        None if proof.is_some() => Verdict::WithinTolerance,
        None => return searched(polyhedral, x, &z, certificate, demand),
    };
    FrictionCertificate { verdict, ..certificate }
}

fn refusal(row: usize, amount: f64, why: Refusal) -> Verdict {
    Verdict::NotASolution { row, amount, why }
}

/// The nearest exact solution found, and its distance from x.
fn proof(
    polyhedral: &Polyhedral,
    x: &[f64],
    z: &[f64],
    demand: &Demand,
) -> Option<(ExactSolution, f64)> {
    if polyhedral.directions() != EXACT_CORNERS || z.len() > demand.prove_up_to {
        return None;
    }
    let size = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
    nearest(polyhedral.lcp(), z, size, |point| polyhedral.exact_x(point).distance(x))
}

/// Whether x is ten times closer to a solution than Π(0), given the residuals of x.
fn polygon_improves_on_zero(
    polyhedral: &Polyhedral,
    found: &[(usize, Residual)],
    tolerance: f64,
) -> bool {
    let mut nothing = vec![0.0; polyhedral.lcp().len()];
    polyhedral.lcp().project_all(&mut nothing);
    let nothing = polyhedral.x(&nothing);
    let z = polygon::unknowns(polyhedral, &nothing);
    let of_nothing = polygon::residuals(polyhedral, &nothing, &z);
    let of = |found: &[(usize, Residual)]| found.iter().map(|(_, own)| *own).collect::<Vec<_>>();
    improves_on_zero(&of(found), &of(&of_nothing), tolerance)
}

/// The certificate of an x within the tolerance whose active set has no solution, after a search
/// for a solution elsewhere.
fn searched(
    polyhedral: &Polyhedral,
    x: &[f64],
    z: &[f64],
    certificate: FrictionCertificate,
    demand: &Demand,
) -> FrictionCertificate {
    let within = FrictionCertificate { verdict: Verdict::WithinTolerance, ..certificate };
    if z.len() > demand.prove_up_to {
        return within;
    }
    let impossible = |evidence: Option<Evidence>| {
        let verdict = refusal(within.worst_row, within.scaled_residual, Refusal::Impossible);
        FrictionCertificate { verdict, evidence, ..within.clone() }
    };
    if let Some(vector) =
        refuting_vector(&polyhedral.friction().coupled_box(), &[x], demand.tolerance)
    {
        return impossible(Some(Evidence::NoSolution(Refutation::Vector(vector))));
    }
    if polyhedral.directions() != EXACT_CORNERS {
        return within;
    }
    match existence(polyhedral.lcp(), &[z], demand.tolerance) {
        // The proof is about the rows of z, not of x.
        Existence::None(_) => impossible(None),
        Existence::Solution(point) => match polyhedral.exact_x(&point).distance(x) {
            distance if is_near(x, distance) => {
                FrictionCertificate { verdict: Verdict::Proved { distance }, ..within }
            }
            // It is one of several solutions, which says nothing about x.
            _ => within,
        },
        Existence::Insignificant(_) | Existence::Unknown => within,
    }
}
