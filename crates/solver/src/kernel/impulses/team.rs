//! Threads that are kept between sweeps and share the octets of each group.
//!
//! Before each call the shares go to the threads, afterwards they come back: no thread holds what
//! it does not work on. Between two groups all threads wait for each other, looking again and again
//! for a short while and then giving their turn away in between, so that threads without a
//! processor of their own do not wait for one that spins.

use std::hint::spin_loop;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use super::octet::Share;
use super::velocities::Velocities;
use crate::kernel::lanes::{Lanes, Width, Work};

/// Looks at a barrier before a thread gives its turn away.
const LOOKS: usize = 200;

/// How long a new team waits for nothing.
const FIRST_WAIT: Duration = Duration::from_millis(5);

/// What all threads see.
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

/// Where threads wait for each other.
#[derive(Debug)]
struct Barrier {
    threads: usize,
    /// How often a thread has arrived.
    arrived: AtomicUsize,
}

impl Barrier {
    /// Waits until all have arrived as often as this thread, which is `turn` times after this one.
    fn wait(&self, turn: usize) {
        self.arrived.fetch_add(1, Ordering::AcqRel);
        let mut looks = 0;
        while self.arrived.load(Ordering::Acquire) < turn * self.threads {
            looks += 1;
            if looks < LOOKS { spin_loop() } else { thread::yield_now() }
        }
    }
}

/// Sweeps over a share.
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

/// Sweeps that another thread is to make.
struct Task {
    share: Share,
    shared: Arc<Shared>,
    width: Width,
    count: usize,
}

/// A thread that is given shares and gives them back.
#[derive(Debug)]
struct Worker {
    tasks: SyncSender<Task>,
    done: Receiver<Share>,
    thread: JoinHandle<()>,
}

impl Worker {
    /// `None` if the system has no more threads.
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
        // a channel takes memory when somebody waits at it for the first time; no sweep should
        let _ = done.recv_timeout(FIRST_WAIT);
        Some(Worker { tasks, done, thread })
    }
}

/// The calling thread and its helpers.
#[derive(Debug)]
pub(super) struct Team {
    workers: Vec<Worker>,
}

/// A worker's channels close when its team ends, and not before.
const ENDED: &str = "a worker that has not ended";

impl Team {
    /// So many threads, or as many as there are to be had.
    pub fn new(threads: usize) -> Self {
        Team { workers: (1..threads).map_while(|_| Worker::start()).collect() }
    }

    /// The number of threads.
    pub fn threads(&self) -> usize {
        1 + self.workers.len()
    }

    /// So many sweeps: the first share on the calling thread, each other one on its own.
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

impl Drop for Team {
    fn drop(&mut self) {
        for Worker { tasks, thread, .. } in self.workers.drain(..) {
            drop(tasks);
            let _ = thread.join(); // it has nothing left to say
        }
    }
}
