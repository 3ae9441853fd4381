//! Branches of steady states along a parameter, their points and special points.

use std::fmt;

use crate::{Critical, Parameter, Spectrum, SteadyError, SteadyState};

/// Kind of a special point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum SpecialKind {
    /// Fold: the branch turns back in the parameter.
    Fold,
    /// Branch point: another branch of steady states crosses.
    BranchPoint,
    /// Hopf point: a branch of limit cycles begins.
    Hopf,
}

impl SpecialKind {
    /// Returns the name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::BranchPoint => "branch point",
            Self::Hopf => "Hopf point",
        }
    }
}

/// Special point of a branch: a fold, a branch point or a Hopf point.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct SpecialPoint {
    /// Kind of the point.
    pub kind: SpecialKind,
    /// Value of the branch's parameter.
    pub value: f64,
    /// State and its critical mode.
    pub critical: Critical,
}

impl SpecialPoint {
    /// Creates a special point of a branch along a parameter; its value is not a number if the description lacks that.
    #[must_use]
    pub fn new(kind: SpecialKind, critical: Critical, parameter: Parameter) -> Self {
        Self { kind, value: parameter.get(critical.state.setup()).unwrap_or(f64::NAN), critical }
    }
}

/// Point of a branch.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct BranchPoint {
    /// Value of the parameter.
    pub value: f64,
    /// Steady state.
    pub state: SteadyState,
    /// Spectrum of the state, which says whether it is stable.
    pub spectrum: Spectrum,
}

/// Reason why a branch ends.
#[derive(Debug)]
#[non_exhaustive]
pub enum BranchEnd {
    /// End of the range of the parameter, at which the last point lies.
    Range,
    /// Droplet at rest, where a branch of mirror-symmetric swimmers meets itself: beyond are the same droplets,
    /// swimming the other way.
    Rest,
    /// Largest number of points reached.
    MostPoints,
    /// Stop asked for by the caller.
    Stopped,
    /// Failure to follow the branch any further.
    Failed(SteadyError),
}

impl fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range => f.write_str("end of the range"),
            Self::Rest => f.write_str("the droplet is at rest"),
            Self::MostPoints => f.write_str("the largest number of points"),
            Self::Stopped => f.write_str("stopped"),
            Self::Failed(error) => error.fmt(f),
        }
    }
}

/// Branch of steady states along a parameter.
#[derive(Debug)]
#[non_exhaustive]
pub struct Branch {
    /// Parameter that changes along the branch.
    pub parameter: Parameter,
    /// Points in the order in which they were found.
    pub points: Vec<BranchPoint>,
    /// Special points in the order of the branch.
    pub special: Vec<SpecialPoint>,
    /// Reason why the branch ends.
    pub end: BranchEnd,
}
