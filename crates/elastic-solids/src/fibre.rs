//! Open elastic fibres: beams, flagella, hairs.

mod body;
mod elasticity;
mod files;
mod observables;
mod target;
mod wave;

use std::cell::Cell;

use motile_base::{
    Vec2,
    internal::{Refuse, all_finite, all_points_finite, at_least},
    not_negative, positive, same_length,
};

use crate::{SolidError, error::MOST_POINTS};
use elasticity::Elasticity;

pub use files::FibreFiles;
pub use observables::FibreState;
pub use target::Target;
pub use wave::FibreWave;

/// Fewest nodes of a fibre: the curvature of an open one is measured at the nodes between its ends.
const LEAST_NODES: usize = 3;

/// How an end of a fibre is held.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum FibreEnd {
    /// The end moves and turns freely.
    #[default]
    Free,
    /// The end stays in place, and the fibre can turn about it.
    Pinned,
    /// The end keeps its place and its direction.
    Clamped,
}

/// An elastic fibre that moves with the fluid: a line of nodes that resists stretching and bending, such as a beam, a
/// hair or a flagellum.
///
/// Its energy per depth is, with s the length at rest along it and theta its direction (radians),
///
/// ```text
/// E = integral of S/2 (|dx/ds| - 1)^2 + B/2 (dtheta/ds - kappa)^2 ds
/// ```
///
/// S is the modulus of stretching (force), B the modulus of bending (force times length squared), kappa the curvature
/// at rest (1/length). The forces at the nodes are the exact gradient of a sum of springs and hinges that converges to
/// this energy with the second power of the node spacing. Total force and total torque of a free fibre therefore vanish
/// to round-off, and it does as much work on the fluid as it loses energy. Curvatures are positive where the fibre
/// turns left on its way from the first node to the last one.
///
/// Each end is free, pinned or clamped ([`FibreEnd`]). A held end stays where it is, and puts no force on the fluid:
/// what holds it takes up the force ([`FibreState::end_forces`]). Targets are springs between nodes and places that
/// may move ([`Target`]).
///
/// Nodes are points of the flow ([`motile_scene::MarkerKind::Points`]). So a fibre needs a grid or layers with a grid,
/// and it is as thick as the kernel of the grid. Free fibres in the plane can be regularised Stokeslets. Nodes should
/// be no further apart than the grid spacing, because the fluid leaks between them otherwise.
///
/// A clamped beam under an end force F, against the theory of slender beams, F L^3/(3 B):
///
/// ```
/// use elastic_solids::{Fibre, FibreEnd, Vec2};
/// use motile_scene::{Scene, Substrate};
///
/// let line: Vec<Vec2> = (0..=8).map(|k| Vec2::new(0.125 * f64::from(k), 0.0)).collect();
/// let beam = Fibre::new(&line, 100.0, 1.0)?
///     .with_ends([FibreEnd::Clamped, FibreEnd::Free])?
///     .with_load(8, Vec2::new(0.0, -0.03))?;
/// let mut scene = Scene::new(Substrate::new(0.01)?);
/// let beam = scene.add(beam);
/// scene.run(0.06).go()?;
/// let tip = scene.body(beam)?.nodes()[8];
/// println!("the tip has sunk by {:.5}", -tip.y);
/// assert!((-tip.y / 0.01 - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("fiber", "filament", "beam", "flagellum", "cilium", "hair", "elastica"))]
pub struct Fibre {
    name: String,
    /// Positions of all nodes, held ones among them (length).
    nodes: Vec<Vec2>,
    elasticity: Elasticity,
    /// Length at rest from the first node to each node (length).
    along: Vec<f64>,
    ends: [FibreEnd; 2],
    wave: Option<FibreWave<f64>>,
    targets: Vec<Target>,
    loads: Vec<(usize, Vec2)>,
    time: f64,
    /// Forces at all nodes (force), kept between calls.
    forces: Vec<Vec2>,
    /// The fastest decay of displacements (1/time) and the shortest segment for which it was found (length).
    decay: Cell<Option<[f64; 2]>>,
}

impl Fibre {
    /// Creates an open fibre through nodes (length), at rest in this shape, with the moduli of stretching S (force) and
    /// bending B (force times length squared). Its ends are free.
    ///
    /// # Errors
    /// Returns an error for fewer than 3 nodes, nodes that are not finite, neighbours that coincide, moduli that are
    /// negative or not finite.
    pub fn new(nodes: &[Vec2], stretching: f64, bending: f64) -> Result<Self, SolidError> {
        Self::of(nodes, None, stretching, bending)
    }

    /// Creates a closed fibre, whose last node is next to the first one, at rest in this shape; otherwise as
    /// [`Fibre::new`].
    ///
    /// # Errors
    /// Returns the errors of [`Fibre::new`].
    pub fn closed(nodes: &[Vec2], stretching: f64, bending: f64) -> Result<Self, SolidError> {
        Self::of(nodes, Some(Vec2::ZERO), stretching, bending)
    }

    /// Creates a fibre without ends that spans a periodic region.
    ///
    /// The node after the last one is the image of the first node, moved by `period` (length). For all other arguments,
    /// see [`Fibre::new`].
    ///
    /// # Errors
    /// Returns the errors of [`Fibre::new`], and an error for a period that is not finite.
    pub fn periodic(nodes: &[Vec2], period: Vec2, stretching: f64, bending: f64) -> Result<Self, SolidError> {
        all_points_finite("the period of a fibre", &[period])?;
        Self::of(nodes, Some(period), stretching, bending)
    }

    fn of(nodes: &[Vec2], advance: Option<Vec2>, stretching: f64, bending: f64) -> Result<Self, SolidError> {
        let count = at_least("the nodes of a fibre", nodes.len(), LEAST_NODES)?;
        if count as f64 > MOST_POINTS {
            let value = format!("it has {count}");
            return Err(SolidError::refused("the fibre has too many nodes", value, "Use at most a million nodes"));
        }
        all_points_finite("the nodes of a fibre", nodes)?;
        let stretching = not_negative("the stretching modulus of a fibre", stretching)?;
        let bending = not_negative("the bending modulus of a fibre", bending)?;
        let segments = count - usize::from(advance.is_none());
        let mut elasticity = Elasticity {
            lengths: vec![1.0; segments],
            stretching: vec![stretching; segments],
            bending: vec![bending; count],
            curvatures: vec![0.0; count],
            clamps: [None; 2],
            advance,
        };
        let lengths: Vec<f64> = (0..segments).map(|k| elasticity.segment(nodes, k).length()).collect();
        if let Some(first) = lengths.iter().position(|length| *length == 0.0) {
            return Err(SolidError::coincident_nodes(first, (first + 1) % count, nodes[first]));
        }
        elasticity.lengths = lengths;
        let mut fibre = Self {
            name: "fibre".to_owned(),
            nodes: nodes.to_vec(),
            along: vec![0.0; count],
            elasticity,
            ends: [FibreEnd::Free; 2],
            wave: None,
            targets: Vec::new(),
            loads: Vec::new(),
            time: 0.0,
            forces: vec![Vec2::ZERO; count],
            decay: Cell::new(None),
        };
        fibre.measure_along();
        fibre.rest_as_now();
        Ok(fibre)
    }

    /// Takes over the lengths from the first node.
    fn measure_along(&mut self) {
        let mut sum = 0.0;
        for (along, length) in self.along.iter_mut().zip(self.elasticity.lengths.iter().chain([&0.0])) {
            *along = sum;
            sum += length;
        }
    }

    /// Puts the bending at rest in the present shape. The ends of an open fibre get the curvatures of their neighbours.
    fn rest_as_now(&mut self) {
        let measured: Vec<(usize, f64)> = self.elasticity.measured_curvatures(&self.nodes).collect();
        for (node, curvature) in measured {
            self.elasticity.curvatures[node] = curvature;
        }
        if self.elasticity.advance.is_none() {
            let curvatures = &mut self.elasticity.curvatures;
            let last = curvatures.len() - 1;
            (curvatures[0], curvatures[last]) = (curvatures[1], curvatures[last - 1]);
        }
    }

    /// Gives the fibre a name for messages ("fibre" otherwise).
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Holds the ends of an open fibre: the first node and the last one. A clamp keeps the tangent that the fibre has
    /// now.
    ///
    /// # Errors
    /// Returns an error for a closed or periodic fibre whose ends would be held.
    pub fn with_ends(mut self, ends: [FibreEnd; 2]) -> Result<Self, SolidError> {
        if ends == [FibreEnd::Free; 2] {
            (self.ends, self.elasticity.clamps) = (ends, [None; 2]);
            return Ok(self);
        }
        if self.elasticity.advance.is_some() {
            let remedy = "Leave its ends free, or use an open fibre";
            return Err(SolidError::refused("a closed fibre has no ends that can be held", "", remedy));
        }
        let measured: Vec<(usize, f64)> = self.elasticity.measured_curvatures(&self.nodes).collect();
        let last = self.elasticity.lengths.len() - 1;
        // The tangent at an end is half a segment away from the direction of its segment.
        let tangent = |end: usize| {
            let (segment, curvature) =
                if end == 0 { (0, measured[0].1) } else { (last, measured[measured.len() - 1].1) };
            let turn = 0.5 * self.elasticity.lengths[segment] * curvature;
            let turn = Vec2::from_angle(if end == 0 { -turn } else { turn });
            turn.rotate(self.elasticity.segment(&self.nodes, segment).normalize())
        };
        self.elasticity.clamps = [0, 1].map(|end| (ends[end] == FibreEnd::Clamped).then(|| tangent(end)));
        self.ends = ends;
        self.decay.set(None);
        Ok(self)
    }

    /// Sets the lengths at rest of the segments (length), from the first one.
    ///
    /// # Errors
    /// Returns an error for another number of lengths than segments, and for lengths that are not positive and finite.
    pub fn with_rest_lengths(mut self, lengths: &[f64]) -> Result<Self, SolidError> {
        same_length("the lengths at rest of a fibre", self.elasticity.lengths.len(), lengths.len())?;
        for length in lengths {
            positive("the length at rest of a segment", *length)?;
        }
        self.elasticity.lengths.copy_from_slice(lengths);
        self.measure_along();
        self.decay.set(None);
        Ok(self)
    }

    /// Sets the length at rest of the whole fibre (length). The shares of its segments stay as they are.
    ///
    /// # Errors
    /// Returns an error for a length that is not positive and finite.
    pub fn with_rest_length(self, length: f64) -> Result<Self, SolidError> {
        let factor = positive("the length at rest of a fibre", length)? / self.rest_length();
        let lengths: Vec<f64> = self.elasticity.lengths.iter().map(|length| factor * length).collect();
        self.with_rest_lengths(&lengths)
    }

    /// Sets the modulus of stretching of each segment (force).
    ///
    /// # Errors
    /// Returns an error for another number of moduli than segments, and for moduli that are negative or not finite.
    pub fn with_stretching_moduli(mut self, moduli: &[f64]) -> Result<Self, SolidError> {
        same_length("the stretching moduli of a fibre", self.elasticity.stretching.len(), moduli.len())?;
        for modulus in moduli {
            not_negative("the stretching modulus of a fibre", *modulus)?;
        }
        self.elasticity.stretching.copy_from_slice(moduli);
        self.decay.set(None);
        Ok(self)
    }

    /// Sets the modulus of bending at each node (force times length squared). The moduli at the ends of an open fibre
    /// count only if they are clamped.
    ///
    /// # Errors
    /// Returns an error for another number of moduli than nodes, and for moduli that are negative or not finite.
    pub fn with_bending_moduli(mut self, moduli: &[f64]) -> Result<Self, SolidError> {
        same_length("the bending moduli of a fibre", self.nodes.len(), moduli.len())?;
        for modulus in moduli {
            not_negative("the bending modulus of a fibre", *modulus)?;
        }
        self.elasticity.bending.copy_from_slice(moduli);
        self.decay.set(None);
        Ok(self)
    }

    /// Puts the bending at rest at one curvature everywhere (1/length; 0 for a straight fibre), whatever the shape now.
    ///
    /// # Errors
    /// Returns an error for a curvature that is not finite.
    pub fn with_reference_curvature(self, curvature: f64) -> Result<Self, SolidError> {
        let curvatures = vec![curvature; self.nodes.len()];
        self.with_reference_curvatures(&curvatures)
    }

    /// Sets the curvature at rest at each node (1/length). The curvatures at the ends of an open fibre count only if
    /// they are clamped.
    ///
    /// # Errors
    /// Returns an error for another number of curvatures than nodes, and for curvatures that are not finite.
    pub fn with_reference_curvatures(mut self, curvatures: &[f64]) -> Result<Self, SolidError> {
        same_length("the curvatures at rest of a fibre", self.nodes.len(), curvatures.len())?;
        all_finite("the curvatures at rest of a fibre", curvatures)?;
        self.elasticity.curvatures.copy_from_slice(curvatures);
        Ok(self)
    }

    /// Adds a travelling wave (amplitude in 1/length) to the curvature at rest, as molecular motors do along a
    /// flagellum.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite.
    pub fn with_curvature_wave(mut self, wave: FibreWave<f64>) -> Result<Self, SolidError> {
        all_finite("the amplitude of the wave of a fibre", &[wave.amplitude])?;
        all_finite("the numbers of the wave of a fibre", &wave.numbers())?;
        self.wave = Some(wave);
        Ok(self)
    }

    /// Tethers nodes to targets, in addition to those that there are.
    ///
    /// # Errors
    /// Returns an error for nodes that do not exist, stiffnesses that are negative or not finite, and other numbers
    /// that are not finite.
    pub fn with_targets(mut self, targets: impl IntoIterator<Item = Target>) -> Result<Self, SolidError> {
        for target in targets {
            self.check_node("a target", target.node)?;
            not_negative("the stiffness of a target", target.stiffness)?;
            let waves = target.wave.map_or(Vec2::ZERO, |wave| wave.amplitude);
            all_points_finite("the place of a target", &[target.place, target.velocity, waves])?;
            all_finite("the wave of a target", &target.wave.map_or([0.0; 3], |wave| wave.numbers()))?;
            self.targets.push(target);
        }
        self.decay.set(None);
        Ok(self)
    }

    /// Makes a constant force (force) act on a node, in addition to the forces that there are.
    ///
    /// # Errors
    /// Returns an error for a node that does not exist, and a force that is not finite.
    pub fn with_load(mut self, node: usize, force: Vec2) -> Result<Self, SolidError> {
        self.check_node("a load", node)?;
        all_points_finite("the load of a fibre", &[force])?;
        self.loads.push((node, force));
        Ok(self)
    }

    fn check_node(&self, what: &str, node: usize) -> Result<(), SolidError> {
        let count = self.nodes.len();
        if node < count {
            return Ok(());
        }
        let what = format!("{what} acts on node {node} of {}, which does not exist", self.name);
        let remedy = format!("Use a number from 0 to {}", count - 1);
        Err(SolidError::refused(what, format!("the fibre has {count} nodes"), remedy))
    }

    /// Moves the nodes (length). The shape at rest, the lengths at rest and the clamps stay as they are, but a held end
    /// is held in its new place.
    ///
    /// # Errors
    /// Returns an error for another number of nodes, nodes that are not finite, and neighbours that coincide.
    pub fn deformed(mut self, nodes: &[Vec2]) -> Result<Self, SolidError> {
        same_length("the nodes of a fibre", self.nodes.len(), nodes.len())?;
        all_points_finite("the nodes of a fibre", nodes)?;
        self.nodes.copy_from_slice(nodes);
        self.check_segments()?;
        self.decay.set(None);
        Ok(self)
    }

    /// Refuses neighbouring nodes at the same place.
    fn check_segments(&self) -> Result<(), SolidError> {
        let segments = self.elasticity.lengths.len();
        match (0..segments).find(|k| self.elasticity.segment(&self.nodes, *k) == Vec2::ZERO) {
            Some(first) => Err(SolidError::coincident_nodes(first, (first + 1) % self.nodes.len(), self.nodes[first])),
            None => Ok(()),
        }
    }

    /// Returns the present positions of all nodes (length), held ones among them, not wrapped into the periods of the
    /// region.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.nodes
    }

    /// Returns the vector from the first node to its image after the last node (length): zero for a closed fibre, the
    /// period of a periodic one, and `None` for an open fibre.
    #[must_use]
    pub fn period(&self) -> Option<Vec2> {
        self.elasticity.advance
    }

    /// Returns the length at rest (length).
    #[must_use]
    pub fn rest_length(&self) -> f64 {
        self.elasticity.lengths.iter().sum()
    }

    /// Returns the present length (length).
    #[must_use]
    pub fn length(&self) -> f64 {
        (0..self.elasticity.lengths.len()).map(|k| self.elasticity.segment(&self.nodes, k).length()).sum()
    }

    /// Returns how the ends are held.
    #[must_use]
    pub fn ends(&self) -> [FibreEnd; 2] {
        self.ends
    }

    /// Returns the targets.
    #[must_use]
    pub fn targets(&self) -> &[Target] {
        &self.targets
    }

    /// Returns the energies of stretching, of bending and of the targets (force times length) at the time of the scene.
    #[must_use]
    pub fn energies(&self) -> [f64; 3] {
        let [stretching, bending] = self.elasticity.energies(&self.nodes, |node| self.beat(node));
        let targets = self.targets.iter().map(|target| {
            let place = target.at(self.along[target.node], self.time);
            0.5 * target.stiffness * (self.nodes[target.node] - place).length_squared()
        });
        [stretching, bending, targets.fold(0.0, |sum, energy| sum + energy)]
    }

    /// Returns the forces at all nodes (force), held ones among them: minus the gradient of the sum of
    /// [`Fibre::energies`], and the loads.
    #[must_use]
    pub fn node_forces(&self) -> Vec<Vec2> {
        let mut forces = vec![Vec2::ZERO; self.nodes.len()];
        self.add_forces(&self.nodes, &mut forces);
        forces
    }

    /// Returns the curvature that the wave adds at a node (1/length).
    fn beat(&self, node: usize) -> f64 {
        self.wave.map_or(0.0, |wave| wave.amplitude * wave.at(self.along[node], self.time))
    }

    /// Adds the forces (force) at nodes in these places.
    fn add_forces(&self, nodes: &[Vec2], forces: &mut [Vec2]) {
        self.elasticity.add_forces(nodes, |node| self.beat(node), forces);
        for target in &self.targets {
            let place = target.at(self.along[target.node], self.time);
            forces[target.node] += target.stiffness * (place - nodes[target.node]);
        }
        for (node, force) in &self.loads {
            forces[*node] += *force;
        }
    }
}

#[cfg(test)]
mod tests;
