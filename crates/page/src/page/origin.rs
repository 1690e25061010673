//! How what a figure or table shows was obtained.

use serde::{Deserialize, Serialize};

use super::{Block, Section};

/// The way from nothing to a figure or table; what is empty is not shown.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Origin {
    /// The scene or problem.
    pub scene: String,
    /// Solver, scheme and numbers, in words.
    pub settings: String,
    /// What to type to get it again, for example `lcplab simulate stack --steps 100`.
    pub command: String,
}

impl Origin {
    /// What is known: a name and the words.
    pub(super) fn parts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let parts = [("scene", self.scene.as_str()), ("settings", &self.settings)];
        parts.into_iter().filter(|(_, words)| !words.is_empty())
    }
}

impl Section {
    /// Says of every figure, film and table so far that it was obtained in this way, unless it has
    /// an origin of its own.
    ///
    /// ```
    /// use lcplab_page::page::{Block, Origin, Section, Table};
    ///
    /// let mut section = Section { blocks: vec![Block::Table(Table::default())], ..Section::default() };
    /// section.obtained(&Origin { command: "lcplab report verification".into(), ..Origin::default() });
    /// let Block::Table(table) = &section.blocks[0] else { unreachable!() };
    /// assert_eq!(table.origin.as_ref().unwrap().command, "lcplab report verification");
    /// ```
    pub fn obtained(&mut self, origin: &Origin) {
        for block in &mut self.blocks {
            let own = match block {
                Block::Figure(picture) => &mut picture.origin,
                Block::Player(player) => &mut player.origin,
                Block::Table(table) => &mut table.origin,
                _ => continue,
            };
            own.get_or_insert_with(|| origin.clone());
        }
    }
}
