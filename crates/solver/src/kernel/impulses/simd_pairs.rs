//! Projected Gauss-Seidel by groups, eight pairs of bodies at a time, on one or several threads.

use std::sync::Arc;

use super::groups::Groups;
use super::pair_lanes::{self, NOBODIES, Share};
use super::thread_pool::{Shared, ThreadPool};
use super::{System, Velocity, WIDTH};
use crate::Status;
use crate::kernel::lanes::Width;

/// Projected Gauss-Seidel by groups, eight pairs of bodies at a time.
///
/// How pairs are assigned to octets and threads does not affect the results, which are bitwise
/// identical for any number of threads.
#[derive(Debug)]
pub struct SimdPairs {
    groups: Groups,
    shares: Vec<Share>,
    shared: Arc<Shared>,
    thread_pool: ThreadPool,
    width: Width,
    /// Velocities before they are written to `shared`.
    v: Vec<Velocity>,
    rows: usize,
}

/// The status for unsupported problems.
const FAR: Status = Status::OutsideClass { reason: "friction reaches beyond its pair of bodies" };

impl SimdPairs {
    /// An empty solver with this number of threads (at least one).
    pub fn idle(width: Width, threads: usize) -> Self {
        let thread_pool = ThreadPool::new(threads);
        SimdPairs {
            groups: Groups::default(),
            shares: (0..thread_pool.threads()).map(|_| Share::default()).collect(),
            shared: Arc::new(Shared::new(0, thread_pool.threads())),
            thread_pool,
            width,
            v: Vec::new(),
            rows: 0,
        }
    }

    /// The sweeps for a system on one thread, from x = 0 and v = 0.
    ///
    /// # Errors
    /// [`Status::OutsideClass`] if the bounds of a row depend on a row between other bodies.
    pub fn new(system: &System, width: Width) -> Result<Self, Status> {
        SimdPairs::on_threads(system, width, 1)
    }

    /// The same on this number of threads.
    ///
    /// # Errors
    /// As [`SimdPairs::new`].
    pub fn on_threads(system: &System, width: Width, threads: usize) -> Result<Self, Status> {
        let mut kernel = SimdPairs::idle(width, threads);
        let (x, v) = (vec![0.0; system.rows.len()], vec![[0.0; WIDTH]; system.bodies]);
        kernel.start(system, &x, &v)?;
        Ok(kernel)
    }

    /// Starts from this x, and from the velocities v plus those that x adds. The arrangement is
    /// reused as long as the pairs are the same; memory is allocated only when the existing storage
    /// is too small.
    ///
    /// # Errors
    /// As [`SimdPairs::new`].
    pub fn start(&mut self, system: &System, x: &[f64], v: &[Velocity]) -> Result<(), Status> {
        if !self.groups.fits(system) {
            if !self.groups.arrange(system) {
                return Err(FAR);
            }
            pair_lanes::deal(&self.groups, system.bodies, &mut self.shares);
            let bodies = system.bodies + NOBODIES * self.shares.len();
            if self.shared.v.len() != bodies {
                self.shared = Arc::new(Shared::new(bodies, self.shares.len()));
            }
        }
        self.shares.iter_mut().for_each(|share| share.load(system, x));
        self.v.clear();
        self.v.extend_from_slice(v);
        system.push_velocities(x, &mut self.v);
        self.v.iter().enumerate().for_each(|(body, v)| self.shared.v.set(body, v));
        self.rows = x.len();
        Ok(())
    }

    /// One sweep over all rows, in the order of [`SimdPairs::order`].
    pub fn sweep(&mut self) {
        self.sweeps(1);
    }

    /// This number of sweeps.
    pub fn sweeps(&mut self, count: usize) {
        self.thread_pool.sweep(&mut self.shares, &self.shared, self.width, count);
    }

    /// The rows of the system in the order of a sweep.
    pub fn order(&self) -> Vec<usize> {
        self.groups.pairs.iter().flat_map(|pair| pair.first..pair.first + pair.rows).collect()
    }

    /// x, one entry per row of the system.
    pub fn x(&self) -> Vec<f64> {
        let mut x = vec![0.0; self.rows];
        self.write_x(&mut x);
        x
    }

    /// Writes x, one entry per row of the system.
    pub fn write_x(&self, x: &mut [f64]) {
        self.shares.iter().for_each(|share| share.unload(x));
    }

    /// Writes the velocities, one entry per body.
    pub fn write_v(&self, v: &mut [Velocity]) {
        v.iter_mut().enumerate().for_each(|(body, v)| *v = self.shared.v.get(body));
    }

    /// The number of threads: as many as were requested and available.
    pub fn threads(&self) -> usize {
        self.shares.len()
    }
}
