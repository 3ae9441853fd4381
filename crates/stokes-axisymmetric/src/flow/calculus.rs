//! Forces of a surface tension on a surface of revolution.

use std::f64::consts::PI;

use motile_base::{PeriodicSeries, Vec2, same_length, within};
use num_complex::Complex64;

use crate::refusal::odd_points;
use stokes_boundary_integrals::{LayerError, TensionPlacement, internal::MOST_POINTS};

/// Forces of a surface tension on surfaces of revolution, given by the closed curve of meridian and mirror image as in
/// [`AxisymmetricFlow`](super::AxisymmetricFlow), for a fixed number of points. Nothing is allocated after
/// construction.
#[derive(Debug, Clone)]
pub struct MeridianCalculus {
    curve: PeriodicSeries,
    pull: PeriodicSeries,
    slope: PeriodicSeries,
    hoop: PeriodicSeries,
    tangents: Vec<Vec2>,
}

impl MeridianCalculus {
    /// Creates a plan for closed curves of `len` points, an even number.
    ///
    /// # Errors
    /// Returns an error for fewer than 4 points, more than 1,048,576, an odd number.
    pub fn new(len: usize) -> Result<Self, LayerError> {
        within("the number of points", len as f64, 4.0, MOST_POINTS)?;
        if !len.is_multiple_of(2) {
            return Err(odd_points(len));
        }
        let series = PeriodicSeries::new(len)?;
        let [curve, pull, slope] = [(); 3].map(|()| series.clone());
        Ok(Self { curve, pull, slope, hoop: series, tangents: vec![Vec2::ZERO; len] })
    }

    /// Writes the forces on the fluid (force) at the points, of the surface tension gamma (force per length). With the
    /// force f per area, the force per t and azimuth is `g = r |X_t| f`,
    ///
    /// ```text
    /// g_x = d(gamma r tau_x)/dt        g_r = d(gamma r tau_r)/dt - gamma |X_t|
    /// ```
    ///
    /// the second term being the pull around the axis; point k gets `2 pi^2/len` times that, the force on half a ring.
    ///
    /// # Errors
    /// Returns an error for slices of another length than planned for.
    pub fn tension_forces(
        &mut self,
        positions: &[Vec2],
        tension: &[f64],
        placement: TensionPlacement,
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        self.stress_forces(positions, [tension; 2], placement, forces)
    }

    /// Writes the forces on the fluid (force) at the points, of stresses along the meridian and around the axis (force
    /// per length). They follow from [`MeridianCalculus::tension_forces`], with the stress along in `gamma r tau`, and
    /// the stress around in the pull around the axis. Both are equal at the poles of a smooth surface.
    ///
    /// # Errors
    /// Returns an error for slices of another length than planned for.
    pub fn stress_forces(
        &mut self,
        positions: &[Vec2],
        [tension, around]: [&[f64]; 2],
        placement: TensionPlacement,
        forces: &mut [Vec2],
    ) -> Result<(), LayerError> {
        let len = self.curve.len();
        same_length("values", len, positions.len())?;
        same_length("tension", len, tension.len())?;
        same_length("the stress around the axis", len, around.len())?;
        same_length("out", len, forces.len())?;
        let shift = placement.shift(len);
        self.curve.analyse_vectors(positions)?;
        self.curve.differentiate();
        self.curve.shift(shift);
        self.curve.write_vectors(&mut self.tangents)?;
        self.curve.analyse_vectors(positions)?;
        self.curve.shift(shift);
        // The part along the meridian is sin(t) times a function h whose series is differentiated, so that no force
        // comes out of the poles: there r/sin(t) is the slope of r.
        let angle = |k: usize| 2.0 * PI * k as f64 / len as f64;
        let points = self.curve.values().iter().zip(&self.tangents).zip(tension).enumerate();
        let pull = |(k, ((place, tangent), tension)): (usize, ((&Complex64, &Vec2), &f64))| {
            let at_pole = shift == 0.0 && (2 * k).is_multiple_of(len);
            let ratio = if at_pole { tangent.y.abs() } else { place.im / (angle(k) + shift).sin() };
            let factor = tension * ratio / tangent.length();
            Complex64::new(factor * tangent.x, factor * tangent.y)
        };
        self.pull.analyse(points.map(pull))?;
        self.pull.shift(-shift);
        self.slope.resample(&self.pull);
        self.slope.differentiate();
        let hoop = self.tangents.iter().zip(around).map(|(tangent, around)| around * tangent.length());
        self.hoop.analyse(hoop.map(|value| Complex64::new(0.0, value)))?;
        self.hoop.shift(-shift);
        let factor = 2.0 * PI * PI / len as f64;
        let parts = self.pull.values().iter().zip(self.slope.values()).zip(self.hoop.values());
        for (k, (force, ((pull, slope), hoop))) in forces.iter_mut().zip(parts).enumerate() {
            let side = if 2 * k > len { -factor } else { factor };
            let (sin, cos) = angle(k).sin_cos();
            *force = side * Vec2::new(cos * pull.re + sin * slope.re, cos * pull.im + sin * slope.im - hoop.im);
        }
        // Both vanish at the poles.
        (forces[0], forces[len / 2]) = (Vec2::ZERO, Vec2::ZERO);
        Ok(())
    }
}
