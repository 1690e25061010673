//! Presentation of results: [`plot`] draws figures as SVG, [`document`] holds text, formulas and
//! tables for a terminal, Markdown or HTML, [`page`] makes one self-contained HTML file, and
//! [`text`] prints a table on a terminal. This crate does not depend on solvers or scenes. Without
//! the feature `plots` it draws no figures.

pub mod csv;
pub mod document;
pub mod escape;
pub mod figure;
pub mod page;
#[cfg(feature = "plots")]
pub mod plot;
pub mod terminal;
pub mod text;

pub use lcplab_lcp::number;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
