//! What a matrix refuses, as values: the asserts of Code 10, and what they let through.

use crate::error;

/// A result whose error is an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// A request that a matrix refuses.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Error {
    /// A row or column that the matrix does not have.
    #[error("entry ({row}, {column}) is outside a {rows} × {columns} matrix")]
    Outside {
        /// The row asked for, from 0.
        row: usize,
        /// The column asked for, from 0.
        column: usize,
        /// Rows of the matrix.
        rows: usize,
        /// Columns of the matrix.
        columns: usize,
    },
    /// A number of values that does not fit.
    #[error("{what} has {found} values, needed are {expected}")]
    Length {
        /// What has them.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// How many are needed.
        expected: usize,
    },
    /// A value that would spread: infinite, or not a number.
    #[error("entry ({row}, {column}) must be finite, is {value}")]
    NotFinite {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The value.
        value: f64,
    },
    /// More rows or columns than the limit that was asked for (E50: a choice, not a constant), or
    /// than can be numbered.
    #[error("{rows} × {columns} is more than the limit of {limit} rows or columns")]
    TooLarge {
        /// Rows asked for.
        rows: usize,
        /// Columns asked for.
        columns: usize,
        /// The most that either may be.
        limit: usize,
    },
    /// Entries that are loaded must come row by row, columns ascending, each place once.
    #[error("entry ({row}, {column}) comes after a later place, or twice")]
    Unordered {
        /// The row of the entry.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// Gauss-Seidel divides by it.
    #[error("row {row} has diagonal {diagonal}, it must be positive")]
    Diagonal {
        /// The row.
        row: usize,
        /// Its diagonal entry.
        diagonal: f64,
    },
}

impl From<Error> for error::Error {
    fn from(error: Error) -> Self {
        let (place, reason) = match error {
            Error::Length { what, found, expected } => {
                (what.to_string(), format!("has {found} values, needed are {expected}"))
            }
            other => ("storage".into(), other.to_string()),
        };
        error::Error::invalid("matrix", place, reason)
    }
}
