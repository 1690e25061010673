//! A film on a page: stages side by side, controls, and the measures beneath with a cursor. Without
//! script, or in print, a strip of frames stands for each take.

use askama::Template;

use super::Origin;
use crate::escape::html;

/// A film, drawn: what a page plays, whatever it is of.
#[derive(Debug, Clone, PartialEq)]
pub struct Reel {
    /// How many takes stand side by side.
    pub columns: usize,
    /// The width and height of a take's stage in px.
    pub size: (f64, f64),
    /// The instants (s).
    pub times: Vec<f64>,
    /// The takes.
    pub panes: Vec<Pane>,
    /// What is measured over time, a curve a take.
    pub charts: Vec<Chart>,
    /// Some instants of each take as an SVG document, for print and where no script runs.
    pub strips: Vec<String>,
    /// All that the script needs, as one JSON object.
    pub data: String,
}

/// One take of a film.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pane {
    /// The take's name.
    pub name: String,
    /// The colour of its curves, `#0072b2`.
    pub color: String,
    /// What never moves, as markup in px.
    pub backdrop: String,
    /// How it went, in a sentence.
    pub description: String,
}

/// A measure over time.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Chart {
    /// What is measured.
    pub name: String,
    /// Its unit.
    pub unit: String,
    /// The curves as an SVG element, for a page that has the colours.
    pub svg: String,
}

/// A numbered film with its caption.
#[derive(Debug, Clone)]
pub struct Player {
    /// What is played.
    pub reel: Reel,
    /// What to see in it.
    pub caption: String,
    /// Files behind it: the name of the link and its address, relative to the page.
    pub files: Vec<(String, String)>,
    /// How it was obtained.
    pub origin: Option<Origin>,
}

/// Playing speeds: seconds of motion in a second.
pub const SPEEDS: [f64; 7] = [1.0, 0.5, 0.25, 0.125, 0.0625, 0.03125, 0.015625];
/// A film should take so many seconds, if slowing it down can do that.
const LONG_ENOUGH: f64 = 4.0;

/// The speed, of [`SPEEDS`], at which a motion is long enough to be seen: never faster than it is.
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

/// The film as HTML.
pub(super) fn rendered(
    player: &Player,
    number: usize,
    caption: String,
) -> std::result::Result<String, String> {
    let reel = &player.reel;
    let own = speed(reel.times.last().copied().unwrap_or(0.0));
    let view = View {
        number,
        player,
        caption,
        columns: reel.columns,
        size: reel.size,
        panes: &reel.panes,
        charts: &reel.charts,
        strips: &reel.strips,
        speeds: SPEEDS.map(|speed| (speed, name(speed), speed == own)).into(),
        last: reel.times.len().saturating_sub(1),
        data: reel.data.replace('<', "\\u003c"),
    };
    view.render().map_err(|error| error.to_string())
}

/// `1×`, `1⁄4×`.
fn name(speed: f64) -> String {
    match speed {
        1.0 => "1×".into(),
        slow => html(&format!("1/{}×", 1.0 / slow)),
    }
}
