//! A droplet ten times as viscous as the exterior fluid, against tables.

use motile::active_interface::{
    Convention,
    observables::{Frame, force_moments},
};
use motile::ib_core::{CubicQuadratic, FlowSample, Hydrodynamics, Vec2};
use motile::stokes_grid::{Grid, PeriodicStokes};

use crate::validation::fixed_shapes::{Case, Shape, couple};
use crate::validation::{Reference, ReferenceFile, StudyError};

/// Largest errors on a fixed shape of the tables.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RatioTen {
    /// Marker velocities, relative to the largest.
    pub markers: f64,
    /// Velocities inside the droplet, relative to the largest marker velocity.
    pub inside: f64,
    /// The same outside.
    pub outside: f64,
    /// Second moments (far-field convention), relative to the largest.
    pub second: f64,
    /// Third moments, relative to the largest; not a number where symmetry makes all of them vanish.
    pub third: f64,
}

/// The errors with grid spacing `h` in a 6 x 6 box.
///
/// # Errors
/// A spacing that does not divide the box, and what a setup can fail with.
pub fn ratio_ten(case: Case, h: f64) -> Result<RatioTen, StudyError> {
    let cells = (6.0 / h).round() as usize;
    let grid = Grid::periodic(cells, cells, h)?.with_origin([-3.0; 2])?;
    let mut flow = couple(PeriodicStokes::new(grid, 1.0)?, &CubicQuadratic::default(), true);
    let mut shape = Shape::new(case, 0.0, h, Some(10.0))?;
    flow.velocities(&mut shape.markers)?;
    let table = case.select(Reference::read(ReferenceFile::FixedShapesRatio10)?).select("L", "6");
    let markers = shape.compare(&table.clone().select("kind", "marker"))?.maximum;
    let on_markers = table.clone().select("kind", "marker");
    let speeds = on_markers.column("vx")?.into_iter().zip(on_markers.column("vy")?);
    let largest = speeds.map(|(x, y)| x.hypot(y)).fold(0.0, f64::max);

    let field = table.select("kind", "field");
    let places: Vec<Vec2> =
        field.column("x")?.into_iter().zip(field.column("y")?).map(|(x, y)| Vec2::new(x, y)).collect();
    let exact: Vec<Vec2> =
        field.column("vx")?.into_iter().zip(field.column("vy")?).map(|(x, y)| Vec2::new(x, y)).collect();
    let mut found = vec![FlowSample::default(); places.len()];
    flow.sample(&shape.markers, &places, &mut found)?;
    let (mut inside, mut outside) = (0.0_f64, 0.0_f64);
    for ((place, exact), found) in places.iter().zip(&exact).zip(&found) {
        let error = (found.velocity - exact).length() / largest;
        let class = if case.contains(*place) { &mut inside } else { &mut outside };
        *class = class.max(error);
    }

    let table =
        case.select(Reference::read(ReferenceFile::MomentsRatio10)?).select("L", "6").select("conv", "farfield");
    let frame = Frame::new(Vec2::ZERO, 0.0)?;
    let state = &shape.markers;
    let viscosities = [10.0, 1.0];
    let moments = force_moments(
        state.positions(),
        state.forces(),
        state.velocities(),
        viscosities,
        Convention::FarField,
        &frame,
    )?;
    let (mut second, mut third) = (Vec::new(), Vec::new());
    for (i, a) in ["x", "y"].into_iter().enumerate() {
        for (j, b) in ["x", "y"].into_iter().enumerate() {
            second.push((moments.dipole[i][j], table.value(&format!("F2{a}{b}"))?));
            for (k, c) in ["x", "y"].into_iter().enumerate() {
                third.push((moments.quadrupole[i][j][k], table.value(&format!("F3{a}{b}{c}"))?));
            }
        }
    }
    let worst = |pairs: &[(f64, f64)]| {
        let largest = pairs.iter().fold(0.0_f64, |most, (_, exact)| most.max(exact.abs()));
        let error = pairs.iter().fold(0.0_f64, |most, (found, exact)| most.max((found - exact).abs()));
        if largest > 1e-9 { error / largest } else { f64::NAN }
    };
    Ok(RatioTen { markers, inside, outside, second: worst(&second), third: worst(&third) })
}
