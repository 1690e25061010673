//! The chapter's matrices: one small interface with several storage formats.
//!
//! K&M build their solver on a dense matrix class (Codes 8-10), then put a map of maps behind the
//! same interface (Code 11) and name other candidates. Here the dense matrix, the map of maps, the
//! chapter's linked list and compressed rows implement [`Storage`], so that one program runs with
//! each and gives bitwise identical results:
//!
//! ```
//! use lcplab::storage::ALL;
//!
//! for kind in &ALL {
//!     let a = (kind.of)(3, 3, &[(0, 0, 2.0), (0, 2, -1.0)]);
//!     assert_eq!(a.rows(), 3);
//!     assert_eq!(a.row(0), [(0, 2.0), (2, -1.0)]);
//!     assert!(a.row(1).is_empty());
//!     println!("{:<20} {:>4} bytes", kind.name, a.bytes());
//! }
//! ```
//!
//! A matrix is made from its entries and not changed; Codes 9 to 11, printed and corrected, with
//! what they do when an entry is set, are in [`chapter`](crate::chapter). Zero entries are not
//! stored (E54), and a row's entries are its nonzero ones, columns ascending, in every format.
//! [`sweep`] runs projected Gauss-Seidel with any of them, [`scaled_rows`] are for sweeps that
//! never assemble A (the kernel `impulses`), and [`Ordering`] gives the fill of a factor of A.

mod compressed;
mod dense;
mod list;
mod map;
mod ordering;
mod scaled_rows;
mod sweep;

pub use compressed::CompressedRows;
pub use dense::Dense;
pub use list::LinkedList;
pub use map::MapOfMaps;
pub use ordering::{Graph, Ordering};
pub use scaled_rows::scaled_rows;
pub use sweep::sweep;

/// Row, column and value of an entry.
pub type Entry = (usize, usize, f64);

/// A matrix, in any storage format.
///
/// ```
/// use lcplab::storage::{MapOfMaps, Storage};
///
/// let a = MapOfMaps::of(2, 3, &[(0, 2, -1.0), (1, 0, 0.0)]);
/// let mut entries = Vec::new();
/// (0..a.rows()).for_each(|i| a.visit_row(i, &mut |column, value| entries.push((column, value))));
/// assert_eq!(entries, [(2, -1.0)]);
/// ```
pub trait Storage {
    /// The number of rows.
    fn rows(&self) -> usize;

    /// Calls `visit` with the nonzero entries (column, value) of a row, columns ascending.
    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64));

    /// The allocated heap memory (bytes).
    fn bytes(&self) -> usize;

    /// The nonzero entries of a row as (column, value), columns ascending.
    fn row(&self, row: usize) -> Vec<(usize, f64)> {
        let mut entries = Vec::new();
        self.visit_row(row, &mut |column, value| entries.push((column, value)));
        entries
    }
}

/// A storage format.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// Makes a matrix of this many rows and columns from its entries, which are given row by row,
    /// columns ascending, each position once; panics otherwise.
    pub of: fn(usize, usize, &[Entry]) -> Box<dyn Storage>,
}

/// Every storage format.
pub const ALL: [Kind; 4] = [
    Kind { name: "dense", of: |m, n, entries| Box::new(Dense::of(m, n, entries)) },
    Kind { name: "map of maps", of: |m, n, entries| Box::new(MapOfMaps::of(m, n, entries)) },
    Kind { name: "linked list", of: |m, n, entries| Box::new(LinkedList::of(m, n, entries)) },
    Kind {
        name: "compressed rows",
        of: |m, n, entries| Box::new(CompressedRows::of(m, n, entries)),
    },
];

/// The entries that are not zero, and how many they are.
///
/// # Panics
/// If an entry is outside the matrix, out of order, or not finite.
fn nonzero(rows: usize, columns: usize, entries: &[Entry]) -> (usize, impl Iterator<Item = Entry>) {
    let is_inside = |&(i, j, value): &Entry| i < rows && j < columns && value.is_finite();
    assert!(entries.iter().all(is_inside), "finite entries of a {rows} × {columns} matrix");
    let is_ordered = entries.is_sorted_by(|a, b| (a.0, a.1) < (b.0, b.1));
    assert!(is_ordered, "entries row by row, columns ascending");
    let kept = || entries.iter().copied().filter(|(.., value)| *value != 0.0);
    (kept().count(), kept())
}
