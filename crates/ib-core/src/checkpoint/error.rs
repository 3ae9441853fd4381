//! What can be wrong with a checkpoint on disk.

use std::path::PathBuf;

/// A checkpoint could not be written or read.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CheckpointError {
    /// The file could not be written or read.
    #[error("could not {action} the checkpoint {}: check the path, the permissions and the space on the disk", path.display())]
    File {
        /// What was tried.
        action: &'static str,
        /// Which file.
        path: PathBuf,
        /// Why it failed.
        source: std::io::Error,
    },
    /// Something else than a checkpoint.
    #[error("this is not a checkpoint: it does not start as one does")]
    Foreign,
    /// A checkpoint of another version of the format.
    #[error(
        "the checkpoint has version {found} of the format, this program reads version {supported}: use the program that wrote it"
    )]
    Version {
        /// Its version.
        found: u32,
        /// The version that is read.
        supported: u32,
    },
    /// The end is missing, or there is something after it.
    #[error(
        "the checkpoint has {found} bytes where {expected} are needed: it is incomplete or has been added to, use another one"
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
