//! Times side by side: in each round every contender has its turn, so that whatever else the machine
//! does meets all of them alike. Medians and the best of all rounds; `--test` makes one round.

use std::time::Instant;

/// Something to be timed.
pub struct Contender<'a> {
    pub name: String,
    /// Runs once and says how many seconds of it count.
    pub run: Box<dyn FnMut() -> f64 + 'a>,
}

impl<'a> Contender<'a> {
    pub fn new(name: impl Into<String>, run: impl FnMut() -> f64 + 'a) -> Self {
        Contender { name: name.into(), run: Box::new(run) }
    }
}

/// Seconds of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Time {
    pub median: f64,
    pub best: f64,
}

/// The times of all contenders, after so many rounds and one to warm up.
pub fn interleaved(rounds: usize, contenders: &mut [Contender<'_>]) -> Vec<Time> {
    let rounds = if std::env::args().any(|argument| argument == "--test") { 1 } else { rounds };
    let mut seconds = vec![Vec::new(); contenders.len()];
    for round in 0..=rounds {
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

/// How long this takes.
pub fn timed(work: impl FnOnce()) -> f64 {
    let start = Instant::now();
    work();
    start.elapsed().as_secs_f64()
}
