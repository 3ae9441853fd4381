//! Interfaces between different viscosities on fixed shapes, against boundary integrals.

use std::f64::consts::TAU;

use motile::active_interface::Curve;
use motile::boundary_integral::{BoundaryIntegral, Channel, FluidDomain, PeriodicBox, Settings};
use motile::ib_core::{
    CubicQuadratic, FlowSample, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, Peskin4, SmearedContrast, Vec2,
};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes};

use crate::StudyError;

/// An ellipse with a tension along it and a viscosity inside, in surroundings of viscosity one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Droplet {
    /// Centre (length).
    pub centre: [f64; 2],
    /// Half axes along x and y (length).
    pub axes: [f64; 2],
    /// The tension is `1 + 0.5 cos(mode t)`, t the parameter.
    pub mode: u32,
    /// Viscosity inside, that of the surroundings being one.
    pub ratio: f64,
}

impl Droplet {
    /// The unit circle with the tension `1 + 0.5 cos(mode t)` at the origin.
    #[must_use]
    pub fn circle(mode: u32, ratio: f64) -> Self {
        Self { centre: [0.0; 2], axes: [1.0; 2], mode, ratio }
    }

    /// The ellipse (1.3 cos t, sin t/1.3) with the tension `1 + 0.5 cos t` at the origin.
    #[must_use]
    pub fn ellipse(ratio: f64) -> Self {
        Self { axes: [1.3, 1.0 / 1.3], ..Self::circle(1, ratio) }
    }

    /// The same moved.
    #[must_use]
    pub fn at(self, x: f64, y: f64) -> Self {
        Self { centre: [x, y], ..self }
    }

    fn kind(&self, even: bool) -> MarkerKind {
        let viscosity_inside = (self.ratio != 1.0).then_some(self.ratio);
        if even { MarkerKind::Interface { viscosity_inside } } else { MarkerKind::UnevenInterface { viscosity_inside } }
    }

    fn point(&self, t: f64) -> Vec2 {
        Vec2::new(self.centre[0] + self.axes[0] * t.cos(), self.centre[1] + self.axes[1] * t.sin())
    }

    fn parameter(&self, point: Vec2) -> f64 {
        ((point.y - self.centre[1]) / self.axes[1]).atan2((point.x - self.centre[0]) / self.axes[0])
    }

    fn tension(&self, t: f64) -> f64 {
        1.0 + 0.5 * (f64::from(self.mode) * t).cos()
    }

    /// Derivative of tension times tangent by the parameter.
    fn force(&self, t: f64) -> Vec2 {
        let [a, b] = self.axes;
        let (sin, cos) = t.sin_cos();
        let tangent = Vec2::new(-a * sin, b * cos);
        let speed = tangent.norm();
        let tau = tangent / speed;
        let mode = f64::from(self.mode);
        let slope = -0.5 * mode * (mode * t).sin();
        slope * tau + self.tension(t) * a * b / (speed * speed) * Vec2::new(-tau.y, tau.x)
    }

    /// Equally spaced markers, about `spacing` apart.
    fn push_even(&self, spacing: f64, markers: &mut Markers) -> Result<(), StudyError> {
        let [a, b] = self.axes;
        let curve = if a == b { Curve::circle(a)? } else { Curve::ellipse(a, b)? };
        let curve = curve.translated(Vec2::new(self.centre[0], self.centre[1]));
        let count = (curve.perimeter() / spacing).round() as usize;
        let start = markers.len();
        markers.push_group(count, self.kind(true));
        markers.positions[start..].copy_from_slice(&curve.markers(count)?);
        for k in 0..count {
            let (here, next) = (markers.positions[start + k], markers.positions[start + (k + 1) % count]);
            let pull = self.tension(self.parameter(0.5 * (here + next))) * (next - here).normalize();
            markers.forces[start + k] += pull;
            markers.forces[start + (k + 1) % count] -= pull;
        }
        Ok(())
    }

    /// Markers at equal steps of the parameter with exact forces.
    fn push_exact(&self, count: usize, markers: &mut Markers) {
        let start = markers.len();
        markers.push_group(count, self.kind(false));
        for k in 0..count {
            let t = TAU * k as f64 / count as f64;
            markers.positions[start + k] = self.point(t);
            markers.forces[start + k] = self.force(t) * (TAU / count as f64);
        }
    }
}

/// Where the droplets are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Region {
    /// A square box (length).
    Box(f64),
    /// A channel of a length and a width, the centre line at y = 0.
    Channel(f64, f64),
}

/// Errors of one droplet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Velocity of the centroid: the distance from the exact one, relative to that or to the fastest marker where the droplet does not
    /// move.
    pub speed: f64,
    /// Root mean square over the markers relative to the fastest one.
    pub rms: f64,
    /// Largest, relative to the same.
    pub maximum: f64,
}

/// Exact velocities of droplets.
#[derive(Debug)]
pub struct Exact {
    droplets: Vec<Droplet>,
    region: Region,
    /// Velocities at equal steps of the parameter.
    velocities: Vec<Vec<Vec2>>,
    centroids: Vec<Vec2>,
}

impl Exact {
    /// By boundary integrals with `nodes` nodes a droplet.
    ///
    /// # Errors
    /// What the solver can fail with.
    pub fn new(region: Region, droplets: &[Droplet], nodes: usize) -> Result<Self, StudyError> {
        let mut markers = Markers::new();
        droplets.iter().for_each(|droplet| droplet.push_exact(nodes, &mut markers));
        let settings = Settings { nodes, tolerance: 1e-10, ..Settings::default() };
        match region {
            Region::Box(side) => solve(PeriodicBox::new(side, side)?, settings, &mut markers)?,
            Region::Channel(length, width) => solve(Channel::new(length, width)?, settings, &mut markers)?,
        }
        let velocities: Vec<Vec<Vec2>> = markers.velocities.chunks(nodes).map(<[Vec2]>::to_vec).collect();
        let centroids = droplets
            .iter()
            .zip(&velocities)
            .map(|(droplet, velocities)| {
                let mut sum = Vec2::zeros();
                for (k, v) in velocities.iter().enumerate() {
                    let t = TAU * k as f64 / nodes as f64;
                    let [a, b] = droplet.axes;
                    let normal = Vec2::new(b * t.cos(), a * t.sin());
                    sum += v.dot(&normal) * (droplet.point(t) - Vec2::from(droplet.centre)) * (TAU / nodes as f64);
                }
                sum / (0.5 * TAU * droplet.axes[0] * droplet.axes[1])
            })
            .collect();
        Ok(Self { droplets: droplets.to_vec(), region, velocities, centroids })
    }

    /// Velocities of a droplet at equal steps of the parameter.
    #[must_use]
    pub fn velocities(&self, droplet: usize) -> &[Vec2] {
        &self.velocities[droplet]
    }

    /// Velocity of the centroid of a droplet.
    #[must_use]
    pub fn centroid_velocity(&self, droplet: usize) -> Vec2 {
        self.centroids[droplet]
    }

    /// The errors of the immersed boundary method with grid spacing `h` and markers h/2 apart, droplet by droplet.
    ///
    /// # Errors
    /// A spacing that does not divide the region; what the solver can fail with.
    pub fn errors(&self, h: f64) -> Result<Vec<Errors>, StudyError> {
        self.compare(coupled(self.region, h)?, h)
    }

    /// The errors of the thesis' way, a viscosity smeared over Peskin's kernel, without a mobility correction.
    ///
    /// # Errors
    /// As [`Exact::errors`].
    pub fn smeared_errors(&self, h: f64) -> Result<Vec<Errors>, StudyError> {
        let cells = |length: f64| (length / h).round() as usize;
        let flow: Box<dyn Hydrodynamics> = match self.region {
            Region::Box(side) => {
                let grid = Grid::periodic(cells(side), cells(side), h)?;
                Box::new(SmearedContrast::new(PeriodicStokes::new(grid, 1.0)?, Peskin4)?)
            }
            Region::Channel(length, width) => {
                let grid = Grid::channel(cells(length), cells(width), h)?;
                Box::new(SmearedContrast::new(ChannelStokes::new(grid, 1.0)?, Peskin4)?)
            }
        };
        self.compare(flow, h)
    }

    fn compare(&self, mut flow: Box<dyn Hydrodynamics>, h: f64) -> Result<Vec<Errors>, StudyError> {
        let mut markers = Markers::new();
        for droplet in &self.droplets {
            droplet.push_even(0.5 * h, &mut markers)?;
        }
        flow.velocities(&mut markers)?;
        let mut all = Vec::new();
        for (index, group) in markers.groups().iter().enumerate() {
            let (droplet, range) = (&self.droplets[index], group.range.clone());
            let (positions, velocities) = (&markers.positions[range.clone()], &markers.velocities[range]);
            let exact = &self.velocities[index];
            let largest = exact.iter().map(Vec2::norm).fold(0.0, f64::max);
            let (mut sum, mut maximum) = (0.0, 0.0_f64);
            for (position, velocity) in positions.iter().zip(velocities) {
                let error = (velocity - interpolate(exact, droplet.parameter(*position))).norm() / largest;
                sum += error * error;
                maximum = maximum.max(error);
            }
            let difference = centroid_velocity(positions, velocities) - self.centroids[index];
            let norm = self.centroids[index].norm();
            let speed = difference.norm() / if norm > 1e-3 * largest { norm } else { largest };
            all.push(Errors { speed, rms: (sum / positions.len() as f64).sqrt(), maximum });
        }
        Ok(all)
    }
}

/// The immersed boundary method in a region, viscosity one.
fn coupled(region: Region, h: f64) -> Result<Box<dyn Hydrodynamics>, StudyError> {
    let cells = |length: f64| (length / h).round() as usize;
    let kernel = CubicQuadratic::default();
    Ok(match region {
        Region::Box(side) => {
            let grid = Grid::periodic(cells(side), cells(side), h)?.with_origin([-0.5 * side; 2])?;
            Box::new(ImmersedBoundary::new(PeriodicStokes::new(grid, 1.0)?, kernel))
        }
        Region::Channel(length, width) => {
            let grid = Grid::channel(cells(length), cells(width), h)?;
            let grid = grid.with_origin([-0.5 * length, -0.5 * width])?;
            Box::new(ImmersedBoundary::new(ChannelStokes::new(grid, 1.0)?, kernel))
        }
    })
}

fn solve<D: FluidDomain>(domain: D, settings: Settings, markers: &mut Markers) -> Result<(), StudyError> {
    BoundaryIntegral::new(domain, 1.0, settings)?.velocities(markers)?;
    Ok(())
}

/// Velocity of the centroid of a closed polygon from the flux through its sides.
fn centroid_velocity(positions: &[Vec2], velocities: &[Vec2]) -> Vec2 {
    let count = positions.len();
    let (mut sum, mut area) = (Vec2::zeros(), 0.0);
    let middle = positions.iter().sum::<Vec2>() / count as f64;
    for k in 0..count {
        let d = 0.5 * (positions[(k + 1) % count] - positions[(k + count - 1) % count]);
        let normal = Vec2::new(d.y, -d.x);
        let relative = positions[k] - middle;
        sum += velocities[k].dot(&normal) * relative;
        area += 0.5 * relative.dot(&normal);
    }
    sum / area
}

/// Trigonometric interpolation of values at equal steps of a parameter.
fn interpolate(values: &[Vec2], t: f64) -> Vec2 {
    let count = values.len();
    let mut sum = Vec2::zeros();
    for (k, value) in values.iter().enumerate() {
        let half = 0.5 * (t - TAU * k as f64 / count as f64);
        // The kernel of Dirichlet for an even number of values.
        let weight =
            if half.sin().abs() < 1e-12 { 1.0 } else { (count as f64 * half).sin() / (half.tan() * count as f64) };
        sum += weight * value;
    }
    sum
}

/// Errors of the flow away from the markers of a single droplet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FieldErrors {
    /// Velocity, relative to the fastest marker.
    pub velocity: f64,
    /// Velocity gradient, relative to the fastest marker over the unit of length.
    pub gradient: f64,
    /// Pressure, relative to the range of the sampled pressures.
    pub pressure: f64,
}

/// Largest errors of sampled flows at points of a droplet's surroundings that are nearer to the interface than 3h, on the
/// inside and on the outside, and farther away, inside and outside.
///
/// # Errors
/// A spacing that does not divide the region; what the solvers can fail with.
pub fn field_errors(region: Region, droplet: &Droplet, h: f64) -> Result<[FieldErrors; 4], StudyError> {
    let mut points = Vec::new();
    for k in 0..40 {
        let t = TAU * (f64::from(k) + 0.37) / 40.0;
        let [a, b] = droplet.axes;
        let normal = Vec2::new(b * t.cos(), a * t.sin()).normalize();
        // The golden ratio spreads the distances over both sides.
        let fraction = (f64::from(k) * 0.618_033_988_75).fract();
        let distance = if k % 2 == 0 { 3.0 * h * (2.0 * fraction - 1.0) } else { 1.1 * fraction - 0.5 };
        points.push((droplet.point(t) + distance * normal, distance));
    }
    let places: Vec<Vec2> = points.iter().map(|(point, _)| *point).collect();
    let (mut exact, mut found) = (vec![FlowSample::default(); 40], vec![FlowSample::default(); 40]);
    let mut markers = Markers::new();
    droplet.push_exact(256, &mut markers);
    let settings = Settings { nodes: 256, tolerance: 1e-10, ..Settings::default() };
    match region {
        Region::Box(side) => sample(
            &mut BoundaryIntegral::new(PeriodicBox::new(side, side)?, 1.0, settings)?,
            &mut markers,
            &places,
            &mut exact,
        )?,
        Region::Channel(length, width) => sample(
            &mut BoundaryIntegral::new(Channel::new(length, width)?, 1.0, settings)?,
            &mut markers,
            &places,
            &mut exact,
        )?,
    }
    let largest = markers.velocities.iter().map(Vec2::norm).fold(0.0, f64::max);
    let mut markers = Markers::new();
    droplet.push_even(0.5 * h, &mut markers)?;
    sample(coupled(region, h)?.as_mut(), &mut markers, &places, &mut found)?;
    // Pressures are known up to a constant.
    let count = points.len() as f64;
    let shift = found.iter().zip(&exact).map(|(a, b)| a.pressure - b.pressure).sum::<f64>() / count;
    let pressures = exact.iter().map(|sample| sample.pressure);
    let range = pressures.clone().fold(f64::MIN, f64::max) - pressures.fold(f64::MAX, f64::min);
    let mut errors = [FieldErrors::default(); 4];
    for (((_, distance), found), exact) in points.iter().zip(&found).zip(&exact) {
        let class = usize::from(distance.abs() > 3.0 * h) * 2 + usize::from(*distance > 0.0);
        let error = &mut errors[class];
        error.velocity = error.velocity.max((found.velocity - exact.velocity).norm() / largest);
        for (found, exact) in found.gradient.iter().flatten().zip(exact.gradient.iter().flatten()) {
            error.gradient = error.gradient.max((found - exact).abs() / largest);
        }
        error.pressure = error.pressure.max((found.pressure - exact.pressure - shift).abs() / range);
    }
    Ok(errors)
}

fn sample<H: Hydrodynamics + ?Sized>(
    flow: &mut H,
    markers: &mut Markers,
    points: &[Vec2],
    out: &mut [FlowSample],
) -> Result<(), StudyError> {
    flow.velocities(markers)?;
    flow.sample(markers, points, out)?;
    Ok(())
}
