//! NumPy's `.npz`: a zip archive with one array per file.
//!
//! The formats are NumPy's NEP 1 (`.npy`, versions 1 to 3) and the archive of `numpy.savez` and
//! `numpy.savez_compressed`; a sparse matrix is stored as `scipy.sparse.save_npz` stores it.
//!
//! | array | type | meaning |
//! | --- | --- | --- |
//! | `A` | numbers, n × n | the matrix, if it is dense |
//! | `data`, `indices`, `indptr`, `shape`, `format` | as SciPy | the matrix, if it is sparse; `format` is `csr`, `csc` or, with `row` and `col`, `coo` |
//! | `b` | numbers, n | the offset of w = A x + b |
//! | `lo`, `hi` | numbers, n | bounds; 0 and ∞ where they are absent |
//! | `friction_index`, `mu` | integers and numbers, n | as in [`file`](lcplab_lcp::file): rows from 0, −1 for none |
//!
//! An archive with `G`, `g` and `mus` instead comes from ContactBench, the benchmark of contact
//! solvers in robotics: contacts t1, t2, n with Coulomb's cone, A = G and b = g; `lam0`, an initial
//! guess, is not part of the problem and causes a warning.
//!
//! An archive with `J_data` instead of A is a frame of an engine: J, M, R, u* and bias, from which
//! A and b are computed (`frame.rs` lists the arrays).
//!
//! ```text
//! numpy.savez("problem.npz", A=A, b=b)                              # NumPy
//! numpy.savez("problem.npz", data=A.data, indices=A.indices, indptr=A.indptr,
//!             shape=A.shape, format="csr", b=b)                     # a scipy.sparse.csr_array
//! ```
//!
//! `numpy.load` reads the written files, and `scipy.sparse.load_npz` reads a sparse A from them.
//!
//! Traps: `scipy.sparse.save_npz` writes the matrix only, so b is missing. `A.T` and arrays from
//! Fortran are stored by columns, `fortran_order`, and are read accordingly. Half of a symmetric
//! matrix (`scipy.sparse.tril`) is not completed. Arrays of objects are pickles and are rejected,
//! and so is an archive with an array that is not listed here.

mod array;
mod contact_bench;
mod frame;
mod header;

use std::io::{Cursor, Read, Write};
use std::path::Path;

use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipArchive, ZipWriter};

use super::budget::Budget;
use super::table::{Table, parts};
use super::{Format, Input, Output};
use array::{Array, Outline};
use lcplab_lcp::Matrix;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Answers, Entries, Problem};
use lcplab_lcp::memory::Memory;

/// NumPy's archives of arrays.
pub const FORMAT: Format = Format {
    name: "npz",
    about: "NumPy and SciPy: an archive of arrays, A dense or as scipy.sparse stores it; ContactBench's G, g, \
     mus; frames of engines, J, M, R",
    endings: &[".npz"],
    in_folder: None,
    beside: &[],
    carries: "any bounds, coupled rows, dense and sparse",
    law: None,
    trap: "scipy.sparse.save_npz writes no b; arrays with fortran_order are stored by columns",
    read,
    write: Some(write),
};

fn read(input: &Input) -> Result<Problem> {
    let name = input.name();
    let mut archive = Archive::open(input, &name)?;
    let names = archive.names();
    let has = |part: &str| names.iter().any(|name| name == part);
    if has("G") && !has("A") {
        let arrays = archive.arrays(&contact_bench::ARRAYS)?;
        let problem = contact_bench::problem(&arrays, input.stem(), &name)?;
        check_names(&names, &[&contact_bench::ARRAYS, &[contact_bench::GUESS]], &name)?;
        let guess = has(contact_bench::GUESS).then(|| {
            format!("{name}: not part of the problem: {}, a first guess", contact_bench::GUESS)
        });
        return Ok(Problem { warnings: guess.into_iter().collect(), ..problem });
    }
    if has("J_data") && !has("A") {
        check_names(&names, &[&frame::ARRAYS], &name)?;
        let arrays = archive.arrays(&frame::ARRAYS)?;
        return frame::problem(&arrays, input.stem(), &name, input.most());
    }
    let mut arrays = archive.arrays(&VECTORS)?;
    let table = if has("A") {
        check_names(&names, &[&["A"], &VECTORS], &name)?;
        arrays.extend(archive.arrays(&["A"])?);
        arrays["A"].table().map_err(|reason| Error::invalid(&name, "A", reason))?
    } else {
        arrays.extend(archive.arrays(&SPARSE)?);
        sparse(&arrays, &names, &name)?
    };
    let vector = |part: &str| {
        let vector = arrays.get(part).map(Array::vector).transpose();
        vector.map_err(|reason| Error::invalid(&name, part, reason))
    };
    let lcp = parts(table, vector, &name)?.into_lcp().map_err(|error| error.within(&name))?;
    Ok(Problem::new(input.stem(), lcp))
}

/// An answer to a problem of n rows: the vector of a `.npy` file, or the array x of a `.npz` file;
/// any other file is read as JSON, as by [`read_answers`](lcplab_lcp::file::read_answers).
///
/// ```
/// use lcplab_lcp::memory::Memory;
///
/// let path = std::env::temp_dir().join("lcplab-answer.json");
/// std::fs::write(&path, "[0.5, 0]").unwrap();
/// assert_eq!(lcplab_files::read_answers(&path, 2, Memory::default())?.x, [0.5, 0.0]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// If the file cannot be read or has no vector of `n` numbers.
pub fn read_answers(path: &Path, n: usize, most: Memory) -> Result<Answers> {
    let is = |end: &str| path.extension().is_some_and(|own| own.eq_ignore_ascii_case(end));
    let (file, input) = (Input::new(path, most), path.display().to_string());
    let array = match (is("npy"), is("npz")) {
        (true, _) => {
            let mut bytes = Cursor::new(file.bytes()?);
            let bytes = &mut bytes as &mut dyn Read;
            let array = Outline::read(bytes).and_then(|outline| outline.filled(bytes));
            Some(array.map_err(|reason| Error::invalid(&input, "file", reason))?)
        }
        (_, true) => Archive::open(&file, &input)?.array("x")?,
        _ => return lcplab_lcp::file::read_answers(path, n, most),
    };
    let fault = |reason: String| Error::invalid(&input, "x", reason);
    let x = array.ok_or_else(|| fault("is missing".into()))?.vector().map_err(fault)?;
    match x.len() == n {
        true => Ok(Answers { x, iterates: Vec::new() }),
        false => Err(fault(format!("has length {}, the problem has {n} rows", x.len()))),
    }
}

/// The arrays stored with the matrix.
const VECTORS: [&str; 5] = ["b", "lo", "hi", "mu", "friction_index"];

/// The arrays of a sparse matrix.
const SPARSE: [&str; 7] = ["format", "shape", "data", "indices", "indptr", "row", "col"];

/// Rejects an archive with an array that is not in `known`.
fn check_names(names: &[String], known: &[&[&str]], input: &str) -> Result<()> {
    match names.iter().find(|name| known.iter().all(|known| !known.contains(&name.as_str()))) {
        None => Ok(()),
        Some(name) => {
            let known = known.concat().join(", ");
            let reason = format!("is not understood: the other arrays of this file may be {known}");
            Err(Error::invalid(input, name.as_str(), reason))
        }
    }
}

fn sparse(arrays: &Arrays, names: &[String], input: &str) -> Result<Table> {
    let get = |part: &str| {
        arrays.get(part).ok_or_else(|| {
            let reason = "is missing: there is neither A nor a scipy.sparse matrix";
            Error::invalid(input, part, reason)
        })
    };
    let whole =
        |part: &str| get(part)?.wholes().map_err(|reason| Error::invalid(input, part, reason));
    let format = get("format")?.text().map_err(|reason| Error::invalid(input, "format", reason))?;
    let fault = |part: &str, reason: String| Err(Error::invalid(input, part, reason));
    if !matches!(format.as_str(), "csr" | "csc" | "coo") {
        return fault("format", format!("must be csr, csc or coo, is {format:?}"));
    }
    let [rows, cols] = whole("shape")?[..] else {
        return fault("shape", "must be rows and columns".into());
    };
    let data = get("data")?.vector().map_err(|reason| Error::invalid(input, "data", reason))?;
    let places = if format == "coo" { ["row", "col"] } else { ["indices", "indptr"] };
    // `_is_array` marks a scipy.sparse array.
    let matrix = ["format", "shape", "data", "_is_array"];
    check_names(names, &[&matrix, &places, &VECTORS], input)?;
    let (lines, across) = if format == "csc" { (cols, rows) } else { (rows, cols) };
    let (i, j) = match format.as_str() {
        "coo" => (whole("row")?, whole("col")?),
        _ => (unpacked(&whole("indptr")?, lines, data.len(), "indptr", input)?, whole("indices")?),
    };
    if i.len() != data.len() || j.len() != data.len() {
        let reason = format!("has {} numbers, but there are {} places", data.len(), j.len());
        return fault("data", reason);
    }
    let mut triplets = Vec::new();
    for (k, ((i, j), value)) in i.into_iter().zip(j).zip(data).enumerate() {
        if i >= lines || j >= across {
            return fault(&format!("data[{k}]"), format!("lies at {i}, {j} of {rows} × {cols}"));
        }
        triplets.push(if format == "csc" { (j, i, value) } else { (i, j, value) });
    }
    Ok(Table { rows, cols, entries: Entries::Sparse(triplets) })
}

/// The line of each number, from the start index of each line and the end of the last one.
fn unpacked(
    starts: &[usize],
    lines: usize,
    count: usize,
    part: &str,
    input: &str,
) -> Result<Vec<usize>> {
    let is_ascending = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    let spans = (starts.first(), starts.last()) == (Some(&0), Some(&count));
    if starts.len().checked_sub(1) != Some(lines) || !is_ascending || !spans {
        let reason = format!("must rise from 0 to {count} in {lines} steps");
        return Err(Error::invalid(input, part, reason));
    }
    let line = |(line, pair): (usize, &[usize])| std::iter::repeat_n(line, pair[1] - pair[0]);
    Ok(starts.windows(2).enumerate().flat_map(line).collect())
}

/// Arrays by name.
type Arrays<'a> = std::collections::HashMap<&'a str, Array>;

/// The archive of a file called `input`.
struct Archive<'a> {
    input: &'a str,
    zip: ZipArchive<Cursor<Vec<u8>>>,
    budget: Budget,
}

impl<'a> Archive<'a> {
    fn open(file: &Input, input: &'a str) -> Result<Self> {
        let zip = ZipArchive::new(Cursor::new(file.bytes()?))
            .map_err(|_| Error::invalid(input, "file", "is no .npz archive, or is cut off"))?;
        Ok(Archive { input, zip, budget: Budget::new(file.most()) })
    }

    fn names(&self) -> Vec<String> {
        let mut names: Vec<_> = self
            .zip
            .file_names()
            .flatten()
            .map(|n| n.trim_end_matches(".npy").to_string())
            .collect();
        names.sort();
        names
    }

    /// Those of these arrays that exist.
    fn arrays<'b>(&mut self, parts: &[&'b str]) -> Result<Arrays<'b>> {
        let mut arrays = Arrays::new();
        for part in parts {
            if let Some(array) = self.array(part)? {
                arrays.insert(*part, array);
            }
        }
        Ok(arrays)
    }

    /// The array with this name, if it exists.
    fn array(&mut self, part: &str) -> Result<Option<Array>> {
        let fault = |reason: String| Error::invalid(self.input, part, reason);
        let mut file = match self.zip.by_name(&format!("{part}.npy")) {
            Ok(file) => file,
            Err(zip::result::ZipError::FileNotFound) => return Ok(None),
            Err(cause) => return Err(fault(cause.to_string())),
        };
        let file = &mut file as &mut dyn Read;
        let outline = Outline::read(file).map_err(fault)?;
        let what = format!("{}: {part} of the shape {:?}", self.input, outline.shape());
        let (count, size) = outline.size();
        self.budget.take(what, count, size)?;
        outline.filled(file).map(Some).map_err(fault)
    }
}

fn write(problem: &Problem) -> Result<Output> {
    let lcp = &problem.lcp;
    let n = lcp.len();
    let mut arrays = matrix(lcp.matrix());
    for (part, values) in [("b", lcp.b()), ("lo", lcp.lo()), ("hi", lcp.hi())] {
        arrays.push((part, Array::floats(values.to_vec())));
    }
    if let Some(coupling) = lcp.coupling() {
        let index = (0..n).map(|i| coupling.index(i).map_or(-1, |k| k as i64));
        arrays.push(("friction_index", Array::integers(index.collect())));
        arrays.push(("mu", Array::floats((0..n).map(|i| coupling.mu(i)).collect())));
    }
    let archive = archive(&arrays);
    archive.map(Output::of).map_err(|cause| Error::invalid("npz", "archive", cause.to_string()))
}

fn matrix(a: &Matrix) -> Vec<(&'static str, Array)> {
    let n = a.len();
    let entries = || (0..n).flat_map(|i| a.row(i).iter());
    let data = entries().map(|(_, value)| value).collect();
    if let Matrix::Dense(_) = a {
        return vec![("A", Array::floats(data).shaped(vec![n, n]))];
    }
    let indptr = std::iter::once(0).chain((0..n).scan(0, |end, i| {
        *end += a.row(i).iter().count() as i64;
        Some(*end)
    }));
    vec![
        ("indices", Array::integers(entries().map(|(j, _)| j as i64).collect())),
        ("indptr", Array::integers(indptr.collect())),
        ("format", Array::word("csr")),
        ("shape", Array::integers(vec![n as i64; 2])),
        ("data", Array::floats(data)),
    ]
}

fn archive(arrays: &[(&str, Array)]) -> std::io::Result<Vec<u8>> {
    let mut zip = ZipWriter::new(Cursor::new(Vec::new()));
    let stored = SimpleFileOptions::default().compression_method(CompressionMethod::Stored);
    for (part, array) in arrays {
        zip.start_file(format!("{part}.npy"), stored)?;
        zip.write_all(&array.to_bytes())?;
    }
    Ok(zip.finish()?.into_inner())
}
