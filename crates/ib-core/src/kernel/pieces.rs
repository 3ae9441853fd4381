//! Kernels made of polynomials.

/// The weights of a kernel of at most four points that between lattice points is a polynomial of degree three (normal
/// role) or two (tangential role). They are for spreading and interpolation without a call for each weight.
///
/// A coordinate `r + shift` has the whole part `w` and the fraction t. The weight of the point `w - 1 + i` in the
/// normal role, and of the point `w - 1/2 + i` in the tangential one, is `sum over d of c[d][i] t^d`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pieces {
    /// Number that is added to a coordinate (in units of h) before it is split.
    pub shift: f64,
    /// Coefficients in the normal role, by power and point.
    pub normal: [[f64; 4]; 4],
    /// Coefficients in the tangential role, by power and point.
    pub tangential: [[f64; 4]; 3],
}

const SIXTH: f64 = 1.0 / 6.0;

/// Cubic and quadratic B-spline; the knots of both lie on the lattice of the normal role.
pub(crate) const BSPLINE_4: Pieces = Pieces {
    shift: 0.0,
    normal: [
        [SIXTH, 4.0 * SIXTH, SIXTH, 0.0],
        [-0.5, 0.0, 0.5, 0.0],
        [0.5, -1.0, 0.5, 0.0],
        [-SIXTH, 0.5, -0.5, SIXTH],
    ],
    tangential: [[0.5, 0.5, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.5, -1.0, 0.5, 0.0]],
};

/// Quadratic and linear B-spline; the knots of both lie on the lattice of the tangential role.
pub(super) const BSPLINE_3: Pieces = Pieces {
    shift: 0.5,
    normal: [[0.5, 0.5, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.5, -1.0, 0.5, 0.0], [0.0; 4]],
    tangential: [[1.0, 0.0, 0.0, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.0; 4]],
};

#[cfg(test)]
mod tests;
