//! Steady states of scene files, without a run: one of them, or a branch over a key of the scene.

mod diagram;
mod state;

use std::path::PathBuf;

use anyhow::{Result, bail};
use clap::Args;
use motile::setup::Setup;
use motile_steady_states::Parameter;
use toml::Value;

pub use diagram::{DiagramSettings, draw};
pub use state::{Wanted, solve};

use crate::keys::{self, SceneFlags};

/// Options of steady states.
#[derive(Debug, Args)]
pub struct SteadyFlags {
    #[command(flatten)]
    scene: SceneFlags,
    /// The droplet at rest with particles everywhere alike, not a swimmer
    #[arg(long)]
    uniform: bool,
    /// Derivatives of what is measured by every number of the scene, also in sensitivities.csv
    #[arg(long, conflicts_with = "along")]
    sensitivities: bool,
    /// Key along which to follow the states, from its value in the scene, such as droplets.0.particles.activity
    #[arg(long, value_name = "KEY", requires = "to")]
    along: Option<String>,
    /// Last value of the key
    #[arg(long, value_name = "VALUE", requires = "along", allow_hyphen_values = true)]
    to: Option<f64>,
    /// Fewest steps along a branch
    #[arg(long, default_value_t = 20, requires = "along", value_parser = clap::value_parser!(u32).range(2..=1_000_000))]
    steps: u32,
    /// Another observable for the table of a branch, such as beta or stresslet_xx; may be repeated
    #[arg(long, value_name = "NAME", requires = "along")]
    observable: Vec<String>,
    /// Continue from the last point of the branch in the directory of the results
    #[arg(long, requires = "along")]
    resume: bool,
    /// Show no progress
    #[arg(long)]
    quiet: bool,
    /// Draw no pictures of the state
    #[arg(long)]
    no_pictures: bool,
    /// Directory of the results; without it out/steady/ and the name of the scene
    #[arg(long, value_name = "DIRECTORY")]
    out: Option<PathBuf>,
}

/// Finds a steady state of a scene, or follows a branch of them, as the flags say.
///
/// # Errors
/// Returns an error for a scene that cannot be read or has no such states; a key along which states cannot be followed;
/// files that cannot be written.
pub fn steady(flags: &SteadyFlags) -> Result<()> {
    let setup = flags.scene.setup()?;
    let name = flags.scene.name();
    let out = flags.out.clone().unwrap_or_else(|| PathBuf::from("out/steady").join(name));
    let (Some(key), Some(to)) = (&flags.along, flags.to) else {
        let wanted =
            Wanted { uniform: flags.uniform, pictures: !flags.no_pictures, sensitivities: flags.sensitivities };
        return solve(&setup, wanted, &out);
    };
    let parameter = parameter(&setup, key)?;
    let from = parameter.get(&setup).map_or_else(|| parameter.with(&setup, 0.0).map(|_| f64::NAN), Ok)?;
    let settings = DiagramSettings {
        parameter,
        range: [from, to],
        swimmer: !flags.uniform,
        step: 1.0 / f64::from(flags.steps),
        observables: flags.observable.clone(),
        resume: flags.resume,
        quiet: flags.quiet,
        out,
    };
    draw(&setup, &settings)
}

/// Returns the parameter that a key of a scene stands for: the one whose change is a change of this key. The names of
/// parameters are accepted too.
fn parameter(setup: &Setup, key: &str) -> Result<Parameter> {
    if let Some((_, named)) = Parameter::NAMES.iter().find(|(name, _)| *name == key) {
        return Ok(*named);
    }
    for (_, parameter) in Parameter::NAMES {
        let Some(value) = parameter.get(setup) else { continue };
        let other = 1.01 * value + 0.001;
        let mut table = keys::written_out(setup)?;
        keys::set(&mut table, key, Value::Float(other))?;
        if keys::read(&table).is_ok_and(|changed| parameter.with(setup, other).is_ok_and(|it| it == changed)) {
            return Ok(parameter);
        }
    }
    let names = Parameter::NAMES.map(|(name, _)| name).join(", ");
    bail!("steady states cannot be followed along {key}. Use one of the parameters {names}")
}

#[cfg(test)]
mod tests;
