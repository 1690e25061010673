//! A table in one expression.

use crate::document::Table;
use crate::document::notation::plain;

/// A table with a title, headings (units included) and rows of entries.
///
/// ```
/// use lcplab::lesson::{row, show, table};
///
/// let costs = (1..5).map(|n| row![n, 2_usize.pow(n) - 1, "worst case"]);
/// show(&table("Cost of the worst case", ["n", "exchanges", "remark"], costs))?;
/// # Ok::<(), lcplab::error::Error>(())
/// ```
pub fn table<const N: usize>(
    title: &str,
    columns: [&str; N],
    rows: impl IntoIterator<Item = [Entry; N]>,
) -> Table {
    let rows = rows.into_iter().map(|row| row.into_iter().map(|entry| entry.0).collect());
    Table::whole(title, &columns, rows.collect())
}

/// A row of a [`table`]: numbers, counts and words, each as written.
#[doc(hidden)]
#[macro_export]
macro_rules! __lesson_row {
    ($($entry:expr),* $(,)?) => { [$($crate::lesson::Entry::from($entry)),*] };
}
pub use crate::__lesson_row as row;

/// The content of a cell of a [`table`].
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Entry(String);

/// Numbers are shown with six significant digits.
impl From<f64> for Entry {
    fn from(value: f64) -> Self {
        Entry(plain(value))
    }
}

impl From<&str> for Entry {
    fn from(words: &str) -> Self {
        Entry(words.into())
    }
}

impl From<String> for Entry {
    fn from(words: String) -> Self {
        Entry(words)
    }
}

macro_rules! counts {
    ($($count:ty)*) => { $(
        impl From<$count> for Entry {
            fn from(count: $count) -> Self {
                Entry(count.to_string())
            }
        }
    )* };
}
counts!(usize u32 u64 i32);
