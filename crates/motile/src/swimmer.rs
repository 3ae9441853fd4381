//! One active droplet in a box, from a few numbers.

use active_interface::{ActiveDroplet, ContractileTension, Curve, Flux, InitialConcentration, InterfaceError, Motion};
use ib_core::{AnyKernel, StepSize, Vec2};

use crate::{ContrastMethod, Method, SetupError};

/// How the particles are spread over the interface at the start.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum InitialState {
    /// `(1 - cos(theta - angle)) c0`: crowded at the rear of a droplet that swims at `angle` (thesis (2.46)).
    Polarised,
    /// Uniform with small random Fourier modes of relative amplitude `amplitude`, made from `seed`.
    Perturbed {
        /// Relative amplitude.
        amplitude: f64,
        /// Seed; the same seed gives the same droplet.
        seed: u64,
    },
}

/// An active droplet in a periodic box, a rigid channel or unbounded fluid, in the thesis' units (lengths in R0,
/// Appendix A): a scene from a few numbers.
///
/// The default is the accurate method; [`Swimmer::thesis`] is the thesis' own. [`Swimmer::build`] and
/// [`Swimmer::build_in_channel`] compute the flow as [`Swimmer::method`] says. For a type known at compile time there
/// are [`Swimmer::build_on_grid`], [`Swimmer::build_on_grid_in_channel`], [`Swimmer::build_without_grid`],
/// [`Swimmer::build_without_grid_in_channel`] and [`Swimmer::build_unbounded`]. Fields that a method has no use for are
/// ignored.
#[derive(Debug, Clone, PartialEq)]
pub struct Swimmer {
    /// Activity zeta delta-mu (force times length), negative if contractile.
    pub activity: f64,
    /// Strength A of the excluded volume (2.41) (force times length).
    pub excluded_volume: f64,
    /// Viscosity of the surroundings, and of the droplet unless it has its own (stress times time).
    pub viscosity: f64,
    /// Viscosity of the droplet (stress times time); `None` for that of the surroundings.
    pub viscosity_inside: Option<f64>,
    /// Diffusion constant of the particles (length squared per time).
    pub diffusion: f64,
    /// Mean concentration c0 (1/length).
    pub mean_concentration: f64,
    /// Bare tension gamma0 (force).
    pub bare_tension: f64,
    /// Radius R0 (length).
    pub radius: f64,
    /// Box lengths; in a channel its period and its width (length).
    pub lengths: [f64; 2],
    /// How the flow is computed.
    pub method: Method,
    /// How a grid treats a viscosity inside that differs from that of the surroundings.
    pub contrast: ContrastMethod,
    /// Grid spacing h (length).
    pub spacing: f64,
    /// Marker spacing on a grid (length); `None` for h/2.
    pub marker_spacing: Option<f64>,
    /// Shape nodes of the boundary integrals. With the default, and its cells of the concentration, all observables
    /// (speed, shape, stresslet, squirmer coefficients, active region, largest concentration) were within a per cent in
    /// boxes at activities of -4 and -5, and in a channel of width 2 at -4 except the stresslet (1.6 per cent). For the
    /// speed alone a third of it will do ([`crate::recommend`]).
    pub nodes: usize,
    /// Cells of the concentration, and markers, with boundary integrals; at least as many as nodes.
    pub concentration_cells: usize,
    /// Kernel.
    pub kernel: AnyKernel,
    /// Whether the mobility correction is on; without effect for [`Motion::WithFluid`], whose markers are not equally
    /// spaced.
    pub corrected: bool,
    /// How the markers move.
    pub motion: Motion,
    /// Flux of the particles.
    pub flux: Flux,
    /// Whether the area is put back to the initial one after each step.
    pub area_constraint: bool,
    /// Direction of swimming at the start (radians from the x axis).
    pub angle: f64,
    /// Position of the centre (length); the box is centred on the origin.
    pub offset: [f64; 2],
    /// Particles at the start.
    pub initial: InitialState,
    /// Time step of the scene's runs.
    pub step: StepSize,
}

impl Default for Swimmer {
    fn default() -> Self {
        Self {
            activity: -2.0,
            excluded_volume: 10.0,
            viscosity: 100.0,
            viscosity_inside: None,
            diffusion: 0.1,
            mean_concentration: 100.0,
            bare_tension: 10.0,
            radius: 1.0,
            lengths: [6.0, 6.0],
            method: Method::default(),
            contrast: ContrastMethod::default(),
            spacing: 0.05,
            marker_spacing: None,
            nodes: 72,
            concentration_cells: 288,
            kernel: AnyKernel::BSpline4,
            corrected: true,
            motion: Motion::default(),
            flux: Flux::Weno5,
            area_constraint: false,
            angle: 0.0,
            offset: [0.0, 0.0],
            initial: InitialState::Polarised,
            step: StepSize::default(),
        }
    }
}

impl Swimmer {
    /// The thesis' method: Peskin's 4-point function, no mobility correction, markers that move with the fluid and are
    /// inserted and removed, a smooth viscosity field, an area constraint, h = 0.05, markers h/2 apart, steps of 1e-3.
    /// What the thesis does not state is a reading of it: a first-order upwind flux; diffusion is implicit as in the
    /// default.
    #[must_use]
    pub fn thesis() -> Self {
        Self {
            method: Method::ImmersedBoundary,
            contrast: ContrastMethod::Arithmetic,
            kernel: AnyKernel::Peskin4,
            corrected: false,
            motion: Motion::WithFluid,
            flux: Flux::Upwind,
            area_constraint: true,
            step: StepSize::Fixed(1e-3),
            ..Self::default()
        }
    }

    /// Cells that a length takes.
    pub(crate) fn cells(&self, length: f64) -> Result<usize, SetupError> {
        let [lx, ly] = self.lengths;
        let cells = length / self.spacing;
        let whole = cells.round();
        let problem = if !(cells.is_finite() && whole >= 2.0) {
            "has no cells: give positive finite lengths"
        } else if (cells - whole).abs() > 1e-6 * whole {
            "does not hold a whole number of cells: change the spacing or the box"
        } else {
            return Ok(whole as usize);
        };
        Err(SetupError::Box { lx, ly, spacing: self.spacing, problem })
    }

    /// The tension law.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn tension(&self) -> Result<ContractileTension, SetupError> {
        Ok(ContractileTension::thesis(self.bare_tension, self.activity, self.excluded_volume, self.mean_concentration)?)
    }

    /// The droplet alone, as it is on a grid.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn droplet(&self) -> Result<ActiveDroplet, SetupError> {
        self.droplet_with(&self.circle_on_grid()?)
    }

    /// The markers of a circle on a grid.
    pub(crate) fn circle_on_grid(&self) -> Result<Vec<Vec2>, SetupError> {
        self.markers_along(&self.circle()?)
    }

    /// Markers along a curve at the spacing for a grid.
    pub(crate) fn markers_along(&self, curve: &Curve) -> Result<Vec<Vec2>, SetupError> {
        let spacing = self.marker_spacing.unwrap_or(0.5 * self.spacing);
        if !(spacing.is_finite() && spacing > 0.0) {
            return Err(InterfaceError::NotPositive { name: "the marker spacing", value: spacing }.into());
        }
        Ok(curve.markers(fast_count(curve.perimeter() / spacing))?)
    }

    pub(crate) fn circle(&self) -> Result<Curve, SetupError> {
        let centre = Vec2::new(self.offset[0], self.offset[1]);
        Ok(Curve::circle(self.radius)?.rotated(self.angle).translated(centre))
    }

    pub(crate) fn droplet_with(&self, markers: &[Vec2]) -> Result<ActiveDroplet, SetupError> {
        // A droplet that starts squeezed has the particles of the circle that it is squeezed from.
        let numbers = self.numbers(&self.circle()?.markers(markers.len())?)?;
        let droplet = ActiveDroplet::new(markers, numbers, self.tension()?, self.diffusion)?
            .with_motion(self.motion)
            .with_flux(self.flux)
            .with_area_constraint(self.area_constraint);
        Ok(match self.viscosity_inside {
            Some(inside) => droplet.with_viscosity_inside(inside)?,
            None => droplet,
        })
    }

    fn numbers(&self, markers: &[Vec2]) -> Result<Vec<f64>, SetupError> {
        let c0 = self.mean_concentration;
        let initial = match self.initial {
            InitialState::Polarised => InitialConcentration::polarised(c0, self.angle)?,
            InitialState::Perturbed { amplitude, seed } => InitialConcentration::perturbed(c0, amplitude, seed)?,
        };
        Ok(initial.particle_numbers(markers)?)
    }
}

/// The even number without prime factors above 5 nearest to `wanted`: transforms of such lengths are fast.
fn fast_count(wanted: f64) -> usize {
    let wanted = wanted.round().clamp(8.0, 1e7) as usize;
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
