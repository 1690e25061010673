//! A notebook that ran as a page.

use super::source::{Part, Shown, Source};
use super::{Program, Record, quoted};
use crate::error::Result;
use crate::live::PAGES;
use crate::report::page::{Block, Live, Page, Section};

impl Program {
    /// The page with prose, cells and what they put out; nothing on it is fetched.
    ///
    /// # Errors
    /// If the prose quotes a value that no cell has put.
    pub fn page(&self, record: &Record) -> Result<Page> {
        let source = Source::read(self.text);
        let mut page = Page {
            title: self.title(),
            facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
            ..Page::default()
        };
        let mut outputs = record.cells.iter();
        for part in &source.parts {
            match part {
                Part::Prose(text) => {
                    // Notebooks stand beside the folder of live pages, pages have it in their own.
                    let text = quoted(text, record)?;
                    add_prose(&mut page, &text.replace("](../live/", "](live/"));
                    for live in lives(&text) {
                        add(&mut page, Block::Live(live));
                    }
                }
                Part::Cell { code, shown } => {
                    let (language, text) = ("rust".into(), code.clone());
                    match shown {
                        Shown::Open => add(&mut page, Block::Code { language, text }),
                        Shown::Folded => add(&mut page, Block::FoldedCode { language, text }),
                        Shown::Hidden => {}
                    }
                    for output in outputs.next().into_iter().flatten() {
                        add(&mut page, output.on_page());
                    }
                }
            }
        }
        Ok(page)
    }
}

/// The live pages to which prose links: `[a stack](../live/stack.html#solver=pgs)`.
fn lives(text: &str) -> Vec<Live> {
    let links = text.split("](../live/").skip(1).map(|after| after.split(')').next().unwrap_or(""));
    let live = |link: &str| {
        let (file, state) = link.split_once('#').unwrap_or((link, ""));
        let page = PAGES.iter().find(|page| file.strip_suffix(".html") == Some(page.name))?;
        let title = format!("Open it here: {}", page.about);
        Some(Live { name: page.name.into(), title, html: page.text(), state: state.into() })
    };
    links.filter_map(live).collect()
}

/// Prose begins a section at each of its headings of the second level.
fn add_prose(page: &mut Page, text: &str) {
    let mut pieces =
        format!("\n{text}").split("\n## ").map(String::from).collect::<Vec<_>>().into_iter();
    let before = pieces.next().unwrap_or_default();
    match before.trim() {
        "" => (),
        lead if page.sections.is_empty() && page.lead.is_empty() => page.lead = lead.into(),
        words => add(page, Block::Text(words.into())),
    }
    for piece in pieces {
        let (title, body) = piece.split_once('\n').unwrap_or((&piece, ""));
        let id = format!("part-{}", page.sections.len() + 1);
        page.sections.push(Section { id, title: title.trim().into(), blocks: Vec::new() });
        if !body.trim().is_empty() {
            add(page, Block::Text(body.trim().into()));
        }
    }
}

/// Adds to the last section; what comes before the first one starts one of its own.
fn add(page: &mut Page, block: Block) {
    if page.sections.is_empty() {
        let title = "Beginning".into();
        page.sections.push(Section { id: "part-1".into(), title, blocks: Vec::new() });
    }
    let last = page.sections.len() - 1;
    page.sections[last].blocks.push(block);
}
