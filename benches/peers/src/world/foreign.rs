//! An engine with C's calling convention.

use std::os::raw::{c_int, c_void};

use lcplab::body::{Pose, State};
use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use super::{HALF, MASS, Setting, World};

/// The functions that a shim exports.
#[derive(Clone, Copy)]
pub struct Calls {
    /// Makes a world of cubes: their number, poses (position, quaternion with the scalar first),
    /// half edge, mass, friction, length of a step, iterations.
    pub world: unsafe extern "C" fn(c_int, *const f64, f64, f64, f64, f64, c_int) -> *mut c_void,
    pub step: unsafe extern "C" fn(*mut c_void),
    /// Writes the poses.
    pub poses: unsafe extern "C" fn(*const c_void, *mut f64),
    pub free: unsafe extern "C" fn(*mut c_void),
}

/// Declares an engine that is compiled from `shims/`.
macro_rules! engine_in_c {
    ($world:ident $step:ident $poses:ident $free:ident) => {
        unsafe extern "C" {
            fn $world(
                bodies: std::os::raw::c_int,
                poses: *const f64,
                half: f64,
                mass: f64,
                friction: f64,
                dt: f64,
                iterations: std::os::raw::c_int,
            ) -> *mut std::os::raw::c_void;
            fn $step(world: *mut std::os::raw::c_void);
            fn $poses(world: *const std::os::raw::c_void, poses: *mut f64);
            fn $free(world: *mut std::os::raw::c_void);
        }
    };
}
pub(crate) use engine_in_c;

/// Numbers of a pose.
const POSE: usize = 7;

/// A world of such an engine.
pub struct Foreign {
    calls: Calls,
    world: *mut c_void,
    bodies: usize,
}

impl Foreign {
    pub fn boxed(calls: Calls, setting: &Setting, iterations: usize) -> Box<dyn World> {
        let bodies = setting.places.len();
        let poses: Vec<f64> = setting.places.iter().flat_map(numbers).collect();
        let [count, iterations] =
            [bodies, iterations].map(|k| c_int::try_from(k).unwrap_or(c_int::MAX));
        // SAFETY: `poses` holds seven numbers a body, which the shim reads and does not keep.
        let world = unsafe {
            (calls.world)(
                count,
                poses.as_ptr(),
                HALF,
                MASS,
                setting.friction,
                setting.dt,
                iterations,
            )
        };
        Box::new(Foreign { calls, world, bodies })
    }
}

impl World for Foreign {
    fn step(&mut self) {
        // SAFETY: the world was made by the same shim and is freed in `drop` only.
        unsafe { (self.calls.step)(self.world) }
    }

    fn poses(&self) -> Vec<Pose> {
        let mut numbers = vec![0.0; POSE * self.bodies];
        // SAFETY: as in `step`, and there is room for seven numbers a body.
        unsafe { (self.calls.poses)(self.world, numbers.as_mut_ptr()) };
        numbers.chunks(POSE).map(pose).collect()
    }
}

impl Drop for Foreign {
    fn drop(&mut self) {
        // SAFETY: as in `step`; there is no other copy of the pointer.
        unsafe { (self.calls.free)(self.world) }
    }
}

fn numbers(state: &State) -> [f64; POSE] {
    let (p, q) = (state.pose.p, state.pose.q);
    [p.x, p.y, p.z, q.w, q.i, q.j, q.k]
}

fn pose(numbers: &[f64]) -> Pose {
    let q = Quaternion::new(numbers[3], numbers[4], numbers[5], numbers[6]);
    Pose {
        p: Vector3::new(numbers[0], numbers[1], numbers[2]),
        q: UnitQuaternion::from_quaternion(q),
    }
}
