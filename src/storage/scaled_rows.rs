//! The rows of J in units where all masses are 1, for sweeps that never form A.

use nalgebra::{Matrix6, Vector6};

use crate::assembly::{Assembly, Block};
use crate::solver::kernel::impulses::{Row, WIDTH};

/// The rows of Ĵ = J L with M⁻¹ = L Lᵀ, so that A = Ĵ Ĵᵀ, by the blocks of an assembly; for a point
/// mass the last three of a block's six entries are 0.
///
/// ```
/// use lcplab::assembly::{Assembly, ConstraintFilter};
/// use lcplab::scene::Scene;
/// use lcplab::storage::scaled_rows;
///
/// // A bob of 1 kg on a rod along x: J = (1, 0, 0), and so is Ĵ.
/// let scene = Scene::load("pendulum")?;
/// let filter = ConstraintFilter::Near;
/// let assembly = Assembly::new(&scene, &scene.states, &[], filter).expect("a direction");
/// let rows = scaled_rows(&assembly);
/// assert_eq!((rows.len(), rows[0].bodies), (1, [0, 0]));
/// assert_eq!(rows[0].jacobian[0][..3], [1.0, 0.0, 0.0]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
pub fn scaled_rows(assembly: &Assembly) -> Vec<Row> {
    let roots: Vec<_> = assembly.blocks.iter().map(inverse_mass).map(|m| root(&m)).collect();
    let mut rows = Vec::with_capacity(assembly.rows.len());
    for own in &assembly.rows {
        let mut row = Row { bodies: [0; 2], jacobian: [[0.0; WIDTH]; 2] };
        let mut parts: Vec<(usize, Vector6<f64>)> = own
            .parts()
            .map(|part| {
                let dof = assembly.blocks[part.block].dof;
                let entry = |k: usize| if k < dof { part.jacobian[k] } else { 0.0 };
                (part.block, Vector6::from_fn(|k, _| entry(k)))
            })
            .filter(|(_, jacobian)| *jacobian != Vector6::zeros())
            .collect();
        parts.sort_by_key(|(block, _)| *block);
        for (side, (block, jacobian)) in parts.into_iter().enumerate() {
            row.bodies[side..].fill(block);
            row.jacobian[side] = (roots[block].transpose() * jacobian).into();
        }
        rows.push(row);
    }
    rows
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

/// M⁻¹ of a body, column by column.
fn inverse_mass(block: &Block) -> Matrix6<f64> {
    let column = |k: usize| block.accelerate(&Vector6::ith(k, f64::from(u8::from(k < block.dof))));
    Matrix6::from_columns(&[0, 1, 2, 3, 4, 5].map(column))
}
