//! Friction and restitution of pairs, static friction, and time-dependent forces and supports.

use super::measure::{Case, Known, Method, ROUNDING, after};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::{Scene, Scheme};

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];
const G: f64 = 9.81;
const SUMMED: (f64, &str) = (1e-6, "the tolerance of the solver, accumulated over the steps");
const OF_CONES: (f64, &str) =
    (1e-4, "the tolerance of the cone solver, accumulated over the steps");

/// A ground and a block of 2 kg on it, μ_s = 0.5 and μ = 0.3, with these fields.
fn block(name: &str, ground: &str, block: &str) -> Result<Scene> {
    let text = format!(
        "contact.friction = 0.3\ncontact.static_friction = 0.5\n[[bodies]]\nname = \"ground\"\n\
         fixed = true\nshape = {{ box = [9, 9, 1] }}\nposition = [0, 0, -0.5]\n{ground}\n\
         [[bodies]]\nname = \"block\"\nmass = 2\nshape = {{ box = [0.4, 0.4, 0.2] }}\n\
         position = [0, 0, 0.1]\nforce_at = [0, 0, -0.1]\n{block}\n"
    );
    Scene::from_toml(name, &text)
}

/// A growing force: the block sticks up to μ_s m g, then accelerates with the force minus kinetic
/// friction.
pub(super) fn ramp(size: Size) -> Result<Vec<Row>> {
    // μ_s m g = 9.81 N is reached after 1 s.
    let force = "force_over_time = { table = [[0, 0, 0, 0], [2, 19.62, 0, 0]] }";
    let case = Case::of("static-friction", block("force-ramp", "", force)?, size);
    let (mass, mu, rate, begins, ends) = (2.0, 0.3, G, 1.0, 1.5);
    let impulse = 0.5 * rate * (ends * ends - begins * begins) - mu * mass * G * (ends - begins);
    let formula =
        "\\tfrac1m(\\tfrac12 F'(t^2 - t_0^2) - \\mu m g (t - t_0)),\\ t_0 = \\mu_s m g/F'";
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(SUMMED, "speed when the force is μ_s m g", "0", "m/s", 0.0),
            Known::exact(SUMMED, "speed 0.5 s later", formula, "m/s", impulse / mass),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let speed = |time| Some(after(scene, time)?[1].v.x);
            Some(vec![speed(begins)?, speed(ends)?])
        }));
    }
    Ok(rows)
}

/// A block on a shaking table: it sticks below A ω² = μ_s g, and above slides with μ g.
pub(super) fn table(size: Size) -> Result<Vec<Row>> {
    let omega = 10.0;
    let shaken = |part: f64| {
        let amplitude = part * 0.5 * G / (omega * omega);
        let ground = format!(
            "displacement_over_time = {{ sine = {{ amplitude = [{amplitude}, 0, 0], \
             angular_frequency = {omega}, phase = {} }} }}",
            std::f64::consts::FRAC_PI_2
        );
        let mut scene = block("shaking-table", &ground, "")?;
        scene.states[1].pose.p.x = amplitude;
        Ok::<_, crate::error::Error>(Case::of("shaking-table", scene, size))
    };
    let slip = "slip after two periods, A ω² 1 % below μ_s g";
    let known = vec![Known::exact(
        (1e-6, "the velocity threshold of static friction"),
        slip,
        "0",
        "m",
        0.0,
    )];
    let mut rows = shaken(0.99)?.rows(Method::Velocity, known, |scene| {
        let states = after(scene, 4.0 * std::f64::consts::PI / omega)?;
        let start = scene.states[1].pose.p.x - scene.states[0].pose.p.x;
        Some(vec![states[1].pose.p.x - states[0].pose.p.x - start])
    });
    let what = "speed after 0.1 s, A ω² 2 % above μ_s g";
    let formula = "-\\mu\\,g\\,t";
    // In its first step the table gains half of a step's speed, so the block starts to slide one
    // step late.
    let known = vec![Known::order(1.0, what, formula, "m/s", -0.3 * G * 0.1)];
    rows.extend(
        shaken(1.02)?.rows(Method::Velocity, known, |scene| Some(vec![after(scene, 0.1)?[1].v.x])),
    );
    Ok(rows)
}

/// A box on a support that moves in time. On a belt that starts, runs for a second and stops, it is
/// dragged with μ g and ends exactly as far as the belt went, with every scheme that moves a
/// support. A table that shakes vertically with A ω² = 1.3 g throws it where it has −g.
pub(super) fn supports(size: Size) -> Result<Vec<Row>> {
    let mu = 0.4;
    let scene = |name: &str, moves: &str| {
        let text = format!(
            "contact.friction = 0.4\n[[bodies]]\nname = \"table\"\nfixed = true\n\
             shape = {{ box = [9, 9, 0.4] }}\nposition = [0, 0, -0.2]\n\
             displacement_over_time = {moves}\n[[bodies]]\nname = \"box\"\nmass = 1.3\n\
             shape = {{ box = [0.4, 0.3, 0.2] }}\nposition = [0, 0, 0.1]\n"
        );
        Scene::from_toml(name, &text)
    };
    let belt = scene("belt-starts-and-stops", "{ table = [[0, 0, 0, 0], [1, 1, 0, 0]] }")?;
    let case = Case::of("moving-support", belt, size);
    let mut rows = Vec::new();
    for scheme in Scheme::ALL.into_iter().filter(|scheme| *scheme != Scheme::Acceleration) {
        let [of_speed, of_way] = match scheme {
            Scheme::Soft => [(1e-2, "contacts are springs"), (1e-3, "contacts are springs")],
            Scheme::Penalty => [(5e-2, "friction is a damper"), (1e-2, "friction is a damper")],
            _ => [SUMMED, SUMMED],
        };
        let drags = "\\mu g t";
        let known = vec![
            Known::exact(of_speed, "speed after 0.1 s", drags, "m/s", mu * G * 0.1),
            Known::exact(of_way, "distance after the belt has stopped", "s", "m", 1.0),
        ];
        rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
            let speed = after(scene, 0.1)?[1].v.x;
            Some(vec![speed, after(scene, 1.6)?[1].pose.p.x])
        }));
    }
    let (part, omega, time) = (1.3_f64, 20.0, 0.12);
    let amplitude = part * G / (omega * omega);
    let sine =
        format!("{{ sine = {{ amplitude = [0, 0, {amplitude}], angular_frequency = {omega} }} }}");
    let mut thrown = scene("table-throws", &sine)?;
    thrown.step.dt = 0.002;
    thrown.states[1].v.z = amplitude * omega;
    let begins = libm::asin(1.0 / part) / omega;
    let (sin, cos) = libm::sincos(omega * begins);
    let flight = time - begins;
    let height = amplitude * (sin + omega * cos * flight) - 0.5 * G * flight * flight;
    let what = "height of a box thrown by its table, A ω² = 1.3 g, after 0.12 s";
    let formula = "A(\\sin\\omega t_0 + \\omega\\cos\\omega t_0\\,(t - t_0)) - \\tfrac12 g (t - t_0)^2,\\ \
         \\sin\\omega t_0 = g/(A\\omega^2)";
    let within = (0.02, "the flight begins at the end of a step");
    let known = vec![Known::exact(within, what, formula, "m", height)];
    let case = Case::of("moving-support", thrown, size);
    rows.extend(
        case.rows(Method::Velocity, known, |scene| {
            Some(vec![after(scene, time)?[1].pose.p.z - 0.1])
        }),
    );
    Ok(rows)
}

/// A mass under a sine force: x = a/ω (t − sin(ω t)/ω), v = a/ω (1 − cos(ω t)).
pub(super) fn sine(size: Size) -> Result<Vec<Row>> {
    let (a, omega, time) = (1.5, 4.0, 1.0);
    let text = "gravity = [0, 0, 0]\n[[bodies]]\nname = \"mass\"\nshape = \"point\"\nmass = 2\n\
                force_over_time = { sine = { amplitude = [3, 0, 0], angular_frequency = 4 } }\n";
    let mut scene = Scene::from_toml("sine-force", text)?;
    scene.step.dt = 0.02;
    let case = Case::of("sine-force", scene, size);
    let way = a / omega * (time - libm::sin(omega * time) / omega);
    let speed = a / omega * (1.0 - libm::cos(omega * time));
    let of_way = "\\frac{F}{m\\omega}(t - \\tfrac1\\omega\\sin\\omega t)";
    let of_speed = "\\frac{F}{m\\omega}(1 - \\cos\\omega t)";
    let methods = [
        (Method::Velocity, 1.0),
        (Method::Acceleration, 1.0),
        (Method::Midpoint, 2.0),
        (Method::Rk4, 4.0),
    ];
    let mut rows = Vec::new();
    for (method, order) in methods {
        let mut known = vec![Known::order(order, "distance after 1 s", of_way, "m", way)];
        if LEVELS.contains(&method) {
            known.push(Known::exact(ROUNDING, "speed after 1 s", of_speed, "m/s", speed));
        }
        rows.extend(case.rows(method, known, |scene| {
            let state = after(scene, time)?[0];
            Some(vec![state.pose.p.x, state.v.x])
        }));
    }
    Ok(rows)
}

/// Two blocks on one slope and two balls on one floor; one of each has a coefficient of its pair.
pub(super) fn pairs(size: Size) -> Result<Vec<Row>> {
    let slope = "tilt = { y = 20 }\ncontact.friction = 0.5\n[[bodies]]\nname = \"slope\"\nfixed = true\n\
        shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"rough\"\nmass = 1\n\
        shape = { box = [0.4, 0.4, 0.1] }\nposition = [0, 0, 0.05]\n[[bodies]]\nname = \"smooth\"\n\
        mass = 1\nshape = { box = [0.4, 0.4, 0.1] }\nposition = [0, 2, 0.05]\n\
        [[pairs]]\nbodies = [\"slope\", \"smooth\"]\nfriction = 0.1\n";
    let floor = "gravity = [0, 0, 0]\ncontact.restitution = 0.2\n[[bodies]]\nname = \"floor\"\n\
        fixed = true\nshape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"first\"\nmass = 1\n\
        shape = { sphere = 0.1 }\nposition = [0, 0, 0.1]\nvelocity = [0, 0, -2]\n[[bodies]]\n\
        name = \"second\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [1, 0, 0.1]\n\
        velocity = [0, 0, -2]\n[[pairs]]\nbodies = [\"floor\", \"first\"]\nrestitution = 0.9\n";
    let (sin, cos) = libm::sincos(20f64.to_radians());
    let slides = "g\\,(\\sin\\theta - \\mu\\cos\\theta)";
    let bounce = "e\\,v";
    let on_slope = Case::of("pairs", Scene::from_toml("two-materials", slope)?, size);
    let on_floor = Case::of("pairs", Scene::from_toml("two-bounces", floor)?, size);
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(SUMMED, "acceleration of the rough block", "0", "m/s²", 0.0),
            Known::exact(
                SUMMED,
                "acceleration of the smooth block",
                slides,
                "m/s²",
                G * (sin - 0.1 * cos),
            ),
        ];
        rows.extend(on_slope.rows(level, known, |scene| {
            let states = after(scene, 0.25)?;
            Some(vec![states[1].v.x / 0.25, states[2].v.x / 0.25])
        }));
        let known = vec![
            Known::exact(ROUNDING, "speed of the first ball", bounce, "m/s", 0.9 * 2.0),
            Known::exact(ROUNDING, "speed of the second ball", bounce, "m/s", 0.2 * 2.0),
        ];
        rows.extend(on_floor.rows(level, known, |scene| {
            let states = after(scene, 0.1)?;
            Some(vec![states[1].v.z, states[2].v.z])
        }));
    }
    Ok(rows)
}

/// A bar in a right-angled groove: Coulomb's cone holds it up to tan α = √2 μ, 35.26° at μ = 0.5,
/// and above that it slides with the remaining force.
pub(super) fn groove(size: Size) -> Result<Vec<Row>> {
    let (mu, time) = (0.5, 0.5);
    let bar = |angle: f64| {
        format!(
            "tilt = {{ y = {angle} }}\ncontact.friction = 0.5\ncontact.model = \"coulomb-cone\"\n\
             [[bodies]]\nname = \"left\"\nfixed = true\nshape = {{ plane = [0, 1, 1] }}\n\
             [[bodies]]\nname = \"right\"\nfixed = true\nshape = {{ plane = [0, -1, 1] }}\n\
             [[bodies]]\nname = \"bar\"\nmass = 3\nshape = {{ box = [0.6, 0.2, 0.2] }}\n\
             position = [0, 0, 0.14142135623730951]\nrotation = {{ x = 45 }}\n"
        )
    };
    let formula = "\\max(0,\\ g\\,(\\sin\\alpha - \\sqrt 2\\mu\\cos\\alpha))\\,t";
    let mut rows = Vec::new();
    for angle in [35.0, 37.0] {
        let (sin, cos) = libm::sincos(f64::to_radians(angle));
        let pull = G * (sin - std::f64::consts::SQRT_2 * mu * cos);
        let mut case = Case::of("groove", Scene::from_toml("bar-in-groove", &bar(angle))?, size);
        case.scene.solver.tolerance = OF_CONES.0 * 1e-4;
        for level in LEVELS {
            let what = format!("speed along the groove at {angle}° after 0.5 s");
            let known = vec![Known::exact(OF_CONES, what, formula, "m/s", pull.max(0.0) * time)];
            rows.extend(case.rows(level, known, |scene| Some(vec![after(scene, time)?[2].v.x])));
        }
    }
    Ok(rows)
}
