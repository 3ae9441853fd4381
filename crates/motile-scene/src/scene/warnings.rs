//! Warnings of a run: doubts about the accuracy of its states.

use super::{Observer, System};
use crate::{Hydrodynamics, Warning};

/// Bodies of a scene above which their warnings of one cause are one.
const MANY: usize = 8;

/// The warnings of a scene's runs ([`System::warnings`]): the worst of each body and cause, and its time. In scenes of
/// more than eight bodies, it is the worst of each cause, together with its body. Checkpoints hold them, so that a run
/// that continues from one reports the earlier warnings too.
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
    /// Returns the worst warning of each body and cause, in the order in which they first came, and its time (time).
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
