//! Formulas that Cowley fitted to simulations, in units of the droplet's radius R0 and at c0 = 100/R0.
//!
//! These are fits and no theory: the book (`docs/book`, figures 3.1, 3.2, 3.12 and 4.4) shows how far converged results
//! bear them out.

use motile_base::{finite, not_negative, positive};

use crate::InterfaceError;

/// Length in the exponentials of (3.7) and (3.9) (R0).
const LENGTH: f64 = 10.0;

/// Returns the speed (R0 per time) of a droplet as wide as its channel, from the `length` l of the channel (R0), Cowley
/// (3.7):
///
/// `|v| = 10 |zeta dmu|/eta exp(-l/10) + |zeta dmu|/eta`
///
/// ```
/// # use active_interface::theory::fits;
/// let speed = fits::speed_over_length(-4.0, 100.0, 12.0)?;
/// assert!((speed - 0.16048).abs() < 1e-5);
/// # Ok::<(), active_interface::InterfaceError>(())
/// ```
///
/// # Errors
/// Returns an error for an activity that is not finite, a viscosity that is not positive and finite, a negative length.
pub fn speed_over_length(activity: f64, viscosity: f64, length: f64) -> Result<f64, InterfaceError> {
    let unit = finite("the activity", activity)?.abs() / positive("the viscosity", viscosity)?;
    let decay = (-not_negative("the length of the channel", length)? / LENGTH).exp();
    Ok(LENGTH * unit * decay + unit)
}

/// Returns the amplitude of a droplet's swings across a channel (R0), from the channel's `[length, width]` and the
/// droplet's half height b, `half_height` (all in R0), Cowley (3.9):
///
/// `A = alpha (w/2 - b) (1 - exp(-(l - l0)/10))`
///
/// from the length l0, `onset`, on; zero before. Cowley has alpha = 0.6 and l0 = 18.
///
/// # Errors
/// Returns an error for lengths that are negative or not finite, a droplet higher than the channel, an alpha that is
/// not finite.
pub fn amplitude_over_length(
    [length, width]: [f64; 2],
    half_height: f64,
    alpha: f64,
    onset: f64,
) -> Result<f64, InterfaceError> {
    let free = 0.5 * not_negative("the width of the channel", width)? - not_negative("the half height", half_height)?;
    let room = not_negative("half the width less the half height", free)?;
    let beyond = not_negative("the length of the channel", length)? - not_negative("the onset", onset)?;
    Ok(finite("alpha", alpha)? * room * (1.0 - (-beyond.max(0.0) / LENGTH).exp()))
}

/// Returns the speed of a droplet between elastic walls of the spring constant k, between its speed in unbounded fluid
/// and that between rigid walls (all three length per time), Cowley (4.3):
///
/// `|v| = (|v|_unconfined - |v|_rigid) exp(-k/b) + |v|_rigid`
///
/// with a fitted width b in the unit of k.
///
/// # Errors
/// Returns an error for speeds that are not finite, a negative k, or a b that is not positive and finite.
pub fn speed_over_stiffness(unconfined: f64, rigid: f64, k: f64, b: f64) -> Result<f64, InterfaceError> {
    let (unconfined, rigid) = (finite("the speed in unbounded fluid", unconfined)?, finite("the speed", rigid)?);
    let decay = (-not_negative("the spring constant", k)? / positive("the width of the exponential", b)?).exp();
    Ok(finite("the speed", (unconfined - rigid) * decay + rigid)?)
}
