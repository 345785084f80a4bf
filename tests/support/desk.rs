//! A place to try the binary at: a folder with a drawing in it.

use assert_cmd::Command;
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

/// A folder with the drawing `part.dxf` in it, which is gone afterwards.
pub struct Desk {
    pub folder: TempDir,
}

impl Desk {
    /// A folder with nothing but this drawing.
    pub fn new(drawing: &str) -> Desk {
        let desk = Desk { folder: tempfile::tempdir().unwrap() };
        desk.put("part.dxf", drawing);
        desk
    }

    /// The path of a file in it.
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    /// Writes a file in it.
    pub fn put(&self, name: &str, text: &str) {
        fs::write(self.path(name), text).unwrap();
    }

    /// The binary, to be run in it.
    pub fn pocket(&self, arguments: &[&str]) -> Command {
        let mut command = Command::cargo_bin("pocket").unwrap();
        command.current_dir(&self.folder).args(arguments);
        command
    }
}
