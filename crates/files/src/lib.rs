//! Reads and writes problems in the file formats of other programs.
//!
//! | format | file | written | bounds | friction | its unknowns and their order |
//! | --- | --- | --- | --- | --- | --- |
//! | `json`: [`file`](lcplab_lcp::file) | `.json` | yes | any | any model | w = A x + b, the file defines the contacts' rows |
//! | [`matrix_market`] | `.mtx`, several | yes | any | coupled rows | as `json`; a matrix in full is listed by columns |
//! | [`npz`] | `.npz` | yes | any | coupled rows | as `json`; by rows unless `fortran_order` |
//! | [`mat`] | `.mat` | no | any | coupled rows | as `json`, or min ½ xᵀPx + qᵀx with constraints: A from P, b from q; by columns |
//! | [`qps`] | `.qps`, `.mps` | yes | any | none | min ½ xᵀQx + cᵀx: A = Q, b = c; Q by one triangle |
//! | [`siconos`] | `.dat` | yes | 0 and ∞, or finite | Coulomb's law | w = M z + q; n first; dense blocks by columns |
//! | [`fclib`] | `.hdf5` | yes | equations | Coulomb's law | u = W r + q; n first; sparse by columns or rows |
//! | [`chrono`] | `_Cq.dat`, several | no | equations | associated cone | A = Cq H⁻¹ Cqᵀ + E, b = Cq H⁻¹ f + b; n first |
//!
//! The page of each format gives its definition, its mapping to w = A x + b, and common mistakes.
//! Nothing is guessed: a file with content that the reader does not understand is invalid input,
//! and the error names the file, the line or key, and the reason. Content that is known not to be
//! part of the problem, such as an answer stored with it, causes a warning.
//!
//! ```
//! use lcplab_files as files;
//! use lcplab_lcp::library;
//!
//! let folder = std::env::temp_dir().join("lcplab-files");
//! std::fs::create_dir_all(&folder).unwrap();
//! let path = folder.join("murty.mtx"); // and murty_b.mtx, murty_lo.mtx, murty_hi.mtx beside it
//! let problem = library::by_name("murty")?.generate(&[("n", 4.0)])?;
//! files::write(&problem, &path, None)?;
//! let back = files::read(&path, None)?;
//! assert_eq!(back.lcp.w(&[0.0, 0.0, 0.0, 1.0]), [1.0, 1.0, 1.0, 0.0]);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```
//!
//! MuJoCo's contact problems come as `json`: Python's `lcplab.receipt(model, data).write` writes
//! them. MuJoCo's contacts are soft, so the matrix is A + R, not A.
//!
//! The contents of a file bound the memory: the reader trusts a size that a file states only after
//! reading that many numbers, and unpacks compressed data only if all of it together stays within
//! the limit ([`read_within`]).
//!
//! ```
//! use lcplab_files::{is_problem, read, read_within, write};
//! use lcplab_lcp::file::Problem;
//! use lcplab_lcp::memory::Memory;
//! use lcplab_lcp::{Lcp, Matrix};
//!
//! let folder = tempfile::tempdir().unwrap();
//! let path = folder.path().join("two.npz");
//! let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
//! let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
//! write(&Problem::new("two contacts", lcp), &path, None)?; // NumPy's format, by the ending
//! assert!(is_problem(&path));
//! assert_eq!(read(&path, None)?.lcp.w(&[0.5, 0.0]), [0.0, 1.5]);
//! assert!(read_within(&path, None, Memory::bytes(10)).is_err()); // the file is larger
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod budget;
pub mod chrono;
mod contacts;
mod delassus;
pub mod disk;
pub mod fclib;
mod foreign;
mod input;
pub mod mat;
pub mod matrix_market;
mod multipliers;
pub mod npz;
mod output;
pub mod qps;
mod several;
pub mod siconos;
mod table;
mod words;

pub use input::Input;
pub use npz::read_answers;
pub use output::Output;
pub use several::several;

use std::path::{Path, PathBuf};

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_lcp::memory::Memory;

/// A format of problem files.
///
/// ```
/// use lcplab_files::{Format, encode, matrix_market};
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// assert_eq!(Format::by_name("npz")?.endings, [".npz"]);
/// let format = Format::of("A.mtx".as_ref()).unwrap();
/// assert_eq!(format.name, matrix_market::FORMAT.name);
///
/// // A.mtx needs a file for b, too; the bounds are the usual ones.
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let output = encode(&Problem::new("one contact", lcp), format)?;
/// assert!(output.main.starts_with(b"%%MatrixMarket matrix"));
/// assert!(output.parts.iter().any(|(part, _)| *part == "b"));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy)]
pub struct Format {
    /// The name to select it by.
    pub name: &'static str,
    /// The program or project it belongs to, in one line.
    pub about: &'static str,
    /// The endings of its file names; for a format of several files, those of the file with the
    /// matrix.
    pub endings: &'static [&'static str],
    /// For a format of several files: the ending of the file with the matrix if they share a
    /// folder.
    pub in_folder: Option<&'static str>,
    /// The other files, named after their contents: with `A.mtx` come `b.mtx`, ….
    pub beside: &'static [&'static str],
    /// The problems it can represent.
    pub carries: &'static str,
    /// The friction model that its files imply, if they imply one.
    pub law: Option<Model>,
    /// Common mistakes.
    pub trap: &'static str,
    /// Reads a problem.
    pub read: fn(&Input) -> Result<Problem>,
    /// Writes a problem, as far as the format can represent it.
    pub write: Option<fn(&Problem) -> Result<Output>>,
}

/// All formats.
pub const ALL: &[Format] = &[
    JSON,
    matrix_market::FORMAT,
    npz::FORMAT,
    mat::FORMAT,
    qps::FORMAT,
    siconos::FORMAT,
    fclib::FORMAT,
    chrono::FORMAT,
];

/// The contents of the file with the matrix, for a format of several files.
const MATRIX: &str = "A";

/// lcplab's own problem files.
pub const JSON: Format = Format {
    name: "json",
    about: "lcplab's own problem files",
    endings: &[".json"],
    in_folder: None,
    beside: &[],
    carries: "everything",
    law: None,
    trap: "w = A x + b: the sign of b is that of Siconos, not of ODE and DART",
    read: |input| Problem::read_within(input.path(), input.most()),
    write: Some(|problem| Ok(Output::of(format!("{}\n", problem.to_json())))),
};

impl Format {
    /// The format of this name.
    ///
    /// # Errors
    /// If there is none.
    pub fn by_name(name: &str) -> Result<&'static Format> {
        ALL.iter().find(|format| format.name == name).ok_or_else(|| Error::Unknown {
            kind: "format",
            name: name.to_string(),
            known: ALL.iter().map(|format| format.name.to_string()).collect(),
        })
    }

    /// The format whose ending the file name has, ignoring case; the longest ending is tried first,
    /// because `_Cq.dat` is not `.dat`.
    pub fn of(path: &Path) -> Option<&'static Format> {
        let name = path.file_name()?.to_str()?.to_ascii_lowercase();
        let ends = |ending: &&&str| name.ends_with(&ending.to_ascii_lowercase());
        let ending = |format: &Format| format.endings.iter().filter(ends).map(|e| e.len()).max();
        ALL.iter().filter(|format| ending(format).is_some()).max_by_key(|format| ending(format))
    }
}

/// Whether a name is that of a problem file: standard input, a known ending, or the folder or
/// common prefix of several files.
pub fn is_problem(path: &Path) -> bool {
    path == Path::new("-") || Format::of(path).is_some() || main_file(path).is_some()
}

/// Whether a name is that of the answer next to a frame, STEM.x.json.
pub fn is_answer(path: &Path) -> bool {
    path.to_str().is_some_and(|name| name.ends_with(".x.json"))
}

/// Reads a problem from a file, from standard input (`-`), or, for a format of several files, from
/// their folder or their common prefix. Without a format the ending decides; a name without a known
/// ending is read as JSON.
///
/// # Errors
/// If the files cannot be read or have defects.
pub fn read(path: &Path, format: Option<&Format>) -> Result<Problem> {
    read_within(path, format, Memory::default())
}

/// Like [`read`], with another limit on the memory that reading may take.
///
/// # Errors
/// As [`read`], or if reading needs more memory.
pub fn read_within(path: &Path, format: Option<&Format>, most: Memory) -> Result<Problem> {
    let found = main_file(path);
    let path = found.as_deref().unwrap_or(path);
    let format = format.or_else(|| Format::of(path)).unwrap_or(&JSON);
    (format.read)(&Input::new(path, most)).map_err(|error| foreign::explained(error, path, format))
}

/// Writes a problem, to several files if the format has several; returns warnings for the readers
/// of the files. Without a format the ending decides.
///
/// # Errors
/// If the format cannot represent the problem or is import only, if a file cannot be written, or if
/// an existing file would be read as part of the problem although it is not.
pub fn write(problem: &Problem, path: &Path, format: Option<&Format>) -> Result<Vec<String>> {
    let format = match format.or_else(|| Format::of(path)) {
        Some(format) => format,
        None => {
            let reason = unknown_ending(|format| format.write.is_some());
            return Err(Error::invalid(path.display().to_string(), "extension", reason));
        }
    };
    let main = match format.in_folder {
        Some(name) if path.is_dir() => path.join(name),
        _ => path.to_path_buf(),
    };
    let output = encode(problem, format)?;
    for part in format.beside.iter().filter(|part| output.parts.iter().all(|(p, _)| p != *part)) {
        let path = input::beside(&main, MATRIX, part);
        if path.exists() {
            let reason = "already exists and would be read as part of the problem; delete it or use another name";
            return Err(Error::invalid(path.display().to_string(), "file", reason));
        }
    }
    output.save(&main)?;
    Ok(output.notes)
}

/// The files of a problem in a format, without writing them.
///
/// # Errors
/// If the format cannot represent the problem or is import only.
pub fn encode(problem: &Problem, format: &Format) -> Result<Output> {
    let Some(write) = format.write else {
        return Err(Error::invalid(format.name, "format", "can be read but not written"));
    };
    let mut output = write(problem)?;
    if format.name != JSON.name {
        output.notes.extend(left_behind(problem, format));
    }
    Ok(output)
}

/// The problem's friction model and the one that the format implies, if they differ: in that format
/// it is a different problem with different solutions.
///
/// ```
/// use lcplab_files::{fclib, model, remodelled};
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::friction::Model;
///
/// let text = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
///                "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5]}"#;
/// let problem = Problem::parse(text, "push.json")?;
/// assert_eq!(model(&problem), Some(Model::CoupledBox));
/// // FCLIB's problems have Coulomb's cones.
/// let (own, meant) = remodelled(&problem, &fclib::FORMAT).unwrap();
/// assert_eq!((own, meant), (Model::CoupledBox, Model::CoulombCone));
/// assert_eq!(remodelled(&problem, &lcplab_files::JSON), None);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn remodelled(problem: &Problem, format: &Format) -> Option<(Model, Model)> {
    let own = model(problem)?;
    let meant = format.law.unwrap_or(Model::CoupledBox);
    (format.name != JSON.name && own != meant).then_some((own, meant))
}

/// The friction model of a problem; `None` without friction.
pub fn model(problem: &Problem) -> Option<Model> {
    problem.lcp.coupling().filter(|coupling| !coupling.is_empty())?;
    Some(problem.model.unwrap_or(Model::CoupledBox))
}

/// Information about a problem that the format cannot store.
fn left_behind(problem: &Problem, format: &Format) -> Option<String> {
    // Every QPS file states an objective.
    let is_kept = |key: &&str| *key == "objective" && format.name == qps::FORMAT.name;
    let mut left: Vec<&str> = problem.extra.keys().map(String::as_str).collect();
    left.retain(|key| !is_kept(key));
    left.extend((problem.lcp.scale() > 0.0).then_some("scale"));
    left.extend(problem.frozen_at.as_ref().map(|_| "frozen_at"));
    left.extend(problem.motion.as_ref().map(|_| "motion"));
    (!left.is_empty()).then(|| format!("the format cannot store {}", left.join(", ")))
}

/// The file with the matrix, if `path` is the folder or the common prefix of several files.
fn main_file(path: &Path) -> Option<PathBuf> {
    let several = || ALL.iter().filter_map(|format| Some((format, format.in_folder?)));
    if path.is_dir() {
        let mut names: Vec<_> = path.read_dir().ok()?.flatten().map(|e| e.file_name()).collect();
        names.sort();
        let is_main = |name: &&std::ffi::OsString| {
            name.to_str().is_some_and(|name| several().any(|(_, end)| name.ends_with(end)))
        };
        return names.iter().find(is_main).map(|name| path.join(name));
    }
    if path.exists() || Format::of(path).is_some() {
        return None;
    }
    let with = |ending: &str| PathBuf::from(format!("{}{ending}", path.display()));
    several().map(|(format, _)| with(format.endings[0])).find(|path| path.is_file())
}

fn unknown_ending(is_suitable: impl Fn(&Format) -> bool) -> String {
    let of = |format: &Format| format!("{} {}", format.name, format.endings.join(" "));
    let known: Vec<String> = ALL.iter().filter(|format| is_suitable(format)).map(of).collect();
    format!("is unknown; known are {}", known.join(", "))
}

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
