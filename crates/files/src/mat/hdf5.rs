//! Reads MATLAB's format 7.3: each variable is a dataset, or, if it is sparse, a group.
//!
//! A matrix is stored with its columns as rows. A sparse matrix is a group with the attribute
//! `MATLAB_sparse`, its number of rows, and the datasets `data`, `ir` and `jc`. The attribute
//! `MATLAB_class` names the type.

use hdf5_reader::attribute_api::Attribute;
use hdf5_reader::messages::datatype::Datatype;
use hdf5_reader::{Dataset, Hdf5File, OpenOptions};

use super::fault;
use super::level5::wholes;
use super::variables::{Variables, dense, sparse};
use crate::budget::Budget;
use crate::table::Table;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::memory::Memory;

/// Types of numbers.
const CLASSES: [&str; 10] =
    ["double", "single", "int8", "uint8", "int16", "uint16", "int32", "uint32", "int64", "uint64"];
/// Files with more variables are rejected.
const MOST: usize = 1000;

/// The variables of a file.
pub(super) fn read(bytes: Vec<u8>, input: &str, most: Memory) -> Result<Variables> {
    let limit = usize::try_from(most.in_bytes()).unwrap_or(usize::MAX);
    let usual =
        OpenOptions { chunk_cache_bytes: 0, max_read_bytes: limit, ..OpenOptions::default() };
    let options = OpenOptions { max_chunk_bytes: usual.max_chunk_bytes.min(limit), ..usual };
    let broken =
        |cause: hdf5_reader::error::Error| Error::invalid(input, "file", cause.to_string());
    let file = Hdf5File::from_vec_with_options(bytes, options).map_err(broken)?;
    let root = file.root_group().map_err(broken)?;
    let (groups, datasets) = root.member_names().map_err(broken)?;
    if groups.len() + datasets.len() > MOST {
        return Err(Error::invalid(input, "file", format!("has more than {MOST} variables")));
    }
    let budget = Budget::new(most);
    let mut all = Vec::new();
    for name in groups {
        let reader = Reader { input, name: &name, budget: &budget };
        let group = root.group(&name).map_err(|cause| reader.broken(&cause))?;
        let rows = group.attribute("MATLAB_sparse");
        let Ok(rows) = rows.and_then(|attribute| attribute.read_as_f64()) else {
            return Err(fault(
                input,
                &name,
                "is a structure or an object, must be a matrix of numbers",
            ));
        };
        reader.check_class(group.attribute("MATLAB_class").ok())?;
        let part = |part: &str| group.dataset(part).map_err(|cause| reader.broken(&cause));
        let rows = wholes(&[rows], input, &name)?[0];
        let starts = wholes(&reader.numbers(&part("jc")?)?, input, &name)?;
        // A matrix without entries has neither.
        let stored = |name: &str| match starts.last() {
            Some(0) => Ok(Vec::new()),
            _ => reader.numbers(&part(name)?),
        };
        let (row_of, values) = (wholes(&stored("ir")?, input, &name)?, stored("data")?);
        let size = [rows, starts.len().saturating_sub(1)];
        let table = sparse(size, &row_of, &starts, &values, input, &name)?;
        all.push((name.clone(), table));
    }
    for name in datasets {
        let reader = Reader { input, name: &name, budget: &budget };
        let dataset = root.dataset(&name).map_err(|cause| reader.broken(&cause))?;
        all.push((name.clone(), reader.table(&dataset)?));
    }
    Ok(Variables { all })
}

/// Reads one variable.
struct Reader<'a> {
    input: &'a str,
    name: &'a str,
    budget: &'a Budget,
}

impl Reader<'_> {
    fn broken(&self, cause: &hdf5_reader::error::Error) -> Error {
        fault(self.input, self.name, cause.to_string())
    }

    fn check_class(&self, class: Option<Attribute>) -> Result<()> {
        let class = class.and_then(|class| class.read_string().ok()).unwrap_or_default();
        match CLASSES.contains(&class.as_str()) {
            true => Ok(()),
            false => {
                let reason = format!("is of the class {class:?}, must be a matrix of numbers");
                Err(fault(self.input, self.name, reason))
            }
        }
    }

    /// A dense matrix. An empty one is stored as its dimensions.
    fn table(&self, dataset: &Dataset) -> Result<Table> {
        self.check_class(dataset.attribute("MATLAB_class").ok())?;
        if dataset.attribute("MATLAB_empty").is_ok() {
            let [rows, cols] = wholes(&self.numbers(dataset)?, self.input, self.name)?[..] else {
                return Err(fault(self.input, self.name, "must have 2 dimensions"));
            };
            return dense([rows, cols], &[], self.input, self.name);
        }
        let &[cols, rows] = dataset.shape() else {
            let reason = format!("has {} dimensions, must have 2", dataset.shape().len());
            return Err(fault(self.input, self.name, reason));
        };
        let size = [rows, cols].map(|length| usize::try_from(length).unwrap_or(usize::MAX));
        dense(size, &self.numbers(dataset)?, self.input, self.name)
    }

    /// The numbers of a dataset.
    fn numbers(&self, dataset: &Dataset) -> Result<Vec<f64>> {
        let broken = |cause: hdf5_reader::error::Error| self.broken(&cause);
        let count = usize::try_from(dataset.num_elements().map_err(broken)?).unwrap_or(usize::MAX);
        let what = format!("{}: {} of {count} numbers", self.input, self.name);
        self.budget.take(what, count, size_of::<f64>())?;
        macro_rules! read {
            ($number:ty) => {
                dataset.read_array::<$number>().map(|all| all.iter().map(|v| *v as f64).collect())
            };
        }
        let numbers: hdf5_reader::error::Result<Vec<f64>> = match dataset.dtype() {
            Datatype::FloatingPoint { size: 4, .. } => read!(f32),
            Datatype::FloatingPoint { .. } => read!(f64),
            Datatype::FixedPoint { size: 1, signed: true, .. } => read!(i8),
            Datatype::FixedPoint { size: 1, .. } => read!(u8),
            Datatype::FixedPoint { size: 2, signed: true, .. } => read!(i16),
            Datatype::FixedPoint { size: 2, .. } => read!(u16),
            Datatype::FixedPoint { size: 4, signed: true, .. } => read!(i32),
            Datatype::FixedPoint { size: 4, .. } => read!(u32),
            Datatype::FixedPoint { signed: true, .. } => read!(i64),
            Datatype::FixedPoint { .. } => read!(u64),
            _ => {
                let reason = "is no matrix of real numbers; complex numbers are not read";
                return Err(fault(self.input, self.name, reason));
            }
        };
        numbers.map_err(broken)
    }
}
