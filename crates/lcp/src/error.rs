//! Errors of inputs, as values.
//!
//! Failures during a solve are not errors: they are a `Status` in the solution. An [`Error`] says
//! that the input itself cannot be used, where, and why.

use std::fmt;

use crate::edit_distance::edit_distance;

/// At most this many defects are listed in one message; the message counts the rest.
const LISTED: usize = 20;
/// The largest number of names that a message lists in full, and the number of those of a longer
/// list.
const ALL_NAMES: usize = 50;
const NEAREST_NAMES: usize = 5;

/// A result whose error is an [`Error`].
pub type Result<T> = std::result::Result<T, Error>;

/// An input that cannot be used.
///
/// ```
/// use lcplab_lcp::error::Error;
///
/// let error = Error::invalid("box.json", "mass", "must be above 0, is -1");
/// assert_eq!(error.to_string(), "box.json: mass: must be above 0, is -1");
/// let error = error.within("stack.json"); // the file that contains the box
/// assert_eq!(error.to_string(), "stack.json: mass: must be above 0, is -1");
///
/// let cause = std::io::Error::other("the disk is full");
/// let error = Error::file("x.json".as_ref(), &cause);
/// assert_eq!(error.to_string(), "x.json: the disk is full");
/// ```
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file that cannot be read or written, or a directory that cannot be made.
    #[error("{}: {reason}", input_name(path))]
    File {
        /// The path as the user gave it.
        path: String,
        /// The reason given by the operating system.
        reason: String,
    },
    /// A name that is not in a list: a solver, a scene, a report.
    #[error("there is no {kind} named {name:?}; there are {}", names(name, known))]
    Unknown {
        /// The kind of thing requested.
        kind: &'static str,
        /// The name requested.
        name: String,
        /// The names that exist.
        known: Vec<String>,
    },
    /// An input with defects, all of them found in one pass.
    #[error("{}", list(input, defects))]
    Invalid {
        /// The file, or the name of the object to be made.
        input: String,
        /// What is wrong with it.
        defects: Vec<Defect>,
    },
    /// An object that would exceed its memory limit.
    #[error("{what} needs {}; the limit is {}", size(*needs), size(*limit))]
    TooLarge {
        /// The object, with the sizes that make it large.
        what: String,
        /// Memory needed (bytes).
        needs: u64,
        /// Memory limit (bytes).
        limit: u64,
    },
}

/// One thing that is wrong with an input.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Defect {
    /// The line, field or row, for example `lo[3]` or `line 12: bodies[2].mass`.
    pub place: String,
    /// The reason, including the offending numbers.
    pub reason: String,
}

impl fmt::Display for Defect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.place, self.reason)
    }
}

/// Collects the defects of an input, so that one message reports all of them.
///
/// ```
/// use lcplab_lcp::error::Defects;
///
/// let mut defects = Defects::default();
/// defects.add("lo[3]", "is 2, above hi[3] = 1");
/// let error = defects.into_result("box.json").unwrap_err();
/// assert_eq!(error.to_string(), "box.json: lo[3]: is 2, above hi[3] = 1");
/// ```
#[derive(Debug, Default)]
pub struct Defects(Vec<Defect>);

impl Defects {
    /// Adds one defect.
    pub fn add(&mut self, place: impl Into<String>, reason: impl Into<String>) {
        self.0.push(Defect { place: place.into(), reason: reason.into() });
    }

    /// The number of defects found so far.
    pub fn len(&self) -> usize {
        self.0.len()
    }

    /// Whether no defect was found so far.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// `Ok` if `input` has no defects so far.
    ///
    /// ```
    /// use lcplab_lcp::error::Defects;
    ///
    /// let mut defects = Defects::default();
    /// assert!(defects.is_empty() && defects.result("box.json").is_ok());
    /// defects.add("mass", "is missing");
    /// defects.add("size", "is missing");
    /// assert_eq!(defects.len(), 2);
    /// let error = defects.result("box.json").unwrap_err();
    /// let text = error.to_string();
    /// assert_eq!(text, "box.json: 2 defects\n  mass: is missing\n  size: is missing");
    /// assert!(defects.is_empty()); // they are now in the error
    /// ```
    pub fn result(&mut self, input: impl Into<String>) -> Result<()> {
        if self.0.is_empty() {
            return Ok(());
        }
        Err(Error::Invalid { input: input.into(), defects: std::mem::take(&mut self.0) })
    }

    /// `Ok` if `input` has no defects.
    pub fn into_result(mut self, input: impl Into<String>) -> Result<()> {
        self.result(input)
    }
}

impl Error {
    /// An error with a single defect.
    pub fn invalid(
        input: impl Into<String>,
        place: impl Into<String>,
        reason: impl Into<String>,
    ) -> Self {
        Error::Invalid {
            input: input.into(),
            defects: vec![Defect { place: place.into(), reason: reason.into() }],
        }
    }

    /// The same defects under another input's name: the file that contains the defective part.
    pub fn within(self, input: &str) -> Self {
        match self {
            Error::Invalid { defects, .. } => Error::Invalid { input: input.to_string(), defects },
            other => other,
        }
    }

    /// The error of a failed file operation.
    pub fn file(path: &std::path::Path, cause: &std::io::Error) -> Self {
        Error::File { path: path.display().to_string(), reason: cause.to_string() }
    }
}

/// All names, or the number of them and those that differ least from this one.
fn names(name: &str, known: &[String]) -> String {
    if known.len() <= ALL_NAMES {
        return known.join(", ");
    }
    let mut nearest: Vec<&str> = known.iter().map(String::as_str).collect();
    nearest.sort_by_key(|known| edit_distance(name, known)); // stable: in the given order
    nearest.truncate(NEAREST_NAMES);
    format!("{}, such as {}", known.len(), nearest.join(", "))
}

/// The input in messages: - is standard input.
fn input_name(input: &str) -> &str {
    if input == "-" { "standard input" } else { input }
}

fn list(input: &str, defects: &[Defect]) -> String {
    let input = input_name(input);
    match defects {
        // About the whole file.
        [Defect { place, reason }] if place == "file" => return format!("{input}: {reason}"),
        [only] => return format!("{input}: {only}"),
        _ => {}
    }
    let mut text = format!("{input}: {} defects", defects.len());
    for defect in defects.iter().take(LISTED) {
        text += &format!("\n  {defect}");
    }
    if defects.len() > LISTED {
        text += &format!("\n  and {} more", defects.len() - LISTED);
    }
    text
}

/// An amount of memory to three digits, such as 28.8 GB.
pub(crate) fn size(bytes: u64) -> String {
    let units = ["B", "kB", "MB", "GB", "TB", "PB", "EB"];
    let (mut amount, mut unit) = (bytes as f64, 0);
    while amount >= 999.5 {
        (amount, unit) = (amount / 1000.0, unit + 1);
    }
    let places =
        usize::from(unit > 0) * if amount < 9.995 { 2 } else { usize::from(amount < 99.95) };
    let digits = format!("{amount:.places$}");
    let digits =
        if places > 0 { digits.trim_end_matches('0').trim_end_matches('.') } else { &digits };
    format!("{digits} {}", units[unit])
}
