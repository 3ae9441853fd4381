//! Rigid walls and obstacles at rest, of any shape.

use motile_base::{PeriodicSeries, Vec2, internal::all_points_finite, not_negative, polygon, positive, within};
use motile_scene::{WallOutline, gap::Boundary};
use num_complex::Complex64;
use stokes_boundary_integrals::{LayerCurve, LayerError, Settings};

/// Fewest and most nodes of a wall: sixteen carry waves up to 7, and the matrix of 3000 takes 288 MB.
const NODES: [f64; 2] = [Settings::NODES[0] as f64, 3000.0];
/// Largest number of points that a wall is given by: its transform takes about 50 MB.
const MOST_POINTS: f64 = 1_048_576.0;
/// Corners per node of the boundary that gaps are measured from: as many as the layers have fine nodes.
const CORNERS: usize = 4;
/// Points per node between which polynomials of the fifth degree are exact to round-off.
const FINEST: usize = 16;
/// Angle (radians) by which a wall turns from one node to the next where nodes are spread: a tenth of a right angle.
const GENTLE: f64 = 0.157;
/// Distances of the widest nodes over which the density of nodes follows: four standard deviations of a Gaussian, of
/// which waves that nodes do not resolve are round-off.
const TRANSITION: f64 = 10.0;

/// Precision of the rounding that resolves a corner.
const PRECISE: f64 = 1e-3;

/// Most points of a side that distances are measured between.
const MOST_MEASURED: usize = 1000;

/// Returns the minimum distance of a lower and an upper side of a channel (length); infinite without two sides.
pub(crate) fn narrowest(walls: &[RigidWall]) -> f64 {
    let sides =
        |upper: bool| walls.iter().filter(move |wall| if upper { wall.period.x < 0.0 } else { wall.period.x > 0.0 });
    let pairs = sides(false).flat_map(|lower| sides(true).map(move |upper| (lower, upper)));
    pairs.map(|(lower, upper)| lower.distance(upper)).fold(f64::INFINITY, f64::min)
}

/// A rigid no-slip wall or obstacle at rest in a channel: a smooth curve of any shape through points of equally spaced
/// parameters.
///
/// ```
/// use motile_boundary_integrals::{BoundaryIntegral, RigidWall, Settings};
/// use motile_base::{Drive, FlowSample, Region, Vec2};
/// use motile_scene::{Hydrodynamics, Markers};
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// // A wavy channel of length 12 between y = -1.5 - 0.3 cos(2 pi x/12) and its mirror image, in a straight one of
/// // width 5, with a post in it. A unit pressure gradient drives fluid through.
/// let side = |x: f64| 1.5 + 0.3 * (std::f64::consts::TAU * x / 12.0).cos();
/// let walls = [
///     RigidWall::below(12.0, 96, |x| -side(x))?,
///     RigidWall::above(12.0, 96, side)?,
///     RigidWall::post(Vec2::new(3.0, 0.0), 0.5, 48)?,
/// ];
/// let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::Gradient(-1.0) };
/// let mut flow = BoundaryIntegral::new(region, 1.0, Settings::default())?.with_walls(&walls)?;
/// let mut samples = [FlowSample::default(); 2];
/// flow.sample(&Markers::new(), &[Vec2::new(-3.0, 0.0), Vec2::new(3.5 + 1e-9, 0.0)], &mut samples)?;
/// println!("velocity in the middle {:.4}", samples[0].velocity.x);
/// assert!((samples[0].velocity.x - 0.4223).abs() < 1e-4 && samples[1].velocity.length() < 1e-7);
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
#[doc(alias("no-slip", "obstacle", "post", "constriction"))]
pub struct RigidWall {
    points: Vec<Vec2>,
    /// Advance of the curve in a turn of the parameter (length), with the fluid on its left: to the right for a lower
    /// side, to the left for an upper one, zero for an obstacle.
    period: Vec2,
    nodes: usize,
    /// How its corners have been rounded.
    rounding: Rounding,
    /// The wall before its nodes were spread by [`RigidWall::graded`].
    even: Option<Box<Self>>,
}

/// The roundings of a wall so far.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Rounding {
    /// Perimeter before the first of them (length).
    perimeter: f64,
    /// Sum of the squares of their standard deviations, each over the perimeter before it.
    variance: f64,
}

/// Corners of a wall that its nodes do not resolve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SharpCorner {
    /// Number of the wall.
    pub wall: usize,
    /// Largest angle by which the wall turns within the distance of two nodes (radians).
    pub turn: f64,
    /// Distance of the nodes next to them, or before they were rounded (length).
    pub spacing: f64,
    /// Rounding of the wall, in place of the present one, that its nodes resolve (length), if there is one.
    pub rounding: Option<f64>,
}

impl RigidWall {
    /// Returns a lower side of a channel, `y = height(x)` (length) over one period (length), by nodes equally spaced in
    /// x.
    ///
    /// # Errors
    /// Returns an error for a period that is not positive and finite, heights that are not finite, fewer than 16 or
    /// more than 3000 nodes.
    pub fn below(period: f64, nodes: usize, height: impl Fn(f64) -> f64) -> Result<Self, LayerError> {
        Self::line_below(profile(period, nodes, height)?, period, nodes)
    }

    /// Returns an upper side of a channel, `y = height(x)` (length), as [`RigidWall::below`].
    ///
    /// # Errors
    /// Returns the same errors as for the lower side.
    pub fn above(period: f64, nodes: usize, height: impl Fn(f64) -> f64) -> Result<Self, LayerError> {
        Self::line_above(profile(period, nodes, height)?, period, nodes)
    }

    /// Creates a round post with this centre and radius (length).
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive and finite, a centre that is not finite, too few or too many
    /// nodes.
    pub fn post(centre: Vec2, radius: f64, nodes: usize) -> Result<Self, LayerError> {
        positive("the radius of a post", radius)?;
        within("the number of nodes of a wall", nodes as f64, NODES[0], NODES[1])?;
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / nodes as f64;
        Self::obstacle((0..nodes).map(|k| centre + radius * Vec2::from_angle(angle(k))).collect(), nodes)
    }

    /// Creates a lower side of a channel through points of one period (length), to the right, at equally spaced values
    /// of some parameter; the line may overhang.
    ///
    /// # Errors
    /// Returns the errors of [`RigidWall::below`], and an error for fewer points than nodes, or more than a million.
    pub fn line_below(points: Vec<Vec2>, period: f64, nodes: usize) -> Result<Self, LayerError> {
        positive("the period of a wall", period)?;
        Self::checked(points, Vec2::new(period, 0.0), nodes)
    }

    /// Creates an upper side of a channel through points, to the right, as [`RigidWall::line_below`].
    ///
    /// # Errors
    /// Returns the same errors as for the lower side.
    pub fn line_above(mut points: Vec<Vec2>, period: f64, nodes: usize) -> Result<Self, LayerError> {
        positive("the period of a wall", period)?;
        reverse(&mut points);
        if let Some(first) = points.first_mut() {
            first.x += period;
        }
        Self::checked(points, Vec2::new(-period, 0.0), nodes)
    }

    /// Creates an obstacle with the fluid around it, through points (length), in either direction, at equally spaced
    /// values of some parameter.
    ///
    /// # Errors
    /// Returns the errors of [`RigidWall::line_below`].
    pub fn obstacle(mut points: Vec<Vec2>, nodes: usize) -> Result<Self, LayerError> {
        if polygon::area(&points) < 0.0 {
            reverse(&mut points);
        }
        Self::checked(points, Vec2::ZERO, nodes)
    }

    /// Returns some of its points (length).
    fn measured(&self) -> impl Iterator<Item = Vec2> {
        self.points.iter().copied().step_by(self.points.len().div_ceil(MOST_MEASURED))
    }

    /// Returns the minimum distance of the points of two sides of a channel (length).
    fn distance(&self, other: &Self) -> f64 {
        let period = self.period.x;
        let apart = |a: Vec2, b: Vec2| {
            let way = b - a;
            Vec2::new(way.x - period * (way.x / period).round(), way.y).length()
        };
        self.measured().flat_map(|a| other.measured().map(move |b| apart(a, b))).fold(f64::INFINITY, f64::min)
    }

    fn checked(points: Vec<Vec2>, period: Vec2, nodes: usize) -> Result<Self, LayerError> {
        within("the number of nodes of a wall", nodes as f64, NODES[0], NODES[1])?;
        within("the number of points of a wall", points.len() as f64, nodes as f64, MOST_POINTS)?;
        all_points_finite("the points of a wall", &points)?;
        Ok(Self { points, period, nodes, rounding: Rounding::default(), even: None })
    }

    /// Rounds the corners of a wall through points of equal distance, by a Gaussian along the line with the standard
    /// deviation `length` (length). Straight stretches stay, and a bend of radius R moves inwards by `length^2/(2 R)`.
    /// Nodes resolve right angles if their distance is at most 0.8 times the length. Sharper corners need more,
    /// because a Gaussian leaves them narrower: [`Hydrodynamics::warnings`](motile_scene::Hydrodynamics::warnings)
    /// names the length.
    ///
    /// # Errors
    /// Returns an error for a length that is negative or not finite.
    pub fn rounded(mut self, length: f64) -> Result<Self, LayerError> {
        not_negative("the length over which corners are rounded", length)?;
        if length == 0.0 {
            return Ok(self);
        }
        let count = self.points.len();
        let step = self.period / count as f64;
        let perimeter = self.perimeter();
        if self.rounding.variance == 0.0 {
            self.rounding.perimeter = perimeter;
        }
        self.rounding.variance += (length / perimeter).powi(2);
        let mut series = PeriodicSeries::new(count)?;
        series.analyse(self.periodic_part())?;
        let decay = std::f64::consts::TAU * length / perimeter;
        series.scale(|index| (-0.5 * (decay * index as f64).powi(2)).exp());
        for (k, (point, value)) in self.points.iter_mut().zip(series.values()).enumerate() {
            *point = Vec2::new(value.re, value.im) + step * k as f64;
        }
        Ok(self)
    }

    /// Spreads the nodes so that their distance (length) is nowhere more than `wanted(place)`, or than the distance
    /// over which the wall turns by a tenth of a right angle unless they are closer already. The number of nodes
    /// follows from that. The density of nodes follows smoothly, within some nodes, so that quadrature stays spectral.
    ///
    /// # Errors
    /// Returns an error for distances that are not positive and finite, or that need more than 3000 nodes.
    pub fn graded(mut self, wanted: impl Fn(Vec2) -> f64) -> Result<Self, LayerError> {
        let even = self.even.take().unwrap_or_else(|| Box::new(self.clone()));
        self.refine()?;
        let count = self.points.len();
        let at = |k: usize| self.points[k % count] + self.period * (k / count) as f64;
        let steps: Vec<f64> = (0..count).map(|k| at(k).distance(at(k + 1))).collect();
        let uniform = steps.iter().sum::<f64>() / self.nodes as f64;
        let mut spacings = Vec::with_capacity(count);
        // Alike from both ends, so that walls that mirror each other are.
        for k in 0..count {
            let wish = positive("the wanted distance of nodes", wanted(self.points[k]))?;
            let [before, after] = [count - 1, 0].map(|shift| at(k + shift + 1) - at(k + shift));
            let (turn, step) = (before.angle_to(after).abs(), 0.5 * (before.length() + after.length()));
            spacings.push(wish.min(uniform.max(GENTLE * step / turn.max(f64::MIN_POSITIVE))));
        }
        let coarsest = spacings.iter().copied().fold(0.0, f64::max);
        let reach = ((TRANSITION * coarsest / uniform * (count / self.nodes) as f64).ceil() as usize).min(count / 2);
        let spacings = smoothed_below(&spacings, reach)?;
        // The parameter in which nodes are equally spaced, at each point.
        let mut parameter = vec![0.0];
        for k in 0..count {
            let next = 0.5 * (1.0 / spacings[k] + 1.0 / spacings[(k + 1) % count]);
            parameter.push(parameter[k] + steps[k] * next);
        }
        let total = parameter[count];
        let nodes = 2.0 * (0.5 * total).ceil().max(0.5 * NODES[0]);
        within("the number of nodes of a wall", nodes, NODES[0], NODES[1])?;
        let finer = (count / self.nodes).max(1);
        self.nodes = nodes as usize;
        let many = finer * self.nodes;
        let value = |k: isize| {
            let turns = k.div_euclid(count as isize);
            let index = k.rem_euclid(count as isize) as usize;
            (parameter[index] + total * turns as f64, self.points[index] + self.period * turns as f64)
        };
        let mut from = 0;
        let mut points = Vec::with_capacity(many);
        for k in 0..many {
            let sought = total * k as f64 / many as f64;
            while parameter[from + 1] <= sought {
                from += 1;
            }
            points.push(interpolated(std::array::from_fn(|j| value(from as isize + j as isize - 2)), sought));
        }
        self.points = points;
        self.even = Some(even);
        Ok(self)
    }

    /// Returns the length of one period, or of an obstacle (length).
    fn perimeter(&self) -> f64 {
        let ends = self.points.iter().skip(1).copied().chain([self.points[0] + self.period]);
        self.points.iter().zip(ends).map(|(a, b)| a.distance(b)).sum()
    }

    /// Interpolates to so many points for each node that polynomials through neighbours are exact to round-off.
    fn refine(&mut self) -> Result<(), LayerError> {
        let (few, many) = (self.points.len(), FINEST * self.nodes);
        if few >= many {
            return Ok(());
        }
        let [mut given, mut finer] = [PeriodicSeries::new(few)?, PeriodicSeries::new(many)?];
        given.analyse(self.periodic_part())?;
        finer.resample(&given);
        let step = self.period / many as f64;
        let values = finer.values().iter().enumerate();
        self.points = values.map(|(k, value)| Vec2::new(value.re, value.im) + step * k as f64).collect();
        Ok(())
    }

    /// Returns the points less the advance of the curve, as complex numbers.
    fn periodic_part(&self) -> impl ExactSizeIterator<Item = Complex64> {
        let step = self.period / self.points.len() as f64;
        self.points.iter().enumerate().map(move |(k, x)| {
            let x = *x - step * k as f64;
            Complex64::new(x.x, x.y)
        })
    }

    /// Returns the largest angle by which the wall turns within the distance of its nodes (radians), and this distance
    /// (length): what nodes do not resolve is as sharp as a corner.
    pub(crate) fn sharpest_turn(&self) -> (f64, f64) {
        let count = self.points.len();
        let at = |k: usize| self.points[k % count] + self.period * (k / count) as f64;
        let turn = |k: usize| (at(k + 1) - at(k)).angle_to(at(k + 2) - at(k + 1));
        // Within one node's distance, and no less than one turn.
        let within = (count / self.nodes).max(1);
        let mut sum: f64 = (0..within).map(turn).sum();
        let (mut largest, mut place) = (sum.abs(), 0);
        for k in 0..count {
            sum += turn(k + within) - turn(k);
            if sum.abs() > largest {
                (largest, place) = (sum.abs(), k + 1);
            }
        }
        let steps = (place..place + within).map(|k| at(k).distance(at(k + 1)));
        (largest, steps.sum::<f64>() * count as f64 / (within * self.nodes) as f64)
    }

    /// Returns the corners that turn by more than `limit` (radians) within the distance of the nodes of this wall,
    /// which has that number.
    pub(crate) fn sharp_corner(&self, wall: usize, limit: f64) -> Result<Option<SharpCorner>, LayerError> {
        let (turn, spacing) = self.sharpest_turn();
        if turn <= limit {
            return Ok(None);
        }
        let is_rounded = self.even.is_none() && self.rounding.variance > 0.0;
        let spacing = if is_rounded { self.rounding.perimeter / self.nodes as f64 } else { spacing };
        let sharp = self.even.as_deref().unwrap_or(self);
        let resolved = |length: f64| {
            let rounded = sharp.clone().rounded(length)?;
            // Nodes that are spread keep their distance, others come closer where a corner is cut.
            let measured = if self.even.is_some() { rounded.evened(spacing) } else { rounded };
            Ok::<_, LayerError>(measured.sharpest_turn().0 <= limit)
        };
        // A rounding that suffices, and one that does not. A Gaussian as wide as a quarter of the wall leaves no shape.
        let (most, mut enough, mut few) = (0.25 * sharp.perimeter(), spacing, 0.0);
        while enough < most && !resolved(enough)? {
            (few, enough) = (enough, 2.0 * enough);
        }
        if enough >= most {
            return Ok(Some(SharpCorner { wall, turn, spacing, rounding: None }));
        }
        while enough - few > PRECISE * enough {
            let middle = 0.5 * (few + enough);
            if resolved(middle)? { enough = middle } else { few = middle }
        }
        let Rounding { perimeter, variance } = sharp.clone().rounded(enough)?.rounding;
        Ok(Some(SharpCorner { wall, turn, spacing, rounding: Some(perimeter * variance.sqrt()) }))
    }

    /// Returns the wall with nodes at equal distances of about `spacing` (length).
    fn evened(&self, spacing: f64) -> Self {
        let perimeter = self.perimeter();
        let nodes = (perimeter / spacing).ceil().clamp(NODES[0], MOST_POINTS / FINEST as f64);
        let many = FINEST * nodes as usize;
        let (mut points, mut before, mut k) = (Vec::with_capacity(many), 0.0, 0);
        let count = self.points.len();
        let at = |k: usize| self.points[k % count] + self.period * (k / count) as f64;
        while points.len() < many && k < count {
            let wanted = perimeter * points.len() as f64 / many as f64;
            let piece = at(k).distance(at(k + 1));
            if wanted <= before + piece {
                points.push(at(k) + (at(k + 1) - at(k)) * ((wanted - before) / piece.max(f64::MIN_POSITIVE)));
            } else {
                before += piece;
                k += 1;
            }
        }
        let nodes = (points.len() / FINEST).max(1);
        Self { points, period: self.period, nodes, rounding: self.rounding, even: None }
    }

    /// Returns the points of one period, or of an obstacle (length).
    #[must_use]
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Returns the corners that the boundary has, a few per node, at equal steps of the parameter.
    pub(crate) fn outline(&self) -> WallOutline {
        let most = (self.points.len() / (CORNERS * self.nodes)).max(1);
        let stride = if self.points.len().is_multiple_of(most) { most } else { 1 };
        let points: Vec<Vec2> = self.points.iter().copied().step_by(stride).collect();
        WallOutline { points, period: self.period }
    }

    /// Returns the wall as a curve of layers.
    pub(crate) fn curve(&self) -> LayerCurve<'_> {
        LayerCurve { positions: &self.points, period: self.period, nodes: self.nodes }
    }

    /// Returns the distances of the nodes at the sides that [`RigidWall::add_to`] adds (length): nodes and corners are
    /// equally spaced in the same parameter.
    pub(crate) fn spacings(&self, sides: &[[Vec2; 2]]) -> impl Iterator<Item = f64> {
        let per_node = sides.len() as f64 / self.nodes as f64;
        sides.iter().map(move |[start, end]| start.distance(*end) * per_node)
    }

    /// Adds the sides of the wall to a boundary, whose inside on their left is the rigid part.
    pub fn add_to(&self, boundary: &mut Boundary) {
        let corners = self.outline().points;
        if self.period == Vec2::ZERO {
            boundary.push_loop(&corners);
            return;
        }
        let ends = corners.iter().skip(1).copied().chain([corners[0] + self.period]);
        corners.iter().zip(ends).for_each(|(&start, end)| boundary.push(end, start));
    }
}

/// Reverses the direction of a curve, whose first point stays: nodes stay where they are, so that the walls of a
/// channel that is its own mirror image are resolved alike.
fn reverse(points: &mut [Vec2]) {
    if let Some(rest) = points.get_mut(1..) {
        rest.reverse();
    }
}

/// Returns the minimum values within some places of each of a periodic list, smoothed over as many: nowhere above the
/// list.
fn smoothed_below(values: &[f64], reach: usize) -> Result<Vec<f64>, LayerError> {
    let count = values.len();
    let around = |k: usize| values[(k + count - reach) % count];
    let repeated: Vec<f64> = (0..count + 2 * reach).map(around).collect();
    let least = repeated.windows(2 * reach + 1).map(|near| near.iter().copied().fold(f64::INFINITY, f64::min));
    let mut series = PeriodicSeries::new(count)?;
    series.analyse(least.map(Complex64::from))?;
    // A Gaussian whose tail beyond the reach is below 1e-4.
    let decay = std::f64::consts::TAU * reach as f64 / (4.0 * count as f64);
    series.scale(|index| (-0.5 * (decay * index as f64).powi(2)).exp());
    Ok(series.values().iter().map(|value| value.re).collect())
}

/// Returns the value at `sought` of the polynomial through points at given parameters.
fn interpolated(points: [(f64, Vec2); 6], sought: f64) -> Vec2 {
    let weight = |i: usize| -> f64 {
        let others = points.iter().enumerate().filter(|(j, _)| *j != i);
        others.map(|(_, (parameter, _))| (sought - parameter) / (points[i].0 - parameter)).product()
    };
    points.iter().enumerate().map(|(i, (_, point))| weight(i) * *point).sum()
}

/// Returns the points `(x, height(x))` over a period, several per node.
fn profile(period: f64, nodes: usize, height: impl Fn(f64) -> f64) -> Result<Vec<Vec2>, LayerError> {
    positive("the period of a wall", period)?;
    within("the number of nodes of a wall", nodes as f64, NODES[0], NODES[1])?;
    let count = CORNERS * nodes;
    let x = |k: usize| period * (k as f64 / count as f64 - 0.5);
    Ok((0..count).map(x).map(|x| Vec2::new(x, height(x))).collect())
}

#[cfg(test)]
mod tests;
