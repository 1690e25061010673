//! Memory limits, which reject large requests before anything is allocated.
//!
//! The limit is checked before anything that grows with the input: before a file is read, before
//! the A of a step is assembled, before a dense factor is allocated. Each is checked separately, by
//! an estimate that is too small by a few vectors at most.

use std::fmt;
use std::str::FromStr;

use crate::error::{Error, Result, size};

/// An amount of memory; the default limit is 4 GB.
///
/// ```
/// use lcplab_lcp::memory::Memory;
///
/// let limit: Memory = "500MB".parse().unwrap();
/// let refused = limit.check("A of 60000 rows as a dense matrix", Memory::square(60_000)).unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "A of 60000 rows as a dense matrix needs 28.8 GB; the limit is 500 MB"
/// );
/// ```
///
/// ```
/// use lcplab_lcp::memory::Memory;
///
/// assert_eq!(Memory::numbers(1000), Memory::bytes(8000)); // 8 bytes each
/// assert_eq!(Memory::square(10).times(3).in_bytes(), 2400); // three 10 × 10 matrices
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Memory(u64);

impl Default for Memory {
    fn default() -> Self {
        Memory(4_000_000_000)
    }
}

impl Memory {
    /// This number of bytes.
    pub const fn bytes(bytes: u64) -> Self {
        Memory(bytes)
    }

    /// Memory for this number of `f64` values.
    pub const fn numbers(count: usize) -> Self {
        Memory((count as u64).saturating_mul(size_of::<f64>() as u64))
    }

    /// Memory for a dense n × n matrix.
    pub const fn square(n: usize) -> Self {
        Memory::numbers(n.saturating_mul(n))
    }

    /// This amount times a factor.
    pub const fn times(self, factor: usize) -> Self {
        Memory(self.0.saturating_mul(factor as u64))
    }

    /// The number of bytes.
    pub const fn in_bytes(self) -> u64 {
        self.0
    }

    /// Checks that `needs` is within this limit.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if it is not.
    pub fn check(self, what: impl Into<String>, needs: Memory) -> Result<()> {
        if needs <= self {
            return Ok(());
        }
        Err(Error::TooLarge { what: what.into(), needs: needs.0, limit: self.0 })
    }
}

impl fmt::Display for Memory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&size(self.0))
    }
}

/// The units in bytes.
const UNITS: [(&str, f64); 7] = [
    ("B", 1.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("KiB", 1024.0),
    ("MiB", 1024.0 * 1024.0),
    ("GiB", 1024.0 * 1024.0 * 1024.0),
];

/// A number with a unit; without a unit in MB.
impl FromStr for Memory {
    type Err = String;

    fn from_str(text: &str) -> std::result::Result<Self, String> {
        let end = text.trim_end_matches(|c: char| c.is_ascii_alphabetic()).len();
        let (number, unit) =
            (text[..end].trim(), if end < text.len() { &text[end..] } else { "MB" });
        let known = UNITS.iter().find(|(name, _)| name.eq_ignore_ascii_case(unit));
        match (number.parse::<f64>(), known) {
            (Ok(number), Some((_, bytes))) if number > 0.0 && number * bytes < 1e18 => {
                Ok(Memory((number * bytes) as u64))
            }
            _ => Err("must be a positive number with a unit, such as 500MB, 4GB or 2GiB".into()),
        }
    }
}
