//! Alignment of directions.

use motile_base::Vec2;

/// Returns the polar order of directions, `|mean of n|` (no dimension): 1 if all are alike, of order `N^(-1/2)` where N
/// are random, 0 without any. Directions of no length do not count.
///
/// ```
/// use motile_analysis::suspension::polar_order;
/// use motile_base::Vec2;
///
/// assert_eq!(polar_order(&[Vec2::X, 3.0 * Vec2::X]), 1.0);
/// assert_eq!(polar_order(&[Vec2::X, -Vec2::X]), 0.0);
/// ```
#[must_use]
pub fn polar_order(directions: &[Vec2]) -> f64 {
    mean_length(directions, |n| n)
}

/// Returns the nematic order of directions at the angles a, `|mean of (cos 2a, sin 2a)|` (no dimension): 1 if all are
/// along one axis, either way. Directions of no length do not count.
///
/// ```
/// use motile_analysis::suspension::nematic_order;
/// use motile_base::Vec2;
///
/// assert_eq!(nematic_order(&[Vec2::X, -Vec2::X]), 1.0);
/// assert_eq!(nematic_order(&[Vec2::X, Vec2::Y]), 0.0);
/// ```
#[must_use]
pub fn nematic_order(directions: &[Vec2]) -> f64 {
    mean_length(directions, |n| Vec2::new(n.x * n.x - n.y * n.y, 2.0 * n.x * n.y))
}

/// Returns the length of the mean of a function of unit vectors.
fn mean_length(directions: &[Vec2], of: impl Fn(Vec2) -> Vec2) -> f64 {
    let units: Vec<Vec2> = directions.iter().filter_map(|direction| direction.try_normalize()).collect();
    if units.is_empty() {
        return 0.0;
    }
    units.iter().map(|n| of(*n)).sum::<Vec2>().length() / units.len() as f64
}
