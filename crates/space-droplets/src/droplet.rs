//! A droplet: how to make one, and what it is made of.

use std::f64::consts::PI;

use active_interface::Tension;
use motile_base::internal::{Refuse, all_finite};
use motile_base::{finite, not_negative, positive, same_length};
use sphere_harmonics::{Grid, Point, count};
use stokes_boundary_integrals::internal::gmres::Gmres;

use crate::SpaceError;
use crate::flow::Flow;
use crate::layers::{Layers, Vectors};
use crate::reflections::Reflections;
use crate::surface::Surface;
use crate::surroundings::{Around, Source, Surroundings, lists};

/// Largest degree of a droplet: the tables of a larger one take several gigabytes.
pub const LARGEST_DEGREE: usize = 96;

/// A tangential velocity of the parameters that crowds them where the concentration is steep.
///
/// The monitor `M = sqrt(1 + (strength R0 |grad c|/(max c - min c))^2)` times the area per parameter becomes uniform
/// within a few times `time`. Swimmers have a sharp edge of the particles, and need a lower degree with this than
/// without.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgeFollowing {
    /// Weight of the slope (no dimension); 4 is a good choice, 0 makes the parameters uniform over the area.
    pub strength: f64,
    /// Time in which the parameters follow (time).
    pub time: f64,
}

/// An active droplet in three dimensions, in unbounded fluid or in [`Surroundings`].
///
/// The surface is `X(s)` for points s of the unit sphere, and the particles are m(s) per area of that sphere; both are
/// sums of harmonics up to a degree. Concentrations are per area, the tension law returns a force per length.
#[derive(Debug)]
pub struct SpaceDroplet {
    pub(crate) degree: usize,
    pub(crate) viscosities: [f64; 2],
    pub(crate) tension: Box<dyn Tension>,
    pub(crate) diffusivity: f64,
    pub(crate) gradient: [[f64; 3]; 3],
    pub(crate) edge: Option<EdgeFollowing>,
    /// Coefficients x, y, z, particles; then the position of the frame.
    pub(crate) state: Vec<f64>,
    pub(crate) time: f64,
    /// Volume that steps restore (length cubed), and the radius of a sphere with this volume (length).
    pub(crate) volume: f64,
    pub(crate) radius: f64,
    pub(crate) surface: Surface,
    pub(crate) nodes: Grid,
    pub(crate) layers: Layers,
    pub(crate) gmres: Gmres,
    pub(crate) flow: Flow,
    pub(crate) around: Option<Box<Around>>,
    /// The error of the last evaluation for an integrator.
    pub(crate) failure: Option<SpaceError>,
}

/// Returns the three fields of coefficients at the start of a list.
pub(crate) fn fields(list: &[f64], n: usize) -> [&[f64]; 3] {
    [&list[..n], &list[n..2 * n], &list[2 * n..3 * n]]
}

/// Returns three lists as slices.
pub(crate) fn slices(vectors: &Vectors) -> [&[f64]; 3] {
    [&vectors[0], &vectors[1], &vectors[2]]
}

impl SpaceDroplet {
    /// Creates a sphere without particles, with its centre at the origin.
    ///
    /// `degree` is the degree of the harmonics: 8 to 12 for round droplets, 16 to 24 for swimmers. The viscosities are
    /// inside and outside (stress times time). The work per evaluation grows with about the fourth power of the degree.
    ///
    /// # Errors
    /// Returns an error if the degree is below 2 or above [`LARGEST_DEGREE`], or if the radius or a viscosity is not
    /// positive and finite.
    pub fn sphere(
        degree: usize,
        radius: f64,
        viscosities: [f64; 2],
        tension: impl Tension + 'static,
    ) -> Result<Self, SpaceError> {
        positive("the radius", radius)?;
        Self::shaped(degree, |direction| direction.map(|x| radius * x), viscosities, tension)
    }

    /// Creates a droplet without particles whose surface is `position(direction)`, a smooth one-to-one function of the
    /// unit vector x, y, z, which keeps orientation (length). The droplet's frame is centred on its volume.
    ///
    /// # Errors
    /// Returns the errors of [`SpaceDroplet::sphere`], and [`SpaceError::Shape`] if the volume is not positive or the
    /// surface is folded.
    pub fn shaped(
        degree: usize,
        position: impl Fn([f64; 3]) -> [f64; 3],
        viscosities: [f64; 2],
        tension: impl Tension + 'static,
    ) -> Result<Self, SpaceError> {
        if !(2..=LARGEST_DEGREE).contains(&degree) {
            let range = format!("Use a degree from 2 to {LARGEST_DEGREE}; 16 is a good start");
            return Err(SpaceError::refused("the degree of a droplet is out of range", degree.to_string(), range));
        }
        positive("the viscosity inside", viscosities[0])?;
        positive("the viscosity outside", viscosities[1])?;
        let (nodes, surface) = (Grid::gauss(degree)?, Surface::new(degree)?);
        let layers = Self::layers(&nodes, 5 * degree / 4 + 4, 5 * degree / 4 + 8)?;
        let flow = Flow::new(count(degree), nodes.len(), surface.grid.len());
        let mut droplet = Self {
            degree,
            viscosities,
            tension: Box::new(tension),
            diffusivity: 0.0,
            gradient: [[0.0; 3]; 3],
            edge: None,
            state: vec![0.0; 4 * count(degree) + 3],
            time: 0.0,
            volume: 0.0,
            radius: 0.0,
            surface,
            nodes,
            layers,
            gmres: Gmres::default(),
            flow,
            around: None,
            failure: None,
        };
        let positions: Vec<[f64; 3]> = droplet.surface.grid.points().map(|s| position(s.direction())).collect();
        let n = count(degree);
        for i in 0..3 {
            let values: Vec<f64> = positions.iter().map(|position| position[i]).collect();
            all_finite("the positions of the surface", &values)?;
            droplet.surface.grid.forward(&values, &mut droplet.state[i * n..(i + 1) * n])?;
        }
        droplet.update_surface()?;
        droplet.volume = droplet.surface.volume();
        droplet.radius = (3.0 * droplet.volume / (4.0 * PI)).cbrt();
        droplet.centre();
        droplet.update_surface()?;
        Ok(droplet)
    }

    /// Puts particles on the surface: their diffusivity (length squared per time), and their concentration (per area)
    /// at each parameter, which is a unit vector x, y, z.
    ///
    /// # Errors
    /// Returns an error if the diffusivity is negative, or if a value is not finite.
    pub fn with_particles(
        mut self,
        diffusivity: f64,
        concentration: impl Fn([f64; 3]) -> f64,
    ) -> Result<Self, SpaceError> {
        self.diffusivity = not_negative("the diffusivity", diffusivity)?;
        let points = self.surface.grid.points().map(Point::direction).zip(&self.surface.area);
        let values: Vec<f64> = points.map(|(direction, area)| area * concentration(direction)).collect();
        all_finite("the concentrations", &values)?;
        let n = count(self.degree);
        self.surface.grid.forward(&values, &mut self.state[3 * n..4 * n])?;
        self.flow.known = false;
        Ok(self)
    }

    /// Imposes the flow `u_i = sum over j of gradient[i][j] x_j` (gradient in 1/time), such as a shear or an extension.
    ///
    /// # Errors
    /// Returns an error if an entry is not finite, or if the flow would not conserve volume: the trace must be zero.
    pub fn with_imposed_flow(mut self, gradient: [[f64; 3]; 3]) -> Result<Self, SpaceError> {
        let mut largest = 0.0_f64;
        for &entry in gradient.iter().flatten() {
            largest = largest.max(finite("an entry of the imposed velocity gradient", entry)?.abs());
        }
        let trace = gradient[0][0] + gradient[1][1] + gradient[2][2];
        if trace.abs() > 1e-12 * largest {
            let what = "the imposed flow does not conserve volume: the trace of its gradient is not zero";
            return Err(SpaceError::refused(
                what,
                trace.to_string(),
                "Subtract a third of the trace from the diagonal",
            ));
        }
        self.gradient = gradient;
        self.flow.known = false;
        Ok(self)
    }

    /// Places the centroid (length) in the laboratory, for an imposed flow or next to other droplets.
    ///
    /// # Errors
    /// Returns an error if a coordinate is not finite.
    pub fn with_position(mut self, position: [f64; 3]) -> Result<Self, SpaceError> {
        let n = count(self.degree);
        let centroid = self.surface.centroid(self.surface.volume());
        for (i, x) in position.into_iter().enumerate() {
            self.state[4 * n + i] = finite("a coordinate of the position", x)? - centroid[i];
        }
        self.flow.known = false;
        Ok(self)
    }

    /// Puts the droplet, at its position in the laboratory, into surroundings such as a [`crate::Slit`].
    ///
    /// # Errors
    /// Returns [`SpaceError::Wall`] if the droplet is not in the fluid.
    pub fn with_surroundings(mut self, surroundings: impl Surroundings + 'static) -> Result<Self, SpaceError> {
        let mut source = Source::new(&self);
        source.update(&mut self)?;
        surroundings.check(self.time, 0, lists(&source.places))?;
        let reflections = Reflections::default();
        self.around = Some(Box::new(Around { surroundings: Box::new(surroundings), source, reflections }));
        self.flow.known = false;
        Ok(self)
    }

    /// Lets the parameters follow the edge of the particles.
    ///
    /// # Errors
    /// Returns an error if the strength is negative or the time is not positive.
    pub fn with_edge_following(mut self, edge: EdgeFollowing) -> Result<Self, SpaceError> {
        not_negative("the strength of edge following", edge.strength)?;
        positive("the time of edge following", edge.time)?;
        self.edge = Some(edge);
        self.flow.known = false;
        Ok(self)
    }

    /// Uses about that many rings and points per ring for the quadrature about each point of the surface. By default,
    /// there are 1.25 degree + 4 rings of 1.25 degree + 8 points. Their error is below the truncation of the shape.
    ///
    /// # Errors
    /// Returns an error for fewer than 4 or more than 1024 of either.
    pub fn with_quadrature(mut self, rings: usize, points: usize) -> Result<Self, SpaceError> {
        if rings.min(points) < 4 || rings.max(points) > 1024 {
            let value = format!("{rings} rings of {points} points");
            return Err(SpaceError::refused("this quadrature cannot be used", value, "Use 4 to 1024 of each"));
        }
        self.layers = Self::layers(&self.nodes, rings, points)?;
        self.flow.known = false;
        Ok(self)
    }

    fn layers(nodes: &Grid, rings: usize, points: usize) -> Result<Layers, SpaceError> {
        Ok(Layers::new(nodes, rings.next_multiple_of(2), points.next_multiple_of(4))?)
    }

    /// Computes the flow and the rates of the present state, unless they are known.
    ///
    /// # Errors
    /// Returns [`SpaceError::Shape`] for a surface that has failed, or [`SpaceError::NotConverged`].
    pub fn evaluate(&mut self) -> Result<(), SpaceError> {
        if self.flow.known {
            return Ok(());
        }
        self.prepare()?;
        self.finish()
    }

    /// Returns the viscosity outside less the one inside.
    pub(crate) fn contrast(&self) -> f64 {
        self.viscosities[1] - self.viscosities[0]
    }

    /// Returns the coefficients of the positions (length): x, y, z, each by [`sphere_harmonics::index`].
    #[must_use]
    pub fn positions(&self) -> [&[f64]; 3] {
        fields(&self.state, count(self.degree))
    }

    /// Returns the coefficients of the particles per area of the unit sphere.
    #[must_use]
    pub fn particles(&self) -> &[f64] {
        let n = count(self.degree);
        &self.state[3 * n..4 * n]
    }

    /// Returns the whole state, to keep it: the coefficients of x, y, z and the particles, and the position of the
    /// frame. Give it to [`SpaceDroplet::resume`] of a droplet that is made the same way.
    #[must_use]
    pub fn state(&self) -> &[f64] {
        &self.state
    }

    /// Continues from a state that [`SpaceDroplet::state`] returned at that time. The volume of this droplet
    /// does not change.
    ///
    /// # Errors
    /// Returns an error if the time is not finite, if the state is of another degree, or if its surface has failed. The
    /// droplet is then as before.
    pub fn resume(&mut self, time: f64, state: &[f64]) -> Result<(), SpaceError> {
        finite("the time", time)?;
        same_length("the state", self.state.len(), state.len())?;
        let before = std::mem::replace(&mut self.state, state.to_vec());
        if let Err(error) = self.update_surface() {
            self.state = before;
            self.flow.known = false;
            return Err(error);
        }
        self.time = time;
        self.flow.known = false;
        // The same guess as in a droplet that is new.
        self.flow.velocities.fill(0.0);
        if let Some(around) = &mut self.around {
            around.reflections.forget();
        }
        Ok(())
    }

    /// Returns the degree of the harmonics.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Returns the iterations that the last flow took, with one double layer each; 0 for equal viscosities. In
    /// surroundings, the double layer is the one that they reflect.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.flow.iterations
    }

    /// Returns the time (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }
}

#[cfg(test)]
mod tests;
