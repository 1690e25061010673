//! Consistent biases for redundant equalities.
//!
//! The bias of an equality requests the motion that corrects its error. Two hinges on one axis
//! request some of it twice: a row of the second is a linear combination of rows of the first,
//! J_j = Σ z_c J_c, and a motion that satisfies both exists only if their biases satisfy the same
//! relation. They do so to first order in the errors, but differ by the square of the drift and by
//! rounding of positions; β/dt or α² multiplies both, and then the LCP has no solution. A row that
//! depends on earlier rows therefore gets the bias that follows from theirs,
//!
//! ```text
//! bias_j ← Σ z_c bias_c        z = A_CC⁻¹ A_Cj,   C the rows before j that do not depend on others
//! ```
//!
//! unless the two differ by more than drift and rounding: constraints that contradict each other
//! still do. The rows of C keep all of their feedback, and if they hold exactly, so does row j.
//!
//! The rows of one joint are independent, and so are those of joints that form a tree. Only bodies
//! and joints that form a loop, possibly through the world, need to be examined.

use std::collections::BTreeMap;

use crate::assembly::{Assembly, Row};
use crate::constraint::Bounds;
use lcplab_lcp::Matrix;
use lcplab_solver::linalg::envelope::Envelope;
use lcplab_solver::linalg::ldlt::Ldlt;

/// A row is dependent if its pivot, a_rr minus a sum of squares, is below this fraction of a_rr.
/// Rounding alone can leave that much: an entry of A is a sum of 12 products and a pivot one of c
/// more, so its error is at most (c + 13) ε/2 a_rr κ², where κ, the sum of |z| in units of 1/√a,
/// depends on the lever arms of the joints; c = 40 and κ = 40 give 1e-11. Rows below this threshold
/// are within 3e-6 rad of being dependent.
const INDEPENDENT: f64 = 1e-11;

/// Biases that differ by less than this fraction have drifted apart. Larger differences are
/// intended: contradictory constraints, which the solver must report.
const DRIFT: f64 = 0.1;
/// Differences below this fraction of the effect of the scene's force scale on the row are also
/// ignored.
const REST: f64 = 1e-4;

/// Makes the biases of rigid equalities consistent with those before them, up to drift and
/// rounding. `scale` is the x below which a row counts as at rest.
pub(super) fn agree(assembly: &Assembly, a: &Matrix, bias: &mut [f64], scale: f64) {
    for rows in loops(assembly) {
        if rows.iter().any(|&i| bias[i] != 0.0) {
            follow(a, &rows, bias, scale);
        }
    }
}

/// Whether a row is an equality without compliance, between bodies that can move.
fn is_rigid(row: &Row) -> bool {
    row.bounds == Bounds::Bilateral && row.spring.is_none() && row.parts().next().is_some()
}

/// The rigid equalities of connected bodies, for those with a loop.
fn loops(assembly: &Assembly) -> Vec<Vec<usize>> {
    let rows = &assembly.rows;
    let rigid: Vec<usize> = (0..rows.len()).filter(|&i| is_rigid(&rows[i])).collect();
    let mut islands = Islands::of(assembly.blocks.len());
    for joint in rigid.chunk_by(|&i, &j| rows[i].id.source == rows[j].id.source) {
        let mut blocks: Vec<usize> =
            joint.iter().flat_map(|&i| rows[i].parts()).map(|part| part.block).collect();
        blocks.sort_unstable();
        blocks.dedup();
        match blocks[..] {
            [one, other] => islands.join(one, other),
            [one] => islands.hold(one),
            _ => {}
        }
    }
    let mut found: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for i in rigid {
        let island = rows[i].parts().next().map(|part| islands.root(part.block));
        let island = island.filter(|&root| islands.has_loop[root]);
        island.into_iter().for_each(|root| found.entry(root).or_default().push(i));
    }
    found.into_values().collect()
}

/// Sets of bodies connected by joints (union-find).
struct Islands {
    /// The parent of each body in its island; a root is its own parent.
    parent: Vec<usize>,
    /// For a root: whether a joint connects the island with the world.
    is_held: Vec<bool>,
    /// For a root: whether its joints form a loop.
    has_loop: Vec<bool>,
}

impl Islands {
    fn of(bodies: usize) -> Self {
        Islands {
            parent: (0..bodies).collect(),
            is_held: vec![false; bodies],
            has_loop: vec![false; bodies],
        }
    }

    fn root(&self, mut body: usize) -> usize {
        while self.parent[body] != body {
            body = self.parent[body];
        }
        body
    }

    /// Adds a joint between two bodies.
    fn join(&mut self, one: usize, other: usize) {
        let (one, other) = (self.root(one), self.root(other));
        let (root, leaf) = (one.min(other), one.max(other));
        let closes = root == leaf || self.is_held[root] && self.is_held[leaf];
        self.has_loop[root] |= self.has_loop[leaf] || closes;
        self.is_held[root] |= self.is_held[leaf];
        self.parent[leaf] = root;
    }

    /// Adds a joint between a body and the world.
    fn hold(&mut self, body: usize) {
        let root = self.root(body);
        self.has_loop[root] |= self.is_held[root];
        self.is_held[root] = true;
    }
}

/// Gives dependent rows the bias that follows from the earlier rows, if they differ by no more than
/// drift and rounding.
fn follow(a: &Matrix, rows: &[usize], bias: &mut [f64], scale: f64) {
    let own = part(a, rows);
    if is_independent(&own) {
        return;
    }
    let (mut factor, mut chosen) = (Ldlt::default(), Vec::<usize>::new());
    for j in 0..rows.len() {
        // Row j is the sum of the chosen rows times −direction, if nothing is left of it.
        let (direction, product) =
            factor.eliminate(chosen.iter().map(|&c| own.entry(c, j)).collect());
        let left = own.diagonal(j) - product;
        if left > INDEPENDENT * own.diagonal(j) {
            factor.enter(&direction, left);
            chosen.push(j);
        } else {
            let follows: f64 =
                chosen.iter().zip(&direction).map(|(&c, part)| -part * bias[rows[c]]).sum();
            let asked = bias[rows[j]];
            let drift = DRIFT * asked.abs().max(follows.abs());
            let rest = REST * scale * own.diagonal(j);
            if (asked - follows).abs() <= drift.max(rest) {
                bias[rows[j]] = follows;
            }
        }
    }
}

/// The submatrix of A with these rows and columns.
fn part(a: &Matrix, rows: &[usize]) -> Matrix {
    let mut place = vec![None; a.len()];
    rows.iter().enumerate().for_each(|(r, &i)| place[i] = Some(r));
    let entries = |(r, &i): (usize, &usize)| {
        let row = a.row(i).iter().filter(|(_, a)| *a != 0.0);
        row.filter_map(|(j, a)| Some((r, place[j]?, a))).collect::<Vec<_>>()
    };
    Matrix::sparse(rows.len(), &rows.iter().enumerate().flat_map(entries).collect::<Vec<_>>())
}

/// Whether no pivot of L D Lᵀ vanishes, with rows in the given order: for a long loop this costs
/// much less than largest-pivot selection.
fn is_independent(own: &Matrix) -> bool {
    let mut factor = Envelope::of(own);
    let is_factored = factor.factor(own, &vec![0.0; own.len()], |_| false).is_ok();
    let is_clear = |(r, pivot): (usize, &f64)| *pivot > INDEPENDENT * own.diagonal(r);
    is_factored && factor.pivots().iter().enumerate().all(is_clear)
}
