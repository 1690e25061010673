//! The error, its causes and remedies, as sentences and tables.

use lcplab_page::document::Section;
use lcplab_page::number::{counted, readable};

use lcplab_lcp::file::number;
use lcplab_solver::{Group, Registry};
use serde_json::{Value, json};

use super::cause::Slow;
use super::examine::{Load, UnsupportedLoad};
use super::remedy::Remedy;
use super::thresholds::HEALTHY;
use crate::diagnosis::Mistake;

/// Significant digits of measured values.
const DIGITS: usize = 2;

/// Significant digits of percentages from 10 on.
const WHOLE: usize = 5;

/// An error below this fraction is not stated as a number.
const INVISIBLE: f64 = 1e-4;

/// Number of pairs shown.
const PAIRS: usize = 6;

/// A fraction in percent.
pub fn percent(part: f64) -> String {
    match 100.0 * part {
        0.0 => "0 %".into(),
        small if small.abs() < 0.01 => "less than 0.01 %".into(),
        value if value.abs() >= 10.0 => format!("{} %", readable(value.round(), WHOLE)),
        value => format!("{} %", readable(value, DIGITS)),
    }
}

impl UnsupportedLoad {
    /// The error as a fraction: of the weight if that is known, otherwise of the constraints'
    /// effect.
    pub fn part(&self) -> f64 {
        self.whole.as_ref().map_or(self.missing, Load::missing)
    }

    /// Whether there is an error worth reporting; never in an answer that the judge accepts.
    pub fn is_short(&self) -> bool {
        !self.is_accepted && (self.missing > HEALTHY || self.missing.is_nan())
    }

    /// The first sentence.
    pub fn headline(&self) -> String {
        if self.is_accepted {
            return format!(
                "{} solved the problem of this step in {}.",
                self.solver,
                self.counted()
            );
        }
        let leave = if self.iterations == 1 { "leaves" } else { "leave" };
        let who = format!("{} of {} {leave}", self.counted(), self.solver);
        if self.missing < INVISIBLE {
            return format!(
                "After {} of {} the motion has no visible error.",
                self.counted(),
                self.solver
            );
        }
        if !self.is_short() {
            return format!("{who} an error of the motion of only {}.", percent(self.missing));
        }
        let effect = match &self.part {
            Some(part) => format!("the change of motion that the constraints cause in {part}"),
            None => "the change of motion that the constraints cause".into(),
        };
        let error = percent(self.missing);
        match self.whole.as_ref().filter(|whole| whole.missing() > 0.5 * self.missing) {
            _ if self.missing > 1.0 => {
                format!("{who} an error of {error} of {effect}, more than x = 0 has.")
            }
            Some(whole) => {
                format!("{who} {} of the total weight unsupported.", percent(whole.missing()))
            }
            None => format!("{who} an error of {error} of {effect}."),
        }
    }

    fn counted(&self) -> String {
        counted(self.iterations, self.unit)
    }

    /// The convergence rate of sweeps, in a sentence, if they are too slow.
    pub fn pace(&self) -> Option<String> {
        let (slowest, (needed, is_done)) = (self.slowest.as_ref()?, self.sweeps?);
        let sweeps = readable(needed.round(), DIGITS);
        let measured = match is_done {
            true => format!("measured: {sweeps}"),
            false => format!("extrapolated from the measured sweeps: {sweeps}"),
        };
        let mover = self.mover.as_ref();
        Some(format!(
            "While no contact opens or closes, each sweep of Gauss-Seidel multiplies the slowest error \
             pattern by {}{}. Reducing the error to 0.1 % takes {} sweeps in theory; {measured}.",
            readable(slowest.rate, 4),
            mover.map_or(String::new(), |body| format!("; {body} moves most in it")),
            readable(slowest.sweeps.round(), DIGITS),
        ))
    }

    /// The cheapest remedy that removes the error, otherwise the one that leaves the least.
    pub(crate) fn best_remedy(&self) -> Option<&Remedy> {
        let cures = self.remedies.iter().filter(|remedy| remedy.missing <= HEALTHY);
        cures.min_by(|a, b| a.work.total_cmp(&b.work)).or_else(|| self.remedies.first())
    }

    /// The load of each pair of bodies.
    pub(crate) fn loads_section(&self) -> Option<Section> {
        let kind = if self.is_of_forces { "force" } else { "impulse" };
        let worst = self.pairs.first().filter(|own| own.due != 0.0).map(|own| {
            let (part, pair) = (percent(own.given / own.due), own.name.replace('–', " and "));
            format!("loads: {part} of the required {kind} between {pair}")
        });
        let mut section = Section::new(worst.unwrap_or("loads".into()));
        let part = |load: &Load| match load.due {
            0.0 => String::new(),
            due => percent(load.given / due),
        };
        let row = |load: &Load| {
            let loads = [load.due, load.given].map(|load| readable(load, 4));
            [load.name.clone()].into_iter().chain(loads).chain([part(load)]).collect()
        };
        let rows = self.pairs.iter().take(PAIRS).map(row).collect();
        let title = match self.is_of_forces {
            true => "upward force between two bodies (N), largest error first",
            false => "upward impulse between two bodies (N s), largest error first",
        };
        section.table(title, &["between", "required", "actual", "share of required"], rows);
        (!self.pairs.is_empty()).then_some(section)
    }

    /// What the best remedy does, to end a sentence: "the direct method dantzig removes the error".
    pub(crate) fn remedy_in_words(&self) -> Option<String> {
        let best = self.best_remedy()?;
        let entry = Registry::standard().entry(&best.what);
        let is_direct = entry.is_ok_and(|entry| entry.group == Group::Pivoting);
        let what = format!("{}{}", if is_direct { "the direct method " } else { "" }, best.what);
        let verb = if best.what.ends_with("sweeps") { "remove" } else { "removes" };
        Some(match best.missing <= HEALTHY {
            true => format!("{what} {verb} the error"),
            false => {
                format!("with {what} the error falls to {}", percent(best.missing))
            }
        })
    }

    /// The cost of the best remedy, if it removes the error; otherwise empty.
    pub(crate) fn remedy_cost(&self) -> String {
        let cure = self.best_remedy().filter(|best| best.missing <= HEALTHY);
        let costs = cure.map(|best| [best.work, self.work]);
        costs.filter(|own| own.iter().all(|work| work.is_finite())).map_or(String::new(), |own| {
            let [own, given] = own.map(|work| readable(work, DIGITS));
            format!(" with {own} multiplications instead of {given}")
        })
    }

    /// The same as JSON.
    pub fn to_json(&self) -> Value {
        let load = |load: &Load| {
            json!({ "name": load.name, "due": number(load.due), "given": number(load.given),
                "approach": number(load.approach), "bias": number(load.bias) })
        };
        let loads = |loads: &[Load]| loads.iter().map(load).collect::<Vec<_>>();
        let remedy = |remedy: &Remedy| {
            json!({ "what": remedy.what, "missing": number(remedy.missing),
                "predicted": remedy.predicted.map(number), "iterations": remedy.iterations,
                "multiplications": number(remedy.work) })
        };
        let mistake = |own: &Mistake| json!({ "what": own.what, "distance": number(own.distance) });
        let cause = |cause: &Slow| {
            let mut object = json!({ "name": cause.name(), "message": cause.to_string() });
            if let Slow::Solver { mistakes, .. } = cause {
                object["mistakes"] = mistakes.iter().map(mistake).collect();
            }
            object
        };
        json!({
            "subject": self.subject,
            "solver": self.solver,
            "iterations": self.iterations,
            "residual": number(self.residual),
            "missing": number(self.missing),
            "accepted": self.is_accepted,
            "predicted": self.predicted.map(number),
            "weight": self.whole.as_ref().map(load),
            "bodies": loads(&self.bodies),
            "pairs": loads(&self.pairs),
            "rate": self.slowest.as_ref().map(|slowest| number(slowest.rate)),
            "sweeps": self.sweeps.map(|(sweeps, _)| number(sweeps)),
            "causes": self.causes.iter().map(cause).collect::<Vec<_>>(),
            "remedies": self.remedies.iter().map(remedy).collect::<Vec<_>>(),
        })
    }
}
