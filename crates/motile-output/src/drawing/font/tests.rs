use super::*;

#[test]
fn every_glyph_reads_and_stays_in_its_cell() {
    for &(c, description) in GLYPHS {
        let words: usize =
            description.split(':').nth(1).unwrap().split('|').map(|s| s.split_whitespace().count()).sum();
        let read: usize = description.split(':').nth(1).unwrap().split('|').map(|s| points(s).len()).sum();
        assert_eq!(words, read, "{c}");
        let glyph = parse(description);
        for p in glyph.strokes.iter().flatten() {
            assert!(p[0] >= -0.01 && p[0] <= glyph.width + 1.01, "{c}: x = {}", p[0]);
            assert!(p[1] >= -4.6 && p[1] <= 16.01, "{c}: y = {}", p[1]);
        }
        assert!(glyph.strokes.iter().all(|s| s.len() >= 2), "{c}");
    }
}

#[test]
fn the_font_has_all_printable_ascii() {
    for c in '!'..='~' {
        assert!(GLYPHS.iter().any(|g| g.0 == c), "{c}");
    }
}

#[test]
fn width_grows_with_size_and_lowered_text_is_small() {
    let width = text_width("pressure", 20.0);
    assert!((text_width("pressure", 40.0) - 2.0 * width).abs() < 1e-9);
    assert!(text_width("R_{000}", 20.0) < text_width("R000", 20.0));
}
