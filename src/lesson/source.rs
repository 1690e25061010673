//! A literate notebook as it is written: Markdown whose Rust blocks are cells.
//!
//! ```text
//! ---                          an optional head for Jupytext, which is skipped
//! # Title                      the first line
//! prose, $x^2$, {{name}}       {{name}} is a value that a cell has put there
//! ```rust                      a cell: shown, compiled and run
//! ```rust tags=["hide"]        a cell whose code is not shown
//! ```rust tags=["fold"]        a cell whose code is folded: set-up, tables, plots
//! ```python                    right after a cell: the same in Python
//! ```text                      anything else in fences belongs to the prose
//! ```
//!
//! The build script reads notebooks by the same code, to turn their cells into programs.

/// A notebook, cut into prose and cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The heading, without its sign.
    pub title: String,
    /// What follows, from top to bottom.
    pub parts: Vec<Part>,
}

/// A piece of a notebook.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// Markdown.
    Prose(String),
    /// Python that says the same as the cell before it.
    Twin(String),
    /// Rust.
    Cell {
        /// The lines, as they are.
        code: String,
        /// How readers see the lines.
        shown: Shown,
    },
}

/// How a cell's code is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// As it is.
    Open,
    /// Folded away, for those who want to look.
    Folded,
    /// Not at all on a page.
    Hidden,
}

impl Shown {
    fn of(fence: &str) -> Shown {
        match fence {
            fence if fence.contains("\"hide\"") => Shown::Hidden,
            fence if fence.contains("\"fold\"") => Shown::Folded,
            _ => Shown::Open,
        }
    }
}

impl Source {
    /// Cuts a notebook into its parts.
    pub fn read(text: &str) -> Source {
        let mut lines = without_head(text).lines();
        let title = lines.by_ref().find(|line| !line.trim().is_empty()).unwrap_or_default();
        let mut parts = Vec::new();
        let (mut prose, mut is_fenced) = (String::new(), false);
        while let Some(line) = lines.next() {
            if !is_fenced && (line == "```rust" || line.starts_with("```rust ")) {
                push_prose(&mut parts, &mut prose);
                let code: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
                parts.push(Part::Cell { code: code.join("\n"), shown: Shown::of(line) });
                continue;
            }
            if !is_fenced && line == "```python" && follows_cell(&parts, &prose) {
                prose.clear();
                let code: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
                parts.push(Part::Twin(code.join("\n")));
                continue;
            }
            is_fenced ^= line.starts_with("```");
            prose += line;
            prose.push('\n');
        }
        push_prose(&mut parts, &mut prose);
        Source { title: title.trim_start_matches('#').trim().to_string(), parts }
    }

    /// The code of the cells, in order.
    pub fn cells(&self) -> impl Iterator<Item = &str> {
        self.parts.iter().filter_map(|part| match part {
            Part::Cell { code, .. } => Some(code.as_str()),
            Part::Prose(_) | Part::Twin(_) => None,
        })
    }
}

fn follows_cell(parts: &[Part], prose: &str) -> bool {
    prose.trim().is_empty() && matches!(parts.last(), Some(Part::Cell { .. }))
}

fn without_head(text: &str) -> &str {
    let body = text.strip_prefix("---\n").and_then(|rest| rest.split_once("\n---\n"));
    body.map_or(text, |(_, body)| body)
}

fn push_prose(parts: &mut Vec<Part>, prose: &mut String) {
    let text = std::mem::take(prose);
    if !text.trim().is_empty() {
        parts.push(Part::Prose(text.trim().to_string()));
    }
}
