//! What a sweep costs: over a dense A beside reading A once, and over a tower of cubes where A need
//! not be formed. The same sweep in several forms, each held against the plain one before it is timed.
//!
//! ```text
//! x_i ← Π_i(x_i − w_i / a_ii),   w = A x + b
//! ```
//!
//! Another order of the rows needs another number of sweeps, so the sweeps to a tolerance are counted
//! too: the time to a tolerance is what counts.

mod contacts;
mod dense;

pub(super) use contacts::posed;
pub use contacts::{EIGHT_PAIRS, ROW_BY_ROW};
pub use dense::{COLUMNS, ROWS};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::timing::{Contender, Time, interleaved, timed};
use lcplab::error::{Error, Result};
use lcplab::lcp::{Lcp, merit};
use lcplab::report::study::Study;
use lcplab::report::study::settings::AtStep;
use lcplab::solver::Status;
use lcplab::solver::kernel::Width;

/// Sweeps from x = 0 before those that are timed, which must still change x.
const BEFORE: usize = 3;
/// Sweeps that are timed together.
const COUNTED: usize = 8;
/// Iterates agree to rounding: part of the largest |x|.
const ROUNDING: f64 = 1e-11;
/// Sweeps between two looks at the residual.
const LOOK: usize = 20;

/// Which problems, how often, and what is asked of the sweeps.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Rows of dense problems.
    pub dense: Vec<usize>,
    /// Steps of scenes with contacts.
    pub scenes: Vec<AtStep>,
    /// Parts of the first natural residual that sweeps are counted to.
    pub tolerances: Vec<f64>,
    /// More sweeps are not made.
    pub most_sweeps: usize,
    /// Rounds of timing.
    pub rounds: usize,
    /// What is asked of the times.
    pub goal: Goal,
}

/// What is asked of the times.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Goal {
    /// A sweep by rows over a dense A, in reads of A: at most.
    pub rows: f64,
    /// The same by columns.
    pub columns: f64,
    /// A sweep over a scene's contacts (ns a row): at most.
    pub row: f64,
    /// The time of the natural order over that of eight pairs, to the smallest of the tolerances
    /// that both reach: at least.
    pub faster: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            dense: Vec::new(),
            scenes: Vec::new(),
            tolerances: vec![1e-2, 1e-3],
            most_sweeps: 20_000,
            rounds: 41,
            goal: Goal::default(),
        }
    }
}

impl Default for Goal {
    fn default() -> Self {
        Goal { rows: 1.3, columns: 0.7, row: 4.0, faster: 3.0 }
    }
}

/// What is known of a problem's sweeps without a clock.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Finding {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// Entries of A that a sweep over the assembled A reads.
    pub stored: usize,
    /// The parts of the first natural residual.
    pub tolerances: Vec<f64>,
    /// By form.
    pub forms: Vec<Checked>,
}

/// A form of the sweep beside the plain one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checked {
    /// The form.
    pub form: String,
    /// The largest difference from the plain sweeps in the same order of rows, in parts of the largest |x|.
    #[serde(with = "lcplab_study::number::always")]
    pub difference: f64,
    /// Whether all instructions that the processor has give the same bits.
    pub same_bits: bool,
    /// Sweeps to each tolerance; nothing where they were too many. Empty if they were not counted.
    pub sweeps: Vec<Option<usize>>,
}

impl Checked {
    /// Whether its iterates are those of the plain sweeps, to rounding: only then is it timed.
    pub fn agrees(&self) -> bool {
        self.difference <= ROUNDING && self.same_bits
    }
}

/// The clock on a problem.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// The problem.
    pub problem: String,
    /// Its rows.
    pub rows: usize,
    /// One read of A (s); only where A is dense.
    pub read: Option<Time>,
    /// The parts of the first natural residual.
    pub tolerances: Vec<f64>,
    /// By form and instructions.
    pub runs: Vec<Run>,
}

/// The clock on a form.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The form.
    pub form: String,
    /// With which instructions; nothing where the compiler chose.
    pub width: Option<String>,
    /// One sweep (s).
    pub sweep: Time,
    /// To each tolerance (s), by the best sweep; nothing where it was not reached.
    pub to: Vec<Option<f64>>,
}

impl Study for Plan {
    const NAME: &'static str = "sweep-speed";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        let dense = self.dense.iter().map(|n| format!("dense, n = {n}"));
        dense
            .chain(self.scenes.iter().map(|at| format!("{}, step {}", at.scene, at.step)))
            .collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let name = self.tasks().swap_remove(task);
        match self.dense.get(task) {
            Some(&n) => dense::measure(self, name, n),
            None => contacts::measure(self, name, &self.scenes[task - self.dense.len()]),
        }
    }
}

/// Something that sweeps, from x = 0 on.
trait Sweeper {
    fn sweep(&mut self);
    fn x(&self) -> Vec<f64>;
}

/// A sweep that is given x.
struct On<F> {
    x: Vec<f64>,
    sweep: F,
}

impl<F: FnMut(&mut [f64])> Sweeper for On<F> {
    fn sweep(&mut self) {
        (self.sweep)(&mut self.x);
    }

    fn x(&self) -> Vec<f64> {
        self.x.clone()
    }
}

type Started<'a> = std::result::Result<Box<dyn Sweeper + 'a>, Status>;

/// A form of the sweep.
struct Form<'a> {
    name: &'static str,
    /// Empty for one whose instructions the compiler chose.
    widths: Vec<Width>,
    /// The order in which it takes the rows.
    order: Vec<usize>,
    /// At x = 0.
    start: Box<dyn Fn(Width) -> Started<'a> + 'a>,
}

/// The name of the sweep as it is defined.
const PLAIN: &str = "as defined";

/// The sweep as it is defined, over the rows of A in this order.
fn plain<'a>(lcp: &'a Lcp, order: &'a [usize]) -> Box<dyn Sweeper + 'a> {
    let sweep = move |x: &mut [f64]| {
        for &i in order {
            let unclamped = x[i] - lcp.row_w(i, x) / lcp.matrix().diagonal(i);
            x[i] = lcp.project(i, unclamped, x);
        }
    };
    Box::new(On { x: vec![0.0; lcp.len()], sweep })
}

impl<'a> Form<'a> {
    fn plain(lcp: &'a Lcp, order: &'a [usize]) -> Self {
        let start = Box::new(move |_| Ok(plain(lcp, order)));
        Form { name: PLAIN, widths: Vec::new(), order: order.to_vec(), start }
    }

    /// With each of its instructions.
    fn each(&self) -> impl Iterator<Item = Option<Width>> {
        let any = self.widths.is_empty().then_some(None);
        any.into_iter().chain(self.widths.iter().map(|width| Some(*width)))
    }

    fn started(&self, width: Option<Width>) -> Result<Box<dyn Sweeper + 'a>> {
        (self.start)(width.unwrap_or(Width::Portable))
            .map_err(|status| Error::invalid(Plan::NAME, self.name, status.to_string()))
    }

    fn swept(&self, width: Option<Width>) -> Result<Vec<f64>> {
        let mut sweeper = self.started(width)?;
        (0..BEFORE + COUNTED).for_each(|_| sweeper.sweep());
        Ok(sweeper.x())
    }

    /// Holds it against the plain sweeps.
    fn checked(&self, lcp: &Lcp) -> Result<Checked> {
        let mut expected = plain(lcp, &self.order);
        (0..BEFORE + COUNTED).for_each(|_| expected.sweep());
        let expected = expected.x();
        let found: Vec<Vec<f64>> = self.each().map(|w| self.swept(w)).collect::<Result<_>>()?;
        let largest = |x: &mut dyn Iterator<Item = f64>| x.map(f64::abs).fold(0.0, larger);
        let missed = largest(&mut found[0].iter().zip(&expected).map(|(x, y)| x - y));
        Ok(Checked {
            form: self.name.into(),
            difference: missed / largest(&mut expected.iter().copied()).max(f64::MIN_POSITIVE),
            same_bits: found.iter().all(|x| *x == found[0]),
            sweeps: Vec::new(),
        })
    }

    /// To be timed: the sweeps that count.
    fn contender<'b>(&'b self, width: Option<Width>) -> Contender<'b> {
        Contender::new(move || {
            let Ok(mut sweeper) = self.started(width) else { return f64::NAN };
            (0..BEFORE).for_each(|_| sweeper.sweep());
            timed(|| (0..COUNTED).for_each(|_| sweeper.sweep()))
        })
    }

    /// The sweeps after which the natural residual is each part of the first one.
    fn sweeps_to(&self, lcp: &Lcp, plan: &Plan) -> Result<Vec<Option<usize>>> {
        let mut sweeper = self.started(self.widths.last().copied())?;
        let first = merit::natural_residual(lcp, &vec![0.0; lcp.len()]);
        let mut reached = vec![None; plan.tolerances.len()];
        for done in (LOOK..=plan.most_sweeps).step_by(LOOK) {
            (0..LOOK).for_each(|_| sweeper.sweep());
            let residual = merit::natural_residual(lcp, &sweeper.x()) / first;
            for (reached, tolerance) in reached.iter_mut().zip(&plan.tolerances) {
                *reached = reached.or((residual <= *tolerance).then_some(done));
            }
            if reached.iter().all(Option::is_some) {
                break;
            }
        }
        Ok(reached)
    }
}

/// The larger one, NaN if either is.
fn larger(a: f64, b: f64) -> f64 {
    if a >= b || a.is_nan() { a } else { b }
}

/// Takes the time of the forms that agree, in turns with some other contenders: theirs come first.
fn clocked<'b>(
    plan: &Plan,
    forms: &'b [Form<'_>],
    finding: &Finding,
    others: Vec<Contender<'b>>,
) -> (Vec<Time>, Vec<Run>) {
    let agreeing = || forms.iter().zip(&finding.forms).filter(|(_, checked)| checked.agrees());
    let runs =
        || agreeing().flat_map(|(form, checked)| form.each().map(move |w| (form, checked, w)));
    let first = others.len();
    let mut contenders = others;
    contenders.extend(runs().map(|(form, _, width)| form.contender(width)));
    let times: Vec<Time> =
        interleaved(plan.rounds, &mut contenders).into_iter().map(|t| t.part(COUNTED)).collect();
    let run = |((_, checked, width), sweep): ((_, &Checked, Option<Width>), &Time)| Run {
        form: checked.form.clone(),
        width: width.map(|width| format!("{width:?}")),
        sweep: *sweep,
        to: checked.sweeps.iter().map(|n| n.map(|n| sweep.best * n as f64)).collect(),
    };
    let clocked = runs().zip(&times[first..]).map(run).collect();
    (times[..first].to_vec(), clocked)
}
