use super::*;
use crate::picture::contents::Format;
use crate::{Look, Raster, Snapshot};

/// Images of a droplet across the upper side of a box whose rows are displaced: each row by its own tilt.
#[test]
fn images_in_a_sheared_box_are_displaced_row_by_row() {
    let images = |tilt: Option<f64>, centre: Vec2| {
        let raster = Raster::new([-3.0, -3.0], [6.0, 6.0], [60, 60], [true, tilt.is_none()]).unwrap();
        let seen = Snapshot {
            time: 0.0,
            raster: Raster { tilt, ..raster },
            flow: vec![Default::default(); 3600],
            interfaces: Vec::new(),
            droplets: Vec::new(),
            gels: Vec::new(),
            inside: Vec::new(),
            solids: Vec::new(),
            walls: None,
            smear: 0.0,
            origin: String::new(),
        };
        let look = Look::default();
        let legends = look.legends(std::slice::from_ref(&seen));
        let picture = Picture {
            seen: &seen,
            look: &look,
            legends: &legends,
            streamline_spacing: 1.0,
            tracks: Vec::new(),
            view: [Vec2::splat(-3.0), Vec2::splat(3.0)],
            format: Format::FRAME,
        };
        let layout = Layout::new(&picture);
        let painter = Painter { picture: &picture, drawing: Drawing::new([440.0, layout.height]), layout };
        let circle: Vec<Vec2> = (0..60).map(|k| centre + Vec2::from_angle(f64::from(k) * 6f64.to_radians())).collect();
        let mut images = painter.images(&circle.iter());
        images.sort_by(|a, b| (a.y, a.x).partial_cmp(&(b.y, b.x)).unwrap());
        images
    };
    let of = |places: &[(f64, f64)]| places.iter().map(|&place| Vec2::from(place)).collect::<Vec<_>>();
    let above = Vec2::new(0.0, 2.8);
    assert_eq!(images(None, above), of(&[(0.0, -6.0), (0.0, 0.0)]));
    assert_eq!(images(Some(1.5), above), of(&[(-1.5, -6.0), (0.0, 0.0)]));
    assert_eq!(images(Some(1.5), -above), of(&[(0.0, 0.0), (1.5, 6.0)]));
    // Two rows up, where the droplet is across the right side.
    assert_eq!(images(Some(1.5), above - Vec2::new(0.0, 12.0)), of(&[(1.5, 6.0), (-3.0, 12.0), (3.0, 12.0)]));
}
