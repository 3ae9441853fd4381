//! Lattices that fill a region.

use active_interface::internal::SplitMix64;
use motile_base::{Region, Vec2};

/// So many sites of the lattice of rows along x, each second one displaced by half a spacing or none, whose minimum
/// distance is the largest. The `margin` is what a channel's sites keep from its walls (length). The lattice may have
/// more sites, of which random ones are taken.
pub(super) fn sites(region: &Region, count: usize, margin: f64, random: &mut SplitMix64) -> Vec<Vec2> {
    let [length, width] = region.lengths();
    let periodic = region.periods()[1].is_some();
    let height = |rows: usize| match (periodic, rows) {
        (true, _) => width / rows as f64,
        (false, 1) => f64::INFINITY,
        (false, _) => (width - 2.0 * margin) / (rows - 1) as f64,
    };
    // Rows, whether they are displaced, and the least distance (length).
    let mut best = (1, false, 0.0);
    for rows in 1..=count {
        let along = length / count.div_ceil(rows) as f64;
        let up = height(rows);
        for displaced in [false, true] {
            if displaced && periodic && !rows.is_multiple_of(2) {
                continue;
            }
            let between = if displaced { up.hypot(0.5 * along) } else { up };
            let second = if displaced && (periodic || rows > 2) { 2.0 * up } else { f64::INFINITY };
            let least = along.min(between).min(second);
            if least > best.2 {
                best = (rows, displaced, least);
            }
        }
    }
    let (rows, displaced, _) = best;
    let columns = count.div_ceil(rows);
    let all = (0..rows).flat_map(|row| {
        let y = match (periodic, rows) {
            (true, _) => -0.5 * width + (row as f64 + 0.5) * height(rows),
            (false, 1) => 0.0,
            (false, _) => -0.5 * width + margin + row as f64 * height(rows),
        };
        let shift = if displaced && row % 2 == 1 { 0.75 } else { 0.25 };
        (0..columns).map(move |column| Vec2::new(length * ((column as f64 + shift) / columns as f64 - 0.5), y))
    });
    let mut all: Vec<Vec2> = all.collect();
    // Fisher and Yates.
    for last in (1..all.len()).rev() {
        all.swap(last, ((random.uniform() * (last + 1) as f64) as usize).min(last));
    }
    all.truncate(count);
    all
}
