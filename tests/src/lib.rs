//! Library of the tests and studies of motile: comparisons with exact and independently computed values
//! ([`validation`]), scenes that are hard to compute
//! ([`hard_cases`]), and descriptions in other units ([`units`]).
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

pub mod hard_cases;
pub mod units;
pub mod validation;

/// The programs of the documents, run as tests.
#[cfg(doctest)]
mod documents {
    #[doc = include_str!("../../README.md")]
    struct Readme;
    #[doc = include_str!("../../docs/architecture.md")]
    struct Architecture;
    #[doc = include_str!("../../docs/guide.md")]
    struct Guide;
    #[doc = include_str!("../../docs/elastic.md")]
    struct Elastic;
}
