//! Checks whether a file of FCLIB has contents that the reader did not use.

use std::collections::HashSet;

use hdf5_reader::Hdf5File;
use hdf5_reader::error::Result as Hdf5Result;
use hdf5_reader::group::Group;

use lcplab_lcp::error::{Error, Result};

/// Groups of answers, which are not part of the problem.
const ANSWERS: [&str; 2] = ["guesses", "solution"];
/// Metadata that FCLIB stores with a matrix.
const REMARKS: [&str; 5] = ["nzmax", "comment", "conditioning", "determinant", "rank"];
/// Files with more groups and datasets than this are not searched.
const MOST: usize = 1000;

/// A warning about the answers that the file stores with its problem, the group `kind`.
///
/// # Errors
/// If there is a dataset that was not `read` and is neither metadata nor an answer.
pub(super) fn check(
    file: &Hdf5File,
    read: &HashSet<String>,
    kind: &str,
    input: &str,
) -> Result<Option<String>> {
    let found = search(file).map_err(|cause| Error::invalid(input, "file", cause.to_string()))?;
    let Some((datasets, answers)) = found else {
        let reason = format!("has more than {MOST} groups and datasets");
        return Err(Error::invalid(input, "file", reason));
    };
    let info = format!("{kind}/info/");
    let is_known = |path: &&String| {
        let name = path.rsplit('/').next().unwrap_or_default();
        let is_remark = REMARKS.contains(&name) && path.starts_with(&format!("{kind}/"));
        read.contains(*path) || path.starts_with(&info) || is_remark
    };
    match datasets.iter().find(|path| !is_known(path)) {
        Some(path) => Err(Error::invalid(input, path.as_str(), "is not understood")),
        None if answers.is_empty() => Ok(None),
        None => Ok(Some(format!("{input}: not part of the problem: {}", answers.join(", ")))),
    }
}

/// The paths of all datasets except those of answers, and the groups of answers; `None` if there
/// are too many.
fn search(file: &Hdf5File) -> Hdf5Result<Option<(Vec<String>, Vec<String>)>> {
    let (mut datasets, mut answers) = (Vec::new(), Vec::new());
    let mut groups: Vec<(String, Group)> = vec![(String::new(), file.root_group()?)];
    let mut count = 0;
    while let Some((path, group)) = groups.pop() {
        let (inner, arrays) = group.member_names()?;
        count += 1 + inner.len() + arrays.len();
        if count > MOST {
            return Ok(None);
        }
        datasets.extend(arrays.into_iter().map(|name| format!("{path}/{name}")));
        for name in inner {
            if path.is_empty() && ANSWERS.contains(&name.as_str()) {
                answers.push(name);
            } else {
                let below = group.group(&name)?;
                groups.push((format!("{path}/{name}"), below));
            }
        }
    }
    Ok(Some((datasets, answers)))
}
