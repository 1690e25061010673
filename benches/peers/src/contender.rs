//! The contenders of a trial on a numerical problem.

/// The result of one run.
pub struct Run {
    /// The time (s).
    pub seconds: f64,
    /// The answer.
    pub x: Vec<f64>,
    /// The error that the contender itself reports.
    pub complaint: Option<String>,
}

/// A method with a problem.
pub struct Contender<'a> {
    pub name: String,
    /// Whether it is one of lcplab's.
    pub ours: bool,
    /// The required scaled residual.
    pub tolerance: f64,
    pub run: Box<dyn FnMut() -> Run + 'a>,
}

impl<'a> Contender<'a> {
    /// A peer, whose answers need a scaled residual of 1e-6; no peer accepts a scaled tolerance.
    pub fn peer(name: &str, run: impl FnMut() -> Run + 'a) -> Self {
        Contender { name: name.into(), ours: false, tolerance: 1e-6, run: Box::new(run) }
    }
}
