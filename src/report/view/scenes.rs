//! Scenes as animations.

use super::animation::animation_block;
use super::{Headline, Outcome, ReportPage, View};
use crate::number::count;
use crate::report::page::markup::literal;
use crate::report::page::{Block, Thumbnail};
use crate::report::study::scenes::{Finding, Plan};
use crate::report::study::tally::Tally;

impl View for Plan {
    const TITLE: &'static str = "Animations of scenes";

    fn show(&self, findings: &[Finding], document: &mut ReportPage) {
        let left = |Finding { animation, tally, .. }: &Finding| {
            let why = tally.unsolved.as_deref().unwrap_or_default();
            let why = why.split(':').next().unwrap_or_default();
            let [left, all] = [tally.rejected(), tally.solves].map(count);
            (tally.rejected() > 0).then(|| format!("*{}*, {left} of {all} ({why})", animation.id))
        };
        let left: Vec<String> = findings.iter().filter_map(left).collect();
        if !left.is_empty() {
            document.text(format!(
                "Left unanswered, as the texts of the scenes explain: {}.",
                left.join("; ")
            ));
        }
        document.add(Block::Thumbnails(findings.iter().map(thumbnail).collect()));
    }

    fn headline(&self, findings: &[Finding]) -> Headline {
        let sum = |count: fn(&Tally) -> usize| findings.iter().map(|own| count(&own.tally)).sum();
        let label = "problems of these scenes answered, each answer accepted by an independent judge; {left} \
                     left unanswered, as their texts explain";
        let result = Some(([sum(|own| own.accepted), sum(|own| own.solves)], label.into()));
        Headline { result, ..Headline::default() }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let recordings = findings.iter().flat_map(|own| &own.animation.recordings);
        let early = recordings.filter(|own| own.ending.is_some()).count();
        let wrong: usize = findings.iter().map(|own| own.tally.rejected_claims).sum();
        let says =
            format!("{} scenes: {early} end early, {wrong} answers rejected", findings.len());
        Outcome { good: early + wrong == 0, says }
    }
}

/// The width and height of a thumbnail in px.
const SIZE: (f64, f64) = (240.0, 170.0);

/// A scene as a small picture that opens its animation.
fn thumbnail(Finding { title, teaches, animation: data, .. }: &Finding) -> Thumbnail {
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
