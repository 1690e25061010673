//! The common interface of all figures.

/// A picture with a name, texts and numbers.
pub trait Figure {
    /// A short name without spaces: the stem of the file name and the anchor on a page.
    fn id(&self) -> &str;

    /// One line, drawn above the picture.
    fn title(&self) -> &str;

    /// The finding that the picture shows, in a sentence or two; it is placed next to the picture,
    /// not in it, and may contain the markup of a page.
    fn caption(&self) -> &str;

    /// The caption, or the title if there is none.
    fn words(&self) -> &str {
        if self.caption().is_empty() { self.title() } else { self.caption() }
    }

    /// The picture as a complete SVG document without fonts, scripts or references to other files.
    fn svg(&self) -> String;

    /// The same picture for narrow screens, with a text size that can be read there, if it has one.
    fn narrow(&self) -> Option<String> {
        None
    }

    /// Every number in the picture (RFC 4180), with names and units in the first line.
    fn csv(&self) -> String;
}
