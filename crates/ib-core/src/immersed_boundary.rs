//! The immersed boundary method: a grid between markers.

mod contrast_flow;
pub(crate) mod sampling;
mod smeared_contrast;

pub use smeared_contrast::SmearedContrast;

use input_checks::{all_points_finite, same_length};
use stokes_grid::{CentreField, Drive, Grid, SolveReport, StaggeredField, StokesSolver};

use crate::contrast::other_viscosities;
use crate::mobility::{MobilityCorrection, MobilityDeficit};
use crate::{
    Discretisation, Domain, FlowError, FlowSample, Hydrodynamics, Kernel, MarkerKind, Markers, Transfer, Vec2,
    checkpoint::SavedState, hydrodynamics::FlowWork,
};
use contrast_flow::ContrastFlow;

/// How far beyond a wall a marker may lie, in grid spacings.
pub(crate) const WALL_TOLERANCE: f64 = 0.25;

/// Velocities of markers by spreading their forces to a grid, solving the Stokes equations there and interpolating
/// (Cowley section 2.2.2), with the mobility correction on interfaces of equally spaced markers (on by default).
///
/// Only [`MarkerKind::Interface`] is corrected; the order of the markers' velocities is then two, else one.
/// [`Hydrodynamics::sample`] interpolates bilinearly between grid points: second order further than the kernel's reach
/// from interfaces, first order within it.
///
/// **Other viscosities inside interfaces.** The grid solves for one viscosity, that of the exterior fluid; where a
/// group of markers has another one inside, the boundary integral equation
///
/// `(eta_in + eta)/2 v(x) = eta u(x) - (eta_in - eta)/(4 pi) PV INT v(y) T(x, y) n ds`
///
/// gives its velocity v from the grid's velocity u, with the stress T of the Green's function of the box or channel, n
/// outward (Pozrikidis, Boundary Integral and Singularity Methods, 1992). It is solved on the markers by GMRES, to
/// errors that do not grow with the ratio of viscosities and are of second order in h.
///
/// All other markers, and samples, get the flow of forces on the interfaces that, in a fluid of one viscosity, leave
/// the same velocities there: by uniqueness it is the same flow, and its errors do not grow with the ratio either.
/// These forces take a few solves on the grid, starting from the last ones. Samples are interpolated cubically, and
/// next to such an interface along its normal, so that velocities are of second order there too. Without such groups
/// none of this costs anything.
#[derive(Debug, Clone)]
pub struct ImmersedBoundary<S, K> {
    solver: S,
    transfer: Transfer<K>,
    density: StaggeredField,
    velocity: StaggeredField,
    correction: Option<MobilityCorrection>,
    stiffness: f64,
    variance: f64,
    contrast: Option<ContrastFlow<K>>,
    /// Whether the solver itself knows the viscosities inside interfaces.
    varying: bool,
    work: FlowWork,
}

impl<S: StokesSolver, K: Kernel> ImmersedBoundary<S, K> {
    /// The method on the grid of `solver`, with the mobility correction.
    #[must_use]
    pub fn new(solver: S, kernel: K) -> Self {
        Self::build(solver, kernel, true)
    }

    /// The method without the mobility correction, as in Cowley.
    #[must_use]
    pub fn uncorrected(solver: S, kernel: K) -> Self {
        Self::build(solver, kernel, false)
    }

    /// The method for a solver that is told the viscosity inside interfaces by other means.
    pub(crate) fn with_varying_viscosity(solver: S, kernel: K) -> Self {
        Self { varying: true, ..Self::build(solver, kernel, false) }
    }

    pub(crate) fn solver_mut(&mut self) -> &mut S {
        &mut self.solver
    }

    fn build(solver: S, kernel: K, corrected: bool) -> Self {
        let grid = *solver.grid();
        let deficit = MobilityDeficit::new(&kernel);
        let stiffness = deficit.interface_stiffness(corrected) / grid.spacing();
        // c(theta) at q = 0 is sqrt(variance_eff / pi)-like: the tangential velocity profile is the kernel smeared
        // twice.
        let constant = deficit.at(0.0).tangential;
        Self {
            transfer: Transfer::new(grid, kernel),
            density: StaggeredField::zeros(grid),
            velocity: StaggeredField::zeros(grid),
            correction: corrected.then(|| MobilityCorrection::new(deficit)),
            stiffness,
            variance: std::f64::consts::PI * constant * constant,
            contrast: None,
            varying: false,
            work: FlowWork::default(),
            solver,
        }
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        self.solver.grid()
    }

    /// The Stokes solver.
    #[must_use]
    pub fn solver(&self) -> &S {
        &self.solver
    }

    /// The kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        self.transfer.kernel()
    }

    /// The velocity on the grid (length per time) of the last evaluation or sampling. Where viscosities differ and
    /// there are no markers but those of interfaces, an evaluation leaves that of a fluid of one viscosity under the
    /// same forces.
    #[must_use]
    pub fn velocity_field(&self) -> &StaggeredField {
        &self.velocity
    }

    /// The pressure at the cell centres for the last evaluation or sampling (force per length; periodic part, mean
    /// zero). Makes a field.
    ///
    /// # Errors
    /// Those of the solver.
    pub fn pressure_field(&mut self) -> Result<CentreField, FlowError> {
        let mut pressure = CentreField::zeros(*self.solver.grid());
        self.solver.pressure(&self.density, &self.velocity, &mut pressure)?;
        Ok(pressure)
    }

    /// The flow on the grid for given positions and forces, without velocities at markers.
    fn solve(&mut self, positions: &[Vec2], forces: &[Vec2]) -> Result<SolveReport, FlowError> {
        self.transfer.locate(positions);
        self.solve_located(forces)
    }

    /// The same for the positions located last.
    fn solve_located(&mut self, forces: &[Vec2]) -> Result<SolveReport, FlowError> {
        self.density.fill(0.0);
        self.transfer.spread(forces, &mut self.density)?;
        self.solve_density(forces.len())
    }

    fn solve_density(&mut self, markers: usize) -> Result<SolveReport, FlowError> {
        let before = self.solver.work();
        let report = self.solver.solve(&self.density, &mut self.velocity)?;
        let after = self.solver.work();
        let transforms = |work: stokes_grid::Work| work.forward_transforms + work.inverse_transforms;
        self.work.stokes_solves += after.solves - before.solves;
        self.work.transforms += transforms(after) - transforms(before);
        let iterations = after.iterations - before.iterations;
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        self.work.markers_spread += markers;
        Ok(report)
    }

    /// Adds the mobility correction of a group to its velocities.
    fn correct(&mut self, index: usize, markers: &mut Markers) -> Result<(), FlowError> {
        let setting = self.setting();
        let group = &markers.groups()[index];
        if let Some(correction) = self.correction.as_mut()
            && matches!(group.kind, MarkerKind::Interface { .. })
        {
            let range = group.range.clone();
            let (positions, forces) = (&markers.positions[range.clone()], &markers.forces[range.clone()]);
            correction.apply(&setting, positions, forces, &mut markers.velocities[range])?;
            self.work.corrections += 1;
        }
        Ok(())
    }

    /// Whether the viscosity inside or around any group differs from that of the exterior fluid.
    fn has_contrast(&self, markers: &Markers) -> Result<bool, FlowError> {
        for group in markers.groups() {
            if other_viscosities(group, self.solver.viscosity())?.is_some() {
                return Ok(!self.varying);
            }
        }
        Ok(false)
    }

    /// Refuses markers that are not finite or too far beyond a wall, and forces that are not finite.
    pub(crate) fn check(&self, markers: &Markers) -> Result<(), FlowError> {
        let walls = self.walls();
        let allowed = WALL_TOLERANCE * self.grid().spacing();
        for (body, group) in markers.groups().iter().enumerate() {
            let positions = &markers.positions[group.range.clone()];
            let forces = &markers.forces[group.range.clone()];
            for (marker, (position, force)) in positions.iter().zip(forces).enumerate() {
                for (what, v) in [("the position", position), ("the force", force)] {
                    if !(v.x.is_finite() && v.y.is_finite()) {
                        return Err(FlowError::NonFinite { what, body, marker, x: v.x, y: v.y });
                    }
                }
                if let Some([bottom, top]) = walls {
                    let depth = (bottom - position.y).max(position.y - top);
                    if depth > allowed {
                        let (x, y) = (position.x, position.y);
                        return Err(FlowError::BeyondWall { body, marker, x, y, depth, allowed });
                    }
                }
            }
        }
        Ok(())
    }

    fn walls(&self) -> Option<[f64; 2]> {
        let grid = self.grid();
        let bottom = grid.origin()[1];
        grid.has_walls().then(|| [bottom, bottom + grid.lengths()[1]])
    }
}

impl<S: StokesSolver, K: Kernel> Hydrodynamics for ImmersedBoundary<S, K> {
    fn discretisation(&self) -> Discretisation {
        let grid = self.grid();
        let [lx, ly] = grid.lengths();
        let walls = self.walls();
        Discretisation {
            domain: Domain { origin: grid.origin(), periods: [Some(lx), walls.is_none().then_some(ly)], walls },
            viscosity: self.solver.viscosity(),
            spacing: Some(grid.spacing()),
            shape_modes: None,
            interface_stiffness: self.stiffness,
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.grid().has_walls().then(|| self.solver.drive())
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.check(markers)?;
        if self.has_contrast(markers)? {
            return self.contrast_velocities(markers);
        }
        let report = self.solve(&markers.positions, &markers.forces)?;
        self.transfer.interpolate(&self.velocity, &mut markers.velocities)?;
        self.work.evaluations += 1;
        for index in 0..markers.groups().len() {
            self.correct(index, markers)?;
        }
        Ok(report)
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        same_length("the samples", points.len(), out.len())?;
        all_points_finite("the points to sample", points)?;
        self.check(markers)?;
        if self.has_contrast(markers)? {
            return self.contrast_sample(markers, points, out);
        }
        self.solve(&markers.positions, &markers.forces)?;
        let pressure = self.pressure_field()?;
        sampling::sample(&self.velocity, &pressure, points, out);
        Ok(())
    }

    fn stresslet(&self, group: usize) -> Result<Option<[[f64; 2]; 2]>, FlowError> {
        self.contrast.as_ref().map_or(Ok(None), |flow| flow.stresslet(group))
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        self.contrast.as_ref().map_or_else(SavedState::default, ContrastFlow::save)
    }

    fn load(&mut self, saved: &SavedState) {
        if saved.counts.is_empty() {
            // Nothing was known of droplets of another viscosity.
            self.contrast = None;
        } else if let Ok(mut flow) = self.take_contrast() {
            flow.restore(saved.clone());
            self.contrast = Some(flow);
        }
    }
}
