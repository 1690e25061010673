//! What a cell can show, and its form in each kind of notebook.

use serde_json::{Value, json};

use super::record::{Output, put_out};
use crate::chapter::exhibit::Exhibit;
use crate::document::{Block, Show};
use crate::error::Result;
use crate::page;

/// Shows a table, a plot, a derivation or an exhibit below the cell.
///
/// # Errors
/// If an exhibit's example cannot be set up.
pub fn show(what: &impl Show) -> Result<()> {
    what.blocks()?.into_iter().map(Output::Block).for_each(put_out);
    Ok(())
}

impl Show for Exhibit {
    fn blocks(&self) -> Result<Vec<Block>> {
        let words = [
            ("Erratum", format!("{}, {}: {}.", self.id, self.place, self.title)),
            ("Printed", self.printed.to_string()),
            ("Correct", self.holds.to_string()),
            ("Why", self.why.to_string()),
        ];
        let words = words.map(|(head, text)| Block::Text(format!("{head}: {text}")));
        let document = self.document()?;
        let evidence = document.sections.into_iter().last().map(|section| section.blocks);
        let evidence = evidence.unwrap_or_default();
        Ok(words.into_iter().chain(evidence).collect())
    }
}

impl Output {
    /// As a block of a page.
    pub(super) fn on_page(&self) -> page::Block {
        match self {
            Output::Lines(lines) => {
                page::Block::Code { language: "text".into(), text: lines.clone() }
            }
            Output::Block(block) => block.on_page(),
        }
    }

    /// As an output of a Jupyter notebook (nbformat 4).
    pub(super) fn in_notebook(&self) -> Value {
        let shown =
            |data: Value| json!({ "output_type": "display_data", "data": data, "metadata": {} });
        match self {
            Output::Lines(lines) => {
                json!({ "output_type": "stream", "name": "stdout", "text": lined(lines) })
            }
            Output::Block(Block::Figure(picture)) => shown(json!({
                "image/svg+xml": lined(&picture.svg),
                "text/plain": lined(&picture.caption),
            })),
            Output::Block(block) => shown(json!({
                "text/markdown": lined(block.markdown().trim()),
                "text/plain": lined(block.text().trim_end()),
            })),
        }
    }

    /// In the form that the evcxr kernel expects on standard output.
    pub(super) fn for_kernel(&self) -> String {
        let (kind, content) = match self {
            Output::Lines(lines) => return lines.clone(),
            Output::Block(Block::Figure(picture)) => ("text/html", picture.svg.clone()),
            Output::Block(block) => ("text/markdown", block.markdown()),
        };
        format!("EVCXR_BEGIN_CONTENT {kind}\n{content}\nEVCXR_END_CONTENT\n")
    }
}

/// A text as a list of its lines, including line ends.
pub(super) fn lined(text: &str) -> Vec<&str> {
    text.split_inclusive('\n').collect()
}
