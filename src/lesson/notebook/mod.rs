//! Writes a notebook and its output as a Jupyter notebook (nbformat 4.5), for Python or for Rust.

mod fold;
mod kernel;
mod python;
mod rust;

use serde::Serialize;
use serde_json::ser::{PrettyFormatter, Serializer};
use serde_json::{Value, json};

use super::show::lined;

/// The text of an `.ipynb` file: its cells in order, and the metadata for a kernel.
fn file(cells: Vec<Value>, metadata: &Value) -> String {
    let mut cells = fold::folded(cells);
    for (k, cell) in cells.iter_mut().enumerate() {
        cell["id"] = json!(format!("cell-{k}"));
    }
    let (nbformat, nbformat_minor) = (4, 5);
    let notebook = json!({
        "cells": cells,
        "metadata": metadata,
        "nbformat": nbformat,
        "nbformat_minor": nbformat_minor,
    });
    // As Jupyter itself writes it.
    let mut out = Vec::new();
    let format = PrettyFormatter::with_indent(b" ");
    notebook.serialize(&mut Serializer::with_formatter(&mut out, format)).expect("plain JSON");
    String::from_utf8_lossy(&out).into_owned() + "\n"
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
