//! Animations on a page: scenes side by side, controls, and below them time plots with a cursor.
//! Without a script, or in print, a strip of frames replaces each scene.

use askama::Template;

use crate::escape::html;

/// An animation, drawn: everything that a page plays.
#[derive(Debug, Clone, PartialEq)]
pub struct DrawnAnimation {
    /// The finding that it shows; may be empty.
    pub title: String,
    /// The number of panes side by side.
    pub columns: usize,
    /// The width and height of a pane in px.
    pub size: (f64, f64),
    /// The times of the frames (s).
    pub times: Vec<f64>,
    /// The panes.
    pub panes: Vec<Pane>,
    /// Quantities over time, with one curve per pane.
    pub charts: Vec<Chart>,
    /// Some frames of each pane as an SVG document, for print and for browsers without scripts.
    pub strips: Vec<String>,
    /// The data for the script, as one JSON object.
    pub data: String,
}

/// One pane of an animation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pane {
    /// The pane's name.
    pub name: String,
    /// The color of its curves, such as `#0072b2`.
    pub color: String,
    /// The static background, as markup in px.
    pub backdrop: String,
    /// The outcome, in a sentence.
    pub description: String,
    /// Whether it has more than one instant, and so a curve.
    pub has_curve: bool,
}

/// A quantity over time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// The quantity.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The curves as an SVG element, for a page with the same colors.
    pub svg: String,
}

/// A numbered animation with its caption.
#[derive(Debug, Clone)]
pub struct Player {
    /// The animation.
    pub animation: DrawnAnimation,
    /// The finding that it shows.
    pub caption: String,
    /// Files with its data: the name of each link and its address, relative to the page.
    pub files: Vec<(String, String)>,
}

/// Playback speeds: simulated seconds per second.
pub const SPEEDS: [f64; 7] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625];
/// The shortest duration (s) that an animation should have, if slow motion can achieve it.
const LONG_ENOUGH: f64 = 4.0;

/// The fastest of [`SPEEDS`] that makes a motion long enough to watch; never faster than real time.
///
/// ```
/// use lcplab_page::page::speed;
///
/// assert_eq!((speed(10.0), speed(1.0), speed(1e-9)), (1.0, 0.25, 0.015625));
/// ```
pub fn speed(duration: f64) -> f64 {
    let long_enough = |speed: &&f64| duration / **speed >= LONG_ENOUGH;
    SPEEDS.iter().find(long_enough).copied().unwrap_or(SPEEDS[SPEEDS.len() - 1])
}

#[derive(Template)]
#[template(path = "player.html")]
struct View<'a> {
    number: usize,
    player: &'a Player,
    title: &'a str,
    caption: String,
    columns: usize,
    size: (f64, f64),
    panes: &'a [Pane],
    charts: &'a [Chart],
    strips: &'a [String],
    speeds: Vec<(f64, String, bool)>,
    last: usize,
    data: String,
}

/// The animation as HTML.
pub(super) fn rendered(
    player: &Player,
    number: usize,
    caption: String,
) -> std::result::Result<String, String> {
    let animation = &player.animation;
    let own = speed(animation.times.last().copied().unwrap_or(0.0));
    let view = View {
        number,
        player,
        title: &animation.title,
        caption,
        columns: animation.columns,
        size: animation.size,
        panes: &animation.panes,
        charts: &animation.charts,
        strips: &animation.strips,
        speeds: SPEEDS.map(|speed| (speed, name(speed), speed == own)).into(),
        last: animation.times.len().saturating_sub(1),
        data: animation.data.replace('<', "\\u003c"),
    };
    view.render().map_err(|error| error.to_string())
}

/// The label of a speed: `1×`, `1⁄4×`.
fn name(speed: f64) -> String {
    match speed {
        1.0 => "1×".into(),
        slow => html(&format!("1/{}×", 1.0 / slow)),
    }
}
