//! The Rust notebook, for the evcxr kernel.

use serde_json::json;

use super::{code, file, kernel, prose};
use crate::error::Result;
use crate::lesson::source::{Part, Shown, Source};
use crate::lesson::{Program, Record, quoted, twin};

/// Without `preserve_vars_on_panic` a cell that panics would not fail the run. The kernel spells
/// out the types of variables, so the traits of `Box<dyn Solver>` and `&dyn Family` must be in
/// scope.
const FIRST_CELL: &str = ":preserve_vars_on_panic 0\n:dep lcplab = { path = \"..\" }\n\
                          :dep nalgebra = \"0.35\"\nuse lcplab::lcp::library::Family;\nuse lcplab::solver::Solver;";

impl Program {
    /// The Rust notebook with its outputs, as the text of an `.ipynb` file.
    ///
    /// # Errors
    /// If the prose quotes a value that no cell has put.
    pub fn rust_notebook(&self, record: &Record) -> Result<String> {
        let source = Source::read(self.text);
        let mut cells = vec![prose(&format!("# {}", self.title())), code(FIRST_CELL, Vec::new())];
        let codes: Vec<&str> = source.cells().collect();
        let mut codes = kernel::cells(&codes).into_iter();
        let mut outputs = record.cells.iter();
        for part in &source.parts {
            cells.push(match part {
                Part::Prose(text) => prose(&quoted(self, text, record)?),
                Part::Python { code: python, .. } => prose(&format!(
                    "<details>\n<summary>Python</summary>\n\n```python\n{}\n```\n\n</details>",
                    twin::shown(python).trim()
                )),
                Part::Cell { shown, .. } => {
                    let lines = codes.next().unwrap_or_default();
                    let put_out = outputs.next().into_iter().flatten();
                    let mut cell =
                        code(&lines, put_out.map(|output| output.in_notebook()).collect());
                    if *shown != Shown::Open {
                        cell["metadata"] = json!({ "jupyter": { "source_hidden": true } });
                    }
                    cell
                }
            });
        }
        let metadata = json!({
            "kernelspec": { "display_name": "Rust", "language": "rust", "name": "rust" },
            "language_info": { "file_extension": ".rs", "mimetype": "text/rust", "name": "rust" },
        });
        Ok(file(cells, &metadata))
    }
}
