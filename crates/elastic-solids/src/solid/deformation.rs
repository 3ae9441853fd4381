//! Measurements on a deformed solid.

use motile_base::Vec2;
use motile_scene::{BodyError, BodyFlow, FluidView, Observe};

use crate::material::Mat2;
use crate::{Solid, SolidError};

/// Area ratio of a triangle below which a solid that flows is at its end (no dimension).
const LEAST_RATIO: f64 = 0.02;

/// Measurements on a solid at one time (`scene.observe(solid)?`). Displacements are those from the reference state.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Deformation {
    /// Largest displacement of a point, in any direction (length).
    pub largest_displacement: f64,
    /// Largest displacement of a point of the surface along the normal of the reference state, outwards or inwards
    /// (length). Walls move mostly along their surface, so this number is much smaller.
    pub largest_normal_displacement: f64,
    /// Mean displacement, weighted by reference area (length): the drift of a solid that nothing holds.
    pub drift: Vec2,
    /// Mean position, weighted by reference area (length): the centre of mass.
    pub centroid: Vec2,
    /// Elastic energy (energy), without the energy of tethers and Maxwell elements; infinite if a triangle is inverted
    /// and the energy is not defined for it.
    pub elastic_energy: f64,
    /// Energy of the Maxwell elements (energy); zero without any.
    pub relaxing_energy: f64,
    /// Energy that the Maxwell elements dissipate (energy per time), in which the fluid has no part.
    pub dissipation: f64,
    /// Fraction of the active springs that are on (no dimension); not a number without any.
    pub active_part: f64,
    /// Energy of the tethers (energy).
    pub tether_energy: f64,
    /// Smallest ratio J of the deformed to the reference area of a triangle; negative where one is inverted.
    pub smallest_jacobian: f64,
}

impl Deformation {
    /// Measures a solid in its present state.
    #[must_use]
    pub fn of(solid: &Solid) -> Self {
        let mesh = &solid.mesh;
        let weights = mesh.point_areas();
        let mean = |places: &mut dyn Iterator<Item = Vec2>| -> Vec2 {
            places.zip(&weights).map(|(place, &weight)| place * weight).sum::<Vec2>() / mesh.area()
        };
        Self {
            largest_displacement: solid.displacements().map(Vec2::length).fold(0.0, f64::max),
            largest_normal_displacement: solid.largest_normal_displacement(),
            drift: mean(&mut solid.displacements()),
            centroid: mean(&mut solid.positions.iter().copied()),
            elastic_energy: solid.elastic_energy().unwrap_or(f64::INFINITY),
            relaxing_energy: solid.relaxing_energy().unwrap_or(f64::INFINITY),
            dissipation: solid.dissipation().unwrap_or(f64::INFINITY),
            active_part: solid
                .active_bonds()
                .map_or(f64::NAN, |on| on.iter().filter(|on| **on).count() as f64 / on.len().max(1) as f64),
            tether_energy: solid.tether_energy(),
            smallest_jacobian: solid.smallest_jacobian().0,
        }
    }
}

impl Observe for Solid {
    type Observables = Deformation;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<Deformation, BodyError> {
        Ok(Deformation::of(self))
    }
}

impl Solid {
    /// Returns the displacement of each point from the reference state (length).
    pub fn displacements(&self) -> impl Iterator<Item = Vec2> {
        self.positions.iter().zip(self.mesh.points()).map(|(now, reference)| now - reference)
    }

    fn largest_normal_displacement(&self) -> f64 {
        let mut largest = 0.0_f64;
        for boundary in self.mesh.boundary_loops() {
            let polygon = self.mesh.raw_polygon(boundary, self.mesh.points());
            let count = polygon.len();
            let advance = Vec2::new(f64::from(boundary.periods) * self.mesh.period().unwrap_or(0.0), 0.0);
            for (k, &point) in boundary.points.iter().enumerate() {
                let before = if k == 0 { polygon[count - 1] - advance } else { polygon[k - 1] };
                let after = if k + 1 == count { polygon[0] + advance } else { polygon[k + 1] };
                let along = (after - before).try_normalize().unwrap_or_default();
                let displacement = self.positions[point] - self.mesh.points()[point];
                largest = largest.max(along.perp_dot(displacement).abs());
            }
        }
        largest
    }

    /// Returns the energy of the Maxwell elements (energy); zero without any.
    ///
    /// # Errors
    /// Returns an error for an inverted triangle.
    pub fn relaxing_energy(&self) -> Result<f64, SolidError> {
        self.relaxation.as_ref().map_or(Ok(0.0), |relaxation| Ok(relaxation.energies(&self.positions)?[0]))
    }

    /// Returns the energy that the Maxwell elements dissipate (energy per time), without what the fluid does; zero
    /// without any.
    ///
    /// # Errors
    /// Returns an error for an inverted triangle.
    pub fn dissipation(&self) -> Result<f64, SolidError> {
        self.relaxation.as_ref().map_or(Ok(0.0), |relaxation| Ok(relaxation.energies(&self.positions)?[1]))
    }

    /// Returns the active springs that are on, in the order of [`crate::mesh::TriangleMesh::edges`]; `None` without
    /// any.
    #[must_use]
    pub fn active_bonds(&self) -> Option<&[bool]> {
        self.bonds.as_ref().map(crate::active_springs::Bonds::on)
    }

    /// Returns the Cauchy stress (force per deformed length) in each triangle that is not elastic: of Maxwell elements
    /// and active springs; `None` without any.
    ///
    /// # Errors
    /// Returns an error for an inverted triangle.
    pub fn internal_stresses(&self) -> Result<Option<Vec<Mat2>>, SolidError> {
        if self.relaxation.is_none() && self.bonds.is_none() {
            return Ok(None);
        }
        self.check_inversion()?;
        let mut stresses = vec![Mat2::ZERO; self.mesh.triangles().len()];
        if let Some(relaxation) = &self.relaxation {
            relaxation.add_stresses(&self.mesh, &self.positions, &mut stresses);
        }
        if let Some(bonds) = &self.bonds {
            bonds.add_stresses(&self.mesh, &self.positions, &mut stresses);
        }
        Ok(Some(stresses))
    }

    /// Returns the elastic energy (energy), without the energy of tethers and Maxwell elements.
    ///
    /// # Errors
    /// Returns an error for an inverted triangle where the energy is not defined for it.
    pub fn elastic_energy(&self) -> Result<f64, SolidError> {
        let surface = self.surface_elasticity.as_ref().map_or(0.0, |surface| surface.energy(&self.positions));
        Ok(self.law.energy(&self.positions)? + surface)
    }

    /// Returns the energy of the tethers (energy).
    #[must_use]
    pub fn tether_energy(&self) -> f64 {
        let stretch = |point: usize, anchor: Vec2| (self.positions[point] - anchor).length_squared();
        self.tethers.iter().map(|tether| 0.5 * tether.stiffness * stretch(tether.point, tether.anchor)).sum()
    }

    /// Returns the determinant J of the deformation gradient of each triangle, its deformed over its reference area (no
    /// dimension); negative for an inverted triangle.
    pub fn jacobians(&self) -> impl Iterator<Item = f64> {
        self.mesh.areas().iter().enumerate().map(|(triangle, area)| {
            let [a, b, c] = self.mesh.raw_corners(triangle, &self.positions);
            0.5 * (b - a).perp_dot(c - a) / area
        })
    }

    /// Returns the smallest determinant J, and the index of its triangle.
    #[must_use]
    pub fn smallest_jacobian(&self) -> (f64, usize) {
        let numbered = self.jacobians().enumerate().map(|(triangle, jacobian)| (jacobian, triangle));
        numbered.fold((f64::INFINITY, 0), |least, this| if this.0 < least.0 { this } else { least })
    }

    /// Checks that no triangle is inverted, nor about to be in a solid that flows, whose steps would get ever shorter.
    ///
    /// # Errors
    /// Returns [`SolidError::Inverted`] with the triangle that is inverted the most.
    pub(crate) fn check_inversion(&self) -> Result<(), SolidError> {
        // Mostly none is; the sign alone takes no division and no search.
        let least = if self.flows { 2.0 * LEAST_RATIO } else { 0.0 };
        let upright = |triangle: usize| {
            let [a, b, c] = self.mesh.raw_corners(triangle, &self.positions);
            (b - a).perp_dot(c - a) > least * self.mesh.areas()[triangle]
        };
        if (0..self.mesh.triangles().len()).all(upright) {
            return Ok(());
        }
        Err(self.most_inverted())
    }

    fn most_inverted(&self) -> SolidError {
        let (jacobian, triangle) = self.smallest_jacobian();
        let place = self.mesh.raw_corners(triangle, &self.positions).iter().sum::<Vec2>() / 3.0;
        SolidError::Inverted { triangle, place, jacobian }
    }

    /// Returns the Cauchy stress `P A^T / J` of each triangle (force per deformed length), inner stresses included
    /// ([`Solid::internal_stresses`]).
    ///
    /// # Errors
    /// Returns an error for an inverted triangle.
    pub fn stresses(&self) -> Result<Vec<Mat2>, SolidError> {
        self.check_inversion()?;
        let gradients: Vec<Mat2> =
            (0..self.mesh.triangles().len()).map(|triangle| self.raw_gradient(triangle)).collect();
        let mut stresses = self.law.stresses(&gradients).ok_or_else(|| self.most_inverted())?;
        for ((stress, gradient), jacobian) in stresses.iter_mut().zip(&gradients).zip(self.jacobians()) {
            *stress = *stress * gradient.transpose() / jacobian;
        }
        if let Some(inner) = self.internal_stresses()? {
            stresses.iter_mut().zip(inner).for_each(|(stress, inner)| *stress += inner);
        }
        Ok(stresses)
    }

    /// Returns the deformation gradient A of a triangle (4.10); `None` for one beyond the last.
    #[must_use]
    pub fn gradient(&self, triangle: usize) -> Option<Mat2> {
        (triangle < self.mesh.triangles().len()).then(|| self.raw_gradient(triangle))
    }

    fn raw_gradient(&self, triangle: usize) -> Mat2 {
        let sides = |positions: &[Vec2]| {
            let [a, b, c] = self.mesh.raw_corners(triangle, positions);
            Mat2::from_cols(b - a, c - a)
        };
        sides(&self.positions) * sides(self.mesh.points()).inverse()
    }

    /// Returns the surface of a periodic wall (length): with `periods` -1 the one which faces up, from right to left,
    /// with 1 the one which faces down, from left to right. It is `None` if there is none.
    pub(crate) fn surface(&self, periods: i32) -> Option<Vec<Vec2>> {
        let boundary = self.mesh.boundary_loops().iter().find(|boundary| boundary.periods == periods)?;
        Some(self.mesh.raw_polygon(boundary, &self.positions))
    }
}
