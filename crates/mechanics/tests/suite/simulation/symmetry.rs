//! A motion in a mirror, in other units, and repeated.

use lcplab_mechanics::body::{Mass, Pose, Shape, State};
use lcplab_mechanics::scene::{Scene, Scheme};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{scene, simulation};

/// The states after `steps` steps.
fn after(scene: Scene, steps: usize) -> Vec<State> {
    let mut simulation = simulation(scene);
    for _ in 0..steps {
        simulation.step().unwrap();
    }
    simulation.states().to_vec()
}

/// The mirror image y → −y of a state: vectors change their sign along y, axes of rotation along x
/// and z.
fn mirrored(state: &State) -> State {
    let polar = |v: Vector3<f64>| Vector3::new(v.x, -v.y, v.z);
    let axial = |w: Vector3<f64>| Vector3::new(-w.x, w.y, -w.z);
    let q = state.pose.q.into_inner();
    let imag = axial(q.imag());
    let q = UnitQuaternion::new_unchecked(Quaternion::new(q.w, imag.x, imag.y, imag.z));
    State { pose: Pose { p: polar(state.pose.p), q }, v: polar(state.v), omega: axial(state.omega) }
}

fn distance(a: &State, b: &State) -> f64 {
    (a.pose.p - b.pose.p).norm()
        + a.pose.q.angle_to(&b.pose.q)
        + (a.v - b.v).norm()
        + (a.omega - b.omega).norm()
}

/// Two boxes and two balls, thrown obliquely onto the ground and each other; all constraints of the
/// scene are contacts, so a mirrored state is sufficient for a mirrored scene.
const THROWN: &str = "
    step = { dt = 0.01, baumgarte = 0.1, alpha = 10 }
    contact = { friction = 0.4 }
    bodies = [
        { name = \"ground\", fixed = true, shape = { plane = [0, 0, 1] } },
        { name = \"a\", shape = { sphere = 0.5 }, mass = 1, position = [0, 0.1, 0.52],
          velocity = [1, 0.5, -0.5], angular_velocity = [1, 2, 3] },
        { name = \"b\", shape = { sphere = 0.25 }, mass = 2, position = [1.0, 0.4, 0.3],
          velocity = [-1, -0.25, 0], angular_velocity = [0, -1, 1] },
        { name = \"c\", shape = { sphere = 0.25 }, mass = 2, position = [0.2, 0.3, 1.4],
          velocity = [0, 0.25, -1] },
    ]
";

#[test]
fn a_mirrored_scene_moves_mirrored() {
    for level in Scheme::LEVELS {
        let mut plain = Scene::from_toml("thrown.toml", THROWN).unwrap();
        plain.step.scheme = level;
        let mut other = plain.clone();
        other.states = plain.states.iter().map(mirrored).collect();
        let start = plain.states.clone();
        let (plain, other) = (after(plain, 40), after(other, 40));
        assert!(distance(&plain[1], &start[1]) > 0.1, "nothing moved");
        for (plain, other) in plain.iter().zip(&other) {
            let apart = distance(&mirrored(plain), other);
            assert!(apart < 1e-9, "{level:?}: {apart}");
        }
    }
}

#[test]
fn a_mirrored_brick_and_pendulum_move_mirrored_bit_for_bit_or_to_rounding() {
    for name in ["dzhanibekov", "rolling_sphere", "incline"] {
        let plain = scene(name, Scheme::Acceleration);
        let mut other = plain.clone();
        other.states = plain.states.iter().map(mirrored).collect();
        for (plain, other) in after(plain, 50).iter().zip(&after(other, 50)) {
            let apart = distance(&mirrored(plain), other);
            assert!(apart < 1e-12, "{name}: {apart}");
        }
    }
}

/// The units of a scene: the number of new units in a meter, a kilogram and a second.
#[derive(Clone, Copy)]
struct Units {
    metre: f64,
    kilogram: f64,
    second: f64,
}

impl Units {
    fn speed(self) -> f64 {
        self.metre / self.second
    }

    fn acceleration(self) -> f64 {
        self.speed() / self.second
    }

    /// Every dimensional number of a scene in these units; the caller rebuilds the constraints.
    fn of(self, scene: &mut Scene) {
        scene.gravity *= self.acceleration();
        scene.step.dt *= self.second;
        scene.step.alpha /= self.second;
        let contact = &mut scene.contact;
        for length in [contact.margin.get_or_insert(0.05), &mut contact.slop] {
            *length *= self.metre;
        }
        for speed in [&mut contact.bounce_speed, &mut contact.sticking_speed] {
            *speed *= self.speed();
        }
        for body in &mut scene.bodies {
            body.force *= self.kilogram * self.acceleration();
            body.mass = match body.mass {
                Mass::Fixed => Mass::Fixed,
                Mass::Point { mass } => Mass::Point { mass: mass * self.kilogram },
                Mass::Rigid { mass, moments } => Mass::Rigid {
                    mass: mass * self.kilogram,
                    moments: moments * (self.kilogram * self.metre * self.metre),
                },
            };
            match &mut body.shape {
                Shape::Sphere { radius } => *radius *= self.metre,
                Shape::Box { half } => *half *= self.metre,
                Shape::Capsule { half_length, radius } => {
                    *half_length *= self.metre;
                    *radius *= self.metre;
                }
                Shape::Point | Shape::Plane { .. } | Shape::Hull(_) | Shape::Compound(_) => {}
            }
        }
        for state in &mut scene.states {
            *state = self.state(state);
        }
    }

    fn state(self, state: &State) -> State {
        State {
            pose: Pose { p: state.pose.p * self.metre, q: state.pose.q },
            v: state.v * self.speed(),
            omega: state.omega / self.second,
        }
    }
}

#[test]
fn units_that_are_powers_of_four_change_no_bit_of_a_motion() {
    // Contacts of balls with planes and each other are sums, products and square roots.
    let units = [
        Units { metre: 4.0, kilogram: 1.0, second: 1.0 },
        Units { metre: 1.0, kilogram: 16.0, second: 1.0 },
        Units { metre: 1.0, kilogram: 1.0, second: 0.25 },
        Units { metre: 1024.0, kilogram: 0.0625, second: 64.0 },
    ];
    for level in Scheme::LEVELS {
        for unit in units {
            let mut plain = Scene::from_toml("thrown.toml", THROWN).unwrap();
            plain.step.scheme = level;
            let mut other = plain.clone();
            unit.of(&mut other);
            for (plain, other) in after(plain, 40).iter().zip(&after(other, 40)) {
                assert_eq!(unit.state(plain), *other, "{level:?}");
            }
        }
    }
}

/// FNV-1a over the bits of all states (Fowler, Noll & Vo).
fn bits(states: &[State]) -> u64 {
    let mut hash = 0xcbf2_9ce4_8422_2325_u64;
    for state in states {
        let q = state.pose.q.coords;
        for x in state.pose.p.iter().chain(&q).chain(&state.v).chain(&state.omega) {
            for byte in x.to_le_bytes() {
                hash = (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
            }
        }
    }
    hash
}

/// Scenes with the hash of their states after 500 steps by Dantzig's method: one with friction and
/// resting contacts, one with joints, one with rolling and impacts. Sums, products, quotients and
/// square roots in a fixed order, and sines of libm: every IEEE 754 processor gives these.
const AFTER_500: [(&str, u64); 3] = [
    ("stack", 0xc43c_bbf0_bf68_e1d9),
    ("double_pendulum", 0x983c_9e65_7ee1_d6d1),
    ("ball_chain", 0xf782_9434_e55b_45f1),
];

#[test]
fn five_hundred_steps_have_the_same_bits_on_any_number_of_threads_and_any_processor() {
    for (name, expected) in AFTER_500 {
        for threads in [1, 2, 4, 8] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let hash = pool.install(|| bits(&after(Scene::load(name).unwrap(), 500)));
            assert_eq!(hash, expected, "{name} on {threads} threads: {hash:#018x}");
        }
    }
}

#[test]
fn a_motion_has_the_same_bits_every_time_at_every_level() {
    for (name, steps) in [("stack", 10), ("double_pendulum", 50), ("ball_chain", 10)] {
        for level in Scheme::LEVELS {
            let run = || bits(&after(scene(name, level), steps));
            let first = run();
            assert_eq!(first, run(), "{name} {level:?}, again");
            assert_ne!(first, bits(&scene(name, level).states), "{name}: nothing moved");
        }
    }
}
