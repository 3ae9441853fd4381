//! Spreading and interpolation as an adjoint pair, in boxes and channels, for every kernel.

use ib_core::{AnyKernel, BSpline, Kernel, MAX_SUPPORT, Role, Transfer};
use motile_base::{InputError, Vec2};
use proptest::prelude::*;
use stokes_grid::{Grid, StaggeredField, StokesError};

/// Returns true if a result is a refusal whose text contains these words.
fn refused<T>(result: &Result<T, StokesError>, words: &str) -> bool {
    matches!(result, Err(error @ StokesError::Refused { .. }) if error.to_string().contains(words))
}

/// A field of reproducible pseudo-random values in [-1, 1), zero on walls for the y component.
fn noise(grid: Grid, seed: u64) -> StaggeredField {
    let mut field = StaggeredField::zeros(grid);
    let mut state = seed.wrapping_add(1);
    let mut next = || {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0
    };
    let (nx, rows) = (grid.nx(), grid.node_rows());
    let (x, y) = field.components_mut();
    x.iter_mut().for_each(|v| *v = next());
    y.iter_mut().for_each(|v| *v = next());
    if grid.has_walls() {
        y[..nx].fill(0.0);
        y[nx * (rows - 1)..].fill(0.0);
    }
    field
}

fn inner(a: &StaggeredField, b: &StaggeredField) -> f64 {
    let dot = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
    dot(a.x(), b.x()) + dot(a.y(), b.y())
}

fn check(grid: Grid, kernel: AnyKernel, positions: &[Vec2], forces: &[Vec2], seed: u64) -> Result<(), TestCaseError> {
    let mut transfer = Transfer::new(grid, kernel);
    transfer.locate(positions);
    let mut density = StaggeredField::zeros(grid);
    transfer.spread(forces, &mut density).expect("a field of the grid");
    let velocity = noise(grid, seed);
    let mut velocities = vec![Vec2::ZERO; positions.len()];
    transfer.interpolate(&velocity, &mut velocities).expect("a field of the grid");
    let h2 = grid.spacing() * grid.spacing();
    let on_grid = h2 * inner(&density, &velocity);
    let at_markers: f64 = forces.iter().zip(&velocities).map(|(f, u)| f.dot(*u)).sum();
    let scale: f64 = forces.iter().map(|v| v.length()).sum();
    prop_assert!((on_grid - at_markers).abs() < 1e-13 * (1.0 + scale), "{}: {on_grid} {at_markers}", kernel.name());
    if !grid.has_walls() {
        let total: Vec2 = forces.iter().sum();
        let sum = |values: &[f64]| h2 * values.iter().sum::<f64>();
        let error = (total - Vec2::new(sum(density.x()), sum(density.y()))).length();
        prop_assert!(error < 1e-12 * (1.0 + scale), "the total force arrives");
    }
    Ok(())
}

fn vectors(range: f64) -> impl Strategy<Value = Vec<Vec2>> {
    prop::collection::vec((-range..range, -range..range).prop_map(|(x, y)| Vec2::new(x, y)), 7)
}

proptest! {
    #[test]
    fn adjoint_in_a_box(positions in vectors(30.0), forces in vectors(5.0), seed in 0..1000_u64) {
        let grid = Grid::periodic(17, 12, 0.37).unwrap();
        for kernel in AnyKernel::ALL {
            check(grid, kernel, &positions, &forces, seed)?;
        }
    }

    #[test]
    fn adjoint_in_a_box_smaller_than_the_kernel(
        positions in vectors(3.0), forces in vectors(5.0), seed in 0..1000_u64,
    ) {
        let grid = Grid::periodic(3, 2, 0.5).unwrap();
        for kernel in AnyKernel::ALL {
            check(grid, kernel, &positions, &forces, seed)?;
        }
    }

    #[test]
    fn adjoint_in_a_channel(positions in vectors(1.0), forces in vectors(5.0), seed in 0..1000_u64) {
        let grid = Grid::channel(14, 8, 0.25).unwrap();
        for kernel in AnyKernel::ALL {
            check(grid, kernel, &positions, &forces, seed)?;
        }
    }
}

/// A field that is odd (x) and even (y) about the walls interpolates to zero on them; one that is constant inside a
/// box to the constant anywhere.
#[test]
fn walls_and_constants() {
    let channel = Grid::channel(16, 9, 0.2).unwrap();
    let velocity = noise(channel, 3);
    let top = channel.origin()[1] + channel.lengths()[1];
    for kernel in AnyKernel::ALL {
        let positions: Vec<Vec2> =
            (0..20).flat_map(|i| [channel.origin()[1], top].map(|y| Vec2::new(0.137 * f64::from(i), y))).collect();
        let mut transfer = Transfer::new(channel, kernel);
        transfer.locate(&positions);
        let mut velocities = vec![Vec2::ZERO; positions.len()];
        transfer.interpolate(&velocity, &mut velocities).unwrap();
        for u in &velocities {
            assert!(u.x.abs() < 1e-14, "{}: no slip, {u}", kernel.name());
        }

        let grid = Grid::periodic(10, 11, 0.3).unwrap();
        let mut constant = StaggeredField::zeros(grid);
        constant.fill(1.5);
        let mut transfer = Transfer::new(grid, kernel);
        transfer.locate(&positions);
        transfer.interpolate(&constant, &mut velocities).unwrap();
        for u in &velocities {
            assert!((u - Vec2::new(1.5, 1.5)).length() < 1e-13);
        }
    }
}

/// The value of a component at any point of its lattice, continued periodically and, at walls, oddly (x) or evenly (y).
fn continued(field: &StaggeredField, component: usize, column: i64, row: i64) -> f64 {
    let grid = field.grid();
    let (nx, ny) = (grid.nx() as i64, grid.ny() as i64);
    let column = column.rem_euclid(nx);
    let values = if component == 0 { field.x() } else { field.y() };
    let at = |row: i64| values[(row * nx + column) as usize];
    if !grid.has_walls() {
        return at(row.rem_euclid(ny));
    }
    let row = row.rem_euclid(2 * ny);
    match component {
        0 if row < ny => at(row),
        0 => -at(2 * ny - 1 - row),
        _ if row <= ny => at(row),
        _ => at(2 * ny - row),
    }
}

proptest! {
    /// Interpolation is the sum of the kernel's values times the field, everywhere: at walls, in corners, across the
    /// ends of the box.
    #[test]
    fn interpolation_is_the_sum_over_the_grid(
        x in -7.0..7.0_f64, height in -0.2..1.2_f64, walls: bool, seed in 0..1000_u64,
    ) {
        let h = 0.25;
        let grid = if walls { Grid::channel(14, 11, h) } else { Grid::periodic(14, 11, h) }.unwrap();
        let [x0, y0] = grid.origin();
        // A quarter of a cell beyond a wall at most.
        let height = if walls { height.clamp(-0.02, 1.02) } else { height };
        let position = Vec2::new(x, y0 + height * 11.0 * h);
        let velocity = noise(grid, seed);
        for kernel in AnyKernel::ALL {
            let mut transfer = Transfer::new(grid, kernel);
            transfer.locate(&[position]);
            let mut found = [Vec2::ZERO];
            transfer.interpolate(&velocity, &mut found).unwrap();
            let [a, b] = [(position.x - x0) / h, (position.y - y0) / h];
            let mut expected = Vec2::ZERO;
            for column in a.floor() as i64 - 4..a.floor() as i64 + 5 {
                for row in b.floor() as i64 - 4..b.floor() as i64 + 5 {
                    let (i, j) = (column as f64, row as f64);
                    let weight = |n: f64, t: f64| kernel.value(Role::Normal, n) * kernel.value(Role::Tangential, t);
                    expected.x += weight(a - i, b - j - 0.5) * continued(&velocity, 0, column, row);
                    expected.y += weight(b - j, a - i - 0.5) * continued(&velocity, 1, column, row);
                }
            }
            prop_assert!((found[0] - expected).length() < 1e-13, "{}: {} {expected}", kernel.name(), found[0]);
        }
    }
}

/// A kernel whose weights are computed one by one.
#[derive(Debug, Clone)]
struct OneByOne(AnyKernel);

impl Kernel for OneByOne {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn support(&self, role: Role) -> usize {
        self.0.support(role)
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        self.0.weights(role, r, weights)
    }

    fn value(&self, role: Role, r: f64) -> f64 {
        self.0.value(role, r)
    }
}

/// Everywhere in and beyond the box: near walls, across the ends, far outside.
#[test]
fn polynomials_and_weights_one_by_one_transfer_alike() {
    let grids =
        [Grid::channel(24, 13, 0.1), Grid::channel(4, 4, 0.1), Grid::periodic(19, 30, 0.1), Grid::periodic(4, 5, 0.1)]
            .map(Result::unwrap);
    let kernels = [AnyKernel::BSpline3, AnyKernel::BSpline4];
    for (grid, kernel) in grids.into_iter().flat_map(|grid| kernels.map(|kernel| (grid, kernel))) {
        let [_, ly] = grid.lengths();
        let y0 = grid.origin()[1];
        let beyond = if grid.has_walls() { 0.02 } else { 7.0 };
        let place = |k: u32| {
            let k = f64::from(k);
            // Whole numbers of cells among them.
            let x =
                if k % 5.0 == 0.0 { 0.1 * (k - 300.0) } else { 0.0193 * k - 6.0 + 1e5 * grid.lengths()[0] * (k % 3.0) };
            Vec2::new(x, y0 + 0.5 * ly + (0.5 * ly + beyond) * (0.37 * k).sin())
        };
        let positions: Vec<Vec2> = (0..997).map(place).collect();
        let forces: Vec<Vec2> = positions.iter().map(|r| Vec2::new(r.y.sin(), (3.0 * r.x).cos())).collect();
        let velocity = noise(grid, 5);
        let mut fast = Transfer::new(grid, kernel);
        let mut slow = Transfer::new(grid, OneByOne(kernel));
        fast.locate(&positions);
        slow.locate(&positions);
        let mut densities = [StaggeredField::zeros(grid), StaggeredField::zeros(grid)];
        fast.spread(&forces, &mut densities[0]).unwrap();
        slow.spread(&forces, &mut densities[1]).unwrap();
        let size = densities[1].x().iter().chain(densities[1].y()).fold(0.0_f64, |size, value| size.max(value.abs()));
        let pairs = densities[0].x().iter().zip(densities[1].x()).chain(densities[0].y().iter().zip(densities[1].y()));
        for (k, (fast, slow)) in pairs.enumerate() {
            assert!((fast - slow).abs() < 1e-13 * size, "{} {k}: {fast} {slow}", kernel.name());
        }
        let mut velocities = [vec![Vec2::ZERO; positions.len()], vec![Vec2::ZERO; positions.len()]];
        fast.interpolate(&velocity, &mut velocities[0]).unwrap();
        slow.interpolate(&velocity, &mut velocities[1]).unwrap();
        for (k, (fast, slow)) in velocities[0].iter().zip(&velocities[1]).enumerate() {
            assert!((fast - slow).length() < 1e-13, "{} at {:?}: {fast} {slow}", kernel.name(), positions[k]);
        }
    }
}

/// Scenes refuse such markers before; the transfer itself must not fail, and leaves other markers alone.
#[test]
fn what_is_not_in_the_box_does_no_harm() {
    let far = [f64::NAN, -f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.350_891_108_598_784e16, 1e9, -1e300];
    for grid in [Grid::channel(14, 8, 1.0), Grid::periodic(14, 8, 1.0)].map(Result::unwrap) {
        for kernel in [AnyKernel::BSpline3, AnyKernel::BSpline4] {
            let velocity = noise(grid, 3);
            let good = Vec2::new(0.3, 0.4);
            let positions: Vec<Vec2> =
                far.into_iter().flat_map(|r| [Vec2::new(r, 0.1), good, Vec2::new(0.1, r), Vec2::new(r, r)]).collect();
            let mut transfer = Transfer::new(grid, kernel);
            let mut alone = vec![Vec2::ZERO];
            transfer.locate(&[good]);
            transfer.interpolate(&velocity, &mut alone).unwrap();
            transfer.locate(&positions);
            transfer.spread(&vec![Vec2::new(1.0, 2.0); positions.len()], &mut StaggeredField::zeros(grid)).unwrap();
            let mut velocities = vec![Vec2::ZERO; positions.len()];
            transfer.interpolate(&velocity, &mut velocities).unwrap();
            for chunk in velocities.chunks(4) {
                assert!((chunk[1] - alone[0]).length() < 1e-15, "{}", kernel.name());
            }
        }
    }
}

#[test]
fn fields_of_other_grids_and_lists_of_other_lengths_are_refused() {
    let [own, other] = [16, 8].map(|n| Grid::periodic(n, n, 0.1).unwrap());
    let mut transfer = Transfer::new(own, BSpline::<4>);
    transfer.locate(&[Vec2::ZERO, Vec2::new(0.75, -0.75)]);
    let mut list = [Vec2::ZERO; 2];
    for grid in [other, own.with_origin([0.0; 2]).unwrap(), Grid::channel(16, 16, 0.1).unwrap()] {
        let mut field = StaggeredField::zeros(grid);
        let spread = transfer.spread(&list, &mut field);
        assert!(refused(&spread, "the force density belongs to another grid"));
        let interpolated = transfer.interpolate(&field, &mut list);
        assert!(refused(&interpolated, "the velocity belongs to another grid"));
    }
    let mut field = StaggeredField::zeros(own);
    for count in [1, 3] {
        let mut list = vec![Vec2::ZERO; count];
        let expected = InputError::WrongLength { name: "the forces", expected: 2, found: count };
        assert_eq!(transfer.spread(&list, &mut field), Err(StokesError::Input(expected)));
        let expected = InputError::WrongLength { name: "the velocities", expected: 2, found: count };
        assert_eq!(transfer.interpolate(&field, &mut list), Err(StokesError::Input(expected)));
    }
}

/// Markers are found in pairs, and a last one alone: both as if each were alone, wherever the grid begins.
#[test]
fn pairs_are_found_where_each_is() {
    for grid in [Grid::periodic(20, 16, 0.3).unwrap(), Grid::channel(20, 16, 0.3).unwrap()] {
        let [x0, y0] = [0.31, -1.27];
        let grid = grid.with_origin([x0, y0]).unwrap();
        let velocity = noise(grid, 5);
        let places: Vec<Vec2> =
            (0..8).map(|k| Vec2::new(x0 + 0.71 * f64::from(k), y0 + 0.4 + 0.53 * f64::from(k))).collect();
        for kernel in AnyKernel::ALL {
            let found = |places: &[Vec2]| {
                let mut transfer = Transfer::new(grid, kernel);
                transfer.locate(places);
                let mut velocities = vec![Vec2::ZERO; places.len()];
                transfer.interpolate(&velocity, &mut velocities).unwrap();
                velocities
            };
            let alone: Vec<Vec2> = places.iter().flat_map(|place| found(&[*place])).collect();
            for (place, (one, other)) in places.iter().zip(found(&places).iter().zip(&alone)) {
                assert!(one.distance(*other) < 1e-13, "{} at {place}: {one} {other}", kernel.name());
            }
        }
    }
}
