//! Stop conditions: a flag that can be raised, and a time limit.
//!
//! Long computations check a [`Stop`] between steps and tasks and pass it to solves by
//! [`watch`](Stop::watch); a solve then ends with [`Status::Stopped`](super::Status::Stopped) at
//! its next iterate. A single sweep, pivot or factorization is not interrupted.

use std::fmt;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use super::{Iterate, Observer, StepDetail};

/// A stop condition. Clones share the flag.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Pgs, Solver, Start, Status, Stop};
///
/// let stop = Stop::default();
/// stop.raise();
/// let lcp = Lcp::new(Matrix::dense(1, &[1.0]), vec![-1.0], vec![0.0], vec![2.0])?;
/// let solution = Pgs::default().solve(&lcp, &Start::default(), &mut stop.watch(&mut ()));
/// assert_eq!(solution.status, Status::Stopped);
/// assert_eq!(stop.reason().unwrap().to_string(), "interrupted");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default)]
pub struct Stop {
    raised: Arc<AtomicBool>,
    deadline: Option<(Instant, Duration)>,
}

/// The reason for a stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Reason {
    /// The flag was raised, by a user or the system.
    Interrupted,
    /// This time limit was reached.
    TimeLimit(Duration),
}

impl Stop {
    /// A stop condition with this time limit, starting now.
    ///
    /// ```
    /// use std::time::Duration;
    ///
    /// use lcplab_solver::{Reason, Stop};
    ///
    /// assert_eq!(Stop::after(Duration::from_secs(3600)).reason(), None);
    /// let over = Stop::after(Duration::ZERO).reason();
    /// assert_eq!(over, Some(Reason::TimeLimit(Duration::ZERO)));
    /// ```
    pub fn after(limit: Duration) -> Self {
        let deadline = Instant::now().checked_add(limit).map(|end| (end, limit));
        Stop { deadline, ..Stop::default() }
    }

    /// Raises the flag.
    pub fn raise(&self) {
        self.raised.store(true, Ordering::Relaxed);
    }

    /// The reason to stop, if there is one now.
    pub fn reason(&self) -> Option<Reason> {
        if self.raised.load(Ordering::Relaxed) {
            return Some(Reason::Interrupted);
        }
        let (end, limit) = self.deadline?;
        (Instant::now() >= end).then_some(Reason::TimeLimit(limit))
    }

    /// Wraps the observer so that it also stops the solver when this condition is met.
    pub fn watch<'a>(&'a self, observer: &'a mut dyn Observer) -> StopObserver<'a> {
        StopObserver { stop: self, observer }
    }
}

/// An observer that also checks a stop condition.
pub struct StopObserver<'a> {
    stop: &'a Stop,
    observer: &'a mut dyn Observer,
}

impl Observer for StopObserver<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.observer.observe(iterate)?;
        match self.stop.reason() {
            Some(_) => ControlFlow::Break(()),
            None => ControlFlow::Continue(()),
        }
    }

    fn wants_details(&self) -> bool {
        self.observer.wants_details()
    }

    fn part(&mut self, part: &StepDetail<'_>) {
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
