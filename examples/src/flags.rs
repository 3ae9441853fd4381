//! Command line flags that scenes share, in groups to be put together with `#[command(flatten)]`.
//!
//! Units are those of Cowley's simulations: lengths in R0, tensions such that gamma0 = 10, times such that D = 0.1;
//! its Appendix A converts them.

use anyhow::{Result, bail, ensure};
use clap::Args;
use motile::base::Drive;
use motile::base::Region;
use motile::setup::{Built, DropletSetup, ExcludedVolume, Setup, Start};
use motile_cli::run::{OutputFlags, SceneRun, View};

use crate::MethodFlags;
use crate::parse::{finite, not_negative, one_of, pair, positive, seed};

/// Radius of a droplet, the unit of length.
pub(crate) const RADIUS: f64 = 1.0;
/// Longest box or channel (radii of the first droplet).
const LONGEST: f64 = 1000.0;
/// Relative amplitude of the random perturbation.
const PERTURBATION: f64 = 0.05;

/// How the concentration starts; the seed is that of `--seed`.
const STARTS: [(&str, &str, Start); 2] = [
    ("polarised", "c = (1 - cos(theta)) c0, Cowley (2.46)", Start::Polarised),
    ("perturbed", "c0 with a small random perturbation", Start::Perturbed { amplitude: PERTURBATION, seed: 1 }),
];
/// Drives of the flow along a channel.
const DRIVES: [(&str, &str, Drive); 2] = [
    ("zero-flux", "No net flux", Drive::ZeroFlux),
    ("zero-gradient", "No mean pressure gradient, as in Cowley", Drive::ZeroGradient),
];

/// The droplets of a scene: each flag changes all droplets that it can apply to. What is not given stays as it is in
/// the scene, by default as listed.
#[derive(Debug, Clone, Default, PartialEq, Args)]
pub struct DropletFlags {
    /// Activity zeta delta-mu of all droplets with particles, negative: contractile [default: -2]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub activity: Option<f64>,
    /// Strength A of the excluded volume tension [default: 10]
    #[arg(long, value_parser = not_negative, allow_hyphen_values = true)]
    pub excluded_volume: Option<f64>,
    /// Viscosity of the fluids, where they have none of their own [default: 100]
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity: Option<f64>,
    /// Viscosity of all droplets
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity_in: Option<f64>,
    /// Viscosity of the exterior fluid; droplets without a viscosity of their own keep the one that they had
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    pub viscosity_out: Option<f64>,
    /// Initial direction of motion (degrees from the x axis), of a scene with one droplet [default: 0]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub angle: Option<f64>,
    /// Initial concentration [default: polarised]
    #[arg(long, value_parser = one_of(&STARTS))]
    pub initial: Option<Start>,
    /// Seed of the random perturbation; each further droplet takes the next one [default: 1]
    #[arg(long, value_parser = seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,
    /// Squeeze round droplets that are wider than the walls leave them, at the start; without it they are refused
    #[arg(long)]
    pub squeezed: bool,
}

impl DropletFlags {
    /// Overrides the entries of a scene: those of all its droplets, or of all that have particles.
    ///
    /// # Errors
    /// A seed of a start that is not random; flags of droplets or of particles where there are none; a direction where
    /// there are several droplets.
    pub fn apply(&self, setup: &mut Setup) -> Result<()> {
        let common = self.viscosity.unwrap_or(setup.viscosity);
        setup.viscosity = self.viscosity_out.unwrap_or(common);
        let of_particles = [
            ("--activity", self.activity.is_some()),
            ("--excluded-volume", self.excluded_volume.is_some()),
            ("--initial", self.initial.is_some()),
            ("--seed", self.seed.is_some()),
        ];
        let of_droplets = [("--viscosity-in", self.viscosity_in.is_some()), ("--angle", self.angle.is_some())];
        for suspension in &mut setup.suspension {
            suspension.activity.take_if(|_| self.activity.is_some());
            suspension.viscosity.take_if(|_| self.viscosity_in.is_some());
        }
        let of_suspensions = setup.suspension.iter_mut().map(|suspension| &mut suspension.droplet);
        let several = of_suspensions.len() > 0 || setup.droplets.len() > 1;
        let mut droplets: Vec<&mut DropletSetup> = setup.droplets.iter_mut().chain(of_suspensions).collect();
        let no_particles = droplets.iter().all(|droplet| droplet.particles.is_none());
        for (flags, lacking, what) in [
            (&of_particles[..], no_particles, "without a droplet that has particles"),
            (&of_droplets, droplets.is_empty(), "without droplets"),
        ] {
            if let Some((flag, _)) = flags.iter().find(|(_, given)| lacking && *given) {
                bail!("{flag} means nothing in a scene {what}: leave it out");
            }
        }
        ensure!(
            self.angle.is_none() || !several,
            "--angle is for a scene with one droplet, and this scene has several: write their angles into the scene file"
        );
        let (mut seeds, mut seeded) = (self.seed.into_iter().flat_map(|first| first..), false);
        for droplet in &mut droplets {
            let DropletSetup { particles, viscosity, angle, squeezed, .. } = &mut **droplet;
            *squeezed |= self.squeezed;
            *viscosity = self.viscosity_in.or(*viscosity).or(self.viscosity_out.map(|_| common));
            *angle = self.angle.map_or(*angle, f64::to_radians);
            let Some(particles) = particles else { continue };
            particles.activity = self.activity.unwrap_or(particles.activity);
            particles.excluded_volume = self.excluded_volume.map_or(particles.excluded_volume, ExcludedVolume::Step);
            particles.start = self.initial.unwrap_or(particles.start);
            if let Start::Perturbed { seed, .. } = &mut particles.start {
                *seed = seeds.next().unwrap_or(*seed);
                seeded = true;
            }
        }
        if let (Some(seed), false) = (self.seed, seeded) {
            bail!("--seed {seed} means nothing without --initial perturbed: leave it out or give that");
        }
        Ok(())
    }
}

/// A periodic box.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct BoxFlags {
    /// Side of the periodic box (R0) [default: 6]
    #[arg(long = "box", value_name = "SIDE", value_parser = positive, allow_hyphen_values = true)]
    pub side: Option<f64>,
    /// Initial position of the droplet, from the middle of the box (R0) [default: 0,0]
    #[arg(long, value_name = "X,Y", value_parser = pair, allow_hyphen_values = true)]
    pub offset: Option<[f64; 2]>,
    /// Shear rate of an imposed flow u = (G y, 0) (1/time), which displaces the images of a box [default: 0]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub shear: Option<f64>,
    /// Extension rate of an imposed flow u = (E x, -E y) (1/time), in unbounded fluid [default: 0]
    #[arg(long, value_parser = finite, allow_hyphen_values = true)]
    pub extension: Option<f64>,
}

impl BoxFlags {
    /// Overrides the entries of a scene.
    ///
    /// # Errors
    /// A box that is unreasonably large; a place for a droplet where there is none, or where there are several.
    pub fn apply(&self, setup: &mut Setup) -> Result<()> {
        if let Some(side) = self.side {
            let most = LONGEST * setup.length_scale();
            ensure!(side <= most, "--box {side} is too large: give at most {most}");
            setup.region = Region::Box { lengths: [side, side] };
        }
        match (self.offset, setup.droplets.as_mut_slice()) {
            (Some(offset), [droplet]) => droplet.centre = offset,
            (Some(_), []) => bail!("--offset means nothing in a scene without droplets: leave it out"),
            (Some(_), _) => bail!(
                "--offset is for a scene with one droplet, and this scene has several: write their centres into the \
                 scene file"
            ),
            (None, _) => {}
        }
        self.impose(setup);
        Ok(())
    }

    /// Imposes the flow, which regions that do not have it refuse.
    pub(crate) fn impose(&self, setup: &mut Setup) {
        setup.flow.shear = self.shear.unwrap_or(setup.flow.shear);
        setup.flow.extension = self.extension.unwrap_or(setup.flow.extension);
    }
}

/// A channel with walls in y, periodic in x.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct ChannelFlags {
    /// Distance of the walls (R0)
    #[arg(long, default_value_t = 3.0, value_parser = positive, allow_hyphen_values = true)]
    pub width: f64,
    /// The period
    #[command(flatten)]
    pub along: AlongFlags,
}

impl ChannelFlags {
    /// Puts the channel into a scene, and refuses what does not fit together.
    ///
    /// # Errors
    /// A droplet that does not fit between the walls, a channel that is unreasonably large.
    pub fn apply(&self, setup: &mut Setup) -> Result<()> {
        let (width, offset) = (self.width, self.along.lateral_offset);
        ensure!(width >= 2.0 * RADIUS, "--width {width} is too small for a droplet of diameter 2: give at least 2");
        let room = 0.5 * width - RADIUS;
        ensure!(
            offset.abs() <= room,
            "--lateral-offset {offset} puts the droplet into a wall: give at most {room} for --width {width}"
        );
        self.along.apply(setup, 0.0, width)
    }
}

/// A period of a channel: the droplet in it, and what drives the flow.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct AlongFlags {
    /// Period along the channel (R0)
    #[arg(long, default_value_t = 12.0, value_parser = positive, allow_hyphen_values = true)]
    pub length: f64,
    /// Initial distance of the droplet from the centre line (R0)
    #[arg(long, default_value_t = 0.0, value_parser = finite, allow_hyphen_values = true)]
    pub lateral_offset: f64,
    /// Drive of the flow
    #[arg(long, default_value = "zero-gradient", value_parser = one_of(&DRIVES))]
    pub drive: Drive,
    /// Net flux along the channel (R0^2 per time)
    #[arg(long, value_parser = finite, allow_hyphen_values = true, conflicts_with_all = ["drive", "gradient"])]
    pub flux: Option<f64>,
    /// Mean pressure gradient along the channel (stress per R0), negative to drive fluid to positive x
    #[arg(long, value_parser = finite, allow_hyphen_values = true, conflicts_with = "drive")]
    pub gradient: Option<f64>,
    /// Velocities of the straight walls along x (R0 per time), the lower one first
    #[arg(long, value_name = "LOWER,UPPER", value_parser = pair, allow_hyphen_values = true)]
    pub wall_velocity: Option<[f64; 2]>,
}

impl AlongFlags {
    /// Drive of the flow.
    #[must_use]
    pub fn driven(&self) -> Drive {
        self.flux.map(Drive::Flux).or(self.gradient.map(Drive::Gradient)).unwrap_or(self.drive)
    }

    /// Puts a channel between rigid walls `width` apart (R0) into a scene, and the droplet `x` along it (R0).
    pub(crate) fn apply(&self, setup: &mut Setup, x: f64, width: f64) -> Result<()> {
        let length = self.length;
        ensure!(width.max(length) <= LONGEST, "a channel of {length} x {width} is too large: give at most {LONGEST}");
        setup.region = Region::Channel { length, width, drive: self.driven() };
        setup.flow.wall_velocity = self.wall_velocity.or(setup.flow.wall_velocity);
        setup.droplets[0].centre = [x, self.lateral_offset];
        Ok(())
    }
}

/// The flags of a region.
pub trait RegionFlags: Args {
    /// The region as it stands above a picture, nothing where that shows it.
    ///
    /// # Errors
    /// Flags that do not fit together.
    fn caption(&self) -> Result<String> {
        Ok(String::new())
    }
}

impl RegionFlags for BoxFlags {}

impl RegionFlags for ChannelFlags {
    fn caption(&self) -> Result<String> {
        Ok(format!("w = {},  l = {}", self.width, self.along.length))
    }
}

/// Flags of a run of a droplet: the droplet, the region `R`, the method, the output.
#[derive(Debug, Clone, PartialEq, Args)]
pub struct SceneFlags<R: Args> {
    /// The droplet
    #[command(flatten)]
    pub droplet: DropletFlags,
    /// The region
    #[command(flatten)]
    pub region: R,
    /// The method
    #[command(flatten)]
    pub method: MethodFlags,
    /// The output
    #[command(flatten)]
    pub output: OutputFlags,
}

impl<R: RegionFlags> SceneFlags<R> {
    /// A run of the scene that was made from `setup`, watching its first droplet. Its results go where the flags say,
    /// by default to `out/<name>/`.
    ///
    /// # Errors
    /// Those of [`SceneRun::new`]; flags that do not fit together.
    pub fn watch(&self, built: Built, setup: &Setup, name: &str) -> Result<SceneRun> {
        let view = View { spacing: self.method.spacing(setup), region: self.region.caption()? };
        SceneRun::new(built, setup, self.method.time, &self.output, name, &view)
    }
}
