//! When to stop: a flag that someone raises, and a deadline.
//!
//! Whoever works for long asks a [`Stop`] between steps and tasks, and lets it
//! [`watch`](Stop::watch) the solves: they end with [`Status::Stopped`](super::Status::Stopped) at
//! their next iterate. What lies between two iterates is not cut short: a sweep, a pivot, a
//! factorisation.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::{Iterate, Observer, Part};

/// Says when to stop. Clones share the flag.
///
/// ```
/// use lcplab_problem::{Lcp, Matrix};
/// use lcplab_solver::{Options, Start, Status, Stop, by_name};
///
/// let stop = Stop::default();
/// stop.raise();
/// let lcp = Lcp::new(Matrix::dense(1, &[1.0]), vec![-1.0], vec![0.0], vec![2.0])?;
/// let pgs = by_name("pgs", &Options::default())?;
/// let solution = pgs.solve(&lcp, &Start::default(), &mut stop.watch(&mut ()));
/// assert_eq!(solution.status, Status::Stopped);
/// assert_eq!(stop.reason().unwrap().to_string(), "interrupted");
/// # Ok::<(), lcplab_problem::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Stop {
    raised: Arc<AtomicBool>,
    deadline: Option<(Instant, Duration)>,
}

/// Why something was stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The flag was raised, by a user who had enough or a system that needs the machine.
    Interrupted,
    /// This much time was over.
    TimeLimit(Duration),
}

impl Stop {
    /// Stops after so much time, counted from now.
    pub fn after(limit: Duration) -> Self {
        let deadline = Instant::now().checked_add(limit).map(|end| (end, limit));
        Stop { deadline, ..Stop::default() }
    }

    /// Raises the flag.
    pub fn raise(&self) {
        self.raised.store(true, Ordering::Relaxed);
    }

    /// Why to stop, if it is time to.
    pub fn reason(&self) -> Option<Reason> {
        if self.raised.load(Ordering::Relaxed) {
            return Some(Reason::Interrupted);
        }
        let (end, limit) = self.deadline?;
        (Instant::now() >= end).then_some(Reason::TimeLimit(limit))
    }

    /// The same observer, which asks the solver to stop when it is time to.
    pub fn watch<'a>(&'a self, observer: &'a mut dyn Observer) -> Watched<'a> {
        Watched { stop: self, observer }
    }
}

/// An observer that stops in time.
pub struct Watched<'a> {
    stop: &'a Stop,
    observer: &'a mut dyn Observer,
}

impl Observer for Watched<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.observer.observe(iterate)?;
        match self.stop.reason() {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        }
    }

    fn asks_for_parts(&self) -> bool {
        self.observer.asks_for_parts()
    }

    fn part(&mut self, part: &Part<'_>) {
        self.observer.part(part);
    }
}

impl fmt::Display for Reason {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Reason::Interrupted => f.write_str("interrupted"),
            Reason::TimeLimit(limit) => {
                write!(f, "stopped by the time limit of {} s", limit.as_secs_f64())
            }
        }
    }
}
