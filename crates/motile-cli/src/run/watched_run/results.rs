//! Results of a run with a droplet, for its summary.

use anyhow::{Context, Result};
use motile::active_interface::observables::InterfaceState;
use motile::active_interface::observables::{Convention, Observables, observe};
use motile::analysis::trajectory::{Evidence, RegimeCriteria};

use super::WatchedRun;
use crate::run::{Steadiness, Summary};
use motile_output::SolidMeter;

/// Remarks on the values of a [`SolidMeter`].
const SOLIDS: [&str; 8] = [
    "in the end (length)",
    "in the end (length)",
    "between droplet and walls, in the end (length)",
    "of the walls, in any direction (length)",
    "across their surface (length)",
    "mean displacement of a wall along the channel (length)",
    "of the walls",
    "deformed over reference area of a triangle",
];

/// Observables that depend on the convention.
const CONVENTIONAL: [&str; 10] = [
    "stresslet_xx",
    "stresslet_xx_laboratory",
    "stresslet_xy_laboratory",
    "s_xxx",
    "s_xyy",
    "n_xyy",
    "n_yxy",
    "n_yyx",
    "f_yxy",
    "f_yyx",
];

impl WatchedRun {
    /// Results that all scenes with a droplet have: its final state, the change since the start, the cost of the run.
    ///
    /// # Errors
    /// A run that has not begun.
    pub fn summary(&self) -> Result<Summary> {
        let mut summary = Summary::default();
        if let Some(numbers) = self.numbers {
            summary.put("peclet", numbers.peclet, "|zeta_dmu| c0 R0/((eta_in + eta_ext) D): swims above 2");
            summary.put("excluded_volume_ratio", numbers.excluded_volume, "A/|zeta_dmu|: collapses up to 1");
            summary.put("bare_tension_ratio", numbers.bare_tension, "gamma0/(|zeta_dmu| c0)");
            summary.put("viscosity_ratio", numbers.viscosity_ratio, "eta_in/eta_ext");
        }
        self.put_droplet(&mut summary, &self.last()?.observables)?;
        self.job.put_cost(&mut summary, &self.scene);
        summary.put("method", self.method.name(), "for the flow");
        if let Some(values) = self.recorder.last_solids() {
            for ((name, value), about) in SolidMeter::NAMES.iter().zip(values).zip(SOLIDS) {
                summary.put(name, *value, about);
            }
            let least = self.gap.smallest().map(|(gap, _)| gap);
            summary.put("minimum_gap", least, "between droplet and walls, over the run (length)");
        }
        Ok(summary)
    }

    /// Summary of a run of a sweep: [`WatchedRun::summary`], all observables, those that depend on the convention also
    /// as printed by Cowley (`..._printed`), the growth rate of the speed over the last quarter (1/time), and the
    /// regime of the motion across a channel.
    ///
    /// # Errors
    /// A run that has not begun.
    pub fn measured(&self) -> Result<Summary> {
        let mut summary = self.summary()?;
        let table = self.recorder.table();
        let speeds = table.curve("time", "speed")?;
        let end = self.scene.time();
        if let Some((time, speed)) = speeds.iter().find(|(time, _)| *time >= 0.75 * end) {
            let (_, last) = speeds[speeds.len() - 1];
            summary.put("speed_rate", (last / speed).ln() / (end - time), "growth rate of the speed, late");
        }
        for (name, value) in self.last()?.observables.entries() {
            if !summary.values().contains_key(name) {
                summary.put(name, value, "");
            }
        }
        let printed = InterfaceState::of(self.scene.system(), self.droplet)
            .ok()
            .and_then(|state| observe(&state, Convention::AsPrinted).ok());
        let entries = printed.map(|printed| printed.entries()).unwrap_or_default();
        for (name, value) in entries.into_iter().filter(|(name, _)| CONVENTIONAL.contains(name)) {
            summary.put(&format!("{name}_printed"), value, "");
        }
        let late = table.curve("time", "stresslet_xx")?.into_iter().filter(|(time, _)| *time >= 0.5 * end);
        let (count, sum) = late.fold((0.0, 0.0), |(count, sum), (_, value)| (count + 1.0, sum + value));
        summary.put("stresslet_xx_mean", sum / count, "over the second half");
        let furthest = table.curve("time", "x")?.iter().map(|(_, x)| *x).fold(f64::NAN, f64::max);
        summary.put("furthest_x", furthest, "largest x of the centroid over the run (length)");
        summary.put("pressure_gradient", self.last()?.pressure_gradient, "mean along the channel");
        if let Ok(evidence) = self.put_regime(&mut summary) {
            summary.put("period", evidence.period.map(|period| period.value), "");
        }
        Ok(summary)
    }

    /// Adds the regime of the motion across the channel and its amplitude (length) to a summary.
    ///
    /// # Errors
    /// A run that has not begun.
    pub fn put_regime(&self, summary: &mut Summary) -> Result<Evidence> {
        // Swimmers are about as fast as their particles diffuse over a radius, in any unit.
        let diffusion = self.particles.diffusion;
        let criteria = if diffusion > 0.0 {
            RegimeCriteria::scaled(self.radius, diffusion / self.radius)?
        } else {
            RegimeCriteria::default()
        };
        let report = self.recorder.trajectory()?.regime(&criteria)?;
        summary.put("regime", report.regime.to_string(), "across the channel");
        summary.put(
            "amplitude",
            report.evidence.amplitude,
            "largest distance from the centre line, in the end (length)",
        );
        Ok(report.evidence)
    }

    fn put_droplet(&self, summary: &mut Summary, last: &Observables) -> Result<()> {
        let value = |name: &str| last.get(name).unwrap_or(f64::NAN);
        for (name, about) in [
            ("speed", "of the centroid (length per time)"),
            ("heading_degrees", "direction of motion, from x"),
            ("deformation", "D = (L - B)/(L + B) by area moments"),
            ("inclination_degrees", "of the long axis by area moments, from x"),
            ("aspect_ratio_moments", "along over across the motion, from area moments; at rest x over y"),
            ("aspect_ratio_ellipse", "the same of a fitted ellipse"),
            ("stresslet_xx", "axes along the motion; below 0 a puller"),
            ("stresslet_xx_laboratory", "axes x and y"),
            ("stresslet_xy_laboratory", "axes x and y"),
            ("beta", "B2/|B1| in the droplet's frame"),
            ("b1", "squirmer coefficient (length per time)"),
            ("b2", "squirmer coefficient (length per time)"),
            ("active_fraction", "of the perimeter"),
            ("active_curvature", "signed, of the active region (1/length)"),
        ] {
            summary.put(name, value(name), about);
        }
        for name in ["concentration_max", "concentration_min"] {
            summary.put(name, value(name) / self.particles.concentration, "in c0");
        }
        summary.put("perimeter", last.perimeter, "(length)");
        let table = self.recorder.table();
        for (name, column, value) in [
            ("area_relative_change", "area", last.area),
            ("particle_relative_change", "particle_number", last.particle_number),
        ] {
            // The start of a run that was resumed is in its table alone.
            let (_, start) = *table.curve("time", column)?.first().context("nothing was measured")?;
            summary.put(name, value / start - 1.0, "since the start");
        }
        let speeds = table.curve("time", "speed")?;
        let steady = Steadiness::of(&speeds, self.particles.diffusion, self.radius);
        summary.put("steady", steady.json(), steady.criterion());
        Ok(())
    }
}
