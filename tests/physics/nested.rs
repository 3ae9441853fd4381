//! Interfaces inside one another, as layers beside a grid and by boundary integrals.

use std::f64::consts::TAU;

use motile::base::Region;
use motile::base::{FlowSample, Vec2};
use motile::ib_core::{AnyKernel, ImmersedBoundary};
use motile::scene::{FlowError, Hydrodynamics, Markers};
use motile::setup::{AnyFlow, Built, DropletSetup, DropletShape, IntegralMethod, LayersMethod, Method, Setup};
use motile::stokes_grid::{Grid, PeriodicStokes};
use motile_tests::validation::contrast::Droplet;
use motile_tests::validation::scene::{flow, open_channel};

use crate::net_forces::{beside_a_point, layers, means};

const REGIONS: [fn() -> Region; 2] = [|| Region::Box { lengths: [6.0; 2] }, || open_channel(6.0, 4.0)];
/// Viscosities of the outer and of the inner droplet; the exterior one is 1.
const VISCOSITIES: [[f64; 2]; 4] = [[10.0, 1.0], [0.1, 5.0], [100.0, 10.0], [20.0, 20.0]];

fn integral(region: Region) -> AnyFlow {
    flow(region, Method::Integral(IntegralMethod { nodes: 160, elements: 640 }), 1.0, 1e-10).expect("a valid scene")
}

/// An ellipse around a circle that is half a radius off its centre, with a force on the inner one.
fn scene([outer, inner]: [f64; 2], pull: Vec2) -> Markers {
    let mut markers = Markers::new();
    let around = Droplet { axes: [1.2, 0.95], ..Droplet::circle(1, outer).at(0.1, 0.05) };
    let within = Droplet { axes: [0.4; 2], ..Droplet::circle(2, inner).at(0.35, 0.15) };
    for droplet in [around, within] {
        droplet.push_even(TAU * 0.4 / 256.0, &mut markers).expect("enough markers");
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
                let solved = |mut flow: AnyFlow, mut markers: Markers| {
                    flow.velocities(&mut markers).unwrap();
                    means(&markers)
                };
                let exact = solved(integral(region()), scene(viscosities, pull));
                let found = solved(layers(region(), 0.1), beside_a_point(scene(viscosities, pull)));
                let fastest = exact[0].length().max(exact[1].length());
                for (exact, found) in exact.iter().zip(found) {
                    let error = (found - exact).length() / fastest;
                    println!("{:?} {viscosities:?} {pull}: {error:e}", region());
                    assert!(error < 5e-5, "{:?} {viscosities:?} {pull}: {error:e}", region());
                }
            }
        }
    }
}

/// An interface without tension between equal fluids, in a droplet a tenth as viscous as the exterior fluid, moves with
/// the fluid there.
#[test]
fn an_interface_that_is_none_moves_with_the_fluid() {
    for region in REGIONS {
        let solved = |mut flow: AnyFlow, mut markers: Markers| {
            let inner = markers.groups()[1].range.clone();
            markers.forces_mut()[inner].fill(Vec2::ZERO);
            flow.velocities(&mut markers).unwrap();
            means(&markers)[1]
        };
        let exact = solved(integral(region()), scene([0.1; 2], Vec2::ZERO));
        let found = solved(layers(region(), 0.1), beside_a_point(scene([0.1; 2], Vec2::ZERO)));
        let error = (found - exact).length() / exact.length();
        println!("{:?}: {error:e}", region());
        assert!(error < 1e-5, "{:?}: {error:e}", region());
    }
}

/// A grid of one viscosity does not know of them.
#[test]
fn a_grid_alone_refuses_them() {
    let solver = PeriodicStokes::new(Grid::periodic(60, 60, 0.1).unwrap(), 1.0).unwrap();
    let mut flow = ImmersedBoundary::new(solver, AnyKernel::BSpline4);
    let refused = flow.velocities(&mut scene([0.1, 5.0], Vec2::ZERO));
    let error = refused.unwrap_err();
    let refused = matches!(error, FlowError::Refused { .. });
    assert!(refused && error.to_string().contains("on a grid"), "{error}");
}

/// Velocities and pressures in each of the three fluids, a kernel's width away from the interfaces, as without a grid.
#[test]
fn the_flow_in_each_fluid() {
    let points = [[0.35, 0.15], [0.3, 0.1], [-0.5, 0.0], [-0.4, 0.3], [1.9, 0.4], [-1.5, -1.2]].map(Vec2::from);
    for region in REGIONS {
        for viscosities in VISCOSITIES {
            let sample = |(mut flow, mut markers): (AnyFlow, Markers)| {
                flow.velocities(&mut markers).unwrap();
                let mut seen = [FlowSample::default(); 6];
                flow.sample(&markers, &points, &mut seen).unwrap();
                seen
            };
            let alone = || scene(viscosities, Vec2::ZERO);
            let flows = [(integral(region()), alone()), (layers(region(), 0.025), beside_a_point(alone()))];
            let [exact, found] = flows.map(sample);
            let fastest = exact.iter().map(|seen| seen.velocity.length()).fold(0.0, f64::max);
            let range = exact.iter().map(|seen| (seen.pressure - exact[5].pressure).abs()).fold(0.0, f64::max);
            for (k, (exact_here, found_here)) in exact.iter().zip(&found).enumerate() {
                let velocity = (exact_here.velocity - found_here.velocity).length() / fastest;
                let pressures = [(exact_here, &exact[5]), (found_here, &found[5])];
                let [here, there] = pressures.map(|(seen, far)| seen.pressure - far.pressure);
                println!("{:?} {viscosities:?} {k}: {velocity:e} {:e}", region(), (here - there) / range);
                assert!(velocity < 5e-3 && (here - there).abs() < 2e-8 * range, "{viscosities:?} {k}");
            }
        }
    }
}

/// A scene finds the fluid around each droplet by itself, in every step, and the droplets observe it: an active droplet
/// around a passive one, and that around one more, swims alike on the grid and without.
#[test]
fn a_swimmer_around_droplets() {
    let of_layers = LayersMethod { nodes: 64, elements: 256, ..LayersMethod::of_spacing(0.1) };
    let methods = [Method::Layers(of_layers), Method::Integral(IntegralMethod { nodes: 64, elements: 256 })];
    let [of_layers, exact] = methods.map(|method| {
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
    for (found, exact) in of_layers.iter().zip(exact) {
        println!("{found} {exact}: {:e}", found / exact - 1.0);
        assert!((found / exact - 1.0).abs() < 1e-4, "{of_layers:?} {exact:?}");
    }
}

/// In a channel as wide as it a droplet that is a layer starts beside films, as without a grid.
#[test]
fn layers_start_beside_films() {
    let inner = DropletSetup {
        viscosity: Some(300.0),
        shape: DropletShape::Round { radius: 0.3 },
        ..DropletSetup::passive(10.0)
    };
    let droplets = vec![DropletSetup { viscosity: Some(10.0), ..DropletSetup::active(-2.0) }, inner];
    let speeds =
        [Method::Layers(LayersMethod::of_spacing(0.1)), Method::Integral(IntegralMethod::default())].map(|method| {
            let setup =
                Setup { region: open_channel(6.0, 2.0), method, droplets: droplets.clone(), ..Setup::default() };
            let Built { mut scene, droplets, .. } = setup.build().unwrap();
            scene.run(0.2).go().unwrap();
            scene.observe(droplets[0]).unwrap().speed()
        });
    assert!((speeds[0] / speeds[1] - 1.0).abs() < 5e-8, "{speeds:?}");
}
