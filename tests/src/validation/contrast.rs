//! Interfaces between different viscosities on fixed shapes, against boundary integrals.

use std::f64::consts::TAU;

use motile::active_interface::Curve;
use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Hydrodynamics, MarkerKind, Markers};
use motile::setup::{AnyFlow, GridMethod, IntegralMethod, LayersMethod, Method};

use crate::validation::StudyError;
use crate::validation::scene::flow;

/// An ellipse with a tension along it and a viscosity inside, in a fluid of viscosity one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Droplet {
    /// Centre (length).
    pub centre: [f64; 2],
    /// Half axes along x and y (length).
    pub axes: [f64; 2],
    /// The tension is `1 + 0.5 cos(mode t - phase)`, t the parameter.
    pub mode: u32,
    /// The phase (radians).
    pub phase: f64,
    /// Viscosity inside, that of the exterior fluid being one.
    pub ratio: f64,
}

impl Droplet {
    /// The unit circle with the tension `1 + 0.5 cos(mode t)` at the origin.
    #[must_use]
    pub fn circle(mode: u32, ratio: f64) -> Self {
        Self { centre: [0.0; 2], axes: [1.0; 2], mode, phase: 0.0, ratio }
    }

    /// The ellipse (1.3 cos t, sin t/1.3) with the tension `1 + 0.5 cos t` at the origin.
    #[must_use]
    pub fn ellipse(ratio: f64) -> Self {
        Self { axes: [1.3, 1.0 / 1.3], ..Self::circle(1, ratio) }
    }

    /// Copy that is moved.
    #[must_use]
    pub fn at(self, x: f64, y: f64) -> Self {
        Self { centre: [x, y], ..self }
    }

    /// Copy with the phase of the tension.
    #[must_use]
    pub fn turned(self, phase: f64) -> Self {
        Self { phase, ..self }
    }

    fn kind(&self, even: bool) -> MarkerKind {
        let viscosity_inside = (self.ratio != 1.0).then_some(self.ratio);
        if even { MarkerKind::Interface { viscosity_inside } } else { MarkerKind::UnevenInterface { viscosity_inside } }
    }

    /// The place of the interface at a parameter.
    #[must_use]
    pub fn point(&self, t: f64) -> Vec2 {
        Vec2::new(self.centre[0] + self.axes[0] * t.cos(), self.centre[1] + self.axes[1] * t.sin())
    }

    fn parameter(&self, point: Vec2) -> f64 {
        ((point.y - self.centre[1]) / self.axes[1]).atan2((point.x - self.centre[0]) / self.axes[0])
    }

    fn tension(&self, t: f64) -> f64 {
        1.0 + 0.5 * (f64::from(self.mode) * t - self.phase).cos()
    }

    /// Derivative of tension times tangent by the parameter.
    #[must_use]
    pub fn force(&self, t: f64) -> Vec2 {
        let [a, b] = self.axes;
        let (sin, cos) = t.sin_cos();
        let tangent = Vec2::new(-a * sin, b * cos);
        let speed = tangent.length();
        let tau = tangent / speed;
        let mode = f64::from(self.mode);
        let slope = -0.5 * mode * (mode * t - self.phase).sin();
        slope * tau + self.tension(t) * a * b / (speed * speed) * Vec2::new(-tau.y, tau.x)
    }

    /// Adds equally spaced markers, about `spacing` (length) apart, with their forces.
    ///
    /// # Errors
    /// A spacing that leaves too few of them.
    pub fn push_even(&self, spacing: f64, markers: &mut Markers) -> Result<(), StudyError> {
        let [a, b] = self.axes;
        let curve = if a == b { Curve::circle(a)? } else { Curve::ellipse(a, b)? };
        let curve = curve.translated(Vec2::new(self.centre[0], self.centre[1]));
        let count = (curve.perimeter() / spacing).round() as usize;
        let start = markers.len();
        markers.push_group(count, self.kind(true));
        markers.positions_mut()[start..].copy_from_slice(&curve.markers(count)?);
        for k in 0..count {
            let (here, next) = (markers.positions()[start + k], markers.positions()[start + (k + 1) % count]);
            let pull = self.tension(self.parameter(0.5 * (here + next))) * (next - here).normalize();
            markers.forces_mut()[start + k] += pull;
            markers.forces_mut()[start + (k + 1) % count] -= pull;
        }
        Ok(())
    }

    /// Adds markers at equal steps of the parameter with exact forces.
    pub fn push_exact(&self, count: usize, markers: &mut Markers) {
        let start = markers.len();
        markers.push_group(count, self.kind(false));
        for k in 0..count {
            let t = TAU * k as f64 / count as f64;
            markers.positions_mut()[start + k] = self.point(t);
            markers.forces_mut()[start + k] = self.force(t) * (TAU / count as f64);
        }
    }
}

/// Errors of one droplet.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// Velocity of the centroid: the distance from the exact one, relative to that or to the fastest marker where the
    /// droplet does not move.
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
    /// Those of the solver.
    pub fn new(region: Region, droplets: &[Droplet], nodes: usize) -> Result<Self, StudyError> {
        let mut markers = Markers::new();
        droplets.iter().for_each(|droplet| droplet.push_exact(nodes, &mut markers));
        exact(region, nodes)?.velocities(&mut markers)?;
        let velocities: Vec<Vec<Vec2>> = markers.velocities().chunks(nodes).map(<[Vec2]>::to_vec).collect();
        let centroids = droplets
            .iter()
            .zip(&velocities)
            .map(|(droplet, velocities)| {
                let mut sum = Vec2::ZERO;
                for (k, v) in velocities.iter().enumerate() {
                    let t = TAU * k as f64 / nodes as f64;
                    let [a, b] = droplet.axes;
                    let normal = Vec2::new(b * t.cos(), a * t.sin());
                    sum += v.dot(normal) * (droplet.point(t) - Vec2::from(droplet.centre)) * (TAU / nodes as f64);
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

    /// True if a droplet moves, so that the error of its velocity can be relative to that.
    #[must_use]
    pub fn moves(&self, droplet: usize) -> bool {
        let largest = self.velocities[droplet].iter().map(|v| v.length()).fold(0.0, f64::max);
        self.centroids[droplet].length() > 0.02 * largest
    }

    /// The errors of layers with `nodes` nodes, on twice as many markers, droplet by droplet.
    ///
    /// # Errors
    /// Those of the solver.
    pub fn errors(&self, nodes: usize) -> Result<Vec<Errors>, StudyError> {
        let mut markers = Markers::new();
        self.droplets.iter().for_each(|droplet| droplet.push_exact(2 * nodes, &mut markers));
        self.compare(layers(self.region, nodes)?, markers)
    }

    /// The errors of Cowley's way, a viscosity smeared over Peskin's kernel, without a mobility correction, with grid
    /// spacing `h` and markers h/2 apart.
    ///
    /// # Errors
    /// A spacing that does not divide the region; what the solver can fail with.
    pub fn smeared_errors(&self, h: f64) -> Result<Vec<Errors>, StudyError> {
        let mut markers = Markers::new();
        self.droplets.iter().try_for_each(|droplet| droplet.push_even(0.5 * h, &mut markers))?;
        self.compare(smeared(self.region, h)?, markers)
    }

    fn compare(&self, mut flow: AnyFlow, mut markers: Markers) -> Result<Vec<Errors>, StudyError> {
        flow.velocities(&mut markers)?;
        let mut all = Vec::new();
        for (index, group) in markers.groups().iter().enumerate() {
            let (droplet, range) = (&self.droplets[index], group.range.clone());
            let (positions, velocities) = (&markers.positions()[range.clone()], &markers.velocities()[range]);
            let exact = &self.velocities[index];
            let largest = exact.iter().map(|v| v.length()).fold(0.0, f64::max);
            let (mut sum, mut maximum) = (0.0, 0.0_f64);
            for (position, velocity) in positions.iter().zip(velocities) {
                let error = (velocity - interpolate(exact, droplet.parameter(*position))).length() / largest;
                sum += error * error;
                maximum = maximum.max(error);
            }
            let difference = centroid_velocity(positions, velocities) - self.centroids[index];
            let speed = difference.length() / if self.moves(index) { self.centroids[index].length() } else { largest };
            all.push(Errors { speed, rms: (sum / positions.len() as f64).sqrt(), maximum });
        }
        Ok(all)
    }
}

/// Boundary integrals in a region, viscosity one.
fn exact(region: Region, nodes: usize) -> Result<AnyFlow, StudyError> {
    flow(region, Method::Integral(IntegralMethod { nodes, elements: nodes }), 1.0, 1e-10)
}

/// Layers in a region, viscosity one.
fn layers(region: Region, nodes: usize) -> Result<AnyFlow, StudyError> {
    let method = LayersMethod { nodes, elements: nodes, ..LayersMethod::of_spacing(0.05) };
    flow(region, Method::Layers(method), 1.0, 1e-6)
}

/// Cowley's way in a region, viscosity one.
fn smeared(region: Region, h: f64) -> Result<AnyFlow, StudyError> {
    flow(region, Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() }), 1.0, 1e-6)
}

/// Velocity of the centroid of a closed polygon from the flux through its sides.
fn centroid_velocity(positions: &[Vec2], velocities: &[Vec2]) -> Vec2 {
    let count = positions.len();
    let (mut sum, mut area) = (Vec2::ZERO, 0.0);
    let middle = positions.iter().sum::<Vec2>() / count as f64;
    for k in 0..count {
        let d = 0.5 * (positions[(k + 1) % count] - positions[(k + count - 1) % count]);
        let normal = Vec2::new(d.y, -d.x);
        let relative = positions[k] - middle;
        sum += velocities[k].dot(normal) * relative;
        area += 0.5 * relative.dot(normal);
    }
    sum / area
}

/// Trigonometric interpolation of values at equal steps of a parameter.
fn interpolate(values: &[Vec2], t: f64) -> Vec2 {
    let count = values.len();
    let mut sum = Vec2::ZERO;
    for (k, value) in values.iter().enumerate() {
        let half = 0.5 * (t - TAU * k as f64 / count as f64);
        // The kernel of Dirichlet for an even number of values.
        let weight =
            if half.sin().abs() < 1e-12 { 1.0 } else { (count as f64 * half).sin() / (half.tan() * count as f64) };
        sum += weight * value;
    }
    sum
}
