//! A notebook that ran as a Jupyter notebook (nbformat 4.5) for the evcxr kernel.

use serde_json::{Value, json};

use super::kernel;
use super::show::lined;
use super::source::{Part, Shown, Source};
use super::{Program, Record, quoted, twin};
use crate::error::Result;

/// Without `preserve_vars_on_panic` a cell that panics would leave the run green. The kernel spells the types of variables
/// out, so the traits of `Box<dyn Solver>` and `&dyn Family` have to be known.
const FIRST_CELL: &str = ":preserve_vars_on_panic 0\n:dep lcplab = { path = \"..\" }\n\
                          :dep nalgebra = \"0.35\"\nuse lcplab::lcp::library::Family;\nuse lcplab::solver::Solver;";

impl Program {
    /// The notebook with its outputs, as the text of an `.ipynb` file.
    ///
    /// # Errors
    /// If the prose quotes a value that no cell has put.
    pub fn notebook(&self, record: &Record) -> Result<String> {
        let source = Source::read(self.text);
        let mut cells = vec![prose(&format!("# {}", self.title())), code(FIRST_CELL, Vec::new())];
        let codes: Vec<&str> = source.cells().collect();
        let mut codes = kernel::cells(&codes).into_iter();
        let mut outputs = record.cells.iter();
        for part in &source.parts {
            cells.push(match part {
                Part::Prose(text) => prose(&quoted(self, text, record)?),
                Part::Twin(python) => prose(&format!(
                    "<details>\n<summary>The same in Python</summary>\n\n```python\n{}\n```\n\n</details>",
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
        for (k, cell) in cells.iter_mut().enumerate() {
            cell["id"] = json!(format!("cell-{k}"));
        }
        let notebook = json!({
            "cells": cells,
            "metadata": {
                "kernelspec": { "display_name": "Rust", "language": "rust", "name": "rust" },
                "language_info": { "file_extension": ".rs", "mimetype": "text/rust", "name": "rust" },
            },
            "nbformat": 4,
            "nbformat_minor": 5,
        });
        Ok(format!("{notebook:#}\n"))
    }
}

fn prose(text: &str) -> Value {
    json!({ "cell_type": "markdown", "id": "", "metadata": {}, "source": lined(text) })
}

fn code(text: &str, outputs: Vec<Value>) -> Value {
    json!({
        "cell_type": "code",
        "execution_count": null,
        "id": "",
        "metadata": {},
        "outputs": outputs,
        "source": lined(text),
    })
}
