//! Limits of a command: `--time-limit`, `--max-memory`, and Ctrl-C.
//!
//! Commands that can stop early request the [`Stop`](Limits::stop): then Ctrl-C or SIGTERM raises
//! it, and they write what they have. The others end immediately, by the system's default or at the
//! time limit.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

use clap::Args;
use lcplab::error::Result;
use lcplab::memory::Memory;
use lcplab::report::aside::GRACE;
use lcplab::solver::{Reason, Stop};

use super::{code, say};

/// The additional time for a command that checks the stop condition: it may have to finish an
/// operation that cannot be interrupted, such as a factorization, and then has to write.
const PATIENCE: Duration = GRACE.saturating_mul(2);

/// The same for a command that has [last words](Limits::last_words), so that little is lost.
const SHORT_PATIENCE: Duration = Duration::from_secs(1);

/// How long a command may take.
#[derive(Debug, Args)]
pub struct TimeLimit {
    /// Stop after this time and write what was computed [default: no limit]
    #[arg(long, global = true, value_name = "SECONDS", value_parser = seconds)]
    time_limit: Option<Duration>,
}

/// How much memory a command may use.
#[derive(Debug, Clone, Copy, Args)]
pub struct MemoryLimit {
    /// Memory limit for any single object: a problem, a matrix, a factor, a recording
    #[arg(long, value_name = "SIZE", default_value = "4GB")]
    pub max_memory: Memory,
}

/// The hint if something is larger than the limit.
pub const RAISE_MEMORY: &str = " (raise it with --max-memory)";

/// What a command prints if it is ended before it is finished.
type LastWords = Box<dyn FnOnce() -> Result<()> + Send>;

/// The running time limit of a command.
#[derive(Clone)]
pub struct Limits {
    stop: Stop,
    /// Whether the command checks the stop condition.
    asks: Arc<AtomicBool>,
    /// Whether it has finished its work and is writing.
    is_over: Arc<AtomicBool>,
    last_words: Arc<Mutex<Option<LastWords>>>,
}

impl Limits {
    /// Starts the time limit.
    pub(crate) fn begin(time: &TimeLimit) -> Self {
        let limits = Limits {
            stop: time.time_limit.map(Stop::after).unwrap_or_default(),
            asks: Arc::default(),
            is_over: Arc::default(),
            last_words: Arc::default(),
        };
        if let Some(limit) = time.time_limit {
            let limits = limits.clone();
            in_background(move || {
                thread::sleep(limit);
                limits.force(Reason::TimeLimit(limit));
            });
        }
        limits
    }

    /// The stop condition, for a command that checks it; from now on signals raise it. A second
    /// signal ends the program immediately.
    pub(crate) fn stop(&self) -> &Stop {
        if self.asks.swap(true, Ordering::Relaxed) {
            // The handler is already installed.
            return &self.stop;
        }
        let (limits, mut was_asked) = (self.clone(), false);
        at_signals(move || {
            if was_asked {
                process::exit(code(Reason::Interrupted).into());
            }
            was_asked = true;
            say("stopping; press Ctrl-C again to end at once");
            limits.stop.raise();
            if limits.has_last_words() {
                let limits = limits.clone();
                in_background(move || limits.force(Reason::Interrupted));
            }
        });
        &self.stop
    }

    /// What to print if the program is ended because the command does not stop by itself.
    pub(crate) fn last_words(&self, words: impl FnOnce() -> Result<()> + Send + 'static) {
        *self.words() = Some(Box::new(words));
    }

    /// Marks the work as done; what follows must not be interrupted.
    pub(crate) fn over(&self) {
        if self.is_over.swap(true, Ordering::Relaxed) {
            // The program is being ended.
            loop {
                thread::park();
            }
        }
    }

    fn words(&self) -> MutexGuard<'_, Option<LastWords>> {
        self.last_words.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn has_last_words(&self) -> bool {
        self.words().is_some()
    }

    /// Ends the program if the command does not stop by itself in time.
    fn force(&self, reason: Reason) {
        thread::sleep(match (self.asks.load(Ordering::Relaxed), self.has_last_words()) {
            (false, _) => Duration::ZERO,
            (true, false) => PATIENCE,
            (true, true) => SHORT_PATIENCE,
        });
        if self.is_over.swap(true, Ordering::Relaxed) {
            return;
        }
        match self.words().take().map(|words| words()) {
            Some(_) => say(&format!("error: {reason}")),
            None => say(&format!("error: {reason}; unfinished work is lost")),
        }
        process::exit(code(reason).into());
    }
}

/// Runs `act` at each Ctrl-C and SIGTERM; if signals cannot be handled, they end the program.
/// SIGHUP is not handled, so that `nohup` can ignore it.
#[cfg(unix)]
fn at_signals(mut act: impl FnMut() + Send + 'static) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) {
        in_background(move || signals.forever().for_each(|_| act()));
    }
}

/// Makes a write beyond the maximum file size (`ulimit -f`) fail with a message, as on a full disk,
/// instead of ending the program by SIGXFSZ and leaving its temporary file behind.
#[cfg(unix)]
pub fn outlive_file_size_limit() {
    // A handler is enough; the flag is not used. If it cannot be installed, the signal ends the
    // program.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Only Unix has such a limit.
#[cfg(not(unix))]
pub fn outlive_file_size_limit() {}

/// Runs `act` at each Ctrl-C; if it cannot be handled, it ends the program.
#[cfg(not(unix))]
fn at_signals(act: impl FnMut() + Send + 'static) {
    let _ = ctrlc::set_handler(act);
}

/// Runs `work` on another thread. In a browser there are none: then only the commands that check
/// the stop condition keep the time limit.
fn in_background(work: impl FnOnce() + Send + 'static) {
    let _ = thread::Builder::new().spawn(work);
}

/// Parses a positive number of seconds.
fn seconds(text: &str) -> std::result::Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0 && *seconds <= 1e9);
    let seconds: f64 = seconds.ok_or("must be a number of seconds above 0")?;
    Ok(Duration::from_secs_f64(seconds))
}
