//! The examination of one solve.

use lcplab_lcp::merit;
use lcplab_lcp::number::counted;
use lcplab_solver::trace::Work;
use lcplab_solver::{Entry, Group, Options, Order, Pgs, Registry, Solution, Solver, Start, Status};

use super::cause::{Moving, Slow};
use super::frame::{Body, Frame};
use super::linear::{Linear, Slowest, SweepParameters};
use super::reference::ReferenceSolution;
use super::remedy::{Remedy, remedies};
use super::slow::{Case, MOST_SWEEPS};
use super::thresholds::HEALTHY;

/// How the user solves a problem.
#[derive(Clone)]
pub struct UserSolver {
    /// The solver.
    pub entry: Entry,
    /// Its settings.
    pub options: Options,
}

impl UserSolver {
    /// Whether it works row by row.
    pub(crate) fn is_sweep(&self) -> bool {
        self.entry.group == Group::Sweeps
    }

    /// The name of one iteration.
    pub(crate) fn unit(&self) -> &'static str {
        match self.entry.group {
            Group::Sweeps => "sweep",
            Group::Pivoting => "pivot",
            Group::FirstOrder | Group::Newton | Group::Plugin => "iteration",
        }
    }

    /// The solver.
    pub(crate) fn solver(&self) -> Box<dyn Solver> {
        self.entry.build(&self.options)
    }

    /// Another solver with these settings, except for the number of steps if it is a direct method;
    /// `None` if there is none with this name.
    pub(crate) fn other(&self, name: &str) -> Option<Box<dyn Solver>> {
        let mut options = self.options.clone();
        let entry = Registry::standard().entry(name).ok()?;
        if entry.group != Group::Sweeps && entry.group != Group::FirstOrder {
            options.settings.max_iterations = Options::default().settings.max_iterations;
        }
        Some(entry.build(&options))
    }
}

/// An impulse (N s) or force (N) in the solution and in the answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// The body or pair of bodies.
    pub name: String,
    /// The upward component in the solution.
    pub due: f64,
    /// The upward component in the answer.
    pub given: f64,
    /// The largest approach velocity that the answer leaves in a row, max −w (m/s, or m/s²).
    pub approach: f64,
    /// The largest separation velocity that feedback of errors requests in a row, max −bias.
    pub bias: f64,
}

impl Load {
    /// A load of zeros.
    fn named(name: &str) -> Self {
        Load { name: name.into(), due: 0.0, given: 0.0, approach: 0.0, bias: 0.0 }
    }

    /// The missing fraction.
    pub fn missing(&self) -> f64 {
        1.0 - self.given / self.due
    }
}

/// The error of an answer, its causes, and remedies.
#[derive(Debug, Clone)]
pub struct UnsupportedLoad {
    /// The problem.
    pub subject: String,
    /// If only an independent part was examined: some of its bodies, as text.
    pub part: Option<String>,
    /// The solver.
    pub solver: String,
    /// The number of its sweeps, pivots or steps.
    pub iterations: usize,
    /// Their cost in multiplications; NaN if unknown.
    pub work: f64,
    /// The name of one of them.
    pub unit: &'static str,
    /// The status that the solver reported.
    pub status: Status,
    /// The answer.
    pub x: Vec<f64>,
    /// The scaled residual of the answer.
    pub residual: f64,
    /// The error, as a fraction of the constraints' effect.
    pub missing: f64,
    /// Whether the judge accepts the answer, so that its error is negligible.
    pub is_accepted: bool,
    /// The error that theory predicts for sweeps.
    pub predicted: Option<f64>,
    /// The total weight supported by contacts; `None` if unknown.
    pub whole: Option<Load>,
    /// The load of each body.
    pub bodies: Vec<Load>,
    /// The load of each pair, the worst first.
    pub pairs: Vec<Load>,
    /// Whether x are forces; otherwise impulses.
    pub is_of_forces: bool,
    /// The slowest mode of Gauss-Seidel.
    pub slowest: Option<Slowest>,
    /// The body that moves most in it, if bodies are known.
    pub mover: Option<String>,
    /// The number of Gauss-Seidel sweeps to a good answer, and whether they were done; otherwise
    /// they are extrapolated.
    pub sweeps: Option<(f64, bool)>,
    /// The causes, the strongest first; empty if there is no error.
    pub causes: Vec<Slow>,
    /// The remedies, the best first.
    pub remedies: Vec<Remedy>,
}

/// Solves the problem of a frame as the user does, from a start if there is one, and examines the
/// answer. `None` if no reference solution is known, or A is not symmetric.
pub fn examine(
    frame: &Frame,
    user_solver: &UserSolver,
    start: Option<&[f64]>,
) -> Option<UnsupportedLoad> {
    let lcp = &frame.lcp;
    let own = start.map_or_else(Start::default, Start::at);
    let mut work = Work::of(&user_solver.entry, lcp);
    let Solution { x, status, iterations, .. } = user_solver.solver().solve(lcp, &own, &mut work);
    let reference = ReferenceSolution::of(frame)?;
    let linear = Linear::new(lcp, &reference);
    let zero = super::reference::start(lcp);
    let sweeps = user_solver.options.settings.max_iterations;
    let is_plain =
        user_solver.entry.name == Pgs::NAME && user_solver.options.order == Order::Natural;
    let missing = reference.missing(&x);
    let predicted = (is_plain && sweeps <= MOST_SWEEPS)
        .then(|| linear.missing(start.unwrap_or(&zero), SweepParameters::PLAIN, sweeps))
        .flatten();
    let mut found = UnsupportedLoad {
        subject: frame.name.clone(),
        part: frame.part.clone(),
        solver: user_solver.entry.name.to_string(),
        iterations,
        work: work.multiplications,
        unit: user_solver.unit(),
        status,
        residual: merit::scaled_residual(lcp, &x),
        missing,
        is_accepted: reference.is_accepted(&x),
        predicted,
        whole: None,
        bodies: Vec::new(),
        pairs: Vec::new(),
        is_of_forces: frame.is_of_forces,
        slowest: None,
        mover: None,
        sweeps: None,
        causes: Vec::new(),
        remedies: Vec::new(),
        x,
    };
    found.loads(frame, &reference.exact);
    if reference.is_needed() && found.is_short() {
        let case = Case { frame, user_solver, reference: &reference, linear: &linear, from: start };
        if let Some(cause) = stopped_early(frame, user_solver, &reference, &own, &found) {
            found.causes.push(cause);
        }
        match case.solver(&found).filter(|_| found.causes.is_empty()) {
            None if !found.causes.is_empty() => {}
            None => case.explain(&mut found, missing),
            Some((cause, left)) => {
                found.causes.push(cause);
                if left > HEALTHY {
                    // The scene is responsible only for the error of plain sweeps.
                    let entry = Registry::standard().entry(Pgs::NAME).ok()?.clone();
                    let plain = UserSolver { entry, ..user_solver.clone() };
                    Case { user_solver: &plain, ..case }.explain(&mut found, left);
                }
            }
        }
        found.remedies = remedies(frame, user_solver, &reference, &linear);
    }
    Some(found)
}

/// The cause if a direct method reached its iteration limit.
fn stopped_early(
    frame: &Frame,
    user_solver: &UserSolver,
    reference: &ReferenceSolution,
    start: &Start<'_>,
    found: &UnsupportedLoad,
) -> Option<Slow> {
    let is_direct = matches!(user_solver.entry.group, Group::Pivoting | Group::Newton);
    if !is_direct || found.status != Status::IterationLimit {
        return None;
    }
    let whole = user_solver.other(&found.solver)?.solve(&frame.lcp, start, &mut ());
    Some(Slow::Stopped {
        solver: found.solver.clone(),
        after: counted(found.iterations, found.unit),
        needs: reference.is_accepted(&whole.x).then_some(whole.iterations),
    })
}

/// The error that compliant contacts cause in the solution itself, if it is large enough to report.
pub fn creep(frame: &Frame) -> Option<Moving> {
    let rigid = frame.rigid()?;
    let weight = frame.weight(|_| 1.0);
    let (soft, hard) =
        (ReferenceSolution::new(&frame.lcp, weight)?, ReferenceSolution::new(&rigid, weight)?);
    let missing = hard.missing(&soft.exact);
    let approach = rigid.w(&soft.exact);
    let speed = approach.iter().fold(0.0, |most: f64, w| most.max(-w));
    (missing > HEALTHY).then_some(Moving::Creep { speed, missing })
}

impl UnsupportedLoad {
    /// The load of each body and pair.
    fn loads(&mut self, frame: &Frame, exact: &[f64]) {
        if frame.bodies.is_empty() || frame.fall.is_none() {
            return;
        }
        let all = |x: &[f64]| frame.impulse(x, |_| true);
        let (due, given) = (all(exact), all(&self.x));
        let of = |body: &Body| Load {
            due: frame.upward(&due, body),
            given: frame.upward(&given, body),
            ..Load::named(&body.name)
        };
        self.bodies = frame.bodies.iter().map(of).collect();
        let sum = |part: fn(&Load) -> f64| self.bodies.iter().map(part).sum::<f64>();
        let (due, given) = (sum(|load| load.due), sum(|load| load.given));
        let scale: f64 = self.bodies.iter().map(|load| load.due.abs()).sum();
        // If nothing is supported, there is no weight to compare with.
        self.whole =
            (due > HEALTHY * scale).then(|| Load { due, given, ..Load::named("all bodies") });
        let w = frame.lcp.w(&self.x);
        let none = vec![0.0; w.len()];
        let bias = frame.motion.as_ref().map_or(&none, |motion| &motion.bias);
        for pair in &frame.pairs {
            let of = |x: &[f64]| {
                let own = frame.impulse(x, |i| pair.rows.contains(&i));
                let each = frame.bodies.iter().map(|body| frame.upward(&own, body));
                each.fold(0.0, f64::max)
            };
            let most = |values: &[f64]| {
                let own = pair.rows.iter().filter(|&&i| frame.lcp.lo()[i].is_finite());
                own.fold(0.0, |most: f64, &i| most.max(-values[i]))
            };
            let load = Load {
                due: of(exact),
                given: of(&self.x),
                approach: most(&w),
                bias: most(bias),
                ..Load::named(&pair.name)
            };
            self.pairs.extend((load.due > HEALTHY * due).then_some(load));
        }
        self.pairs.sort_by(|a, b| (b.due - b.given).total_cmp(&(a.due - a.given)));
    }
}
