//! Geometry of a polygon of markers, closed or periodic along x, and the motion that keeps the markers equally spaced.

use motile_base::Vec2;

use crate::concentration::Cells;

/// Geometry of a polygon, closed or one period of one that is periodic along x, marker k followed by segment k.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Geometry {
    /// Lengths of the segments (length).
    pub(crate) lengths: Vec<f64>,
    /// Unit vectors along the segments.
    pub(crate) directions: Vec<Vec2>,
    /// Arc weights w_k of the markers (length): of a polygon the lengths of the half chords `(X_{k+1} - X_{k-1}) / 2`,
    /// with which the rate of its area is exactly `sum X_k' . n_k w_k`.
    pub(crate) weights: Vec<f64>,
    /// Unit tangents at the markers, along the half chords; the outward normal is (tau_y, -tau_x).
    pub(crate) tangents: Vec<Vec2>,
    /// |X_alpha| at the markers (length); only of smooth curves, see `SpectralCurve`.
    pub(crate) stretch: Vec<f64>,
    /// |X_alpha| at the middles of the segments times the step of alpha (length); only of smooth curves.
    pub(crate) spans: Vec<f64>,
    /// Sum of the lengths of the segments (length).
    pub(crate) perimeter: f64,
    /// Rings of a surface of revolution; empty in the plane.
    pub(crate) rings: Rings,
}

/// Mean square deviation of the curvature from its mean, over the square of the mean, up to which a curve is round.
const ROUND: f64 = 1e-4;

/// Halves of the rings that segments and markers of a surface of revolution stand for: its curve is the meridian with
/// its mirror image.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Rings {
    /// Areas of the segments (length squared).
    pub(crate) areas: Vec<f64>,
    /// Lengths of the circles at the markers (length).
    pub(crate) circles: Vec<f64>,
    /// Signed distances of the middles of the segments from the axis (length).
    pub(crate) middles: Vec<f64>,
    /// Weights of the markers in integrals over the surface (length squared), exact for trigonometric polynomials: the
    /// distance from the axis times even functions is a series of sines over the meridian.
    pub(crate) weights: Vec<f64>,
}

impl Rings {
    /// Returns the factors of the trapezoidal rule's weights for so many markers that integrate sines from 0 to pi
    /// exactly.
    pub(crate) fn quadrature(count: usize) -> Vec<f64> {
        let half = count / 2;
        let waves: Vec<f64> = (0..count).map(|k| (std::f64::consts::PI * k as f64 / half as f64).sin()).collect();
        let factor = |k: usize| -> f64 {
            let sines = (1..half).step_by(2).map(|m| waves[m * k.min(count - k) % count] / m as f64);
            4.0 / std::f64::consts::PI * sines.sum::<f64>()
        };
        (0..count).map(factor).collect()
    }
}

impl Geometry {
    /// Makes all lists fit `count` markers.
    pub(crate) fn resize(&mut self, count: usize) {
        for list in [&mut self.directions, &mut self.tangents] {
            list.resize(count, Vec2::ZERO);
        }
        self.lengths.resize(count, 0.0);
        self.weights.resize(count, 0.0);
    }

    /// Returns the geometry of the polygon through the markers, which continues `advance` further along x (length).
    pub(crate) fn update(&mut self, markers: &[Vec2], advance: f64) {
        let (count, period) = (markers.len(), Vec2::new(advance, 0.0));
        self.resize(count);
        self.spans.clear();
        self.perimeter = 0.0;
        for k in 0..count {
            let (before, here) = (if k == 0 { markers[count - 1] - period } else { markers[k - 1] }, markers[k]);
            let after = if k + 1 == count { markers[0] + period } else { markers[k + 1] };
            let segment = after - here;
            let length = segment.length();
            self.perimeter += length;
            self.lengths[k] = length;
            self.directions[k] = segment / length;
            let chord = 0.5 * (after - before);
            let weight = chord.length();
            self.weights[k] = weight;
            self.tangents[k] = chord / weight;
        }
    }

    /// Writes the differences of the tensions of segments along them (force) at each marker: `T_k t_k - T_{k-1}
    /// t_{k-1}`.
    pub(super) fn write_pulls(&self, tensions: &[f64], forces: &mut [Vec2]) {
        let pull = |k: usize| tensions[k] * self.directions[k];
        let mut before = pull(self.directions.len() - 1);
        for (k, force) in forces.iter_mut().enumerate() {
            let here = pull(k);
            *force = here - before;
            before = here;
        }
    }

    /// Returns the cells of particles.
    pub(crate) fn cells(&self) -> Cells<'_> {
        let Self { lengths, rings, .. } = self;
        let sizes = if rings.areas.is_empty() { lengths } else { &rings.areas };
        Cells { sizes, lengths, faces: &rings.circles }
    }

    /// Returns the weights of the markers in an integral over the interface (length, or length squared).
    fn all_weights(&self) -> &[f64] {
        if self.rings.weights.is_empty() { &self.weights } else { &self.rings.weights }
    }

    /// Returns the volume of a body of revolution through these markers (length cubed).
    pub(crate) fn volume(&self, markers: &[Vec2]) -> f64 {
        let parts = markers.iter().zip(&self.tangents).zip(self.all_weights());
        parts.map(|((x, tau), weight)| weight * (x - markers[0]).dot(outward(*tau)) / 3.0).sum()
    }

    /// Returns the length of the interface, or area of a surface of revolution by the markers' weights.
    pub(crate) fn total_weight(&self) -> f64 {
        self.all_weights().iter().sum()
    }

    /// Returns the curvature at marker k minus `mean` (1/length).
    pub(crate) fn curvature_from(&self, mean: f64, k: usize) -> f64 {
        let before = if k == 0 { self.directions.len() - 1 } else { k - 1 };
        let turn = self.directions[before] - self.directions[k];
        turn.dot(outward(self.tangents[k])) / self.weights[k] - mean
    }

    /// Returns true if a closed curve is round, up to 1 % of its curvature. A change of its length would then
    /// change its area.
    pub(crate) fn is_round(&self) -> bool {
        let length = self.total_weight();
        let mean = std::f64::consts::TAU / length;
        let square = |(k, weight): (usize, &f64)| self.curvature_from(mean, k).powi(2) * weight;
        self.weights.iter().enumerate().map(square).sum::<f64>() <= ROUND * length * mean * mean
    }

    /// Returns the mean length of the segments (length).
    pub(crate) fn mean_length(&self) -> f64 {
        self.perimeter / self.lengths.len() as f64
    }
}

/// Returns the outward unit normal of a counter-clockwise curve with this unit tangent.
#[inline]
pub(crate) fn outward(tangent: Vec2) -> Vec2 {
    Vec2::new(tangent.y, -tangent.x)
}

/// Returns the rate at which a flow moves markers around or away (1/time). It is the root mean square of their
/// velocities over the radius of a circle of the same perimeter. Spacing becomes unequal by errors of that motion, a
/// translation included.
pub(crate) fn motion_rate(geometry: &Geometry, velocities: &[Vec2]) -> f64 {
    let square = velocities.iter().map(|velocity| velocity.length_squared()).sum::<f64>() / velocities.len() as f64;
    square.sqrt() * std::f64::consts::TAU / geometry.perimeter
}

/// Writes the normal parts of `velocities` relative to `carried` (length per time) to `motion`, less the mean normal
/// velocity over the weights, so that the area or volume enclosed stays.
pub(super) fn write_normal_motion(geometry: &Geometry, velocities: &[Vec2], carried: Vec2, motion: &mut [Vec2]) {
    let (mut flux, mut total) = (0.0, 0.0);
    for ((u, tau), w) in velocities.iter().zip(&geometry.tangents).zip(geometry.all_weights()) {
        flux += (*u - carried).dot(outward(*tau)) * w;
        total += w;
    }
    let mean = flux / total;
    for ((u, tau), out) in velocities.iter().zip(&geometry.tangents).zip(motion) {
        let normal = outward(*tau);
        *out = ((*u - carried).dot(normal) - mean) * normal;
    }
}

/// Adds the tangential velocities W of the markers, as `velocity(k, slip[k])`, to `motion`, and writes `V_t - W`, the
/// fluid's velocity along the interface relative to the markers, to `slip` (length per time).
pub(super) fn add_tangential_motion(
    geometry: &Geometry,
    velocities: &[Vec2],
    motion: &mut [Vec2],
    slip: &mut [f64],
    velocity: impl Fn(usize, f64) -> f64,
) {
    for (k, (out, slip)) in motion.iter_mut().zip(slip).enumerate() {
        let (tau, w) = (geometry.tangents[k], velocity(k, *slip));
        *out += w * tau;
        *slip = velocities[k].dot(tau) - w;
    }
}

/// Returns the velocities of markers that follow the interface normally and stay equally spaced
/// (docs/explanation/time-stepping.md):
///
/// * normal velocity `V_n = U . n` less its mean over the arc weights, which keeps the polygon's area;
/// * tangential velocity W with `W_{k+1} - W_k = mean(q) - q_k + rho (mean(l) - l_k)`, where
///   `q_k = ((V_n n)_{k+1} - (V_n n)_k) . t_k` is the stretching of segment k by the normal motion, rho the rate of
///   relaxation (1/time), and `mean(W) = mean(V_t)`, so that markers turn with the fluid.
///
/// Writes the marker velocities to `motion` and `V_t - W` to `slip` (length per time).
pub(crate) fn equidistribute(
    geometry: &Geometry,
    velocities: &[Vec2],
    relaxation: f64,
    motion: &mut [Vec2],
    slip: &mut [f64],
) {
    let count = velocities.len();
    write_normal_motion(geometry, velocities, Vec2::ZERO, motion);
    let tangential: f64 = velocities.iter().zip(&geometry.tangents).map(|(u, tau)| u.dot(*tau)).sum();
    let stretching = |motion: &[Vec2], k: usize| {
        (motion[if k + 1 == count { 0 } else { k + 1 }] - motion[k]).dot(geometry.directions[k])
    };
    let mean_stretching = (0..count).map(|k| stretching(motion, k)).sum::<f64>() / count as f64;
    let mean_length = geometry.mean_length();
    // W up to a constant, kept in `slip` for now.
    let mut w = 0.0;
    let mut sum = 0.0;
    for (k, position) in slip.iter_mut().enumerate() {
        *position = w;
        sum += w;
        w += mean_stretching - stretching(motion, k) + relaxation * (mean_length - geometry.lengths[k]);
    }
    let shift = tangential / count as f64 - sum / count as f64;
    add_tangential_motion(geometry, velocities, motion, slip, |_, w| w + shift);
}
