//! Errors of swimmers.

use std::sync::OnceLock;

use anyhow::{Result, anyhow};
use motile::active_interface::ActiveDroplet;
use motile::base::Drive;
use motile::base::Region;
use motile::scene::{StepSize, System};
use motile::setup::{AnyFlow, DropletSetup, ExcludedVolume, Particles, Setup};
use motile_tests::validation::Reference;

use crate::work_precision::cost::{Cost, march};
use crate::work_precision::settings::Settings;

/// Speed of the swimmer of ratio 100 with 160 nodes, 1280 elements and steps of a quarter of the limit
/// (`--reference` computes it).
const RATIO_100: f64 = 0.149_390_892_4;

/// Time by which a swimmer is steady.
const STEADY: f64 = 80.0;

/// The swimmer of the reference tables for a box; the exterior fluid may have another viscosity.
fn boxed(settings: &Settings, activity: f64, outside: Option<f64>) -> Setup {
    let mut setup = settings.setup();
    setup.viscosity = outside.unwrap_or(100.0);
    let excluded_volume = ExcludedVolume::Step(2.0 * activity.abs());
    let droplet = &mut setup.droplets[0];
    droplet.viscosity = outside.map(|_| 100.0);
    droplet.particles = droplet.particles.map(|particles| Particles { activity, excluded_volume, ..particles });
    setup
}

/// Speed at present of the only droplet.
fn speed(system: &mut System<AnyFlow>) -> Result<f64> {
    let (droplet, _) = system.bodies::<ActiveDroplet>().next().ok_or_else(|| anyhow!("no droplet"))?;
    Ok(system.observe(droplet)?.speed())
}

fn against(setup: &Setup, settings: &Settings, reference: f64) -> Result<(f64, Cost)> {
    let (cost, found) = march(|| Ok(setup.build()?.scene), settings.stepper, STEADY, speed)?;
    Ok((found / reference - 1.0, cost))
}

/// Speed of the steady swimmer of an activity.
pub(crate) fn steady(settings: &Settings, activity: f64) -> Result<(f64, Cost)> {
    let reference = Reference::read("steady_swimmer_box6")?.select("zeta_dmu", &format!("{activity:.1}"));
    against(&boxed(settings, activity, None), settings, reference.value("speed")?)
}

/// Speed of a swimmer that is not along the grid, against far finer boundary integrals.
pub(crate) fn oblique(settings: &Settings) -> Result<(f64, Cost)> {
    static REFERENCE: OnceLock<f64> = OnceLock::new();
    let scene = |settings: &Settings| {
        let mut setup = boxed(settings, -3.0, None);
        setup.droplets[0] = DropletSetup { angle: 0.4, centre: [0.013, 0.027], ..setup.droplets[0].clone() };
        setup
    };
    let reference = match REFERENCE.get() {
        Some(&speed) => speed,
        None => {
            let fine = Settings::integrals(96, 512);
            let setup = scene(&fine);
            let found = march(|| Ok(setup.build()?.scene), fine.stepper, STEADY, speed)?.1;
            *REFERENCE.get_or_init(|| found)
        }
    };
    against(&scene(settings), settings, reference)
}

/// The swimmer of activity -1, ten times as viscous as the exterior fluid.
pub(crate) fn ratio_10(settings: &Settings) -> Result<(f64, Cost)> {
    let reference = Reference::read("steady_swimmer_contrast_box6")?.select("zeta_dmu", "-1.0");
    against(&boxed(settings, -1.0, Some(10.0)), settings, reference.value("speed")?)
}

/// Swimmer a hundred times as viscous.
pub(crate) fn ratio_100(settings: &Settings) -> Result<(f64, Cost)> {
    against(&boxed(settings, -1.0, Some(1.0)), settings, RATIO_100)
}

/// The speed that [`ratio_100`] compares with.
pub(crate) fn reference_of_ratio_100() -> Result<f64> {
    let settings = Settings::integrals(160, 1280).with_step(StepSize::OfLimit(0.25));
    let setup = boxed(&settings, -1.0, Some(1.0));
    Ok(march(|| Ok(setup.build()?.scene), settings.stepper, STEADY, speed)?.1)
}

/// Speed in a narrow channel.
pub(crate) fn channel(settings: &Settings) -> Result<(f64, Cost)> {
    let reference = Reference::read("channel_steady_swimmer")?
        .select("conv", "p0")
        .select("w", "2")
        .select("zeta_dmu", "-2.0")
        .value("speed")?;
    let region = Region::Channel { length: 12.0, width: 2.0, drive: Drive::ZeroGradient };
    let setup = Setup { region, ..settings.setup() };
    let (cost, found) = march(|| Ok(setup.build()?.scene), settings.stepper, STEADY, speed)?;
    Ok((found / reference - 1.0, cost))
}

/// Largest error of the speed on the way to the steady state.
pub(crate) fn transient(settings: &Settings) -> Result<(f64, Cost)> {
    let reference = Reference::read("swimmer_transient_box6_activity_1")?;
    let (times, speeds) = (reference.column("t")?, reference.column("speed")?);
    let setup = boxed(settings, -1.0, None);
    let mut scene = setup.build()?.scene;
    let mut worst = 0.0_f64;
    for (&time, expected) in times.iter().zip(speeds) {
        if time > 0.0 {
            scene.run(time).go()?;
        }
        let error = speed(scene.system_mut())? / expected - 1.0;
        if error.abs() > worst.abs() {
            worst = error;
        }
    }
    // The cost from a run nobody interrupts.
    let (cost, ()) = march(|| Ok(setup.build()?.scene), settings.stepper, 10.0, |_| Ok(()))?;
    Ok((worst, cost))
}
