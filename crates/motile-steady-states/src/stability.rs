//! Verdicts on stability, no finer than the error of the rates that they rest on.

/// Stability of a steady state or of a limit cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stability {
    /// All disturbances decay, by more than the error of their rates.
    Stable,
    /// A disturbance grows, by more than the error of its rate.
    Unstable,
    /// The largest growth rate is zero within its error: more nodes may decide.
    Undecided,
}

impl Stability {
    /// Creates a verdict on a largest growth rate with an error (1/time, or both without a dimension). A rate or an
    /// error that is not a number decides nothing.
    ///
    /// ```
    /// use motile_steady_states::Stability;
    ///
    /// assert_eq!(Stability::of_rate(-0.02, 0.001), Stability::Stable);
    /// assert_eq!(Stability::of_rate(-0.0006, 0.067), Stability::Undecided);
    /// ```
    #[must_use]
    pub fn of_rate(rate: f64, error: f64) -> Self {
        if rate < -error {
            Self::Stable
        } else if rate > error {
            Self::Unstable
        } else {
            Self::Undecided
        }
    }

    /// Creates a verdict on a whole of which these are the parts: one that is unstable decides, one that is undecided
    /// leaves the others undecided.
    #[must_use]
    pub fn of_parts(parts: impl IntoIterator<Item = Self>) -> Self {
        let worse = |a: Self, b: Self| match (a, b) {
            (Self::Unstable, _) | (_, Self::Unstable) => Self::Unstable,
            (Self::Undecided, _) | (_, Self::Undecided) => Self::Undecided,
            (Self::Stable, Self::Stable) => Self::Stable,
        };
        parts.into_iter().fold(Self::Stable, worse)
    }

    /// Returns true or false if it is decided.
    #[must_use]
    pub fn decided(self) -> Option<bool> {
        match self {
            Self::Stable => Some(true),
            Self::Unstable => Some(false),
            Self::Undecided => None,
        }
    }

    /// Returns the name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Stable => "stable",
            Self::Unstable => "unstable",
            Self::Undecided => "undecided",
        }
    }
}

#[cfg(test)]
mod tests;
