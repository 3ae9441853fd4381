//! Regions made byte by byte, after the layout of `ij.io.RoiDecoder`.

use super::*;

/// A region of that kind with coordinates relative to a corner and, if there are any, in fractions of pixels.
fn region(kind: u8, corner: [i16; 2], whole: &[[i16; 2]], fractions: &[[f32; 2]], name: &str) -> Vec<u8> {
    let mut bytes = vec![0; HEADER];
    bytes[..4].copy_from_slice(b"Iout");
    bytes[4..6].copy_from_slice(&228u16.to_be_bytes());
    bytes[6] = kind;
    let [left, top] = corner;
    for (place, value) in [(8, top), (10, left), (12, top + 20), (14, left + 40)] {
        bytes[place..place + 2].copy_from_slice(&value.to_be_bytes());
    }
    bytes[16..18].copy_from_slice(&(whole.len() as u16).to_be_bytes());
    for axis in 0..2 {
        whole.iter().for_each(|point| bytes.extend(point[axis].to_be_bytes()));
    }
    if !fractions.is_empty() {
        bytes[50..52].copy_from_slice(&SUBPIXEL.to_be_bytes());
        for axis in 0..2 {
            fractions.iter().for_each(|point| bytes.extend(point[axis].to_be_bytes()));
        }
    }
    let second = bytes.len() as i32;
    bytes[60..64].copy_from_slice(&second.to_be_bytes());
    let mut header = vec![0; 64];
    header[16..20].copy_from_slice(&(second + 64).to_be_bytes());
    header[20..24].copy_from_slice(&(name.encode_utf16().count() as i32).to_be_bytes());
    bytes.extend(header);
    name.encode_utf16().for_each(|unit| bytes.extend(unit.to_be_bytes()));
    bytes
}

#[test]
fn polygons_in_whole_pixels_and_fractions() {
    let whole = [[0, 0], [10, 0], [10, 5]];
    let read_whole = read(&region(7, [100, -20], &whole, &[], "zelle µ")).unwrap();
    assert_eq!(read_whole.points, [[100.0, -20.0], [110.0, -20.0], [110.0, -15.0]].map(Vec2::from));
    assert_eq!((read_whole.name.as_deref(), read_whole.closed), (Some("zelle µ"), true));
    let fractions = [[0.25, 1.5], [10.75, 1.5], [10.0, 7.125]];
    let read_fractions = read(&region(0, [0, 1], &whole, &fractions, "")).unwrap();
    assert_eq!(read_fractions.points, [[0.25, 1.5], [10.75, 1.5], [10.0, 7.125]].map(Vec2::from));
    assert_eq!(read_fractions.name, None);
    assert!(!read(&region(5, [0, 0], &whole, &[], "")).unwrap().closed);
}

#[test]
fn rectangles_and_ovals() {
    let square = read(&region(1, [5, 7], &[], &[], "")).unwrap();
    assert_eq!(square.points, [[5.0, 7.0], [45.0, 7.0], [45.0, 27.0], [5.0, 27.0]].map(Vec2::from));
    let oval = read(&region(2, [5, 7], &[], &[], "")).unwrap();
    let on = |p: &Vec2| ((p.x - 25.0) / 20.0).hypot((p.y - 17.0) / 10.0);
    assert!(oval.points.len() == 360 && oval.points.iter().all(|point| (on(point) - 1.0).abs() < 1e-12));
}

#[test]
fn what_is_no_outline_and_files_cut_off_are_refused() {
    let error = read(&region(10, [0, 0], &[[0, 0]], &[], "")).unwrap_err().to_string();
    assert!(error.contains("it is points") && error.contains("Use a polygon"), "{error}");
    let whole = region(0, [0, 0], &[[0, 0], [10, 0], [10, 5]], &[[0.0, 0.0], [9.0, 0.0], [9.0, 9.0]], "");
    for length in 4..HEADER + 36 {
        let error = read(&whole[..length]).unwrap_err().to_string();
        assert!(error.contains("ends too early"), "{length}: {error}");
    }
}
