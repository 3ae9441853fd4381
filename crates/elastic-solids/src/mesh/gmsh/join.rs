//! Points of a mesh file that coincide, possibly one period apart.

use std::collections::HashMap;

use motile_base::Vec2;

/// Distance up to which points coincide, over the shortest edge: far above the digits of a file, far below any edge.
const TOLERANCE: f64 = 1e-3;

/// Makes points that coincide modulo the period one, the first of them.
pub(super) fn join_ends(points: &[Vec2], triangles: &[[usize; 3]], period: f64) -> (Vec<Vec2>, Vec<[usize; 3]>) {
    let first = first_of_same(points, triangles, Some(period));
    let mut kept = Vec::with_capacity(points.len());
    let mut numbers = Vec::with_capacity(points.len());
    for (number, (&first, &point)) in first.iter().zip(points).enumerate() {
        numbers.push(if first == number { kept.len() } else { numbers[first] });
        if first == number {
            kept.push(point);
        }
    }
    (kept, triangles.iter().map(|triangle| triangle.map(|point| numbers[point])).collect())
}

/// Returns the index of the first point that coincides with each point, modulo the period if there is one.
pub(in crate::mesh) fn first_of_same(points: &[Vec2], triangles: &[[usize; 3]], period: Option<f64>) -> Vec<usize> {
    let edges = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let shortest = edges.map(|(a, b)| (points[a] - points[b]).length()).fold(f64::INFINITY, f64::min);
    let reach = TOLERANCE * shortest;
    // Without a length there is nothing to compare with; the mesh will be refused.
    if !(reach.is_finite() && reach > 0.0) {
        return (0..points.len()).collect();
    }
    let start = points.iter().map(|point| point.x).fold(f64::INFINITY, f64::min);
    // The fraction of the period, with the end counted as the start.
    let home = |point: &Vec2| {
        let Some(period) = period else { return *point };
        let x = (point.x - start).rem_euclid(period);
        Vec2::new(if x > period - 2.0 * reach { x - period } else { x }, point.y)
    };
    let cell = |point: &Vec2| ((point.x / (4.0 * reach)).floor() as i64, (point.y / (4.0 * reach)).floor() as i64);
    let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let homes: Vec<Vec2> = points.iter().map(home).collect();
    let first = homes.iter().enumerate().map(|(number, place)| {
        let (x, y) = cell(place);
        let near = (-1..=1)
            .flat_map(|i| (-1..=1).map(move |j| (x.saturating_add(i), y.saturating_add(j))))
            .filter_map(|key| cells.get(&key))
            .flatten();
        if let Some(&same) = near.into_iter().find(|&&other| (homes[other] - place).length() <= reach) {
            return same;
        }
        cells.entry((x, y)).or_default().push(number);
        number
    });
    first.collect()
}
