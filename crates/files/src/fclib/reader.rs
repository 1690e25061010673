//! Reads FCLIB's problems from HDF5.

use std::cell::RefCell;
use std::collections::HashSet;

use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Dataset, Hdf5File, OpenOptions};

use super::leftover;
use crate::Input;
use crate::budget::Budget;
use crate::contacts::{coulomb, law};
use crate::delassus::Motion;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Problem};
use lcplab_lcp::memory::Memory;

pub(super) fn read(input: &Input) -> Result<Problem> {
    let name = input.name();
    // A small array may be stored in a large chunk.
    let most = usize::try_from(input.most().in_bytes()).unwrap_or(usize::MAX);
    // Every array is read once.
    let chunk_cache_bytes = 0;
    let usual = OpenOptions { chunk_cache_bytes, max_read_bytes: most, ..OpenOptions::default() };
    let options = OpenOptions { max_chunk_bytes: usual.max_chunk_bytes.min(most), ..usual };
    let file = Hdf5File::from_vec_with_options(input.bytes()?, options)
        .map_err(|cause| Error::invalid(&name, "file", cause.to_string()))?;
    let has = |group: &str| file.group(group).is_ok();
    let file = File {
        file: &file,
        input: &name,
        most: input.most(),
        budget: Budget::new(input.most()),
        read: RefCell::default(),
    };
    let (kind, contents) = match KINDS.map(has) {
        [true, false, false] => (KINDS[0], file.local()?),
        [false, true, false] => (KINDS[1], file.global()?),
        [false, false, true] => {
            let reason = "holds contacts with rolling friction, which are not read";
            return Err(file.fault(KINDS[2], reason));
        }
        [false, false, false] => {
            let reason = "is missing, and so is fclib_global, so this is not an FCLIB file";
            return Err(Error::invalid(&name, "fclib_local", reason));
        }
        _ => return Err(file.fault("file", "contains several problems; select one of them")),
    };
    let beside = leftover::check(file.file, &file.read.borrow(), kind, &name)?;
    let Contents { entries, b, mu, dimension } = contents;
    let lcp =
        coulomb(entries, b, &mu, dimension).into_lcp().map_err(|error| error.within(&name))?;
    let title = file.read(&format!("{kind}/info/title"), Some(1), Dataset::read_string);
    let title = title.unwrap_or_else(|_| input.stem());
    let model = law(&lcp, dimension);
    let warnings = beside.into_iter().collect();
    Ok(Problem { model, warnings, ..Problem::new(title, lcp) })
}

/// The groups of the problem kinds.
const KINDS: [&str; 3] = ["/fclib_local", "/fclib_global", "/fclib_global_rolling"];

/// A local problem, or a global one converted to local form.
struct Contents {
    entries: Entries,
    b: Vec<f64>,
    mu: Vec<f64>,
    /// The number of rows of a contact.
    dimension: usize,
}

/// A sparse matrix.
struct Sparse {
    rows: usize,
    cols: usize,
    entries: Vec<(usize, usize, f64)>,
}

/// An HDF5 file and its name in messages.
struct File<'a> {
    file: &'a Hdf5File,
    input: &'a str,
    most: Memory,
    budget: Budget,
    /// The paths of the datasets read so far.
    read: RefCell<HashSet<String>>,
}

impl File<'_> {
    fn local(&self) -> Result<Contents> {
        let dimension = self.dimension("/fclib_local/spacedim")?;
        let w = self.matrix("/fclib_local/W")?;
        let mut b = self.numbers("/fclib_local/vectors/q", w.rows)?;
        self.check_size("/fclib_local/W", &w, [w.rows, w.rows])?;
        let mu = self.numbers("/fclib_local/vectors/mu", w.rows / dimension)?;
        self.check_contacts("/fclib_local/W", w.rows, dimension)?;
        let (n, mut entries) = (w.rows, w.entries);
        if self.file.group("/fclib_local/R").is_ok() {
            let (v, r) = (self.matrix("/fclib_local/V")?, self.matrix("/fclib_local/R")?);
            self.check_size("/fclib_local/R", &r, [r.rows, r.rows])?;
            self.check_size("/fclib_local/V", &v, [n, r.rows])?;
            b.extend(self.numbers("/fclib_local/vectors/s", r.rows)?);
            for (i, j, value) in v.entries {
                entries.extend([(i, n + j, value), (n + j, i, value)]);
            }
            entries.extend(r.entries.into_iter().map(|(i, j, value)| (n + i, n + j, value)));
        }
        Ok(Contents { entries: Entries::Sparse(entries), b, mu, dimension })
    }

    fn global(&self) -> Result<Contents> {
        let dimension = self.dimension("/fclib_global/spacedim")?;
        let (m, h) = (self.matrix("/fclib_global/M")?, self.matrix("/fclib_global/H")?);
        let k = m.rows;
        let force = self.numbers("/fclib_global/vectors/f", k)?;
        self.check_size("/fclib_global/M", &m, [k, k])?;
        self.check_size("/fclib_global/H", &h, [k, h.cols])?;
        self.check_contacts("/fclib_global/H", h.cols, dimension)?;
        let mut bias = self.numbers("/fclib_global/vectors/w", h.cols)?;
        let mu = self.numbers("/fclib_global/vectors/mu", h.cols / dimension)?;
        let mut columns = h.entries;
        if self.file.group("/fclib_global/G").is_ok() {
            let g = self.matrix("/fclib_global/G")?;
            self.check_size("/fclib_global/G", &g, [k, g.cols])?;
            bias.extend(self.numbers("/fclib_global/vectors/b", g.cols)?);
            columns.extend(g.entries.into_iter().map(|(i, j, value)| (i, h.cols + j, value)));
        }
        let mut motion = Motion { mass: m.entries, jacobian: vec![Vec::new(); bias.len()], force };
        columns.into_iter().for_each(|(c, row, value)| motion.jacobian[row].push((c, value)));
        let zeros = vec![0.0; bias.len()];
        let (entries, free) = motion.dual(&zeros, "/fclib_global/M", self.input, self.most)?;
        let b = free.iter().zip(&bias).map(|(free, bias)| free + bias).collect();
        Ok(Contents { entries, b, mu, dimension })
    }

    /// The number of rows of a contact.
    fn dimension(&self, path: &str) -> Result<usize> {
        match self.whole(path)? {
            d @ (2 | 3) => Ok(d),
            d => Err(self.fault(path, format!("is {d}, must be 2 (the plane) or 3 (space)"))),
        }
    }

    fn check_contacts(&self, path: &str, rows: usize, dimension: usize) -> Result<()> {
        match rows.is_multiple_of(dimension) {
            true => Ok(()),
            false => {
                let reason = format!("has {rows} rows, not {dimension} per contact");
                Err(self.fault(path, reason))
            }
        }
    }

    fn check_size(&self, path: &str, matrix: &Sparse, size: [usize; 2]) -> Result<()> {
        if [matrix.rows, matrix.cols] == size {
            return Ok(());
        }
        let (is, must) = (format!("{} × {}", matrix.rows, matrix.cols), size);
        Err(self.fault(path, format!("is {is}, must be {} × {}", must[0], must[1])))
    }

    /// The matrix stored in a group.
    fn matrix(&self, path: &str) -> Result<Sparse> {
        let part = |part: &str| format!("{path}/{part}");
        let group = self.file.group(path).map_err(|cause| self.fault(path, cause.to_string()))?;
        if group.attribute("symmetric_packed").is_ok() {
            return Err(
                self.fault(path, "is packed (half of a matrix), which is not FCLIB's format")
            );
        }
        let (rows, cols) = (self.whole(&part("m"))?, self.whole(&part("n"))?);
        let fault = |reason: &str| self.fault(path, format!("{rows} × {cols}: {reason}"));
        let nz = self.integer(&part("nz"))?;
        let starts = match nz {
            -1 => cols + 1,
            -2 => rows + 1,
            nz => usize::try_from(nz)
                .map_err(|_| fault("nz must be -1, -2 or a number of triplets"))?,
        };
        let x: Vec<f64> = self.read(&part("x"), None, floats)?;
        let i = self.integers(&part("i"), Some(x.len()))?;
        let p = self.integers(&part("p"), Some(starts))?;
        let (i, j) = match nz {
            -1 => (wholes(&i), unpacked(&p, cols, x.len())),
            -2 => (unpacked(&p, rows, x.len()), wholes(&i)),
            // The meaning in CSparse.
            _ => (wholes(&i), wholes(&p)),
        };
        let (Some(i), Some(j)) = (i, j) else {
            return Err(fault("p and i do not determine the positions of the numbers"));
        };
        let fits = i.iter().all(|i| *i < rows) && j.iter().all(|j| *j < cols);
        if i.len() != x.len() || j.len() != x.len() || !fits {
            return Err(fault("p, i and x do not agree"));
        }
        let places = i.into_iter().zip(j).zip(x);
        let entries = places.map(|((i, j), value)| (i, j, value)).collect();
        Ok(Sparse { rows, cols, entries })
    }

    fn whole(&self, path: &str) -> Result<usize> {
        let value = self.integer(path)?;
        let negative = |_| self.fault(path, format!("must be a size, is {value}"));
        usize::try_from(value).map_err(negative)
    }

    fn integer(&self, path: &str) -> Result<i64> {
        let values = self.integers(path, Some(1))?;
        values.first().copied().ok_or_else(|| self.fault(path, "has no number"))
    }

    fn integers(&self, path: &str, count: Option<usize>) -> Result<Vec<i64>> {
        self.read(path, count, integers)
    }

    /// `n` finite numbers.
    fn numbers(&self, path: &str, n: usize) -> Result<Vec<f64>> {
        let numbers: Vec<f64> = self.read(path, Some(n), floats)?;
        match numbers.iter().find(|number| !number.is_finite()) {
            Some(number) => Err(self.fault(path, format!("has {number}"))),
            None => Ok(numbers),
        }
    }

    /// The values of a dataset, checked against the expected length, if known, and the memory
    /// limit.
    fn read<T>(
        &self,
        path: &str,
        count: Option<usize>,
        values: impl Fn(&Dataset) -> hdf5_reader::error::Result<T>,
    ) -> Result<T> {
        let fault = |cause: hdf5_reader::error::Error| self.fault(path, cause.to_string());
        let dataset = self.file.dataset(path).map_err(fault)?;
        let found = usize::try_from(dataset.num_elements().map_err(fault)?).unwrap_or(usize::MAX);
        if let Some(count) = count.filter(|count| *count != found) {
            return Err(self.fault(path, format!("has {found} numbers, must have {count}")));
        }
        let what = format!("{}: {path} of {found} numbers", self.input);
        self.budget.take(what, found, size_of::<f64>())?;
        self.read.borrow_mut().insert(path.to_string());
        values(&dataset).map_err(fault)
    }

    fn fault(&self, path: &str, reason: impl Into<String>) -> Error {
        Error::invalid(self.input, path, reason)
    }
}

/// Floats stored in 4 or 8 bytes.
fn floats(dataset: &Dataset) -> hdf5_reader::error::Result<Vec<f64>> {
    match dataset.dtype() {
        Datatype::FloatingPoint { size: 4, .. } => {
            Ok(dataset.read_array::<f32>()?.iter().map(|value| f64::from(*value)).collect())
        }
        _ => Ok(dataset.read_array::<f64>()?.iter().copied().collect()),
    }
}

/// Integers stored in 4 or 8 bytes.
fn integers(dataset: &Dataset) -> hdf5_reader::error::Result<Vec<i64>> {
    match dataset.dtype() {
        Datatype::FixedPoint { size: 8, .. } => {
            Ok(dataset.read_array::<i64>()?.iter().copied().collect())
        }
        _ => Ok(dataset.read_array::<i32>()?.iter().map(|value| i64::from(*value)).collect()),
    }
}

fn wholes(values: &[i64]) -> Option<Vec<usize>> {
    values.iter().map(|value| usize::try_from(*value).ok()).collect()
}

/// The line of each of `count` numbers, from the start index of each line and the end of the last.
fn unpacked(starts: &[i64], lines: usize, count: usize) -> Option<Vec<usize>> {
    let starts = wholes(starts)?;
    let spans = (starts.first(), starts.last()) == (Some(&0), Some(&count));
    let is_ascending = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    if starts.len().checked_sub(1) != Some(lines) || !spans || !is_ascending {
        return None;
    }
    let line = |(line, pair): (usize, &[usize])| std::iter::repeat_n(line, pair[1] - pair[0]);
    Some(starts.windows(2).enumerate().flat_map(line).collect())
}
