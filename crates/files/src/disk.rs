//! Files are written whole or not at all.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use tempfile::Builder;

use lcplab_problem::error::{Error, Result};

/// Writes a file, with the folders above it, under a temporary name that is then changed: a reader, or
/// an interrupted run, never finds half a file. A device or a pipe is written to as it stands.
///
/// # Errors
/// If it cannot be written; then what was there before is still there.
pub fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<()> {
    let bytes = text.as_ref();
    let is_special = fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    let written = match is_special {
        true => fs::write(path, bytes),
        false => replace(path, |part| part.write_all(bytes)),
    };
    written.map_err(|cause| Error::file(path, &plain(cause)))
}

/// Puts what `fill` writes into a file in the place of another one.
fn replace(path: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let place = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf()); // a link stays a link
    let folder = folder_of(&place);
    fs::create_dir_all(&folder)?;
    let mut part = named_part().tempfile_in(&folder)?;
    fill(part.as_file_mut())?;
    part.persist(&place)?;
    Ok(())
}

/// Makes a folder and sees whether files can be put there, before hours are spent on what they shall hold.
///
/// # Errors
/// If they cannot.
pub fn prepare(folder: &Path) -> Result<()> {
    let tried = fs::create_dir_all(folder).and_then(|()| named_part().tempfile_in(folder));
    tried.map(drop).map_err(|cause| Error::file(folder, &plain(cause)))
}

/// The files of a folder in the order of their names.
///
/// # Errors
/// If it cannot be read.
pub fn list(folder: &Path) -> Result<Vec<PathBuf>> {
    let read = || -> io::Result<Vec<PathBuf>> {
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    };
    let mut paths = read().map_err(|cause| Error::file(folder, &plain(cause)))?;
    paths.sort();
    Ok(paths)
}

/// Has a file made by someone else, under a temporary name that is then changed.
///
/// # Errors
/// What `make` says; or if there is no such file then, or it cannot be renamed.
pub fn made_by(path: &Path, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    let failed = |cause: io::Error| Error::file(path, &plain(cause));
    let part = named_part().tempfile_in(folder_of(path)).map_err(failed)?.into_temp_path();
    make(&part)?;
    part.persist(path).map_err(|cause| failed(cause.error))
}

/// A temporary file that others may read as far as the user lets them.
fn named_part() -> Builder<'static, 'static> {
    let mut builder = Builder::new();
    builder.prefix(".lcplab-");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    builder
}

fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder.into(),
        _ => ".".into(),
    }
}

/// What the operating system said, without the temporary file's name.
fn plain(cause: io::Error) -> io::Error {
    match cause.raw_os_error() {
        Some(_) => cause,
        None => cause.kind().into(),
    }
}
