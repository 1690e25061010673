//! The velocities of all bodies, shared between threads.
//!
//! Within a group each body is accessed by only one thread, and between two groups all threads wait
//! for each other. Relaxed atomics are therefore sufficient; they cost the same as plain accesses
//! and need no `unsafe`.

use std::sync::atomic::{AtomicU64, Ordering::Relaxed};

use super::{Velocity, WIDTH};
use crate::kernel::lanes::Lanes;

/// A body's velocity: six numbers, padded to a cache line.
#[derive(Debug, Default)]
#[repr(align(64))]
struct Body([AtomicU64; 8]);

/// The velocities of all bodies.
#[derive(Debug, Default)]
pub(super) struct Velocities(Vec<Body>);

impl Velocities {
    /// Zero velocities of this number of bodies.
    pub fn new(bodies: usize) -> Self {
        Velocities((0..bodies).map(|_| Body::default()).collect())
    }

    /// The number of bodies.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    pub fn get(&self, body: usize) -> Velocity {
        let own = &self.0[body].0;
        std::array::from_fn(|k| f64::from_bits(own[k].load(Relaxed)))
    }

    pub fn set(&self, body: usize, v: &Velocity) {
        let own = &self.0[body].0;
        (0..WIDTH).for_each(|k| own[k].store(v[k].to_bits(), Relaxed));
    }

    /// Gathers component k of eight bodies' velocities into u_k.
    #[inline(always)]
    pub fn gather<V: Lanes>(&self, bodies: &[u32; 8], u: &mut [V]) {
        let mut components = [[0.0; 8]; WIDTH];
        for lane in 0..8 {
            let own = &self.0[bodies[lane] as usize].0;
            for k in 0..WIDTH {
                components[k][lane] = f64::from_bits(own[k].load(Relaxed));
            }
        }
        for k in 0..WIDTH {
            u[k] = V::load(&components[k]);
        }
    }

    #[inline(always)]
    pub fn scatter<V: Lanes>(&self, u: &[V], bodies: &[u32; 8]) {
        let mut components = [[0.0; 8]; WIDTH];
        for k in 0..WIDTH {
            u[k].store(&mut components[k]);
        }
        for lane in 0..8 {
            let own = &self.0[bodies[lane] as usize].0;
            for k in 0..WIDTH {
                own[k].store(components[k][lane].to_bits(), Relaxed);
            }
        }
    }
}
