//! Text of a file, in the encodings that programs use.

use std::borrow::Cow;

use crate::OutlineError;

/// Beginnings of files that other programs read, with what they are and what to do.
const OTHERS: [(&[u8], &str, &str); 5] = [
    (b"\x93NUMPY", "it is an array of NumPy", "Save it as text: numpy.savetxt(\"cell.csv\", points, delimiter=\",\")"),
    (b"\x89HDF", "it is an HDF5 file", "Save the points of the outline as CSV"),
    (b"MATLAB", "it is a file of MATLAB", "Save the points as CSV: writematrix(points, \"cell.csv\")"),
    (b"\xd0\xcf\x11\xe0", "it is a workbook of Excel", "Save it as CSV"),
    (b"%PDF", "it is a PDF file", "Save the drawing as SVG"),
];
const PICTURE: &str = "If this is a picture, trace the shape first and save the outline as CSV, SVG or GeoJSON. \
                       Otherwise save the file as UTF-8 text";

/// Returns the text of a file without the mark of its encoding and blanks at its start: UTF-8, UTF-16 with its mark, or
/// else an encoding of one byte for each character.
pub(crate) fn text_of(bytes: &[u8]) -> Result<Cow<'_, str>, OutlineError> {
    let refuse = |what: &str, remedy: &'static str| Err(OutlineError::format("the file", what, remedy));
    if let Some((_, what, remedy)) = OTHERS.iter().find(|(start, ..)| bytes.starts_with(start)) {
        return refuse(what, remedy);
    }
    if bytes.starts_with(b"PK") {
        let has = |name: &[u8]| bytes.windows(name.len()).any(|window| window == name);
        return if has(b"[Content_Types].xml") || has(b"xl/workbook") {
            refuse("it is a workbook of Excel", "Save it as CSV")
        } else if has(b".npy") {
            refuse("it is an archive of NumPy", "Save the points of the outline with numpy.savetxt")
        } else {
            refuse("it is a ZIP archive", "Unpack it and use one of the .roi files in it")
        };
    }
    let start = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}').len();
    let wide = match bytes {
        [0xff, 0xfe, rest @ ..] => Some((rest, false)),
        [0xfe, 0xff, rest @ ..] => Some((rest, true)),
        _ => None,
    };
    if let Some((rest, big_endian)) = wide {
        let units = rest.chunks_exact(2).map(|pair| {
            let pair = [pair[0], pair[1]];
            if big_endian { u16::from_be_bytes(pair) } else { u16::from_le_bytes(pair) }
        });
        let units: Vec<u16> = units.collect();
        let text = String::from_utf16(&units).ok().filter(|text| !text.contains('\0'));
        let Some(text) = text else { return refuse("it is not text", PICTURE) };
        return Ok(Cow::Owned(text[start(&text)..].to_owned()));
    }
    let is_control = |byte: &u8| *byte < b' ' && !b"\t\n\r\x0b\x0c".contains(byte);
    if bytes.iter().any(is_control) {
        return refuse("it is not text", PICTURE);
    }
    match std::str::from_utf8(bytes) {
        Ok(text) => Ok(Cow::Borrowed(&text[start(text)..])),
        // In all encodings of one byte, numbers and separators are as in ASCII. Other characters stand in names only.
        Err(_) => {
            let text: String =
                bytes.iter().map(|byte| if byte.is_ascii() { char::from(*byte) } else { '\u{fffd}' }).collect();
            Ok(Cow::Owned(text[start(&text)..].to_owned()))
        }
    }
}

#[cfg(test)]
mod tests;
