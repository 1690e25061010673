//! Memory limit for all arrays of one file: a small file can contain, or claim, very large ones.

use std::cell::Cell;

use lcplab_lcp::error::Result;
use lcplab_lcp::memory::Memory;

/// Memory for a number in addition to its stored bytes (bytes): as a float or an index, with its
/// row and column in a list of entries, and in the resulting matrix.
const PLACE: usize = 48;

/// The memory still available to a file's arrays; it is reserved before they are read.
pub(super) struct Budget {
    limit: Memory,
    taken: Cell<u64>,
}

impl Budget {
    pub fn new(limit: Memory) -> Self {
        Budget { limit, taken: Cell::new(0) }
    }

    /// Reserves memory for `count` numbers of `size` bytes each.
    ///
    /// # Errors
    /// If the total would exceed the limit.
    pub fn take(&self, what: impl Into<String>, count: usize, size: usize) -> Result<()> {
        let own = Memory::bytes(size.saturating_add(PLACE) as u64).times(count);
        let needs = self.taken.get().saturating_add(own.in_bytes());
        self.limit.check(what, Memory::bytes(needs))?;
        self.taken.set(needs);
        Ok(())
    }
}
