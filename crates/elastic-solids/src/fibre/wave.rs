//! Waves that travel along a fibre.

/// A wave `amplitude sin(wave_number s - frequency t + phase)` along a fibre, s the length at rest from its first node.
///
/// Its amplitude is a curvature (1/length) for a flagellum that beats
/// ([`Fibre::with_curvature_wave`](crate::Fibre::with_curvature_wave)), or a displacement (length) for target points
/// that move ([`Target::wave`](crate::Target::wave)).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FibreWave<V> {
    /// Amplitude: 1/length for a curvature, length for a displacement.
    pub amplitude: V,
    /// Wave number (radians per length); the wave travels from the first node to the last one if it has the sign of
    /// the frequency.
    pub wave_number: f64,
    /// Angular frequency (radians per time).
    pub frequency: f64,
    /// Phase (radians).
    pub phase: f64,
}

impl<V> FibreWave<V> {
    /// Returns the value over the amplitude (no dimension) at a place along the fibre (length) and a time.
    pub(super) fn at(&self, along: f64, time: f64) -> f64 {
        (self.wave_number * along - self.frequency * time + self.phase).sin()
    }

    /// Returns the numbers without the amplitude.
    pub(super) fn numbers(&self) -> [f64; 3] {
        [self.wave_number, self.frequency, self.phase]
    }
}
