//! Content that can be part of a document, as blocks.

use lcplab_lcp::error::Result;

use super::{Block, Document, Section, Table};
use crate::figure::Figure;
use crate::page::Picture;

/// Content that can be part of a document.
///
/// ```
/// use lcplab_page::document::{Block, Section, Show};
///
/// let mut section = Section::new("The weight");
/// section.say("19.62 N");
/// let blocks = section.blocks()?;
/// assert_eq!(blocks, [Block::Text("The weight.".into()), Block::Text("19.62 N".into())]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub trait Show {
    /// Its blocks from top to bottom.
    ///
    /// # Errors
    /// If the content has to be computed first and that fails.
    fn blocks(&self) -> Result<Vec<Block>>;
}

impl<F: Figure> Show for F {
    fn blocks(&self) -> Result<Vec<Block>> {
        Ok(vec![Block::Figure(Picture::inline(self))])
    }
}

impl Show for Table {
    fn blocks(&self) -> Result<Vec<Block>> {
        Ok(vec![Block::Table(self.clone())])
    }
}

impl Show for Document {
    fn blocks(&self) -> Result<Vec<Block>> {
        let sections: Result<Vec<_>> = self.sections.iter().map(Show::blocks).collect();
        Ok(sections?.concat())
    }
}

impl Show for Section {
    fn blocks(&self) -> Result<Vec<Block>> {
        let title = Block::Text(format!("{}.", self.title));
        Ok([title].into_iter().chain(self.blocks.iter().cloned()).collect())
    }
}
