use super::*;

#[test]
fn few_colours_are_kept_exactly() {
    let colours = [Rgb([0, 0, 0]), Rgb([255, 255, 255]), Rgb([200, 16, 40]), Rgb([201, 120, 40])];
    let mut histogram = Histogram::new();
    for (k, &colour) in colours.iter().enumerate() {
        (0..=k * 1000).for_each(|_| histogram.add(colour));
    }
    let (palette, index) = histogram.palette(255);
    assert_eq!(palette.len(), 4);
    for colour in colours {
        assert_eq!(palette[usize::from(index[usize::from(code(colour))])], colour);
    }
}

#[test]
fn a_colour_map_is_followed_closely_by_255_colours() {
    let mut histogram = Histogram::new();
    let colours: Vec<Rgb> = (0..4000).map(|k| crate::ColourMap::Rainbow.at(f64::from(k) / 3999.0)).collect();
    colours.iter().for_each(|&c| histogram.add(c));
    let (palette, index) = histogram.palette(255);
    assert!(palette.len() <= 255);
    for colour in colours {
        let found = palette[usize::from(index[usize::from(code(colour))])];
        for (a, b) in colour.0.into_iter().zip(found.0) {
            assert!(a.abs_diff(b) <= 8, "{colour:?} becomes {found:?}");
        }
    }
}
