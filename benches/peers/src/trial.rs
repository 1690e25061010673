//! All contenders on one problem: their answers are checked first, then they are timed in turns.

use lcplab::judge::{Demand, Verdict, judge};
use lcplab::lcp::{Lcp, merit};
use lcplab_benches::recording::{Answer, Problem};
use lcplab_benches::timing::Time;

use crate::contender::{Contender, Run};

/// Seconds to spend on the rounds of a problem.
const SECONDS: f64 = 1.5;
/// Rounds, at least and at most.
const ROUNDS: [usize; 2] = [3, 101];
/// A run this short (s) is done twice in a turn, and the better one counts: the first one reloads
/// data that the others have evicted from the cache.
const SHORT: f64 = 2e-2;

/// A contender and the result of its first run.
struct Tried<'a> {
    contender: Contender<'a>,
    first: Run,
    is_right: bool,
    /// The times (s) of all runs that count.
    seconds: Vec<f64>,
}

/// The answers of all contenders, and the times of those that are right.
pub fn trial(name: &str, lcp: &Lcp, contenders: Vec<Contender>) -> Problem {
    let mut all: Vec<Tried> = contenders.into_iter().map(|c| Tried::of(lcp, c)).collect();
    let a_round: f64 =
        all.iter().filter(|tried| tried.is_right).map(|tried| tried.first.seconds).sum();
    let rounds = ((SECONDS / a_round) as usize).clamp(ROUNDS[0], ROUNDS[1]);
    for _ in 0..rounds {
        all.iter_mut().filter(|tried| tried.is_right).for_each(Tried::turn);
    }
    let answers = all.into_iter().map(|tried| tried.answer(lcp)).collect();
    Problem { name: name.into(), rows: lcp.len(), answers }
}

impl<'a> Tried<'a> {
    fn of(lcp: &Lcp, mut contender: Contender<'a>) -> Self {
        let first = (contender.run)();
        let demand = Demand { tolerance: contender.tolerance, prove_up_to: 0 };
        let is_finite = first.x.iter().all(|x| x.is_finite());
        let is_right = is_finite
            && first.complaint.is_none()
            && !matches!(judge(lcp, &first.x, &demand).verdict, Verdict::NotASolution { .. });
        Tried { contender, first, is_right, seconds: Vec::new() }
    }

    fn turn(&mut self) {
        let runs = if self.first.seconds < SHORT { 2 } else { 1 };
        let seconds = (0..runs).map(|_| (self.contender.run)().seconds);
        self.seconds.push(seconds.fold(f64::INFINITY, f64::min));
    }

    fn answer(mut self, lcp: &Lcp) -> Answer {
        self.seconds.sort_by(f64::total_cmp);
        let middle = self.seconds.get(self.seconds.len() / 2);
        let residual = merit::scaled_residual(lcp, &self.first.x);
        Answer {
            contender: self.contender.name,
            ours: self.contender.ours,
            residual: residual.is_finite().then_some(residual),
            complaint: self.first.complaint,
            time: middle.map(|&median| Time { median, best: self.seconds[0] }),
        }
    }
}
