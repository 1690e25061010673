//! A plot as an exhibit's picture.

use crate::plot::{Figure, Lines};
use crate::report::page::Picture;

/// Curves as a picture without files beside it.
pub(super) fn drawn(lines: &Lines) -> Picture {
    Picture { svg: lines.svg(), caption: lines.caption.clone(), files: Vec::new() }
}
