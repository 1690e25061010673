//! What a command may use: `--time-limit`, `--max-memory`, and the patience of who types Ctrl-C.
//!
//! Commands that can stop halfway ask for the [`Stop`](Limits::stop): then Ctrl-C or SIGTERM raises
//! it, and they write what they have. The others end at once, by the system's own means or at the
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

/// How long after the limit a command that asks is still waited for: it waits itself for what
/// cannot be cut short, such as a factorisation, and then has to write.
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

/// What helps where something is larger than the limit.
pub const RAISE_MEMORY: &str = " (raise it with --max-memory)";

/// The end of a command's time.
pub struct Limits {
    stop: Stop,
    /// Whether the command asks when to stop.
    asks: Arc<AtomicBool>,
    /// Whether it has stopped working, and writes.
    is_over: Arc<AtomicBool>,
}

impl Limits {
    /// Starts the clock.
    pub fn begin(time: &TimeLimit) -> Self {
        let limits = Limits {
            stop: time.time_limit.map(Stop::after).unwrap_or_default(),
            asks: Arc::default(),
            is_over: Arc::default(),
        };
        if let Some(limit) = time.time_limit {
            let (asks, is_over) = (Arc::clone(&limits.asks), Arc::clone(&limits.is_over));
            thread::spawn(move || guard(limit, &asks, &is_over));
        }
        limits
    }

    /// When to stop, for a command that asks; from now on a signal is one of the reasons. A second
    /// one ends at once.
    pub fn stop(&self) -> &Stop {
        if self.asks.swap(true, Ordering::Relaxed) {
            return &self.stop; // it listens already
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

    /// Tells that the work is done, and what follows must not be cut short.
    pub fn over(&self) {
        self.is_over.store(true, Ordering::Relaxed);
    }
}

/// Does this at each Ctrl-C and SIGTERM; where nothing can listen to them, they end at once. SIGHUP
/// is left alone: `nohup` has it ignored.
#[cfg(unix)]
fn at_signals(mut act: impl FnMut() + Send + 'static) {
    use signal_hook::consts::{SIGINT, SIGTERM};
    if let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGINT, SIGTERM]) {
        thread::spawn(move || signals.forever().for_each(|_| act()));
    }
}

/// Has a write beyond the size that files may have (`ulimit -f`) fail with a message, as on a full
/// disk, instead of ending the program by SIGXFSZ with its temporary file left behind.
#[cfg(unix)]
pub fn outlive_file_size_limit() {
    // A handler is enough; nobody looks at the flag. Where there can be none, the signal ends the
    // program.
    let _ = signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Arc::default());
}

/// Only Unix has such a limit.
#[cfg(not(unix))]
pub fn outlive_file_size_limit() {}

/// Does this at each Ctrl-C; where nothing can listen to it, it ends at once.
#[cfg(not(unix))]
fn at_signals(act: impl FnMut() + Send + 'static) {
    let _ = ctrlc::set_handler(act);
}

/// Ends the program at the time limit if it cannot do so itself.
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

/// A positive number of seconds.
fn seconds(text: &str) -> Result<Duration, String> {
    let seconds = text.parse().ok().filter(|seconds| *seconds > 0.0 && *seconds <= 1e9);
    let seconds: f64 = seconds.ok_or("must be a number of seconds above 0")?;
    Ok(Duration::from_secs_f64(seconds))
}
