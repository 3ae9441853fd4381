//! Measures of membranes.

use std::f64::consts::PI;

use crate::ActiveInterface;

/// Measures of a membrane in the plane: a closed interface that bends or does not stretch.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
#[doc(alias("vesicle", "reduced volume"))]
pub struct MembraneMeasures {
    /// Reduced area `4 pi A/L^2`, of the area A and the length L: 1 for a circle, less for every other shape (no
    /// dimension).
    pub reduced_area: f64,
    /// Mean over the length of the tension T in the force `d(T tau)/ds` of the membrane (force), without the bending.
    pub mean_tension: f64,
}

impl MembraneMeasures {
    /// Returns the measures of an interface; `None` for another interface than a closed membrane.
    pub(crate) fn of(interface: &ActiveInterface) -> Option<Self> {
        let closed = interface.advance() == 0.0 && !interface.is_axisymmetric();
        let membrane = interface.law.bending.is_some() || interface.law.cortex.inextensible;
        if !(closed && membrane) {
            return None;
        }
        let (length, area) = (interface.geometry().total_weight(), interface.smooth_area());
        let sizes = interface.element_sizes();
        let whole: f64 = sizes.iter().sum();
        let mean_tension = sizes.iter().zip(interface.tensions()).map(|(size, tension)| size * tension).sum::<f64>();
        Some(Self { reduced_area: 4.0 * PI * area / (length * length), mean_tension: mean_tension / whole })
    }
}
