//! From descriptions to scenes.

use std::f64::consts::TAU;

use active_interface::{ActiveDroplet, Curve, InitialConcentration, Motion};
use boundary_integral::{BoundaryIntegral, Settings};
use elastic_solids::{RigidBody, Shell, Solid};
use ib_core::{Handle, Hydrodynamics, ImmersedBoundary, ImmersedLayers, Scene, SmearedContrast, Vec2};
use stokes_grid::{ChannelStokes, Grid, PeriodicStokes, StokesSolver};

use super::{
    Contrast, DropletSetup, DropletShape, GridMethod, IntegralMethod, MarkerMotion, Method, Region, Setup, Squeezed,
    Start, Surface,
};
use crate::SetupError;

/// Hydrodynamics by whatever method a scene was made with.
pub type AnyFlow = Box<dyn Hydrodynamics>;

/// A scene and what is in it, in the order of the description.
#[derive(Debug)]
pub struct Built {
    /// The scene.
    pub scene: Scene<AnyFlow>,
    /// The droplets.
    pub droplets: Vec<Handle<ActiveDroplet>>,
    /// The solids.
    pub solids: Vec<Handle<Solid>>,
    /// The rigid bodies.
    pub rigid_bodies: Vec<Handle<RigidBody>>,
    /// The shells.
    pub shells: Vec<Handle<Shell>>,
}

/// Accuracy of layers beside solids, whose inner points see them through a grid.
const LAYER_TOLERANCE: f64 = 1e-6;
/// Film that is left beside a droplet squeezed to fit, over its radius.
const FILM: f64 = 0.05;
/// A squeezed droplet's least half height, over its radius.
const FLATTEST: f64 = 0.1;
/// Most markers of an interface.
pub(super) const MOST_MARKERS: f64 = IntegralMethod::MOST_CELLS as f64;

impl Setup {
    /// Makes the scene. Nothing large is allocated before [`Setup::check`] has passed.
    ///
    /// # Errors
    /// What [`Setup::check`] refuses; before anything is meshed, bodies that do not fit into the region or overlap one
    /// another or their images ([`SetupError::NoRoom`], [`SetupError::Overlap`]); shapes that
    /// cannot be meshed.
    pub fn build(&self) -> Result<Built, SetupError> {
        self.check()?;
        let keyed = |body: usize| move |error: SetupError| error.of(&self.key(body));
        let layers = self.has_layers();
        let droplet = |(k, droplet)| self.placed(droplet, layers).map_err(keyed(k));
        let droplets = self.droplets.iter().enumerate().map(droplet);
        let droplets = droplets.collect::<Result<Vec<_>, _>>()?;
        let solids = || self.solids.iter().zip(self.droplets.len()..);
        let regions = solids().map(|(solid, k)| solid.enclosed(&self.region).map_err(keyed(k)));
        let (regions, flow) = (regions.collect::<Result<Vec<_>, _>>()?, self.flow()?);
        let first = self.droplets.len() + self.solids.len();
        let bodies = self.rigid_bodies.iter().enumerate().map(|(k, body)| body.build(self).map_err(keyed(first + k)));
        let bodies = bodies.collect::<Result<Vec<_>, _>>()?;
        let first = first + bodies.len();
        let shells = self.shells.iter().enumerate().map(|(k, s)| s.build(self, layers).map_err(keyed(first + k)));
        let shells = shells.collect::<Result<Vec<_>, _>>()?;
        self.check_places(&droplets, &regions, &bodies, &shells, &flow)?;
        let solids = solids().map(|(solid, k)| solid.build(self).map_err(keyed(k))).collect::<Result<Vec<_>, _>>()?;
        let points = droplets.iter().map(ActiveDroplet::markers);
        let points = points.chain(solids.iter().map(Solid::positions));
        let outlines: Vec<Vec<Vec2>> = bodies.iter().map(|body| body.markers().collect()).collect();
        let points = points.chain(outlines.iter().map(Vec::as_slice)).chain(shells.iter().map(Shell::positions));
        let points: Vec<&[Vec2]> = points.collect();
        self.check_filled(&points)?;
        let mut scene = Scene::new(flow).with_step_size(self.step);
        if let Some(super::RepulsionSetup { strength, range }) = self.repulsion {
            scene = scene.with_repulsion(ib_core::Repulsion::new(strength, range).map_err(ib_core::FlowError::from)?);
        }
        if let Some(bound) = self.least_gap {
            scene = scene.with_least_gap(bound).map_err(ib_core::FlowError::from)?;
        }
        let droplets: Vec<_> = droplets.into_iter().map(|droplet| scene.add(droplet)).collect();
        let solids = solids.into_iter().map(|solid| scene.add(solid)).collect();
        let rigid_bodies = bodies.into_iter().map(|body| scene.add(body)).collect();
        let shells = shells.into_iter().map(|shell| scene.add(shell)).collect();
        for (k, (setup, &host)) in self.droplets.iter().zip(&droplets).enumerate() {
            let Ok(droplet) = scene.body(host) else { continue };
            let gel = self.gel(setup, droplet, host).map_err(keyed(k))?;
            let inside = self.particles_inside(setup, droplet, host).map_err(keyed(k))?;
            gel.map(|gel| scene.add(gel));
            inside.map(|inside| scene.add(inside));
        }
        Ok(Built { scene, droplets, solids, rigid_bodies, shells })
    }

    /// A droplet of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn droplet(&self, droplet: &DropletSetup) -> Result<ActiveDroplet, SetupError> {
        self.placed(droplet, self.has_layers())
    }

    /// A droplet, of as many markers as a layer has or as a grid alone needs.
    fn placed(&self, droplet: &DropletSetup, layers: bool) -> Result<ActiveDroplet, SetupError> {
        let shape = self.shape(droplet, layers)?;
        let (curve, turned, round) = shape.curve()?;
        let centre = Vec2::new(droplet.centre[0], droplet.centre[1]);
        let placed = |curve: Curve, turned| {
            if turned { curve.rotated(droplet.angle).translated(centre) } else { curve.translated(centre) }
        };
        let curve = placed(curve, turned);
        let markers = curve.markers(self.marker_count(&curve, &droplet.name, layers)?)?;
        let made = match &droplet.particles {
            None => ActiveDroplet::passive(&markers, droplet.tension)?,
            Some(particles) => {
                let c0 = particles.concentration;
                let initial = match particles.start {
                    Start::Polarised => InitialConcentration::polarised(c0, droplet.angle)?,
                    Start::Uniform => InitialConcentration::uniform(c0)?,
                    Start::Perturbed { amplitude, seed } => InitialConcentration::perturbed(c0, amplitude, seed)?,
                };
                let numbers = match round {
                    // A droplet that starts squeezed has the particles of the circle that it is squeezed from.
                    Some(radius) => {
                        initial.particle_numbers(&placed(Curve::circle(radius)?, true).markers(markers.len())?)?
                    }
                    None => initial.particle_numbers(&markers)?,
                };
                let law = particles.law(droplet.tension)?;
                let made = ActiveDroplet::new(&markers, numbers, law, particles.diffusion)?.with_flux(particles.flux);
                match particles.exchange {
                    None => made,
                    Some(exchange) if exchange.diffusion_inside.is_some() => made.with_open_number(),
                    Some(exchange) => {
                        let number = exchange.number(c0, made.initial_area())?;
                        made.with_pool(exchange.rates()?, number)?
                    }
                }
            }
        };
        let motion = match droplet.motion {
            MarkerMotion::WithFluid => Motion::WithFluid,
            MarkerMotion::Equidistributed { relaxation } => {
                let filter = !matches!(&self.method, Method::Grid(grid) if !grid.filter || layers);
                Motion::Equidistributed { relaxation, filter }
            }
        };
        let made = made.with_name(&droplet.name).with_motion(motion).with_area_constraint(droplet.area_constraint);
        Ok(match droplet.viscosity {
            Some(inside) => made.with_viscosity_inside(inside)?,
            None => made,
        })
    }

    /// How many markers the outline of a body has, as a layer or on a grid alone.
    pub(super) fn marker_count(&self, curve: &Curve, name: &str, layers: bool) -> Result<usize, SetupError> {
        Ok(match &self.method {
            Method::Grid(GridMethod { layers: IntegralMethod { nodes, cells }, .. }) if layers => *(cells.max(nodes)),
            Method::Integral(IntegralMethod { nodes, cells }) => *(cells.max(nodes)),
            Method::Grid(grid) => {
                let spacing = grid.marker_spacing.unwrap_or(0.5 * grid.spacing);
                let wanted = curve.perimeter() / spacing;
                if wanted.is_nan() || wanted > MOST_MARKERS {
                    let remedy = format!("{name} would have {wanted:.1e} markers: give more than that");
                    let (key, value) = ("method.grid.marker-spacing".to_owned(), spacing.to_string());
                    return Err(SetupError::Value { key, value, remedy });
                }
                fast_count(wanted)
            }
        })
    }

    /// The flow of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// A region that the method does not have, lengths that do not hold a whole number of cells.
    pub fn flow(&self) -> Result<AnyFlow, SetupError> {
        let viscosity = self.viscosity;
        match (&self.method, self.region) {
            (Method::Integral(method), region) => self.integrals(method, region),
            (Method::Grid(_), Region::Plane) => Err(SetupError::Value {
                key: "region".to_owned(),
                value: "plane".to_owned(),
                remedy: "a grid has a box or a channel: give one, or the method of boundary integrals".to_owned(),
            }),
            (Method::Grid(grid), Region::Box { lengths: [lx, ly] }) => {
                let [nx, ny] = self.cells(grid, [lx, ly])?;
                let solver = PeriodicStokes::new(Grid::periodic(nx, ny, grid.spacing)?, viscosity)?;
                self.coupled(grid, Box::new(solver))
            }
            (Method::Grid(grid), Region::Channel { length, width, drive }) => {
                let [nx, ny] = self.cells(grid, [length, width])?;
                let mut solver = ChannelStokes::new(Grid::channel(nx, ny, grid.spacing)?, viscosity)?;
                solver.set_drive(drive)?;
                self.coupled(grid, Box::new(solver))
            }
        }
    }

    fn integrals(&self, &IntegralMethod { nodes, .. }: &IntegralMethod, region: Region) -> Result<AnyFlow, SetupError> {
        let settings = Settings { nodes, ..Settings::default() };
        let mut flow = BoundaryIntegral::new(region.geometry(), self.viscosity, settings)?;
        if !self.rigid.is_empty() {
            flow = flow.with_walls(&self.rigid_walls()?)?;
        }
        let shapes = self.droplets.iter().map(|droplet| &droplet.shape).chain(self.shells.iter().map(|s| &s.shape));
        let perimeters = shapes.map(|shape| match shape {
            &DropletShape::Round { radius } | &DropletShape::Squeezed { radius, .. } => Ok(TAU * radius),
            shape => Ok(shape.curve()?.0.perimeter()),
        });
        let shortest = perimeters.collect::<Result<Vec<f64>, SetupError>>()?.into_iter().reduce(f64::min);
        Ok(Box::new(match shortest {
            Some(perimeter) => flow.with_reference_perimeter(perimeter)?,
            None => flow,
        }))
    }

    /// Whether interfaces and the surfaces of solids are layers, as they are beside rigid bodies and where interfaces
    /// between different viscosities lie in one another.
    pub(super) fn has_layers(&self) -> bool {
        let sharp = matches!(&self.method, Method::Grid(GridMethod { contrast: Contrast::Sharp, .. }));
        let solids = self.solids.iter().any(|solid| solid.surface == Surface::Layer);
        !self.rigid_bodies.is_empty() || solids || sharp && self.solids.is_empty() && self.is_nested()
    }

    /// Whether there is fluid of another viscosity than the exterior one.
    pub(super) fn has_contrast(&self) -> bool {
        let inside = self.droplets.iter().map(|droplet| droplet.viscosity);
        let mut inside = inside.chain(self.shells.iter().map(|shell| shell.viscosity));
        inside.any(|viscosity| viscosity.is_some_and(|inside| inside != self.viscosity))
    }

    /// Takes a boxed solver, for which the method is compiled once, not once for each kind.
    fn coupled(&self, grid: &GridMethod, solver: Box<dyn StokesSolver>) -> Result<AnyFlow, SetupError> {
        let differs = self.has_contrast();
        Ok(if self.has_layers() {
            Box::new(ImmersedLayers::new(solver, grid.kernel, grid.layers.nodes, LAYER_TOLERANCE)?)
        } else if differs && grid.contrast == Contrast::Arithmetic {
            Box::new(SmearedContrast::new(solver, grid.kernel)?)
        } else if grid.corrected && self.solids.is_empty() {
            Box::new(ImmersedBoundary::new(solver, grid.kernel))
        } else {
            Box::new(ImmersedBoundary::uncorrected(solver, grid.kernel))
        })
    }

    /// The shape of a droplet at the start: its own, or that of a circle squeezed between walls.
    fn shape(&self, droplet: &DropletSetup, layers: bool) -> Result<DropletShape, SetupError> {
        let &DropletShape::Round { radius } = &droplet.shape else { return Ok(droplet.shape.clone()) };
        let y = droplet.centre[1];
        let [length, width] = self.region.lengths();
        // Walls of solids bound the channel where there are some; they know nothing of a film unless they are
        // layers.
        let sides = || self.solids.iter().filter_map(|solid| Some((solid, solid.side()?)));
        let beside = sides().map(|(solid, side)| {
            (if side < 0.0 { y - side } else { side - y }, if solid.surface == Surface::Layer { FILM } else { 0.0 })
        });
        let exact = layers || matches!(self.method, Method::Integral(_));
        let (room, film, to) = match (beside.reduce(|a, b| if b.0 < a.0 { b } else { a }), self.region) {
            (Some((room, film)), _) => (room, film, Squeezed::Stadium),
            (None, Region::Channel { .. }) if exact => (0.5 * width - y.abs(), FILM, Squeezed::Ellipse),
            _ => return Ok(droplet.shape.clone()),
        };
        let below = sides().map(|(_, side)| side).filter(|side| *side < 0.0).fold(-0.5 * width, f64::max);
        let above = sides().map(|(_, side)| side).filter(|side| *side > 0.0).fold(0.5 * width, f64::min);
        let least = radius * (1.0 - 1e-12);
        // Rigid walls of any shape leave what they leave around the middle of the droplet.
        let centre = Vec2::new(droplet.centre[0], y);
        let (room, film, to) = match self.room(centre)? {
            Some(nearest) => (nearest.min(room), FILM, Squeezed::Ellipse),
            None => (room, film, to),
        };
        // Where the circle has room elsewhere in the channel it is misplaced, which is not for this to mend.
        let misplaced = self.rigid.is_empty() && room < least && 0.5 * (above - below) >= least + film * radius;
        if room >= least + film * radius || misplaced {
            return Ok(droplet.shape.clone());
        }
        let half_height = room - FILM * radius;
        if half_height <= FLATTEST * radius {
            return Err(SetupError::NoRoom { length, width });
        }
        Ok(DropletShape::Squeezed { radius, half_height, to })
    }
}

/// The even number without prime factors above 5 nearest to `wanted`: transforms of such lengths are fast.
fn fast_count(wanted: f64) -> usize {
    let wanted = wanted.round().clamp(8.0, MOST_MARKERS) as usize;
    let fast = |mut n: usize| {
        for p in [2, 3, 5] {
            while n.is_multiple_of(p) {
                n /= p;
            }
        }
        n == 1
    };
    (0..wanted)
        .flat_map(|d| [wanted + d, wanted - d])
        .find(|&n| n >= 8 && n.is_multiple_of(2) && fast(n))
        .unwrap_or(wanted)
}
