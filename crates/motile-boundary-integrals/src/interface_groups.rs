//! The flow of the groups of markers that are interfaces, by boundary integrals.

use motile_base::{FlowSample, SolveReport, Vec2, internal::all_points_finite};
use motile_scene::{FlowError, FlowWork, MarkerGroup, MarkerKind, Markers, checkpoint::SavedState};
use stokes_boundary_integrals::{Interface, InterfaceFlow, Solution, WarmStart};

use crate::error::of_layers;

/// Boundary integrals ([`InterfaceFlow`]) for the markers of bodies: every group that is an interface is a curve, and
/// points on which nothing pulls are carried along.
#[derive(Debug, Clone)]
pub(crate) struct InterfaceGroups {
    /// The flow of the interfaces.
    pub(crate) flow: InterfaceFlow,
    stiffness: f64,
    samples: Vec<FlowSample>,
}

/// Sum of forces over the sum of their sizes below which it is round-off.
const BALANCED: f64 = 1e-13;

/// Returns the mean density of forces in a box of that area (force per length squared). The mean pressure gradient of
/// the box balances it. It is zero if the forces add up to zero.
fn force_density(forces: &[Vec2], area: f64) -> Vec2 {
    let add = |(sum, size), force: &Vec2| (sum + *force, size + force.x.abs() + force.y.abs());
    let (sum, size) = forces.iter().fold((Vec2::ZERO, 0.0), add);
    if sum.length() > BALANCED * size { sum / area } else { Vec2::ZERO }
}

impl InterfaceGroups {
    /// Groups that move with a flow. Until interfaces are known, the stiffness is taken for an interface of perimeter 2
    /// pi.
    pub(crate) fn new(flow: InterfaceFlow) -> Self {
        let stiffness = stiffness(flow.settings().nodes, std::f64::consts::TAU);
        Self { flow, stiffness, samples: Vec::new() }
    }

    /// Returns the fastest relaxation of the interfaces ([`motile_scene::FluidView::interface_stiffness`], 1/length): a
    /// wave number q decays at the rate `gamma q/(2 (eta_in + eta_ext))`, and q is at most what the nodes of the
    /// shortest interface carry.
    pub(crate) fn stiffness(&self) -> f64 {
        self.stiffness
    }

    /// Returns the stiffness of an interface of that perimeter (length), until interfaces are known.
    pub(crate) fn set_reference_perimeter(&mut self, perimeter: f64) {
        self.stiffness = stiffness(self.flow.settings().nodes, perimeter);
    }

    /// Returns the perimeter (length) of the shortest interface of the last evaluation, before it the reference
    /// perimeter.
    #[must_use]
    pub(crate) fn reference_perimeter(&self) -> f64 {
        stiffness(self.flow.settings().nodes, 1.0) / self.stiffness
    }

    /// Takes the stiffness from the lengths of the interfaces (length), if there are any.
    pub(crate) fn set_lengths(&mut self, lengths: impl Iterator<Item = f64>) {
        if let Some(shortest) = lengths.reduce(f64::min) {
            self.set_reference_perimeter(shortest);
        }
    }

    /// Takes over positions and forces of the interfaces.
    ///
    /// # Errors
    /// Returns the errors of [`InterfaceFlow::load`].
    pub(crate) fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        let (exterior, positions, forces) = (self.flow.viscosity(), markers.positions(), markers.forces());
        let interfaces = interfaces(markers).map(|group| interface(group, positions, forces, exterior));
        self.flow.load(interfaces).map_err(|error| {
            let groups = markers.groups().iter().enumerate().filter(|(_, group)| group.kind.is_curve());
            let bodies: Vec<usize> = groups.map(|(body, _)| body).collect();
            of_layers(error).of_body(|curve| bodies.get(curve).copied().unwrap_or(curve))
        })
    }

    /// Fills the velocities of all markers and counts the work.
    ///
    /// # Errors
    /// Returns the errors of [`InterfaceFlow::load`] and [`InterfaceFlow::solve`].
    pub(crate) fn velocities(&mut self, markers: &mut Markers, work: &mut FlowWork) -> Result<SolveReport, FlowError> {
        self.load(markers)?;
        work.evaluations += 1;
        let Self { flow, samples, .. } = self;
        let Solution { iterations, residual, pressure_gradient, .. } = flow.solve().map_err(of_layers)?;
        work.iterations += iterations;
        work.most_iterations = work.most_iterations.max(iterations);
        if flow.len() == markers.groups().len() {
            flow.all_velocities(markers.velocities_mut()).map_err(of_layers)?;
        } else {
            let mut interface = 0;
            let (groups, positions, all_velocities) = markers.groups_and_lists();
            for MarkerGroup { range, kind, host, .. } in groups {
                let velocities = &mut all_velocities[range.clone()];
                if kind.is_curve() {
                    flow.velocities(interface, velocities).map_err(of_layers)?;
                    interface += 1;
                } else if let Some(host) = *host {
                    let curve = groups[..host].iter().filter(|group| group.kind.is_curve()).count();
                    flow.velocities_inside(curve, &positions[range.clone()], velocities).map_err(of_layers)?;
                } else {
                    samples.resize(range.len(), FlowSample::default());
                    flow.sample(&positions[range.clone()], samples).map_err(of_layers)?;
                    velocities.iter_mut().zip(&*samples).for_each(|(to, seen)| *to = seen.velocity);
                }
            }
        }
        let shortest = (0..flow.len()).filter_map(|interface| flow.perimeter(interface)).reduce(f64::min);
        shortest.into_iter().for_each(|perimeter| self.set_reference_perimeter(perimeter));
        self.tell_dipoles(markers)?;
        let periods = self.flow.periods();
        let mean_pressure_gradient = match periods[0].zip(periods[1]) {
            Some((length, height)) => force_density(markers.forces(), length * height).to_array(),
            None => [pressure_gradient, 0.0],
        };
        Ok(SolveReport { iterations, residual, mean_pressure_gradient })
    }

    /// Reports to the markers what keeps bodies rigid in the last solution ([`Markers::rigid_dipole`]).
    ///
    /// # Errors
    /// Returns an error for values that are not finite.
    pub(crate) fn tell_dipoles(&self, markers: &mut Markers) -> Result<(), FlowError> {
        let mut interface = 0;
        for group in 0..markers.groups().len() {
            if markers.groups()[group].kind.is_curve() {
                if let Some(dipole) = self.flow.rigid_dipole(interface) {
                    markers.set_rigid_dipole(group, dipole)?;
                }
                interface += 1;
            }
        }
        Ok(())
    }

    /// Returns the flow at points for the positions, forces and velocities in `markers`. The next solution starts from
    /// what it would have started from without this.
    ///
    /// # Errors
    /// Returns the errors of [`InterfaceFlow::load`] and [`InterfaceFlow::sample`].
    pub(crate) fn sample(
        &mut self,
        markers: &Markers,
        points: &[Vec2],
        out: &mut [FlowSample],
    ) -> Result<(), FlowError> {
        all_points_finite("the points to sample", points)?;
        self.load(markers)?;
        let flow = &mut self.flow;
        if markers.groups().iter().any(|group| group.kind == MarkerKind::Rigid) {
            // Velocities do not tell of the layer on a rigid body.
            let before = flow.warm_start();
            flow.solve().map_err(of_layers)?;
            flow.resume(before);
        } else {
            for (interface, group) in interfaces(markers).enumerate() {
                flow.set_velocities(interface, &markers.velocities()[group.range.clone()]).map_err(of_layers)?;
            }
        }
        flow.sample(points, out).map_err(of_layers)
    }

    /// Returns the last solution, from which the next one starts, and the stiffness.
    pub(crate) fn save(&self) -> SavedState {
        let WarmStart { velocities, directions } = self.flow.warm_start();
        let counts = vec![velocities.len() as u64];
        SavedState { reals: [&[self.stiffness], velocities.as_slice(), directions.as_slice()].concat(), counts }
    }

    /// Takes back what [`InterfaceGroups::save`] wrote; what does not fit is ignored.
    pub(crate) fn restore(&mut self, reals: &[f64], counts: &[u64]) {
        let ([stiffness, rest @ ..], &[count]) = (reals, counts) else { return };
        let Some((velocities, directions)) = usize::try_from(count).ok().and_then(|n| rest.split_at_checked(n)) else {
            return;
        };
        self.stiffness = *stiffness;
        self.flow.resume(WarmStart { velocities: velocities.to_vec(), directions: directions.to_vec() });
    }
}

/// Returns a group as an interface of boundary integrals, if the viscosity of the exterior fluid is `exterior`.
pub(crate) fn interface<'a>(
    group: &MarkerGroup,
    positions: &'a [Vec2],
    forces: &'a [Vec2],
    exterior: f64,
) -> Interface<'a> {
    let (positions, forces) = (&positions[group.range.clone()], &forces[group.range.clone()]);
    let viscosities = group.viscosities(exterior);
    match group.kind {
        MarkerKind::Rigid => Interface::rigid(positions, forces, viscosities[1]),
        kind => {
            let period = Vec2::new(kind.advance().unwrap_or(0.0), 0.0);
            Interface { period, ..Interface::closed(positions, forces, viscosities) }
        }
    }
}

/// Returns the groups that are interfaces.
fn interfaces(markers: &Markers) -> impl Iterator<Item = &MarkerGroup> + Clone {
    markers.groups().iter().filter(|group| group.kind.is_curve())
}

/// Returns a quarter of the largest wave number of a curve.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * std::f64::consts::TAU / perimeter
}
