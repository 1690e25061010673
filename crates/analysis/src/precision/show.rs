//! Errors by precision as text and as JSON.

use serde_json::{Map, Value, json};

use super::{Loss, Precision, StageLoss, TextbookSolver};
use lcplab_lcp::Level;
use lcplab_lcp::file::number;
use lcplab_lcp::number::count;
use lcplab_page::number::{plain, readable};

impl Precision {
    /// Whether single precision suffices, where it loses most and which stage mends it.
    pub fn finding(&self) -> String {
        let relative = |loss: &Loss| shown(loss.relative);
        let limit = shown(self.tolerance);
        let (single, double) = (relative(&self.single), relative(&self.double));
        if self.double.relative > self.tolerance {
            return format!(
                "rounding is not the limit: {} in double precision has a relative motion error of {double} above \
                 the limit {limit}",
                self.solver.name()
            );
        }
        let most = |words: &str| match self.worst() {
            Some(worst) => format!(
                "{words} in stage {}; with this stage in double {}",
                worst.stage.name(),
                relative(&worst.mended)
            ),
            None => "nothing is lost".into(),
        };
        if self.suffices() {
            let most = most("most is lost");
            return format!(
                "single precision suffices: relative motion error {single}, limit {limit}; {most}"
            );
        }
        let lost = format!(
            "single precision does not suffice: relative motion error {single}, limit {limit}"
        );
        match self.best_mended() {
            Some(best) if best.mended.relative <= self.tolerance => format!(
                "{lost}; stage {} in double mends it: {}",
                best.stage.name(),
                relative(&best.mended)
            ),
            _ => format!("{lost}; no single stage in double mends it, {}", most("most is lost")),
        }
    }

    /// The block of text that commands print: the finding, the prediction and a table of stages.
    pub fn text(&self) -> String {
        let sweeps = match self.solver {
            TextbookSolver::Pgs => format!(", {} sweeps", count(self.sweeps)),
            _ => String::new(),
        };
        let predicted =
            self.predicted.map_or("no formula for interior-point methods".into(), |own| {
                format!("relative motion error {} in single precision", shown(own))
            });
        let reference = match (self.is_proved, self.is_frozen) {
            (true, true) => "proved for frozen friction limits",
            (true, false) => "proved",
            (false, _) => "accepted by the judge",
        };
        let measure = match &self.u {
            Some(_) => {
                let level = self.level.unwrap_or(Level::Velocity);
                let effect = format!("{} {}", shown(self.effect), level.norm_unit());
                format!(
                    "relative to the constraints' effect, {effect}; entry: largest error of a velocity, in {}",
                    level.units()
                )
            }
            None => "relative to |x|_A; entry: largest error of w".into(),
        };
        let mut text = format!("{}\n", self.finding());
        text += &format!(
            "  solver      {}{sweeps}; reference solution {reference}\n",
            self.solver.name()
        );
        text += &format!("  predicted   {predicted}\n");
        text += &format!("  errors      {measure}\n");
        text += "            this stage alone in single        in double\n";
        text += &row(
            "stage",
            ["relative", "entry", "residual", "relative"].map(String::from),
            "cost of double",
        );
        for StageLoss { stage, alone, mended, cost } in &self.stages {
            text += &row(stage.name(), cells(alone, &shown(mended.relative)), cost);
        }
        text += &row("all", cells(&self.single, &shown(self.double.relative)), "");
        text
    }

    /// The object that commands print.
    pub fn json(&self) -> Map<String, Value> {
        let stage = |own: &StageLoss| {
            json!({
                "name": own.stage.name(),
                "alone": own.alone.json(),
                "mended": own.mended.json(),
                "cost": own.cost,
            })
        };
        let list = |v: &[f64]| v.iter().map(|x| number(*x)).collect::<Value>();
        let object = json!({
            "finding": plain(&self.finding()),
            "suffices": self.suffices(),
            "solver": self.solver.name(),
            "sweeps": (self.solver == TextbookSolver::Pgs).then_some(self.sweeps),
            "tolerance": number(self.tolerance),
            "predicted": self.predicted.map(number),
            "proved": self.is_proved,
            "effect": number(self.effect),
            "x": list(&self.x),
            "u": self.u.as_deref().map(list),
            "single": self.single.json(),
            "double": self.double.json(),
            "stages": self.stages.iter().map(stage).collect::<Vec<_>>(),
        });
        object.as_object().cloned().unwrap_or_default()
    }
}

impl Loss {
    fn json(&self) -> Value {
        json!({
            "motion_error": number(self.error),
            "relative": number(self.relative),
            "largest_entry": number(self.largest_entry),
            "scaled_residual": number(self.scaled_residual),
        })
    }
}

fn row(name: &str, cells: [String; 4], cost: &str) -> String {
    let [relative, entry, residual, mended] = cells;
    let line = format!("{name:<10}{relative:>9} {entry:>9} {residual:>9} {mended:>12}   {cost}");
    format!("{}\n", line.trim_end())
}

fn cells(loss: &Loss, mended: &str) -> [String; 4] {
    let [relative, entry, residual] =
        [loss.relative, loss.largest_entry, loss.scaled_residual].map(shown);
    [relative, entry, residual, mended.into()]
}

fn shown(value: f64) -> String {
    readable(value, 2)
}
