//! The flow that the periodic images of droplets add, by a split sum.
//!
//! The Stokeslet is `G = (I lap - grad grad) r`. Its smooth part replaces r by B(r), with the spectrum
//! `-8 pi phi(k r_c)/k^4`. The function phi, made from the prolate function of order 0, vanishes beyond c, and makes
//! `G - G_M` vanish beyond the cut-off r_c. So the images are a sum over the wave vectors of the box up to c/r_c, and
//! over the few images within the cut-off. The flow of the sources themselves in unbounded fluid is left out.
//!
//! The wave vector 0 fixes the frame: the mean velocity of the box is zero, over the fluid outside and inside. If
//! forces have a sum, a uniform pressure gradient balances it.

mod near;
mod split;
mod waves;

use std::sync::Arc;

use motile_base::{internal::Refuse, positive};
use stokes_boundary_integrals::internal::{MOST_SHARES, each_share};

use crate::SpaceError;
use crate::surroundings::{Components, Sources, Surroundings, Targets, bounds, digits, edge};
use near::Near;
use split::{LEVELS, Split};
use waves::{Block, Columns, Share};

/// The cut-off over the shortest side of the box: sums over waves and over neighbours take about equal time.
const CUT_OFF: f64 = 0.6;
/// Exponent of the error of the flow of a droplet's own images, above which the box is too small.
const LEAST_DIGITS: f64 = 9.0;

/// A periodic box: the flow and the droplets repeat along x, y and z.
///
/// The mean velocity of the box is zero, over the fluid outside and inside of droplets. Droplets move freely through
/// its sides, and their positions count on. The work is proportional to the product of the numbers of droplets and of
/// their images within a side of the box, and to its volume.
///
/// ```
/// use space_droplets::{ContractileTension, ExcludedVolume, PeriodicBox, SpaceDroplet};
///
/// // A droplet with a gradient of tension along x, in a cube with sides of 6 radii. Its flow outside is a dipole with
/// // the mean 0, so the box moves back by the droplet's part of its volume.
/// let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0)?;
/// let droplet = SpaceDroplet::sphere(8, 1.0, [1.0, 1.0], law)?.with_particles(0.1, |s| 1.0 + s[0])?;
/// let mut droplet = droplet.with_surroundings(PeriodicBox::new([6.0; 3])?)?;
/// let speed = droplet.observe()?.velocity[0];
/// let exact = -(1.0 - 4.0 * std::f64::consts::PI / 3.0 / 216.0) / 15.0;
/// println!("speed {speed:.9}, exact {exact:.9}");
/// assert!((speed / exact - 1.0).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct PeriodicBox {
    size: [f64; 3],
    cut_off: f64,
    /// Splits with all digits and with fewer; a split that is not needed is not made.
    levels: [Option<Level>; LEVELS.len()],
    shares: Vec<Share>,
    blocks: Vec<Block>,
}

/// A split and its wave vectors.
#[derive(Debug, Clone)]
struct Level {
    split: Arc<Split>,
    columns: Arc<Columns>,
}

impl Level {
    fn new(size: [f64; 3], cut_off: f64, c: f64) -> Self {
        let split = Split::new(c);
        Self { columns: Arc::new(Columns::new(size, cut_off, &split)), split: Arc::new(split) }
    }
}

impl PeriodicBox {
    /// Largest ratio of the longest to the shortest side. Above it, the waves would be too many.
    pub const LARGEST_RATIO: f64 = 50.0;

    /// Creates a box with these sides along x, y and z (length).
    ///
    /// # Errors
    /// Returns an error if a side is not positive and finite, or more than 50 times longer than another.
    pub fn new(size: [f64; 3]) -> Result<Self, SpaceError> {
        for side in size {
            positive("a side of the box", side)?;
        }
        let [least, most] = size.iter().fold([f64::INFINITY, 0.0_f64], |[a, b], &side| [a.min(side), b.max(side)]);
        if most > Self::LARGEST_RATIO * least {
            let value = format!("{} x {} x {}", size[0], size[1], size[2]);
            let what = "the box is too long for its width";
            return Err(SpaceError::refused(
                what,
                value,
                format!("Use sides that differ by less than {}", Self::LARGEST_RATIO),
            ));
        }
        let cut_off = CUT_OFF * least;
        let shares = vec![Share::default(); MOST_SHARES];
        Ok(Self { size, cut_off, levels: [const { None }; LEVELS.len()], shares, blocks: Vec::new() })
    }

    /// Returns the sides (length).
    #[must_use]
    pub fn size(&self) -> [f64; 3] {
        self.size
    }

    /// Adds the flow of the images by one of the splits.
    fn add(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>], level: usize) {
        let Self { size, cut_off, levels, shares, blocks } = self;
        let Level { split, columns } =
            levels[level].get_or_insert_with(|| Level::new(*size, *cut_off, LEVELS[level].0));
        let len = shares.len();
        for (k, share) in shares.iter_mut().enumerate() {
            share.columns.clear();
            share.columns.extend((k..columns.list.len()).step_by(len));
        }
        let columns = &**columns;
        each_share(shares, |share| share.gather(columns, sources));
        let count = Block::distribute(blocks, targets);
        let volume: f64 = size.iter().product();
        let mut mean = [0.0; 3];
        for source in sources {
            let flow = mean_flow(source, volume);
            mean = std::array::from_fn(|i| mean[i] + flow[i]);
        }
        let (shares, near, places) = (&*shares, Near { split, size: *size, cut_off: *cut_off }, &*targets);
        each_share(&mut blocks[..count], |block| {
            let places = places[block.group].places;
            block.scatter(columns, shares, places, mean);
            sources.iter().for_each(|source| near.add(source, places, block));
        });
        for block in &blocks[..count] {
            for (out, sums) in targets[block.group].flow.iter_mut().zip(&block.sums) {
                out[block.first..].iter_mut().zip(sums).for_each(|(out, sum)| *out += sum);
            }
        }
    }
}

impl Surroundings for PeriodicBox {
    fn add_flow(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>]) -> Result<(), SpaceError> {
        self.add(sources, targets, 0);
        Ok(())
    }

    fn add_rough_flow(
        &mut self,
        sources: &[Sources<'_>],
        targets: &mut [Targets<'_>],
        accuracy: f64,
    ) -> Result<(), SpaceError> {
        let level = LEVELS.iter().rposition(|(_, error)| *error <= accuracy).unwrap_or(0);
        self.add(sources, targets, level);
        Ok(())
    }

    fn check(&self, time: f64, droplet: usize, places: Components<'_>) -> Result<(), SpaceError> {
        for ([low, high], side) in bounds(places).into_iter().zip(self.size) {
            let what = if high - low >= side {
                format!("at time {time} droplet {droplet} does not fit into the box with a side of {side}")
            } else if digits(places, side - (high - low)) < LEAST_DIGITS {
                format!("at time {time} droplet {droplet} is too close to its image in the box with a side of {side}")
            } else {
                continue;
            };
            let value = format!("it is {} long", high - low);
            return Err(SpaceError::refused(
                what,
                value,
                "Enlarge the box, shrink the droplet, or use a higher degree",
            ));
        }
        Ok(())
    }

    fn outline(&self, middle: [f64; 3], _: f64) -> Vec<Vec<[f64; 3]>> {
        let corner =
            |k: usize| std::array::from_fn(|i| middle[i] + if k >> i & 1 == 0 { -0.5 } else { 0.5 } * self.size[i]);
        let ends = (0..8_usize).flat_map(|k| [1, 2, 4].map(|bit| (k, k | bit))).filter(|(from, to)| from != to);
        ends.map(|(from, to)| edge(corner(from), corner(to))).collect()
    }

    fn properties(&self) -> Vec<(&'static str, f64)> {
        let [x, y, z] = self.size;
        vec![("the side of the box along x", x), ("the side of the box along y", y), ("the side of the box along z", z)]
    }

    fn images(&self, displacement: [f64; 3], reach: f64, visit: &mut dyn FnMut([f64; 3])) {
        let range = |i: usize| {
            let low = ((-displacement[i] - reach) / self.size[i]).ceil();
            let high = ((-displacement[i] + reach) / self.size[i]).floor();
            low as i64..=high as i64
        };
        for x in range(0) {
            for y in range(1) {
                for z in range(2) {
                    if [x, y, z] != [0, 0, 0] {
                        visit([x as f64 * self.size[0], y as f64 * self.size[1], z as f64 * self.size[2]]);
                    }
                }
            }
        }
    }
}

/// Returns the wave vector 0 of a double layer: the flow inside of closed surfaces counts in the mean velocity. Places
/// count from their middle, so that the flux through a surface, which is zero up to its truncation, does no more the
/// farther the droplet has come.
fn mean_flow(source: &Sources<'_>, volume: f64) -> [f64; 3] {
    match source {
        Sources::Forces { .. } => [0.0; 3],
        Sources::Stresslets { places, normals, velocities } => std::array::from_fn(|i| {
            let through = |k: usize| (0..3).map(|j| normals[j][k] * velocities[j][k]).sum::<f64>();
            let middle = places[i].iter().sum::<f64>() / places[i].len().max(1) as f64;
            -places[i].iter().enumerate().map(|(k, x)| (x - middle) * through(k)).sum::<f64>() / volume
        }),
    }
}

#[cfg(test)]
mod tests;
