//! Errors of checkpoints on disk.

use std::io::ErrorKind;
use std::path::{Path, PathBuf};

/// A checkpoint could not be written or read.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be written or read.
    #[error(
        "could not {action} the checkpoint {}: check the path, the permissions and the space on the disk",
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
    #[error("there is no checkpoint at {}: check the path", path.display())]
    Missing {
        /// The path.
        path: PathBuf,
    },
    /// A directory at this path.
    #[error("{} is a directory: give the path of a checkpoint in it", path.display())]
    Directory {
        /// The path.
        path: PathBuf,
    },
    /// A file that may not be read.
    #[error("there is no permission to read the checkpoint {}: change its permissions", path.display())]
    Permission {
        /// The path.
        path: PathBuf,
    },
    /// Something else than a checkpoint.
    #[error("this is not a checkpoint, since it does not start as one does: give the path of one")]
    Foreign,
    /// A checkpoint of another version of the format.
    #[error(
        "the checkpoint has version {found} of the format, this program reads version {supported}: use the program \
         that wrote it"
    )]
    Version {
        /// Its version.
        found: u32,
        /// The version that is read.
        supported: u32,
    },
    /// The end is missing, or there is something after it.
    #[error(
        "the checkpoint has {found} bytes where {expected} are needed: it is incomplete or has been added to, use \
         another one"
    )]
    Length {
        /// Bytes needed.
        expected: u64,
        /// Bytes found.
        found: u64,
    },
    /// The contents are not those that were written.
    #[error("the checkpoint is damaged: its checksum is {found:08x} where {expected:08x} was written, use another one")]
    Damaged {
        /// Checksum written.
        expected: u32,
        /// Checksum of the contents found.
        found: u32,
    },
    /// The contents are not those of a checkpoint, though they are what was written.
    #[error("the contents of the checkpoint make no sense: use another one")]
    Contents(#[source] postcard::Error),
}

motile_base::debug_as_explanation!(CheckpointError);

impl CheckpointError {
    /// A file that could not be read.
    pub(super) fn reading(path: &Path, source: std::io::Error) -> Self {
        let path = path.to_owned();
        match source.kind() {
            ErrorKind::NotFound | ErrorKind::NotADirectory => Self::Missing { path },
            ErrorKind::IsADirectory => Self::Directory { path },
            ErrorKind::PermissionDenied => Self::Permission { path },
            _ => Self::File { action: "read", path, source },
        }
    }
}
