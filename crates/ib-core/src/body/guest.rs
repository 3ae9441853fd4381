//! Bodies that fill others.

use crate::{Body, Handle, Vec2};

/// A body that fills another one, its host, up to the host's markers: a gel inside a droplet, say.
///
/// It is a body of its own with a state and markers, its inner points. Besides it is shown its host, and puts forces on
/// the host's markers too. Whatever the viscosity inside its host, it lies in that fluid.
pub trait Guest {
    /// The body that it fills, which was added to the scene before it.
    fn host(&self) -> Handle<dyn Body>;

    /// Shows it the host in a new state, before anything that depends on it is asked: its markers, its forces; and at
    /// the end of a step, before and after the host's own [`Body::end_step`], then its own.
    fn see(&mut self, host: &dyn Body);

    /// Adds its forces on the fluid at the host's markers (force) to those of the host, after its own
    /// [`Body::write_forces`].
    fn add_host_forces(&self, forces: &mut [Vec2]);

    /// Shows it the velocities of the fluid at the host's markers (length per time), and the host, which has computed
    /// from them how its markers move, before [`Body::rate`].
    fn see_motion(&mut self, host: &dyn Body, velocities: &[Vec2]);

    /// Adds to the rate of change of the host's state (unit of the state per time) what comes from the guest, after its
    /// own [`Body::rate`]: what it puts there is what its own state loses. By default nothing.
    fn add_host_rate(&self, _rate: &mut [f64]) {}
}
