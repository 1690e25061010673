//! Writes a document as a page in HTML: formulas are MathML, and the page loads no other files.

use super::Document;
use super::markdown::formula;
use crate::page::markup::literal;
use crate::page::{Block, Cell, Column, Page, Section, Table};
use lcplab_lcp::error::Result;

pub(super) fn written(document: &Document) -> Result<String> {
    let section = |(k, section): (usize, &super::Section)| Section {
        id: format!("part-{}", k + 1),
        title: section.title.clone(),
        blocks: section.blocks.iter().map(super::Block::on_page).collect(),
        ..Section::default()
    };
    let page = Page {
        title: document.title.clone(),
        lead: joined(&document.lead),
        sections: document.sections.iter().enumerate().map(section).collect(),
        facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
        ..Page::default()
    };
    page.render()
}

impl super::Block {
    /// The picture, formula or table as a block of a page.
    pub fn on_page(&self) -> Block {
        match self {
            super::Block::Heading(words) => Block::Text(format!("### {}", literal(words))),
            super::Block::Text(words) => Block::Text(joined(words)),
            super::Block::Formula(own) => Block::Equation { latex: formula(own), label: None },
            super::Block::Table(own) => Block::Table(table(own)),
            super::Block::Figure(own) => Block::Figure(own.clone()),
        }
    }
}

/// The words as markup, with no line break at a relation.
fn joined(words: &str) -> String {
    let relations = ["≥", "≤", "=", ">", "<"].into_iter();
    let words = relations.fold(words.to_string(), |words, sign| {
        words.replace(&format!(" {sign} "), &format!("\u{a0}{sign}\u{a0}"))
    });
    literal(&words)
}

fn table(table: &super::Table) -> Table {
    let column = |(c, title): (usize, &String)| match table.is_numeric(c) {
        true => Column::numbers(literal(title), ""),
        false => Column::words(literal(title)),
    };
    let row = |(k, row): (usize, &Vec<String>)| {
        let bold = |cell: &String| match table.chosen == Some(k) && !cell.is_empty() {
            // The space lets the mark open before a minus sign.
            true => format!(" **{}**", literal(cell)),
            false => String::new(),
        };
        let cell = |cell: &String| Cell { markup: bold(cell), ..Cell::text(cell.as_str()) };
        row.iter().map(cell).collect()
    };
    let left_out = match table.left_out {
        0 => String::new(),
        more => format!("And {more} more lines."),
    };
    Table {
        title: table.title.clone(),
        how_to_read: left_out,
        columns: table.columns.iter().enumerate().map(column).collect(),
        rows: table.rows.iter().enumerate().map(row).collect(),
        keeps_columns: table.keeps_columns,
        ..Table::default()
    }
}
