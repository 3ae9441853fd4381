//! Moments of the interface's force, which determine the flow far away from a droplet.

use motile_base::{
    InputError, Vec2, finite,
    internal::{all_points_finite, at_least},
    same_length,
};
use motile_scene::Enclosed;

use super::frame::{Frame, weighted_normals};
use crate::InterfaceError;

/// Sign of the viscous term in the force moments of a droplet whose viscosity differs from the exterior one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Convention {
    /// The sign that matches the flow far away for the force F as in Cowley, eq. (2.5): + (eta_ext - eta_in). (For
    /// the flow itself the second moment needs twice its viscous term and a pressure dipole besides.)
    #[default]
    FarField,
    /// Eqs. (2.49) and (2.50) as they are printed: - (eta_ext - eta_in).
    AsPrinted,
}

impl Convention {
    /// Returns the factor of the viscous term between viscosities inside and outside (stress times time).
    pub(super) fn factor(self, [inside, outside]: [f64; 2]) -> Result<f64, InputError> {
        let difference = finite("the viscosity outside", outside)? - finite("the viscosity inside", inside)?;
        Ok(if self == Self::FarField { difference } else { -difference })
    }
}

/// Force moments about the centroid of a droplet, in axes along its motion (index 0: along, 1: across).
///
/// ```text
/// F_i   = sum F_i                                                                       (2.48)
/// F_ij  = sum F_i r_j     +- (eta_ext - eta_in) sum (v_j n_i + v_i n_j) ds               (2.49)
/// F_ijk = sum F_i r_j r_k +- (eta_ext - eta_in) sum (v_j n_i + v_i n_j) r_k ds           (2.50)
/// ```
/// with F_i the force on the fluid at a marker, r from the centroid of the area, v the velocity of the fluid at the
/// marker, n the outward normal, and the sign of the [`Convention`]. Sums over the markers; second order in their
/// spacing.
///
/// Those of a droplet are the moments of everything in it: bodies inside add the sums over their own markers, with
/// eta_ext the viscosity of the fluid that they lie in, and rigid ones the dipole of what keeps them rigid. Then F_ij
/// is, up to a pressure, the force dipole of a closed curve around all of it, `INT eta (v n + n v) - (sigma n) r ds`
/// (Batchelor, J. Fluid Mech. 41, 545 (1970)).
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ForceMoments {
    /// F_i (force): zero to round-off for a free droplet.
    pub force: [f64; 2],
    /// F_ij (force times length).
    pub dipole: [[f64; 2]; 2],
    /// F_ijk (force times length squared); `None` with a rigid body inside, on whose surface the forces are not known.
    pub quadrupole: Option<[[[f64; 2]; 2]; 2]>,
    /// True for a body of revolution in three dimensions, whose dipole across both directions is F_yy.
    pub in_space: bool,
}

impl ForceMoments {
    /// Returns the stresslet S_ij (force times length), the symmetric part of F_ij without trace, eq. (2.52). S_xx > 0
    /// is a pusher.
    #[must_use]
    pub fn stresslet(&self) -> [[f64; 2]; 2] {
        let [[xx, xy], [yx, yy]] = self.dipole;
        let (along, across) = if self.in_space { (2.0 / 3.0, -1.0 / 3.0) } else { (0.5, -0.5) };
        let off = 0.5 * (xy + yx);
        [[along * (xx - yy), off], [off, across * (xx - yy)]]
    }

    /// Returns the stresslet S_ij in the axes x and y (force times length), of moments in the axes of `frame`.
    #[must_use]
    pub fn stresslet_in_laboratory(&self, frame: &Frame) -> [[f64; 2]; 2] {
        let stresslet = self.stresslet();
        if self.in_space {
            return stresslet;
        }
        let [[along, across], _] = stresslet;
        // Products of the axes, exact for those along x and y.
        let Vec2 { x, y } = frame.direction();
        let (cos, sin) = (x * x - y * y, 2.0 * x * y);
        let (xx, xy) = (cos * along - sin * across, sin * along + cos * across);
        [[xx, xy], [xy, -xx]]
    }

    /// Adds the moments of a body inside, with velocities relative to `drift` (length per time).
    pub(super) fn add_body(
        &mut self,
        body: &Enclosed,
        drift: Vec2,
        convention: Convention,
        frame: &Frame,
    ) -> Result<(), InputError> {
        let Enclosed { positions, forces, velocities, viscosities, rigid_dipole } = body;
        let factor = convention.factor(*viscosities)?;
        let velocities: Vec<Vec2> = velocities.iter().map(|velocity| velocity - drift).collect();
        self.add(positions, forces, &velocities, factor, frame);
        if let Some(dipole) = rigid_dipole {
            self.quadrupole = None;
            let axes = [Vec2::X, Vec2::Y].map(|axis| frame.components(axis));
            for i in 0..2 {
                for j in 0..2 {
                    let entry = |(k, l): (usize, usize)| axes[k][i] * dipole[k][l] * axes[l][j];
                    self.dipole[i][j] += [(0, 0), (0, 1), (1, 0), (1, 1)].map(entry).iter().sum::<f64>();
                }
            }
        }
        Ok(())
    }

    /// Adds the sums over markers, `factor` being the factor of the viscous term (stress times time).
    fn add(&mut self, markers: &[Vec2], forces: &[Vec2], velocities: &[Vec2], factor: f64, frame: &Frame) {
        for (((&marker, &force), &velocity), normal) in
            markers.iter().zip(forces).zip(velocities).zip(weighted_normals(markers))
        {
            let r = frame.coordinates(marker);
            let (f, v, n) = (frame.components(force), frame.components(velocity), frame.components(normal));
            for i in 0..2 {
                self.force[i] += f[i];
                for j in 0..2 {
                    let first = f[i] * r[j] + factor * (v[j] * n[i] + v[i] * n[j]);
                    self.dipole[i][j] += first;
                    if let Some(quadrupole) = &mut self.quadrupole {
                        (0..2).for_each(|k| quadrupole[i][j][k] += first * r[k]);
                    }
                }
            }
        }
    }

    /// Returns the symmetric part S_ijk of F_ijk (force times length squared), the mean over the six orders of the
    /// indices, eq. (2.54); `None` as [`ForceMoments::quadrupole`].
    #[must_use]
    pub fn symmetric_quadrupole(&self) -> Option<[[[f64; 2]; 2]; 2]> {
        let f = self.quadrupole.as_ref()?;
        let sum =
            |i: usize, j: usize, k: usize| f[i][j][k] + f[i][k][j] + f[j][i][k] + f[j][k][i] + f[k][i][j] + f[k][j][i];
        Some(build(|i, j, k| sum(i, j, k) / 6.0))
    }

    /// Returns the part of mixed symmetry N_ijk = F_ijk - S_ijk (force times length squared), eq. (2.53), related to
    /// the source dipole. The totally antisymmetric part A_ijk is zero in two dimensions.
    #[must_use]
    pub fn mixed_quadrupole(&self) -> Option<[[[f64; 2]; 2]; 2]> {
        let (all, symmetric) = (self.quadrupole?, self.symmetric_quadrupole()?);
        Some(build(|i, j, k| all[i][j][k] - symmetric[i][j][k]))
    }
}

fn build(entry: impl Fn(usize, usize, usize) -> f64) -> [[[f64; 2]; 2]; 2] {
    std::array::from_fn(|i| std::array::from_fn(|j| std::array::from_fn(|k| entry(i, j, k))))
}

/// Returns the force moments of a droplet in the axes of `frame`, whose origin must be the centroid of its area.
///
/// `forces` act on the fluid at the markers (force, not force per length), `velocities` are the velocities of the fluid
/// there (length per time, in the frame of the fluid far away; they matter for unequal viscosities only), `viscosities`
/// the viscosities inside and outside (stress times time).
///
/// # Errors
/// Returns an error for slices of different length, fewer than three markers, values that are not finite.
pub fn force_moments(
    markers: &[Vec2],
    forces: &[Vec2],
    velocities: &[Vec2],
    viscosities: [f64; 2],
    convention: Convention,
    frame: &Frame,
) -> Result<ForceMoments, InterfaceError> {
    at_least("markers", markers.len(), 3)?;
    same_length("forces", markers.len(), forces.len())?;
    same_length("velocities", markers.len(), velocities.len())?;
    all_points_finite("the markers", markers)?;
    all_points_finite("the forces", forces)?;
    all_points_finite("the velocities", velocities)?;
    let mut sums = ForceMoments { quadrupole: Some(Default::default()), ..ForceMoments::default() };
    sums.add(markers, forces, velocities, convention.factor(viscosities)?, frame);
    Ok(sums)
}

#[cfg(test)]
mod tests;
