//! Requirements on every scheme: a free body's momentum, a top that does not fall, a ball that
//! comes to rest.

use super::measure::{Case, Known, Method, ROUNDING, after, last, start};
use super::{Row, Size};
use crate::error::Result;
use crate::lcp::friction::Model;
use crate::scene::catalogue::bounce::Drop;
use crate::scene::{Integrator, Scene, Scheme};

/// Schemes with restitution, and the maximum distance (m) of the resting ball from the ground: a
/// soft contact penetrates, and at acceleration level a ball rests at any gap that counts as
/// touching, 1/1000 of its size.
const BOUNCING: [(Scheme, f64); 5] = [
    (Scheme::Velocity, 1e-6),
    (Scheme::Acceleration, 2e-4),
    (Scheme::SequentialImpulses, 1e-6),
    (Scheme::Xpbd, 1e-4),
    (Scheme::Soft, 1e-3),
];
/// XPBD divides differences of positions by a substep.
const SUMMED: (f64, &str) =
    (1e-9, "rounding errors of position differences divided by the substep, accumulated");

/// The brick that flips, for ten seconds: the midpoint rule conserves its angular momentum and
/// energy.
pub(super) fn free_body(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("free-body", "dzhanibekov", size)?;
    case.scene.step.dt = 0.01;
    let before = match start(&case.scene) {
        Some(simulation) => simulation.motion(),
        None => return Ok(Vec::new()),
    };
    let mut rows = Vec::new();
    for scheme in Scheme::ALL.into_iter().filter(|s| *s != Scheme::Acceleration) {
        let criterion = if scheme == Scheme::Xpbd { SUMMED } else { ROUNDING };
        let momentum = before.angular_momentum.norm();
        let known = vec![
            Known::exact(criterion, "angular momentum after 10 s", "L_0", "N m s", momentum),
            Known::exact(criterion, "energy after 10 s", "E_0", "J", before.kinetic),
        ];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let motion = last(scene, 10.0)?.motion;
            Some(vec![motion.angular_momentum.norm(), motion.kinetic])
        }));
    }
    Ok(rows)
}

/// The steady top for five seconds: its inclination stays at 30 degrees.
pub(super) fn lean(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("top-lean", "top", size)?;
    (case.scene.step.dt, case.scene.step.baumgarte) = (0.002, 0.2);
    let half_a_degree = (
        0.5 / 30.0,
        "the error of the tilt is of first order in dt; half a degree is allowed at steps of up to 2 ms",
    );
    let mut rows = Vec::new();
    for scheme in [Scheme::Velocity, Scheme::SequentialImpulses] {
        let what = "tilt after 5 s";
        let known = vec![Known::exact(half_a_degree, what, "\\theta", "°", 30.0)];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let state = last(scene, 5.0)?.states[0];
            Some(vec![(state.pose.q * nalgebra::Vector3::z()).z.acos().to_degrees()])
        }));
    }
    Ok(rows)
}

/// A pendulum released at 170 degrees, for a minute. Runge-Kutta and the midpoint rule lose energy
/// at their order; schemes with feedback of the rod's stretch keep the energy within one percent
/// and the rod's length within a thousandth. NGS and split impulses, which move the bob back to its
/// circle, keep the length to the last digit and lose a third of the energy, XPBD a tenth of it:
/// for these only the length is checked.
pub(super) fn long_pendulum(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("long-pendulum", "pendulum", size)?;
    let (time, angle) = (60.0, 170f64.to_radians());
    (case.levels, case.scene.step.dt) = (2, 0.002);
    (case.scene.step.baumgarte, case.scene.step.alpha) = (0.2, 10.0);
    case.scene.states[0].pose.p = nalgebra::Vector3::new(angle.sin(), 0.0, -angle.cos());
    let height = 1.0 - angle.cos();
    let energy = case.scene.bodies[0].mass.mass() * -case.scene.gravity.z * height;
    let near = (0.01, "position stabilization of the rod, over a minute");
    let stretched = (1e-3, "the stretch of the rod that stabilization leaves");
    let (what, formula) = ("energy after a minute", "m g l (1 - \\cos 170°)");
    let kept = || Known::exact(near, what, formula, "J", energy);
    let length = |known| Known::exact(known, "length of the rod after a minute", "l", "m", 1.0);
    let on_circle = (1e-12, "the bob is projected onto its circle");
    let mut rows = Vec::new();
    let cases = [
        (
            Method::Rk4,
            Some(Known::order(4.0, what, formula, "J", energy)),
            (1e-8, "the order of the Runge-Kutta method"),
        ),
        (Method::Midpoint, Some(Known::order(2.0, what, formula, "J", energy)), stretched),
        (Method::Scheme(Scheme::Velocity), Some(kept()), stretched),
        (Method::Scheme(Scheme::SequentialImpulses), Some(kept()), stretched),
        (Method::Scheme(Scheme::Soft), Some(kept()), stretched),
        (Method::Scheme(Scheme::Penalty), Some(kept()), stretched),
        (Method::Scheme(Scheme::SplitImpulse), None, on_circle),
        (Method::Scheme(Scheme::GaussSeidel), None, on_circle),
        (Method::Scheme(Scheme::Xpbd), None, on_circle),
    ];
    for (method, of_energy, of_length) in cases {
        let has_energy = of_energy.is_some();
        let known = of_energy.into_iter().chain([length(of_length)]).collect();
        rows.extend(case.rows(method, known, |scene| {
            let step = last(scene, time)?;
            let p = step.states[0].pose.p;
            let lifted = case.scene.bodies[0].mass.mass() * -scene.gravity.z * (p.z + 1.0);
            let energy = has_energy.then_some(step.motion.kinetic + lifted);
            Some(energy.into_iter().chain([p.norm()]).collect())
        }));
    }
    Ok(rows)
}

/// Every scheme with the coupled box, and every other friction model at velocity level.
pub(super) fn long_stacks() -> impl Iterator<Item = (Scheme, Model)> {
    let schemes = Scheme::ALL.into_iter().map(|scheme| (scheme, Model::CoupledBox));
    let models = Model::ALL.into_iter().filter(|model| *model != Model::CoupledBox);
    schemes.chain(models.map(|model| (Scheme::Velocity, model)))
}

/// Ten boxes for a minute: none moves sideways, and the top one sinks by the compression of the
/// springs below it.
pub(super) fn long_stack(scheme: Scheme, model: Model, size: Size) -> Result<Vec<Row>> {
    let stack = "contact.friction = 0.5\n[generate]\nkind = \"stack\"\ncount = 10\nsize = 1\nmass = 1\n\
                 [[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let scene = Scene::from_toml("stack_of_ten.toml", stack)?;
    let mut case = Case::of("long-stack", scene, size);
    case.levels = 2;
    case.scene.contact.model = model;
    case.scene.solver.tolerance = 1e-8;
    if scheme == Scheme::SequentialImpulses {
        case.scene.step.sweeps = 100;
    }
    let start = case.scene.states.clone();
    let stands = match scheme {
        Scheme::Xpbd | Scheme::Soft | Scheme::SequentialImpulses => {
            (0.05, "the sweeps do not converge in a step; the stack must stay within 1/20 of a box")
        }
        _ => (1e-6, "the gap that a contact keeps at rest"),
    };
    let gravity = -case.scene.gravity.z;
    let (sinks, formula, near) = match scheme {
        // Contact j from the top supports j boxes on four springs of k.
        Scheme::Penalty => (
            55.0 * gravity / (4.0 * case.scene.step.penalty.stiffness),
            r"\frac{55\,m g}{4 k}",
            (1e-6, "the equilibrium after the oscillation has decayed"),
        ),
        // A corner is a spring of ω²/a, and a = J M⁻¹ Jᵀ is 4/m on the ground and 8/m between two
        // boxes: contact j from the top sinks by j m g / (4 ω² m / 8), the lowest one by half of
        // that.
        Scheme::Soft => (
            100.0 * gravity / (std::f64::consts::TAU * case.scene.step.soft.contact_hertz).powi(2),
            r"\frac{100\,g}{\omega^2}",
            (0.01, "the static deflection of the springs"),
        ),
        _ => (0.0, "0", stands),
    };
    let known = vec![
        Known::exact(
            stands,
            format!("largest sideways displacement in a minute, {model}"),
            "0",
            "m",
            0.0,
        ),
        Known::exact(near, format!("sinking of the top box, {model}"), formula, "m", sinks),
    ];
    Ok(case.rows(Method::Scheme(scheme), known, |scene| {
        let states = after(scene, 60.0)?;
        let mut moved = states.iter().zip(&start).map(|(now, then)| now.pose.p - then.pose.p);
        let aside = moved.clone().map(|way| way.xy().norm()).fold(0.0, f64::max);
        Some(vec![aside, -moved.next_back()?.z])
    }))
}

/// The bouncing ball until it rests: with every scheme its second flight has the height e² h as
/// precisely as its step resolves the impact, and at the end the ball rests on the ground.
pub(super) fn rest(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("bounce-to-rest", "bouncing_ball", size)?;
    let radius = 0.1;
    case.scene.step.integrator = Integrator::SemiImplicitEuler;
    let e = case.scene.contact.restitution;
    let height = case.scene.states[1].pose.p.z - radius;
    let drop = Drop { height, restitution: e, gravity: -case.scene.gravity.z };
    let end = drop.time_of(1) * (1.0 + e) / (1.0 - e) + 1.0;
    let mut rows = Vec::new();
    for (scheme, sinking) in BOUNCING {
        let found = (0.1, "the time of impact is known only to within a substep");
        let lies = (sinking, "the penetration or gap that a contact keeps at rest");
        let (what, formula, height) = ("height after one bounce", "e^2 h", drop.height_after(1));
        let known = vec![
            match scheme {
                // XPBD and soft steps find the impact only to within a substep, so their errors do
                // not decrease uniformly.
                Scheme::Xpbd | Scheme::Soft => Known::exact(found, what, formula, "m", height),
                _ => Known::order(1.0, what, formula, "m", height),
            },
            Known::exact(lies, "height at rest", "0", "m", 0.0),
        ];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let mut simulation = start(scene)?;
            let (mut bounced, mut top, mut ended) = (0, 0.0f64, false);
            let mut before = 0.0;
            for _ in 0..(end / scene.step.dt).ceil() as usize {
                let state = simulation.step().ok()?.states[1];
                bounced += usize::from(before < 0.0 && state.v.z > 0.1);
                ended |= bounced > 1;
                if bounced == 1 && !ended {
                    top = top.max(state.pose.p.z - radius);
                }
                before = state.v.z;
            }
            Some(vec![top, simulation.states()[1].pose.p.z - radius])
        }));
    }
    Ok(rows)
}
