//! Animations: as a section, as the page of a simulation, and next to the tables of a comparison.

use super::{Outcome, ReportPage, View};
use crate::animation::Animation;
use crate::report::page::{Block, Cell, Page, Player, Table, markup};
use crate::report::recording::Record;
use crate::report::study::animation::{AnimationData, Plan};

/// The explanation of the controls, for the caption.
const HOW: &str = "Arrows are forces on the moving body. Click a curve to jump to that time.";

impl ReportPage {
    /// Adds an animation as a separate section.
    pub fn animation(&mut self, animation: &Animation, caption: &str) {
        self.open("animation", "The motion");
        let caption = format!("{caption} {HOW}");
        self.player(animation, caption);
    }

    /// Adds an animation from a recorded motion.
    pub(super) fn recorded(&mut self, data: &AnimationData, caption: &str) {
        match data.animation() {
            Ok(animation) => self.player(&animation, caption.into()),
            Err(error) => self.text(format!("The animation cannot be shown: {error}.")),
        }
    }

    fn player(&mut self, animation: &Animation, caption: String) {
        let (animation, files) = (animation.drawn(), Vec::new());
        self.add(Block::Player(Box::new(Player { animation, caption, files })));
    }
}

impl View for Plan {
    const TITLE: &'static str = "Animation of a scene";

    fn show(&self, findings: &[AnimationData], document: &mut ReportPage) {
        for data in findings {
            document.recorded(data, &self.caption);
        }
    }

    fn outcome(&self, _: &[AnimationData]) -> Outcome {
        Outcome::undecided()
    }
}

/// The page of one simulation: its animation and its totals; its tables are next to it.
pub fn simulation_page(animation: Animation, record: &Record) -> Page {
    let scene = animation.scene.clone();
    let page = Page {
        title: scene.title.clone(),
        lead: markup::literal(scene.teaches.trim()),
        ..Page::default()
    };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    document.animation(&animation, "The simulated motion over time.");
    if let Some(Block::Player(player)) =
        document.page.sections.iter_mut().flat_map(|section| &mut section.blocks).next()
    {
        player.files = FILES.map(|name| (name.into(), name.into())).into();
    }
    document.open("totals", "Totals");
    for (kind, remark) in record.remarks() {
        document.add(Block::Note(format!("**{kind}**: {}", markup::literal(&remark))));
    }
    document.add(Block::Table(totals(record)));
    document.open("end", "The bodies at the end");
    document.add(Block::Code { language: "text".into(), text: record.states_text() });
    document.page
}

/// The totals; further lines of a value follow its first one.
fn totals(record: &Record) -> Table {
    let row = |(name, value): (&str, String)| {
        let single = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let (first, more) = value.split_once('\n').unwrap_or((&value, ""));
        let more = more.lines().map(single).collect::<Vec<_>>().join("; ");
        vec![Cell::text(name), Cell::text(format!("{first} {more}").trim_end())]
    };
    let rows = record.totals().into_iter().map(row).collect();
    Table::new("The whole run", "", "total | value", rows)
}

/// The files that `simulate` writes next to the page.
const FILES: [&str; 5] =
    ["trajectory.csv", "ledger.csv", "forces.csv", "results.json", "final.toml"];
