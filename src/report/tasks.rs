//! Many tasks on all cores, of which the ends are handed over one by one.

use std::panic;
use std::sync::mpsc::{self, RecvTimeoutError};
use std::thread;
use std::time::Duration;

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use crate::error::{Error, Result};
use crate::solver::Stop;

/// How often it is looked whether to stop while no task ends.
const LOOK: Duration = Duration::from_millis(50);

/// Tasks that do not depend on each other.
pub(super) struct Tasks<T> {
    /// Those that may run side by side, on as many threads as rayon's pool has.
    pub together: Vec<T>,
    /// Those that run after them, one after the other, because they are timed.
    pub alone: Vec<T>,
}

impl<T: Send + 'static> Tasks<T> {
    /// Does the `work` of every task and gives `note` each end as it comes. When it is time to stop, no
    /// more are begun, and what is under way is left behind on its thread: it comes to nothing.
    ///
    /// # Errors
    /// What `note` says; then no more are begun either.
    pub fn run<R: Send + 'static>(
        self,
        stop: &Stop,
        work: impl Fn(&T) -> R + Send + Sync + 'static,
        mut note: impl FnMut(T, R) -> Result<()>,
    ) -> Result<()> {
        let pool = ThreadPoolBuilder::new().num_threads(rayon::current_num_threads()).build();
        let pool = pool.map_err(|cause| Error::invalid("--threads", "pool", cause.to_string()))?;
        let (sender, ends) = mpsc::channel();
        let asked = stop.clone();
        let worker = thread::spawn(move || {
            let one = |task: T| {
                if asked.reason().is_some() {
                    return None;
                }
                let end = work(&task);
                sender.send((task, end)).ok() // without a receiver nobody wants more
            };
            let Tasks { together, alone } = self;
            let _ = pool.install(|| together.into_par_iter().try_for_each(one));
            let _ = pool.install(|| alone.into_iter().try_for_each(one));
        });
        loop {
            match ends.recv_timeout(LOOK) {
                Ok((task, end)) => note(task, end)?,
                Err(RecvTimeoutError::Timeout) if stop.reason().is_some() => return Ok(()),
                Err(RecvTimeoutError::Timeout) => {}
                Err(RecvTimeoutError::Disconnected) => break,
            }
        }
        match worker.join() {
            Ok(()) => Ok(()),
            Err(cause) => panic::resume_unwind(cause),
        }
    }
}
