//! Codes 9 and 10: a dense matrix of floats with checks, stored row by row.
//!
//! Code 9 has only the three members; Code 10 adds constructor, destructor and access. A failed
//! assertion of the listing is an [`Error`](crate::error::Error) here, so that a program can show
//! it.
//!
//! One fault of Code 10 cannot be reproduced in safe Rust: the class owns a raw pointer and does
//! not define copying, so a copy shares the memory and the destructors free it twice (E51). A `Vec`
//! is moved or cloned, never shared by accident.

use super::Listing;

pub(in crate::chapter) const MEMBERS: Listing = Listing {
    id: "Code 9",
    title: "the members of a dense matrix",
    printed: "A pointer to floats, the number of rows and the number of columns, all public.",
    corrected: "The same three, private, so that there are always rows × columns entries.",
    errata: &[],
};

pub(in crate::chapter) const ACCESS: Listing = Listing {
    id: "Code 10",
    title: "construction and access of a dense matrix",
    printed: "Assert sizes below 500, both or neither of them 0, allocate, free in the destructor; \
              entry (row, col) lies at col + columns · row.",
    corrected: "Any size from 0 on, errors instead of assertions, and copies that own their entries; the \
                index stays.",
    errata: &["E50", "E51", "E59"],
};

/// The listings as printed.
pub mod printed {
    use crate::error::{Error, Result};

    /// Sizes from this on are rejected: the assertion says `< 500`, the text "greater than 500".
    pub const LIMIT: i32 = 500;

    /// Code 9: the members, all public.
    #[derive(Debug, Clone, PartialEq, Default)]
    pub struct RawMatrix {
        /// Rows × columns entries.
        pub data: Vec<f32>,
        /// The number of rows.
        pub num_rows: i32,
        /// The number of columns.
        pub num_cols: i32,
    }

    /// Code 10: the same with access functions.
    #[derive(Debug, PartialEq)] // not `Clone`: the listing has no copy that works
    pub struct DenseMatrix(RawMatrix);

    impl DenseMatrix {
        /// A matrix of this size with these entries by rows, or with zeros.
        ///
        /// # Errors
        /// The listing's assertions: sizes below 0 or from [`LIMIT`] on, and only one size of 0;
        /// also data of a different length, which the listing does not check.
        pub fn new(num_rows: i32, num_cols: i32, data: Option<&[f32]>) -> Result<Self> {
            let stop = |place: &str, reason: String| Err(Error::invalid("Code 10", place, reason));
            for (place, size) in [("numRows", num_rows), ("numCols", num_cols)] {
                if !(0..LIMIT).contains(&size) {
                    return stop(place, format!("must be from 0 to {}, is {size}", LIMIT - 1));
                }
            }
            if (num_rows == 0) != (num_cols == 0) {
                return stop("size", format!("{num_rows} × {num_cols} has one zero"));
            }
            let size = (num_rows * num_cols) as usize;
            let data = data.map_or_else(|| vec![0.0; size], <[f32]>::to_vec);
            if data.len() != size {
                return stop("data", format!("has {} entries, needs {size}", data.len()));
            }
            Ok(DenseMatrix(RawMatrix { data, num_rows, num_cols }))
        }

        /// The number of rows.
        pub fn num_rows(&self) -> i32 {
            self.0.num_rows
        }

        /// The number of columns.
        pub fn num_cols(&self) -> i32 {
            self.0.num_cols
        }

        /// An entry.
        ///
        /// # Errors
        /// If the position does not exist.
        pub fn get(&self, row: i32, col: i32) -> Result<f32> {
            Ok(self.0.data[self.data_index(row, col)?])
        }

        /// A mutable entry.
        ///
        /// # Errors
        /// If the position does not exist.
        pub fn set(&mut self, row: i32, col: i32) -> Result<&mut f32> {
            let index = self.data_index(row, col)?;
            Ok(&mut self.0.data[index])
        }

        /// The index of an entry: col + columns · row.
        fn data_index(&self, row: i32, col: i32) -> Result<usize> {
            let RawMatrix { num_rows, num_cols, .. } = self.0;
            if !(0..num_rows).contains(&row) || !(0..num_cols).contains(&col) {
                let reason = format!("outside {num_rows} × {num_cols}");
                return Err(Error::invalid("Code 10", format!("({row}, {col})"), reason));
            }
            Ok((col + num_cols * row) as usize)
        }
    }
}

/// The class without arbitrary limits, with sizes of 0, and safe to copy.
pub mod corrected {
    use crate::error::{Error, Result};

    /// A dense matrix of floats, stored row by row.
    #[derive(Debug, Clone, PartialEq)]
    pub struct DenseMatrix {
        data: Vec<f32>,
        num_rows: usize,
        num_cols: usize,
    }

    impl DenseMatrix {
        /// A matrix of zeros; either size may be 0, such as that of a J without active rows.
        ///
        /// ```
        /// use lcplab::chapter::code::code09_10_dense_matrix::corrected::DenseMatrix;
        ///
        /// let j = DenseMatrix::zeros(0, 18);
        /// assert_eq!((j.num_rows(), j.num_cols()), (0, 18));
        /// ```
        pub fn zeros(num_rows: usize, num_cols: usize) -> Self {
            DenseMatrix { data: vec![0.0; num_rows * num_cols], num_rows, num_cols }
        }

        /// A matrix with these entries by rows.
        ///
        /// # Errors
        /// If their number is not rows × columns.
        pub fn new(num_rows: usize, num_cols: usize, data: &[f32]) -> Result<Self> {
            let size = num_rows * num_cols;
            if data.len() != size {
                let reason = format!("has {} entries, needs {size}", data.len());
                return Err(Error::invalid("dense matrix", "data", reason));
            }
            Ok(DenseMatrix { data: data.to_vec(), num_rows, num_cols })
        }

        /// The number of rows.
        pub fn num_rows(&self) -> usize {
            self.num_rows
        }

        /// The number of columns.
        pub fn num_cols(&self) -> usize {
            self.num_cols
        }

        /// The entry, if the position exists.
        pub fn get(&self, row: usize, col: usize) -> Option<f32> {
            self.index(row, col).map(|index| self.data[index])
        }

        /// The mutable entry, if the position exists.
        pub fn get_mut(&mut self, row: usize, col: usize) -> Option<&mut f32> {
            self.index(row, col).map(|index| &mut self.data[index])
        }

        fn index(&self, row: usize, col: usize) -> Option<usize> {
            let is_inside = row < self.num_rows && col < self.num_cols;
            is_inside.then_some(col + self.num_cols * row)
        }
    }
}
