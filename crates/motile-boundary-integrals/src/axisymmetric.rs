//! Hydrodynamics of bodies of revolution by boundary integrals.

use std::f64::consts::TAU;

use motile_base::{Drive, FlowSample, Region, SolveReport, Vec2, internal::all_points_finite};
use motile_scene::{
    Domain, FlowError, FlowWork, FluidView, Hydrodynamics, MarkerGroup, Markers, checkpoint::SavedState, gap::Boundary,
};
use stokes_axisymmetric::AxisymmetricFlow;
use stokes_boundary_integrals::{LayerError, Settings};

use crate::{error::of_layers, interface_groups::interface};

/// Sides of the polygon of a wall.
const SIDES: usize = 600;

/// Stokes flow in three dimensions of bodies of revolution about the x axis, in unbounded fluid or in a straight tube:
/// [`AxisymmetricFlow`], which has the equations, for the markers of bodies.
///
/// Every body is a group of markers of a closed curve, the meridian with its mirror image, as many as nodes or more,
/// equally spaced in the parameter; forces are those on halves of rings.
#[derive(Debug, Clone)]
pub struct AxisymmetricIntegral {
    flow: AxisymmetricFlow,
    region: Region,
    work: FlowWork,
    stiffness: f64,
    /// Sides of a tube that is not straight, in the meridian plane.
    walls: Boundary,
}

impl AxisymmetricIntegral {
    /// Creates a solver for exterior fluid of the given viscosity (stress times time) in space or in a tube, with
    /// interfaces of that perimeter of the closed curve (length) until they are known.
    ///
    /// # Errors
    /// Returns an error for a region of the plane; a viscosity that is not positive and finite; settings out of their
    /// range.
    pub fn new(region: Region, viscosity: f64, settings: Settings, perimeter: f64) -> Result<Self, LayerError> {
        let flow = AxisymmetricFlow::in_region(region, viscosity, settings)?;
        let stiffness = stiffness(settings.nodes, perimeter);
        let mut walls = Boundary::default();
        if let (Region::Tube { radius, shape, .. }, Some(half)) = (region, region.half_length()) {
            let x = |k: usize| half * (2.0 * k as f64 / SIDES as f64 - 1.0);
            let place = |k: usize, side: f64| Vec2::new(x(k), side * shape.radius(radius, half, x(k)));
            // The rigid side is on the left.
            (0..SIDES).for_each(|k| walls.push(place(k, 1.0), place(k + 1, 1.0)));
            (0..SIDES).rev().for_each(|k| walls.push(place(k + 1, -1.0), place(k, -1.0)));
            walls.sort();
        }
        Ok(Self { flow, region, work: FlowWork::default(), stiffness, walls })
    }

    /// Returns the mean pressure gradient along x (stress per length) in the last solution: of a straight tube over its
    /// length, or if it has none far from the surfaces; zero in unbounded fluid. In a tube of another shape it is not a
    /// number, since the pressure there falls mostly where it is narrow.
    fn pressure_gradient(&self) -> f64 {
        let unbounded = if matches!(self.region, Region::Tube { .. }) { f64::NAN } else { 0.0 };
        self.flow.pressure_gradient().unwrap_or(unbounded)
    }

    fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        let mut shortest = f64::INFINITY;
        for group in markers.groups() {
            if !group.kind.is_curve() {
                return Err(FlowError::unsupported(
                    "a point in the fluid around axisymmetric bodies",
                    "Use only axisymmetric droplets and rigid bodies, or a two-dimensional region",
                ));
            }
            let places = &markers.positions()[group.range.clone()];
            let next = places.iter().cycle().skip(1);
            shortest = shortest.min(places.iter().zip(next).map(|(a, b)| a.distance(*b)).sum());
        }
        if shortest.is_finite() {
            self.stiffness = stiffness(self.flow.settings().nodes, shortest);
        }
        let exterior = self.flow.viscosity();
        let surface = |group: &MarkerGroup| interface(group, markers.positions(), markers.forces(), exterior);
        self.flow.load(markers.groups().iter().map(surface)).map_err(of_layers)
    }
}

/// Returns a quarter of the largest wave number of a curve: waves of a drop relax like waves of an interface in the
/// plane.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * TAU / perimeter
}

impl Hydrodynamics for AxisymmetricIntegral {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Domain::from(self.region),
            viscosity: self.flow.viscosity(),
            spacing: None,
            second_order: true,
            // Velocities come from as many nodes as there are waves: products of two waves of the shape stay below the
            // waves that they would pass for, and the shape free of them, where the tension is low.
            shape_modes: Some(2 * self.flow.settings().nodes / 3),
            nodes: Some(self.flow.settings().nodes),
            interface_stiffness: self.stiffness,
        }
    }

    fn drive(&self) -> Option<Drive> {
        if let Region::Tube { drive, .. } = self.region { Some(drive) } else { None }
    }

    fn walls(&self) -> Option<&Boundary> {
        self.region.half_length().map(|_| &self.walls)
    }

    fn axisymmetric(&self) -> bool {
        true
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.load(markers)?;
        self.work.evaluations += 1;
        self.flow.solve().map_err(of_layers)?;
        let ranges: Vec<_> = markers.groups().iter().map(|group| group.range.clone()).collect();
        for (surface, range) in ranges.into_iter().enumerate() {
            self.flow.velocities(surface, &mut markers.velocities_mut()[range]).map_err(of_layers)?;
        }
        Ok(SolveReport { mean_pressure_gradient: [self.pressure_gradient(), 0.0], ..SolveReport::default() })
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        all_points_finite("the points to sample", points)?;
        self.load(markers)?;
        self.flow.solve().map_err(of_layers)?;
        self.flow.sample(points, out).map_err(of_layers)?;
        let gradient = self.pressure_gradient();
        if gradient.is_finite() {
            out.iter_mut().zip(points).for_each(|(sample, point)| sample.pressure -= gradient * point.x);
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let tube = self.flow.tube_resolution().into_iter().flatten();
        SavedState { reals: std::iter::once(self.stiffness).chain(tube).collect(), counts: Vec::new() }
    }

    fn load(&mut self, saved: &SavedState) {
        if let [stiffness, tube @ ..] = &saved.reals[..] {
            self.stiffness = *stiffness;
            if let &[half_length, spacing] = tube {
                // Lengths that make no tube are those of no checkpoint: the next evaluation makes one.
                let _ = self.flow.restore_tube([half_length, spacing]);
            }
        }
    }
}
