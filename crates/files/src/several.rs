//! Expands names that stand for several files.

use std::path::Path;

use lcplab_lcp::error::{Error, Result};

use super::{is_answer, is_problem};

/// The files that a name stands for, sorted by name: the `wanted` files of a folder, or the files
/// that match a pattern, in which `*` matches any letters within a name and `**` any folders; in
/// either case without the answers next to frames ([`is_answer`]). `None` if the name is a single
/// file or does not name several files.
///
/// ```
/// use lcplab_files::{is_answer, is_problem, several};
///
/// let folder = std::env::temp_dir().join("lcplab-several");
/// std::fs::create_dir_all(&folder).unwrap();
/// for name in ["a.json", "a.x.json", "b.npz", "notes.txt"] {
///     std::fs::write(folder.join(name), "").unwrap();
/// }
/// let folder = folder.display();
/// assert_eq!(several(&format!("{folder}"), is_problem)?.unwrap().len(), 2);
/// assert_eq!(several(&format!("{folder}/*.json"), is_problem)?.unwrap(), [format!("{folder}/a.json")]);
/// assert_eq!(several(&format!("{folder}/a.json"), is_problem)?, None);
/// assert!(is_answer("a.x.json".as_ref())); // the answer to the frame a.json
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
///
/// # Errors
/// If there are no such files, or the folder or the pattern cannot be read.
pub fn several(name: &str, wanted: fn(&Path) -> bool) -> Result<Option<Vec<String>>> {
    let path = Path::new(name);
    let fault = |reason: String| Error::invalid(name, "files", reason);
    let is_pattern = name.contains('*') && !path.exists();
    if !is_pattern && is_problem(path) {
        return Ok(None);
    }
    let pattern = match (path.is_dir(), is_pattern) {
        (true, _) => format!("{}/*", glob::Pattern::escape(name.trim_end_matches('/'))),
        (false, true) => name.to_string(),
        (false, false) => return Ok(None),
    };
    let found = glob::glob(&pattern).map_err(|cause| fault(cause.msg.into()))?;
    let mut files = Vec::new();
    for file in found {
        let file = file.map_err(|cause| fault(cause.to_string()))?;
        if !is_answer(&file) && (!path.is_dir() || wanted(&file)) {
            files.push(file.to_str().ok_or_else(|| fault("a name is not UTF-8".into()))?.into());
        }
    }
    if files.is_empty() {
        let reason = match is_pattern {
            true => "no file that lcplab can read matches this pattern",
            false => "the folder contains no file that lcplab can read",
        };
        return Err(fault(reason.into()));
    }
    Ok(Some(files))
}
