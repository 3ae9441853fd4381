//! Points of the plane, Fourier transforms and series, checks of input, and the words in which flows are described:
//! what the crates of motile share.
//!
//! ```
//! use motile_base::{PeriodicSeries, Vec2};
//!
//! // The derivative of a circle along its angle, from twelve points.
//! let circle: Vec<Vec2> = (0..12).map(|k| Vec2::from_angle(std::f64::consts::TAU * k as f64 / 12.0)).collect();
//! let mut series = PeriodicSeries::new(12)?;
//! series.analyse_vectors(&circle)?;
//! series.differentiate();
//! let mut slopes = [Vec2::ZERO; 12];
//! series.write_vectors(&mut slopes)?;
//! assert!(slopes[1].distance(circle[1].perp()) < 1e-14);
//! # Ok::<(), motile_base::InputError>(())
//! ```
//!
//! # Transforms
//!
//! Every transform is a plan for one length: it is made once, owns its scratch, and allocates nothing per call. Nothing
//! here is generic, so that the algorithms behind the plans (rustfft, realfft) are compiled in this crate
//! alone and not again in each crate that transforms.
//!
//! | plan | transform |
//! |---|---|
//! | [`ComplexTransform`] | complex numbers, in place |
//! | [`RealTransform`] | real numbers to half of their spectrum and back |
//! | [`CosineTransform`] | real numbers in cells, DCT-II and DCT-III |
//! | [`SineTransform`] | real numbers in cells, DST-II and DST-III |
//! | [`NodeSineTransform`] | real numbers at nodes, DST-I |
//!
//! On them stand Fourier series through equally spaced samples of periodic functions, such as the points of a closed
//! curve ([`PeriodicSeries`]), the forces of energies of such curves ([`CurveForces`]) and elastic membranes along them
//! ([`Membrane`]). Every length is correct, odd and prime ones included; lengths with no prime factors but 2, 3, 5, 7
//! and 11 are fast.
//!
//! # Input
//!
//! Constructors check the numbers and lists they are given by [`positive`], [`within`], [`same_length`] and the like;
//! [`InputError`] names the quantity, its value and the remedy. [`debug_as_explanation!`] makes errors print as
//! sentences where `main` returns them.
//!
//! ```
//! use motile_base::positive;
//!
//! assert_eq!(positive("the radius", 2.0), Ok(2.0));
//! let error = positive("the radius", -1.0).unwrap_err();
//! assert_eq!(error.to_string(), "the radius is -1. Use a positive finite number");
//! ```

pub mod boxes;
mod complex;
mod curve_forces;
mod drive;
mod explanation;
mod flow;
mod forwarded;
mod imposed;
mod input;
mod membrane;
pub mod polygon;
mod quadrature;
mod real;
mod refusal;
mod region;
mod series;
mod sine_cosine;
mod spectrum;
mod sums;
mod transform;
mod vec2;

pub use complex::ComplexTransform;
pub use curve_forces::CurveForces;
pub use drive::Drive;
pub use flow::{FlowSample, SolveReport};
pub use imposed::ImposedFlow;
pub use input::{InputError, finite, not_negative, positive, same_length, within};
pub use membrane::{BendingMeasure, Membrane};
pub use real::RealTransform;
pub use refusal::Refusal;
pub use region::{Region, TubeShape};
pub use series::PeriodicSeries;
pub use sine_cosine::{CosineTransform, NodeSineTransform, SineTransform};
pub use vec2::Vec2;

/// Shared with the other crates of motile. It is not part of the interface and may change at any time.
#[doc(hidden)]
pub mod internal {
    pub use crate::explanation::{decimals, explanation, given, place, told, told_apart};
    pub use crate::input::{all_finite, all_points_finite, at_least};
    pub use crate::quadrature::gauss_legendre;
    pub use crate::refusal::Refuse;
    pub use crate::sums::{dot, sum, widely};

    /// Spectra of real numbers.
    pub mod spectrum {
        pub use crate::spectrum::*;
    }
}

/// Most numbers of a transform: a plan for as many takes some gigabytes.
const MOST_NUMBERS: usize = 1 << 26;

/// Refuses a length that cannot be planned for, before anything is allocated.
fn check_length(len: usize) -> Result<usize, InputError> {
    within("the length of a Fourier transform", len as f64, 0.0, MOST_NUMBERS as f64)?;
    Ok(len)
}
