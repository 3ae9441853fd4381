//! Checkpoints as bytes and as files.
//!
//! A file is a header of 24 bytes and the contents in the postcard format (all numbers little-endian). The header has
//! eight bytes that say what it is, the version of the format (four bytes), the length of the contents (eight), their
//! CRC-32 (four).

use std::fs::{self, File};
use std::io::{Error, Read, Write};
use std::path::{Path, PathBuf};

use super::{Checkpoint, CheckpointError};

/// Changes whenever older programs cannot read what is written, or the other way round.
const VERSION: u32 = 8;
const HEADER: usize = 24;
const MARK_LENGTH: u64 = Checkpoint::MARK.len() as u64;

fn part<const N: usize>(bytes: &[u8], start: usize) -> Option<[u8; N]> {
    bytes.get(start..start + N)?.try_into().ok()
}

impl Checkpoint {
    /// First bytes of each file.
    pub const MARK: [u8; 8] = *b"motile\x00\x1a";

    /// Returns the bytes of a file.
    ///
    /// # Errors
    /// Returns no error that is known.
    pub fn to_bytes(&self) -> Result<Vec<u8>, CheckpointError> {
        let contents = postcard::to_stdvec(self).map_err(|error| CheckpointError::contents(&error))?;
        let mut bytes = Vec::with_capacity(HEADER + contents.len());
        bytes.extend_from_slice(&Self::MARK);
        bytes.extend_from_slice(&VERSION.to_le_bytes());
        bytes.extend_from_slice(&(contents.len() as u64).to_le_bytes());
        bytes.extend_from_slice(&crc32fast::hash(&contents).to_le_bytes());
        bytes.extend_from_slice(&contents);
        Ok(bytes)
    }

    /// Creates a checkpoint from the bytes of a file.
    ///
    /// # Errors
    /// Bytes that are not exactly the errors of a checkpoint.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, CheckpointError> {
        if !bytes.starts_with(&Self::MARK) {
            return Err(CheckpointError::foreign());
        }
        let found = bytes.len() as u64;
        let header = part(bytes, 8).zip(part(bytes, 12)).zip(part(bytes, 20));
        let Some(((version, length), checksum)) = header else {
            return Err(CheckpointError::length(HEADER as u64, found));
        };
        let version = u32::from_le_bytes(version);
        if version != VERSION {
            return Err(CheckpointError::Version { found: version, supported: VERSION });
        }
        let expected = u64::from_le_bytes(length).saturating_add(HEADER as u64);
        if expected != found {
            return Err(CheckpointError::length(expected, found));
        }
        let contents = &bytes[HEADER..];
        let (expected, found) = (u32::from_le_bytes(checksum), crc32fast::hash(contents));
        if expected != found {
            return Err(CheckpointError::damaged(expected, found));
        }
        Self::from_contents(contents)
    }

    /// Creates a checkpoint from the contents of a file without its header.
    ///
    /// # Errors
    /// Contents that are not the errors of a checkpoint.
    pub fn from_contents(contents: &[u8]) -> Result<Self, CheckpointError> {
        match postcard::take_from_bytes(contents) {
            Ok((checkpoint, [])) => Ok(checkpoint),
            Ok(_) => Err(CheckpointError::contents(&postcard::Error::DeserializeBadEncoding)),
            Err(error) => Err(CheckpointError::contents(&error)),
        }
    }

    /// Writes a file: to a temporary one in the same directory, which takes the place of `path` when it is complete and
    /// on the disk. However the program ends, there is a complete checkpoint at `path` if there was one before.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be written; a file at `path` that is not a checkpoint, which would be
    /// lost.
    pub fn write(&self, path: &Path) -> Result<(), CheckpointError> {
        let bytes = self.to_bytes()?;
        let temporary = temporary(path);
        let problem = |action, path: &Path| {
            let path = path.to_owned();
            move |source| CheckpointError::File { action, path, source }
        };
        // A device or a directory must not be replaced.
        if fs::metadata(path).is_ok_and(|found| !found.is_file()) {
            let source = Error::other("there is something there that is not a file");
            return Err(problem("write", path)(source));
        }
        if let Ok(found) = File::open(path) {
            let mut first = Vec::with_capacity(HEADER);
            found.take(MARK_LENGTH).read_to_end(&mut first).map_err(problem("write", path))?;
            if !first.is_empty() && first != Self::MARK {
                let source = Error::other("a file with this name exists and is not a checkpoint. Use another name");
                return Err(problem("write", path)(source));
            }
        }
        let written = File::create(&temporary).and_then(|mut file| {
            file.write_all(&bytes)?;
            file.sync_all()
        });
        let moved = written
            .map_err(problem("write", &temporary))
            .and_then(|()| fs::rename(&temporary, path).map_err(problem("put in its place", path)));
        if moved.is_err() {
            // What is left of a failed attempt is of no use; where it cannot be removed there is nothing to do about
            // it.
            let _ = fs::remove_file(&temporary);
        }
        moved
    }

    /// Reads a file.
    ///
    /// # Errors
    /// Returns an error for a file that is not there ([`CheckpointError::Missing`]) or cannot be read, or is not a
    /// complete and undamaged checkpoint of this version.
    pub fn read(path: &Path) -> Result<Self, CheckpointError> {
        let mut bytes = Vec::new();
        let read = File::open(path).and_then(|mut file| {
            let kind = file.metadata()?.file_type();
            // A device could go on for ever.
            if kind.is_file() || kind.is_dir() {
                file.read_to_end(&mut bytes)
            } else {
                Err(Error::other("this is not a file. Use the path of a file"))
            }
        });
        read.map_err(|source| CheckpointError::reading(path, source))?;
        Self::from_bytes(&bytes)
    }
}

/// Returns the place where a checkpoint is written before it is complete: in the same directory, so that it can be
/// moved there at once, under a name that only this process uses.
fn temporary(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}
