use stokes_grid::{Grid, StaggeredField};

use crate::{AnyKernel, Kernel, Transfer};
use motile_base::Vec2;

#[test]
fn several_threads_give_the_bits_of_one() {
    let pool = |threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
    let grids =
        [Grid::channel(64, 90, 0.1), Grid::channel(70, 161, 0.1), Grid::periodic(48, 97, 0.1)].map(Result::unwrap);
    for (grid, kernel) in grids.into_iter().flat_map(|grid| AnyKernel::ALL.map(|kernel| (grid, kernel))) {
        let [_, ly] = grid.lengths();
        let y0 = grid.origin()[1];
        // Everywhere, the walls themselves included.
        let place = |k: usize| {
            let k = k as f64;
            Vec2::new(0.00137 * k - 20.0, y0 + ly * (0.5 + 0.5 * (1.1 * (0.37 * k).sin()).clamp(-1.0, 1.0)))
        };
        let positions: Vec<Vec2> = (0..31_000).map(place).collect();
        let forces: Vec<Vec2> = positions.iter().map(|x| Vec2::new(x.y.sin(), (3.0 * x.x).cos())).collect();
        let both = |threads| {
            pool(threads).install(|| {
                let mut transfer = Transfer::new(grid, kernel);
                transfer.locate(&positions);
                assert_eq!(transfer.bands.are_used(), threads > 1);
                let mut density = StaggeredField::zeros(grid);
                transfer.spread(&forces, &mut density).unwrap();
                let mut velocities = vec![Vec2::ZERO; positions.len()];
                transfer.interpolate(&density, &mut velocities).unwrap();
                (density, velocities)
            })
        };
        let (density, velocities) = both(1);
        for threads in [2, 3] {
            let (other_density, other_velocities) = both(threads);
            assert_eq!(density.x(), other_density.x(), "{} {threads}", kernel.name());
            assert_eq!(density.y(), other_density.y(), "{} {threads}", kernel.name());
            assert_eq!(velocities, other_velocities, "{} {threads}", kernel.name());
        }
    }
}
