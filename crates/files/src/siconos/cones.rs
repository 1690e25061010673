//! Linear problems over second-order cones (SOCLCP): K ∋ z ⟂ M z + q ∈ K*, where K has a cone
//! ‖z_t‖ ≤ τ z_n for each three rows. This is the associated cone with μ = τ.

use super::{matrix, reader};
use crate::contacts::coulomb;
use crate::words::Words;
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Parts;

/// Reads the sizes, M, q, the beginning of each cone and the end of the last, and τ.
pub(super) fn read(words: &mut Words, input: &str) -> Result<Parts> {
    let n = words.whole("the number of rows")?;
    let cones = words.whole("the number of cones")?;
    let entries = matrix::read(words, "M")?.square(n, input)?;
    let b = words.numbers(n, "q")?;
    let mut last = words.whole("the beginning of the first cone")?;
    let first = last;
    for _ in 0..cones {
        let end = words.whole("the end of a cone")?;
        if end != last + 3 {
            let rows = end.saturating_sub(last);
            return Err(
                words.fault(format!("a cone of {rows} rows: only cones of 3 rows are read"))
            );
        }
        last = end;
    }
    if (first, last) != (0, n) {
        return Err(words.fault(format!("cones from {first} to {last}, not from 0 to {n}")));
    }
    let tau = words.numbers(cones, "tau")?;
    reader::flag(words, cones)?;
    Ok(coulomb(entries, b, &tau, 3))
}
