//! What J, M⁻¹ and A of a scene's step take, and whether all storages assemble the same A.

use serde::{Deserialize, Serialize};

use crate::error::Result;
use crate::formulation::Problem;
use crate::report::study::settings::AtStep;
use crate::storage::Factors;
use crate::storage::{ALL, CompressedRows, Entry, Storage, Workspace, triple_product};

/// The matrices of a scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Structure {
    /// The scene.
    pub scene: String,
    /// Moving bodies.
    pub bodies: usize,
    /// Rows of J and A.
    pub rows: usize,
    /// Entries of J and of A.
    pub entries: [usize; 2],
    /// The share of A's entries that are not zero (%).
    pub fill: f64,
    /// Bytes of J, M⁻¹ and A in each storage.
    pub bytes: Vec<(String, [usize; 3])>,
    /// Whether the storages gave the same A to the last bit; `None` if A was too large to ask them.
    pub agree: Option<bool>,
}

/// Above this many entries the storages are not asked to assemble A too.
const MANY: usize = 10_000;

/// Loads the matrices of a step into every storage.
pub(super) fn run(task: &AtStep, problem: &Problem) -> Result<Structure> {
    let factors = Factors::of(&problem.assembly);
    let a = assembled(&factors)?;
    let sizes = [factors.rows, factors.columns, factors.rows];
    let widths = [factors.columns, factors.columns, factors.rows];
    let matrices = [&factors.jacobian, &factors.inverse_mass, &a];
    let mut bytes = Vec::new();
    for kind in &ALL {
        let mut own = [0; 3];
        for k in 0..3 {
            own[k] = match kind.name {
                "dense" => sizes[k] * widths[k] * size_of::<f64>(), // not made: it may not fit
                _ => {
                    let mut storage = (kind.new)(sizes[k], widths[k]);
                    storage.load(matrices[k])?;
                    storage.bytes()
                }
            };
        }
        bytes.push((kind.name.to_string(), own));
    }
    Ok(Structure {
        scene: task.scene.clone(),
        bodies: factors.inverse_masses.len(),
        rows: factors.rows,
        entries: [factors.jacobian.len(), a.len()],
        fill: 100.0 * a.len() as f64 / (factors.rows as f64).powi(2).max(1.0),
        bytes,
        agree: agree(&factors, &a)?,
    })
}

/// The entries of A.
pub(super) fn assembled(factors: &Factors) -> Result<Vec<Entry>> {
    let mut j = CompressedRows::new(factors.rows, factors.columns);
    j.load(&factors.jacobian)?;
    let mut m_inv = CompressedRows::new(factors.columns, factors.columns);
    m_inv.load(&factors.inverse_mass)?;
    let mut a = CompressedRows::new(0, 0);
    triple_product(&j, &m_inv, &mut a, &mut Workspace::default())?;
    entries_of(&a)
}

fn entries_of(a: &dyn Storage) -> Result<Vec<Entry>> {
    let mut entries = Vec::with_capacity(a.stored());
    for i in 0..a.rows() {
        a.visit_row(i, &mut |j, value| entries.push((i, j, value)))?;
    }
    Ok(entries)
}

/// Whether A is the same assembled in any storage.
fn agree(factors: &Factors, expected: &[Entry]) -> Result<Option<bool>> {
    if expected.len() > MANY {
        return Ok(None);
    }
    for kind in &ALL {
        let mut j = (kind.new)(factors.rows, factors.columns);
        j.load(&factors.jacobian)?;
        let mut m_inv = (kind.new)(factors.columns, factors.columns);
        m_inv.load(&factors.inverse_mass)?;
        let mut a = (kind.new)(0, 0);
        triple_product(j.as_ref(), m_inv.as_ref(), a.as_mut(), &mut Workspace::default())?;
        if entries_of(a.as_ref())? != expected {
            return Ok(Some(false));
        }
    }
    Ok(Some(true))
}
