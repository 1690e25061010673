//! Work on a separate thread whose results are received one by one, and which can be abandoned.

use std::panic;
use std::sync::mpsc::{self, Receiver, RecvTimeoutError};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

use lcplab_solver::Stop;

/// The time that work gets to finish after a stop, because it cannot be interrupted everywhere.
pub const GRACE: Duration = Duration::from_secs(2);

/// How often the stop condition is checked while no result arrives.
const LOOK: Duration = Duration::from_millis(50);
/// Maximum number of results that wait in the channel; small because a result may need much memory.
const WAITING: usize = 1;

/// The results of work on a separate thread. The iterator ends when the work ends; or, after a
/// stop, when no more results arrive within the grace period: the thread is then abandoned, and its
/// current result is lost.
pub struct Aside<T> {
    results: Receiver<T>,
    thread: Option<JoinHandle<()>>,
    stop: Stop,
    grace: Duration,
    /// The time since which a stop is known.
    since: Option<Instant>,
}

impl<T: Send + 'static> Aside<T> {
    /// Starts the work, which sends its results and should end when they are no longer received, as
    /// the function that sends a result then returns false. Without threads, in a browser, all of
    /// the work is done here.
    pub fn begin(
        stop: &Stop,
        grace: Duration,
        work: impl FnOnce(&(dyn Fn(T) -> bool + Sync)) + Send + 'static,
    ) -> Self {
        let (thread, results) = if cfg!(target_os = "emscripten") {
            let (sender, results) = mpsc::channel();
            work(&|result| sender.send(result).is_ok());
            (None, results)
        } else {
            let (sender, results) = mpsc::sync_channel(WAITING);
            (Some(thread::spawn(move || work(&|result| sender.send(result).is_ok()))), results)
        };
        Aside { results, thread, stop: stop.clone(), grace, since: None }
    }
}

impl<T> Iterator for Aside<T> {
    type Item = T;

    /// # Panics
    /// If the work panicked.
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
