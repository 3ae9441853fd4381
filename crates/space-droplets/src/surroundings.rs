//! Surroundings of droplets: walls and boxes, and how to write your own.

use std::fmt::Debug;

use sphere_harmonics::{Grid, count};

use crate::droplet::fields;
use crate::layers::Vectors;
use crate::reflections::Reflections;
use crate::surface::{Surface, vectors};
use crate::{SpaceDroplet, SpaceError};

/// Three components of as many vectors.
pub type Components<'a> = [&'a [f64]; 3];

/// Sources of flow, at places in the laboratory (length).
#[derive(Debug, Clone, Copy)]
pub enum Sources<'a> {
    /// Point forces on the fluid (force), whose flow in unbounded fluid is `SUM G f/(8 pi)` over the viscosity.
    Forces {
        /// Places of the forces (length).
        places: Components<'a>,
        /// The forces (force).
        forces: Components<'a>,
    },
    /// Points of a double layer, whose flow in unbounded fluid is `SUM T u n/(8 pi)`, with `T u n = -6 r (r.u)
    /// (r.n)/r^5` and r from the target to the source.
    Stresslets {
        /// Places of the points (length).
        places: Components<'a>,
        /// Outward normals times areas (length squared).
        normals: Components<'a>,
        /// Velocities (length per time).
        velocities: Components<'a>,
    },
}

/// Most numbers that say what a source is.
pub(crate) const FIELDS: usize = 6;

impl<'a> Sources<'a> {
    /// Returns the places (length).
    #[must_use]
    pub fn places(&self) -> Components<'a> {
        match *self {
            Self::Forces { places, .. } | Self::Stresslets { places, .. } => places,
        }
    }

    /// Returns the number of numbers that say what a source is: three for a force, six for a stresslet.
    pub(crate) fn fields(&self) -> usize {
        match self {
            Self::Forces { .. } => 3,
            Self::Stresslets { .. } => FIELDS,
        }
    }

    /// Returns the force of a point, or the components xx, xy, xz, yy, yz, zz of `n u + u n`.
    #[inline(always)]
    pub(crate) fn values(&self, k: usize) -> [f64; FIELDS] {
        match self {
            Self::Forces { forces: [x, y, z], .. } => [x[k], y[k], z[k], 0.0, 0.0, 0.0],
            Self::Stresslets { normals, velocities, .. } => {
                let s = |a: usize, b: usize| normals[a][k] * velocities[b][k] + normals[b][k] * velocities[a][k];
                [s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)]
            }
        }
    }
}

/// Returns the lowest and highest coordinate of places along each axis.
pub(crate) fn bounds(places: Components<'_>) -> [[f64; 2]; 3] {
    places.map(|list| list.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], &x| [low.min(x), high.max(x)]))
}

/// Returns the exponent of the error of a sum over the points of a droplet, at this distance from their images: so many
/// points resolve the fields of a droplet of half that size.
pub(crate) fn digits(places: Components<'_>, distance: f64) -> f64 {
    let size = bounds(places).iter().fold(0.0_f64, |most, [low, high]| most.max(0.5 * (high - low)));
    2.0 * (0.5 * places[0].len() as f64).sqrt() * distance / size
}

/// Points at which a flow is asked for.
#[derive(Debug)]
pub struct Targets<'a> {
    /// Places in the laboratory (length).
    pub places: Components<'a>,
    /// Flow that is added to: velocities times the viscosity outside for forces, velocities for stresslets.
    pub flow: [&'a mut [f64]; 3],
}

/// Walls or a periodic box around droplets, which change their flow.
///
/// A droplet has its own flow in unbounded fluid. Surroundings add the rest: the flow that walls reflect, or the flow
/// of periodic images. Implement this trait for other surroundings, and give them to
/// [`SpaceDroplet::with_surroundings`] or [`crate::SpaceDroplets::with_surroundings`].
pub trait Surroundings: Debug + Send + Sync {
    /// Adds the flow of all sources in these surroundings, without their flow in unbounded fluid, at all targets. The
    /// fluid has the viscosity 1.
    ///
    /// # Errors
    /// Returns an error if sources or targets are too close to a wall to be resolved.
    fn add_flow(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>]) -> Result<(), SpaceError>;

    /// Adds the same flow at points of the droplets that make it, with an error of up to about `accuracy` times the
    /// largest velocity that is added. The later iterations for two viscosities need few digits, which take less work.
    /// By default, the flow has all digits.
    ///
    /// # Errors
    /// Returns the errors of [`Surroundings::add_flow`].
    fn add_rough_flow(
        &mut self,
        sources: &[Sources<'_>],
        targets: &mut [Targets<'_>],
        accuracy: f64,
    ) -> Result<(), SpaceError> {
        let _ = accuracy;
        self.add_flow(sources, targets)
    }

    /// Refuses a droplet with points that are not in the fluid; `places` are in the laboratory (length).
    ///
    /// # Errors
    /// Returns [`SpaceError::Wall`] if a point is beyond a wall.
    fn check(&self, time: f64, droplet: usize, places: Components<'_>) -> Result<(), SpaceError>;

    /// Returns the velocity (length per time) of the fluid at a place if there were no droplets. By default, the fluid
    /// is at rest.
    fn imposed(&self, place: [f64; 3]) -> [f64; 3] {
        let _ = place;
        [0.0; 3]
    }

    /// Calls `visit` with each shift (length) to a periodic image of a droplet that comes within `reach` (length) of
    /// another one, at this displacement from it. By default, there are no images.
    fn images(&self, displacement: [f64; 3], reach: f64, visit: &mut dyn FnMut([f64; 3])) {
        let _ = (displacement, reach, visit);
    }

    /// Returns the minimum distance of places from the walls (length), negative beyond them. By default, there are no
    /// walls, and the distance is infinite.
    fn gap(&self, places: Components<'_>) -> f64 {
        let _ = places;
        f64::INFINITY
    }

    /// Returns names and values that a checkpoint keeps, so that it is not resumed in other surroundings. By default,
    /// there are none.
    fn properties(&self) -> Vec<(&'static str, f64)> {
        Vec::new()
    }

    /// Returns lines (length) that show walls or a box around a place in pictures, within a distance of it (length). By
    /// default, there are none.
    fn outline(&self, middle: [f64; 3], reach: f64) -> Vec<Vec<[f64; 3]>> {
        let _ = (middle, reach);
        Vec::new()
    }

    /// Returns true if the surroundings look alike after any turn about the z axis and any shift along it, so that
    /// there can be steady axisymmetric swimmers. By default, they do not.
    fn symmetric_about_z(&self) -> bool {
        false
    }
}

/// A droplet as others and the surroundings feel it, in the laboratory.
#[derive(Debug, Clone)]
pub(crate) struct Source {
    pub(crate) places: Vectors,
    pub(crate) forces: Vectors,
    /// Normals times area and weight, and velocities times the difference of viscosities.
    pub(crate) normals: Vectors,
    pub(crate) velocities: Vectors,
    /// Nodes in the frame of the droplet and in the laboratory, and what double layers of others give there.
    pub(crate) nodes: Vectors,
    pub(crate) lab_nodes: Vectors,
    pub(crate) doubles: [Vectors; 2],
    pub(crate) position: [f64; 3],
    /// Largest distance of the surface from the origin of the frame.
    pub(crate) reach: f64,
    /// Forces of the repulsion per area of the unit sphere, on the fine grid and as coefficients; empty for a droplet
    /// that is alone.
    pub(crate) pushed: Vectors,
    pub(crate) pushes: Vectors,
}

impl Source {
    /// Creates memory for a droplet.
    pub(crate) fn new(droplet: &SpaceDroplet) -> Self {
        let (fine, nodes) = (droplet.surface.grid.len(), droplet.nodes.len());
        let (fine, nodes) = (|| vectors(fine), || vectors(nodes));
        Self {
            places: fine(),
            forces: fine(),
            normals: fine(),
            velocities: fine(),
            nodes: nodes(),
            lab_nodes: nodes(),
            doubles: [nodes(), nodes()],
            position: [0.0; 3],
            reach: 0.0,
            pushed: vectors(0),
            pushes: vectors(0),
        }
    }

    /// Takes over the places and forces of a droplet that is prepared.
    pub(crate) fn update(&mut self, droplet: &mut SpaceDroplet) -> Result<(), SpaceError> {
        let n = count(droplet.degree);
        self.position.copy_from_slice(&droplet.state[4 * n..]);
        let Surface { grid, weights, positions, normals, .. } = &mut droplet.surface;
        for (field, values) in droplet.flow.forces.iter().zip(&mut self.forces) {
            grid.backward(field, values)?;
            values.iter_mut().zip(&*weights).for_each(|(value, weight)| *value *= weight);
        }
        for (scaled, normals) in self.normals.iter_mut().zip(&*normals) {
            let products = normals.iter().zip(&*weights).map(|(normal, weight)| normal * weight);
            scaled.iter_mut().zip(products).for_each(|(scaled, product)| *scaled = product);
        }
        self.nodes.clone_from(&droplet.flow.at_nodes);
        let lists = self.places.iter_mut().zip(&*positions).chain(self.lab_nodes.iter_mut().zip(&self.nodes));
        for ((places, positions), shift) in lists.zip(self.position.into_iter().cycle()) {
            places.iter_mut().zip(positions).for_each(|(place, position)| *place = position + shift);
        }
        Ok(())
    }

    /// Takes over the coefficients of velocities on the fine grid, times the viscosity outside less the one inside.
    pub(crate) fn load(&mut self, grid: &mut Grid, [inside, outside]: [f64; 2], velocities: &[f64]) {
        for (field, values) in fields(velocities, grid.coefficients()).iter().zip(&mut self.velocities) {
            // The lengths fit: transforms cannot fail.
            let _ = grid.backward(field, values);
            values.iter_mut().for_each(|value| *value *= outside - inside);
        }
    }

    /// Returns the forces.
    pub(crate) fn forces(&self) -> Sources<'_> {
        Sources::Forces { places: lists(&self.places), forces: lists(&self.forces) }
    }

    /// Returns the points of the double layer.
    pub(crate) fn stresslets(&self) -> Sources<'_> {
        Sources::Stresslets {
            places: lists(&self.places),
            normals: lists(&self.normals),
            velocities: lists(&self.velocities),
        }
    }
}

/// Returns points of a straight line between two places.
pub(crate) fn edge(from: [f64; 3], to: [f64; 3]) -> Vec<[f64; 3]> {
    const POINTS: usize = 48;
    let at = |k: usize| k as f64 / POINTS as f64;
    (0..=POINTS).map(|k| std::array::from_fn(|i| from[i] + at(k) * (to[i] - from[i]))).collect()
}

/// Memory for lists of sources and targets, which borrow from droplets during one sum.
#[derive(Debug, Default)]
pub(crate) struct Lent {
    pub(crate) sources: Vec<Sources<'static>>,
    pub(crate) targets: Vec<Targets<'static>>,
}

/// Returns an empty list in the memory of another one, whose entries differ in their lifetimes only.
pub(crate) fn emptied<T, U>(list: Vec<T>) -> Vec<U> {
    list.into_iter().filter_map(|_| None).collect()
}

/// Returns three lists as slices.
pub(crate) fn lists(vectors: &Vectors) -> Components<'_> {
    [&vectors[0], &vectors[1], &vectors[2]]
}

/// Returns three lists as slices that can be changed.
pub(crate) fn lists_mut(vectors: &mut Vectors) -> [&mut [f64]; 3] {
    let [x, y, z] = vectors;
    [x, y, z]
}

/// Surroundings of one droplet, with memory.
#[derive(Debug)]
pub(crate) struct Around {
    pub(crate) surroundings: Box<dyn Surroundings>,
    pub(crate) source: Source,
    pub(crate) reflections: Reflections,
}

impl Around {
    /// Writes the flow that the surroundings add at the nodes of a droplet that is prepared, to `flow.external`: of its
    /// forces, and of a guess for its velocities if the viscosities differ.
    pub(crate) fn apply(&mut self, droplet: &mut SpaceDroplet) -> Result<(), SpaceError> {
        self.source.update(droplet)?;
        let Self { surroundings, source, reflections } = self;
        surroundings.check(droplet.time, 0, lists(&source.places))?;
        let guessed = droplet.contrast() != 0.0 && !droplet.flow.solved;
        if guessed {
            let mut velocities = std::mem::take(&mut droplet.flow.velocities);
            reflections.guess.write(droplet.scaled_state(), &mut velocities);
            droplet.flow.velocities = velocities;
            source.load(&mut droplet.surface.grid, droplet.viscosities, &droplet.flow.velocities);
        }
        let external = &mut droplet.flow.external;
        external.iter_mut().for_each(|list| list.fill(0.0));
        add_imposed(&**surroundings, droplet.viscosities[1], &source.lab_nodes, external);
        let mut targets = [Targets { places: lists(&source.lab_nodes), flow: lists_mut(external) }];
        let sources = [source.forces(), source.stresslets()];
        let moving = guessed && droplet.flow.velocities.iter().any(|value| *value != 0.0);
        surroundings.add_flow(&sources[..if moving { 2 } else { 1 }], &mut targets)
    }

    /// Writes the double layer of the surroundings at the nodes for the velocities in `source.velocities`, to the first
    /// list of `source.doubles`, with an error of about `accuracy` times its size.
    pub(crate) fn double(&mut self, accuracy: f64) -> Result<(), SpaceError> {
        let Self { surroundings, source, .. } = self;
        let mut doubles = std::mem::take(&mut source.doubles[0]);
        doubles.iter_mut().for_each(|list| list.fill(0.0));
        let mut targets = [Targets { places: lists(&source.lab_nodes), flow: lists_mut(&mut doubles) }];
        let outcome = surroundings.add_rough_flow(&[source.stresslets()], &mut targets, accuracy);
        source.doubles[0] = doubles;
        outcome
    }
}

/// Adds the imposed flow times the viscosity.
pub(crate) fn add_imposed(surroundings: &dyn Surroundings, viscosity: f64, places: &Vectors, flow: &mut Vectors) {
    for k in 0..places[0].len() {
        let velocity = surroundings.imposed([places[0][k], places[1][k], places[2][k]]);
        flow.iter_mut().zip(velocity).for_each(|(list, value)| list[k] += viscosity * value);
    }
}
