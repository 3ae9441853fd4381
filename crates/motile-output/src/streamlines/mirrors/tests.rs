use super::*;

const TAU: f64 = std::f64::consts::TAU;

fn sampled(periodic: bool, flow: impl Fn(Vec2) -> Vec2) -> Samples<Vec2> {
    let raster = Raster::new([-1.0, -1.0], [2.0, 2.0], [80, 80], [periodic; 2]).unwrap();
    Samples::new(raster, raster.points().into_iter().map(flow).collect()).unwrap()
}

#[test]
fn mirror_lines_are_found_where_they_are() {
    // A strain has both, a shear none, a jet along x one.
    let strain = sampled(false, |p| Vec2::new(p.x, -p.y));
    assert_eq!(Mirrors::of(&strain, Vec2::new(0.3, 0.2), 0.1).at, [Some(0.0); 2]);
    assert_eq!(Mirrors::of(&sampled(false, |p| Vec2::new(p.y, 0.0)), Vec2::ZERO, 0.1).at, [None; 2]);
    let jet = |lopsided: f64| {
        sampled(true, move |p| {
            let (x, y) = (0.5 * TAU * p.x, 0.5 * TAU * (p.y - 0.3));
            Vec2::new(y.cos() + lopsided * y.sin(), 0.3 * y.sin() * (x.cos() + 0.4 * (2.0 * x).sin()))
        })
    };
    let found = Mirrors::of(&jet(0.0), Vec2::new(0.1, 0.3), 0.1).at;
    assert_eq!(found, [None, Some(0.3)]);
    for lopsided in [0.05, 0.01] {
        assert_eq!(Mirrors::of(&jet(lopsided), Vec2::new(0.1, 0.3), 0.1).at, [None; 2]);
    }
}

#[test]
fn images_are_reflected_once_for_each_mirror_line() {
    let mirrors = Mirrors { at: [Some(0.0), Some(0.5)], ..Mirrors::of(&sampled(true, |_| Vec2::X), Vec2::ZERO, 0.1) };
    let line = [Vec2::new(0.2, 0.6), Vec2::new(0.3, 0.9)];
    let images = mirrors.images(&line);
    let starts: Vec<[f64; 2]> = images.iter().map(|image| image[0].to_array()).collect();
    assert_eq!(images.len(), 3);
    for expected in [[-0.2, 0.6], [0.2, 0.4], [-0.2, 0.4]] {
        assert!(starts.iter().any(|p| (Vec2::from(*p) - Vec2::from(expected)).length() < 1e-12), "{starts:?}");
    }
    assert!(
        mirrors.is_ahead(line[0]) && !mirrors.is_ahead(Vec2::new(-0.2, 0.6)) && !mirrors.is_ahead(Vec2::new(0.2, 0.4))
    );
    // A line on one mirror line has an image in the other alone.
    assert_eq!(mirrors.images(&[Vec2::new(0.0, 0.7), Vec2::new(0.0, 0.8)]).len(), 1);
    // Near the line, and near the one that is half a period away.
    assert!(mirrors.is_near_image(Vec2::new(0.04, 0.8), 0.1) && mirrors.is_near_image(Vec2::new(0.97, 0.8), 0.1));
    assert!(!mirrors.is_near_image(Vec2::new(0.06, 0.8), 0.1) && !mirrors.is_near_image(Vec2::new(0.0, 0.8), 0.1));
    assert_eq!(mirrors.along(Vec2::new(0.0, 0.7), Vec2::new(0.01, 0.8)), Vec2::new(0.0, 0.8));
}
