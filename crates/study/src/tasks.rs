//! Many tasks on all cores, of which the ends are handed over one by one.

use std::time::Duration;

use rayon::ThreadPoolBuilder;
use rayon::prelude::*;

use super::aside::Aside;
use lcplab_problem::error::{Error, Result};
use lcplab_solver::Stop;

/// Tasks that do not depend on each other.
pub struct Tasks<T> {
    /// Those that may run side by side, on as many threads as rayon's pool has.
    pub together: Vec<T>,
    /// Those that run after them, one after the other, because they are timed.
    pub alone: Vec<T>,
    /// How long those under way are waited for when it is time to stop: not at all if they do not
    /// ask.
    pub grace: Duration,
}

impl<T: Send + 'static> Tasks<T> {
    /// Does the `work` of every task and gives `note` each end as it comes. When it is time to
    /// stop, no more are begun.
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
        let pool = pool.map_err(|cause| Error::invalid("threads", "pool", cause.to_string()))?;
        let Tasks { together, alone, grace } = self;
        let asked = stop.clone();
        let ends = Aside::begin(stop, grace, move |sender| {
            let one = |task: T| {
                asked.reason().is_none().then_some(())?;
                let end = work(&task);
                sender.send((task, end)).ok() // None where nobody wants more
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
