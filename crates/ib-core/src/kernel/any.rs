//! A kernel chosen at run time.

use motile_scene::FlowError;
use serde::{Deserialize, Serialize};

use super::{BSpline, Gaussian6, Kernel, MAX_SUPPORT, Peskin4, Pieces, Role, Roma3};

/// A kernel chosen at run time; parsed from its name (`peskin4`, `roma3`, `gaussian6`, `bspline3` to `bspline6`).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
#[doc(alias("delta function", "B-spline"))]
pub enum AnyKernel {
    /// [`Peskin4`].
    Peskin4,
    /// [`Roma3`].
    Roma3,
    /// [`Gaussian6`].
    Gaussian6,
    /// [`BSpline<3>`]: quadratic/linear.
    BSpline3,
    /// [`BSpline<4>`]: cubic/quadratic, the default.
    BSpline4,
    /// [`BSpline<5>`]: quartic/cubic.
    BSpline5,
    /// [`BSpline<6>`]: quintic/quartic.
    BSpline6,
}

impl AnyKernel {
    /// All of them.
    pub const ALL: [Self; 7] =
        [Self::Peskin4, Self::Roma3, Self::Gaussian6, Self::BSpline3, Self::BSpline4, Self::BSpline5, Self::BSpline6];
}

macro_rules! dispatch {
    ($self:ident, $method:ident ( $($argument:expr),* )) => {
        match $self {
            AnyKernel::Peskin4 => Peskin4.$method($($argument),*),
            AnyKernel::Roma3 => Roma3.$method($($argument),*),
            AnyKernel::Gaussian6 => Gaussian6.$method($($argument),*),
            AnyKernel::BSpline3 => BSpline::<3>.$method($($argument),*),
            AnyKernel::BSpline4 => BSpline::<4>.$method($($argument),*),
            AnyKernel::BSpline5 => BSpline::<5>.$method($($argument),*),
            AnyKernel::BSpline6 => BSpline::<6>.$method($($argument),*),
        }
    };
}

impl Kernel for AnyKernel {
    fn name(&self) -> &'static str {
        dispatch!(self, name())
    }

    fn support(&self, role: Role) -> usize {
        dispatch!(self, support(role))
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        dispatch!(self, weights(role, r, weights))
    }

    fn pieces(&self) -> Option<&'static Pieces> {
        dispatch!(self, pieces())
    }

    fn value(&self, role: Role, r: f64) -> f64 {
        dispatch!(self, value(role, r))
    }

    fn transform(&self, role: Role, theta: f64) -> f64 {
        dispatch!(self, transform(role, theta))
    }
}

impl std::str::FromStr for AnyKernel {
    type Err = FlowError;

    fn from_str(name: &str) -> Result<Self, Self::Err> {
        Self::ALL.into_iter().find(|kernel| kernel.name() == name).ok_or_else(|| {
            FlowError::unsupported(
                "a kernel of that name",
                "Use peskin4, roma3, gaussian6, bspline3, bspline4, bspline5 or bspline6",
            )
        })
    }
}
