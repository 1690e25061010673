//! An array of numbers or a word, as a `.npy` file.

use std::io::Read;

use super::header::Header;
use crate::table::{Table, by_rows};
use lcplab_lcp::file::Entries;

/// The maximum length of a word.
const MOST_LETTERS: usize = 4096;

/// Why an array is invalid.
pub(super) type Reason = String;

/// An array.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Array {
    shape: Vec<usize>,
    /// Whether the first index varies fastest.
    by_columns: bool,
    values: Values,
}

#[derive(Debug, Clone, PartialEq)]
enum Values {
    Floats(Vec<f64>),
    Integers(Vec<i64>),
    Word(String),
}

/// The header of an array, so that its size is known before its entries are read.
pub(super) struct Outline {
    head: Header,
    kind: Kind,
}

impl Outline {
    /// Reads the header of a `.npy` file.
    pub fn read(file: &mut dyn Read) -> Result<Self, Reason> {
        let head = Header::read(file)?;
        let kind = Kind::of(&head.descr)?;
        Ok(Outline { head, kind })
    }

    /// The length along each axis.
    pub fn shape(&self) -> &[usize] {
        &self.head.shape
    }

    /// The number of entries, and the bytes of each.
    pub fn size(&self) -> (usize, usize) {
        (self.shape().iter().fold(1, |all, length| all.saturating_mul(*length)), self.kind.size)
    }

    /// The array, with entries from the rest of the file.
    pub fn filled(self, file: &mut dyn Read) -> Result<Array, Reason> {
        let (count, entry) = self.size();
        let (size, mut bytes) = (count.saturating_mul(entry), Vec::new());
        // One more, to detect excess bytes.
        let most = (size as u64).saturating_add(1);
        file.take(most).read_to_end(&mut bytes).map_err(|cause| cause.to_string())?;
        let Header { fortran_order, shape, .. } = self.head;
        if bytes.len() < size {
            return Err(format!("has {} bytes, the shape {shape:?} needs {size}", bytes.len()));
        }
        if bytes.len() > size {
            return Err(format!("has more bytes than the shape {shape:?} needs, {size}"));
        }
        Ok(Array { shape, by_columns: fortran_order, values: self.kind.values(&bytes)? })
    }
}

impl Array {
    /// A list of numbers.
    pub fn floats(values: Vec<f64>) -> Self {
        Array { shape: vec![values.len()], by_columns: false, values: Values::Floats(values) }
    }

    /// A list of integers.
    pub fn integers(values: Vec<i64>) -> Self {
        Array { shape: vec![values.len()], by_columns: false, values: Values::Integers(values) }
    }

    /// A word, as a zero-dimensional array.
    pub fn word(word: &str) -> Self {
        Array { shape: Vec::new(), by_columns: false, values: Values::Word(word.to_string()) }
    }

    /// The same numbers, in row order, with another shape.
    pub fn shaped(self, shape: Vec<usize>) -> Self {
        Array { shape, ..self }
    }

    /// The numbers of a list or a column vector.
    pub fn vector(&self) -> Result<Vec<f64>, Reason> {
        match self.shape[..] {
            [_] | [_, 1] => self.numbers(),
            _ => Err(format!("must be a list, has the shape {:?}", self.shape)),
        }
    }

    /// The numbers of a matrix.
    pub fn table(&self) -> Result<Table, Reason> {
        let [rows, cols] = self.shape[..] else {
            return Err(format!("must be a matrix, has the shape {:?}", self.shape));
        };
        let numbers = self.numbers()?;
        let dense = if self.by_columns { by_rows(rows, cols, &numbers) } else { numbers };
        Ok(Table { rows, cols, entries: Entries::Dense(dense) })
    }

    /// The nonnegative integers of a list.
    pub(crate) fn wholes(&self) -> Result<Vec<usize>, Reason> {
        let (Values::Integers(values), [_]) = (&self.values, &self.shape[..]) else {
            return Err("must be a list of integers".into());
        };
        let whole = |value: &i64| {
            usize::try_from(*value).map_err(|_| format!("must not be negative, has {value}"))
        };
        values.iter().map(whole).collect()
    }

    /// The number of a zero-dimensional array.
    pub fn number(&self) -> Result<f64, Reason> {
        match (&self.numbers()?[..], &self.shape[..]) {
            ([value], [] | [1]) => Ok(*value),
            _ => Err(format!("must be one number, has the shape {:?}", self.shape)),
        }
    }

    /// The word of a zero-dimensional array.
    pub fn text(&self) -> Result<String, Reason> {
        match &self.values {
            Values::Word(word) => Ok(word.clone()),
            _ => Err("must be a word".into()),
        }
    }

    fn numbers(&self) -> Result<Vec<f64>, Reason> {
        match &self.values {
            Values::Floats(values) => Ok(values.clone()),
            Values::Integers(values) => Ok(values.iter().map(|value| *value as f64).collect()),
            Values::Word(_) => Err("must be numbers".into()),
        }
    }

    /// The array as a `.npy` file.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let (descr, bytes): (String, Vec<u8>) = match &self.values {
            Values::Floats(v) => ("<f8".into(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
            Values::Integers(v) => ("<i8".into(), v.iter().flat_map(|v| v.to_le_bytes()).collect()),
            Values::Word(word) => (format!("|S{}", word.len()), word.as_bytes().to_vec()),
        };
        let header = Header { descr, fortran_order: self.by_columns, shape: self.shape.clone() };
        [header.to_bytes(), bytes].concat()
    }
}

/// The number with these bits in 16-bit floating point: sign, 5 bits of exponent, 10 of fraction.
fn half(bits: u16) -> f64 {
    let (exponent, fraction) = (i32::from(bits >> 10 & 0x1f), f64::from(bits & 0x3ff));
    let size = match exponent {
        0x1f if fraction == 0.0 => f64::INFINITY,
        0x1f => f64::NAN,
        0 => fraction * 2f64.powi(-24),
        _ => (1024.0 + fraction) * 2f64.powi(exponent - 25),
    };
    if bits >> 15 == 1 { -size } else { size }
}

/// The type of an entry.
struct Kind {
    is_big_endian: bool,
    letter: u8,
    /// The size of an entry in bytes.
    size: usize,
}

impl Kind {
    /// Parses NumPy's type name: byte order, letter, size.
    fn of(descr: &str) -> Result<Self, Reason> {
        let unknown = || format!("has entries of the type {descr:?}, not numbers or words");
        let [order @ (b'<' | b'>' | b'|' | b'='), letter, size @ ..] = descr.as_bytes() else {
            return Err(unknown());
        };
        let size: Option<usize> = std::str::from_utf8(size).ok().and_then(|size| size.parse().ok());
        let size = match (letter, size) {
            (b'f', Some(size @ (2 | 4 | 8))) | (b'i' | b'u', Some(size @ (1 | 2 | 4 | 8))) => size,
            (b'S', Some(size @ 1..=MOST_LETTERS)) => size,
            // Four bytes per character.
            (b'U', Some(size @ 1..=MOST_LETTERS)) => 4 * size,
            _ => return Err(unknown()),
        };
        Ok(Kind { is_big_endian: *order == b'>', letter: *letter, size })
    }

    fn values(&self, bytes: &[u8]) -> Result<Values, Reason> {
        let entries = bytes.chunks_exact(self.size).map(|entry| self.ordered(entry));
        Ok(match self.letter {
            b'f' if self.size == 8 => Values::Floats(entries.map(f64::from_bits).collect()),
            b'f' if self.size == 2 => Values::Floats(entries.map(|e| half(e as u16)).collect()),
            b'f' => Values::Floats(entries.map(|e| f64::from(f32::from_bits(e as u32))).collect()),
            b'u' => {
                let whole = |e| i64::try_from(e).map_err(|_| format!("has {e}, beyond 2⁶³"));
                Values::Integers(entries.map(whole).collect::<Result<_, _>>()?)
            }
            b'i' => {
                // The highest used bit is the sign.
                let unused = 64 - 8 * self.size as u32;
                Values::Integers(entries.map(|e| ((e << unused) as i64) >> unused).collect())
            }
            _ => {
                let letters = bytes.iter().filter(|byte| **byte != 0);
                Values::Word(letters.map(|byte| char::from(*byte)).collect())
            }
        })
    }

    /// The bits of a number of at most eight bytes, most significant byte first.
    fn ordered(&self, entry: &[u8]) -> u64 {
        let shift = |bits: u64, byte: &u8| bits << 8 | u64::from(*byte);
        match self.is_big_endian {
            true => entry.iter().fold(0, shift),
            false => entry.iter().rev().fold(0, shift),
        }
    }
}
