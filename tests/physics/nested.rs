//! Interfaces inside one another, on the grid and by boundary integrals.

use std::f64::consts::TAU;

use motile::ib_core::{FlowSample, Hydrodynamics, Markers, Vec2};
use motile::{AnyFlow, Built, DropletSetup, DropletShape, GridMethod, IntegralMethod, Method, Region, Setup};
use motile_tests::validation::contrast::Droplet;
use motile_tests::validation::order;
use motile_tests::validation::scene::{flow, open_channel};

use crate::net_forces::means;

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];
const REGIONS: [fn() -> Region; 2] = [|| Region::Box { lengths: [6.0; 2] }, || open_channel(6.0, 4.0)];
/// Viscosities of the outer and of the inner droplet; the exterior one is 1.
const VISCOSITIES: [[f64; 2]; 4] = [[10.0, 1.0], [0.1, 5.0], [100.0, 10.0], [20.0, 20.0]];

fn on_grid(region: Region, h: f64) -> AnyFlow {
    flow(region, Method::Grid(GridMethod::of_spacing(h)), 1.0, 1e-6).expect("a valid scene")
}

fn integral(region: Region) -> AnyFlow {
    flow(region, Method::Integral(IntegralMethod { nodes: 160, cells: 640 }), 1.0, 1e-10).expect("a valid scene")
}

/// An ellipse around a circle that is half a radius off its centre, with a force on the inner one.
fn scene([outer, inner]: [f64; 2], spacing: f64, pull: Vec2) -> Markers {
    let mut markers = Markers::new();
    let around = Droplet { axes: [1.2, 0.95], ..Droplet::circle(1, outer).at(0.1, 0.05) };
    let within = Droplet { axes: [0.4; 2], ..Droplet::circle(2, inner).at(0.35, 0.15) };
    for droplet in [around, within] {
        droplet.push_even(spacing, &mut markers).expect("enough markers");
    }
    let range = markers.groups()[1].range.clone();
    let share = 1.0 / range.len() as f64;
    markers.forces_mut()[range].iter_mut().for_each(|force| *force += share * pull);
    markers.set_viscosity_outside(1, Some(outer)).expect("a viscosity");
    markers
}

#[test]
fn droplets_in_droplets_move_as_they_should() {
    for region in REGIONS {
        for viscosities in VISCOSITIES {
            for pull in [Vec2::ZERO, Vec2::new(2.0, -1.0)] {
                let mut exact = scene(viscosities, TAU * 0.4 / 256.0, pull);
                integral(region()).velocities(&mut exact).unwrap();
                let exact = means(&exact);
                let fastest = exact[0].length().max(exact[1].length());
                let mut errors = [[0.0; 3]; 2];
                for (level, h) in SPACINGS.into_iter().enumerate() {
                    let mut markers = scene(viscosities, 0.5 * h, pull);
                    on_grid(region(), h).velocities(&mut markers).unwrap();
                    for (index, (found, exact)) in means(&markers).iter().zip(&exact).enumerate() {
                        errors[index][level] = (found - exact).length() / fastest;
                    }
                }
                // What is pulled through a narrow film of another viscosity is as hard as beside a wall.
                let (bound, scene) = (if pull == Vec2::ZERO { 5e-4 } else { 4e-3 }, (region(), viscosities, pull));
                assert!(errors[0][2] < 1e-4 && errors[1][2] < bound, "{scene:?}: {errors:?}");
                assert!(order(&SPACINGS, &errors[1]) > 1.7, "{scene:?}: {errors:?}");
            }
        }
    }
}

/// An interface without tension between equal fluids, in a droplet a tenth as viscous as the exterior fluid, moves with
/// the fluid there.
#[test]
fn an_interface_that_is_none_moves_with_the_fluid() {
    for region in REGIONS {
        let solved = |mut flow: AnyFlow, spacing: f64| {
            let mut markers = scene([0.1; 2], spacing, Vec2::ZERO);
            let inner = markers.groups()[1].range.clone();
            markers.forces_mut()[inner].fill(Vec2::ZERO);
            flow.velocities(&mut markers).unwrap();
            means(&markers)
        };
        let exact = solved(integral(region()), TAU * 0.4 / 256.0);
        let errors =
            SPACINGS.map(|h| (solved(on_grid(region(), h), 0.5 * h)[1] - exact[1]).length() / exact[1].length());
        println!("{:?}: {errors:?}", region());
        assert!(errors[2] < 5e-3 && order(&SPACINGS, &errors) > 1.7, "{:?}: {errors:?}", region());
    }
}

/// Velocities and pressures in each of the three fluids, a kernel's width away from the interfaces, as without a grid.
#[test]
fn the_flow_in_each_fluid() {
    let points = [[0.35, 0.15], [0.3, 0.1], [-0.5, 0.0], [-0.4, 0.3], [1.9, 0.4], [-1.5, -1.2]].map(Vec2::from);
    for region in REGIONS {
        for viscosities in VISCOSITIES {
            let sample = |mut flow: AnyFlow, spacing: f64| {
                let mut markers = scene(viscosities, spacing, Vec2::ZERO);
                flow.velocities(&mut markers).unwrap();
                let mut seen = [FlowSample::default(); 6];
                flow.sample(&markers, &points, &mut seen).unwrap();
                seen
            };
            let [exact, found] =
                [sample(integral(region()), TAU * 0.4 / 256.0), sample(on_grid(region(), 0.025), 0.0125)];
            let fastest = exact.iter().map(|seen| seen.velocity.length()).fold(0.0, f64::max);
            let range = exact.iter().map(|seen| (seen.pressure - exact[5].pressure).abs()).fold(0.0, f64::max);
            for (k, (exact_here, found_here)) in exact.iter().zip(&found).enumerate() {
                let velocity = (exact_here.velocity - found_here.velocity).length() / fastest;
                let pressures = [(exact_here, &exact[5]), (found_here, &found[5])];
                let [here, there] = pressures.map(|(seen, far)| seen.pressure - far.pressure);
                println!("{:?} {viscosities:?} {k}: {velocity:e} {:e}", region(), (here - there) / range);
                assert!(velocity < 5e-3 && (here - there).abs() < 1e-2 * range, "{viscosities:?} {k}");
            }
        }
    }
}

/// A scene finds the fluid around each droplet by itself, in every step, and the droplets observe it: an active droplet
/// around a passive one, and that around one more, swims alike on the grid and without.
#[test]
fn a_swimmer_around_droplets() {
    let speeds = [
        Method::Grid(GridMethod::of_spacing(0.1)),
        Method::Grid(GridMethod::of_spacing(0.05)),
        Method::Integral(IntegralMethod { nodes: 64, cells: 256 }),
    ]
    .map(|method| {
        let passive = |radius, place, viscosity| DropletSetup {
            viscosity: Some(viscosity),
            centre: [place, 0.1],
            shape: DropletShape::Round { radius },
            ..DropletSetup::passive(10.0)
        };
        let outer = DropletSetup { viscosity: Some(20.0), ..DropletSetup::active(-2.0) };
        // The innermost one first: the order does not matter.
        let droplets = vec![passive(0.2, 0.25, 300.0), outer, passive(0.5, 0.2, 50.0)];
        let Built { mut scene, droplets, .. } = Setup { method, droplets, ..Setup::default() }.build().unwrap();
        scene.run(0.3).go().unwrap();
        let around = [0, 1, 2].map(|k| scene.system().fluid_around(droplets[k]).unwrap().viscosity);
        assert_eq!(around, [50.0, 100.0, 20.0]);
        let seen = [0, 1, 2].map(|k| scene.observe(droplets[k]).unwrap());
        seen.map(|seen| seen.speed())
    });
    for k in 0..3 {
        let [coarse, fine] = [0, 1].map(|grid| (speeds[grid][k] / speeds[2][k] - 1.0).abs());
        println!("{k}: {coarse:e} {fine:e}");
        assert!(fine < 0.01 && fine < 0.35 * coarse, "{speeds:?}");
    }
}
