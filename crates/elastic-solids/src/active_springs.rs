//! Active springs: bonds along the edges of a mesh that contract while they are on.

use motile_base::{Vec2, finite, not_negative, positive};

use crate::SolidError;
use crate::forces::{Bar, add_stress_of_bar};
use crate::material::Mat2;
use crate::mesh::{Edge, TriangleMesh};
use crate::random::uniform;

/// Bonds of two states along all edges of a mesh, such as motors that bind and unbind: each pulls the ends of its edge
/// together by a constant tension while it is on, and is turned on and off at random.
///
/// With p = on/(on + off), k = on + off, a bond is on after a step of dt with the probability `p + (1-p) exp(-k dt)` if
/// it was on and `p (1 - exp(-k dt))` if it was off. This is exact for any step at constant rates. At the start, it is
/// on with the probability p. On a triangular lattice of spacing l, the mean stress is `sqrt(3) p f/l`, an isotropic
/// contraction. It holds up to the boundary, where bonds pull half as much, as springs there do. A free lattice of
/// springs of the spring constant K shrinks by `p f/(K l)`. Rates may depend on the strain e = r/d - 1 of the edge, as
/// `rate exp(sensitivity e)` with the strain at the end of the step. A positive sensitivity of unbinding makes slip
/// bonds, a negative one catch bonds.
///
/// Random numbers are functions of the seed, the number of the bond and the number of the step, so that a run is the
/// same for any number of threads and through a checkpoint.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("motors", "myosin", "catch bond", "slip bond"))]
pub struct ActiveSprings {
    tension: f64,
    rates: [f64; 2],
    sensitivities: [f64; 2],
    seed: u64,
}

impl ActiveSprings {
    /// Creates bonds with the tension f (force) while they are on, and with these rates of turning on and off (1/time).
    ///
    /// # Errors
    /// Returns an error for a tension or rate of turning on that is not positive and finite; a rate of turning off that
    /// is negative or not finite.
    pub fn new(tension: f64, on: f64, off: f64, seed: u64) -> Result<Self, SolidError> {
        let tension = positive("the tension of the active springs", tension)?;
        let on = positive("the rate at which active springs turn on", on)?;
        let off = not_negative("the rate at which active springs turn off", off)?;
        Ok(Self { tension, rates: [on, off], sensitivities: [0.0; 2], seed })
    }

    /// Makes the rates of turning on and off depend on the strain of the edges, with these sensitivities (no
    /// dimension).
    ///
    /// # Errors
    /// Returns an error for sensitivities that are not finite.
    pub fn with_sensitivities(mut self, on: f64, off: f64) -> Result<Self, SolidError> {
        self.sensitivities = [finite("the sensitivity of turning on", on)?, finite("that of turning off", off)?];
        Ok(self)
    }

    /// Returns the tension of a bond that is on (force).
    #[must_use]
    pub fn tension(&self) -> f64 {
        self.tension
    }

    /// Returns the mean fraction of the bonds of unstrained edges that are on (no dimension).
    #[must_use]
    pub fn duty_ratio(&self) -> f64 {
        self.rates[0] / (self.rates[0] + self.rates[1])
    }

    /// Returns the probability of being on after a time `dt` for a bond of an edge of the strain `strain` (no
    /// dimension).
    fn probability(&self, on: bool, strain: f64, dt: f64) -> f64 {
        // Rates that are beyond all bounds are as good as the largest numbers.
        let rate = |k: usize| self.rates[k] * (self.sensitivities[k] * strain).clamp(-600.0, 600.0).exp();
        let total = rate(0) + rate(1);
        let mean = rate(0) / total;
        let kept = (-total * dt).exp();
        if on { mean + (1.0 - mean) * kept } else { -mean * (-total * dt).exp_m1() }
    }
}

/// The bonds of a solid.
#[derive(Debug, Clone)]
pub(crate) struct Bonds {
    law: ActiveSprings,
    /// Bars, and the factor on the tension that each has: its own half on the boundary.
    bars: Vec<(Bar, f64)>,
    on: Vec<bool>,
    /// Accepted steps.
    steps: u64,
}

impl Bonds {
    /// Bonds along all edges of a mesh, in their stationary state without strain.
    pub(crate) fn new(mesh: &TriangleMesh, law: ActiveSprings) -> Self {
        let share = |edge: &Edge| if edge.triangles.1.is_some() { 1.0 } else { 0.5 };
        let bars: Vec<(Bar, f64)> = Bar::all(mesh).zip(mesh.edges().iter().map(share)).collect();
        let on = (0..bars.len()).map(|bond| uniform(law.seed, bond as u64, 0) < law.duty_ratio()).collect();
        Self { law, bars, on, steps: 0 }
    }

    /// Multiplies the tension by a factor that is a function of the reference position of the middle of an edge
    /// (length).
    ///
    /// # Errors
    /// Returns an error for a factor that is negative or not finite.
    pub(crate) fn graded(
        mut self,
        mesh: &TriangleMesh,
        mut factor: impl FnMut(Vec2) -> f64,
    ) -> Result<Self, SolidError> {
        for ((_, share), edge) in self.bars.iter_mut().zip(mesh.edges()) {
            let middle = mesh.points()[edge.points[0]] + 0.5 * mesh.edge_vector(edge, mesh.points());
            *share *= not_negative("the factor on the tension of the active springs", factor(middle))?;
        }
        Ok(self)
    }

    /// Returns the states of the bonds, in the order of the edges.
    pub(crate) fn on(&self) -> &[bool] {
        &self.on
    }

    /// Puts the bonds into these states, `true` if a number is nearer to 1 than to 0.
    pub(crate) fn set(&mut self, states: &[f64]) {
        self.on.iter_mut().zip(states).for_each(|(on, state)| *on = *state > 0.5);
    }

    /// Returns the number of accepted steps.
    pub(crate) fn steps(&self) -> u64 {
        self.steps
    }

    /// Continues from that number of steps.
    pub(crate) fn set_steps(&mut self, steps: u64) {
        self.steps = steps;
    }

    /// Counts an accepted step.
    pub(crate) fn keep_step(&mut self) {
        self.steps += 1;
    }

    /// Turns bonds on and off at the end of a step of `dt` (time), with the points at `positions` (length).
    pub(crate) fn end_step(&mut self, positions: &[Vec2], dt: f64) {
        for (bond, ((bar, _), on)) in self.bars.iter().zip(&mut self.on).enumerate() {
            let strain = bar.span(positions).length() / bar.length - 1.0;
            *on = uniform(self.law.seed, bond as u64, self.steps + 1) < self.law.probability(*on, strain, dt);
        }
    }

    /// Adds the forces of the bonds that are on (force) with the points at `positions` (length).
    pub(crate) fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) {
        for ((bar, share), _) in self.bars.iter().zip(&self.on).filter(|(_, on)| **on) {
            let span = bar.span(positions);
            bar.add_pull(span * (share * self.law.tension / span.length().max(f64::MIN_POSITIVE)), forces);
        }
    }

    /// Adds the Cauchy stresses of the bonds (force per deformed length) to the stresses of the triangles of the mesh,
    /// none of which is inverted.
    pub(crate) fn add_stresses(&self, mesh: &TriangleMesh, positions: &[Vec2], stresses: &mut [Mat2]) {
        for (edge, ((bar, share), _)) in self.bars.iter().zip(&self.on).enumerate().filter(|(_, (_, on))| **on) {
            add_stress_of_bar((mesh, edge), (bar, share * self.law.tension), positions, stresses);
        }
    }

    /// Returns the upper bound of the stiffness that the tension adds to the lattice (force per length).
    pub(crate) fn stiffness(&self, spacing: f64) -> f64 {
        let largest = self.bars.iter().fold(0.0, |largest: f64, (_, share)| largest.max(*share));
        3.0_f64.sqrt() * largest * self.law.tension / spacing
    }

    /// Returns the longest step (time) that resolves how bonds turn on and off: half of the time in which they forget.
    pub(crate) fn resolved_step(&self) -> f64 {
        0.5 / (self.law.rates[0] + self.law.rates[1])
    }

    /// Parameters by their names.
    pub(crate) fn properties(&self) -> [(&'static str, f64); 7] {
        let ActiveSprings { tension, rates, sensitivities, seed } = self.law;
        [
            ("the tension of its active springs", tension),
            ("the rate at which they turn on", rates[0]),
            ("the rate at which they turn off", rates[1]),
            ("the sensitivity of turning on", sensitivities[0]),
            ("the sensitivity of turning off", sensitivities[1]),
            ("the seed of its active springs", seed as f64),
            ("the sum of the factors on their tension", self.bars.iter().map(|(_, share)| share).sum()),
        ]
    }
}

#[cfg(test)]
mod tests;
