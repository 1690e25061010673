//! Runs many tasks on all cores and hands over their results one by one.

use std::time::Duration;

use rayon::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};

use super::aside::Aside;
use lcplab_lcp::error::{Error, Result};
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
        let pool = pool()?;
        let Tasks { together, alone, grace } = self;
        let asked = stop.clone();
        let ends = Aside::begin(stop, grace, move |send| {
            let one = |task: T| {
                asked.reason().is_none().then_some(())?;
                let end = work(&task);
                // `None` if the receiver no longer exists.
                send((task, end)).then_some(())
            };
            let all = || {
                let _ = together.into_par_iter().try_for_each(one);
                let _ = alone.into_iter().try_for_each(one);
            };
            match pool {
                Some(pool) => pool.install(all),
                None => all(),
            }
        });
        for (task, end) in ends {
            note(task, end)?;
        }
        Ok(())
    }
}

/// The threads for the tasks; none in a browser, where rayon does everything on the calling thread.
fn pool() -> Result<Option<ThreadPool>> {
    if cfg!(target_os = "emscripten") {
        return Ok(None);
    }
    let pool = ThreadPoolBuilder::new().num_threads(rayon::current_num_threads()).build();
    pool.map(Some).map_err(|cause| Error::invalid("threads", "pool", cause.to_string()))
}
