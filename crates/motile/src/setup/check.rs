//! What descriptions must be, checked before any work.

use ib_core::{AnyKernel, StepSize};
use stokes_grid::Drive;

use super::{
    Contrast, DropletSetup, DropletShape, ExchangeSetup, Exclusion, Grading, GridMethod, Hold, IntegralMethod,
    MarkerMotion, Method, Region, RigidBodySetup, RigidSetup, Setup, ShellSetup, SkinSetup, SolidOutline, SolidSetup,
    Start, Surface,
};
use crate::SetupError;

/// Most cells of a grid in a direction, and in all.
const MOST_CELLS: [f64; 2] = [16_384.0, 1.7e7];
/// Markers of an interface, and cells of its concentration.
const MARKERS: [f64; 2] = [8.0, super::build::MOST_MARKERS];
/// Largest length over the grid spacing that a solid may have.
const MOST_ACROSS: f64 = 1e5;

/// Values with their place in the description.
pub(super) struct Checked<'a> {
    place: &'a str,
}

impl Checked<'_> {
    pub(super) fn refuse<T>(
        &self,
        key: &str,
        value: &dyn std::fmt::Display,
        remedy: impl Into<String>,
    ) -> Result<T, SetupError> {
        let key = if self.place.is_empty() { key.to_owned() } else { format!("{}.{key}", self.place) };
        Err(SetupError::Value { key, value: value.to_string(), remedy: remedy.into() })
    }

    fn require(&self, holds: bool, key: &str, value: f64, remedy: &str) -> Result<(), SetupError> {
        if holds { Ok(()) } else { self.refuse(key, &value, remedy) }
    }

    pub(super) fn positive(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite() && value > 0.0, key, value, "give a positive finite number")
    }

    pub(super) fn not_negative(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite() && value >= 0.0, key, value, "give a finite number that is not negative")
    }

    pub(super) fn finite(&self, key: &str, value: f64) -> Result<(), SetupError> {
        self.require(value.is_finite(), key, value, "give a finite number")
    }

    fn all_finite(&self, key: &str, values: &[f64]) -> Result<(), SetupError> {
        values.iter().try_for_each(|&value| self.finite(key, value))
    }
}

impl Setup {
    /// Refuses a description that makes no scene: values out of their range, and values that do not fit together. What
    /// only shows when shapes are made is refused by [`Setup::build`].
    ///
    /// # Errors
    /// [`SetupError::Value`] with the key, the value and what to give instead.
    pub fn check(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        top.positive("viscosity", self.viscosity)?;
        match self.region {
            Region::Plane => {}
            Region::Box { lengths } => {
                top.positive("region.box.lengths[0]", lengths[0])?;
                top.positive("region.box.lengths[1]", lengths[1])?;
            }
            Region::Channel { length, width, drive } => {
                top.positive("region.channel.length", length)?;
                top.positive("region.channel.width", width)?;
                match drive {
                    Drive::Gradient(value) => top.finite("region.channel.drive.gradient", value)?,
                    Drive::Flux(value) => top.finite("region.channel.drive.flux", value)?,
                    Drive::ZeroGradient | Drive::ZeroFlux => {}
                }
            }
        }
        match &self.method {
            Method::Integral(integral) => self.check_integral(integral)?,
            Method::Grid(grid) => self.check_grid(grid)?,
        }
        let (key, value) = match self.step {
            StepSize::Fixed(dt) => ("step.fixed", dt),
            StepSize::OfLimit(part) => ("step.of-limit", part),
            StepSize::Adaptive { tolerance } => ("step.adaptive.tolerance", tolerance),
        };
        self.step.check().or_else(|error| top.refuse(key, &value, error.to_string()))?;
        if let Some(repulsion) = self.repulsion {
            top.positive("repulsion.strength", repulsion.strength)?;
            top.positive("repulsion.range", repulsion.range)?;
        }
        if let Some(bound) = self.least_gap {
            top.finite("least-gap", bound)?;
        }
        for (number, droplet) in self.droplets.iter().enumerate() {
            droplet.check(&format!("droplets[{number}]"))?;
        }
        for (number, solid) in self.solids.iter().enumerate() {
            solid.check(&format!("solids[{number}]"), self)?;
        }
        for (number, body) in self.rigid_bodies.iter().enumerate() {
            let (place, held) = (format!("rigid-bodies[{number}]"), self.region != Region::Plane);
            body.check(&Checked { place: &place }, held)?;
        }
        for (number, shell) in self.shells.iter().enumerate() {
            shell.check(&Checked { place: &format!("shells[{number}]") })?;
        }
        for (number, wall) in self.rigid.iter().enumerate() {
            wall.check(&format!("rigid[{number}]"), self)?;
        }
        Ok(())
    }

    fn check_integral(&self, integral: &IntegralMethod) -> Result<(), SetupError> {
        integral.check("method.integral")?;
        if !self.solids.is_empty() {
            return Err(SetupError::needs_a_grid("solids"));
        }
        if self.droplets.iter().any(|droplet| droplet.gel.is_some()) {
            return Err(SetupError::needs_a_grid("gels"));
        }
        Ok(())
    }

    fn check_grid(&self, grid: &GridMethod) -> Result<(), SetupError> {
        let checked = Checked { place: "method.grid" };
        checked.positive("spacing", grid.spacing)?;
        if let Some(spacing) = grid.marker_spacing {
            checked.positive("marker-spacing", spacing)?;
        }
        self.cells(grid, self.region.lengths())?;
        if self.has_layers() {
            return self.check_layers(grid);
        }
        if grid.contrast == Contrast::Sharp && self.is_nested() {
            let remedy = "interfaces between different viscosities that lie in one another are layers, and so are the \
                          surfaces of solids beside them: give layer";
            Checked { place: "solids[0]" }.refuse("surface", &"plain", remedy)?;
        }
        let (with_fluid, equal): (Vec<_>, Vec<_>) =
            self.droplets.iter().partition(|droplet| droplet.motion == MarkerMotion::WithFluid);
        if !with_fluid.is_empty() && equal.is_empty() {
            for (key, set) in [("corrected", grid.corrected), ("filter", grid.filter)] {
                if set {
                    let remedy = "markers that move with the fluid are not equally spaced: give false, or droplets \
                                  with equidistributed markers";
                    checked.refuse(key, &true, remedy)?;
                }
            }
        }
        if self.has_contrast() && grid.corrected && grid.contrast == Contrast::Arithmetic {
            let remedy = "an arithmetic contrast has no mobility correction: give false, or a sharp contrast";
            checked.refuse("corrected", &true, remedy)?;
        }
        Ok(())
    }

    fn check_layers(&self, grid: &GridMethod) -> Result<(), SetupError> {
        let checked = Checked { place: "method.grid" };
        grid.layers.check("method.grid.layers")?;
        if let Some(spacing) = grid.marker_spacing {
            checked.refuse("marker-spacing", &spacing, "layers have a number of cells: leave it out")?;
        }
        if grid.contrast == Contrast::Arithmetic {
            checked.refuse("contrast", &"arithmetic", "layers have none: give sharp, or plain surfaces of solids")?;
        }
        if let (AnyKernel::Peskin4 | AnyKernel::Roma3 | AnyKernel::Gaussian6, false) =
            (grid.kernel, self.solids.is_empty())
        {
            let remedy = "solids lose volume to layers with it: give a composite B-spline, such as bspline4, or plain \
                          surfaces of solids";
            checked.refuse("kernel", &format!("{:?}", grid.kernel), remedy)?;
        }
        if let Some(number) = self.droplets.iter().position(|droplet| droplet.gel.is_some()) {
            let remedy = "the grid hardly sees the gel's forces so close to a layer: take the gel away, or give plain \
                          surfaces of solids and neither rigid bodies nor interfaces in one another";
            Checked { place: &format!("droplets[{number}]") }.refuse("gel", &"a gel", remedy)?;
        }
        for (number, solid) in self.solids.iter().enumerate() {
            let place = Checked { place: &format!("solids[{number}]") };
            if solid.surface == Surface::Plain {
                place.refuse("surface", &"plain", "others are layers: give layer, or plain for all")?;
            }
            let least = 2.0 * grid.spacing;
            if let Some(spacing) = solid.mesh_spacing.filter(|spacing| *spacing < least * (1.0 - 1e-9)) {
                let remedy = format!(
                    "the grid hardly sees inner points so close to a layer: give {least} or more, or plain \
                     surfaces"
                );
                place.refuse("mesh-spacing", &spacing, remedy)?;
            }
        }
        Ok(())
    }

    /// Cells of the grid over these lengths.
    pub(super) fn cells(&self, grid: &GridMethod, lengths: [f64; 2]) -> Result<[usize; 2], SetupError> {
        let checked = Checked { place: "method.grid" };
        let counts = lengths.map(|length| length / grid.spacing);
        let product: f64 = counts.iter().product();
        for (length, cells) in lengths.into_iter().zip(counts) {
            let whole = cells.round();
            let [most, in_all] = MOST_CELLS;
            if length.is_infinite() {
                let remedy = "the plane has no grid: give a box or a channel, or the method of boundary integrals";
                return Checked { place: "" }.refuse("region", &"plane", remedy);
            }
            if cells > most || product > in_all {
                let remedy =
                    format!("a length of {length} would take {cells:.0} cells, {product:.1e} in all: give more");
                return checked.refuse("spacing", &grid.spacing, remedy);
            }
            if whole < 4.0 || (cells - whole).abs() > 1e-6 * whole {
                let nearest = length / whole.max(4.0);
                let remedy =
                    format!("a length of {length} is not a whole number of at least 4 cells: give {nearest}, say");
                return checked.refuse("spacing", &grid.spacing, remedy);
            }
        }
        Ok(counts.map(|cells| cells.round() as usize))
    }
}

impl IntegralMethod {
    fn check(&self, place: &str) -> Result<(), SetupError> {
        let (checked, Self { nodes, cells }) = (Checked { place }, *self);
        let [least, most] = Self::NODES;
        if !(least..=most).contains(&nodes) {
            checked.refuse("nodes", &nodes, format!("give a number from {least} to {most}"))?;
        }
        if cells < nodes || cells as f64 > MARKERS[1] {
            let remedy = format!("give a number from {nodes}, that of the nodes, to {}", MARKERS[1]);
            checked.refuse("cells", &cells, remedy)?;
        }
        Ok(())
    }
}

impl DropletShape {
    fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        match self {
            Self::Round { radius } => checked.positive("shape.round.radius", *radius),
            Self::Squeezed { radius, half_height, .. } => {
                checked.positive("shape.squeezed.radius", *radius)?;
                checked.positive("shape.squeezed.half-height", *half_height)?;
                let (key, remedy) = ("shape.squeezed.half-height", "give less than the radius");
                checked.require(half_height <= radius, key, *half_height, remedy)
            }
            Self::Ellipse { half_axes } => {
                half_axes.iter().try_for_each(|&axis| checked.positive("shape.ellipse.half-axes", axis))
            }
            Self::Modes { radius, cosines, sines } => {
                checked.positive("shape.modes.radius", *radius)?;
                checked.all_finite("shape.modes.cosines", cosines)?;
                checked.all_finite("shape.modes.sines", sines)
            }
            Self::Points(points) => {
                if points.len() < 8 || points.len() as f64 > MARKERS[1] {
                    let remedy = format!("give from {} to {} points", MARKERS[0], MARKERS[1]);
                    checked.refuse("shape.points", &format!("{} points", points.len()), remedy)?;
                }
                checked.all_finite("shape.points", points.as_flattened())
            }
        }
    }
}

impl RigidBodySetup {
    fn check(&self, checked: &Checked<'_>, held: bool) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        checked.all_finite("force", &self.force)?;
        checked.finite("torque", self.torque)?;
        for &force in self.force.iter().filter(|_| !held) {
            let remedy = "in the plane nothing holds a fluid that is pushed: give 0, or a box or a channel";
            checked.require(force == 0.0, "force", force, remedy)?;
        }
        self.shape.check(checked)
    }
}

impl ShellSetup {
    fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        if let Some(viscosity) = self.viscosity {
            checked.positive("viscosity", viscosity)?;
        }
        checked.not_negative("stretching", self.stretching)?;
        checked.not_negative("bending", self.bending)?;
        if let Some(curvature) = self.reference_curvature {
            checked.finite("reference-curvature", curvature)?;
        }
        self.shape.check(checked)
    }
}

impl DropletSetup {
    fn check(&self, place: &str) -> Result<(), SetupError> {
        let checked = Checked { place };
        checked.all_finite("centre", &self.centre)?;
        checked.finite("angle", self.angle)?;
        if let Some(viscosity) = self.viscosity {
            checked.positive("viscosity", viscosity)?;
        }
        checked.not_negative("tension", self.tension)?;
        if let MarkerMotion::Equidistributed { relaxation } = self.motion {
            checked.not_negative("motion.equidistributed.relaxation", relaxation)?;
        }
        self.shape.check(&checked)?;
        self.gel.map_or(Ok(()), |gel| gel.check(&checked, self))?;
        let Some(particles) = &self.particles else { return Ok(()) };
        checked.finite("particles.activity", particles.activity)?;
        checked.not_negative("particles.diffusion", particles.diffusion)?;
        checked.positive("particles.concentration", particles.concentration)?;
        let (key, tension) = ("particles.activity", particles.activity * particles.concentration);
        let remedy = "the tension that it makes at the mean concentration is not finite: give less";
        checked.require(tension.is_finite(), key, particles.activity, remedy)?;
        match particles.excluded_volume {
            Exclusion::None => {}
            Exclusion::Step(strength) => checked.not_negative("particles.excluded-volume.step", strength)?,
            Exclusion::Quadratic(strength) => checked.not_negative("particles.excluded-volume.quadratic", strength)?,
        }
        if let Some(ExchangeSetup { binding, unbinding, number_inside, diffusion_inside, spacing_inside }) =
            particles.exchange
        {
            checked.not_negative("particles.exchange.binding", binding)?;
            checked.not_negative("particles.exchange.unbinding", unbinding)?;
            let inside = [("diffusion-inside", diffusion_inside), ("spacing-inside", spacing_inside)];
            for (key, value) in inside.into_iter().filter_map(|(key, value)| Some((key, value?))) {
                checked.positive(&format!("particles.exchange.{key}"), value)?;
            }
            if diffusion_inside.is_some() && self.motion == MarkerMotion::WithFluid {
                let remedy = "a droplet with a mesh inside needs a fixed number of markers: give equidistributed ones";
                checked.refuse("motion", &"with-fluid", remedy)?;
            }
            let key = "particles.exchange.number-inside";
            match number_inside {
                Some(number) => checked.not_negative(key, number)?,
                None => {
                    let remedy = "nothing that unbinds comes back, so that no number inside is at rest: give one";
                    checked.require(
                        binding > 0.0 || unbinding == 0.0,
                        "particles.exchange.binding",
                        binding,
                        remedy,
                    )?;
                }
            }
        }
        let Start::Perturbed { amplitude, .. } = particles.start else { return Ok(()) };
        let (key, holds) = ("particles.start.perturbed.amplitude", (0.0..1.0).contains(&amplitude));
        checked.require(holds, key, amplitude, "give a number from 0 to below 1")
    }
}

impl RigidSetup {
    fn check(&self, place: &str, setup: &Setup) -> Result<(), SetupError> {
        let checked = Checked { place };
        checked.positive("spacing", self.spacing)?;
        checked.not_negative("rounding", self.rounding)?;
        let remedy = "rigid walls stand in a channel, wider than they are, without a grid: give such a region, and the \
                      method of boundary integrals";
        if !matches!((setup.region, &setup.method), (Region::Channel { .. }, Method::Integral(_))) {
            checked.refuse("outline", &"a rigid wall", remedy)?;
        }
        Ok(())
    }
}

impl SolidSetup {
    fn check(&self, place: &str, setup: &Setup) -> Result<(), SetupError> {
        let checked = Checked { place };
        let Method::Grid(grid) = &setup.method else { return Err(SetupError::needs_a_grid("solids")) };
        if let Some(spacing) = self.mesh_spacing {
            checked.positive("mesh-spacing", spacing)?;
        }
        if let Some(SkinSetup { stretching, bending }) = self.skin {
            checked.not_negative("skin.stretching", stretching)?;
            checked.not_negative("skin.bending", bending)?;
        }
        let spacing = self.mesh_spacing.unwrap_or(grid.spacing);
        let across = |key: &str, length: f64| {
            let remedy = format!("with points {spacing} apart it would have too many of them: give less");
            checked.require(length / spacing <= MOST_ACROSS, key, length, &remedy)
        };
        match &self.outline {
            SolidOutline::WallBelow(shape)
            | SolidOutline::WallAbove(shape)
            | SolidOutline::Island { of: shape, .. } => {
                let outline = match &self.outline {
                    SolidOutline::WallBelow(_) => "outline.wall-below".to_owned(),
                    SolidOutline::WallAbove(_) => "outline.wall-above".to_owned(),
                    _ => "outline.island.of".to_owned(),
                };
                if !matches!(setup.region, Region::Channel { .. }) {
                    checked.refuse("outline", &"a wall or an island", "give a region that is a channel")?;
                }
                let (width, height) = (shape.width(), setup.region.lengths()[1]);
                let key = format!("{outline}.{}.width", shape.name());
                checked.positive(&key, width)?;
                across(&key, height.max(setup.region.lengths()[0]))?;
                let remedy = format!("give less than {height}, the width of the region, so that the walls have room");
                checked.require(self.side().is_none() || width < height, &key, width, &remedy)?;
                let islands = shape.islands();
                if let SolidOutline::Island { number, .. } = self.outline {
                    let remedy = format!("a {} channel has {islands}, counted from 0", shape.name());
                    checked.require(number < islands, "outline.island.number", number as f64, &remedy)?;
                }
            }
            SolidOutline::Disc { centre, radius } => {
                checked.all_finite("outline.disc.centre", centre)?;
                checked.positive("outline.disc.radius", *radius)?;
                across("outline.disc.radius", *radius)?;
            }
            SolidOutline::Ellipse { centre, half_axes } => {
                checked.all_finite("outline.ellipse.centre", centre)?;
                for &axis in half_axes {
                    checked.positive("outline.ellipse.half-axes", axis)?;
                    across("outline.ellipse.half-axes", axis)?;
                }
            }
            SolidOutline::Polygon { corners, fillet } => {
                checked.all_finite("outline.polygon.corners", corners.as_flattened())?;
                checked.not_negative("outline.polygon.fillet", *fillet)?;
                for length in corners.as_flattened() {
                    across("outline.polygon.corners", length.abs())?;
                }
            }
        }
        if self.hold == Hold::Pinned && self.side().is_none() {
            let remedy = "only walls reach the rigid walls of the region: give tethered or free";
            checked.refuse("hold", &"pinned", remedy)?;
        }
        if let Hold::Tethered { stiffness } = self.hold {
            checked.positive("hold.tethered.stiffness", stiffness)?;
        }
        if let Grading::Along { factors, .. } = &self.grading {
            factors.iter().try_for_each(|[place, factor]| {
                checked.finite("grading.along.factors", *place)?;
                checked.positive("grading.along.factors", *factor)
            })?;
            if factors.is_empty() || !factors.windows(2).all(|pair| pair[0][0] < pair[1][0]) {
                let remedy = "give at least one place with its factor, places increasing";
                checked.refuse("grading.along.factors", &format!("{factors:?}"), remedy)?;
            }
        }
        self.material.check(&checked)
    }
}

impl super::Material {
    fn check(&self, checked: &Checked<'_>) -> Result<(), SetupError> {
        let (name, bulk) = match *self {
            Self::Springs { .. } => ("springs", None),
            Self::NeoHookean { bulk, .. } => ("neo-hookean", Some(bulk)),
            Self::SaintVenantKirchhoff { bulk, .. } => ("saint-venant-kirchhoff", Some(bulk)),
            Self::MooneyRivlin { bulk, .. } => ("mooney-rivlin", Some(bulk)),
        };
        let key = |entry: &str| format!("material.{name}.{entry}");
        checked.positive(&key("shear"), self.shear())?;
        bulk.map_or(Ok(()), |bulk| checked.positive(&key("bulk"), bulk))?;
        match *self {
            Self::MooneyRivlin { fraction, .. } => {
                let holds = (0.0..=1.0).contains(&fraction);
                checked.require(holds, &key("fraction"), fraction, "give a number from 0 to 1")
            }
            _ => Ok(()),
        }
    }
}
