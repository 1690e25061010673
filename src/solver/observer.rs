//! Someone who looks over a solver's shoulder.

use std::ops::ControlFlow;

/// Is told of every iterate, and may ask the solver to stop. `()` observes nothing.
pub trait Observer {
    /// Looks at an iterate; `Break` ends the solve with
    /// [`Status::Stopped`](super::Status::Stopped).
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()>;
}

impl Observer for () {
    fn observe(&mut self, _: &Iterate<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }
}

/// One iterate of a solver.
#[derive(Debug, Clone, Copy)]
pub struct Iterate<'a> {
    /// 0 for the start, then 1, 2, …
    pub iteration: usize,
    /// The unknowns now.
    pub x: &'a [f64],
    /// What led here.
    pub event: Event,
}

/// What a solver did to reach an iterate.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Event {
    /// The starting point.
    Start,
    /// One pass over all rows.
    Sweep,
    /// One step of a Newton or first-order method, all rows at once.
    Step,
    /// A pivoting method moved x while driving row `driven`; row `blocking` ended the move.
    Pivot {
        /// The row whose w is driven to 0.
        driven: usize,
        /// The row that changed sides, `driven` itself when it got there.
        blocking: usize,
    },
    /// A block of rows changed sides at once.
    Exchange {
        /// How many rows.
        rows: usize,
    },
    /// An enumeration looked at another active set.
    Trial,
}
