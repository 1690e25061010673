//! Scenes as animations.

use super::animation::animation_block;
use super::{Headline, Outcome, ReportPage, View};
use crate::report::page::markup::literal;
use crate::report::page::{Block, Thumbnail};
use crate::report::study::scenes::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Animations of scenes";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        document.add(Block::Thumbnails(findings.iter().map(thumbnail).collect()));
    }

    fn headline(&self, findings: &[Finding]) -> Headline {
        let result = Some(([whole(findings), findings.len()], "scenes run to the end".into()));
        Headline { result, ..Headline::default() }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let (whole, all) = (whole(findings), findings.len());
        Outcome { good: whole == all, says: format!("{whole} of {all} scenes run to the end") }
    }
}

/// The number of scenes without a step that fails.
fn whole(findings: &[Finding]) -> usize {
    let comes_to_its_end = |finding: &&Finding| {
        finding.animation.recordings.iter().all(|recording| recording.ending.is_none())
    };
    findings.iter().filter(comes_to_its_end).count()
}

/// The width and height of a thumbnail in px.
const SIZE: (f64, f64) = (240.0, 170.0);

/// A scene as a small picture that opens its animation.
fn thumbnail(Finding { title, teaches, animation: data }: &Finding) -> Thumbnail {
    let (svg, block) = match data.animation() {
        Ok(animation) => {
            let block = animation_block(animation.drawn(), literal(teaches.trim()));
            (animation.thumbnail(SIZE), block)
        }
        Err(error) => {
            (String::new(), Block::Text(format!("The animation cannot be shown: {error}.")))
        }
    };
    Thumbnail {
        id: format!("scene-{}", data.id),
        name: data.id.clone(),
        title: title.clone(),
        svg,
        block,
    }
}
