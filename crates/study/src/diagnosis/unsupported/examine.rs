//! The examination of one solve.

use lcplab_problem::{Lcp, merit};
use lcplab_solver::{
    Entry, Group, Options, Order, Pgs, Solution, Solver, Start, Status, by_name, entry,
};

use super::cause::{Moving, Slow, Without};
use super::frame::{Body, Frame};
use super::linear::{Linear, Slowest, SweepParameters};
use super::reference::ReferenceSolution;
use super::remedy::{Remedy, remedies, sweeps_to};
use crate::diagnosis::find_mistakes;
use lcplab_problem::friction::ProblemForm;

/// An error below this fraction is negligible.
pub const HEALTHY: f64 = 0.01;

/// The error of a good answer, for counting sweeps.
pub const GOOD: f64 = 1e-3;

/// A cause must reduce the number of sweeps by at least this factor when removed.
const LARGE_FACTOR: f64 = 2.0;

/// It must also explain this part of the error.
const WORTH: f64 = 0.1;

/// A cause that explains this part of the error explains most of it.
const MOST: f64 = 0.5;

/// The factor on motor limits for testing the effect of strong motors.
const WEAK: f64 = 0.01;

/// A solver whose error is this many times that of plain Gauss-Seidel after the same number of
/// sweeps is suspected.
const WORSE: f64 = 2.0;

/// Maximum number of sweeps, and of multiplications, for counting sweeps.
const MOST_SWEEPS: usize = 20_000;
const MULTIPLICATIONS: usize = 10_000_000;

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
    pub fn unit(&self) -> &'static str {
        match self.entry.group {
            Group::Sweeps => "sweep",
            Group::Pivoting => "pivot",
            Group::FirstOrder | Group::Newton | Group::Plugin => "step",
        }
    }

    /// The solver.
    pub fn solver(&self) -> Box<dyn Solver> {
        (self.entry.build)(&self.options)
    }

    /// Another solver with these settings, except for the number of steps if it is a direct method;
    /// `None` if there is none with this name.
    pub fn other(&self, name: &str) -> Option<Box<dyn Solver>> {
        let mut options = self.options.clone();
        let entry = lcplab_solver::entry(name).ok()?;
        if entry.group != Group::Sweeps && entry.group != Group::FirstOrder {
            options.settings.max_iterations = Options::default().settings.max_iterations;
        }
        by_name(name, &options).ok()
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
    let Solution { x, status, iterations, .. } = user_solver.solver().solve(lcp, &own, &mut ());
    let reference = ReferenceSolution::of(frame)?;
    let linear = Linear::new(lcp, &reference);
    let zero = super::reference::start(lcp);
    let sweeps = user_solver.options.settings.max_iterations;
    let is_plain = user_solver.entry.name == "pgs" && user_solver.options.order == Order::Natural;
    let missing = reference.missing(&x);
    let predicted = (is_plain && sweeps <= MOST_SWEEPS)
        .then(|| linear.missing(start.unwrap_or(&zero), SweepParameters::PLAIN, sweeps))
        .flatten();
    let mut found = UnsupportedLoad {
        subject: frame.name.clone(),
        part: frame.part.clone(),
        solver: user_solver.entry.name.into(),
        iterations,
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
        let case = Case { frame, user_solver, reference: &reference, linear: &linear };
        let suspected = case.solver(&found, start);
        let plain = UserSolver { entry: *entry("pgs").ok()?, options: user_solver.options.clone() };
        match suspected {
            None => case.explain(&mut found, start, missing),
            Some((cause, left)) => {
                found.causes.push(cause);
                if left > HEALTHY {
                    // The scene is responsible only for the error of plain sweeps.
                    Case { user_solver: &plain, ..case }.explain(&mut found, start, left);
                }
            }
        }
        found.remedies = remedies(frame, user_solver, &reference, &linear);
    }
    Some(found)
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

#[derive(Clone, Copy)]
struct Case<'a> {
    frame: &'a Frame,
    user_solver: &'a UserSolver,
    reference: &'a ReferenceSolution<'a>,
    linear: &'a Linear<'a>,
}

impl Case<'_> {
    fn most(&self) -> usize {
        MOST_SWEEPS.min(MULTIPLICATIONS / (1 + self.frame.lcp.matrix().stored()))
    }

    /// For a changed problem, with the effect of gravity `weight`: the number of sweeps that it
    /// needs, and the error if it is solved like the original.
    fn changed(&self, lcp: &Lcp, weight: f64) -> Option<[f64; 2]> {
        let reference = ReferenceSolution::new(lcp, weight)?;
        if !reference.is_needed() {
            return Some([1.0, 0.0]);
        }
        let needed = sweeps_to(lcp, &reference, Order::Natural, GOOD, self.most()).0;
        let solution = self.user_solver.solver().solve(lcp, &Start::default(), &mut ());
        Some([needed.max(1.0), reference.missing(&solution.x)])
    }

    /// Adds the causes of slow sweeps; `missing` is the error after the user's number of sweeps.
    fn explain(&self, found: &mut UnsupportedLoad, from: Option<&[f64]>, missing: f64) {
        let lcp = &self.frame.lcp;
        let zero = super::reference::start(lcp);
        found.slowest = self.linear.slowest(&zero, GOOD, self.most());
        let Some(slowest) = &found.slowest else { return };
        let (needed, is_done) = sweeps_to(lcp, self.reference, Order::Natural, GOOD, self.most());
        found.sweeps = Some((needed, is_done));
        let speeds = self.frame.speeds(&slowest.forces);
        let speed = |k: &usize| speeds[*k];
        let movers = || 0..self.frame.bodies.len();
        let mover = movers().max_by(|a, b| speed(a).total_cmp(&speed(b)));
        found.mover = mover.map(|k| self.frame.bodies[k].name.clone());
        let mut causes: Vec<(Without, Slow)> = Vec::new();
        causes.extend(self.masses_and_height([needed, missing], mover, &speed));
        causes.extend(self.motors([needed, missing]));
        if self.user_solver.is_sweep() {
            causes.extend(self.order());
        }
        causes.extend(from.and_then(|_| self.stale(missing)));
        let is_bad = |own: &Without| own.factor >= LARGE_FACTOR && own.share() >= WORTH * missing;
        causes.retain(|(without, _)| is_bad(without));
        // Of the causes that each explain most of the error alone, the one that is removed most
        // easily comes first.
        let explains = |own: &Without| own.share() >= MOST * missing;
        let place = |(without, cause): &(Without, Slow)| match explains(without) {
            true => (cause.ease(), 0.0),
            false => (usize::MAX, -without.share()),
        };
        causes.sort_by(|a, b| {
            let (a, b) = (place(a), place(b));
            a.0.cmp(&b.0).then(a.1.total_cmp(&b.1))
        });
        found.causes.extend(causes.into_iter().map(|(_, cause)| cause));
        // A method without sweeps that gave up is not slow.
        let is_slow = self.user_solver.is_sweep() || matches!(found.status, Status::IterationLimit);
        if found.causes.is_empty() && is_slow {
            found.causes.push(Slow::Other);
        }
    }

    /// The solver as a cause, if plain Gauss-Seidel has a much smaller error after the same number
    /// of sweeps; with the error of plain Gauss-Seidel.
    fn solver(&self, found: &UnsupportedLoad, from: Option<&[f64]>) -> Option<(Slow, f64)> {
        let UserSolver { entry, options } = self.user_solver;
        if entry.group != Group::Plugin {
            // Solvers of the library are tested; some of them are slower than sweeps.
            return None;
        }
        let start = from.map_or_else(Start::default, Start::at);
        let pgs = Pgs { settings: options.settings.clone(), ..Pgs::default() };
        let plain = pgs.solve(&self.frame.lcp, &start, &mut ());
        let left = self.reference.missing(&plain.x);
        let is_worse = !(found.missing < WORSE * left || found.missing - left < HEALTHY);
        is_worse.then(|| {
            let refusal = match &found.status {
                Status::NoAnswer { .. } | Status::OutsideClass { .. } => {
                    Some(found.status.to_string())
                }
                _ => None,
            };
            let mistakes = match &refusal {
                Some(_) => Vec::new(),
                None => {
                    find_mistakes(&ProblemForm::Boxed(self.frame.lcp.clone()), &found.x, from)
                        .mistakes
                }
            };
            let (sweeps, with) = (plain.iterations, found.missing);
            (Slow::Solver { sweeps, with, plain: left, refusal, mistakes }, left)
        })
    }

    /// The effect of equal masses, if masses are known, and then of decoupling the pairs of bodies.
    fn masses_and_height(
        &self,
        own: [f64; 2],
        mover: Option<usize>,
        speed: &dyn Fn(&usize) -> f64,
    ) -> Vec<(Without, Slow)> {
        let bodies = &self.frame.bodies;
        let mean = bodies.iter().map(|body| body.mass.ln()).sum::<f64>() / bodies.len() as f64;
        let equal: Vec<f64> = bodies.iter().map(|body| body.mass / mean.exp()).collect();
        let lcp = self.frame.with_mobility(&equal);
        let weight = match &lcp {
            Some(_) => self.frame.weight(|k| 1.0 / equal[k]),
            None => self.frame.weight(|_| 1.0),
        };
        let mut causes = Vec::new();
        let mut alike = own;
        if let (Some(lcp), Some(mover)) = (&lcp, mover) {
            alike = self.changed(lcp, weight).unwrap_or(own);
            causes.push(self.masses(own, alike, mover, speed));
        }
        let apart = self.frame.by_pairs(lcp.as_ref().unwrap_or(&self.frame.lcp));
        if let Some(left) = apart.and_then(|apart| self.changed(&apart, weight)) {
            // An error that is not there now cannot be caused by it.
            let with = alike[1].min(own[1]);
            let without = Without { factor: alike[0] / left[0], with, without: left[1] };
            let bodies = mover.filter(|_| lcp.is_some()).map(|mover| self.frame.diameter(mover));
            causes.push((without, Slow::Tall { bodies, without }));
        }
        causes
    }

    fn masses(
        &self,
        [needed, missing]: [f64; 2],
        alike: [f64; 2],
        mover: usize,
        speed: &dyn Fn(&usize) -> f64,
    ) -> (Without, Slow) {
        let largest = speed(&mover);
        let bodies = &self.frame.bodies;
        let moving =
            || (0..bodies.len()).filter(|k| speed(k) > HEALTHY * largest).map(|k| &bodies[k]);
        let by_mass = |a: &&Body, b: &&Body| a.mass.total_cmp(&b.mass);
        let named = |body: Option<&Body>| {
            body.map_or_else(Default::default, |body| (body.name.clone(), body.mass))
        };
        let without = Without { factor: needed / alike[0], with: missing, without: alike[1] };
        let heavy = named(moving().max_by(by_mass));
        let light = named(moving().min_by(by_mass));
        (without, Slow::MassRatio { heavy, light, without })
    }

    /// The effect of motors at their limits.
    fn motors(&self, [needed, missing]: [f64; 2]) -> Option<(Without, Slow)> {
        let rows = self.reference.motors_at_limits();
        if rows.is_empty() {
            return None;
        }
        let weak = self.frame.with_efforts(&rows, WEAK)?;
        let [fewer, without] = self.changed(&weak, self.frame.weight(|_| 1.0))?;
        let without = Without { factor: needed / fewer, with: missing, without };
        Some((without, Slow::Motors { between: self.frame.between(&rows), without }))
    }

    /// The effect of the other order. Asymptotically it is no faster (a chain has the same
    /// eigenvalues both ways): it matters in the first sweeps, as many as bodies on the path of an
    /// impulse.
    fn order(&self) -> Option<(Without, Slow)> {
        let lcp = &self.frame.lcp;
        let mut reversed = self.user_solver.clone();
        reversed.options.order = Order::Reverse;
        let run = |user_solver: &UserSolver| {
            let solution = user_solver.solver().solve(lcp, &Start::default(), &mut ());
            self.reference.missing(&solution.x)
        };
        let (with, without) = (run(self.user_solver), run(&reversed));
        let without = Without { factor: with / without, with, without };
        Some((without, Slow::Order { without }))
    }

    fn stale(&self, missing: f64) -> Option<(Without, Slow)> {
        let solution = self.user_solver.solver().solve(&self.frame.lcp, &Start::default(), &mut ());
        let left = self.reference.missing(&solution.x);
        let without = Without { factor: missing / left, with: missing, without: left };
        Some((without, Slow::Stale { without }))
    }
}
