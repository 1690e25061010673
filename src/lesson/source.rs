//! The source of a literate notebook: Markdown whose Python and Rust blocks are cells.
//!
//! ```text
//! ---                          an optional head for Jupytext, which is skipped
//! # Title                      the first line
//! prose, $x^2$, {{name}}       {{name}} is a value that a cell has set
//! ```rust                      a cell: shown, compiled and run
//! ```rust tags=["hide"]        a cell whose code is not shown
//! ```rust tags=["fold"]        a cell whose code is folded: set-up, tables, plots
//! ```python                    a cell in Python; after an open cell in Rust: the same in Python
//! ```output                    what the Python cell above it prints
//! ```text                      anything else in fences belongs to the prose
//! <details> … </details>       a fold, which can contain cells: the answer to a prediction
//! ```
//!
//! The build script uses the same code to turn the Rust cells of notebooks into programs. The tests
//! of the Python package run the Python cells and compare their output.

/// A notebook, split into prose and cells.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Source {
    /// The heading, without its `#`.
    pub title: String,
    /// The parts, from top to bottom.
    pub parts: Vec<Part>,
}

/// A part of a notebook.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Part {
    /// Markdown.
    Prose(String),
    /// A Python cell.
    Python {
        /// The code.
        code: String,
        /// Its output.
        output: String,
        /// Whether it is equivalent to the preceding Rust cell.
        is_twin: bool,
    },
    /// A Rust cell.
    Cell {
        /// The code.
        code: String,
        /// How the code is shown.
        shown: Shown,
    },
}

/// How a cell's code is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Shown {
    /// In full.
    Open,
    /// Collapsed.
    Folded,
    /// Not shown on a page.
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
    /// Splits a notebook into its parts.
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
            if !is_fenced && line == "```python" {
                push_prose(&mut parts, &mut prose);
                let code: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
                let (code, output) = (code.join("\n"), String::new());
                parts.push(Part::Python { code, output, is_twin: follows_open_cell(&parts) });
                continue;
            }
            if !is_fenced
                && line == "```output"
                && prose.trim().is_empty()
                && let Some(Part::Python { output, .. }) = parts.last_mut()
            {
                let lines = lines.by_ref().take_while(|line| *line != "```");
                *output = lines.fold(String::new(), |text, line| text + line + "\n");
                prose.clear();
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
            Part::Prose(_) | Part::Python { .. } => None,
        })
    }
}

fn follows_open_cell(parts: &[Part]) -> bool {
    matches!(parts.last(), Some(Part::Cell { shown: Shown::Open, .. }))
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
