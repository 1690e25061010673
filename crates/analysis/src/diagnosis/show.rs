//! A diagnosis as a document, and as JSON.

use serde_json::{Value, json};

use super::{Cause, Diagnosis, Proof};
use lcplab_judge::regularity::Regularity;
use lcplab_page::document::notation::indexed;
use lcplab_page::document::{Document, SHOWN, Section};
use lcplab_page::number::{count, readable};

/// Significant digits of the factors in a sum.
const DIGITS: usize = 3;

impl Diagnosis {
    /// The diagnosis as a document for a terminal or a page.
    pub fn document(&self) -> Document {
        let mut document = Document {
            title: format!("Diagnosis of {}", self.subject),
            lead: self.summary(),
            sections: Vec::new(),
            is_accepted: self.is_sound(),
        };
        if let Some(found) = &self.regularity {
            document.add("", self.counts(found));
        }
        if !self.causes.is_empty() {
            document.add("", self.findings());
        }
        if let Some(found) = self.regularity.as_ref().filter(|found| !found.dependencies.is_empty())
        {
            document.add("", self.dependencies(found));
        }
        document
    }

    /// The same as JSON: counts are `null` if there are no rows; degrees of freedom also for a
    /// problem.
    pub fn to_json(&self) -> Value {
        let cause = |cause: &Cause| {
            let mut object = json!({
                "name": cause.name(), "is_fatal": cause.is_fatal(), "rows": cause.rows(),
                "message": cause.to_string(),
            });
            if let Cause::Impossible { proof, .. } = cause {
                object["is_proved"] = json!(*proof != Proof::Rounding);
            }
            object
        };
        let degrees_of_freedom = self.degrees_of_freedom.map(|degrees_of_freedom| {
            json!({
                "components": degrees_of_freedom.components, "rows": degrees_of_freedom.rows, "rank": degrees_of_freedom.rank,
                "left": degrees_of_freedom.left(),
            })
        });
        let found = self.regularity.as_ref();
        json!({
            "subject": self.subject,
            "is_sound": self.is_sound(),
            "unique": if self.is_unique { json!(true) } else { Value::Null },
            "rows": self.labels,
            "rank": found.map(|found| found.rank),
            "condition": found.map(|found| found.condition),
            "dependencies": found.map(|found| &found.dependencies),
            "degrees_of_freedom": degrees_of_freedom,
            "causes": self.causes.iter().map(cause).collect::<Vec<_>>(),
        })
    }

    fn summary(&self) -> String {
        let words = match self.causes.as_slice() {
            [] if self.is_unique => {
                "The problem is well posed: the rows are independent and the answer is unique."
            }
            [] => "Nothing was found that prevents a solution; whether it is unique is not known.",
            _ if self.is_sound() => {
                "Nothing was found that prevents a solution. The remarks below state what makes the problem hard for a solver."
            }
            _ => "The problem cannot be solved in this form.",
        };
        words.to_string()
    }

    fn counts(&self, found: &Regularity) -> Section {
        let mut section = Section::new(match self.degrees_of_freedom {
            Some(_) => "rank and degrees of freedom",
            None => "rank and condition",
        });
        let mut rows = vec![
            ["rows of A".to_string(), count(self.labels.len())],
            ["rank of A, up to rounding".into(), count(found.rank)],
            [
                "condition number of A, scaled to unit diagonal, without zero eigenvalues".into(),
                readable(found.condition, DIGITS),
            ],
        ];
        if let Some(degrees_of_freedom) = &self.degrees_of_freedom {
            rows.extend([
                [
                    "velocity components of moving bodies".into(),
                    count(degrees_of_freedom.components),
                ],
                ["rows of rigid equations".into(), count(degrees_of_freedom.rows)],
                ["rank of the rigid equations".into(), count(degrees_of_freedom.rank)],
                ["remaining degrees of freedom".into(), count(degrees_of_freedom.left())],
            ]);
        }
        section.table("counts", &["quantity", "number"], rows.into_iter().map(Vec::from).collect());
        section
    }

    fn findings(&self) -> Section {
        let mut section = Section::new(if self.is_sound() { "remarks" } else { "causes" });
        for cause in &self.causes {
            section.say(format!("{}: {cause}", cause.name()));
        }
        section
    }

    fn dependencies(&self, found: &Regularity) -> Section {
        let mut section = Section::new("dependent rows");
        section.say(if self.is_symmetric {
            "Up to rounding, these linear combinations of w = A x + b do not depend on the forces. Along \
             each one, forces can be shifted between the rows within their bounds without changing the \
             motion."
        } else {
            "Up to rounding, these linear combinations of w = A x + b do not depend on the forces."
        });
        let lines = found.dependencies.iter().map(|d| vec![combination(d)]).collect();
        section.table("combinations of w that do not depend on x", &["combination of rows"], lines);
        section
    }
}

/// d as a sum: `w₀ − 2 w₃`.
fn combination(d: &[f64]) -> String {
    let entries: Vec<usize> = (0..d.len()).filter(|&i| d[i] != 0.0).collect();
    let mut sum = String::new();
    for (k, &i) in entries.iter().take(SHOWN).enumerate() {
        let sign = match (k, d[i] < 0.0) {
            (0, false) => "",
            (0, true) => "−",
            (_, false) => " + ",
            (_, true) => " − ",
        };
        let factor = match readable(d[i].abs(), DIGITS) {
            one if one == "1" => String::new(),
            other => other + " ",
        };
        sum += &format!("{sign}{factor}{}", indexed("w", i));
    }
    if entries.len() > SHOWN {
        sum += &format!(" … and {} more", entries.len() - SHOWN);
    }
    sum
}
