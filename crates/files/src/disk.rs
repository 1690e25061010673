//! Atomic writing of files: a file is written completely or not at all.
//!
//! A path given by the user may be a symbolic link and is followed. A name that the program chose
//! inside a folder must not be a link: the folder may come from an untrusted source, and a link in
//! it can point to any file of the user. Such names go through [`inside`] or [`write_in`].
//!
//! ```
//! use lcplab_files::disk;
//!
//! let folder = tempfile::tempdir().unwrap();
//! let path = folder.path().join("runs/a.txt");
//! disk::prepare(&disk::folder_of(&path), &["a.txt"])?; // makes the folder
//! disk::write(&path, "first")?;
//! // A program that writes files by itself gets another path; "first" stays if it fails.
//! disk::made_by(&path, |other| disk::write(other, "second"))?;
//! assert_eq!(std::fs::read(&path).unwrap(), b"second");
//! assert_eq!(disk::list(&disk::folder_of(&path))?, [path]);
//! assert!(disk::inside(folder.path(), "../elsewhere.txt").is_err());
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use tempfile::Builder;

use lcplab_lcp::error::{Error, Result};

/// Writes a file whose path the user gave, and creates missing parent folders. It writes under a
/// temporary name and then renames, so that readers and interrupted runs never leave half a file.
/// Devices and pipes are written directly, and a link stays a link.
///
/// # Errors
/// If it cannot be written; then the previous file is unchanged.
pub fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<()> {
    let bytes = text.as_ref();
    let is_special = fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    let written = match is_special {
        true => fs::write(path, bytes),
        false => replace(&followed(path), |part| part.write_all(bytes)),
    };
    written.map_err(|cause| Error::file(path, &plain(cause)))
}

/// Writes a file whose name the program chose into a folder, like [`write`](write()), but never
/// through a link.
///
/// # Errors
/// If a part of the name is a link, or the file cannot be written; then the previous file is
/// unchanged.
///
/// ```
/// use lcplab_files::disk;
///
/// let folder = tempfile::tempdir().unwrap();
/// disk::write_in(folder.path(), "data/a.csv", "1,2\n").unwrap();
/// assert_eq!(std::fs::read(folder.path().join("data/a.csv")).unwrap(), b"1,2\n");
/// ```
pub fn write_in(folder: &Path, name: impl AsRef<Path>, text: impl AsRef<[u8]>) -> Result<()> {
    let path = inside(folder, name)?;
    let written = replace(&path, |part| part.write_all(text.as_ref()));
    written.map_err(|cause| Error::file(&path, &plain(cause)))
}

/// The path of a file or folder whose name the program chose inside a folder; neither needs to
/// exist.
///
/// # Errors
/// If a part of the name is a symbolic link, or leads out of the folder.
pub fn inside(folder: &Path, name: impl AsRef<Path>) -> Result<PathBuf> {
    let mut path = folder.to_path_buf();
    for part in name.as_ref().components() {
        path.push(part);
        let is_link = fs::symlink_metadata(&path).is_ok_and(|found| found.is_symlink());
        let reason = match part {
            Component::Normal(_) if !is_link => continue,
            Component::Normal(_) => {
                "is a symbolic link, which may lead to any file, so lcplab does not write through it; delete the \
                 link or use another folder"
            }
            _ => "leads out of its folder",
        };
        return Err(Error::File { path: path.display().to_string(), reason: reason.into() });
    }
    Ok(path)
}

/// Writes a file with `fill` and puts it at `place`; a link there is replaced, not followed.
fn replace(place: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let folder = folder_of(place);
    fs::create_dir_all(&folder)?;
    let mut part = named_part().tempfile_in(&folder)?;
    fill(part.as_file_mut())?;
    part.persist(place)?;
    Ok(())
}

/// The file to write for a path: if it is a link, the link's target.
fn followed(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())
}

/// Creates a folder and checks that files with these names can be written there, before hours are
/// spent on computing them.
///
/// # Errors
/// If they cannot be written.
pub fn prepare(folder: &Path, names: &[&str]) -> Result<()> {
    let tried = fs::create_dir_all(folder).and_then(|()| named_part().tempfile_in(folder));
    tried.map(drop).map_err(|cause| Error::file(folder, &plain(cause)))?;
    names.iter().try_for_each(|name| inside(folder, name).map(drop))
}

/// The files of a folder, sorted by name.
///
/// # Errors
/// If the folder cannot be read.
pub fn list(folder: &Path) -> Result<Vec<PathBuf>> {
    let read = || -> io::Result<Vec<PathBuf>> {
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect()
    };
    let mut paths = read().map_err(|cause| Error::file(folder, &plain(cause)))?;
    paths.sort();
    Ok(paths)
}

/// Lets `make` create a file whose path the user gave, under a temporary name, then renames it.
///
/// # Errors
/// The error of `make`; or if it created no file, or the file cannot be renamed.
pub fn made_by(path: &Path, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    let place = followed(path);
    let failed = |cause: io::Error| Error::file(&place, &plain(cause));
    let part = named_part().tempfile_in(folder_of(&place)).map_err(failed)?.into_temp_path();
    make(&part)?;
    part.persist(&place).map_err(|cause| failed(cause.error))
}

/// A temporary file with the permissions that the user's umask allows.
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

/// The folder that contains a file.
pub fn folder_of(path: &Path) -> PathBuf {
    match path.parent() {
        Some(folder) if folder != Path::new("") => folder.into(),
        _ => ".".into(),
    }
}

/// The error of the operating system without the temporary file's name.
fn plain(cause: io::Error) -> io::Error {
    match cause.raw_os_error() {
        Some(_) => cause,
        None => cause.kind().into(),
    }
}
