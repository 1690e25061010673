//! Fill of the factor of A with three orderings: the cost of a direct method.

use serde::{Deserialize, Serialize};

use super::problem;
use crate::error::{Error, Result};
use crate::plot::Raster;
use crate::report::study::settings::AtStep;
use crate::storage::{Graph, Ordering};

/// The number of cells along the side of a picture.
const CELLS: usize = 110;

/// The factor of a scene's A.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Factor {
    /// The scene.
    pub scene: String,
    /// The number of the step, from 1.
    pub step: usize,
    /// The number of rows of A.
    pub rows: usize,
    /// The number of entries of A on and below the diagonal.
    pub lower: usize,
    /// The factor with each ordering.
    pub ordered: Vec<Ordered>,
}

/// A factor with one ordering.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Ordered {
    /// The ordering's name.
    pub ordering: String,
    /// The largest distance of an entry of A from the diagonal.
    pub bandwidth: usize,
    /// The number of entries of L, including the diagonal.
    pub entries: usize,
    /// Multiplications of the factorization: Σ over columns of the entries below the diagonal,
    /// squared.
    pub work: f64,
    /// The pattern of the factor.
    pub picture: Raster,
}

/// Factorizes the pattern of A of a scene's step.
///
/// # Errors
/// If the simulation does not reach this step, or the step has no rows.
pub fn run(task: &AtStep) -> Result<Factor> {
    let problem = problem(task)?.ok_or_else(|| {
        let reason = format!("has no rows in step {}", task.step);
        Error::invalid("sparsity", &task.scene, reason)
    })?;
    let matrix = problem.lcp.matrix();
    let n = matrix.len();
    let graph = Graph::of(n, matrix.pattern());
    let ordered = Ordering::ALL.iter().map(|ordering| factored(*ordering, &graph)).collect();
    let (scene, step) = (task.scene.clone(), task.step);
    Ok(Factor { scene, step, rows: n, lower: graph.lower_entries(), ordered })
}

fn factored(ordering: Ordering, graph: &Graph) -> Ordered {
    let (n, order) = (graph.len(), ordering.rows(graph));
    let mut below = vec![0_usize; n];
    let picture = Raster::new((n, n), CELLS, |mark| {
        graph.visit_factor(&order, &mut |i, j| {
            mark(i, j);
            below[j] += usize::from(i > j);
        });
    });
    Ordered {
        ordering: ordering.name().into(),
        bandwidth: graph.bandwidth(&order),
        entries: picture.nonzeros,
        work: below.iter().map(|&count| (count as f64).powi(2)).sum(),
        picture,
    }
}
