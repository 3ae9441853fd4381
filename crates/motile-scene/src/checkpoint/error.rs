//! Errors of checkpoints on disk.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

use motile_base::{Refusal, internal::Refuse};

/// A checkpoint could not be written or read.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be written or read.
    #[error(
        "could not {action} the checkpoint {}. Check the path, the permissions and the space on the disk",
        path.display()
    )]
    File {
        /// Attempt, as it reads after "could not".
        action: &'static str,
        /// The file.
        path: PathBuf,
        /// Cause.
        source: std::io::Error,
    },
    /// No file at this path.
    #[error("there is no checkpoint at {}. Check the path", path.display())]
    Missing {
        /// The path.
        path: PathBuf,
    },
    /// A checkpoint of another version of the format.
    #[error(
        "the checkpoint has version {found} of the format, this program reads version {supported}. Use the program \
         that wrote it"
    )]
    Version {
        /// Its version.
        found: u32,
        /// The version that is read.
        supported: u32,
    },
    /// A file that is not a complete and undamaged checkpoint, or cannot be opened.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(CheckpointError);

impl CheckpointError {
    /// Returns the error for a file that could not be read.
    pub(super) fn reading(path: &Path, source: std::io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => Self::Missing { path },
            ErrorKind::IsADirectory => Self::directory(&path),
            ErrorKind::PermissionDenied => Self::permission(&path),
            _ => Self::File { action: "read", path, source },
        }
    }

    fn directory(path: &Path) -> Self {
        Self::refused(format!("{} is a directory", path.display()), "", "Use the path of a checkpoint in it")
    }

    fn permission(path: &Path) -> Self {
        let what = format!("there is no permission to read the checkpoint {}", path.display());
        Self::refused(what, "", "Change its permissions")
    }

    /// Returns the error for something else than a checkpoint.
    pub(super) fn foreign() -> Self {
        let what = "this file is not a checkpoint, because it does not start as one does";
        Self::refused(what, "", "Use the path of a checkpoint")
    }

    /// Returns the error for a file whose end is missing, or that continues after it.
    pub(super) fn length(expected: u64, found: u64) -> Self {
        let value = format!("it has {found} bytes where {expected} are needed");
        Self::refused("the checkpoint is incomplete or has been added to", value, ANOTHER)
    }

    /// Returns the error for contents that differ from what was written, by their checksums.
    pub(super) fn damaged(expected: u32, found: u32) -> Self {
        let value = format!("its checksum is {found:08x} where {expected:08x} was written");
        Self::refused("the checkpoint is damaged", value, ANOTHER)
    }

    /// Returns the error for contents that do not form a checkpoint, though they are what was written.
    pub(super) fn contents(cause: &postcard::Error) -> Self {
        Self::refused("the contents of the checkpoint make no sense", cause.to_string(), ANOTHER)
    }
}

/// Remedy for files that are beyond repair.
const ANOTHER: &str = "Use another checkpoint";
