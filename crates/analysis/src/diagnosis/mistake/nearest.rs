//! Finds the exact solution nearest to an answer, with which every mistake is compared.
//!
//! The active sets of the answer itself, of solvers and of sweeps are each solved in exact
//! arithmetic; components that the equations leave undetermined keep their value in the answer.
//! This finds the nearest of many solutions.

use lcplab_lcp::exact::{Exact, Side};
use lcplab_lcp::{Lcp, merit};
use lcplab_solver::{Enumeration, Lemke, Options, Registry, Settings, Start, Status, default_for};

/// Maximum number of rows for exact solutions; with more, the solutions of solvers are used
/// unchanged.
const EXACT_ROWS: usize = 50;
/// Maximum number of rows for which all active sets are tried.
const ENUMERATED_ROWS: usize = 8;
/// An entry within this fraction of the largest of a bound is at the bound.
const AT_BOUND: f64 = 1e-12;

/// The solution nearest to x among those found from these points and solvers; `None` if there are
/// none.
pub(super) fn nearest_solution(lcp: &Lcp, x: &[f64], points: &[Vec<f64>]) -> Option<Vec<f64>> {
    let tolerance = Settings::default().tolerance;
    let points: Vec<Vec<f64>> =
        any_solution(lcp).into_iter().chain(points.iter().cloned()).collect();
    let mut all = exact_solutions(lcp, x, &points);
    all.extend(points.into_iter().filter(|y| merit::is_solution(lcp, y, tolerance)));
    all.into_iter().min_by(|y, z| distance(x, y).total_cmp(&distance(x, z)))
}

/// max |x − y|; ∞ if it is NaN.
pub(super) fn distance(x: &[f64], y: &[f64]) -> f64 {
    // f64::max would ignore NaN.
    let largest = |most: f64, apart: f64| if apart <= most { most } else { apart };
    let distance = x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, largest);
    if distance.is_nan() { f64::INFINITY } else { distance }
}

/// The solution of the default solver.
pub(super) fn solution(lcp: &Lcp) -> Option<Vec<f64>> {
    solved_by(default_for(lcp), lcp)
}

fn solved_by(name: &str, lcp: &Lcp) -> Option<Vec<f64>> {
    let solver = Registry::standard().entry(name).ok()?.build(&Options::default());
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    (solution.status == Status::Solved).then_some(solution.x)
}

/// The solution of the default solver, or of another one if it finds none.
fn any_solution(lcp: &Lcp) -> Option<Vec<f64>> {
    let enumerated =
        || if lcp.len() <= ENUMERATED_ROWS { solved_by(Enumeration::NAME, lcp) } else { None };
    solution(lcp).or_else(|| solved_by(Lemke::NAME, lcp)).or_else(enumerated)
}

/// The solutions with the active sets of x and of these points.
fn exact_solutions(lcp: &Lcp, x: &[f64], points: &[Vec<f64>]) -> Vec<Vec<f64>> {
    if lcp.len() > EXACT_ROWS {
        return Vec::new();
    }
    let exact = Exact::new(lcp);
    let mut inside = x.to_vec();
    lcp.project_all(&mut inside);
    let mut tried: Vec<Vec<Side>> = Vec::new();
    let mut found = Vec::new();
    for point in std::iter::once(x).chain(points.iter().map(Vec::as_slice)) {
        let sides = sides(lcp, point);
        if tried.contains(&sides) {
            continue;
        }
        let solution = exact.point(&sides, &inside).map(|(point, _)| point);
        let solution = solution.filter(|point| exact.is_solved_by(point));
        found.extend(solution.map(|point| {
            point.entries().iter().map(|entry| entry.to_f64().value()).collect::<Vec<f64>>()
        }));
        tried.push(sides);
    }
    found
}

/// The exact solution of the equations of the active set of x, whether or not its signs are right,
/// and the number of rows that are at a bound.
pub(super) fn on_active_set(lcp: &Lcp, x: &[f64]) -> Option<(Vec<f64>, usize)> {
    if lcp.len() > EXACT_ROWS {
        return None;
    }
    let size = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let is_at = |value: f64, bound: f64| (value - bound).abs() <= AT_BOUND * size;
    let side = |i: usize| match lcp.bounds(i, x) {
        (lo, _) if is_at(x[i], lo) => Side::Lower,
        (_, hi) if is_at(x[i], hi) => Side::Upper,
        _ => Side::Free,
    };
    let sides: Vec<Side> = (0..lcp.len()).map(side).collect();
    let (point, _) = Exact::new(lcp).point(&sides, x)?;
    let y = point.entries().iter().map(|entry| entry.to_f64().value()).collect();
    Some((y, sides.iter().filter(|side| **side != Side::Free).count()))
}

/// The side of Π(x − w/s) in each row.
fn sides(lcp: &Lcp, x: &[f64]) -> Vec<Side> {
    let side = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        let scale = merit::row_scale(lcp, i);
        let target = x[i] - lcp.row_w(i, x) / if scale == 0.0 { 1.0 } else { scale };
        match target {
            _ if lo == hi => Side::Lower,
            target if target <= lo => Side::Lower,
            target if target >= hi => Side::Upper,
            _ => Side::Free,
        }
    };
    (0..lcp.len()).map(side).collect()
}
