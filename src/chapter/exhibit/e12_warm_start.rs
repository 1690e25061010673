//! E12: a warm start that starts cold, K&M Codes 6 and 7.

use super::common::{bounded, last, sweeps, tridiagonal};
use super::setting::{DT, G};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::plot::{Axis, Lines, Series};
use crate::solver::Pgs;

const BODIES: usize = 10;
const FRAMES: usize = 100;
const SWEEPS: usize = 10;
/// The velocity that gravity adds in a frame (m/s), and the impulse (N s) that supports one body.
const STEP: f64 = G * DT;

/// The fraction of the weight of ten resting bodies that the floor supports, frame by frame.
pub(super) fn example() -> Result<Finding> {
    let mut b = [0.0; BODIES];
    // Only the lowest contact closes if all bodies fall at the same speed.
    b[0] = -STEP;
    let lcp = bounded(tridiagonal(BODIES, 1.0), &b, 0.0)?;
    let (printed, corrected) =
        (frames(&lcp, |_| vec![0.0; BODIES])?, frames(&lcp, <[f64]>::to_vec)?);
    let share = Measure::new(
        "weight supported by the floor",
        "",
        printed[FRAMES - 1],
        corrected[FRAMES - 1],
    );
    let points = |shares: &[f64]| -> Vec<(f64, f64)> {
        shares
            .iter()
            .take(40)
            .enumerate()
            .map(|(k, &share)| ((k + 1) as f64, 100.0 * share))
            .collect()
    };
    let lines = Lines::new(
        "warm_start",
        "The weight supported by the floor, frame by frame",
        "Ten sweeps per frame. If x is kept, the column settles within twenty frames; if x is cleared, \
             every frame starts from 0 and the column sinks.",
        Axis::linear("frame", ""),
        Axis::linear("supported by the floor", "% of the weight"),
        vec![
            Series::measured("x kept", points(&corrected)),
            Series::measured("x cleared", points(&printed)),
            Series::reference("the weight", vec![(1.0, 100.0), (40.0, 100.0)]),
        ],
    );
    Ok(Finding::new(
        "Ten bodies of 1 kg at rest on each other, dt = 1/60 s: A = tridiag(−1, 2, −1) but for a₁₁ = 1, \
         b = (−g dt, 0, …, 0), in the chapter with the other sign. 100 frames of 10 sweeps without the clearing line: printed with an x that is \
         local to the call, corrected with the x of the frame before.",
    )
    .measure(share.truth(&[1.0], "equilibrium", 1e-9))
    .plot(&lines))
}

/// The fraction of the weight at the floor after each frame; each frame starts from what `start`
/// keeps of the last x.
fn frames(lcp: &Lcp, start: impl Fn(&[f64]) -> Vec<f64>) -> Result<Vec<f64>> {
    let mut x = vec![0.0; BODIES];
    (0..FRAMES)
        .map(|_| {
            x = last(sweeps(Pgs::NAME, lcp, &start(&x), SWEEPS)?);
            Ok(x[0] / (BODIES as f64 * STEP))
        })
        .collect()
}
