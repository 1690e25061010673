//! The Python that says the same as a cell.

/// The methods as the Python package has them.
const TEXTBOOK: &str = include_str!("textbook.py");

/// The text as readers see it: `from lcplab.textbook import murty  # as follows` gives way to the program itself.
pub(super) fn shown(python: &str) -> String {
    let line = |line: &str| {
        let import = line.strip_prefix("from lcplab.textbook import ")?;
        program(import.strip_suffix("  # as follows")?)
    };
    python.lines().map(|own| line(own).unwrap_or_else(|| format!("{own}\n"))).collect()
}

/// A function of the package.
fn program(name: &str) -> Option<String> {
    let start = TEXTBOOK.find(&format!("\ndef {name}("))? + 1;
    let rest = &TEXTBOOK[start..];
    let end = rest.find("\n\n\n").unwrap_or(rest.len());
    Some(format!("\n{}\n", rest[..end].trim_end()))
}
