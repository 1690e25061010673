//! Animations on separate pages and next to the tables of a comparison.

use super::ReportPage;
use crate::film::Film;
use crate::report::page::{Block, Page, Player, markup};
use crate::report::recording::Record;

/// The explanation of the controls, for the caption.
const HOW: &str = "Arrows are forces on the moving body. Click a curve to jump to that time.";

impl ReportPage {
    /// Adds an animation as a separate section.
    pub fn film(&mut self, film: &Film, caption: &str) {
        self.open("film", "The motion");
        let caption = format!("{caption} {HOW}");
        let (animation, files) = (film.animation(), Vec::new());
        self.add(Block::Player(Box::new(Player { animation, caption, files })));
    }
}

/// The page of one simulation: its animation and its totals; its tables are next to it.
pub fn simulation_page(film: Film, record: &Record) -> Page {
    let scene = film.scene.clone();
    let page = Page {
        title: scene.title.clone(),
        lead: markup::literal(scene.teaches.trim()),
        ..Page::default()
    };
    let mut document = ReportPage { page, figures: Vec::new(), tables: Vec::new() };
    document.film(&film, "The simulated motion over time.");
    if let Some(Block::Player(player)) =
        document.page.sections.iter_mut().flat_map(|section| &mut section.blocks).next()
    {
        player.files = FILES.map(|name| (name.into(), name.into())).into();
    }
    document.open("totals", "Totals");
    document.add(Block::Code { language: "text".into(), text: record.text() });
    document.page
}

/// The files that `simulate` writes next to the page.
const FILES: [&str; 5] =
    ["trajectory.csv", "ledger.csv", "forces.csv", "results.json", "final.toml"];
