//! Writes a document as Markdown, with LaTeX between dollar signs.

use super::notation::latex;
use super::{Block, Document, Formula, Piece, Table};

pub(super) fn written(document: &Document) -> String {
    let mut out = format!("# {}\n\n{}\n", escaped(&document.title), escaped(&document.lead));
    for (k, section) in document.sections.iter().enumerate() {
        out += &format!("\n## {} {}\n", k + 1, escaped(&section.title));
        for block in &section.blocks {
            out += &block.markdown();
        }
    }
    out
}

impl Block {
    /// The Markdown, preceded by an empty line.
    pub fn markdown(&self) -> String {
        match self {
            Block::Heading(words) => format!("\n### {}\n", escaped(words)),
            Block::Text(words) => format!("\n{}\n", escaped(words)),
            Block::Formula(own) => format!("\n$$\n{}\n$$\n", formula(own)),
            Block::Table(own) => table(own),
            Block::Figure(own) => format!("\n*Figure: {}*\n", own.caption),
        }
    }
}

/// A formula in LaTeX, followed by its unit and a note on omitted entries as text.
pub(super) fn formula(formula: &Formula) -> String {
    let piece = |piece: &Piece| match piece {
        Piece::Symbols { latex, .. } => latex.clone(),
        Piece::Grid(grid) => {
            let cells = grid.cells(latex, ["\\cdots", "\\vdots", "\\ddots"]);
            let rows: Vec<String> = cells.iter().map(|row| row.join(" & ")).collect();
            format!("\\begin{{bmatrix}} {} \\end{{bmatrix}}", rows.join(" \\\\ "))
        }
    };
    let mut out = formula.pieces.iter().map(piece).collect::<Vec<_>>().join(" ");
    for remark in [formula.unit.as_str(), &formula.left_out()] {
        if !remark.is_empty() {
            out += &format!(" \\quad \\text{{{remark}}}");
        }
    }
    out
}

fn table(table: &Table) -> String {
    let line = |cells: &[String]| {
        let cells: Vec<String> = cells.iter().map(|cell| escaped(cell)).collect();
        format!("| {} |\n", cells.join(" | "))
    };
    let rule: Vec<&str> = (0..table.columns.len())
        .map(|c| if table.is_numeric(c) { "---:" } else { "---" })
        .collect();
    let mut out = format!("\n*{}*\n\n{}", escaped(&table.title), line(&table.columns));
    out += &format!("| {} |\n", rule.join(" | "));
    for row in &table.rows {
        out += &line(row);
    }
    if table.left_out > 0 {
        out += &format!("\nand {} more\n", table.left_out);
    }
    out
}

/// Text with Markdown's special characters escaped.
fn escaped(words: &str) -> String {
    let mut out = String::new();
    for c in words.chars() {
        if "\\`*_[]<>|$#".contains(c) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}
