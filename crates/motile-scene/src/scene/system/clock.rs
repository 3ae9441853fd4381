//! The time of a scene, and its steps.

/// Time and steps since the start of a scene.
#[derive(Debug, Clone, Copy)]
pub(super) struct Clock {
    /// Time (time).
    pub(super) time: f64,
    pub(super) steps: usize,
    /// The next step is the first since bodies were put in or changed: no step before it tells how fast they move,
    /// which bounds its length.
    pub(super) first_step: bool,
}

impl Clock {
    /// Time 0, before the first step.
    pub(super) fn new() -> Self {
        Self { time: 0.0, steps: 0, first_step: true }
    }

    /// Counts a step of `dt` (time).
    pub(super) fn advance(&mut self, dt: f64) {
        self.time += dt;
        self.steps += 1;
    }
}
