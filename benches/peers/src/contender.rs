//! Who takes part in a trial on numbers.

/// What came of one run.
pub struct Run {
    /// What it took (s).
    pub seconds: f64,
    /// The answer.
    pub x: Vec<f64>,
    /// What the contender itself says is wrong.
    pub complaint: Option<String>,
}

/// A method with a problem.
pub struct Contender<'a> {
    pub name: String,
    /// Whether it is one of lcplab's.
    pub ours: bool,
    /// The scaled residual that it has to reach.
    pub tolerance: f64,
    pub run: Box<dyn FnMut() -> Run + 'a>,
}

impl<'a> Contender<'a> {
    /// A peer; 1e-6 tells an answer from none, and no peer can be asked for a scaled residual.
    pub fn peer(name: &str, run: impl FnMut() -> Run + 'a) -> Self {
        Contender { name: name.into(), ours: false, tolerance: 1e-6, run: Box::new(run) }
    }
}
