//! The least time of several runs: pauses of the machine and the first access to memory only add.

/// The largest number of runs.
const RUNS: usize = 5;
/// Runs that have taken longer in total are not repeated (s).
const ENOUGH: f64 = 1.0;

/// Runs again, after a first run of this time (s); `run` returns its time.
pub(super) fn repeat(first: f64, mut run: impl FnMut() -> f64) {
    let mut total = first;
    for _ in 1..RUNS {
        if total > ENOUGH {
            break;
        }
        total += run();
    }
}
