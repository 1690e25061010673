//! The top of a page: what each study adds to it, and how that is put together.

use super::{FILES, ReportPage};
use crate::number::count;
use crate::plot::Figure;
use crate::report::page::{Block, Picture, Table, Tile};

/// What a study adds to the top of the page.
#[derive(Default)]
pub struct Headline {
    /// The answer to the study's question, in one or two sentences.
    pub answer: Option<String>,
    /// The main figure, if it has one.
    pub figure: Option<Box<dyn Figure>>,
    /// A table below the figure, with the name of its file.
    pub table: Option<(String, Table)>,
    /// The number of its checks that succeed, the number of all, and what they check, in which
    /// `{left}` becomes the number of the others.
    pub result: Option<([usize; 2], String)>,
}

impl Headline {
    /// An answer alone.
    pub(super) fn of(answer: Option<String>) -> Self {
        Headline { answer, ..Headline::default() }
    }
}

/// The top of the page: the first answer, the results of the checks, the main figures and tables,
/// and then the lead of the report.
#[derive(Default)]
pub(super) struct Top {
    answer: Option<String>,
    figures: Vec<Box<dyn Figure>>,
    tables: Vec<(String, Table)>,
    results: Vec<([usize; 2], Tile)>,
}

impl Top {
    /// Adds a section's part; returns its answer, figure and table for the section itself if an
    /// earlier section has given an answer. Results of the same checks are added up.
    pub fn add(&mut self, headline: Headline, section: &str, good: bool) -> Headline {
        if let Some((counts, label)) = headline.result {
            match self.results.iter_mut().find(|(_, tile)| tile.label == label) {
                Some((sums, tile)) => {
                    *sums = [sums[0] + counts[0], sums[1] + counts[1]];
                    tile.good &= good;
                }
                None => {
                    let tile = Tile { label, section: section.into(), good, ..Tile::default() };
                    self.results.push((counts, tile));
                }
            }
        }
        if self.answer.is_some() {
            return Headline { result: None, ..headline };
        }
        self.tables.extend(headline.table);
        self.answer = headline.answer;
        self.figures.extend(headline.figure);
        Headline::default()
    }

    /// Fills the top of the page; the tile of a section that is not shown leads to the summary.
    pub fn put(self, lead: &str, summary: Option<&str>, document: &mut ReportPage) {
        let is_shown =
            |tile: &Tile| document.page.sections.iter().any(|own| own.id == tile.section);
        let tile = |([some, all], tile): ([usize; 2], Tile)| {
            let section = summary.filter(|_| !is_shown(&tile)).unwrap_or(&tile.section).into();
            let label = tile.label.replace("{left}", &count(all - some));
            Tile { label, value: format!("{} of {}", count(some), count(all)), section, ..tile }
        };
        let tiles: Vec<Tile> = self.results.into_iter().map(tile).collect();
        let lead = Some(lead.trim().to_string()).filter(|lead| !lead.is_empty());
        let mut texts = self.answer.into_iter().chain(lead);
        document.page.lead = texts.next().unwrap_or_default();
        let opening = &mut document.page.opening;
        if !tiles.is_empty() {
            opening.push(Block::Tiles(tiles));
        }
        for figure in self.figures {
            opening.push(Block::Figure(Picture::of(&*figure, FILES)));
            document.figures.push(figure);
        }
        for (id, table) in self.tables {
            let block = document.filed(&id, table);
            document.page.opening.push(block);
        }
        document.page.opening.extend(texts.map(Block::Text));
    }
}
