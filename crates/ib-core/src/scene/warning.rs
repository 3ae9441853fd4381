//! What a user should know of a run though it goes on.

use std::fmt;

use super::{Observer, System};
use crate::Hydrodynamics;

/// What a user should know of a state though a run can go on from it: results may be off by more than a per cent.
#[derive(Debug, Clone, PartialEq)]
pub struct Warning {
    /// Name of the body that it is about.
    pub body: String,
    /// What is amiss, in a few words: the same for all warnings of one kind.
    pub cause: &'static str,
    /// How far beyond its limit the quantity is that it is about: 1 at the limit, more beyond.
    pub excess: f64,
    /// The value, the limit and the remedy.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.body, self.cause, self.message)
    }
}

/// The warnings of a run ([`System::warnings`]): of each body and cause the worst, and when it was.
///
/// ```no_run
/// # fn run<H: ib_core::Hydrodynamics>(mut scene: ib_core::Scene<H>) -> Result<(), ib_core::SceneError> {
/// use ib_core::{Every, Warnings};
///
/// let mut warnings = Warnings::default();
/// scene.run(5.0).observe(Every::Steps(10), &mut warnings).go()?;
/// for (time, warning) in warnings.worst() {
///     eprintln!("t = {time}: {warning}");
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, Default)]
pub struct Warnings {
    worst: Vec<(f64, Warning)>,
}

impl Warnings {
    /// The worst warning of each body and cause, in the order in which they first came, and its time (time).
    #[must_use]
    pub fn worst(&self) -> &[(f64, Warning)] {
        &self.worst
    }

    /// Looks at the present state; returns what was not warned of before.
    pub fn look<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> &[(f64, Warning)] {
        let known = self.worst.len();
        for warning in system.warnings() {
            let same = |(_, other): &&mut (f64, Warning)| other.body == warning.body && other.cause == warning.cause;
            match self.worst.iter_mut().find(same) {
                Some((_, worst)) if warning.excess <= worst.excess => {}
                Some(worst) => *worst = (system.time(), warning),
                None => self.worst.push((system.time(), warning)),
            }
        }
        &self.worst[known..]
    }
}

impl<H: Hydrodynamics> Observer<H> for Warnings {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.look(system);
        Ok(())
    }
}
