//! Single joints: gears, rack, universal, cylindrical, slider, rope, limit and belt.

use super::measure::{Case, Known, Method, ROUNDING, after, last};
use super::{Row, Size};
use crate::error::Result;
use crate::scene::{Scene, Scheme};

const LEVELS: [Method; 2] = [Method::Velocity, Method::Acceleration];
const G: f64 = 9.81;
const SUMMED: (f64, &str) = (1e-7, "the tolerance of the solver, accumulated over the steps");
/// At acceleration level a limit counts as reached below a gap that is a fraction of g dt².
const MET: (f64, &str) = (1e-6, "the gap below which a limit counts as reached");

/// A joint's scene, the closed forms of its motion after a time, and how they are measured.
struct Joint {
    scene: &'static str,
    text: String,
    time: f64,
    quantity: String,
    formula: &'static str,
    unit: &'static str,
    expected: f64,
    tolerance: (f64, &'static str),
    measure: fn(&[crate::body::State]) -> f64,
}

/// The rows of some joints at both levels.
fn rows(name: &'static str, joints: Vec<Joint>, size: Size) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for joint in joints {
        let case = Case::of(name, Scene::from_toml(joint.scene, &joint.text)?, size);
        for level in LEVELS {
            let Joint { formula, unit, expected, tolerance, measure, time, .. } = joint;
            let known =
                vec![Known::exact(tolerance, joint.quantity.clone(), formula, unit, expected)];
            let run = |scene: &Scene| Some(vec![measure(&after(scene, time)?)]);
            rows.extend(case.rows(level, known, run));
        }
    }
    Ok(rows)
}

/// A ball of 2 kg with I = 0.2 kg m², with this name, position and fields.
fn ball(name: &str, position: [f64; 3], fields: &str) -> String {
    format!(
        "[[bodies]]\nname = \"{name}\"\nshape = {{ sphere = 0.5 }}\nmass = 2\n\
         position = {position:?}\n{fields}\n"
    )
}

fn joint(kind: &str, bodies: &str, fields: &str) -> String {
    format!("[[constraints]]\nkind = \"{kind}\"\nbodies = {bodies}\n{fields}\n")
}

const WEIGHTLESS: &str = "gravity = [0, 0, 0]\n";

/// Joints without gravity: the rotation caused by a torque of 3 N m.
pub(super) fn turning(size: Size) -> Result<Vec<Row>> {
    let [inertia, torque, time, ratio] = [0.2, 3.0, 0.5, 20.0 / 45.0];
    let torque_on = "torque = [0, 0, 3]";
    let pair = ball("a", [0.0; 3], torque_on) + &ball("b", [2.0, 0.0, 0.0], "");
    let hinge = |body: &str| joint("hinge", &format!("[\"{body}\"]"), "axis = [0, 0, 1]");
    let teeth = "axes = [[0, 0, 1], [0, 0, 1]]\nteeth = [20, 45]";
    let gears = joint("gear", "[\"a\", \"b\"]", teeth) + &hinge("a") + &hinge("b");
    let shafts = ball("a", [0.0; 3], torque_on) + &ball("b", [0.0, 0.0, 2.0], "");
    let crossed = "point = [0, 0, 2]\naxes = [[1, 0, 0], [0, 1, 0]]";
    let cardan = joint("universal", "[\"a\", \"b\"]", crossed) + &hinge("a");
    let screw = ball("a", [0.0; 3], "torque = [0, 0, 3]\nforce = [0, 5, 4]");
    let sleeve = joint("cylindrical", "[\"a\"]", "axis = [0, 0, 1]");
    let turns = |scene, text, formula, expected| Joint {
        scene,
        text,
        time,
        quantity: format!("angular velocity after 0.5 s, {scene}"),
        formula,
        unit: "rad/s",
        expected,
        tolerance: ROUNDING,
        measure: |states| states[0].omega.z,
    };
    let geared = "\\frac{T t}{I_1 + I_2 (z_1/z_2)^2}";
    let together = "\\frac{T t}{I_1 + I_2}";
    let alone = "T t/I";
    let joints = vec![
        turns(
            "gears",
            format!("{WEIGHTLESS}{pair}{gears}"),
            geared,
            torque * time / (inertia * (1.0 + ratio * ratio)),
        ),
        turns(
            "universal",
            format!("{WEIGHTLESS}{shafts}{cardan}"),
            together,
            torque * time / (2.0 * inertia),
        ),
        turns(
            "cylindrical",
            format!("{WEIGHTLESS}{screw}{sleeve}"),
            alone,
            torque * time / inertia,
        ),
        Joint {
            scene: "cylindrical",
            text: format!("{WEIGHTLESS}{screw}{sleeve}"),
            time,
            quantity: "speed along the axis after 0.5 s".into(),
            formula: "F t/m",
            unit: "m/s",
            expected: 4.0 * time / 2.0,
            tolerance: ROUNDING,
            measure: |states| states[0].v.z,
        },
    ];
    rows("joints-turning", joints, size)
}

/// Joints loaded by weights: a yo-yo, a slider on a slope, its limit, a rope that becomes taut.
pub(super) fn falling(size: Size) -> Result<Vec<Row>> {
    let slope = "axis = [1, 0, -1]";
    let sledge = ball("a", [0.0; 3], "") + &joint("slider", "[\"a\"]", slope);
    let stop = joint("limit_translation", "[\"a\"]", &format!("{slope}\nlimits = [-1, 0.3]"));
    let rope = "[[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = 2\nposition = [0, 0, -0.5]\n"
        .to_string()
        + &joint("rope", "[\"bob\"]", "points = [[0, 0, 0], [0, 0, -0.5]]\nlength = 1");
    let yoyo = "[[bodies]]\nname = \"yoyo\"\nshape = { sphere = 0.04 }\nmass = 0.1\n\
                inertia = [8e-5, 8e-5, 8e-5]\n[[bodies]]\nname = \"ceiling\"\nfixed = true\n\
                shape = { box = [0.1, 0.1, 0.1] }\nposition = [-0.02, 0, 1]\n"
        .to_string()
        + &joint("rack", "[\"yoyo\", \"ceiling\"]", "axes = [[0, 1, 0], [0, 0, 1]]\nlength = 0.01");
    let joints = vec![
        Joint {
            scene: "yo-yo",
            text: yoyo,
            time: 1.0,
            quantity: "speed of a yo-yo after 1 s".into(),
            formula: "-\\frac{g t}{1 + I/(m r^2)}",
            unit: "m/s",
            expected: -G / 9.0,
            tolerance: SUMMED,
            measure: |states| states[0].v.z,
        },
        Joint {
            scene: "slider",
            text: sledge.clone(),
            time: 0.5,
            quantity: "speed down a slope of 45° after 0.5 s".into(),
            formula: "g\\sin\\theta\\,t",
            unit: "m/s",
            expected: G * std::f64::consts::FRAC_1_SQRT_2 * 0.5,
            tolerance: ROUNDING,
            measure: |states| states[0].v.norm(),
        },
        Joint {
            scene: "limit",
            text: sledge + &stop,
            time: 1.0,
            quantity: "distance at the limit".into(),
            formula: "s_{max}",
            unit: "m",
            expected: 0.3,
            tolerance: MET,
            measure: |states| states[0].pose.p.norm(),
        },
        Joint {
            scene: "rope",
            text: rope,
            time: 1.0,
            quantity: "depth when the rope is taut".into(),
            formula: "L",
            unit: "m",
            expected: 1.0,
            tolerance: MET,
            measure: |states| states[0].pose.p.norm(),
        },
    ];
    rows("joints-falling", joints, size)
}

/// A crate on a belt: it is dragged with μ g, and friction transfers half of the energy that the
/// belt supplies.
pub(super) fn belt(size: Size) -> Result<Vec<Row>> {
    let text = "contact.friction = 0.5\n[[bodies]]\nname = \"belt\"\nfixed = true\n\
        shape = { plane = [0, 0, 1] }\nvelocity = [2, 0, 0]\n[[bodies]]\nname = \"crate\"\nmass = 2\n\
        shape = { box = [1, 1, 0.4] }\nposition = [0, 0, 0.2]\n";
    let case = Case::of("belt", Scene::from_toml("belt", text)?, size);
    let mut rows = Vec::new();
    for level in LEVELS {
        let known = vec![
            Known::exact(SUMMED, "speed after 0.1 s", "\\mu g t", "m/s", 0.05 * G),
            Known::exact(SUMMED, "speed after 1 s", "v", "m/s", 2.0),
        ];
        rows.extend(case.rows(level, known, |scene| {
            let speed = |time| Some(last(scene, time)?.states[1].v.x);
            Some(vec![speed(0.1)?, speed(1.0)?])
        }));
    }
    Ok(rows)
}

/// Redundant joints that are not along the axes of the world: a door on two hinges with one axis,
/// and a ball on two sliders, each driven by a motor.
pub(super) fn redundant(size: Size) -> Result<Vec<Row>> {
    let axis = nalgebra::Vector3::new(0.1, 0.2, 1.0).normalize();
    let hinge =
        |point: &str| joint("hinge", "[\"door\"]", &format!("axis = [0.1, 0.2, 1]\n{point}"));
    let door = String::from("gravity = [0, 0, 0]\n[[bodies]]\nname = \"door\"\nmass = 20\n")
        + "shape = { box = [1, 0.05, 2] }\nposition = [0.5, 0, 0]\n"
        + &hinge("point = [0.08, 0.16, 0.8]")
        + &hinge("point = [-0.08, -0.16, -0.8]")
        + &joint("motor_rotation", "[\"door\"]", "axis = [0.1, 0.2, 1]\nspeed = 2\neffort = 1e4");
    let slider =
        |point: &str| joint("slider", "[\"a\"]", &format!("axis = [0.1, 0.2, 1]\n{point}"));
    let sliders = String::from(WEIGHTLESS)
        + &ball("a", [0.0; 3], "")
        + &slider("point = [0.8, 0.5, 0]")
        + &slider("point = [-0.8, -0.5, 0]")
        + &joint("motor_translation", "[\"a\"]", "axis = [0.1, 0.2, 1]\nspeed = 2\neffort = 1e4");
    let formula = "v_{\\mathrm{motor}}";
    let mut rows = Vec::new();
    for (scene, text, quantity, unit) in [
        ("door", &door, "angular velocity about the hinges after 0.5 s", "rad/s"),
        ("sliders", &sliders, "speed along the sliders after 0.5 s", "m/s"),
    ] {
        let mut case = Case::of("redundant-joints", Scene::from_toml(scene, text)?, size);
        case.scene.step.baumgarte = 0.1;
        for level in LEVELS {
            // The state preserves L: I(q)⁻¹ L at the end of a step is u with the inertia rotated by
            // dt ω.
            let turns = (scene, level) == ("door", Method::Velocity);
            let known = vec![match turns {
                true => Known::order(1.0, quantity, formula, unit, 2.0),
                false => Known::exact(SUMMED, quantity, formula, unit, 2.0),
            }];
            rows.extend(case.rows(level, known, |scene| {
                let state = after(scene, 0.5)?[0];
                let moved = if unit == "m/s" { state.v } else { state.omega };
                Some(vec![moved.dot(&axis)])
            }));
        }
    }
    Ok(rows)
}

/// A motor below its force limit keeps its speed against a force, with every scheme.
pub(super) fn blocked(size: Size) -> Result<Vec<Row>> {
    let drive = "axis = [1, 0, 0]\nspeed = 2\neffort = 1000";
    let text = String::from(WEIGHTLESS)
        + &ball("a", [0.0; 3], "force = [-50, 0, 0]")
        + &joint("motor_translation", "[\"a\"]", drive);
    let case = Case::of("blocked-motor", Scene::from_toml("motor-against-force", &text)?, size);
    let mut rows = Vec::new();
    for scheme in Scheme::ALL {
        let formula = "v_{\\mathrm{motor}}";
        let known =
            vec![Known::exact(SUMMED, "speed of the motor against the force", formula, "m/s", 2.0)];
        let run = |scene: &Scene| Some(vec![after(scene, 0.5)?[0].v.x]);
        rows.extend(case.rows(Method::Scheme(scheme), known, run));
    }
    Ok(rows)
}
