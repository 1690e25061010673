//! What a cell puts out, caught while it runs.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Display;

use crate::document::Block;

/// What stands under a cell.
#[derive(Debug, Clone, PartialEq)]
pub enum Output {
    /// Lines as they were printed.
    Lines(String),
    /// A table, a formula, a picture.
    Block(Block),
}

/// What a whole notebook put out.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Record {
    /// Cell by cell.
    pub cells: Vec<Vec<Output>>,
    /// The values that the prose quotes by name.
    pub values: BTreeMap<String, String>,
}

thread_local! {
    static RECORD: RefCell<Option<Record>> = const { RefCell::new(None) };
}

/// Begins the record of a notebook's run on this thread.
pub(super) fn begin() {
    RECORD.set(Some(Record::default()));
}

/// Ends it.
pub(super) fn end() -> Record {
    RECORD.take().unwrap_or_default()
}

/// What follows belongs to the cell of this index.
pub fn cell(index: usize) {
    with(|record| record.cells.resize(index + 1, Vec::new()));
}

/// A line under the cell; `println!` of a cell ends here.
pub fn say(line: &str) {
    put_out(Output::Lines(format!("{line}\n")));
}

/// A value that the prose quotes as `{{name}}`.
pub fn put(name: &str, value: impl Display) {
    let is_recorded = with(|record| record.values.insert(name.to_string(), value.to_string()));
    if is_recorded.is_none() {
        println!("{name} = {value}");
    }
}

/// Adds to the cell's outputs; without a record, in a Jupyter kernel say, it is printed.
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
