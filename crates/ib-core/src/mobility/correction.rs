//! Putting the lost mobility of an interface back.

use motile_base::{ComplexTransform, InputError, RealTransform};
use num_complex::Complex;

use super::{MobilityDeficit, normal_taper};
use motile_base::Vec2;
use stokes_grid::StokesError;

/// The mobility correction of an interface, which turns the first-order error of its velocity into a second-order one
/// (docs/explanation/grid.md):
///
/// `V_t += (h/eta) (S[G_t] F_t + S[G_x] F_n)`, `V_n += (h/eta) T (S[G_n] F_n + S[G_x] F_t)`,
///
/// F_t and F_n the tangential and normal force per length, S[G] the multiplication of each Fourier mode along the
/// equally spaced markers, of wave number q, by `G(q h)`, and `T = exp(-(q h/2)^4)` (in the coupling on both sides).
/// The uniform mode of F_n only changes the pressure inside and is dropped.
///
/// The deficits depend on the direction of the interface through cos(4 theta), cos(8 theta) and, for the coupling G_x,
/// sin(4 theta), theta the angle of the normal. Along a curve direction and wave number are no longer independent.
/// Multiplying by the direction only after S would be wrong by a term of second order which is not reciprocal and turns
/// a swimmer towards the axes. Multiplying by half the phase before and by half after it,
///
/// `cos(4 theta) G F  ->  Re( e^{2 i theta} S[G] e^{2 i theta} F )`, `sin(4 theta) G F  ->  Im( ... )`,
///
/// is symmetric and takes to each term the wave number half way between the wave numbers of the force and of the
/// velocity.
///
/// These mobilities are averages over positions of the interface between the grid lines. If it runs along the grid, the
/// tangential one depends on that position, through the first harmonic of the grid, which is subtracted: for each axis,
/// with `phi = 2 pi y / h` for the interface along x,
///
/// `V -= (h/eta) 2 Re(e^{i phi/2} S[H] e^{i phi/2} F_t) (tau + tau' - (tau . tau') tau)`,
///
/// tau' the tangent mirrored in that axis. Multiplying by e^{i phi/2} on both sides gives each inclination its own
/// wave number, so that H fades by itself where the interface turns away from the axis.
#[derive(Debug, Clone)]
pub(crate) struct MobilityCorrection {
    deficit: MobilityDeficit,
    plan: Option<Plan>,
}

/// Transforms and scratch for one number of markers.
#[derive(Debug, Clone)]
struct Plan {
    real: RealTransform,
    complex: ComplexTransform,
    places: Vec<Place>,
    /// Tangential and normal force per length.
    forces: [Vec<f64>; 2],
    spectra: [Vec<Complex<f64>>; 2],
    /// Velocities that the mean deficits give along the tangent and the normal (length per time).
    parts: [Vec<f64>; 2],
    /// Factors of a mode, `MODULATED` and one more; see [`Plan::transform`].
    factors: Vec<[f64; 5]>,
    /// For each modulated force, one after the other: the factor before and after the multiplication of its modes.
    phases: Vec<Complex<f64>>,
    modulated: Vec<Complex<f64>>,
}

/// Forces that are multiplied by a phase before and after their modes are multiplied by factors. These are: with e^{2i
/// theta} the tangential and the normal one, with e^{4i theta} the tangential one, with the grid's phase along both
/// axes the tangential one.
const MODULATED: usize = 5;

/// A marker on its interface.
#[derive(Debug, Clone, Copy, Default)]
struct Place {
    /// Unit tangent; zero between coinciding neighbours, which give no direction.
    tangent: Vec2,
    /// Fractions of the tangential and of the normal part that walls leave.
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
        Self { deficit, plan: None }
    }

    /// Adds the correction of one equally spaced closed interface to `velocities`.
    pub(crate) fn apply(
        &mut self,
        setting: &Setting,
        positions: &[Vec2],
        forces: &[Vec2],
        velocities: &mut [Vec2],
    ) -> Result<(), StokesError> {
        let count = positions.len();
        if count < 3 {
            return Ok(());
        }
        if self.plan.as_ref().is_none_or(|plan| plan.places.len() != count) {
            self.plan = Some(Plan::new(count)?);
        }
        let Some(plan) = self.plan.as_mut() else { return Ok(()) };
        let perimeter = plan.place(setting, positions, forces);
        plan.transform(&self.deficit, setting, perimeter, positions)?;
        for (velocity, (place, [along, across])) in velocities.iter_mut().zip(plan.places.iter().zip(plan.restored())) {
            let tau = place.tangent;
            *velocity += place.left[0] * along * tau + place.left[1] * across * Vec2::new(tau.y, -tau.x);
        }
        plan.take_off_harmonics(self.deficit.second_harmonic(), velocities);
        Ok(())
    }
}

impl Setting {
    /// Fractions of the tangential and of the normal part that are left at height y: the image of the force in the wall
    /// cancels it at the wall. `1 - exp(-x^2) + sqrt(pi) x erfc(x)`, x = gap/(h sqrt(variance)), and `(1 -
    /// exp(-gap/2h))^2`.
    fn left(&self, y: f64) -> [f64; 2] {
        let Some([bottom, top]) = self.walls else { return [1.0; 2] };
        let gap = (y - bottom).min(top - y).max(0.0) / self.spacing;
        let x = gap / self.variance.sqrt();
        let tangential = if x > 6.0 { 1.0 } else { 1.0 - (-x * x).exp() + std::f64::consts::PI.sqrt() * x * erfc(x) };
        // Beyond 80 spacings the rest is below round-off.
        let normal = if gap > 80.0 { 1.0 } else { (1.0 - (-0.5 * gap).exp()).powi(2) };
        [tangential, normal]
    }
}

/// Returns the complementary error function for x >= 0, to about 1e-7 (Abramowitz and Stegun 7.1.26): the fading it
/// enters is a model good to per cents.
fn erfc(x: f64) -> f64 {
    let t = 1.0 / (1.0 + 0.327_591_1 * x);
    let p = t * (0.254_829_592 + t * (-0.284_496_736 + t * (1.421_413_741 + t * (-1.453_152_027 + t * 1.061_405_429))));
    p * (-x * x).exp()
}

impl Plan {
    fn new(count: usize) -> Result<Self, InputError> {
        let (real, complex) = (RealTransform::new(count)?, ComplexTransform::new(count)?);
        let (values, spectrum) = (vec![0.0; count], vec![Complex::default(); count / 2 + 1]);
        Ok(Self {
            real,
            complex,
            factors: vec![[0.0; 5]; spectrum.len()],
            phases: vec![Complex::default(); MODULATED * count],
            modulated: vec![Complex::default(); MODULATED * count],
            places: vec![Place::default(); count],
            forces: std::array::from_fn(|_| values.clone()),
            spectra: std::array::from_fn(|_| spectrum.clone()),
            parts: std::array::from_fn(|_| values.clone()),
        })
    }

    /// Returns the tangents and forces per length along and across them, for `d = (X_{k+1} - X_{k-1}) / 2 = w tau`, n =
    /// (tau_y, -tau_x), the normal ones less their mean; the sum of w.
    fn place(&mut self, setting: &Setting, positions: &[Vec2], forces: &[Vec2]) -> f64 {
        let count = positions.len();
        let [tangential, normal] = &mut self.forces;
        let (mut perimeter, mut pressure) = (0.0, 0.0);
        for (k, place) in self.places.iter_mut().enumerate() {
            let before = positions[if k == 0 { count - 1 } else { k - 1 }];
            let after = positions[if k + 1 == count { 0 } else { k + 1 }];
            let d = 0.5 * (after - before);
            let w = d.length();
            perimeter += w;
            let inverse = if w > 0.0 { 1.0 / w } else { 0.0 };
            let (tau, force) = (inverse * d, inverse * forces[k]);
            tangential[k] = force.dot(tau);
            normal[k] = force.x * tau.y - force.y * tau.x;
            pressure += normal[k];
            *place = Place { tangent: tau, left: setting.left(positions[k].y) };
        }
        pressure /= count as f64;
        normal.iter_mut().for_each(|force| *force -= pressure);
        perimeter
    }

    /// The forces times the phases that belong to each of them.
    fn modulate(&mut self, setting: &Setting, positions: &[Vec2]) {
        let count = positions.len();
        let per_length = std::f64::consts::PI / setting.spacing;
        let [tangential, normal] = &self.forces;
        for (k, (position, place)) in positions.iter().zip(&self.places).enumerate() {
            let tau = place.tangent;
            // The square of tau_x + i tau_y is -e^{2i theta}, theta the angle of the normal; it always enters twice.
            let twice = Complex::new(tau.x, tau.y).powu(2);
            let grid = [1, 0].map(|across| {
                let (sin, cos) = (per_length * (position[across] - setting.origin[across])).sin_cos();
                Complex::new(cos, sin)
            });
            let phases = [twice, twice, twice * twice, grid[0], grid[1]];
            for (which, phase) in phases.into_iter().enumerate() {
                let force = if which == 1 { normal[k] } else { tangential[k] };
                self.phases[which * count + k] = phase;
                self.modulated[which * count + k] = phase * force;
            }
        }
    }

    /// The parts of the correction (length per time) from the forces.
    fn transform(
        &mut self,
        deficit: &MobilityDeficit,
        setting: &Setting,
        perimeter: f64,
        positions: &[Vec2],
    ) -> Result<(), StokesError> {
        self.modulate(setting, positions);
        let count = self.places.len();
        // Wave numbers in units of 1/h; the inverse transforms are unnormalised.
        let step = 2.0 * std::f64::consts::PI * setting.spacing / perimeter;
        let scale = setting.spacing / setting.viscosity / count as f64;
        for (force, spectrum) in self.forces.iter_mut().zip(&mut self.spectra) {
            self.real.forward(force, spectrum)?;
        }
        let [tangential, normal] = &mut self.spectra;
        for (m, factors) in self.factors.iter_mut().enumerate() {
            let q = step * m as f64;
            let here = deficit.at(q);
            let taper = normal_taper(q);
            tangential[m] *= scale * here.tangential;
            normal[m] *= scale * here.normal * taper;
            // z = cos(4 theta) / 4
            *factors = [
                0.25 * here.tangential_slope,
                0.25 * here.normal_slope * taper,
                here.tangential_curvature,
                2.0 * deficit.harmonic(q),
                here.cross * taper,
            ]
            .map(|factor| scale * factor);
        }
        for (spectrum, part) in self.spectra.iter_mut().zip(&mut self.parts) {
            self.real.inverse(spectrum, part)?;
        }
        self.complex.forward(&mut self.modulated)?;
        for m in 0..count {
            let [tangential, normal, curvature, harmonic, cross] = self.factors[m.min(count - m)];
            let [along, across] = [0, 1].map(|which| self.modulated[which * count + m]);
            // Re(-i z) = Im z: sin(4 theta) for cos(4 theta).
            let turned = Complex::new(0.0, -cross);
            self.modulated[m] = along * tangential + across * turned;
            self.modulated[count + m] = across * normal + along * turned;
            self.modulated[2 * count + m] *= curvature;
            self.modulated[3 * count + m] *= harmonic;
            self.modulated[4 * count + m] *= harmonic;
        }
        self.complex.inverse(&mut self.modulated)?;
        Ok(())
    }

    /// Returns the mobility that is restored along the tangent and the normal of each marker (length per time). A
    /// uniform pressure moves nothing, so a force has no uniform normal velocity.
    fn restored(&self) -> impl Iterator<Item = [f64; 2]> {
        let count = self.places.len();
        let turned = move |which: usize, k: usize| {
            let k = which * count + k;
            (self.phases[k] * self.modulated[k]).re
        };
        let across = move |k: usize| self.parts[1][k] + turned(1, k);
        let mean = (0..count).map(across).sum::<f64>() / count as f64;
        (0..count).map(move |k| [self.parts[0][k] + turned(0, k) + turned(2, k), across(k) - mean])
    }

    fn take_off_harmonics(&self, second: f64, velocities: &mut [Vec2]) {
        let count = self.places.len();
        for (axis, (phases, modulated)) in
            self.phases.chunks_exact(count).zip(self.modulated.chunks_exact(count)).skip(MODULATED - 2).enumerate()
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
                *velocity -= place.left[0] * harmonics * (tau + mirrored - tau.dot(mirrored) * tau);
            }
        }
    }
}

#[cfg(test)]
mod tests;
