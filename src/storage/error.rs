//! The errors of matrices: the assertions of Code 10, and the cases that they miss.

use crate::error;

/// A result whose error is an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// A rejected request.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Error {
    /// A row or column that the matrix does not have.
    #[error("entry ({row}, {column}) is outside a {rows} × {columns} matrix")]
    Outside {
        /// The requested row, from 0.
        row: usize,
        /// The requested column, from 0.
        column: usize,
        /// The number of rows of the matrix.
        rows: usize,
        /// The number of columns of the matrix.
        columns: usize,
    },
    /// A wrong number of values.
    #[error("{what} has {found} values, but {expected} are needed")]
    Length {
        /// The object that has them.
        what: &'static str,
        /// The number of values given.
        found: usize,
        /// The number of values required.
        expected: usize,
    },
    /// A value that would propagate: infinite or NaN.
    #[error("entry ({row}, {column}) must be finite, is {value}")]
    NotFinite {
        /// The row.
        row: usize,
        /// The column.
        column: usize,
        /// The value.
        value: f64,
    },
    /// More rows or columns than the requested limit (E50: a choice, not a constant), or than the
    /// index type can count.
    #[error("{rows} × {columns} is more than the limit of {limit} rows or columns")]
    TooLarge {
        /// The requested number of rows.
        rows: usize,
        /// The requested number of columns.
        columns: usize,
        /// The maximum of either.
        limit: usize,
    },
    /// Entries must be loaded row by row, columns ascending, each position once.
    #[error("entry ({row}, {column}) is out of order, or occurs twice")]
    Unordered {
        /// The row of the entry.
        row: usize,
        /// Its column.
        column: usize,
    },
    /// A diagonal entry by which Gauss-Seidel cannot divide.
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
                (what.to_string(), format!("has {found} values, but {expected} are needed"))
            }
            other => ("storage".into(), other.to_string()),
        };
        error::Error::invalid("matrix", place, reason)
    }
}
