//! What results are shown with: [`plot`] draws figures as SVG, a [`document`] is words, formulas
//! and tables for a terminal, Markdown or HTML, a [`page`] one self-contained HTML file, and
//! [`text`] a table on a terminal. Nothing here knows a solver or a scene. Without the feature
//! `plots` nothing is drawn.

pub mod csv;
pub mod document;
mod escape;
pub mod figure;
pub mod page;
#[cfg(feature = "plots")]
pub mod plot;
pub mod text;

pub use lcplab_problem::number;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
