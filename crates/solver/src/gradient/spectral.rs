//! Spectral projected gradient: Barzilai-Borwein step lengths with a safeguard.
//!
//! ```text
//! d ← Π(x − t ∇(x)) − x,   x ← x + λ d
//! t ← sᵀD s / sᵀA s        with s the last step: an inverse Rayleigh quotient of D⁻¹A
//! ```
//!
//! The last step s measured a curvature between the smallest and the largest eigenvalue of D⁻¹A;
//! its inverse is the next step length (Barzilai & Borwein 1988). These lengths range over the
//! spectrum, which removes one error component after another. The objective is *not* monotone, and
//! that is what makes the method fast. As a safeguard (Birgin, Martínez & Raydan 2000), λ ≤ 1 is
//! accepted as long as the objective stays below the largest of the last ten:
//!
//! ```text
//! λ wᵀd + ½ λ² dᵀA d ≤ h + 10⁻⁴ λ wᵀd,   h = the height of that largest one above the last
//! ```
//!
//! For a quadratic objective this is a quadratic equation for λ.
//!
//! Converges to a minimum of ½ xᵀAx + bᵀx over the box for symmetric semidefinite A, if there is
//! one. The left side is the change of the objective, which is not computed as a difference of two
//! objectives, so the test works down to rounding. Lengths are measured by D = diag(A). A step
//! costs two products with A.
//!
//! A not symmetric: `OutsideClass`. A row with a_ii ≤ 0: `ZeroDiagonal`. Coupled rows: see
//! [`frozen`].

use std::collections::VecDeque;
use std::ops::ControlFlow;

use crate::iterate::iterate;
use crate::metric::{Curvature, Metric};
use crate::tolerances::SUFFICIENT_DECREASE;
use crate::{Event, Observer, Settings, Solution, Solver, Start, Status, frozen};
use lcplab_lcp::Lcp;

/// The number of recent objectives whose maximum the new one must not exceed.
const MEMORY: usize = 10;

/// Spectral projected gradient (Barzilai-Borwein steps).
#[derive(Debug, Clone, Default)]
pub struct Spectral {
    /// The common settings; an iteration is one step.
    pub settings: Settings,
}

impl Spectral {
    /// Its name in the registry.
    pub const NAME: &'static str = "spectral";
}

impl Solver for Spectral {
    fn name(&self) -> &str {
        Spectral::NAME
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let x = start.point(lcp);
        let metric = match Metric::of_symmetric(lcp) {
            Ok(metric) => metric,
            Err(status) => return Solution::outside_class(lcp, x, status, 0, &self.settings),
        };
        frozen::solve(lcp, x, &self.settings, |lcp, x, first| {
            let mut length = 1.0 / metric.eigenvalue;
            // The objectives of the last steps, relative to the newest.
            let mut heights = VecDeque::from([0.0]);
            iterate(lcp, x, first, &self.settings, observer, |x| {
                let gradient = metric.gradient(lcp, x);
                let d = projected_direction(lcp, x, &gradient, length);
                let slope = metric.inner(&gradient, &d);
                if !(slope < 0.0) {
                    return ControlFlow::Break(Status::Stalled);
                }
                let curvature = match metric.curvature(lcp, &d) {
                    Curvature::Positive(curvature) => curvature,
                    _ => 0.0,
                };
                let highest = heights.iter().copied().fold(0.0, f64::max);
                let lambda = longest(highest, slope, curvature);
                for i in 0..x.len() {
                    x[i] = lcp.project(i, x[i] + lambda * d[i], &[]);
                }
                remember(&mut heights, lambda * (slope + 0.5 * lambda * curvature));
                if curvature > 0.0 {
                    length = metric.inner(&d, &d) / curvature;
                }
                ControlFlow::Continue(Event::Step)
            })
        })
    }
}

/// Π(x − t ∇) − x.
fn projected_direction(lcp: &Lcp, x: &[f64], gradient: &[f64], t: f64) -> Vec<f64> {
    (0..x.len()).map(|i| lcp.project(i, x[i] - t * gradient[i], x) - x[i]).collect()
}

/// The longest λ ≤ 1 with λ s + ½ λ² c ≤ h + γ λ s, for the slope s < 0 and the curvature c ≥ 0.
fn longest(highest: f64, slope: f64, curvature: f64) -> f64 {
    let s = (SUFFICIENT_DECREASE - 1.0) * slope;
    let root = s + (s * s + 2.0 * curvature * highest).sqrt();
    if root >= curvature { 1.0 } else { root / curvature }
}

/// Updates the stored objectives relative to the new one, which is `change` above the last.
fn remember(heights: &mut VecDeque<f64>, change: f64) {
    for height in heights.iter_mut() {
        *height -= change;
    }
    heights.push_back(0.0);
    if heights.len() > MEMORY {
        heights.pop_front();
    }
}
