//! The gap to the walls, followed through steps.

use motile_base::{FlowSample, SolveReport, Vec2};
use motile_scene::{
    Body, BodyError, Domain, FlowError, FlowWork, FluidView, Hydrodynamics, MarkerKind, Markers, Scene,
    gap::SurfaceCurve,
};

/// A fluid that moves uniformly whatever the forces on it are.
#[derive(Debug)]
struct Wind {
    velocity: Vec2,
    walls: Option<[f64; 2]>,
}

impl Hydrodynamics for Wind {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Domain { origin: [0.0, 0.0], periods: [None, None].into(), walls: self.walls },
            viscosity: 1.0,
            spacing: None,
            shape_modes: None,
            nodes: None,
            second_order: true,
            interface_stiffness: 1.0,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        markers.velocities_mut().fill(self.velocity);
        Ok(SolveReport::default())
    }

    fn sample(&mut self, _: &Markers, _: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        out.fill(FlowSample { velocity: self.velocity, ..FlowSample::default() });
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}

/// Points that the fluid carries, turned back where they come below a height.
#[derive(Debug)]
struct Points {
    positions: Vec<Vec2>,
    floor: f64,
    turned: bool,
    kind: MarkerKind,
}

impl Points {
    fn new(heights: &[f64], floor: f64) -> Self {
        // Interfaces that do not stand in each other's way.
        let positions = heights.iter().map(|&y| Vec2::new(100.0 * heights[0], y)).collect();
        Self { positions, floor, turned: false, kind: MarkerKind::UnevenInterface { viscosity_inside: None } }
    }
}

impl Body for Points {
    fn name(&self) -> &str {
        "points"
    }
    fn kind(&self) -> MarkerKind {
        self.kind
    }
    fn marker_count(&self) -> usize {
        self.positions.len()
    }
    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.positions);
    }
    fn write_forces(&mut self, _: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(Vec2::ZERO);
        Ok(())
    }
    fn state_len(&self) -> usize {
        2 * self.positions.len()
    }
    fn write_state(&self, state: &mut [f64]) {
        for (pair, position) in state.chunks_exact_mut(2).zip(&self.positions) {
            pair.copy_from_slice(&position.to_array());
        }
    }
    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        for (pair, position) in state.chunks_exact(2).zip(&mut self.positions) {
            *position = Vec2::new(pair[0], pair[1]);
        }
        Ok(())
    }
    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        for (pair, velocity) in rate.chunks_exact_mut(2).zip(velocities) {
            let velocity = if self.turned { -velocity } else { *velocity };
            pair.copy_from_slice(&velocity.to_array());
        }
    }
    fn end_step(&mut self, _: &FluidView, _: f64) -> Result<(), BodyError> {
        self.turned |= self.positions.iter().any(|position| position.y < self.floor);
        Ok(())
    }
    /// Single points enclose nothing.
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        Vec::new()
    }
}

#[test]
fn present_and_least_gap() {
    let mut scene = Scene::new(Wind { velocity: Vec2::new(1.0, -0.5), walls: Some([-2.0, 2.0]) });
    assert_eq!(scene.system_mut().wall_gap(), None);
    assert_eq!(scene.system().minimum_wall_gap(), None);
    // A solid may stand on a wall.
    scene.add(Points { kind: MarkerKind::Points, ..Points::new(&[-2.0, 2.0], f64::NEG_INFINITY) });
    assert_eq!(scene.system().minimum_wall_gap(), None);
    let low = scene.add(Points::new(&[0.0, -1.0], -1.4));
    assert_eq!(scene.system_mut().wall_gap(), Some(1.0));
    // Another body counts from its addition on.
    scene.add(Points::new(&[1.25], f64::NEG_INFINITY));
    assert_eq!(scene.system().minimum_wall_gap(), Some(0.75));
    // The lowest point sinks by 1/8 a step to -1.5 and rises again; the high one sinks all the time.
    let gaps: Vec<f64> = (0..8)
        .map(|_| {
            scene.step(0.25).unwrap();
            scene.system_mut().wall_gap().unwrap()
        })
        .collect();
    assert_eq!(gaps, [0.875, 0.75, 0.625, 0.5, 0.625, 0.75, 0.875, 1.0]);
    assert_eq!(scene.system().minimum_wall_gap(), Some(0.5));
    // A change by hand shows at once, and in the record with the next step.
    scene.body_mut(low).unwrap().positions[0].y = 1.75;
    assert_eq!(scene.system_mut().wall_gap(), Some(0.25));
    assert_eq!(scene.system().minimum_wall_gap(), Some(0.5));
    scene.step(0.125).unwrap();
    assert_eq!(scene.system().minimum_wall_gap(), Some(0.1875));
    // A step that is refused leaves no trace.
    assert!(scene.step(f64::NAN).is_err());
    assert_eq!(scene.system().minimum_wall_gap(), Some(0.1875));
}

/// A gap that is not a number is not hidden by one that is.
#[test]
fn no_gap_of_a_place_that_is_not_a_number() {
    for heights in [[f64::NAN, 0.5], [0.5, f64::NAN]] {
        let mut scene = Scene::new(Wind { velocity: Vec2::ZERO, walls: Some([-1.0, 1.0]) });
        heights.iter().for_each(|&y| _ = scene.add(Points::new(&[y], -1.0)));
        assert!(scene.system_mut().wall_gap().unwrap().is_nan(), "{heights:?}");
    }
}

#[test]
fn no_gap_without_walls() {
    let mut scene = Scene::new(Wind { velocity: Vec2::ZERO, walls: None });
    scene.add(Points::new(&[0.0], 0.0));
    scene.step(1.0).unwrap();
    assert_eq!(scene.system_mut().wall_gap(), None);
    assert_eq!(scene.system().minimum_wall_gap(), None);
}
