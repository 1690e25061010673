//! The diagnosis of a user's own problems.

use super::diagnosis::convergence;
use super::{Headline, Outcome, ReportPage, View};
use crate::number::counted;
use crate::report::page::markup::literal;
use crate::report::study::frames::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Remaining error and its causes";

    fn show(&self, found: &[Finding], document: &mut ReportPage) {
        for Finding { words, error_histories, .. } in found {
            if !error_histories.is_empty() {
                document.figure(convergence(error_histories));
            }
            for section in &words.sections {
                document.text(format!("**{}.**", literal(&section.title)));
                section.blocks.iter().for_each(|block| document.add(block.on_page()));
            }
        }
    }

    fn headline(&self, found: &[Finding]) -> Headline {
        let (solver, limit) = (&self.solver, counted(self.max_iterations, "iteration"));
        Headline::of(found.first().map(|Finding { words, .. }| {
            let answer = literal(words.lead.trim());
            format!("**What error does {solver} leave after {limit}?** {answer}")
        }))
    }

    fn outcome(&self, found: &[Finding]) -> Outcome {
        let says = found.iter().map(|found| found.words.lead.trim());
        let good = found.iter().all(|found| found.is_good);
        Outcome { good, says: says.collect::<Vec<_>>().join(" ") }
    }
}
