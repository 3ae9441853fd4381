//! From descriptions to scenes.

use std::f64::consts::{PI, TAU};

use active_interface::{ActiveDroplet, ActiveInterface, Curve, InitialConcentration};
use elastic_solids::{Fibre, RigidBody, Shell, Solid};
use ib_core::{ImmersedBoundary, SmearedContrast};
use motile_base::internal::spectrum::is_product;
use motile_base::{Region, Vec2, polygon};
use motile_boundary_integrals::{AxisymmetricIntegral, BoundaryIntegral, ImmersedLayers, Settings};
use motile_interior::{GelInBox, ParticlesInDroplet};
use motile_scene::{Body, Deformation, Handle, Hydrodynamics, Scene};
use space_droplets::{SpaceBody, SpaceFluid};
use stokes_grid::{ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StokesSolver, WallMotion, WallTreatment};

use super::{
    DropletSetup, DropletShape, GridSolver, IntegralMethod, LayersMethod, Method, MethodKind, Setup, SolidSetup,
    Squeezed, Start, checked::Checked, droplet::squeezed_sphere, gel::spacing_inside, method::MARKERS,
};
use crate::SetupError;

/// The flow of a scene, computed with whatever method you chose.
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
    /// The elastic fibres.
    pub fibres: Vec<Handle<Fibre>>,
    /// The gels that fill the box.
    pub gels: Vec<Handle<GelInBox>>,
    /// The interfaces that are periodic along x.
    pub interfaces: Vec<Handle<ActiveInterface>>,
    /// The droplets in three dimensions without symmetry ([`Setup::lacks_symmetry`]), which are one body.
    pub space: Option<Handle<SpaceBody>>,
}

/// Accuracy of layers next to solids, whose inner points feel them through a grid.
const LAYER_TOLERANCE: f64 = 1e-6;
/// Gap that is left on each side of a droplet squeezed to fit, over its radius.
const FILM: f64 = 0.05;
/// Fraction of its radius by which a circle may miss a wall that it touches: round-off of positions.
const TOUCHING: f64 = 1e-12;
/// A squeezed droplet's least half height, over its radius.
const FLATTEST: f64 = 0.1;
/// Corners of a polygon by which a circle or its squeezed shape is compared with rigid walls.
const CORNERS: usize = 400;

/// Spacing of a mesh over the marker spacing if there is no grid, and the largest one over the droplet's radius. With
/// 0.33 of it a swimmer of activity -4 is 8 % too fast, with 0.1 two (diffusion constant inside 0.05).
const MARKERS_APART: f64 = 5.0;
const COARSEST: f64 = 0.1;

impl Setup {
    /// Builds the scene. It allocates nothing large before [`Setup::check`] has passed.
    ///
    /// # Errors
    /// Returns the errors of [`Setup::check`]; before anything is meshed, bodies that do not fit into the region or
    /// overlap one another or their images ([`SetupError::NoRoom`], [`SetupError::Overlap`]), and droplets whose
    /// particles would collapse to a point ([`SetupError::Value`]); shapes that cannot be meshed.
    pub fn build(&self) -> Result<Built, SetupError> {
        self.check()?;
        let built = if cfg!(feature = "without-symmetry") && self.lacks_symmetry() {
            self.assembled_in_space()?
        } else if self.suspension.is_empty() {
            self.assembled(self.droplets.len())?
        } else {
            let placed = self.placed()?;
            placed.check()?;
            placed.assembled(self.droplets.len())?
        };
        let mut scene = built.scene.described_by(self.entries());
        scene.system_mut().set_origin(self.origin());
        Ok(Built { scene, ..built })
    }

    /// Returns the scene of a description that has been checked and has no suspensions. Droplets after the first
    /// `listed` come from suspensions.
    fn assembled(&self, listed: usize) -> Result<Built, SetupError> {
        let keyed = |body: usize| move |error: SetupError| error.of(&self.key(body));
        let plans = self.bodies().enumerate().map(|(k, (_, body))| body.plan(self).map_err(keyed(k)));
        let (plans, flow) = (plans.collect::<Result<Vec<_>, _>>()?, self.flow()?);
        self.check_places(&plans, &flow)?;
        // After the places: what does not fit says which quantities seem to have other units.
        self.check_collapse(listed)?;
        self.check_filled(&plans)?;
        let mut scene = Scene::new(flow).with_step_size(self.step).advanced_by(self.integrator);
        if let Some(repulsion) = self.repulsion {
            scene = scene.with_repulsion(repulsion);
        }
        if let Some(bound) = self.least_gap {
            scene = scene.with_least_gap(bound).map_err(motile_scene::FlowError::from)?;
        }
        if !self.flow.is_none() {
            scene.impose(self.flow.imposed(&self.region)?)?;
        }
        for (k, plan) in plans.into_iter().enumerate() {
            (plan.add)(&mut scene).map_err(keyed(k))?;
        }
        let droplets: Vec<Handle<ActiveDroplet>> = handles(&scene);
        for (k, (setup, &host)) in self.droplets.iter().zip(&droplets).enumerate() {
            let Ok(droplet) = scene.body(host) else { continue };
            let gel = self.gel(setup, droplet, host).map_err(keyed(k))?;
            let inside = self.particles_inside(setup, droplet, host).map_err(keyed(k))?;
            gel.map(|gel| scene.add(gel));
            inside.map(|inside| scene.add(inside));
        }
        let (solids, rigid_bodies, shells) = (handles(&scene), handles(&scene), handles(&scene));
        let (fibres, gels) = (handles(&scene), handles(&scene));
        let interfaces: Vec<Handle<ActiveInterface>> = handles(&scene);
        let others = self.bodies().count() - self.interfaces.len();
        for (k, (setup, &host)) in self.interfaces.iter().zip(&interfaces).enumerate() {
            let Ok(interface) = scene.body(host) else { continue };
            let gel = self.gel_in_layer(setup, interface, host).map_err(keyed(others + k))?;
            gel.map(|gel| scene.add(gel));
        }
        if self.mirror_symmetric || self.region.is_axisymmetric() {
            scene = scene.held_symmetric()?;
        }
        Ok(Built { scene, droplets, solids, rigid_bodies, shells, fibres, gels, interfaces, space: None })
    }

    /// Returns the particles that diffuse inside a droplet, made to be the body `host`.
    fn particles_inside(
        &self,
        setup: &DropletSetup,
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
    ) -> Result<Option<ParticlesInDroplet>, SetupError> {
        let Some((particles, exchange)) = setup.particles.as_ref().and_then(|all| Some((all, all.exchange?))) else {
            return Ok(None);
        };
        let Some(diffusion) = exchange.diffusion_inside else { return Ok(None) };
        let density = exchange.number(particles.concentration, droplet.initial_area())? / droplet.initial_area();
        let between = |length: f64| (MARKERS_APART * length).min(COARSEST * (droplet.initial_area() / PI).sqrt());
        let usual = self.method.spacing().unwrap_or_else(|| between(droplet.element_lengths()[0]));
        let key = "particles.exchange.spacing-inside";
        let spacing = spacing_inside((&setup.name, key), exchange.spacing_inside, usual, droplet)?;
        Ok(Some(ParticlesInDroplet::new(droplet, host, exchange.rates()?, diffusion, |_| density, spacing)?))
    }

    /// Returns a droplet of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Returns an error for parameters out of their range.
    pub fn droplet(&self, droplet: &DropletSetup) -> Result<ActiveDroplet, SetupError> {
        let shape = self.shape(droplet)?;
        let (curve, turned, round, share) = match (&shape, self.region.is_axisymmetric()) {
            (&DropletShape::Squeezed { radius, half_height, to }, true) => {
                let (curve, share) = squeezed_sphere(radius, half_height, to)?;
                (curve, false, None, share)
            }
            _ => {
                let (curve, turned, round) = shape.curve()?;
                (curve, turned, round, 1.0)
            }
        };
        let centre = Vec2::new(droplet.centre[0], droplet.centre[1]);
        let placed = |curve: Curve, turned| {
            if turned { curve.rotated(droplet.angle).translated(centre) } else { curve.translated(centre) }
        };
        let curve = placed(curve, turned);
        // The energy of bending is no polynomial of the shape either.
        let count = if droplet.bending > 0.0 { Self::membrane_count } else { Self::marker_count };
        let count = count(self, &curve, &droplet.name)?;
        // Fields are known as precisely as imposed flows.
        let markers =
            if droplet.is_pushed() { self.true_outline(&curve, count)? } else { self.outline(&curve, count)? };
        let made = match &droplet.particles {
            None => ActiveDroplet::passive(&markers, droplet.tension)?,
            Some(particles) => {
                // A squeezed sphere has the particles of the sphere.
                let c0 = share * particles.concentration;
                let initial = match particles.start {
                    Start::Polarised => InitialConcentration::polarised(c0, droplet.angle)?,
                    Start::Uniform => InitialConcentration::uniform(c0)?,
                    Start::Perturbed { amplitude, seed } => InitialConcentration::perturbed(c0, amplitude, seed)?,
                };
                let initial = if self.region.is_axisymmetric() { initial.axisymmetric() } else { initial };
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
                        let number = exchange.number(particles.concentration, made.initial_area())?;
                        made.with_well_mixed_interior(exchange.rates()?, number)?
                    }
                }
            }
        };
        let made = made.with_name(&droplet.name).with_motion(droplet.motion);
        let made = made.with_area_constraint(droplet.area_constraint);
        let made = if self.region.is_axisymmetric() { made.axisymmetric()? } else { made };
        let made = made.with_bending(droplet.bending, droplet.reference_curvature)?;
        let made = match droplet.fields.is_none() {
            true => made,
            false => made.with_fields(droplet.fields.fields(self.region.periods())?)?,
        };
        let made = match droplet.particles.and_then(|particles| particles.noise) {
            Some(noise) => made.with_noise(noise.noise()?)?,
            None => made,
        };
        let made = made.with_cortex(droplet.cortex)?.with_friction(droplet.friction)?;
        let made = made.with_wall_friction(droplet.wall_friction)?;
        let made = made.with_body_force(droplet.body_force.into())?.with_force(droplet.force.into())?;
        Ok(match droplet.viscosity {
            Some(inside) => made.with_viscosity_inside(inside)?,
            None => made,
        })
    }

    /// So many markers of a droplet's outline. In an imposed flow, which deforms bodies as precisely as it is known,
    /// and in three dimensions, they come from [`Setup::true_outline`]; otherwise their polygon has the area of the
    /// outline, as on grids.
    pub(super) fn outline(&self, curve: &Curve, count: usize) -> Result<Vec<Vec2>, SetupError> {
        if self.flow.is_none() && !self.region.is_axisymmetric() {
            return Ok(curve.markers(count)?);
        }
        self.true_outline(curve, count)
    }

    /// So many markers of a body's outline, so that the smooth curve through them has the area of the outline, except
    /// on grids, where their polygon has it. Narrow gaps at rigid bodies are sensitive to a difference of the radius.
    pub(super) fn true_outline(&self, curve: &Curve, count: usize) -> Result<Vec<Vec2>, SetupError> {
        let mut markers = curve.markers(count)?;
        if !matches!(self.method, Method::Grid(_)) {
            let still = vec![Vec2::ZERO; markers.len()];
            let Deformation { area, centroid, .. } =
                Deformation::of(&markers, &still).map_err(motile_scene::FlowError::from)?;
            let factor = (polygon::area(&markers) / area).sqrt();
            markers.iter_mut().for_each(|marker| *marker = centroid + factor * (*marker - centroid));
        }
        Ok(markers)
    }

    /// Returns the number of markers of a body's outline.
    pub(super) fn marker_count(&self, curve: &Curve, name: &str) -> Result<usize, SetupError> {
        let grid = match self.method.resolution() {
            Ok([nodes, elements]) => return Ok(elements.max(nodes)),
            Err(grid) => grid,
        };
        self.grid_markers(curve, name, grid.marker_spacing.unwrap_or(0.5 * grid.spacing))
    }

    /// Returns the number of markers of a body's outline on a grid at that distance of markers (length).
    pub(super) fn grid_markers(&self, curve: &Curve, name: &str, spacing: f64) -> Result<usize, SetupError> {
        let wanted = curve.perimeter() / spacing;
        let remedy = format!("{name} would have {wanted:.1e} markers, too many to compute. Use a larger spacing");
        let many = wanted.is_nan() || wanted > MARKERS[1];
        Checked { place: "method.grid" }.refuse_if(many, "marker-spacing", spacing, remedy)?;
        Ok(fast_count(wanted))
    }

    /// Returns the like for an elastic membrane, of at least three markers for each two modes of its shape. Products of
    /// more modes than that would pass for others in its energy, and waves that do not exist grow.
    pub(super) fn membrane_count(&self, curve: &Curve, name: &str) -> Result<usize, SetupError> {
        let count = self.marker_count(curve, name)?;
        Ok(self.method.resolution().map_or(count, |[nodes, _]| count.max(nodes + nodes.div_ceil(2))))
    }

    /// Returns the flow of this scene, for scenes that are put together by hand.
    ///
    /// # Errors
    /// Returns an error for a region that the method does not have, lengths that do not hold a whole number of cells.
    pub fn flow(&self) -> Result<AnyFlow, SetupError> {
        Ok(match &self.method {
            Method::Harmonics(_) => Box::new(SpaceFluid::new(self.viscosity)?),
            Method::Integral(method) => self.integrals(method)?,
            Method::Layers(LayersMethod { nodes, spacing, kernel, .. }) => {
                let flow = ImmersedLayers::new(
                    self.streamfunction(if self.spreads() { 0.5 * spacing } else { *spacing })?,
                    *kernel,
                    *nodes,
                    self.tolerance.unwrap_or(LAYER_TOLERANCE),
                )?;
                Box::new(match self.shortest_perimeter()? {
                    Some(perimeter) => flow.with_reference_perimeter(perimeter)?,
                    None => flow,
                })
            }
            Method::Grid(grid) => {
                let lagged = grid.solver == GridSolver::LaggedProjection && !self.iterates();
                let treatment = if lagged { WallTreatment::Lagged } else { WallTreatment::Exact };
                let solver = match grid.solver {
                    GridSolver::Streamfunction => self.streamfunction(grid.spacing)?,
                    _ => self.projection(grid.spacing, treatment)?,
                };
                if grid.corrected {
                    Box::new(ImmersedBoundary::new(solver, grid.kernel))
                } else {
                    Box::new(SmearedContrast::new(solver, grid.kernel)?)
                }
            }
        })
    }

    /// Returns true if the forces of a solid are spread over its triangles.
    pub(super) fn spreads(&self) -> bool {
        self.solids.iter().any(|solid| solid.spread_over_triangles)
    }

    /// Returns true if a flow is found by iterations on a grid: with other viscosities and with solids that damp.
    fn iterates(&self) -> bool {
        let damps = |solid: &SolidSetup| solid.viscosity.is_some_and(|own| own > self.viscosity);
        self.has_contrast() || self.solids.iter().any(damps)
    }

    /// Returns the projection solver on a grid; boxed like the other one.
    fn projection(&self, spacing: f64, treatment: WallTreatment) -> Result<Box<dyn StokesSolver>, SetupError> {
        let [nx, ny] = self.cells(spacing, self.region.lengths())?;
        let Region::Channel { drive, .. } = self.region else {
            return Ok(Box::new(ProjectionStokes::new(Grid::periodic(nx, ny, spacing)?, self.viscosity)?));
        };
        let mut solver = ProjectionStokes::new(Grid::channel(nx, ny, spacing)?, self.viscosity)?;
        solver.set_drive(drive)?;
        solver.set_wall_treatment(treatment)?;
        Ok(Box::new(solver))
    }

    /// Returns a solver on a grid; boxed, so that methods are compiled once, not once for each kind.
    fn streamfunction(&self, spacing: f64) -> Result<Box<dyn StokesSolver>, SetupError> {
        let [nx, ny] = self.cells(spacing, self.region.lengths())?;
        if let Some(drive) = self.region.drive() {
            let mut solver = ChannelStokes::new(Grid::channel(nx, ny, spacing)?, self.viscosity)?;
            solver.set_drive(drive)?;
            let slip = self.region.slip();
            if slip != [0.0; 2] {
                solver.set_walls(WallMotion::AT_REST.with_slip(slip)?)?;
            }
            if self.friction != 0.0 {
                solver.set_friction(self.friction)?;
            }
            Ok(Box::new(solver))
        } else {
            let mut solver = PeriodicStokes::new(Grid::periodic(nx, ny, spacing)?, self.viscosity)?;
            if self.friction != 0.0 {
                solver.set_friction(self.friction)?;
            }
            Ok(Box::new(solver))
        }
    }

    fn integrals(&self, &IntegralMethod { nodes, .. }: &IntegralMethod) -> Result<AnyFlow, SetupError> {
        let usual = Settings::default();
        let settings = Settings { nodes, tolerance: self.tolerance.unwrap_or(usual.tolerance), ..usual };
        if self.region.is_axisymmetric() {
            let perimeter = self.shortest_perimeter()?.unwrap_or(TAU);
            return Ok(Box::new(AxisymmetricIntegral::new(self.region, self.viscosity, settings, perimeter)?));
        }
        let mut flow = BoundaryIntegral::new(self.region, self.viscosity, settings)?;
        if !self.walls.is_empty() {
            flow = flow.with_walls(&self.rigid_walls()?)?;
        }
        if !self.fibres.is_empty() {
            let mut radius = f64::INFINITY;
            for fibre in &self.fibres {
                radius = radius.min(fibre.shortest_segment(self)?);
            }
            flow = flow.with_point_radius(radius)?;
        }
        Ok(Box::new(match self.shortest_perimeter()? {
            Some(perimeter) => flow.with_reference_perimeter(perimeter)?,
            None => flow,
        }))
    }

    /// Returns the perimeter of the smallest droplet, shell or rigid body (length), and a period of interfaces along x.
    fn shortest_perimeter(&self) -> Result<Option<f64>, SetupError> {
        let shapes = self.droplets.iter().map(|droplet| &droplet.shape).chain(self.shells.iter().map(|s| &s.shape));
        let shapes = shapes.chain(self.rigid_bodies.iter().map(|body| &body.shape));
        let perimeters = shapes.map(|shape| match shape {
            &DropletShape::Round { radius } | &DropletShape::Squeezed { radius, .. } => Ok(TAU * radius),
            shape => Ok(shape.curve()?.0.perimeter()),
        });
        let period = self.interfaces.first().map(|_| Ok(self.region.lengths()[0]));
        let lengths = perimeters.chain(period).collect::<Result<Vec<f64>, SetupError>>()?;
        Ok(lengths.into_iter().reduce(f64::min))
    }

    /// Returns true if there is fluid of another viscosity than the exterior one.
    pub(super) fn has_contrast(&self) -> bool {
        let inside = self.droplets.iter().map(|droplet| droplet.viscosity);
        let mut inside = inside.chain(self.shells.iter().map(|shell| shell.viscosity));
        inside.any(|viscosity| viscosity.is_some_and(|inside| inside != self.viscosity))
    }

    /// Returns the shape of a droplet at the start: its own, or the shape of a circle that is squeezed between walls.
    /// The walls squeeze a circle by a film if it is just as wide as the place between them, so that it touches both.
    /// They squeeze it by more only if it is [`DropletSetup::squeezed`]. A circle with a gap, however narrow, stays a
    /// circle.
    ///
    /// # Errors
    /// Returns an error for a circle that is wider than its surroundings.
    pub fn shape(&self, droplet: &DropletSetup) -> Result<DropletShape, SetupError> {
        let &DropletShape::Round { radius } = &droplet.shape else { return Ok(droplet.shape.clone()) };
        let y = droplet.centre[1];
        let [length, width] = self.region.lengths();
        // Walls of solids bound the channel where there are some; they know nothing of a film unless they are
        // layers.
        let sides = || self.solids.iter().filter_map(SolidSetup::side);
        let exact = self.method.kind() != MethodKind::Grid;
        let beside = sides().map(|side| if side < 0.0 { y - side } else { side - y });
        let (room, to) = match (beside.reduce(f64::min), self.region) {
            (Some(room), _) => (room, Squeezed::Stadium),
            (None, Region::Channel { .. } | Region::SlipChannel { .. }) if exact => {
                (0.5 * width - y.abs(), Squeezed::Ellipse)
            }
            (None, Region::Tube { radius, shape, .. }) => {
                let half = self.region.half_length().unwrap_or(f64::INFINITY);
                (shape.radius(radius, half, droplet.centre[0]), Squeezed::Ellipse)
            }
            _ => return Ok(droplet.shape.clone()),
        };
        let below = sides().filter(|side| *side < 0.0).fold(-0.5 * width, f64::max);
        let above = sides().filter(|side| *side > 0.0).fold(0.5 * width, f64::min);
        let [least, touching] = [radius * (1.0 - TOUCHING), radius * (1.0 + TOUCHING)];
        // Rigid walls of any shape leave what they leave around the middle of the droplet.
        let of_walls = |above: f64| self.room(Vec2::new(droplet.centre[0], y + above));
        let nearest = of_walls(0.0)?;
        let (room, to) = nearest.map_or((room, to), |nearest| (nearest.min(room), Squeezed::Ellipse));
        // A grid keeps a droplet and a solid apart by itself.
        let touches = room <= touching && (exact || sides().next().is_none());
        if room >= least && !touches {
            return Ok(droplet.shape.clone());
        }
        // If the circle has room elsewhere in the channel, it is misplaced, and its shape stays.
        let beside = || Ok::<_, SetupError>([of_walls(FILM * radius)?, of_walls(-FILM * radius)?]);
        let misplaced = match nearest {
            _ if self.region.is_axisymmetric() => false,
            None => 0.5 * (above - below) > touching,
            Some(_) if room < least => false,
            Some(_) => beside()?.into_iter().flatten().any(|other| other > touching),
        };
        match (misplaced, touches && room >= least) {
            (true, true) => return Err(SetupError::NoRoom { length, width, hint: self.mixed_units(droplet) }),
            (true, false) => return Ok(droplet.shape.clone()),
            (false, _) => {}
        }
        let half_height = room - FILM * radius;
        let squeezed = DropletShape::Squeezed { radius, half_height, to };
        if nearest.is_some() && room < least {
            let squeezed = Some(&squeezed).filter(|_| half_height > FLATTEST * radius);
            self.check_circle(droplet, squeezed)?;
        }
        if half_height <= FLATTEST * radius {
            return Err(SetupError::NoRoom { length, width, hint: self.mixed_units(droplet) });
        }
        if room < least && !droplet.squeezed {
            return Err(SetupError::wider_than_walls(radius, room, half_height, to));
        }
        Ok(squeezed)
    }

    /// Refuses a circle that a rigid wall reaches into, as its shape does where it is squeezed along y: the wall stands
    /// inside it, or at its side.
    fn check_circle(&self, droplet: &DropletSetup, squeezed: Option<&DropletShape>) -> Result<(), SetupError> {
        let number = self.droplets.iter().position(|other| std::ptr::eq(other, droplet));
        let key = number.map_or_else(|| "the droplet".to_owned(), |number| format!("droplets[{number}]"));
        let walls = self.even_walls()?;
        let check = |shape: &DropletShape| -> Result<(), SetupError> {
            let curve = shape.curve()?.0.translated(droplet.centre.into());
            self.check_walls(&key, &curve.markers(CORNERS)?, &walls)
        };
        let fits = squeezed.is_some_and(|shape| check(shape).is_ok());
        if fits { Ok(()) } else { check(&droplet.shape) }
    }
}

/// Returns the bodies of a type, in the order in which they were added.
fn handles<B: Body>(scene: &Scene<AnyFlow>) -> Vec<Handle<B>> {
    scene.system().bodies().map(|(handle, _)| handle).collect()
}

/// Returns the even number without prime factors above 5 nearest to `wanted`: transforms of such lengths are fast.
fn fast_count(wanted: f64) -> usize {
    let wanted = wanted.round().clamp(8.0, MARKERS[1]) as usize;
    (0..wanted)
        .flat_map(|d| [wanted + d, wanted - d])
        .find(|&n| n >= 8 && n.is_multiple_of(2) && is_product(n, &[2, 3, 5]))
        .unwrap_or(wanted)
}
