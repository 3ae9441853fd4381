//! Formats by their contents, choices, and bytes of any kind.

use proptest::prelude::*;

use super::*;
use crate::{closed, line, smooth};

#[test]
fn formats_are_found_from_the_contents() {
    let svg = "\u{feff}\n<svg xmlns=\"http://www.w3.org/2000/svg\"><rect width=\"1\" height=\"2\"/></svg>";
    let json = " {\"type\":\"Polygon\",\"coordinates\":[[[0,0],[1,0],[0,1]]]}";
    for (text, format) in [(svg, FileFormat::Svg), (json, FileFormat::GeoJson), ("0 0\n1 0\n0 1", FileFormat::Csv)] {
        assert_eq!(OutlineFile::from_bytes(text.as_bytes()).unwrap().format, format);
    }
    for (bytes, said) in [
        (&b""[..], "it is empty"),
        (b" \n", "it is empty"),
        (b"PK\x03\x04", "it is a ZIP archive. Unpack it"),
        (b"\x89PNG\r\n\x1a\n\x00", "it is not text. If this is a picture, trace the shape"),
        (b"Iout", "the file ends too early"),
        (b"[]", "it has no outline"),
    ] {
        let error = OutlineFile::from_bytes(bytes).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
    let error = OutlineFile::read(Path::new("no such file.csv")).unwrap_err().to_string();
    assert_eq!(
        error,
        "the file no such file.csv cannot be read: there is no such file. Check the path, which is relative to the \
         scene file"
    );
}

#[test]
fn one_of_several_is_chosen_by_name_or_index() {
    let part = |id: &str| format!("<path id=\"{id}\" d=\"M0 0h1v1z\"/>");
    let text = format!("<svg>{}{}{}</svg>", part("a"), part("b"), part("b"));
    let file = OutlineFile::from_bytes(text.as_bytes()).unwrap();
    assert_eq!(file.choose(&Choice::Index(1)).unwrap().name.as_deref(), Some("b"));
    assert_eq!(file.choose(&Choice::Name("a".into())).unwrap().name.as_deref(), Some("a"));
    let said = |choice| file.choose(&choice).unwrap_err().to_string();
    let several = "the file has 3 outlines (\"a\", \"b\", \"b\"). Choose one by `name`, or by `index`, counted from 0";
    assert_eq!(said(Choice::Only), several);
    assert!(said(Choice::Name("b".into())).contains("two of them named \"b\""));
    assert_eq!(said(Choice::Name("c".into())), "the file has no outline named \"c\". It has 3: \"a\", \"b\", \"b\"");
    assert!(said(Choice::Index(3)).contains("no outline of the index 3"));
}

/// Reads bytes and uses what they hold: nothing panics.
fn used(bytes: &[u8]) {
    let Ok(file) = OutlineFile::from_bytes(bytes) else { return };
    for contour in &file.contours {
        let _ = closed(&contour.points);
        let _ = line(&contour.points, 3.0);
        if contour.points.len() < 100 {
            let _ = smooth(&contour.points, None, 0.1);
        }
    }
}

/// A blank line by mistake makes two outlines of a table: the message says what separates them.
#[test]
fn tables_of_several_outlines_say_what_separates_them() {
    let file = OutlineFile::from_bytes(b"x,y\n0,0\n1,0\n1,1\n,\n0,1\n-1,0.5\n-1,0\n-.5,-.5\n").unwrap();
    let error = file.choose(&Choice::Only).unwrap_err().to_string();
    assert!(
        error.starts_with("the file has 2 outlines (of 3, 4 points: blank lines separate them, so remove"),
        "{error}"
    );
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn any_bytes(bytes in proptest::collection::vec(any::<u8>(), 0..200)) {
        used(&bytes);
        used(&[b"Iout", &bytes[..]].concat());
    }

    #[test]
    fn any_region_of_interest(
        bytes in proptest::collection::vec(any::<u8>(), 60..300),
        kind in 0u8..11,
        many in 0u8..40,
    ) {
        let mut bytes = [b"Iout\0\xe4", &bytes[..]].concat();
        bytes[6] = kind;
        (bytes[16], bytes[17]) = (0, many);
        bytes[36..40].fill(0);
        used(&bytes);
    }

    #[test]
    fn any_text(text in "[0-9eE+., ;\\t\\n\"xyNaif#-]{0,80}") {
        used(text.as_bytes());
    }

    #[test]
    fn any_path(text in "[MmLlHhVvCcSsQqTtAaZz0-9eE., -]{0,60}", matrix in "[a-z0-9(), .-]{0,20}") {
        used(format!("<svg><path transform=\"{matrix}\" d=\"{text}\"/><polygon points=\"{text}\"/></svg>").as_bytes());
        used(format!("<svg><path d=\"M1 2{text}\"/></svg>").as_bytes());
    }

    #[test]
    fn any_geometry(text in "[\\[\\]{}0-9eE.,:-]{0,60}") {
        used(format!("{{\"type\":\"Polygon\",\"coordinates\":[[{text}]]}}").as_bytes());
    }
}
