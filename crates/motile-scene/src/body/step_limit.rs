//! Bounds on the time step.

/// Origin of a bound on the time step, which decides how the bound depends on the integrator.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StepCause {
    /// A mode that decays at the rate `2/dt`: an integrator with a longer interval of stability takes longer steps.
    Decay,
    /// A mode that a stabiliser ([`crate::body::StepInfo::stabilised`]) has slowed down to what this bound allows, and
    /// that decays at the rate `2/bare` without it.
    Stabilised {
        /// The bound without the stabiliser (time).
        bare: f64,
    },
    /// Transport with the flow, for which no integrator here allows longer steps.
    Transport,
    /// A change that longer steps do not resolve: steps of a fraction of the limit and adaptive ones keep the bound,
    /// fixed ones may be longer.
    Accuracy,
}

/// A bound on the time step.
///
/// An infinite one says that no step is unstable, which is not that any step is accurate: a scene without a finite
/// bound runs with [`crate::StepSize::Fixed`] or [`crate::StepSize::Adaptive`] alone.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimit {
    /// Largest stable step of the explicit midpoint rule (time); infinity if there is none.
    pub dt: f64,
    /// Reason, as it reads after "set by".
    pub reason: &'static str,
    /// Origin.
    pub cause: StepCause,
}

impl StepLimit {
    /// Creates the bound for a mode that decays at the rate `2/dt`.
    #[must_use]
    pub fn decay(dt: f64, reason: &'static str) -> Self {
        Self { dt, reason, cause: StepCause::Decay }
    }

    /// Returns the bound (time) for an integrator with that interval of stability, with or without the bodies'
    /// stabilisers.
    #[must_use]
    pub fn for_interval(&self, interval: f64, stabilised: bool) -> f64 {
        match self.cause {
            StepCause::Decay => 0.5 * interval * self.dt,
            StepCause::Stabilised { bare } if !stabilised => 0.5 * interval * bare,
            StepCause::Stabilised { .. } | StepCause::Transport | StepCause::Accuracy => self.dt,
        }
    }

    /// Returns the rate of decay without a stabiliser (1/time); 0 for what does not decay.
    #[must_use]
    pub fn decay_rate(&self) -> f64 {
        match self.cause {
            StepCause::Decay => 2.0 / self.dt,
            StepCause::Stabilised { bare } => 2.0 / bare,
            StepCause::Transport | StepCause::Accuracy => 0.0,
        }
    }
}

#[cfg(test)]
mod tests;
