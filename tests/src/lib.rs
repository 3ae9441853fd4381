//! Library of the tests and studies of motile: comparisons with exact and independently computed values
//! ([`validation`]), and descriptions in other units ([`units`]).
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

pub mod units;
pub mod validation;

/// The programs of README.md and of all pages in the folders of docs, run as tests: `build.rs` finds the pages.
#[cfg(doctest)]
// Other tests read more of a fence, such as `toml scene file=channel.toml`.
#[allow(rustdoc::invalid_codeblock_attributes)]
mod pages {
    include!(concat!(env!("OUT_DIR"), "/pages.rs"));
}
