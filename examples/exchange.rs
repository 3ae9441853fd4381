//! An active droplet that exchanges its particles with its inside.
//!
//! `cargo run --release --example exchange` simulates it with a well-mixed inside, or with `--bulk-diffusion` one where
//! particles diffuse and are carried along, prints what was measured, and writes to `out/exchange/` what the example
//! `swimming_droplet` writes; the trajectory also has the number of particles inside and the exchange flux, and
//! pictures show in colour what diffuses inside. Particles bind to the interface at the rate `--k-on` times their
//! concentration inside and unbind at the rate `--k-off`. `--help` lists the flags.

use std::f64::consts::{PI, TAU};
use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::Parser;
use motile::setup::{ExchangeSetup, Setup};
use motile_examples::{AnyRegionFlags, SceneFlags, not_negative, positive};

/// An active droplet that exchanges its particles with its inside.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,120 steps, 2,241 evaluations of the flow.")]
struct Flags {
    /// Rate k_on at which particles inside bind to the interface (R0 per time)
    #[arg(long, default_value_t = 0.1, value_parser = not_negative, allow_hyphen_values = true)]
    k_on: f64,
    /// Rate k_off at which particles on the interface unbind (1/time)
    #[arg(long, default_value_t = 0.1, value_parser = not_negative, allow_hyphen_values = true)]
    k_off: f64,
    /// Diffusion constant inside (R0^2 per time); inf for a well-mixed inside
    #[arg(long, default_value_t = f64::INFINITY, value_parser = diffusion, allow_hyphen_values = true)]
    bulk_diffusion: f64,
    /// Number of particles on the interface and inside, at rest with each other at the start; without it as many as
    /// leave the usual 100 per R0 on the interface
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    total_number: Option<f64>,
    #[command(flatten)]
    scene: SceneFlags<AnyRegionFlags>,
}

impl Flags {
    /// Puts the exchange into a scene.
    fn apply(&self, setup: &mut Setup) -> Result<()> {
        let Self { k_on, k_off, bulk_diffusion, total_number, .. } = *self;
        ensure!(
            k_on > 0.0 || k_off == 0.0,
            "--k-on 0 with --k-off {k_off}: nothing that unbinds comes back, give both or neither"
        );
        let Some(particles) = &mut setup.droplets[0].particles else { return Ok(()) };
        if let Some(total) = total_number {
            // N = c0 (2 pi R + pi R^2 k_off/k_on), R = 1.
            let inside = if k_on > 0.0 { PI * k_off / k_on } else { 0.0 };
            particles.concentration = total / (TAU + inside);
        }
        let diffusion_inside = Some(bulk_diffusion).filter(|diffusion| diffusion.is_finite());
        particles.exchange = Some(ExchangeSetup { diffusion_inside, ..ExchangeSetup::new(k_on, k_off) });
        Ok(())
    }
}

/// A positive number, or inf.
fn diffusion(text: &str) -> Result<f64, String> {
    if text == "inf" { Ok(f64::INFINITY) } else { positive(text) }
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(all: &Flags) -> Result<()> {
    // The droplet, its region, the exchange.
    let flags = &all.scene;
    let mut setup = flags.method.setup(&flags.droplet, None)?;
    flags.region.apply(&mut setup)?;
    all.apply(&mut setup)?;

    // The run, with all that watches it.
    let mut run = flags.watch(setup.build()?, &setup, "exchange")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let on = run.last()?.observables.particle_number;
    let [inside, flux] = ["number_inside", "exchange_flux"].map(|column| run.last_of(column).unwrap_or_default());
    summary.put("number_on", on, "on the interface");
    summary.put("number_inside", inside, "");
    summary.put("exchange_flux", flux, "binding less unbinding (1/time)");
    summary.put("number_relative_change", (on + inside) / run.totals()? - 1.0, "of all since the start");
    run.finish(&summary)
}
