//! Eight pairs at once, one a lane.
//!
//! Pairs of one colour share no body, so eight of them can go through their rows together: lane l holds
//! the numbers of pair l, and the first rows of all eight are one vector operation after the other, then
//! their second rows. No lane waits for a sum over another, which is what a single row spends its time
//! on. Where a colour has no eight pairs left, lanes stay empty: rows of zeros between bodies that are
//! none.

use std::ops::Range;

use super::colour::{Colour, colours};
use super::{System, Velocities, WIDTH};
use crate::solver::kernel::lanes::{Lanes, Width, Work};

/// Projected Gauss-Seidel by colours, eight pairs of bodies at a time.
#[derive(Debug, Clone)]
pub struct EightPairs {
    octets: Vec<Octet>,
    /// Row r of eight pairs.
    rows: Vec<Rows>,
    /// Those of the bodies, and sixteen more for empty lanes.
    v: Velocities,
    /// The row of the system in each row and lane.
    places: Vec<[Option<usize>; 8]>,
    width: Width,
}

/// Eight pairs.
#[derive(Debug, Clone)]
struct Octet {
    rows: Range<usize>,
    bodies: [[u32; 8]; 2],
    /// For each row, the row of the octet that bounds it; then `hi` is μ.
    follows: Vec<Option<usize>>,
}

/// A row of each of eight pairs.
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

impl EightPairs {
    /// The sweeps, from x = 0; `None` if a row's bounds follow a row between other bodies.
    pub fn new(system: &System, width: Width) -> Option<Self> {
        let mut kernel = EightPairs {
            octets: Vec::new(),
            rows: Vec::new(),
            v: vec![[0.0; 8]; system.bodies + 16],
            places: Vec::new(),
            width,
        };
        for colour in colours(system)? {
            for pairs in colour.pairs.chunks(8) {
                kernel.add(system, &colour, pairs);
            }
        }
        Some(kernel)
    }

    fn add(&mut self, system: &System, colour: &Colour, pairs: &[Range<usize>]) {
        let first = self.rows.len();
        let empty = |lane: usize| (system.bodies + lane) as u32;
        let mut bodies = [[0; 8]; 2];
        for lane in 0..8 {
            (bodies[0][lane], bodies[1][lane]) = (empty(lane), empty(lane + 8));
        }
        for (lane, pair) in pairs.iter().enumerate() {
            let [p, q] = system.rows[pair.start].bodies;
            bodies[0][lane] = p as u32;
            bodies[1][lane] = if p == q { empty(lane + 8) } else { q as u32 };
        }
        for r in 0..colour.follows.len() {
            let (mut rows, mut places) = (Rows::default(), [None; 8]);
            for (lane, pair) in pairs.iter().enumerate() {
                rows.put(lane, system, pair.start + r);
                places[lane] = Some(pair.start + r);
            }
            self.rows.push(rows);
            self.places.push(places);
        }
        let follows = colour.follows.clone();
        self.octets.push(Octet { rows: first..self.rows.len(), bodies, follows });
    }

    /// One sweep over all rows, in the order of [`EightPairs::order`].
    pub fn sweep(&mut self) {
        self.width.run(Sweep { octets: &self.octets, rows: &mut self.rows, v: &mut self.v });
    }

    /// The rows of the system in the order in which a sweep takes them.
    pub fn order(&self) -> Vec<usize> {
        let octets = self.octets.iter().map(|octet| &self.places[octet.rows.clone()]);
        octets
            .flat_map(|rows| (0..8).flat_map(|lane| rows.iter().filter_map(move |r| r[lane])))
            .collect()
    }

    /// x, one entry a row of the system.
    pub fn x(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.places.iter().flatten().flatten().count()];
        for (rows, places) in self.rows.iter().zip(&self.places) {
            for (value, place) in rows.x.iter().zip(places) {
                place.iter().for_each(|&i| x[i] = *value);
            }
        }
        x
    }
}

impl Rows {
    fn put(&mut self, lane: usize, system: &System, i: usize) {
        let row = &system.rows[i];
        for (to, from) in self.jacobian.iter_mut().zip(row.jacobian.as_flattened()) {
            to[lane] = *from;
        }
        if row.bodies[0] == row.bodies[1] {
            for k in 0..WIDTH {
                self.jacobian[k][lane] += std::mem::take(&mut self.jacobian[WIDTH + k][lane]);
            }
        }
        self.inverse[lane] = system.inverse[i];
        self.b[lane] = system.lcp.b()[i];
        self.lo[lane] = system.lcp.lo()[i];
        self.hi[lane] = system.follows(i).map_or(system.lcp.hi()[i], |(_, mu)| mu);
    }
}

struct Sweep<'a> {
    octets: &'a [Octet],
    rows: &'a mut [Rows],
    v: &'a mut [[f64; 8]],
}

impl Work for Sweep<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Sweep { octets, rows, v } = self;
        for octet in octets {
            let mut u = [V::splat(0.0); 2 * WIDTH];
            gather(v, &octet.bodies[0], &mut u[..WIDTH]);
            gather(v, &octet.bodies[1], &mut u[WIDTH..]);
            let rows = &mut rows[octet.rows.clone()];
            for r in 0..rows.len() {
                let (lo, hi) = bounds::<V>(rows, r, octet.follows[r]);
                update(&mut rows[r], lo, hi, &mut u);
            }
            scatter(&u[..WIDTH], &octet.bodies[0], v);
            scatter(&u[WIDTH..], &octet.bodies[1], v);
        }
    }
}

/// The bounds of row r: its own, or ±μ max(x_k, 0).
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

/// Component k of eight bodies' velocities in u_k.
#[inline(always)]
fn gather<V: Lanes>(v: &[[f64; 8]], bodies: &[u32; 8], u: &mut [V]) {
    let mut components = [[0.0; 8]; WIDTH];
    for lane in 0..8 {
        let v = &v[bodies[lane] as usize];
        for k in 0..WIDTH {
            components[k][lane] = v[k];
        }
    }
    for k in 0..WIDTH {
        u[k] = V::load(&components[k]);
    }
}

#[inline(always)]
fn scatter<V: Lanes>(u: &[V], bodies: &[u32; 8], v: &mut [[f64; 8]]) {
    let mut components = [[0.0; 8]; WIDTH];
    for k in 0..WIDTH {
        u[k].store(&mut components[k]);
    }
    for lane in 0..8 {
        let v = &mut v[bodies[lane] as usize];
        for k in 0..WIDTH {
            v[k] = components[k][lane];
        }
    }
}
