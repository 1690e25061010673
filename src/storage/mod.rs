//! The chapter's matrices: one small interface with several storage formats.
//!
//! K&M build their solver on a dense matrix class (Codes 8-10), then put a map of maps behind the
//! same interface (Code 11) and name other candidates. Here the dense matrix, the map of maps, the
//! chapter's linked list and compressed rows implement [`Storage`], so that one program runs with
//! each and gives bitwise identical results:
//!
//! ```
//! use lcplab::storage::{self, MapOfMaps, Storage};
//!
//! let mut a = MapOfMaps::new(3, 3);
//! a.set(0, 0, 2.0)?;
//! a.set(0, 2, -1.0)?;
//! assert_eq!(a.row(0)?, [(0, 2.0), (2, -1.0)]);
//! assert_eq!(a.set(3, 0, 1.0).unwrap_err().to_string(), "entry (3, 0) is outside a 3 × 3 matrix");
//!
//! for kind in &storage::ALL {
//!     let mut same = (kind.new)(3, 3);
//!     same.load(&[(0, 0, 2.0), (0, 2, -1.0)])?;
//!     assert_eq!(same.row(0)?, a.row(0)?);
//!     println!("{:<20} {:>4} bytes", kind.name, same.bytes());
//! }
//! # Ok::<(), lcplab::error::Error>(())
//! ```
//!
//! Zero entries are not stored: setting an entry to zero removes it (E54), and a row's entries are
//! its nonzero ones, columns ascending, in every format. [`sweep`] runs projected Gauss-Seidel with
//! any of them, [`Factors`] has J and M⁻¹ for sweeps that never assemble A
//! (the kernel `impulses`), and [`Ordering`] gives the fill of a factor of
//! A.

mod compressed;
mod dense;
mod error;
mod factors;
mod kind;
mod list;
mod map;
mod nodes;
mod ordering;
mod slots;
mod sweep;

pub use compressed::CompressedRows;
pub use dense::Dense;
pub use error::{Error, Result};
pub use factors::Factors;
pub use kind::{ALL, Kind};
pub use list::LinkedList;
pub use map::MapOfMaps;
pub use ordering::{Graph, Ordering};
pub use sweep::sweep;

/// A matrix, in any storage format.
///
/// ```
/// use lcplab::storage::{MapOfMaps, Storage};
///
/// let mut a = MapOfMaps::new(2, 3);
/// a.set(0, 2, -1.0)?;
/// assert_eq!((a.rows(), a.columns()), (2, 3));
/// assert_eq!((a.get(0, 2)?, a.get(1, 0)?), (-1.0, 0.0)); // reading does not insert
/// let mut entries = Vec::new();
/// a.visit_row(0, &mut |column, value| entries.push((column, value)))?;
/// assert_eq!(entries, [(2, -1.0)]);
/// assert!(a.allocations() > 0); // on the heap, since it was made
///
/// a.reset(1, 1)?;
/// assert_eq!((a.rows(), a.stored()), (1, 0));
/// assert!(lcplab::storage::ALL.iter().any(|kind| kind.name == a.name()));
/// # Ok::<(), lcplab::storage::Error>(())
/// ```
pub trait Storage {
    /// Its name in [`ALL`].
    fn name(&self) -> &'static str;

    /// The number of rows.
    fn rows(&self) -> usize;

    /// The number of columns.
    fn columns(&self) -> usize;

    /// The entry at (row, column), 0 if none is stored. It never inserts one (the trap that Code 11
    /// comments on).
    ///
    /// # Errors
    /// [`Error::Outside`].
    fn get(&self, row: usize, column: usize) -> Result<f64>;

    /// Sets the value at (row, column); zero removes the entry.
    ///
    /// # Errors
    /// [`Error::Outside`], [`Error::NotFinite`].
    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()>;

    /// Calls `visit` with the nonzero entries (column, value) of a row, columns ascending.
    ///
    /// # Errors
    /// [`Error::Outside`].
    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()>;

    /// Resets to a zero matrix of this size, reusing its memory if possible. (Code 11's `SetToZero`
    /// changes nothing, E52.)
    ///
    /// # Errors
    /// [`Error::TooLarge`] above a requested limit.
    fn reset(&mut self, rows: usize, columns: usize) -> Result<()>;

    /// The number of stored values; for a dense matrix all, including zeros.
    fn stored(&self) -> usize;

    /// The allocated heap memory (bytes), including spare capacity.
    fn bytes(&self) -> usize;

    /// The number of heap allocations since the matrix was created.
    fn allocations(&self) -> usize;

    /// Loads these entries, given row by row, columns ascending, each position once.
    ///
    /// # Errors
    /// As for [`set`](Storage::set) and [`reset`](Storage::reset); [`Error::Unordered`].
    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        self.reset(self.rows(), self.columns())?;
        entries.iter().try_for_each(|&(row, column, value)| self.set(row, column, value))
    }

    /// The nonzero entries of a row as (column, value), columns ascending.
    ///
    /// # Errors
    /// [`Error::Outside`].
    fn row(&self, row: usize) -> Result<Vec<(usize, f64)>> {
        let mut entries = Vec::new();
        self.visit_row(row, &mut |column, value| entries.push((column, value)))?;
        Ok(entries)
    }
}

/// Row, column and value of an entry.
pub type Entry = (usize, usize, f64);

/// Checks that the matrix has this position; indices are stored in 4 bytes.
fn check_place(matrix: &(impl Storage + ?Sized), row: usize, column: usize) -> Result<(u32, u32)> {
    let (rows, columns) = (matrix.rows(), matrix.columns());
    if row >= rows || column >= columns {
        return Err(Error::Outside { row, column, rows, columns });
    }
    match (u32::try_from(row), u32::try_from(column)) {
        (Ok(row), Ok(column)) => Ok((row, column)),
        _ => Err(Error::TooLarge { rows, columns, limit: u32::MAX as usize }),
    }
}

/// Checks the position and the value of an entry.
fn check_entry(
    matrix: &(impl Storage + ?Sized),
    row: usize,
    column: usize,
    value: f64,
) -> Result<(u32, u32)> {
    let place = check_place(matrix, row, column)?;
    if value.is_finite() { Ok(place) } else { Err(Error::NotFinite { row, column, value }) }
}

/// Checks that the matrix has this row.
fn check_row(matrix: &(impl Storage + ?Sized), row: usize) -> Result<u32> {
    let (rows, columns) = (matrix.rows(), matrix.columns());
    match u32::try_from(row) {
        Ok(index) if row < rows => Ok(index),
        _ => Err(Error::Outside { row, column: 0, rows, columns }),
    }
}

fn check_length(what: &'static str, found: usize, expected: usize) -> Result<()> {
    if found == expected { Ok(()) } else { Err(Error::Length { what, found, expected }) }
}

fn check_order(entries: &[Entry]) -> Result<()> {
    match entries.windows(2).find(|pair| (pair[0].0, pair[0].1) >= (pair[1].0, pair[1].1)) {
        Some(pair) => Err(Error::Unordered { row: pair[1].0, column: pair[1].1 }),
        None => Ok(()),
    }
}
