//! Scenes as films.

use super::{Document, View};
use crate::report::page::markup::literal;
use crate::report::study::scenes::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Scenes";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        for Finding { title, teaches, footage } in findings {
            document.text(format!("**{}**: {}", literal(&footage.id), literal(title)));
            document.footage(footage, &literal(teaches.trim()));
        }
    }
}
