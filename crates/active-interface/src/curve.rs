//! Closed curves from which the markers of an interface are made, and the polygon through the markers.

mod equidistant;
mod near_polygon;
pub(crate) mod periodic;
pub(crate) mod polygon;
mod rounded;
mod spline;

use std::f64::consts::{PI, TAU};
use std::fmt;
use std::ops::Deref;
use std::sync::Arc;

use motile_base::{
    Vec2, finite,
    internal::{all_finite, all_points_finite, at_least},
    not_negative, positive, within,
};

use crate::InterfaceError;
use equidistant::equidistant;
pub(crate) use motile_base::polygon::first_crossing;
use near_polygon::NearPolygon;
pub(crate) use periodic::check_period;
pub use periodic::{line_distance_from_polygon, line_through, wave};
pub use polygon::{AreaMoments, polygon_area, polygon_moments, polygon_perimeter};
use polygon::{edges, raw_area, raw_perimeter};
use rounded::Rounded;
use spline::PeriodicSpline;

/// Fewest markers of an interface: the reconstruction of the concentration at a marker spans six segments, which must
/// be different ones.
pub(crate) const MINIMUM_MARKERS: usize = 8;

/// Most markers of an interface: a bound on the memory that a wrong spacing takes.
const MAXIMUM_MARKERS: usize = 1_000_000;

/// Largest ratio of the distances between neighbouring markers. Transport and forces are of second order in slowly
/// varying spacing; neighbours that differ by more than this are a mistake in a list of points.
const MAXIMUM_UNEVENNESS: f64 = 4.0;

/// Samples on which a smooth curve is checked and measured; with the extrapolation over four strides, round-off.
const SAMPLES: usize = 8192;

/// A closed curve without self-crossings, from which the markers of an interface are made.
///
/// Curves run counter-clockwise: one that is given clockwise is turned around. Every curve is checked where it is made:
/// it is finite, closed, simple and encloses an area.
///
/// ```
/// use active_interface::Curve;
/// let curve = Curve::ellipse(1.3, 1.0 / 1.3)?.rotated(0.5);
/// let markers = curve.markers(200)?;
/// // equal spacing, and the polygon has exactly the ellipse's area
/// let first = (markers[1] - markers[0]).length();
/// let other = (markers[101] - markers[100]).length();
/// assert!((first - other).abs() < 1e-12 * first);
/// assert!((active_interface::polygon_area(&markers)? - std::f64::consts::PI).abs() < 1e-13);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Curve {
    shape: Shape,
    reversed: bool,
    rotation: f64,
    translation: Vec2,
    area: f64,
    perimeter: f64,
}

#[derive(Debug, Clone)]
enum Shape {
    /// Half axes along x and y (length); equal for a circle.
    Ellipse(f64, f64),
    Fourier {
        radius: f64,
        cosines: Vec<f64>,
        sines: Vec<f64>,
    },
    Parametric(Function<Vec2>),
    Spline(NearPolygon),
    Polygon {
        points: Vec<Vec2>,
        ends: Vec<f64>,
    },
    Rounded(Rounded),
}

/// Returns the radius over its mean at the polar angle `angle`.
fn fourier_factor(cosines: &[f64], sines: &[f64], angle: f64) -> f64 {
    let wave = |amplitudes: &[f64], f: fn(f64) -> f64| -> f64 {
        amplitudes.iter().zip(1u32..).map(|(amplitude, k)| amplitude * f(f64::from(k) * angle)).sum()
    };
    1.0 + wave(cosines, f64::cos) + wave(sines, f64::sin)
}

impl Shape {
    /// Returns the point at the fraction `t` of the parameter, t in [0, 1].
    fn point(&self, t: f64) -> Vec2 {
        match self {
            Self::Ellipse(a, b) => {
                let (s, c) = (TAU * t).sin_cos();
                Vec2::new(a * c, b * s)
            }
            Self::Fourier { radius, cosines, sines } => {
                let (s, c) = (TAU * t).sin_cos();
                Vec2::new(c, s) * (radius * fourier_factor(cosines, sines, TAU * t))
            }
            Self::Parametric(f) => f(TAU * t),
            Self::Spline(curve) => curve.spline.point(t),
            Self::Rounded(curve) => curve.point(t),
            Self::Polygon { points, ends } => {
                let u = t * ends[ends.len() - 1];
                let k = ends[..ends.len() - 1].partition_point(|&end| end <= u);
                let start = if k == 0 { 0.0 } else { ends[k - 1] };
                points[k].lerp(points[(k + 1) % points.len()], (u - start) / (ends[k] - start))
            }
        }
    }

    /// Returns the signed area (length squared) if there is a formula.
    fn area(&self) -> Option<f64> {
        match self {
            Self::Ellipse(a, b) => Some(PI * a * b),
            Self::Fourier { radius, cosines, sines } => {
                let squares: f64 = cosines.iter().chain(sines).map(|amplitude| amplitude * amplitude).sum();
                Some(PI * radius * radius * (1.0 + 0.5 * squares))
            }
            Self::Parametric(_) => None,
            Self::Spline(curve) => Some(curve.spline.area()),
            Self::Polygon { points, .. } => Some(raw_area(points)),
            Self::Rounded(curve) => Some(curve.area),
        }
    }
}

impl Curve {
    /// Creates a circle about the origin with this radius (length).
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive.
    pub fn circle(radius: f64) -> Result<Self, InterfaceError> {
        positive("the radius", radius)?;
        Self::build(Shape::Ellipse(radius, radius))
    }

    /// Creates the ellipse (a cos t, b sin t) with the half axes a along x and b along y (length).
    ///
    /// # Errors
    /// Returns an error for half axes that are not positive.
    pub fn ellipse(a: f64, b: f64) -> Result<Self, InterfaceError> {
        Self::build(Shape::Ellipse(positive("the half axis along x", a)?, positive("the half axis along y", b)?))
    }

    /// Creates the curve r(theta) = R (1 + sum over k >= 1 of a_k cos k theta + b_k sin k theta) about the origin, with
    /// `cosines` = a_1, a_2, ... and `sines` = b_1, b_2, ... (no dimension) and the radius R (length).
    ///
    /// The area inside is pi R^2 (1 + sum (a_k^2 + b_k^2) / 2).
    ///
    /// # Errors
    /// Returns an error for a radius R that is not positive, amplitudes that are not finite or so large that r is not
    /// positive everywhere.
    pub fn fourier(radius: f64, cosines: &[f64], sines: &[f64]) -> Result<Self, InterfaceError> {
        positive("the radius", radius)?;
        all_finite("the cosine amplitudes", cosines)?;
        all_finite("the sine amplitudes", sines)?;
        for i in 0..SAMPLES {
            let angle = TAU * i as f64 / SAMPLES as f64;
            let factor = fourier_factor(cosines, sines, angle);
            if factor <= 0.0 {
                return Err(InterfaceError::radius_not_positive(radius * factor, angle));
            }
        }
        Self::build(Shape::Fourier { radius, cosines: cosines.to_vec(), sines: sines.to_vec() })
    }

    /// Returns the curve of a function of a parameter that runs from 0 to 2 pi and need not be the polar angle nor the
    /// arc length. Area and length are right to round-off for smooth curves, to 1e-7 for curves with corners.
    ///
    /// # Errors
    /// Returns an error for points that are not finite, an end that is not the start, a crossing, no area.
    pub fn parametric(point: impl Fn(f64) -> Vec2 + Send + Sync + 'static) -> Result<Self, InterfaceError> {
        let (start, end) = (point(0.0), point(TAU));
        all_points_finite("the ends of the curve", &[start, end])?;
        let gap = (end - start).length();
        let extent = (0..64).map(|i| (point(TAU * f64::from(i) / 64.0) - start).length()).fold(0.0, f64::max);
        if gap > 1e-9 * extent {
            return Err(InterfaceError::not_closed(gap));
        }
        Self::build(Shape::Parametric(Function::new(point)))
    }

    /// Creates the smooth closed curve through these points; the last is joined to the first and must not repeat it.
    ///
    /// It is a cubic spline that stays near the polygon through the points ([`Curve::distance_from_polygon`]): its
    /// distance from a side is at most 0.15 of the shortest of the side and its two neighbours. If the points are
    /// uneven or have sharp corners, the curve follows the sides there.
    ///
    /// # Errors
    /// Returns an error for fewer than three points, points that are not finite or coincide, a crossing (by the numbers
    /// of the points), no area.
    pub fn through_points(points: &[Vec2]) -> Result<Self, InterfaceError> {
        check_list(points, 3)?;
        let crossing = |spline: &PeriodicSpline| {
            let samples: Vec<Vec2> = parameters().step_by(4).map(|t| spline.point(t)).collect();
            let found = first_crossing(&samples)?;
            Ok(found.map(|(first, second)| [first, second].map(|k| k as f64 / samples.len() as f64)))
        };
        Self::build(Shape::Spline(NearPolygon::new(points, Vec2::ZERO, crossing)?))
    }

    /// Returns the largest distance of the curve from the polygon through the points that it was made from (length);
    /// `None` for curves that were not made with [`Curve::through_points`].
    #[must_use]
    pub fn distance_from_polygon(&self) -> Option<f64> {
        if let Shape::Spline(curve) = &self.shape { Some(curve.distance) } else { None }
    }

    /// Creates the polygon with these corners; the last is joined to the first and must not repeat it.
    ///
    /// # Errors
    /// Returns an error for fewer than three points, points that are not finite or coincide, a crossing, no area.
    pub fn polygon(points: &[Vec2]) -> Result<Self, InterfaceError> {
        check_list(points, 3)?;
        let mut length = 0.0;
        let ends = edges(points)
            .map(|(a, b)| {
                length += (b - a).length();
                length
            })
            .collect();
        Self::build(Shape::Polygon { points: points.to_vec(), ends })
    }

    /// Creates the polygon with these corners, each of them replaced by an arc of that radius (length) that its two
    /// sides touch. Area and perimeter are exact: a square loses `(4 - pi) r^2` of its area.
    ///
    /// # Errors
    /// Returns the errors of [`Curve::polygon`], and an error for a radius that is not positive or too large for a
    /// side.
    pub fn rounded_polygon(points: &[Vec2], radius: f64) -> Result<Self, InterfaceError> {
        check_list(points, 3)?;
        positive("the radius of the corners", radius)?;
        Self::build(Shape::Rounded(Rounded::new(points, radius)?))
    }

    /// Creates two half circles about (-`straight`, 0) and (`straight`, 0) with this radius (length), joined by
    /// straight sides of the length 2 `straight`. They form a polygon of 720 corners that starts on the x axis: an even
    /// number of markers is its own mirror image there.
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive, a negative length.
    pub fn stadium(straight: f64, radius: f64) -> Result<Self, InterfaceError> {
        const CORNERS: u32 = 720;
        positive("the radius", radius)?;
        not_negative("half the length of the straight sides", straight)?;
        let half_step = 0.5 * TAU / f64::from(CORNERS);
        let corners = (0..CORNERS)
            .map(|k| half_step * f64::from(2 * k + 1))
            .map(|angle| Vec2::new(radius * angle.cos() + straight * angle.cos().signum(), radius * angle.sin()));
        // The middle of the side that crosses the axis.
        let start = Vec2::new(straight + radius * half_step.cos(), 0.0);
        Self::polygon(&std::iter::once(start).chain(corners).collect::<Vec<_>>())
    }

    fn build(shape: Shape) -> Result<Self, InterfaceError> {
        let samples: Vec<Vec2> = parameters().map(|t| shape.point(t)).collect();
        all_points_finite("the points of the curve", &samples)?;
        let perimeter = match &shape {
            Shape::Polygon { ends, .. } => ends[ends.len() - 1],
            Shape::Rounded(curve) => curve.perimeter,
            _ => extrapolate(|stride| raw_perimeter(&every(&samples, stride))),
        };
        let area = shape.area().unwrap_or_else(|| extrapolate(|stride| raw_area(&every(&samples, stride))));
        if area.abs() < 1e-6 * perimeter * perimeter {
            return Err(InterfaceError::no_area(area, perimeter));
        }
        // Ellipses and modes are simple by their form; points have been checked, and their curve as well.
        if let Shape::Parametric(_) | Shape::Rounded(_) = shape
            && let Some((first, second)) = first_crossing(&every(&samples, 4))?
        {
            let of = |sample: usize| TAU * (4 * sample) as f64 / SAMPLES as f64;
            return Err(InterfaceError::crossing_parameters(of(first), of(second)));
        }
        Ok(Self { shape, reversed: area < 0.0, rotation: 0.0, translation: Vec2::ZERO, area: area.abs(), perimeter })
    }

    /// Turns the curve, as it lies, about the origin by `angle` (radians, counter-clockwise).
    #[must_use]
    pub fn rotated(mut self, angle: f64) -> Self {
        self.rotation += angle;
        self.translation = Vec2::from_angle(angle).rotate(self.translation);
        self
    }

    /// Moves the curve by `displacement` (length).
    #[must_use]
    pub fn translated(mut self, displacement: Vec2) -> Self {
        self.translation += displacement;
        self
    }

    /// Returns the area inside (length squared).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.area
    }

    /// Returns the length of the curve (length).
    #[must_use]
    pub fn perimeter(&self) -> f64 {
        self.perimeter
    }

    /// Returns the point (length) at the fraction `t` of the curve's own parameter, t in [0, 1], counter-clockwise.
    #[must_use]
    pub fn point(&self, t: f64) -> Vec2 {
        let t = t.clamp(0.0, 1.0);
        let point = self.shape.point(if self.reversed { 1.0 - t } else { t });
        Vec2::from_angle(self.rotation).rotate(point) + self.translation
    }

    /// Returns `count` markers in counter-clockwise order, the first at the start of the curve's parameter.
    ///
    /// Chords between neighbours are equal, to 1e-12 of their length; around corners that are sharper than their
    /// distance, where there need be no equal chords, arc lengths are. The polygon through the markers is scaled about
    /// its centroid so that it has the area of the curve; the markers then lie outside the curve by about (spacing)^2
    /// times its curvature / 12.
    ///
    /// # Errors
    /// Returns an error for:
    /// * fewer than eight or more than a million markers,
    /// * so few that the polygon crosses itself,
    /// * a curve whose chords could not be made equal,
    /// * rotations or translations that are not finite.
    pub fn markers(&self, count: usize) -> Result<Vec<Vec2>, InterfaceError> {
        at_least("markers", count, MINIMUM_MARKERS)?;
        within("the number of markers", count as f64, MINIMUM_MARKERS as f64, MAXIMUM_MARKERS as f64)?;
        finite("the rotation", self.rotation)?;
        all_points_finite("the translation", &[self.translation])?;
        let mut markers = if matches!(self.shape, Shape::Ellipse(a, b) if a == b) {
            (0..count).map(|k| self.point(k as f64 / count as f64)).collect()
        } else {
            equidistant(
                |t| self.point(t),
                Vec2::ZERO,
                count,
                matches!(self.shape, Shape::Spline(_) | Shape::Rounded(_)),
            )?
        };
        let moments = polygon_moments(&markers)?;
        if moments.area <= 0.0 {
            return Err(InterfaceError::no_area(moments.area, raw_perimeter(&markers)));
        }
        let factor = (self.area / moments.area).sqrt();
        for marker in &mut markers {
            *marker = moments.centroid + (*marker - moments.centroid) * factor;
        }
        match first_crossing(&markers)? {
            Some((first, _)) => Err(InterfaceError::crossing_markers(markers[first], count)),
            None => Ok(markers),
        }
    }

    /// Returns the markers about `spacing` apart (length): as [`Curve::markers`], with the perimeter divided by the
    /// spacing, rounded, as their number.
    ///
    /// # Errors
    /// Returns an error for a spacing that is not positive or gives fewer than eight markers, and the errors of
    /// [`Curve::markers`].
    pub fn markers_with_spacing(&self, spacing: f64) -> Result<Vec<Vec2>, InterfaceError> {
        positive("the marker spacing", spacing)?;
        self.markers((self.perimeter / spacing).round() as usize)
    }
}

/// Returns the markers of an interface from points (length): checked, and turned around where they run clockwise (the
/// first stays the first).
///
/// # Errors
/// Returns an error for fewer than eight points, points that are not finite or coincide, distances between neighbours
/// that differ by more than a factor of four, a crossing, no area.
pub(crate) fn markers_from_points(points: &[Vec2]) -> Result<Vec<Vec2>, InterfaceError> {
    check_list(points, MINIMUM_MARKERS)?;
    let (area, length) = (raw_area(points), raw_perimeter(points));
    if area.abs() < 1e-9 * length * length {
        return Err(InterfaceError::no_area(area, length));
    }
    let range = [f64::INFINITY, 0.0];
    let [shortest, longest] =
        edges(points).map(|(a, b)| (b - a).length()).fold(range, |[min, max], chord| [chord.min(min), chord.max(max)]);
    if longest > MAXIMUM_UNEVENNESS * shortest {
        return Err(InterfaceError::uneven_spacing(longest / shortest, MAXIMUM_UNEVENNESS));
    }
    let mut markers = points.to_vec();
    if area < 0.0 {
        markers[1..].reverse();
    }
    Ok(markers)
}

fn check_list(points: &[Vec2], minimum: usize) -> Result<(), InterfaceError> {
    at_least("points of the curve", points.len(), minimum)?;
    all_points_finite("the points of the curve", points)?;
    if let Some(index) = edges(points).position(|(a, b)| a == b) {
        return Err(InterfaceError::coincident_points(index));
    }
    match first_crossing(points)? {
        Some((first, second)) => Err(InterfaceError::crossing_points(first, second)),
        None => Ok(()),
    }
}

/// Fractions of the parameter at which curves are sampled.
fn parameters() -> impl Iterator<Item = f64> {
    (0..SAMPLES).map(|i| i as f64 / SAMPLES as f64)
}

fn every(points: &[Vec2], stride: usize) -> Vec<Vec2> {
    points.iter().step_by(stride).copied().collect()
}

/// Returns the Richardson extrapolation of a quantity of the inscribed polygon with every stride-th sample, whose error
/// is a series in the square of the spacing.
fn extrapolate(quantity: impl Fn(usize) -> f64) -> f64 {
    let mut column: Vec<f64> = [8, 4, 2, 1].into_iter().map(quantity).collect();
    let mut factor = 4.0;
    while column.len() > 1 {
        column = column.windows(2).map(|pair| pair[1] + (pair[1] - pair[0]) / (factor - 1.0)).collect();
        factor *= 4.0;
    }
    column[0]
}

/// Function of one number that a user gives, shared between clones.
#[derive(Clone)]
pub(crate) struct Function<T>(Arc<dyn Fn(f64) -> T + Send + Sync>);

impl<T> Function<T> {
    pub(crate) fn new(function: impl Fn(f64) -> T + Send + Sync + 'static) -> Self {
        Self(Arc::new(function))
    }
}

impl<T> Deref for Function<T> {
    type Target = dyn Fn(f64) -> T + Send + Sync;

    fn deref(&self) -> &Self::Target {
        self.0.as_ref()
    }
}

impl<T> fmt::Debug for Function<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Function")
    }
}

#[cfg(test)]
mod tests;
