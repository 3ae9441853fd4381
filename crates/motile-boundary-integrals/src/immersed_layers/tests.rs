use std::f64::consts::TAU;

use stokes_boundary_integrals::{Interface, InterfaceFlow, Settings};
use stokes_grid::{ChannelStokes, PeriodicStokes};

use super::*;
use ib_core::BSpline;
use motile_scene::{MarkerKind, gap::SurfaceCurve};

const NODES: usize = 64;
const HEIGHT: f64 = 6.0;
const TOLERANCE: f64 = 1e-8;

type Flow<S> = ImmersedLayers<S, BSpline<4>>;

fn channel(length: f64, h: f64) -> Flow<ChannelStokes> {
    let cells = |length: f64| (length / h).round() as usize;
    let solver = ChannelStokes::new(Grid::channel(cells(length), cells(HEIGHT), h).unwrap(), 2.0).unwrap();
    ImmersedLayers::new(solver, BSpline::<4>, NODES, TOLERANCE).unwrap()
}

fn circle(centre: Vec2, radius: f64, count: usize) -> Vec<Vec2> {
    let at = |k: usize| centre + radius * Vec2::from_angle(TAU * k as f64 / count as f64);
    (0..count).map(at).collect()
}

fn closed(count: usize) -> SurfaceCurve {
    SurfaceCurve::through(0..count, 0)
}

fn droplet(viscosity_inside: Option<f64>) -> Markers {
    let mut markers = Markers::new();
    markers.push_group(NODES, MarkerKind::Interface { viscosity_inside });
    markers.positions_mut().copy_from_slice(&circle(Vec2::ZERO, 1.0, NODES));
    markers
}

/// A solid of surface points and inner points.
fn push(markers: &mut Markers, surface: SurfaceCurve, points: &[Vec2]) {
    let mut positions = markers.positions().to_vec();
    positions.extend_from_slice(points);
    markers.push_body(points.len(), MarkerKind::Points, vec![surface]);
    markers.positions_mut().copy_from_slice(&positions);
}

/// A droplet and a disc beside it, whose inner points are `lattice` apart, those of the surface half of that.
fn droplet_and_disc(gap: f64, lattice: f64) -> Markers {
    let mut markers = droplet(None);
    push_disc(&mut markers, Vec2::new(0.3, 1.7 + gap), 0.7, lattice);
    markers
}

fn push_disc(markers: &mut Markers, centre: Vec2, radius: f64, lattice: f64) {
    let count = (radius * TAU / (0.5 * lattice)) as usize;
    let rows = (radius / lattice) as i32;
    let place = |i: i32, j: i32| Vec2::new(f64::from(i), f64::from(j)) * lattice;
    let inner = (-rows..=rows).flat_map(|i| (-rows..=rows).map(move |j| place(i, j)));
    let inner = inner.filter(|x| x.length() < radius - 0.8 * lattice).map(|x| x + centre);
    let points: Vec<Vec2> = circle(centre, radius, count).into_iter().chain(inner).collect();
    push(markers, closed(count), &points);
}

/// A droplet between the surfaces of two walls.
fn droplet_and_walls(viscosity_inside: Option<f64>, gap: f64, length: f64, lattice: f64) -> Markers {
    let mut markers = droplet(viscosity_inside);
    let columns = (length / lattice).round() as usize;
    for side in [-1.0, 1.0] {
        let at = |x: f64, depth: f64| Vec2::new(x, side * (1.0 + gap + depth));
        let count = 2 * columns;
        let surface = (0..count).map(|k| at(0.5 * lattice * k as f64, 0.0));
        let rows = (1..4).flat_map(|row| (0..columns).map(move |k| (row, k)));
        let inner =
            rows.map(|(row, k)| at(lattice * (k as f64 + 0.5 * f64::from(row % 2)), 0.866 * lattice * f64::from(row)));
        let curve = SurfaceCurve::through(0..count, 1);
        push(&mut markers, curve, &surface.chain(inner).collect::<Vec<_>>());
    }
    markers
}

/// The mobility, column by column.
fn mobility(flow: &mut impl Hydrodynamics, markers: &mut Markers) -> Vec<Vec<f64>> {
    let count = 2 * markers.len();
    let column = |column: usize| {
        markers.forces_mut().fill(Vec2::ZERO);
        markers.forces_mut()[column / 2][column % 2] = 1.0;
        flow.velocities(markers).unwrap();
        markers.velocities().iter().copied().flat_map(Vec2::to_array).collect()
    };
    (0..count).map(column).collect()
}

/// True if all eigenvalues of a symmetric matrix are above a bound, by Cholesky's decomposition.
fn eigenvalues_are_above(bound: f64, mut matrix: Vec<Vec<f64>>) -> bool {
    let count = matrix.len();
    matrix.iter_mut().enumerate().for_each(|(k, row)| row[k] -= bound);
    for k in 0..count {
        let (above, below) = matrix.split_at_mut(k + 1);
        let row = &above[k];
        if row[k] <= 0.0 {
            return false;
        }
        for (i, other) in (k + 1..).zip(below) {
            let factor = row[i] / row[k];
            other[i..].iter_mut().zip(&row[i..]).for_each(|(entry, pivot)| *entry -= factor * pivot);
        }
    }
    true
}

/// Largest entry, and how far the matrix is from being symmetric.
fn asymmetry(matrix: &[Vec<f64>]) -> [f64; 2] {
    let entries = || (0..matrix.len()).flat_map(|i| (0..matrix.len()).map(move |j| (i, j)));
    let largest = entries().map(|(i, j)| matrix[i][j].abs()).fold(0.0, f64::max);
    [largest, entries().map(|(i, j)| (matrix[i][j] - matrix[j][i]).abs()).fold(0.0, f64::max)]
}

#[test]
fn the_mobility_is_symmetric_and_takes_energy() {
    for gap in [0.3, 0.05] {
        for mut markers in [droplet_and_disc(gap, 0.2), droplet_and_walls(None, gap, 4.0, 0.2)] {
            let matrix = mobility(&mut channel(4.0, 0.1), &mut markers);
            let [largest, difference] = asymmetry(&matrix);
            assert!(difference < 1e-13 * largest, "{gap}: {difference:e} of {largest:e}");
            assert!(eigenvalues_are_above(-1e-7 * largest, matrix), "{gap}");
        }
    }
}

fn forces(markers: &mut Markers) {
    for (k, force) in markers.forces_mut().iter_mut().enumerate() {
        *force = Vec2::new((0.3 * k as f64).sin(), (0.2 * k as f64).cos());
    }
}

/// With what is around and inside a droplet of another viscosity.
#[test]
fn the_mobility_is_symmetric_for_any_viscosities() {
    for inside in [0.2, 20.0, 200.0] {
        let mut nucleus = droplet(Some(inside));
        push_disc(&mut nucleus, Vec2::new(0.3, 0.1), 0.5, 0.2);
        nucleus.set_viscosity_outside(1, Some(inside)).unwrap();
        for (what, mut markers) in [("walls", droplet_and_walls(Some(inside), 0.1, 4.0, 0.2)), ("nucleus", nucleus)] {
            let matrix = mobility(&mut channel(4.0, 0.1), &mut markers);
            let [largest, difference] = asymmetry(&matrix);
            println!("{what} {inside}: {:e}", difference / largest);
            assert!(difference < 1e-6 * largest, "{what}, {inside}: {difference:e} of {largest:e}");
            assert!(eigenvalues_are_above(-1e-6 * largest, matrix), "{what}, {inside}");
        }
    }
}

#[test]
fn interfaces_beside_points_move_as_without_a_grid() {
    for inside in [2.0, 0.1, 300.0] {
        let mut markers = droplet(Some(inside));
        markers.push_group(1, MarkerKind::Points);
        markers.positions_mut()[NODES] = Vec2::new(0.0, 2.0);
        forces(&mut markers);
        markers.forces_mut()[NODES] *= 1e-12;
        let mut flow = channel(4.0, 0.2);
        flow.velocities(&mut markers).unwrap();
        let region = Region::Channel { length: 4.0, width: HEIGHT, drive: Drive::default() };
        let settings = Settings { nodes: NODES, tolerance: TOLERANCE, ..Settings::default() };
        let mut exact = InterfaceFlow::new(region, 2.0, settings).unwrap();
        let (positions, forces) = (&markers.positions()[..NODES], &markers.forces()[..NODES]);
        exact.load([Interface::closed(positions, forces, [inside, 2.0])].into_iter()).unwrap();
        exact.solve().unwrap();
        let mut expected = vec![Vec2::ZERO; NODES];
        exact.velocities(0, &mut expected).unwrap();
        let errors = markers.velocities().iter().zip(expected).map(|(found, expected)| (found - expected).length());
        let error = errors.fold(0.0, f64::max);
        println!("{inside}: {error:e}");
        assert_eq!(flow.work().stokes_solves, 2);
        assert!(error < 1e-7, "{inside}: {error:e}");
    }
}

/// Forces on a surface inside a droplet move all of it as those of an interface there, with the viscosity inside on
/// either side, move it without a grid.
#[test]
fn forces_inside_another_viscosity_count_by_it() {
    for inside in [0.2, 20.0] {
        let mut markers = droplet(Some(inside));
        push(&mut markers, closed(NODES), &circle(Vec2::new(0.3, 0.1), 0.5, NODES));
        markers.set_viscosity_outside(1, Some(inside)).unwrap();
        let [positions, forces, _] = markers.lists_mut();
        for (force, x) in forces.iter_mut().zip(positions).skip(NODES) {
            *force = 0.1 * Vec2::new(x.x * x.y, x.x + 1.0);
        }
        channel(4.0, 0.1).velocities(&mut markers).unwrap();
        let region = Region::Channel { length: 4.0, width: HEIGHT, drive: Drive::default() };
        let settings = Settings { nodes: NODES, tolerance: TOLERANCE, ..Settings::default() };
        let mut exact = InterfaceFlow::new(region, 2.0, settings).unwrap();
        let curve = |part: std::ops::Range<usize>, viscosities| {
            Interface::closed(&markers.positions()[part.clone()], &markers.forces()[part], viscosities)
        };
        let curves = [curve(0..NODES, [inside, 2.0]), curve(NODES..2 * NODES, [inside; 2])];
        exact.load(curves.into_iter()).unwrap();
        exact.solve().unwrap();
        let mut expected = vec![Vec2::ZERO; 2 * NODES];
        for (number, velocities) in expected.chunks_exact_mut(NODES).enumerate() {
            exact.velocities(number, velocities).unwrap();
        }
        let largest = expected.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
        let errors = markers.velocities().iter().zip(&expected).map(|(found, expected)| (found - *expected).length());
        let error = errors.fold(0.0, f64::max) / largest;
        println!("{inside}: {error:e} of {largest:e}");
        assert!(error < 1e-6, "{inside}: {error:e}");
    }
}

/// A uniform force along the normal moves nothing: those that take the place of a viscosity have none, which would be
/// a pressure inside.
#[test]
fn forces_for_another_viscosity_do_not_press() {
    for inside in [0.2, 20.0] {
        let mut markers = droplet(Some(inside));
        push_disc(&mut markers, Vec2::new(0.3, 1.8), 0.5, 0.2);
        forces(&mut markers);
        let mut flow = channel(4.0, 0.2);
        flow.velocities(&mut markers).unwrap();
        let parts = || flow.contrast.unknown.iter().zip(&flow.contrast.normals).map(|(force, normal)| force * normal);
        let [sum, size] = [parts().sum::<f64>(), parts().map(f64::abs).sum()];
        println!("{inside}: {sum:e} of {size:e}");
        assert!(sum.abs() < 1e-7 * size, "{inside}: {sum:e} of {size:e}");
    }
}

/// Each evaluation beside inner points solves twice on the grid, with the transforms that the solver alone counts.
#[test]
fn an_evaluation_counts_the_transforms_of_its_two_solutions() {
    let mut flow = channel(4.0, 0.2);
    let (density, mut velocity) = (StaggeredField::zeros(*flow.grid()), StaggeredField::zeros(*flow.grid()));
    let mut alone = flow.solver.clone();
    alone.solve(&density, &mut velocity).unwrap();
    let one = alone.work().forward_transforms + alone.work().inverse_transforms;
    let mut markers = droplet_and_disc(0.3, 0.2);
    forces(&mut markers);
    for evaluations in 1..4 {
        flow.velocities(&mut markers).unwrap();
        let work = flow.work();
        assert_eq!([work.evaluations, work.stokes_solves], [evaluations, 2 * evaluations]);
        assert!(one > 0 && work.transforms == 2 * evaluations * one, "{} of {one}", work.transforms);
    }
}

/// Forces that are not found within the iterations are an error with its numbers, which leaves nothing behind.
#[test]
fn forces_that_are_not_found_are_an_error() {
    let mut markers = droplet(Some(20.0));
    push_disc(&mut markers, Vec2::new(0.3, 1.8), 0.5, 0.2);
    forces(&mut markers);
    let mut flow = channel(4.0, 0.2);
    flow.contrast.most_iterations = 3;
    let error = flow.velocities(&mut markers).unwrap_err();
    let FlowError::NoConvergence { what, iterations, residual, tolerance } = error else { panic!("{error}") };
    assert_eq!(what, "the flow around interfaces to another viscosity");
    assert_eq!((iterations, tolerance), (3, TOLERANCE));
    assert!(residual > 2.0 * TOLERANCE && residual < 1.0, "{residual:e}");
    flow.contrast.most_iterations = 100;
    let found = flow.velocities(&mut markers).unwrap();
    assert!(found.iterations > 3 && found.residual <= 2.0 * TOLERANCE, "{found:?}");
}

/// The flow of layers at inner points away from them is of second order, inside and outside; so are samples.
#[test]
fn inner_points_move_with_the_flow_of_the_layers() {
    let places = [Vec2::new(0.2, 2.1), Vec2::new(-0.3, 1.9), Vec2::new(0.1, 0.2)];
    for inside in [2.0, 40.0] {
        let errors = [0.2, 0.1, 0.05].map(|h| {
            let mut markers = droplet(Some(inside));
            let [positions, forces, _] = markers.lists_mut();
            for (force, x) in forces.iter_mut().zip(positions) {
                *force = 0.1 * Vec2::new(x.x * x.y, x.x + 1.0);
            }
            markers.push_group(places.len(), MarkerKind::Points);
            markers.positions_mut()[NODES..].copy_from_slice(&places);
            // However little: forces on points need the grid.
            markers.forces_mut()[NODES] = Vec2::splat(1e-14);
            let mut flow = channel(4.0, h);
            flow.velocities(&mut markers).unwrap();
            let mut exact = [FlowSample::default(); 3];
            let region = Region::Channel { length: 4.0, width: HEIGHT, drive: Drive::default() };
            let settings = Settings { nodes: NODES, tolerance: TOLERANCE, ..Settings::default() };
            let mut alone = InterfaceFlow::new(region, 2.0, settings).unwrap();
            let interface = Interface::closed(&markers.positions()[..NODES], &markers.forces()[..NODES], [inside, 2.0]);
            alone.load([interface].into_iter()).unwrap();
            alone.solve().unwrap();
            alone.sample(&places, &mut exact).unwrap();
            let mut samples = [FlowSample::default(); 3];
            flow.sample(&markers, &places, &mut samples).unwrap();
            let speed = exact[0].velocity.length();
            let error = |k: usize| {
                let v = exact[k].velocity;
                (markers.velocities()[NODES + k] - v).length().max((samples[k].velocity - v).length()) / speed
            };
            let drop = |list: &[FlowSample; 3]| list[2].pressure - list[0].pressure;
            [(0..3).map(error).fold(0.0, f64::max), (drop(&samples) / drop(&exact) - 1.0).abs()]
        });
        println!("{inside}: {errors:?}");
        assert!(errors[2][0] < 2e-3 && (errors[0][0] / errors[2][0]).log2() > 2.0 * 1.8, "{inside}: {errors:?}");
        assert!(errors[2][1] < 1e-2, "{inside}: {errors:?}");
    }
}

#[test]
fn forces_inside_leave_the_area_of_a_solid() {
    let mut markers = droplet_and_disc(0.1, 0.2);
    let surface = NODES..NODES + markers.groups()[1].surfaces[0].points.len();
    forces(&mut markers);
    markers.forces_mut()[..surface.end].fill(Vec2::ZERO);
    channel(4.0, 0.1).velocities(&mut markers).unwrap();
    let (positions, velocities) = (&markers.positions()[surface.clone()], &markers.velocities()[surface]);
    let centre = Vec2::new(0.3, 1.8);
    let flux: f64 = positions.iter().zip(velocities).map(|(x, v)| (x - centre).dot(*v)).sum();
    let sizes: f64 = positions.iter().zip(velocities).map(|(x, v)| (x - centre).length() * v.length()).sum();
    assert!(flux.abs() < 1e-5 * sizes, "{flux:e} of {sizes:e}");
}

#[test]
fn a_box_has_them_too() {
    let solver = PeriodicStokes::new(Grid::periodic(40, 60, 0.1).unwrap(), 2.0).unwrap();
    let mut flow = ImmersedLayers::new(solver, BSpline::<4>, NODES, TOLERANCE).unwrap();
    let mut markers = droplet_and_disc(0.1, 0.2);
    let [largest, difference] = asymmetry(&mobility(&mut flow, &mut markers));
    assert!(difference < 1e-13 * largest, "{difference:e} of {largest:e}");
}

#[test]
fn what_has_no_layers_is_refused() {
    let mut flow = channel(4.0, 0.2);
    let mut refused = |kind: MarkerKind, count: usize, surface: usize| {
        let mut markers = Markers::new();
        markers.push_body(count, kind, if surface > 0 { vec![closed(surface)] } else { Vec::new() });
        markers.positions_mut().copy_from_slice(&circle(Vec2::ZERO, 1.0, count));
        flow.velocities(&mut markers).unwrap_err().to_string()
    };
    let few = refused(MarkerKind::Interface { viscosity_inside: None }, 32, 0);
    assert!(few.contains("curve of body 0 has 32 points. Use a number from 64"), "{few}");
    let few = refused(MarkerKind::Points, 20, 10);
    assert!(few.contains("curve of body 0 has 10 points. Use a number from 16 to 4096"), "{few}");
    let mut beyond = droplet_and_disc(0.3, 0.2);
    beyond.positions_mut()[NODES + 50].y = 4.0;
    let error = channel(4.0, 0.2).velocities(&mut beyond).unwrap_err();
    assert!(matches!(error, FlowError::BeyondWall { body: 1, marker: 50, .. }), "{error}");
    let moved = Grid::channel(20, 20, 0.2).unwrap().with_origin([0.0; 2]).unwrap();
    let solver = ChannelStokes::new(moved, 1.0).unwrap();
    let error = ImmersedLayers::new(solver, BSpline::<4>, NODES, TOLERANCE).unwrap_err();
    assert!(error.to_string().contains("middle"), "{error}");
}

/// A surface that names a marker which its body does not have is refused.
#[test]
fn surfaces_name_markers_of_their_body() {
    let velocities = |first: usize| {
        let mut markers = droplet(None);
        let points: Vec<Vec2> = circle(Vec2::new(0.3, 1.9), 0.7, 64);
        let surface = SurfaceCurve::through(first..first + 64, 0);
        push(&mut markers, surface, &points);
        // Another body follows, whose first marker the surface must not take.
        push(&mut markers, closed(64), &circle(Vec2::new(0.3, -1.9), 0.7, 64));
        channel(6.0, 0.25).velocities(&mut markers).map(drop)
    };
    assert!(velocities(0).is_ok());
    let error = velocities(1).unwrap_err().to_string();
    assert!(error.contains("the markers of a solid with a surface"), "{error}");
}
