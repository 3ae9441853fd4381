//! Elastic solids: a mesh, the law of its forces, and the present positions of its points.

mod body;
mod body_force;
mod deformation;
mod self_contact;
mod spreading;

use std::sync::Arc;

use motile_base::{
    Vec2,
    internal::{all_points_finite, at_least},
    positive, same_length,
};

use crate::active_springs::Bonds;
use crate::damping::Damping;
use crate::forces::{Hyperelastic, Springs};
use crate::mesh::TriangleMesh;
use crate::relaxation::{NoElasticity, Relaxation};
use crate::surface_elasticity::SurfaceElasticity;
use crate::{ActiveSprings, ElasticForces, EnergyDensity, Maxwell, SolidError};

use body_force::BodyForce;
use self_contact::SelfContact;
use spreading::Spreading;

pub use deformation::Deformation;

/// An elastic solid in a fluid, as a body of a scene ([`motile_scene::Body`]). Its points put their elastic forces on
/// the fluid and move with it. It is made of springs along the edges of its mesh (Cowley section 4.1), of a
/// hyperelastic material (Cowley section 4.2), or has your own forces.
///
/// To hold a solid, pin points, so that they stay where they are and put no force on the fluid, or tether them to their
/// places in the reference state.
///
/// ```
/// use elastic_solids::{ChannelShape, Mesher, NeoHookean, Solid, SolidError};
/// use elastic_solids::Vec2;
///
/// // The wall below a straight channel of width 2, soft on the left and ten times as stiff on the right, its lowest
/// // row pinned.
/// let channel = ChannelShape::Straight { width: 2.0 }.channel(12.0)?;
/// let mesh = channel.lower_wall(-2.5, &Mesher::new(0.1)?)?;
/// let shear = |s: Vec2| if s.x < 0.0 { 100.0 } else { 1000.0 };
/// let wall = Solid::hyperelastic_graded(mesh, |s| NeoHookean::new(shear(s), 2.0 * shear(s)))?
///     .named("lower wall")
///     .pinned(|s| s.y < -2.49)?;
/// println!("{} points, {} of them free", wall.mesh().points().len(), wall.free_points().len()); // 2124 and 2006
/// assert_eq!(wall.free_points().len(), 2006);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("elastic wall", "finite elements", "hyperelastic", "gel wall"))]
pub struct Solid {
    pub(crate) name: String,
    pub(crate) mesh: TriangleMesh,
    pub(crate) law: Arc<dyn ElasticForces>,
    /// Positions of all points, pinned ones among them (length).
    pub(crate) positions: Vec<Vec2>,
    /// Indices of the points that are not pinned, which are the markers unless there is a spreading.
    pub(crate) free: Vec<usize>,
    pub(crate) tethers: Vec<Tether>,
    /// Forces on the fluid of all points (force), kept between calls.
    pub(crate) forces: Vec<Vec2>,
    /// Mean length of the edges of the mesh in the reference state (length).
    pub(crate) spacing: f64,
    pub(crate) may_invert: bool,
    pub(crate) surface_elasticity: Option<SurfaceElasticity>,
    /// True where the law is of springs along the edges.
    springs: bool,
    pub(crate) relaxation: Option<Relaxation>,
    pub(crate) bonds: Option<Bonds>,
    pub(crate) damping: Option<Damping>,
    spreading: Option<Box<Spreading>>,
    surface: SelfContact,
    /// True for a solid without elastic stress.
    flows: bool,
    pub(crate) body_force: Option<Box<BodyForce>>,
}

/// A spring from a point to a fixed place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tether {
    /// Index of the point of the mesh.
    pub point: usize,
    /// Place to which the point is held (length).
    pub anchor: Vec2,
    /// Spring constant (force per length).
    pub stiffness: f64,
}

impl Solid {
    /// Creates a solid of springs with one shear modulus everywhere (force per length), in its reference state.
    ///
    /// ```
    /// use elastic_solids::{Moduli, Solid, SolidError, mesh::equilateral_strip};
    /// use elastic_solids::Vec2;
    ///
    /// let mesh = equilateral_strip(Vec2::new(-6.0, -2.5), 120, 17, 0.1)?;
    /// let moduli = Moduli::from_thesis_spring_constant(1e4)?;
    /// let wall = Solid::springs(mesh, moduli.shear())?;
    /// println!("energy at rest {}", wall.elastic_energy()?); // 0, to round-off
    /// assert!(wall.elastic_energy()? < 1e-20);
    /// # Ok::<(), SolidError>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error for a shear modulus that is not positive and finite.
    pub fn springs(mesh: TriangleMesh, shear: f64) -> Result<Self, SolidError> {
        Self::springs_graded(mesh, |_| shear)
    }

    /// Returns a solid of springs whose shear modulus (force per length) is a function of the reference position
    /// (length), taken at the centroid of each triangle.
    ///
    /// # Errors
    /// Returns an error for a shear modulus that is not positive and finite.
    pub fn springs_graded(mesh: TriangleMesh, shear: impl FnMut(Vec2) -> f64) -> Result<Self, SolidError> {
        let law = Springs::graded(&mesh, shear)?;
        Ok(Self { springs: true, ..Self::at_rest(mesh, law) })
    }

    /// Creates a solid of one hyperelastic material everywhere, in its reference state.
    #[must_use]
    pub fn hyperelastic(mesh: TriangleMesh, material: impl EnergyDensity) -> Self {
        let law = Hyperelastic::new(&mesh, material);
        Self::at_rest(mesh, law)
    }

    /// Returns a solid whose hyperelastic material is a function of the reference position (length), taken at the
    /// centroid of each triangle.
    ///
    /// # Errors
    /// Returns the errors of the function.
    pub fn hyperelastic_graded<E: EnergyDensity>(
        mesh: TriangleMesh,
        material: impl FnMut(Vec2) -> Result<E, SolidError>,
    ) -> Result<Self, SolidError> {
        let law = Hyperelastic::graded(&mesh, material)?;
        Ok(Self::at_rest(mesh, law))
    }

    /// Creates a solid with your own elastic forces, in its reference state.
    ///
    /// # Errors
    /// Returns an error for forces made for another number of points.
    pub fn with_forces(mesh: TriangleMesh, law: impl ElasticForces) -> Result<Self, SolidError> {
        same_length("the mesh of the forces", mesh.points().len(), law.point_count())?;
        Ok(Self::at_rest(mesh, law))
    }

    /// Creates a solid without elastic stress, for a material that flows: all its stress comes from Maxwell elements
    /// ([`Solid::with_maxwell`]), on its triangles, and relaxes entirely. As it creeps, its triangles are sheared. When
    /// one has lost 98 % of its area, the run ends with [`SolidError::Inverted`], at the time that the scene's error
    /// reports.
    #[must_use]
    pub fn fluid_like(mesh: TriangleMesh) -> Self {
        let law = NoElasticity { points: mesh.points().len(), triangles: mesh.triangles().len() };
        Self { flows: true, ..Self::at_rest(mesh, law) }
    }

    fn at_rest(mesh: TriangleMesh, law: impl ElasticForces) -> Self {
        let count = mesh.points().len();
        Self {
            name: "solid".to_owned(),
            law: Arc::new(law),
            positions: mesh.points().to_vec(),
            free: (0..count).collect(),
            tethers: Vec::new(),
            forces: vec![Vec2::ZERO; count],
            spacing: mesh.quality().mean_edge,
            may_invert: false,
            surface_elasticity: None,
            springs: false,
            relaxation: None,
            bonds: None,
            damping: None,
            body_force: None,
            spreading: None,
            surface: SelfContact::of(&mesh),
            flows: false,
            mesh,
        }
    }

    /// Allows inverted triangles, which springs do not resist, and a surface that crosses itself. Use this only to
    /// compare with work that has them. [`Solid::smallest_jacobian`] is negative if there are some. Otherwise a step
    /// that inverts a triangle or folds the surface onto itself is an error, as the first always is for a material
    /// whose energy is not defined there.
    #[must_use]
    pub fn allow_inversion(mut self) -> Self {
        self.may_invert = true;
        self
    }

    /// Covers the surface with surface elasticity, without stress in the reference state, with the moduli of stretching
    /// E_s (force) and bending B (force times length squared):
    ///
    /// ```text
    /// energy = sum over sides E_s/2 (l/L - 1)^2 L  +  sum over points B/2 (theta - theta_0)^2/S
    /// ```
    ///
    /// with the lengths l of the sides of the surface and the angles theta between them, L and theta_0 the same in the
    /// reference state, S the mean length of two sides. A soft solid that is compressed along its surface beyond a
    /// stretch of about 0.65 creases. Surface elasticity sets the length, of the order of the cube root of B over the
    /// shear modulus, below which it does not fold.
    ///
    /// # Errors
    /// Returns an error for moduli that are negative or not finite.
    pub fn with_surface_elasticity(mut self, stretching: f64, bending: f64) -> Result<Self, SolidError> {
        self.surface_elasticity = Some(SurfaceElasticity::new(&self.mesh, stretching, bending)?);
        Ok(self)
    }

    /// Adds a [`Maxwell`] element in parallel with the elastic forces, everywhere the same: along the springs if the
    /// solid is made of springs, otherwise in all triangles. Several calls put several of them there. The element is
    /// without stress in the reference state, also where the solid starts deformed.
    ///
    /// ```
    /// use elastic_solids::{Maxwell, NeoHookean, Solid, SolidError, mesh::equilateral_strip};
    /// use elastic_solids::Vec2;
    ///
    /// // A standard linear solid: G(t) = 100 + 400 exp(-t/2).
    /// let mesh = equilateral_strip(Vec2::new(-6.0, -2.5), 60, 9, 0.2)?;
    /// let wall = Solid::hyperelastic(mesh, NeoHookean::new(100.0, 1000.0)?).with_maxwell(Maxwell::new(400.0, 2.0)?)?;
    /// let sheared = wall.deformed(|s| Vec2::new(s.x + 0.1 * s.y, s.y))?;
    /// let energy = 0.5 * 500.0 * 0.01 * sheared.mesh().area();
    /// println!("energy {:.2}, of the moduli {energy:.2}", sheared.elastic_energy()? + sheared.relaxing_energy()?);
    /// assert!((sheared.elastic_energy()? + sheared.relaxing_energy()? - energy).abs() < 0.01 * energy);
    /// # Ok::<(), SolidError>(())
    /// ```
    ///
    /// # Errors
    /// Returns no error for a valid element.
    pub fn with_maxwell(self, element: Maxwell) -> Result<Self, SolidError> {
        self.with_maxwell_graded(|_| Ok(element))
    }

    /// Puts a [`Maxwell`] element there that is a function of the reference position (length), taken at the centroid of
    /// each triangle; see [`Solid::with_maxwell`].
    ///
    /// # Errors
    /// Returns the errors of the function.
    pub fn with_maxwell_graded(
        mut self,
        element: impl FnMut(Vec2) -> Result<Maxwell, SolidError>,
    ) -> Result<Self, SolidError> {
        self.relaxation.get_or_insert_default().add(&self.mesh, self.springs, element)?;
        Ok(self)
    }

    /// Adds [`ActiveSprings`] along all edges of the mesh, in addition to all other forces.
    #[must_use]
    pub fn with_active_springs(mut self, law: ActiveSprings) -> Self {
        self.bonds = Some(Bonds::new(&self.mesh, law));
        self
    }

    /// Puts [`ActiveSprings`] there whose tension has a factor (no dimension) that is a function of the reference
    /// position of the middle of an edge (length).
    ///
    /// # Errors
    /// Returns an error for a factor that is negative or not finite.
    pub fn with_active_springs_graded(
        mut self,
        law: ActiveSprings,
        factor: impl FnMut(Vec2) -> f64,
    ) -> Result<Self, SolidError> {
        self.bonds = Some(Bonds::new(&self.mesh, law).graded(&self.mesh, factor)?);
        Ok(self)
    }

    /// Makes the solid more viscous than the fluid by `excess` (force per length times time): a viscous stress in
    /// addition to the elastic one (Kelvin and Voigt) and to the stress of the fluid in it. An evaluation then takes
    /// several evaluations of the flow: the number grows with the ratio of the viscosities. Steps may be as long as
    /// without it.
    ///
    /// # Errors
    /// Returns an error for an excess that is not positive and finite.
    pub fn with_excess_viscosity(mut self, excess: f64) -> Result<Self, SolidError> {
        self.damping = Some(Damping::new(&self.mesh, positive("the excess viscosity of the solid", excess)?));
        Ok(self)
    }

    /// Makes a force act on the solid, uniform over its area at rest: its weight less the weight of as much fluid,
    /// `(rho_solid - rho_fluid) g` (force per area). Pinned points take up their share.
    ///
    /// # Errors
    /// Returns an error for a force that is not finite.
    pub fn with_body_force(mut self, force: Vec2) -> Result<Self, SolidError> {
        all_points_finite("the body force of a solid", &[force])?;
        self.body_force = (force != Vec2::ZERO).then(|| Box::new(BodyForce::new(&self.mesh, force)));
        Ok(self)
    }

    /// Spreads the forces on inner points over the triangles about them, and moves these points with the fluid in all
    /// of the triangles. This is the Galerkin method with piecewise linear fields, whose markers are the points of the
    /// boundary and three places in each triangle with an inner point.
    ///
    /// Otherwise forces act at the points themselves. If the grid is much finer than the mesh, fluid leaks between the
    /// points, so the solid seems softer than it is. With forces spread over the triangles, a finer grid leaks less,
    /// and a mesh of four spacings of a fine grid is enough. A run takes two to three times as long as without these
    /// points. A held [mirror symmetry](motile_scene::Scene::held_symmetric) is not for such solids.
    #[must_use]
    pub fn spread_over_triangles(mut self) -> Self {
        self.spreading = Some(Box::new(Spreading::new(&self.mesh, &self.free)));
        self
    }

    /// Gives the solid a name for messages ("solid" otherwise).
    #[must_use]
    pub fn named(mut self, name: &str) -> Self {
        name.clone_into(&mut self.name);
        self
    }

    /// Pins the points whose reference position (length) satisfies a condition, such as the outermost row of a wall on
    /// the no-slip wall of the channel. Pinned points stay where they are, and their forces do not act on the fluid:
    /// the support that holds them takes these up.
    ///
    /// # Errors
    /// Returns an error if no point is left free.
    pub fn pinned(mut self, condition: impl Fn(Vec2) -> bool) -> Result<Self, SolidError> {
        let points = self.mesh.points();
        self.free.retain(|&point| !condition(points[point]));
        at_least("free points", self.free.len(), 1)?;
        Ok(if self.spreading.is_some() { self.spread_over_triangles() } else { self })
    }

    /// Tethers each point whose reference position (length) satisfies a condition to that position, by a spring of
    /// `stiffness` (force per length).
    ///
    /// # Errors
    /// Returns an error for a stiffness that is not positive and finite; no point that satisfies the condition.
    pub fn tethered(mut self, stiffness: f64, condition: impl Fn(Vec2) -> bool) -> Result<Self, SolidError> {
        positive("the stiffness of the tethers", stiffness)?;
        let before = self.tethers.len();
        let held = self.mesh.points().iter().enumerate().filter(|(_, place)| condition(**place));
        self.tethers.extend(held.map(|(point, &anchor)| Tether { point, anchor, stiffness }));
        at_least("tethered points", self.tethers.len() - before, 1)?;
        Ok(self)
    }

    /// Deforms the solid: puts every point, pinned ones too, at a function of its reference position (length).
    ///
    /// # Errors
    /// Returns an error for positions that are not finite.
    pub fn deformed(mut self, position: impl Fn(Vec2) -> Vec2) -> Result<Self, SolidError> {
        let positions: Vec<Vec2> = self.mesh.points().iter().map(|&place| position(place)).collect();
        self.set_positions(&positions)?;
        Ok(self)
    }

    /// Puts all points, pinned ones too, at these positions (length). If they invert a triangle, the next step returns
    /// an error.
    ///
    /// # Errors
    /// Returns an error for a list of the wrong length, positions that are not finite.
    pub fn set_positions(&mut self, positions: &[Vec2]) -> Result<(), SolidError> {
        same_length("the positions", self.positions.len(), positions.len())?;
        all_points_finite("the positions", positions)?;
        self.positions.copy_from_slice(positions);
        Ok(())
    }

    /// Returns the mesh of the reference state.
    #[must_use]
    pub fn mesh(&self) -> &TriangleMesh {
        &self.mesh
    }

    /// Returns the law of the elastic forces.
    #[must_use]
    pub fn law(&self) -> &dyn ElasticForces {
        self.law.as_ref()
    }

    /// Returns the present positions of all points of the mesh (length), not wrapped into the period.
    #[must_use]
    pub fn positions(&self) -> &[Vec2] {
        &self.positions
    }

    /// Returns the indices of the points that are not pinned, in increasing order; these points are the markers of the
    /// body, unless its forces are [spread over triangles](Solid::spread_over_triangles).
    #[must_use]
    pub fn free_points(&self) -> &[usize] {
        &self.free
    }

    /// Tethers of the solid.
    #[must_use]
    pub fn tethers(&self) -> &[Tether] {
        &self.tethers
    }

    /// Tethers of the solid, to be moved or changed between steps.
    pub fn tethers_mut(&mut self) -> &mut [Tether] {
        &mut self.tethers
    }

    /// Computes the forces on the fluid (force) of all points, from law, surface elasticity, inner stresses, the
    /// body force and tethers.
    pub(crate) fn compute_forces(&mut self) -> Result<(), SolidError> {
        self.forces.fill(Vec2::ZERO);
        self.law.add_forces(&self.positions, &mut self.forces)?;
        if let Some(surface) = &self.surface_elasticity {
            surface.add_forces(&self.positions, &mut self.forces);
        }
        if let Some(relaxation) = &self.relaxation {
            relaxation.add_forces(&self.positions, &mut self.forces)?;
        }
        if let Some(bonds) = &self.bonds {
            bonds.add_forces(&self.positions, &mut self.forces);
        }
        if let Some(body_force) = &self.body_force {
            body_force.add_forces(&mut self.forces);
        }
        for tether in &self.tethers {
            self.forces[tether.point] += (tether.anchor - self.positions[tether.point]) * tether.stiffness;
        }
        Ok(())
    }
}

#[cfg(test)]
pub(crate) mod tests;
