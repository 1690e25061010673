//! Animations from recorded motions.

use super::{Outcome, ReportPage, View};
use crate::report::page::{Block, Player};
use crate::report::study::film::{FilmData, Plan};

impl ReportPage {
    /// Adds an animation from a recorded motion.
    pub(super) fn recorded(&mut self, data: &FilmData, caption: &str) {
        match data.film() {
            Ok(film) => {
                let (caption, files) = (caption.into(), Vec::new());
                let animation = film.animation();
                self.add(Block::Player(Box::new(Player { animation, caption, files })));
            }
            Err(error) => self.text(format!("The animation cannot be shown: {error}.")),
        }
    }
}

impl View for Plan {
    const TITLE: &'static str = "Animation of a scene";

    fn show(&self, findings: &[FilmData], document: &mut ReportPage) {
        for data in findings {
            document.recorded(data, &self.caption);
        }
    }

    fn outcome(&self, _: &[FilmData]) -> Outcome {
        Outcome::undecided()
    }
}
