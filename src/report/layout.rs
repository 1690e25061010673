//! JSON with line breaks in its outer levels, so that a diff shows the place of a change, and
//! without in the inner levels, so that a number does not take a line.

use std::io::{self, Write};

use serde::Serialize;
use serde_json::ser::{CompactFormatter, Formatter, PrettyFormatter, Serializer};

/// The number of levels with line breaks: from the results down to a field of a task.
const LINES: usize = 5;

/// The value as JSON.
///
/// # Errors
/// Those of the value's serialization.
pub fn json<T: Serialize>(value: &T) -> serde_json::Result<String> {
    let mut out = Vec::new();
    value.serialize(&mut Serializer::with_formatter(&mut out, Layout::default()))?;
    out.push(b'\n');
    Ok(String::from_utf8_lossy(&out).into_owned())
}

/// A formatter that is pretty outside and compact inside.
#[derive(Default)]
struct Layout<'a> {
    depth: usize,
    outer: PrettyFormatter<'a>,
}

impl Layout<'_> {
    fn is_outer(&self) -> bool {
        self.depth <= LINES
    }
}

/// Forwards each call of the writer to the formatter of its level.
macro_rules! by_level {
    ($($name:ident($($argument:ident: $type:ty),*) $entering:expr, $leaving:expr;)*) => {$(
        fn $name<W: ?Sized + Write>(&mut self, writer: &mut W $(, $argument: $type)*) -> io::Result<()> {
            self.depth += $entering;
            let written = match self.is_outer() {
                true => self.outer.$name(writer $(, $argument)*),
                false => CompactFormatter.$name(writer $(, $argument)*),
            };
            self.depth -= $leaving;
            written
        }
    )*};
}

impl Formatter for Layout<'_> {
    by_level! {
        begin_array() 1, 0;
        end_array() 0, 1;
        begin_array_value(first: bool) 0, 0;
        end_array_value() 0, 0;
        begin_object() 1, 0;
        end_object() 0, 1;
        begin_object_key(first: bool) 0, 0;
        begin_object_value() 0, 0;
        end_object_value() 0, 0;
    }
}
