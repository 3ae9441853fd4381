use super::*;

#[test]
fn braces_raise_and_lower() {
    let text: Vec<(char, i8)> = levels("R_{0}^{-3} m_x");
    let expected = [('R', 0), ('0', -1), ('-', 1), ('3', 1), (' ', 0), ('m', 0), ('_', 0), ('x', 0)];
    assert_eq!(text, expected);
}

#[test]
fn the_font_has_what_labels_need() {
    let face = Face::parse(FONT, 0).unwrap();
    let letters = "αβγδεζηθικλμνξπρστυφχψωΓΔΘΛΞΠΣΦΨΩé";
    let signs = "−±×·°∂∇∞√≈≠≤≥→⟨⟩∥⊥";
    for c in (' '..='~').chain(letters.chars()).chain(signs.chars()) {
        assert!(face.glyph_index(c).is_some(), "{c}");
    }
    assert_eq!(f64::from(face.capital_height().unwrap()), CAPITAL * f64::from(face.units_per_em()));
}

#[test]
fn text_stands_where_it_is_put() {
    for (anchor, left) in [(Anchor::Start, 0.0), (Anchor::Middle, -0.5), (Anchor::End, -1.0)] {
        let width = text_width("HH", 20.0);
        let across = place("HH", [100.0, 50.0], &TextStyle::new(20.0, anchor)).unwrap().bounds();
        let up = place("HH", [100.0, 50.0], &TextStyle::new(20.0, anchor).upwards()).unwrap().bounds();
        let [low, high] = [left, left + 1.0].map(|part| part * width);
        // The letters begin some two pixels within their advance.
        let near = |a: f32, b: f64| (f64::from(a) - b).abs() < 2.5;
        assert!(near(across.left(), 100.0 + low) && near(across.right(), 100.0 + high), "{across:?}");
        assert!(near(up.bottom(), 50.0 - low) && near(up.top(), 50.0 - high), "{up:?}");
        // Halfway up the capitals.
        assert!((across.top() + across.bottom() - 100.0).abs() < 1e-3, "{across:?}");
    }
    assert!(place(" ", [0.0; 2], &TextStyle::new(20.0, Anchor::Start)).is_none());
}

#[test]
fn width_grows_with_size_and_lowered_text_is_small() {
    let width = text_width("pressure", 20.0);
    assert!((text_width("pressure", 40.0) - 2.0 * width).abs() < 1e-9);
    assert!(text_width("R_{000}", 20.0) < text_width("R000", 20.0));
}
