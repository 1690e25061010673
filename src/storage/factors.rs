//! J and M⁻¹ as entries, for the matrices of [`storage`](crate::storage).

use nalgebra::{Matrix6, Vector6};

use crate::assembly::{Assembly, Block};
use crate::solver::kernel::impulses::{Row, WIDTH};
use crate::storage::Entry;

/// The factors of A = J M⁻¹ Jᵀ with six columns per moving body; for a point mass the last three
/// are empty.
///
/// ```
/// use lcplab::assembly::{Assembly, ConstraintFilter};
/// use lcplab::scene::Scene;
/// use lcplab::storage::Factors;
///
/// // A bob of 1 kg on a rod along x: J = (1, 0, 0), and so is Ĵ.
/// let scene = Scene::load("pendulum")?;
/// let filter = ConstraintFilter::Near;
/// let assembly = Assembly::new(&scene, &scene.states, &[], filter).expect("a direction");
/// let factors = Factors::of(&assembly);
/// assert_eq!((factors.rows, factors.bodies(), factors.columns), (1, 1, 6));
/// assert_eq!(factors.scaled_rows()[0].jacobian[0][..3], [1.0, 0.0, 0.0]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Factors {
    /// The number of rows of J.
    pub rows: usize,
    /// The number of columns of J, and of rows and columns of M⁻¹.
    pub columns: usize,
    /// The entries of J, row by row.
    pub jacobian: Vec<Entry>,
    /// The diagonal blocks of M⁻¹ (1/kg, 1/(kg m²)), one per moving body.
    pub inverse_masses: Vec<Matrix6<f64>>,
}

impl Factors {
    /// The factors of an assembly.
    pub fn of(assembly: &Assembly) -> Self {
        Factors {
            rows: assembly.rows.len(),
            columns: WIDTH * assembly.blocks.len(),
            jacobian: jacobian(assembly),
            inverse_masses: assembly.blocks.iter().map(inverse_mass).collect(),
        }
    }

    /// The number of bodies, one for each six columns.
    pub fn bodies(&self) -> usize {
        self.inverse_masses.len()
    }

    /// The rows of Ĵ = J L with M⁻¹ = L Lᵀ, so that A = Ĵ Ĵᵀ: for sweeps that never form A.
    pub fn scaled_rows(&self) -> Vec<Row> {
        let roots: Vec<_> = self.inverse_masses.iter().map(root).collect();
        let mut rows = vec![Row { bodies: [0; 2], jacobian: [[0.0; WIDTH]; 2] }; self.rows];
        for (row, entries) in self.jacobian.chunk_by(|a, b| a.0 == b.0).map(|e| (e[0].0, e)) {
            for (side, part) in entries.chunk_by(|a, b| a.1 / WIDTH == b.1 / WIDTH).enumerate() {
                let body = part[0].1 / WIDTH;
                let mut j = Vector6::zeros();
                part.iter().for_each(|&(_, column, value)| j[column % WIDTH] = value);
                rows[row].bodies[side..].fill(body);
                rows[row].jacobian[side] = (roots[body].transpose() * j).into();
            }
        }
        rows
    }
}

/// L with M⁻¹ = L Lᵀ, lower triangular; a column is zero if that of M⁻¹ is.
fn root(inverse_mass: &Matrix6<f64>) -> Matrix6<f64> {
    let mut l = Matrix6::zeros();
    for j in 0..WIDTH {
        let left =
            |i: usize| inverse_mass[(i, j)] - (0..j).map(|k| l[(i, k)] * l[(j, k)]).sum::<f64>();
        let pivot = left(j).max(0.0).sqrt();
        if pivot > 0.0 {
            let column: Vec<f64> = (j..WIDTH).map(|i| left(i) / pivot).collect();
            (j..WIDTH).zip(column).for_each(|(i, value)| l[(i, j)] = value);
        }
    }
    l
}

fn jacobian(assembly: &Assembly) -> Vec<Entry> {
    let mut entries = Vec::new();
    for (i, row) in assembly.rows.iter().enumerate() {
        let first = entries.len();
        for part in row.parts() {
            let dof = assembly.blocks[part.block].dof;
            let values = part.jacobian.iter().take(dof).enumerate().filter(|(_, j)| **j != 0.0);
            entries.extend(values.map(|(k, &j)| (i, WIDTH * part.block + k, j)));
        }
        entries[first..].sort_by_key(|&(_, column, _)| column);
    }
    entries
}

/// M⁻¹ of a body, column by column.
fn inverse_mass(block: &Block) -> Matrix6<f64> {
    let column = |k: usize| block.accelerate(&Vector6::ith(k, f64::from(u8::from(k < block.dof))));
    Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(column))
}
