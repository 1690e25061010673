//! What results are shown with: [`plot`] draws figures as SVG, a [`document`] is words, formulas and tables
//! for a terminal, Markdown or HTML, a [`page`] one self-contained HTML file, and [`text`] a table on a
//! terminal. Nothing here knows a solver or a scene.

pub mod document;
pub mod page;
pub mod plot;
pub mod text;
