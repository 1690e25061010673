//! Code 11: a sparse matrix as a map of rows, each a map from column to entry.
//!
//! `std::map` becomes a `BTreeMap` here. The listing clears nothing (E52), reads its data column by
//! column where Code 10 reads row by row (E53), and keeps every entry that was ever accessed (E54).
//! Its product of three matrices is invalid C++ (E55); this has no counterpart, because Rust can
//! borrow a temporary.

use std::collections::BTreeMap;

use super::Listing;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 11",
    title: "a sparse matrix as a map of maps",
    printed: "Clear with empty(), read data column by column, hand out a reference to an entry that is made \
              for it.",
    corrected: "Clear with clear(), read data row by row, take the value itself, and keep no zeros.",
    errata: &["E50", "E52", "E53", "E54", "E56"],
};

pub(in crate::chapter) const OPERATORS: Listing = Listing {
    id: "operators",
    title: "the operators of that matrix",
    printed: "The product takes both operands by a reference through which they could be changed.",
    corrected: "It takes them by const references, as the other operators do: then J * MInverse * Jt compiles.",
    errata: &["E55"],
};

/// Entries by row, then by column.
type Rows = BTreeMap<usize, BTreeMap<usize, f32>>;

fn stored(rows: &Rows) -> usize {
    rows.values().map(BTreeMap::len).sum()
}

fn entry(rows: &Rows, row: usize, col: usize) -> f32 {
    rows.get(&row).and_then(|row| row.get(&col)).copied().unwrap_or(0.0)
}

/// The listing as printed.
pub mod printed {
    use super::Rows;
    use crate::error::{Error, Result};

    /// Sizes from this on are rejected.
    pub const LIMIT: usize = 1501;

    /// A map of maps.
    #[derive(Debug, Clone, PartialEq)]
    pub struct MapMatrix {
        rows: Rows,
        num_rows: usize,
        num_cols: usize,
    }

    impl MapMatrix {
        /// A matrix of this size, filled from `data`, which is read column by column.
        ///
        /// # Errors
        /// The listing's assertions: sizes from [`LIMIT`] on, and only one size of 0; also data of
        /// a different length, which the listing does not check.
        pub fn new(num_rows: usize, num_cols: usize, data: Option<&[f32]>) -> Result<Self> {
            let stop = |place: &str, reason: String| Err(Error::invalid("Code 11", place, reason));
            for (place, size) in [("numRows", num_rows), ("numCols", num_cols)] {
                if size >= LIMIT {
                    return stop(place, format!("must be below {LIMIT}, is {size}"));
                }
            }
            if (num_rows == 0) != (num_cols == 0) {
                return stop("size", format!("{num_rows} × {num_cols} has one zero"));
            }
            let mut matrix = MapMatrix { rows: Rows::new(), num_rows, num_cols };
            if let Some(data) = data {
                if data.len() != num_rows * num_cols {
                    return stop("data", format!("has {} entries", data.len()));
                }
                for i in 0..num_rows {
                    for k in 0..num_cols {
                        *matrix.set(i, k)? = data[i + k * num_rows];
                    }
                }
            }
            Ok(matrix)
        }

        /// The entry, 0 if none is stored.
        ///
        /// # Errors
        /// If the position does not exist.
        pub fn get(&self, row: usize, col: usize) -> Result<f32> {
            self.check(row, col)?;
            Ok(super::entry(&self.rows, row, col))
        }

        /// A mutable entry; accessing it stores it, whatever is written or read.
        ///
        /// # Errors
        /// If the position does not exist.
        pub fn set(&mut self, row: usize, col: usize) -> Result<&mut f32> {
            self.check(row, col)?;
            Ok(self.rows.entry(row).or_default().entry(col).or_default())
        }

        /// Does nothing: `empty()` of a map tests whether it is empty. The result, which the
        /// listing discards, is returned here.
        pub fn set_to_zero(&mut self) -> bool {
            self.rows.is_empty()
        }

        /// The number of stored entries.
        pub fn stored(&self) -> usize {
            super::stored(&self.rows)
        }

        fn check(&self, row: usize, col: usize) -> Result<()> {
            if row < self.num_rows && col < self.num_cols {
                return Ok(());
            }
            let reason = format!("outside {} × {}", self.num_rows, self.num_cols);
            Err(Error::invalid("Code 11", format!("({row}, {col})"), reason))
        }
    }
}

/// The same idea without the faults.
pub mod corrected {
    use super::Rows;
    use crate::error::{Error, Result};

    /// A map of maps that stores only nonzero entries.
    #[derive(Debug, Clone, PartialEq)]
    pub struct MapMatrix {
        rows: Rows,
        num_rows: usize,
        num_cols: usize,
    }

    impl MapMatrix {
        /// A matrix of zeros; either size may be 0.
        pub fn zeros(num_rows: usize, num_cols: usize) -> Self {
            MapMatrix { rows: Rows::new(), num_rows, num_cols }
        }

        /// A matrix with these entries by rows.
        ///
        /// # Errors
        /// If their number is not rows × columns.
        ///
        /// ```
        /// use lcplab::chapter::code::code11_map_matrix::corrected::MapMatrix;
        ///
        /// let matrix = MapMatrix::new(2, 2, &[1.0, 0.0, 0.0, 4.0])?;
        /// assert_eq!((matrix.get(1, 1), matrix.stored()), (4.0, 2));
        /// # Ok::<(), lcplab::error::Error>(())
        /// ```
        pub fn new(num_rows: usize, num_cols: usize, data: &[f32]) -> Result<Self> {
            if data.len() != num_rows * num_cols {
                let reason = format!("has {} entries, needs {num_rows} × {num_cols}", data.len());
                return Err(Error::invalid("map matrix", "data", reason));
            }
            let mut matrix = MapMatrix::zeros(num_rows, num_cols);
            for (k, &value) in data.iter().enumerate() {
                matrix.set(k / num_cols, k % num_cols, value)?;
            }
            Ok(matrix)
        }

        /// The entry, 0 if none is stored.
        pub fn get(&self, row: usize, col: usize) -> f32 {
            super::entry(&self.rows, row, col)
        }

        /// Writes an entry; a zero removes it.
        ///
        /// # Errors
        /// If the position does not exist.
        pub fn set(&mut self, row: usize, col: usize, value: f32) -> Result<()> {
            if row >= self.num_rows || col >= self.num_cols {
                let reason = format!("outside {} × {}", self.num_rows, self.num_cols);
                return Err(Error::invalid("map matrix", format!("({row}, {col})"), reason));
            }
            let entries = self.rows.entry(row).or_default();
            match value {
                0.0 => entries.remove(&col),
                value => entries.insert(col, value),
            };
            if entries.is_empty() {
                self.rows.remove(&row);
            }
            Ok(())
        }

        /// Sets every entry to 0.
        pub fn set_to_zero(&mut self) {
            self.rows.clear();
        }

        /// The number of stored entries.
        pub fn stored(&self) -> usize {
            super::stored(&self.rows)
        }

        /// The number of map nodes in memory: one per nonempty row, one per entry.
        pub fn nodes(&self) -> usize {
            self.rows.len() + self.stored()
        }
    }
}
