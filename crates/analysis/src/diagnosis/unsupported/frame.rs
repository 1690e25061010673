//! One problem of a run, with the available data about its bodies.

use std::ops::Range;

use lcplab_lcp::file::Problem;
use lcplab_lcp::{Gauss, Lcp, Matrix};
use nalgebra::DMatrix;
use serde_json::Value;

/// A fraction of the largest entry of A that counts as rounding.
const ROUNDING: f64 = 1e-9;

/// A moving body.
#[derive(Debug, Clone, PartialEq)]
pub struct Body {
    /// Its name.
    pub name: String,
    /// Its columns; the first three are those of its linear velocity.
    pub columns: Range<usize>,
    /// Its mass (kg).
    pub mass: f64,
}

/// The rows between the same two bodies.
#[derive(Debug, Clone, PartialEq)]
pub struct Pair {
    /// The two bodies, `box1–box2`; for a problem without bodies, the label of the row.
    pub name: String,
    /// The rows.
    pub rows: Vec<usize>,
}

/// A problem with the available data about its bodies. Everything except the numbers may be
/// missing.
#[derive(Debug, Clone)]
pub struct Frame {
    /// Its name.
    pub name: String,
    /// If this is an independent part of a larger frame: some of its bodies, as text.
    pub part: Option<String>,
    /// The LCP.
    pub lcp: Lcp,
    /// The rows, grouped by the bodies between which they act.
    pub pairs: Vec<Pair>,
    /// M, J, γ and the motion without constraints, if they are known.
    pub motion: Option<Gauss>,
    /// The moving bodies, if they are known.
    pub bodies: Vec<Body>,
    /// Whether x are forces and w accelerations; otherwise x are impulses and w velocities.
    pub is_of_forces: bool,
    /// The contribution of gravity to each velocity of the motion without constraints (m/s; m/s² if
    /// x are forces), if there is any.
    pub fall: Option<[f64; 3]>,
    /// The speed (m/s; m/s² if x are forces) that rounding of positions alone can cause; 0 if
    /// unknown.
    pub position_rounding: f64,
}

impl Frame {
    /// The frame of a problem file.
    pub fn of(problem: &Problem) -> Self {
        let lcp = problem.lcp.clone();
        let motion = problem.motion.clone();
        let bodies = motion.as_ref().map_or_else(Vec::new, |motion| bodies(problem, motion));
        let fall = problem.extra.get("gravity").and_then(vector);
        let pairs = pairs(problem);
        let unit = problem.extra.get("rows").and_then(|rows| rows.get(0)?.get("unit")?.as_str());
        let is_of_forces = matches!(unit, Some("N" | "N m"));
        let name = problem.name.clone();
        Frame {
            name,
            part: None,
            lcp,
            pairs,
            motion,
            bodies,
            is_of_forces,
            fall,
            position_rounding: 0.0,
        }
    }

    /// The problem with other masses: M⁻¹ of body k is multiplied by `mobility[k]`. A body with 0
    /// is held fixed. `None` if the bodies are unknown, or do not reproduce the A of this problem.
    pub fn with_mobility(&self, mobility: &[f64]) -> Option<Lcp> {
        let motion = self.motion.as_ref().filter(|_| !self.bodies.is_empty())?;
        let own = self.assembled(motion, &vec![1.0; self.bodies.len()])?;
        if !is_same(own.matrix(), self.lcp.matrix()) {
            return None;
        }
        self.assembled(motion, mobility)
    }

    /// A = J M⁻¹ Jᵀ + γ and b = J u* + bias, with these factors on M⁻¹.
    fn assembled(&self, motion: &Gauss, mobility: &[f64]) -> Option<Lcp> {
        let n = self.lcp.len();
        let mut entries: Vec<(usize, usize, f64)> =
            (0..n).map(|i| (i, i, motion.compliance[i])).collect();
        let mut target = motion.target.clone();
        for (body, &part) in self.bodies.iter().zip(mobility) {
            if part == 0.0 {
                target[body.columns.clone()].fill(0.0);
                continue;
            }
            let inverse = mass(motion, body).try_inverse()? * part;
            let touching: Vec<(usize, DMatrix<f64>)> =
                (0..n).filter_map(|i| Some((i, row_of(&motion.jacobian[i], body)?))).collect();
            for (i, j_i) in &touching {
                let response = j_i * &inverse;
                entries.extend(
                    touching.iter().map(|(k, j_k)| (*i, *k, response.row(0).dot(&j_k.row(0)))),
                );
            }
        }
        let mut is_moving = vec![false; n];
        entries
            .iter()
            .filter(|(i, j, a)| i == j && *a > 0.0)
            .for_each(|(i, ..)| is_moving[*i] = true);
        // Rows between fixed bodies have no effect: w = x.
        entries.extend((0..n).filter(|&i| !is_moving[i]).map(|i| (i, i, 1.0)));
        let approach = |i: usize| {
            motion.jacobian[i].iter().map(|&(column, j)| j * target[column]).sum::<f64>()
                + motion.bias[i]
        };
        let b = (0..n).map(|i| if is_moving[i] { approach(i) } else { 0.0 }).collect();
        self.with_rows(Matrix::sparse(n, &entries), b)
    }

    /// A problem with these rows in which the pairs of bodies are decoupled: A without the entries
    /// between pairs.
    pub(crate) fn by_pairs(&self, lcp: &Lcp) -> Option<Lcp> {
        let mut pair_of = vec![0; lcp.len()];
        for (k, pair) in self.pairs.iter().enumerate() {
            pair.rows.iter().for_each(|&i| pair_of[i] = k);
        }
        let row = |i: usize| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a));
        let entries: Vec<_> =
            (0..lcp.len()).flat_map(row).filter(|&(i, j, _)| pair_of[i] == pair_of[j]).collect();
        self.with_rows(Matrix::sparse(lcp.len(), &entries), lcp.b().to_vec())
    }

    /// The problem with rigid contacts: A without γ in one-sided rows. `None` if no contact is
    /// compliant.
    pub(crate) fn rigid(&self) -> Option<Lcp> {
        let motion = self.motion.as_ref()?;
        let yields = |i: usize| {
            let is_one_sided = self.lcp.lo()[i].is_finite() && self.lcp.hi()[i].is_infinite();
            if is_one_sided { motion.compliance[i] } else { 0.0 }
        };
        if (0..self.lcp.len()).all(|i| yields(i) == 0.0) {
            return None;
        }
        let row = |i: usize| self.lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a));
        let rigid = |(i, j, a): (usize, usize, f64)| (i, j, if i == j { a - yields(i) } else { a });
        let entries: Vec<_> = (0..self.lcp.len()).flat_map(row).map(rigid).collect();
        self.with_rows(Matrix::sparse(self.lcp.len(), &entries), self.lcp.b().to_vec())
    }

    /// The problem with the bounds of these rows multiplied by `part`.
    pub(crate) fn with_efforts(&self, rows: &[usize], part: f64) -> Option<Lcp> {
        let scaled = |bounds: &[f64]| {
            let mut bounds = bounds.to_vec();
            rows.iter().for_each(|&i| bounds[i] *= part);
            bounds
        };
        self.lcp.with_bounds(scaled(self.lcp.lo()), scaled(self.lcp.hi())).ok()
    }

    /// The pairs of bodies between which these rows act.
    pub(crate) fn between(&self, rows: &[usize]) -> Vec<String> {
        let pairs = self.pairs.iter().filter(|pair| pair.rows.iter().any(|i| rows.contains(i)));
        pairs.map(|pair| pair.name.clone()).collect()
    }

    /// A problem with the bounds, the friction and the scale of this one.
    fn with_rows(&self, matrix: Matrix, b: Vec<f64>) -> Option<Lcp> {
        self.lcp.with_matrix(matrix).ok()?.with_b(b).ok()
    }

    /// For each body, those that share a row with it.
    pub(crate) fn neighbors(&self) -> Vec<Vec<usize>> {
        let mut neighbors = vec![Vec::new(); self.bodies.len()];
        for row in self.motion.iter().flat_map(|motion| &motion.jacobian) {
            let touches =
                |k: &usize| row.iter().any(|(column, _)| self.bodies[*k].columns.contains(column));
            let pair: Vec<usize> = (0..self.bodies.len()).filter(touches).collect();
            if let [one, other] = pair[..] {
                neighbors[one].push(other);
                neighbors[other].push(one);
            }
        }
        for own in &mut neighbors {
            own.sort_unstable();
            own.dedup();
        }
        neighbors
    }

    /// The maximum number of bodies on a shortest path between two bodies connected with this one.
    pub(crate) fn diameter(&self, body: usize) -> usize {
        let neighbors = self.neighbors();
        let connected = by_distance(&neighbors, body).concat();
        connected.iter().map(|&k| by_distance(&neighbors, k).len()).max().unwrap_or(0)
    }

    /// M⁻¹ Jᵀ x: the velocity change due to x. Empty if the bodies are unknown.
    pub fn response(&self, x: &[f64]) -> Vec<f64> {
        let Some(motion) = &self.motion else { return Vec::new() };
        let impulse = self.impulse(x, |_| true);
        let mut change = vec![0.0; impulse.len()];
        for body in &self.bodies {
            let own = nalgebra::DVector::from_column_slice(&impulse[body.columns.clone()]);
            let moved = mass(motion, body).lu().solve(&own).unwrap_or(own);
            change[body.columns.clone()].copy_from_slice(moved.as_slice());
        }
        change
    }

    /// Jᵀ x of the selected rows: the impulse on each column.
    pub(crate) fn impulse(&self, x: &[f64], counts: impl Fn(usize) -> bool) -> Vec<f64> {
        let Some(motion) = &self.motion else { return Vec::new() };
        let mut impulse = vec![0.0; motion.target.len()];
        for i in (0..x.len()).filter(|&i| counts(i)) {
            for &(column, j) in &motion.jacobian[i] {
                impulse[column] += j * x[i];
            }
        }
        impulse
    }

    /// The speed of each body due to forces x (m/s, or m/s²).
    pub fn speeds(&self, x: &[f64]) -> Vec<f64> {
        let moved = self.response(x);
        let speed = |body: &Body| {
            let own = &moved[body.columns.start..body.columns.start + 3];
            own.iter().map(|u| u * u).sum::<f64>().sqrt()
        };
        self.bodies.iter().map(speed).collect()
    }

    /// The speed of each body due to the error of x, relative to the contribution of gravity to its
    /// velocity, or to the fastest body if there is none.
    pub fn left(&self, x: &[f64], exact: &[f64]) -> Vec<f64> {
        let error: Vec<f64> = exact.iter().zip(x).map(|(exact, x)| exact - x).collect();
        let speeds = self.speeds(&error);
        let fastest = || speeds.iter().copied().fold(0.0, f64::max);
        let whole = self.fall.map_or_else(fastest, length);
        speeds.into_iter().map(|speed| if whole > 0.0 { speed / whole } else { 0.0 }).collect()
    }

    /// The upward component of an impulse on a body (N s).
    pub(crate) fn upward(&self, impulse: &[f64], body: &Body) -> f64 {
        let Some(fall) = self.fall else { return 0.0 };
        let own = &impulse[body.columns.start..body.columns.start + 3];
        -own.iter().zip(fall).map(|(p, fall)| p * fall).sum::<f64>() / length(fall)
    }

    /// The effect of gravity in all bodies, |M⁻¹F|_M, with masses multiplied by `mass`; 0 if
    /// unknown.
    pub(crate) fn weight(&self, mass: impl Fn(usize) -> f64) -> f64 {
        let masses = self.bodies.iter().enumerate().map(|(k, body)| mass(k) * body.mass);
        self.fall.map_or(0.0, length) * masses.sum::<f64>().sqrt()
    }

    /// γ of each row, 0 if unknown.
    pub(crate) fn compliances(&self) -> Vec<f64> {
        let none = || vec![0.0; self.lcp.len()];
        self.motion.as_ref().map_or_else(none, |motion| motion.compliance.clone())
    }

    /// Σ_j |J_ij u*_j| + |bias_i|: the sum of the terms of each b_i, 0 if unknown.
    pub(crate) fn offset_terms(&self) -> Vec<f64> {
        let Some(motion) = &self.motion else { return vec![0.0; self.lcp.len()] };
        let term = |i: usize| {
            let row = motion.jacobian[i].iter();
            row.map(|&(column, j)| (j * motion.target[column]).abs()).sum::<f64>()
                + motion.bias[i].abs()
        };
        (0..self.lcp.len()).map(term).collect()
    }

    /// The size of the motion that rounding of positions can cause.
    pub(crate) fn rounding(&self) -> f64 {
        self.position_rounding * self.bodies.iter().map(|body| body.mass).sum::<f64>().sqrt()
    }
}

/// The bodies named in a file, with at least three columns each.
fn bodies(problem: &Problem, motion: &Gauss) -> Vec<Body> {
    let list = problem.extra.get("bodies").and_then(Value::as_array);
    let body = |value: &Value| {
        let number = |key| Some(value.get(key)?.as_u64()? as usize);
        let (first, count) = (number("first")?, number("count")?);
        let columns = first..first.checked_add(count)?;
        let name = value.get("name")?.as_str()?.to_string();
        let mass = motion.mass.iter().find(|(i, j, _)| (*i, *j) == (first, first))?.2;
        let fits = count >= 3 && columns.end <= motion.target.len();
        fits.then_some(Body { name, columns, mass })
    };
    let all: Option<Vec<Body>> = list.into_iter().flatten().map(body).collect();
    let all = all.unwrap_or_default();
    let covered: usize = all.iter().map(|body| body.columns.len()).sum();
    if covered == motion.target.len() { all } else { Vec::new() }
}

/// The rows grouped by the two bodies that a file names for each; otherwise each row alone,
/// friction with its normal.
fn pairs(problem: &Problem) -> Vec<Pair> {
    let rows = problem.extra.get("rows").and_then(Value::as_array);
    let of = |i: usize, key: &str| rows.and_then(|rows| rows.get(i)?.get(key).cloned());
    let label = |i: usize| match of(i, "label").as_ref().and_then(Value::as_str) {
        Some(label) => label.to_string(),
        None => format!("row {i}"),
    };
    let mut pairs: Vec<Pair> = Vec::new();
    for i in 0..problem.lcp.len() {
        let between = of(i, "bodies").and_then(|pair| {
            let (first, second) = (pair.get(0)?.as_str()?, pair.get(1)?.as_str()?);
            // Either of the two may come first: all rows between them are one pair, named after its
            // first row.
            Some([format!("{first}–{second}"), format!("{second}–{first}")])
        });
        let normal = problem.lcp.coupling().and_then(|coupling| coupling.index(i));
        let [name, turned] =
            between.unwrap_or_else(|| [(); 2].map(|()| label(normal.unwrap_or(i))));
        match pairs.iter_mut().find(|pair| [&name, &turned].contains(&&pair.name)) {
            Some(pair) => pair.rows.push(i),
            None => pairs.push(Pair { name, rows: vec![i] }),
        }
    }
    pairs
}

/// A vector of three numbers that is not 0.
fn vector(value: &Value) -> Option<[f64; 3]> {
    let numbers: Vec<f64> = value.as_array()?.iter().filter_map(Value::as_f64).collect();
    let vector = <[f64; 3]>::try_from(numbers).ok()?;
    (length(vector) > 0.0 && length(vector).is_finite()).then_some(vector)
}

fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

/// The block of M of a body.
fn mass(motion: &Gauss, body: &Body) -> DMatrix<f64> {
    let mut block = DMatrix::zeros(body.columns.len(), body.columns.len());
    let inside = |k: &usize| body.columns.contains(k);
    for &(i, j, m) in motion.mass.iter().filter(|(i, j, _)| inside(i) && inside(j)) {
        let (i, j) = (i - body.columns.start, j - body.columns.start);
        (block[(i, j)], block[(j, i)]) = (m, m);
    }
    block
}

/// The part of a row of J for a body, if there is any.
fn row_of(row: &[(usize, f64)], body: &Body) -> Option<DMatrix<f64>> {
    let mut own = DMatrix::zeros(1, body.columns.len());
    for &(column, j) in row.iter().filter(|(column, _)| body.columns.contains(column)) {
        own[(0, column - body.columns.start)] = j;
    }
    own.iter().any(|&j| j != 0.0).then_some(own)
}

/// Whether two matrices are equal up to rounding.
fn is_same(one: &Matrix, other: &Matrix) -> bool {
    let largest = (0..one.len()).map(|i| one.diagonal(i).abs()).fold(0.0, f64::max);
    (0..one.len()).all(|i| {
        let mut row = vec![0.0; one.len()];
        one.row(i).iter().for_each(|(j, a)| row[j] += a);
        other.row(i).iter().for_each(|(j, a)| row[j] -= a);
        row.iter().all(|difference| difference.abs() <= ROUNDING * largest)
    })
}

/// The bodies at distance 0, 1, 2, … from this one.
fn by_distance(neighbors: &[Vec<usize>], body: usize) -> Vec<Vec<usize>> {
    let mut is_reached = vec![false; neighbors.len()];
    is_reached[body] = true;
    let mut rings = vec![vec![body]];
    loop {
        let mut next = Vec::new();
        for other in rings[rings.len() - 1].iter().flat_map(|&k| &neighbors[k]) {
            if !std::mem::replace(&mut is_reached[*other], true) {
                next.push(*other);
            }
        }
        if next.is_empty() {
            return rings;
        }
        rings.push(next);
    }
}
