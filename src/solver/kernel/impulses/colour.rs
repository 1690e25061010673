//! Which pairs can be taken at once: those of one colour share no body.

use std::ops::Range;

use super::System;

/// Pairs of one colour and of one kind: as many rows each, bounded in the same way.
pub(super) struct Colour {
    /// For each row of a pair, the row of the pair that bounds it.
    pub(super) follows: Vec<Option<usize>>,
    pub(super) pairs: Vec<Range<usize>>,
}

/// The pairs by colour, each taking the least colour that neither of its bodies has had. `None` if a
/// row is bounded by one outside its pair.
pub(super) fn colours(system: &System) -> Option<Vec<Colour>> {
    let mut taken: Vec<Vec<bool>> = vec![Vec::new(); system.bodies];
    let mut colours: Vec<Vec<Colour>> = Vec::new();
    for pair in system.pairs() {
        let follows = within(system, &pair)?;
        let bodies = system.rows[pair.start].bodies;
        let is_free = |c: &usize| bodies.iter().all(|&body| taken[body].get(*c) != Some(&true));
        let colour = (0..).find(is_free)?;
        for body in bodies {
            let count = taken[body].len().max(colour + 1);
            taken[body].resize(count, false);
            taken[body][colour] = true;
        }
        colours.resize_with(colours.len().max(colour + 1), Vec::new);
        match colours[colour].iter_mut().find(|kind| kind.follows == follows) {
            Some(kind) => kind.pairs.push(pair),
            None => colours[colour].push(Colour { follows, pairs: vec![pair] }),
        }
    }
    Some(colours.into_iter().flatten().collect())
}

/// Which row of the pair bounds each of its rows.
fn within(system: &System, pair: &Range<usize>) -> Option<Vec<Option<usize>>> {
    let of_row = |i: usize| match system.follows(i) {
        None => Some(None),
        Some((normal, _)) if pair.contains(&normal) => Some(Some(normal - pair.start)),
        Some(_) => None,
    };
    pair.clone().map(of_row).collect()
}
