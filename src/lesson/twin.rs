//! Python cells in the form shown to readers.

/// The engine that grows from lesson to lesson; pages and notebooks are next to it.
pub const ENGINE: &str = include_str!("../../notebooks/engine.py");

/// What the Python cells use of NumPy, for pages that run where NumPy is missing.
pub const ARRAYS: &str = include_str!("../../notebooks/arrays.py");

/// Replaces `from engine import murty  # as follows` by the code itself.
pub(super) fn shown(python: &str) -> String {
    let line = |line: &str| {
        let import = line.strip_prefix("from engine import ")?;
        program(import.strip_suffix("  # as follows")?)
    };
    let lines = python.lines().map(|own| line(own).unwrap_or_else(|| format!("{own}\n")));
    lines.collect::<String>().trim_start_matches('\n').to_string()
}

/// A function or a class of the engine.
fn program(name: &str) -> Option<String> {
    let defined = |kind: &str| ENGINE.find(&format!("\n{kind} {name}"));
    let start = defined("def").or_else(|| defined("class"))? + 1;
    let rest = &ENGINE[start..];
    let end = rest.find("\n\n\n").unwrap_or(rest.len());
    Some(format!("\n{}\n", rest[..end].trim_end()))
}
