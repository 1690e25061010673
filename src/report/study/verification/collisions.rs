//! Impacts with friction, slip that is not along the axes, and more than one bounce.

use nalgebra::Vector3;

use super::measure::{Case, Known, Method, ROUNDING, after};
use super::{Row, Size};
use crate::body::State;
use crate::error::Result;
use crate::lcp::friction::Model;
use crate::scene::{Scene, Scheme, Sliding};

const G: f64 = 9.81;
const SUMMED: (f64, &str) = (1e-6, "the tolerance of the solver, accumulated over the steps");
const SUBSTEPS: (f64, &str) =
    (1e-6, "rounding errors of position differences divided by the substep");
/// Under XPBD, about an axis across ω × L.
const ACROSS: (f64, &str) = (
    1e-6,
    "a substep changes the angular momentum along ω × L, that is about x; about the other axes the change is of higher order",
);

/// The speed after a damped contact.
const DAMPED: &str = "v\\,e^{-\\zeta\\varphi/\\sqrt{1 - \\zeta^2}}";
/// The step (s) of the penalty method, which it divides by eight: about 1/300 of a contact.
const PENALTY_STEP: f64 = 8e-4;

/// The case under the penalty method, and e of a mass (kg) on this number of its contact springs.
///
/// Damping determines the bounce, for contacts never pull: with k and d of all springs together,
/// ω² = k/m and ζ = d/(2 m ω), the force has fallen to 0 after the phase φ = π − arctan(2 ζ
/// √(1 − ζ²)/(1 − 2 ζ²)), and e = exp(−ζ φ/√(1 − ζ²)).
pub(super) fn under_penalty(case: &Case, size: Size, springs: f64, mass: f64) -> (Case, f64) {
    let mut case = Case::of(case.name, case.scene.clone(), size);
    case.scene.step.dt = PENALTY_STEP;
    let settings = &case.scene.step.penalty;
    let (k, d) = (springs * settings.stiffness, springs * settings.damping);
    let ratio = d / (2.0 * (k * mass).sqrt());
    let rest = (1.0 - ratio * ratio).sqrt();
    let phase = std::f64::consts::PI - libm::atan2(2.0 * ratio * rest, 1.0 - 2.0 * ratio * ratio);
    let e = libm::exp(-ratio * phase / rest);
    (case, e)
}

/// The tolerance for an impact with this scheme, and its reason.
fn of_scheme(scheme: Scheme) -> (f64, &'static str) {
    match scheme {
        Scheme::Xpbd | Scheme::Soft => SUBSTEPS,
        _ => SUMMED,
    }
}

/// A ball thrown on the ground slides through its impact: friction is μ (1 + e) v_n, and turns it.
pub(super) fn friction_in_impact(size: Size) -> Result<Vec<Row>> {
    let [mu, e, down, along, radius] = [0.1, 0.5, 2.0, 3.0, 0.1];
    let text = "gravity = [0, 0, 0]\ncontact.friction = 0.1\ncontact.restitution = 0.5\n[[bodies]]\n\
        name = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"ball\"\n\
        mass = 1\nshape = { sphere = 0.1 }\nposition = [0, 0, 0.1]\nvelocity = [3, 0, -2]\n";
    let case = Case::of("impact-with-friction", Scene::from_toml("thrown-ball", text)?, size);
    let loss = mu * (1.0 + e) * down;
    let methods = Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Penalty);
    let mut rows = Vec::new();
    for scheme in methods {
        let criterion = of_scheme(scheme);
        let known = vec![
            Known::exact(criterion, "speed upward", "e\\,v_n", "m/s", e * down),
            Known::exact(
                criterion,
                "speed along the ground",
                "v_t - \\mu(1 + e) v_n",
                "m/s",
                along - loss,
            ),
            Known::exact(
                criterion,
                "angular velocity",
                "\\frac{5\\mu(1 + e) v_n}{2 r}",
                "rad/s",
                2.5 * loss / radius,
            ),
        ];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let state = after(scene, 0.05)?[1];
            Some(vec![state.v.z, state.v.x, state.omega.y])
        }));
    }
    let (case, e) = under_penalty(&case, size, 1.0, 1.0);
    let loss = mu * (1.0 + e) * down;
    let known = vec![
        Known::order(1.0, "speed upward of a penalty contact", DAMPED, "m/s", e * down),
        Known::order(1.0, "speed along the ground", "v_t - \\mu(1 + e) v_n", "m/s", along - loss),
    ];
    rows.extend(case.rows(Method::Scheme(Scheme::Penalty), known, |scene| {
        let v = after(scene, 0.05)?[1].v;
        Some(vec![v.z, v.x])
    }));
    Ok(rows)
}

/// The slip of a point under a friction model.
struct Slip {
    method: Method,
    model: Model,
    sliding: Sliding,
    formula: &'static str,
    /// The speeds along x and y (m/s).
    expected: [f64; 2],
    /// The order of the error in dt; `None` if the model follows its law at every step length.
    order: Option<f64>,
}

/// A point that slides at 30° to the axes: each model follows its own law. Coulomb's force opposes
/// the slip, the box opposes both of its components separately, a polygon uses the corner that
/// opposes the slip most. A frozen box has the size of the last step, so it has none in the first.
/// An associated cone throws a point that slides into the air, see [`thrown`].
pub(super) fn oblique_slip(size: Size) -> Result<Vec<Row>> {
    let (mu, speed, time) = (0.3, 2.0, 0.1);
    let angle = 30f64.to_radians();
    let text = "contact.friction = 0.3\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
        shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"point\"\nshape = \"point\"\nmass = 1\n";
    let mut scene = Scene::from_toml("oblique-slip", text)?;
    let (sin_of_slip, cos_of_slip) = libm::sincos(angle);
    scene.states[1].v = Vector3::new(speed * cos_of_slip, speed * sin_of_slip, 0.0);
    let pull = mu * G * time;
    let straight = [cos_of_slip * (speed - pull), sin_of_slip * (speed - pull)];
    let boxed = [speed * cos_of_slip - pull, speed * sin_of_slip - pull];
    // With 4 corners 0° is nearest to 30°, with 8 corners 45°, with 16 corners 22.5°.
    let towards = |corner: f64| {
        let (sin, cos) = libm::sincos(corner.to_radians());
        [speed * cos_of_slip - pull * cos, speed * sin_of_slip - pull * sin]
    };
    let of_polygon = "v_0 - \\mu g t\\,p";
    let of_cone = "v_0 - \\mu g t\\,v_0/|v_0|";
    let of_box = "v_0 - \\mu g t\\,\\mathrm{sgn}(v_0)";
    let slip = |model, formula, expected| Slip {
        method: Method::Velocity,
        model,
        sliding: Sliding::Box,
        formula,
        expected,
        order: None,
    };
    let choices = [
        slip(Model::CoupledBox, of_box, boxed),
        Slip { order: Some(1.0), ..slip(Model::FrozenBox, of_box, boxed) },
        slip("polygon-4".parse()?, of_polygon, towards(0.0)),
        slip("polygon-8".parse()?, of_polygon, towards(45.0)),
        slip("polygon-16".parse()?, of_polygon, towards(22.5)),
        slip(Model::CoulombCone, of_cone, straight),
        Slip { method: Method::Acceleration, ..slip(Model::CoupledBox, of_box, boxed) },
        Slip {
            method: Method::Acceleration,
            sliding: Sliding::Substituted,
            ..slip(Model::CoupledBox, of_cone, straight)
        },
    ];
    let mut rows = Vec::new();
    for Slip { method, model, sliding, formula, expected, order } in choices {
        let mut scene = scene.clone();
        (scene.contact.model, scene.contact.sliding) = (model, sliding);
        let name = match sliding {
            Sliding::Box => model.to_string(),
            Sliding::Substituted => "λ_t = −μ λ_n v_t/|v_t| substituted".into(),
        };
        let case = Case::of("oblique-slip", scene, size);
        let known = ["x", "y"].into_iter().zip(expected).map(|(axis, expected)| {
            let what = format!("speed along {axis} after 0.1 s, {name}");
            match order {
                Some(order) => Known::order(order, what, formula, "m/s", expected),
                None => Known::exact(SUMMED, what, formula, "m/s", expected),
            }
        });
        rows.extend(case.rows(method, known.collect(), |scene| {
            let v = after(scene, time)?[1].v;
            Some(vec![v.x, v.y])
        }));
    }
    scene.contact.model = Model::AssociatedCone;
    rows.extend(thrown(&Case::of("oblique-slip", scene, size), mu, time, straight));
    Ok(rows)
}

/// A point that slides under an associated cone.
///
/// The cone allows no slip v without a separation at the speed μ v. From the ground, the impulse of
/// the first step is the nearest point of the cone to (m g dt, −m v_t), so the point leaves with
/// v/(1 + μ²) along the slip and μ v/(1 + μ²) upward. From the height μ v dt, at which this
/// separation is what the step leaves of the gap, it keeps to Coulomb's law.
fn thrown(case: &Case, mu: f64, time: f64, straight: [f64; 2]) -> Vec<Row> {
    let v = case.scene.states[1].v;
    let part = 1.0 / (1.0 + mu * mu);
    let along = "\\frac{v_0}{1 + \\mu^2}";
    let up = "\\frac{\\mu |v_0|}{1 + \\mu^2} - g t";
    let of_cone = "v_0 - \\mu g t\\,v_0/|v_0|";
    let of = |what: &str| format!("{what} after 0.1 s, associated-cone");
    let known = vec![
        Known::order(1.0, of("speed along x"), along, "m/s", part * v.x),
        Known::order(1.0, of("speed along y"), along, "m/s", part * v.y),
        Known::order(1.0, of("speed upward"), up, "m/s", part * mu * v.norm() - G * time),
    ];
    let mut rows = case.rows(Method::Velocity, known, |scene| {
        let v = after(scene, time)?[1].v;
        Some(vec![v.x, v.y, v.z])
    });
    let known = ["x", "y"].into_iter().zip(straight).map(|(axis, expected)| {
        let what = of(&format!("speed along {axis}, from the height μ v dt,"));
        Known::order(1.0, what, of_cone, "m/s", expected)
    });
    rows.extend(case.rows(Method::Velocity, known.collect(), |scene| {
        let mut scene = scene.clone();
        scene.states[1].pose.p.z = mu * v.norm() * scene.step.dt;
        let v = after(&scene, time)?[1].v;
        Some(vec![v.x, v.y])
    }));
    rows
}

/// A ball between two walls: after three bounces it has e³ of its speed, with every scheme; under
/// the penalty method e is that of its damping.
pub(super) fn bounces(size: Size) -> Result<Vec<Row>> {
    let (e, speed) = (0.9_f64, 2.0);
    let wall = |name: &str, x: f64| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nfixed = true\nshape = {{ box = [1, 4, 4] }}\n\
             position = [{x}, 0, 0]\n"
        )
    };
    let text = format!(
        "gravity = [0, 0, 0]\ncontact.restitution = 0.9\n{}{}[[bodies]]\nname = \"ball\"\nmass = 1\n\
         shape = {{ sphere = 0.1 }}\nvelocity = [2, 0, 0]\n",
        wall("left", -1.0),
        wall("right", 1.0)
    );
    let case = Case::of("three-bounces", Scene::from_toml("between-walls", &text)?, size);
    let mut rows = Vec::new();
    for scheme in Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Penalty) {
        let what = "velocity after three bounces";
        let formula = "-e^3 v";
        let known = vec![Known::exact(of_scheme(scheme), what, formula, "m/s", -e.powi(3) * speed)];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            // 0.4 m, then twice 0.8 m at 1.8 and 1.62 m/s: the third hit is at 1.138 s.
            Some(vec![after(scene, 1.3)?[2].v.x])
        }));
    }
    let (case, e) = under_penalty(&case, size, 1.0, 1.0);
    let what = "velocity after three bounces";
    let formula = "-e^3 v";
    // The errors of the three contacts depend on the part of a substep in which each begins.
    let within = (
        2e-3,
        "a contact begins and ends somewhere within a substep, which lasts 1/300 of the contact",
    );
    let known = vec![Known::exact(within, what, formula, "m/s", -e.powi(3) * speed)];
    // Each contact takes 31 ms: the third ends at 1.3 s, the fourth begins at 1.9 s.
    let moved = |scene: &Scene| Some(vec![after(scene, 1.6)?[2].v.x]);
    rows.extend(case.rows(Method::Scheme(Scheme::Penalty), known, moved));
    Ok(rows)
}

/// A box falls flat on its face: it bounces with e v and does not rotate.
pub(super) fn flat(size: Size) -> Result<Vec<Row>> {
    let (e, speed) = (0.6, 2.0);
    let text = "gravity = [0, 0, 0]\ncontact.restitution = 0.6\n[[bodies]]\nname = \"ground\"\n\
        fixed = true\nshape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"box\"\nmass = 1\n\
        shape = { box = [0.4, 0.4, 0.2] }\nposition = [0, 0, 0.14]\nvelocity = [0, 0, -2]\n";
    let case = Case::of("flat-bounce", Scene::from_toml("flat-box", text)?, size);
    let mut rows = Vec::new();
    for scheme in Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Penalty) {
        let criterion = of_scheme(scheme);
        let known = vec![
            Known::exact(criterion, "speed upward", "e\\,v", "m/s", e * speed),
            Known::exact(criterion, "angular velocity", "0", "rad/s", 0.0),
        ];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let state = after(scene, 0.1)?[1];
            Some(vec![state.v.z, state.omega.norm()])
        }));
    }
    let (case, e) = under_penalty(&case, size, 4.0, 1.0);
    let known = vec![
        Known::order(1.0, "speed upward of a penalty contact", DAMPED, "m/s", e * speed),
        Known::exact(SUMMED, "angular velocity", "0", "rad/s", 0.0),
    ];
    rows.extend(case.rows(Method::Scheme(Scheme::Penalty), known, |scene| {
        let state = after(scene, 0.1)?[1];
        Some(vec![state.v.z, state.omega.norm()])
    }));
    Ok(rows)
}

/// A ball hits a brick at rest off-center, e = 0.5, without gravity and friction: the impulses on
/// the two bodies are opposite and act at the same point, so the angular momentum about the common
/// center of mass stays r × m v with the reduced mass m = m_a m_b/(m_a + m_b).
///
/// XPBD corrects positions instead of velocities: within a substep the brick turns from rest, its
/// inertia turns with it, and angular momentum changes in proportion to the substep. The
/// acceleration level keeps it in the impact, and then integrates the turning brick with the order
/// of its integrator.
pub(super) fn off_center(size: Size) -> Result<Vec<Row>> {
    let [ball, brick, speed]: [f64; 3] = [1.0, 2.0, 3.0];
    let [y, z]: [f64; 2] = [0.3, 0.15];
    let text = "gravity = [0, 0, 0]\ncontact.restitution = 0.5\nstep.dt = 0.008\n[[bodies]]\n\
        name = \"brick\"\nmass = 2\nshape = { box = [0.2, 0.8, 0.4] }\n[[bodies]]\n\
        name = \"ball\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [-0.2, 0.3, 0.15]\n\
        velocity = [3, 0, 0]\n";
    let case = Case::of("off-center-impact", Scene::from_toml("ball-and-brick", text)?, size);
    let reduced = ball * brick / (ball + brick);
    let formula = "r \\times m v";
    let expected = [("x", 0.0), ("y", z * reduced * speed), ("z", -y * reduced * speed)];
    let mut rows = Vec::new();
    for scheme in Scheme::ALL {
        let known = expected.map(|(axis, value)| {
            let what = format!("angular momentum about {axis} after the impact");
            match (scheme, axis) {
                (Scheme::Xpbd, "x") => Known::order(1.0, what, formula, "N m s", value),
                (Scheme::Xpbd, _) => Known::exact(ACROSS, what, formula, "N m s", value),
                (Scheme::Acceleration, _) => Known::order(2.0, what, formula, "N m s", value),
                _ => Known::exact(ROUNDING, what, formula, "N m s", value),
            }
        });
        let method = match scheme {
            Scheme::Acceleration => Method::Midpoint,
            _ => Method::Scheme(scheme),
        };
        rows.extend(case.rows(method, known.into(), |scene| {
            let spin = about_center_of_mass(scene, &after(scene, 0.08)?);
            Some(vec![spin.x, spin.y, spin.z])
        }));
    }
    Ok(rows)
}

/// The angular momentum of all bodies about their common center of mass (N m s).
fn about_center_of_mass(scene: &Scene, states: &[State]) -> Vector3<f64> {
    let bodies = || scene.bodies.iter().map(|body| &body.mass).zip(states);
    let mass: f64 = bodies().map(|(own, _)| own.mass()).sum();
    let moment: Vector3<f64> = bodies().map(|(own, state)| own.mass() * state.pose.p).sum();
    let momentum: Vector3<f64> = bodies().map(|(own, state)| own.momentum(state)).sum();
    let about_origin: Vector3<f64> = bodies().map(|(own, state)| own.angular_momentum(state)).sum();
    about_origin - (moment / mass).cross(&momentum)
}

/// A ball hits another one off-center, e = 1, after a gap that it closes within a step: they
/// separate at a right angle. The acceleration level divides the step at the impact; the velocity
/// level bounces at the beginning of the step, in the direction at that time, and reports it.
pub(super) fn gap(size: Size) -> Result<Vec<Row>> {
    let (speed, offset, reach) = (3.0_f64, 0.6_f64, 1.0_f64);
    let text = "gravity = [0, 0, 0]\ncontact.restitution = 1\n[[bodies]]\nname = \"a\"\nmass = 1\n\
        shape = { sphere = 0.5 }\nvelocity = [3, 0, 0]\n[[bodies]]\nname = \"b\"\nmass = 1\n\
        shape = { sphere = 0.5 }\nposition = [2.3, 0.6, 0]\n";
    let case = Case::of("gap-below-a-step", Scene::from_toml("billiards", text)?, size);
    // When they meet, the line of centers and the path of the first ball make an angle of sine 0.6.
    let sin = offset / reach;
    let along = speed * (1.0 - sin * sin).sqrt();
    let expected = [along * (1.0 - sin * sin).sqrt(), along * sin];
    let formula = "v\\,(1 - s^2,\\ s\\sqrt{1 - s^2})";
    let turned = (0.05, "the impact is applied at the beginning of the step (a warning says so)");
    let mut rows = Vec::new();
    for (method, criterion) in [(Method::Acceleration, SUMMED), (Method::Velocity, turned)] {
        let known = ["x", "y"].into_iter().zip(expected).map(|(axis, value)| {
            let what = format!("speed of the struck ball along {axis}");
            Known::exact(criterion, what, formula, "m/s", value)
        });
        rows.extend(case.rows(method, known.collect(), |scene| {
            let v = after(scene, 1.0)?[1].v;
            Some(vec![v.x, v.y])
        }));
    }
    Ok(rows)
}
