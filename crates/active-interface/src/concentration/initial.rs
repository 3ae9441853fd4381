//! Initial concentrations.

use std::f64::consts::TAU;

use motile_base::{Vec2, finite, internal::all_finite, not_negative, positive, within};

use crate::InterfaceError;
use crate::curve::{Function, check_period, polygon::edges};

/// Initial concentration of particles along a closed curve.
///
/// ```
/// use active_interface::{Curve, InitialConcentration};
/// let markers = Curve::circle(1.0)?.markers(100)?;
/// let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
/// // c = c0 (1 - cos theta): none at the front, twice the mean at the rear
/// let length = active_interface::polygon_perimeter(&markers)? / 100.0;
/// assert!(numbers[0] / length < 0.2 && (numbers[50] / length - 200.0).abs() < 0.2);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone)]
pub struct InitialConcentration(Kind);

#[derive(Debug, Clone)]
enum Kind {
    Polarised { mean: f64, heading: f64 },
    Perturbed { mean: f64, amplitude: f64, seed: u64, axisymmetric: bool },
    PolarAngle(Function<f64>),
    ArcFraction(Function<f64>),
}

/// Number of Fourier modes of a seeded perturbation.
const MODES: usize = 8;

impl InitialConcentration {
    /// Creates the polarised state of Cowley, eq. (2.46): c = c0 (1 - cos(theta - heading)), with theta the polar angle
    /// about the centroid. The concentration is highest at the rear, so that a contractile droplet swims in the
    /// direction `heading` (radians); `mean` is c0 (particles per length).
    ///
    /// The particle number of a segment is the integral over its polar angles. All numbers are then scaled by one
    /// factor so that their total is c0 times the perimeter of the polygon (on a circle with equidistant markers the
    /// factor is 1 except for round-off).
    ///
    /// # Errors
    /// Returns an error for a mean that is not positive, a heading that is not finite.
    pub fn polarised(mean: f64, heading: f64) -> Result<Self, InterfaceError> {
        let mean = positive("the mean concentration", mean)?;
        Ok(Self(Kind::Polarised { mean, heading: finite("the heading", heading)? }))
    }

    /// Creates the uniform state with a small perturbation, c = c0 (1 + amplitude p(s)), where p is a sum of the first
    /// eight Fourier modes in the arc length with random weights and phases, |p| <= 1 and of mean zero. `mean` is c0
    /// (particles per length), `amplitude` lies in [0, 1).
    ///
    /// A seed determines the function of the arc length, on every machine and at every number of markers. The total is
    /// c0 times the perimeter of the polygon.
    ///
    /// # Errors
    /// Returns an error for a mean that is not positive, an amplitude outside [0, 1).
    pub fn perturbed(mean: f64, amplitude: f64, seed: u64) -> Result<Self, InterfaceError> {
        let mean = positive("the mean concentration", mean)?;
        within("the amplitude of the perturbation", amplitude, 0.0, 1.0 - f64::EPSILON)?;
        Ok(Self(Kind::Perturbed { mean, amplitude, seed, axisymmetric: false }))
    }

    /// Turns a perturbation into one of a body of revolution whose first marker is on the axis y = 0. Only the parts of
    /// its modes remain that are even about this marker, and the mean is the mean over the surface. Other
    /// concentrations stay.
    #[must_use]
    pub fn axisymmetric(mut self) -> Self {
        if let Kind::Perturbed { axisymmetric, .. } = &mut self.0 {
            *axisymmetric = true;
        }
        self
    }

    /// Creates the uniform state with the mean concentration c0 (particles per length).
    ///
    /// # Errors
    /// Returns an error for a mean that is not positive.
    pub fn uniform(mean: f64) -> Result<Self, InterfaceError> {
        Self::perturbed(mean, 0.0, 0)
    }

    /// Returns a concentration (particles per length) as a function of the polar angle about the centroid, from -pi to
    /// pi, for curves on which it is single-valued. Averaged over each segment by Simpson's rule and not scaled.
    pub fn by_polar_angle(concentration: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self(Kind::PolarAngle(Function::new(concentration)))
    }

    /// Returns a concentration (particles per length) as a function of the arc length from the first marker over the
    /// perimeter, from 0 to 1. Averaged over each segment by Simpson's rule and not scaled.
    pub fn by_arc_fraction(concentration: impl Fn(f64) -> f64 + Send + Sync + 'static) -> Self {
        Self(Kind::ArcFraction(Function::new(concentration)))
    }

    /// Returns the particle numbers of the segments of the closed polygon through `markers` (counter-clockwise),
    /// segment k from marker k to the next.
    ///
    /// # Errors
    /// Returns an error for fewer than three markers, markers that are not finite or enclose no area; a concentration
    /// that is not finite or negative somewhere.
    pub fn particle_numbers(&self, markers: &[Vec2]) -> Result<Vec<f64>, InterfaceError> {
        let centre = crate::curve::polygon_moments(markers)?.centroid;
        let lengths: Vec<f64> = edges(markers).map(|(a, b)| (b - a).length()).collect();
        self.numbers(markers, &lengths, centre)
    }

    /// Returns the particle numbers of the segments through `markers`, one period of an interface that continues
    /// `advance` further along x (length). Fractions of the arc length refer to the period.
    ///
    /// # Errors
    /// Returns an error for:
    /// * a concentration by the polar angle, which there is none of,
    /// * fewer than eight markers, markers that are not finite or do not close across the period,
    /// * a concentration that is not finite or negative somewhere.
    pub fn particle_numbers_over(&self, markers: &[Vec2], advance: f64) -> Result<Vec<f64>, InterfaceError> {
        if let Kind::Polarised { .. } | Kind::PolarAngle(_) = self.0 {
            return Err(InterfaceError::no_polar_angle());
        }
        check_period(markers, advance)?;
        let next = markers.iter().skip(1).copied().chain([markers[0] + Vec2::new(advance, 0.0)]);
        let lengths: Vec<f64> = markers.iter().zip(next).map(|(a, b)| (b - *a).length()).collect();
        self.numbers(markers, &lengths, Vec2::ZERO)
    }

    fn numbers(&self, markers: &[Vec2], lengths: &[f64], centre: Vec2) -> Result<Vec<f64>, InterfaceError> {
        let perimeter: f64 = lengths.iter().sum();
        let mut concentrations = match &self.0 {
            Kind::Polarised { heading, .. } => polarised(markers, centre, *heading),
            Kind::Perturbed { amplitude, seed, axisymmetric, .. } => {
                perturbed(lengths, *amplitude, *seed, *axisymmetric)
            }
            Kind::PolarAngle(f) => edges(markers)
                .map(|(a, b)| simpson(f, [a, (a + b) * 0.5, b].map(|p| (p.y - centre.y).atan2(p.x - centre.x))))
                .collect(),
            Kind::ArcFraction(f) => {
                let mut end = 0.0;
                lengths
                    .iter()
                    .map(|length| {
                        let start = end;
                        end += length / perimeter;
                        simpson(f, [start, 0.5 * (start + end), end.min(1.0)])
                    })
                    .collect()
            }
        };
        all_finite("the initial concentration", &concentrations)?;
        concentrations.iter().try_for_each(|&value| not_negative("the initial concentration", value).map(drop))?;
        for (c, length) in concentrations.iter_mut().zip(lengths) {
            *c *= length;
        }
        if let Kind::Perturbed { mean, axisymmetric: true, .. } = self.0 {
            let weights: Vec<f64> = edges(markers).map(|(a, b)| (a.y + b.y).abs()).collect();
            let sum = |values: &[f64]| values.iter().zip(&weights).map(|(value, weight)| value * weight).sum::<f64>();
            let factor = mean * sum(lengths) / sum(&concentrations);
            concentrations.iter_mut().for_each(|number| *number *= factor);
        } else if let Kind::Polarised { mean, .. } | Kind::Perturbed { mean, .. } = self.0 {
            let factor = mean * perimeter / concentrations.iter().sum::<f64>();
            concentrations.iter_mut().for_each(|number| *number *= factor);
        }
        Ok(concentrations)
    }
}

fn simpson(f: &Function<f64>, [a, middle, b]: [f64; 3]) -> f64 {
    (f(a) + 4.0 * f(middle) + f(b)) / 6.0
}

/// Means of 1 - cos(theta - heading) over the polar angles of the segments.
fn polarised(markers: &[Vec2], centre: Vec2, heading: f64) -> Vec<f64> {
    edges(markers)
        .map(|(a, b)| {
            let (a, b) = (a - centre, b - centre);
            let width = a.angle_to(b);
            let middle = a.y.atan2(a.x) + 0.5 * width - heading;
            // mean of cos over the interval = cos(middle) sin(width/2)/(width/2)
            let half = 0.5 * width;
            let damping = if half == 0.0 { 1.0 } else { half.sin() / half };
            (1.0 - middle.cos() * damping).max(0.0)
        })
        .collect()
}

/// Means of 1 + amplitude p over the segments, p with its even part alone if `even`.
fn perturbed(lengths: &[f64], amplitude: f64, seed: u64, even: bool) -> Vec<f64> {
    let perimeter: f64 = lengths.iter().sum();
    let mut random = SplitMix64::new(seed);
    let weights: [f64; MODES] = std::array::from_fn(|_| random.uniform());
    let phases: [f64; MODES] = std::array::from_fn(|_| TAU * random.uniform());
    let total: f64 = weights.iter().sum();
    let mut end = 0.0;
    lengths
        .iter()
        .map(|length| {
            let width = TAU * length / perimeter;
            let middle = end + 0.5 * width;
            end += width;
            let wave: f64 = (1u32..)
                .zip(weights.iter().zip(&phases))
                .map(|(k, (weight, phase))| {
                    let (angle, half) = (f64::from(k) * middle, 0.5 * f64::from(k) * width);
                    let wave = if even { angle.cos() * phase.cos() } else { (angle + phase).cos() };
                    weight * wave * half.sin() / half
                })
                .sum();
            1.0 + amplitude * wave / total
        })
        .collect()
}

/// The generator splitmix64 (Steele, Lea and Flood 2014): every seed is good, and the numbers are the same everywhere.
#[derive(Debug, Clone)]
pub struct SplitMix64(u64);

impl SplitMix64 {
    /// Creates the generator of that seed.
    #[must_use]
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// Returns the next number in (0, 1], a multiple of 2^-53.
    pub fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        ((z >> 11) + 1) as f64 / (1u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests;
