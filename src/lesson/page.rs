//! Writes a notebook and its output as a page.

use super::record::Output;
use super::source::{Part, Shown, Source};
use super::{Program, Record, quoted, twin};
use crate::error::{Error, Result};
use crate::live::linked;
use crate::report::page::{Block, Fold, Page, Section};

/// The beginnings of the titles of sections that a lesson does not need: they are collapsed.
const ASIDES: [&str; 2] = ["Going further", "For readers of the chapter"];

impl Program {
    /// The page with prose, cells and their output; it loads nothing else.
    ///
    /// # Errors
    /// If the prose quotes a value that no cell has put, or shows a drawing that does not exist.
    pub fn page(&self, record: &Record) -> Result<Page> {
        let source = Source::read(self.text);
        let mut page = Page {
            title: self.title(),
            facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
            ..Page::default()
        };
        let mut outputs = record.cells.iter();
        for (k, part) in source.parts.iter().enumerate() {
            match part {
                Part::Prose(text) => self.add_prose(&mut page, &quoted(self, text, record)?)?,
                // It is shown with its cell.
                Part::Python { is_twin: true, .. } => {}
                Part::Python { code, output, .. } => {
                    let (code, output) = (twin::shown(code), output.clone());
                    add(&mut page, Block::Python { code, output });
                }
                Part::Cell { code, shown } => {
                    let own = outputs.next().map(Vec::as_slice).unwrap_or_default();
                    let twin = match source.parts.get(k + 1) {
                        Some(Part::Python { code, output, is_twin: true }) => {
                            Some(printed(code, output))
                        }
                        _ => None,
                    };
                    add_cell(&mut page, code, *shown, own, twin);
                }
            }
        }
        for section in &mut page.sections {
            if ASIDES.iter().any(|aside| section.title.starts_with(aside)) {
                section.fold = Fold::After(0);
            }
        }
        // Below the lists of errata, sections show those that lead to a wrong result first.
        let lists = self.text.matches(" errata}}").count();
        for section in page.sections.iter_mut().skip(lists).filter(|_| lists > 0) {
            section.blocks.sort_by_key(|block| !is_wrong(block));
            section.fold = Fold::After(section.blocks.iter().filter(|own| is_wrong(own)).count());
        }
        Ok(page)
    }

    /// Adds prose, with a section at each heading of the second level. Drawings and live pages
    /// follow the paragraphs that show them.
    fn add_prose(&self, page: &mut Page, text: &str) -> Result<()> {
        let mut pieces =
            format!("\n{text}").split("\n## ").map(String::from).collect::<Vec<_>>().into_iter();
        let before = pieces.next().unwrap_or_default();
        match before.trim() {
            "" => (),
            lead if page.sections.is_empty() && page.lead.is_empty() => page.lead = on_page(lead),
            words => self.add_words(page, words)?,
        }
        for piece in pieces {
            let (title, body) = piece.split_once('\n').unwrap_or((&piece, ""));
            let id = format!("part-{}", page.sections.len() + 1);
            page.sections.push(Section { id, title: title.trim().into(), ..Section::default() });
            self.add_words(page, body.trim())?;
        }
        Ok(())
    }

    fn add_words(&self, page: &mut Page, words: &str) -> Result<()> {
        let mut paragraphs = String::new();
        for line in words.lines() {
            let Some((alt, name)) = drawing(line) else {
                paragraphs += line;
                paragraphs.push('\n');
                continue;
            };
            self.add_paragraphs(page, &std::mem::take(&mut paragraphs));
            let found = self.drawings.iter().find(|own| own.0 == name);
            let (_, svg) = found.ok_or_else(|| {
                Error::invalid(self.name, name, "notebooks/drawings has no such file")
            })?;
            add(page, Block::Drawing { svg: (*svg).into(), alt: alt.into() });
        }
        self.add_paragraphs(page, &paragraphs);
        Ok(())
    }

    /// Adds paragraphs, and in a lesson the live pages to which they link; elsewhere the links
    /// suffice.
    fn add_paragraphs(&self, page: &mut Page, text: &str) {
        if let Some((before, block, after)) = numbered(text).or_else(|| note(text)) {
            self.add_paragraphs(page, before);
            add(page, block);
            return self.add_paragraphs(page, after);
        }
        if text.trim().is_empty() {
            return;
        }
        let text = on_page(text.trim());
        let lives = if self.number() > 0 { linked(&text) } else { Vec::new() };
        add(page, Block::Text(text));
        lives.into_iter().for_each(|live| add(page, Block::Live(live)));
    }
}

/// The first equation with a number in a line of its own above it, `**K&M (4)**`, and the text
/// before and after it.
fn numbered(text: &str) -> Option<(&str, Block, &str)> {
    text.match_indices("**K&M ").find_map(|(at, _)| {
        let (number, rest) = text[at..].strip_prefix("**")?.split_once("**")?;
        let (latex, after) = rest.trim_start().strip_prefix("$$")?.split_once("$$")?;
        let label = Some(number.replace(['(', ')'], ""));
        let equation = Block::Equation { latex: latex.trim().into(), label };
        Some((&text[..at], equation, after))
    })
}

/// The first note of an erratum, which is a line, and the text before and after it.
fn note(text: &str) -> Option<(&str, Block, &str)> {
    let (before, rest) = text.split_at(text.find("> **E")?);
    let (note, after) = rest.split_once('\n').unwrap_or((rest, ""));
    Some((before, Block::Text(note.into()), after))
}

/// Whether a block is the note of an erratum that leads to a wrong result.
fn is_wrong(block: &Block) -> bool {
    matches!(block, Block::Text(text) if text.starts_with("> **E") && text.contains(", wrong. *"))
}

/// The text and the file of a line that is a drawing: `![words](drawings/name.svg)`.
fn drawing(line: &str) -> Option<(&str, &str)> {
    line.strip_prefix("![")?.strip_suffix(')')?.split_once("](drawings/")
}

/// Converts links: notebooks are next to the folder of live pages and link to each other; pages
/// have it in their own folder and other extensions.
pub(super) fn on_page(text: &str) -> String {
    text.replace("](../live/", "](live/")
        .replace("](README.md)", "](index.html)")
        .replace(".md)", ".html)")
}

/// A Python cell and its output.
fn printed(code: &str, output: &str) -> Vec<(String, String)> {
    let mut pieces = vec![("python".to_string(), twin::shown(code))];
    if !output.is_empty() {
        pieces.push(("text".into(), output.into()));
    }
    pieces
}

/// Adds a Rust cell with its output. If it has a Python equivalent, its printed output is shown
/// with its code; otherwise its code is collapsed, because the lesson uses Python.
fn add_cell(
    page: &mut Page,
    code: &str,
    shown: Shown,
    outputs: &[Output],
    twin: Option<Vec<(String, String)>>,
) {
    let (language, text) = ("rust".to_string(), code.to_string());
    let mut rust = vec![(language.clone(), text.clone())];
    let mut rest = Vec::new();
    for output in outputs {
        match output {
            Output::Lines(lines) if twin.is_some() => rust.push(("text".into(), lines.clone())),
            output => rest.push(output.on_page()),
        }
    }
    match (shown, twin) {
        (_, Some(python)) => add(page, Block::Twin { python, rust }),
        (Shown::Open | Shown::Folded, None) => add(page, Block::FoldedCode { language, text }),
        (Shown::Hidden, None) => {}
    }
    rest.into_iter().for_each(|block| add(page, block));
}

/// Adds a block to the last section, or before the first one.
fn add(page: &mut Page, block: Block) {
    match page.sections.last_mut() {
        Some(section) => section.blocks.push(block),
        None => page.opening.push(block),
    }
}
