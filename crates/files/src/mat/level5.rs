//! Reads MATLAB's format 5: a header of 128 bytes, then one element for each variable.
//!
//! An element is a tag (type, number of bytes) and its data; types up to 4 bytes may share 8 bytes
//! with their tag. A matrix contains elements: flags, dimensions, name and numbers; a sparse one
//! also the row of each number and where each column begins. A compressed element is a zlib stream
//! with one element.

use std::io::Read;

use flate2::read::ZlibDecoder;

use super::fault;
use super::variables::{Variables, dense, sparse};
use crate::budget::Budget;
use crate::table::Table;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::memory::Memory;

const HEADER: usize = 128;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;

/// The classes of MATLAB's arrays that are not numbers.
const OTHER_CLASSES: [(u8, &str); 7] = [
    (1, "a cell array"),
    (2, "a structure"),
    (3, "an object"),
    (4, "a text"),
    (16, "a function"),
    (17, "an object"),
    (18, "an object"),
];
const SPARSE: u8 = 5;
const NUMBERS: std::ops::RangeInclusive<u8> = 6..=15;
const COMPLEX: u8 = 0x08;

/// The variables of a file.
pub(super) fn read(bytes: &[u8], input: &str, most: Memory) -> Result<Variables> {
    match bytes.get(124..HEADER) {
        Some([_, _, b'I', b'M']) => {}
        Some([_, _, b'M', b'I']) => {
            return Err(Error::invalid(
                input,
                "file",
                "has its most significant bytes first, which is not read",
            ));
        }
        _ => return Err(Error::invalid(input, "file", "is not a MATLAB file of format 5 or 7.3")),
    }
    let budget = Budget::new(most);
    let (mut rest, mut all) = (&bytes[HEADER..], Vec::new());
    while !rest.is_empty() {
        let element = Element::take(&mut rest).map_err(|reason| cut(input, reason))?;
        let (name, table) = match element.kind {
            COMPRESSED => {
                let inner = unpacked(element.data, input, &budget)?;
                let element =
                    Element::take(&mut &inner[..]).map_err(|reason| cut(input, reason))?;
                matrix(&element, input, &budget)?
            }
            _ => matrix(&element, input, &budget)?,
        };
        if all.iter().any(|(own, _): &(String, Table)| *own == name) {
            return Err(fault(input, &name, "appears twice"));
        }
        all.push((name, table));
    }
    Ok(Variables { all })
}

fn cut(input: &str, reason: &str) -> Error {
    Error::invalid(input, "file", reason)
}

/// A tag and its data.
struct Element<'a> {
    kind: u32,
    data: &'a [u8],
}

impl<'a> Element<'a> {
    /// Takes the next element from the bytes.
    fn take(bytes: &mut &'a [u8]) -> std::result::Result<Self, &'static str> {
        let word = |at: usize| {
            let word = bytes.get(at..at + 4).and_then(|word| word.try_into().ok());
            word.map(u32::from_le_bytes).ok_or("ends within an element")
        };
        let first = word(0)?;
        let (kind, size, start) = match first >> 16 {
            0 => (first, word(4)? as usize, 8),
            size => (first & 0xffff, size as usize, 4),
        };
        let end = start + size;
        let data = bytes.get(start..end).ok_or("ends within an element")?;
        // Elements begin at multiples of 8 bytes, except after compressed ones.
        let next = match (start, kind) {
            (4, _) => 8,
            (_, COMPRESSED) => end,
            _ => end.next_multiple_of(8),
        };
        *bytes = bytes.get(next..).unwrap_or_default();
        Ok(Element { kind, data })
    }
}

/// The bytes of a compressed element, if the element in it stays within the memory limit.
fn unpacked(data: &[u8], input: &str, budget: &Budget) -> Result<Vec<u8>> {
    let mut stream = ZlibDecoder::new(data);
    let mut bytes = vec![0; 8];
    let broken = |cause: std::io::Error| Error::invalid(input, "file", cause.to_string());
    stream.read_exact(&mut bytes).map_err(broken)?;
    let size = u32::from_le_bytes([bytes[4], bytes[5], bytes[6], bytes[7]]);
    budget.take(format!("{input}: a variable of {size} bytes"), size as usize / 8, 8)?;
    // One more, to detect excess bytes.
    stream.take(u64::from(size) + 1).read_to_end(&mut bytes).map_err(broken)?;
    match bytes.len() == 8 + size as usize {
        true => Ok(bytes),
        false => Err(cut(input, "has a compressed element of another size than its tag states")),
    }
}

/// The name and the numbers of a matrix.
fn matrix(element: &Element, input: &str, budget: &Budget) -> Result<(String, Table)> {
    if element.kind != MATRIX {
        let reason = format!("has an element of type {} instead of a variable", element.kind);
        return Err(Error::invalid(input, "file", reason));
    }
    let mut rest = element.data;
    let mut next = || Element::take(&mut rest).map_err(|reason| cut(input, reason));
    let (flags, size, name) = (next()?, next()?, next()?);
    let name = String::from_utf8_lossy(name.data).into_owned();
    let &[class, flags, ..] = flags.data else {
        return Err(fault(input, &name, "has no flags"));
    };
    if let Some((_, what)) = OTHER_CLASSES.iter().find(|(other, _)| *other == class) {
        return Err(fault(input, &name, format!("is {what}, must be a matrix of numbers")));
    }
    if class != SPARSE && !NUMBERS.contains(&class) {
        return Err(fault(input, &name, format!("has the unknown class {class}")));
    }
    if flags & COMPLEX != 0 {
        return Err(fault(input, &name, "is complex, must be real"));
    }
    let values = |what: &str, element: Element| {
        let numbers = element.data.len() / element.size_of_number(input, &name)?;
        budget.take(format!("{input}: {name}: {what} of {numbers} numbers"), numbers, 8)?;
        element.numbers(input, &name)
    };
    let size = values("dimensions", size)?;
    let [rows, cols] = wholes(&size, input, &name)?[..] else {
        return Err(fault(input, &name, format!("has {} dimensions, must have 2", size.len())));
    };
    if class != SPARSE {
        return Ok((
            name.clone(),
            dense([rows, cols], &values("numbers", next()?)?, input, &name)?,
        ));
    }
    let row_of = wholes(&values("ir", next()?)?, input, &name)?;
    let starts = wholes(&values("jc", next()?)?, input, &name)?;
    let numbers = values("numbers", next()?)?;
    Ok((name.clone(), sparse([rows, cols], &row_of, &starts, &numbers, input, &name)?))
}

impl Element<'_> {
    /// The bytes of one of its numbers.
    fn size_of_number(&self, input: &str, name: &str) -> Result<usize> {
        match self.kind {
            1 | 2 => Ok(1),
            3 | 4 => Ok(2),
            5..=7 => Ok(4),
            9 | 12 | 13 => Ok(8),
            kind => Err(fault(input, name, format!("has numbers of the unknown type {kind}"))),
        }
    }

    /// Its numbers; a number is stored in the smallest type that holds it.
    fn numbers(&self, input: &str, name: &str) -> Result<Vec<f64>> {
        let size = self.size_of_number(input, name)?;
        if !self.data.len().is_multiple_of(size) {
            return Err(fault(input, name, "ends within a number"));
        }
        let number = |bytes: &[u8]| {
            let mut all = [0; 8];
            all[..size].copy_from_slice(bytes);
            let unsigned = u64::from_le_bytes(all);
            // The sign of an integer is its highest bit.
            let unused = 64 - 8 * size as u32;
            let signed = (unsigned << unused) as i64 >> unused;
            match self.kind {
                7 => f64::from(f32::from_bits(unsigned as u32)),
                9 => f64::from_bits(unsigned),
                2 | 4 | 6 | 13 => unsigned as f64,
                _ => signed as f64,
            }
        };
        Ok(self.data.chunks_exact(size).map(number).collect())
    }
}

/// Indices or sizes.
pub(super) fn wholes(values: &[f64], input: &str, name: &str) -> Result<Vec<usize>> {
    let whole = |&value: &f64| match value >= 0.0 && value < 2f64.powi(53) && value.fract() == 0.0 {
        true => Ok(value as usize),
        false => Err(fault(input, name, format!("has the index {value}"))),
    };
    values.iter().map(whole).collect()
}
