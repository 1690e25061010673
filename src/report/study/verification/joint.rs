//! Feedback of errors, springs and motors.

use super::measure::{Case, Known, Method, ROUNDING, after, last, passages};
use super::{Row, Size};
use crate::body::State;
use crate::error::Result;
use crate::scene::Scene;

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];

/// A rod that is too long, without gravity: with β each step multiplies its error by 1 − β; with α
/// it decays like a critically damped spring.
pub(super) fn feedback(size: Size) -> Result<Vec<Row>> {
    let mut case = Case::load("feedback", "pendulum", size)?;
    let (beta, alpha, error, steps, time) = (0.2f64, 20.0, 0.01, 10, 0.15);
    case.scene.gravity *= 0.0;
    (case.scene.step.baumgarte, case.scene.step.alpha) = (beta, alpha);
    case.scene.states[0].pose.p.x += error;
    let left = |state: &State| state.pose.p.x - 1.0;
    let known = Known::exact(
        ROUNDING,
        "length error of the rod after 10 steps",
        "(1 - \\beta)^{10} c_0",
        "m",
        error * (1.0 - beta).powi(steps),
    );
    let mut rows = case.rows(Method::Velocity, vec![known], |scene| {
        Some(vec![left(&after(scene, f64::from(steps) * scene.step.dt)?[0])])
    });
    let decayed = error * (1.0 + alpha * time) * (-alpha * time).exp();
    let formula = "(1 + \\alpha t)\\,e^{-\\alpha t} c_0";
    for (method, order) in
        [(Method::Acceleration, 1.0), (Method::Midpoint, 2.0), (Method::Rk4, 4.0)]
    {
        case.scene.step.dt = if method == Method::Rk4 { 0.005 } else { 0.0025 };
        let known =
            Known::order(order, "length error of the rod after 0.15 s", formula, "m", decayed);
        rows.extend(
            case.rows(method, vec![known], |scene| Some(vec![left(&after(scene, time)?[0])])),
        );
    }
    Ok(rows)
}

/// A weight on a spring: the period, and the rest position with damping. The implicit step rotates
/// the motion by atan(ω dt) = ω dt − (ω dt)³/3 …: the frequency is of second order.
pub(super) fn spring(size: Size) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for level in LEVELS {
        let case = Case::load("spring", "spring", size)?;
        let (mass, stiffness) = (case.scene.bodies[0].mass.mass(), 50.0);
        let sag = mass * -case.scene.gravity.z / stiffness;
        let rest = -1.0 - sag;
        let formula = "2\\pi\\sqrt{m/k}";
        let period = std::f64::consts::TAU * f64::sqrt(mass / stiffness);
        let known = vec![Known::order(2.0, "period", formula, "s", period)];
        rows.extend(case.rows(level, known, |scene| {
            let height = |states: &[State]| (states[0].pose.p.z - rest, 0.0);
            let times = passages(scene, (2, 3.0 * period), height)?;
            Some(vec![times[1] - times[0]])
        }));
        let settled = (1e-9, "the oscillation left after 8 s with ζ = 1/2: e^(−ζ ω t)");
        let damped = Case::load("spring", "spring_damped", size)?;
        let formula = "m\\,g/k";
        let known = vec![Known::exact(settled, "deflection at rest", formula, "m", sag)];
        rows.extend(
            damped.rows(level, known, |scene| {
                Some(vec![-1.0 - last(scene, 8.0)?.states[0].pose.p.z])
            }),
        );
    }
    Ok(rows)
}

/// A mass on a spring of zero length, on the ellipse x = cos(ω t), y = ½ sin(ω t): an implicit
/// step, which uses the spring's direction at its beginning, changes its size at first order;
/// integrators preserve it to their own order, the midpoint rule exactly. The scene's energy
/// includes that of the spring: ½ k (x² + y²) + ½ m v² = ½ k (1 + ¼).
pub(super) fn ellipse(size: Size) -> Result<Vec<Row>> {
    let (omega, time): (f64, f64) = (4.0, 0.5);
    let text = "gravity = [0, 0, 0]\n[[bodies]]\nname = \"mass\"\nshape = \"point\"\nmass = 1\n\
                position = [1, 0, 0]\nvelocity = [0, 2, 0]\n[[constraints]]\nkind = \"spring\"\n\
                bodies = [\"mass\"]\npoints = [[0, 0, 0], [1, 0, 0]]\nstiffness = 16\nlength = 1e-15\n";
    let scene = Scene::from_toml("spring-ellipse", text)?;
    let mut case = Case::of("spring-ellipse", scene, size);
    let quantities = [
        ("x after 0.5 s", "\\cos\\omega t", "m", libm::cos(omega * time)),
        ("radius of the ellipse (y scaled by 2)", "1", "m", 1.0),
        ("energy", "\\tfrac58 k a^2", "J", 10.0),
    ];
    let methods = [
        (Method::Velocity, [Some(1.0); 3]),
        (Method::Acceleration, [Some(1.0); 3]),
        (Method::Midpoint, [Some(2.0), None, None]),
        // |1 + z + z²/2 + z³/6 + z⁴/24|² = 1 − |z|⁶/72 + … on the imaginary axis
        (Method::Rk4, [Some(4.0), Some(5.0), Some(5.0)]),
    ];
    let mut rows = Vec::new();
    for (method, orders) in methods {
        // With shorter steps rounding would hide a fifth order.
        case.scene.step.dt = if LEVELS.contains(&method) { 0.01 } else { 0.02 };
        let known =
            quantities.iter().zip(orders).map(
                |(&(what, formula, unit, value), order)| match order {
                    Some(order) => Known::order(order, what, formula, unit, value),
                    None => Known::exact(ROUNDING, what, formula, unit, value),
                },
            );
        rows.extend(case.rows(method, known.collect(), |scene| {
            let step = last(scene, time)?;
            let p = step.states[0].pose.p;
            Some(vec![p.x, p.x.hypot(2.0 * p.y), step.motion.energy()])
        }));
    }
    Ok(rows)
}

/// A wheel driven by a motor with bounded torque: ω = τ t/I until it reaches its speed.
pub(super) fn motor(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("motor", "motor", size)?;
    let (effort, inertia, speed) = (2.0, 0.5, 3.0);
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(
                ROUNDING,
                "angular velocity after 0.5 s",
                "\\tau\\,t/I",
                "rad/s",
                effort * 0.5 / inertia,
            ),
            Known::exact(ROUNDING, "angular velocity after 1 s", "\\omega_{max}", "rad/s", speed),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let rate = |time| Some(last(scene, time)?.states[0].omega.z);
            Some(vec![rate(0.5)?, rate(1.0)?])
        }));
    }
    Ok(rows)
}
