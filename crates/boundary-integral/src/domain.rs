//! The regions that interfaces can be in.

use ib_core::Domain;
use stokes_grid::Drive;

use crate::{
    BoundaryIntegralError,
    error::{finite, positive},
};

/// Unbounded fluid, at rest far away.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct FreeSpace;

/// A rectangle with periodic boundaries; the velocity, that inside the interfaces included, has zero mean.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PeriodicBox {
    periods: [f64; 2],
}

impl PeriodicBox {
    /// A box with periods `lx` and `ly` (length).
    ///
    /// # Errors
    /// A period that is not positive and finite, or one more than 20 times the other.
    pub fn new(lx: f64, ly: f64) -> Result<Self, BoundaryIntegralError> {
        positive("the period in x", lx)?;
        positive("the period in y", ly)?;
        let ratio = lx.max(ly) / lx.min(ly);
        if ratio > 20.0 {
            let name = "the ratio of the periods";
            return Err(BoundaryIntegralError::OutOfRange { name, value: ratio, least: 1.0, most: 20.0 });
        }
        Ok(Self { periods: [lx, ly] })
    }

    /// Periods in x and y (length).
    #[must_use]
    pub fn periods(&self) -> [f64; 2] {
        self.periods
    }
}

/// A channel along x, periodic in x, with no-slip walls at y = -width/2 and y = width/2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Channel {
    period: f64,
    width: f64,
    drive: Drive,
}

impl Channel {
    /// A channel with the given period and distance between the walls (length), without mean pressure gradient.
    ///
    /// # Errors
    /// Lengths that are not positive and finite.
    pub fn new(period: f64, width: f64) -> Result<Self, BoundaryIntegralError> {
        positive("the period", period)?;
        positive("the width", width)?;
        Ok(Self { period, width, drive: Drive::default() })
    }

    /// The same channel with another drive.
    ///
    /// # Errors
    /// A drive that is not finite.
    pub fn with_drive(self, drive: Drive) -> Result<Self, BoundaryIntegralError> {
        if let Drive::Gradient(value) | Drive::Flux(value) = drive {
            finite("the drive", value)?;
        }
        Ok(Self { drive, ..self })
    }

    /// Period along x (length).
    #[must_use]
    pub fn period(&self) -> f64 {
        self.period
    }

    /// Distance between the walls (length).
    #[must_use]
    pub fn width(&self) -> f64 {
        self.width
    }

    /// What drives the fluid.
    #[must_use]
    pub fn drive(&self) -> Drive {
        self.drive
    }
}

/// A region for which [`crate::BoundaryIntegral`] knows the Green's function: [`FreeSpace`], [`PeriodicBox`] or
/// [`Channel`].
pub trait FluidDomain: sealed::Region + Copy + std::fmt::Debug + Send + 'static {
    /// The region as bodies see it, with its middle at the origin.
    fn region(&self) -> Domain;
}

impl FluidDomain for FreeSpace {
    fn region(&self) -> Domain {
        Domain { origin: [0.0; 2], periods: [None; 2], walls: None }
    }
}

impl FluidDomain for PeriodicBox {
    fn region(&self) -> Domain {
        Domain { origin: self.periods.map(|period| -0.5 * period), periods: self.periods.map(Some), walls: None }
    }
}

impl FluidDomain for Channel {
    fn region(&self) -> Domain {
        let half = 0.5 * self.width;
        Domain { origin: [-0.5 * self.period, -half], periods: [Some(self.period), None], walls: Some([-half, half]) }
    }
}

pub(crate) mod sealed {
    use super::{Channel, FreeSpace, PeriodicBox};

    /// One of the regions.
    #[derive(Debug, Clone, Copy)]
    pub enum Kind {
        Free(FreeSpace),
        Periodic(PeriodicBox),
        Channel(Channel),
    }

    pub trait Region {
        fn kind(&self) -> Kind;
    }

    impl Region for FreeSpace {
        fn kind(&self) -> Kind {
            Kind::Free(*self)
        }
    }

    impl Region for PeriodicBox {
        fn kind(&self) -> Kind {
            Kind::Periodic(*self)
        }
    }

    impl Region for Channel {
        fn kind(&self) -> Kind {
            Kind::Channel(*self)
        }
    }
}
