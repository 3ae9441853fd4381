//! Shape of a droplet and the particles on it, as trigonometric polynomials.

use std::f64::consts::TAU;

use motile::base::{Region, TubeShape};
use motile::setup::{DropletShape, Setup};
use motile_base::{
    PeriodicSeries, Vec2,
    internal::{decimals, place},
    same_length,
};
use num_complex::Complex64;

use crate::SteadyError;
use crate::iteration::MOST_ITERATIONS;

/// Crowding of nodes (length): they stand 1.3 times as densely where the concentration changes by its mean over a
/// length of 1.
pub(crate) const CROWDING: f64 = 0.8;
/// Largest wave number of the density of nodes: beyond it a concentration would be resolved no better, and with few
/// nodes to a wave the density would follow their errors.
const MOST_WAVES: f64 = 12.0;
const NODES_PER_WAVE: f64 = 7.0;
/// Amplitude of modes, over the mean, below which there is nothing to resolve, as in the concentration at rest.
const FLAT: f64 = 1e-3;
/// Highest Fourier modes above which the nodes on the way, and the nodes of a branch, are redistributed.
pub(crate) const RESOLVED: f64 = 5e-4;
/// Change of the parameter of a place on a curve below which it is found.
const ROUND_OFF: f64 = 64.0 * f64::EPSILON;

/// Droplet in its steady state: a closed curve and the density of particles on it.
///
/// Both are given at N nodes, node k at the parameter a = 2 pi k/N, and are the trigonometric polynomials through these
/// values, so that they are known between the nodes to spectral accuracy.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Positions of the nodes (length), counter-clockwise.
    pub positions: Vec<Vec2>,
    /// Particles per parameter at the nodes, m = c |dx/da|, with the concentration c in particles per length; in three
    /// dimensions c is per area, and m per parameter and length of a ring.
    pub density: Vec<f64>,
    /// Centres of the rigid discs inside (length), in the order of the description.
    pub nuclei: Vec<Vec2>,
}

/// Offsets (length) and densities at nodes.
pub(crate) type Fields = (Vec<f64>, Vec<f64>);

/// Curve and density as series, for evaluation at any parameter.
pub(crate) struct Sampler {
    curve: PeriodicSeries,
    density: PeriodicSeries,
}

/// Point of a curve: position, its derivative by the parameter, density.
pub(crate) struct Place {
    pub(crate) position: Vec2,
    pub(crate) tangent: Vec2,
    pub(crate) density: f64,
}

impl Sampler {
    pub(crate) fn new(profile: &Profile) -> Result<Self, SteadyError> {
        let count = profile.positions.len();
        let (mut curve, mut density) = (PeriodicSeries::new(count)?, PeriodicSeries::new(count)?);
        curve.analyse_vectors(&profile.positions)?;
        analyse(&mut density, profile.density.iter())?;
        Ok(Self { curve, density })
    }

    pub(crate) fn at(&self, parameter: f64) -> Place {
        let vector = |z: Complex64| Vec2::new(z.re, z.im);
        let (position, tangent) = evaluated(self.curve.coefficients(), parameter);
        let (density, _) = evaluated(self.density.coefficients(), parameter);
        Place { position: vector(position), tangent: vector(tangent), density: density.re }
    }
}

/// Returns the series through real values at the nodes.
pub(crate) fn analyse<'a>(
    series: &mut PeriodicSeries,
    values: impl ExactSizeIterator<Item = &'a f64>,
) -> Result<(), SteadyError> {
    Ok(series.analyse(values.map(|&value| Complex64::new(value, 0.0)))?)
}

/// Returns the derivative by the parameter of a real function given at the nodes.
fn derivative(values: &[f64]) -> Result<Vec<f64>, SteadyError> {
    let mut series = PeriodicSeries::new(values.len())?;
    analyse(&mut series, values.iter())?;
    series.differentiate();
    Ok(series.values().iter().map(|z| z.re).collect())
}

/// Returns the integral over the parameter of a real function given at the nodes: its mean, and the periodic remainder
/// as a series.
fn integral(values: &[f64]) -> Result<(f64, PeriodicSeries), SteadyError> {
    let mut series = PeriodicSeries::new(values.len())?;
    analyse(&mut series, values.iter())?;
    let mean = series.coefficients()[0].re;
    series.multiply(|wave| if wave == 0.0 { Complex64::ZERO } else { Complex64::new(0.0, -1.0 / wave) });
    Ok((mean, series))
}

/// Returns the value and derivative of a trigonometric polynomial at a parameter, from its coefficients.
fn evaluated(coefficients: &[Complex64], parameter: f64) -> (Complex64, Complex64) {
    let (len, unit) = (coefficients.len(), Complex64::cis(parameter));
    let (mut value, mut rate, mut power) = (coefficients[0], Complex64::ZERO, unit);
    for m in 1..len.div_ceil(2) {
        let (up, down) = (coefficients[m] * power, coefficients[len - m] * power.conj());
        value += up + down;
        rate += Complex64::new(0.0, m as f64) * (up - down);
        power *= unit;
    }
    (value, rate)
}

impl Profile {
    /// Creates a profile of a droplet from its N markers (length) and the numbers of particles on its N segments,
    /// segment k from marker k to the next. Markers become nodes, and the series of the density has these means over
    /// the segments.
    ///
    /// # Errors
    /// Returns an error for lists of different length, or longer than a transform takes.
    pub fn from_markers(markers: &[Vec2], numbers: &[f64]) -> Result<Self, SteadyError> {
        let count = markers.len();
        same_length("particle numbers", count, numbers.len())?;
        // The number on segment k is the density's mean over it times the step. The means have the Fourier coefficients
        // of the density times sin(w)/w exp(i w), w half a step times the wave number.
        let step = TAU / count as f64;
        let mut series = PeriodicSeries::new(count)?;
        analyse(&mut series, numbers.iter())?;
        series.multiply(|wave| {
            let half = 0.5 * wave * step;
            let mean = if half == 0.0 { 1.0 } else { half.sin() / half };
            Complex64::cis(-half) / (mean * step)
        });
        let density = series.values().iter().map(|z| z.re).collect();
        Ok(Self { positions: markers.to_vec(), density, nuclei: Vec::new() })
    }

    /// Returns the profile with rigid discs inside, at these centres (length).
    #[must_use]
    pub fn with_nuclei(self, nuclei: Vec<Vec2>) -> Self {
        Self { nuclei, ..self }
    }

    /// Returns true for particles that are spread evenly to a thousandth, as at rest; branches of swimmers begin
    /// farther off.
    pub(crate) fn is_at_rest(&self) -> bool {
        let [least, most] = self.density.iter().fold([f64::INFINITY, 0.0], |[a, b], m| [m.min(a), m.max(b)]);
        most - least <= 1e-3 * most
    }

    /// Shifts the droplet along x (length).
    pub(crate) fn shift(&mut self, x: f64) {
        self.positions.iter_mut().chain(&mut self.nuclei).for_each(|position| position.x += x);
    }

    /// Returns the droplet with its centroid at x = 0.
    pub(crate) fn centred(mut self) -> Result<Self, SteadyError> {
        self.shift(-self.moments()?.centroid.x);
        Ok(self)
    }

    /// Returns the number N of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.positions.len()
    }

    /// Returns the mirror image of the droplet at the x axis, counter-clockwise from the image of the first node.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let n = self.nodes();
        let from = |k: usize| (n - k) % n;
        Self {
            positions: (0..n).map(|k| self.positions[from(k)] * Vec2::new(1.0, -1.0)).collect(),
            density: (0..n).map(|k| self.density[from(k)]).collect(),
            nuclei: self.nuclei.iter().map(|centre| *centre * Vec2::new(1.0, -1.0)).collect(),
        }
    }

    /// Returns the mirror-symmetric droplet next to this one: its centroid is shifted to the x axis, its first node to
    /// where it crosses the axis in front, and it is averaged with its mirror image.
    pub(crate) fn symmetrised(&self) -> Result<Self, SteadyError> {
        let centroid = self.moments()?.centroid;
        let count = self.nodes();
        let sampler = Sampler::new(self)?;
        let front = |k: &usize| {
            let arm = self.positions[*k] - centroid;
            arm.x / arm.length()
        };
        let mut first =
            TAU * (0..count).max_by(|a, b| front(a).total_cmp(&front(b))).unwrap_or(0) as f64 / count as f64;
        for _ in 0..MOST_ITERATIONS {
            let place = sampler.at(first);
            first -= ((place.position.y - centroid.y) / place.tangent.y).clamp(-0.5, 0.5);
        }
        let places = (0..count).map(|k| sampler.at(first + TAU * k as f64 / count as f64));
        let across = Vec2::new(0.0, centroid.y);
        let (positions, density) = places.map(|place| (place.position - across, place.density)).unzip();
        let nuclei = self.nuclei.iter().map(|centre| *centre - across).collect();
        Ok(Self { positions, density, nuclei }.mean_with_image())
    }

    /// Returns the mean of this droplet, whose first node is on the x axis, and its mirror image.
    pub(crate) fn mean_with_image(mut self) -> Self {
        let image = self.mirrored();
        self.positions.iter_mut().zip(&image.positions).for_each(|(here, there)| *here = 0.5 * (*here + *there));
        self.density.iter_mut().zip(&image.density).for_each(|(here, there)| *here = 0.5 * (*here + there));
        self.nuclei.iter_mut().for_each(|centre| centre.y = 0.0);
        self
    }

    /// Returns the arc length from the first node (length) and concentration (particles per length) at the nodes.
    ///
    /// # Errors
    /// Returns an error for more nodes than a transform takes.
    pub fn concentrations(&self) -> Result<(Vec<f64>, Vec<f64>), SteadyError> {
        let rates: Vec<f64> = self.tangents()?.iter().map(|t| t.length()).collect();
        let (mean, mut periodic) = integral(&rates)?;
        let periodic = periodic.values();
        let step = TAU / rates.len() as f64;
        let lengths =
            periodic.iter().enumerate().map(|(k, z)| mean * step * k as f64 + z.re - periodic[0].re).collect();
        Ok((lengths, self.density.iter().zip(&rates).map(|(m, rate)| m / rate).collect()))
    }

    /// Returns the smallest distance of the nodes from the straight walls of a region (length); `None` without walls.
    pub(crate) fn film(&self, setup: &Setup) -> Option<f64> {
        let reach = self.positions.iter().map(|x| x.y.abs()).fold(0.0, f64::max);
        match setup.region.without_slip() {
            Region::Channel { width, .. } => Some(0.5 * width - reach),
            Region::Tube { radius, shape: TubeShape::Straight, .. } => Some(radius - reach),
            _ => None,
        }
    }

    /// Refuses a droplet that reaches into a wall or its own periodic image, or that does not hold all of its discs.
    pub(crate) fn check_room(&self, setup: &Setup) -> Result<(), SteadyError> {
        let extent = |way: Vec2| self.positions.iter().map(|x| x.dot(way)).fold(f64::NEG_INFINITY, f64::max);
        let [left, right, top, bottom] = [-Vec2::X, Vec2::X, Vec2::Y, -Vec2::Y].map(extent);
        let fits = match setup.region.without_slip() {
            Region::Tube { radius, .. } => top.max(bottom) < radius,
            Region::Channel { length, width, .. } => left + right < length && top.max(bottom) < 0.5 * width,
            region => left + right < region.lengths()[0] && top + bottom < region.lengths()[1],
        };
        if !fits {
            return Err(SteadyError::unsupported(
                format!(
                    "the droplet does not fit: it reaches from y = {} to {} and is {} long",
                    decimals(3, -bottom),
                    decimals(3, top),
                    decimals(3, left + right)
                ),
                "Use a larger region or a smaller droplet, or move the droplet",
            ));
        }
        same_length("the nuclei of the profile", setup.rigid_bodies.len(), self.nuclei.len())?;
        for (body, centre) in setup.rigid_bodies.iter().zip(&self.nuclei) {
            let DropletShape::Round { radius } = body.shape else { continue };
            let arms = || self.positions.iter().map(|x| *x - *centre);
            let turn: f64 = arms().zip(arms().cycle().skip(1)).map(|(a, b)| a.angle_to(b)).sum();
            if turn.abs() < 0.5 * TAU || !arms().all(|arm| arm.length() > radius) {
                return Err(SteadyError::unsupported(
                    format!("the disc of radius {radius} at {} is not inside", place(centre.x, centre.y)),
                    "Use a smaller disc, or move it within the droplet",
                ));
            }
        }
        Ok(())
    }

    /// Returns the derivative of the positions by the parameter at the nodes (length).
    pub(crate) fn tangents(&self) -> Result<Vec<Vec2>, SteadyError> {
        let mut series = PeriodicSeries::new(self.nodes())?;
        series.analyse_vectors(&self.positions)?;
        series.differentiate();
        let mut tangents = vec![Vec2::ZERO; self.nodes()];
        series.write_vectors(&mut tangents)?;
        Ok(tangents)
    }

    /// Returns the droplet at another number of nodes, of equal spacing or, where `crowding` is positive, crowding
    /// where the concentration is steep. The density of nodes is then `sqrt(1 + (crowding R/c0 dc/ds)^2)` over the arc
    /// length, R the radius of a circle of this area, smoothed; without particles where the curve is bent, the
    /// curvature taking the place of the slope.
    pub(crate) fn resampled(&self, nodes: usize, crowding: f64) -> Result<Self, SteadyError> {
        let fine = 4 * self.nodes().max(nodes);
        let sampler = Sampler::new(self)?;
        let places: Vec<Place> = (0..fine).map(|k| sampler.at(TAU * k as f64 / fine as f64)).collect();
        let mut weights: Vec<f64> = places.iter().map(|place| place.tangent.length()).collect();
        if crowding > 0.0 {
            let steep = |rate: f64| (1.0 + (crowding * rate).powi(2)).sqrt();
            let mut series = PeriodicSeries::new(fine)?;
            let carries = self.density.iter().any(|density| *density != 0.0);
            let densities: Vec<f64> = if carries {
                // That of the circle of this area.
                let area = places.iter().map(|place| place.position.perp_dot(place.tangent)).sum::<f64>();
                let radius = (area.abs() / fine as f64).sqrt();
                let concentrations: Vec<f64> =
                    places.iter().zip(&weights).map(|(place, g)| place.density / g).collect();
                let mean = concentrations.iter().sum::<f64>() / fine as f64;
                let slopes = derivative(&concentrations)?;
                slopes.iter().zip(&weights).map(|(slope, g)| steep(radius * slope / (g * mean))).collect()
            } else {
                let radius = weights.iter().sum::<f64>() / fine as f64;
                series.analyse_vectors(&places.iter().map(|place| place.tangent).collect::<Vec<_>>())?;
                series.differentiate();
                let turning = |(place, bend): (&Place, &Complex64)| {
                    let Vec2 { x, y } = place.tangent;
                    (x * bend.im - y * bend.re) / place.tangent.length().powi(3)
                };
                places.iter().zip(series.values()).map(turning).map(|kappa| steep(kappa * radius)).collect()
            };
            analyse(&mut series, densities.iter())?;
            let most = if carries { MOST_WAVES } else { f64::INFINITY };
            let waves = most.min(nodes as f64 / NODES_PER_WAVE);
            series.scale(|m| (-(m as f64 / waves).powi(2)).exp());
            weights.iter_mut().zip(series.values()).for_each(|(weight, smooth)| *weight *= smooth.re);
        }
        // Nodes divide the integral of the weight into equal parts.
        let (mean, periodic) = integral(&weights)?;
        let weight = |parameter: f64| {
            let (sum, rate) = evaluated(periodic.coefficients(), parameter);
            (mean * parameter + sum.re, mean + rate.re)
        };
        let start = weight(0.0).0;
        let (positions, density) = (Vec::with_capacity(nodes), Vec::with_capacity(nodes));
        let mut result = Self { positions, density, nuclei: self.nuclei.clone() };
        let mut parameter = 0.0;
        for k in 0..nodes {
            let goal = start + mean * TAU * k as f64 / nodes as f64;
            for _ in 0..MOST_ITERATIONS {
                let (value, rate) = weight(parameter);
                let step = (goal - value) / rate;
                parameter += step;
                if step.abs() < ROUND_OFF {
                    break;
                }
            }
            let Place { position, density, .. } = sampler.at(parameter);
            let stretch = mean / weight(parameter).1;
            result.positions.push(position);
            result.density.push(density * stretch);
            parameter += TAU / nodes as f64 * stretch;
        }
        Ok(result)
    }

    /// Returns the droplet as offsets along the normals of another curve and density per parameter of that curve;
    /// `None` if the normals do not cross the droplet one after the other.
    pub(crate) fn over(&self, origins: &[Vec2], normals: &[Vec2]) -> Result<Option<Fields>, SteadyError> {
        let sampler = Sampler::new(self)?;
        let count = origins.len();
        let (mut parameters, mut offsets, mut density) = (Vec::new(), Vec::new(), Vec::new());
        let mut parameter = 0.0;
        for k in 0..count {
            let (origin, normal) = (origins[k], normals[k]);
            let place_of = |j: usize| sampler.at(TAU * j as f64 / (2 * count) as f64).position;
            if k == 0 {
                let distance = |j: &usize| (place_of(*j) - origin).length_squared();
                let nearest = (0..2 * count).min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(0);
                parameter = TAU * nearest as f64 / (2 * count) as f64;
            }
            let mut converged = false;
            for _ in 0..MOST_ITERATIONS {
                let Place { position, tangent, .. } = sampler.at(parameter);
                let step = -(position - origin).perp_dot(normal) / tangent.perp_dot(normal);
                parameter += step.clamp(-0.5, 0.5);
                converged = step.abs() < ROUND_OFF;
                if converged {
                    break;
                }
            }
            let place = sampler.at(parameter);
            if !(converged && place.tangent.perp_dot(normal) < 0.0) {
                return Ok(None);
            }
            offsets.push((place.position - origin).dot(normal));
            density.push(place.density);
            parameters.push(parameter);
            parameter += TAU / count as f64;
        }
        let step = TAU / count as f64;
        let excess: Vec<f64> = parameters.iter().enumerate().map(|(k, p)| p - step * k as f64).collect();
        let rates = derivative(&excess)?;
        if rates.iter().any(|rate| *rate <= -1.0) {
            return Ok(None);
        }
        for (value, rate) in density.iter_mut().zip(&rates) {
            *value *= 1.0 + rate;
        }
        offsets.extend(self.nuclei.iter().map(|centre| centre.x));
        density.extend(self.nuclei.iter().map(|centre| centre.y));
        Ok(Some((offsets, density)))
    }
}

/// Centroid (length) of the area inside a curve, and its second moments xx, xy and yy about that (length to the fourth
/// power).
pub(crate) struct AreaMoments {
    pub(crate) centroid: Vec2,
    second: [f64; 3],
}

impl AreaMoments {
    /// Returns the aspect ratio: square root of the second moment along a unit vector over that across it.
    pub(crate) fn aspect_ratio(&self, along: Vec2) -> f64 {
        let [xx, xy, yy] = self.second;
        let moment = |u: Vec2| u.x * u.x * xx + 2.0 * u.x * u.y * xy + u.y * u.y * yy;
        (moment(along) / moment(along.perp())).sqrt()
    }
}

impl Profile {
    /// Returns the moments of the area inside.
    pub(crate) fn moments(&self) -> Result<AreaMoments, SteadyError> {
        let fine = self.resample_fine()?;
        let tangents = fine.tangents()?;
        let step = TAU / fine.nodes() as f64;
        let integral = |of: &dyn Fn(Vec2, Vec2) -> f64| -> f64 {
            fine.positions.iter().zip(&tangents).map(|(x, t)| of(*x, *t) * step).sum()
        };
        let area = integral(&|x, t| 0.5 * x.perp_dot(t));
        let centroid =
            Vec2::new(integral(&|x, t| 0.5 * x.x * x.x * t.y), integral(&|x, t| -0.5 * x.y * x.y * t.x)) / area;
        let xx = integral(&|x, t| (x.x - centroid.x).powi(3) * t.y / 3.0);
        let xy = integral(&|x, t| 0.5 * (x.x - centroid.x).powi(2) * (x.y - centroid.y) * t.y);
        let yy = integral(&|x, t| -(x.y - centroid.y).powi(3) * t.x / 3.0);
        Ok(AreaMoments { centroid, second: [xx, xy, yy] })
    }

    /// Returns the series at twice the nodes, for integrals of products of three.
    pub(crate) fn resample_fine(&self) -> Result<Self, SteadyError> {
        let sampler = Sampler::new(self)?;
        let count = 2 * self.nodes();
        let places = (0..count).map(|k| sampler.at(TAU * k as f64 / count as f64));
        let (positions, density) = places.map(|place| (place.position, place.density)).unzip();
        Ok(Self { positions, density, nuclei: self.nuclei.clone() })
    }

    /// Returns the minimum curvature (1/length) at the nodes.
    pub(crate) fn least_curvature(&self) -> Result<f64, SteadyError> {
        let tangents = self.tangents()?;
        let turning = Self { positions: tangents.clone(), density: Vec::new(), nuclei: Vec::new() }.tangents()?;
        let curvature = tangents.iter().zip(&turning).map(|(t, rate)| t.perp_dot(*rate) / t.length().powi(3));
        Ok(curvature.fold(f64::INFINITY, f64::min))
    }

    /// Returns the largest and smallest concentration (particles per length), between the nodes too.
    pub(crate) fn extrema(&self) -> Result<[f64; 2], SteadyError> {
        let sampler = Sampler::new(self)?;
        let at = |parameter: f64| {
            let place = sampler.at(parameter);
            place.density / place.tangent.length()
        };
        let count = 8 * self.nodes();
        let step = TAU / count as f64;
        let extremum = |sign: f64| {
            let value = |parameter: f64| sign * at(parameter);
            let best =
                (0..count).max_by(|a, b| value(*a as f64 * step).total_cmp(&value(*b as f64 * step))).unwrap_or(0);
            // The parabola through three points that are close.
            let (mut middle, mut width) = (best as f64 * step, step);
            for _ in 0..4 {
                let [a, b, c] = [-width, 0.0, width].map(|offset| value(middle + offset));
                let curvature = a - 2.0 * b + c;
                if curvature < 0.0 {
                    middle += (0.5 * (a - c) / curvature * width).clamp(-width, width);
                }
                width *= 0.3;
            }
            at(middle)
        };
        Ok([extremum(1.0), extremum(-1.0)])
    }

    /// Returns the ratio of the last eighth of the Fourier coefficients to the largest, of the shape and of the
    /// density.
    pub(crate) fn tails(&self) -> Result<[(&'static str, f64); 2], SteadyError> {
        let count = self.nodes();
        let sampler = Sampler::new(self)?;
        let tail = |series: &PeriodicSeries| {
            let size = |m: usize| series.coefficients()[m].norm() + series.coefficients()[count - m].norm();
            let largest = (1..count / 2).map(size).fold(f64::MIN_POSITIVE, f64::max);
            let last = (count * 7 / 16..count / 2).map(size).fold(0.0, f64::max);
            last / largest.max(FLAT * series.coefficients()[0].norm())
        };
        Ok([("shape", tail(&sampler.curve)), ("concentration", tail(&sampler.density))])
    }
}

#[cfg(test)]
mod tests;
