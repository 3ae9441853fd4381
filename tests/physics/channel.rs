//! Channels with no-slip walls against boundary-integral values.

use motile::base::{Drive, FlowSample, Vec2};
use motile::ib_core::{BSpline, Kernel};
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::setup::{DropletSetup, Setup};
use motile::stokes_grid::{StokesSolver, Wall, WallMotion, flux, wall_shear_stress};
use motile_tests::validation::fixed_shapes::{Errors, Shape, couple};
use motile_tests::validation::scene::{channel_solver, on_grid, open_channel};
use motile_tests::validation::swimmers::{speeds, steady};
use motile_tests::validation::{Case, Reference, StudyError, order};

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];

/// Name of a drive in the reference tables.
fn convention(drive: Drive) -> &'static str {
    if drive == Drive::ZeroFlux { "q0" } else { "p0" }
}

/// Largest error of 4 pi eta times the velocity around point forces (period 4, width 2), over the points of the table
/// that are at least 0.5 from the force; the velocities there are of order one.
fn point_forces<K: Kernel>(kernel: &K, h: f64, drive: Drive) -> Result<f64, StudyError> {
    let table = Reference::read("channel_greens_function")?.select("conv", convention(drive));
    let column = |name: &str| table.column(name);
    let (x, y, x0, y0) = (column("x")?, column("y")?, column("x0")?, column("y0")?);
    let expected = [[column("Gxx")?, column("Gyx")?], [column("Gxy")?, column("Gyy")?]];
    let mut flow = couple(channel_solver([4.0, 2.0], h, drive, 1.0)?, kernel, false);
    let mut worst: f64 = 0.0;
    for i in 0..x.len() {
        let (from, to) = (Vec2::new(x0[i], y0[i]), Vec2::new(x[i], y[i]));
        if (to - from).length() < 0.5 {
            continue;
        }
        for (direction, force) in [Vec2::X, Vec2::Y].into_iter().enumerate() {
            // A second marker without force takes the velocity by the kernel's own interpolation.
            let mut markers = Markers::new();
            markers.push_group(2, MarkerKind::Points);
            markers.positions_mut().copy_from_slice(&[from, to]);
            markers.forces_mut()[0] = force;
            flow.velocities(&mut markers)?;
            let velocity = 4.0 * std::f64::consts::PI * markers.velocities()[1];
            let [ex, ey] = &expected[direction];
            worst = worst.max((velocity - Vec2::new(ex[i], ey[i])).length());
        }
    }
    Ok(worst)
}

/// Errors of a fixed shape in a channel (period 6, width 3), relative to the largest velocity or value.
#[derive(Debug, Clone, Copy, PartialEq)]
struct ShapeErrors {
    /// At the markers.
    markers: Errors,
    /// Largest at the points off the interface that are further than 3 h from it, and half a width at most from a wall.
    field: f64,
    /// Of the flux (zero net gradient) or of the mean pressure gradient (zero flux).
    drive: f64,
    /// Of the sum of the wall shear stress at the top.
    wall_shear: f64,
}

/// The errors of a shape with its centre at the height `height` (0, or 0.3 for the circle).
fn fixed_shape<K: Kernel>(
    kernel: &K,
    corrected: bool,
    h: f64,
    drive: Drive,
    case: Case,
    height: f64,
) -> Result<ShapeErrors, StudyError> {
    let rows = |file| -> Result<Reference, StudyError> {
        let height = if height == 0.0 { "0.0" } else { "0.3" };
        Ok(case.select(Reference::read(file)?).select("conv", convention(drive)).select("y0", height))
    };
    let mut flow = couple(channel_solver([6.0, 3.0], h, drive, 1.0)?, kernel, corrected);
    let mut shape = Shape::new(case, height, h)?;
    let report = flow.velocities(&mut shape.markers)?;
    let velocities = rows("channel_fixed_shape_velocities")?;
    let markers = shape.compare(&velocities.clone().select("kind", "marker"))?;

    let global = rows("channel_fixed_shape_global")?;
    let drive_error = if drive == Drive::ZeroFlux {
        let exact = global.value("mean_dpdx")?;
        (report.mean_pressure_gradient[0] - exact) / exact.abs().max(1e-3)
    } else {
        let exact = global.value("flux")?;
        (flux(flow.velocity_field()) - exact) / exact.abs().max(1e-3)
    };
    let grid = *flow.grid();
    let mut shear = vec![0.0; grid.nx()];
    let walls = WallMotion::uniform(&grid, 0.0, 0.0)?;
    wall_shear_stress(flow.velocity_field(), 1.0, &walls, Wall::Top, &mut shear)?;
    let exact = global.value("wall_shear_top_sum")?;
    let wall_shear = (shear.iter().sum::<f64>() * h - exact) / exact.abs().max(0.1);

    let field = velocities.select("kind", "field");
    let (x, y, vx, vy) = (field.column("x")?, field.column("y")?, field.column("vx")?, field.column("vy")?);
    let points: Vec<Vec2> = x.iter().zip(&y).map(|(x, y)| Vec2::new(*x, *y)).collect();
    let mut samples = vec![FlowSample::default(); points.len()];
    flow.sample(&shape.markers, &points, &mut samples)?;
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for (i, (point, sample)) in points.iter().zip(&samples).enumerate() {
        let distance =
            shape.markers.positions().iter().map(|marker| (marker - point).length()).fold(f64::INFINITY, f64::min);
        let exact = Vec2::new(vx[i], vy[i]);
        largest = largest.max(exact.length());
        if distance > 3.0 * h {
            worst = worst.max((sample.velocity - exact).length());
        }
    }
    Ok(ShapeErrors { markers, field: worst / largest, drive: drive_error, wall_shear })
}

/// The drives of the reference tables, with their names.
fn drives() -> [(&'static str, Drive); 2] {
    [("zero gradient", Drive::ZeroGradient), ("zero flux", Drive::ZeroFlux)]
}

#[test]
fn point_forces_are_second_order() {
    for (name, drive) in drives() {
        let errors: Vec<f64> = SPACINGS.iter().map(|&h| point_forces(&BSpline::<4>, h, drive).unwrap()).collect();
        assert!((order(&SPACINGS, &errors) - 2.0).abs() < 0.01, "{name}: {errors:?}");
        assert!(errors[1] < 6e-3, "{name}: {errors:?}");
    }
}

#[test]
fn fixed_shapes_are_second_order() {
    let kernel = BSpline::<4>;
    for (name, drive) in drives() {
        for (case, height) in
            [(Case::Circle, 0.0), (Case::Circle, 0.3), (Case::EllipseUniform, 0.0), (Case::EllipseGradient, 0.0)]
        {
            let rows = SPACINGS.map(|h| fixed_shape(&kernel, true, h, drive, case, height).unwrap());
            let what = format!("{name}, {} at {height}: {rows:?}", case.name());
            let markers: Vec<f64> = rows.iter().map(|row| row.markers.maximum).collect();
            let field: Vec<f64> = rows.iter().map(|row| row.field).collect();
            assert!(order(&SPACINGS, &markers) > 1.8, "{what}");
            assert!(order(&SPACINGS, &field) > 1.8, "{what}");
            assert!(rows[1].markers.maximum < 3e-3 && rows[1].drive.abs() < 1e-3, "{what}");
            assert!(rows[1].wall_shear.abs() < 2e-3, "{what}");
        }
    }
}

/// Activity -1 is above the threshold in a box but not in a channel of its own width (Cowley section 3.1).
#[test]
fn a_weak_swimmer_comes_to_rest() {
    let droplets = vec![DropletSetup::active(-1.0)];
    let late = speeds(&Setup { region: open_channel(12.0, 2.0), droplets, ..on_grid(0.1) }, &[300.0]).unwrap();
    assert!(late[0] < 1e-4, "{late:?}");
}

/// The droplet as wide as the channel starts in contact with both walls and opens a film of 0.09 R0.
#[test]
fn steady_swimmers() {
    for (width, [speed, gap, flux], time) in [(2.0, [0.005, 0.003, 0.004], 120.0), (3.0, [0.002, 0.007, 0.008], 60.0)] {
        let errors = steady(&Setup { region: open_channel(12.0, width), ..on_grid(0.05) }, time).unwrap();
        assert!(errors.speed.abs() < speed, "{errors:?}");
        assert!(errors.gap.unwrap().abs() < gap && errors.flux.unwrap().abs() < flux, "{errors:?}");
        assert!(errors.area_change.abs() < 1e-5 && errors.particle_change.abs() < 1e-12, "{errors:?}");
    }
}

#[test]
fn solver_has_the_drive() {
    let solver = channel_solver([4.0, 2.0], 0.25, Drive::ZeroFlux, 1.0).unwrap();
    assert_eq!(solver.drive(), Drive::ZeroFlux);
    assert!(solver.grid().has_walls());
}
