//! Adapts cells for the evcxr kernel.
//!
//! The kernel keeps variables from cell to cell, except closures and values that borrow from
//! another variable. A cell therefore becomes a block whose value is what later cells use, and a
//! closure is repeated in each cell that calls it.

/// The cells with the code that the kernel needs around them.
pub(super) fn cells(codes: &[&str]) -> Vec<String> {
    let cells: Vec<Vec<Statement>> = codes.iter().map(|code| statements(code)).collect();
    let repeated: Vec<Vec<&str>> =
        (0..cells.len()).map(|k| closures_from_before(&cells, k)).collect();
    let texts: Vec<String> = codes
        .iter()
        .zip(&repeated)
        .map(|(code, own)| format!("{}\n{code}", own.join("\n")))
        .collect();
    let bare: Vec<String> = texts.iter().map(|text| bare(text)).collect();
    // Until a cell defines a variable of the same name.
    let is_used_later = |k: usize, name: &str| {
        let binds = |later: usize| cells[later].iter().any(|statement| statement.binds(name));
        let ends = (k + 1..cells.len()).find(|&later| is_free(&bare[later], name) || binds(later));
        ends.is_some_and(|later| is_free(&bare[later], name))
    };
    let written = |(k, own): (usize, &Vec<Statement>)| {
        written(own, &repeated[k], |name| is_used_later(k, name))
    };
    cells.iter().enumerate().map(written).collect()
}

/// A top-level statement.
struct Statement<'a> {
    text: &'a str,
    kind: Kind,
}

enum Kind {
    /// `use`, `fn`, `struct`, `impl`: it has no value, and must be outside of blocks to be visible
    /// later.
    Item,
    /// Binds a closure.
    Closure(String),
    /// Binds these names, each with whether it is `mut`.
    Let(Vec<(String, bool)>),
    Other,
}

/// The closures of earlier cells that this one calls, with those that they call, in order.
fn closures_from_before<'a>(cells: &[Vec<Statement<'a>>], k: usize) -> Vec<&'a str> {
    let own = |name: &str| cells[k].iter().any(|statement| statement.binds(name));
    let mut wanted: Vec<&str> = cells[k].iter().map(|statement| statement.text).collect();
    let mut found = Vec::new();
    for statement in cells[..k].iter().flatten().rev() {
        let Kind::Closure(name) = &statement.kind else { continue };
        if !own(name) && wanted.iter().any(|text| has(text, name)) {
            wanted.push(statement.text);
            found.push(statement.text);
        }
    }
    found.reverse();
    found
}

/// A cell: its items first, then the rest, in a block if it contains something that cannot be kept.
fn written(cell: &[Statement], repeated: &[&str], is_used_later: impl Fn(&str) -> bool) -> String {
    let (items, rest): (Vec<_>, Vec<_>) =
        cell.iter().partition(|statement| matches!(statement.kind, Kind::Item));
    let mut kept: Vec<(String, bool)> = Vec::new();
    let mut is_all_kept = repeated.is_empty();
    for statement in &rest {
        match &statement.kind {
            Kind::Closure(_) => is_all_kept = false,
            Kind::Let(names) => {
                for name in names {
                    if !is_used_later(&name.0) {
                        is_all_kept = false;
                    } else if kept.iter().all(|other| other.0 != name.0) {
                        kept.push(name.clone());
                    }
                }
            }
            Kind::Item | Kind::Other => {}
        }
    }
    let text = |statements: &[&Statement]| -> String {
        statements.iter().map(|statement| statement.text).collect::<Vec<_>>().join("\n")
    };
    if is_all_kept {
        return cell.iter().map(|statement| statement.text).collect::<Vec<_>>().join("\n");
    }
    let pattern = |with_mut: bool| {
        let name = |(name, is_mut): &(String, bool)| {
            if with_mut && *is_mut { format!("mut {name}") } else { name.clone() }
        };
        let names: Vec<String> = kept.iter().map(name).collect();
        if names.len() == 1 { names[0].clone() } else { format!("({})", names.join(", ")) }
    };
    let again = match repeated {
        [] => String::new(),
        closures => format!("// from above: the kernel keeps no closures\n{}", closures.join("\n")),
    };
    let [before, body] = [text(&items), text(&rest)];
    let (open, close) = if kept.is_empty() {
        ("{".to_string(), "}".to_string())
    } else {
        (format!("let {} = {{", pattern(true)), format!("{}\n}};", pattern(false)))
    };
    let parts = [before, open, again, body, close];
    parts.into_iter().filter(|part| !part.is_empty()).collect::<Vec<_>>().join("\n")
}

impl Statement<'_> {
    fn binds(&self, name: &str) -> bool {
        match &self.kind {
            Kind::Closure(own) => own == name,
            Kind::Let(names) => names.iter().any(|own| own.0 == name),
            Kind::Item | Kind::Other => false,
        }
    }
}

/// Splits a cell where a line without indentation begins something new. Cells are formatted, so
/// such a line is a statement unless it closes one. Comments and attributes come before what they
/// belong to, and raw strings have lines of their own.
fn statements(code: &str) -> Vec<Statement<'_>> {
    let (mut start, mut at) = (0, 0);
    let (mut is_string, mut is_attached) = (false, false);
    let mut texts = Vec::new();
    for line in code.split_inclusive('\n') {
        let begins = !is_string && !line.starts_with([' ', '}', ')', ']', '\n']);
        if begins {
            if !is_attached && at > start {
                texts.push(code[start..at].trim_end());
                start = at;
            }
            is_attached = line.starts_with("//") || line.starts_with("#[");
        }
        is_string =
            if is_string { !line.contains("\"#") } else { line.trim_end().ends_with("r#\"") };
        at += line.len();
    }
    texts.push(code[start..].trim_end());
    texts.into_iter().map(|text| Statement { text, kind: kind(text) }).collect()
}

fn kind(text: &str) -> Kind {
    let code =
        text.lines().find(|line| !line.starts_with("//") && !line.starts_with("#[")).unwrap_or("");
    let items = ["use ", "fn ", "struct ", "impl ", "impl<", "enum ", "trait ", "const ", "type "];
    if items.iter().any(|item| code.starts_with(item)) {
        return Kind::Item;
    }
    let start = text.find(code).unwrap_or(0);
    let Some(rest) = text[start..].strip_prefix("let ") else { return Kind::Other };
    let Some((pattern, value)) = rest.split_once(" =") else { return Kind::Other };
    let value = value.trim_start();
    let names = names(pattern);
    if names.len() == 1 && (value.starts_with('|') || value.starts_with("move |")) {
        return Kind::Closure(names[0].0.clone());
    }
    Kind::Let(names)
}

/// The names that a pattern binds: lowercase words or single letters, without types.
fn names(pattern: &str) -> Vec<(String, bool)> {
    let mut is_mut = false;
    let mut names = Vec::new();
    let without_type = pattern.split(": ").next().unwrap_or(pattern);
    let is_bracketed = pattern.starts_with(['(', '[']) || pattern.contains('{');
    let pattern = if is_bracketed { pattern } else { without_type };
    for word in pattern.split(|c: char| !c.is_alphanumeric() && c != '_') {
        match word {
            "" | "_" | "ref" => {}
            "mut" => is_mut = true,
            word => {
                let is_name = word.chars().count() == 1 || !word.starts_with(char::is_uppercase);
                if is_name && !word.starts_with(char::is_numeric) {
                    names.push((word.to_string(), is_mut));
                }
                is_mut = false;
            }
        }
    }
    names
}

/// Whether a text uses a variable of this name that it has not defined: where the name first
/// occurs, it is not bound.
fn is_free(text: &str, name: &str) -> bool {
    let Some(at) = places(text, name).find(|&at| !text[at + name.len()..].starts_with(": ")) else {
        return false;
    };
    let before = &text[..at];
    // In the pattern of `let … =`, between the bars of a closure, or after `for`.
    let in_let = before.rfind("let ").is_some_and(|start| !before[start..].contains('='));
    let line = before.rsplit('\n').next().unwrap_or_default();
    let in_bars = line.matches('|').count() % 2 == 1;
    let in_for = before.ends_with("for ") || before.ends_with("for (");
    let is_bound = in_let || in_for || in_bars;
    // A parameter with a type precedes the uses of its name in the closure.
    let is_parameter = places(before, name).any(|at| before[at + name.len()..].starts_with(": "));
    !is_bound && !is_parameter
}

/// The text without comments, and with strings reduced to the names that they print, as in
/// `"{x:.3}"`.
fn bare(text: &str) -> String {
    let mut out = String::new();
    for line in text.lines() {
        let (mut in_string, mut in_name) = (false, false);
        let mut last = ' ';
        for (at, c) in line.char_indices() {
            let is_word = c.is_alphanumeric() || c == '_';
            match c {
                '/' if !in_string && line[at..].starts_with("//") => break,
                '"' if last != '\\' && last != '\'' => {
                    in_string = !in_string;
                    out.push(' ');
                }
                '{' if in_string => {
                    in_name = true;
                    out.push(' ');
                }
                _ if in_string && in_name && is_word => out.push(c),
                _ if in_string => in_name = false,
                _ => out.push(c),
            }
            last = c;
        }
        out.push('\n');
    }
    out
}

/// Where this word occurs in a text as a variable or a function: not as a field, a method or a part
/// of a path.
fn places<'a>(text: &'a str, word: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is_part = |c: char| c.is_alphanumeric() || c == '_';
    text.match_indices(word).map(|(at, _)| at).filter(move |&at| {
        let (before, after) = (&text[..at], &text[at + word.len()..]);
        !before.ends_with(is_part)
            && (before.ends_with("..") || !before.ends_with(['.', '"']))
            && !before.ends_with("::")
            && !after.starts_with(is_part)
            && !after.starts_with("::")
            && (after.starts_with("!=") || !after.starts_with('!'))
    })
}

fn has(text: &str, word: &str) -> bool {
    places(text, word).next().is_some()
}
