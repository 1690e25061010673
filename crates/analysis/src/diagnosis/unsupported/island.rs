//! The independent parts of a frame: groups of rows that neither A nor friction connects.
//!
//! An error is measured relative to the effect of all constraints. If one part is driven hard, its
//! effect hides the error of another part, so that each part is measured by itself too.

use lcplab_lcp::{Gauss, Lcp};

use super::frame::{Body, Frame, Pair};
use super::reference::ReferenceSolution;
use super::thresholds::{HEALTHY, HIDDEN};

/// A part of a frame.
pub(super) struct Island {
    /// The part as a frame of its own.
    pub frame: Frame,
    rows: Vec<usize>,
}

impl Island {
    /// The entries of x of this part.
    pub fn of(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|&i| x[i]).collect()
    }
}

/// The parts of a frame; none if all rows are connected.
pub(super) fn islands(frame: &Frame) -> Vec<Island> {
    let groups = groups(&frame.lcp);
    if groups.len() < 2 {
        return Vec::new();
    }
    groups.into_iter().map(|rows| Island { frame: part(frame, &rows), rows }).collect()
}

/// The part with the largest error of x, and that error, among those whose constraints have an
/// effect; `None` if the effect of the other parts does not hide it, or it is negligible. `missing`
/// is the error of the whole.
pub(super) fn worst(frame: &Frame, x: &[f64], missing: f64) -> Option<(Island, f64)> {
    let measured = islands(frame).into_iter().filter_map(|island| {
        let reference =
            ReferenceSolution::of(&island.frame).filter(ReferenceSolution::is_needed)?;
        let error = reference.missing_in_answer(&island.of(x));
        Some((island, error))
    });
    let is_hidden = |error: f64| error > HEALTHY && error > HIDDEN * missing;
    measured.max_by(|a, b| a.1.total_cmp(&b.1)).filter(|(_, error)| is_hidden(*error))
}

/// The part whose error the others hide, and its start; otherwise the whole.
pub(super) fn worst_part(frame: Frame, x: &[f64], start: Vec<f64>) -> (Frame, Vec<f64>) {
    let missing =
        ReferenceSolution::of(&frame).map_or(0.0, |reference| reference.missing_in_answer(x));
    match worst(&frame, x, missing) {
        Some((island, _)) => {
            let start = island.of(&start);
            (island.frame, start)
        }
        None => (frame, start),
    }
}

/// Some bodies of a part, or some of its pairs if bodies are unknown.
fn named(bodies: &[&Body], pairs: &[Pair]) -> String {
    const FEW: usize = 3;
    let mut names: Vec<&str> = match bodies {
        [] => pairs.iter().map(|pair| pair.name.as_str()).collect(),
        _ => bodies.iter().map(|body| body.name.as_str()).collect(),
    };
    if names.len() > FEW {
        names.truncate(FEW);
        names.push("…");
    }
    names.join(", ")
}

/// The rows in groups that are connected through A or through friction.
fn groups(lcp: &Lcp) -> Vec<Vec<usize>> {
    let mut neighbors = vec![Vec::new(); lcp.len()];
    let mut connect = |i: usize, j: usize| {
        neighbors[i].push(j);
        neighbors[j].push(i);
    };
    for i in 0..lcp.len() {
        let entries = lcp.matrix().row(i);
        entries.iter().filter(|(_, a)| *a != 0.0).for_each(|(j, _)| connect(i, j));
        lcp.coupling()
            .and_then(|coupling| coupling.index(i))
            .into_iter()
            .for_each(|k| connect(i, k));
    }
    let mut is_seen = vec![false; lcp.len()];
    let mut groups = Vec::new();
    for first in 0..lcp.len() {
        let mut group = Vec::new();
        let mut open = vec![first];
        while let Some(i) = open.pop() {
            if !std::mem::replace(&mut is_seen[i], true) {
                group.push(i);
                open.extend(&neighbors[i]);
            }
        }
        group.sort_unstable();
        if !group.is_empty() {
            groups.push(group);
        }
    }
    groups
}

/// The frame of these rows, which no other row is connected with, and of the bodies they act on.
fn part(frame: &Frame, rows: &[usize]) -> Frame {
    let of = |values: &[f64]| rows.iter().map(|&i| values[i]).collect::<Vec<f64>>();
    let motion = frame.motion.as_ref().map(|motion| Gauss {
        jacobian: rows.iter().map(|&i| motion.jacobian[i].clone()).collect(),
        bias: of(&motion.bias),
        compliance: of(&motion.compliance),
        lo: of(&motion.lo),
        hi: of(&motion.hi),
        ..motion.clone()
    });
    let columns = || motion.iter().flat_map(|motion| motion.jacobian.iter().flatten());
    let moves = |body: &&Body| columns().any(|(column, _)| body.columns.contains(column));
    let bodies: Vec<&Body> = frame.bodies.iter().filter(moves).collect();
    let pair = |pair: &Pair| {
        let own = pair.rows.iter().filter_map(|&i| position(rows, i)).collect::<Vec<_>>();
        (!own.is_empty()).then(|| Pair { name: pair.name.clone(), rows: own })
    };
    let pairs: Vec<Pair> = frame.pairs.iter().filter_map(pair).collect();
    Frame {
        part: Some(named(&bodies, &pairs)),
        lcp: frame.lcp.part(rows),
        pairs,
        bodies: bodies.into_iter().cloned().collect(),
        motion,
        ..frame.clone()
    }
}

/// The place of a row among sorted rows.
fn position(rows: &[usize], row: usize) -> Option<usize> {
    rows.binary_search(&row).ok()
}
