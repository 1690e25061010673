//! An exhibit as a document.

use super::Exhibit;
use super::finding::{Finding, Measure, Outcome};
use crate::document::notation::{plain, vector};
use crate::document::{Block, Document, Section, unicode};
use crate::error::Result;
use crate::judge::Verdict;
use crate::number::readable;

/// A number below this counts as rounding if the truth is 0.
const ROUNDING: f64 = 1e-12;

impl Exhibit {
    /// The exhibit with its example run, for a terminal or a page.
    ///
    /// # Errors
    /// If the example cannot be set up.
    pub fn document(&self) -> Result<Document> {
        let finding = self.found()?;
        let mut document = Document {
            title: format!("{}: {}", self.id, self.title),
            lead: self.lead(),
            ..Document::default()
        };
        let [printed, holds] = [&self.printed, &self.holds].map(|text| unicode(text));
        for (title, words) in [("Printed", printed), ("Correct", holds), ("Why", self.why.clone())]
        {
            let mut section = Section::new(title);
            section.say(words);
            document.add("", section);
        }
        document.add("", self.evidence(finding.as_ref()));
        document.is_accepted = finding.is_none_or(|finding| finding.is_shown());
        Ok(document)
    }

    fn lead(&self) -> String {
        let scan =
            if self.may_be_scan { ", perhaps by the scan the text was read from" } else { "" };
        format!("{}, {}{scan}.", self.place, self.severity.word())
    }

    fn evidence(&self, finding: Option<&Finding>) -> Section {
        let mut section = Section::new("Example");
        let Some(finding) = finding else {
            section.say(format!("No example: {}", self.in_words));
            return section;
        };
        for paragraph in finding.example.split("\n\n") {
            section.say(paragraph);
        }
        if !finding.measures.is_empty() {
            let columns =
                ["quantity", "unit", "printed", "corrected", "truth", "truth from", "verdict"];
            let rows = finding.measures.iter().map(row).collect();
            section.table("Both forms compared with the true value", &columns, rows);
        }
        if !finding.judged.is_empty() {
            let rows = finding.judged.iter().map(|(problem, printed, corrected)| {
                vec![problem.clone(), word(printed), word(corrected)]
            });
            let columns = ["problem", "printed", "corrected"];
            section.table("The judge on both forms' answers", &columns, rows.collect());
        }
        section.blocks.extend(finding.tables.iter().cloned().map(Block::Table));
        if let Some(picture) = &finding.picture {
            section.figure(picture.clone());
        }
        section.say(if finding.is_shown() {
            "Shown: the printed form fails, the corrected one holds."
        } else {
            "Not shown: the example does not distinguish the two forms."
        });
        section
    }
}

fn row(measure: &Measure) -> Vec<String> {
    let verdict = match (measure.is_as_claimed(), measure.agrees) {
        (true, false) => "distinguished",
        (true, true) => "both hold",
        (false, _) => "not shown",
    };
    vec![
        measure.quantity.clone(),
        measure.unit.to_string(),
        written(&measure.printed, &measure.truth),
        written(&measure.corrected, &measure.truth),
        truth(measure),
        measure.source.to_string(),
        verdict.to_string(),
    ]
}

/// The judge's verdict in a table cell.
fn word(verdict: &Verdict) -> String {
    match verdict {
        Verdict::Proved { .. } => "proved".into(),
        Verdict::NotASolution { amount, .. } => {
            format!("rejected: scaled residual {}", readable(*amount, 2))
        }
        other => other.to_string(),
    }
}

fn written(outcome: &Outcome, truth: &[f64]) -> String {
    match outcome {
        Outcome::Numbers(values) => numbers(values, truth),
        Outcome::Impossible(reason) => reason.clone(),
    }
}

/// The true value, with its tolerance if the corrected form does not show the same digits.
fn truth(measure: &Measure) -> String {
    let truth = numbers(&measure.truth, &[]);
    if written(&measure.corrected, &measure.truth) == truth {
        return truth;
    }
    format!("{truth} ± {}", readable(measure.tolerance, 2))
}

fn numbers(values: &[f64], truth: &[f64]) -> String {
    match values {
        [one] => number(*one, truth == [0.0]),
        many => vector(many),
    }
}

/// Counts in full (`+ 0.0` removes the sign of −0); rounding errors around 0 with one digit.
fn number(value: f64, is_zero: bool) -> String {
    match value.abs() {
        count if count.fract() == 0.0 && count < 1e7 => (value + 0.0).to_string().replace('-', "−"),
        rest if is_zero && rest < ROUNDING => readable(value, 1),
        _ => plain(value),
    }
}
