use stokes_grid::Grid;

use super::*;
use crate::BSpline;
use crate::transfer::lanes::{Portable, dispatch};
use crate::transfer::locations::Locations;

/// On a machine without wide instructions both are the same.
#[test]
fn all_instructions_agree() {
    let grid = Grid::channel(20, 16, 0.1).unwrap();
    let kernel = BSpline::<4>;
    let general = GeneralTransfer { kernel: &kernel, grid: &grid };
    let positions: Vec<Vec2> =
        (0..500).map(|k| f64::from(k) * 0.0731).map(|k| Vec2::new(k % 2.0 - 1.0, (k * 0.39) % 1.6 - 0.8)).collect();
    let forces: Vec<Vec2> = positions.iter().map(|r| Vec2::new(r.x.sin(), (r.y * 1.7).cos())).collect();
    let mut found = Locations::new(grid);
    found.find(kernel.pieces(), &positions);
    let (locations, irregular) = (&found.all, &found.irregular);
    let cells = 20 * 17;
    let both = |wide: bool| {
        let (mut fx, mut fy) = (vec![0.0; cells - 20], vec![0.0; cells]);
        let markers = Markers { locations, forces: &forces, stride: 8, irregular };
        let band = Band { first_row: 0, fx: &mut fx, fy: &mut fy };
        let task = Spreading { general, pieces: BSpline4Pieces, scale: 3.0, markers, band };
        if wide {
            dispatch(task);
        } else {
            task.run(Portable);
        }
        let mut velocities = vec![Vec2::ZERO; positions.len()];
        let (u, v, velocities_mut) = (&fx[..], &fy[..], &mut velocities[..]);
        let pieces = BSpline4Pieces;
        let task = Interpolation { general, pieces, locations, irregular, u, v, velocities: velocities_mut };
        if wide {
            dispatch(task);
        } else {
            task.run(Portable);
        }
        (fx, fy, velocities)
    };
    let (wide, plain) = (both(true), both(false));
    let size = plain.0.iter().chain(&plain.1).fold(0.0_f64, |size, value| size.max(value.abs()));
    assert!(size > 1.0);
    // A few roundings of the largest of the sums on the way.
    let close = |a: f64, b: f64| (a - b).abs() < 16.0 * f64::EPSILON * size;
    let numbers = |(fx, fy, velocities): (Vec<f64>, Vec<f64>, Vec<Vec2>)| {
        fx.into_iter().chain(fy).chain(velocities.into_iter().flat_map(|u| [u.x, u.y])).collect::<Vec<_>>()
    };
    for (wide, plain) in numbers(wide).into_iter().zip(numbers(plain)) {
        assert!(close(wide, plain), "{wide} {plain}");
    }
}
