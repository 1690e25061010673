//! A document for a terminal: aligned, with matrices drawn in brackets.

use super::notation::plain;
use super::{Block, Document, Formula, Grid, Piece, Table};

/// Whether escapes are used.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Ink {
    Plain,
    Coloured,
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
            Ink::Coloured => format!("\x1b[{code}m{words}\x1b[0m"),
        }
    }
}

/// Lines of a paragraph are not longer than this.
const WIDTH: usize = 96;

pub(super) fn written(document: &Document, ink: Ink) -> String {
    let mut out = format!("{}\n{}", ink.heading(&document.title), wrapped(&document.lead));
    for (k, section) in document.sections.iter().enumerate() {
        out += &format!("\n{}\n", ink.heading(&format!("{} {}", k + 1, section.title)));
        for block in &section.blocks {
            out += &inked(block, ink);
        }
    }
    out
}

impl Block {
    /// As lines for a terminal, without colours.
    pub fn text(&self) -> String {
        inked(self, Ink::Plain)
    }
}

fn inked(block: &Block, ink: Ink) -> String {
    match block {
        Block::Text(words) => wrapped(words),
        Block::Formula(own) => formula(own, ink),
        Block::Table(own) => table(own, ink),
        Block::Figure(own) => wrapped(&format!("[picture: {}]", own.caption)),
    }
}

/// A paragraph in lines.
fn wrapped(words: &str) -> String {
    let (mut out, mut length) = (String::new(), 0);
    for word in words.split(' ') {
        let size = word.chars().count();
        if length > 0 && length + 1 + size > WIDTH {
            out.push('\n');
            length = 0;
        } else if length > 0 {
            out.push(' ');
            length += 1;
        }
        out += word;
        length += size;
    }
    out + "\n"
}

/// A formula: its pieces side by side, symbols on the middle line of the matrices.
fn formula(formula: &Formula, ink: Ink) -> String {
    let drawn: Vec<Vec<String>> = formula.pieces.iter().map(piece).collect();
    let height = drawn.iter().map(Vec::len).max().unwrap_or(1);
    let mut lines = vec![String::from("   "); height];
    for piece in &drawn {
        let width = piece.iter().map(|line| line.chars().count()).max().unwrap_or(0);
        let above = (height - piece.len()) / 2;
        for (k, line) in lines.iter_mut().enumerate() {
            let own = k.checked_sub(above).and_then(|k| piece.get(k)).map_or("", String::as_str);
            *line += &format!(" {own:<width$}");
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
        Piece::Symbols { text, .. } => vec![text.clone()],
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
        let cells = row.iter().zip(&widths).map(|(cell, &width)| format!("{cell:>width$}"));
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

/// A table with its title above; columns of words to the left, of numbers to the right.
fn table(table: &Table, ink: Ink) -> String {
    let width = |c: usize| {
        let cells = table.rows.iter().map(|row| row[c].chars().count());
        cells.chain([table.columns[c].chars().count()]).max().unwrap_or(0)
    };
    let widths: Vec<usize> = (0..table.columns.len()).map(width).collect();
    let line = |row: &[String]| {
        let pad = |(c, cell): (usize, &String)| match table.is_numeric(c) {
            true => format!("{cell:>width$}", width = widths[c]),
            false => format!("{cell:<width$}", width = widths[c]),
        };
        let cells: Vec<String> = row.iter().enumerate().map(pad).collect();
        format!("    {}", cells.join("   ")).trim_end().to_string()
    };
    let mut out = format!("  {}\n{}\n", table.title, ink.faint(&line(&table.columns)));
    for row in &table.rows {
        out += &(line(row) + "\n");
    }
    if table.left_out > 0 {
        out += &format!("    and {} more\n", table.left_out);
    }
    out
}
