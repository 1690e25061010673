//! Limits of a command: `--time-limit`, `--max-memory`, and Ctrl-C.
//!
//! Commands that can stop early request the [`Stop`](Limits::stop): then Ctrl-C or SIGTERM raises
//! it, and they write what they have. The others end immediately, by the system's default or at the
//! time limit.

use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;
use std::time::Duration;

use clap::Args;
use lcplab::memory::Memory;
use lcplab::report::aside::GRACE;
use lcplab::solver::{Reason, Stop};

use super::{code, say};

/// The additional time for a command that checks the stop condition: it may have to finish an
/// operation that cannot be interrupted, such as a factorization, and then has to write.
const PATIENCE: Duration = GRACE.saturating_mul(2);

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

/// The running time limit of a command.
pub struct Limits {
    stop: Stop,
    /// Whether the command checks the stop condition.
    asks: Arc<AtomicBool>,
    /// Whether it has finished its work and is writing.
    is_over: Arc<AtomicBool>,
}

impl Limits {
    /// Starts the time limit.
    pub(crate) fn begin(time: &TimeLimit) -> Self {
        let limits = Limits {
            stop: time.time_limit.map(Stop::after).unwrap_or_default(),
            asks: Arc::default(),
            is_over: Arc::default(),
        };
        if let Some(limit) = time.time_limit {
            let (asks, is_over) = (Arc::clone(&limits.asks), Arc::clone(&limits.is_over));
            in_background(move || guard(limit, &asks, &is_over));
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
        let (stop, mut was_asked) = (self.stop.clone(), false);
        at_signals(move || {
            if was_asked {
                process::exit(code(Reason::Interrupted).into());
            }
            was_asked = true;
            say("stopping; press Ctrl-C again to end at once");
            stop.raise();
        });
        &self.stop
    }

    /// Marks the work as done; what follows must not be interrupted.
    pub(crate) fn over(&self) {
        self.is_over.store(true, Ordering::Relaxed);
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

/// Ends the program at the time limit if it cannot end by itself.
fn guard(limit: Duration, asks: &AtomicBool, is_over: &AtomicBool) {
    thread::sleep(limit);
    if asks.load(Ordering::Relaxed) {
        thread::sleep(PATIENCE);
    }
    if !is_over.load(Ordering::Relaxed) {
        let reason = Reason::TimeLimit(limit);
        say(&format!("error: {reason}; unfinished work is lost"));
        process::exit(code(reason).into());
    }
}

/// Parses a positive number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0 && *seconds <= 1e9);
    let seconds: f64 = seconds.ok_or("must be a number of seconds above 0")?;
    Ok(Duration::from_secs_f64(seconds))
}
