//! One active droplet in a box, from a few numbers.

use std::f64::consts::TAU;

use active_interface::{
    ActiveDroplet, ContractileTension, Curve, Flux, InitialConcentration, InterfaceError, Motion, StepExcludedVolume,
};
use ib_core::{AnyKernel, FlowError, Handle, ImmersedBoundary, Scene, StepSize, Vec2};
use stokes_grid::{Grid, PeriodicStokes, StokesError};

/// A scene that could not be set up.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetupError {
    /// The grid or the solver.
    #[error(transparent)]
    Stokes(#[from] StokesError),
    /// The droplet.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// The coupling.
    #[error(transparent)]
    Flow(#[from] FlowError),
    /// A box that does not hold a whole number of cells or is too small for the droplet.
    #[error("a box of {lx} x {ly} with cells of {spacing} {problem}")]
    Box {
        /// Length in x.
        lx: f64,
        /// Length in y.
        ly: f64,
        /// Grid spacing.
        spacing: f64,
        /// What is wrong, and the remedy.
        problem: &'static str,
    },
}

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

/// An active droplet in a periodic box, in the thesis' units (lengths in R0, Appendix A).
///
/// The default is the accurate method; [`Swimmer::thesis`] is the thesis' own.
#[derive(Debug, Clone, PartialEq)]
pub struct Swimmer {
    /// Activity zeta delta-mu (force times length), negative if contractile.
    pub activity: f64,
    /// Strength A of the excluded volume (2.41) (force times length).
    pub excluded_volume: f64,
    /// Viscosity of both fluids (stress times time).
    pub viscosity: f64,
    /// Diffusion constant of the particles (length squared per time).
    pub diffusion: f64,
    /// Mean concentration c0 (1/length).
    pub mean_concentration: f64,
    /// Bare tension gamma0 (force).
    pub bare_tension: f64,
    /// Radius R0 (length).
    pub radius: f64,
    /// Box lengths (length).
    pub lengths: [f64; 2],
    /// Grid spacing h (length).
    pub spacing: f64,
    /// Marker spacing (length); `None` for h/2.
    pub marker_spacing: Option<f64>,
    /// Kernel.
    pub kernel: AnyKernel,
    /// Whether the mobility correction is on.
    pub corrected: bool,
    /// How the markers move.
    pub motion: Motion,
    /// Flux of the particles.
    pub flux: Flux,
    /// Whether the area is put back after each step.
    pub area_constraint: bool,
    /// Direction of swimming at the start (radians).
    pub angle: f64,
    /// Position of the centre (length); the box is centred on the origin.
    pub offset: [f64; 2],
    /// Particles at the start.
    pub initial: InitialState,
    /// Time step.
    pub step: StepSize,
}

impl Default for Swimmer {
    fn default() -> Self {
        Self {
            activity: -2.0,
            excluded_volume: 10.0,
            viscosity: 100.0,
            diffusion: 0.1,
            mean_concentration: 100.0,
            bare_tension: 10.0,
            radius: 1.0,
            lengths: [6.0, 6.0],
            spacing: 0.05,
            marker_spacing: None,
            kernel: AnyKernel::BSpline4,
            corrected: true,
            motion: Motion::default(),
            flux: Flux::Weno5,
            area_constraint: false,
            angle: 0.0,
            offset: [0.0, 0.0],
            initial: InitialState::Polarised,
            step: StepSize::OfLimit(0.25),
        }
    }
}

/// The hydrodynamics of a droplet in a periodic box.
pub type PeriodicBox = ImmersedBoundary<PeriodicStokes, AnyKernel>;

impl Swimmer {
    /// The thesis' method: Peskin's 4-point function, no mobility correction, markers that move with the fluid and are
    /// inserted and removed, an area constraint, h = 0.05, markers h/2 apart, steps of 1e-3.
    #[must_use]
    pub fn thesis() -> Self {
        Self {
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
    fn cells(&self, length: f64) -> Result<usize, SetupError> {
        let [lx, ly] = self.lengths;
        let cells = length / self.spacing;
        let whole = cells.round();
        let problem = if !(cells.is_finite() && whole >= 2.0) {
            "has no cells: give positive finite lengths"
        } else if (cells - whole).abs() > 1e-6 * whole {
            "does not hold a whole number of cells: change the spacing or the box"
        } else if self.lengths.iter().any(|&l| l <= 2.0 * self.radius) {
            "is too small for the droplet: give it more than two radii each way"
        } else {
            return Ok(whole as usize);
        };
        Err(SetupError::Box { lx, ly, spacing: self.spacing, problem })
    }

    /// The tension law.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn tension(&self) -> Result<ContractileTension<StepExcludedVolume>, SetupError> {
        Ok(ContractileTension::thesis(self.bare_tension, self.activity, self.excluded_volume, self.mean_concentration)?)
    }

    /// The droplet alone.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn droplet(&self) -> Result<ActiveDroplet, SetupError> {
        let tension = self.tension()?;
        let spacing = self.marker_spacing.unwrap_or(0.5 * self.spacing);
        let curve =
            Curve::circle(self.radius)?.rotated(self.angle).translated(Vec2::new(self.offset[0], self.offset[1]));
        let markers = curve.markers(fast_count(TAU * self.radius / spacing))?;
        let numbers = self.numbers(&markers)?;
        let droplet = ActiveDroplet::new(&markers, numbers, tension, self.diffusion)?
            .with_motion(self.motion)
            .with_flux(self.flux)?
            .with_area_constraint(self.area_constraint);
        Ok(droplet)
    }

    fn numbers(&self, markers: &[Vec2]) -> Result<Vec<f64>, SetupError> {
        let c0 = self.mean_concentration;
        let initial = match self.initial {
            InitialState::Polarised => InitialConcentration::polarised(c0, self.angle)?,
            InitialState::Perturbed { amplitude, seed } => InitialConcentration::perturbed(c0, amplitude, seed)?,
        };
        Ok(initial.particle_numbers(markers)?)
    }

    /// The scene and the droplet in it.
    ///
    /// # Errors
    /// Parameters out of their range, a box that does not hold a whole number of cells.
    pub fn build(&self) -> Result<(Scene<PeriodicBox>, Handle<ActiveDroplet>), SetupError> {
        let droplet = self.droplet()?;
        let mut scene = self.scene()?;
        let droplet = scene.add(droplet);
        Ok((scene, droplet))
    }

    /// The scene without a droplet, for droplets made otherwise.
    ///
    /// # Errors
    /// Parameters out of their range, a box that does not hold a whole number of cells.
    pub fn scene(&self) -> Result<Scene<PeriodicBox>, SetupError> {
        let [lx, ly] = self.lengths;
        let grid = Grid::periodic(self.cells(lx)?, self.cells(ly)?, self.spacing)?;
        let solver = PeriodicStokes::new(grid, self.viscosity)?;
        let flow = if self.corrected {
            ImmersedBoundary::new(solver, self.kernel)
        } else {
            ImmersedBoundary::uncorrected(solver, self.kernel)
        };
        Ok(Scene::new(flow))
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
