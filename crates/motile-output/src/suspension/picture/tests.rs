use super::*;

fn square(x: f64, y: f64) -> Vec<Vec2> {
    [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(a, b)| Vec2::new(x + a, y + b)).to_vec()
}

fn crowd(periodic: [bool; 2]) -> SuspensionPicture {
    let (corner, size, origin) = (Vec2::splat(-2.0), Vec2::splat(4.0), String::new());
    SuspensionPicture { time: 0.0, droplets: Vec::new(), corner, size, periodic, origin }
}

#[test]
fn images_are_those_that_show() {
    let inside = crowd([true; 2]).images(&square(0.0, 0.0));
    assert_eq!(inside, [Vec2::ZERO]);
    // Across a corner of the box, periods away from it: all four corners.
    let mut across = crowd([true; 2]).images(&square(9.5, -6.5));
    across.sort_by(|a, b| (a.x, a.y).partial_cmp(&(b.x, b.y)).unwrap());
    assert_eq!(across, [(-12.0, 4.0), (-12.0, 8.0), (-8.0, 4.0), (-8.0, 8.0)].map(Vec2::from));
    // Walls have no images beyond them.
    assert_eq!(crowd([true, false]).images(&square(1.5, 1.5)), [Vec2::new(-4.0, 0.0), Vec2::ZERO]);
}

#[test]
fn runs_of_marked_points() {
    let path: Vec<Pixel> = (0..7).map(|k| [f64::from(k), 0.0]).collect();
    let marked = [true, true, false, true, false, true, true];
    assert_eq!(runs(&path, &marked), [vec![[0.0, 0.0], [1.0, 0.0]], vec![[5.0, 0.0], [6.0, 0.0]]]);
}

/// Crowded parts of an interface are three times as wide as its outline, in pictures of any size.
#[test]
fn crowded_parts_are_wide() {
    let drop = Drop { markers: square(-0.5, -0.5), relative: vec![2.0, 2.0, 2.0, 0.5], heading: Vec2::X };
    let seen = SuspensionPicture { droplets: vec![drop], ..crowd([true; 2]) };
    let widths = [600.0, 1200.0].map(|width| -> Vec<f64> {
        let svg = seen.draw(SuspensionColour::Heading, width, None).svg();
        let ink = format!("stroke=\"#{}\" stroke-width=\"", Rgb::INK.0.map(|part| format!("{part:02x}")).concat());
        svg.split(&ink).skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect()
    });
    assert!(widths.iter().all(|widths| widths.len() == 2), "{widths:?}");
    for [outline, crowded] in widths.iter().map(|widths| [widths[0], widths[1]]) {
        assert!((crowded / outline - 3.0).abs() < 0.02, "{widths:?}");
    }
    assert!((widths[1][0] / widths[0][0] - 2.0).abs() < 0.01, "{widths:?}");
}

#[test]
fn opposite_directions_have_other_colours() {
    let difference = |a: Rgb, b: Rgb| a.0.iter().zip(b.0).map(|(a, b)| a.abs_diff(b)).max().unwrap();
    for k in 0..12 {
        let angle = f64::from(k) * TAU / 12.0;
        assert!(difference(of_angle(angle), of_angle(angle + PI)) > 120);
        assert!(difference(of_angle(angle), of_angle(angle + 0.05)) < 8);
    }
}

/// Concentrations are told relative to their mean, whatever its unit.
#[test]
fn concentrations_are_relative_to_their_mean() {
    use motile::prelude::*;
    let mut scene = Setup { droplets: vec![DropletSetup::active(-1.0)], ..Setup::default() }.build().unwrap().scene;
    let seen = SuspensionPicture::take(scene.system_mut()).unwrap();
    let relative = &seen.droplets[0].relative;
    let mean = relative.iter().sum::<f64>() / relative.len() as f64;
    let most = relative.iter().copied().fold(0.0, f64::max);
    assert!((mean - 1.0).abs() < 1e-12 && (most - 2.0).abs() < 0.01, "{mean} {most}");
}
