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
    tangents: Vec<Vec2>,
    real: Vec<f64>,
    tangential: Vec<Complex<f64>>,
    normal: Vec<Complex<f64>>,
    product: Vec<Complex<f64>>,
    scratch: Vec<Complex<f64>>,
    complex_forward: Arc<dyn Fft<f64>>,
    complex_inverse: Arc<dyn Fft<f64>>,
    tangential_force: Vec<f64>,
    phases: Vec<Complex<f64>>,
    modulated: Vec<Complex<f64>>,
    complex_scratch: Vec<Complex<f64>>,
}

impl std::fmt::Debug for Plan {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Plan").field("markers", &self.real.len()).finish_non_exhaustive()
    }
}

/// Which of the five products of an evaluation.
#[derive(Clone, Copy)]
enum Part {
    Tangential,
    TangentialSlope,
    TangentialCurvature,
    Normal,
    NormalSlope,
}

impl Part {
    const ALL: [Self; 5] =
        [Self::Tangential, Self::TangentialSlope, Self::TangentialCurvature, Self::Normal, Self::NormalSlope];
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
        if self.plan.as_ref().is_none_or(|plan| plan.real.len() != count) {
            self.plan = Some(Plan::new(&mut self.planner.0, count));
        }
        let Some(plan) = self.plan.as_mut() else { return Ok(()) };

        let mut perimeter = 0.0;
        for k in 0..count {
            let (before, after) = (positions[(k + count - 1) % count], positions[(k + 1) % count]);
            let d = 0.5 * (after - before);
            perimeter += d.norm();
            plan.tangents[k] = d;
        }
        for part in [Part::Tangential, Part::Normal] {
            for ((real, d), force) in plan.real.iter_mut().zip(&plan.tangents).zip(forces) {
                let w2 = d.norm_squared();
                // F.tau / w and F.n / w with d = w tau, n = (tau_y, -tau_x); coinciding neighbours give no direction.
                let along = match part {
                    Part::Tangential | Part::TangentialSlope | Part::TangentialCurvature => force.dot(d),
                    Part::Normal | Part::NormalSlope => force.x * d.y - force.y * d.x,
                };
                *real = if w2 > 0.0 { along / w2 } else { 0.0 };
            }
            if matches!(part, Part::Tangential) {
                plan.tangential_force.copy_from_slice(&plan.real);
            }
            plan.forward(part)?;
        }
        plan.normal[0] = Complex::default();

        // Wave numbers in units of 1/h; the inverse transform is unnormalised.
        let step = 2.0 * std::f64::consts::PI * setting.spacing / perimeter;
        let scale = setting.spacing / setting.viscosity / count as f64;
        for part in Part::ALL {
            plan.backward(part, |m| {
                let q = step * m as f64;
                let deficit = self.deficit.at(q);
                scale
                    * match part {
                        Part::Tangential => deficit.tangential,
                        Part::TangentialSlope => deficit.tangential_slope,
                        Part::TangentialCurvature => deficit.tangential_curvature,
                        Part::Normal => deficit.normal * normal_taper(q),
                        Part::NormalSlope => deficit.normal_slope * normal_taper(q),
                    }
            })?;
            for k in 0..count {
                let d = plan.tangents[k];
                let w2 = d.norm_squared();
                if w2 == 0.0 {
                    continue;
                }
                let tau = d / w2.sqrt();
                let normal = Vec2::new(tau.y, -tau.x);
                // n_x^4 + n_y^4 - 3/4 = 1/4 - 2 (n_x n_y)^2
                let direction = 0.25 - 2.0 * (normal.x * normal.y).powi(2);
                let fade = setting.fade(positions[k].y, gaps.get(k), part);
                velocities[k] += fade
                    * plan.real[k]
                    * match part {
                        Part::Tangential => tau,
                        Part::TangentialSlope => direction * tau,
                        Part::TangentialCurvature => (32.0 * direction * direction - 1.0) * tau,
                        Part::Normal => normal,
                        Part::NormalSlope => direction * normal,
                    };
            }
        }
        self.take_off_harmonics(setting, step, gaps, positions, velocities);
        Ok(())
    }

    fn take_off_harmonics(
        &mut self,
        setting: &Setting,
        step: f64,
        gaps: &[f64],
        positions: &[Vec2],
        velocities: &mut [Vec2],
    ) {
        let Some(plan) = self.plan.as_mut() else { return };
        let count = positions.len();
        let scale = 2.0 * setting.spacing / setting.viscosity / count as f64;
        let second = self.deficit.second_harmonic();
        for axis in [0, 1] {
            let across = 1 - axis;
            for (k, position) in positions.iter().enumerate() {
                let half_phase = std::f64::consts::PI * (position[across] - setting.origin[across]) / setting.spacing;
                let (sin, cos) = half_phase.sin_cos();
                plan.phases[k] = Complex::new(cos, sin);
                plan.modulated[k] = plan.phases[k] * plan.tangential_force[k];
            }
            plan.complex_forward.process_with_scratch(&mut plan.modulated, &mut plan.complex_scratch);
            for (m, value) in plan.modulated.iter_mut().enumerate() {
                let q = step * m.min(count - m) as f64;
                *value *= scale * self.deficit.harmonic(q);
            }
            plan.complex_inverse.process_with_scratch(&mut plan.modulated, &mut plan.complex_scratch);
            for (k, velocity) in velocities.iter_mut().enumerate() {
                let norm = plan.tangents[k].norm();
                if norm == 0.0 {
                    continue;
                }
                let tau = plan.tangents[k] / norm;
                let mut mirrored = tau;
                mirrored[across] = -tau[across];
                let phase = plan.phases[k] * plan.phases[k];
                let first = plan.phases[k] * plan.modulated[k];
                // The second harmonic from the first: e^{-i phi} takes the first one's phase off.
                let harmonics = first.re + second * (first * phase.conj()).re * (phase * phase).re;
                let amount = setting.fade(positions[k].y, gaps.get(k), Part::Tangential) * harmonics;
                *velocity -= amount * (tau + mirrored - tau.dot(&mirrored) * tau);
            }
        }
    }
}

impl Setting {
    /// How much of the correction is left at height y and at the distance `to_solids` (grid spacings) from elastic solids, if
    /// there are any: the image of the force in the wall cancels it at the wall, and so do the forces of a solid.
    /// Tangential `1 - exp(-x^2) + sqrt(pi) x erfc(x)`, x = gap/(h sqrt(variance)); normal `(1 - exp(-gap/2h))^2`.
    fn fade(&self, y: f64, to_solids: Option<&f64>, part: Part) -> f64 {
        let to_walls = self.walls.map(|[bottom, top]| (y - bottom).min(top - y).max(0.0) / self.spacing);
        let gap = to_walls.unwrap_or(f64::INFINITY).min(to_solids.copied().unwrap_or(f64::INFINITY));
        if gap == f64::INFINITY {
            return 1.0;
        }
        match part {
            Part::Tangential | Part::TangentialSlope | Part::TangentialCurvature => {
                let x = gap / self.variance.sqrt();
                if x > 6.0 { 1.0 } else { 1.0 - (-x * x).exp() + std::f64::consts::PI.sqrt() * x * erfc(x) }
            }
            Part::Normal | Part::NormalSlope => (1.0 - (-0.5 * gap).exp()).powi(2),
        }
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
        let spectrum = vec![Complex::default(); count / 2 + 1];
        let mut complex_planner = FftPlanner::new();
        let (complex_forward, complex_inverse) =
            (complex_planner.plan_fft_forward(count), complex_planner.plan_fft_inverse(count));
        let needed = complex_forward.get_inplace_scratch_len().max(complex_inverse.get_inplace_scratch_len());
        Self {
            complex_forward,
            complex_inverse,
            tangential_force: vec![0.0; count],
            phases: vec![Complex::default(); count],
            modulated: vec![Complex::default(); count],
            complex_scratch: vec![Complex::default(); needed],
            forward,
            inverse,
            tangents: vec![Vec2::zeros(); count],
            real: vec![0.0; count],
            tangential: spectrum.clone(),
            normal: spectrum.clone(),
            product: spectrum,
            scratch,
        }
    }

    fn forward(&mut self, part: Part) -> Result<(), FlowError> {
        let spectrum = match part {
            Part::Tangential | Part::TangentialSlope | Part::TangentialCurvature => &mut self.tangential,
            Part::Normal | Part::NormalSlope => &mut self.normal,
        };
        self.forward.process_with_scratch(&mut self.real, spectrum, &mut self.scratch).map_err(lengths)
    }

    fn backward(&mut self, part: Part, factor: impl Fn(usize) -> f64) -> Result<(), FlowError> {
        let spectrum = match part {
            Part::Tangential | Part::TangentialSlope | Part::TangentialCurvature => &self.tangential,
            Part::Normal | Part::NormalSlope => &self.normal,
        };
        for (m, (out, value)) in self.product.iter_mut().zip(spectrum).enumerate() {
            *out = value * factor(m);
        }
        // Purely real by definition; round-off would make the transform refuse them.
        self.product[0].im = 0.0;
        if self.real.len().is_multiple_of(2)
            && let Some(last) = self.product.last_mut()
        {
            last.im = 0.0;
        }
        self.inverse.process_with_scratch(&mut self.product, &mut self.real, &mut self.scratch).map_err(lengths)
    }
}

/// The plans are made for the lengths they are used with, so this is not met in practice.
fn lengths(_: realfft::FftError) -> FlowError {
    FlowError::Unsupported { what: "a transform along an interface of this length", remedy: "report this as a defect" }
}
