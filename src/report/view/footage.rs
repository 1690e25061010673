//! Animations from recorded motions.

use super::{Document, Outcome, View};
use crate::report::page::{Block, Player};
use crate::report::study::footage::{Footage, Plan};

impl Document {
    /// Adds an animation from a recorded motion.
    pub(super) fn footage(&mut self, footage: &Footage, caption: &str) {
        match footage.film() {
            Ok(film) => {
                let (caption, files) = (caption.into(), Vec::new());
                self.add(Block::Player(Box::new(Player {
                    reel: film.reel(),
                    caption,
                    files,
                    origin: None,
                })));
            }
            Err(error) => self.text(format!("The animation cannot be shown: {error}.")),
        }
    }
}

impl View for Plan {
    const TITLE: &'static str = "Animation of a scene";

    fn show(&self, findings: &[Footage], document: &mut Document) {
        for footage in findings {
            document.footage(footage, &self.caption);
        }
    }

    fn outcome(&self, _: &[Footage]) -> Outcome {
        Outcome::undecided()
    }
}
