use motile::space_droplets::{ConstantTension, SpaceDroplet};

use super::*;

fn ball(position: [f64; 3], radius: f64) -> SurfaceMesh {
    let law = ConstantTension::new(1.0).unwrap();
    let mut drop = SpaceDroplet::sphere(8, radius, [1.0, 1.0], law).unwrap().with_position(position).unwrap();
    drop.evaluate().unwrap();
    drop.mesh().unwrap()
}

/// As many pixels as a disc has, lit from the right and above; what is behind does not show.
#[test]
fn balls_are_discs_that_hide_what_is_behind() {
    let camera = Camera::new([0.0; 3], 40.0, [60.0, 60.0]);
    let mut canvas = Canvas::new([120, 120]);
    canvas.draw(&ball([0.0; 3], 1.0), &camera, None);
    let pixels = |canvas: &Canvas| (0..120 * 120).filter(|k| canvas.pixel(k % 120, k / 120).is_some()).count() as f64;
    let disc = std::f64::consts::PI * 40.0 * 40.0;
    assert!((pixels(&canvas) / disc - 1.0).abs() < 0.05, "{} {disc}", pixels(&canvas));
    let bright = |canvas: &Canvas, x, y| canvas.pixel(x, y).unwrap().0.iter().map(|c| u32::from(*c)).sum::<u32>();
    assert!(bright(&canvas, 75, 40) > bright(&canvas, 45, 85) + 100);
    // The eye is at -y: a ball there hides the middle, a ball behind is hidden.
    let before = canvas.pixel(60, 60).unwrap();
    let behind = unit(TO_EYE).map(|x| -3.0 * x);
    canvas.draw(&ball(behind, 0.5), &camera, None);
    assert_eq!(canvas.pixel(60, 60).unwrap(), before);
    assert!(!canvas.shows([60.0, 60.0], 0.5) && canvas.shows([60.0, 60.0], 1.5) && canvas.shows([2.0, 2.0], -9.0));
    let (at, depth) = camera.place(unit(TO_EYE));
    assert!((at[0] - 60.0).abs() < 1e-9 && (depth - 1.0).abs() < 1e-12);
}
