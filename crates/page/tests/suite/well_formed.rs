//! What every picture promises.

use lcplab_page::plot::Figure;

/// A complete SVG document without scripts, references or numbers that are none.
pub fn assert_well_formed(figure: &dyn Figure) {
    let svg = figure.svg();
    assert_eq!(svg, figure.svg(), "the same bytes twice");
    assert!(svg.starts_with("<svg ") && svg.ends_with("</svg>\n"));
    assert!(svg.contains("viewBox=\"0 0 "));
    assert!(svg.contains(&format!("<title id=\"{}-title\">", figure.id())));
    assert!(svg.contains("</desc>"));
    assert_eq!(svg.matches("<g").count(), svg.matches("</g>").count());
    assert_eq!(svg.matches("<svg").count(), svg.matches("</svg>").count());
    for forbidden in ["NaN", "inf", "href", "<script", "url("] {
        assert!(!svg.contains(forbidden), "{forbidden} in {svg}");
    }
}
