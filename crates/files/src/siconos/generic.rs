//! Generic mechanical problems: blocks of rows, each of an LCP, of equations, or of a contact.

use super::kind::refusal;
use super::matrix;
use crate::words::Words;
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Parts;

/// The kinds of blocks, as Siconos numbers them.
const LCP: usize = 0;
const EQUATIONS: usize = 2;
const CONTACT: usize = 4;

/// Reads M in blocks, q, and the kind of each block of rows, with mu after that of a contact.
pub(super) fn read(words: &mut Words, input: &str) -> Result<Parts> {
    let start = words.clone();
    let ends = matrix::row_ends_ahead(words).unwrap_or_default();
    let table = matrix::read(words, "M")?;
    if words.is_empty() {
        return Err(refusal(&start, "a matrix alone"));
    }
    let n = table.rows;
    let entries = table.square(n, input)?;
    let b = words.numbers(n, "q")?;
    let (mut lo, mut index, mut mu) = (Vec::new(), Vec::new(), Vec::new());
    for end in ends {
        let first = lo.len();
        let rows = end - first;
        let kind = words.whole("the kind of a block of rows")?;
        let (normals, friction) = match kind {
            LCP => (rows, 0.0),
            EQUATIONS => (0, 0.0),
            CONTACT if rows == 3 => (1, words.number("mu")?),
            CONTACT => return Err(words.fault(format!("a contact of {rows} rows has not 3"))),
            _ => {
                return Err(words.fault(format!(
                    "a block of the kind {kind} in a generic mechanical problem (GMP): only 0, an \
                     LCP, 2, equations, and 4, a contact, are read"
                )));
            }
        };
        lo.extend((0..rows).map(|k| if k < normals { 0.0 } else { -f64::INFINITY }));
        let is_tangent = |k: usize| kind == CONTACT && k > 0;
        index.extend((0..rows).map(|k| is_tangent(k).then_some(first)));
        mu.extend((0..rows).map(|k| if is_tangent(k) { friction } else { 0.0 }));
    }
    let has_contacts = index.iter().any(Option::is_some);
    let (index, mu) = if has_contacts { (Some(index), Some(mu)) } else { (None, None) };
    Ok(Parts { entries, b, lo: Some(lo), hi: None, index, mu })
}
