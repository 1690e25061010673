//! Eight pairs at once, one per lane.
//!
//! Pairs of one group share no body, so eight of them can be processed together: lane l holds pair
//! l, and vector operations process the first rows of all eight, then their second rows, and so on.
//! No lane waits for a horizontal sum, which dominates the time of a single row. If fewer than
//! eight pairs of a group are left, the remaining lanes are empty: rows of zeros between dummy
//! bodies. Lanes of shorter pairs are filled with such rows too.

use std::ops::Range;

use super::groups::{Groups, Pair};
use super::velocities::Velocities;
use super::{System, WIDTH};
use crate::kernel::lanes::{Lanes, prefetch};

/// The octets of one thread, some of each group.
#[derive(Debug, Default)]
pub(super) struct Share {
    lane_groups: Vec<PairLanes>,
    /// For each group, the end of its octets.
    groups: Vec<usize>,
    /// Row r of the eight pairs of an octet, octet after octet.
    rows: Vec<Rows>,
    /// For each row, the row of the octet that bounds it; `hi` is then μ.
    follows: Vec<Option<usize>>,
}

/// Eight pairs.
#[derive(Debug)]
struct PairLanes {
    rows: Range<usize>,
    bodies: [[u32; 8]; 2],
    /// The range of system rows in each lane.
    places: [Range<usize>; 8],
}

/// One row of each of eight pairs.
#[derive(Debug, Clone, Default)]
#[repr(align(64))]
struct Rows {
    jacobian: [[f64; 8]; 2 * WIDTH],
    inverse: [f64; 8],
    b: [f64; 8],
    lo: [f64; 8],
    hi: [f64; 8],
    x: [f64; 8],
}

/// Prefetch distance in rows.
const AHEAD: usize = 12;

/// Number of dummy bodies for the empty lanes of a share.
pub(super) const NOBODIES: usize = 16;

/// Distributes the octets over the shares, equally within each group. The empty lanes of share k
/// use the dummy bodies from `bodies` + 16 k on.
pub(super) fn deal(groups: &Groups, bodies: usize, shares: &mut [Share]) {
    shares.iter_mut().for_each(Share::clear);
    let (mut group, mut turn) = (0, 0);
    for pairs in groups.lane_groups() {
        if pairs[0].group != group {
            shares.iter_mut().for_each(Share::end_group);
            (group, turn) = (pairs[0].group, 0);
        }
        let k = turn % shares.len();
        shares[k].add(groups, pairs, bodies + NOBODIES * k);
        turn += 1;
    }
    shares.iter_mut().for_each(Share::end_group);
}

impl Share {
    fn clear(&mut self) {
        self.lane_groups.clear();
        self.groups.clear();
        self.rows.clear();
        self.follows.clear();
    }

    fn end_group(&mut self) {
        self.groups.push(self.lane_groups.len());
    }

    fn add(&mut self, groups: &Groups, pairs: &[Pair], nobody: usize) {
        let empty = |lane: usize| (nobody + lane) as u32;
        let mut bodies = [0, 8].map(|half| std::array::from_fn(|lane| empty(half + lane)));
        let mut places = [const { 0..0 }; 8];
        for (lane, pair) in pairs.iter().enumerate() {
            let [p, q] = pair.bodies;
            bodies[0][lane] = p as u32;
            if p != q {
                bodies[1][lane] = q as u32;
            }
            places[lane] = pair.first..pair.first + pair.rows;
        }
        let first = self.rows.len();
        self.follows.extend(groups.bounded(&pairs[0]));
        self.rows.resize(first + pairs[0].rows, Rows::default());
        self.lane_groups.push(PairLanes { rows: first..self.rows.len(), bodies, places });
    }

    /// Copies the rows of the system, and x.
    pub fn load(&mut self, system: &System, x: &[f64]) {
        for pair_lanes in &self.lane_groups {
            let rows = &mut self.rows[pair_lanes.rows.clone()];
            for (lane, places) in pair_lanes.places.iter().enumerate() {
                for (row, i) in rows.iter_mut().zip(places.clone()) {
                    row.put(lane, system, i, x[i]);
                }
            }
        }
    }

    /// Writes x for each row of the system in this share.
    pub fn unload(&self, x: &mut [f64]) {
        for pair_lanes in &self.lane_groups {
            let rows = &self.rows[pair_lanes.rows.clone()];
            for (lane, places) in pair_lanes.places.iter().enumerate() {
                rows.iter().zip(places.clone()).for_each(|(row, i)| x[i] = row.x[lane]);
            }
        }
    }

    /// One sweep, with a callback after each group.
    #[inline(always)]
    pub fn sweep<V: Lanes>(&mut self, v: &Velocities, mut after_group: impl FnMut()) {
        let Share { lane_groups, groups, rows, follows } = self;
        let mut first = 0;
        for &end in &*groups {
            for pair_lanes in &lane_groups[first..end] {
                pair_lanes.sweep::<V>(rows, follows, v);
            }
            first = end;
            after_group();
        }
    }
}

impl Rows {
    /// Prefetches the rows.
    #[inline(always)]
    fn prefetch(&self) {
        self.jacobian.iter().for_each(prefetch);
        [&self.inverse, &self.b, &self.lo, &self.hi, &self.x].into_iter().for_each(prefetch);
    }

    fn put(&mut self, lane: usize, system: &System, i: usize, x: f64) {
        let (row, aim) = (&system.rows[i], &system.aims[i]);
        for (to, from) in self.jacobian.iter_mut().zip(row.jacobian.as_flattened()) {
            to[lane] = *from;
        }
        if row.bodies[0] == row.bodies[1] {
            for k in 0..WIDTH {
                self.jacobian[k][lane] += std::mem::take(&mut self.jacobian[WIDTH + k][lane]);
            }
        }
        self.inverse[lane] = system.inverse[i];
        self.b[lane] = aim.b;
        self.lo[lane] = aim.lo;
        self.hi[lane] = aim.hi;
        self.x[lane] = x;
    }
}

impl PairLanes {
    #[inline(always)]
    fn sweep<V: Lanes>(&self, rows: &mut [Rows], follows: &[Option<usize>], v: &Velocities) {
        let mut u = [V::splat(0.0); 2 * WIDTH];
        v.gather(&self.bodies[0], &mut u[..WIDTH]);
        v.gather(&self.bodies[1], &mut u[WIDTH..]);
        let first = self.rows.start;
        for r in self.rows.clone() {
            if let Some(later) = rows.get(r + AHEAD) {
                later.prefetch();
            }
            let (lo, hi) = bounds::<V>(rows, r, follows[r].map(|k| first + k));
            update(&mut rows[r], lo, hi, &mut u);
        }
        v.scatter(&u[..WIDTH], &self.bodies[0]);
        v.scatter(&u[WIDTH..], &self.bodies[1]);
    }
}

/// The bounds of row r: fixed, or ±μ max(x_k, 0).
#[inline(always)]
fn bounds<V: Lanes>(rows: &[Rows], r: usize, follows: Option<usize>) -> (V, V) {
    let hi = V::load(&rows[r].hi);
    match follows {
        None => (V::load(&rows[r].lo), hi),
        Some(k) => {
            let zero = V::splat(0.0);
            let hi = hi * V::load(&rows[k].x).max(zero);
            (zero - hi, hi)
        }
    }
}

/// w = Ĵ u + b,   x ← Π(x − w / a),   u ← u + Ĵᵀ δ
#[inline(always)]
fn update<V: Lanes>(row: &mut Rows, lo: V, hi: V, u: &mut [V; 2 * WIDTH]) {
    let zero = V::splat(0.0);
    let mut parts = [V::load(&row.b), zero, zero, zero];
    for k in 0..2 * WIDTH {
        parts[k % 4] = parts[k % 4] + V::load(&row.jacobian[k]) * u[k];
    }
    let w = (parts[0] + parts[1]) + (parts[2] + parts[3]);
    let before = V::load(&row.x);
    let after = (before - w * V::load(&row.inverse)).max(lo).min(hi);
    after.store(&mut row.x);
    let change = after - before;
    for k in 0..2 * WIDTH {
        u[k] = u[k] + V::load(&row.jacobian[k]) * change;
    }
}
