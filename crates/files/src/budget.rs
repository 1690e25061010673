//! What the arrays of one file may take together: a small file can hold, or claim, very large ones.

use std::cell::Cell;

use lcplab_problem::error::Result;
use lcplab_problem::memory::Memory;

/// What a number takes beside its bytes until it stands in the problem: as a float or an index,
/// with its row and column in a list of entries, and in the matrix made of that (bytes).
const PLACE: usize = 48;

/// The memory of a file's arrays, taken before they are read.
pub(super) struct Budget {
    limit: Memory,
    taken: Cell<u64>,
}

impl Budget {
    pub fn new(limit: Memory) -> Self {
        Budget { limit, taken: Cell::new(0) }
    }

    /// Takes room for `count` numbers of so many bytes each.
    ///
    /// # Errors
    /// If that and what was taken before are more than the limit.
    pub fn take(&self, what: impl Into<String>, count: usize, size: usize) -> Result<()> {
        let own = Memory::bytes(size.saturating_add(PLACE) as u64).times(count);
        let needs = self.taken.get().saturating_add(own.in_bytes());
        self.limit.check(what, Memory::bytes(needs))?;
        self.taken.set(needs);
        Ok(())
    }
}
