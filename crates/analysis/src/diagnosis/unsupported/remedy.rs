//! Remedies, each one carried out: the error with it, and its cost.

use lcplab_lcp::Lcp;
use lcplab_solver::trace::Work;
use lcplab_solver::{
    AndersonPgs, BlockPgs, BlockPivoting, Dantzig, Entry, Order, Pgs, Registry, Settings, Solver,
    Start,
};

use super::examine::UserSolver;
use super::frame::Frame;
use super::linear::{Linear, SweepParameters};
use super::reference::{ReferenceSolution, start};

/// The run without a change.
pub(super) const UNCHANGED: &str = "unchanged";

/// Other methods that are tried, by name.
pub(super) const METHODS: [&str; 4] =
    [AndersonPgs::NAME, BlockPgs::NAME, BlockPivoting::NAME, Dantzig::NAME];

/// Relaxation factors that are tried.
const OMEGAS: [f64; 3] = [1.3, 1.6, 1.9];

/// The factors on the number of sweeps that are tried.
const FACTORS: [usize; 2] = [4, 40];

/// A change and its effect.
#[derive(Debug, Clone, PartialEq)]
pub struct Remedy {
    /// The change.
    pub what: String,
    /// The error with it.
    pub missing: f64,
    /// The error predicted by theory, if there is a prediction.
    pub predicted: Option<f64>,
    /// The number of sweeps, pivots, or steps of the method.
    pub iterations: usize,
    /// Their cost in multiplications; NaN if unknown.
    pub work: f64,
}

/// A change of a run and its effect.
#[derive(Debug, Clone, PartialEq)]
pub struct RemedyEffect {
    /// The change.
    pub what: String,
    /// The mean error in the second half of the run.
    pub missing: f64,
    /// The largest distance of a body's final position from that with exact answers (m).
    pub off: f64,
    /// The mean number of sweeps, pivots or steps per step of the scene.
    pub iterations: f64,
}

/// The remedies of one solve.
pub fn remedies(
    frame: &Frame,
    user_solver: &UserSolver,
    reference: &ReferenceSolution<'_>,
    linear: &Linear<'_>,
) -> Vec<Remedy> {
    let (lcp, sweeps) = (&frame.lcp, user_solver.options.settings.max_iterations);
    let settings = || user_solver.options.settings.clone().with_max_iterations(sweeps);
    let mut all = Vec::new();
    let mut add = |what: String, entry: &Entry, solver: &dyn Solver, predicted: Option<f64>| {
        let mut work = Work::of(entry, lcp);
        let solution = solver.solve(lcp, &Start::default(), &mut work);
        let (missing, work) = (reference.missing(&solution.x), work.multiplications);
        all.push(Remedy { what, missing, predicted, iterations: solution.iterations, work });
    };
    let own = &user_solver.entry;
    let zero = start(lcp);
    let theory = |omega, is_reversed, sweeps| {
        linear.missing(&zero, SweepParameters { omega, is_reversed }, sweeps)
    };
    if user_solver.is_sweep() {
        for omega in OMEGAS {
            let solver = Pgs { omega, order: Order::Natural, settings: settings() };
            add(format!("ω = {omega}"), own, &solver, theory(omega, false, sweeps));
        }
        let solver = Pgs { omega: 1.0, order: Order::Reverse, settings: settings() };
        add("reverse order of rows".into(), own, &solver, theory(1.0, true, sweeps));
        for factor in FACTORS {
            let more = factor * sweeps;
            let solver = Pgs { settings: settings().with_max_iterations(more), ..Pgs::default() };
            add(format!("{more} sweeps"), own, &solver, theory(1.0, false, more));
        }
    }
    for name in METHODS.into_iter().filter(|name| *name != user_solver.entry.name) {
        let entry = Registry::standard().entry(name);
        if let (Some(solver), Ok(entry)) = (user_solver.other(name), entry) {
            add(name.into(), entry, &*solver, None);
        }
    }
    if user_solver.is_sweep()
        && let Ok(entry) = Registry::standard().entry(AndersonPgs::NAME)
    {
        let more = FACTORS[0] * sweeps;
        let mut own = user_solver.clone();
        own.options.settings.max_iterations = more;
        if let Some(solver) = own.other(AndersonPgs::NAME) {
            add(format!("{}, {more} sweeps", AndersonPgs::NAME), entry, &*solver, None);
        }
    }
    all.sort_by(|a, b| a.missing.total_cmp(&b.missing));
    all
}

/// The number of Gauss-Seidel sweeps to this error, and whether they were done: at most `most` are
/// done, the rest is extrapolated from the last ones.
pub fn sweeps_to(
    lcp: &Lcp,
    reference: &ReferenceSolution<'_>,
    order: Order,
    target: f64,
    most: usize,
) -> (f64, bool) {
    let settings = Settings::default().with_tolerance(0.0).with_max_iterations(most);
    let solver = Pgs { omega: 1.0, order, settings };
    let error_history = reference.error_history(&solver, &start(lcp), target);
    let (sweeps, last) = (error_history.len() - 1, error_history[error_history.len() - 1]);
    if last <= target {
        return (sweeps as f64, true);
    }
    // Over many sweeps, so that rounding does not matter.
    let back = sweeps / 2;
    let rate = (last / error_history[sweeps - back]).ln() / back.max(1) as f64;
    let rest = if rate < 0.0 { (target / last).ln() / rate } else { f64::INFINITY };
    (sweeps as f64 + rest, false)
}
