//! What the last active set and its factor are worth: block pivoting on a problem whose b has moved by
//! about a hundredth while the answer's active set stayed, cold and warm.
//!
//! Every x and w of the answer is moved by up to the given part, and b follows, so the set is the same by
//! construction. Both answers are judged before any time counts.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::direct_speed::Bounds;
use super::timing::{Contender, Time, interleaved, timed};
use lcplab::error::Result;
use lcplab::lcp::Lcp;
use lcplab::report::study::Study;
use lcplab::report::study::attempt::Outcome;
use lcplab::solver::{BlockPivoting, Settings, Solution, Solver, Start, Warm};

/// More rounds say nothing new.
const MOST_ROUNDS: f64 = 301.0;

/// Which problems.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Numbers of rows.
    pub rows: Vec<usize>,
    /// By which part x and w move.
    pub change: f64,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend on a problem.
    pub seconds: f64,
    /// What is asked: at most this part of the cold time.
    pub goal: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Plan { rows: vec![200, 500, 1000], change: 0.01, tolerance: 1e-9, seconds: 0.3, goal: 0.2 }
    }
}

/// What came of a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// Its rows.
    pub rows: usize,
    /// From nothing.
    pub cold: Outcome,
    /// From what the problem before has left.
    pub warm: Outcome,
    /// Exchanges of each.
    pub exchanges: [usize; 2],
}

/// The clock on a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// Its rows.
    pub rows: usize,
    /// From nothing.
    pub cold: Time,
    /// From what the problem before has left.
    pub warm: Time,
}

impl Study for Plan {
    const NAME: &'static str = "warm-factor";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.rows.iter().map(|n| format!("n = {n}")).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let rows = self.rows[task];
        let before = Bounds::OneSided.lcp(rows, 400.0)?;
        let settings = Settings { tolerance: self.tolerance, ..Settings::default() };
        let solver = BlockPivoting { settings, ..BlockPivoting::default() };
        let warm = Warm::default();
        let cold = Start::default();
        let warm = Start { warm: Some(&warm), ..cold };
        let first = solver.solve(&before, &warm, &mut ());
        let now = self.moved(&before, &first)?;
        let answers = [cold, warm].map(|start| solver.solve(&now, &start, &mut ()));
        let once = timed(|| drop(solver.solve(&now, &cold, &mut ())));
        let mut contenders = [
            Contender::new(|| timed(|| drop(solver.solve(&now, &cold, &mut ())))),
            Contender::new(|| timed(|| drop(solver.solve(&now, &warm, &mut ())))),
        ];
        let rounds = (self.seconds / once).min(MOST_ROUNDS) as usize;
        let times = interleaved(rounds, &mut contenders);
        let judged = |solution: &Solution| Outcome::of(solution, &now, self.tolerance);
        let finding = Finding {
            rows,
            cold: judged(&answers[0]),
            warm: judged(&answers[1]),
            exchanges: [answers[0].iterations, answers[1].iterations],
        };
        Ok((finding, Times { rows, cold: times[0], warm: times[1] }))
    }
}

impl Plan {
    /// The problem with the b that belongs to x and w a little larger or smaller, each by its own part.
    fn moved(&self, lcp: &Lcp, answer: &Solution) -> Result<Lcp> {
        let mut random = oorandom::Rand64::new(1);
        let mut part = || 1.0 + self.change * (2.0 * random.rand_float() - 1.0);
        let x: Vec<f64> = answer.x.iter().map(|x| x * part()).collect();
        let b = (0..lcp.len()).map(|i| {
            let w = if x[i] > 0.0 { 0.0 } else { answer.w[i] * part() };
            w - lcp.matrix().row_dot(i, &x)
        });
        lcp.with_b(b.collect())
    }
}
