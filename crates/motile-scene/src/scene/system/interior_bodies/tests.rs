use std::sync::{Arc, Mutex};

use motile_base::Vec2;

use crate::body::InteriorBody;
use crate::hydrodynamics::tests::DragBox;
use crate::{Body, BodyError, FluidView, Handle, MarkerBody, MarkerKind, Scene, StepSize, integrator::Dynamics as _};

/// What fills a body: it has two numbers that change at the rates 5 and 6, adds its position in the list to each rate
/// of its host, and a force along y to each of its host's markers.
#[derive(Debug)]
struct Inside {
    host: Handle<dyn Body>,
    state: [f64; 2],
    /// Markers of the host when it was shown last, and at the ends of steps.
    shown: Vec<Vec2>,
    at_ends: Arc<Mutex<Vec<f64>>>,
}

impl Inside {
    fn of(host: Handle<MarkerBody>) -> Self {
        Self { host: host.into(), state: [0.0; 2], shown: Vec::new(), at_ends: Arc::default() }
    }
}

impl InteriorBody for Inside {
    fn host(&self) -> Handle<dyn Body> {
        self.host
    }
    fn update_host(&mut self, host: &dyn Body) {
        self.shown.resize(host.marker_count(), Vec2::ZERO);
        host.write_markers(&mut self.shown);
    }
    fn add_host_forces(&self, forces: &mut [Vec2]) {
        forces.iter_mut().for_each(|force| *force += Vec2::Y);
    }
    fn host_moved(&mut self, _: &dyn Body, _: &[Vec2]) {}
    fn add_host_rate(&self, rate: &mut [f64]) {
        rate.iter_mut().enumerate().for_each(|(k, rate)| *rate += (k + 1) as f64);
    }
}

impl Body for Inside {
    fn name(&self) -> &str {
        "inside"
    }
    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }
    fn marker_count(&self) -> usize {
        0
    }
    fn write_markers(&self, _: &mut [Vec2]) {}
    fn write_forces(&mut self, _: &FluidView, _: &mut [Vec2]) -> Result<(), BodyError> {
        Ok(())
    }
    fn state_len(&self) -> usize {
        2
    }
    fn write_state(&self, state: &mut [f64]) {
        state.copy_from_slice(&self.state);
    }
    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        self.state.copy_from_slice(state);
        Ok(())
    }
    fn rate(&mut self, _: &[Vec2], rate: &mut [f64]) {
        rate.copy_from_slice(&[5.0, 6.0]);
    }
    fn end_step(&mut self, _: &FluidView, _: f64) -> Result<(), BodyError> {
        self.at_ends.lock().unwrap().push(self.shown[0].x);
        Ok(())
    }
    fn as_interior_body(&mut self) -> Option<&mut dyn InteriorBody> {
        Some(self)
    }
}

/// Markers that move at (10, 20), whatever the fluid does.
fn moving(count: usize) -> MarkerBody {
    let places = (0..count).map(|k| Vec2::new(k as f64, 0.5)).collect();
    MarkerBody::new("moving", places, |_, _| {}).with_motion(|_, _, rates| rates.fill(Vec2::new(10.0, 20.0)))
}

/// An interior body writes to the rates and forces of its host, and to no entry before or after them.
#[test]
fn interior_bodies_change_the_whole_host_and_nothing_else() {
    let mut scene = Scene::new(DragBox::new(8.0, 1.0, 0.1));
    scene.add(moving(1));
    let host = scene.add(moving(2));
    scene.add(moving(1));
    scene.add(Inside::of(host));
    scene.add(moving(1));
    let system = scene.system_mut();
    let mut rate = vec![0.0; 12];
    assert_eq!(system.state_len(), rate.len());
    system.present_rate(&mut rate).unwrap();
    assert_eq!(rate, [10.0, 20.0, 11.0, 22.0, 13.0, 24.0, 10.0, 20.0, 5.0, 6.0, 10.0, 20.0]);
    let pushed: Vec<f64> = system.markers().forces().iter().map(|force| force.y).collect();
    assert_eq!(pushed, [0.0, 1.0, 1.0, 0.0, 0.0]);
}

/// At the end of each step an interior body has seen its host where the step has taken it, at the rate of 10 and its
/// own 1.
#[test]
fn interior_bodies_see_their_host_at_the_end_of_a_step() {
    let mut scene = Scene::new(DragBox::new(80.0, 1.0, 0.1));
    let host = scene.add(moving(2));
    let inside = Inside::of(host);
    let at_ends = Arc::clone(&inside.at_ends);
    scene.add(inside);
    scene.run(0.5).step_size(StepSize::Fixed(0.125)).go().unwrap();
    assert_eq!(*at_ends.lock().unwrap(), [1.375, 2.75, 4.125, 5.5]);
}
