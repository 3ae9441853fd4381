use super::*;
use crate::Curve;
use approx::assert_relative_eq;
use ib_core::{BSpline, ImmersedBoundary};
use motile_base::Drive;
use motile_scene::{Domain, FlowWork, Markers, Scene};
use stokes_grid::{ChannelStokes, Grid, flux};

/// A channel between y = -1 and y = 2 with the flow `plug + shear y + curve y^2`, whatever the forces are.
#[derive(Debug)]
struct Profile {
    plug: f64,
    shear: f64,
    curve: f64,
    walls: bool,
}

impl Profile {
    fn u(&self, y: f64) -> f64 {
        self.plug + y * (self.shear + y * self.curve)
    }

    /// The integral of u.
    fn flux(&self, from: f64, to: f64) -> f64 {
        let integral = |y: f64| y * (self.plug + y * (self.shear / 2.0 + y * self.curve / 3.0));
        integral(to) - integral(from)
    }
}

impl Hydrodynamics for Profile {
    fn fluid_view(&self) -> FluidView {
        let walls = self.walls.then_some([-1.0, 2.0]);
        let domain = Domain { origin: [0.0, -1.0], periods: [Some(10.0), None].into(), walls };
        FluidView {
            domain,
            viscosity: 1.0,
            spacing: None,
            second_order: true,
            interface_stiffness: 1.0,
            shape_modes: None,
            nodes: None,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let [positions, _, velocities] = markers.lists_mut();
        for (velocity, position) in velocities.iter_mut().zip(positions) {
            *velocity = Vec2::new(self.u(position.y), 0.0);
        }
        Ok(SolveReport::default())
    }

    fn sample(&mut self, _: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        for (out, point) in out.iter_mut().zip(points) {
            out.velocity = Vec2::new(self.u(point.y), 0.0);
        }
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}

fn droplet(count: usize, radius: f64, centre: [f64; 2]) -> ActiveDroplet {
    let curve = Curve::circle(radius).unwrap().translated(Vec2::new(centre[0], centre[1]));
    ActiveDroplet::passive(&curve.markers(count).unwrap(), 1.0).unwrap()
}

#[test]
fn pressure_drop_of_a_report() {
    let report = SolveReport { mean_pressure_gradient: [-0.25, 3.0], ..SolveReport::default() };
    assert_eq!(pressure_drop(&report, 12.0).unwrap(), 3.0);
    assert!(pressure_drop(&report, 0.0).is_err() && pressure_drop(&report, f64::NAN).is_err());
    let report = SolveReport { mean_pressure_gradient: [f64::NAN, 0.0], ..SolveReport::default() };
    assert!(pressure_drop(&report, 12.0).is_err());
}

#[test]
fn plug_and_poiseuille_flow_are_exact() {
    let profile = |plug, shear, curve| Profile { plug, shear, curve, walls: true };
    // No slip at y = -1 and y = 2: -(y + 1) (y - 2) = 2 + y - y^2.
    let mut scene = Scene::new(profile(2.0, 1.0, -1.0));
    assert_relative_eq!(net_flux(scene.system_mut(), 0.0).unwrap(), 4.5, max_relative = 1e-14);

    // A droplet that the fluid carries along does not see it pass.
    let mut scene = Scene::new(profile(0.3, 0.0, 0.0));
    let body = scene.add(droplet(100, 0.8, [33.0, 0.5]));
    let flow = gap_flow(scene.system_mut(), body).unwrap();
    assert_relative_eq!(flow.velocity, 0.3, max_relative = 1e-13);
    assert_relative_eq!(flow.net(), 0.9, max_relative = 1e-13);
    assert!(flow.retrograde().unwrap().abs() < 1e-13);
    assert_relative_eq!(flow.inside, 0.3 * flow.droplet_height, max_relative = 1e-13);
    assert_relative_eq!(flow.droplet_height, 1.6, max_relative = 1e-3);

    // A passive droplet in Poiseuille flow, off the centre line, each part by itself.
    for turn in [1.0, -1.0] {
        let flow = profile(turn * 2.0, turn, -turn);
        let (low, high) = (flow.flux(-1.0, 0.0), flow.flux(0.0, 2.0));
        let mut scene = Scene::new(flow);
        let body = scene.add(droplet(800, 0.6, [0.0, 0.2]));
        let found = gap_flow(scene.system_mut(), body).unwrap();
        let exact = profile(turn * 2.0, turn, -turn);
        let [d, e] = found.gap_heights;
        assert_relative_eq!(found.gaps[0], exact.flux(-1.0, -1.0 + d), max_relative = 1e-12);
        assert_relative_eq!(found.gaps[1], exact.flux(2.0 - e, 2.0), max_relative = 1e-12);
        assert_relative_eq!(found.net(), low + high, max_relative = 1e-13);
        assert_relative_eq!(d + e + found.droplet_height, 3.0, max_relative = 1e-14);
        // The mean of u over the disc: 2 + y - y^2 at the centre, less radius^2/4 for the curvature.
        assert_relative_eq!(found.velocity, turn * (2.0 + 0.2 - 0.04 - 0.09), max_relative = 1e-4);
        let relative = found.gaps[0] + found.gaps[1] - found.velocity * (d + e);
        assert_relative_eq!(found.retrograde().unwrap(), -turn * relative, max_relative = 1e-13);
        assert!(found.retrograde().unwrap() > 0.0);
    }
}

/// A droplet that does not move, but by round-off, has no direction in which the fluid could pass it.
#[test]
fn nothing_passes_a_droplet_at_rest() {
    for (plug, shear) in [(0.0, 0.0), (0.0, 1.0), (1e-15, -1.0)] {
        let mut scene = Scene::new(Profile { plug, shear, curve: 0.0, walls: true });
        let body = scene.add(droplet(100, 0.8, [0.0, 0.0]));
        let flow = gap_flow(scene.system_mut(), body).unwrap();
        assert_eq!((flow.velocity, flow.retrograde()), (0.0, None), "{plug} {shear}");
    }
}

/// Where there is a grid, the sampled flux is that of the solver but for the linear profile next to the walls.
#[test]
fn net_flux_on_a_grid() {
    let errors = [20, 40].map(|cells| {
        let h = 3.0 / cells as f64;
        let mut solver = ChannelStokes::new(Grid::channel(2 * cells, cells, h).unwrap(), 2.0).unwrap();
        solver.set_drive(Drive::Gradient(-0.4)).unwrap();
        let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
        scene.add(droplet(8, 0.1, [0.0, 0.0]));
        let found = net_flux(scene.system_mut(), 0.123).unwrap();
        let field = scene.system().hydrodynamics().velocity_field();
        let wall = field.x()[0];
        assert_relative_eq!(found, flux(field) - 0.5 * h * wall, max_relative = 1e-6);
        assert_relative_eq!(pressure_drop(scene.system().report(), 6.0).unwrap(), 2.4, max_relative = 1e-13);
        (found - 0.4 * 27.0 / 24.0).abs()
    });
    assert!(errors[1] < 5e-4 && (errors[0] / errors[1]).log2() > 1.9, "{errors:?}");
}

/// Through the part of the interface to the right of the cross-section flows what flows through the cross-section
/// inside.
fn flux_through_interface(markers: &[Vec2], velocities: &[Vec2], x: f64) -> f64 {
    let count = markers.len();
    (0..count)
        .map(|k| {
            let next = (k + 1) % count;
            let (a, b) = (markers[k], markers[next]);
            // The part of the edge beyond x, as a part of its parameter.
            let at = (x - a.x) / (b.x - a.x);
            let (from, to) = match (a.x > x, b.x > x) {
                (true, true) => (0.0, 1.0),
                (true, false) => (0.0, at),
                (false, true) => (at, 1.0),
                (false, false) => return 0.0,
            };
            let velocity = velocities[k] + (velocities[next] - velocities[k]) * (0.5 * (from + to));
            let normal = Vec2::new(b.y - a.y, a.x - b.x) * (to - from);
            velocity.dot(normal)
        })
        .sum()
}

/// An ellipse that relaxes while it drifts in a channel: its flow through the cross-section is that through its front.
#[test]
fn inside_flux_is_that_of_the_interface() {
    let errors = [0.1, 0.05].map(|h: f64| {
        let grid = Grid::channel((6.0 / h).round() as usize, (3.0 / h).round() as usize, h).unwrap();
        let mut solver = ChannelStokes::new(grid, 1.0).unwrap();
        solver.set_drive(Drive::Flux(1.0)).unwrap();
        let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
        let curve = Curve::ellipse(1.2, 1.0 / 1.2).unwrap().rotated(0.5).translated(Vec2::new(0.02, 0.13));
        let count = (80.0 * 0.1 / h) as usize * 2;
        let body = scene.add(ActiveDroplet::passive(&curve.markers(count).unwrap(), 2.0).unwrap());
        let flow = gap_flow(scene.system_mut(), body).unwrap();
        assert_relative_eq!(flow.net(), net_flux(scene.system_mut(), 1.7).unwrap(), max_relative = 2e-3);
        let x = polygon_moments(scene.body(body).unwrap().markers()).unwrap().centroid.x;
        let markers = scene.body(body).unwrap().markers();
        let through = flux_through_interface(markers, scene.system().markers().velocities(), x);
        ((flow.inside - through).abs(), (flow.net() - 1.0).abs())
    });
    assert!(errors[1].0 < 3e-4 && errors[0].0 / errors[1].0 > 3.0, "{errors:?}");
    assert!(errors[1].1 < 2e-3 && errors[0].1 / errors[1].1 > 3.0, "{errors:?}");
}

#[test]
fn a_droplet_that_touches_the_walls_has_no_gaps() {
    let mut scene = Scene::new(Profile { plug: 1.0, shear: 0.0, curve: 0.0, walls: true });
    let body = scene.add(droplet(200, 1.5, [0.0, 0.5]));
    let flow = gap_flow(scene.system_mut(), body).unwrap();
    assert!(flow.gap_heights.iter().all(|height| (0.0..1e-3).contains(height)), "{flow:?}");
    assert_relative_eq!(flow.net(), 3.0, max_relative = 1e-13);
}

#[test]
fn channels_only() {
    let mut scene = Scene::new(Profile { plug: 1.0, shear: 0.0, curve: 0.0, walls: false });
    let body = scene.add(droplet(20, 0.5, [0.0, 0.0]));
    assert!(matches!(net_flux(scene.system_mut(), 0.0), Err(SceneError::Flow { .. })));
    let error = gap_flow(scene.system_mut(), body).unwrap_err();
    assert!(error.explanation().contains("Put the droplet into a channel"), "{error}");
    let mut other = Scene::new(Profile { plug: 1.0, shear: 0.0, curve: 0.0, walls: true });
    let error = gap_flow(other.system_mut(), body).unwrap_err();
    assert!(matches!(error, SceneError::Refused { .. }), "{error}");
    assert!(error.to_string().starts_with("the handle is of a body of another scene"), "{error}");
}
