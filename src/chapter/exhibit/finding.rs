//! The result of an example: numbers of the printed and the corrected form, compared with the
//! truth.

use crate::document::Table;
use crate::judge::{Demand, Verdict, judge};
use crate::lcp::Lcp;
use crate::plot::Lines;
use crate::report::page::Picture;

/// The result of an example.
#[derive(Debug, Clone, Default)]
pub struct Finding {
    /// The example in words, with all its numbers; plain text, paragraphs separated by an empty
    /// line.
    pub example: String,
    /// The measures. Each must distinguish the two forms, unless `agrees` says otherwise.
    pub measures: Vec<Measure>,
    /// The verdicts on the answers of both forms to one LCP: `(problem in words, printed,
    /// corrected)`.
    pub judged: Vec<(String, Verdict, Verdict)>,
    /// Other numbers, which do not decide which form is right.
    pub tables: Vec<Table>,
    /// A figure, if it helps.
    pub picture: Option<Picture>,
}

/// A quantity in the printed and the corrected form, with its true value.
#[derive(Debug, Clone)]
pub struct Measure {
    /// What is measured, such as `velocity after the step`.
    pub quantity: String,
    /// Its unit; empty for a pure number.
    pub unit: &'static str,
    /// The result of the printed form.
    pub printed: Outcome,
    /// The result of the corrected form.
    pub corrected: Outcome,
    /// The true value, if it is a number that can be computed independently.
    pub truth: Vec<f64>,
    /// The source of the true value: `closed form`, `dual numbers`, `exact rational arithmetic`.
    pub source: &'static str,
    /// The largest difference from the true value, in the unit, that counts as right.
    pub tolerance: f64,
    /// Whether the printed form gives the right answer here too: a case that hides the fault.
    pub agrees: bool,
}

/// The result of a form.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    /// Numbers; one for a scalar.
    Numbers(Vec<f64>),
    /// It cannot be computed, for this reason.
    Impossible(String),
}

impl Finding {
    /// A finding for this example without measures.
    pub(crate) fn new(example: impl Into<String>) -> Self {
        Finding { example: example.into(), ..Finding::default() }
    }

    /// Adds a measure.
    pub(crate) fn measure(mut self, measure: Measure) -> Self {
        self.measures.push(measure);
        self
    }

    /// Adds the verdicts on both forms' answers x to one problem: the printed one must be rejected,
    /// the corrected one accepted.
    pub(crate) fn judged(
        mut self,
        problem: impl Into<String>,
        lcp: &Lcp,
        printed: &[f64],
        corrected: &[f64],
    ) -> Self {
        let word = |x: &[f64]| judge(lcp, x, &Demand::default()).verdict;
        self.judged.push((problem.into(), word(printed), word(corrected)));
        self
    }

    /// Adds a table, all of whose rows are shown.
    pub(crate) fn table(mut self, title: &str, columns: &[&str], rows: Vec<Vec<String>>) -> Self {
        self.tables.push(Table::whole(title, columns, rows));
        self
    }

    /// Sets these curves as the figure.
    pub(crate) fn plot(mut self, lines: &Lines) -> Self {
        self.picture = Some(Picture::inline(lines));
        self
    }

    /// Whether the erratum is demonstrated: every corrected form is right, and every printed form
    /// is wrong where it should be.
    pub fn is_shown(&self) -> bool {
        let is_told_apart = |(_, printed, corrected): &(String, Verdict, Verdict)| {
            !printed.is_solution() && corrected.is_solution()
        };
        self.measures.iter().all(Measure::is_as_claimed)
            && self.judged.iter().all(is_told_apart)
            && (!self.judged.is_empty() || self.measures.iter().any(|measure| !measure.agrees))
    }
}

impl Measure {
    /// A measure with the numbers of both forms.
    pub(crate) fn new(
        quantity: impl Into<String>,
        unit: &'static str,
        printed: impl Into<Outcome>,
        corrected: impl Into<Outcome>,
    ) -> Self {
        Measure {
            quantity: quantity.into(),
            unit,
            printed: printed.into(),
            corrected: corrected.into(),
            truth: Vec::new(),
            source: "",
            tolerance: 0.0,
            agrees: false,
        }
    }

    /// Sets the true value, its source, and the tolerance.
    pub(crate) fn truth(mut self, truth: &[f64], source: &'static str, tolerance: f64) -> Self {
        (self.truth, self.source, self.tolerance) = (truth.to_vec(), source, tolerance);
        self
    }

    /// Marks a case in which the printed form happens to be right too.
    pub(crate) fn agreeing(mut self) -> Self {
        self.agrees = true;
        self
    }

    /// Whether the corrected form is right, and the printed one wrong (or right, if it `agrees`).
    pub(crate) fn is_as_claimed(&self) -> bool {
        self.is_right(&self.corrected) && self.is_right(&self.printed) == self.agrees
    }

    /// Whether an outcome equals the true value within the tolerance.
    pub(crate) fn is_right(&self, outcome: &Outcome) -> bool {
        match outcome {
            Outcome::Numbers(values) => {
                values.len() == self.truth.len()
                    && values.iter().zip(&self.truth).all(|(a, b)| (a - b).abs() <= self.tolerance)
            }
            Outcome::Impossible(_) => false,
        }
    }
}

impl From<f64> for Outcome {
    fn from(value: f64) -> Self {
        Outcome::Numbers(vec![value])
    }
}

impl From<Vec<f64>> for Outcome {
    fn from(values: Vec<f64>) -> Self {
        Outcome::Numbers(values)
    }
}

impl<const N: usize> From<[f64; N]> for Outcome {
    fn from(values: [f64; N]) -> Self {
        Outcome::Numbers(values.to_vec())
    }
}
