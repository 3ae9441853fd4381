//! The immersed boundary method: a grid between markers.

mod smeared_contrast;

pub use smeared_contrast::SmearedContrast;

use motile_base::{Drive, FlowSample, SolveReport, Vec2, internal::all_points_finite, positive, same_length};
use motile_scene::{
    Domain, FlowError, FlowWork, FluidView, Hydrodynamics, MarkerGroup, MarkerKind, Markers, checkpoint::SavedState,
};
use stokes_grid::{CentreField, Grid, StaggeredField, StokesError, StokesSolver, level_at_walls, sample_flow};

use crate::mobility::{MobilityCorrection, MobilityDeficit, Setting};
use crate::{Kernel, Role, Transfer};

/// Distance beyond a wall up to which a marker may lie, in grid spacings.
pub const WALL_TOLERANCE: f64 = 0.25;

/// Turns an error of a grid solver into an error of the flow.
fn flow_error(error: StokesError) -> FlowError {
    match error {
        StokesError::Input(error) => FlowError::Input(error),
        other => FlowError::solver(other),
    }
}

/// Returns the extents, periods and walls (length) of a grid, as a flow on it reports them to a scene.
#[must_use]
pub fn grid_domain(grid: &Grid) -> Domain {
    let ([lx, ly], [_, bottom]) = (grid.lengths(), grid.origin());
    let walls = grid.has_walls().then_some([bottom, bottom + ly]);
    Domain { origin: grid.origin(), periods: [Some(lx), walls.is_none().then_some(ly)].into(), walls }
}

/// The immersed boundary method: computes velocities of markers from their forces with a grid. It spreads the forces to
/// the grid, solves the Stokes equations there, and interpolates (Cowley section 2.2.2). On interfaces of equally
/// spaced markers it corrects the mobility (on by default).
///
/// Only [`MarkerKind::Interface`] is corrected. The markers' velocities are then of second order, and otherwise of
/// first order. [`Hydrodynamics::sample`] interpolates bilinearly between grid points: second order further than the
/// kernel's reach from interfaces, first order within it.
///
/// All fluid has one viscosity, so this method refuses interfaces to another one, and rigid bodies too. For other
/// viscosities, use [`SmearedContrast`] or boundary integrals.
#[derive(Debug, Clone)]
#[doc(alias("immersed boundary", "immersed boundary method", "IBM", "Peskin"))]
pub struct ImmersedBoundary<S, K> {
    solver: S,
    transfer: Transfer<K>,
    density: StaggeredField,
    velocity: StaggeredField,
    /// Velocity relative to the flow between sliding walls, if there are any.
    relative: Option<StaggeredField>,
    correction: Option<MobilityCorrection>,
    stiffness: f64,
    variance: f64,
    /// True if the solver itself knows the viscosities inside interfaces.
    varying: bool,
    work: FlowWork,
}

impl<S: StokesSolver, K: Kernel> ImmersedBoundary<S, K> {
    /// Creates the method on the grid of `solver`, with the mobility correction.
    #[must_use]
    pub fn new(solver: S, kernel: K) -> Self {
        Self::build(solver, kernel, true)
    }

    /// Creates the method without the mobility correction, as in Cowley.
    #[must_use]
    pub fn uncorrected(solver: S, kernel: K) -> Self {
        Self::build(solver, kernel, false)
    }

    /// Creates the method for a solver that learns the viscosity inside interfaces by other means.
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
            relative: None,
            correction: corrected.then(|| MobilityCorrection::new(deficit)),
            stiffness,
            variance: std::f64::consts::PI * constant * constant,
            varying: false,
            work: FlowWork::default(),
            solver,
        }
    }

    /// Returns the grid.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        self.solver.grid()
    }

    /// Returns the Stokes solver.
    #[must_use]
    pub fn solver(&self) -> &S {
        &self.solver
    }

    /// Returns the kernel.
    #[must_use]
    pub fn kernel(&self) -> &K {
        self.transfer.kernel()
    }

    /// Returns the velocity on the grid (length per time) of the last evaluation or sampling.
    #[must_use]
    pub fn velocity_field(&self) -> &StaggeredField {
        &self.velocity
    }

    /// Returns the pressure at the cell centres for the last evaluation or sampling (force per length; the periodic
    /// part, with mean zero in a box, and mean zero over both walls in a channel). Makes a field.
    ///
    /// # Errors
    /// Returns the errors of the solver.
    pub fn pressure_field(&mut self) -> Result<CentreField, StokesError> {
        let mut pressure = CentreField::zeros(*self.solver.grid());
        self.solver.pressure(&self.density, &self.velocity, &mut pressure)?;
        level_at_walls(&mut pressure);
        Ok(pressure)
    }

    /// Computes the flow of the markers' forces on the grid, and interpolates the velocity to the markers. Next to
    /// walls that slide, the kernel reaches beyond them, where the grid continues a velocity that vanishes on the
    /// walls: so the flow between the walls is left out on the grid.
    fn interpolate(&mut self, markers: &mut Markers) -> Result<(), StokesError> {
        let walls = self.solver.walls();
        if walls.is_at_rest() {
            return self.transfer.interpolate(&self.velocity, markers.velocities_mut());
        }
        let grid = *self.solver.grid();
        let [x0, y0] = grid.origin();
        let relative = self.relative.get_or_insert_with(|| StaggeredField::zeros(grid));
        relative.copy_from(&self.velocity);
        for (index, value) in relative.components_mut().0.iter_mut().enumerate() {
            let (column, row) = (index % grid.nx(), index / grid.nx());
            let x = x0 + column as f64 * grid.spacing();
            *value -= walls.between(&grid, Vec2::new(x, y0 + (row as f64 + 0.5) * grid.spacing()));
        }
        self.transfer.interpolate(relative, markers.velocities_mut())?;
        let [positions, _, velocities] = markers.lists_mut();
        for (velocity, place) in velocities.iter_mut().zip(&*positions) {
            velocity.x += walls.between(&grid, *place);
        }
        Ok(())
    }

    fn solve(&mut self, markers: &Markers) -> Result<SolveReport, FlowError> {
        self.transfer.locate(markers.positions());
        self.density.fill(0.0);
        self.transfer.spread(markers.forces(), &mut self.density).map_err(flow_error)?;
        let before = self.solver.work();
        let report = self.solver.solve(&self.density, &mut self.velocity).map_err(flow_error)?;
        let after = self.solver.work();
        let transforms = |work: stokes_grid::Work| work.forward_transforms + work.inverse_transforms;
        self.work.stokes_solves += after.solves - before.solves;
        self.work.transforms += transforms(after) - transforms(before);
        let iterations = after.iterations - before.iterations;
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        self.work.markers_spread += markers.len();
        Ok(report)
    }

    /// Adds the mobility correction of a group to its velocities.
    fn correct(&mut self, index: usize, markers: &mut Markers) -> Result<(), FlowError> {
        let setting = Setting {
            spacing: self.grid().spacing(),
            origin: self.grid().origin(),
            viscosity: self.solver.viscosity(),
            walls: grid_domain(self.grid()).walls,
            variance: self.variance,
        };
        let group = &markers.groups()[index];
        if let Some(correction) = self.correction.as_mut()
            && matches!(group.kind, MarkerKind::Interface { .. })
        {
            let range = group.range.clone();
            let [positions, forces, velocities] = markers.lists_mut().map(|list| &mut list[range.clone()]);
            correction.apply(&setting, positions, forces, velocities).map_err(flow_error)?;
            self.work.corrections += 1;
        }
        Ok(())
    }

    /// Returns the distance from a wall with slip that markers keep (length): half of the kernel's support.
    fn slip_reach(&self) -> f64 {
        let support = [Role::Normal, Role::Tangential].map(|role| self.kernel().support(role));
        0.5 * self.grid().spacing() * support[0].max(support[1]) as f64
    }

    /// Refuses markers that are not finite or too far beyond a wall, forces that are not finite, rigid bodies, and
    /// interfaces to another viscosity that the solver does not know.
    pub(crate) fn check(&self, markers: &Markers) -> Result<(), FlowError> {
        let walls = grid_domain(self.grid()).walls;
        let allowed = WALL_TOLERANCE * self.grid().spacing();
        // Beyond the walls the kernel continues a flow without slip.
        let slips = self.solver.walls().slip().map(|slip| slip > 0.0);
        let reach = self.slip_reach();
        for (body, group) in markers.groups().iter().enumerate() {
            if other_viscosities(group, self.solver.viscosity())?.is_some() && !self.varying {
                return Err(FlowError::unsupported(
                    "an interface to another viscosity on a grid of one viscosity",
                    "Use layers or boundary integrals, or a smeared contrast",
                ));
            }
            let positions = &markers.positions()[group.range.clone()];
            let forces = &markers.forces()[group.range.clone()];
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
                    if slips[0] && position.y - bottom < reach || slips[1] && top - position.y < reach {
                        return Err(FlowError::unsupported(
                            "a marker next to a wall with slip, closer than the delta function of the grid reaches",
                            "Use boundary integrals (the method `integral`), a finer grid, or a wider channel",
                        ));
                    }
                }
            }
        }
        Ok(())
    }
}

impl<S: StokesSolver, K: Kernel> Hydrodynamics for ImmersedBoundary<S, K> {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: grid_domain(self.grid()),
            viscosity: self.solver.viscosity(),
            spacing: Some(self.grid().spacing()),
            second_order: self.correction.is_some(),
            shape_modes: None,
            nodes: None,
            interface_stiffness: self.stiffness,
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.grid().has_walls().then(|| self.solver.drive())
    }

    fn wall_slip(&self) -> Option<[f64; 2]> {
        let walls = self.solver.walls();
        (self.grid().has_walls() && walls.is_at_rest()).then(|| walls.slip())
    }

    fn friction(&self) -> f64 {
        self.solver.friction()
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.check(markers)?;
        let report = self.solve(markers)?;
        self.interpolate(markers).map_err(flow_error)?;
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
        // The flow that the markers have, even if the solver has a memory.
        self.solver.rewind();
        self.solve(markers)?;
        let pressure = self.pressure_field().map_err(flow_error)?;
        sample_flow(&self.velocity, &pressure, self.solver.walls(), points, out).map_err(flow_error)
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        SavedState { reals: self.solver.memory().to_vec(), ..SavedState::default() }
    }

    fn load(&mut self, saved: &SavedState) {
        load_memory(&mut self.solver, &saved.reals);
    }

    fn rewind(&mut self) {
        self.solver.rewind();
    }
}

/// Restores the memory of a solver; numbers of another solver are of no use, and it starts afresh.
fn load_memory(solver: &mut impl StokesSolver, memory: &[f64]) {
    if solver.set_memory(memory).is_err() {
        let forgotten = solver.set_memory(&[]);
        debug_assert!(forgotten.is_ok());
    }
}

/// Returns the viscosities inside and outside of a group (stress times time) if it is an interface and one of them is
/// not the viscosity of the exterior fluid.
///
/// # Errors
/// Returns an error for a viscosity that is not positive and finite; a rigid body, an interface that is periodic along
/// x.
fn other_viscosities(group: &MarkerGroup, exterior: f64) -> Result<Option<[f64; 2]>, FlowError> {
    if group.kind == MarkerKind::Rigid {
        return Err(FlowError::unsupported(
            "a rigid body that is coupled to a grid alone",
            "Use boundary integrals or layers",
        ));
    }
    if group.kind.advance().is_some() {
        return Err(FlowError::unsupported(
            "an interface that is periodic along x on a grid alone",
            "Use boundary integrals or layers",
        ));
    }
    if !group.kind.is_curve() {
        return Ok(None);
    }
    let [inside, outside] = group.viscosities(exterior);
    let inside = positive("the viscosity inside an interface", inside)?;
    Ok((inside != exterior || outside != exterior).then_some([inside, outside]))
}
