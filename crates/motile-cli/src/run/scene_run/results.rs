//! Results of a run, for its summary.

use anyhow::{Context, Result};
use motile::active_interface::ActiveDroplet;
use motile::active_interface::observables::InterfaceState;
use motile::active_interface::observables::{Convention, Observables, observe};
use motile::analysis::trajectory::{Evidence, RegimeCriteria};
use motile::base::Region;
use motile::scene::{Handle, Hydrodynamics, Scene, System, WallStress};
use motile::setup::AnyFlow;

use super::{First, SceneRun};
use crate::run::{Steadiness, Summary};
use motile_output::{BodiesCsv, SolidMeter};

/// Most bodies of a kind in a summary; the tables have all of them.
const MOST_BODIES: usize = 20;

/// Remarks on the values of a [`SolidMeter`].
const SOLIDS: [&str; 8] = [
    "at the end (length)",
    "at the end (length)",
    "between droplet and walls, at the end (length)",
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

impl SceneRun {
    /// Returns the results of a run: the final states of the first droplet, if it has particles, and of all bodies that
    /// have a table (by their names, the first twenty of a kind), the changes since the start, and the cost of the run.
    ///
    /// # Errors
    /// Returns an error for a state that cannot be measured.
    pub fn summary(&mut self) -> Result<Summary> {
        let mut summary = Summary::default();
        if let Some(first) = &self.first {
            if let Some(numbers) = first.numbers {
                summary.put("peclet", numbers.peclet, "|zeta_dmu| c0 R0/((eta_in + eta_ext) D): swims above 2");
                summary.put("excluded_volume_ratio", numbers.excluded_volume, "A/|zeta_dmu|: collapses up to 1");
                summary.put("bare_tension_ratio", numbers.bare_tension, "gamma0/(|zeta_dmu| c0)");
                summary.put("viscosity_ratio", numbers.viscosity_ratio, "eta_in/eta_ext");
            }
            first.put(&mut summary)?;
            let values = first.recorder.last_solids().into_iter().flatten();
            for ((name, value), about) in SolidMeter::NAMES.iter().zip(values).zip(SOLIDS) {
                summary.put(name, *value, about);
            }
        }
        self.put_bodies(&mut summary)?;
        // A state whose flow cannot be computed has no forces.
        let _ = self.put_forces(&mut summary);
        let gaps = [self.scene.system().minimum_gap(), self.gap.smallest().map(|(gap, _)| gap)];
        let least = gaps.into_iter().flatten().reduce(f64::min);
        summary.put("minimum_gap", least, "between bodies and to walls, over the run (length)");
        self.job.put_cost(&mut summary, &self.scene);
        summary.put("method", self.method.name(), "for the flow");
        Ok(summary)
    }

    /// Adds the final states of droplets, interfaces and other bodies by their names.
    fn put_bodies(&mut self, summary: &mut Summary) -> Result<()> {
        let scene = &mut self.scene;
        for (name, handle, start) in self.droplets.iter().take(MOST_BODIES) {
            let seen = scene.observe(*handle)?;
            let mut put = |key: &str, value: f64, about: &str| summary.put(&format!("{name}_{key}"), value, about);
            put("x", seen.centroid.x, "of its centroid, at the end (length)");
            put("y", seen.centroid.y, "of its centroid, at the end (length)");
            put("speed", seen.speed(), "of its centroid relative to the imposed flow, at the end (length per time)");
            put("deformation", seen.shape.deformation(), "D = (L - B)/(L + B) by area moments");
            let angle = seen.shape.angle.map_or(f64::NAN, f64::to_degrees);
            put("angle", angle, "of the long axis by area moments (degrees)");
            put("area_relative_change", area(scene, self.region, *handle)? / start - 1.0, "since the start");
        }
        for (name, handle, start) in self.interfaces.iter().take(MOST_BODIES) {
            let seen = scene.observe(*handle)?;
            let mut put = |key: &str, value: f64, about: &str| summary.put(&format!("{name}_{key}"), value, about);
            put("height_change", seen.height - start.height, "of its mean height, since the start (length)");
            put("length", seen.length, "over a period (length)");
            put("height_mode", seen.height_modes.amplitude(1), "amplitude of the longest wave (length)");
            let Some([most, least]) = seen.concentration_range else { continue };
            put("particle_relative_change", seen.particle_number / start.particle_number - 1.0, "since the start");
            let mean = start.particle_number / start.length;
            put("concentration_max", most / mean, "in its mean at the start");
            put("concentration_min", least / mean, "in its mean at the start");
            put("concentration_mode", seen.concentration_modes.amplitude(1) / mean, "of the longest wave");
            put("flux", seen.flux, "of particles along x (1/time)");
        }
        // All other bodies as in the last rows of their table.
        if self.bodies.is_empty() {
            return Ok(());
        }
        for row in BodiesCsv::rows(scene.system_mut())? {
            let [_, (_, index), values @ ..] = row.as_slice() else { continue };
            let name = self.bodies.iter().take(MOST_BODIES).find(|(_, body)| *body as f64 == *index);
            for (key, value) in name.iter().flat_map(|_| values) {
                summary.put(&format!("{}_{key}", name.map_or("", |(name, _)| name)), *value, "at the end");
            }
        }
        Ok(())
    }

    /// Adds the forces of the fluid on droplets and solids that a weight or a force pulls at, on all bodies together,
    /// and on the walls of a channel, with their balance.
    fn put_forces(&mut self, summary: &mut Summary) -> Result<()> {
        if self.region.is_axisymmetric() {
            return Ok(());
        }
        for (name, handle) in self.pulled.iter().take(MOST_BODIES) {
            let force = self.scene.system_mut().force_on(*handle)?;
            summary.put(&format!("{name}_force_x"), force.x, "of the fluid on it, at the end (force)");
            summary.put(&format!("{name}_force_y"), force.y, "of the fluid on it, at the end (force)");
        }
        let system = self.scene.system_mut();
        let force = system.force_on_bodies()?;
        summary.put("force_bodies_x", force.x, "of the fluid on all bodies, at the end (force)");
        summary.put("force_bodies_y", force.y, "of the fluid on all bodies, at the end (force)");
        let loads = system.obstacle_loads()?;
        for (number, load) in loads.iter().enumerate().take(MOST_BODIES) {
            let Some(load) = load else { continue };
            let about = "of the fluid on it, at the end";
            summary.put(&format!("walls.{number}_force_x"), load.force.x, about);
            summary.put(&format!("walls.{number}_force_y"), load.force.y, about);
            summary.put(
                &format!("walls.{number}_torque"),
                load.torque,
                "of the fluid on it about its centroid, at the end",
            );
        }
        let shaped = system.wall_stresses()?;
        for (number, wall) in shaped.iter().enumerate().take(MOST_BODIES) {
            if !wall.closed {
                summary.put(&format!("walls.{number}_force_x"), wall.force.x, "of the fluid on it, at the end");
            }
            let about = "largest in size along it, at the end (stress)";
            summary.put(&format!("walls.{number}_shear_max"), wall.largest(), about);
        }
        let Some(forces) = system.channel_forces()? else {
            put_balance_between(summary, system, &shaped)?;
            let domain = system.hydrodynamics().fluid_view().domain;
            if let (Some(length), Some(height), None) = (domain.periods[0], domain.periods[1], domain.walls) {
                // The mean pressure gradient of a box carries the forces in it.
                let [along, up] = system.report().mean_pressure_gradient.map(|gradient| gradient * length * height);
                summary.put("pressure_force_x", along, "of the mean pressure gradient, at the end (force)");
                summary.put("pressure_force_y", up, "of the mean pressure gradient, at the end (force)");
                // Forces that cancel leave round-off of all of them.
                let scale = system.markers().forces().iter().map(|force| force.length()).sum::<f64>();
                let left = (along + force.x).hypot(up + force.y);
                let about = "force of the pressure gradient and on the bodies, over the sum of all forces";
                summary.put("force_balance", if scale > 0.0 { left / scale } else { 0.0 }, about);
            }
            return Ok(());
        };
        summary.put("pressure_drop", forces.pressure_drop, "over a period, at the end (stress)");
        if let Some(extra) = forces.extra_pressure_drop {
            summary.put("extra_pressure_drop", extra, "over a period, because of the bodies (stress)");
        }
        let [lower, upper] = forces.on_walls;
        summary.put("force_lower", lower, "of the fluid along the lower wall, over a period (force)");
        summary.put("force_upper", upper, "of the fluid along the upper wall, over a period (force)");
        if system.hydrodynamics().friction() > 0.0 {
            summary.put("force_plates", forces.on_plates, "of the fluid on the plates that it rubs against (force)");
        }
        if let Some(traction) = system.wall_traction()? {
            // Forces that cancel leave round-off of all of them.
            let all = system.markers().forces().iter().map(|force| force.length()).sum::<f64>();
            let scale = forces.scale().max(all);
            let balance = if scale > 0.0 { forces.imbalance(traction) / scale } else { 0.0 };
            summary.put(
                "force_balance",
                balance,
                "pressure drop less forces, from the shear stress on the walls, over the sum of all forces",
            );
        }
        Ok(())
    }

    /// Returns the summary of a run of a sweep: [`SceneRun::summary`], and of a first droplet with particles all
    /// observables, those that depend on the convention also as printed by Cowley (`..._printed`), the growth rate of
    /// the speed over the last quarter (1/time), and the regime of the motion across a channel.
    ///
    /// # Errors
    /// Returns an error for a run that has not begun.
    pub fn measured(&mut self) -> Result<Summary> {
        let mut summary = self.summary()?;
        let Some(First { droplet, recorder, .. }) = &self.first else { return Ok(summary) };
        let table = recorder.table();
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
        let printed = InterfaceState::of(self.scene.system(), *droplet)
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
    /// Returns an error for a run that has not begun.
    pub fn put_regime(&self, summary: &mut Summary) -> Result<Evidence> {
        // Swimmers are about as fast as their particles diffuse over a radius, in any unit.
        let First { particles, radius, recorder, .. } = self.first()?;
        let criteria = if particles.diffusion > 0.0 {
            RegimeCriteria::scaled(*radius, particles.diffusion / radius)?
        } else {
            RegimeCriteria::default()
        };
        let report = recorder.trajectory()?.regime(&criteria)?;
        summary.put("regime", report.regime.to_string(), "across the channel");
        summary.put(
            "amplitude",
            report.evidence.amplitude,
            "largest distance from the centre line, at the end (length)",
        );
        Ok(report.evidence)
    }
}

impl First {
    /// Adds the final state of the droplet, the changes since the start, and whether it swims steadily.
    fn put(&self, summary: &mut Summary) -> Result<()> {
        let last: &Observables = &self.recorder.last().context("nothing was measured")?.observables;
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

/// Returns the area of the smooth curve through a droplet's markers (length squared), or its volume (length cubed).
pub(super) fn area(scene: &mut Scene<AnyFlow>, region: Region, droplet: Handle<ActiveDroplet>) -> Result<f64> {
    if region.is_axisymmetric() {
        return Ok(scene.observe(droplet)?.area);
    }
    Ok(scene.system_mut().deformation(droplet)?.area)
}

/// Adds the pressure drop along a channel, one or both sides of which are not straight, and the balance with the forces
/// on both sides, on obstacles and on bodies.
fn put_balance_between<H: Hydrodynamics>(
    summary: &mut Summary,
    system: &mut System<H>,
    walls: &[WallStress],
) -> Result<()> {
    let domain = system.hydrodynamics().fluid_view().domain;
    let sides: Vec<&WallStress> = walls.iter().filter(|wall| !wall.closed).collect();
    let Some(period) = domain.periods[0] else { return Ok(()) };
    // A straight side has the force on it, and the reach of its height.
    let straight = match (sides.as_slice(), domain.walls, system.opposite_wall_force()?) {
        ([_, _], ..) => None,
        ([_], Some([below, above]), Some((wall, force))) => {
            let (name, reach) = if wall == 0 { ("force_lower", -below) } else { ("force_upper", above) };
            summary.put(name, force, "of the fluid along the straight wall, over a period (force)");
            Some((force, reach))
        }
        _ => return Ok(()),
    };
    let drop = 0.0 - system.report().mean_pressure_gradient[0] * period;
    summary.put("pressure_drop", drop, "over a period, at the end (stress)");
    let (on_straight, reach) = straight.unwrap_or_default();
    let carried = drop * (reach + sides.iter().map(|wall| wall.reach).sum::<f64>());
    let pulls = system.markers().forces();
    let on_walls = on_straight + walls.iter().map(|wall| wall.force.x).sum::<f64>();
    let on_bodies = -pulls.iter().map(|force| force.x).sum::<f64>();
    // Forces that cancel leave round-off of all of them.
    let all = walls.iter().map(|wall| wall.force.x.abs()).chain(pulls.iter().map(|force| force.length()));
    let scale = all.sum::<f64>().max(carried.abs()).max(on_straight.abs());
    let balance = if scale > 0.0 { (carried - on_walls - on_bodies) / scale } else { 0.0 };
    let about = "pressure drop times the mean width less forces, over the sum of all forces";
    summary.put("force_balance", balance, about);
    Ok(())
}
