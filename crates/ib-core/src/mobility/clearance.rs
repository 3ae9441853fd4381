//! How far the markers of an interface are from solids.

use crate::{MarkerKind, Markers, Vec2, hydrodynamics::MarkerGroup};

/// Distance up to which it is measured, in grid spacings.
const REACH: f64 = 6.0;
/// How much further away than its surface the nearest point of a solid is for markers close to it, on average, in grid
/// spacings.
const OFFSET: f64 = 0.2;

/// Distances of the markers of an interface from the nearest points of solids.
#[derive(Debug, Clone, Default)]
pub(crate) struct Clearance {
    squared: Vec<f64>,
    gaps: Vec<f64>,
    /// Markers sorted by x.
    order: Vec<(f64, u32)>,
}

impl Clearance {
    /// The gaps between the markers of an interface and the surfaces of solids, in grid spacings; infinite beyond the
    /// reach. Empty without solids. Points that put no force on the fluid (tracers) stop nothing.
    pub(crate) fn gaps(&mut self, markers: &Markers, interface: usize, spacing: f64, period: f64) -> &[f64] {
        self.gaps.clear();
        let is_solid = |group: &MarkerGroup| {
            group.kind == MarkerKind::Points
                && markers.forces[group.range.clone()].iter().any(|force| *force != Vec2::ZERO)
        };
        if !markers.groups().iter().any(is_solid) {
            return &self.gaps;
        }
        let positions = &markers.positions[markers.groups()[interface].range.clone()];
        self.squared.clear();
        self.squared.resize(positions.len(), f64::INFINITY);
        self.order.clear();
        self.order.extend(positions.iter().zip(0..).map(|(p, k)| (p.x, k)));
        self.order.sort_unstable_by(|a, b| a.0.total_cmp(&b.0));
        let reach = REACH * spacing;
        let (low, high) =
            positions.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), p| (a.min(p.y), b.max(p.y)));
        let (Some(&(first, _)), Some(&(last, _))) = (self.order.first(), self.order.last()) else { return &self.gaps };
        let middle = 0.5 * (first + last);
        let solids = markers.groups().iter().filter(|group| is_solid(group));
        for point in solids.flat_map(|group| &markers.positions[group.range.clone()]) {
            if point.y < low - reach || point.y > high + reach {
                continue;
            }
            let offset = point.x - middle;
            let x = if offset.abs() > 0.5 * period { point.x - period * (offset / period).round() } else { point.x };
            if x < first - reach || x > last + reach {
                continue;
            }
            let point = Vec2::new(x, point.y);
            let start = self.order.partition_point(|(at, _)| *at < x - reach);
            for &(at, marker) in &self.order[start..] {
                if at > x + reach {
                    break;
                }
                let marker = marker as usize;
                let squared = (positions[marker] - point).length_squared();
                self.squared[marker] = self.squared[marker].min(squared);
            }
        }
        let gap = |squared: &f64| {
            if *squared > reach * reach { f64::INFINITY } else { (squared.sqrt() / spacing - OFFSET).max(0.0) }
        };
        self.gaps.extend(self.squared.iter().map(gap));
        &self.gaps
    }
}

#[cfg(test)]
mod tests;
