//! Warnings of a run: doubts about the accuracy of its states.

use super::{Observer, System};
use crate::{Hydrodynamics, Warning};

/// Bodies of a scene above which their warnings of one cause are one.
const MANY: usize = 8;

/// The warnings of a scene's runs ([`System::warnings`]): of each body and cause the worst, and when it was; in scenes
/// of more than eight bodies of each cause, with the body that it was worst of.
/// Checkpoints hold them, so that a run that goes on from one tells those from before it too.
///
/// ```no_run
/// # use motile_scene::{Hydrodynamics, Scene, SceneError};
/// # fn run<H: Hydrodynamics>(mut scene: Scene<H>) -> Result<(), SceneError> {
/// use motile_scene::{Every, Warnings};
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
        let (found, time) = (system.warnings(), system.time());
        let many = system.all_bodies().len() > MANY;
        let all = &mut system.findings.warnings;
        let known = all.len();
        for warning in found {
            let same =
                |(_, other): &&mut (f64, Warning)| other.cause == warning.cause && (many || other.body == warning.body);
            match all.iter_mut().find(same) {
                Some((_, worst)) if warning.excess <= worst.excess => {}
                Some(worst) => *worst = (time, warning),
                None => all.push((time, warning)),
            }
        }
        if self.worst != *all {
            self.worst.clone_from(all);
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
