//! Reports: pages made of results.

pub mod page;
