//! Groups of pairs that can be processed at once because no two of them share a body.
//!
//! Pairs are arranged in layers from the ground up, and each layer is colored greedily: a pair gets
//! the least color that neither of its bodies has in this layer. One sweep then carries a change at
//! the ground to the top of a tower. In a single stack every layer has one pair, and seven of eight
//! lanes would be empty. If layers would produce more than twice as many octets as coloring alone,
//! layers are not used: each sweep is then cheaper, but more sweeps are needed.
//!
//! Within a group, pairs with the most rows come first. Eight consecutive pairs form an octet if
//! the rows of each are bounded like the first rows of the longest.

use super::System;

/// A run of consecutive rows between the same two bodies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    pub first: usize,
    pub rows: usize,
    pub bodies: [usize; 2],
    /// The number of pairs between it and an immovable body.
    layer: usize,
    pub group: usize,
}

/// The pairs of a system by groups; storage is reused for the next arrangement.
#[derive(Debug, Clone, Default)]
pub(super) struct Groups {
    /// Sorted by group, within a group by their rows.
    pub pairs: Vec<Pair>,
    /// For each row of the system, the row that bounds it, counted from the first row of its pair.
    pub follows: Vec<Option<usize>>,
    /// For each row of the system, its bodies and the row that bounds it: the input of the
    /// arrangement.
    made_of: Vec<([usize; 2], Option<usize>)>,
    /// For each body, the number of pairs on the shortest path to an immovable body.
    height: Vec<usize>,
    /// Bit c is set for a body that has color c of the current window in the current layer.
    taken: Vec<u64>,
    /// The number of pairs in each group.
    sizes: Vec<usize>,
}

/// Pairs in an octet.
const LANES: usize = 8;
/// Layers are used if they produce at most this many times the octets without layers.
const EMPTY_LANES: usize = 2;
/// Colors are assigned in windows of this size, the bits of a word.
const WINDOW: usize = 64;

impl Groups {
    /// Whether the system's rows are between the same bodies, and bounded by the same rows, as in
    /// the last arrangement.
    pub fn fits(&self, system: &System) -> bool {
        self.height.len() == system.bodies && self.made_of.iter().copied().eq(shape(system))
    }

    /// Arranges the pairs; `false` if a row is bounded by a row outside its pair.
    pub fn arrange(&mut self, system: &System) -> bool {
        self.made_of.clear();
        self.made_of.extend(shape(system));
        self.collect(system);
        if !self.follow(system) {
            return false;
        }
        self.color(system.bodies);
        let least = self.count_lane_groups();
        self.layer(system.bodies);
        self.color(system.bodies);
        if self.count_lane_groups() > EMPTY_LANES * least {
            self.pairs.iter_mut().for_each(|pair| pair.layer = 0);
            self.color(system.bodies);
        }
        let Groups { pairs, follows, .. } = self;
        let bounded = |pair: &Pair| &follows[pair.first..pair.first + pair.rows];
        pairs.sort_unstable_by(|a, b| {
            let group = a.group.cmp(&b.group);
            group.then_with(|| bounded(b).cmp(bounded(a))).then(a.first.cmp(&b.first))
        });
        true
    }

    /// Collects the runs of rows between the same two bodies.
    fn collect(&mut self, system: &System) {
        self.pairs.clear();
        let mut first = 0;
        for run in system.rows.chunk_by(|a, b| a.bodies == b.bodies) {
            let (rows, bodies) = (run.len(), run[0].bodies);
            self.pairs.push(Pair { first, rows, bodies, layer: 0, group: 0 });
            first += rows;
        }
    }

    /// Finds the row that bounds each row; returns whether it is always in the same pair.
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

    /// Computes the layers: that of a pair is the height of its lower body. Heights are reduced in
    /// forward and backward passes over the pairs until they are shortest distances.
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

    /// Assigns the least colors, layer by layer.
    fn color(&mut self, bodies: usize) {
        self.pairs.sort_unstable_by_key(|pair| (pair.layer, pair.first));
        self.taken.resize(bodies, 0);
        let mut first = 0;
        for layer in self.pairs.chunk_by_mut(|a, b| a.layer == b.layer) {
            first = color_layer(layer, &mut self.taken, first);
        }
    }

    /// The number of octets if pairs are combined without regard to their rows.
    fn count_lane_groups(&mut self) -> usize {
        self.sizes.clear();
        for pair in &self.pairs {
            if self.sizes.len() <= pair.group {
                self.sizes.resize(pair.group + 1, 0);
            }
            self.sizes[pair.group] += 1;
        }
        self.sizes.iter().map(|size| size.div_ceil(LANES)).sum()
    }

    /// For each row of a pair, the row that bounds it.
    pub fn bounded(&self, pair: &Pair) -> &[Option<usize>] {
        &self.follows[pair.first..pair.first + pair.rows]
    }

    /// The pairs in runs of up to eight that can be processed together, the longest first in each
    /// run.
    pub fn lane_groups(&self) -> impl Iterator<Item = &[Pair]> {
        let mut rest = &self.pairs[..];
        std::iter::from_fn(move || {
            let leader = rest.first()?;
            let goes = |pair: &&Pair| {
                pair.group == leader.group && self.bounded(leader).starts_with(self.bounded(pair))
            };
            let (pair_lanes, others) =
                rest.split_at(rest.iter().take(LANES).take_while(goes).count());
            rest = others;
            Some(pair_lanes)
        })
    }
}

/// Gives each pair of a layer the least color, from `first` on, that neither of its bodies has;
/// returns the first unused color. A pair that finds none in a window waits for the next window,
/// which does not affect the others.
fn color_layer(layer: &mut [Pair], taken: &mut [u64], first: usize) -> usize {
    layer.iter_mut().for_each(|pair| pair.group = usize::MAX);
    let (mut window, mut end) = (first, first);
    loop {
        layer.iter().flat_map(|pair| pair.bodies).for_each(|body| taken[body] = 0);
        let mut waiting = false;
        for pair in layer.iter_mut().filter(|pair| pair.group == usize::MAX) {
            let [p, q] = pair.bodies;
            let color = (!(taken[p] | taken[q])).trailing_zeros() as usize;
            if color < WINDOW {
                pair.group = window + color;
                end = end.max(pair.group + 1);
                pair.bodies.iter().for_each(|&body| taken[body] |= 1 << color);
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

/// The data that an arrangement depends on.
fn shape(system: &System) -> impl Iterator<Item = ([usize; 2], Option<usize>)> {
    system.rows.iter().zip(&system.aims).map(|(row, aim)| (row.bodies, aim.follows))
}
