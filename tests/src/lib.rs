//! What the tests and studies of motile share: comparisons with exact and independently computed values
//! ([`validation`]), and scenes that are hard to compute ([`hard_cases`]).

pub mod hard_cases;
pub mod validation;
