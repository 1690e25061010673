//! Results as pages, tables and JSON.

pub mod answer;
pub mod page;
