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
//! ```
//! use fourier::PeriodicSeries;
//!
//! // The derivative of a circle along its angle, from twelve points.
//! let angle = |k: usize| std::f64::consts::TAU * k as f64 / 12.0;
//! let circle: Vec<[f64; 2]> = (0..12).map(|k| [angle(k).cos(), angle(k).sin()]).collect();
//! let mut series = PeriodicSeries::new(12)?;
//! series.analyse_vectors(&circle)?;
//! series.differentiate();
//! let mut slopes = [[0.0; 2]; 12];
//! series.write_vectors(&mut slopes)?;
//! assert!((slopes[1][0] + angle(1).sin()).abs() < 1e-14);
//! # Ok::<(), fourier::InputError>(())
//! ```
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

/// Most numbers of a transform: a plan for as many takes some gigabytes.
const MOST_NUMBERS: usize = 1 << 26;

/// Refuses a length that cannot be planned for, before anything is allocated.
fn check_length(len: usize) -> Result<usize, InputError> {
    input_checks::within("the length of a Fourier transform", len as f64, 0.0, MOST_NUMBERS as f64)?;
    Ok(len)
}
