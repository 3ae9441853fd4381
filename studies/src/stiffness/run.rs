//! A run by its parameters, and what is measured in it.

use anyhow::{Result, bail};
use clap::ValueEnum;
use motile::active_interface::{
    ActiveDroplet,
    trajectory::{RegimeCriteria, TrajectoryRecorder},
};
use motile::elastic_solids::{Moduli, Solid, channel::width_between, solid::Deformation};
use motile::ib_core::gap::SolidGap;
use motile::ib_core::{Every, Handle, Hydrodynamics, Scene, SceneError, StepSize};
use motile::stokes_grid::Drive;
use motile::{
    Built, ChannelShape, DropletSetup, Exclusion, GridMethod, MarkerMotion, Material, MeshKind, Method, Particles,
    Region, Setup, SolidSetup,
};
use motile_examples::{Decided, Passage, Steadiness, Summary};

use crate::stiffness::history::History;

/// Period of all channels, and side of the box that is called unconfined (R0).
pub(crate) const LENGTH: f64 = 12.0;
/// How deep the droplet may come into a wall, in grid spacings.
const OVERLAP: f64 = 0.25;
/// Part of the stability limit that steps take.
const OF_LIMIT: f64 = 0.7;
/// The same between walls so soft that they fold around the droplet, where 0.7 is not stable.
const OF_LIMIT_NARROW: f64 = 0.2;

/// What a run contributes to: a part of the study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, ValueEnum)]
pub(crate) enum Purpose {
    /// Speed, shape and walls against stiffness (Cowley figures 4.4 to 4.16).
    Speed,
    /// The same between rigid walls, without a grid.
    #[value(skip)]
    Rigid,
    /// The same in a large box, without a grid.
    #[value(skip)]
    Unconfined,
    /// Droplets off the centre line (Cowley figure 4.17).
    Lateral,
    /// The constriction (Cowley figure 4.19).
    Passage,
    /// Springs and neo-Hookean walls, lattice and unstructured mesh (Cowley figures 4.2, 4.3, 4.22, 4.23).
    Comparison,
    /// A channel half as wide as the droplet (Cowley figure 4.25); the stiffness is Young's modulus.
    Narrow,
    /// Droplets more viscous than the exterior fluid.
    Contrast,
    /// How a droplet in contact with stiff walls starts by the method of Cowley.
    Start,
    /// Whether the least active droplet comes to rest.
    Rest,
}

/// What walls are made of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum WallMaterial {
    Springs,
    NeoHookean,
}

/// A run by its parameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Job {
    pub(crate) purpose: Purpose,
    pub(crate) width: f64,
    pub(crate) activity: f64,
    pub(crate) excluded_volume: f64,
    pub(crate) viscosity: f64,
    /// Viscosity of the droplet over that of the exterior fluid.
    pub(crate) ratio: f64,
    /// Cowley's spring constant k.
    pub(crate) stiffness: f64,
    pub(crate) material: WallMaterial,
    pub(crate) mesh: MeshKind,
    pub(crate) thesis: bool,
    /// Whether markers are kept equally spaced, also by the method of Cowley.
    pub(crate) equidistant: bool,
    /// How much further back than the shape says the walls stand (R0).
    pub(crate) back: f64,
    pub(crate) spacing: f64,
    pub(crate) time: f64,
}

impl Job {
    /// A run between walls of springs on a lattice.
    pub(crate) fn new(purpose: Purpose, width: f64, activity: f64, stiffness: f64, spacing: f64, time: f64) -> Self {
        Self {
            purpose,
            width,
            activity,
            excluded_volume: 10.0,
            viscosity: 100.0,
            ratio: 1.0,
            stiffness,
            material: WallMaterial::Springs,
            mesh: MeshKind::Equilateral,
            thesis: false,
            equidistant: false,
            back: 0.0,
            spacing,
            time,
        }
    }

    pub(crate) fn name(&self) -> String {
        let Self { purpose, width, activity, excluded_volume, viscosity, stiffness, spacing, time, .. } = self;
        let kind = format!("{purpose:?}_{:?}_{:?}", self.material, self.mesh).to_lowercase();
        let method = if self.thesis { "_thesis" } else { "" };
        let equidistant = if self.equidistant { "_equidistant" } else { "" };
        let back = if self.back == 0.0 { String::new() } else { format!("_back{}", self.back) };
        let surface = if self.thesis { "" } else { "_layer" };
        let ratio = if self.ratio == 1.0 { String::new() } else { format!("_ratio{}", self.ratio) };
        format!(
            "{kind}_w{width}_z{activity}_A{excluded_volume}_eta{viscosity}{ratio}_k{stiffness}_h{spacing}_t{time}\
             {method}{surface}{equidistant}{back}"
        )
    }

    /// Thickness of each wall (R0).
    const THICKNESS: f64 = 1.5;

    /// The scene without its walls.
    fn setup(&self) -> Setup {
        let centre = match self.purpose {
            Purpose::Passage => [-0.5 * LENGTH, 0.0],
            Purpose::Lateral => [0.0, 0.3],
            _ => [0.0, 0.0],
        };
        let base = if self.thesis { Setup::thesis() } else { Setup::default() };
        let mut grid = if self.thesis { GridMethod::thesis() } else { GridMethod::default() };
        grid.spacing = self.spacing;
        // The filter goes with equally spaced markers.
        grid.filter |= self.equidistant;
        let droplet = DropletSetup {
            centre,
            viscosity: (self.ratio != 1.0).then_some(self.ratio * self.viscosity),
            motion: if self.equidistant { MarkerMotion::default() } else { base.droplets[0].motion },
            particles: base.droplets[0].particles.map(|particles| Particles {
                activity: self.activity,
                excluded_volume: Exclusion::Step(self.excluded_volume),
                ..particles
            }),
            ..base.droplets[0].clone()
        };
        Setup {
            region: self.channel(self.width + 2.0 * Self::THICKNESS),
            method: Method::Grid(grid),
            viscosity: self.viscosity,
            droplets: vec![droplet],
            solids: Vec::new(),
            // Cowley's step of 1e-3 would only cost time.
            step: StepSize::OfLimit(if self.purpose == Purpose::Narrow { OF_LIMIT_NARROW } else { OF_LIMIT }),
            ..base
        }
    }

    fn channel(&self, width: f64) -> Region {
        Region::Channel { length: LENGTH, width, drive: Drive::ZeroGradient }
    }

    fn walls(&self) -> Result<Vec<SolidSetup>> {
        let moduli = if self.purpose == Purpose::Narrow {
            Moduli::from_young(self.stiffness, 1.0 / 3.0)?
        } else {
            Moduli::from_thesis_spring_constant(self.stiffness)?
        };
        let material = match self.material {
            WallMaterial::Springs => Material::Springs { shear: moduli.shear() },
            WallMaterial::NeoHookean => Material::NeoHookean { shear: moduli.shear(), bulk: moduli.bulk() },
        };
        let walls = SolidSetup::walls(&self.shape(), &material).into_iter().map(|wall| {
            let wall = SolidSetup { mesh: self.mesh, ..wall };
            // Whether springs are inverted is reported.
            SolidSetup {
                may_invert: true,
                finer_surface: (self.purpose == Purpose::Passage).then_some(false),
                ..if self.thesis { wall.thesis() } else { wall }
            }
        });
        Ok(walls.collect())
    }

    fn shape(&self) -> ChannelShape {
        match self.purpose {
            Purpose::Passage => ChannelShape::Constriction {
                width: self.width,
                throat: 1.0,
                throat_length: 4.0,
                ramp: 1.0,
                centre: 0.0,
            },
            _ => ChannelShape::Straight { width: self.width },
        }
    }

    /// The scene, its walls as far back as they are to stand.
    fn build(&self, setup: &Setup) -> Result<Built> {
        if self.back == 0.0 {
            return Ok(setup.build()?);
        }
        let Method::Grid(grid) = &setup.method else { bail!("elastic walls need a grid") };
        let shape = self.shape().channel(LENGTH)?.widened(2.0 * self.back)?;
        let mut scene = Scene::new(setup.flow()?).with_step_size(setup.step);
        let droplets = vec![scene.add(setup.droplet(&setup.droplets[0])?)];
        let (walls, top) = (&setup.solids, 0.5 * self.width + Self::THICKNESS);
        let lower = walls[0].on_mesh(shape.lower_wall(-top, &walls[0].mesher(grid)?)?, &setup.region)?;
        let upper = walls[1].on_mesh(shape.upper_wall(top, &walls[1].mesher(grid)?)?, &setup.region)?;
        let solids = vec![scene.add(lower), scene.add(upper)];
        Ok(Built { scene, droplets, solids, rigid_bodies: Vec::new(), shells: Vec::new() })
    }

    /// How much work it is, roughly.
    pub(crate) fn size(&self) -> f64 {
        let stiff = 1.0 + self.stiffness / 1e5 * 100.0 / self.viscosity;
        match self.purpose {
            Purpose::Rigid | Purpose::Unconfined => 0.0,
            _ => self.time * stiff / (self.spacing * self.spacing),
        }
    }

    pub(crate) fn run(&self) -> Result<Summary> {
        let without = |region| -> Result<Summary> {
            let setup = Setup { region, method: Method::default(), ..self.setup() };
            let Built { scene, droplets, .. } = setup.build()?;
            self.without_solids(scene, droplets[0])
        };
        let mut summary = match self.purpose {
            Purpose::Rigid => without(self.channel(self.width))?,
            Purpose::Unconfined => without(Region::Box { lengths: [LENGTH; 2] })?,
            _ => self.with_solids()?,
        };
        let parameters = [
            ("width", self.width),
            ("activity", self.activity),
            ("excluded_volume", self.excluded_volume),
            ("viscosity", self.viscosity),
            ("ratio", self.ratio),
            ("stiffness", self.stiffness),
            ("spacing", self.spacing),
        ];
        summary.put("purpose", format!("{:?}", self.purpose), "");
        summary.put("material", format!("{:?}", self.material), "");
        summary.put("mesh", format!("{:?}", self.mesh), "");
        summary.put("thesis", self.thesis, "");
        for (name, value) in parameters {
            summary.put(name, value, "");
        }
        Ok(summary)
    }

    fn without_solids<H: Hydrodynamics>(&self, mut scene: Scene<H>, droplet: Handle<ActiveDroplet>) -> Result<Summary> {
        let mut recorder = TrajectoryRecorder::new(droplet);
        scene.run(self.time).observe(Every::StepAfter(self.time / 300.0), &mut recorder).go()?;
        measured(&recorder)
    }

    fn with_solids(&self) -> Result<Summary> {
        let setup = Setup { solids: self.walls()?, ..self.setup() };
        let Built { mut scene, droplets, solids: walls, .. } = self.build(&setup)?;
        let droplet = droplets[0];
        let mut recorder = TrajectoryRecorder::new(droplet);
        let mut gap = SolidGap::new(OVERLAP * self.spacing);
        let mut history = History::new(droplet);
        let mut passage = Passage::new(if self.purpose == Purpose::Passage { 3.0 } else { f64::INFINITY });
        let mut run = scene
            .run(self.time)
            .observe(Every::StepAfter(self.time / 300.0), &mut recorder)
            .observe(Every::StepAfter(self.time / 300.0), &mut history)
            .observe(Every::Steps(1), &mut gap);
        if self.purpose == Purpose::Passage {
            run = run.observe(Every::Steps(1), &mut passage);
        }
        let outcome = run.go();
        let failure = match &outcome {
            Err(SceneError::Observer { source, .. }) if source.is::<Decided>() => None,
            outcome => outcome.as_ref().err().map(ToString::to_string),
        };
        let mut summary = measured(&recorder)?;
        history.put(&mut summary);
        self.measure_walls(&scene, &walls, &mut summary)?;
        summary.put("minimum_gap", gap.smallest().map(|(gap, _)| gap), "");
        if self.purpose == Purpose::Passage {
            passage.put(&mut summary);
        }
        summary.put("time", scene.time(), "");
        summary.put("steps", scene.steps(), "");
        summary.put("failure", failure, "");
        Ok(summary)
    }

    fn measure_walls<H: Hydrodynamics>(
        &self,
        scene: &Scene<H>,
        walls: &[Handle<Solid>],
        summary: &mut Summary,
    ) -> Result<()> {
        let [lower, upper] = [scene.body(walls[0])?, scene.body(walls[1])?];
        let width = width_between(lower, upper)?;
        summary.put("channel_width_min", width.minimum, "");
        summary.put("channel_width_max", width.maximum, "");
        let seen = [lower, upper].map(Deformation::of);
        let largest = |of: fn(&Deformation) -> f64| of(&seen[0]).max(of(&seen[1]));
        summary.put("largest_displacement", largest(|wall| wall.largest_displacement), "");
        summary.put("largest_normal_displacement", largest(|wall| wall.largest_normal_displacement), "");
        summary.put("smallest_jacobian", seen[0].smallest_jacobian.min(seen[1].smallest_jacobian), "");
        Ok(())
    }
}

/// What is measured of the droplet.
fn measured(recorder: &TrajectoryRecorder) -> Result<Summary> {
    let Some(last) = recorder.records().last() else { bail!("nothing was measured") };
    let seen = &last.observables;
    let speeds: Vec<(f64, f64)> = recorder.records().iter().map(|r| (r.time, r.observables.speed())).collect();
    let steadiness = Steadiness::of(&speeds, Particles::default().diffusion);
    let report = recorder.regime(&RegimeCriteria::default())?;
    let mut summary = Summary::default();
    summary.put("speed", steadiness.final_speed, "");
    summary.put("speed_deviation", steadiness.deviation, "");
    summary.put("aspect_ratio", seen.aspect_ratio_moments, "");
    summary.put("active_curvature", seen.get("active_curvature"), "");
    summary.put("regime", report.regime.to_string(), "");
    summary.put("amplitude", report.evidence.amplitude, "");
    summary.put("growth_rate", report.evidence.growth_rate.map(|rate| rate.value), "");
    Ok(summary)
}
