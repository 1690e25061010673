//! The set of all solutions of a small problem, exactly.
//!
//! The set is a union of polyhedra, its *faces*. It is described by its corners and by its rays,
//! the directions in which it has no end. Two corners belong to one face if the point halfway is a
//! solution and no w_i has opposite signs at them, except where the bounds of x_i are equal: x_i,
//! its bounds and w_i are linear along the way, so an x_i that is at a bound halfway is there
//! everywhere, and a w_i that is 0 halfway is 0 everywhere. A ray d belongs to a corner x if
//! x + t d is a solution for all t ≥ 0. A set belongs together if each two of it do.

use std::collections::HashSet;
use std::fmt;

use dashu_ratio::RBig;

use super::dyadic::{Dyadic, dyadic};
use super::pieces::Pieces;
use super::{Exact, Point};
use crate::Lcp;

/// Limit on the number of pieces: 3¹².
const MOST_PIECES: usize = 531_441;
/// Limit on the number of corners, each pair of which is examined.
const MOST_CORNERS: usize = 1024;

/// Why a set of solutions is not listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TooMany {
    /// More than 531,441 pieces: 19 contacts, or 12 rows with two bounds.
    Pieces,
    /// More than 1,024 corners.
    Corners,
}

impl fmt::Display for TooMany {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            TooMany::Pieces => "has more than 531,441 active sets, too many to try",
            TooMany::Corners => "has more than 1,024 solutions, too many to list",
        })
    }
}

/// All solutions of a problem.
///
/// ```
/// use lcplab_lcp::exact::SolutionSet;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Two supports share a load of 1: the segment x1 + x2 = 1.
/// let a = Matrix::dense(2, &[1.0; 4]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let set = SolutionSet::of(&lcp).unwrap();
/// assert_eq!(set.corners, [[0.into(), 1.into()], [1.into(), 0.into()]]);
/// assert_eq!(set.faces.len(), 1);
/// assert!(!set.is_unique());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct SolutionSet {
    /// The isolated solutions and the corners of the faces.
    pub corners: Vec<Vec<RBig>>,
    /// The directions in which the set has no end.
    pub rays: Vec<Vec<RBig>>,
    /// The faces, none of which is part of another. Every solution belongs to one.
    pub faces: Vec<Face>,
}

/// A polyhedron of solutions: all weighted means of its corners, plus multiples of its rays. A
/// single corner without rays is an isolated solution.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Face {
    /// Indices of its corners.
    pub corners: Vec<usize>,
    /// Indices of its rays.
    pub rays: Vec<usize>,
}

impl Face {
    /// Whether it is a single solution.
    ///
    /// ```
    /// use lcplab_lcp::exact::{Face, SolutionSet};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // w = (x0 + 2 x1 − 1, 2 x0 + x1 − 1): (1, 0), (0, 1) and (1/3, 1/3), each by itself.
    /// let a = Matrix::from([[1.0, 2.0], [2.0, 1.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
    /// let set = SolutionSet::of(&lcp).unwrap();
    /// assert_eq!(set.faces.len(), 3);
    /// assert!(set.faces.iter().all(Face::is_isolated));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn is_isolated(&self) -> bool {
        self.corners.len() == 1 && self.rays.is_empty()
    }
}

impl SolutionSet {
    /// The set.
    ///
    /// # Errors
    /// If there are too many pieces or too many corners.
    pub fn of(lcp: &Lcp) -> Result<Self, TooMany> {
        let exact = Exact::new(lcp);
        let corners = points(&pieces(lcp, None, Vec::new())?, lcp)?;
        let (cone, rays) = rays(lcp)?;
        let (faces, rays) = with_corners(faces(&exact, &cone, &corners, &rays), rays);
        let entries = |points: &[Point]| points.iter().map(Point::entries).collect();
        Ok(SolutionSet { corners: entries(&corners), rays: entries(&rays), faces })
    }

    /// Whether there is exactly one solution.
    pub fn is_unique(&self) -> bool {
        self.faces.len() == 1 && self.faces.iter().all(Face::is_isolated)
    }
}

fn pieces(lcp: &Lcp, level: Option<usize>, kinks: Vec<usize>) -> Result<Pieces, TooMany> {
    Pieces::at_most(lcp, MOST_PIECES, level, kinks).ok_or(TooMany::Pieces)
}

/// The corners, each once.
fn points(pieces: &Pieces, lcp: &Lcp) -> Result<Vec<Point>, TooMany> {
    let mut all: Vec<Point> = Vec::new();
    let mut known: HashSet<Vec<RBig>> = HashSet::new();
    pieces.each_possible(lcp, &mut |sides| {
        if all.len() <= MOST_CORNERS {
            all.extend(pieces.solutions(sides).into_iter().filter(|p| known.insert(p.entries())));
        }
    });
    if all.len() > MOST_CORNERS { Err(TooMany::Corners) } else { Ok(all) }
}

/// The problem with b = 0 whose finite bounds are 0, and the rays, each scaled to 1 in one of its
/// rows, which is then free and has w = 0: solutions d of this problem. A friction row has a
/// direction only together with its normal row. A row between two bounds has d = 0, but its w must
/// keep its sign: rays are also where it is 0.
fn rays(lcp: &Lcp) -> Result<(Exact, Vec<Point>), TooMany> {
    let zero = |bound: &f64| if bound.is_finite() { 0.0 } else { *bound };
    let (lo, hi): (Vec<f64>, Vec<f64>) =
        (lcp.lo().iter().map(zero).collect(), lcp.hi().iter().map(zero).collect());
    let bounded = |lo, hi| {
        lcp.homogeneous().with_bounds(lo, hi).expect("the bounds 0, ±1 and ±∞ are in order")
    };
    let directions = bounded(lo.clone(), hi.clone());
    let cone = Exact::new(&directions);
    if pieces(&directions, None, Vec::new())?.are_regular() {
        return Ok((cone, Vec::new())); // 0 is the only solution
    }
    let is_kink = |&i: &usize| lcp.lo()[i] < lcp.hi()[i] && lo[i] == 0.0 && hi[i] == 0.0;
    let kinks: Vec<usize> = (0..lcp.len()).filter(is_kink).collect();
    let (mut all, mut known): (Vec<Point>, Vec<Vec<RBig>>) = Default::default();
    for i in (0..lcp.len()).filter(|&i| !lcp.is_coupled(i)) {
        for side in [1.0, -1.0].into_iter().filter(|side| lo[i] <= *side && *side <= hi[i]) {
            let (mut lo, mut hi) = (lo.clone(), hi.clone());
            (lo[i], hi[i]) = (side, side);
            let fixed = bounded(lo, hi);
            let points = points(&pieces(&fixed, Some(i), kinks.clone())?, &fixed)?;
            for point in points.into_iter().filter(|d| cone.is_solved_by(d)) {
                let largest =
                    point.entries().iter().map(|d| d.clone().max(-d)).max().unwrap_or(RBig::ONE);
                let direction: Vec<RBig> = point.entries().iter().map(|d| d / &largest).collect();
                if !known.contains(&direction) {
                    known.push(direction);
                    all.push(point);
                }
            }
        }
    }
    Ok((cone, all))
}

/// Whether all points between two solutions are solutions.
fn are_joined(exact: &Exact, x: &Point, y: &Point) -> bool {
    let halfway = part(&sum(x, y), 2.0);
    let signs = |i| (exact.scaled_w(i, x), exact.scaled_w(i, y));
    exact.is_solved_by(&halfway) && keeps_signs(exact, &halfway, &signs)
}

/// Whether x + t d is a solution for all t ≥ 0: d solves the problem with b = 0 whose finite bounds
/// are 0, x + d is a solution, and no w_i changes its sign on the way.
fn is_ray(exact: &Exact, cone: &Exact, x: &Point, d: &Point) -> bool {
    let beyond = sum(x, d);
    let signs = |i| (exact.scaled_w(i, x), cone.scaled_w(i, d));
    exact.is_solved_by(&beyond) && keeps_signs(exact, &beyond, &signs)
}

/// Whether these two numbers of each row do not have different signs, except where its bounds are
/// equal at this point.
fn keeps_signs(exact: &Exact, at: &Point, signs: &dyn Fn(usize) -> (Dyadic, Dyadic)) -> bool {
    let is_against = |v: &Dyadic, w: &Dyadic| *v < Dyadic::ZERO && *w > Dyadic::ZERO;
    (0..at.len()).all(|i| {
        let ((lo, hi), (v, w)) = (exact.scaled_bounds(i, at), signs(i));
        lo == hi || !is_against(&v, &w) && !is_against(&w, &v)
    })
}

/// The largest sets of corners and rays that belong together.
fn faces(exact: &Exact, cone: &Exact, corners: &[Point], rays: &[Point]) -> Vec<Face> {
    let count = corners.len();
    let joined = |i: usize, j: usize| match j.checked_sub(count) {
        None => are_joined(exact, &corners[i], &corners[j]),
        Some(ray) if i < count => is_ray(exact, cone, &corners[i], &rays[ray]),
        Some(ray) => are_joined(cone, &rays[i - count], &rays[ray]),
    };
    let all = count + rays.len();
    let mut is_joined = vec![vec![true; all]; all];
    for i in 0..all {
        for j in i + 1..all {
            is_joined[i][j] = joined(i, j);
            is_joined[j][i] = is_joined[i][j];
        }
    }
    let mut sets = Vec::new();
    extend(&is_joined, Vec::new(), (0..all).collect(), Vec::new(), &mut sets);
    let face = |set: Vec<usize>| {
        let (corners, rays): (Vec<usize>, Vec<usize>) = set.into_iter().partition(|&i| i < count);
        Face { corners, rays: rays.into_iter().map(|ray| ray - count).collect() }
    };
    let mut faces: Vec<Face> = sets.into_iter().map(face).collect();
    faces.retain(|face| !face.corners.is_empty());
    faces.sort_by(|a, b| a.corners.cmp(&b.corners));
    faces
}

/// Adds every largest set of pairwise joined members that contains `own`, members of `open` and
/// none of `done` (Bron and Kerbosch 1973).
fn extend(
    is_joined: &[Vec<bool>],
    own: Vec<usize>,
    mut open: Vec<usize>,
    mut done: Vec<usize>,
    sets: &mut Vec<Vec<usize>>,
) {
    if open.is_empty() && done.is_empty() {
        sets.push(own);
        return;
    }
    while let Some(next) = open.first().copied() {
        let near = |of: &[usize]| -> Vec<usize> {
            of.iter().copied().filter(|&i| i != next && is_joined[next][i]).collect()
        };
        extend(is_joined, [&own[..], &[next]].concat(), near(&open), near(&done), sets);
        open.remove(0);
        done.push(next);
    }
}

/// The faces that have a corner, and the rays that belong to one of them.
fn with_corners(mut faces: Vec<Face>, rays: Vec<Point>) -> (Vec<Face>, Vec<Point>) {
    let is_used = |ray: usize| faces.iter().any(|face| face.rays.contains(&ray));
    let used: Vec<usize> = (0..rays.len()).filter(|&ray| is_used(ray)).collect();
    for ray in faces.iter_mut().flat_map(|face| &mut face.rays) {
        *ray = used.iter().position(|own| own == ray).unwrap_or(*ray);
    }
    (faces, used.into_iter().map(|ray| rays[ray].clone()).collect())
}

/// x + y.
fn sum(x: &Point, y: &Point) -> Point {
    let entry = |i| x.scaled(i) * y.denominator() + y.scaled(i) * x.denominator();
    Point::new((0..x.len()).map(entry).collect(), x.denominator() * y.denominator())
}

/// x / parts.
fn part(x: &Point, parts: f64) -> Point {
    let numerators = (0..x.len()).map(|i| x.scaled(i).clone()).collect();
    Point::new(numerators, x.denominator() * dyadic(parts))
}
