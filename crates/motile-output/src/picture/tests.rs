use super::*;
use crate::{ColourMap, Limits, Raster, Rgb};

const SCALE: (ColourMap, f64, f64) = (ColourMap::Viridis, 0.0, 1.0);

fn scale() -> ColourScale {
    ColourScale::new(SCALE.0, Limits::Fixed(SCALE.1, SCALE.2), &[])
}

/// A field that is 0 in the left and 1 in the right half of a square box around the origin.
fn halves() -> Picture {
    let raster = Raster::new([-3.0, -3.0], [6.0, 6.0], [60, 60], [true, true]).unwrap();
    let values = raster.points().iter().map(|p| if p.x < 0.0 { 0.0 } else { 1.0 }).collect();
    Picture::new(Samples::new(raster, values).unwrap(), scale(), "step")
}

fn count(image: &Image, colour: Rgb) -> usize {
    image.pixels().iter().filter(|&&p| p == colour).count()
}

#[test]
fn the_field_fills_its_halves_and_the_view_shifts_it() {
    let format = Format::frame();
    let (low, high) = (SCALE.0.at(0.0), SCALE.0.at(1.0));
    let image = halves().draw(&format).unwrap();
    let (left, right) = (count(&image, low) as f64, count(&image, high) as f64);
    assert!(left > 40_000.0 && (left / right - 1.0).abs() < 0.1, "{left} {right}");
    let shifted = halves().view(Vec2::new(0.2, -3.0), Vec2::new(2.8, 3.0)).unwrap().draw(&format).unwrap();
    // What is left of the colour of the low end is in its colour bar.
    assert!(count(&shifted, low) < 400, "{}", count(&shifted, low));
}

#[test]
fn an_interface_across_the_border_shows_on_both_sides() {
    let circle = |x: f64| -> Vec<Vec2> {
        (0..90).map(|k| f64::from(k) * 4f64.to_radians()).map(|t| Vec2::new(x + t.cos(), t.sin())).collect()
    };
    let ink = |x: f64| {
        let picture = halves().interface(&circle(x), &[0.5; 90]).unwrap();
        count(&picture.draw(&Format { width: 800, ..Format::frame() }).unwrap(), Rgb::INK) as f64
    };
    let (inside, across, far) = (ink(1.5), ink(3.0), ink(3.0 - 60.0));
    assert!((across / inside - 1.0).abs() < 0.05, "{across} {inside}");
    assert!((far / across - 1.0).abs() < 1e-3, "{far} {across}");
}

#[test]
fn bad_sizes_views_and_interfaces_are_refused() {
    assert!(halves().draw(&Format { width: 10, ..Format::frame() }).is_err());
    assert!(halves().draw(&Format { width: 1_000_000, ..Format::frame() }).is_err());
    assert!(halves().view(Vec2::new(0.0, 0.0), Vec2::new(0.0, 1.0)).is_err());
    assert!(halves().view(Vec2::new(0.0, 0.0), Vec2::new(f64::NAN, 1.0)).is_err());
    assert!(halves().interface(&[Vec2::zeros(); 4], &[0.0; 3]).is_err());
}

#[test]
fn values_that_are_not_numbers_do_no_harm() {
    let raster = Raster::new([0.0, 0.0], [4.0, 2.0], [8, 4], [true, false]).unwrap();
    let field = Samples::new(raster, vec![f64::NAN; 32]).unwrap();
    let flow = Samples::new(raster, vec![Vec2::new(f64::NAN, 0.0); 32]).unwrap();
    let picture = Picture::new(field, scale(), "nothing")
        .walls(0.0, 2.0)
        .streamlines(flow, 0.2, Vec2::new(1.0, 1.0))
        .track(&[Vec2::new(f64::NAN, 1.0), Vec2::new(1.0, 1.0)])
        .interface(&[Vec2::new(f64::NAN, 0.0); 3], &[f64::NAN; 3])
        .unwrap();
    assert!(picture.draw(&Format::frame()).is_ok());
}
