//! Writes a document as a page in HTML: formulas are MathML, and the page loads no other files.

use super::Document;
use super::markdown::formula;
use super::unicode::scripted;
use crate::escape::{SIGNS, units};
use crate::page::markup::literal;
use crate::page::{Block, Cell, Column, Page, Section, Table};
use lcplab_lcp::error::Result;

pub(super) fn written(document: &Document) -> Result<String> {
    // A picture before everything else stands above the first section.
    let first = document.sections.first().and_then(|section| section.blocks.first());
    let opening: Vec<Block> = match first {
        Some(picture @ super::Block::Figure(_)) => vec![picture.on_page()],
        _ => Vec::new(),
    };
    let shown = opening.len();
    let section = |(k, section): (usize, &super::Section)| Section {
        id: format!("part-{}", k + 1),
        title: section.title.clone(),
        blocks: section.blocks[if k == 0 { shown } else { 0 }..]
            .iter()
            .map(super::Block::on_page)
            .collect(),
        ..Section::default()
    };
    let page = Page {
        title: document.title.clone(),
        lead: lead(&document.lead),
        opening,
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
            super::Block::Text(words) => Block::Text(typeset(words)),
            super::Block::Formula(own) => Block::Equation { latex: formula(own), label: None },
            super::Block::Table(own) => Block::Table(table(own)),
            super::Block::Figure(own) => Block::Figure(own.clone()),
        }
    }
}

/// The lead as markup, with the finding, its first sentence, in bold if others follow.
///
/// ```
/// use lcplab_page::document::lead;
///
/// assert!(lead("It sinks by 2.5 m. It is 1 m high.").starts_with("**It sinks by 2\\.5 m"));
/// assert!(!lead("It sinks.").contains("**"));
/// ```
pub fn lead(words: &str) -> String {
    match words.split_once(". ") {
        Some((finding, rest)) => {
            format!("**{}** {}", typeset(&format!("{finding}.")), typeset(rest))
        }
        None => typeset(words),
    }
}

/// The words as markup, with the names of variables, such as x, wᵢ and J u⁺, as formulas.
fn typeset(words: &str) -> String {
    let words: Vec<&str> = words.split(' ').collect();
    let units = units(&words);
    let name = |k: usize| words[k].trim_matches(|c| "(),.;:|".contains(c));
    let latex = |k: usize| {
        let begins = k == 0 || words[k - 1].ends_with(['.', ':']);
        let is_article =
            begins && words[k] == "A" && !matches!(words.get(k + 1), Some(&("is" | "=")));
        variable(name(k)).filter(|_| !units[k] && !is_article)
    };
    // A relation belongs to the variable before it.
    let is_taken = |k: usize| SIGNS.contains(&words[k]) && k > 0 && latex(k - 1).is_some();
    let one = |k: usize| match latex(k) {
        Some(latex) => {
            let (before, after) = words[k].split_once(name(k)).unwrap_or_default();
            let sign = words.get(k + 1).filter(|_| is_taken(k + 1)).unwrap_or(&"");
            let space = if sign.is_empty() { "" } else { " " };
            format!("{}${latex}{space}{sign}${}", literal(before), literal(after))
        }
        None => literal(words[k]),
    };
    let kept = (0..words.len()).filter(|k| !is_taken(*k));
    kept.map(one).collect::<Vec<_>>().join(" ")
}

/// The LaTeX of a letter, or of one or two with marks.
fn variable(name: &str) -> Option<String> {
    let (base, index) = name.split_once('_').unwrap_or((name, ""));
    let is_mark = |c: &char| !c.is_alphabetic() || "ᵀᵢⱼₖ".contains(*c);
    let marks = base.chars().filter(is_mark).count() + index.len();
    let letters = base.chars().count() - base.chars().filter(is_mark).count();
    let is_name = letters == 1 || (letters == 2 && marks > 0);
    let is_plain = |c: char| {
        c.is_ascii_alphanumeric()
            || matches!(c, 'Α'..='ω' | '\'')
            || scripted(&c.to_string()).starts_with(['^', '_'])
    };
    if !is_name
        || !name.starts_with(char::is_alphabetic)
        || matches!(name, "a" | "I")
        || !base.chars().chain(index.chars()).all(is_plain)
    {
        return None;
    }
    let base = scripted(base);
    Some(if index.is_empty() { base } else { format!("{base}_{{{index}}}") })
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
