//! The header of a `.npy` file: type, order and shape, as a Python dictionary.

use std::io::Read;

use super::array::Reason;

/// Limit on the length of a header.
const LONGEST: usize = 1 << 16;
const MAGIC: &[u8; 6] = b"\x93NUMPY";

/// The header of an array file.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Header {
    /// NumPy's name for the type of an entry, such as `<f8`.
    pub descr: String,
    /// Whether the first index varies fastest.
    pub fortran_order: bool,
    /// The length along each axis.
    pub shape: Vec<usize>,
}

impl Header {
    /// Reads the header at the start of a file, versions 1 to 3.
    pub fn read(file: &mut dyn Read) -> Result<Self, Reason> {
        let mut start = [0; 8];
        file.read_exact(&mut start).map_err(|cause| cause.to_string())?;
        let length = match start {
            [magic @ .., 1, _] if magic == *MAGIC => 2,
            [magic @ .., 2 | 3, _] if magic == *MAGIC => 4,
            _ => return Err("is not a .npy file of version 1, 2 or 3".into()),
        };
        let mut size = [0; 4];
        file.read_exact(&mut size[..length]).map_err(|cause| cause.to_string())?;
        let size = u32::from_le_bytes(size) as usize;
        if size > LONGEST {
            return Err(format!("has a head of {size} bytes"));
        }
        let mut text = vec![0; size];
        file.read_exact(&mut text).map_err(|cause| cause.to_string())?;
        let text =
            String::from_utf8(text).map_err(|_| "has a header that is not text".to_string())?;
        parse(&text).ok_or_else(|| format!("has an invalid header: {:?}", text.trim_end()))
    }

    /// The header as bytes, padded with spaces so that the entries start at a multiple of 64.
    pub(crate) fn to_bytes(&self) -> Vec<u8> {
        let order = if self.fortran_order { "True" } else { "False" };
        let shape: String = self.shape.iter().map(|length| format!("{length}, ")).collect();
        let mut text = format!(
            "{{'descr': '{}', 'fortran_order': {order}, 'shape': ({}), }}",
            self.descr,
            shape.trim_end(),
        );
        let start = MAGIC.len() + 4;
        let size = (start + text.len() + 1).next_multiple_of(64) - start;
        text += &" ".repeat(size - 1 - text.len());
        let head = [&MAGIC[..], &[1, 0], &(size as u16).to_le_bytes(), text.as_bytes(), b"\n"];
        head.concat()
    }
}

/// The dictionary `{'descr': '<f8', 'fortran_order': False, 'shape': (2, 2), }`, its keys in any
/// order.
fn parse(text: &str) -> Option<Header> {
    let mut rest = text.trim().strip_prefix('{')?.strip_suffix('}')?.trim();
    let (mut descr, mut fortran_order, mut shape) = (None, None, None);
    while !rest.is_empty() {
        let (key, value) = rest.split_once(':')?;
        let (key, value) = (key.trim(), value.trim_start());
        let end = match value.chars().next()? {
            '(' => value.find(')')? + 1,
            quote @ ('\'' | '"') => value[1..].find(quote)? + 2,
            _ => value.find(',').unwrap_or(value.len()),
        };
        let (value, more) = value.split_at(end);
        match key.trim_matches(['\'', '"']) {
            "descr" => descr = Some(value.strip_prefix(['\'', '"'])?.trim_end_matches(['\'', '"'])),
            "fortran_order" => fortran_order = Some(value.trim().to_lowercase().parse().ok()?),
            "shape" => shape = Some(tuple(value)?),
            _ => return None,
        }
        rest = more.trim_start();
        rest = rest.strip_prefix(',').unwrap_or(rest).trim_start();
    }
    Some(Header { descr: descr?.to_string(), fortran_order: fortran_order?, shape: shape? })
}

fn tuple(text: &str) -> Option<Vec<usize>> {
    let inside = text.strip_prefix('(')?.strip_suffix(')')?;
    let lengths = inside.split(',').map(|length| length.trim().trim_end_matches('L'));
    lengths.filter(|length| !length.is_empty()).map(|length| length.parse().ok()).collect()
}
