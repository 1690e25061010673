//! A linked list of entries, each with its row, column, value and the number of the next one.
//!
//! An entry takes 24 bytes: 4 each for row, column and link, 8 for the value, and 4 that keep the
//! values aligned. The chapter's takes 28 compared with numbers of 4, so a full list is 7 times as
//! large as the dense matrix, not 28 times, half a list 3.5 times, and the break-even is at a fill
//! of 1/7 (E57). Here it is 24 compared with 8: 3 times, 1/3.
//!
//! The list is sorted by row and column, and every row is found by a walk from the head, so its
//! cost grows linearly with the number of entries before it (E57: not exponentially).

use super::{Entry, Storage, nonzero};

#[derive(Debug, Clone, PartialEq)]
struct Link {
    row: u32,
    column: u32,
    value: f64,
    /// The place of the next entry; past the end for the last one.
    next: u32,
}

/// A sorted list of entries.
///
/// ```
/// use lcplab::storage::{LinkedList, Storage};
///
/// let a = LinkedList::of(100, 100, &(0..100).map(|i| (i, i, 1.0)).collect::<Vec<_>>());
/// assert_eq!(a.bytes(), 100 * 24);
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LinkedList {
    rows: usize,
    links: Vec<Link>,
}

impl LinkedList {
    /// The matrix with these entries, row by row, columns ascending.
    ///
    /// # Panics
    /// If an entry is outside the matrix, out of order, or not finite.
    pub fn of(rows: usize, columns: usize, entries: &[Entry]) -> Self {
        let (count, entries) = nonzero(rows, columns, entries);
        let mut links = Vec::with_capacity(count);
        links.extend((1..).zip(entries).map(|(next, (i, j, value))| Link {
            row: i as u32,
            column: j as u32,
            value,
            next,
        }));
        LinkedList { rows, links }
    }

    /// The entries from the head on.
    fn walk(&self) -> impl Iterator<Item = &Link> {
        std::iter::successors(self.links.first(), |link| self.links.get(link.next as usize))
    }
}

impl Storage for LinkedList {
    fn rows(&self) -> usize {
        self.rows
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) {
        let entries = self.walk().skip_while(|link| (link.row as usize) < row);
        entries
            .take_while(|link| link.row as usize == row)
            .for_each(|link| visit(link.column as usize, link.value));
    }

    fn bytes(&self) -> usize {
        self.links.capacity() * size_of::<Link>()
    }
}
