//! Numbers from text and from bytes.

use std::str::FromStr;

use super::raw::MOST;
use crate::SolidError;

/// Most characters of a file that a message quotes.
const QUOTED: usize = 40;

/// Place in the bytes of a file, from which words or numbers are read.
#[derive(Debug, Clone)]
pub(super) struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    /// True if numbers are bytes, not words.
    pub(super) binary: bool,
    /// True if the most significant byte comes first.
    pub(super) big_endian: bool,
    remedy: &'static str,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(bytes: &'a [u8], remedy: &'static str) -> Self {
        Self { bytes, at: 0, binary: false, big_endian: false, remedy }
    }

    /// Returns the error for what stands here.
    pub(super) fn error(&self, problem: impl Into<String>) -> SolidError {
        let line = self.bytes[..self.at.min(self.bytes.len())].iter().filter(|byte| **byte == b'\n').count() + 1;
        let place = if self.binary {
            format!("byte {} of the mesh file", self.at)
        } else {
            format!("line {line} of the mesh file")
        };
        SolidError::mesh_file(place, problem, self.remedy)
    }

    /// Returns true at the end of the file, after blanks.
    pub(super) fn at_end(&mut self) -> bool {
        self.skip_blanks();
        self.at >= self.bytes.len()
    }

    fn skip_blanks(&mut self) {
        while self.bytes.get(self.at).is_some_and(u8::is_ascii_whitespace) {
            self.at += 1;
        }
    }

    /// Returns the next word.
    pub(super) fn word(&mut self) -> Result<&'a str, SolidError> {
        self.skip_blanks();
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        if length == 0 {
            return Err(self.error("the file ends too early"));
        }
        let word = std::str::from_utf8(&rest[..length]).map_err(|_| self.error("this is not text"))?;
        self.at += length;
        Ok(word)
    }

    /// Returns the next word without passing it; empty at the end or where there is no text.
    pub(super) fn peek(&self) -> &'a str {
        self.clone().word().unwrap_or("")
    }

    /// Returns the rest of the line.
    pub(super) fn line(&mut self) -> Result<&'a str, SolidError> {
        let rest = &self.bytes[self.at.min(self.bytes.len())..];
        let length = rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
        let line = std::str::from_utf8(&rest[..length]).map_err(|_| self.error("this is not text"))?;
        self.at += (length + 1).min(rest.len());
        Ok(line.trim())
    }

    /// Returns the number that the next word is.
    pub(super) fn parsed<T: FromStr>(&mut self) -> Result<T, SolidError> {
        let before = self.clone();
        let word = self.word()?;
        let shown: String = word.chars().take(QUOTED).collect();
        word.parse().map_err(|_| before.error(format!("{shown:?} is not a number that can stand here")))
    }

    /// Returns so many bytes.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], SolidError> {
        let part = self.bytes.get(self.at..).and_then(|rest| rest.first_chunk::<N>());
        let mut part = *part.ok_or_else(|| self.error("the file ends too early"))?;
        self.at += N;
        if self.big_endian {
            part.reverse();
        }
        Ok(part)
    }

    /// Returns a whole number of four bytes, or a word.
    pub(super) fn int(&mut self) -> Result<i64, SolidError> {
        if self.binary { Ok(i32::from_le_bytes(self.take()?).into()) } else { self.parsed() }
    }

    /// Returns a whole number of eight bytes, or a word.
    pub(super) fn long(&mut self) -> Result<i64, SolidError> {
        if self.binary { Ok(i64::from_le_bytes(self.take()?)) } else { self.parsed() }
    }

    /// Returns a number of eight bytes, or a word.
    pub(super) fn double(&mut self) -> Result<f64, SolidError> {
        if self.binary { Ok(f64::from_le_bytes(self.take()?)) } else { self.parsed() }
    }

    /// Returns a number of a type of VTK, or a word.
    pub(super) fn of_type(&mut self, kind: &str) -> Result<f64, SolidError> {
        if !self.binary {
            return self.parsed();
        }
        Ok(match kind.to_ascii_lowercase().as_str() {
            "float" | "float32" => f32::from_le_bytes(self.take()?).into(),
            "double" | "float64" => f64::from_le_bytes(self.take()?),
            "int" | "int32" | "vtktypeint32" => i32::from_le_bytes(self.take()?).into(),
            "unsigned_int" | "uint32" => u32::from_le_bytes(self.take()?).into(),
            "long" | "int64" | "vtktypeint64" | "vtkidtype" => i64::from_le_bytes(self.take()?) as f64,
            "unsigned_long" | "uint64" => u64::from_le_bytes(self.take()?) as f64,
            "short" | "int16" => i16::from_le_bytes(self.take()?).into(),
            "unsigned_short" | "uint16" => u16::from_le_bytes(self.take()?).into(),
            "char" | "int8" => i8::from_le_bytes(self.take()?).into(),
            "unsigned_char" | "uint8" => u8::from_le_bytes(self.take()?).into(),
            _ => return Err(self.error(format!("numbers of the type {kind:?} are not read"))),
        })
    }

    /// Returns so many numbers of a type of VTK.
    pub(super) fn all(&mut self, kind: &str, count: usize) -> Result<Vec<f64>, SolidError> {
        // Each number takes at least one byte, so that no more is allocated than the file has.
        if count > self.bytes.len().saturating_sub(self.at) {
            return Err(self.error(format!("{count} numbers are announced, but the file ends before")));
        }
        (0..count).map(|_| self.of_type(kind)).collect()
    }

    /// Returns a number of things that can be.
    pub(super) fn count(&self, found: i64) -> Result<usize, SolidError> {
        let count = usize::try_from(found).ok().filter(|count| *count <= MOST);
        count.ok_or_else(|| self.error(format!("there cannot be {found} of these. Files have at most {MOST}")))
    }

    /// Passes the end of the line, in front of bytes.
    pub(super) fn end_line(&mut self) {
        if self.bytes.get(self.at) == Some(&b'\r') {
            self.at += 1;
        }
        if self.bytes.get(self.at) == Some(&b'\n') {
            self.at += 1;
        }
    }

    /// Passes everything up to a text and the text itself.
    pub(super) fn skip_past(&mut self, text: &str) -> Result<(), SolidError> {
        let rest = &self.bytes[self.at..];
        let found = rest.windows(text.len()).position(|window| window == text.as_bytes());
        let found = found.ok_or_else(|| self.error(format!("{text} is missing")))?;
        self.at += found + text.len();
        Ok(())
    }

    /// Passes a word and all lines up to an empty one.
    pub(super) fn skip_paragraph(&mut self) -> Result<(), SolidError> {
        self.line()?;
        while self.at < self.bytes.len() && !self.line()?.is_empty() {}
        Ok(())
    }
}
