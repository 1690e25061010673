//! The common interface of all figures.

/// Width of every figure in px.
pub const WIDTH: f64 = 880.0;
/// Width of a figure for a phone or a column of a sheet in px.
pub(crate) const NARROW: f64 = 400.0;

/// A picture with a name, texts and numbers.
///
/// ```
/// use lcplab_page::figure::Figure;
///
/// /// A line of 1 px.
/// struct Line;
///
/// impl Figure for Line {
///     fn id(&self) -> &str {
///         "line"
///     }
///
///     fn title(&self) -> &str {
///         "A line"
///     }
///
///     fn caption(&self) -> &str {
///         ""
///     }
///
///     fn drawn(&self, width: f64, id: &str) -> String {
///         format!(r#"<svg id="{id}" viewBox="0 0 {width} 1"><path d="M0 0H{width}"/></svg>"#)
///     }
///
///     fn csv(&self) -> String {
///         "x\n0\n".into()
///     }
/// }
///
/// assert_eq!(Line.words(), "A line"); // it has no caption
/// assert!(Line.svg().contains(r#"id="line""#)); // in the usual width
/// assert!(Line.narrow().unwrap().contains(r#"id="line-narrow""#)); // for phones
/// ```
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

    /// The picture with this width (px) and this id, which no other picture on its page has: a
    /// complete SVG document without fonts, scripts or references to other files.
    fn drawn(&self, width: f64, id: &str) -> String;

    /// The picture in the usual width.
    fn svg(&self) -> String {
        self.drawn(WIDTH, self.id())
    }

    /// The same picture for phones and for a column of a printed sheet, where its text can still
    /// be read; `None` if so narrow a picture shows nothing.
    fn narrow(&self) -> Option<String> {
        Some(self.drawn(NARROW, &format!("{}-narrow", self.id())))
    }

    /// Every number in the picture (RFC 4180), with names and units in the first line.
    fn csv(&self) -> String;
}
