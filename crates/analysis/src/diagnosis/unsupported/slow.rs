//! Causes of slow sweeps: the problem is solved again without each suspect.

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::ProblemForm;
use lcplab_solver::{Group, Order, Pgs, Solver, Start, Status};

use super::cause::{Slow, Without};
use super::examine::{UnsupportedLoad, UserSolver};
use super::frame::{Body, Frame};
use super::linear::Linear;
use super::reference::{ReferenceSolution, start};
use super::remedy::sweeps_to;
use super::suspect::{Suspect, test_all};
use super::thresholds::{
    EXPLAINS, EXPLAINS_MOST, FEWER_SWEEPS, GOOD, HEALTHY, WEAK_MOTOR, WORSE_THAN_PLAIN,
};
use crate::diagnosis::find_mistakes;

/// Maximum number of sweeps, and of multiplications, for counting sweeps.
pub(super) const MOST_SWEEPS: usize = 20_000;
const MULTIPLICATIONS: usize = 10_000_000;

/// A problem that a user's solver solves with an error.
#[derive(Clone, Copy)]
pub(super) struct Case<'a> {
    pub frame: &'a Frame,
    pub user_solver: &'a UserSolver,
    pub reference: &'a ReferenceSolution<'a>,
    pub linear: &'a Linear<'a>,
    /// The start of the user's solve; `None` for x = 0.
    pub from: Option<&'a [f64]>,
}

/// The cost and the error of sweeps.
#[derive(Clone, Copy)]
struct Pace {
    /// The number of sweeps to a good answer.
    needed: f64,
    /// The error after the user's number of sweeps.
    error: f64,
}

/// A case with what is known of its sweeps.
struct Sweeps<'a> {
    case: Case<'a>,
    own: Pace,
    /// The speed of each body in the slowest mode, and the fastest body.
    speeds: Vec<f64>,
    mover: Option<usize>,
    /// The problem with equal masses, if masses are known.
    equal: Option<Lcp>,
    /// The effect of gravity on these masses.
    weight: f64,
    /// The pace with these masses.
    alike: Pace,
}

/// A cause comes with the part of the error that it explains.
type Row<'a> = Suspect<Sweeps<'a>, Without, Option<(f64, Slow)>>;

/// The suspects of slow sweeps; height is tested with equal masses.
fn suspects<'a>() -> [Row<'a>; 5] {
    [
        Suspect { intervention: Sweeps::equal_masses, measure: Sweeps::mass_ratio },
        Suspect { intervention: Sweeps::separate_pairs, measure: Sweeps::height },
        Suspect { intervention: Sweeps::weak_motors, measure: Sweeps::motors },
        Suspect {
            intervention: Sweeps::reversed_rows,
            measure: |case, without| case.decided(without, Slow::Order { without }),
        },
        Suspect {
            intervention: Sweeps::cold_start,
            measure: |case, without| case.decided(without, Slow::Stale { without }),
        },
    ]
}

impl<'a> Case<'a> {
    /// Adds the causes of slow sweeps; `missing` is the error after the user's number of sweeps.
    pub fn explain(&self, found: &mut UnsupportedLoad, missing: f64) {
        let lcp = &self.frame.lcp;
        found.slowest = self.linear.slowest(&start(lcp), GOOD, self.most());
        let Some(slowest) = &found.slowest else { return };
        let speeds = self.frame.speeds(&slowest.forces);
        let (needed, is_done) = sweeps_to(lcp, self.reference, Order::Natural, GOOD, self.most());
        found.sweeps = Some((needed, is_done));
        let sweeps = Sweeps::of(*self, Pace { needed, error: missing }, speeds);
        found.mover = sweeps.mover.map(|k| self.frame.bodies[k].name.clone());
        let mut causes: Vec<(f64, Slow)> =
            test_all(&suspects(), &sweeps).into_iter().flatten().collect();
        // Of the causes that each explain most of the error alone, the one that is removed most
        // easily comes first.
        let place = |(share, cause): &(f64, Slow)| match *share >= EXPLAINS_MOST * missing {
            true => (cause.ease(), 0.0),
            false => (usize::MAX, -share),
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
    /// of sweeps; with the error of plain Gauss-Seidel, which alone the other suspects explain.
    pub(crate) fn solver(&self, found: &UnsupportedLoad) -> Option<(Slow, f64)> {
        let UserSolver { entry, options } = self.user_solver;
        if entry.group != Group::Plugin {
            // Solvers of the library are tested; some of them are slower than sweeps.
            return None;
        }
        let start = self.from.map_or_else(Start::default, Start::at);
        let pgs = Pgs { settings: options.settings.clone(), ..Pgs::default() };
        let plain = pgs.solve(&self.frame.lcp, &start, &mut ());
        let left = self.reference.missing(&plain.x);
        if found.missing < WORSE_THAN_PLAIN * left || found.missing - left < HEALTHY {
            return None;
        }
        let refusal = match &found.status {
            Status::NoAnswer { .. } | Status::OutsideClass { .. } => Some(found.status.to_string()),
            _ => None,
        };
        let mistakes = match &refusal {
            Some(_) => Vec::new(),
            None => {
                let problem = ProblemForm::Boxed(self.frame.lcp.clone());
                find_mistakes(&problem, &found.x, self.from).mistakes
            }
        };
        let (sweeps, with) = (plain.iterations, found.missing);
        Some((Slow::Solver { sweeps, with, plain: left, refusal, mistakes }, left))
    }

    fn most(&self) -> usize {
        MOST_SWEEPS.min(MULTIPLICATIONS / (1 + self.frame.lcp.matrix().stored()))
    }

    /// The pace of a changed problem, with the effect of gravity `weight`.
    fn changed(&self, lcp: &Lcp, weight: f64) -> Option<Pace> {
        let reference = ReferenceSolution::new(lcp, weight)?;
        if !reference.is_needed() {
            return Some(Pace { needed: 1.0, error: 0.0 });
        }
        let needed = sweeps_to(lcp, &reference, Order::Natural, GOOD, self.most()).0.max(1.0);
        let solution = self.user_solver.solver().solve(lcp, &Start::default(), &mut ());
        Some(Pace { needed, error: reference.missing(&solution.x) })
    }

    /// The error of a solver after the user's number of sweeps from x = 0.
    fn error_of(&self, user_solver: &UserSolver) -> f64 {
        let solution = user_solver.solver().solve(&self.frame.lcp, &Start::default(), &mut ());
        self.reference.missing(&solution.x)
    }
}

impl<'a> Sweeps<'a> {
    fn of(case: Case<'a>, own: Pace, speeds: Vec<f64>) -> Self {
        let bodies = &case.frame.bodies;
        let mover = (0..bodies.len()).max_by(|&a, &b| speeds[a].total_cmp(&speeds[b]));
        let mean = bodies.iter().map(|body| body.mass.ln()).sum::<f64>() / bodies.len() as f64;
        let mobility: Vec<f64> = bodies.iter().map(|body| body.mass / mean.exp()).collect();
        let equal = case.frame.with_mobility(&mobility);
        let weight = match &equal {
            Some(_) => case.frame.weight(|k| 1.0 / mobility[k]),
            None => case.frame.weight(|_| 1.0),
        };
        let alike = equal.as_ref().filter(|_| mover.is_some());
        let alike = alike.and_then(|lcp| case.changed(lcp, weight)).unwrap_or(own);
        Sweeps { case, own, speeds, mover, equal, weight, alike }
    }

    /// A cause, if its removal saves enough sweeps and explains enough of the error.
    fn decided(&self, without: Without, cause: Slow) -> Option<(f64, Slow)> {
        let share = without.share();
        let is_cause = without.factor >= FEWER_SWEEPS && share >= EXPLAINS * self.own.error;
        is_cause.then_some((share, cause))
    }

    fn equal_masses(&self) -> Option<Without> {
        let Sweeps { own, alike, .. } = self;
        self.equal.as_ref().and(self.mover)?;
        let factor = own.needed / alike.needed;
        Some(Without { factor, with: own.error, without: alike.error })
    }

    fn mass_ratio(&self, without: Without) -> Option<(f64, Slow)> {
        let bodies = &self.case.frame.bodies;
        let largest = self.mover.map_or(0.0, |mover| self.speeds[mover]);
        let moves = |k: &usize| self.speeds[*k] > HEALTHY * largest;
        let moving = || (0..bodies.len()).filter(moves).map(|k| &bodies[k]);
        let by_mass = |a: &&Body, b: &&Body| a.mass.total_cmp(&b.mass);
        let named = |body: Option<&Body>| {
            body.map_or_else(Default::default, |body| (body.name.clone(), body.mass))
        };
        let (heavy, light) = (named(moving().max_by(by_mass)), named(moving().min_by(by_mass)));
        self.decided(without, Slow::MassRatio { heavy, light, without })
    }

    /// Each pair of bodies solved on its own, with equal masses in both cases.
    fn separate_pairs(&self) -> Option<Without> {
        let Case { frame, .. } = self.case;
        let apart = frame.by_pairs(self.equal.as_ref().unwrap_or(&frame.lcp))?;
        let left = self.case.changed(&apart, self.weight)?;
        // It cannot explain more than the present error.
        let with = self.alike.error.min(self.own.error);
        let factor = self.alike.needed / left.needed;
        Some(Without { factor, with, without: left.error })
    }

    fn height(&self, without: Without) -> Option<(f64, Slow)> {
        let mover = self.mover.filter(|_| self.equal.is_some());
        let bodies = mover.map(|mover| self.case.frame.diameter(mover));
        self.decided(without, Slow::Tall { bodies, without })
    }

    fn weak_motors(&self) -> Option<Without> {
        let Case { frame, reference, .. } = self.case;
        let rows = reference.motors_at_limits();
        if rows.is_empty() {
            return None;
        }
        let weak = frame.with_efforts(&rows, WEAK_MOTOR)?;
        let left = self.case.changed(&weak, frame.weight(|_| 1.0))?;
        let factor = self.own.needed / left.needed;
        Some(Without { factor, with: self.own.error, without: left.error })
    }

    fn motors(&self, without: Without) -> Option<(f64, Slow)> {
        let between = self.case.frame.between(&self.case.reference.motors_at_limits());
        self.decided(without, Slow::Motors { between, without })
    }

    /// The rows in the other order. In the long run it is no faster (a chain has the same
    /// eigenvalues in both orders). It matters in the first sweeps, until impulses have passed all
    /// bodies on their path.
    fn reversed_rows(&self) -> Option<Without> {
        let Case { user_solver, .. } = self.case;
        if !user_solver.is_sweep() {
            return None;
        }
        let mut reversed = user_solver.clone();
        reversed.options.order = Order::Reverse;
        let [with, without] = [user_solver, &reversed].map(|solver| self.case.error_of(solver));
        Some(Without { factor: with / without, with, without })
    }

    /// The solve from x = 0, if it began elsewhere.
    fn cold_start(&self) -> Option<Without> {
        let with = self.own.error;
        self.case.from?;
        let without = self.case.error_of(self.case.user_solver);
        Some(Without { factor: with / without, with, without })
    }
}
