//! What the grid takes from the velocity beside a line of tangential forces.

use ib_core::Vec2;

/// The flow that is missing beside a line of tangential forces, as a streamfunction.
///
/// Where a force f_t per length pulls along a line the velocity has a kink, which spreading and interpolation round off. At the
/// distance `s h` the velocity along the line lacks
/// ```text
/// (h/eta) phi(s) f_t,    phi(s) = 1/2 (E|s + Z| - |s|),    phi(0) = G_t(0)
/// ```
/// (h grid spacing, eta viscosity, G_t the deficit of a flat interface) with a random number Z that stands for the kernels and the
/// grid: here a cubic B-spline, made as wide as phi(0) asks for. Where f_t changes along the line this alone has a divergence, and a
/// solid that is moved by it is compressed, which no flow undoes. What the grid really takes has none. With the streamfunction
/// ```text
/// (h^2/eta) f_t chi(s),    chi' = phi - g integral of phi,    integral of g = 1
/// ```
/// there is a velocity across the line too, away from it, of `-(h^2/eta) f_t' chi(s)/(1 - kappa s h)`, kappa being the curvature of the line. It
/// vanishes on the line; the weight g ends it over some grid spacings, in place of the wavelength over which it really ends. The part
/// of g is of second order in h.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RoundedKink {
    /// Width of the spline over that of the cubic one on a grid.
    scale: f64,
    /// Where g ends, in units of the scale.
    end: f64,
    /// Integral of the spline to there.
    integral: f64,
}

/// A point beside a straight part of a line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Beside {
    /// Unit vector along the line.
    pub(crate) tangent: Vec2,
    /// chi'(s)/phi(0), what multiplies the missing velocity of the line.
    along: f64,
    /// The vector that multiplies its slope (length).
    across: Vec2,
}

/// phi(0) of a cubic B-spline.
const SPLINE_AT_ZERO: f64 = 7.0 / 30.0;
/// Where g ends, where there is room.
const END: f64 = 4.0;
/// How much shorter than the line itself one beside it may be: keeps away from centres of curvature.
const SHORTEST: f64 = 0.3;

/// phi(s) for a cubic B-spline: its second derivative is the spline, its slope at 0 is -1/2, and it ends at 2.
fn spline(s: f64) -> f64 {
    if s < 1.0 {
        SPLINE_AT_ZERO + s * (-0.5 + s * (1.0 / 3.0 + s * s * (-1.0 / 12.0 + s / 40.0)))
    } else if s < 2.0 {
        (2.0 - s).powi(5) / 120.0
    } else {
        0.0
    }
}

/// Its integral from 0 to s, 1/12 in the end.
fn spline_integral(s: f64) -> f64 {
    if s < 1.0 {
        s * (SPLINE_AT_ZERO + s * (-0.25 + s * (1.0 / 9.0 + s * s * (-1.0 / 60.0 + s / 240.0))))
    } else if s < 2.0 {
        1.0 / 12.0 - (2.0 - s).powi(6) / 720.0
    } else {
        1.0 / 12.0
    }
}

impl RoundedKink {
    /// For the deficit `phi(0)` (no dimension; [`ib_core::MobilityDeficit::flat`]) and within `room` grid spacings of the line.
    pub(crate) fn new(deficit: f64, room: f64) -> Self {
        let scale = deficit.max(0.0) / SPLINE_AT_ZERO;
        let end = if scale > 0.0 { END.min(room / scale) } else { 0.0 };
        Self { scale, end, integral: spline_integral(end) }
    }

    /// The distance (grid spacings) beyond which nothing is missing.
    pub(crate) fn reach(&self) -> f64 {
        self.scale * self.end
    }

    /// `chi'(s)` and `chi(s)` over `phi(0)`, for a distance s >= 0 (grid spacings).
    fn parts(&self, s: f64) -> [f64; 2] {
        let t = s / self.scale;
        let x = t / self.end;
        let along = spline(t) - self.integral / self.end * 6.0 * x * (1.0 - x);
        let across = spline_integral(t) - self.integral * x * x * (3.0 - 2.0 * x);
        [along / SPLINE_AT_ZERO, self.scale * across / SPLINE_AT_ZERO]
    }

    /// What is missing at the place `away` (length) from the nearest point of a line along the unit vector `tangent` that turns to its left
    /// with the `curvature` (1/length); nothing beyond the reach.
    pub(crate) fn beside(&self, away: Vec2, tangent: Vec2, curvature: f64, spacing: f64) -> Option<Beside> {
        let normal = Vec2::new(-tangent.y, tangent.x);
        let height = away.dot(&normal);
        let s = height.abs() / spacing;
        (s < self.reach()).then(|| {
            let [along, across] = self.parts(s);
            // Lines at this distance are shorter towards the centre of curvature.
            let shorter = (1.0 - curvature * height).max(SHORTEST);
            Beside { tangent, along, across: normal * (-height.signum() * across * spacing / shorter) }
        })
    }
}

impl Beside {
    /// The velocity (length per time) where on the line the velocity `missing` is missing (length per time), with the `slope` along the
    /// line (1/time).
    pub(crate) fn velocity(&self, missing: f64, slope: f64) -> Vec2 {
        self.tangent * (self.along * missing) + self.across * slope
    }

    /// The adjoint: the force that works on what is missing on the line, and the one (times length) that works on its slope.
    pub(crate) fn work(&self, force: Vec2) -> [f64; 2] {
        [self.along * self.tangent.dot(&force), self.across.dot(&force)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ib_core::{CubicQuadratic, MobilityDeficit};

    #[test]
    fn the_shape_is_the_mean_distance_from_a_spline() {
        // phi(s) = 1/2 (E|s + Z| - |s|) by quadrature over the cubic B-spline.
        let density = |z: f64| {
            let a = z.abs();
            if a < 1.0 { 2.0 / 3.0 - a * a + 0.5 * a * a * a } else { (2.0 - a).powi(3) / 6.0 }
        };
        for s in [0.0, 0.3, 0.9, 1.0, 1.4, 2.0, 2.5] {
            let steps = 40_000;
            let mean: f64 = (0..steps)
                .map(|k| 4.0 * (f64::from(k) + 0.5) / f64::from(steps) - 2.0)
                .map(|z| density(z) * (s + z).abs() * 4.0 / f64::from(steps))
                .sum();
            assert!((spline(s) - 0.5 * (mean - s)).abs() < 1e-8, "{s}");
        }
    }

    #[test]
    fn the_deficit_of_the_default_kernel_is_that_of_the_shape() {
        let along_the_grid = MobilityDeficit::new(&CubicQuadratic::default()).flat(Vec2::new(1.0, 0.0));
        assert!((along_the_grid - SPLINE_AT_ZERO).abs() < 2e-3, "{along_the_grid}");
    }

    #[test]
    fn it_has_no_divergence_and_ends() {
        let (step, spacing) = (1e-4, 0.1);
        for kink in [RoundedKink::new(0.25, 20.0), RoundedKink::new(0.25, 2.5), RoundedKink::new(0.4, 1.2)] {
            // What is missing on y = 0 is sin(x).
            let velocity = |x: f64, y: f64| {
                let beside = kink.beside(Vec2::new(0.0, y), Vec2::new(1.0, 0.0), 0.0, spacing);
                beside.map_or_else(Vec2::zeros, |beside| beside.velocity(x.sin(), x.cos()))
            };
            let places: [(f64, f64); 5] = [(0.3, 0.2), (0.3, -0.7), (1.2, 1.1), (2.0, -2.3), (0.1, 3.0)];
            for (x, s) in places.into_iter().filter(|(_, s)| s.abs() + 0.01 < kink.reach()) {
                let y = spacing * s;
                let divergence = (velocity(x + step, y) - velocity(x - step, y)).x
                    + (velocity(x, y + step) - velocity(x, y - step)).y;
                assert!((0.5 * divergence / step).abs() < 1e-5, "{x} {s}: {divergence}");
            }
            assert!((velocity(1.0, 0.0) - Vec2::new(1.0_f64.sin(), 0.0)).norm() < 1e-15);
            // Nothing flows across where it ends.
            assert!(velocity(0.0, spacing * kink.reach() * (1.0 - 1e-9)).y.abs() < 1e-8);
        }
    }

    #[test]
    fn velocity_and_work_are_adjoint() {
        let kink = RoundedKink::new(0.25, 20.0);
        let beside = kink.beside(Vec2::new(0.03, -0.11), Vec2::new(0.6, 0.8), 0.5, 0.1).unwrap();
        let (force, missing, slope) = (Vec2::new(1.3, -0.4), 0.7, -2.1);
        let [on_missing, on_slope] = beside.work(force);
        let (power, adjoint) = (force.dot(&beside.velocity(missing, slope)), on_missing * missing + on_slope * slope);
        assert!((power - adjoint).abs() < 1e-14 && power.abs() > 1e-4, "{power} {adjoint}");
    }
}
