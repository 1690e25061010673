//! Degrees of freedom: what the equations leave of the bodies' velocities.
//!
//! ```text
//! freedoms = k − rank J_E
//! ```
//!
//! with k velocity components of moving bodies (6 a rigid body, 3 a point mass) and J_E the rows of
//! rigid equations. Counting rows instead of their rank is right only where the rows are independent:
//! Bricard's mechanism has 30 of each and moves. K&M "Maximal coordinates", E19, E20.

use nalgebra::DMatrix;

use lcplab_mechanics::assembly::Assembly;
use lcplab_mechanics::constraint::Bounds;

/// A singular value below this part of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-9;

/// What the equations leave of the bodies' velocities.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Freedoms {
    /// k, the velocity components of moving bodies.
    pub components: usize,
    /// The rows of rigid equations.
    pub rows: usize,
    /// The number of independent ones among them.
    pub rank: usize,
}

impl Freedoms {
    /// The degrees of freedom of a scene at an instant.
    pub fn of(assembly: &Assembly) -> Self {
        let rigid = |i: &usize| {
            let row = &assembly.rows[*i];
            row.bounds == Bounds::Bilateral && row.spring.is_none()
        };
        let rows: Vec<usize> = (0..assembly.rows.len()).filter(rigid).collect();
        let mut jacobian = DMatrix::zeros(rows.len(), assembly.columns());
        for (r, &i) in rows.iter().enumerate() {
            let entries = assembly.jacobian_row(i);
            let length = entries.iter().map(|(_, j)| j * j).sum::<f64>().sqrt();
            for (column, j) in entries {
                jacobian[(r, column)] = j / length;
            }
        }
        let rank = match jacobian.is_empty() {
            true => 0,
            false => {
                let singular = jacobian.singular_values();
                singular.iter().filter(|&&value| value > RELATIVE_ZERO * singular[0]).count()
            }
        };
        Freedoms { components: assembly.columns(), rows: rows.len(), rank }
    }

    /// The number that is left.
    pub fn left(&self) -> usize {
        self.components - self.rank
    }
}
