//! Discrete Fourier transforms of double precision numbers, and Fourier series of closed curves.
//!
//! Every transform is a plan for one length: it is made once, owns its scratch, and allocates nothing per call. Nothing
//! here is generic, so that the algorithms behind the plans (rustfft, realfft) are compiled in this crate
//! alone and not again in each crate that transforms.
//!
//! | plan | transform |
//! |---|---|
//! | [`ComplexTransform`] | complex numbers, in place |
//! | [`RealTransform`] | real numbers to half of their spectrum and back |
//!
//! On them stand Fourier series through equally spaced samples of periodic functions, such as the points of a closed
//! curve ([`PeriodicSeries`]).
//!
//! Every length is correct, odd and prime ones included; lengths with no prime factors but 2, 3, 5, 7 and 11 are fast.

mod complex;
mod real;
mod series;
pub mod spectrum;

pub use complex::ComplexTransform;
pub use input_checks::InputError;
pub use real::RealTransform;
pub use series::PeriodicSeries;
