//! Runs many tasks on all cores and hands over their results one by one.

use std::time::Duration;

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use super::aside::Aside;
use lcplab_problem::error::{Error, Result};
use lcplab_solver::Stop;

/// Tasks that do not depend on each other.
pub struct Tasks<T> {
    /// Those that may run in parallel, on the threads of rayon's pool.
    pub together: Vec<T>,
    /// Those that run afterwards, one after the other, because they are timed.
    pub alone: Vec<T>,
    /// How long to wait for running tasks after a stop; zero if they do not check the stop
    /// condition.
    pub grace: Duration,
}

impl<T: Send + 'static> Tasks<T> {
    /// Runs `work` for every task and passes each result to `note` as it arrives. After a stop, no
    /// more tasks are started.
    ///
    /// # Errors
    /// Errors of `note`; no more tasks are started then either.
    pub fn run<R: Send + 'static>(
        self,
        stop: &Stop,
        work: impl Fn(&T) -> R + Send + Sync + 'static,
        mut note: impl FnMut(T, R) -> Result<()>,
    ) -> Result<()> {
        let pool = ThreadPoolBuilder::new().num_threads(rayon::current_num_threads()).build();
        let pool = pool.map_err(|cause| Error::invalid("threads", "pool", cause.to_string()))?;
        let Tasks { together, alone, grace } = self;
        let asked = stop.clone();
        let ends = Aside::begin(stop, grace, move |sender| {
            let one = |task: T| {
                asked.reason().is_none().then_some(())?;
                let end = work(&task);
                // `None` if the receiver no longer exists.
                sender.send((task, end)).ok()
            };
            let _ = pool.install(|| together.into_par_iter().try_for_each(one));
            let _ = pool.install(|| alone.into_iter().try_for_each(one));
        });
        for (task, end) in ends {
            note(task, end)?;
        }
        Ok(())
    }
}
