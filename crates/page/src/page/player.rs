//! A film on a page: stages side by side, controls, and the measures beneath with a cursor. Without
//! script, or in print, a strip of frames stands for each take.

use askama::Template;

use super::Origin;
use super::markup::html;
use crate::plot::Figure;
use crate::plot::scene::{Film, Measure, Pane};

/// A numbered film with its caption.
#[derive(Debug, Clone)]
pub struct Player {
    /// What is played.
    pub film: Film,
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
/// use lcplab::report::page::speed;
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
    panes: Vec<Pane>,
    charts: Vec<(Measure, String)>,
    strips: Vec<String>,
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
    let Player { film, .. } = player;
    let times = film.times();
    let own = speed(times.last().copied().unwrap_or(0.0));
    let view = View {
        number,
        player,
        caption,
        columns: film.columns(),
        size: film.size(),
        panes: film.panes(),
        charts: film.measures().into_iter().map(|own| (own, film.chart(own))).collect(),
        strips: (0..film.takes.len()).map(|k| film.strip(k).svg()).collect(),
        speeds: SPEEDS.map(|speed| (speed, name(speed), speed == own)).into(),
        last: times.len().saturating_sub(1),
        data: film.data().replace('<', "\\u003c"),
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
