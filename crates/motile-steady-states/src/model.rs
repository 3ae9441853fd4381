//! Rates of change of a droplet as a function of its state.

use std::f64::consts::{PI, TAU};

use motile::active_interface::{ContractileTension, ExcludedVolume, Tension};
use motile::base::{FlowSample, ImposedFlow, Region};
use motile::setup::{DropletSetup, DropletShape, Method, Particles, RigidBodySetup, Setup};
use motile_base::{PeriodicSeries, Vec2, internal::Refuse as _};
use stokes_boundary_integrals::{Interface, Settings, TensionPlacement};

use crate::flow::Flow;
use crate::inside::{Inside, Wall};
use crate::profile::analyse;
use crate::resistance::{Progress, Resistance, Strain};
use crate::revolution::Rings;
use crate::{Profile, SteadyError};

/// Relative accuracy to which the flow is solved for, near round-off, so that differences of rates keep their digits.
pub(crate) const TOLERANCE: f64 = 1e-13;

/// Capillary number below which the deformation is round-off.
const LEAST_CAPILLARY: f64 = 1e-7;

/// Velocity over D/R that counts as none: far above round-off, which the tension over D times the viscosity magnifies.
const NO_FLOW: f64 = 1e-8;

/// Base curve, by its points and outward unit normals: shapes are offsets from it along these.
#[derive(Debug, Clone)]
pub(crate) struct Base {
    pub(crate) positions: Vec<Vec2>,
    pub(crate) normals: Vec<Vec2>,
}

impl Base {
    pub(crate) fn new(profile: &Profile) -> Result<Self, SteadyError> {
        let normals = profile.tangents()?.iter().map(|t| outward(*t)).collect();
        Ok(Self { positions: profile.positions.clone(), normals })
    }

    /// Returns the points at offsets along the normals (length).
    pub(crate) fn displaced(&self, offsets: &[f64]) -> impl Iterator<Item = Vec2> {
        self.positions.iter().zip(&self.normals).zip(offsets).map(|((x, n), h)| *x + *h * *n)
    }

    /// Returns the curve turned about the origin by an angle, then shifted.
    pub(crate) fn moved(&self, shift: Vec2, angle: f64) -> Self {
        let turn = Vec2::from_angle(angle);
        Self {
            positions: self.positions.iter().map(|x| turn.rotate(*x) + shift).collect(),
            normals: self.normals.iter().map(|n| turn.rotate(*n)).collect(),
        }
    }
}

/// Returns the unit normal to the right of a tangent, outward for a counter-clockwise curve.
fn outward(tangent: Vec2) -> Vec2 {
    -tangent.perp().normalize()
}

/// Motion of the frame of a droplet: velocity in x and y (length per time) and rate of turning about the origin
/// (1/time), counter-clockwise.
pub(crate) type FrameMotion = [f64; 3];

/// Returns the velocity of a point that moves with a frame (length per time).
fn frame_velocity([ux, uy, turn]: FrameMotion, x: Vec2) -> Vec2 {
    Vec2::new(ux, uy) + turn * x.perp()
}

/// Rigid disc inside a droplet, free of force and torque.
#[derive(Debug)]
struct Nucleus {
    radius: f64,
    centre: Vec2,
    velocity: Vec2,
    surface: Vec<Vec2>,
}

/// Droplet of a description at N nodes.
///
/// Its state is the offset h of the shape along the normals n0 of a base curve x0(a), a the parameter, and the number
/// of particles per parameter, m. In a frame that moves with the velocity V
///
/// ```text
/// x = x0 + h n0,   c = m/|x_a|,   F = d(gamma(c) tau)/ds
/// dh/dt = (v - V).n/(n0.n),   q = (v - V - dh/dt n0).tau,   dm/dt = -d(q c - D dc/ds)/da
/// ```
///
/// from Cowley (2.3), (2.5), (2.39) and an interface that moves with the fluid, on points that slide along fixed lines:
/// q is the speed of the fluid past such a point. In three dimensions the curve is the meridian of a body of revolution
/// about the x axis with its mirror image, m = c |x_a| all the same, and with the distance y from the axis
///
/// ```text
/// dm/dt = -d(q c - D dc/ds)/da - (y_a (q c - D dc/ds) + m dy/dt)/y
/// ```
///
/// If particles are exchanged with the inside, dm/dt gains `(k_on b - k_off c) |x_a|`, b the density inside next to the
/// interface: uniform, of the particles that the interface lacks, or the field that is steady with the flow and c
/// ([`Inside`]).
///
/// The centres of rigid discs inside move with the fluid; their coordinates x stand after the offsets and y after the
/// densities, and so do the rates of these.
#[derive(Debug)]
pub(crate) struct Model {
    pub(crate) setup: Setup,
    pub(crate) radius: f64,
    pub(crate) concentration: f64,
    pub(crate) viscosities: [f64; 2],
    pub(crate) diffusion: f64,
    /// Rate of change in units of which rates are small or large (1/time): D/R^2 with particles, without them that
    /// at which the tension restores the circle or the imposed flow deforms it, whichever is faster.
    rate: f64,
    pub(crate) law: ContractileTension,
    inside: Option<Inside>,
    pub(crate) flow: Flow,
    /// Quadrature over rings, in three dimensions.
    rings: Option<Rings>,
    series: PeriodicSeries,
    pub(crate) positions: Vec<Vec2>,
    tangents: Vec<Vec2>,
    pub(crate) concentrations: Vec<f64>,
    tensions: Vec<f64>,
    /// Gradient of the activity about the origin (force times length over length), zero in a scene.
    pub(crate) activity_slope: Vec2,
    /// Cortex and friction of the interface, if there are any.
    resistance: Option<Box<Resistance>>,
    pub(crate) forces: Vec<Vec2>,
    pub(crate) velocities: Vec<Vec2>,
    nuclei: Vec<Nucleus>,
    /// Forces on the discs: none.
    zeros: Vec<Vec2>,
    /// dh/dt and dm/dt of the last rates, and the flux q c - D dc/ds.
    offset_rates: Vec<f64>,
    density_rates: Vec<f64>,
    flux: Vec<f64>,
}

impl Model {
    /// Creates a model of a description, at an even number of nodes.
    pub(crate) fn new(setup: &Setup) -> Result<Self, SteadyError> {
        Self::with_flow(setup, None)
    }

    /// Returns the model of a neighbouring description, which starts from the stresses of this one. It keeps what the
    /// flow has computed for the region if that is the same, else the nodes of a tube's wall in proportion.
    pub(crate) fn retuned(self, setup: &Setup) -> Result<Self, SteadyError> {
        let old = &self.setup;
        let [here, there] = [old, setup].map(|setup| (setup.region, setup.viscosity, &setup.flow, &setup.method));
        let kept = here == there;
        let widening = match (old.region, setup.region) {
            (Region::Tube { radius: before, .. }, Region::Tube { radius, .. }) => radius / before,
            _ => 1.0,
        };
        let Self { flow, resistance, .. } = self;
        // Errors of the nodes of a tube's wall then change smoothly.
        let tube = flow.tube().filter(|_| !kept).map(|lengths| lengths.map(|length| widening * length));
        let mut model = Self::with_flow(setup, kept.then_some(flow))?;
        if let Some(tube) = tube {
            model.flow.restore_tube(tube)?;
        }
        if let (Some(own), Some(other)) = (&mut model.resistance, &resistance) {
            own.adopt(other);
        }
        Ok(model)
    }

    /// Creates a model of a description with a flow of its region, viscosity and imposed flow if there is one already.
    fn with_flow(setup: &Setup, flow: Option<Flow>) -> Result<Self, SteadyError> {
        let refuse = |what: &str, remedy| Err(SteadyError::unsupported(what, remedy));
        setup.check()?;
        if setup.lacks_symmetry() {
            let remedy = match setup.region {
                Region::Space | Region::Tube { .. } => {
                    "A swimmer alone is axisymmetric, so leave out position, heading, flow and the method harmonics"
                }
                _ => "Use region = \"space\" or a tube, where a swimmer alone is axisymmetric",
            };
            return refuse("the scene is described without symmetry about the x axis", remedy);
        }
        let Method::Integral(method) = setup.method else {
            return refuse("the scene is computed on a grid", "Use the method of boundary integrals (`integral`)");
        };
        if !setup.fibres.is_empty() {
            return refuse("the scene has a fibre", "Run it until it no longer changes, or remove the fibre");
        }
        if !(setup.shells.is_empty() && setup.interfaces.is_empty()) {
            return refuse(
                "the scene has a shell or an interface that is periodic along x, whose points keep moving along it",
                "Run it until its deformation no longer changes (System::deformation)",
            );
        }
        let [
            DropletSetup {
                particles,
                tension,
                viscosity,
                shape,
                bending,
                fields,
                cortex,
                friction,
                wall_friction,
                body_force,
                force,
                ..
            },
        ] = setup.droplets.as_slice()
        else {
            return refuse("the scene does not have exactly one droplet", "Use one droplet");
        };
        if !fields.is_none() {
            return refuse(
                "the droplet feels fields that are fixed in the laboratory, where a moving droplet is not steady",
                "Leave the fields out, or run the scene",
            );
        }
        if *wall_friction != 0.0 {
            return refuse("walls rub on the interface", "Leave wall-friction out, or run the scene");
        }
        if cortex.inextensible {
            return refuse("the interface does not stretch", "Run it until its deformation no longer changes");
        }
        if particles.is_some_and(|particles| particles.noise.is_some()) {
            return refuse("there is noise on the particles", "Leave the noise out, or run the scene");
        }
        if !setup.flow.is_none() && matches!(setup.region, Region::Box { .. }) {
            return refuse(
                "the images of a sheared box never stop moving",
                "Use the plane or a channel, or run the scene",
            );
        }
        if !(setup.solids.is_empty() && setup.walls.is_empty()) || setup.repulsion.is_some() {
            return refuse("the scene has solids, shaped walls or a repulsion", "Leave them out");
        }
        if setup.region.half_length().is_some() {
            return refuse("nothing is steady in a tube that is not straight", "Use a straight tube");
        }
        if *bending > 0.0 {
            return refuse("the interface resists bending", "Leave the bending out");
        }
        if [*body_force, *force] != [[0.0; 2]; 2] {
            return refuse("a force acts on the droplet", "Leave out body-force and force, or run the scene");
        }
        if setup.rigid_bodies.iter().any(RigidBodySetup::is_held) {
            return refuse("a rigid body is held or moved", "Let the body move freely, or run the scene");
        }
        let disc = |body: &RigidBodySetup| match body.shape {
            DropletShape::Round { radius } if body.force == [0.0; 2] && body.torque == 0.0 => Some(radius),
            _ => None,
        };
        let Some(discs) = setup.rigid_bodies.iter().map(disc).collect::<Option<Vec<f64>>>() else {
            return refuse("a rigid body is no disc, or has a force or torque", "Use a disc without force and torque");
        };
        let (DropletShape::Round { radius } | DropletShape::Squeezed { radius, .. }) = *shape else {
            let remedy = match shape.radius() {
                Ok(radius) => format!("Use a round droplet of the same area, of radius {radius:.4}"),
                Err(_) => "Use a round droplet".to_owned(),
            };
            return refuse("the droplet is neither round nor a squeezed circle", &remedy);
        };
        let nodes = method.nodes - method.nodes % 2;
        let settings = Settings { nodes, tolerance: TOLERANCE, ..Settings::default() };
        if setup.region.is_axisymmetric() && !discs.is_empty() {
            return refuse(
                "an axisymmetric droplet has a rigid body inside",
                "Leave it out, or use a two-dimensional region",
            );
        }
        let exchange = particles.and_then(|particles| particles.exchange);
        if exchange.is_some_and(|exchange| exchange.diffusion_inside.is_some()) && !discs.is_empty() {
            return refuse("particles diffuse around a rigid body inside", "Leave out one of them");
        }
        let viscosities = [viscosity.unwrap_or(setup.viscosity), setup.viscosity];
        let imposed = setup.flow.imposed(&setup.region)?;
        let inside = particles.map_or(Ok(None), |particles| Inside::new(&particles, radius, nodes))?;
        let (law, [diffusion, concentration, rate]) = match particles {
            Some(particles) => {
                let &Particles { diffusion, concentration, .. } = particles;
                motile_base::positive("the diffusion constant", diffusion)?;
                let at_rest = inside.as_ref().map_or(concentration, |inside| inside.at_rest);
                (particles.law(*tension)?, [diffusion, at_rest, diffusion / (radius * radius)])
            }
            None => {
                let relaxation = tension / ((viscosities[0] + viscosities[1]) * radius);
                let rate = relaxation.max(imposed.rate());
                motile_base::positive("the rate at which the droplet relaxes or is deformed", rate)?;
                // The rate of strain, that of a Poiseuille flow a radius from its middle.
                let [[along, up], [down, _]] = imposed.gradient;
                let strain = along.abs().max((up + down).abs()).max(imposed.bend.abs() * radius);
                let capillary = strain * setup.viscosity * radius / tension;
                if capillary > 0.0 && capillary < LEAST_CAPILLARY {
                    let what = format!("the capillary number is {capillary:.1e}");
                    let remedy = "Use at least 1e-7, or compute D to first order: the capillary number in shear, and \
                                  twice as much in extension";
                    return Err(SteadyError::refused(what, "the deformation is lost in round-off", remedy));
                }
                (ContractileTension::new(*tension, 0.0, ExcludedVolume::None, 1.0)?, [0.0, 0.0, rate])
            }
        };
        let flow = match flow {
            Some(flow) => flow,
            None => {
                let mut flow = Flow::new(setup.region, setup.viscosity, settings)?;
                flow.impose(imposed)?;
                flow
            }
        };
        let nucleus =
            |radius| Nucleus { radius, centre: Vec2::ZERO, velocity: Vec2::ZERO, surface: vec![Vec2::ZERO; nodes] };
        Ok(Self {
            setup: setup.clone(),
            radius,
            concentration,
            viscosities,
            diffusion,
            rate,
            law,
            inside,
            flow,
            rings: setup.region.is_axisymmetric().then(|| Rings::new(nodes)),
            series: PeriodicSeries::new(nodes)?,
            positions: vec![Vec2::ZERO; nodes],
            tangents: vec![Vec2::ZERO; nodes],
            concentrations: vec![0.0; nodes],
            tensions: vec![0.0; nodes],
            activity_slope: Vec2::ZERO,
            resistance: Resistance::new(*cortex, *friction, nodes, &setup.region).map(Box::new),
            forces: vec![Vec2::ZERO; nodes],
            velocities: vec![Vec2::ZERO; nodes],
            offset_rates: vec![0.0; nodes + discs.len()],
            density_rates: vec![0.0; nodes + discs.len()],
            nuclei: discs.into_iter().map(nucleus).collect(),
            zeros: vec![Vec2::ZERO; nodes],
            flux: vec![0.0; nodes],
        })
    }

    /// Returns true if the flow of the loaded state is round-off.
    pub(crate) fn is_at_rest(&self) -> bool {
        let speed = self.rate * self.radius;
        self.velocities.iter().all(|velocity| velocity.length() < NO_FLOW * speed)
    }

    /// Returns the number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.positions.len()
    }

    /// Returns the number of rigid discs inside.
    pub(crate) fn nuclei(&self) -> usize {
        self.nuclei.len()
    }

    /// Returns the weight of a node in an integral over the interface: of the parameter in the plane, of the parameter
    /// and the azimuth in three dimensions (length).
    pub(crate) fn weight(&self, node: usize) -> f64 {
        let step = TAU / self.nodes() as f64;
        self.rings.as_ref().map_or(step, |rings| rings.weights[node] * TAU * self.positions[node].y.abs())
    }

    /// Returns the area (length squared) or volume (length cubed) of the droplet at rest, and the number of particles
    /// on it.
    fn conserved(&self) -> [f64; 2] {
        let radius = self.radius;
        let [size, surface] = match self.rings {
            None => [PI * radius * radius, TAU * radius],
            Some(_) => [4.0 / 3.0 * PI * radius.powi(3), 4.0 * PI * radius * radius],
        };
        [size, surface * self.concentration]
    }

    /// Returns the area or volume and number of particles that the loaded state lacks, over their values for the
    /// droplet at rest.
    pub(crate) fn lacks(&self) -> [f64; 2] {
        let dimensions = if self.rings.is_some() { 3.0 } else { 2.0 };
        let curve = self.positions.iter().zip(&self.tangents).enumerate();
        let size: f64 = curve.map(|(k, (x, t))| x.perp_dot(*t) / dimensions * self.weight(k)).sum();
        let [size_at_rest, number_at_rest] = self.conserved();
        let all = self.inside.as_ref().map_or(number_at_rest, |inside| inside.total);
        let lacking = || (all - self.number()) / number_at_rest - self.diffusing();
        let particles = if self.keeps_number() { lacking() } else { 0.0 };
        [1.0 - size / size_at_rest, particles]
    }

    /// Returns the unit of rates: D/R^2 with particles (1/time).
    pub(crate) fn rate_unit(&self) -> f64 {
        self.rate
    }

    /// Returns true if the number of particles has a separate equation. It is the number on the interface, or of all
    /// particles if particles inside diffuse. A well-mixed inside holds the particles that the interface lacks.
    pub(crate) fn keeps_number(&self) -> bool {
        self.carries() && self.inside.as_ref().is_none_or(|inside| inside.field.is_some())
    }

    /// Returns true if particles diffuse inside.
    pub(crate) fn has_field(&self) -> bool {
        self.inside.as_ref().is_some_and(|inside| inside.field.is_some())
    }

    /// Returns the number of particles inside the state of the last rates and the rate at which they bind less that at
    /// which they unbind (1/time); `None` without an exchange.
    pub(crate) fn inside(&self) -> Option<(f64, f64)> {
        let (inside, on) = (self.inside.as_ref()?, self.number());
        let gains = (0..self.nodes()).map(|k| self.gain(inside, on, k) * self.weight(k));
        Some((inside.number(on), gains.sum()))
    }

    /// Returns the number of particles inside over that on the interface of the circle at rest, where they diffuse;
    /// else zero.
    pub(crate) fn diffusing(&self) -> f64 {
        let field = self.inside.as_ref().and_then(|inside| inside.field.as_ref());
        field.map_or(0.0, |field| field.number / self.conserved()[1])
    }

    /// Returns the number of particles on the loaded interface.
    fn number(&self) -> f64 {
        (0..self.nodes()).map(|k| self.concentrations[k] * self.tangents[k].length() * self.weight(k)).sum()
    }

    /// Returns the rate at which the density m of a node grows by exchange (1/time), with so many particles on the
    /// interface.
    fn gain(&self, inside: &Inside, on: f64, node: usize) -> f64 {
        let bound = inside.exchange.binding() * inside.density(on, node);
        (bound - inside.exchange.unbinding() * self.concentrations[node]) * self.tangents[node].length()
    }

    /// Returns true with particles on the interface.
    pub(crate) fn carries(&self) -> bool {
        self.concentration > 0.0
    }

    /// Returns the imposed flow, without what the drive of a channel drives.
    pub(crate) fn imposed(&self) -> ImposedFlow {
        self.flow.imposed()
    }

    /// Returns true if the imposed flow is its own mirror image at the x axis.
    pub(crate) fn is_mirror_symmetric(&self) -> bool {
        let ImposedFlow { velocity: [_, v], gradient: [[_, uy], [vx, _]], .. } = self.imposed();
        let [below, above] = self.setup.region.slip();
        v == 0.0 && uy == 0.0 && vx == 0.0 && below == above
    }

    pub(crate) fn in_plane(&self) -> bool {
        self.setup.region == Region::Plane
    }

    pub(crate) fn in_channel(&self) -> bool {
        matches!(self.setup.region.without_slip(), Region::Channel { .. })
    }

    /// Returns true for bodies of revolution in three dimensions.
    pub(crate) fn is_axisymmetric(&self) -> bool {
        self.rings.is_some()
    }

    /// Returns true if the interface has a cortex.
    pub(crate) fn has_cortex(&self) -> bool {
        self.resistance.as_ref().is_some_and(|resistance| resistance.has_cortex())
    }

    /// Takes over a state and solves for its flow.
    pub(crate) fn load(&mut self, base: &Base, offsets: &[f64], density: &[f64]) -> Result<(), SteadyError> {
        self.positions.iter_mut().zip(base.displaced(offsets)).for_each(|(position, x)| *position = x);
        self.series.analyse_vectors(&self.positions)?;
        self.series.differentiate();
        self.series.write_vectors(&mut self.tangents)?;
        for ((c, m), tangent) in self.concentrations.iter_mut().zip(density).zip(&self.tangents) {
            *c = m / tangent.length();
        }
        self.law.values(&self.concentrations, &mut self.tensions);
        if self.activity_slope != Vec2::ZERO {
            for ((tension, c), x) in self.tensions.iter_mut().zip(&self.concentrations).zip(&self.positions) {
                *tension -= self.activity_slope.dot(*x) * c;
            }
        }
        let nodes = self.nodes();
        for (k, Nucleus { radius, centre, surface, .. }) in self.nuclei.iter_mut().enumerate() {
            *centre = Vec2::new(offsets[nodes + k], density[nodes + k]);
            let step = TAU / surface.len() as f64;
            for (j, point) in surface.iter_mut().enumerate() {
                *point = *centre + *radius * Vec2::from_angle(step * j as f64);
            }
        }
        if let Some(mut resistance) = self.resistance.take() {
            let solved = self.solve_resisted(&mut resistance);
            self.resistance = Some(resistance);
            return solved;
        }
        let Self { flow, positions, tensions, forces, .. } = self;
        flow.tension_forces(positions, tensions, TensionPlacement::Points, forces)?;
        self.solve_flow()
    }

    /// Returns the derivatives of the arc length by the parameter at the nodes (length).
    pub(crate) fn stretches(&self) -> impl Iterator<Item = f64> {
        self.tangents.iter().map(|tangent| tangent.length())
    }

    /// Solves for the flow of the present forces.
    fn solve_flow(&mut self) -> Result<(), SteadyError> {
        let Self { flow, positions, forces, .. } = self;
        if flow.approximate(positions, forces, &mut self.velocities)? {
            return Ok(());
        }
        let viscosity = self.viscosities[0];
        let viscosities = [viscosity, self.viscosities[1]];
        let discs = self.nuclei.iter().map(|disc| Interface::rigid(&disc.surface, &self.zeros, viscosity));
        self.flow.solve(std::iter::once(Interface::closed(positions, forces, viscosities)).chain(discs))?;
        for (k, nucleus) in self.nuclei.iter_mut().enumerate() {
            nucleus.velocity = self.flow.rigid_velocity(1 + k);
        }
        Ok(self.flow.velocities(0, &mut self.velocities)?)
    }

    /// Takes the flow of all states for linear about the loaded one, until [`Model::release`], where that is quicker.
    pub(crate) fn linearise(&mut self) -> Result<(), SteadyError> {
        if let Some(mut resistance) = self.resistance.take() {
            let renewed = self.renew(&mut resistance);
            // Particles that diffuse inside are carried by the flow there, which has to be that of all forces.
            resistance.fix(!self.has_field());
            self.resistance = Some(resistance);
            renewed?;
        }
        Ok(self.flow.linearise(&self.positions, &self.forces, &self.velocities)?)
    }

    pub(crate) fn release(&mut self) {
        self.flow.release();
        if let Some(resistance) = &mut self.resistance {
            resistance.fix(false);
        }
    }

    /// Returns true if derivatives come from the linear flow about a state.
    pub(crate) fn is_linearised(&self) -> bool {
        self.is_axisymmetric() || self.resistance.is_some()
    }

    /// Starts from the stresses of a neighbouring model.
    pub(crate) fn adopt(&mut self, other: &Self) {
        if let (Some(own), Some(other)) = (&mut self.resistance, &other.resistance) {
            own.adopt(other);
        }
    }

    /// Solves for the flow of an interface that resists it, and for its stresses.
    fn solve_resisted(&mut self, resistance: &mut Resistance) -> Result<(), SteadyError> {
        resistance.set_curve(&self.tangents);
        self.find_stresses(resistance)?;
        let uniform = resistance.uniform();
        let moving = self.velocities.iter_mut().chain(self.nuclei.iter_mut().map(|disc| &mut disc.velocity));
        moving.for_each(|velocity| *velocity += uniform);
        Ok(())
    }

    /// Solves for the stresses, and for the velocities except for a uniform one.
    fn find_stresses(&mut self, resistance: &mut Resistance) -> Result<(), SteadyError> {
        if resistance.is_fixed() {
            self.push(resistance, true)?;
            self.solve_flow()?;
            let [along, around] = self.strain_rates()?;
            let strain = Strain { along: &along, around: &around, velocities: &self.velocities };
            let change = resistance.first_order(strain, &self.concentrations)?;
            let moving = self.velocities.iter_mut().chain(self.nuclei.iter_mut().map(|disc| &mut disc.velocity));
            moving.zip(change).for_each(|(velocity, change)| *velocity += change);
            return Ok(());
        }
        let mut fresh = !resistance.has_matrix();
        if fresh {
            self.push(resistance, true)?;
            self.solve_flow()?;
            self.renew(resistance)?;
        }
        loop {
            let scale = self.tensions.iter().fold(0.0_f64, |largest, tension| largest.max(tension.abs()));
            let mut progress = Progress::new(self.radius, scale);
            loop {
                self.push(resistance, true)?;
                self.solve_flow()?;
                let [along, around] = self.strain_rates()?;
                let strain = Strain { along: &along, around: &around, velocities: &self.velocities };
                if resistance.correct(strain, &self.concentrations, &mut progress)? {
                    break;
                }
            }
            if progress.is_done() {
                return Ok(());
            }
            if fresh {
                return Err(SteadyError::singular(
                    "the stresses of the cortex",
                    "Use another number of nodes, or a smaller viscosity of the cortex",
                ));
            }
            self.renew(resistance)?;
            fresh = true;
        }
    }

    /// Writes the forces of the stresses of the interface, with the forces of the tension or without.
    fn push(&mut self, resistance: &Resistance, with_tension: bool) -> Result<(), SteadyError> {
        let total = |stresses: &[f64]| -> Vec<f64> {
            let tension = self.tensions.iter().map(|tension| if with_tension { *tension } else { 0.0 });
            tension.zip(stresses).map(|(tension, stress)| tension + stress).collect()
        };
        let (along, around) = (total(&resistance.along), total(&resistance.around));
        self.flow.stress_forces(&self.positions, [&along, &around], &mut self.forces)?;
        resistance.add_drag(&mut self.forces);
        Ok(())
    }

    /// Gives the stresses the matrix of the loaded state, whose flow is solved for.
    fn renew(&mut self, resistance: &mut Resistance) -> Result<(), SteadyError> {
        let unit = self.tensions.iter().fold(f64::MIN_POSITIVE, |largest, tension| largest.max(tension.abs()));
        let unit = if unit > f64::MIN_POSITIVE { unit } else { self.rate * self.radius * self.viscosities[1] };
        let (velocities, forces) = (self.velocities.clone(), self.forces.clone());
        let discs: Vec<Vec2> = self.nuclei.iter().map(|disc| disc.velocity).collect();
        let concentrations = std::mem::take(&mut self.concentrations);
        let disturbances = self.flow.disturbances(0)?;
        let still = vec![Vec2::ZERO; self.nodes()];
        let moving = |model: &Self| -> Vec<Vec2> {
            model.velocities.iter().copied().chain(model.nuclei.iter().map(|disc| disc.velocity)).collect()
        };
        let mut background = None;
        if disturbances.is_none() {
            self.forces.fill(Vec2::ZERO);
            self.solve_flow()?;
            background = Some(moving(self)).filter(|flow| flow.iter().any(|v| *v != Vec2::ZERO));
        }
        let renewed = resistance.renew(&concentrations, unit, |resistance, unknown| {
            resistance.set_one(unknown, unit);
            self.push(resistance, false)?;
            if let Some(disturbances) = &disturbances {
                disturbances.velocities_at_points(&still, &self.forces, &mut self.velocities)?;
            } else {
                self.solve_flow()?;
            }
            let mut all = moving(self);
            if let Some(background) = &background {
                all.iter_mut().zip(background).for_each(|(v, at_rest)| *v -= *at_rest);
            }
            let nodes = self.nodes();
            self.velocities.copy_from_slice(&all[..nodes]);
            Ok((self.strain_rates()?, all))
        });
        (self.concentrations, self.velocities, self.forces) = (concentrations, velocities, forces);
        self.nuclei.iter_mut().zip(discs).for_each(|(disc, velocity)| disc.velocity = velocity);
        renewed
    }

    /// Returns the rates at which the interface is stretched (1/time) at the nodes: along it, `tau.dv/ds`, and in three
    /// dimensions around the axis, `v_y/y`.
    fn strain_rates(&mut self) -> Result<[Vec<f64>; 2], SteadyError> {
        self.series.analyse_vectors(&self.velocities)?;
        self.series.differentiate();
        let mut slopes = vec![Vec2::ZERO; self.nodes()];
        self.series.write_vectors(&mut slopes)?;
        let along = slopes.iter().zip(&self.tangents).map(|(slope, t)| slope.dot(*t) / t.length_squared()).collect();
        let around = |k: usize| {
            let at_pole = k == 0 || 2 * k == self.nodes();
            if at_pole { slopes[k].y / self.tangents[k].y } else { self.velocities[k].y / self.positions[k].y }
        };
        let rings = if self.is_axisymmetric() { self.nodes() } else { 0 };
        Ok([along, (0..rings).map(around).collect()])
    }

    /// Returns the force dipoles (force times length) of what keeps the discs rigid in the loaded state.
    pub(crate) fn rigid_dipoles(&self) -> impl Iterator<Item = [[f64; 2]; 2]> {
        (1..=self.nuclei()).filter_map(|disc| self.flow.rigid_dipole(disc))
    }

    /// Returns the flow of the loaded state at points (length).
    pub(crate) fn sample(&mut self, points: &[Vec2]) -> Result<Vec<FlowSample>, SteadyError> {
        let mut samples = vec![FlowSample::default(); points.len()];
        self.flow.sample(points, &mut samples)?;
        let uniform = self.resistance.as_ref().map_or(Vec2::ZERO, |resistance| resistance.uniform());
        samples.iter_mut().for_each(|sample| sample.velocity += uniform);
        Ok(samples)
    }

    /// Returns the derivatives of area or volume and of the number of particles, over their values for the droplet at
    /// rest, by the offset and by the density of each node.
    pub(crate) fn conserved_gradients(&self, base: &Base) -> [(Vec<f64>, Vec<f64>); 2] {
        let [size, number] = self.conserved();
        let gradients = (0..self.nodes()).map(|k| {
            let (weight, n0) = (self.weight(k), base.normals[k]);
            let density = self.concentrations[k] * self.tangents[k].length();
            let by_radius = self
                .rings
                .as_ref()
                .map_or(0.0, |rings| rings.weights[k] * TAU * n0.y * self.positions[k].y.signum() * density / number);
            ((-self.tangents[k].perp()).dot(n0) * weight / size, (by_radius, weight / number))
        });
        let (by_offset, of_number): (Vec<f64>, (Vec<f64>, Vec<f64>)) = gradients.unzip();
        [(by_offset, vec![0.0; self.nodes()]), of_number]
    }

    /// dh/dt and dm/dt of the loaded state in a moving frame.
    pub(crate) fn rates(&mut self, base: &Base, frame: FrameMotion) -> Result<(&[f64], &[f64]), SteadyError> {
        let velocities = std::mem::take(&mut self.velocities);
        self.transport(base, |k, x| velocities[k] - frame_velocity(frame, x));
        self.velocities = velocities;
        self.carry(|nucleus| nucleus.velocity - frame_velocity(frame, nucleus.centre));
        analyse(&mut self.series, self.concentrations.iter())?;
        self.series.differentiate();
        for ((flux, slope), tangent) in self.flux.iter_mut().zip(self.series.values()).zip(&self.tangents) {
            *flux -= self.diffusion * slope.re / tangent.length();
        }
        self.divergence(base)?;
        self.exchange(frame)?;
        Ok((&self.offset_rates, &self.density_rates))
    }

    /// Adds the exchange with the inside to dm/dt.
    fn exchange(&mut self, frame: FrameMotion) -> Result<(), SteadyError> {
        let on = self.number();
        let Self { inside, flow, positions, tangents, concentrations, .. } = self;
        if let Some(field) = inside.as_mut().and_then(|inside| inside.field.as_mut()) {
            field.solve(Wall { positions, tangents, concentrations }, flow, |x| frame_velocity(frame, x))?;
        }
        let Some(inside) = &self.inside else { return Ok(()) };
        let gains: Vec<f64> = (0..self.nodes()).map(|node| self.gain(inside, on, node)).collect();
        self.density_rates.iter_mut().zip(gains).for_each(|(rate, gain)| *rate += gain);
        Ok(())
    }

    /// dh/dt and dm/dt that a rigid motion alone causes.
    pub(crate) fn rigid_rates(&mut self, base: &Base, motion: FrameMotion) -> Result<(&[f64], &[f64]), SteadyError> {
        self.transport(base, |_, x| frame_velocity(motion, x));
        self.carry(|nucleus| frame_velocity(motion, nucleus.centre));
        self.divergence(base)
    }

    /// dh/dt and the flux q c of a velocity.
    fn transport(&mut self, base: &Base, velocity: impl Fn(usize, Vec2) -> Vec2) {
        for (k, tangent) in self.tangents.iter().enumerate() {
            let (n0, n) = (base.normals[k], -tangent.perp());
            let w = velocity(k, self.positions[k]);
            let rate = w.dot(n) / n0.dot(n);
            self.offset_rates[k] = rate;
            self.flux[k] = (w - rate * n0).dot(tangent.normalize()) * self.concentrations[k];
        }
    }

    /// Returns the velocities of the discs as rates.
    fn carry(&mut self, velocity: impl Fn(&Nucleus) -> Vec2) {
        let nodes = self.nodes();
        for (k, nucleus) in self.nuclei.iter().enumerate() {
            let Vec2 { x, y } = velocity(nucleus);
            (self.offset_rates[nodes + k], self.density_rates[nodes + k]) = (x, y);
        }
    }

    /// dm/dt as the divergence of the flux; returns both rates.
    fn divergence(&mut self, base: &Base) -> Result<(&[f64], &[f64]), SteadyError> {
        if let Some(rings) = &self.rings {
            let densities = self.concentrations.iter().zip(&self.tangents).map(|(c, t)| c * t.length());
            let widening = self.offset_rates.iter().zip(&base.normals).map(|(rate, n0)| rate * n0.y);
            let nodes = self.positions.iter().zip(&self.tangents);
            rings.divergence(&mut self.series, nodes, densities.zip(widening), &self.flux, &mut self.density_rates)?;
        } else {
            analyse(&mut self.series, self.flux.iter())?;
            self.series.differentiate();
            for (rate, value) in self.density_rates.iter_mut().zip(self.series.values()) {
                *rate = -value.re;
            }
        }
        Ok((&self.offset_rates, &self.density_rates))
    }
}
