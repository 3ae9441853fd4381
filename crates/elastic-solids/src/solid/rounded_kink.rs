//! What the grid takes from the velocity beside a line of tangential forces.

use ib_core::Vec2;

/// The flow that is missing beside a line of tangential forces, as a streamfunction.
///
/// Where a force f_t per length pulls along a line the velocity has a kink, which spreading and interpolation round
/// off. At the distance `s h` the velocity along the line lacks
/// ```text
/// (h/eta) phi(s) f_t,    phi(s) = 1/2 (E|s + Z| - |s|),    phi(0) = G_t(0)
/// ```
/// (h grid spacing, eta viscosity, G_t the deficit of a flat interface) with a random number Z that stands for the
/// kernels and the grid: here a cubic B-spline, made as wide as phi(0) asks for. Where f_t changes along the line this
/// alone has a divergence, and a solid that is moved by it is compressed, which no flow undoes. What the grid really
/// takes has none. With the streamfunction
/// ```text
/// (h^2/eta) f_t chi(s),    chi' = phi - g integral of phi,    integral of g = 1
/// ```
/// there is a velocity across the line too, away from it, of `-(h^2/eta) f_t' chi(s)/(1 - kappa s h)`, kappa being the
/// curvature of the line. It vanishes on the line; the weight g ends it over some grid spacings, in place of the
/// wavelength over which it really ends. The part of g is of second order in h.
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
    /// For the deficit `phi(0)` (no dimension; [`ib_core::MobilityDeficit::flat`]) and within `room` grid spacings of
    /// the line.
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

    /// What is missing at the place `away` (length) from the nearest point of a line along the unit vector `tangent`
    /// that turns to its left with the `curvature` (1/length); nothing beyond the reach.
    pub(crate) fn beside(&self, away: Vec2, tangent: Vec2, curvature: f64, spacing: f64) -> Option<Beside> {
        let normal = Vec2::new(-tangent.y, tangent.x);
        let height = away.dot(normal);
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
    /// The velocity (length per time) where on the line the velocity `missing` is missing (length per time), with the
    /// `slope` along the line (1/time).
    pub(crate) fn velocity(&self, missing: f64, slope: f64) -> Vec2 {
        self.tangent * (self.along * missing) + self.across * slope
    }

    /// The adjoint: the force that works on what is missing on the line, and the one (times length) that works on its
    /// slope.
    pub(crate) fn work(&self, force: Vec2) -> [f64; 2] {
        [self.along * self.tangent.dot(force), self.across.dot(force)]
    }
}

#[cfg(test)]
mod tests;
