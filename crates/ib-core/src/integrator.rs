//! Time steps.

mod chebyshev;
mod error_estimate;
mod midpoint;
mod spectral_radius;

pub use chebyshev::{RungeKuttaChebyshev, SpectralEstimate};
pub(crate) use error_estimate::ErrorEstimate;
pub use midpoint::Midpoint;

use crate::{Hydrodynamics, SceneError, System, checkpoint::SavedState};

/// Work of an integrator since the start.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct IntegratorWork {
    /// Stages of all steps, each with one evaluation of the flow.
    pub stages: usize,
    /// Most stages of a step.
    pub most_stages: usize,
    /// Evaluations spent on estimates of the spectral radius.
    pub estimates: usize,
}

/// Advances the state of all bodies by one step.
pub trait Integrator: std::fmt::Debug + Send {
    /// What it is called in messages and checkpoints.
    fn name(&self) -> &'static str;

    /// Advances the states of `system` by `dt` (time): reads them with [`System::write_state`], computes rates with
    /// [`System::present_rate`] and [`System::rate`], and leaves the new ones with [`System::read_state`]. The clock,
    /// the calls before and after a step and the return to the last good state after an error are the scene's.
    ///
    /// # Errors
    /// Those of the bodies and of the flow.
    fn step<H: Hydrodynamics>(&mut self, system: &mut System<H>, dt: f64) -> Result<(), SceneError>;

    /// Length of the interval of stability on the negative real axis: a mode that decays at the rate r is stable for
    /// `dt < interval / r`. No dimension; 2 for the midpoint rule, for which bodies estimate their limits.
    fn stability_interval(&self) -> f64;

    /// Whether bodies are to make their stiff couplings implicit by adding and subtracting a diffusion
    /// ([`crate::body::StepInfo::stabilised`]); an integrator with a long interval of stability does better without.
    fn stabilised(&self) -> bool {
        true
    }

    /// The constant C of an error of a step of about `C dt^3 y'''`, from which it is estimated for
    /// [`crate::StepSize::Adaptive`]; `None`, the default, where the error is of another form. No dimension.
    fn error_constant(&self) -> Option<f64> {
        None
    }

    /// Largest error of a step, in the measure of [`crate::StepSize::Adaptive`], that runs with
    /// [`crate::StepSize::OfLimit`] accept; needs [`Integrator::error_constant`]; by default none is estimated. For
    /// integrators whose stability limit is so long that it says nothing of accuracy.
    fn error_bound(&self) -> Option<f64> {
        None
    }

    /// Work since the start.
    fn work(&self) -> IntegratorWork {
        IntegratorWork::default()
    }

    /// Writes what it keeps from step to step, so that it can go on bitwise identically; most keep nothing.
    fn save(&self, _record: &mut SavedState) {}

    /// Takes back what [`Integrator::save`] wrote.
    ///
    /// # Errors
    /// A state that another kind of integrator wrote.
    fn load(&mut self, _saved: &SavedState) -> Result<(), SceneError> {
        Ok(())
    }
}
