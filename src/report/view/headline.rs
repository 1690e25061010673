//! The top of a page: what each study adds to it, and how that is put together.

use super::{Document, FILES};
use crate::plot::Figure;
use crate::report::page::{Block, Picture, Tile};

/// What a study adds to the top of the page.
#[derive(Default)]
pub struct Headline {
    /// The answer to the study's question, in one or two sentences.
    pub answer: Option<String>,
    /// The main figure, if it has one.
    pub figure: Option<Box<dyn Figure>>,
    /// The result of its checks, as a number and what it counts.
    pub result: Option<[String; 2]>,
}

impl Headline {
    /// An answer alone.
    pub(super) fn of(answer: Option<String>) -> Self {
        Headline { answer, ..Headline::default() }
    }
}

/// The top of the page: the first answer, the main figures, the results of the checks, and then the
/// other answers.
#[derive(Default)]
pub(super) struct Top {
    answers: Vec<String>,
    figures: Vec<Box<dyn Figure>>,
    tiles: Vec<Tile>,
}

impl Top {
    pub fn add(&mut self, headline: Headline, section: &str, good: bool) {
        self.answers.extend(headline.answer);
        self.figures.extend(headline.figure);
        let tile =
            |[value, label]: [String; 2]| Tile { value, label, section: section.into(), good };
        self.tiles.extend(headline.result.map(tile));
    }

    pub fn put(self, lead: &str, document: &mut Document) {
        let lead = Some(lead.trim().to_string()).filter(|lead| !lead.is_empty());
        let mut texts = self.answers.into_iter().chain(lead);
        document.page.lead = texts.next().unwrap_or_default();
        for figure in self.figures {
            document.page.opening.push(Block::Figure(Picture::of(&*figure, FILES)));
            document.figures.push(figure);
        }
        if !self.tiles.is_empty() {
            document.page.opening.push(Block::Tiles(self.tiles));
        }
        document.page.opening.extend(texts.map(Block::Text));
    }
}
