//! The tables of the report, on the terminal.

#[path = "../../measure/table.rs"]
mod table;

use lcplab_benches::study::peers::{Plan, Recording};
use lcplab::report::view::Document;

pub fn tables(recording: &Recording) {
    let document = Document::of(&Plan::default(), std::slice::from_ref(recording));
    document.tables.iter().for_each(|(_, shown)| table::print(shown));
}
