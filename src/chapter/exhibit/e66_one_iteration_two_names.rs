//! E66: sequential impulses and solving the system are the same iteration, section on approaches.

use nalgebra::DMatrix;

use super::common::{contacts, delassus, largest, sweeps};
use super::{Finding, Measure};
use crate::error::Result;
use crate::solver::Pgs;

/// A plank of 1 kg lands flat on two supports at ±a, a² = I/2m: rows [1, ±1/√2] of (v, ω √(I/m)).
const ARM: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// The quantity that is clamped in a sweep of impulses.
#[derive(Clone, Copy, PartialEq)]
enum Clamped {
    Total,
    Single,
}

/// x and u after each sweep of impulses on the bodies, without a matrix.
fn impulses(j: &[[f64; 2]; 2], clamped: Clamped, count: usize) -> Vec<([f64; 2], [f64; 2])> {
    let (mut x, mut u) = ([0.0; 2], [-1.0, 0.0]);
    let mut kept = vec![(x, u)];
    for _ in 0..count {
        for (i, j) in j.iter().enumerate() {
            let wanted = -(j[0] * u[0] + j[1] * u[1]) / (j[0] * j[0] + j[1] * j[1]);
            let given = match clamped {
                Clamped::Total => (x[i] + wanted).max(0.0) - x[i],
                Clamped::Single => wanted.max(0.0),
            };
            x[i] += given;
            u = [u[0] + j[0] * given, u[1] + j[1] * given];
        }
        kept.push((x, u));
    }
    kept
}

pub(super) fn example() -> Result<Finding> {
    let count = 50;
    let j = [[1.0, ARM], [1.0, -ARM]];
    let matrix = DMatrix::from_row_slice(2, 2, &j.concat());
    let lcp = contacts(&delassus(&matrix, &[1.0; 2]), &[-1.0, -1.0])?;
    let system = sweeps(Pgs::NAME, &lcp, &[0.0; 2], count)?;
    let (single, total) =
        (impulses(&j, Clamped::Single, count), impulses(&j, Clamped::Total, count));
    let apart = |kept: &[([f64; 2], [f64; 2])]| {
        let difference =
            |((x, _), y): (&([f64; 2], [f64; 2]), &Vec<f64>)| largest([x[0] - y[0], x[1] - y[1]]);
        largest(kept.iter().zip(&system).map(difference))
    };
    let left_end = |kept: &[([f64; 2], [f64; 2])]| kept[count].1[0] + ARM * kept[count].1[1];
    let difference = Measure::new("largest |x − x of PGS|", "N s", apart(&single), apart(&total));
    let lifted = Measure::new("left end afterwards", "m/s", left_end(&single), left_end(&total));
    Ok(Finding::new(
        "A plank of 1 kg lands flat at 1 m/s on two supports, one at each side, where A = [1.5 0.5; 0.5 1.5] and \
         b = (−1, −1). Fifty sweeps of impulses on the bodies, once clamping each single impulse (printed: the \
         reading in which the families differ) and once the total of each contact (corrected), compared with fifty \
         sweeps of projected Gauss-Seidel on A x + b. A plank that lands flat stays down at both ends.",
    )
    .measure(difference.truth(&[0.0], "PGS on A x + b", 1e-14))
    .measure(lifted.truth(&[0.0], "it lands flat", 1e-12))
    .judged("the plank on two supports", &lcp, &single[count].0, &total[count].0))
}
