//! Threads that are kept between sweeps and share the octets of each group.
//!
//! Before each call the shares are moved to the threads, and afterwards back, so no thread keeps
//! data between calls. Between two groups all threads wait at a barrier: they spin for a short
//! while and then yield between tests, so that threads without a processor of their own do not wait
//! for a spinning thread.

use std::hint::spin_loop;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::pair_lanes::Share;
use super::velocities::Velocities;
use crate::kernel::lanes::{Lanes, Width, Work};

/// Number of barrier tests before a thread yields.
const LOOKS: usize = 200;

/// Timeout of the wait that initializes a channel.
const FIRST_WAIT: Duration = Duration::from_millis(5);

/// The data shared by all threads.
#[derive(Debug)]
pub(super) struct Shared {
    pub v: Velocities,
    barrier: Barrier,
}

impl Shared {
    pub fn new(bodies: usize, threads: usize) -> Self {
        let barrier = Barrier { threads, arrived: AtomicUsize::new(0) };
        Shared { v: Velocities::new(bodies), barrier }
    }
}

/// A barrier for the threads.
#[derive(Debug)]
struct Barrier {
    threads: usize,
    /// The total number of arrivals of all threads.
    arrived: AtomicUsize,
}

impl Barrier {
    /// Waits until all threads have arrived as often as this one; this is its arrival number
    /// `turn`, counted from 1.
    fn wait(&self, turn: usize) {
        self.arrived.fetch_add(1, Ordering::AcqRel);
        let mut looks = 0;
        while self.arrived.load(Ordering::Acquire) < turn * self.threads {
            looks += 1;
            if looks < LOOKS { spin_loop() } else { thread::yield_now() }
        }
    }
}

/// Sweeps over one share.
struct Sweeps<'a> {
    share: &'a mut Share,
    shared: &'a Shared,
    count: usize,
}

impl Work for Sweeps<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Shared { v, barrier } = self.shared;
        let mut turn = 0;
        for _ in 0..self.count {
            self.share.sweep::<V>(v, || {
                turn += 1;
                barrier.wait(turn);
            });
        }
    }
}

/// Sweeps for another thread.
struct Task {
    share: Share,
    shared: Arc<Shared>,
    width: Width,
    count: usize,
}

/// A thread that receives shares and returns them.
#[derive(Debug)]
struct Worker {
    tasks: SyncSender<Task>,
    done: Receiver<Share>,
    thread: JoinHandle<()>,
}

impl Worker {
    /// `None` if the system cannot start another thread.
    fn start() -> Option<Self> {
        let (tasks, taken) = sync_channel::<Task>(1);
        let (give, done) = sync_channel(1);
        let work = move || {
            for Task { mut share, shared, width, count } in taken {
                width.run(Sweeps { share: &mut share, shared: &shared, count });
                drop(shared);
                if give.send(share).is_err() {
                    break;
                }
            }
        };
        let thread = thread::Builder::new().name("sweeps".into()).spawn(work).ok()?;
        // a channel allocates memory at the first wait, which must not happen during a sweep
        let _ = done.recv_timeout(FIRST_WAIT);
        Some(Worker { tasks, done, thread })
    }
}

/// The calling thread and its workers.
#[derive(Debug)]
pub(super) struct ThreadPool {
    workers: Vec<Worker>,
}

/// A worker's channels stay open until its pool is dropped.
const ENDED: &str = "a worker that has not ended";

impl ThreadPool {
    /// A pool of this number of threads, or as many as the system can start.
    pub fn new(threads: usize) -> Self {
        ThreadPool { workers: (1..threads).map_while(|_| Worker::start()).collect() }
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        1 + self.workers.len()
    }

    /// This number of sweeps: the first share on the calling thread, the others on one worker each.
    pub fn sweep(&self, shares: &mut [Share], shared: &Arc<Shared>, width: Width, count: usize) {
        let Some((own, others)) = shares.split_first_mut() else { return };
        shared.barrier.arrived.store(0, Ordering::Release);
        for (worker, share) in self.workers.iter().zip(&mut *others) {
            let (share, shared) = (std::mem::take(share), shared.clone());
            worker.tasks.send(Task { share, shared, width, count }).expect(ENDED);
        }
        width.run(Sweeps { share: own, shared, count });
        for (worker, share) in self.workers.iter().zip(others) {
            *share = worker.done.recv().expect(ENDED);
        }
    }
}

impl Drop for ThreadPool {
    fn drop(&mut self) {
        for Worker { tasks, thread, .. } in self.workers.drain(..) {
            drop(tasks);
            // The result of the thread is not needed.
            let _ = thread.join();
        }
    }
}
