//! Distances of smooth curves from the points that they are given by.

use active_interface::line_distance_from_polygon;
use motile_base::Vec2;

use super::{DropletShape, InterfaceShape, Setup, Side};
use crate::SetupError;

impl Setup {
    /// Returns the keys of all shapes that are given by points or outlines, each with the largest distance of its
    /// smooth curve from the polygon through the points (length).
    ///
    /// # Errors
    /// Returns an error for points through which no curve goes.
    pub fn distances_from_points(&self) -> Result<Vec<(String, f64)>, SetupError> {
        let mut distances = Vec::new();
        for (key, shape) in self.shapes() {
            if let DropletShape::Points(_) = shape {
                let (curve, ..) = shape.curve()?;
                distances.extend(curve.distance_from_polygon().map(|distance| (format!("{key}.points"), distance)));
            }
        }
        let [length, _] = self.region.lengths();
        for (k, interface) in self.interfaces.iter().enumerate() {
            if let InterfaceShape::Points(points) = &interface.shape {
                let advance = if interface.inside == Side::Above { length } else { -length };
                let distance = line_distance_from_polygon(&points_along(points, advance), advance)?;
                distances.push((format!("interfaces[{k}].shape.points"), distance));
            }
        }
        distances.extend(self.outlines()?.into_iter().map(|outline| (outline.key, outline.distance)));
        Ok(distances)
    }
}

/// Returns the points in the direction in which an interface advances.
pub(super) fn points_along(points: &[[f64; 2]], advance: f64) -> Vec<Vec2> {
    let mut points: Vec<Vec2> = points.iter().copied().map(Vec2::from).collect();
    let ends = points.first().zip(points.last());
    if ends.is_some_and(|(first, last)| (last.x - first.x) * advance < 0.0) {
        points.reverse();
    }
    points
}
