//! Command line flags of a gel inside a droplet.

use anyhow::{Result, ensure};
use clap::Args;
use motile::interior::{Anchoring, DirectorStart, GelMaterial};
use motile::setup::{DropletSetup, GelSetup};

use crate::parse::{finite, not_negative, one_of, positive};

/// How the director meets the interface.
const ANCHORINGS: [(&str, &str, Anchoring); 3] = [
    ("homeotropic", "Along the outward normal", Anchoring::Homeotropic),
    ("planar", "Along the tangent, counter-clockwise", Anchoring::Planar),
    ("free", "At any angle", Anchoring::Free),
];
/// Directors at the start; the seed is that of `--seed`, the noise that of `--noise`.
const STARTS: [(&str, &str, DirectorStart); 4] = [
    ("uniform", "Along x", DirectorStart::Uniform { angle: 0.0, noise: 0.1, seed: 1 }),
    ("aster", "Outwards", DirectorStart::Aster),
    ("vortex", "Around", DirectorStart::Vortex),
    ("random", "Every direction as likely", DirectorStart::Random { seed: 1 }),
];

/// An active polar gel that fills a droplet.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct GelFlags {
    /// Frank constant K (force times length) [default: 10]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    pub frank: Option<f64>,
    /// Rotational viscosity gamma1 (stress times time) [default: 100]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub rotational_viscosity: Option<f64>,
    /// Alignment nu1 with the flow, negative for rods [default: -0.5]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub alignment: Option<f64>,
    /// Activity zeta_b (stress), negative: contractile [default: -100]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub bulk_activity: Option<f64>,
    /// How the director meets the interface
    #[arg(long, default_value = "free", value_parser = one_of(&ANCHORINGS))]
    pub anchoring: Anchoring,
    /// The director at the start
    #[arg(long, default_value = "uniform", value_parser = one_of(&STARTS))]
    pub start: DirectorStart,
    /// Largest random angle (degrees) of each node of a uniform start [default: 6]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    pub noise: Option<f64>,
    /// Spacing of the mesh inside (R0); without it that of the grid
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub gel_spacing: Option<f64>,
    /// Tension of the interface without particles [default: 10]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    pub tension: Option<f64>,
}

impl GelFlags {
    /// Fills a droplet with the gel, its random numbers from that seed.
    ///
    /// # Errors
    /// A noise of a start that has none.
    pub fn apply(&self, droplet: &mut DropletSetup, seed: Option<u64>) -> Result<()> {
        let usual = GelMaterial::default();
        let material = GelMaterial {
            frank: self.frank.unwrap_or(usual.frank),
            rotational_viscosity: self.rotational_viscosity.unwrap_or(usual.rotational_viscosity),
            alignment: self.alignment.unwrap_or(usual.alignment),
            activity: self.bulk_activity.unwrap_or(usual.activity),
        };
        let mut start = self.start;
        match &mut start {
            DirectorStart::Uniform { noise, seed: own, .. } => {
                *noise = self.noise.map_or(*noise, f64::to_radians);
                *own = seed.unwrap_or(*own);
            }
            DirectorStart::Random { seed: own } => *own = seed.unwrap_or(*own),
            _ => {}
        }
        let noiseless = self.noise.is_some() && !matches!(start, DirectorStart::Uniform { .. });
        ensure!(!noiseless, "--noise means nothing without --start uniform: leave it out or give that");
        droplet.tension = self.tension.unwrap_or(droplet.tension);
        droplet.gel = Some(GelSetup { material, anchoring: self.anchoring, start, spacing: self.gel_spacing });
        Ok(())
    }
}
