//! Records the iterates themselves.

use std::ops::ControlFlow;

use crate::{Event, Iterate, Observer};

/// An observer that keeps every iterate and its event, the start first.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Pgs, Solver, Start};
/// use lcplab_solver::trace::Path;
///
/// let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
/// let lcp = Lcp::new(a, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let mut path = Path::default();
/// Pgs::default().solve(&lcp, &Start::default(), &mut path);
/// assert_eq!(path.points[..2], [[0.0, 0.0], [0.5, 0.75]]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Path {
    /// x of every iterate, n entries each.
    pub points: Vec<Vec<f64>>,
    /// The event of each iterate.
    pub events: Vec<Event>,
}

impl Path {
    /// The largest distance in any row from a point, for each iterate: (iteration, distance).
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::trace::Path;
    /// use lcplab_solver::{Pgs, Solver, Start};
    ///
    /// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?; // x = (1, 1)
    /// let mut path = Path::default();
    /// Pgs::default().solve(&lcp, &Start::default(), &mut path);
    /// let distances = path.distances(&[1.0, 1.0]);
    /// assert_eq!(distances[..3], [(0.0, 1.0), (1.0, 0.5), (2.0, 0.125)]); // then by ¼ each
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn distances(&self, point: &[f64]) -> Vec<(f64, f64)> {
        let distance = |x: &Vec<f64>| {
            x.iter().zip(point).map(|(x, point)| (x - point).abs()).fold(0.0, f64::max)
        };
        self.points.iter().enumerate().map(|(k, x)| (k as f64, distance(x))).collect()
    }
}

impl Observer for Path {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.points.push(iterate.x.to_vec());
        self.events.push(iterate.event);
        ControlFlow::Continue(())
    }
}
