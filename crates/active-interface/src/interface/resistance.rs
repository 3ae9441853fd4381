//! Forces of an interface that depend on its velocities: the viscous tension of its cortex and friction with a
//! substrate.

use motile_base::{ComplexTransform, InputError, Vec2};
use motile_scene::{FluidView, Viscous};
use num_complex::Complex64;

mod rings;

use super::{
    ActiveInterface, Law, Shape,
    geometry::{Geometry, outward},
    limits::grid_spacing,
    spectral::SpectralCurve,
};
use crate::Field;
use rings::RingStresses;

/// Least viscosity of a cortex that depends on its particles, over the largest: where it vanishes the compliance would
/// be infinite.
const LEAST_VISCOSITY: f64 = 1e-9;

/// Stresses of an interface that depend on the velocities of the fluid on it, as [`Viscous`] has them:
///
/// * with a cortex the viscous tensions `eta_s Th` of the segments (force), whose rates are those at which the segments
///   stretch (length per time),
/// * with friction the forces `xi w v` of the substrate on the markers (force), outward and along, w their weights,
///   whose rates are these components of the velocities. Walls resist the component along only.
///
/// The preconditioner is the inverse for a circle of the same perimeter, on which waves of any number are independent
/// ([`Wave`]), or for a flat interface. Waves beyond those that the flow resolves are left out.
#[derive(Debug, Clone)]
pub(super) struct Resistance {
    transform: ComplexTransform,
    /// True with a cortex, and with friction.
    parts: [bool; 2],
    compliances: Vec<f64>,
    stresses: Vec<f64>,
    /// Waves of the preconditioner, number m = 0 first, and factors on the tensions before and after it.
    waves: Vec<Wave>,
    scales: Vec<f64>,
    /// Such factors on the forces of friction outward and along; empty if the friction is uniform.
    friction_scales: Vec<f64>,
    /// Friction outward and along at the markers (force times time per length squared).
    frictions: Vec<[f64; 2]>,
    /// Coefficients of the viscous tensions at the markers, and of the forces of friction, outward and along.
    coefficients: [Vec<Complex64>; 2],
    /// Tensions of the segments in all (force), with a cortex.
    pub(super) tensions: Vec<f64>,
    vectors: Vec<Vec2>,
    /// Stresses of a body of revolution, in place of the stresses of a line.
    rings: Option<Box<RingStresses>>,
}

/// Number of the waves by which the fluid gives way, in comparison with a cortex whose compliance varies.
const TYPICAL_WAVE: f64 = 4.0;

/// Friction below this fraction of the largest one counts as this fraction, as a compliance has to be finite.
const LEAST_FRICTION: f64 = 1e-9;

/// Returns the compliance of the mean stiffness.
fn mean_compliance(list: &[f64]) -> f64 {
    list.len() as f64 / list.iter().map(|compliance| compliance.recip()).sum::<f64>()
}

/// The matrix C + B M B^T for the waves of one number m on a circle or a flat interface, as its factors L D L^T.
///
/// With velocities `u cos m th` outward and `w sin m th` along a circle of radius R, forces per length are `(2 Sigma/R)
/// [[m, 1], [1, m]] (u, w)`, Sigma the sum of both viscosities, and the rate of stretching is `(u + m w)/R`. On a flat
/// interface of the wave number q they are `2 Sigma q (u, w)`, and the rate is `q w`. The stresses are the viscous
/// tension and the forces of friction outward and along.
#[derive(Debug, Clone, Copy)]
struct Wave {
    pivots: [f64; 3],
    below: [f64; 3],
}

/// Least pivot over the diagonal entry: round-off.
const LEAST_PIVOT: f64 = 1e-13;

impl Wave {
    /// Creates the waves whose stretching is `stretch` times (u, w), for markers that move at `mobility` times the
    /// force on them, with the compliances of tension and friction, of parts that there are.
    fn new(stretch: [f64; 2], mobility: [[f64; 2]; 2], compliances: [f64; 2], parts: [bool; 2]) -> Self {
        let rows = [stretch, [1.0, 0.0], [0.0, 1.0]];
        let product = |i: usize, j: usize| -> f64 {
            let moved = mobility.map(|row| row[0] * rows[j][0] + row[1] * rows[j][1]);
            rows[i][0] * moved[0] + rows[i][1] * moved[1]
        };
        let part = |i: usize| i.min(1);
        let entry = |i: usize, j: usize| match (parts[part(i)] && parts[part(j)], i == j) {
            (true, true) => compliances[part(i)] + product(i, i),
            (true, false) => product(i, j),
            (false, true) => 1.0,
            (false, false) => 0.0,
        };
        let mut diagonal = [0, 1, 2].map(|i| entry(i, i));
        if diagonal[0] == 0.0 {
            // A uniform tension of a circle that does not stretch: it does nothing, and little on other shapes.
            diagonal[0] = rows[0][0] * rows[0][0] * mobility[1][1];
        }
        let (first, down, across) = (diagonal[0], entry(1, 0) / diagonal[0], entry(2, 0) / diagonal[0]);
        let second = (diagonal[1] - down * down * first).max(LEAST_PIVOT * diagonal[1]);
        let last = (entry(2, 1) - across * down * first) / second;
        let third = diagonal[2] - across * across * first - last * last * second;
        Self { pivots: [first, second, third.max(LEAST_PIVOT * diagonal[2])], below: [down, across, last] }
    }

    /// Returns the stresses for rates.
    fn solve(&self, rates: [Complex64; 3]) -> [Complex64; 3] {
        let [down, across, last] = self.below;
        let [a, mut b, mut c] = rates;
        b -= a * down;
        c -= a * across + b * last;
        let [a, b, c] = [a / self.pivots[0], b / self.pivots[1], c / self.pivots[2]];
        let b = b - c * last;
        [a - b * down - c * across, b, c]
    }
}

impl Resistance {
    /// Creates the stresses of a law, with friction or without, on so many markers; `None` if there are none.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub(super) fn of(
        law: &Law,
        friction: bool,
        markers: usize,
        axisymmetric: bool,
    ) -> Result<Option<Box<Self>>, InputError> {
        let parts = [!law.cortex.is_none(), friction];
        if parts == [false; 2] {
            return Ok(None);
        }
        let mut made = Self {
            transform: ComplexTransform::new(markers)?,
            parts,
            compliances: Vec::new(),
            stresses: Vec::new(),
            waves: Vec::new(),
            scales: Vec::new(),
            friction_scales: Vec::new(),
            frictions: Vec::new(),
            coefficients: [0; 2].map(|_| vec![Complex64::ZERO; markers]),
            tensions: Vec::new(),
            vectors: vec![Vec2::ZERO; markers],
            rings: None,
        };
        if axisymmetric {
            made.rings = Some(Box::new(RingStresses::new(law.cortex, markers)?));
        }
        made.stresses = vec![0.0; made.count()];
        made.compliances = made.stresses.clone();
        Ok(Some(Box::new(made)))
    }

    /// Returns the number of stresses.
    pub(super) fn count(&self) -> usize {
        if let Some(rings) = &self.rings {
            return rings.count();
        }
        let [cortex, friction] = self.parts.map(usize::from);
        (cortex + 2 * friction) * self.transform.len()
    }

    /// Returns the number of markers.
    pub(super) fn markers(&self) -> usize {
        self.transform.len()
    }

    /// Returns the number of stresses of the cortex, which come first.
    fn split(&self) -> usize {
        if self.parts[0] { self.transform.len() } else { 0 }
    }

    /// Returns the viscous tensions of the segments and the forces of friction, outward and along, on the markers
    /// (force).
    pub(super) fn stresses(&self) -> &[f64] {
        &self.stresses
    }

    /// Takes over stresses of the same number, others as zero.
    pub(super) fn set_stresses(&mut self, stresses: &[f64], tensions: &[f64]) {
        if stresses.len() == self.stresses.len() {
            self.stresses.copy_from_slice(stresses);
        } else {
            self.stresses.fill(0.0);
        }
        self.add_tensions(tensions);
    }

    /// Adds the viscous tensions to the tensions of the law (force).
    pub(super) fn add_tensions(&mut self, tensions: &[f64]) {
        self.tensions.clear();
        if let Some(rings) = &mut self.rings {
            self.tensions.extend_from_slice(tensions);
            rings.write_tensions(&self.stresses, &mut self.tensions);
            return;
        }
        let viscous = self.stresses[..self.split()].iter().chain(std::iter::repeat(&0.0));
        self.tensions.extend(tensions.iter().zip(viscous).map(|(tension, viscous)| tension + viscous));
    }

    /// Computes the friction at the markers, to which a field adds at a time, and walls at these heights (length) along
    /// the interface.
    fn write_frictions(&mut self, law: &Law, shape: &Shape, field: Option<(&Field, f64)>, walls: Option<[f64; 2]>) {
        self.frictions.clear();
        self.frictions.extend(shape.markers.iter().map(|marker| {
            let all = law.friction + field.map_or(0.0, |(field, time)| field.value(*marker, time));
            let distances = walls.map_or([f64::INFINITY; 2], |[below, above]| [marker.y - below, above - marker.y]);
            let film = |distance: f64| if law.wall_film > 0.0 { law.wall_film / distance.max(0.0) } else { 0.0 };
            [all, all + distances.map(film).iter().sum::<f64>()]
        }));
        let most = self.frictions.iter().flatten().copied().filter(|value| value.is_finite()).fold(0.0, f64::max);
        let least = LEAST_FRICTION * if most > 0.0 { most } else { 1.0 };
        self.frictions.as_flattened_mut().iter_mut().for_each(|value| *value = value.max(least));
    }

    /// Computes compliances and preconditioner at the present state, at the mean viscosity of both sides (stress times
    /// time).
    fn update(&mut self, law: &Law, shape: &Shape, concentrations: &[f64], view: &FluidView, viscosity: f64) {
        let (geometry, closed) = (&shape.geometry, shape.advance == 0.0);
        let (count, split) = (self.transform.len(), self.split());
        let spans = if geometry.spans.is_empty() { &geometry.lengths } else { &geometry.spans };
        let (cortex, friction) = self.compliances.split_at_mut(split);
        let least = LEAST_VISCOSITY * concentrations.iter().map(|&c| law.cortex.viscosity_at(c)).fold(0.0, f64::max);
        for ((compliance, span), &c) in cortex.iter_mut().zip(spans).zip(concentrations) {
            *compliance = if law.cortex.inextensible { 0.0 } else { span / law.cortex.viscosity_at(c).max(least) };
        }
        let pairs = friction.chunks_exact_mut(2).zip(&self.frictions);
        for ((pair, frictions), weight) in pairs.zip(&geometry.weights) {
            pair.copy_from_slice(&frictions.map(|friction| 1.0 / (friction * weight)));
        }
        let radius = geometry.perimeter / std::f64::consts::TAU;
        let (spacing, finest) = (geometry.mean_length(), grid_spacing(view));
        let most = view.shape_modes.map_or(count, |modes| modes.min(count));
        let largest = most.saturating_sub(1) / 2;
        // The stiff places count.
        let own = [&*cortex, &*friction].map(|list| if list.is_empty() { 1.0 } else { mean_compliance(list) });
        // Velocity of a force on one marker, of the wave of number 1.
        let unit = radius / (4.0 * viscosity * spacing);
        // Where a cortex is soft, it gives way more than the fluid does.
        let fluid = unit * TYPICAL_WAVE * (spacing / radius).powi(2);
        self.scales.clear();
        self.scales.extend(cortex.iter().map(|compliance| ((own[0] + fluid) / (compliance + fluid)).sqrt()));
        self.friction_scales.clear();
        if self.frictions.iter().any(|pair| *pair != [law.friction; 2]) {
            self.friction_scales.extend(friction.iter().map(|c| ((own[1] + fluid) / (c + fluid)).sqrt()));
        }
        let waves = (0..=largest).map(|number| {
            let number = number as f64;
            let m = finest.map_or(number, |h| number.min(0.5 * std::f64::consts::PI * radius / h));
            let mobility = match number {
                _ if !closed => [[unit / m.max(1.0), 0.0], [0.0, unit / m.max(1.0)]],
                // The area stays.
                0.0 => [[0.0, 0.0], [0.0, 2.0 * unit]],
                // One half of it is a translation.
                1.0 => [[1.25 * unit, -0.75 * unit], [-0.75 * unit, 1.25 * unit]],
                _ => {
                    let unit = unit / (m * m - 1.0);
                    [[m * unit, -unit], [-unit, m * unit]]
                }
            };
            let stretch = [if closed { spacing / radius } else { 0.0 }, m * spacing / radius];
            Wave::new(stretch, mobility, own, self.parts)
        });
        self.waves.clear();
        self.waves.extend(waves);
    }

    /// Replaces rates by the stresses that cause them on a circle.
    fn precondition(&mut self, rates: &mut [f64]) {
        let (count, split) = (self.transform.len(), self.split());
        let Self {
            transform,
            parts: [has_cortex, has_friction],
            waves,
            scales,
            friction_scales,
            coefficients: [tension, force],
            ..
        } = self;
        let (cortex, friction) = rates.split_at_mut(split);
        // The lists are as long as the transform, so that its calls cannot fail.
        if *has_cortex {
            for ((out, rate), scale) in tension.iter_mut().zip(&*cortex).zip(&*scales) {
                *out = (scale * rate).into();
            }
            let _ = transform.forward(tension);
        }
        if *has_friction {
            friction.iter_mut().zip(&*friction_scales).for_each(|(rate, scale)| *rate *= scale);
            for (out, pair) in force.iter_mut().zip(friction.chunks_exact(2)) {
                *out = Complex64::new(pair[0], pair[1]);
            }
            let _ = transform.forward(force);
        }
        let scale = 1.0 / count as f64;
        let middle = std::f64::consts::PI / count as f64;
        for (m, wave) in waves.iter().enumerate() {
            let (other, shift) = ((count - m) % count, Complex64::cis(-middle * m as f64));
            let [one, two] = [force[m], force[other].conj()];
            let rates = [tension[m] * shift, 0.5 * (one + two), 0.5 * (one - two)];
            let [stress, out, along] = wave.solve(rates).map(|stress| stress * scale);
            tension[m] = stress * shift.conj();
            (force[m], force[other]) = (out + along, (out - along).conj());
            tension[other] = tension[m].conj();
        }
        let first = waves.len();
        for list in [&mut *tension, force] {
            list[first..=count - first].fill(Complex64::ZERO);
        }
        if *has_cortex {
            let _ = transform.inverse(tension);
            for ((rate, stress), scale) in cortex.iter_mut().zip(tension).zip(scales) {
                *rate = *scale * stress.re;
            }
        }
        if *has_friction {
            let _ = transform.inverse(force);
            for (pair, stress) in friction.chunks_exact_mut(2).zip(force) {
                pair.copy_from_slice(&[stress.re, stress.im]);
            }
            friction.iter_mut().zip(&*friction_scales).for_each(|(stress, scale)| *stress *= scale);
        }
    }
}

impl ActiveInterface {
    /// Makes the stresses fit the law and the number of markers.
    pub(super) fn fit_resistance(&mut self) -> Result<(), InputError> {
        let (count, law, friction) = (self.state.shape.markers.len(), &self.law, self.has_friction());
        let fits = |resistance: &Resistance| {
            resistance.markers() == count && resistance.rings.is_some() == self.state.shape.axisymmetric
        };
        if !self.scheme.resistance.as_ref().is_some_and(|resistance| fits(resistance)) {
            self.scheme.resistance = Resistance::of(law, friction, count, self.state.shape.axisymmetric)?;
            if let Some(resistance) = &mut self.scheme.resistance {
                resistance.add_tensions(&self.derived.tensions);
            }
        }
        Ok(())
    }

    /// Prepares the stresses at the present state; `viscosity` is the mean of those on both sides (stress times time).
    pub(super) fn update_resistance(&mut self, view: &FluidView, viscosity: f64) -> Result<(), InputError> {
        if self.scheme.resistance.is_some() {
            self.fit_resistance()?;
        }
        if let Some(resistance) = &mut self.scheme.resistance {
            let (law, shape, concentrations) = (&self.law, &self.state.shape, &self.derived.concentrations);
            if let Some(rings) = &mut resistance.rings {
                let viscosities = [law.viscosity_inside.unwrap_or(view.viscosity), view.viscosity];
                let of = (shape.markers.as_slice(), &shape.geometry);
                let fluids = (viscosities, view.shape_modes);
                rings.update(law.cortex, of, concentrations, fluids, &mut resistance.compliances);
            } else {
                if resistance.parts[1] {
                    let felt = self.felt.as_ref().and_then(|felt| Some((felt.fields.friction.as_ref()?, felt.time)));
                    resistance.write_frictions(law, shape, felt, view.domain.walls);
                }
                resistance.update(law, shape, concentrations, view, viscosity);
            }
        }
        Ok(())
    }

    /// Returns the stresses and the smooth curve, if there is one for all markers, with the geometry.
    fn resisting(&mut self) -> Option<(&mut Resistance, Option<&mut SpectralCurve>, &Geometry)> {
        let (scheme, geometry) = (&mut self.scheme, &self.state.shape.geometry);
        Some((scheme.resistance.as_mut()?, scheme.spectral.as_mut(), geometry))
    }
}

impl Viscous for ActiveInterface {
    fn stress_count(&self) -> usize {
        self.scheme.resistance.as_ref().map_or(0, |resistance| resistance.count())
    }

    fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]) {
        let Some((resistance, spectral, geometry)) = self.resisting() else { return };
        if let Some(rings) = &mut resistance.rings {
            return rings.write_rates(geometry, velocities, rates);
        }
        let (cortex, friction) = rates.split_at_mut(resistance.split());
        if resistance.parts[0] {
            let smooth = &mut resistance.vectors;
            smooth.copy_from_slice(velocities);
            if let Some(spectral) = spectral {
                spectral.sharpen(smooth);
            }
            let after = smooth.iter().cycle().skip(1);
            for ((rate, direction), (here, next)) in
                cortex.iter_mut().zip(&geometry.directions).zip(smooth.iter().zip(after))
            {
                *rate = (*next - *here).dot(*direction);
            }
        }
        for ((pair, velocity), tau) in friction.chunks_exact_mut(2).zip(velocities).zip(&geometry.tangents) {
            pair.copy_from_slice(&[velocity.dot(outward(*tau)), velocity.dot(*tau)]);
        }
    }

    fn add_stress_forces(&mut self, stresses: &[f64], forces: &mut [Vec2]) {
        let Some((resistance, spectral, geometry)) = self.resisting() else { return };
        if let Some(rings) = &mut resistance.rings {
            return rings.add_forces(geometry, stresses, forces);
        }
        let (cortex, friction) = stresses.split_at(resistance.split());
        if resistance.parts[0] {
            let own = &mut resistance.vectors;
            geometry.write_pulls(cortex, own);
            if let Some(spectral) = spectral {
                spectral.sharpen(own);
            }
            forces.iter_mut().zip(own).for_each(|(force, own)| *force += *own);
        }
        for ((pair, force), tau) in friction.chunks_exact(2).zip(forces).zip(&geometry.tangents) {
            *force -= pair[0] * outward(*tau) + pair[1] * *tau;
        }
    }

    fn write_compliances(&self, compliances: &mut [f64]) {
        if let Some(resistance) = &self.scheme.resistance {
            compliances.copy_from_slice(&resistance.compliances);
        }
    }

    fn precondition(&mut self, rates: &mut [f64]) {
        if let Some((resistance, ..)) = self.resisting() {
            match &mut resistance.rings {
                Some(rings) => rings.precondition(rates),
                None => resistance.precondition(rates),
            }
        }
    }

    fn stresses(&self) -> &[f64] {
        self.scheme.resistance.as_ref().map_or(&[], |resistance| resistance.stresses())
    }

    fn set_stresses(&mut self, stresses: &[f64]) {
        if let Some(resistance) = &mut self.scheme.resistance {
            resistance.set_stresses(stresses, &self.derived.tensions);
        }
    }
}

#[cfg(test)]
mod tests;
