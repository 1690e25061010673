//! What every figure gives.

/// A picture with a name, words and numbers.
pub trait Figure {
    /// A short name without spaces: the file's stem and the anchor on a page.
    fn id(&self) -> &str;

    /// One line, drawn above the picture.
    fn title(&self) -> &str;

    /// What the reader should see in the picture, in a sentence or two; it stands beside the
    /// picture, not in it, and may carry the markup of a page.
    fn caption(&self) -> &str;

    /// The caption, or the title where there is none.
    fn words(&self) -> &str {
        if self.caption().is_empty() { self.title() } else { self.caption() }
    }

    /// The picture, a complete SVG document without fonts, scripts or references to other files.
    fn svg(&self) -> String;

    /// Every number behind the picture (RFC 4180), names and units in the first line.
    fn csv(&self) -> String;
}
