//! Filter of the modes of the markers above the cut-off of the kernel, which the grid does not see.

use motile_base::Vec2;

use super::geometry::{Geometry, outward};
use crate::tridiagonal::CirculantTridiagonal;

/// Largest part of a mode that one pass takes away: below one, so that no mode changes its sign.
const STRONGEST: f64 = 0.5;
/// Most passes a step: more, of steps that long, would smooth the shape itself.
const MOST_PASSES: f64 = 20.0;

/// Filter that relaxes modes of the markers shorter than the kernel (docs/explanation/time-stepping.md). The kernel's
/// transform vanishes at the wave number 2 pi / h, so that tension does not act on them while the converging surface
/// flow amplifies them.
///
/// With the short-wave part `e = (1 - S)^2 X` of the positions, `S = (1 - l^2 d_ss)^-1`, l = h/2, each marker moves by
/// `-a (e . n) n`, `a = dt gamma / (2 eta h)`, in as many passes. There are as many passes as make a at most a half in
/// each, so that the decay over a time does not depend on the length of steps. The area that this would change is
/// restored evenly.
#[derive(Debug, Clone, Default)]
pub(crate) struct ShortWaveFilter {
    once: Vec<Vec2>,
    twice: Vec<Vec2>,
}

impl ShortWaveFilter {
    /// Filters equally spaced `markers`; `strength(k)` is the rate gamma/(2 eta h) times the step at marker k.
    pub(crate) fn apply(
        &mut self,
        markers: &mut [Vec2],
        geometry: &Geometry,
        spacing: f64,
        strength: impl Fn(usize) -> f64,
    ) {
        let smoothing = CirculantTridiagonal::smoothing(0.5 * spacing, geometry.mean_length());
        for list in [&mut self.once, &mut self.twice] {
            list.resize(markers.len(), Vec2::ZERO);
        }
        let strongest = (0..markers.len()).map(&strength).fold(0.0, f64::max);
        if !(strongest > 0.0 && strongest.is_finite()) {
            return;
        }
        let passes = (strongest / STRONGEST).ceil().min(MOST_PASSES);
        for _ in 0..passes as usize {
            self.pass(markers, geometry, &smoothing, |k| (strength(k).max(0.0) / passes).min(STRONGEST));
        }
    }

    fn pass(
        &mut self,
        markers: &mut [Vec2],
        geometry: &Geometry,
        smoothing: &CirculantTridiagonal,
        strength: impl Fn(usize) -> f64,
    ) {
        // Positions relative to one marker, so that droplets that have travelled far lose no digits.
        let origin = markers[0];
        for (out, marker) in self.once.iter_mut().zip(markers.iter()) {
            *out = marker - origin;
        }
        for _ in 0..2 {
            self.twice.copy_from_slice(&self.once);
            smoothing.solve(&mut self.twice);
            for (value, smooth) in self.once.iter_mut().zip(&self.twice) {
                *value -= smooth;
            }
        }
        let (mut swept, mut total) = (0.0, 0.0);
        for (k, (short, tau)) in self.once.iter_mut().zip(&geometry.tangents).enumerate() {
            let normal = outward(*tau);
            let shift = -strength(k) * short.dot(normal);
            *short = shift * normal;
            swept += shift * geometry.weights[k];
            total += geometry.weights[k];
        }
        let mean = swept / total;
        for ((marker, shift), tau) in markers.iter_mut().zip(&self.once).zip(&geometry.tangents) {
            *marker += shift - mean * outward(*tau);
        }
    }
}

#[cfg(test)]
mod tests;
