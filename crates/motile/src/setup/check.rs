//! Checks of descriptions before any work.

use active_interface::Motion;
use ib_core::AnyKernel;
use motile_base::internal::Refuse as _;
use motile_base::{Region, TubeShape};
use motile_boundary_integrals::Settings;
use motile_scene::{StepSize, integrator::IntegratorKind};

use super::{
    DropletSetup, GridMethod, GridSolver, IntegralMethod, LayersMethod, Method, MethodKind, Setup,
    body::BodySetup,
    checked::{Checked, short},
};
use crate::SetupError;

/// Most cells of a grid in a direction, and in all.
const MOST_CELLS: [f64; 2] = [16_384.0, 1.7e7];

/// Least and largest relative accuracy of layers.
const TOLERANCES: [f64; 2] = [1e-15, 1e-3];
/// Sum of the forces on bodies in the plane, over the sum of their sizes, up to which it is zero to round-off.
pub(super) const BALANCED: f64 = 1e-12;

/// Largest width of a channel over its length by integrals: beyond it hyperbolic functions of their ratio overflow.
const WIDEST: f64 = 100.0;
/// Largest length of a channel over its width by integrals, whose work grows with this ratio.
const LONGEST: f64 = 1000.0;

impl Setup {
    /// Refuses a description that makes no scene: values out of their range, and values that do not fit together. What
    /// only shows when shapes are made is refused by [`Setup::build`].
    ///
    /// # Errors
    /// Returns [`SetupError::Value`] with the key, the value and what to give instead. Without the feature
    /// `without-symmetry`, returns an error for scenes that [`Setup::lacks_symmetry`].
    pub fn check(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        top.positive("viscosity", self.viscosity)?;
        if self.lacks_symmetry() {
            if !cfg!(feature = "without-symmetry") {
                let what = "this scene has droplets in three dimensions without symmetry, which this program was built \
                            without";
                let remedy = "Put the droplets on the x axis, heading along it, or use the program motile or Python";
                return Err(SetupError::refused(what, "", remedy));
            }
            return self.check_space();
        }
        self.check_friction()?;
        match self.region {
            Region::Tube { radius, .. } => {
                top.length("region.tube.radius", radius)?;
                self.check_tube()?;
            }
            Region::Box { lengths } => {
                top.length("region.box.lengths[0]", lengths[0])?;
                top.length("region.box.lengths[1]", lengths[1])?;
                self.check_sides(lengths)?;
            }
            Region::Channel { length, width, drive } | Region::SlipChannel { length, width, drive, .. } => {
                top.length("region.channel.length", length)?;
                top.length("region.channel.width", width)?;
                self.check_slip()?;
                let remedy = "the length is less than a hundredth of the width. Use a longer channel";
                let wide = self.method.kind() == MethodKind::Integral && width > WIDEST * length;
                top.require(!wide, "region.channel.length", length, remedy)?;
                let long = self.method.kind() == MethodKind::Integral && length > LONGEST * width;
                let most = short(LONGEST * width);
                let remedy = format!(
                    "this is more than {LONGEST} widths, but flow in a channel decays within a few widths. Use at \
                     most {most}"
                );
                top.require(!long, "region.channel.length", length, &remedy)?;
                top.finite("region.channel.drive.gradient", drive.gradient())?;
                top.finite("region.channel.drive.flux", drive.flux())?;
            }
            _ => {}
        }
        if self.region.is_axisymmetric() {
            self.check_revolution()?;
        }
        match &self.method {
            Method::Integral(integral) => integral.check("method.integral")?,
            Method::Layers(layers) => self.check_layers(layers)?,
            Method::Grid(grid) => self.check_grid(grid)?,
            Method::Harmonics(_) => {
                let remedy = "spherical harmonics compute droplets in three dimensions. Use region = \"space\", a \
                              tube, a slit or a box with three lengths, or the method integral";
                return top.refuse("method", &"harmonics", remedy);
            }
        }
        if let Some(tolerance) = self.tolerance {
            let [least, most] = TOLERANCES;
            let remedy = format!("use a number from {least:e} to {most:e}");
            let holds = (least..=most).contains(&tolerance);
            top.require(holds, "tolerance", tolerance, &remedy)?;
            self.computed("an accuracy of its own", &[MethodKind::Integral, MethodKind::Layers])?;
        }
        self.flow.check(self)?;
        if !self.flow.is_none() {
            self.computed("imposed flows", &[MethodKind::Integral])?;
        }
        if !self.walls.is_empty() {
            self.computed("rigid walls that stand in a channel", &[MethodKind::Integral])?;
        }
        self.check_steps()?;
        top.finite("least-gap", self.least_gap)?;
        for (number, body) in self.bodies() {
            self.able(body)?;
            body.check(&Checked { place: &format!("{}[{number}]", body.kind()[0]) }, self)?;
        }
        self.check_balance()?;
        self.check_suspensions()?;
        for (number, wall) in self.walls.iter().enumerate() {
            wall.check(&format!("walls[{number}]"), self)?;
        }
        self.check_correction()
    }

    /// Refuses steps, integrators and repulsions that cannot be used.
    pub(super) fn check_steps(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        let (key, value) = match self.step {
            StepSize::Fixed(dt) => ("step.fixed", dt.to_string()),
            StepSize::OfLimit(part) => ("step.of-limit", part.to_string()),
            StepSize::Adaptive { tolerance } => ("step.adaptive.tolerance", tolerance.to_string()),
            other => ("step", format!("{other:?}")),
        };
        if self.integrator == IntegratorKind::RungeKutta {
            self.check_no_diffusion()?;
        }
        self.step.check().or_else(|error| top.refuse(key, &value, error.to_string()))?;
        if let Some(repulsion) = self.repulsion {
            top.positive("repulsion.strength", repulsion.strength())?;
            top.positive("repulsion.range", repulsion.range())?;
        }
        Ok(())
    }

    /// Refuses friction of the fluid that is out of its range, or that the method does not have.
    fn check_friction(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        top.not_negative("friction", self.friction)?;
        if self.friction == 0.0 {
            return Ok(());
        }
        match self.method {
            Method::Grid(GridMethod { solver: GridSolver::Streamfunction, .. }) => Ok(()),
            Method::Grid(_) => {
                let remedy = "it has no friction of the fluid. Use \"streamfunction\", or leave the friction out";
                Checked { place: "method.grid" }.refuse("solver", &"projection", remedy)
            }
            _ => self.computed("friction of the fluid, because its Green's functions have none", &[MethodKind::Grid]),
        }
    }

    /// Refuses slip lengths out of their range, and slip where it is not computed.
    fn check_slip(&self) -> Result<(), SetupError> {
        let slip = self.region.slip();
        if slip == [0.0; 2] {
            return Ok(());
        }
        let checked = Checked { place: "region.channel" };
        for (number, length) in slip.into_iter().enumerate() {
            checked.not_negative(&format!("slip[{number}]"), length)?;
        }
        if let Method::Grid(GridMethod { solver: GridSolver::Projection | GridSolver::LaggedProjection, .. }) =
            self.method
        {
            let remedy = "it has no walls with slip, because its sines vanish on the walls. Use \"streamfunction\"";
            return Checked { place: "method.grid" }.refuse("solver", &"projection", remedy);
        }
        let remedy = "solids next to a wall would feel it without slip. Set it to 0, or remove the solids";
        checked.refuse_if(!self.solids.is_empty(), "slip", format!("{slip:?}"), remedy)?;
        let remedy = "slip exists along straight walls only: behind curved rigid walls the forces that hold the fluid \
                      would not be those on them. Set it to 0, or remove the walls";
        checked.refuse_if(!self.walls.is_empty(), "slip", format!("{slip:?}"), remedy)
    }

    /// Refuses forces in the plane that do not add up to zero: nothing holds a fluid that is pushed.
    fn check_balance(&self) -> Result<(), SetupError> {
        if self.region != Region::Plane {
            return Ok(());
        }
        for axis in 0..2 {
            let bodies = self.droplets.iter().map(|droplet| droplet.force[axis]);
            let first = self.droplets.len();
            let all: Vec<f64> = bodies.chain(self.rigid_bodies.iter().map(|body| body.force[axis])).collect();
            let (sum, most) = (all.iter().sum::<f64>(), all.iter().copied().map(f64::abs).sum::<f64>());
            let pushed = all.iter().rposition(|force| *force != 0.0);
            if let Some(last) = pushed.filter(|_| sum.abs() > BALANCED * most) {
                let remedy = format!(
                    "in the plane nothing holds a fluid that is pushed, and the forces on all bodies add up to {}: \
                     set this force to {}, or use a box or a channel",
                    short(sum),
                    short(all[last] - sum)
                );
                let place = match last.checked_sub(first) {
                    Some(body) => format!("rigid-bodies[{body}]"),
                    None => format!("droplets[{last}]"),
                };
                return Checked { place: &place }.refuse("force", &all[last], remedy);
            }
        }
        Ok(())
    }

    /// Refuses a force per area where no speed follows from it.
    pub(super) fn check_body_force(&self, checked: &Checked<'_>, force: [f64; 2]) -> Result<(), SetupError> {
        let Some(axis) = force.iter().position(|part| *part != 0.0) else { return Ok(()) };
        let key = format!("body-force[{axis}]");
        let remedy = "in the plane nothing holds a fluid that is pushed, so that no speed exists (Stokes' paradox). \
                      Use a box or a channel";
        checked.require(self.region != Region::Plane, &key, force[axis], remedy)
    }

    /// Refuses a box that is too narrow for the sums over its images.
    fn check_sides(&self, [x, y]: [f64; 2]) -> Result<(), SetupError> {
        let most = Settings::LARGEST_PERIOD_RATIO;
        if self.method.kind() != MethodKind::Integral || x.max(y) <= most * x.min(y) {
            return Ok(());
        }
        let (key, value) = if x < y { ("lengths[0]", x) } else { ("lengths[1]", y) };
        let remedy = format!("this is less than a {most:.0}th of the other side. Use a wider box");
        Checked { place: "region.box" }.refuse(key, &value, remedy)
    }

    /// Refuses a tube whose wall, drive or length cannot be.
    pub(super) fn check_tube(&self) -> Result<(), SetupError> {
        let top = Checked { place: "" };
        let Region::Tube { shape, drive, .. } = self.region else { return Ok(()) };
        self.region.check().or_else(|error| top.refuse("region.tube", &"given", error.to_string()))?;
        let remedy = "a pressure can be prescribed in straight tubes only. Use zero-flux or a flux";
        let pressed = shape != TubeShape::Straight && drive.flux().is_none();
        top.refuse_if(pressed, "region.tube.drive", format!("{drive:?}"), remedy)
    }

    /// Refuses particles and gels, parts of whose motion are stiffer than an integrator without implicit parts steps.
    fn check_no_diffusion(&self) -> Result<(), SetupError> {
        let has = self.droplets.iter().any(|droplet| droplet.particles.is_some() || droplet.gel.is_some())
            || self.interfaces.iter().any(|interface| interface.particles.is_some() || interface.gel.is_some())
            || !self.gels.is_empty();
        let remedy = "it cannot step particles or gels, because their diffusion is implicit. Use \"midpoint\" or \
                      \"runge-kutta-chebyshev\"";
        Checked { place: "" }.refuse_if(has, "integrator", "runge-kutta", remedy)
    }

    /// Refuses what has no meaning or no method for bodies of revolution in three dimensions.
    fn check_revolution(&self) -> Result<(), SetupError> {
        let refuse_if = |wrong: bool, place: &str, key: &str, value: &dyn std::fmt::Display, remedy: &str| {
            Checked { place }.refuse_if(wrong, key, value, format!("{remedy}, or use a two-dimensional region"))
        };
        let kind = self.method.kind();
        let remedy = "the grid is two-dimensional, but this region is axisymmetric. Use integral";
        refuse_if(kind != MethodKind::Integral, "", "method", &kind.name(), remedy)?;
        let planar = [
            ("solids", self.solids.len()),
            ("rigid-bodies", self.rigid_bodies.len()),
            ("shells", self.shells.len()),
            ("fibres", self.fibres.len()),
            ("gels", self.gels.len()),
            ("walls", self.walls.len()),
            ("interfaces", self.interfaces.len()),
        ];
        for (key, count) in planar {
            refuse_if(count > 0, "", key, &count, "these bodies exist in two dimensions only. Remove them")?;
        }
        for (number, droplet) in self.droplets.iter().enumerate() {
            let DropletSetup { centre, angle, motion, gel, particles, body_force, force, .. } = droplet;
            let refuse_if = |wrong: bool, key: &str, value: &dyn std::fmt::Display, remedy: &str| {
                refuse_if(wrong, &format!("droplets[{number}]"), key, value, remedy)
            };
            let remedy = "axisymmetric bodies lie on the x axis. Use 0";
            refuse_if(centre[1] != 0.0, "centre[1]", &centre[1], remedy)?;
            let remedy = "an axisymmetric droplet swims along the x axis. Use 0, or pi for backwards";
            refuse_if(angle.sin().abs() > 1e-12, "angle", angle, remedy)?;
            let remedy = "a force across the axis would push the droplet off it. Use 0";
            refuse_if(body_force[1] != 0.0, "body-force[1]", &body_force[1], remedy)?;
            refuse_if(force[1] != 0.0, "force[1]", &force[1], remedy)?;
            let remedy = "markers that move with the fluid lose their mirror images. Use equidistributed";
            refuse_if(*motion == Motion::WithFluid, "motion", &"with-fluid", remedy)?;
            refuse_if(gel.is_some(), "gel", &"given", "gels exist in two dimensions only. Remove the gel")?;
            let exchange = particles.is_some_and(|particles| particles.exchange.is_some());
            refuse_if(
                exchange,
                "particles.exchange",
                &"given",
                "the exchange is implemented in two dimensions only. Remove the key",
            )?;
        }
        Ok(())
    }

    /// Refuses a body that the method cannot compute.
    pub(super) fn able(&self, body: &dyn BodySetup) -> Result<(), SetupError> {
        body.needs().map_or(Ok(()), |(what, able)| self.computed(what, able))
    }

    /// Refuses what no other methods than those that are `able` compute, where the scene's is not among them.
    fn computed(&self, what: &str, able: &[MethodKind]) -> Result<(), SetupError> {
        let kind = self.method.kind();
        if able.contains(&kind) {
            return Ok(());
        }
        let able = able.iter().map(|kind| kind.name()).collect::<Vec<_>>().join(" or ");
        Checked { place: "" }.refuse("method", &kind.name(), format!("it does not support {what}. Use {able}"))
    }

    fn check_grid(&self, grid: &GridMethod) -> Result<(), SetupError> {
        let checked = Checked { place: "method.grid" };
        checked.positive("spacing", grid.spacing)?;
        checked.positive("marker-spacing", grid.marker_spacing)?;
        self.cells(grid.spacing, self.region.lengths())?;
        let mut droplets = self.droplets.iter();
        let remedy = "markers that move with the fluid are not equally spaced. Use false, or droplets with \
                      equidistributed markers";
        let carried = !self.droplets.is_empty() && droplets.all(|droplet| droplet.motion == Motion::WithFluid);
        checked.refuse_if(grid.corrected && carried, "corrected", true, remedy)
    }

    /// Refuses the mobility correction if nothing has one.
    fn check_correction(&self) -> Result<(), SetupError> {
        if !matches!(self.method, Method::Grid(GridMethod { corrected: true, .. })) {
            return Ok(());
        }
        for (what, present) in [("viscosity contrasts", self.has_contrast()), ("solids", !self.solids.is_empty())] {
            let remedy =
                format!("the mobility correction cannot handle {what} on the grid. Use false, or the method layers");
            Checked { place: "method.grid" }.refuse_if(present, "corrected", true, remedy)?;
        }
        Ok(())
    }

    fn check_layers(&self, layers: &LayersMethod) -> Result<(), SetupError> {
        let checked = Checked { place: "method.layers" };
        let LayersMethod { nodes, elements, spacing, kernel } = *layers;
        IntegralMethod { nodes, elements }.check("method.layers")?;
        checked.positive("spacing", spacing)?;
        self.cells(spacing, self.region.lengths())?;
        if self.spreads() {
            self.cells(0.5 * spacing, self.region.lengths())?;
        }
        if let AnyKernel::Peskin4 | AnyKernel::Roma3 | AnyKernel::Gaussian6 = kernel {
            let remedy = "with this kernel solids lose volume. Use a composite B-spline, such as bspline4";
            checked.refuse("kernel", &format!("{kernel:?}"), remedy)?;
        }
        Ok(())
    }

    /// Returns the cells of the grid over these lengths.
    pub(super) fn cells(&self, spacing: f64, lengths: [f64; 2]) -> Result<[usize; 2], SetupError> {
        let place = format!("method.{}", self.method.kind().name());
        let checked = Checked { place: &place };
        let counts = lengths.map(|length| length / spacing);
        let product: f64 = counts.iter().product();
        for (length, cells) in lengths.into_iter().zip(counts) {
            let whole = cells.round();
            let [most, in_all] = MOST_CELLS;
            let remedy = "the plane is unbounded, so no grid covers it. Use a box or a channel, or the method integral";
            Checked { place: "" }.refuse_if(length.is_infinite(), "region", "plane", remedy)?;
            if cells > most || product > in_all {
                let count = if cells < 1e6 { format!("{cells:.0}") } else { format!("{cells:.1e}") };
                let remedy = format!(
                    "a length of {} would need {count} cells, {product:.1e} in all. Use a larger spacing",
                    short(length)
                );
                return checked.refuse("spacing", &spacing, remedy);
            }
            if whole < 4.0 || (cells - whole).abs() > 1e-6 * whole {
                // As many digits as it takes to divide the length.
                let nearest: f64 = format!("{:.7e}", length / whole.max(4.0)).parse().unwrap_or(spacing);
                let remedy = format!(
                    "a length of {} is not a whole number of at least 4 cells. Use {}, for example",
                    short(length),
                    short(nearest)
                );
                return checked.refuse("spacing", &spacing, remedy);
            }
        }
        Ok(counts.map(|cells| cells.round() as usize))
    }
}
