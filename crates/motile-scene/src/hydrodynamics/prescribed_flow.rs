//! A flow that is given.

use motile_base::{FlowSample, SolveReport, Vec2, internal::all_points_finite, same_length};

use super::{Domain, FlowWork, FluidView, Hydrodynamics, Markers};
use crate::FlowError;

/// A velocity field that you give, in unbounded fluid of viscosity 1: it carries markers along, whatever their forces.
///
/// Use it to test what a body does in a known flow, for example the transport of particles along an interface.
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::{MarkerBody, PrescribedFlow, Scene, StepSize};
///
/// // A point circles around the origin once.
/// let mut scene = Scene::new(PrescribedFlow::new(|x: Vec2| Vec2::new(-x.y, x.x)));
/// let point = scene.add(MarkerBody::new("point", vec![Vec2::X], |_, _| {}));
/// scene.run(std::f64::consts::TAU).step_size(StepSize::Fixed(0.01)).go()?;
/// let place = scene.body(point)?.markers()[0];
/// println!("back at ({:.4}, {:.4})", place.x, place.y);
/// assert!(place.distance(Vec2::X) < 2e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct PrescribedFlow {
    velocity: Box<dyn Fn(Vec2) -> Vec2 + Send>,
}

impl PrescribedFlow {
    /// Makes a flow from the velocity (length per time) as a function of the place (length).
    #[must_use]
    pub fn new(velocity: impl Fn(Vec2) -> Vec2 + Send + 'static) -> Self {
        Self { velocity: Box::new(velocity) }
    }
}

impl std::fmt::Debug for PrescribedFlow {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PrescribedFlow").finish_non_exhaustive()
    }
}

impl Hydrodynamics for PrescribedFlow {
    /// Nothing relaxes by its forces in a prescribed flow, so that these set no bound on the time step.
    fn fluid_view(&self) -> FluidView {
        let domain = Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None };
        FluidView {
            domain,
            viscosity: 1.0,
            spacing: None,
            second_order: true,
            shape_modes: None,
            nodes: None,
            interface_stiffness: 0.0,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let [positions, _, velocities] = markers.lists_mut();
        velocities.iter_mut().zip(positions).for_each(|(velocity, place)| *velocity = (self.velocity)(*place));
        all_points_finite("the prescribed velocities", markers.velocities())?;
        Ok(SolveReport::default())
    }

    /// Samples the velocity. Its gradient comes from central differences over 1e-5 of the largest coordinate of the
    /// markers and points, and the pressure is zero.
    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        same_length("the samples", points.len(), out.len())?;
        all_points_finite("the points to sample", points)?;
        let extent = points.iter().chain(markers.positions()).map(|place| place.x.abs().max(place.y.abs()));
        let extent = extent.fold(0.0, f64::max);
        let step = 1e-5 * if extent > 0.0 { extent } else { 1.0 };
        for (&point, out) in points.iter().zip(&mut *out) {
            let slope = |way: Vec2| ((self.velocity)(point + way) - (self.velocity)(point - way)) / (2.0 * step);
            let [by_x, by_y] = [slope(Vec2::new(step, 0.0)), slope(Vec2::new(0.0, step))];
            let gradient = [[by_x.x, by_y.x], [by_x.y, by_y.y]];
            *out = FlowSample { velocity: (self.velocity)(point), pressure: 0.0, gradient };
        }
        for seen in &*out {
            let [a, b] = seen.gradient;
            all_points_finite("a prescribed velocity or its gradient", &[seen.velocity, Vec2::from(a), Vec2::from(b)])?;
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}
