//! The strip: several instants of a motion on one sheet.

use super::ground::{self, Patch};
use super::ink::{Ink, tenth};
use super::layout::{LABEL, Layout, Lens, Window};
use super::solid::Solid;
use super::{Camera, Force, Frame, Origin, View, arrow, depth, extent, joint};
use crate::body::{Body, Mass, State};
use crate::csv;
use crate::number::readable;
use crate::plot::Figure;
use crate::plot::canvas::{Anchor, Canvas, escape, hex};
use crate::plot::round_step;
use crate::plot::style::{self, EDGE, FAINT_INK, GRID, INK, TEXT};
use crate::scene::Scene;

/// The space above the frames in px, for the title and the scales.
const TOP: f64 = 62.0;
/// The vertical center of the line of scales in px.
const SCALES: f64 = 48.0;
/// The height of a further line of scales in px.
const LINE: f64 = 20.0;
/// The minimum length of the scale bar as a fraction of a frame's width.
const BAR: f64 = 0.3;

/// A frame with more forces does not show their sizes.
const FEW: usize = 6;

/// The opacity of the earlier frames in a thumbnail.
const FAINT: f64 = 0.3;

/// Whether forces are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Arrows {
    /// No forces.
    Hidden,
    /// The forces of the frames, and the contact points.
    Shown,
    /// The same with the sizes of the forces, if they are few, and the names of the bodies.
    Labeled,
}

/// Several instants of a motion side by side, seen by one camera at one scale.
///
/// ```
/// use lcplab::{animation::{Frame, Strip}, plot::Figure};
/// use lcplab::scene::Scene;
///
/// let scene = Scene::load("stack")?;
/// let strip = Strip::new(&scene, vec![Frame::start(&scene)]);
/// assert!(strip.svg().starts_with("<svg "));
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Strip {
    /// The figure's short name.
    pub id: String,
    /// The figure's title.
    pub title: String,
    /// The figure's caption.
    pub caption: String,
    /// The scene.
    pub scene: Scene,
    /// Its instants; those with states that are not finite are not drawn.
    pub frames: Vec<Frame>,
    /// The view.
    pub view: View,
    /// Whether forces are drawn.
    pub arrows: Arrows,
    /// The text above each frame; its time by default.
    pub labels: Vec<String>,
    /// The instants of other strips with which it shares the scales.
    pub others: Vec<Frame>,
}

impl Strip {
    /// A strip with the scene's title and best view, without forces.
    pub fn new(scene: &Scene, frames: Vec<Frame>) -> Self {
        Strip {
            id: "frames".into(),
            title: scene.title.clone(),
            caption: String::new(),
            view: View::of(scene, &frames),
            scene: scene.clone(),
            frames,
            arrows: Arrows::Hidden,
            labels: Vec::new(),
            others: Vec::new(),
        }
    }

    /// The same with another short name, for pages with several strips.
    pub fn named(self, id: &str) -> Self {
        Strip { id: id.into(), ..self }
    }

    /// The same with a caption, a sentence that says what the reader should see.
    pub fn with_caption(self, words: &str) -> Self {
        Strip { caption: words.into(), ..self }
    }

    /// The same with the forces drawn.
    ///
    /// ```
    /// use lcplab::animation::{Arrows, Frame, Strip};
    /// use lcplab::scene::Scene;
    ///
    /// let scene = Scene::load("stack")?;
    /// let strip = Strip::new(&scene, vec![Frame::start(&scene)])
    ///     .named("stack")
    ///     .with_caption("The boxes at the start.")
    ///     .with_forces();
    /// assert_eq!(strip.id, "stack");
    /// assert_eq!(strip.caption, "The boxes at the start.");
    /// assert!(matches!(strip.arrows, Arrows::Shown));
    /// # Ok::<(), lcplab::error::Error>(())
    /// ```
    pub fn with_forces(self) -> Self {
        Strip { arrows: Arrows::Shown, ..self }
    }

    /// The first frame without a sheet, in a box of this width and height (px), with a group for
    /// each body; empty without frames.
    pub(crate) fn still(&self, (width, height): (f64, f64)) -> String {
        let Some(frame) = self.frames.iter().find(|frame| frame.is_finite()) else {
            return String::new();
        };
        let camera = Camera::new(self.view);
        let landmarks = extent::landmarks(&self.scene, std::slice::from_ref(frame));
        let patches = ground::patches(&self.scene, &landmarks);
        let window = ground::window(&camera, landmarks, &patches);
        let layout = Layout::single(&window, width, height);
        let lens = layout.lens(camera, &window);
        format!(
            "<g transform=\"translate(0 {:.1}) scale(0.1)\" stroke=\"{}\" stroke-width=\"6\" \
             stroke-linejoin=\"round\">\n{}</g>\n{}",
            height - layout.height,
            hex((INK.0, INK.1, INK.2)),
            self.frame(frame, &patches, &lens, None, true),
            self.names(frame, &lens, height - layout.height)
        )
    }

    /// All frames over each other without a sheet, the earlier ones fainter, as an SVG document of
    /// this width and height (px).
    pub(crate) fn thumbnail(&self, (width, height): (f64, f64)) -> String {
        let frames: Vec<_> = self.frames.iter().filter(|frame| frame.is_finite()).collect();
        let all: Vec<Frame> = frames.iter().map(|frame| (*frame).clone()).collect();
        let camera = Camera::new(self.view);
        let landmarks = extent::landmarks(&self.scene, &all);
        let patches = ground::patches(&self.scene, &landmarks);
        let window = ground::window(&camera, landmarks, &patches);
        let layout = Layout::single(&window, width, height);
        let lens = layout.lens(camera, &window);
        let last = frames.len().saturating_sub(1);
        let picture = |(k, frame): (usize, &&Frame)| {
            let opacity = if k == last { 1.0 } else { FAINT };
            let patches = if k == 0 { &patches[..] } else { &[] };
            let drawn = self.frame(frame, patches, &lens, None, false);
            format!("<g opacity=\"{opacity}\">\n{drawn}</g>\n")
        };
        format!(
            "<svg viewBox=\"0 0 {width} {height}\" xmlns=\"http://www.w3.org/2000/svg\" \
             aria-hidden=\"true\"><g transform=\"translate(0 {:.1}) scale(0.1)\" fill=\"none\" \
             stroke=\"{}\" stroke-width=\"6\" stroke-linejoin=\"round\" stroke-linecap=\"round\">\n\
             {}</g></svg>",
            0.5 * (height - layout.height),
            hex((INK.0, INK.1, INK.2)),
            frames.iter().enumerate().map(picture).collect::<String>()
        )
    }

    /// The names of the moving bodies, at their centers.
    fn names(&self, frame: &Frame, lens: &Lens, top: f64) -> String {
        let bodies = self.scene.bodies.iter().zip(&frame.states);
        let moving = bodies.filter(|(body, _)| body.mass != Mass::Fixed);
        let name = |(body, state): (&Body, &State)| {
            let (x, y) = lens.place(&state.pose.p);
            format!(
                "<text x=\"{x:.1}\" y=\"{:.1}\" text-anchor=\"middle\" font-size=\"{TEXT}\" fill=\"{}\">{}</text>\n",
                y + top + 5.0,
                hex((INK.0, INK.1, INK.2)),
                escape(&body.name)
            )
        };
        moving.map(name).collect()
    }

    /// The names of several moving bodies, left of them; empty if these have no space there.
    fn names_beside(&self, frame: &Frame, lens: &Lens) -> String {
        let boxes = extent::boxes(&self.scene, frame, lens);
        let mut out = String::new();
        for (body, [left, _, top, bottom]) in &boxes {
            let (name, right, middle) =
                (&self.scene.bodies[*body].name, left - 6.0, 0.5 * (top + bottom));
            let start = right - style::width(name, TEXT);
            let covers = |(_, [l, r, t, b]): &(usize, [f64; 4])| {
                start < *r && *l < right && middle - 8.0 < *b && *t < middle + 8.0
            };
            if boxes.len() < 2 || start < 0.0 || boxes.iter().any(covers) {
                return String::new();
            }
            out += &format!(
                "<text x=\"{right:.1}\" y=\"{:.1}\" text-anchor=\"end\" font-size=\"{TEXT}\" fill=\"{}\">{}</text>\n",
                middle + 5.0,
                hex((INK.0, INK.1, INK.2)),
                escape(name)
            );
        }
        out
    }

    fn description(&self, frames: &[Frame]) -> String {
        let (Some(first), Some(last)) = (frames.first(), frames.last()) else {
            return "no instants".into();
        };
        format!(
            "{} instants from {} s to {} s, seen {}",
            frames.len(),
            readable(first.time, 3),
            readable(last.time, 3),
            self.view.name()
        )
    }

    /// One frame in tenths of a px.
    fn frame(
        &self,
        frame: &Frame,
        patches: &[Patch],
        lens: &Lens,
        arrows: Option<(f64, &[f64])>,
        grouped: bool,
    ) -> String {
        let mut ink = Ink::new(lens);
        ink.groups_bodies = grouped;
        for patch in patches {
            ink.ground(patch);
        }
        let bodies = self.scene.bodies.iter().zip(&frame.states).enumerate();
        let dot = joint::dot(&self.scene, lens) / lens.scale;
        let mut solids: Vec<_> =
            bodies.flat_map(|(k, (body, state))| Solid::of(k, body, &state.pose, dot)).collect();
        solids.extend(joint::rods(&self.scene, frame, joint::rod(&self.scene, lens) / lens.scale));
        let order = depth::order(&lens.camera, &solids);
        let painted: Vec<_> = order.into_iter().map(|k| &solids[k]).collect();
        ink.solids(&self.scene.bodies, &frame.heat, &painted);
        if let Some((newton, most)) = arrows {
            ink.raw(&arrow::markup(&frame.forces, lens, newton));
            if self.arrows == Arrows::Labeled && frame.forces.len() <= FEW {
                let boxes = extent::boxes(&self.scene, frame, lens);
                ink.raw(&arrow::sizes(&frame.forces, lens, newton, most, &boxes));
            }
        }
        ink.marks(&joint::marks(&self.scene, frame));
        ink.finish()
    }

    /// The scale bar, and an arrow of a round length for each origin, in lines of this width.
    fn scales(
        &self,
        frames: &[Frame],
        lens: &Lens,
        arrows: Option<(f64, &[f64])>,
        width: f64,
    ) -> Vec<Scale> {
        let metres = round_step(BAR * lens.width / lens.scale);
        let bar = format!("{} m", readable(metres, 2));
        let mut scales = vec![(None, metres * lens.scale, bar)];
        if let Some((newton, most)) = arrows {
            let drawn = |force: &Force| force.force.norm() * newton >= arrow::SHORTEST;
            let forces = || frames.iter().flat_map(|frame| &frame.forces).filter(|own| drawn(own));
            let acts = |origin: &Origin| forces().any(|force| force.origin == *origin);
            scales.extend(Origin::ALL.into_iter().filter(acts).map(|origin| {
                let most = most[origin as usize];
                let round = round_step(0.4 * most);
                let words = format!("{} {} {}", origin.name(), readable(round, 2), origin.unit());
                (Some(origin), round / most * newton, words)
            }));
        }
        let (mut x, mut line) = (EDGE, 0);
        let place = |(origin, length, words): (Option<Origin>, f64, String)| {
            let total = length + 8.0 + style::width(&words, TEXT);
            if x + total > width && x > EDGE {
                (x, line) = (EDGE, line + 1);
            }
            let at = (x, line);
            x += total + 22.0;
            Scale { origin, length, words, at }
        };
        scales.into_iter().map(place).collect()
    }
}

/// A bar of a length, or an arrow of a force, with its words.
struct Scale {
    /// `None` for the bar.
    origin: Option<Origin>,
    length: f64,
    words: String,
    /// Its left end (px), and its line.
    at: (f64, usize),
}

impl Scale {
    /// Draws it, lower by this distance (px).
    fn draw(&self, canvas: &mut Canvas, lower: f64) {
        let (x, y) = (self.at.0, SCALES + lower + LINE * self.at.1 as f64);
        match self.origin {
            None => canvas.raw(&format!(
                "<path class=\"scale\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.4\" \
                 d=\"M{x} {:.1}v8m0 -4h{:.2}m0 -4v8\"/>\n",
                hex((INK.0, INK.1, INK.2)),
                y - 4.0,
                self.length
            )),
            Some(origin) => {
                let arrow = arrow::sample(origin, (x, y), self.length);
                canvas.raw(&format!("<g transform=\"scale(0.1)\">{arrow}</g>\n"));
            }
        }
        let at = (x + self.length + 8.0, y + 5.0);
        canvas.text(at, Anchor::Start, TEXT, FAINT_INK, &self.words);
    }
}

impl Figure for Strip {
    fn id(&self) -> &str {
        &self.id
    }

    fn title(&self) -> &str {
        &self.title
    }

    fn caption(&self) -> &str {
        &self.caption
    }

    fn drawn(&self, width: f64, id: &str) -> String {
        let label = |(k, frame): (usize, &Frame)| {
            let time = || format!("{} s", readable(frame.time, 3));
            self.labels.get(k).cloned().unwrap_or_else(time)
        };
        let finite = || self.frames.iter().enumerate().filter(|(_, frame)| frame.is_finite());
        let frames: Vec<Frame> = finite().map(|(_, frame)| frame.clone()).collect();
        let labels: Vec<String> = finite().map(label).collect();
        let widest = labels.iter().map(|label| style::width(label, TEXT)).fold(0.0, f64::max);
        let camera = Camera::new(self.view);
        let mut all: Vec<Frame> = frames.iter().chain(&self.others).cloned().collect();
        let most = arrow::normalize(&mut all);
        let count = frames.len();
        let frames = &all[..count];
        let landmarks = extent::landmarks(&self.scene, &all);
        let patches = ground::patches(&self.scene, &landmarks);
        let window = ground::window(&camera, landmarks, &patches);
        let lens = |window: &Window| Layout::new(window, width, count, widest).lens(camera, window);
        let first = lens(&window);
        let shown = self.arrows != Arrows::Hidden && most.iter().any(|most| *most > 0.0);
        let newton = if shown { arrow::scale(1.0, &first) } else { 0.0 };
        // The picture contains the arrows.
        let window = window.containing(arrow::tips(all.iter(), 1.0, &first, newton));
        let layout = Layout::new(&window, width, count, widest);
        let lens = lens(&window);
        let newton = shown.then_some(newton * lens.scale / first.scale);

        let arrows = newton.map(|newton| (newton, &most[..]));
        let scales = self.scales(frames, &lens, arrows, width - EDGE);
        let top = TOP + LINE * scales.last().map_or(0, |scale| scale.at.1) as f64;
        let height = top + layout.total() + EDGE;
        let (mut canvas, lower) = Canvas::titled(width, height, &self.title);
        let top = top + lower;
        scales.iter().for_each(|scale| scale.draw(&mut canvas, lower));
        for (k, (frame, label)) in frames.iter().zip(&labels).enumerate() {
            let (x, y) = layout.corner(k, top);
            canvas.text((x + 2.0, y - LABEL + 14.0), Anchor::Start, TEXT, FAINT_INK, label);
            canvas.raw(&format!(
                "<g class=\"instant\" transform=\"translate({x:.1} {y:.1}) scale(0.1)\" \
                 fill=\"none\" stroke=\"{}\" stroke-width=\"6\" stroke-linejoin=\"round\" \
                 stroke-linecap=\"round\">\n\
                 <path stroke=\"{}\" d=\"M0 0h{w}v{h}h-{w}z\"/>\n{}</g>\n\
                 <g transform=\"translate({x:.1} {y:.1})\">{}</g>\n",
                hex((INK.0, INK.1, INK.2)),
                hex((GRID.0, GRID.1, GRID.2)),
                self.frame(frame, &patches, &lens, arrows, false),
                if self.arrows == Arrows::Labeled {
                    self.names_beside(frame, &lens)
                } else {
                    String::new()
                },
                w = tenth(lens.width),
                h = tenth(lens.height),
            ));
        }
        canvas.finish(id, &self.title, &self.description(frames))
    }

    /// One record per frame and body: its pose.
    fn csv(&self) -> String {
        let mut out = String::new();
        csv::record(&mut out, COLUMNS);
        for frame in &self.frames {
            for (body, state) in self.scene.bodies.iter().zip(&frame.states) {
                let (p, q) = (state.pose.p, state.pose.q);
                let numbers = [p.x, p.y, p.z, q.w, q.i, q.j, q.k].map(csv::number);
                let names = [csv::number(frame.time), body.name.clone()];
                csv::record(&mut out, names.into_iter().chain(numbers));
            }
        }
        out
    }
}

const COLUMNS: [&str; 9] = ["time (s)", "body", "x (m)", "y (m)", "z (m)", "qw", "qx", "qy", "qz"];
