//! Writes a document for a terminal: aligned, with matrices in brackets.

use super::notation::plain;
use super::{Block, Document, Formula, Grid, Piece, Table};
use crate::page::Align;
use crate::text::{padded, printable};

/// Whether escape sequences are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ink {
    Plain,
    Colored,
}

impl Ink {
    fn heading(self, words: &str) -> String {
        self.styled("1;34", words)
    }

    fn faint(self, words: &str) -> String {
        self.styled("2", words)
    }

    fn styled(self, code: &str, words: &str) -> String {
        match self {
            Ink::Plain => words.to_string(),
            Ink::Colored => format!("\x1b[{code}m{}\x1b[0m", printable(words)),
        }
    }
}

/// The largest width of a paragraph.
const WIDTH: usize = 96;
/// The largest width of a table, if its cells can be wrapped.
pub(crate) const TABLE: usize = 128;
/// Cells are wrapped to this width at least.
const WRAPPED: usize = 24;
/// The margin of a table, and the gap between its columns.
const MARGIN: usize = 4;
const GAP: usize = 3;

pub(super) fn written(document: &Document, ink: Ink) -> String {
    let mut out = format!("{}\n{}", ink.heading(&document.title), paragraph(&document.lead));
    for (k, section) in document.sections.iter().enumerate() {
        out += &format!("\n{}\n", ink.heading(&format!("{} {}", k + 1, section.title)));
        for block in &section.blocks {
            out += &inked(block, ink);
        }
    }
    out
}

impl Block {
    /// The document as lines for a terminal, without colors.
    pub fn text(&self) -> String {
        inked(self, Ink::Plain)
    }
}

fn inked(block: &Block, ink: Ink) -> String {
    match block {
        Block::Heading(words) => format!("\n{}\n", ink.heading(words)),
        Block::Text(words) => paragraph(words),
        Block::Formula(own) => formula(own, ink),
        Block::Table(own) => table(own, ink),
        Block::Figure(own) => paragraph(&format!("[picture: {}]", own.caption)),
    }
}

pub(crate) fn paragraph(words: &str) -> String {
    wrapped(words, WIDTH).join("\n") + "\n"
}

/// Text wrapped to this width, made printable; at least one line.
pub(crate) fn wrapped(words: &str, width: usize) -> Vec<String> {
    let words = printable(words);
    let (mut lines, mut line, mut length) = (Vec::new(), String::new(), 0);
    for word in words.split(' ') {
        let size = word.chars().count();
        if length > 0 && length + 1 + size > width {
            lines.push(std::mem::take(&mut line));
            length = 0;
        } else if length > 0 {
            line.push(' ');
            length += 1;
        }
        line += word;
        length += size;
    }
    lines.push(line);
    lines.into_iter().map(|line| line.replace('\u{a0}', " ")).collect()
}

/// A formula: its parts side by side, with symbols at the middle row of the matrices.
fn formula(formula: &Formula, ink: Ink) -> String {
    let drawn: Vec<Vec<String>> = formula.pieces.iter().map(piece).collect();
    let height = drawn.iter().map(Vec::len).max().unwrap_or(1);
    let mut lines = vec![String::from("   "); height];
    for piece in &drawn {
        let width = piece.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        let above = (height - piece.len()) / 2;
        for (k, line) in lines.iter_mut().enumerate() {
            let own = k.checked_sub(above).and_then(|k| piece.get(k)).map_or("", String::as_str);
            *line += &format!(" {}", padded(own, width, Align::Left));
        }
    }
    let mut lines: Vec<String> = lines.iter().map(|line| line.trim_end().to_string()).collect();
    let middle = (height - 1) / 2;
    for remark in [formula.unit.as_str(), &formula.left_out()] {
        if !remark.is_empty() {
            lines[middle] += &format!("   {}", ink.faint(remark));
        }
    }
    lines.join("\n") + "\n"
}

fn piece(piece: &Piece) -> Vec<String> {
    match piece {
        Piece::Symbols { text, .. } => vec![printable(text).into_owned()],
        Piece::Grid(own) => grid(own),
    }
}

/// A matrix in brackets.
fn grid(grid: &Grid) -> Vec<String> {
    let cells = grid.cells(plain, ["…", "⋮", "⋱"]);
    let (height, columns) = (cells.len(), cells.first().map_or(0, Vec::len));
    let width = |c: usize| cells.iter().map(|row| row[c].chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let line = |(r, row): (usize, &Vec<String>)| {
        let cells = row.iter().zip(&widths).map(|(cell, &width)| padded(cell, width, Align::Right));
        let [open, close] = match r {
            _ if height == 1 => ["[", "]"],
            0 => ["⎡", "⎤"],
            r if r + 1 == height => ["⎣", "⎦"],
            _ => ["⎢", "⎥"],
        };
        format!("{open} {} {close}", cells.collect::<Vec<_>>().join("  "))
    };
    cells.iter().enumerate().map(line).collect()
}

/// A table with its title above; text columns are left-aligned, numbers right-aligned.
fn table(table: &Table, ink: Ink) -> String {
    let align = |c: usize| if table.is_numeric(c) { Align::Right } else { Align::Left };
    let align: Vec<Align> = (0..table.columns.len()).map(align).collect();
    let rows = aligned(table, &align, TABLE, ink);
    let mut out = format!("  {}\n{rows}", printable(&table.title));
    if table.left_out > 0 {
        out += &format!("    and {} more\n", table.left_out);
    }
    out
}

/// The headings and rows of a table, its columns aligned in this way; lines are no longer than
/// `width` if cells that are wrapped at spaces allow it.
pub(crate) fn aligned(table: &Table, align: &[Align], width: usize, ink: Ink) -> String {
    let widths = widths(table, width);
    let lines = |row: &[String]| {
        let cells: Vec<_> =
            row.iter().zip(&widths).map(|(cell, &width)| wrapped(cell, width)).collect();
        let height = cells.iter().map(Vec::len).max().unwrap_or(1);
        let line = |k: usize| {
            let pad = |(c, lines): (usize, &Vec<String>)| {
                padded(lines.get(k).map_or("", String::as_str), widths[c], align[c])
            };
            let cells: Vec<String> = cells.iter().enumerate().map(pad).collect();
            let (margin, gap) = (" ".repeat(MARGIN), " ".repeat(GAP));
            format!("{margin}{}", cells.join(&gap)).trim_end().to_string()
        };
        (0..height).map(line).collect::<Vec<_>>().join("\n")
    };
    let rows = table.rows.iter().map(|row| lines(row) + "\n");
    format!("{}\n{}", ink.faint(&lines(&table.columns)), rows.collect::<String>())
}

/// Whether the columns fit lines of this width with cells that are not narrower than [`WRAPPED`]
/// for wrapping.
pub(crate) fn is_readable(table: &Table, width: usize) -> bool {
    total(&readable(table)) <= width
}

/// The columns' widths: those of their cells; while the table is too wide, the widest column that
/// can be wrapped is narrowed, first to [`WRAPPED`] and then to its longest word.
fn widths(table: &Table, width: usize) -> Vec<usize> {
    let [words, readable] = [words(table), readable(table)];
    let mut widths = longest(table, size);
    // If even the longest words are too wide, narrower columns are of no use.
    let least = if total(&words) > width { vec![readable] } else { vec![readable, words] };
    for least in least {
        while total(&widths) > width {
            let partable = (0..widths.len()).filter(|&c| widths[c] > least[c]);
            let Some(widest) = partable.max_by_key(|&c| widths[c]) else { break };
            widths[widest] -= 1;
        }
    }
    widths
}

/// The width of the lines of a table whose columns have these widths.
fn total(widths: &[usize]) -> usize {
    MARGIN + widths.iter().sum::<usize>() + GAP * widths.len().saturating_sub(1)
}

/// The least widths: the longest word of each column.
fn words(table: &Table) -> Vec<usize> {
    longest(table, |words| words.split(' ').map(size).max().unwrap_or(0))
}

/// The least widths at which cells of several words are easy to read.
fn readable(table: &Table) -> Vec<usize> {
    let cells = |c: usize| table.rows.iter().map(|row| size(&row[c])).max().unwrap_or(0);
    words(table).into_iter().enumerate().map(|(c, word)| word.max(cells(c).min(WRAPPED))).collect()
}

/// The largest size in each column, heading included.
fn longest(table: &Table, size: impl Fn(&str) -> usize) -> Vec<usize> {
    let longest = |c: usize| {
        let cells = table.rows.iter().map(|row| row[c].as_str());
        cells.chain([table.columns[c].as_str()]).map(&size).max().unwrap_or(0)
    };
    (0..table.columns.len()).map(longest).collect()
}

fn size(words: &str) -> usize {
    words.chars().count()
}
