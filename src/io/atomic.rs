//! Output files that are written whole or not at all.
//!
//! **Guarantees** that a file at one of the paths is the old one or the whole new one, at any
//! moment, and that nothing else is left in the folder, unless the machine itself stops.
//! **Does not** keep several files in step through a failure of the very last step, renaming; all
//! that can be tried before is tried for all of them first.
//!
//! **Method.** Every file is written to a temporary one in the same folder, which is renamed when
//! all are complete.

use crate::error::Error;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// Writes one file whole or not at all.
///
/// # Errors
/// When the file cannot be written; then it is as it was.
pub fn write_whole(path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), Error> {
    write_all_whole(&[(path.as_ref(), bytes)])
}

/// Writes several files, all of them or none.
///
/// # Errors
/// When one cannot be written; then all are as they were.
pub fn write_all_whole<P: AsRef<Path>, B: AsRef<[u8]>>(files: &[(P, B)]) -> Result<(), Error> {
    let mut drafts = Vec::with_capacity(files.len());
    for (path, bytes) in files {
        let mut draft = Draft::new(path)?;
        draft.write(bytes.as_ref())?;
        draft.finish()?;
        drafts.push(draft);
    }
    put_in_place(drafts)
}

/// Puts files that are finished in the place of the old ones.
///
/// # Errors
/// When one cannot be renamed.
pub fn put_in_place(drafts: Vec<Draft>) -> Result<(), Error> {
    for Draft { temporary, target, .. } in drafts {
        temporary.persist(&target).map_err(|e| cannot_write(&target, e.error))?;
    }
    Ok(())
}

/// A file that is written bit by bit beside the one that it is to replace.
pub struct Draft {
    /// As it was named.
    path: PathBuf,
    temporary: NamedTempFile,
    target: PathBuf,
}

impl Draft {
    /// A file without text yet.
    ///
    /// # Errors
    /// When it cannot be made, or could not replace what is there, as far as that can be known beforehand.
    pub fn new(path: impl AsRef<Path>) -> Result<Draft, Error> {
        let path = path.as_ref();
        let (temporary, target) = stage(path).map_err(|cause| cannot_write(path, cause))?;
        Ok(Draft { path: path.to_path_buf(), temporary, target })
    }

    /// Appends to it, without gathering: let the pieces be large.
    ///
    /// # Errors
    /// When there is no room.
    pub fn write(&mut self, bytes: &[u8]) -> Result<(), Error> {
        self.temporary.write_all(bytes).map_err(|cause| cannot_write(&self.path, cause))
    }

    /// Waits until all of it is stored.
    ///
    /// # Errors
    /// When that fails.
    pub fn finish(&self) -> Result<(), Error> {
        self.temporary.as_file().sync_all().map_err(|cause| cannot_write(&self.path, cause))
    }
}

/// Makes the temporary file beside the target and makes sure, as far as that can be known
/// beforehand, that it can be renamed. A link is followed, so that it stays a link.
fn stage(path: &Path) -> io::Result<(NamedTempFile, PathBuf)> {
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_path_buf());
    let old = fs::metadata(&target).ok();
    if old.as_ref().is_some_and(fs::Metadata::is_dir) {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
    }
    if old.as_ref().is_some_and(|m| m.permissions().readonly()) {
        return Err(io::Error::new(io::ErrorKind::PermissionDenied, "it is write-protected"));
    }
    let name = target
        .file_name()
        .ok_or_else(|| io::Error::new(io::ErrorKind::InvalidInput, "not a name of a file"))?;
    let folder = target.parent().filter(|p| !p.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let mut prefix = std::ffi::OsString::from(".");
    prefix.push(name);
    let mut builder = tempfile::Builder::new();
    builder.prefix(&prefix).suffix(".part");
    if let Some(permissions) = old.map(|m| m.permissions()).or_else(usual_permissions) {
        builder.permissions(permissions);
    }
    fs::metadata(folder)?;
    // The kind alone: the name of the temporary file means nothing to a reader.
    let temporary = builder.tempfile_in(folder).map_err(|e| io::Error::from(e.kind()))?;
    Ok((temporary, target))
}

/// What a new file may be used for, the mask of the process aside: temporary files are private
/// unless told otherwise.
#[cfg(unix)]
fn usual_permissions() -> Option<fs::Permissions> {
    use std::os::unix::fs::PermissionsExt;
    Some(fs::Permissions::from_mode(0o666))
}

/// As the system does it.
#[cfg(not(unix))]
fn usual_permissions() -> Option<fs::Permissions> {
    None
}

fn cannot_write(path: &Path, cause: io::Error) -> Error {
    Error::File { action: "write", path: path.display().to_string(), cause }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> =
            fs::read_dir(folder).unwrap().map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_is_replaced_whole() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("a.nc");
        write_whole(&path, b"first").unwrap();
        write_whole(&path, b"second").unwrap();
        assert_eq!(fs::read(&path).unwrap(), b"second");
        assert_eq!(names(folder.path()), ["a.nc"]);
    }

    #[test]
    fn when_one_file_fails_all_stay_as_they_were() {
        let folder = tempfile::tempdir().unwrap();
        let (good, bad) = (folder.path().join("a.nc"), folder.path().join("none/b.nc"));
        fs::write(&good, b"old").unwrap();
        let error = write_all_whole(&[(&good, b"new"), (&bad, b"new")]).unwrap_err();
        assert!(error.to_string().contains("cannot write") && error.to_string().contains("b.nc"));
        assert_eq!(fs::read(&good).unwrap(), b"old");
        assert_eq!(names(folder.path()), ["a.nc"]);
    }

    #[test]
    fn a_folder_is_no_file_to_write() {
        let folder = tempfile::tempdir().unwrap();
        assert!(write_whole(folder.path(), b"x").is_err());
        assert!(write_whole("", b"x").is_err());
        assert!(names(folder.path()).is_empty());
    }

    #[cfg(unix)]
    #[test]
    fn links_stay_links_and_permissions_stay() {
        use std::os::unix::fs::PermissionsExt;
        let folder = tempfile::tempdir().unwrap();
        let (file, link) = (folder.path().join("a.nc"), folder.path().join("b.nc"));
        fs::write(&file, b"old").unwrap();
        fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
        std::os::unix::fs::symlink(&file, &link).unwrap();
        write_whole(&link, b"new").unwrap();
        assert_eq!(fs::read(&file).unwrap(), b"new");
        assert_eq!(fs::metadata(&file).unwrap().permissions().mode() & 0o777, 0o640);
        assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    }
}
