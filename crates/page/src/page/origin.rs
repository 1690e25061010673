//! The origin of a figure or table: how it was computed.

use serde::{Deserialize, Serialize};

use super::{Block, Section};

/// The origin of a figure or table; empty fields are not shown.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct Origin {
    /// The scene or problem.
    pub scene: String,
    /// Solver, scheme and parameters, as text.
    pub settings: String,
    /// The command that computes it again, for example `lcplab simulate stack --steps 100`.
    pub command: String,
}

impl Origin {
    /// The fields that are set: their names and texts.
    pub(super) fn parts(&self) -> impl Iterator<Item = (&'static str, &str)> {
        let parts = [("scene", self.scene.as_str()), ("settings", &self.settings)];
        parts.into_iter().filter(|(_, words)| !words.is_empty())
    }
}

impl Section {
    /// Sets the origin of every figure, animation and table so far that has none of its own.
    ///
    /// ```
    /// use lcplab_page::page::{Block, Origin, Section, Table};
    ///
    /// let blocks = vec![Block::Table(Table::default())];
    /// let mut section = Section { blocks, ..Section::default() };
    /// let command = "lcplab report verification".to_string();
    /// section.obtained(&Origin { command, ..Origin::default() });
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
