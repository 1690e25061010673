//! The glossary: terms, symbols and units, each with the code that computes it. Its source is the
//! page `docs/glossary.md`.

use std::sync::LazyLock;

use crate::document::{Document, Section};

/// A row of the glossary.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Term {
    /// The term.
    pub name: String,
    /// Its symbol; may be empty.
    pub symbol: String,
    /// The unit, or two units: for forces and lengths, and for torques and angles. May be empty.
    pub unit: String,
    /// The definition, one sentence.
    pub means: String,
    /// The chapter's term, if it differs.
    pub chapter: String,
    /// The modules or items that compute it.
    pub code: Vec<String>,
}

/// All terms in alphabetical order.
pub fn terms() -> &'static [Term] {
    static TERMS: LazyLock<Vec<Term>> =
        LazyLock::new(|| table(include_str!("../../docs/glossary.md")));
    &TERMS
}

/// The rows of the table on the page.
fn table(page: &str) -> Vec<Term> {
    let rows = page.lines().filter(|line| line.starts_with("| "));
    // Skips the head and the line below it.
    rows.skip(2).map(|row| term(&cells(row))).collect()
}

fn term(cells: &[String]) -> Term {
    let [name, symbol, unit, means, chapter, code] = cells else {
        panic!("glossary.md: six cells are needed: {cells:?}");
    };
    let code = code.split(", ").map(|place| place.trim_matches('`').to_string());
    Term {
        name: name.clone(),
        symbol: symbol.clone(),
        unit: unit.clone(),
        means: means.clone(),
        chapter: chapter.clone(),
        code: code.filter(|place| !place.is_empty()).collect(),
    }
}

/// The cells of a row of a Markdown table, in which `\|` stands for a vertical bar.
fn cells(row: &str) -> Vec<String> {
    let (bar, mut cells) = ("\u{0}", Vec::new());
    for cell in row.trim_matches('|').replace("\\|", bar).split('|') {
        cells.push(cell.trim().replace(bar, "|"));
    }
    cells
}

/// The glossary.
pub fn document() -> Document {
    let mut document = Document {
        title: "Glossary".into(),
        lead: "Terms and symbols, their units, and the code that computes them.".into(),
        is_accepted: true,
        ..Document::default()
    };
    for term in terms() {
        let mut section = Section::new(&term.name);
        let facts = [("Symbol", &term.symbol), ("Unit", &term.unit), ("K&M", &term.chapter)];
        let facts = facts.into_iter().filter(|(_, fact)| !fact.is_empty());
        let facts: Vec<String> = facts.map(|(name, fact)| format!("{name}: {fact}.")).collect();
        section.say(&term.means);
        if !facts.is_empty() {
            section.say(facts.join(" "));
        }
        if !term.code.is_empty() {
            section.say(format!("In the library: {}.", term.code.join(", ")));
        }
        document.add("", section);
    }
    document
}
