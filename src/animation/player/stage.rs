//! The stage: the dimensions of the picture, and its fixed parts.

use std::fmt::Write;

use nalgebra::Vector3;

use super::Animation;
use super::chart::WIDTH;
use crate::animation::Camera;
use crate::animation::arrow;
use crate::animation::colors::HEAVY;
use crate::animation::extent::Landmark;
use crate::animation::frame::Origin;
use crate::animation::ground::{self, Patch};
use crate::animation::ink::{Ink, heaviest};
use crate::animation::layout::{Layout, Lens, Window};
use crate::number::readable;
use crate::plot::canvas::hex;
use crate::plot::round_step;
use crate::plot::style::width;

/// The minimum and maximum height of a stage in px.
const HEIGHT: (f64, f64) = (250.0, 420.0);
/// The width of a single stage, so that its scales can be read on a phone, and the part of that
/// width for these scales.
const SINGLE: f64 = 560.0;
const READABLE: f64 = 1.0 / 1.6;
/// The gap between stages in px.
const GAP: f64 = 10.0;
/// The space below the motion for the scales, in px.
const FOOT: f64 = 22.0;
/// The space for the mass of the dark body, above the scales, in px.
const LINE: f64 = 17.0;
/// In a narrower pane the arrows of the other forces stand above that of the first, in px.
const ONE_LINE: f64 = 320.0;
/// Size of the scales' text in px.
const SMALL: f64 = 11.0;
/// The minimum length of the scale bar, as a fraction of the width.
const BAR: f64 = 0.12;
/// The fraction of instants whose largest force is drawn in full: arrows of impacts leave the
/// picture, so that resting forces stay visible.
const USUAL: f64 = 0.9;

pub(super) struct Stage {
    pub lens: Lens,
    /// px per newton, if there are forces.
    pub newton: Option<f64>,
    /// The ground.
    pub patches: Vec<Patch>,
    /// The pivot of a rotating camera (m, world): the center of the picture, at the depth of the
    /// motion.
    pub pivot: Vector3<f64>,
    origins: Vec<Origin>,
    /// The force (N) whose arrow has the standard length.
    usual: f64,
    /// The mass (kg) of the dark body, if one outweighs all others.
    heaviest: Option<f64>,
    /// Whether the kinds of forces take two lines.
    is_narrow: bool,
}

impl Stage {
    pub fn new(animation: &Animation, camera: Camera, landmarks: Vec<Landmark>) -> Self {
        let patches = ground::patches(&animation.scene, &landmarks);
        let depths = landmarks.iter().map(|mark| camera.project(&mark.point).z);
        let depth = depths.sum::<f64>() / landmarks.len().max(1) as f64;
        let window = ground::window(&camera, landmarks, &patches);
        let columns = animation.columns() as f64;
        let across = ((WIDTH - (columns - 1.0) * GAP) / columns).round();
        let highest = (0.75 * across).clamp(HEIGHT.0, HEIGHT.1);
        let (across, highest) = if columns == 1.0 { (SINGLE, HEIGHT.0) } else { (across, highest) };
        let samples = || animation.recordings.iter().flat_map(|recording| &recording.samples);
        let is_heated = samples().any(|sample| !sample.frame.heat.is_empty());
        let heaviest = heaviest(&animation.scene.bodies).filter(|_| !is_heated);
        let heaviest = heaviest.map(|k| animation.scene.bodies[k].mass.mass());
        let acts = |origin: &Origin| {
            samples().any(|sample| sample.frame.forces.iter().any(|force| force.origin == *origin))
        };
        let origins: Vec<Origin> = Origin::ALL.into_iter().filter(acts).collect();
        let is_narrow = (across < ONE_LINE || columns == 1.0) && origins.len() > 1;
        let foot = FOOT + if heaviest.is_some() || is_narrow { LINE } else { 0.0 };
        let foot = if columns == 1.0 { foot / READABLE } else { foot };
        let lens = |window: &Window| Layout::single(window, across, highest).lens(camera, window);
        let largest =
            |sample: &super::Sample| arrow::largest(std::slice::from_ref(&sample.frame), "N");
        let mut forces: Vec<f64> = samples().map(largest).filter(|force| *force > 0.0).collect();
        forces.sort_by(f64::total_cmp);
        let usual = forces.get((USUAL * forces.len() as f64) as usize).copied().unwrap_or(0.0);
        // The picture contains the usual arrows.
        let first = lens(&window);
        let newton = if usual > 0.0 { arrow::scale(usual, &first) } else { 0.0 };
        let frames = samples().map(|sample| &sample.frame);
        let window = window.containing(arrow::tips(frames, usual, &first, newton));
        let last = lens(&window);
        let newton = (usual > 0.0).then_some(newton * last.scale / first.scale);
        let lens = last.with_foot(foot);
        let (x, y) = lens.middle();
        let pivot = camera.world(&Vector3::new(x, y, depth));
        Stage { lens, newton, patches, pivot, origins, usual, heaviest, is_narrow }
    }

    /// The ground and the scales, in px.
    pub fn backdrop(&self) -> String {
        let mut ink = Ink::new(&self.lens);
        for patch in &self.patches {
            ink.ground(patch);
        }
        format!(
            "<g class=\"soil\" fill=\"none\" transform=\"scale(0.1)\">{}</g>\n<g class=\"scales\">{}</g>\n",
            ink.finish(),
            self.scales()
        )
    }

    /// A bar of a round length, the mass of the dark body, and an arrow of a round force for each
    /// origin.
    fn scales(&self) -> String {
        let y = self.lens.height - 11.0;
        let metres = round_step(BAR * self.lens.width / self.lens.scale);
        let length = metres * self.lens.scale;
        let label = format!("{} m", readable(metres, 2));
        let mut out = format!(
            "<path class=\"bar\" d=\"M10 {:.1}v6m0 -3h{length:.1}m0 -3v6\"/>\
             <text x=\"{:.1}\" y=\"{:.1}\">{label}</text>",
            y - 3.0,
            length + 15.0,
            y + 4.0
        );
        let mut second = 10.0; // where the upper line begins
        if let Some(mass) = self.heaviest {
            let (words, color, y) = (format!("{} kg", readable(mass, 2)), hex(HEAVY), y - LINE);
            second = 25.0 + width(&words, SMALL) + 16.0;
            let _ = write!(
                out,
                "<path style=\"fill:{color};stroke:none\" d=\"M10 {:.1}h10v10h-10z\"/>\
                 <text x=\"25\" y=\"{:.1}\">{words}</text>",
                y - 5.0,
                y + 4.0
            );
        }
        let Some(newton) = self.newton else { return out };
        let room = self.lens.width * if self.lens.width == SINGLE { READABLE } else { 1.0 };
        let mut x = length + 15.0 + width(&label, SMALL) + 16.0;
        let force = round_step(0.35 * self.usual);
        out += "<g class=\"forces\">";
        for (k, origin) in self.origins.iter().enumerate() {
            let y = if self.is_narrow && k > 0 { y - LINE } else { y };
            if self.is_narrow && k == 1 {
                x = second;
            }
            let long = force * newton;
            let number = if k == 0 { format!(" {} N", readable(force, 2)) } else { String::new() };
            let words = format!("{}{number}", origin.name());
            if x + long + 5.0 + width(&words, SMALL) > room {
                break;
            }
            let arrow = arrow::sample(*origin, (x, y), long);
            let _ = write!(
                out,
                "<g class=\"{}\" transform=\"scale(0.1)\">{arrow}</g>\
                 <text x=\"{:.1}\" y=\"{:.1}\">{words}</text>",
                origin.name(),
                x + long + 5.0,
                y + 4.0
            );
            x += long + 5.0 + width(&words, SMALL) + 12.0;
        }
        out + "</g>\n"
    }
}
