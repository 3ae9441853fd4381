//! Integrators: advance of the bodies' states by a time step.

mod chebyshev;
mod error_estimate;
mod midpoint;
mod runge_kutta;
mod spectral_radius;

pub use chebyshev::{RungeKuttaChebyshev, SpectralEstimate};
pub(crate) use error_estimate::ErrorEstimate;
pub use midpoint::Midpoint;
pub use runge_kutta::RungeKutta;

use std::any::Any;

use serde::{Deserialize, Serialize};

use crate::{SceneError, saved_state::SavedState};

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

/// The equations of motion of all bodies of a scene as an integrator sees them: `d state/dt = rate + L state` for one
/// flat list of numbers, the rate explicit, the linear part L implicit. [`crate::System`] is one.
pub trait Dynamics {
    /// Returns the length of the state.
    fn state_len(&self) -> usize;

    /// Copies the state to `state`, resizing it.
    fn write_state(&self, state: &mut Vec<f64>);

    /// Gives the bodies a state of their present lengths.
    ///
    /// # Errors
    /// Returns an error for a state that a body refuses.
    fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError>;

    /// Writes the explicit rate of change (unit of the state per time) of `state`, which the bodies take over.
    ///
    /// # Errors
    /// Returns the errors of the bodies and of the flow.
    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError>;

    /// Writes the explicit rate of change (unit of the state per time) at the present state, whose flow is computed
    /// only if it is not known yet.
    ///
    /// # Errors
    /// Returns the errors of the bodies and of the flow.
    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError>;

    /// Adds `factor * L(state) state` to `out`; see [`crate::Body::add_implicit`].
    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]);

    /// Solves `y - factor L(state) y = state` in place; see [`crate::Body::solve_implicit`].
    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]);

    /// Writes the sizes of the entries of the state; see [`crate::Body::write_scales`].
    fn write_scales(&self, scales: &mut [f64]);

    /// Returns the fastest decay that follows from the bodies' limits at the present state, without stabilisers
    /// (1/time).
    fn fastest_decay(&self) -> f64;
}

/// An integrator by its name: as data of a description.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum IntegratorKind {
    /// [`Midpoint`].
    #[default]
    Midpoint,
    /// [`RungeKuttaChebyshev`] with at most 16 stages, for stiff solids.
    RungeKuttaChebyshev,
    /// [`RungeKutta`], of fourth order, for scenes without particles.
    RungeKutta,
}

impl From<IntegratorKind> for Box<dyn Integrator> {
    fn from(kind: IntegratorKind) -> Self {
        match kind {
            IntegratorKind::Midpoint => Box::new(Midpoint::default()),
            IntegratorKind::RungeKuttaChebyshev => Box::new(RungeKuttaChebyshev::new()),
            IntegratorKind::RungeKutta => Box::new(RungeKutta::default()),
        }
    }
}

impl<I: Integrator> From<I> for Box<dyn Integrator> {
    fn from(integrator: I) -> Self {
        Box::new(integrator)
    }
}

/// Advances the state of all bodies by one step.
pub trait Integrator: Any + std::fmt::Debug + Send {
    /// Returns the name in messages and checkpoints.
    fn name(&self) -> &'static str;

    /// Advances the states of `system` by `dt` (time): reads them with [`Dynamics::write_state`], computes rates
    /// with [`Dynamics::present_rate`] and [`Dynamics::rate`], and leaves the new ones with [`Dynamics::read_state`].
    /// The clock, the calls before and after a step and the return to the last good state after an error are the
    /// scene's.
    ///
    /// # Errors
    /// Returns the errors of the bodies and of the flow.
    fn step(&mut self, system: &mut dyn Dynamics, dt: f64) -> Result<(), SceneError>;

    /// Returns the length of the interval of stability on the negative real axis: a mode that decays at the rate r is
    /// stable for `dt < interval / r`. No dimension; 2 for the midpoint rule, for which bodies estimate their limits.
    fn stability_interval(&self) -> f64;

    /// Returns true if bodies should make their stiff couplings implicit, by adding and subtracting a diffusion
    /// ([`crate::body::StepInfo::stabilised`]); an integrator with a long interval of stability does better without.
    fn stabilised(&self) -> bool {
        true
    }

    /// Returns the constant C of an error of a step of about `C dt^3 y'''`, from which it is estimated for
    /// [`crate::StepSize::Adaptive`]; `None`, the default, if the error has another form. No dimension.
    fn error_constant(&self) -> Option<f64> {
        None
    }

    /// Returns the largest error of a step, in the measure of [`crate::StepSize::Adaptive`], that runs with
    /// [`crate::StepSize::OfLimit`] accept; needs [`Integrator::error_constant`]; by default none is estimated. Use it
    /// for integrators whose stability limit is so long that it says nothing about accuracy.
    fn error_bound(&self) -> Option<f64> {
        None
    }

    /// Returns the work since the start.
    fn work(&self) -> IntegratorWork {
        IntegratorWork::default()
    }

    /// Writes what it keeps from step to step, so that it can continue bitwise identically; most keep nothing.
    fn save(&self, _record: &mut SavedState) {}

    /// Takes back what [`Integrator::save`] wrote.
    ///
    /// # Errors
    /// Returns an error for a state that another kind of integrator wrote.
    fn load(&mut self, _saved: &SavedState) -> Result<(), SceneError> {
        Ok(())
    }
}
