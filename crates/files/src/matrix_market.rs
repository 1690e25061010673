//! Matrix Market: a matrix as text, with the vectors in separate files.
//!
//! The format is Boisvert, Pozo & Remington, *The Matrix Market Exchange Formats: Initial Design*,
//! NISTIR 5935 (1996); each file holds one matrix. The matrix is in `problem.mtx`, `problem_A.mtx`
//! or `A.mtx`. Next to it are `problem_b.mtx` (or `b.mtx`), as in the SuiteSparse collection, `lo`
//! and `hi` (0 and ∞ if the file is missing), and, with friction, `friction_index` (rows counted
//! from 0, −1 for none) and `mu`. Their meaning is the same as in [`file`](lcplab_lcp::file): w
//! = A x + b.
//!
//! ```text
//! %%MatrixMarket matrix coordinate real symmetric      %%MatrixMarket matrix array real general
//! % the lower triangle, rows and columns from 1        2 2
//! 2 2 3                                                2
//! 1 1 2                                                -1
//! 2 1 -1                                               -1
//! 2 2 2                                                2
//! ```
//!
//! Traps: indices start at 1; an `array` is listed column by column; a `symmetric` file holds the
//! lower triangle only, and an entry above the diagonal is an error. The format does not define
//! infinite bounds: the words `inf`, `Infinity` (SciPy) and the same with a sign are read, and
//! `inf` is written. The reader accepts `real` and `integer`, `general` and `symmetric`; entries at
//! the same place are summed. `complex` and `pattern` files, which have no real numbers, are
//! rejected. The writer uses `general`, and an `array` for a dense A, with the fewest digits that
//! are read back bitwise.

use super::output::decimal;
use super::table::{Table, by_rows, parts};
use super::words::{Words, brief};
use super::{Format, Input, MATRIX, Output};
use lcplab_lcp::Matrix;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Problem};

/// Matrix Market.
pub const FORMAT: Format = Format {
    name: "matrix-market",
    about: "Matrix Market: one file for A, and files next to it for b, lo, hi",
    endings: &[".mtx"],
    in_folder: Some("A.mtx"),
    beside: &["b", "lo", "hi", "friction_index", "mu"],
    carries: "any bounds, coupled rows, dense and sparse",
    law: None,
    trap: "indices from 1; a full array by columns; a symmetric file is its lower triangle",
    read,
    write: Some(write),
};

fn read(input: &Input) -> Result<Problem> {
    let table = |input: &Input| parse(&input.text()?, &input.name());
    let vector = |part: &str| {
        let file = input.companion(MATRIX, part);
        file.exists().then(|| table(&file)?.vector(&file.name())).transpose()
    };
    let (name, matrix, b) = (input.name(), table(input)?, input.companion(MATRIX, "b"));
    if !b.exists() {
        let reason =
            "is missing: a Matrix Market file has one matrix, so b must be in a file next to it";
        return Err(Error::invalid(b.name(), "file", reason));
    }
    let lcp = parts(matrix, vector, &name)?.into_lcp().map_err(|e| e.within(&name))?;
    Ok(Problem::new(input.stem(), lcp))
}

/// The contents of the first line.
struct Header {
    is_coordinate: bool,
    is_symmetric: bool,
}

fn parse(text: &str, input: &str) -> Result<Table> {
    let mut words = Words::new(text, input);
    let header = header(&mut words)?;
    let sizes = loop {
        match words.line() {
            None => return Err(words.fault("the file ends before the sizes")),
            Some(line) if line.trim().is_empty() || line.starts_with('%') => {}
            Some(line) => break sizes(line, &header, &words)?,
        }
    };
    let table = match sizes[..] {
        [rows, cols, count] => coordinate(&mut words, rows, cols, count, &header)?,
        [rows, cols] => array(&mut words, rows, cols, &header)?,
        _ => unreachable!("two or three sizes"),
    };
    match words.next() {
        Some(word) => {
            Err(words.fault(format!("more entries than stated in the sizes: {:?}", brief(word))))
        }
        None => Ok(table),
    }
}

fn header(words: &mut Words) -> Result<Header> {
    let line = words.line().unwrap_or_default().to_ascii_lowercase();
    let fields: Vec<&str> = line.split_whitespace().collect();
    let ["%%matrixmarket", "matrix", format, field, symmetry] = fields[..] else {
        return Err(words.fault("must be %%MatrixMarket matrix FORMAT FIELD SYMMETRY"));
    };
    let among = |word: &str, what: &str, known: &[&str]| match known.contains(&word) {
        true => Ok(()),
        false => Err(words.fault(format!("{what} must be {}, is {word:?}", known.join(" or ")))),
    };
    among(format, "the format", &["coordinate", "array"])?;
    among(field, "the field", &["real", "integer"])?;
    among(symmetry, "the symmetry", &["general", "symmetric"])?;
    Ok(Header { is_coordinate: format == "coordinate", is_symmetric: symmetry == "symmetric" })
}

/// The numbers of rows and columns, and for coordinates the number of entries.
fn sizes(line: &str, header: &Header, words: &Words) -> Result<Vec<usize>> {
    let sizes: Option<Vec<usize>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
    let expected = if header.is_coordinate { 3 } else { 2 };
    match sizes {
        Some(sizes) if sizes.len() == expected => {
            if header.is_symmetric && sizes[0] != sizes[1] {
                let reason = format!("{} × {} cannot be symmetric", sizes[0], sizes[1]);
                return Err(words.fault(reason));
            }
            Ok(sizes)
        }
        _ => Err(words.fault(format!("must be {expected} sizes, is {:?}", brief(line)))),
    }
}

fn coordinate(
    words: &mut Words,
    rows: usize,
    cols: usize,
    count: usize,
    header: &Header,
) -> Result<Table> {
    let mut triplets = Vec::new();
    for k in 1..=count {
        let (i, j) = (words.whole(format_args!("row of entry {k}"))?, words.whole("its column")?);
        let value = words.number("its value")?;
        if !((1..=rows).contains(&i) && (1..=cols).contains(&j)) {
            let reason = format!("there is no row {i}, column {j} in {rows} × {cols}");
            return Err(words.fault(reason));
        }
        if header.is_symmetric && i < j {
            let reason = format!("row {i}, column {j} lies above the diagonal of a symmetric file");
            return Err(words.fault(reason));
        }
        triplets.push((i - 1, j - 1, value));
        if header.is_symmetric && i != j {
            triplets.push((j - 1, i - 1, value));
        }
    }
    Ok(Table { rows, cols, entries: Entries::Sparse(triplets) })
}

fn array(words: &mut Words, rows: usize, cols: usize, header: &Header) -> Result<Table> {
    let value = |words: &mut Words, i: usize, j: usize| {
        words.number(format_args!("row {}, column {}", i + 1, j + 1))
    };
    let mut by_columns = Vec::new();
    if header.is_symmetric {
        for (i, j) in lower_triangle(rows) {
            by_columns.push(value(words, i, j)?);
        }
        return Ok(Table { rows, cols, entries: Entries::Dense(mirrored(rows, &by_columns)) });
    }
    for k in 0..rows.saturating_mul(cols) {
        by_columns.push(value(words, k % rows, k / rows)?);
    }
    Ok(Table { rows, cols, entries: Entries::Dense(by_rows(rows, cols, &by_columns)) })
}

/// The positions (i, j) on and below the diagonal, column by column.
fn lower_triangle(n: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..n).flat_map(move |j| (j..n).map(move |i| (i, j)))
}

/// All n² entries, from the lower triangle by columns.
fn mirrored(n: usize, lower: &[f64]) -> Vec<f64> {
    let mut entries = vec![0.0; n * n];
    for ((i, j), value) in lower_triangle(n).zip(lower) {
        (entries[i * n + j], entries[j * n + i]) = (*value, *value);
    }
    entries
}

fn write(problem: &Problem) -> Result<Output> {
    let lcp = &problem.lcp;
    let n = lcp.len();
    let mut parts = vec![("b", column("real", lcp.b().iter().map(|v| decimal(*v))))];
    for (part, bounds) in [("lo", lcp.lo()), ("hi", lcp.hi())] {
        parts.push((part, column("real", bounds.iter().map(|v| decimal(*v)))));
    }
    if let Some(coupling) = lcp.coupling() {
        let index = |i| coupling.index(i).map_or("-1".to_string(), |k| k.to_string());
        parts.push(("friction_index", column("integer", (0..n).map(index))));
        parts.push(("mu", column("real", (0..n).map(|i| decimal(coupling.mu(i))))));
    }
    let main = matrix(lcp.matrix()).into_bytes();
    Ok(Output { main, parts, ..Output::default() })
}

fn matrix(a: &Matrix) -> String {
    let n = a.len();
    if let Matrix::Dense(_) = a {
        let by_columns = (0..n * n).map(|k| decimal(a.entry(k % n, k / n)));
        return lines(format!("%%MatrixMarket matrix array real general\n{n} {n}\n"), by_columns);
    }
    let row = |i| a.row(i).iter().map(move |(j, v)| format!("{} {} {}", i + 1, j + 1, decimal(v)));
    let sizes = format!("{n} {n} {}", a.stored());
    lines(format!("%%MatrixMarket matrix coordinate real general\n{sizes}\n"), (0..n).flat_map(row))
}

fn column(field: &str, values: impl ExactSizeIterator<Item = String>) -> String {
    let sizes = format!("{} 1", values.len());
    lines(format!("%%MatrixMarket matrix array {field} general\n{sizes}\n"), values)
}

fn lines(header: String, values: impl Iterator<Item = String>) -> String {
    values.fold(header, |text, value| text + &value + "\n")
}
