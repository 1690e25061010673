//! A step of a scene with contacts: A assembled, and A never formed. Friction follows the normal force.

use super::{Checked, Finding, Form, Plan, Sweeper, Times, clocked};
use lcplab::error::{Error, Result};
use lcplab::formulation::Problem;
use lcplab::report::study::Study;
use lcplab::report::study::settings::AtStep;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{EightPairs, RowByRow, System};
use lcplab::solver::{Options, Settings, by_name};
use lcplab::storage::Factors;

/// The name of the form without A in the natural order.
pub const ROW_BY_ROW: &str = "row by row";
/// The name of the form without A, eight pairs of bodies at a time.
pub const EIGHT_PAIRS: &str = "eight pairs";

/// Sweeps for each step on the way to the problem.
const ON_THE_WAY: usize = 20;

pub(super) fn measure(plan: &Plan, problem: String, at: &AtStep) -> Result<(Finding, Times)> {
    let posed = posed(at)?;
    let lcp = &posed.lcp;
    let factors = Factors::of(&posed.assembly);
    let rows = factors.scaled_rows();
    let refused = |reason: String| Error::invalid(Plan::NAME, &*problem, reason);
    let system =
        System::new(factors.bodies(), &rows, lcp).map_err(|status| refused(status.to_string()))?;
    let eight = |width| EightPairs::new(&system, width);
    let eight_order = eight(Width::Portable).map_err(|status| refused(status.to_string()))?.order();
    let order: Vec<usize> = (0..lcp.len()).collect();
    let forms = [
        Form::plain(lcp, &order),
        Form {
            name: ROW_BY_ROW,
            widths: Vec::new(),
            order: order.clone(),
            start: Box::new(|_| {
                Ok(Box::new(Rows { system: &system, kernel: RowByRow::new(&system) }))
            }),
        },
        Form {
            name: EIGHT_PAIRS,
            widths: Width::available().collect(),
            order: eight_order,
            start: Box::new(|width| Ok(Box::new(eight(width)?))),
        },
    ];
    let mut checked: Vec<Checked> =
        forms.iter().map(|form| form.checked(lcp)).collect::<Result<_>>()?;
    for (form, checked) in forms.iter().zip(&mut checked).skip(1) {
        checked.sweeps = form.sweeps_to(lcp, plan)?;
    }
    // Row by row the iterates are those of the assembled rows: one count serves both.
    checked[0].sweeps = checked[1].sweeps.clone();
    let finding = Finding {
        problem: problem.clone(),
        rows: lcp.len(),
        stored: lcp.matrix().stored(),
        tolerances: plan.tolerances.clone(),
        forms: checked,
    };
    let (_, runs) = clocked(plan, &forms, &finding, Vec::new());
    let times =
        Times { problem, rows: lcp.len(), read: None, tolerances: plan.tolerances.clone(), runs };
    Ok((finding, times))
}

/// The first problem of the step, after steps by a few sweeps each: direct methods take too long on
/// a tower.
pub(crate) fn posed(at: &AtStep) -> Result<Problem> {
    let settings = Settings { max_iterations: ON_THE_WAY, ..Settings::default() };
    let pgs = by_name("pgs", &Options { settings, ..Options::default() })?;
    let mut simulation = Simulation::new(Scene::load(&at.scene)?, pgs);
    let refused = |reason: String| Error::invalid(&*at.scene, format!("step {}", at.step), reason);
    let mut last = None;
    for _ in 0..at.step {
        last = Some(simulation.step().map_err(|failure| refused(failure.to_string()))?);
    }
    let solve = last.and_then(|step| step.solves.into_iter().next());
    Ok(solve.ok_or_else(|| refused("it solves no problem".into()))?.problem)
}

/// Row by row over a system.
struct Rows<'a> {
    system: &'a System,
    kernel: RowByRow,
}

impl Sweeper for Rows<'_> {
    fn sweep(&mut self) {
        self.kernel.sweep(self.system);
    }

    fn x(&self) -> Vec<f64> {
        self.kernel.x().to_vec()
    }
}

impl Sweeper for EightPairs {
    fn sweep(&mut self) {
        EightPairs::sweep(self);
    }

    fn x(&self) -> Vec<f64> {
        EightPairs::x(self)
    }
}
