//! Comparative timing: in each round every contender has its turn, so that other work of the
//! machine affects all of them equally. Medians, and the best of all rounds: the median includes
//! the work of other processes, the best hardly any, so ratios of bests are reproducible.

use std::time::Instant;

use serde::{Deserialize, Serialize};

/// Something to be timed.
pub struct Contender<'a> {
    /// Runs once and returns the number of seconds that count.
    pub run: Box<dyn FnMut() -> f64 + 'a>,
}

impl<'a> Contender<'a> {
    /// A contender that runs so.
    pub fn new(run: impl FnMut() -> f64 + 'a) -> Self {
        Contender { run: Box::new(run) }
    }
}

/// Seconds of one run.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// The median of all rounds.
    pub median: f64,
    /// The least.
    pub best: f64,
}

/// The times of all contenders in this number of rounds (at least one), after one to warm up.
pub fn interleaved(rounds: usize, contenders: &mut [Contender<'_>]) -> Vec<Time> {
    let mut seconds = vec![Vec::new(); contenders.len()];
    for round in 0..=rounds.max(1) {
        for (contender, seconds) in contenders.iter_mut().zip(&mut seconds) {
            let elapsed = (contender.run)();
            if round > 0 {
                seconds.push(elapsed);
            }
        }
    }
    let time = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        Time { median: all[all.len() / 2], best: all[0] }
    };
    seconds.into_iter().map(time).collect()
}

/// How long this takes (s).
pub fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}
