//! Which pairs can be taken at once: those of one colour share no body.
//!
//! Each pair, in its order, takes the least colour that neither of its bodies has had. Within a colour the
//! pairs with the most rows come first, and eight follow each other in the same octet if the rows of
//! each are bounded like the first rows of the longest.

use super::System;

/// A run of rows between the same two bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub first: usize,
    pub rows: usize,
    pub bodies: [usize; 2],
    pub colour: usize,
}

/// The pairs of a system by colour; the memory is kept from one arrangement to the next.
#[derive(Debug, Clone, Default)]
pub(super) struct Colouring {
    /// Colour by colour; within a colour by their rows.
    pub pairs: Vec<Pair>,
    /// For each row of the system, the row that bounds it, counted from the first of its pair.
    pub follows: Vec<Option<usize>>,
    /// For each row of the system, its bodies and the row that bounds it: what the colouring was made of.
    made_of: Vec<([usize; 2], Option<usize>)>,
    /// Bit c is set for a body that has had colour c of the present window.
    taken: Vec<u64>,
}

/// Colours are given away in windows of as many as a word has bits.
const WINDOW: usize = 64;

impl Colouring {
    /// Whether the system's rows are between the same bodies, and bounded by the same rows, as those of
    /// the last arrangement.
    pub fn fits(&self, system: &System) -> bool {
        self.taken.len() == system.bodies && self.made_of.iter().copied().eq(shape(system))
    }

    /// Arranges the pairs; `false` if a row is bounded by one outside its pair.
    pub fn arrange(&mut self, system: &System) -> bool {
        self.made_of.clear();
        self.made_of.extend(shape(system));
        self.collect(system);
        if !self.follow(system) {
            return false;
        }
        self.colour(system.bodies);
        let Colouring { pairs, follows, .. } = self;
        let bounded = |pair: &Pair| &follows[pair.first..pair.first + pair.rows];
        pairs.sort_unstable_by(|a, b| {
            let colour = a.colour.cmp(&b.colour);
            colour.then_with(|| bounded(b).cmp(bounded(a))).then(a.first.cmp(&b.first))
        });
        true
    }

    /// The runs of rows between the same two bodies.
    fn collect(&mut self, system: &System) {
        self.pairs.clear();
        let mut first = 0;
        for run in system.rows.chunk_by(|a, b| a.bodies == b.bodies) {
            let (rows, bodies) = (run.len(), run[0].bodies);
            self.pairs.push(Pair { first, rows, bodies, colour: 0 });
            first += rows;
        }
    }

    /// Which row of its pair bounds each row; whether it is always one of the pair.
    fn follow(&mut self, system: &System) -> bool {
        self.follows.clear();
        for pair in &self.pairs {
            let own = pair.first..pair.first + pair.rows;
            for aim in &system.aims[own.clone()] {
                if aim.follows.is_some_and(|normal| !own.contains(&normal)) {
                    return false;
                }
                self.follows.push(aim.follows.map(|normal| normal - pair.first));
            }
        }
        true
    }

    /// The least colours. A pair that finds none in a window waits for the next, which changes
    /// nothing for those that do.
    fn colour(&mut self, bodies: usize) {
        self.pairs.iter_mut().for_each(|pair| pair.colour = usize::MAX);
        let (mut window, mut waiting) = (0, !self.pairs.is_empty());
        while waiting {
            waiting = false;
            self.taken.clear();
            self.taken.resize(bodies, 0);
            for pair in self.pairs.iter_mut().filter(|pair| pair.colour == usize::MAX) {
                let [p, q] = pair.bodies;
                let colour = (!(self.taken[p] | self.taken[q])).trailing_zeros() as usize;
                if colour < WINDOW {
                    pair.colour = window + colour;
                    pair.bodies.iter().for_each(|&body| self.taken[body] |= 1 << colour);
                } else {
                    waiting = true;
                }
            }
            window += WINDOW;
        }
    }

    /// The rows of a pair, by which of them bounds each.
    pub fn bounded(&self, pair: &Pair) -> &[Option<usize>] {
        &self.follows[pair.first..pair.first + pair.rows]
    }

    /// The pairs in runs of up to eight that go together, each with its longest in front.
    pub fn octets(&self) -> impl Iterator<Item = &[Pair]> {
        let mut rest = &self.pairs[..];
        std::iter::from_fn(move || {
            let leader = rest.first()?;
            let goes = |pair: &&Pair| {
                pair.colour == leader.colour && self.bounded(leader).starts_with(self.bounded(pair))
            };
            let (octet, others) = rest.split_at(rest.iter().take(8).take_while(goes).count());
            rest = others;
            Some(octet)
        })
    }

    /// The bytes that its arrays hold.
    pub fn bytes(&self) -> usize {
        super::bytes(&self.pairs)
            + super::bytes(&self.follows)
            + super::bytes(&self.made_of)
            + super::bytes(&self.taken)
    }
}

/// What an arrangement depends on.
fn shape(system: &System) -> impl Iterator<Item = ([usize; 2], Option<usize>)> {
    system.rows.iter().zip(&system.aims).map(|(row, aim)| (row.bodies, aim.follows))
}
