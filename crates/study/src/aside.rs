//! Work on a thread of its own: its results come one by one, and it can be left behind.

use std::panic;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, SyncSender};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use lcplab_solver::Stop;

/// What asks when to stop, but cannot be cut short at every place, has so much time to come to its
/// end.
pub const GRACE: Duration = Duration::from_secs(2);

/// How often it is looked whether to stop while no result comes.
const LOOK: Duration = Duration::from_millis(50);
/// So many results may wait to be taken: a large one is not held more often than it must be.
const WAITING: usize = 1;

/// The results of work on a thread of its own. They end when the work does; or, once it is time to
/// stop, when no more have come within the time of grace: then the thread is left behind, and what
/// it has under way comes to nothing.
pub struct Aside<T> {
    results: Receiver<T>,
    thread: Option<JoinHandle<()>>,
    stop: Stop,
    grace: Duration,
    /// Since when it is known that it is time to stop.
    since: Option<Instant>,
}

impl<T: Send + 'static> Aside<T> {
    /// Begins the work. It sends its results, and should end when they are no longer taken.
    pub fn begin(
        stop: &Stop,
        grace: Duration,
        work: impl FnOnce(&SyncSender<T>) + Send + 'static,
    ) -> Self {
        let (sender, results) = mpsc::sync_channel(WAITING);
        let thread = Some(thread::spawn(move || work(&sender)));
        Aside { results, thread, stop: stop.clone(), grace, since: None }
    }
}

impl<T> Iterator for Aside<T> {
    type Item = T;

    /// # Panics
    /// If the work did.
    fn next(&mut self) -> Option<T> {
        loop {
            match self.results.recv_timeout(LOOK) {
                Ok(result) => return Some(result),
                Err(RecvTimeoutError::Disconnected) => {
                    if let Some(Err(cause)) = self.thread.take().map(JoinHandle::join) {
                        panic::resume_unwind(cause);
                    }
                    return None;
                }
                Err(RecvTimeoutError::Timeout) if self.stop.reason().is_some() => {
                    if self.since.get_or_insert_with(Instant::now).elapsed() >= self.grace {
                        return None;
                    }
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        }
    }
}
