//! A short-range repulsion between interfaces.

use input_checks::{InputError, positive};

use super::boundary::nearest;
use crate::{MarkerKind, Markers};

/// A repulsion between different interfaces that come close, an option for scenes of several droplets whose films the
/// grid does not resolve; off unless a scene is told otherwise ([`crate::Scene::with_repulsion`]). It is not part of
/// Cowley's model.
///
/// Each pair of pieces of interfaces of lengths ds and ds', a distance r < range apart, is pushed apart by the force
/// ```text
/// strength ds ds' (1 - r/range)^2
/// ```
/// along the line between them, so that all forces together have no resultant and no torque.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Repulsion {
    strength: f64,
    range: f64,
}

impl Repulsion {
    /// A repulsion of that strength (force per length squared) and range (length).
    ///
    /// # Errors
    /// Values that are not positive and finite.
    pub fn new(strength: f64, range: f64) -> Result<Self, InputError> {
        Ok(Self {
            strength: positive("the strength of the repulsion", strength)?,
            range: positive("the range of the repulsion", range)?,
        })
    }

    /// Its strength (force per length squared).
    #[must_use]
    pub fn strength(&self) -> f64 {
        self.strength
    }

    /// Its range (length).
    #[must_use]
    pub fn range(&self) -> f64 {
        self.range
    }

    /// Largest stable step of the midpoint rule (time) in fluid of viscosity eta: two flat interfaces within the range
    /// move apart at a rate of at most about `strength range / (2 eta)`.
    pub(crate) fn step_limit(&self, viscosity: f64) -> f64 {
        4.0 * viscosity / (self.strength * self.range)
    }

    /// Adds the forces between all interfaces to those of the markers.
    pub(crate) fn add(&self, markers: &mut Markers, periods: [Option<f64>; 2]) {
        for first in 0..markers.groups().len() {
            for second in first + 1..markers.groups().len() {
                self.add_between(first, second, markers, periods);
            }
        }
    }

    fn add_between(&self, first: usize, second: usize, markers: &mut Markers, periods: [Option<f64>; 2]) {
        let [a, b] = [first, second].map(|index| markers.groups()[index].clone());
        if [a.kind, b.kind].contains(&MarkerKind::Points) {
            return;
        }
        // Half the distance of the neighbours.
        let length = |markers: &Markers, range: &std::ops::Range<usize>, k: usize| {
            let (count, i) = (range.len(), k - range.start);
            let [before, after] =
                [(i + count - 1) % count, (i + 1) % count].map(|i| markers.positions[range.start + i]);
            0.5 * (after - before).length()
        };
        for i in a.range.clone() {
            let (place, piece) = (markers.positions[i], length(markers, &a.range, i));
            for j in b.range.clone() {
                let apart = nearest(place - markers.positions[j], periods);
                let distance = apart.length();
                if distance < self.range && distance > 0.0 {
                    let closeness = 1.0 - distance / self.range;
                    let size = self.strength * piece * length(markers, &b.range, j) * closeness * closeness;
                    let force = size / distance * apart;
                    markers.forces[i] += force;
                    markers.forces[j] -= force;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
