//! Entries in a hash table by row and column.
//!
//! A single entry is found at once, whatever the number of entries: a hash, a look, rarely a second
//! one. What a table does not know is which entries are neighbours, so a row has to ask for each of
//! its columns: as many looks as a dense row, each dearer. A product A x walks the table instead and
//! adds in the table's order.
//!
//! The number of places is a power of two, filled to 7/8 at most; a place takes 17 bytes. Keys are
//! mixed by a fixed function, so that the table is the same in every run.

use std::collections::HashMap;
use std::hash::{BuildHasherDefault, Hasher};

use super::{
    Entry, Result, Storage, check_entry, check_order, check_place, check_product, check_row,
};

/// Control bytes that the table reads at once, and keeps once more at its end.
const GROUP: usize = if cfg!(target_feature = "sse2") { 16 } else { 8 };

/// A hash table of entries.
///
/// ```
/// use lcplab::storage::{HashTable, Storage};
///
/// let mut a = HashTable::new(1_000_000, 1_000_000);
/// a.set(271_828, 314_159, 6.25)?;
/// assert_eq!(a.get(271_828, 314_159)?, 6.25);
/// assert!(a.bytes() < 200);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct HashTable {
    rows: usize,
    columns: usize,
    table: HashMap<u64, f64, BuildHasherDefault<Mixer>>,
    /// The largest number of entries that the table said it has room for.
    room: usize,
    allocations: usize,
}

/// The splitmix64 generator's last steps: every bit of the key moves every bit of the hash.
#[derive(Debug, Clone, Copy, Default)]
struct Mixer(u64);

impl Hasher for Mixer {
    fn write(&mut self, bytes: &[u8]) {
        bytes.iter().for_each(|&byte| self.write_u64(u64::from(byte)));
    }

    fn write_u64(&mut self, key: u64) {
        let z = self.0 ^ key;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        self.0 = z ^ (z >> 31);
    }

    fn finish(&self) -> u64 {
        self.0
    }
}

fn key((row, column): (u32, u32)) -> u64 {
    u64::from(row) << 32 | u64::from(column)
}

impl HashTable {
    /// A zero matrix.
    pub fn new(rows: usize, columns: usize) -> Self {
        HashTable { rows, columns, table: HashMap::default(), room: 0, allocations: 0 }
    }

    /// Notes whether the table grew.
    fn watch(&mut self) {
        if self.table.capacity() > self.room {
            self.room = self.table.capacity();
            self.allocations += 1;
        }
    }
}

impl Storage for HashTable {
    fn name(&self) -> &'static str {
        "hash table"
    }

    fn rows(&self) -> usize {
        self.rows
    }

    fn columns(&self) -> usize {
        self.columns
    }

    fn get(&self, row: usize, column: usize) -> Result<f64> {
        let place = check_place(self, row, column)?;
        Ok(self.table.get(&key(place)).copied().unwrap_or(0.0))
    }

    fn set(&mut self, row: usize, column: usize, value: f64) -> Result<()> {
        let place = check_entry(self, row, column, value)?;
        if value == 0.0 {
            self.table.remove(&key(place));
        } else {
            self.table.insert(key(place), value);
            self.watch();
        }
        Ok(())
    }

    fn visit_row(&self, row: usize, visit: &mut dyn FnMut(usize, f64)) -> Result<()> {
        let row = check_row(self, row)?;
        for column in 0..self.columns {
            if let Some(&value) = self.table.get(&key((row, column as u32))) {
                visit(column, value);
            }
        }
        Ok(())
    }

    fn reset(&mut self, rows: usize, columns: usize) -> Result<()> {
        self.table.clear();
        (self.rows, self.columns) = (rows, columns);
        Ok(())
    }

    fn stored(&self) -> usize {
        self.table.len()
    }

    fn bytes(&self) -> usize {
        if self.room == 0 {
            return 0;
        }
        // Room for 3, 7, or 7/8 of the places.
        let places = if self.room < 8 { self.room + 1 } else { self.room / 7 * 8 };
        places * (size_of::<(u64, f64)>() + 1) + GROUP
    }

    fn allocations(&self) -> usize {
        self.allocations
    }

    fn load(&mut self, entries: &[Entry]) -> Result<()> {
        check_order(entries)?;
        self.reset(self.rows, self.columns)?;
        self.table.reserve(entries.len());
        self.watch();
        entries.iter().try_for_each(|&(row, column, value)| self.set(row, column, value))
    }

    /// One walk through the table: each sum runs in the table's order, so its last bits may differ from
    /// those of the other storages.
    fn multiply(&self, x: &[f64], y: &mut [f64]) -> Result<()> {
        check_product(self.rows, self.columns, x, y)?;
        y.fill(0.0);
        for (key, value) in &self.table {
            y[(key >> 32) as usize] += value * x[(key & u64::from(u32::MAX)) as usize];
        }
        Ok(())
    }
}
