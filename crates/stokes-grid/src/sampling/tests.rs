use super::*;
use crate::{ChannelStokes, StokesSolver};

/// Couette flow is linear, so that samples are exact everywhere, also on walls that slide and beyond them.
#[test]
fn samples_next_to_sliding_walls_are_exact() {
    for h in [0.1, 1e-6] {
        let grid = Grid::channel(12, 9, h).unwrap();
        let [y0, width] = [grid.origin()[1], grid.lengths()[1]];
        let mut solver = ChannelStokes::new(grid, 2.0).unwrap();
        solver.set_walls(WallMotion::uniform(&grid, 0.5, 2.0).unwrap()).unwrap();
        let (force, mut velocity) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
        solver.solve(&force, &mut velocity).unwrap();
        let heights = [-0.3, 0.0, 0.25, 1.0, 4.5, 8.75, 9.0, 9.2];
        let points = heights.map(|y| Vec2::new(0.37 * h, y0 + y * h));
        let mut out = [FlowSample::default(); 8];
        sample_flow(&velocity, &CentreField::zeros(grid), solver.walls(), &points, &mut out).unwrap();
        for (seen, y) in out.iter().zip(heights) {
            let exact = 0.5 + 1.5 * y * h / width;
            assert!((seen.velocity.x - exact).abs() < 1e-12, "{h} {y}: {} {exact}", seen.velocity.x);
            assert!((seen.gradient[0][1] * width / 1.5 - 1.0).abs() < 1e-10, "{h} {y}: {}", seen.gradient[0][1]);
        }
    }
}

#[test]
fn points_far_away_have_the_values_of_their_images() {
    let grid = Grid::periodic(8, 8, 1.0).unwrap();
    let values = (0..64).map(|k| f64::from(k * k % 17)).collect();
    let pressure = CentreField::from_values(grid, values).unwrap();
    let [here, far] = [0.0, 2f64.powi(40)].map(|x| sample_pressure(&pressure, Vec2::new(x, 0.5)));
    assert_eq!(here, far);
    // Where numbers no longer tell one cell from the next, the value is that of some cell.
    let beyond = sample_pressure(&pressure, Vec2::new(1e19, -1e25));
    assert!((0.0..=16.0).contains(&beyond), "{beyond}");
    assert!(sample_pressure(&pressure, Vec2::new(f64::INFINITY, 0.0)).is_nan());
}
