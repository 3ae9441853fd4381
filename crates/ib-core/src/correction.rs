//! Putting the lost mobility of an interface back.

use std::sync::Arc;

use num_complex::Complex;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

use crate::mobility::{MobilityDeficit, normal_taper};
use crate::{FlowError, Vec2};

/// The mobility correction of an interface, which turns the first-order error of its velocity into a second-order one
/// (docs/method.md, section 3):
///
/// `V_t += (h/eta) S[G_t] F_t`, `V_n += (h/eta) S[G_n T] F_n`,
///
/// F_t and F_n the tangential and normal force per length, S[G] the multiplication of each Fourier mode along the
/// equally spaced markers, of wave number q, by `G(q h)`, and `T = exp(-(q h/2)^4)`. The uniform mode of F_n only
/// changes the pressure inside and is dropped.
///
/// These mobilities are averages over positions of the interface between the grid lines. Where it runs along the grid, the
/// tangential one depends on that position, through the first harmonic of the grid, which is taken off: for each axis,
/// with `phi = 2 pi y / h` for the interface along x,
///
/// `V -= (h/eta) 2 Re(e^{i phi/2} S[H] e^{i phi/2} F_t) (tau + tau' - (tau . tau') tau)`,
///
/// tau' the tangent mirrored in that axis. Multiplying by e^{i phi/2} on both sides gives each inclination its own
/// wave number, so that H fades by itself where the interface turns away from the axis.
#[derive(Debug)]
pub(crate) struct MobilityCorrection {
    deficit: MobilityDeficit,
    planner: Planner,
    plan: Option<Plan>,
}

/// The planner does not implement Debug.
struct Planner(RealFftPlanner<f64>);

impl std::fmt::Debug for Planner {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("RealFftPlanner")
    }
}

/// Transforms and scratch for one number of markers.
struct Plan {
    forward: Arc<dyn RealToComplex<f64>>,
    inverse: Arc<dyn ComplexToReal<f64>>,
    places: Vec<Place>,
    /// Tangential and normal force per length.
    forces: [Vec<f64>; 2],
    spectra: [Vec<Complex<f64>>; 2],
    /// Spectra and values of the parts of the correction: tangential mean, slope and curvature, normal mean and slope.
    products: [Vec<Complex<f64>>; PARTS],
    parts: [Vec<f64>; PARTS],
    scratch: Vec<Complex<f64>>,
    complex_forward: Arc<dyn Fft<f64>>,
    complex_inverse: Arc<dyn Fft<f64>>,
    tangential_force: Vec<f64>,
    /// Factors of the grid harmonic, a mode.
    harmonics: Vec<f64>,
    /// For both axes, one after the other.
    phases: Vec<Complex<f64>>,
    modulated: Vec<Complex<f64>>,
    complex_scratch: Vec<Complex<f64>>,
}

impl std::fmt::Debug for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Plan").field("markers", &self.places.len()).finish_non_exhaustive()
    }
}

/// Products of an evaluation: three of the tangential force, two of the normal one.
const PARTS: usize = 5;
/// How many of them are of the tangential force.
const TANGENTIAL: usize = 3;

/// A marker on its interface.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    /// Unit tangent; zero between coinciding neighbours, which give no direction.
    tangent: Vec2,
    /// What walls and solids leave of the tangential and of the normal part.
    left: [f64; 2],
}

/// The fluid and grid of a correction.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Setting {
    /// Grid spacing (length).
    pub(crate) spacing: f64,
    /// Lower left corner of the grid (length).
    pub(crate) origin: [f64; 2],
    /// Viscosity (stress times time).
    pub(crate) viscosity: f64,
    /// Heights of walls (length).
    pub(crate) walls: Option<[f64; 2]>,
    /// Effective variance of the kernel, which sets how the tangential part fades near a wall (units of h^2).
    pub(crate) variance: f64,
}

impl MobilityCorrection {
    pub(crate) fn new(deficit: MobilityDeficit) -> Self {
        Self { deficit, planner: Planner(RealFftPlanner::new()), plan: None }
    }

    /// Adds the correction of one equally spaced closed interface to `velocities`; `gaps` are the distances of its markers from
    /// elastic solids (grid spacings), empty without.
    pub(crate) fn apply(
        &mut self,
        setting: &Setting,
        gaps: &[f64],
        positions: &[Vec2],
        forces: &[Vec2],
        velocities: &mut [Vec2],
    ) -> Result<(), FlowError> {
        let count = positions.len();
        if count < 3 {
            return Ok(());
        }
        if self.plan.as_ref().is_none_or(|plan| plan.places.len() != count) {
            self.plan = Some(Plan::new(&mut self.planner.0, count));
        }
        let Some(plan) = self.plan.as_mut() else { return Ok(()) };
        let perimeter = plan.place(setting, gaps, positions, forces);
        plan.transform(&self.deficit, setting, perimeter)?;
        for (k, (velocity, place)) in velocities.iter_mut().zip(&plan.places).enumerate() {
            let tau = place.tangent;
            // n_x^4 + n_y^4 - 3/4 = 1/4 - 2 (n_x n_y)^2
            let direction = 0.25 - 2.0 * (tau.x * tau.y).powi(2);
            let [mean, slope, curvature, normal, normal_slope] = plan.parts.each_ref().map(|part| part[k]);
            let along = mean + direction * slope + (32.0 * direction * direction - 1.0) * curvature;
            let across = normal + direction * normal_slope;
            *velocity += place.left[0] * along * tau + place.left[1] * across * Vec2::new(tau.y, -tau.x);
        }
        plan.take_off_harmonics(self.deficit.second_harmonic(), setting, positions, velocities);
        Ok(())
    }
}

impl Setting {
    /// How much of the tangential and of the normal part is left at height y and at the distance `to_solids` (grid spacings) from
    /// elastic solids, if there are any: the image of the force in the wall cancels it at the wall, and so do the forces of a
    /// solid. `1 - exp(-x^2) + sqrt(pi) x erfc(x)`, x = gap/(h sqrt(variance)), and `(1 - exp(-gap/2h))^2`.
    fn left(&self, y: f64, to_solids: Option<&f64>) -> [f64; 2] {
        let to_walls = self.walls.map(|[bottom, top]| (y - bottom).min(top - y).max(0.0) / self.spacing);
        let gap = to_walls.unwrap_or(f64::INFINITY).min(to_solids.copied().unwrap_or(f64::INFINITY));
        if gap == f64::INFINITY {
            return [1.0; 2];
        }
        let x = gap / self.variance.sqrt();
        let tangential = if x > 6.0 { 1.0 } else { 1.0 - (-x * x).exp() + std::f64::consts::PI.sqrt() * x * erfc(x) };
        // Beyond 80 spacings the rest is below round-off.
        let normal = if gap > 80.0 { 1.0 } else { (1.0 - (-0.5 * gap).exp()).powi(2) };
        [tangential, normal]
    }
}

/// The complementary error function for x >= 0, to about 1e-7 (Abramowitz and Stegun 7.1.26): the fading it enters is a
/// model good to per cents.
fn erfc(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x);
    let p = t * (0.254_829_592 + t * (-0.284_496_736 + t * (1.421_413_741 + t * (-1.453_152_027 + t * 1.061_405_429))));
    p * (-x * x).exp()
}

impl Plan {
    fn new(planner: &mut RealFftPlanner<f64>, count: usize) -> Self {
        let (forward, inverse) = (planner.plan_fft_forward(count), planner.plan_fft_inverse(count));
        let scratch = vec![Complex::default(); forward.get_scratch_len().max(inverse.get_scratch_len())];
        let (real, spectrum) = (vec![0.0; count], vec![Complex::default(); count / 2 + 1]);
        let mut complex_planner = FftPlanner::new();
        let (complex_forward, complex_inverse) =
            (complex_planner.plan_fft_forward(count), complex_planner.plan_fft_inverse(count));
        let needed = complex_forward.get_inplace_scratch_len().max(complex_inverse.get_inplace_scratch_len());
        Self {
            complex_forward,
            complex_inverse,
            tangential_force: real.clone(),
            harmonics: vec![0.0; spectrum.len()],
            phases: vec![Complex::default(); 2 * count],
            modulated: vec![Complex::default(); 2 * count],
            complex_scratch: vec![Complex::default(); needed],
            forward,
            inverse,
            places: vec![Place::default(); count],
            forces: std::array::from_fn(|_| real.clone()),
            spectra: std::array::from_fn(|_| spectrum.clone()),
            products: std::array::from_fn(|_| spectrum.clone()),
            parts: std::array::from_fn(|_| real.clone()),
            scratch,
        }
    }

    /// Tangents and forces per length along and across them, for `d = (X_{k+1} - X_{k-1}) / 2 = w tau`, n = (tau_y, -tau_x);
    /// the sum of w.
    fn place(&mut self, setting: &Setting, gaps: &[f64], positions: &[Vec2], forces: &[Vec2]) -> f64 {
        let count = positions.len();
        let [tangential, normal] = &mut self.forces;
        let mut perimeter = 0.0;
        for (k, place) in self.places.iter_mut().enumerate() {
            let before = positions[if k == 0 { count - 1 } else { k - 1 }];
            let after = positions[if k + 1 == count { 0 } else { k + 1 }];
            let d = 0.5 * (after - before);
            let w = d.norm();
            perimeter += w;
            let inverse = if w > 0.0 { 1.0 / w } else { 0.0 };
            let (tau, force) = (inverse * d, inverse * forces[k]);
            tangential[k] = force.dot(&tau);
            normal[k] = force.x * tau.y - force.y * tau.x;
            *place = Place { tangent: tau, left: setting.left(positions[k].y, gaps.get(k)) };
        }
        self.tangential_force.copy_from_slice(tangential);
        perimeter
    }

    /// The parts of the correction (length per time) from the forces, and the factors of the grid harmonic.
    fn transform(&mut self, deficit: &MobilityDeficit, setting: &Setting, perimeter: f64) -> Result<(), FlowError> {
        for (force, spectrum) in self.forces.iter_mut().zip(&mut self.spectra) {
            self.forward.process_with_scratch(force, spectrum, &mut self.scratch).map_err(lengths)?;
        }
        let count = self.places.len();
        let [tangential, normal] = &mut self.spectra;
        normal[0] = Complex::default();
        // Wave numbers in units of 1/h; the inverse transform is unnormalised.
        let step = 2.0 * std::f64::consts::PI * setting.spacing / perimeter;
        let scale = setting.spacing / setting.viscosity / count as f64;
        for m in 0..=count / 2 {
            let q = step * m as f64;
            let deficit_here = deficit.at(q);
            let taper = normal_taper(q);
            let factors = [
                deficit_here.tangential,
                deficit_here.tangential_slope,
                deficit_here.tangential_curvature,
                deficit_here.normal * taper,
                deficit_here.normal_slope * taper,
            ];
            for (part, (product, factor)) in self.products.iter_mut().zip(factors).enumerate() {
                let force = if part < TANGENTIAL { tangential[m] } else { normal[m] };
                product[m] = force * (scale * factor);
            }
            self.harmonics[m] = 2.0 * scale * deficit.harmonic(q);
        }
        for (product, part) in self.products.iter_mut().zip(&mut self.parts) {
            // Purely real by definition; round-off would make the transform refuse them.
            product[0].im = 0.0;
            if count.is_multiple_of(2) {
                product[count / 2].im = 0.0;
            }
            self.inverse.process_with_scratch(product, part, &mut self.scratch).map_err(lengths)?;
        }
        Ok(())
    }

    fn take_off_harmonics(&mut self, second: f64, setting: &Setting, positions: &[Vec2], velocities: &mut [Vec2]) {
        let count = positions.len();
        let per_length = std::f64::consts::PI / setting.spacing;
        for (axis, (phases, modulated)) in
            self.phases.chunks_exact_mut(count).zip(self.modulated.chunks_exact_mut(count)).enumerate()
        {
            let across = 1 - axis;
            let origin = setting.origin[across];
            for (((phase, value), position), force) in
                phases.iter_mut().zip(modulated).zip(positions).zip(&self.tangential_force)
            {
                let (sin, cos) = (per_length * (position[across] - origin)).sin_cos();
                *phase = Complex::new(cos, sin);
                *value = *phase * *force;
            }
        }
        self.complex_forward.process_with_scratch(&mut self.modulated, &mut self.complex_scratch);
        for modulated in self.modulated.chunks_exact_mut(count) {
            for (m, value) in modulated.iter_mut().enumerate() {
                *value *= self.harmonics[m.min(count - m)];
            }
        }
        self.complex_inverse.process_with_scratch(&mut self.modulated, &mut self.complex_scratch);
        for (axis, (phases, modulated)) in
            self.phases.chunks_exact(count).zip(self.modulated.chunks_exact(count)).enumerate()
        {
            let across = 1 - axis;
            for (((velocity, place), phase), value) in
                velocities.iter_mut().zip(&self.places).zip(phases).zip(modulated)
            {
                let tau = place.tangent;
                let mut mirrored = tau;
                mirrored[across] = -tau[across];
                let first = phase * value;
                let phase = phase * phase;
                // The second harmonic from the first: e^{-i phi} takes the first one's phase off.
                let harmonics = first.re + second * (first * phase.conj()).re * (phase * phase).re;
                *velocity -= place.left[0] * harmonics * (tau + mirrored - tau.dot(&mirrored) * tau);
            }
        }
    }
}

/// The plans are made for the lengths they are used with, so this is not met in practice.
fn lengths(_: realfft::FftError) -> FlowError {
    FlowError::Unsupported { what: "a transform along an interface of this length", remedy: "report this as a defect" }
}
