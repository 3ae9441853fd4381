//! Points that are the same one period apart.

use std::collections::HashMap;

use ib_core::Vec2;

/// Distance at which points are the same, over the shortest edge.
const TOLERANCE: f64 = 1e-3;

/// Makes points that coincide modulo the period one, the first of them.
pub(super) fn join_ends(points: &[Vec2], triangles: &[[usize; 3]], period: f64) -> (Vec<Vec2>, Vec<[usize; 3]>) {
    let edges = triangles.iter().flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)]);
    let shortest = edges.map(|(a, b)| (points[a] - points[b]).length()).fold(f64::INFINITY, f64::min);
    let reach = TOLERANCE * shortest;
    // Without a length there is nothing to compare with; the mesh will be refused.
    if !(reach.is_finite() && reach > 0.0) {
        return (points.to_vec(), triangles.to_vec());
    }
    let start = points.iter().map(|point| point.x).fold(f64::INFINITY, f64::min);
    // The fraction of the period, with the end counted as the start.
    let home = |point: &Vec2| {
        let x = (point.x - start).rem_euclid(period);
        Vec2::new(if x > period - 2.0 * reach { x - period } else { x }, point.y)
    };
    let cell = |point: &Vec2| ((point.x / (4.0 * reach)).floor() as i64, (point.y / (4.0 * reach)).floor() as i64);
    let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
    let mut kept: Vec<Vec2> = Vec::with_capacity(points.len());
    let mut homes: Vec<Vec2> = Vec::with_capacity(points.len());
    let numbers: Vec<usize> = points
        .iter()
        .map(|point| {
            let place = home(point);
            let (x, y) = cell(&place);
            let near = (-1..=1)
                .flat_map(|i| (-1..=1).map(move |j| (x.saturating_add(i), y.saturating_add(j))))
                .filter_map(|key| cells.get(&key))
                .flatten();
            if let Some(&same) = near.into_iter().find(|&&other| (homes[other] - place).length() <= reach) {
                return same;
            }
            cells.entry((x, y)).or_default().push(kept.len());
            kept.push(*point);
            homes.push(place);
            kept.len() - 1
        })
        .collect();
    (kept, triangles.iter().map(|triangle| triangle.map(|point| numbers[point])).collect())
}
