//! A page about a rejected step: its receipt, and a picture of the laws of its rows.

use lcplab_lcp::Level;
use lcplab_page::escape::{xml_line, xml_text};
use lcplab_page::number::{counted, readable};

use super::{EngineStep, Receipt};

/// The size of the picture and its margins (px).
const WIDTH: f64 = 560.0;
const HEIGHT: f64 = 360.0;
const MARGIN: f64 = 60.0;

impl Receipt {
    /// The page as HTML; whether its folder has fewer rows that show the same error.
    pub(super) fn page(&self, has_shrunk: bool) -> String {
        let step = &self.step;
        let (engine, version) = (&step.source.engine, &step.source.version);
        let scene = if step.source.name.is_empty() { "a scene" } else { &step.source.name };
        let engine = format!("{engine} {version}");
        let time = readable(step.source.time, 4);
        let title = format!("{}: a rejected step of {scene} at {time} s", engine.trim());
        let mut files = vec!["frame.json, frame.x.json      the problem and the engine\'s answer"];
        if has_shrunk {
            files.push("shrunk.json, shrunk.x.json    fewer rows that show the same error");
        }
        files.push("lcplab receipts frame.json    prints this receipt again");
        include_str!("page.html")
            .replace("{title}", &xml_line(&title))
            .replace("{files}", &xml_text(&files.join("\n")))
            .replace("{receipt}", &xml_text(&self.text()))
            .replace("{figure}", &picture(step, self.rejected().and_then(|finding| finding.row)))
    }
}

/// The force x of each row of a contact, limit or equation, and the row velocity w, as SVG.
///
/// Rows of friction are left out, because their law is not in this plane.
fn picture(step: &EngineStep, worst: Option<usize>) -> String {
    let (x, w) = (&step.answer.forces, step.remaining());
    let is_shown =
        |&i: &usize| step.friction.index[i].is_none() && x[i].is_finite() && w[i].is_finite();
    let rows: Vec<usize> = (0..step.len()).filter(is_shown).collect();
    if rows.is_empty() {
        return String::new();
    }
    let across = Axis::of(rows.iter().map(|&i| x[i]), MARGIN, WIDTH - 20.0);
    let up = Axis::of(rows.iter().map(|&i| w[i]), HEIGHT - MARGIN, 20.0);
    let (unit_x, unit_w) = match step.gauss.level {
        Some(Level::Acceleration) => ("N", "m/s²"),
        _ => ("N s", "m/s"),
    };
    let mut marks = String::new();
    for &i in &rows {
        let (right, down) = (across.place(x[i]), up.place(w[i]));
        let is_worst = worst == Some(i);
        let style = format!("style=\"fill: var(--{})\"", if is_worst { "bad" } else { "row" });
        let label = match step.rows.get(i) {
            Some(row) if !row.label.is_empty() => xml_line(&row.label),
            _ => format!("row {i}"),
        };
        let circle = format!("<circle cx=\"{right:.1}\" cy=\"{down:.1}\" r=\"4\" {style}>");
        marks += &format!("{circle}<title>{label}</title></circle>");
        if is_worst {
            let side = if right > WIDTH / 2.0 { "end" } else { "start" };
            let at = format!("x=\"{right:.1}\" y=\"{:.1}\" text-anchor=\"{side}\"", down - 8.0);
            marks += &format!("<text {at} {style}>{label}</text>");
        }
    }
    let (left, right, top, bottom) = (MARGIN, WIDTH - 20.0, 20.0, HEIGHT - MARGIN);
    let (zero_x, zero_w) = (across.place(0.0), up.place(0.0));
    let line = "stroke=\"currentColor\" style=\"color: var(--pale)\"";
    format!(
        "<h2>Forces and row velocities</h2>
<svg viewBox=\"0 0 {WIDTH} {HEIGHT}\" role=\"img\" \
         aria-label=\"forces and velocities of {}\">
<line x1=\"{left}\" x2=\"{right}\" y1=\"{zero_w:.1}\" y2=\"{zero_w:.1}\" {line}/>
<line x1=\"{zero_x:.1}\" x2=\"{zero_x:.1}\" y1=\"{top}\" y2=\"{bottom}\" {line}/>
<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">force x of a row ({unit_x}): {across}</text>
<text transform=\"translate(24 {}) rotate(-90)\" text-anchor=\"middle\">w ({unit_w}): {up}</text>
{marks}
</svg>
<p>The lines are x = 0 and w = 0. A contact or a limit obeys its law on two half lines: it pushes
(x &gt; 0, w = 0), or it opens (x = 0, w &gt; 0). An equation obeys its law at w = 0. Rows of
friction are not shown.</p>",
        counted(rows.len(), "row"),
        WIDTH / 2.0,
        HEIGHT - 30.0,
        HEIGHT / 2.0,
    )
}

/// Values from `least` to `most` on a line of pixels that also shows 0.
struct Axis {
    least: f64,
    most: f64,
    /// The pixels of the smallest and of the largest number on the line.
    ends: (f64, f64),
}

impl Axis {
    fn of(values: impl Iterator<Item = f64> + Clone, first: f64, last: f64) -> Axis {
        let least = values.clone().fold(f64::INFINITY, f64::min);
        let most = values.fold(f64::NEG_INFINITY, f64::max);
        Axis { least, most, ends: (first, last) }
    }

    fn place(&self, value: f64) -> f64 {
        let (least, most) = (self.least.min(0.0), self.most.max(0.0));
        let span = if most > least { most - least } else { 1.0 };
        self.ends.0 + (value - least) / span * (self.ends.1 - self.ends.0)
    }
}

impl std::fmt::Display for Axis {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} to {}", readable(self.least, 3), readable(self.most, 3))
    }
}
