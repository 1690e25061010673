//! Captures the output of a cell while it runs.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Display;

use crate::document::Block;

/// An output below a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Printed lines.
    Lines(String),
    /// A table, a formula, a picture.
    Block(Block),
}

/// The output of a whole notebook.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// The output of each cell.
    pub cells: Vec<Vec<Output>>,
    /// The values that the prose quotes by name.
    pub values: BTreeMap<String, String>,
}

thread_local! {
    static RECORD: RefCell<Option<Record>> = const { RefCell::new(None) };
}

/// Begins the record of a notebook run on this thread.
pub(super) fn begin() {
    RECORD.set(Some(Record::default()));
}

/// Ends the record.
pub(super) fn end() -> Record {
    RECORD.take().unwrap_or_default()
}

/// Assigns the following output to the cell with this index.
pub fn cell(index: usize) {
    with(|record| record.cells.resize(index + 1, Vec::new()));
}

/// Adds a line of output; `println!` in a cell calls this.
pub fn say(line: &str) {
    put_out(Output::Lines(format!("{line}\n")));
}

/// Sets a value that the prose quotes as `{{name}}`.
pub fn put(name: &str, value: impl Display) {
    let is_recorded = with(|record| record.values.insert(name.to_string(), value.to_string()));
    if is_recorded.is_none() {
        println!("{name} = {value}");
    }
}

/// Adds to the cell's outputs; without a record, for example in a Jupyter kernel, it is printed.
pub(super) fn put_out(output: Output) {
    let mut output = Some(output);
    with(|record| {
        let Some(cell) = record.cells.last_mut() else { return };
        match (cell.last_mut(), output.take()) {
            (Some(Output::Lines(lines)), Some(Output::Lines(more))) => lines.push_str(&more),
            (_, Some(other)) => cell.push(other),
            (_, None) => (),
        }
    });
    if let Some(output) = output {
        print!("{}", output.for_kernel());
    }
}

fn with<T>(action: impl FnOnce(&mut Record) -> T) -> Option<T> {
    RECORD.with_borrow_mut(|record| record.as_mut().map(action))
}
