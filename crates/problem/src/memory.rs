//! How much memory one thing may take, so that what would take more is refused before it is made.
//!
//! What grows with the input asks first: a file before it is read, the A of a step before it is
//! assembled, a dense factor before it is allocated. Each is held against the limit by itself, by
//! an estimate that is not too small by more than a few vectors.

use std::fmt;
use std::str::FromStr;

use crate::error::{Error, Result, size};

/// An amount of memory; as a limit, 4 GB unless told otherwise.
///
/// ```
/// use lcplab_problem::memory::Memory;
///
/// let limit: Memory = "500MB".parse().unwrap();
/// let refused = limit.check("A of 60000 rows as a dense matrix", Memory::square(60_000)).unwrap_err();
/// assert_eq!(
///     refused.to_string(),
///     "A of 60000 rows as a dense matrix needs 28.8 GB; the limit is 500 MB"
/// );
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Memory(u64);

impl Default for Memory {
    fn default() -> Self {
        Memory(4_000_000_000)
    }
}

impl Memory {
    /// So many bytes.
    pub const fn bytes(bytes: u64) -> Self {
        Memory(bytes)
    }

    /// Room for so many numbers.
    pub const fn numbers(count: usize) -> Self {
        Memory((count as u64).saturating_mul(size_of::<f64>() as u64))
    }

    /// Room for a dense n × n matrix.
    pub const fn square(n: usize) -> Self {
        Memory::numbers(n.saturating_mul(n))
    }

    /// So many times as much.
    pub const fn times(self, factor: usize) -> Self {
        Memory(self.0.saturating_mul(factor as u64))
    }

    /// The number of bytes.
    pub const fn in_bytes(self) -> u64 {
        self.0
    }

    /// Whether what needs so much stays within this limit.
    ///
    /// # Errors
    /// [`Error::TooLarge`] if it does not.
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

/// The units, in bytes.
const UNITS: [(&str, f64); 7] = [
    ("B", 1.0),
    ("kB", 1e3),
    ("MB", 1e6),
    ("GB", 1e9),
    ("KiB", 1024.0),
    ("MiB", 1024.0 * 1024.0),
    ("GiB", 1024.0 * 1024.0 * 1024.0),
];

/// A number with a unit; MB without one.
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
