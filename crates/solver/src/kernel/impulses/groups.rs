//! Which pairs can be taken at once: those of one group share no body.
//!
//! Pairs are taken layer by layer from the ground up, and each layer in as few colours as greed
//! finds: a pair gets the least colour that neither of its bodies has in this layer. So one sweep
//! carries what moves at the ground to the top of a tower. In a lone stack every layer has one
//! pair, and seven of eight lanes would stay empty; so where layers make more than twice as many
//! octets as colours alone, there are no layers: a sweep is cheaper then, and more are needed.
//!
//! Within a group the pairs with the most rows come first, and eight follow each other in the same
//! octet if the rows of each are bounded like the first rows of the longest.

use super::System;

/// A run of rows between the same two bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub first: usize,
    pub rows: usize,
    pub bodies: [usize; 2],
    /// How many pairs lie between it and a body that does not move.
    layer: usize,
    pub group: usize,
}

/// The pairs of a system by groups; the memory is kept from one arrangement to the next.
#[derive(Debug, Clone, Default)]
pub(super) struct Groups {
    /// Group by group; within a group by their rows.
    pub pairs: Vec<Pair>,
    /// For each row of the system, the row that bounds it, counted from the first of its pair.
    pub follows: Vec<Option<usize>>,
    /// For each row of the system, its bodies and the row that bounds it: what the groups were made
    /// of.
    made_of: Vec<([usize; 2], Option<usize>)>,
    /// How many pairs lead from each body to one that does not move.
    height: Vec<usize>,
    /// Bit c is set for a body that has colour c of the present window in the present layer.
    taken: Vec<u64>,
    /// How many pairs each group has.
    sizes: Vec<usize>,
}

/// Pairs in an octet.
const LANES: usize = 8;
/// Layers are kept if they make at most so many times the octets that there are without.
const EMPTY_LANES: usize = 2;
/// Colours are given away in windows of as many as a word has bits.
const WINDOW: usize = 64;

impl Groups {
    /// Whether the system's rows are between the same bodies, and bounded by the same rows, as
    /// those of the last arrangement.
    pub fn fits(&self, system: &System) -> bool {
        self.height.len() == system.bodies && self.made_of.iter().copied().eq(shape(system))
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
        let least = self.count_octets();
        self.layer(system.bodies);
        self.colour(system.bodies);
        if self.count_octets() > EMPTY_LANES * least {
            self.pairs.iter_mut().for_each(|pair| pair.layer = 0);
            self.colour(system.bodies);
        }
        let Groups { pairs, follows, .. } = self;
        let bounded = |pair: &Pair| &follows[pair.first..pair.first + pair.rows];
        pairs.sort_unstable_by(|a, b| {
            let group = a.group.cmp(&b.group);
            group.then_with(|| bounded(b).cmp(bounded(a))).then(a.first.cmp(&b.first))
        });
        true
    }

    /// The runs of rows between the same two bodies.
    fn collect(&mut self, system: &System) {
        self.pairs.clear();
        let mut first = 0;
        for run in system.rows.chunk_by(|a, b| a.bodies == b.bodies) {
            let (rows, bodies) = (run.len(), run[0].bodies);
            self.pairs.push(Pair { first, rows, bodies, layer: 0, group: 0 });
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

    /// The layers: a pair's is the height of its lower body. Heights sink, there and back through
    /// the pairs, to the least that any way down gives.
    fn layer(&mut self, bodies: usize) {
        self.height.clear();
        self.height.resize(bodies, usize::MAX);
        let mut sinks = true;
        while sinks {
            let (height, mut sunk) = (&mut self.height, false);
            let mut see = |pair: &mut Pair| {
                let [p, q] = pair.bodies;
                let is_grounded = p == q;
                pair.layer = if is_grounded { 0 } else { height[p].min(height[q]) };
                let most = if is_grounded { 0 } else { pair.layer.saturating_add(1) };
                for body in pair.bodies {
                    sunk |= height[body] > most;
                    height[body] = height[body].min(most);
                }
            };
            self.pairs.iter_mut().for_each(&mut see);
            self.pairs.iter_mut().rev().for_each(&mut see);
            sinks = sunk;
        }
    }

    /// Layer by layer the least colours.
    fn colour(&mut self, bodies: usize) {
        self.pairs.sort_unstable_by_key(|pair| (pair.layer, pair.first));
        self.taken.resize(bodies, 0);
        let mut first = 0;
        for layer in self.pairs.chunk_by_mut(|a, b| a.layer == b.layer) {
            first = colour_layer(layer, &mut self.taken, first);
        }
    }

    /// The octets that the groups make, if all pairs go together.
    fn count_octets(&mut self) -> usize {
        self.sizes.clear();
        for pair in &self.pairs {
            if self.sizes.len() <= pair.group {
                self.sizes.resize(pair.group + 1, 0);
            }
            self.sizes[pair.group] += 1;
        }
        self.sizes.iter().map(|size| size.div_ceil(LANES)).sum()
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
                pair.group == leader.group && self.bounded(leader).starts_with(self.bounded(pair))
            };
            let (octet, others) = rest.split_at(rest.iter().take(LANES).take_while(goes).count());
            rest = others;
            Some(octet)
        })
    }

    /// The bytes that its arrays hold.
    pub fn bytes(&self) -> usize {
        super::bytes(&self.pairs)
            + super::bytes(&self.follows)
            + super::bytes(&self.made_of)
            + super::bytes(&self.height)
            + super::bytes(&self.taken)
            + super::bytes(&self.sizes)
    }
}

/// Gives each pair of a layer the least colour, from `first` on, that neither of its bodies has;
/// returns the first that nobody has. A pair that finds none in a window waits for the next, which
/// changes nothing for those that do.
fn colour_layer(layer: &mut [Pair], taken: &mut [u64], first: usize) -> usize {
    layer.iter_mut().for_each(|pair| pair.group = usize::MAX);
    let (mut window, mut end) = (first, first);
    loop {
        layer.iter().flat_map(|pair| pair.bodies).for_each(|body| taken[body] = 0);
        let mut waiting = false;
        for pair in layer.iter_mut().filter(|pair| pair.group == usize::MAX) {
            let [p, q] = pair.bodies;
            let colour = (!(taken[p] | taken[q])).trailing_zeros() as usize;
            if colour < WINDOW {
                pair.group = window + colour;
                end = end.max(pair.group + 1);
                pair.bodies.iter().for_each(|&body| taken[body] |= 1 << colour);
            } else {
                waiting = true;
            }
        }
        if !waiting {
            return end;
        }
        window += WINDOW;
    }
}

/// What an arrangement depends on.
fn shape(system: &System) -> impl Iterator<Item = ([usize; 2], Option<usize>)> {
    system.rows.iter().zip(&system.aims).map(|(row, aim)| (row.bodies, aim.follows))
}
