//! Target points: places to which nodes of a fibre are tethered.

use motile_base::Vec2;

use super::FibreWave;

/// A spring of zero length from a node of a fibre to a place, which may move in time:
/// `place + velocity t + wave(s, t)`, s the length at rest from the first node to the node.
///
/// The force on the fluid is `stiffness (target - node)`. The energy is `stiffness/2 |target - node|^2`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("tether", "target point"))]
pub struct Target {
    /// Number of the node, from 0.
    pub node: usize,
    /// Place at time 0, without the wave (length).
    pub place: Vec2,
    /// Spring constant (force per length).
    pub stiffness: f64,
    /// Velocity of the place (length per time).
    pub velocity: Vec2,
    /// Wave that displaces the place (length), such as a peristaltic wave along a row of targets.
    pub wave: Option<FibreWave<Vec2>>,
}

impl Target {
    /// Creates a target at a fixed place (length) with a spring constant (force per length).
    #[must_use]
    pub fn fixed(node: usize, place: Vec2, stiffness: f64) -> Self {
        Self { node, place, stiffness, velocity: Vec2::ZERO, wave: None }
    }

    /// Returns true if the place depends on time.
    pub(super) fn moves(&self) -> bool {
        self.velocity != Vec2::ZERO || self.wave.is_some_and(|wave| wave.frequency != 0.0)
    }

    /// Returns the place (length) at a time, `along` the length at rest from the first node to the node.
    #[must_use]
    pub fn at(&self, along: f64, time: f64) -> Vec2 {
        let wave = self.wave.map_or(Vec2::ZERO, |wave| wave.at(along, time) * wave.amplitude);
        self.place + time * self.velocity + wave
    }
}
