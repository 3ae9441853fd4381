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
fn what_is_rare_gets_the_nearest_frequent_colour() {
    let mut histogram = Histogram::new();
    for (colour, count) in [(Rgb([250, 0, 0]), 9), (Rgb([0, 0, 250]), 8), (Rgb([180, 0, 40]), 1)] {
        (0..count).for_each(|_| histogram.add(colour));
    }
    let (palette, index) = histogram.palette(2);
    assert_eq!(palette, [Rgb([250, 0, 0]), Rgb([0, 0, 250])]);
    assert_eq!(index[usize::from(code(Rgb([180, 0, 40])))], 0);
}
