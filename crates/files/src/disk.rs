//! Files are written whole or not at all.
//!
//! A path that the user named may be a symbolic link, and is followed. A name that the program
//! chose inside a folder may not: the folder may come from a stranger, and a link in it can lead to
//! any file of the reader. So such a name goes through [`inside`], [`write_in`] or [`make_in`].

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Component, Path, PathBuf};

use tempfile::Builder;

use lcplab_problem::error::{Error, Result};

/// Writes a file that the user named, with the folders above it, under a temporary name that is
/// then changed: a reader, or an interrupted run, never finds half a file. A device or a pipe is
/// written to directly, a link stays a link.
///
/// # Errors
/// If it cannot be written; then what was there before is still there.
pub fn write(path: &Path, text: impl AsRef<[u8]>) -> Result<()> {
    let bytes = text.as_ref();
    let is_special = fs::metadata(path).is_ok_and(|found| !found.is_file() && !found.is_dir());
    let written = match is_special {
        true => fs::write(path, bytes),
        false => replace(&followed(path), |part| part.write_all(bytes)),
    };
    written.map_err(|cause| Error::file(path, &plain(cause)))
}

/// Writes a file whose name the program chose into a folder, as [`write`](write()) does, but never
/// through a link.
///
/// # Errors
/// If a part of the name is a link, or the file cannot be written; then what was there before is
/// still there.
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

/// Puts what `fill` writes into a file in the place of another one; a link at that place is
/// replaced, not followed.
fn replace(place: &Path, fill: impl FnOnce(&mut File) -> io::Result<()>) -> io::Result<()> {
    let folder = folder_of(place);
    fs::create_dir_all(&folder)?;
    let mut part = named_part().tempfile_in(&folder)?;
    fill(part.as_file_mut())?;
    part.persist(place)?;
    Ok(())
}

/// The file that a path means: where it is a link, the file at the link's end.
fn followed(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf())
}

/// Makes a folder and sees whether files of these names can be put there, before hours are spent on
/// what they shall hold.
///
/// # Errors
/// If they cannot.
pub fn prepare(folder: &Path, names: &[&str]) -> Result<()> {
    let tried = fs::create_dir_all(folder).and_then(|()| named_part().tempfile_in(folder));
    tried.map(drop).map_err(|cause| Error::file(folder, &plain(cause)))?;
    names.iter().try_for_each(|name| inside(folder, name).map(drop))
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

/// Has a file that the user named made by another program, under a temporary name that is then
/// changed.
///
/// # Errors
/// What `make` says; or if there is no such file then, or it cannot be renamed.
pub fn made_by(path: &Path, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
    make_at(&followed(path), make)
}

/// The same for a file whose name the program chose inside a folder: see [`inside`]. Returns its
/// path.
///
/// # Errors
/// If the name is a link; what `make` says; or if there is no such file then, or it cannot be
/// renamed.
pub fn make_in(
    folder: &Path,
    name: impl AsRef<Path>,
    make: impl FnOnce(&Path) -> Result<()>,
) -> Result<PathBuf> {
    let path = inside(folder, name)?;
    make_at(&path, make)?;
    Ok(path)
}

fn make_at(path: &Path, make: impl FnOnce(&Path) -> Result<()>) -> Result<()> {
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

/// The folder that a file is in.
pub fn folder_of(path: &Path) -> PathBuf {
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
