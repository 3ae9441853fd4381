//! The stress that bodies add to a fluid.

use std::f64::consts::TAU;

use motile_base::{ImposedFlow, InputError, PeriodicSeries, Vec2};

use crate::{FlowError, Hydrodynamics, Markers, SceneError, System};

/// Mean stress of a periodic box and the part of its bodies in it (Batchelor, J. Fluid Mech. 41, 545 (1970)),
///
/// ```text
/// Sigma = -p + 2 eta e + S/V,   S = dev sym sum over bodies [ -INT F x ds + (eta_in - eta_ext) INT (v n + n v) ds ]
/// ```
///
/// with the strain rate e of the imposed flow, the area V of the box, and F the forces of the bodies on the fluid. A
/// positive S_xy in a shear of positive rate raises the viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("effective viscosity", "stresslet", "Batchelor stress", "rheology"))]
pub struct Stress {
    /// Stresslet S of all bodies together, symmetric and without trace (force times length).
    pub stresslet: [[f64; 2]; 2],
    /// Area V of the box (length squared).
    pub area: f64,
    /// Viscosity of the exterior fluid (stress times time).
    pub viscosity: f64,
    /// The imposed flow.
    pub imposed: ImposedFlow,
}

impl Stress {
    /// Returns the mean particle stress S/V (stress).
    #[must_use]
    pub fn of_particles(&self) -> [[f64; 2]; 2] {
        self.stresslet.map(|row| row.map(|entry| entry / self.area))
    }

    /// Returns the mean stress without its trace, 2 eta e + S/V (stress).
    #[must_use]
    pub fn mean(&self) -> [[f64; 2]; 2] {
        let [[ux, uy], [vx, vy]] = self.imposed.gradient;
        let rate = [[2.0 * ux, uy + vx], [uy + vx, 2.0 * vy]];
        let particles = self.of_particles();
        std::array::from_fn(|i| std::array::from_fn(|j| self.viscosity * rate[i][j] + particles[i][j]))
    }

    /// Returns the shear viscosity of the box, the mean stress Sigma_xy over the shear rate (stress times time); `None`
    /// without a shear.
    #[must_use]
    pub fn effective_viscosity(&self) -> Option<f64> {
        let [[_, uy], [vx, _]] = self.imposed.gradient;
        (uy + vx != 0.0).then(|| self.mean()[0][1] / (uy + vx))
    }

    /// Returns the first normal stress difference Sigma_xx - Sigma_yy (stress).
    #[must_use]
    pub fn normal_difference(&self) -> f64 {
        let mean = self.mean();
        mean[0][0] - mean[1][1]
    }
}

/// Returns the symmetric part without trace.
fn deviator([[xx, xy], [yx, yy]]: [[f64; 2]; 2]) -> [[f64; 2]; 2] {
    let (half, off) = (0.5 * (xx - yy), 0.5 * (xy + yx));
    [[half, off], [off, -half]]
}

/// Returns the particle stress of the body of a group of markers (force times length).
fn stresslet(markers: &Markers, group: usize, exterior: f64) -> Result<[[f64; 2]; 2], InputError> {
    let of = &markers.groups()[group];
    let lists = [markers.positions(), markers.forces(), markers.velocities()];
    let [positions, forces, velocities] = lists.map(|list| &list[of.range.clone()]);
    let origin = positions.first().copied().unwrap_or_default();
    let mut sum = markers.rigid_dipole(group).map(|row| row.map(|entry| -entry));
    for (x, force) in positions.iter().zip(forces) {
        let arm = *x - origin;
        for i in 0..2 {
            (0..2).for_each(|j| sum[i][j] -= force[i] * arm[j]);
        }
    }
    let [inside, outside] = of.viscosities(exterior);
    if inside != outside {
        let mut series = PeriodicSeries::new(positions.len())?;
        series.analyse_vectors(positions)?;
        series.differentiate();
        let factor = (inside - outside) * TAU / positions.len() as f64;
        for (tangent, v) in series.values().iter().zip(velocities) {
            let normal = factor * Vec2::new(tangent.im, -tangent.re);
            for i in 0..2 {
                (0..2).for_each(|j| sum[i][j] += v[i] * normal[j] + normal[i] * v[j]);
            }
        }
    }
    Ok(deviator(sum))
}

impl<H: Hydrodynamics> System<H> {
    /// Returns the stresslets of all bodies in the order in which they were added, as in [`Stress`] (force times
    /// length): bodies inside others have separate entries. Closed curves are integrated by their trigonometric
    /// interpolants.
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`]; [`FlowError::Refused`] if there are interfaces that are periodic
    /// along x, whose tension pulls across the ends of a period.
    pub fn stresslets(&mut self) -> Result<Vec<[[f64; 2]; 2]>, SceneError> {
        if self.markers().groups().iter().any(|group| group.kind.advance().is_some()) {
            let what = "the stresslet of an interface that is periodic along x";
            let remedy = "Average the stress over a horizontal line that crosses no interface, by `System::sample`";
            return Err(SceneError::Flow { time: self.time(), source: FlowError::unsupported(what, remedy) });
        }
        self.evaluate()?;
        let viscosity = self.hydrodynamics().fluid_view().viscosity;
        let markers = self.markers();
        let groups = 0..markers.groups().len();
        Ok(groups.map(|group| stresslet(markers, group, viscosity)).collect::<Result<_, _>>()?)
    }

    /// Returns the mean stress of a periodic box.
    ///
    /// # Errors
    /// Returns the errors of [`System::stresslets`]; [`FlowError::Refused`] if the region is not a box.
    pub fn stress(&mut self) -> Result<Stress, SceneError> {
        let view = self.hydrodynamics().fluid_view();
        let [Some(lx), Some(ly)] = *view.domain.periods else {
            let (what, remedy) = ("the mean stress of a region without an area", "Use a periodic box, or `stresslets`");
            return Err(SceneError::Flow { time: self.time(), source: FlowError::unsupported(what, remedy) });
        };
        let mut total = [[0.0; 2]; 2];
        for stresslet in self.stresslets()? {
            total.as_flattened_mut().iter_mut().zip(stresslet.as_flattened()).for_each(|(sum, part)| *sum += part);
        }
        Ok(Stress { stresslet: total, area: lx * ly, viscosity: view.viscosity, imposed: self.imposed() })
    }
}

#[cfg(test)]
mod tests;
