//! The examination of one solve.

use lcplab_problem::{Lcp, merit};
use lcplab_solver::{
    Entry, Group, Options, Order, Pgs, Solution, Solver, Start, Status, by_name, entry,
};

use super::cause::{Moving, Slow, Without};
use super::frame::{Body, Frame};
use super::linear::{Linear, Slowest, Way};
use super::remedy::{Remedy, remedies, sweeps_to};
use super::yard::Yard;
use crate::diagnosis::find_mistakes;

/// Less than this part missing is nothing to speak of.
pub const HEALTHY: f64 = 0.01;

/// What is missing in a good answer, to count sweeps by.
pub const GOOD: f64 = 1e-3;

/// Without a cause it takes so many times fewer sweeps, or it is none.
const TELLING: f64 = 2.0;

/// And it explains this part of what is missing.
const WORTH: f64 = 0.1;

/// A cause that explains this part explains most of it.
const MOST: f64 = 0.5;

/// To see what strong motors do, they may do this part of what they did.
const WEAK: f64 = 0.01;

/// A solver that misses so many times as much as plain Gauss-Seidel after as many sweeps is to be
/// suspected.
const WORSE: f64 = 2.0;

/// Sweeps are counted up to here, and up to so many multiplications.
const MOST_SWEEPS: usize = 20_000;
const MULTIPLICATIONS: usize = 10_000_000;

/// How a problem is solved by those who ask.
#[derive(Clone)]
pub struct Practice {
    /// The solver.
    pub entry: Entry,
    /// Its settings.
    pub options: Options,
}

impl Practice {
    /// Whether it goes row by row.
    pub(crate) fn is_sweep(&self) -> bool {
        self.entry.group == Group::Sweeps
    }

    /// What an iteration of it is called.
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

    /// Another solver with these settings, but for the number of steps of one that is there or
    /// nowhere.
    pub fn other(&self, name: &str) -> Option<Box<dyn Solver>> {
        let mut options = self.options.clone();
        let entry = lcplab_solver::entry(name).ok()?;
        if entry.group != Group::Sweeps && entry.group != Group::FirstOrder {
            options.settings.max_iterations = Options::default().settings.max_iterations;
        }
        by_name(name, &options).ok()
    }
}

/// What an impulse (N s) or force (N) should be, and what it is.
#[derive(Debug, Clone, PartialEq)]
pub struct Load {
    /// Who carries or is carried.
    pub name: String,
    /// Upward in the solution.
    pub due: f64,
    /// Upward in the answer.
    pub given: f64,
    /// The fastest approach that the answer leaves in a row, max −w (m/s, or m/s²).
    pub approach: f64,
    /// The fastest parting that feedback of errors asks of a row, max −bias.
    pub bias: f64,
}

impl Load {
    /// Nothing yet.
    fn named(name: &str) -> Self {
        Load { name: name.into(), due: 0.0, given: 0.0, approach: 0.0, bias: 0.0 }
    }

    /// The part that is missing.
    pub fn missing(&self) -> f64 {
        1.0 - self.given / self.due
    }
}

/// What an answer leaves undone, why, and what helps.
#[derive(Debug, Clone)]
pub struct Shortfall {
    /// Which problem.
    pub subject: String,
    /// Who solved it.
    pub solver: String,
    /// Its sweeps, pivots or steps.
    pub iterations: usize,
    /// What one of them is called.
    pub unit: &'static str,
    /// What it said of its answer.
    pub status: Status,
    /// The answer.
    pub x: Vec<f64>,
    /// The scaled residual of the answer.
    pub residual: f64,
    /// What is missing, as a part of what the constraints have to do.
    pub missing: f64,
    /// Whether the judge accepts the answer, so that nothing that counts is missing.
    pub is_accepted: bool,
    /// The same by theory, of sweeps.
    pub predicted: Option<f64>,
    /// The whole weight that is carried, and that of each body and each pair; empty if that is not
    /// known.
    pub whole: Option<Load>,
    /// Body by body.
    pub bodies: Vec<Load>,
    /// Pair by pair, the worst first.
    pub pairs: Vec<Load>,
    /// Whether x are forces, else impulses.
    pub is_of_forces: bool,
    /// The slowest pattern of Gauss-Seidel.
    pub slowest: Option<Slowest>,
    /// The body that moves most in it, if bodies are known.
    pub mover: Option<String>,
    /// The sweeps of Gauss-Seidel to a good answer, and whether they were done or follow from the
    /// last that were.
    pub sweeps: Option<(f64, bool)>,
    /// Why, the strongest first; empty if nothing is missing.
    pub causes: Vec<Slow>,
    /// What helps, the best first.
    pub remedies: Vec<Remedy>,
}

/// Solves the problem of a frame as is the practice, from a start if there is one, and examines the
/// answer. `None` if no solution is known to compare with, or A is not symmetric.
pub fn examine(frame: &Frame, practice: &Practice, start: Option<&[f64]>) -> Option<Shortfall> {
    let lcp = &frame.lcp;
    let own = start.map_or_else(Start::default, Start::at);
    let Solution { x, status, iterations, .. } = practice.solver().solve(lcp, &own, &mut ());
    let yard = Yard::of(frame)?;
    let linear = Linear::new(lcp, &yard);
    let zero = super::yard::start(lcp);
    let sweeps = practice.options.settings.max_iterations;
    let is_plain = practice.entry.name == "pgs" && practice.options.order == Order::Natural;
    let missing = yard.missing(&x);
    let predicted = (is_plain && sweeps <= MOST_SWEEPS)
        .then(|| linear.missing(start.unwrap_or(&zero), Way::PLAIN, sweeps))
        .flatten();
    let mut found = Shortfall {
        subject: frame.name.clone(),
        solver: practice.entry.name.into(),
        iterations,
        unit: practice.unit(),
        status,
        residual: merit::scaled_residual(lcp, &x),
        missing,
        is_accepted: yard.is_accepted(&x),
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
    found.loads(frame, &yard.exact);
    if yard.is_needed() && found.is_short() {
        let case = Case { frame, practice, yard: &yard, linear: &linear };
        let suspected = case.solver(&found, start);
        let plain = Practice { entry: *entry("pgs").ok()?, options: practice.options.clone() };
        match suspected {
            None => case.explain(&mut found, start, missing),
            Some((cause, left)) => {
                found.causes.push(cause);
                if left > HEALTHY {
                    // The scene is to blame for what plain sweeps leave, not for more.
                    Case { practice: &plain, ..case }.explain(&mut found, start, left);
                }
            }
        }
        found.remedies = remedies(frame, practice, &yard, &linear);
    }
    Some(found)
}

/// What contacts that yield leave undone in the solution itself, if it is worth a word.
pub fn creep(frame: &Frame) -> Option<Moving> {
    let rigid = frame.rigid()?;
    let weight = frame.weight(|_| 1.0);
    let (soft, hard) = (Yard::new(&frame.lcp, weight)?, Yard::new(&rigid, weight)?);
    let missing = hard.missing(&soft.exact);
    let approach = rigid.w(&soft.exact);
    let speed = approach.iter().fold(0.0, |most: f64, w| most.max(-w));
    (missing > HEALTHY).then_some(Moving::Creep { speed, missing })
}

impl Shortfall {
    /// Who carries how much of the weight.
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
        // Where nothing is carried, there is no weight of which a part is missing.
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
    practice: &'a Practice,
    yard: &'a Yard<'a>,
    linear: &'a Linear<'a>,
}

impl Case<'_> {
    fn most(&self) -> usize {
        MOST_SWEEPS.min(MULTIPLICATIONS / (1 + self.frame.lcp.matrix().stored()))
    }

    /// A changed problem, where gravity does `weight`: the sweeps that it needs, and what is
    /// missing when it is solved as this one was.
    fn changed(&self, lcp: &Lcp, weight: f64) -> Option<[f64; 2]> {
        let yard = Yard::new(lcp, weight)?;
        if !yard.is_needed() {
            return Some([1.0, 0.0]);
        }
        let needed = sweeps_to(lcp, &yard, Order::Natural, GOOD, self.most()).0;
        let solution = self.practice.solver().solve(lcp, &Start::default(), &mut ());
        Some([needed.max(1.0), yard.missing(&solution.x)])
    }

    /// Adds the causes of slow sweeps; `missing` is missing after those of the practice.
    fn explain(&self, found: &mut Shortfall, from: Option<&[f64]>, missing: f64) {
        let lcp = &self.frame.lcp;
        let zero = super::yard::start(lcp);
        found.slowest = self.linear.slowest(&zero, GOOD, self.most());
        let Some(slowest) = &found.slowest else { return };
        let (needed, is_done) = sweeps_to(lcp, self.yard, Order::Natural, GOOD, self.most());
        found.sweeps = Some((needed, is_done));
        let speeds = self.frame.speeds(&slowest.forces);
        let speed = |k: &usize| speeds[*k];
        let movers = || 0..self.frame.bodies.len();
        let mover = movers().max_by(|a, b| speed(a).total_cmp(&speed(b)));
        found.mover = mover.map(|k| self.frame.bodies[k].name.clone());
        let mut causes: Vec<(Without, Slow)> = Vec::new();
        causes.extend(self.masses_and_height([needed, missing], mover, &speed));
        causes.extend(self.motors([needed, missing]));
        if self.practice.is_sweep() {
            causes.extend(self.order());
        }
        causes.extend(from.and_then(|_| self.stale(missing)));
        let is_telling = |own: &Without| own.factor >= TELLING && own.share() >= WORTH * missing;
        causes.retain(|(without, _)| is_telling(without));
        // Of those that explain most of it, each alone, the one that is taken away most easily
        // comes first.
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
        if found.causes.is_empty() {
            found.causes.push(Slow::Other);
        }
    }

    /// The solver as a cause, if plain Gauss-Seidel does far better with the same number of sweeps,
    /// and the part that plain Gauss-Seidel leaves missing.
    fn solver(&self, found: &Shortfall, from: Option<&[f64]>) -> Option<(Slow, f64)> {
        let Practice { entry, options } = self.practice;
        if entry.group != Group::Plugin {
            return None; // those of the library are tested; some of them are slower than sweeps
        }
        let start = from.map_or_else(Start::default, Start::at);
        let pgs = Pgs { settings: options.settings.clone(), ..Pgs::default() };
        let plain = pgs.solve(&self.frame.lcp, &start, &mut ());
        let left = self.yard.missing(&plain.x);
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
                None => find_mistakes(&self.frame.lcp, &found.x, from).mistakes,
            };
            let (sweeps, with) = (plain.iterations, found.missing);
            (Slow::Solver { sweeps, with, plain: left, refusal, mistakes }, left)
        })
    }

    /// What equal masses do, if masses are known, and then keeping pairs of bodies apart.
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
            // What is not missing now cannot be missing because of it.
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

    /// What motors do that are at their limits.
    fn motors(&self, [needed, missing]: [f64; 2]) -> Option<(Without, Slow)> {
        let rows = self.yard.motors_at_limits();
        if rows.is_empty() {
            return None;
        }
        let weak = self.frame.with_efforts(&rows, WEAK)?;
        let [fewer, without] = self.changed(&weak, self.frame.weight(|_| 1.0))?;
        let without = Without { factor: needed / fewer, with: missing, without };
        Some((without, Slow::Motors { between: self.frame.between(&rows), without }))
    }

    /// The other order. In the long run it is no faster (both ways a chain has the same
    /// eigenvalues): it counts in the first sweeps, as many as bodies that an impulse goes through.
    fn order(&self) -> Option<(Without, Slow)> {
        let lcp = &self.frame.lcp;
        let mut reversed = self.practice.clone();
        reversed.options.order = Order::Reverse;
        let run = |practice: &Practice| {
            let solution = practice.solver().solve(lcp, &Start::default(), &mut ());
            self.yard.missing(&solution.x)
        };
        let (with, without) = (run(self.practice), run(&reversed));
        let without = Without { factor: with / without, with, without };
        Some((without, Slow::Order { without }))
    }

    fn stale(&self, missing: f64) -> Option<(Without, Slow)> {
        let solution = self.practice.solver().solve(&self.frame.lcp, &Start::default(), &mut ());
        let left = self.yard.missing(&solution.x);
        let without = Without { factor: missing / left, with: missing, without: left };
        Some((without, Slow::Stale { without }))
    }
}
