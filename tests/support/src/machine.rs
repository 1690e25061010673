//! Mechanisms with redundant rows, as text in the scene format, in any orientation.

use nalgebra::{UnitQuaternion, Vector3};
use proptest::prelude::*;

/// Motors (N m or N): masses weigh about ten newtons, so the first is unlimited and the second
/// limited.
pub const EFFORTS: [f64; 2] = [1e6, 5.0];
/// The mechanisms. Bricard's ring moves only in exact positions: once it has drifted, its rows
/// leave no degree of freedom.
pub const MECHANISMS: [&str; 9] = [
    "a door on two hinges",
    "a door on three hinges",
    "welds in a ring",
    "two sliders",
    "a universal joint on two bearings",
    "a parallelogram",
    "a beam on three cranks",
    "a four-bar linkage",
    "a ring of Bricard",
];

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// A mechanism of [`MECHANISMS`] in an orientation, with its motor and settings.
#[derive(Debug, Clone, Copy)]
pub struct Machine {
    /// Its place in [`MECHANISMS`].
    pub kind: usize,
    /// The Euler angles (rad) by which it is turned.
    pub angles: [f64; 3],
    /// Gravity (m/s²), downward; the mechanism is turned, gravity is not.
    pub gravity: f64,
    /// The effort of its motor (N or N m), see [`EFFORTS`].
    pub effort: f64,
    /// The part of position errors that a step corrects.
    pub beta: f64,
    /// The length of a step (s).
    pub dt: f64,
}

impl Machine {
    /// Its scene.
    pub fn scene(&self) -> String {
        let Machine { kind, angles: [a, b, c], gravity, effort, beta, dt } = *self;
        let text = format!(
            "gravity = [0, 0, -{gravity}]\n[step]\ndt = {dt}\nbaumgarte = {beta}\nalpha = {}\n",
            if beta == 0.0 { 0.0 } else { 20.0 }
        );
        let mut writer = Writer { turn: UnitQuaternion::from_euler_angles(a, b, c), text };
        mechanism(&mut writer, MECHANISMS[kind], effort);
        writer.text
    }
}

/// A mechanism turned at random, with or without gravity.
pub fn machine() -> impl Strategy<Value = Machine> {
    let angles = [-3.1..3.1_f64, -1.5..1.5, -3.1..3.1];
    let dts = prop_oneof![Just(0.01), Just(0.001), Just(1.0 / 60.0)];
    let kinds = (0..MECHANISMS.len(), any::<bool>(), 0..2_usize);
    (kinds, angles, 0..3_usize, dts).prop_map(|((kind, falls, effort), angles, beta, dt)| Machine {
        kind,
        angles,
        gravity: if falls { 9.81 } else { 0.0 },
        effort: EFFORTS[effort],
        beta: [0.0, 0.1, 0.2][beta],
        dt,
    })
}

/// The text of a scene whose positions and directions are rotated.
struct Writer {
    turn: UnitQuaternion<f64>,
    text: String,
}

impl Writer {
    fn turned(&self, v: [f64; 3]) -> String {
        let v = self.turn * Vector3::from(v);
        format!("[{}, {}, {}]", v.x, v.y, v.z)
    }

    fn body(&mut self, name: &str, at: [f64; 3]) {
        let at = self.turned(at);
        self.text += &format!(
            "[[bodies]]\nname = {name:?}\nshape = {{ sphere = 0.02 }}\nmass = 1.5\n\
             inertia = [0.1, 0.2, 0.15]\nposition = {at}\n"
        );
    }

    fn joint(
        &mut self,
        kind: &str,
        bodies: &[&str],
        point: [f64; 3],
        axes: &[[f64; 3]],
        more: &str,
    ) {
        let point = self.turned(point);
        let directions: Vec<String> = axes.iter().map(|axis| self.turned(*axis)).collect();
        let axes = match directions.as_slice() {
            [] => String::new(),
            [axis] => format!("axis = {axis}\n"),
            several => format!("axes = [{}]\n", several.join(", ")),
        };
        let point = match kind {
            "motor_rotation" | "motor_translation" | "fixed" => String::new(),
            _ => format!("point = {point}\n"),
        };
        self.text += &format!(
            "[[constraints]]\nkind = {kind:?}\nbodies = {bodies:?}\n{point}{axes}{more}\n"
        );
    }

    fn motor(&mut self, kind: &str, bodies: &[&str], axis: [f64; 3], effort: f64) {
        let more = format!("speed = 2\neffort = {effort}\n");
        self.joint(kind, bodies, [0.0; 3], &[axis], &more);
    }
}

fn mechanism(w: &mut Writer, kind: &str, effort: f64) {
    match kind {
        "a door on two hinges" | "a door on three hinges" => {
            w.body("door", [0.5, 0.0, 0.3]);
            w.joint("hinge", &["door"], [0.0, 0.0, 0.8], &[Z], "");
            w.joint("hinge", &["door"], [0.0, 0.0, -0.7], &[Z], "");
            if kind.contains("three") {
                w.joint("hinge", &["door"], [0.0, 0.0, 0.1], &[Z], "");
            }
            w.motor("motor_rotation", &["door"], Z, effort);
        }
        "welds in a ring" => {
            let place = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / 5.0;
                [angle.cos(), angle.sin(), 0.1 * k as f64]
            };
            let names: Vec<String> = (0..5).map(|k| format!("part{k}")).collect();
            names.iter().enumerate().for_each(|(k, name)| w.body(name, place(k)));
            for k in 0..5 {
                w.joint("fixed", &[&names[k], &names[(k + 1) % 5]], place(k), &[], "");
            }
            w.joint("hinge", &["part0"], place(0), &[Z], "");
            w.motor("motor_rotation", &["part0"], Z, effort);
        }
        "two sliders" => {
            w.body("sledge", [0.0; 3]);
            w.joint("slider", &["sledge"], [0.8, 0.5, 0.0], &[Z], "");
            w.joint("slider", &["sledge"], [-0.8, -0.5, 0.1], &[Z], "");
            w.motor("motor_translation", &["sledge"], Z, effort);
        }
        "a universal joint on two bearings" => {
            let out = [0.766044443118978, 0.6427876096865393, 0.0];
            let across = [-0.6427876096865393, 0.766044443118978, 0.0];
            w.body("in", [-0.5, 0.0, 0.0]);
            w.body("out", [0.383022221559489, 0.3213938048432696, 0.0]);
            w.joint("hinge", &["in"], [-0.5, 0.0, 0.0], &[X], "");
            w.joint("cylindrical", &["out"], [0.0; 3], &[out], "");
            w.joint("universal", &["in", "out"], [0.0; 3], &[Z, across], "");
            w.motor("motor_rotation", &["in"], X, effort);
        }
        "a parallelogram" => cranks(w, &[0.0, 1.5], effort),
        "a beam on three cranks" => cranks(w, &[0.0, 0.6, 1.5], effort),
        "a four-bar linkage" => {
            // Grashof's condition holds, 0.4 + 1.2 < 1.0 + 0.9: the short bar rotates fully.
            let corners = four_bar(0.4, 1.0, 0.9, 1.2, 1.1);
            for (name, [a, b]) in ["crank", "coupler", "rocker"].into_iter().zip([
                [corners[0], corners[1]],
                [corners[1], corners[2]],
                [corners[2], corners[3]],
            ]) {
                w.body(name, std::array::from_fn(|k| (a[k] + b[k]) / 2.0));
            }
            w.joint("hinge", &["crank"], corners[0], &[Z], "");
            w.joint("hinge", &["crank", "coupler"], corners[1], &[Z], "");
            w.joint("hinge", &["coupler", "rocker"], corners[2], &[Z], "");
            w.joint("hinge", &["rocker"], corners[3], &[Z], "");
            w.motor("motor_rotation", &["crank"], Z, effort);
        }
        "a ring of Bricard" => ring(w, effort),
        _ => unreachable!("{kind}"),
    }
}

/// A beam on parallel cranks at these positions, the first of which is driven by a motor.
fn cranks(w: &mut Writer, places: &[f64], effort: f64) {
    let angle = 0.7_f64;
    let arm = [0.5 * angle.cos(), 0.5 * angle.sin()];
    w.body("beam", [0.75 + arm[0], arm[1], 0.0]);
    for (k, &x) in places.iter().enumerate() {
        let name = format!("crank{k}");
        w.body(&name, [x + arm[0] / 2.0, arm[1] / 2.0, 0.0]);
        w.joint("hinge", &[&name], [x, 0.0, 0.0], &[Z], "");
        w.joint("hinge", &[&name, "beam"], [x + arm[0], arm[1], 0.0], &[Z], "");
    }
    w.motor("motor_rotation", &["crank0"], Z, effort);
}

/// Five rods on six hinges, along the edges of a cube.
fn ring(w: &mut Writer, effort: f64) {
    let corners = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
        [0.0, 0.0, 1.0],
    ];
    let (y, z, x) = ([0.0, 1.0, 0.0], Z, X);
    let axes = [y, z, x, y, z, x];
    let names: Vec<String> = (0..5).map(|k| format!("rod{k}")).collect();
    for (k, name) in names.iter().enumerate() {
        w.body(name, std::array::from_fn(|i| (corners[k][i] + corners[k + 1][i]) / 2.0));
    }
    for (k, axis) in axes.into_iter().enumerate() {
        let bodies: Vec<&str> = match k {
            0 => vec![&names[0]],
            5 => vec![&names[4]],
            _ => vec![&names[k - 1], &names[k]],
        };
        w.joint("hinge", &bodies, corners[k], &[axis], "");
    }
    w.motor("motor_rotation", &["rod0"], y, effort);
}

/// The four pivots of a linkage of crank, coupler, rocker and frame in the plane z = 0.
fn four_bar(crank: f64, coupler: f64, rocker: f64, frame: f64, angle: f64) -> [[f64; 3]; 4] {
    let a = [crank * angle.cos(), crank * angle.sin()];
    let (dx, dy) = (frame - a[0], -a[1]);
    let span = dx.hypot(dy);
    let along = (coupler * coupler - rocker * rocker + span * span) / (2.0 * span);
    let up = (coupler * coupler - along * along).sqrt();
    let b = [a[0] + (along * dx - up * dy) / span, a[1] + (along * dy + up * dx) / span];
    [[0.0; 3], [a[0], a[1], 0.0], [b[0], b[1], 0.0], [frame, 0.0, 0.0]]
}
