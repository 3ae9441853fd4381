//! Pressure on either side of interfaces, across which it jumps.

use crate::{OutputError, Raster, Samples};
use motile::base::Vec2;

/// Field that is smooth on either side of closed curves.
pub(crate) struct Sides {
    pub(crate) outside: Samples<f64>,
    pub(crate) inside: Samples<f64>,
}

/// Returns the fields outside and inside of closed curves, from samples of one that jumps across them. Samples nearer
/// to a curve than `band` (length) are replaced by neighbours of the same side, with which each field is also continued
/// across the curves; farther across it is not a number.
pub(crate) fn sides(raster: &Raster, values: Vec<f64>, curves: &[&[Vec2]], band: f64) -> Result<Sides, OutputError> {
    let mut field = Samples::new(*raster, values)?;
    let cell = (0..2).map(|k| raster.size[k] / raster.cells[k] as f64).fold(0.0, f64::max);
    let band = band.max(0.75 * cell);
    let (mut inside, mut trusted) = (vec![false; field.values.len()], vec![true; field.values.len()]);
    let mut kept_inside = vec![false; field.values.len()];
    for curve in curves {
        let (within, near) = (samples_within(raster, curve), samples_near(raster, curve, band));
        near.iter().for_each(|&k| trusted[k] = false);
        within.iter().for_each(|&k| inside[k] = true);
        // Of a curve without samples farther from it, those inside count as they are.
        let far = within.iter().any(|k| near.binary_search(k).is_err());
        within.iter().filter(|k| !far || near.binary_search(k).is_err()).for_each(|&k| kept_inside[k] = true);
    }
    let reach = (2.0 * band / cell).ceil() as usize + 2;
    let continued = |kept: &dyn Fn(usize) -> bool| {
        let value = |(k, &value): (usize, &f64)| if kept(k) { value } else { f64::NAN };
        let values = field.values.iter().enumerate().map(value).collect();
        let mut field = Samples { raster: *raster, values };
        (0..reach).for_each(|_| grow(&mut field));
        field
    };
    let (outer, inner) = (continued(&|k| trusted[k] && !inside[k]), continued(&|k| kept_inside[k]));
    // Beyond the reach nothing is seen of this field, which is below the other.
    for (value, outer) in field.values.iter_mut().zip(&outer.values) {
        *value = if outer.is_nan() { *value } else { *outer };
    }
    Ok(Sides { outside: field, inside: inner })
}

/// Gives each sample that is not a number the mean of its neighbours that are.
fn grow(field: &mut Samples<f64>) {
    let [nx, ny] = field.raster.cells;
    let [around_x, around_y] = [0, 1].map(|axis| {
        let (n, periodic) = (field.raster.cells[axis] as i64, field.raster.periodic[axis]);
        move |k: usize| {
            let all = (k as i64 - 1)..=(k as i64 + 1);
            all.filter(move |m| periodic || (0..n).contains(m)).map(move |m| m.rem_euclid(n) as usize)
        }
    });
    let before = field.values.clone();
    for j in 0..ny {
        for i in (0..nx).filter(|i| before[j * nx + i].is_nan()) {
            let near = around_y(j).flat_map(|n| around_x(i).map(move |m| n * nx + m)).map(|k| before[k]);
            let (count, sum) = near.filter(|v| !v.is_nan()).fold((0.0, 0.0), |(count, sum), v| (count + 1.0, sum + v));
            field.values[j * nx + i] = sum / count;
        }
    }
}

/// Returns the numbers of the cell of a raster at integer coordinates, with its periods; `None` beyond a border.
fn number(raster: &Raster, at: [i64; 2]) -> Option<usize> {
    let wrapped = [0, 1].map(|k| {
        let n = raster.cells[k] as i64;
        (raster.periodic[k] || (0..n).contains(&at[k])).then(|| at[k].rem_euclid(n) as usize)
    });
    Some(wrapped[1]? * raster.cells[0] + wrapped[0]?)
}

/// Returns the point in units of the cells, in which samples have integer coordinates.
fn in_cells(raster: &Raster, p: Vec2) -> [f64; 2] {
    [0, 1].map(|k| (p[k] - raster.origin[k]) / raster.size[k] * raster.cells[k] as f64 - 0.5)
}

/// Returns the sides of a closed curve in units of the cells; none if a point is not finite or the curve is too large.
fn edges(raster: &Raster, curve: &[Vec2]) -> Vec<[[f64; 2]; 2]> {
    let points: Vec<[f64; 2]> = curve.iter().map(|&p| in_cells(raster, p)).collect();
    let longest = 10.0 * (raster.cells[0] + raster.cells[1]) as f64;
    let next = points.iter().cycle().skip(1);
    let all: Vec<_> = points.iter().zip(next).map(|(a, b)| [*a, *b]).collect();
    let short = |[a, b]: &[[f64; 2]; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < longest;
    if all.iter().all(short) { all } else { Vec::new() }
}

/// Returns the numbers of the samples within a closed curve, sorted.
fn samples_within(raster: &Raster, curve: &[Vec2]) -> Vec<usize> {
    let edges = edges(raster, curve);
    let heights = || edges.iter().map(|[a, _]| a[1]);
    let (low, high) = heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), v| (a.min(v), b.max(v)));
    let mut found = Vec::new();
    for row in low.ceil() as i64..=high.floor() as i64 {
        let y = row as f64;
        let crossing = |[a, b]: &[[f64; 2]; 2]| {
            ((a[1] <= y) != (b[1] <= y)).then(|| a[0] + (y - a[1]) / (b[1] - a[1]) * (b[0] - a[0]))
        };
        let mut crossings: Vec<f64> = edges.iter().filter_map(crossing).collect();
        crossings.sort_unstable_by(f64::total_cmp);
        for pair in crossings.chunks_exact(2) {
            found.extend((pair[0].ceil() as i64..=pair[1].floor() as i64).filter_map(|x| number(raster, [x, row])));
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

/// Returns the numbers of the samples nearer to a closed curve than a distance (length), sorted.
fn samples_near(raster: &Raster, curve: &[Vec2], distance: f64) -> Vec<usize> {
    let cell = [0, 1].map(|k| raster.size[k] / raster.cells[k] as f64);
    let mut found = Vec::new();
    for [a, b] in edges(raster, curve) {
        let range = |k: usize| {
            let margin = distance / cell[k];
            (a[k].min(b[k]) - margin).ceil() as i64..=(a[k].max(b[k]) + margin).floor() as i64
        };
        let length = |p: [f64; 2], q: [f64; 2]| Vec2::new((q[0] - p[0]) * cell[0], (q[1] - p[1]) * cell[1]);
        let along = length(a, b);
        for y in range(1) {
            for x in range(0) {
                let to = length(a, [x as f64, y as f64]);
                let part = (to.dot(along) / along.length_squared().max(1e-300)).clamp(0.0, 1.0);
                if (to - part * along).length() < distance {
                    found.extend(number(raster, [x, y]));
                }
            }
        }
    }
    found.sort_unstable();
    found.dedup();
    found
}

#[cfg(test)]
mod tests;
