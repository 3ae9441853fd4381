//! Numbers and lengths of the steps of a scene, and what set them.

use serde::{Deserialize, Serialize};

/// A reason for the length of steps, and the number of steps that it applied to.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Limiting {
    /// The reason, as it reads after "set by".
    pub reason: String,
    /// The body; empty if the reason is not a body's.
    pub body: String,
    /// Steps that it set the length of.
    pub steps: usize,
}

/// The steps of a scene's runs.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[non_exhaustive]
pub struct StepReport {
    /// Steps taken.
    pub steps: usize,
    /// Steps rejected because their error was above the tolerance.
    pub rejections: usize,
    /// Steps rejected because something went wrong in them, and retried with a shorter one.
    pub failures: usize,
    /// The shortest step, except for steps that end a run or end at an exact report, which may be of any length (time;
    /// infinite before any).
    pub shortest: f64,
    /// The longest step (time).
    pub longest: f64,
    /// Largest estimated error of a step that was taken, in the measure of
    /// [`StepSize::Adaptive`](crate::StepSize::Adaptive) (no dimension); 0 if none was estimated.
    pub largest_error: f64,
    /// Reasons for the lengths, in the order of first occurrence.
    pub limiting: Vec<Limiting>,
}

impl StepReport {
    /// Returns the reason for the length of most steps.
    #[must_use]
    pub fn most_limiting(&self) -> Option<&Limiting> {
        self.limiting.iter().max_by_key(|limiting| limiting.steps)
    }

    pub(crate) fn count(&mut self, dt: f64, shortened: bool, reason: &str, body: &str) {
        if self.steps == 0 {
            self.shortest = f64::INFINITY;
        }
        self.steps += 1;
        self.longest = self.longest.max(dt);
        if !shortened {
            self.shortest = self.shortest.min(dt);
        }
        match self.limiting.iter_mut().find(|limiting| limiting.reason == reason && limiting.body == body) {
            Some(limiting) => limiting.steps += 1,
            None => self.limiting.push(Limiting { reason: reason.to_owned(), body: body.to_owned(), steps: 1 }),
        }
    }
}
