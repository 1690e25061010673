//! Finds the iterate of a sweep method that is nearest to an answer.

use std::ops::ControlFlow;

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::ProblemForm;
use lcplab_solver::{
    Code6, ConePgs, ConeSolver, Damping, Iterate, Jacobi, Observer, Order, Pgs, PolygonPgs,
    Settings, Solver, Start,
};

use super::MistakeKind;
use super::nearest::distance;

/// Maximum number of sweeps per method, also limited by this number of multiplications.
const SWEEPS: usize = 2000;
const MULTIPLICATIONS: usize = 200_000_000;
/// Maximum number of sweeps on a changed problem.
const SWEEPS_OF_CHANGED: usize = 100;
/// Sweeps have converged if the last one changes x by less than this part of its largest entry, and
/// an iterate is their result if it is this near to it.
const LAST_CHANGE: f64 = 1e-10;
const SAME_LIMIT: f64 = 1e-8;

/// The numbers of sweeps that are compared with an answer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct SweepLimits {
    /// For each method, on the original problem.
    pub of_problem: usize,
    /// For projected Gauss-Seidel, on each changed problem.
    pub of_changed: usize,
}

impl SweepLimits {
    pub(super) fn of(lcp: &Lcp) -> Self {
        let of_problem = SWEEPS.min(MULTIPLICATIONS / (1 + lcp.matrix().stored()));
        SweepLimits { of_problem, of_changed: of_problem.min(SWEEPS_OF_CHANGED) }
    }
}

/// The iterate nearest to x.
pub(super) struct Nearest<'a> {
    x: &'a [f64],
    sweeps: usize,
    iterate: Vec<f64>,
    distance: f64,
    /// The last iterate, and its distance from the one before.
    latest: Vec<f64>,
    change: f64,
}

impl<'a> Nearest<'a> {
    pub fn to(x: &'a [f64]) -> Self {
        let (far, none) = (f64::INFINITY, Vec::new);
        Nearest { x, sweeps: 0, iterate: none(), distance: far, latest: none(), change: far }
    }

    pub(crate) fn look_at(&mut self, sweeps: usize, iterate: &[f64]) {
        if !self.latest.is_empty() {
            self.change = distance(&self.latest, iterate);
        }
        self.latest.clear();
        self.latest.extend(iterate);
        let distance = distance(self.x, iterate);
        if distance < self.distance && sweeps > 0 {
            (self.sweeps, self.distance) = (sweeps, distance);
            self.iterate = iterate.to_vec();
        }
    }

    /// The result, with x after all sweeps.
    pub fn swept(self, last: Vec<f64>) -> SweepMatch {
        let size = self.latest.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
        let is_converged = self.change <= LAST_CHANGE * size
            && distance(&self.iterate, &self.latest) <= SAME_LIMIT * size;
        SweepMatch { sweeps: self.sweeps, nearest: self.iterate, last, is_converged }
    }
}

impl Observer for Nearest<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.look_at(iterate.iteration, iterate.x);
        ControlFlow::Continue(())
    }
}

/// The result of a sequence of sweeps.
pub(super) struct SweepMatch {
    /// The number of sweeps after which x is nearest to the answer; 0 if none were done.
    pub sweeps: usize,
    /// x after these sweeps.
    pub nearest: Vec<f64>,
    /// x after all sweeps.
    pub last: Vec<f64>,
    /// Whether the sweeps converge, and the nearest x is their result.
    pub is_converged: bool,
}

impl SweepMatch {
    /// Whether x no longer changes once it is nearest.
    pub(crate) fn stays_at_nearest(&self) -> bool {
        self.nearest == self.last
    }
}

/// The sweeps of a solver from a start.
pub(super) fn sweep(solver: &dyn Solver, lcp: &Lcp, start: &Start, x: &[f64]) -> SweepMatch {
    let mut nearest = Nearest::to(x);
    let last = solver.solve(lcp, start, &mut nearest).x;
    nearest.swept(last)
}

/// Projected Gauss-Seidel of the friction law, contact by contact, from 0; `None` for boxes.
pub(super) fn contact_sweep(posed: &ProblemForm, most: usize, x: &[f64]) -> Option<SweepMatch> {
    let mut nearest = Nearest::to(x);
    let (settings, start) = (settings(most), Start::default());
    let last = match posed {
        ProblemForm::Boxed(_) => return None,
        ProblemForm::Polyhedral(polygons) => {
            PolygonPgs { settings }.solve(polygons, &start, &mut nearest).x
        }
        ProblemForm::Cone(cones) => ConePgs { settings }.solve(cones, &start, &mut nearest).x,
    };
    Some(nearest.swept(last))
}

/// Projected Gauss-Seidel in 32-bit numbers from 0.
pub(super) fn single_precision_sweep(lcp: &Lcp, most: usize, x: &[f64]) -> SweepMatch {
    let (n, a) = (lcp.len(), lcp.matrix());
    let single = |v: &[f64]| -> Vec<f32> { v.iter().map(|&v| v as f32).collect() };
    let b = single(lcp.b());
    let mut wide = vec![0.0; n];
    lcp.project_all(&mut wide);
    let mut narrow = single(&wide);
    let mut nearest = Nearest::to(x);
    for sweeps in 1..=most {
        for i in 0..n {
            let w = a.row(i).iter().fold(b[i], |sum, (j, a)| sum + a as f32 * narrow[j]);
            let value = f64::from(narrow[i] - w / a.diagonal(i) as f32);
            narrow[i] = lcp.project(i, value, &wide) as f32;
            wide[i] = f64::from(narrow[i]);
        }
        nearest.look_at(sweeps, &wide);
    }
    nearest.swept(wide)
}

/// Projected Gauss-Seidel in natural order.
pub(super) fn gauss_seidel(most: usize) -> Pgs {
    Pgs { omega: 1.0, order: Order::Natural, settings: settings(most) }
}

/// The methods whose sweeps are compared: the mistake that a stopped run means, the name, and the
/// method.
pub(super) fn methods(most: usize) -> [(MistakeKind, &'static str, Box<dyn Solver>); 6] {
    use MistakeKind::{Jacobi as AllAtOnce, LateClamp, StoppedSweeps};
    let pgs = |order| Box::new(Pgs { order, ..gauss_seidel(most) });
    let jacobi = Jacobi { damping: Damping::Factor(1.0), settings: settings(most) };
    [
        (StoppedSweeps, "projected Gauss-Seidel", pgs(Order::Natural)),
        (
            StoppedSweeps,
            "projected Gauss-Seidel from the last row to the first",
            pgs(Order::Reverse),
        ),
        (StoppedSweeps, "projected Gauss-Seidel forward and backward", pgs(Order::Symmetric)),
        (StoppedSweeps, "projected Gauss-Seidel color by color", pgs(Order::Colored)),
        (AllAtOnce, "Jacobi instead of Gauss-Seidel", Box::new(jacobi)),
        (
            LateClamp,
            "Gauss-Seidel with the clamp after the sweep",
            Box::new(Code6 { settings: settings(most) }),
        ),
    ]
}

fn settings(most: usize) -> Settings {
    Settings::default().with_tolerance(0.0).with_max_iterations(most)
}
