//! Refines the x of a tableau method, to remove the rounding errors of the pivots.

use super::principal::Point;
use crate::kernel::rank_one::get;
use crate::kernel::tableau::Tableau;
use crate::tolerances::REFINED_RESIDUAL;
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::{Lcp, accurate};

/// Number of refinement steps; all but the first use an accurate w.
const STEPS: usize = 3;

/// Refines x by x_C ← x_C + S_CC w_C until it is exact up to rounding or meets the tolerance.
/// Dependent rows, those that depend on C, only have to meet the tolerance.
///
/// # Errors
/// The last x, if it meets neither.
pub(crate) fn refined(
    lcp: &Lcp,
    tableau: &Tableau,
    free: &[usize],
    mut x: Vec<f64>,
    tolerance: f64,
    is_idle: impl Fn(usize) -> bool,
) -> Result<Point, Point> {
    lcp.project_all(&mut x);
    let mut point = Point::at(lcp, x);
    for step in 0..=STEPS {
        let most = |i: usize| if is_idle(i) { tolerance } else { tolerance.min(REFINED_RESIDUAL) };
        if (0..lcp.len()).all(|i| point.residual(i) <= most(i)) {
            return Ok(point);
        }
        let w = |j: usize| match step {
            0 => point.terms[j].w(),
            _ => RowTerms::summed::<accurate::Sum>(lcp, j, &point.x).w(),
        };
        let w: Vec<f64> = free.iter().map(|&j| w(j)).collect();
        let (mut x, mut row) = (point.x, tableau.room());
        for &k in free {
            tableau.read(k, &mut row);
            let change: f64 = free.iter().zip(&w).map(|(&j, w)| get(&row, j) * w).sum();
            x[k] = (x[k] + change).max(lcp.lo()[k]).min(lcp.hi()[k]);
        }
        point = Point::at(lcp, x);
    }
    Err(point)
}
