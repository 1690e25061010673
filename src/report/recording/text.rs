//! The text that `simulate` prints.

use nalgebra::Vector3;

use super::energy_totals::EnergyTotals;
use super::{NOT_ACCOUNTED, Record};
use crate::body::{Body, State};
use crate::lcp::friction::{Form, Law};
use crate::number::{counted, readable};
use crate::scene::{Resting, Scene, Scheme};
use crate::simulation::{Departure, Slip, momentum_sizes, unstable_springs};

/// Maximum number of bodies whose final state is printed.
const SHOWN: usize = 12;
/// Smaller violations of the laws of friction and impact, in percent, are not reported.
const MUCH: f64 = 1.0;
/// The same for impacts of schemes whose bodies turn between the approach and the bounce: the
/// velocity of the center of mass may be off by several times as much.
const MUCH_SPREAD: f64 = 0.25;
/// Smaller angles between friction and the direction opposite to sliding, in degrees, are not
/// reported.
const FRICTION_ANGLE: f64 = 5.0;
/// Smaller changes of the angular momentum, relative to that of all bodies, are not reported.
const TURNED: f64 = 1e-6;
/// What a run of a fixed number of sweeps prints for a law that it does not measure.
const NOT_MEASURED: &str = "not measured";
/// Smaller drifts and overlaps, relative to the scene's size, and smaller misalignments of joints
/// (rad) are not reported.
const DRIFT: f64 = 1e-3;

/// A smaller length (m), or change of the energy relative to it, is rounding.
const ROUNDING: f64 = 1e-12;

impl Record {
    /// The totals and remarks as text.
    pub fn text(&self) -> String {
        let mut text = format!("{}: {}\n", self.scene.name, self.scene.title);
        let states = [("at the end", self.states_text())];
        for (name, value) in self.totals().into_iter().chain(states).chain(self.remarks()) {
            text += &format!("{name:<13}{}\n", value.replace('\n', "\n             "));
        }
        text
    }

    /// What was measured over the whole run: a name and its value, which may have several lines.
    pub(crate) fn totals(&self) -> Vec<(&'static str, String)> {
        let [start, end] = [&self.first, &self.last].map(|motion| readable(motion.energy(), 6));
        let scheme = self.scene.step.scheme;
        let solver = self.solver().map_or_else(String::new, |solver| format!(", solver {solver}"));
        let mut totals = vec![
            ("scheme", format!("{}{solver}, dt {} s", scheme.name(), self.scene.step.dt)),
            ("friction", self.scene.contact.model.to_string()),
            ("steps", format!("{} ({} s)", self.steps, readable(self.last.time, 6))),
            ("problems", self.problems_in_words()),
            (
                "residual",
                match self.tally.solves {
                    0 => "–".into(),
                    _ => format!("at most {}", readable(self.tally.worst_residual, 2)),
                },
            ),
            ("energy", format!("{start} J at the start, {end} J at the end")),
            ("drift", self.drift_in_words()),
            ("penetration", format!("at most {} m", readable(self.worst_penetration, 3))),
            ("weight", self.carried_in_words()),
            ("laws", self.laws_in_words()),
            (
                "ledger",
                self.energy_totals.as_ref().map_or(NOT_ACCOUNTED.into(), EnergyTotals::text),
            ),
        ];
        if scheme == Scheme::Acceleration {
            let Resting { gap, speed, .. } = self.scene.resting();
            let [gap, speed] = [gap, speed].map(|most| readable(most, 2));
            let most = format!("gap at most {gap} m, separation speed at most {speed} m/s");
            totals.push(("resting", most));
        }
        totals
    }

    /// The change of the energy, and the largest errors of joints and contacts, in a sentence; only
    /// of what the scene has.
    pub(crate) fn finding(&self) -> String {
        let energy = self.energy_in_words();
        let error = |value: f64| match value <= ROUNDING {
            true => "not at all".into(),
            false => format!("by at most {} m", readable(value, 2)),
        };
        let drift = (!self.scene.constraints.is_empty()).then(|| {
            let size = self.size();
            let part = match self.worst_drift > ROUNDING && size > 0.0 {
                true => {
                    format!(
                        " ({} % of the scene's size)",
                        readable(100.0 * self.worst_drift / size, 2)
                    )
                }
                false => String::new(),
            };
            format!("joints drift {}{part}", error(self.worst_drift))
        });
        let overlap =
            self.touched.then(|| format!("bodies overlap {}", error(self.worst_penetration)));
        let parts: Vec<String> = [Some(energy), drift, overlap].into_iter().flatten().collect();
        let time = readable(self.last.time, 4);
        match &parts[..] {
            [first @ .., last] if !first.is_empty() => {
                format!("In {time}\u{a0}s {}, and {last}", first.join(", "))
            }
            parts => format!("In {time}\u{a0}s {}", parts.join("")),
        }
    }

    /// The range of the energy, without a full stop.
    fn energy_in_words(&self) -> String {
        let scale = self.first.energy().abs().max(self.last.energy().abs()).max(self.most_kinetic);
        let [least, most] = self.energy_changes;
        if most - least <= ROUNDING * scale {
            return "the energy stays the same".into();
        }
        let part = readable(100.0 * (most - least) / self.most_kinetic, 2);
        let part = match self.most_kinetic > 0.0 {
            true => format!(" ({part} % of the largest kinetic energy)"),
            false => String::new(),
        };
        format!("the energy varies over a range of {} J{part}", readable(most - least, 2))
    }

    /// The totals of a page: without those of contacts if there were none, without the ledger, and
    /// without what its lead and its tiles state.
    pub(crate) fn page_totals(&self) -> Vec<(&'static str, String)> {
        let is_shown = |name: &str| match name {
            "friction" | "penetration" | "laws" | "weight" => self.touched,
            "scheme" | "steps" | "energy" | "residual" => false,
            "drift" => self.worst_angular_drift > DRIFT,
            "problems" => self.tally.solves == 0,
            name => name != "ledger" || self.energy_totals.is_none(),
        };
        self.totals().into_iter().filter(|(name, _)| is_shown(name)).collect()
    }

    /// The work of each account of the energy ledger (J), without rounding errors; empty if the
    /// forces were not recorded.
    pub(crate) fn ledger(&self) -> Vec<(&'static str, f64)> {
        self.energy_totals.as_ref().map_or(Vec::new(), EnergyTotals::notable)
    }

    /// How well the energy ledger balances.
    pub(crate) fn balance(&self) -> String {
        self.energy_totals.as_ref().map_or_else(String::new, EnergyTotals::balance)
    }

    /// The number and the length of the steps, the scheme and the solver.
    pub(crate) fn run(&self) -> String {
        let solver = self.solver().map_or_else(String::new, |solver| format!(", solver {solver}"));
        let step = &self.scene.step;
        let steps = counted(self.steps, "step");
        format!("{steps} of {} s, scheme {}{solver}.", readable(step.dt, 3), step.scheme.name())
    }

    /// How to reduce the drift, in a sentence; empty if it is small.
    pub(crate) fn advice(&self) -> String {
        self.relative_drift().map_or_else(String::new, |(_, remedy)| format!(" Drift: {remedy}."))
    }

    /// The largest scaled residual of an answer.
    pub(crate) fn residual(&self) -> String {
        readable(self.tally.worst_residual, 2)
    }

    /// What needs attention: notes, warnings, a rejected answer, and why the run ended early.
    pub(crate) fn remarks(&self) -> Vec<(&'static str, String)> {
        let notes = self.notes().into_iter().map(|note| ("note", note));
        let warnings = self.warnings.texts().into_iter().map(|warning| ("warning", warning));
        let mut remarks: Vec<_> = notes.chain(warnings).collect();
        remarks.extend(self.refused.iter().map(|refused| ("rejected", refused.to_string())));
        if !self.conflict.is_empty() {
            let rows = self.conflict.join(", ");
            remarks.push(("conflict", format!("no forces satisfy these rows together: {rows}")));
        }
        remarks.extend(self.failure.iter().map(|failure| ("failed", failure.to_string())));
        remarks
    }

    /// The number of answers that the judge accepted, and of all problems.
    pub(crate) fn verdicts(&self) -> [usize; 2] {
        [self.tally.accepted, self.tally.solves]
    }

    fn problems_in_words(&self) -> String {
        match &self.scene.solver {
            solver if solver.fixed_sweeps && self.tally.solves == 0 => {
                format!(
                    "not judged: {} sweeps per step, without a tolerance",
                    solver.max_iterations
                )
            }
            _ => format!("{}, accepted by the judge {}", self.tally.solves, self.tally.accepted),
        }
    }

    fn laws_in_words(&self) -> String {
        let unit = if self.scene.step.scheme == Scheme::Acceleration { "N" } else { "N s" };
        let attraction = match self.scene.solver.fixed_sweeps {
            true => NOT_MEASURED.into(),
            false => format!("{} {unit}", readable(self.laws.attraction, 2)),
        };
        let gain = match self.energy_totals {
            Some(_) => format!("{} J", readable(self.laws.friction_gain, 2)),
            None => NOT_ACCOUNTED.into(),
        };
        let excess = readable(100.0 * self.laws.cone_excess, 2);
        format!(
            "tensile contact force {attraction}, friction excess {excess} %, friction gain {gain}"
        )
    }

    /// Notes on the settings, the start and the friction model.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = self.scene.notes();
        if self.first.penetration > DRIFT * self.scene.thinnest().unwrap_or(f64::INFINITY) {
            let depth = readable(self.first.penetration, 2);
            notes.push(format!("bodies overlap by {depth} m at the start"));
        }
        if self.scene.solver.fixed_sweeps {
            notes.push(
                "with solver.fixed_sweeps the direction of friction, restitution and momentum are \
                 not measured"
                    .into(),
            );
        }
        notes.extend(self.friction_in_words());
        notes.extend(self.departure_in_words());
        notes.extend(self.restitution_in_words());
        notes.extend(self.lost_bounces.in_words(&self.scene));
        notes.extend(self.turning_in_words());
        notes.extend(unstable_springs(&self.scene));
        notes
    }

    /// The deviation of friction from Coulomb's law, if it is large enough to report.
    fn friction_in_words(&self) -> Option<String> {
        let model = self.scene.contact.model;
        let pair = |bodies: [usize; 2]| {
            let [body, other] = bodies.map(|body| &self.scene.bodies[body].name);
            format!("Between {body:?} and {other:?}, friction of the model {model}")
        };
        let is_cone = matches!(model.form(), Form::Cone(_));
        let degrees = |slip: &Slip| slip.angle.unwrap_or(0.0).to_degrees();
        let angle =
            self.slips.friction_angle.filter(|slip| degrees(slip) > FRICTION_ANGLE && !is_cone);
        let angle = angle.map(|slip| {
            let what = "away from the direction opposite to the slip";
            (slip.bodies, format!("pointed up to {:.0}° {what}", degrees(&slip)))
        });
        let excess = self.slips.cone_excess.filter(|slip| 100.0 * slip.excess > MUCH);
        let excess = excess.map(|slip| {
            let percent = 100.0 * slip.excess;
            (slip.bodies, format!("was up to {percent:.0} % above Coulomb's limit"))
        });
        let mut says: Vec<String> = match (angle, excess) {
            (Some((bodies, angle)), Some((same, excess))) if bodies == same => {
                vec![format!("{} {angle} and {excess}", pair(bodies))]
            }
            (angle, excess) => {
                let own = angle.into_iter().chain(excess);
                own.map(|(bodies, what)| format!("{} {what}", pair(bodies))).collect()
            }
        };
        let total = self.slips.speed_error(&self.scene).map(|(body, error)| {
            let subject = match says.is_empty() {
                true => format!("The total difference of the model {model} from Coulomb's law"),
                false => "The total difference from Coulomb's law".into(),
            };
            format!(
                "{subject} is an impulse of about {} m/s times the mass of {:?}",
                readable(error, 2),
                self.scene.bodies[body].name
            )
        });
        says.extend(total);
        let creep = self.slips.notable_creep(&self.scene).map(|creep| {
            let [body, other] = creep.bodies.map(|body| &self.scene.bodies[body].name);
            let model =
                if says.is_empty() { format!("Under the model {model}, ") } else { String::new() };
            format!(
                "{model}{body:?} crept by {} m on {other:?}, at less than {} m/s, with {:.0} % of the friction force \
                 that Coulomb's law demands of a contact that slips",
                readable(creep.path.norm(), 2),
                readable(self.scene.resting().speed, 2),
                100.0 * creep.strength().max(0.0)
            )
        });
        says.extend(creep);
        let separation = match model.form() {
            Form::Cone(Law::Associated) => self.slips.notable_separation(&self.scene),
            _ => None,
        };
        if let Some(slip) = separation {
            let [body, other] = slip.bodies.map(|body| &self.scene.bodies[body].name);
            let speed = readable(slip.separation, 2);
            return Some(format!(
                "friction of the model {model} separates contacts that slide, at μ times the speed of the slip: \
                 {body:?} left {other:?} at up to {speed} m/s; the model coulomb-cone does not separate them"
            ));
        }
        if says.is_empty() {
            return None;
        }
        let scheme = self.scene.step.scheme;
        let remedy = match model.form() {
            _ if !scheme.poses_friction() => {
                "The scheme velocity with the model coulomb-cone satisfies Coulomb's law"
            }
            Form::Polygon { .. } => "More directions, or the model coulomb-cone, are more accurate",
            Form::Cone(_) => "Reduce solver.tolerance or raise solver.max_iterations",
            Form::Box => "The model coulomb-cone has the correct strength and direction",
        };
        says.push(remedy.into());
        Some(says.join(". ") + ".")
    }

    /// The motion of bodies that the forces at the start keep at rest.
    fn departure_in_words(&self) -> Option<String> {
        let Scene { bodies, contact, step, .. } = &self.scene;
        let Departure { body, distance, angle } = Departure::of(&self.scene, &self.states)?;
        let cause = match step.scheme {
            Scheme::Penalty => {
                "contacts of the scheme penalty are springs, and its friction is a damper: increase \
                 step.penalty.stiffness, step.penalty.damping and step.substeps, or use the scheme velocity"
            }
            Scheme::Soft => {
                "contacts of the scheme soft are springs: increase step.soft.contact_hertz and \
                 step.substeps, or use the scheme velocity"
            }
            Scheme::Xpbd => {
                "increase step.xpbd.sweeps and step.substeps, or use the scheme velocity"
            }
            Scheme::SequentialImpulses => {
                "the sweeps of a step do not balance the forces: increase step.sweeps, or use the scheme \
                 velocity"
            }
            _ if !matches!(contact.model.form(), Form::Cone(_)) => "use the model coulomb-cone",
            _ => "reduce solver.tolerance or raise solver.max_iterations",
        };
        Some(format!(
            "{:?} is {} m from its place at the start and turned by {:.0}°, although under Coulomb's law \
             contacts and joints keep all bodies at rest there; {cause}",
            bodies[body].name,
            readable(distance, 2),
            angle.to_degrees()
        ))
    }

    /// The impact that missed the coefficient of restitution by most, where that can be seen.
    fn restitution_in_words(&self) -> Option<String> {
        let least = match self.scene.step.scheme.spreads_impacts() {
            true => MUCH_SPREAD,
            false => MUCH,
        };
        let impact = self.worst_impact().filter(|impact| 100.0 * impact.error().abs() > least)?;
        let remedy = match self.scene.step.scheme {
            _ if !self.conflict.is_empty() => {
                "no impulses satisfy all rows of the step: reduce step.dt"
            }
            Scheme::Velocity | Scheme::Acceleration => {
                "the answer is not accurate enough: reduce solver.tolerance"
            }
            _ => "the schemes velocity and acceleration keep to it",
        };
        let [body, other] = impact.bodies.map(|body| &self.scene.bodies[body].name);
        let [parting, approach, due] =
            [impact.parting, impact.approach, impact.restitution * impact.approach]
                .map(|speed| readable(speed, 3));
        Some(format!(
            "{body:?} and {other:?} met at {approach} m/s in step {} and separated at {parting} m/s; \
             with the restitution {} it should be {due} m/s; {remedy}",
            impact.step, impact.restitution
        ))
    }

    /// The angular momentum produced by the contacts and joints of a scheme without an LCP. (A gear
    /// exerts a torque on the hinges of its wheels; sequential impulses push with the same rows as
    /// the velocity level.)
    fn turning_in_words(&self) -> Option<String> {
        let size = |states: &[State]| momentum_sizes(&self.scene, states)[1];
        let made = self.laws.internal_torque;
        let is_made = made > TURNED * size(&self.scene.states).max(size(&self.states));
        (is_made && self.scene.step.scheme.spreads_impacts()).then(|| {
            format!(
                "in one step the total angular momentum changed by {} N m s, although only contacts \
                 and joints between the bodies acted; the scheme {} does not conserve it, velocity \
                 does",
                readable(made, 2),
                self.scene.step.scheme.name()
            )
        })
    }

    /// The misalignment of joints, if it is large enough to report.
    fn misalignment_in_words(&self) -> String {
        let angle = self.worst_angular_drift;
        match angle > DRIFT {
            true => format!(" and {}°", readable(angle.to_degrees(), 2)),
            false => String::new(),
        }
    }

    fn drift_in_words(&self) -> String {
        let [drift, angle] = [readable(self.worst_drift, 3), self.misalignment_in_words()];
        let relative = self.relative_drift();
        let relative = relative.map_or_else(String::new, |(part, remedy)| {
            format!(", {part} % of the scene's size at the start; {remedy}")
        });
        format!("at most {drift} m{angle}{relative}")
    }

    /// The size of the scene (m) at the start, because a drift enlarges it.
    fn size(&self) -> f64 {
        let points = self.scene.states.iter().map(|state| state.pose.p);
        let size = points.clone().flat_map(|p| points.clone().map(move |q| (p - q).norm()));
        size.fold(0.0, f64::max).max(points.map(|p| p.norm()).fold(0.0, f64::max))
    }

    /// The drift in percent of the scene's size, and how to reduce it, if it is large enough to
    /// report.
    fn relative_drift(&self) -> Option<(String, &'static str)> {
        let part = self.worst_drift / self.size();
        if !(part > DRIFT && part.is_finite()) {
            return None;
        }
        let remedy = match self.scene.step.scheme {
            Scheme::Velocity | Scheme::SequentialImpulses if self.scene.step.baumgarte > 0.0 => {
                "a shorter step reduces it, and so does correcting more of it per step (step.baumgarte)"
            }
            Scheme::Velocity | Scheme::SequentialImpulses => {
                "step.baumgarte is the part of it to correct per step"
            }
            // Feedback cannot hold what rows of a nearly singular A throw apart.
            Scheme::Acceleration if self.has_diverged => {
                "the motion diverged: try a shorter step or the scheme velocity"
            }
            Scheme::Acceleration if self.scene.step.alpha == 0.0 => "set step.alpha to correct it",
            Scheme::Penalty => "a larger step.penalty.stiffness with more step.substeps reduces it",
            Scheme::Soft => "a larger step.soft.joint_hertz with more step.substeps reduces it",
            _ => "a shorter step reduces it",
        };
        Some((readable(100.0 * part, 2), remedy))
    }

    /// The moving bodies that the output lists, with their states, and the number of the others.
    pub(crate) fn listed(&self) -> (Vec<(&Body, &State)>, usize) {
        let bodies = self.scene.bodies.iter().zip(&self.states);
        let mut moving: Vec<_> = bodies.filter(|(body, _)| body.mass.dof() > 0).collect();
        let more = moving.len().saturating_sub(SHOWN);
        moving.truncate(SHOWN);
        (moving, more)
    }

    /// The current positions and velocities of the moving bodies.
    fn states_text(&self) -> String {
        let (moving, more) = self.listed();
        let vector = |v: &Vector3<f64>| {
            let short = |x: f64| match x.abs() {
                size if size < 1e5 => format!("{:>11.5}", if size < 5e-6 { 0.0 } else { x }),
                _ => format!("{:>11}", readable(x, 4)),
            };
            let parts = [v.x, v.y, v.z].map(short);
            parts.join(" ")
        };
        let mut text = String::from("position (m), velocity (m/s)");
        for (body, state) in moving {
            let (p, v) = (vector(&state.pose.p), vector(&state.v));
            text += &format!("\n{:<12} {p}   {v}", body.name);
        }
        match more {
            0 => text,
            more => text + &format!("\nand {more} more bodies, which the JSON lists"),
        }
    }

    /// The supported fraction of the weight, as text.
    fn carried_in_words(&self) -> String {
        let (Some([mean, least]), Some((step, _))) = (self.carried(), self.least_carried) else {
            return "–".into();
        };
        let [mean, least] = [mean, least].map(|part| readable((1e4 * part).round() / 100.0, 4));
        format!(
            "supported by contacts, joints and springs: {mean} % on average, least in step {step}: {least} %"
        )
    }
}
