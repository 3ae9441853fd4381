//! Encodings of text, and files of other programs.

use super::*;

#[test]
fn encodings_of_a_table() {
    let text = "x (\u{b5}m)\ty (\u{b5}m)\r\n0\t0\r\n2\t0\r\n2\t1\r\n";
    let units = |bytes: fn(u16) -> [u8; 2]| text.encode_utf16().flat_map(bytes).collect::<Vec<u8>>();
    let of_one: Vec<u8> = text.chars().map(|sign| u8::try_from(u32::from(sign)).unwrap()).collect();
    for bytes in [
        text.as_bytes().to_vec(),
        [b"\xef\xbb\xbf\n", text.as_bytes()].concat(),
        [vec![0xff, 0xfe], units(u16::to_le_bytes)].concat(),
        [vec![0xfe, 0xff], units(u16::to_be_bytes)].concat(),
        of_one,
    ] {
        let read = text_of(&bytes).unwrap();
        assert_eq!(read.replace(['\u{b5}', '\u{fffd}'], "u"), text.replace('\u{b5}', "u"));
    }
}

#[test]
fn files_of_other_programs_are_named() {
    for (bytes, said) in [
        (&b"\x93NUMPY\x01\0"[..], "it is an array of NumPy. Save it as text: numpy.savetxt("),
        (b"PK\x03\x04\0[Content_Types].xml", "it is a workbook of Excel. Save it as CSV"),
        (b"PK\x03\x04points.npy", "it is an archive of NumPy"),
        (b"PK\x03\x04", "it is a ZIP archive. Unpack it and use one of the .roi files in it"),
        (b"\xff\xd8\xff\xe0\0\x10JFIF", "it is not text. If this is a picture, trace the shape"),
        (b"1,2\n3,4\n\0\0", "it is not text"),
        (b"\xff\xfe\x00\xd8", "it is not text"),
    ] {
        let error = text_of(bytes).map(Cow::into_owned).unwrap_err().to_string();
        assert!(error.contains(said), "{error}");
    }
}
