//! Viscous stresses of the cortex of a body of revolution.

use std::f64::consts::{PI, TAU};

use motile_base::{InputError, PeriodicSeries, Vec2};
use num_complex::Complex64;

use super::{Geometry, LEAST_VISCOSITY};
use crate::Cortex;

/// Part of the waves along the meridian that stresses have: forces are the transpose of rates of stretching as long
/// as products with the geometry are resolved too.
const RESOLVED: f64 = 2.0 / 3.0;

/// Viscous stresses of a cortex at the markers of the meridian from one pole to the other (Boussinesq and Scriven).
///
/// The stresses are the isotropic one, `s = kappa_d (e_1 + e_2)`, and half the difference of those along the meridian
/// and around the axis, `d = mu_s (e_1 - e_2)` (force per length). The rates of stretching are `e_1 = tau.dv/ds` along
/// the meridian and `e_2 = v_y/y` around the axis (1/time). With the areas A of rings, rates of deformation are
/// `A (e_1 + e_2)` and `A (e_1 - e_2)`, so that rates times stresses are powers.
///
/// Forces are densities at the markers, of which the fluid sees a smooth function. Their power in velocities is a sum
/// over the markers with weights that are exact for smooth functions, and so are the areas. In these weights, the
/// forces are the transpose of the rates as far as both are resolved. Stresses therefore are sums of spherical
/// harmonics of low degree. For these, the preconditioner is the inverse for a sphere of the same area.
#[derive(Debug, Clone)]
pub(super) struct RingStresses {
    /// Number of segments from pole to pole.
    half: usize,
    series: PeriodicSeries,
    /// True with a dilatational viscosity, and with a shear viscosity.
    parts: [bool; 2],
    /// Harmonics at the markers, of degrees from 0 for the isotropic stress and from 2 for the difference, one degree
    /// after the other. They are orthonormal in sin(theta).
    harmonics: [Vec<f64>; 2],
    degrees: usize,
    /// Inverse of the equations for a sphere by degree, `[ss, sd, dd]`.
    inverse: Vec<[f64; 3]>,
    amplitudes: [Vec<f64>; 2],
    /// Areas of the rings (length squared), and distances of the markers from the axis (length).
    areas: Vec<f64>,
    distances: Vec<f64>,
    /// Dilatational viscosities at the markers (force times time per length).
    viscosities: Vec<f64>,
    pulls: Vec<Complex64>,
}

/// Returns orthonormal Legendre functions of an order at equal angles from 0 to pi, from the degree `order` on.
fn legendre(order: usize, degrees: usize, half: usize) -> Vec<f64> {
    let square = |l: usize| (l * l) as f64;
    let mut values = Vec::with_capacity((degrees + 1) * (half + 1));
    for l in order..=degrees {
        for k in 0..=half {
            let (sin, cos) = (PI * k as f64 / half as f64).sin_cos();
            let before = |back: usize| values[(l - order - back) * (half + 1) + k];
            let value = if l == order {
                if order == 0 { 0.5_f64.sqrt() } else { 3.0 / 9.6_f64.sqrt() * sin * sin }
            } else {
                let m = square(order);
                let factor = ((4.0 * square(l) - 1.0) / (square(l) - m)).sqrt();
                let second = if l > order + 1 {
                    ((square(l - 1) - m) / (4.0 * square(l - 1) - 1.0)).sqrt() * before(2)
                } else {
                    0.0
                };
                factor * (cos * before(1) - second)
            };
            values.push(value);
        }
    }
    values
}

impl RingStresses {
    /// Creates the stresses of a cortex on so many markers, an even number.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub(super) fn new(cortex: Cortex, markers: usize) -> Result<Self, InputError> {
        let half = markers / 2;
        let parts = [cortex.viscosity > 0.0 || cortex.per_concentration > 0.0, cortex.shear_viscosity > 0.0];
        Ok(Self {
            half,
            series: PeriodicSeries::new(markers)?,
            parts,
            harmonics: [Vec::new(), Vec::new()],
            degrees: 0,
            inverse: Vec::new(),
            amplitudes: [Vec::new(), Vec::new()],
            areas: vec![0.0; half + 1],
            distances: vec![0.0; half + 1],
            viscosities: vec![0.0; markers],
            pulls: vec![Complex64::ZERO; markers],
        })
    }

    /// Returns the number of stresses: both kinds at the markers from pole to pole.
    pub(super) fn count(&self) -> usize {
        2 * (self.half + 1)
    }

    /// Prepares the present state: areas, compliances, and the preconditioner, for viscosities of the fluids inside and
    /// outside (stress times time), and so many modes of the flow.
    pub(super) fn update(
        &mut self,
        cortex: Cortex,
        (markers, geometry): (&[Vec2], &Geometry),
        concentrations: &[f64],
        ([inside, outside], waves): ([f64; 2], Option<usize>),
        compliances: &mut [f64],
    ) {
        let half = self.half;
        let own = (RESOLVED * half as f64) as usize;
        let degrees = waves.map_or(own, |modes| own.min(modes.saturating_sub(1) / 2)).max(2);
        if degrees != self.degrees {
            self.degrees = degrees;
            self.harmonics = [0, 2].map(|order| legendre(order, degrees, half));
            self.inverse = vec![[0.0; 3]; degrees + 1];
            self.amplitudes = [0; 2].map(|_| vec![0.0; degrees + 1]);
        }
        for (k, (area, distance)) in self.areas.iter_mut().zip(&mut self.distances).enumerate() {
            // The poles have no area.
            *area = if k % half == 0 { 0.0 } else { 2.0 * geometry.rings.weights[k] };
            *distance = markers[k].y;
        }
        self.fill_viscosities(cortex, geometry, concentrations);
        let surface: f64 = self.areas.iter().sum();
        let (of_area, of_shear) = compliances.split_at_mut(half + 1);
        let mut stiffness = 0.0;
        for ((compliance, area), viscosity) in of_area.iter_mut().zip(&self.areas).zip(&self.viscosities) {
            *compliance = if self.parts[0] { area / viscosity } else { 0.0 };
            stiffness += area * viscosity;
        }
        for (compliance, area) in of_shear.iter_mut().zip(&self.areas) {
            *compliance = if self.parts[1] { area / cortex.shear_viscosity } else { 0.0 };
        }
        let mean = [stiffness / surface, cortex.shear_viscosity];
        let radius = (surface / (4.0 * PI)).sqrt();
        for (degree, inverse) in self.inverse.iter_mut().enumerate() {
            *inverse = sphere(degree, radius, mean, [inside, outside], self.parts);
        }
    }

    /// Computes the viscosities at the markers from the concentrations on the segments, as tensions are taken over.
    fn fill_viscosities(&mut self, cortex: Cortex, geometry: &Geometry, concentrations: &[f64]) {
        self.viscosities.fill(cortex.viscosity);
        if cortex.per_concentration == 0.0 {
            return;
        }
        let spacing = TAU / self.viscosities.len() as f64;
        let own = concentrations.iter().zip(&geometry.lengths).map(|(c, length)| (c * length).into());
        // As many as the series has, so that this cannot fail.
        let _ = self.series.analyse(own);
        self.series.multiply(|wave| {
            let half = 0.5 * wave * spacing;
            Complex64::cis(-half) * if half == 0.0 { 1.0 } else { half / half.sin() }
        });
        for ((out, value), weight) in self.viscosities.iter_mut().zip(self.series.values()).zip(&geometry.weights) {
            *out = cortex.viscosity_at(value.re / weight);
        }
        let least = LEAST_VISCOSITY * self.viscosities.iter().copied().fold(0.0, f64::max);
        self.viscosities.iter_mut().for_each(|viscosity| *viscosity = viscosity.max(least));
    }

    /// Writes the rates of deformation from the velocities of the markers.
    pub(super) fn write_rates(&mut self, geometry: &Geometry, velocities: &[Vec2], rates: &mut [f64]) {
        let _ = self.series.analyse_vectors(velocities);
        self.series.differentiate();
        let slopes = self.series.values();
        let (of_area, of_shear) = rates.split_at_mut(self.half + 1);
        for (k, (sum, difference)) in of_area.iter_mut().zip(of_shear).enumerate() {
            if self.areas[k] == 0.0 {
                (*sum, *difference) = (0.0, 0.0);
                continue;
            }
            let (slope, tau) = (slopes[k], geometry.tangents[k]);
            let along = (slope.re * tau.x + slope.im * tau.y) / geometry.stretch[k];
            let around = velocities[k].y / self.distances[k];
            *sum = if self.parts[0] { self.areas[k] * (along + around) } else { 0.0 };
            *difference = if self.parts[1] { self.areas[k] * (along - around) } else { 0.0 };
        }
    }

    /// Adds the forces on the fluid (force, on halves of rings) of stresses: `pi INT g dalpha` over a marker's piece
    /// with `g = d((s + d) y tau)/dalpha - (s - d) |X_alpha|` across the axis, as densities at the markers.
    pub(super) fn add_forces(&mut self, geometry: &Geometry, stresses: &[f64], forces: &mut [Vec2]) {
        let (count, half) = (2 * self.half, self.half);
        let (of_area, of_shear) = stresses.split_at(half + 1);
        let own = |k: usize| k.min(count - k);
        let angle = |k: usize| TAU * k as f64 / count as f64;
        // y over sin(alpha): the pull is sin(alpha) times a smooth function, so that no force comes out of the poles.
        for (k, pull) in self.pulls.iter_mut().enumerate() {
            let (along, tau) = (of_area[own(k)] + of_shear[own(k)], geometry.tangents[k]);
            let ratio = if k % half == 0 { geometry.stretch[k] } else { self.distances[own(k)] / angle(own(k)).sin() };
            *pull = along * ratio * Complex64::new(tau.x, tau.y);
        }
        let _ = self.series.analyse(self.pulls.iter().copied());
        self.series.differentiate();
        let slopes = self.series.values();
        let factor = PI * TAU / count as f64;
        for (k, force) in forces.iter_mut().enumerate() {
            if k % half == 0 {
                continue;
            }
            let side = if k > half { -factor } else { factor };
            let (sin, cos) = angle(k).sin_cos();
            let (pull, slope) = (self.pulls[k], slopes[k]);
            let hoop = (of_area[own(k)] - of_shear[own(k)]) * geometry.stretch[k];
            *force += side * Vec2::new(cos * pull.re + sin * slope.re, cos * pull.im + sin * slope.im - hoop);
        }
    }

    /// Replaces rates by the stresses that cause them on a sphere.
    pub(super) fn precondition(&mut self, rates: &mut [f64]) {
        let width = self.half + 1;
        let lists = rates.split_at_mut(width);
        let lists = [lists.0, lists.1];
        for (order, list) in [0, 2].into_iter().zip(&lists) {
            let kind = order / 2;
            self.amplitudes[kind].fill(0.0);
            for (row, amplitude) in
                self.harmonics[kind].chunks_exact(width).zip(&mut self.amplitudes[kind][order..=self.degrees])
            {
                *amplitude = row.iter().zip(&**list).map(|(a, b)| a * b).sum();
            }
        }
        let [sums, differences] = &mut self.amplitudes;
        for (([ss, sd, dd], s), d) in self.inverse.iter().zip(sums).zip(differences) {
            (*s, *d) = (ss * *s + sd * *d, sd * *s + dd * *d);
        }
        for (order, list) in [0, 2].into_iter().zip(lists) {
            let kind = order / 2;
            list.fill(0.0);
            for (row, amplitude) in
                self.harmonics[kind].chunks_exact(width).zip(&self.amplitudes[kind][order..=self.degrees])
            {
                list.iter_mut().zip(row).for_each(|(out, value)| *out += amplitude * value);
            }
        }
    }

    /// Writes the isotropic stresses at the middles of all segments (force per length).
    pub(super) fn write_tensions(&mut self, stresses: &[f64], tensions: &mut [f64]) {
        let count = 2 * self.half;
        let _ = self.series.analyse((0..count).map(|k| stresses[k.min(count - k)].into()));
        self.series.shift(PI / count as f64);
        for (tension, value) in tensions.iter_mut().zip(self.series.values()) {
            *tension += value.re;
        }
    }
}

/// Returns the inverse of `C + B M B^T` for orthonormal harmonics of a degree on a sphere, for viscosities of the
/// cortex and of the fluids, `[ss, sd, dd]`, from Lamb's solution. With velocities `u Y` outward and `w grad Y` along
/// the sphere, `Th = (2 u - l (l+1) w) Y/R`, and the difference of the rates is `w Y_2/R`, Y_2 of the order 2.
fn sphere(degree: usize, radius: f64, cortex: [f64; 2], [i, e]: [f64; 2], [stretches, shears]: [bool; 2]) -> [f64; 3] {
    let l = degree as f64;
    let waves = l * (l + 1.0);
    let unit = TAU * radius;
    let [own, own_shear] = cortex.map(|viscosity| unit * radius / viscosity);
    if degree == 0 {
        // The volume stays.
        return [if stretches { 1.0 / own } else { 0.0 }, 0.0, 0.0];
    }
    let uu = i * (2.0 * l * l + l + 3.0) / l + e * (2.0 * l * l + 3.0 * l + 4.0) / (l + 1.0);
    let uw = -3.0 * (i * (l + 1.0) + e * l);
    let ww = waves * (2.0 * l + 1.0) * (i + e);
    let determinant = uu * ww - uw * uw;
    let order = (waves * (waves - 2.0)).sqrt();
    let ss = (4.0 * ww + 4.0 * waves * uw + waves * waves * uu) / determinant;
    let sd = order * (-2.0 * uw - waves * uu) / determinant;
    let dd = order * order * uu / determinant;
    let [ss, sd, dd] = [own + unit * ss, unit * sd, own_shear + unit * dd];
    match (stretches, shears && degree > 1) {
        (true, true) => {
            let determinant = ss * dd - sd * sd;
            [dd / determinant, -sd / determinant, ss / determinant]
        }
        (true, false) => [1.0 / ss, 0.0, 0.0],
        (false, true) => [0.0, 0.0, 1.0 / dd],
        (false, false) => [0.0; 3],
    }
}
