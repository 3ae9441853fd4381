//! The flow that two parallel walls without slip add, by plane waves.
//!
//! Between walls at z = -1 and 1, a wave vector k has the longitudinal direction L along k, the transverse one T, and
//! z. The free flow of a force at z', times 8 pi eta, is at the distance `a = |z - z'|`
//!
//! ```text
//! LL (2 pi/k)(1 - k a) e^(-k a)    TT (4 pi/k) e^(-k a)
//! zz (2 pi/k)(1 + k a) e^(-k a)    Lz = zL = -2 pi i (z - z') e^(-k a)
//! ```
//!
//! and its derivatives by the place of the force, with a pressure, give the double layer. The walls add the flow that
//! cancels this on both. Its component `w = u_z` is a sum of cosh kz, z sinh(kz)/k, sinh(kz)/k and
//! (z cosh kz - sinh(kz)/k)/k^2, which are different functions also for k = 0. The others are `u_L = i w'/k`, and a sum
//! of cosh kz and sinh kz for `u_T`. The integral over k is a Gauss-Legendre rule in the root of |k| and a trapezoidal
//! rule in its angle. Both converge exponentially.

mod modes;
mod rule;

use motile_base::{finite, internal::Refuse};
use stokes_boundary_integrals::internal::{MOST_SHARES, each_share};

use crate::SpaceError;
use crate::surroundings::{Components, Sources, Surroundings, Targets, digits, edge};
use modes::{Block, Share};
use rule::{DIGITS, Extent, Rule};

/// Exponent of the error of the walls' flow, above which a droplet is too close to a wall.
const LEAST_DIGITS: f64 = 9.0;
/// Part of a picture's reach over which walls are shown, so that their corners are on it.
const SHOWN: f64 = 0.6;
/// Added to the exponent of a rough flow, because walls amplify what is left out (measured).
const MARGIN: f64 = 5.0;
/// Part of half of the slit that round-off may put a target beyond a wall.
const ROUND_OFF: f64 = 1e-9;

/// Two parallel plane walls without slip, at `z = lower` and `z = upper`, without end along x and y.
///
/// Far from the walls, the flow has the accuracy of the droplet. At a gap d between the walls and a droplet of radius R
/// and degree p, the error of the flow that the walls add is about `exp(-(8 p + 4) d/R)`. Droplets for which this is
/// more than 1e-4 are refused: at p = 16, gaps below 0.07 R. The work grows as droplets come closer to a wall, or
/// are far from each other.
///
/// ```
/// use space_droplets::{ContractileTension, ExcludedVolume, Slit, SpaceDroplet};
///
/// // A droplet with a gradient of tension along x, in the middle between two walls 8 radii apart.
/// let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0)?;
/// let droplet = SpaceDroplet::sphere(8, 1.0, [1.0, 1.0], law)?.with_particles(0.1, |s| 1.0 + s[0])?;
/// let mut droplet = droplet.with_surroundings(Slit::new(-4.0, 4.0)?)?;
/// let speed = droplet.observe()?.velocity[0];
/// println!("speed over the one without walls {:.6}, exact 0.993668", -15.0 * speed);
/// assert!((-15.0 * speed - 0.993_667_68).abs() < 1e-7);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Slit {
    lower: f64,
    upper: f64,
    rule: Rule,
    shares: Vec<Share>,
    blocks: Vec<Block>,
}

impl Slit {
    /// Creates the walls at these two heights (length).
    ///
    /// # Errors
    /// Returns an error if a height is not finite, or if the upper wall is not above the lower one.
    pub fn new(lower: f64, upper: f64) -> Result<Self, SpaceError> {
        finite("the height of the lower wall", lower)?;
        finite("the height of the upper wall", upper)?;
        if upper <= lower {
            let (what, value) = ("the upper wall of a slit is not above the lower one", format!("{lower} and {upper}"));
            return Err(SpaceError::refused(what, value, "Swap the heights or move the walls apart"));
        }
        let shares = vec![Share::default(); MOST_SHARES];
        Ok(Self { lower, upper, rule: Rule::default(), shares, blocks: Vec::new() })
    }

    /// Returns the height of the lower wall (length).
    #[must_use]
    pub fn lower(&self) -> f64 {
        self.lower
    }

    /// Returns the height of the upper wall (length).
    #[must_use]
    pub fn upper(&self) -> f64 {
        self.upper
    }

    fn half(&self) -> f64 {
        0.5 * (self.upper - self.lower)
    }

    /// Returns the minimum distance of places from the walls (length), and the height of the wall there.
    fn nearest(&self, places: Components<'_>) -> [f64; 2] {
        places[2].iter().flat_map(|z| [[z - self.lower, self.lower], [self.upper - z, self.upper]]).fold(
            [f64::INFINITY, self.lower],
            // Places that are not numbers are beyond a wall.
            |best, next| if next[0] < best[0] || next[0].is_nan() { next } else { best },
        )
    }
}

impl Slit {
    /// Adds the flow of the walls without parts below exp(-digits) of it.
    fn add(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>], digits: f64) -> Result<(), SpaceError> {
        let half = self.half();
        let least = |least: f64, places: Components<'_>| least.min(self.nearest(places)[0]);
        let gaps = [
            sources.iter().map(Sources::places).fold(f64::INFINITY, least),
            targets.iter().map(|target| target.places).fold(f64::INFINITY, least),
        ];
        if gaps.contains(&f64::INFINITY) {
            return Ok(());
        }
        if !(gaps[0] > 0.0 && gaps[1] > -ROUND_OFF * half) {
            let what = "a flow in the slit is asked for or made at a point that is not between the walls";
            let value = format!("it is {} beyond a wall", -gaps[0].min(gaps[1]));
            return Err(SpaceError::refused(what, value, "Use points between the walls"));
        }
        let extent = Extent::new(self.lower, half, gaps, sources, targets);
        if !self.rule.update(&extent, digits) {
            let what = "the flow of droplets or at points that are so far apart along the walls would take too long";
            let value = format!("{:.0} half widths of the slit", extent.reach);
            return Err(SpaceError::refused(what, value, "Bring them closer together, or farther from the walls"));
        }
        // Rings of wave vectors are dealt out in turn, because the outer ones have more angles.
        let Self { rule, shares, blocks, .. } = self;
        let len = shares.len();
        for (k, share) in shares.iter_mut().enumerate() {
            share.rings.clear();
            share.rings.extend((k..rule.rings.len()).step_by(len));
        }
        let rule = &*rule;
        each_share(shares, |share| share.gather(rule, &extent, sources));
        let count = Block::distribute(blocks, targets);
        let (shares, places) = (&*shares, &*targets);
        each_share(&mut blocks[..count], |block| block.scatter(rule, &extent, shares, places[block.group].places));
        for block in &blocks[..count] {
            for (out, sums) in targets[block.group].flow.iter_mut().zip(&block.sums) {
                out[block.first..].iter_mut().zip(sums).for_each(|(out, sum)| *out += sum);
            }
        }
        Ok(())
    }
}

impl Surroundings for Slit {
    fn add_flow(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>]) -> Result<(), SpaceError> {
        self.add(sources, targets, DIGITS)
    }

    fn add_rough_flow(
        &mut self,
        sources: &[Sources<'_>],
        targets: &mut [Targets<'_>],
        accuracy: f64,
    ) -> Result<(), SpaceError> {
        self.add(sources, targets, (MARGIN - accuracy.max(f64::MIN_POSITIVE).ln()).min(DIGITS))
    }

    fn check(&self, time: f64, droplet: usize, places: Components<'_>) -> Result<(), SpaceError> {
        let [gap, wall] = self.nearest(places);
        if gap.is_nan() || gap <= 0.0 {
            let wall = format!("the wall at z = {wall}");
            let remedy = "Move it between the walls, make it smaller or the slit wider, or use shorter steps";
            return Err(SpaceError::Wall { time, droplet, wall, remedy });
        }
        // A wall reflects a droplet as an image at twice the distance.
        if digits(places, 2.0 * gap) < LEAST_DIGITS {
            let what =
                format!("at time {time} the gap between droplet {droplet} and the wall at z = {wall} is too small");
            return Err(SpaceError::refused(
                what,
                gap.to_string(),
                "Use a higher degree, or start farther from the wall",
            ));
        }
        Ok(())
    }

    fn gap(&self, places: Components<'_>) -> f64 {
        self.nearest(places)[0]
    }

    fn outline(&self, middle: [f64; 3], reach: f64) -> Vec<Vec<[f64; 3]>> {
        let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
        let sides = [self.lower, self.upper].into_iter().flat_map(|z| {
            let corner = move |k: usize| {
                let [x, y] = corners[k % 4];
                [middle[0] + SHOWN * reach * x, middle[1] + SHOWN * reach * y, z]
            };
            (0..4).map(move |k| edge(corner(k), corner(k + 1)))
        });
        sides.collect()
    }

    fn properties(&self) -> Vec<(&'static str, f64)> {
        vec![("the height of the lower wall", self.lower), ("the height of the upper wall", self.upper)]
    }
}

#[cfg(test)]
mod tests;
