//! A droplet as its curve and the particles on it.

use std::f64::consts::TAU;

use fourier::PeriodicSeries;
use motile::ib_core::Vec2;
use num_complex::Complex64;

use crate::SteadyError;

/// Newton iterations for a place on a curve.
const MOST_ITERATIONS: usize = 50;
/// Modes below this part of the mean are not worth resolving.
const FLAT: f64 = 1e-3;
/// Waves of the density of nodes that are kept: that many, or one for this number of nodes where there are few, whose
/// error it would follow.
const SMOOTH_WAVES: f64 = 12.0;
const NODES_PER_WAVE: f64 = 7.0;

/// A closed curve and the particles on it, node k of N at the parameter 2 pi k/N: trigonometric polynomials, so that
/// everything between the nodes is known to spectral accuracy.
#[derive(Debug, Clone, PartialEq)]
pub struct Profile {
    /// Positions of the nodes (length), counter-clockwise.
    pub positions: Vec<Vec2>,
    /// Particles per parameter: the concentration times the derivative of the arc length by the parameter.
    pub density: Vec<f64>,
    /// Centres of the rigid discs inside (length).
    pub nuclei: Vec<Vec2>,
}

/// Offsets (length) and densities at nodes.
pub(crate) type Fields = (Vec<f64>, Vec<f64>);

/// Curve and density as series that can be asked for anywhere.
pub(crate) struct Sampler {
    curve: PeriodicSeries,
    density: PeriodicSeries,
}

/// A place on a curve: position and its derivative by the parameter, density.
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
        density.analyse(profile.density.iter().map(|&value| Complex64::new(value, 0.0)))?;
        Ok(Self { curve, density })
    }

    pub(crate) fn at(&self, parameter: f64) -> Place {
        let (curve, density) = (self.curve.coefficients(), self.density.coefficients());
        let len = curve.len();
        let unit = Complex64::cis(parameter);
        let (mut position, mut tangent, mut value) = (curve[0], Complex64::ZERO, density[0].re);
        let mut power = unit;
        for m in 1..len.div_ceil(2) {
            let (up, down) = (curve[m] * power, curve[len - m] * power.conj());
            position += up + down;
            tangent += Complex64::new(0.0, m as f64) * (up - down);
            value += 2.0 * (density[m] * power).re;
            power *= unit;
        }
        let vector = |z: Complex64| Vec2::new(z.re, z.im);
        Place { position: vector(position), tangent: vector(tangent), density: value }
    }
}

/// Derivative by the parameter of a real function given at the nodes, and the size of its last modes over that of all
/// but the mean.
pub(crate) fn derivative(series: &mut PeriodicSeries, values: &[f64]) -> Result<Vec<f64>, SteadyError> {
    series.analyse(values.iter().map(|&value| Complex64::new(value, 0.0)))?;
    series.differentiate();
    Ok(series.values().iter().map(|z| z.re).collect())
}

impl Profile {
    /// The droplet whose markers and segments (segment k from marker k to the next) these are.
    ///
    /// # Errors
    /// Lists of different length.
    pub fn from_markers(markers: &[Vec2], numbers: &[f64]) -> Result<Self, SteadyError> {
        let count = markers.len();
        motile::ib_core::input::same_length("particle numbers", count, numbers.len())?;
        // The density is the derivative of the number of particles up to a parameter; that of segment k is its mean
        // there, whose Fourier coefficients are those of the density times sin(m/2)/(m/2).
        let step = TAU / count as f64;
        let mut series = PeriodicSeries::new(count)?;
        series.analyse(numbers.iter().map(|&n| Complex64::new(n / step, 0.0)))?;
        series.multiply(|wave| {
            let half = 0.5 * wave * step;
            let mean = if half == 0.0 { 1.0 } else { half.sin() / half };
            Complex64::cis(-half) / mean
        });
        let density = series.values().iter().map(|z| z.re).collect();
        Ok(Self { positions: markers.to_vec(), density, nuclei: Vec::new() })
    }

    /// The same droplet with rigid discs inside, at these centres (length).
    #[must_use]
    pub fn with_nuclei(self, nuclei: Vec<Vec2>) -> Self {
        Self { nuclei, ..self }
    }

    /// Moves it along x.
    pub(crate) fn shift(&mut self, x: f64) {
        self.positions.iter_mut().chain(&mut self.nuclei).for_each(|position| position.x += x);
    }

    /// Number of nodes.
    #[must_use]
    pub fn nodes(&self) -> usize {
        self.positions.len()
    }

    /// The same droplet mirrored at the x axis.
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

    /// The mirror-symmetric droplet next to this one: its mean with its mirror image at the x axis, its first node
    /// being where it crosses the axis in front.
    ///
    /// # Errors
    /// A curve that is not finite.
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

    /// The mean of this droplet, whose first node is on the x axis, and its mirror image.
    pub(crate) fn mean_with_image(mut self) -> Self {
        let image = self.mirrored();
        self.positions.iter_mut().zip(&image.positions).for_each(|(here, there)| *here = 0.5 * (*here + *there));
        self.density.iter_mut().zip(&image.density).for_each(|(here, there)| *here = 0.5 * (*here + there));
        self.nuclei.iter_mut().for_each(|centre| centre.y = 0.0);
        self
    }

    /// Arc length from the first node (length) and concentration (particles per length) at the nodes.
    ///
    /// # Errors
    /// A curve that is not finite.
    pub fn concentrations(&self) -> Result<(Vec<f64>, Vec<f64>), SteadyError> {
        let rates: Vec<f64> = self.tangents()?.iter().map(|t| t.length()).collect();
        let mut series = PeriodicSeries::new(self.nodes())?;
        series.analyse(rates.iter().map(|&rate| Complex64::new(rate, 0.0)))?;
        let mean = series.coefficients()[0].re;
        series.multiply(|wave| if wave == 0.0 { Complex64::ZERO } else { Complex64::new(0.0, -1.0 / wave) });
        let periodic = series.values();
        let step = TAU / rates.len() as f64;
        let lengths =
            periodic.iter().enumerate().map(|(k, z)| mean * step * k as f64 + z.re - periodic[0].re).collect();
        Ok((lengths, self.density.iter().zip(&rates).map(|(m, rate)| m / rate).collect()))
    }

    /// Derivative of the positions by the parameter.
    pub(crate) fn tangents(&self) -> Result<Vec<Vec2>, SteadyError> {
        let mut series = PeriodicSeries::new(self.nodes())?;
        series.analyse_vectors(&self.positions)?;
        series.differentiate();
        let mut tangents = vec![Vec2::ZERO; self.nodes()];
        series.write_vectors(&mut tangents)?;
        Ok(tangents)
    }

    /// The same droplet with `nodes` nodes. Where `crowding` is positive nodes crowd where the concentration is
    /// steep, by the density `sqrt(1 + (crowding/c0 dc/ds)^2)` smoothed; otherwise they have equal spacing.
    ///
    /// # Errors
    /// A curve that is not finite.
    pub(crate) fn resampled(&self, nodes: usize, crowding: f64) -> Result<Self, SteadyError> {
        let fine = 4 * self.nodes().max(nodes);
        let sampler = Sampler::new(self)?;
        let places: Vec<Place> = (0..fine).map(|k| sampler.at(TAU * k as f64 / fine as f64)).collect();
        let lengths: Vec<f64> = places.iter().map(|place| place.tangent.length()).collect();
        let mut series = PeriodicSeries::new(fine)?;
        let mut weights = lengths.clone();
        if crowding > 0.0 {
            let concentration: Vec<f64> = places.iter().zip(&lengths).map(|(place, g)| place.density / g).collect();
            let mean = concentration.iter().sum::<f64>() / fine as f64;
            let slopes = derivative(&mut series, &concentration)?;
            let steep =
                slopes.iter().zip(&lengths).map(|(slope, g)| (1.0 + (crowding * slope / (g * mean)).powi(2)).sqrt());
            series.analyse(steep.map(|value| Complex64::new(value, 0.0)))?;
            let waves = SMOOTH_WAVES.min(nodes as f64 / NODES_PER_WAVE);
            series.scale(|m| (-(m as f64 / waves).powi(2)).exp());
            for (weight, smooth) in weights.iter_mut().zip(series.values()) {
                *weight *= smooth.re;
            }
        }
        // Cumulative weight as a function of the parameter: linear part and periodic part.
        series.analyse(weights.iter().map(|&value| Complex64::new(value, 0.0)))?;
        let slope = series.coefficients()[0].re;
        series.multiply(|wave| if wave == 0.0 { Complex64::ZERO } else { Complex64::new(0.0, -1.0 / wave) });
        let periodic = series.coefficients().to_vec();
        let weight = |parameter: f64| {
            let unit = Complex64::cis(parameter);
            let (mut power, mut sum, mut rate) = (unit, 0.0, slope);
            for (m, c) in periodic.iter().enumerate().take(fine / 2).skip(1) {
                let term = c * power;
                sum += 2.0 * term.re;
                rate -= 2.0 * m as f64 * term.im;
                power *= unit;
            }
            (slope * parameter + sum, rate)
        };
        let start = weight(0.0).0;
        let (positions, density) = (Vec::with_capacity(nodes), Vec::with_capacity(nodes));
        let mut result = Self { positions, density, nuclei: self.nuclei.clone() };
        let mut parameter = 0.0;
        for k in 0..nodes {
            let goal = start + slope * TAU * k as f64 / nodes as f64;
            for _ in 0..MOST_ITERATIONS {
                let (value, rate) = weight(parameter);
                let step = (goal - value) / rate;
                parameter += step;
                if step.abs() < 1e-14 {
                    break;
                }
            }
            let Place { position, density, .. } = sampler.at(parameter);
            result.positions.push(position);
            result.density.push(density * slope / weight(parameter).1);
            parameter += TAU / nodes as f64 * slope / weight(parameter).1;
        }
        Ok(result)
    }

    /// This droplet on lines along normals of another curve: the offsets along them, and the density by the parameter
    /// of that curve; none where it is too far from that curve.
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
                if step.abs() < 1e-14 {
                    converged = true;
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
        let rates = derivative(&mut PeriodicSeries::new(count)?, &excess)?;
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

/// Centroid and aspect ratio of an area.
pub(crate) struct AreaMoments {
    pub(crate) centroid: Vec2,
    pub(crate) aspect_ratio: f64,
}

impl Profile {
    /// Moments of the area inside.
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
        let along = integral(&|x, t| (x.x - centroid.x).powi(3) * t.y / 3.0);
        let across = integral(&|x, t| -(x.y - centroid.y).powi(3) * t.x / 3.0);
        Ok(AreaMoments { centroid, aspect_ratio: (along / across).sqrt() })
    }

    /// The same series at twice the nodes.
    fn resample_fine(&self) -> Result<Self, SteadyError> {
        let sampler = Sampler::new(self)?;
        let count = 2 * self.nodes();
        let places = (0..count).map(|k| sampler.at(TAU * k as f64 / count as f64));
        let (positions, density) = places.map(|place| (place.position, place.density)).unzip();
        Ok(Self { positions, density, nuclei: self.nuclei.clone() })
    }

    /// Least curvature (1/length) at the nodes.
    pub(crate) fn least_curvature(&self) -> Result<f64, SteadyError> {
        let tangents = self.tangents()?;
        let turning = Self { positions: tangents.clone(), density: Vec::new(), nuclei: Vec::new() }.tangents()?;
        let curvature = tangents.iter().zip(&turning).map(|(t, rate)| t.perp_dot(*rate) / t.length().powi(3));
        Ok(curvature.fold(f64::INFINITY, f64::min))
    }

    /// Largest and smallest concentration (particles per length).
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

    /// Size of the last modes over the largest, of the shape and of the density.
    pub(crate) fn tails(&self) -> Result<[(&'static str, f64); 2], SteadyError> {
        let count = self.nodes();
        let sampler = Sampler::new(self)?;
        let tail = |series: &PeriodicSeries| {
            let size = |m: usize| series.coefficients()[m].norm() + series.coefficients()[count - m].norm();
            let largest = (1..count / 2).map(size).fold(0.0, f64::max);
            let last = (count * 7 / 16..count / 2).map(size).fold(0.0, f64::max);
            last / largest.max(FLAT * series.coefficients()[0].norm())
        };
        Ok([("shape", tail(&sampler.curve)), ("concentration", tail(&sampler.density))])
    }
}
