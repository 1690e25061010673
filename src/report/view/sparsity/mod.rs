//! Patterns of matrices.

mod factor;
mod pattern;

use super::{Outcome, ReportPage, View};
use crate::report::study::sparsity::factor::Factor;
use crate::report::study::sparsity::pattern::Patterns;
use crate::report::study::sparsity::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Sparsity of J, A and its factor";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        let patterns: Vec<&Patterns> = patterns(findings).collect();
        let factors: Vec<&Factor> = factors(findings).collect();
        if !patterns.is_empty() {
            pattern::show(&patterns, &factors, document);
        }
        if !factors.is_empty() {
            factor::show(&factors, document);
        }
    }

    fn outcome(&self, _: &[Finding]) -> Outcome {
        Outcome::undecided()
    }
}

fn patterns(findings: &[Finding]) -> impl Iterator<Item = &Patterns> {
    findings.iter().filter_map(|finding| match finding {
        Finding::Patterns(patterns) => Some(patterns),
        _ => None,
    })
}

fn factors(findings: &[Finding]) -> impl Iterator<Item = &Factor> {
    findings.iter().filter_map(|finding| match finding {
        Finding::Factor(factor) => Some(factor),
        _ => None,
    })
}
