use super::*;

#[test]
fn braces_raise_and_lower() {
    let text: Vec<(char, i8)> = levels("R_{0}^{-3} m_x");
    let expected = [('R', 0), ('0', -1), ('-', 1), ('3', 1), (' ', 0), ('m', 0), ('_', 0), ('x', 0)];
    assert_eq!(text, expected);
}

#[test]
fn every_glyph_reads_and_stays_in_its_cell() {
    for line in GLYPHS.lines() {
        let c = line.chars().next().unwrap();
        let strokes = line.rsplit(':').next().unwrap();
        let words: usize = strokes.split('|').map(|s| s.split_whitespace().count()).sum();
        let read: usize = strokes.split('|').map(|s| points(s).len()).sum();
        assert_eq!(words, read, "{c}");
        let glyph = parse(line);
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
        assert!(GLYPHS.lines().any(|line| line.starts_with(c)), "{c}");
    }
}

#[test]
fn width_grows_with_size_and_lowered_text_is_small() {
    let width = text_width("pressure", 20.0);
    assert!((text_width("pressure", 40.0) - 2.0 * width).abs() < 1e-9);
    assert!(text_width("R_{000}", 20.0) < text_width("R000", 20.0));
}
