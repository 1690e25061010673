//! A = J M⁻¹ Jᵀ from matrices in any storage format: the line of Codes 4, 7 and 8.
//!
//! Row by row (Gustavson 1978): the response M⁻¹ J_iᵀ is computed in a dense row, then its product
//! with each row of J that shares a column with it. The work depends on the number of matching
//! entries, not on the sizes. Sums run over ascending columns, so A is bitwise identical for any
//! storage formats of J, M⁻¹ and A; it is symmetric up to rounding.

use super::{Entry, Pool, Result, Storage, check_length};

/// The buffers of products, kept from step to step.
#[derive(Debug, Clone, Default)]
pub struct Workspace {
    numbers: Pool<f64>,
    indices: Pool<u32>,
    entries: Pool<Entry>,
    /// The number of entries of the largest product so far.
    largest: usize,
}

impl Workspace {
    /// The number of memory allocations.
    pub fn allocations(&self) -> usize {
        self.numbers.allocations() + self.indices.allocations() + self.entries.allocations()
    }

    /// The allocated memory (bytes).
    pub fn bytes(&self) -> usize {
        self.numbers.bytes() + self.indices.bytes() + self.entries.bytes()
    }
}

/// A ← J M⁻¹ Jᵀ. A is resized and overwritten; M⁻¹ must be symmetric.
///
/// ```
/// use lcplab::storage::{self, Dense, MapOfMaps, Storage, triple_product};
///
/// let j = Dense::from_rows(2, 2, &[1.0, 0.0, -1.0, 1.0])?;
/// let m_inv = Dense::from_rows(2, 2, &[0.5, 0.0, 0.0, 0.25])?;
/// let mut a = MapOfMaps::new(0, 0);
/// triple_product(&j, &m_inv, &mut a, &mut storage::Workspace::default())?;
/// assert_eq!(a.row(1)?, [(0, -0.5), (1, 0.75)]);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
///
/// # Errors
/// [`Error::Length`](super::Error::Length) if the sizes do not match; errors of A.
pub fn triple_product(
    j: &dyn Storage,
    m_inv: &dyn Storage,
    a: &mut dyn Storage,
    workspace: &mut Workspace,
) -> Result<()> {
    check_length("M⁻¹'s rows", m_inv.rows(), j.columns())?;
    check_length("M⁻¹'s columns", m_inv.columns(), j.columns())?;
    let columns = Columns::of(j, workspace)?;
    let mut response = Accumulator::new(j.columns(), workspace);
    let mut row = Accumulator::new(j.rows(), workspace);
    let mut entries = workspace.entries.with_room(workspace.largest.max(1));
    let room = entries.capacity();
    for i in 0..j.rows() {
        let mut outcome = Ok(());
        j.visit_row(i, &mut |d, j_id| {
            let visit = &mut |c: usize, m: f64| response.add(c, m * j_id);
            outcome = outcome.and(m_inv.visit_row(d, visit)); // r = M⁻¹ J_iᵀ
        })?;
        outcome?;
        response.drain(|c, r_c| columns.entries(c).for_each(|(k, j_kc)| row.add(k, r_c * j_kc)));
        row.drain(|k, a_ik| {
            if a_ik != 0.0 {
                entries.push((i, k, a_ik));
            }
        });
    }
    a.reset(j.rows(), j.rows())?;
    let loaded = a.load(&entries);
    workspace.entries.count_growth(room, entries.capacity());
    workspace.largest = workspace.largest.max(entries.len());
    workspace.entries.give(entries);
    columns.give(workspace);
    response.give(workspace);
    row.give(workspace);
    loaded
}

/// The entries of a matrix by columns.
struct Columns {
    starts: Vec<u32>,
    rows: Vec<u32>,
    values: Vec<f64>,
}

impl Columns {
    fn of(j: &dyn Storage, workspace: &mut Workspace) -> Result<Self> {
        let mut starts = workspace.indices.take(j.columns() + 2);
        let mut count = 0;
        for row in 0..j.rows() {
            j.visit_row(row, &mut |column, _| {
                starts[column + 2] += 1;
                count += 1;
            })?;
        }
        for column in 2..starts.len() {
            starts[column] += starts[column - 1];
        }
        let mut rows = workspace.indices.take(count);
        let mut values = workspace.numbers.take(count);
        for row in 0..j.rows() {
            j.visit_row(row, &mut |column, value| {
                let k = starts[column + 1] as usize; // becomes the end of its column
                (rows[k], values[k]) = (row as u32, value);
                starts[column + 1] += 1;
            })?;
        }
        Ok(Columns { starts, rows, values })
    }

    /// The entries (row, value) of a column, rows ascending.
    fn entries(&self, column: usize) -> impl Iterator<Item = (usize, f64)> {
        let range = self.starts[column] as usize..self.starts[column + 1] as usize;
        range.map(|k| (self.rows[k] as usize, self.values[k]))
    }

    fn give(self, workspace: &mut Workspace) {
        workspace.indices.give(self.starts);
        workspace.indices.give(self.rows);
        workspace.numbers.give(self.values);
    }
}

/// A sparse sum: a dense row of numbers and the list of nonzero positions.
struct Accumulator {
    sums: Vec<f64>,
    touched: Vec<u32>,
    is_touched: Vec<u32>,
}

impl Accumulator {
    fn new(len: usize, workspace: &mut Workspace) -> Self {
        Accumulator {
            sums: workspace.numbers.take(len),
            touched: workspace.indices.with_room(len),
            is_touched: workspace.indices.take(len),
        }
    }

    fn add(&mut self, place: usize, value: f64) {
        self.sums[place] += value;
        if self.is_touched[place] == 0 {
            self.is_touched[place] = 1;
            self.touched.push(place as u32);
        }
    }

    /// Calls `show` with the sums in ascending order of positions, and sets them to zero.
    fn drain(&mut self, mut show: impl FnMut(usize, f64)) {
        self.touched.sort_unstable();
        for place in self.touched.drain(..) {
            let place = place as usize;
            show(place, std::mem::take(&mut self.sums[place]));
            self.is_touched[place] = 0;
        }
    }

    fn give(self, workspace: &mut Workspace) {
        workspace.numbers.give(self.sums);
        workspace.indices.give(self.touched);
        workspace.indices.give(self.is_touched);
    }
}
