//! Descriptions of rigid walls and obstacles.

use active_interface::InterfaceError;
use elastic_solids::{ChannelShape, Outline};
use motile_base::{
    Region, Vec2,
    internal::{Refuse as _, place},
    polygon::{self, CrossingFinder},
};
use motile_boundary_integrals::{RigidWall, Settings};
use motile_scene::gap::Boundary;
use serde::{Deserialize, Serialize};

use super::{Setup, SolidOutline, checked::Checked};
use crate::SetupError;

/// Points per node by which corners are rounded.
const FINER: f64 = 16.0;
/// Largest factor between the distances of nodes along a wall.
const MOST_GRADING: f64 = 10.0;
/// Most nodes of a wall.
const MOST_NODES: f64 = 3000.0;

/// A rigid wall or obstacle at rest in a channel, by boundary integrals.
///
/// ```
/// use motile::prelude::*;
/// use motile::elastic_solids::ChannelShape;
/// use motile::setup::WallSetup;
///
/// // A wavy channel of width 3 -+ 0.6 in a region of 12 x 5.
/// let shape = ChannelShape::Sinusoidal { width: 3.0, amplitude: 0.3, waves: 1, phase: 0.0 };
/// let setup = Setup {
///     region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
///     method: Method::Integral(IntegralMethod { nodes: 32, elements: 128 }),
///     walls: WallSetup::channel(&shape, 0.15),
///     ..Setup::default()
/// };
/// let Built { mut scene, droplets, .. } = setup.build()?;
/// scene.run(0.5).go()?;
/// println!("speed {:.3}", scene.observe(droplets[0])?.speed());
/// let gap = scene.system().minimum_wall_gap().unwrap();
/// assert!(gap > 0.75 && gap < 0.8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[doc(alias("no-slip", "obstacle", "post"))]
pub struct WallSetup {
    /// Outline that it bounds: the side of a channel, an island, a closed outline.
    pub outline: SolidOutline,
    /// Distance of its nodes where walls are nearest to one another (length).
    pub spacing: f64,
    /// Largest factor by which this distance grows in proportion to the distance from the other walls, though never
    /// beyond what curvature requires. It is 1 for equal distances, which is the default in a file. See
    /// [`RigidWall::graded`].
    #[serde(default = "uniform")]
    pub grading: f64,
    /// Length over which corners are rounded: the standard deviation of a Gaussian along the wall (length), for walls
    /// of any outline ([`RigidWall::rounded`]). A right angle needs 1.25 times the spacing, sharper corners need more,
    /// and the warning of a corner that is not resolved names the length. To round the corners of a polygon by arcs
    /// instead, leave this 0, which is the default in a file, and give [`SolidOutline::Polygon`] a radius.
    #[serde(default)]
    pub rounding: f64,
}

fn uniform() -> f64 {
    1.0
}

/// Fraction of the width by which a wall may be beyond the straight walls, and an obstacle must be away from them.
const ROUND_OFF: f64 = 1e-9;

impl WallSetup {
    /// Creates the wall along a smooth outline, with nodes at that distance (length).
    #[must_use]
    pub fn new(outline: SolidOutline, spacing: f64) -> Self {
        Self { outline, spacing, grading: uniform(), rounding: 0.0 }
    }

    /// Returns the sides and islands of a channel, with nodes at that distance (length).
    #[must_use]
    pub fn channel(channel: &ChannelShape, spacing: f64) -> Vec<Self> {
        let wall = |outline| Self::new(outline, spacing);
        let mut walls = vec![wall(SolidOutline::WallBelow(*channel)), wall(SolidOutline::WallAbove(*channel))];
        let island = |number| wall(SolidOutline::Island { of: *channel, number });
        walls.extend((0..channel.islands()).map(island));
        walls
    }

    /// Returns the wall of this description in a region of that period along x (length).
    fn build(&self, checked: &Checked<'_>, period: f64) -> Result<RigidWall, SetupError> {
        let outline = self.outline.line(period)?;
        let nodes = (outline.length() / self.spacing).max(Settings::NODES[0] as f64);
        let remedy = format!("the wall would have {nodes:.1e} nodes, too many to compute. Use a larger spacing");
        checked.refuse_if(nodes.is_nan() || nodes > MOST_NODES, "spacing", self.spacing, remedy)?;
        let nodes = 2 * (0.5 * nodes).ceil() as usize;
        let points = points(&outline, (FINER * nodes as f64) as usize)?;
        let advance = if self.outline.is_wall() { period } else { 0.0 };
        if let Some((first, _)) =
            CrossingFinder::default().first_crossing_over(&points, advance).map_err(InterfaceError::from)?
        {
            let what = format!("the outline crosses itself near {}", place(points[first].x, points[first].y));
            return Err(SetupError::refused(what, "", "Give its points in order, around the wall"));
        }
        let wall = if !self.outline.is_wall() {
            RigidWall::obstacle(points, nodes)?
        } else if self.outline.is_above() {
            RigidWall::line_above(points, period, nodes)?
        } else {
            RigidWall::line_below(points, period, nodes)?
        };
        Ok(wall.rounded(self.rounding)?)
    }
}

/// Returns the points of an outline at equal distances along it.
fn points(outline: &Outline, count: usize) -> Result<Vec<Vec2>, SetupError> {
    let length = outline.length();
    let end = |points: &[Vec2]| points[0] + Vec2::new(outline.period().unwrap_or(0.0), 0.0);
    // Corners divide an outline into parts, each with a number of its own.
    let fine = outline.resampled(0.25 * length / count as f64)?;
    let mut points = Vec::with_capacity(count);
    let ends = fine.iter().skip(1).copied().chain([end(&fine)]);
    let pieces: Vec<[Vec2; 2]> = fine.iter().copied().zip(ends).map(|(a, b)| [a, b]).collect();
    let total: f64 = pieces.iter().map(|[a, b]| a.distance(*b)).sum();
    let (mut before, mut pieces) = (0.0, pieces.into_iter().peekable());
    while points.len() < count {
        let Some(&[a, b]) = pieces.peek() else { break };
        let wanted = total * points.len() as f64 / count as f64;
        let piece = a.distance(b);
        if wanted <= before + piece {
            points.push(a + (b - a) * ((wanted - before) / piece.max(f64::MIN_POSITIVE)).clamp(0.0, 1.0));
        } else {
            before += piece;
            pieces.next();
        }
    }
    Ok(points)
}

impl WallSetup {
    pub(super) fn check(&self, place: &str, setup: &Setup) -> Result<(), SetupError> {
        let checked = Checked { place };
        checked.positive("spacing", self.spacing)?;
        checked.not_negative("rounding", self.rounding)?;
        let remedy = format!("use a number from 1, for equal distances, to {MOST_GRADING}");
        checked.refuse_if(!(1.0..=MOST_GRADING).contains(&self.grading), "grading", self.grading, remedy)?;
        let region = match setup.region {
            Region::Channel { .. } | Region::SlipChannel { .. } => return self.outline.check(&checked, &setup.region),
            Region::Box { .. } => "a box",
            Region::Plane => "the plane",
            _ => "axisymmetric",
        };
        let remedy = "Use region.channel, with a width above that of the walls";
        let what = format!("rigid walls need region.channel; this region is {region}");
        Err(SetupError::refused(what, "", remedy).of(place))
    }
}

impl Setup {
    /// Returns the rigid walls of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Returns an error for outlines that cannot be, more than 3000 nodes of a wall.
    pub fn rigid_walls(&self) -> Result<Vec<RigidWall>, SetupError> {
        let [period, _] = self.region.lengths();
        let built = self.even_walls()?;
        if self.walls.iter().all(|wall| wall.grading == 1.0) {
            return Ok(built);
        }
        // Distances of the points of each wall from the others.
        let others = |k: usize| {
            let mut others = Boundary::default();
            built.iter().enumerate().filter(|(j, _)| *j != k).for_each(|(_, wall)| wall.add_to(&mut others));
            others.sort();
            others
        };
        let others: Vec<Boundary> = (0..built.len()).map(others).collect();
        let distance = |k: usize, point: Vec2| others[k].distance(point, [Some(period), None]).abs();
        let nearest = others.iter().zip(&built).filter_map(|(others, wall)| {
            others.smallest(wall.points(), [Some(period), None]).map(|(distance, _)| distance.abs())
        });
        let nearest = nearest.fold(f64::INFINITY, f64::min);
        let apart = |k: usize, point: Vec2| {
            if nearest > 0.0 && nearest.is_finite() { distance(k, point) / nearest } else { 1.0 }
        };
        let graded = built.iter().zip(&self.walls).enumerate().map(|(k, (wall, setup))| {
            let wanted = |point| setup.spacing * apart(k, point).clamp(1.0, setup.grading);
            if setup.grading == 1.0 { Ok(wall.clone()) } else { wall.clone().graded(wanted) }
                .map_err(|error| SetupError::from(error).of(&wall_key(k)))
        });
        graded.collect()
    }

    /// Returns the rigid walls with nodes at equal distances.
    pub(super) fn even_walls(&self) -> Result<Vec<RigidWall>, SetupError> {
        let [period, _] = self.region.lengths();
        let walls = self.walls.iter().enumerate();
        let built = walls.map(|(k, wall)| {
            let key = wall_key(k);
            let checked = Checked { place: &key };
            let built = wall.build(&checked, period);
            let built = built.and_then(|built| self.check_between_sides(&checked, wall, &built).map(|()| built));
            built.map_err(|error| error.of(&key))
        });
        built.collect()
    }

    /// Refuses a wall that leaves the channel, and an obstacle that touches the channel's own walls, because no flow
    /// passes between them and their images coincide.
    fn check_between_sides(
        &self,
        checked: &Checked<'_>,
        wall: &WallSetup,
        built: &RigidWall,
    ) -> Result<(), SetupError> {
        let [_, width] = self.region.lengths();
        let beyond = |point: &Vec2| point.y.abs() - 0.5 * width;
        let Some(farthest) = built.points().iter().max_by(|a, b| beyond(a).total_cmp(&beyond(b))) else {
            return Ok(());
        };
        let least = if wall.outline.is_wall() { -ROUND_OFF } else { ROUND_OFF };
        let value = format!("a wall through ({:.3e}, {:.3e})", farthest.x, farthest.y);
        let remedy = format!(
            "it touches or crosses the straight walls at y = -{0:.3e} and {0:.3e}. Use a wider channel, or move it",
            0.5 * width
        );
        checked.refuse_if(beyond(farthest) >= -least * width, "outline", value, remedy)
    }

    /// Refuses a body that starts beyond a rigid wall, or around one, by the corners of its boundary.
    pub(super) fn check_walls(&self, key: &str, corners: &[Vec2], walls: &[RigidWall]) -> Result<(), SetupError> {
        let [period, _] = self.region.lengths();
        for (number, wall) in walls.iter().enumerate() {
            let (key, other) = (key.to_owned(), wall_key(number));
            let mut boundary = Boundary::default();
            wall.add_to(&mut boundary);
            boundary.sort();
            let nearest = boundary.smallest(corners, [Some(period), None]);
            if let Some((gap, corner)) = nearest.filter(|(gap, _)| *gap <= 0.0) {
                let [x, y] = corners[corner].into();
                return Err(SetupError::Overlap { key, other, x, y, depth: -gap, allowed: 0.0 });
            }
            let ahead = |x: f64| corners.iter().map(move |corner| (corner.x - x) / period);
            let inside = wall.points().first().is_some_and(|point| {
                let first = ahead(point.x).fold(f64::INFINITY, f64::min).ceil();
                let last = ahead(point.x).fold(f64::NEG_INFINITY, f64::max).floor();
                let images = (0..).map(|image| first + f64::from(image)).take_while(|image| *image <= last);
                images.into_iter().any(|image| polygon::contains(corners, *point + Vec2::new(image * period, 0.0)))
            });
            if inside {
                return Err(SetupError::Contains { key, other });
            }
        }
        Ok(())
    }

    /// Returns the distance of a place from the nearest rigid wall (length).
    pub(super) fn room(&self, place: Vec2) -> Result<Option<f64>, SetupError> {
        let mut boundary = Boundary::default();
        self.even_walls()?.iter().for_each(|wall| wall.add_to(&mut boundary));
        boundary.sort();
        let [length, _] = self.region.lengths();
        Ok((!boundary.is_empty()).then(|| boundary.distance(place, [Some(length), None])))
    }
}

/// Returns the key of a wall, by which errors name it.
fn wall_key(number: usize) -> String {
    format!("walls[{number}]")
}
