//! A linked list of entries, each with its row, column, value and links.
//!
//! An entry takes 24 bytes: 4 each for row, column and the two links, 8 for the value. The
//! chapter's takes 28 compared with numbers of 4, so a full list is 7 times as large as the dense
//! matrix, not 28 times, half a list 3.5 times, and the break-even is at a fill of 1/7 (E57). Here
//! it is 24 compared with 8: 3 times, 1/3.
//!
//! The list is sorted by row and column. `get` walks from the head, so its cost grows linearly with
//! the number of entries before it (E57: not exponentially). `set` starts from the entry set last,
//! the caching that the chapter recommends: entries in ascending order are inserted without a
//! search.

use super::slots::{NONE, Slots};
use super::{Entry, Result, Storage, check_entry, check_order, check_place, check_row};

#[derive(Debug, Clone, PartialEq)]
struct Link {
    row: u32,
    column: u32,
    value: f64,
    next: u32,
    previous: u32,
}

/// A sorted list of entries.
///
/// ```
/// use lcplab::storage::{LinkedList, Storage};
///
/// let mut a = LinkedList::new(100, 100);
/// a.load(&(0..100).map(|i| (i, i, 1.0)).collect::<Vec<_>>())?;
/// assert_eq!(a.bytes(), 100 * 24);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct LinkedList {
    rows: usize,
    columns: usize,
    links: Slots<Link>,
    head: u32,
    /// The position of the last entry set.
    cursor: u32,
}

impl LinkedList {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        LinkedList { rows, columns, links: Slots::default(), head: NONE, cursor: NONE }
    }

    /// The entries from this one on.
    fn from(&self, slot: u32) -> impl Iterator<Item = &Link> {
        std::iter::successors(self.links.at(slot), |link| self.links.at(link.next))
    }

    fn place(&self, slot: u32) -> Option<(u32, u32)> {
        self.links.at(slot).map(|link| (link.row, link.column))
    }

    /// The neighbors of a free position, or the entry there, searched from the cursor.
    fn seek(&self, place: (u32, u32)) -> Seek {
        let (mut before, mut after) = match self.place(self.cursor) {
            None => (NONE, self.head),
            Some(here) if here == place => return Seek::Found(self.cursor),
            Some(here) if here < place => (self.cursor, self.next(self.cursor)),
            Some(_) => (self.previous(self.cursor), self.cursor),
        };
        while let Some(here) = self.place(after).filter(|here| *here <= place) {
            if here == place {
                return Seek::Found(after);
            }
            (before, after) = (after, self.next(after));
        }
        while let Some(here) = self.place(before).filter(|here| *here >= place) {
            if here == place {
                return Seek::Found(before);
            }
            (before, after) = (self.previous(before), before);
        }
        Seek::Between(before, after)
    }

    fn next(&self, slot: u32) -> u32 {
        self.links.at(slot).map_or(NONE, |link| link.next)
    }

    fn previous(&self, slot: u32) -> u32 {
        self.links.at(slot).map_or(NONE, |link| link.previous)
    }

    /// Links two entries; with no entry before, sets the head.
    fn join(&mut self, before: u32, after: u32) {
        match self.links.at_mut(before) {
            Some(link) => link.next = after,
            None => self.head = after,
        }
        if let Some(link) = self.links.at_mut(after) {
            link.previous = before;
        }
    }
}

enum Seek {
    Found(u32),
    Between(u32, u32),
}

impl Storage for LinkedList {
    fn name(&self) -> &'static str {
        "linked list"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let place = check_place(self, row, column)?;
        let found = self.from(self.head).find(|link| (link.row, link.column) >= place);
        Ok(found.filter(|link| (link.row, link.column) == place).map_or(0.0, |link| link.value))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let (row, column) = check_entry(self, row, column, value)?;
        match self.seek((row, column)) {
            Seek::Found(slot) if value == 0.0 => {
                let (before, after) = (self.previous(slot), self.next(slot));
                self.join(before, after);
                self.links.remove(slot);
                self.cursor = if before == NONE { after } else { before };
            }
            Seek::Found(slot) => {
                if let Some(link) = self.links.at_mut(slot) {
                    link.value = value;
                }
                self.cursor = slot;
            }
            Seek::Between(before, after) if value != 0.0 => {
                let slot = self.links.add(Link { row, column, value, next: NONE, previous: NONE });
                self.join(before, slot);
                self.join(slot, after);
                self.cursor = slot;
            }
            Seek::Between(..) => {}
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        let row = check_row(self, row)?;
        let entries = self.from(self.head).skip_while(|link| link.row < row);
        entries
            .take_while(|link| link.row == row)
            .for_each(|link| visit(link.column as usize, link.value));
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        self.links.clear();
        (self.rows, self.columns, self.head, self.cursor) = (rows, columns, NONE, NONE);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.links.len()
    }

    fn bytes(&self) -> usize {
        self.links.bytes()
    }

    fn allocations(&self) -> usize {
        self.links.allocations()
    }

    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        self.reset(self.rows, self.columns)?;
        self.links.reserve(entries.len());
        entries.iter().try_for_each(|&(row, column, value)| self.set(row, column, value))
    }
}
