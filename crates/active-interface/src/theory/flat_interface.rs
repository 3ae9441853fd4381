//! Linear theory of flat interfaces between half-spaces, in channels and in pairs.

use motile_base::{finite, not_negative, positive};

use crate::InterfaceError;

/// Parameters of a flat interface with particles, and the wave on it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FlatInterface {
    /// Wave number k of the wave (1/length).
    pub wave_number: f64,
    /// Tension gamma(c0) of the uniform state (force).
    pub tension: f64,
    /// Activity (force times length), zeta_dmu for the linear law; for any law minus the slope of the tension,
    /// -d gamma/dc at c0. Negative for particles that contract.
    pub activity: f64,
    /// Mean concentration c0 (particles per length).
    pub concentration: f64,
    /// Diffusivity D along the interface (length squared per time).
    pub diffusivity: f64,
}

/// Fluid on one side of a flat interface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stratum {
    /// Viscosity (stress times time).
    pub viscosity: f64,
    /// Far side of it.
    pub end: StratumEnd,
}

/// Far side of a layer of fluid next to a flat interface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StratumEnd {
    /// None: a half-space.
    None,
    /// A rigid wall.
    Wall {
        /// Thickness of the layer (length).
        thickness: f64,
    },
    /// A rigid wall along which fluid slips.
    SlipWall {
        /// Thickness of the layer (length).
        thickness: f64,
        /// Slip length b (length): `u = b du/dn` at the wall, n being the normal into the fluid.
        slip: f64,
    },
    /// Another such interface, with the same concentration above every place: the mirror image in the middle of the
    /// layer, so that the shape of one is minus the shape of the other.
    Same {
        /// Thickness of the layer (length).
        thickness: f64,
    },
    /// Another such interface with the opposite perturbation of the concentration and the same shape.
    Opposite {
        /// Thickness of the layer (length).
        thickness: f64,
    },
}

impl Stratum {
    /// Returns the resistance Z of the fluid below an interface to the velocity `(u sin kx, v cos kx)` of the interface
    /// (stress times time over length). The force per length on the fluid is `Z (u, v)`, times sin kx and cos kx.
    ///
    /// With s = k times the thickness, `2 k eta [[A, C], [C, B]]`, where
    /// ```text
    /// none   A = B = 1, C = 0
    /// wall   A, B = (sinh s cosh s -+ s)/(sinh^2 s - s^2),  C = s^2/(sinh^2 s - s^2)
    /// slip   A = (sinh s cosh s - s + 2 b k sinh^2 s)/Q,  B = (sinh s cosh s + s + 2 b k cosh^2 s)/Q,
    ///        C = (s^2 + 2 b k s)/Q,  Q = sinh^2 s - s^2 + 2 b k (sinh s cosh s - s)
    /// ```
    /// and for another interface, with t = s/2, `2 k eta/(sinh t cosh t - t) [[sinh^2 t, t], [t, cosh^2 t]]` (same) or
    /// `2 k eta/(sinh t cosh t + t) [[cosh^2 t, -t], [-t, sinh^2 t]]` (opposite). The off-diagonal entries of the fluid
    /// above have the other sign. It is minus the integral of the Stokes equations over the layer.
    fn resistance(&self, wave_number: f64) -> Result<[[f64; 2]; 2], InterfaceError> {
        let unit = 2.0 * wave_number * positive("the viscosity of a layer", self.viscosity)?;
        let scaled = |thickness: f64| Ok::<_, InterfaceError>(wave_number * positive("the thickness", thickness)?);
        let matrix = |[a, c, b]: [f64; 3], over: f64| {
            let [a, c, b] = [a, c, b].map(|entry| unit * entry / over);
            [[a, c], [c, b]]
        };
        Ok(match self.end {
            StratumEnd::None => matrix([1.0, 0.0, 1.0], 1.0),
            StratumEnd::Wall { thickness } => {
                // Over sinh^2 s, so that nothing overflows.
                let s = scaled(thickness)?;
                let (coth, part) = (1.0 / s.tanh(), s / s.sinh());
                let rest = s / s.sinh().powi(2);
                matrix([coth - rest, part * part, coth + rest], 1.0 - part * part)
            }
            StratumEnd::SlipWall { thickness, slip } => {
                let s = scaled(thickness)?;
                let twice = 2.0 * wave_number * not_negative("the slip length", slip)?;
                let (coth, part) = (1.0 / s.tanh(), s / s.sinh());
                let rest = s / s.sinh().powi(2);
                let over = 1.0 - part * part + twice * (coth - rest);
                matrix([coth - rest + twice, part * part + twice * rest, coth + rest + twice * coth * coth], over)
            }
            StratumEnd::Same { thickness } => {
                let t = 0.5 * scaled(thickness)?;
                let (tanh, rest) = (t.tanh(), t / t.cosh().powi(2));
                matrix([tanh * tanh, rest, 1.0], tanh - rest)
            }
            StratumEnd::Opposite { thickness } => {
                let t = 0.5 * scaled(thickness)?;
                let (tanh, rest) = (t.tanh(), t / t.cosh().powi(2));
                matrix([1.0, -rest, tanh * tanh], tanh + rest)
            }
        })
    }
}

impl FlatInterface {
    /// Returns the mobility M of the interface between fluids (length over stress times time): forces per length `(f
    /// sin kx, g cos kx)` on the fluid move it at `M (f, g)`, times sin kx and cos kx.
    ///
    /// # Errors
    /// Returns an error for a wave number, viscosity or thickness that is not positive and finite.
    pub fn mobility(&self, below: Stratum, above: Stratum) -> Result<[[f64; 2]; 2], InterfaceError> {
        self.resisted_mobility(below, above, [0.0; 2])
    }

    /// Returns the mobility of an interface that resists its motion: with a cortex of viscosity eta_s (force times
    /// time) and a friction xi with a substrate (force times time per length squared), as `[eta_s, xi]`. They add
    /// `eta_s k^2 + xi` and xi to the resistance along the interface and across it.
    ///
    /// # Errors
    /// Returns the errors of [`FlatInterface::mobility`]; a viscosity or friction that is negative or not finite.
    pub fn resisted_mobility(
        &self,
        below: Stratum,
        above: Stratum,
        [cortex, friction]: [f64; 2],
    ) -> Result<[[f64; 2]; 2], InterfaceError> {
        let k = positive("the wave number", self.wave_number)?;
        not_negative("the viscosity of the cortex", cortex)?;
        not_negative("the friction", friction)?;
        let ([[a, b], [_, d]], [[e, f], [_, h]]) = (below.resistance(k)?, above.resistance(k)?);
        let [xx, xy, yy] = [a + e + cortex * k * k + friction, b - f, d + h + friction];
        let determinant = xx * yy - xy * xy;
        let off = -xy / determinant;
        Ok([[yy / determinant, off], [off, xx / determinant]])
    }

    /// Returns the matrix G of the growth of a wave, `d/dt (c, h) = G (c, h)` with the concentration `c0 + c cos kx`
    /// (particles per length) and the height `h cos kx` (length): with the mobility M, zeta the activity and gamma the
    /// tension,
    ///
    /// ```text
    /// G = [[-zeta c0 k^2 Mxx - D k^2, gamma c0 k^3 Mxy], [zeta k Mxy, -gamma k^2 Myy]]
    /// ```
    ///
    /// so that between half-spaces the concentration grows at `-zeta c0 k/(2 (eta_1 + eta_2)) - D k^2`, the thin limit
    /// of the linear theory of a droplet (Cowley, (2.20), and section 5.2.2.3.1 for active boundaries).
    ///
    /// ```
    /// use active_interface::theory::{FlatInterface, Stratum, StratumEnd};
    ///
    /// let interface =
    ///     FlatInterface { wave_number: 1.0, tension: 3.0, activity: -1.0, concentration: 100.0, diffusivity: 0.1 };
    /// let fluid = Stratum { viscosity: 100.0, end: StratumEnd::None };
    /// let [[growth, _], _] = interface.growth_matrix(fluid, fluid)?;
    /// println!("{growth:.2}"); // 0.15
    /// assert!((growth - 0.15).abs() < 1e-12);
    /// # Ok::<(), active_interface::InterfaceError>(())
    /// ```
    ///
    /// # Errors
    /// Returns the errors of [`FlatInterface::mobility`]; a concentration that is not positive, a negative diffusivity,
    /// numbers that are not finite.
    pub fn growth_matrix(&self, below: Stratum, above: Stratum) -> Result<[[f64; 2]; 2], InterfaceError> {
        self.resisted_growth_matrix(below, above, [0.0; 2])
    }

    /// Returns the matrix of [`FlatInterface::growth_matrix`] of an interface that resists its motion, with the
    /// mobility of [`FlatInterface::resisted_mobility`].
    ///
    /// # Errors
    /// Returns the errors of [`FlatInterface::growth_matrix`] and [`FlatInterface::resisted_mobility`].
    pub fn resisted_growth_matrix(
        &self,
        below: Stratum,
        above: Stratum,
        resistance: [f64; 2],
    ) -> Result<[[f64; 2]; 2], InterfaceError> {
        let [[xx, xy], [_, yy]] = self.resisted_mobility(below, above, resistance)?;
        let Self { wave_number: k, tension, activity, concentration: c0, diffusivity } = *self;
        positive("the mean concentration", c0)?;
        not_negative("the diffusivity", diffusivity)?;
        finite("the tension", tension)?;
        finite("the activity", activity)?;
        let k2 = k * k;
        Ok([
            [-activity * c0 * k2 * xx - diffusivity * k2, tension * c0 * k * k2 * xy],
            [activity * k * xy, -tension * k2 * yy],
        ])
    }
}
