//! Renders a page as HTML. Reports all errors in it at once, with their places.

use askama::Template;
use sha2::{Digest, Sha256};

use super::code::code;
use super::markup::{Renderer, unescaped};
use super::player::{self, Player};
use super::{
    Align, Block, Cell, Column, Live, Mark, Page, Picture, Proof, Section, Table, Thumbnail, Tile,
};
use crate::escape::{html, with_bound_units};
use lcplab_lcp::disk;
use lcplab_lcp::error::{Defects, Error, Result};

const FONT: &[u8] = include_bytes!("../assets/lcplab-math.woff2");

/// A cell with more characters than this is wrapped.
const LONG: usize = 28;
/// A cell with more characters than this takes two columns of a card on a phone.
const MIDDLE: usize = 15;

/// A table with more rows than this scrolls in its own frame under a fixed header.
const TALL: usize = 40;

/// Of a table with more rows than this only the marked ones are printed.
const UNPRINTED: usize = 100;

/// A table with more columns than this is set smaller,
const WIDE: usize = 9;
/// and one with more than this as small as is readable.
const WIDEST: usize = 11;

/// The width of the text on a phone, of a letter of a table, of the space between its columns, and
/// of a cell that wraps, in px.
const PHONE: f64 = 358.0;
const LETTER: f64 = 7.3;
const BETWEEN: f64 = 17.6;
const LONGEST: f64 = 224.0;
/// A wider table of numbers, in widths of a phone, has a list for each row there.
const PHONES: f64 = 1.35;

#[derive(Template)]
#[template(path = "page.html")]
struct Html<'a> {
    page: &'a Page,
    lead: String,
    opening: Vec<String>,
    /// Each section, and its blocks as HTML.
    sections: Vec<(&'a Section, Vec<String>)>,
    font: String,
    style: [&'static str; 4],
    dark: &'static str,
    script: String,
    /// The hash of the script; the browser runs no other script, except those of live pages.
    sha256: String,
    /// Each live page once: its name and its HTML as JSON.
    lives: Vec<(String, String)>,
    /// The hashes of the live pages' scripts.
    hashes: Vec<&'a str>,
}

#[derive(Template)]
#[template(path = "figure.html")]
struct FigureView<'a> {
    number: usize,
    figure: &'a Picture,
    caption: String,
}

impl FigureView<'_> {
    /// Whether it takes both columns of a printed sheet.
    fn is_broad(&self) -> bool {
        self.figure.narrow.is_none() || self.figure.svg.contains(" class=\"broad\"")
    }
}

/// What the blocks contain after this number of figures and of tables: text, and their numbers.
fn contents<'a>(
    blocks: impl Iterator<Item = &'a Block> + Clone,
    (figures, tables): (usize, usize),
) -> String {
    let numbered = |is: fn(&&Block) -> bool, name: &str, before: usize| {
        let (first, last) = (before + 1, before + blocks.clone().filter(is).count());
        match last - before {
            0 => None,
            1 => Some(format!("{name} {first}")),
            2 => Some(format!("{name}s {first} and {last}")),
            _ => Some(format!("{name}s {first} to {last}")),
        }
    };
    let has_text = blocks.clone().any(|block| matches!(block, Block::Text(_)));
    let parts = [
        has_text.then(|| "text".to_string()),
        numbered(|own| matches!(own, Block::Figure(_) | Block::Player(_)), "Figure", figures),
        numbered(|own| matches!(own, Block::Table(_)), "Table", tables),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    match &parts[..] {
        [] => "this part".into(),
        [one] => one.clone(),
        [first @ .., last] => format!("{} and {last}", first.join(", ")),
    }
}

/// The proof checker, the same file that runs in Node.js.
const CHECKER: &str = include_str!("lcpcheck.js");

#[derive(Template)]
#[template(path = "proof.html")]
struct ProofView<'a> {
    problem: String,
    proof: &'a Proof,
}

/// The start of a pair of programs, with the buttons that select one.
const SWITCH: &str = "<div class=\"twin\"><div class=\"switch\" role=\"group\" aria-label=\"Language\">\
    <button type=\"button\" data-language=\"python\" aria-pressed=\"true\">Python</button>\
    <button type=\"button\" data-language=\"rust\" aria-pressed=\"false\">Rust</button></div>\n";

/// JSON without `<`, so that it cannot close a script element.
fn data(json: &str) -> String {
    json.trim_end().replace('<', "\\u003c")
}

/// A text as JSON that cannot close a script element.
fn quoted(text: &str) -> String {
    data(&serde_json::Value::from(text).to_string())
}

/// The hash of the script that a page allows, with its quotation marks.
fn script_hash(page: &str) -> Option<&str> {
    let (_, after) = page.split_once("script-src ")?;
    after.split([' ', ';']).find(|word| word.starts_with("'sha256-"))
}

#[derive(Template)]
#[template(path = "table.html")]
struct TableView<'a> {
    number: usize,
    table: &'a Table,
    how_to_read: String,
    /// Each column with its title as HTML.
    columns: Vec<(&'a Column, String)>,
    /// Each cell with its content as HTML.
    rows: Vec<Vec<(&'a Cell, String)>>,
}

impl Page {
    /// Whether it is printed in two columns: it has figures that fit them, and neither programs,
    /// whose lines need the width of a sheet, nor a derivation, which is read from top to bottom.
    fn has_columns(&self) -> bool {
        let any = |is: fn(&Block) -> bool| self.sections.iter().flat_map(|s| &s.blocks).any(is);
        any(|block| matches!(block, Block::Figure(picture) if picture.narrow.is_some()))
            && !any(|block| {
                use Block::{Code, Equation, Proof, Python, Twin};
                let is_derived = matches!(block, Equation { label: None, .. });
                is_derived || matches!(block, Code { .. } | Proof(_) | Python { .. } | Twin { .. })
            })
    }

    /// The page as one HTML document.
    ///
    /// # Errors
    /// Lists every invalid equation and markup, every row with too many or too few cells, and every
    /// section with an invalid or duplicate id.
    pub fn render(&self) -> Result<String> {
        let mut writer = Writer::default();
        let lead = writer.checked("lead", |markup| markup.blocks(&self.lead));
        let opening = self.opening.iter().map(|block| writer.block("opening", block)).collect();
        let sections = self.sections.iter().enumerate();
        let sections = sections.map(|(k, section)| (section, writer.section(k, section))).collect();
        let only = |used, part: &'static str| if used { part } else { "" };
        let (plots, plays, proofs) = (writer.plots, writer.plays, writer.proofs);
        let hashes = writer.lives.iter().filter_map(|live| script_hash(&live.html)).collect();
        let lives: Vec<_> =
            writer.lives.iter().map(|live| (live.name.clone(), quoted(&live.html))).collect();
        let defects = self.ids_checked(std::mem::take(&mut writer.defects));
        defects.into_result(format!("page {:?}", self.title))?;
        let script = [
            include_str!("page.js"),
            only(plots, include_str!("plot.js")),
            only(plays, include_str!("player.js")),
            only(proofs, CHECKER),
            only(proofs, include_str!("proof.js")),
            only(!lives.is_empty(), include_str!("live.js")),
            only(self.runs_python, include_str!("python.js")),
        ];
        let script = format!("\n{}", script.concat());
        finished(&Html {
            page: self,
            lead,
            opening,
            sections,
            font: base64(FONT),
            style: [
                include_str!("page.css"),
                only(self.runs_python, include_str!("python.css")),
                only(plots, include_str!("plot.css")),
                only(plays, include_str!("player.css")),
            ],
            dark: include_str!("dark.css"),
            sha256: base64(&Sha256::digest(&script)),
            script,
            lives,
            hashes,
        })
    }

    fn ids_checked(&self, mut defects: Defects) -> Defects {
        for (k, section) in self.sections.iter().enumerate() {
            let id = section.id.as_str();
            if !disk::is_name(id) {
                defects.add(format!("section {}", k + 1), format!("{id:?} cannot be an anchor"));
            }
            if let Some(first) = self.sections[..k].iter().position(|other| other.id == id) {
                let reason = format!("its id {id:?} is that of section {}", first + 1);
                defects.add(format!("section {}", k + 1), reason);
            }
        }
        defects
    }
}

/// Writes blocks, counts figures and tables, collects errors.
#[derive(Default)]
struct Writer {
    markup: Renderer,
    defects: Defects,
    figures: usize,
    /// Whether there is a figure, an animation, and a proof.
    plots: bool,
    plays: bool,
    proofs: bool,
    tables: usize,
    /// The live pages, each once.
    lives: Vec<Live>,
}

impl Writer {
    fn section(&mut self, k: usize, section: &Section) -> Vec<String> {
        let blocks = section.blocks.iter().enumerate();
        let place = |i: usize| format!("section {} {:?}, block {}", k + 1, section.title, i + 1);
        let (folded, open): (Vec<_>, Vec<_>) =
            blocks.partition(|(i, _)| section.fold.takes(*i, &section.blocks));
        let mut shown: Vec<String> =
            open.into_iter().map(|(i, block)| self.block(&place(i), block)).collect();
        if !folded.is_empty() {
            let before = (self.figures, self.tables);
            let what = contents(folded.iter().map(|(_, block)| *block), before);
            shown.push(format!("<details class=\"part\"><summary>Show {what}</summary>\n"));
            shown.extend(folded.into_iter().map(|(i, block)| self.block(&place(i), block)));
            shown.push("</details>\n".into());
        }
        shown
    }

    fn block(&mut self, place: &str, block: &Block) -> String {
        match block {
            Block::Text(text) => self.checked(place, |markup| markup.blocks(text)),
            Block::Printed(text) => {
                let text = self.checked(place, |markup| markup.blocks(text));
                format!("<div class=\"paper-only\">\n{text}</div>\n")
            }
            Block::Aside { title, text } => {
                let text = self.checked(place, |markup| markup.blocks(text));
                format!(
                    "<details class=\"aside\"><summary>{}</summary>\n{text}</details>\n",
                    html(title)
                )
            }
            Block::Note(text) => {
                let text = self.checked(place, |markup| markup.blocks(text));
                format!("<aside class=\"note\">\n{text}</aside>\n")
            }
            Block::Equation { latex, label } => {
                let mathml = self.checked(place, |markup| markup.equation(latex));
                let label = label.as_ref().map_or(String::new(), |label| {
                    format!("<span class=\"label\">({})</span>", html(label))
                });
                format!("<div class=\"equation\">{mathml}{label}</div>\n")
            }
            Block::Code { language, text } => code(language, text),
            Block::Python { code: text, output } => {
                let output = if output.is_empty() { String::new() } else { code("text", output) };
                format!("<div class=\"python\">\n{}{output}</div>\n", code("python", text))
            }
            Block::Twin { python, rust } => {
                let [python, rust] = [python, rust].map(|pieces| -> String {
                    pieces.iter().map(|(language, text)| code(language, text)).collect()
                });
                format!(
                    "{SWITCH}<div class=\"python\">\n{python}</div><div class=\"rust\">\n{rust}</div></div>\n"
                )
            }
            Block::Drawing { svg, alt } => format!(
                "<p class=\"drawing\"><img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\"></p>\n",
                html(alt),
                base64(svg.as_bytes())
            ),
            Block::FoldedCode { language, text } => format!(
                "<details class=\"folded\"><summary>{}: {} lines</summary>\n{}</details>\n",
                if language == "rust" { "Rust" } else { "code" },
                text.trim_end().lines().count(),
                code(language, text)
            ),
            Block::Proof(proof) => {
                self.proofs = true;
                let problem = data(&proof.problem);
                self.checked(place, |_| written(&ProofView { problem, proof }))
            }
            Block::Live(live) => self.live(place, live),
            Block::Figure(figure) => self.figure(place, figure),
            Block::Tiles(list) => tiles(list),
            Block::Player(player) => self.player(place, player),
            Block::Table(table) => self.table(place, table),
            Block::Thumbnails(list) => self.thumbnails(place, list),
        }
    }

    fn thumbnails(&mut self, place: &str, list: &[Thumbnail]) -> String {
        let one = |own: &Thumbnail| {
            if !disk::is_name(&own.id) {
                self.defects.add(place, format!("{:?} cannot be an anchor", own.id));
            }
            let block = self.block(place, &own.block);
            let (id, name, title) = (html(&own.id), html(&own.name), html(&own.title));
            format!(
                "<details class=\"thumbnail\" id=\"{id}\"><summary>{}<b>{name}</b> <span>{title}</span>\
                 </summary>\n{block}</details>\n",
                own.svg
            )
        };
        format!("<div class=\"thumbnails\">\n{}</div>\n", list.iter().map(one).collect::<String>())
    }

    fn figure(&mut self, place: &str, figure: &Picture) -> String {
        self.figures += 1;
        self.plots = true;
        let caption = self.checked(place, |markup| markup.inline(&figure.caption));
        let number = self.figures;
        self.checked(place, |_| written(&FigureView { number, figure, caption }))
    }

    fn live(&mut self, place: &str, live: &Live) -> String {
        if !disk::is_name(&live.name) {
            self.defects.add(place, format!("{:?} cannot be the name of a live page", live.name));
        }
        if self.lives.iter().all(|other| other.name != live.name) {
            self.lives.push(live.clone());
        }
        format!(
            "<details class=\"live\" data-page=\"{}\" data-state=\"{}\"><summary>{}</summary></details>\n",
            html(&live.name),
            html(&live.state),
            html(&live.title)
        )
    }

    fn player(&mut self, place: &str, player: &Player) -> String {
        self.figures += 1;
        self.plays = true;
        let caption = self.checked(place, |markup| markup.inline(&player.caption));
        let number = self.figures;
        self.checked(place, |_| player::rendered(player, number, caption))
    }

    fn table(&mut self, place: &str, table: &Table) -> String {
        self.tables += 1;
        for (i, row) in table.rows.iter().enumerate() {
            if row.len() != table.columns.len() {
                let (cells, columns) = (row.len(), table.columns.len());
                let place = format!("{place}, row {}", i + 1);
                self.defects.add(place, format!("has {cells} cells, the table {columns} columns"));
            }
        }
        let (table, same) = &table.condensed();
        let mut how_to_read = self.checked(place, |markup| markup.inline(&table.how_to_read));
        if !same.is_empty() {
            let said = same.iter().map(|(title, value)| {
                let title = self.checked(place, |markup| markup.inline(title));
                format!("{title} = {}", html(value))
            });
            let said: Vec<String> = said.collect();
            how_to_read += &format!(" The same in every row: {}.", said.join(", "));
        }
        let titled = table
            .columns
            .iter()
            .map(|column| (column, self.checked(place, |markup| markup.inline(&column.title))));
        let columns = titled.collect();
        let number = self.tables;
        let mut typeset = |cell: &Cell| match cell.markup.is_empty() {
            true => html(&cell.text).to_string(),
            false => self.checked(place, |markup| markup.inline(&cell.markup)),
        };
        let mut rows = Vec::new();
        for row in &table.rows {
            rows.push(row.iter().map(|cell| (cell, typeset(cell))).collect());
        }
        self.checked(place, |_| written(&TableView { number, table, how_to_read, columns, rows }))
    }

    /// The HTML, or an empty text and one more defect.
    fn checked(
        &mut self,
        place: &str,
        write: impl FnOnce(&Renderer) -> std::result::Result<String, String>,
    ) -> String {
        write(&self.markup).unwrap_or_else(|reason| {
            self.defects.add(place, reason);
            String::new()
        })
    }
}

fn tiles(list: &[Tile]) -> String {
    let tile = |tile: &Tile| {
        let Tile { value, label, section, good } = tile;
        let class = if *good { "good" } else { "bad" };
        format!(
            "<li><a href=\"#{}\"><b class=\"{class}\">{}</b> {}</a></li>\n",
            html(section),
            html(value),
            html(label)
        )
    };
    format!("<ul class=\"tiles\">\n{}</ul>\n", list.iter().map(tile).collect::<String>())
}

impl TableView<'_> {
    /// Whether a phone shows each row as a list: columns of words do not fit its width, nor do many
    /// columns of numbers.
    fn is_stacked(&self) -> bool {
        let columns = || self.table.columns.iter().filter(|own| !own.wide);
        let is_plain =
            |own: &Column| !own.title.is_empty() && !own.title.contains(['$', '*', '`', '[']);
        let is_words = |own: &Column| own.align == Align::Left;
        (columns().count() > 2 || self.width() > PHONE)
            && columns().all(is_plain)
            && (columns().all(is_words) || self.width() > PHONES * PHONE)
    }

    /// Whether such a list has its numbers in pairs.
    fn has_pairs(&self) -> bool {
        self.is_stacked() && self.table.columns.iter().any(|own| own.align == Align::Right)
    }

    /// The number of rows with a mark of failure or attention.
    fn marked(&self) -> usize {
        let is_marked = |cell: &Cell| matches!(cell.mark, Mark::Bad | Mark::Note);
        self.table.rows.iter().filter(|row| row.iter().any(is_marked)).count()
    }

    /// The estimated width of the columns on a phone (px): of cells, and of the words of headings.
    fn width(&self) -> f64 {
        let width = |text: &str| LETTER * text.chars().count() as f64;
        let cell = |text: &str| if text.chars().count() > LONG { LONGEST } else { width(text) };
        let column = |k: usize| {
            let cells = self.table.rows.iter().filter_map(|row| Some(cell(&row.get(k)?.text)));
            let heading = self.heading(&k);
            let words = heading.split(' ').map(width);
            cells.chain(words).fold(0.0, f64::max) + BETWEEN
        };
        (0..self.table.columns.len()).filter(|k| !self.table.columns[*k].wide).map(column).sum()
    }

    /// The heading of a column as plain text, with its unit.
    fn heading(&self, k: &usize) -> String {
        let Column { title, unit, .. } = &self.table.columns[*k];
        let title = unescaped(title);
        if unit.is_empty() { title } else { format!("{title} ({unit})") }
    }

    fn class(&self, k: &usize, cell: &Cell) -> String {
        let align = match self.table.columns[*k].align {
            Align::Left => "",
            Align::Right => "number",
        };
        let mark = match cell.mark {
            Mark::Plain => "",
            Mark::Good => "good",
            Mark::Bad => "bad",
            Mark::Note => "caution",
        };
        let length = match cell.text.chars().count() {
            length if length > LONG => "long",
            length if length > MIDDLE => "middle",
            _ => "",
        };
        let Column { secondary, wide, .. } = self.table.columns[*k];
        let paper = if secondary { "screen-only" } else { "" };
        let phone = if wide { "wide-only" } else { "" };
        let classes =
            [align, mark, length, paper, phone].into_iter().filter(|class| !class.is_empty());
        classes.collect::<Vec<_>>().join(" ")
    }
}

fn written(template: &impl Template) -> std::result::Result<String, String> {
    template.render().map_err(|error| error.to_string())
}

fn finished(html: &Html) -> Result<String> {
    let written = written(html).map(|html| with_bound_units(&html));
    written.map_err(|reason| Error::invalid("page", html.page.title.as_str(), reason))
}

/// Bytes as base64 (RFC 4648), as used in `data:` addresses.
///
/// ```
/// assert_eq!(lcplab_page::page::base64(b"lcp"), "bGNw");
/// ```
pub fn base64(bytes: &[u8]) -> String {
    const DIGITS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut out = String::with_capacity(bytes.len().div_ceil(3) * 4);
    for chunk in bytes.chunks(3) {
        let word = (0..3).fold(0, |word, k| word << 8 | u32::from(*chunk.get(k).unwrap_or(&0)));
        for k in 0..4 {
            let digit = DIGITS[(word >> (18 - 6 * k) & 63) as usize];
            out.push(if k <= chunk.len() { digit.into() } else { '=' });
        }
    }
    out
}
