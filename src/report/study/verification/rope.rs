//! Ropes: the discrete catenary, two weights on a pulley, and the capstan.

use std::f64::consts::PI;

use super::measure::{Case, Known, Method, ROUNDING, first, last};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::Scene;
use crate::scene::catalogue::capstan::Capstan;
use crate::scene::generate::Rope;

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];
const HANGS: (f64, &str) = (1e-9, "rounding errors, amplified along the chain of rods");

/// The tension in each rod of a hanging chain is H/cos of its slope angle.
pub(super) fn catenary(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("catenary", "catenary", size)?;
    let rope = Rope { links: 12, length: 3.0, span: 2.0, mass: 0.25 };
    let (slopes, ratio) = rope.catenary();
    // The horizontal force H.
    let level = rope.mass * -case.scene.gravity.z / ratio;
    let mut rows = Vec::new();
    for method in LEVELS {
        let formula = "H\\sqrt{1 + s_k^2}";
        let known = [0, 3, 5].map(|k: usize| {
            let what = format!("tension in rod {}", k + 1);
            Known::exact(HANGS, what, formula, "N", level * slopes[k].hypot(1.0))
        });
        rows.extend(case.rows(method, known.into(), |scene| {
            let step = first(scene)?;
            let x = &step.solves[0].solution.x;
            let unit = if method == Method::Velocity { scene.step.dt } else { 1.0 };
            Some([0, 3, 5].map(|k: usize| -x[k] / unit).into())
        }));
    }
    Ok(rows)
}

/// Atwood's machine: the difference of the weights accelerates the sum of the masses.
pub(super) fn atwood(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("atwood", "atwood", size)?;
    let (g, time) = (-case.scene.gravity.z, 0.5);
    let [m1, m2] = [0, 1].map(|k: usize| case.scene.bodies[k].mass.mass());
    let mut rows = Vec::new();
    for method in LEVELS {
        let known = vec![
            Known::exact(
                ROUNDING,
                "acceleration of the heavier weight",
                "\\frac{m_1 - m_2}{m_1 + m_2}\\,g",
                "m/s²",
                (m1 - m2) / (m1 + m2) * g,
            ),
            Known::exact(
                ROUNDING,
                "tension",
                "\\frac{2 m_1 m_2}{m_1 + m_2}\\,g",
                "N",
                2.0 * m1 * m2 / (m1 + m2) * g,
            ),
        ];
        rows.extend(case.rows(method, known, |scene| {
            let step = last(scene, time)?;
            let unit = if method == Method::Velocity { scene.step.dt } else { 1.0 };
            Some(vec![-step.states[0].v.z / time, step.solves[0].solution.x[0].abs() / unit])
        }));
    }
    Ok(rows)
}

/// Atwood's machine with a massive wheel: its inertia is accelerated too, and the tensions on its
/// two sides differ.
pub(super) fn massive_pulley(size: Size) -> Result<Vec<Row>> {
    let case = Case::load("massive-pulley", "massive_pulley", size)?;
    let (g, time, radius) = (-case.scene.gravity.z, 0.5, 0.5);
    let [wheel, m1, m2] = [0, 1, 2].map(|k: usize| case.scene.bodies[k].mass.mass());
    let inertia = 0.5 * wheel * radius * radius;
    let a = (m1 - m2) / (m1 + m2 + inertia / (radius * radius)) * g;
    let mut rows = Vec::new();
    for method in LEVELS {
        let formula = "\\frac{m_1 - m_2}{m_1 + m_2 + I/r^2}\\,g";
        let known = vec![
            Known::exact(ROUNDING, "acceleration of the heavier weight", formula, "m/s²", a),
            Known::exact(
                ROUNDING,
                "tension above the heavier weight",
                "m_1\\,(g - a)",
                "N",
                m1 * (g - a),
            ),
            Known::exact(
                ROUNDING,
                "tension above the lighter weight",
                "m_2\\,(g + a)",
                "N",
                m2 * (g + a),
            ),
        ];
        rows.extend(case.rows(method, known, |scene| {
            let step = last(scene, time)?;
            let unit = if method == Method::Velocity { scene.step.dt } else { 1.0 };
            let x = &step.solves[0].solution.x;
            Some(vec![-step.states[1].v.z / time, x[5].abs() / unit, x[6].abs() / unit])
        }));
    }
    Ok(rows)
}

/// The capstan: 1 % below the ratio that friction allows nothing moves, 1 % above it the rope
/// slides.
pub(super) fn capstan(size: Size) -> Result<Vec<Row>> {
    let post = Capstan { links: 12, angle: PI, friction: 0.3, mass: 0.1 };
    Ok(wound(&Case::load("capstan", "capstan", size)?, post))
}

/// The same rope wound twice around: 10 N hold 430 N.
pub(super) fn two_turns(size: Size) -> Result<Vec<Row>> {
    let post = Capstan { links: 48, angle: 4.0 * PI, friction: 0.3, mass: 0.1 };
    let scene = Scene::new("two_turns", &post.description(10.0, 400.0))?;
    Ok(wound(&Case::of("capstan-two-turns", scene, size), post))
}

fn wound(case: &Case, post: Capstan) -> Vec<Row> {
    let weak = case.scene.bodies[1].force.norm();
    let [holds, slides] = [0.99, 1.01].map(|part: f64| part * post.ratio() * weak);
    let ratio = "0 \\text{ because } T_2 < T_1 \\left(\\frac{1 + \\mu\\tan\\frac{\\delta}{2}}{1 - \
         \\mu\\tan\\frac{\\delta}{2}}\\right)^n";
    let mut rows = Vec::new();
    for method in LEVELS {
        let known = vec![
            Known::exact(HANGS, "speed, pulled with 1 % less than the limit", ratio, "m/s", 0.0),
            Known::exact(
                HANGS,
                "acceleration, pulled with 1 % more than the limit",
                "\\frac{T_2 - r^n T_1}{m K}",
                "m/s²",
                post.acceleration(weak, slides),
            ),
        ];
        rows.extend(case.rows(method, known, |scene| {
            let pulled = |strong: f64| {
                let mut scene = scene.clone();
                let last = scene.bodies.last_mut()?;
                last.force = last.force.normalize() * strong;
                let step = first(&scene)?;
                Some(step.states.last()?.v.norm())
            };
            Some(vec![pulled(holds)?, pulled(slides)? / scene.step.dt])
        }));
    }
    rows
}
