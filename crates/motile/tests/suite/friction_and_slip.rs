//! Friction of the fluid and slip along the walls of a channel, in scenes.

use motile::active_interface::observables::net_flux;
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::setup::{
    FibreHold, FibreSetup, FibreShape, FlowSetup, GridSolver, Material, SolidOutline, SolidSetup, WallSetup,
};

fn grid(spacing: f64) -> Method {
    Method::Grid(GridMethod { spacing, ..GridMethod::default() })
}

fn integral() -> Method {
    Method::Integral(IntegralMethod { nodes: 64, elements: 128 })
}

fn slipping(drive: Drive, slip: [f64; 2], method: Method) -> Setup {
    let region = Region::Channel { length: 6.0, width: 3.0, drive }.with_slip(slip);
    let droplet = DropletSetup { centre: [0.1, 0.2], ..DropletSetup::active(-3.0) };
    Setup { region, method, droplets: vec![droplet], ..Setup::default() }
}

/// Velocity of the first droplet and flux at the start.
fn start(setup: &Setup) -> ([f64; 2], f64) {
    let Built { mut scene, droplets, .. } = setup.build().expect("a valid scene");
    scene.system_mut().evaluate().expect("velocities");
    let velocity = scene.observe(droplets[0]).expect("a droplet").velocity;
    (velocity.into(), net_flux(scene.system_mut(), 2.2).expect("a channel"))
}

/// Two methods give the same velocity and flux, to second order in the spacing.
#[test]
fn a_swimmer_between_walls_with_slip_by_two_methods() {
    for (drive, slip) in
        [(Drive::ZeroGradient, [0.5; 2]), (Drive::Gradient(-3.0), [0.3, 0.0]), (Drive::ZeroFlux, [0.1, 2.0])]
    {
        let (expected, flux) = start(&slipping(drive, slip, integral()));
        let errors = [0.1, 0.05].map(|spacing| {
            let (found, through) = start(&slipping(drive, slip, grid(spacing)));
            let apart = (found[0] - expected[0]).hypot(found[1] - expected[1]) / expected[0].hypot(expected[1]);
            [apart, (through - flux).abs()]
        });
        println!("{drive:?} {slip:?}: {expected:?} {flux} {errors:?}");
        assert!(errors[1][0] < 4e-3 && errors[1][0] < 0.5 * errors[0][0].max(2e-3), "{drive:?}: {errors:?}");
        assert!(errors[1][1] < 2e-3 * flux.abs().max(0.1), "{drive:?}: {errors:?}");
    }
}

/// Layers between walls with slip: a droplet alone as by boundary integrals, and with a fibre nearly as by the grid.
#[test]
fn layers_between_walls_with_slip() {
    let layers = Method::Layers(LayersMethod { nodes: 64, elements: 128, spacing: 0.1, ..LayersMethod::default() });
    for (drive, slip) in [(Drive::Gradient(-3.0), [0.3, 0.0]), (Drive::ZeroFlux, [0.1, 2.0])] {
        let (expected, flux) = start(&slipping(drive, slip, integral()));
        let (found, through) = start(&slipping(drive, slip, layers));
        let apart = (found[0] - expected[0]).hypot(found[1] - expected[1]) / expected[0].hypot(expected[1]);
        assert!(apart < 1e-6 && (through - flux).abs() < 1e-6 * flux.abs().max(1.0), "{apart} {through} {flux}");
        let fibre = FibreSetup {
            shape: FibreShape::Line { from: [1.6, -0.5], to: [1.9, 0.5] },
            ends: [FibreHold::Clamped, FibreHold::Free],
            ..FibreSetup::default()
        };
        let [by_layers, by_grid] = [layers, grid(0.05)]
            .map(|method| start(&Setup { fibres: vec![fibre.clone()], ..slipping(drive, slip, method) }).0);
        let apart = (by_layers[0] - by_grid[0]).hypot(by_layers[1] - by_grid[1]) / by_grid[0].hypot(by_grid[1]);
        println!("{drive:?}: {by_layers:?} {by_grid:?} {apart}");
        assert!(apart < 2e-2, "{drive:?}: {by_layers:?} {by_grid:?}");
    }
    let close = FibreSetup {
        shape: FibreShape::Line { from: [1.6, -1.5], to: [1.9, 0.5] },
        reference_curvature: Some(2.0),
        ..FibreSetup::default()
    };
    let setup = Setup { fibres: vec![close], ..slipping(Drive::ZeroFlux, [0.1, 0.2], layers) };
    let mut scene = setup.build().expect("checked at each state").scene;
    let error = scene.system_mut().evaluate().expect_err("too close").to_string();
    assert!(error.contains("slip"), "{error}");
}

/// Walls that slide drive Couette flow through the slip lengths, written as a scene file would.
#[cfg(feature = "toml")]
#[test]
fn walls_that_slide_and_slip() {
    let text = "
        region.channel = { length = 6.0, width = 3.0, slip = [0.2, 1] }
        method.integral = { nodes = 32, elements = 64 }
        flow.wall-velocity = [0.0, 1.0]
    ";
    let setup = Setup::from_toml(text).expect("a scene");
    assert_eq!(setup.region.slip(), [0.2, 1.0]);
    let Built { mut scene, .. } = setup.build().expect("a scene");
    let flux = net_flux(scene.system_mut(), 0.0).expect("a channel");
    let exact = (4.5 + 0.2 * 3.0) / 4.2;
    assert!((flux / exact - 1.0).abs() < 1e-12, "{flux} {exact}");
    let both = Setup::from_toml("region.channel = { length = 6.0, width = 3.0, slip = 0.25 }").expect("a scene");
    assert_eq!(both.region.slip(), [0.25; 2]);
    let written = setup.to_toml().expect("text");
    assert_eq!(Setup::from_toml(&written).expect("a scene"), setup, "{written}");
    let none = Setup::from_toml("region.channel = { length = 6.0, width = 3.0, slip = 0.0 }").expect("a scene");
    assert!(matches!(none.region, Region::Channel { .. }) && !none.to_toml().expect("text").contains("slip"));
    let wrong = Setup::from_toml("region.channel = { length = 6.0, width = 3.0, slip = [1.0, 2.0, 3.0] }");
    assert!(wrong.is_err_and(|error| error.to_string().contains("slip length")));
}

/// Friction of the fluid slows a swimmer, whose speed with friction 100 is about two thirds of the one without.
#[test]
fn friction_slows_a_swimmer() {
    let speed = |friction: f64| {
        let droplets = vec![DropletSetup::active(-2.0)];
        let region = Region::Box { lengths: [16.0; 2] };
        let setup = Setup { region, friction, method: grid(0.1), droplets, ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().expect("a valid scene");
        scene.system_mut().evaluate().expect("velocities");
        scene.observe(droplets[0]).expect("a droplet").velocity.length()
    };
    // The start is polarised as cos t, so that both speeds are those of the same tension, but for the box.
    let ratio = speed(100.0) / speed(0.0);
    assert!((ratio - 8.170_750_391_52e-4 * 800.0).abs() < 0.02, "{ratio}");
}

fn refusal(setup: &Setup) -> String {
    setup.check().expect_err("a refusal").to_string()
}

#[test]
fn what_has_no_friction_or_slip_is_refused() {
    let rough = Setup { friction: 10.0, ..Setup::default() };
    assert!(refusal(&rough).contains("friction"), "{}", refusal(&rough));
    for friction in [-1.0, f64::NAN, f64::INFINITY] {
        let wrong = Setup { friction, method: grid(0.1), ..Setup::default() };
        assert!(refusal(&wrong).starts_with("friction = "), "{}", refusal(&wrong));
    }
    let layers = Method::Layers(LayersMethod::of_spacing(0.1));
    let projected = |base: &Setup| {
        let method = GridMethod { solver: GridSolver::Projection, spacing: 0.1, ..GridMethod::default() };
        Setup { method: Method::Grid(method), ..base.clone() }
    };
    assert!(refusal(&Setup { method: layers, ..rough.clone() }).contains("friction"));
    assert!(refusal(&projected(&rough)).contains("friction"));
    let slips = slipping(Drive::ZeroFlux, [0.1, 0.2], integral());
    slips.check().expect("a scene");
    assert!(refusal(&projected(&slips)).contains("slip"));
    for slip in [[-0.1, 0.0], [0.1, f64::NAN]] {
        let wrong = slipping(Drive::ZeroFlux, slip, integral());
        assert!(refusal(&wrong).contains("slip["), "{}", refusal(&wrong));
    }
    let walls = vec![WallSetup::new(
        SolidOutline::Polygon { corners: vec![[-2.5, -1.4], [-2.0, -1.4], [-2.2, -1.2]], rounding: 0.0 },
        0.1,
    )];
    assert!(refusal(&Setup { walls, ..slips.clone() }).contains("curved rigid walls"));
    let solids =
        SolidSetup::walls(&ChannelShape::Straight { width: 2.6 }, &Material::NeoHookean { shear: 200.0, bulk: 400.0 });
    let elastic = Setup { solids, ..slipping(Drive::ZeroFlux, [0.1, 0.2], grid(0.1)) };
    assert!(refusal(&elastic).contains("solids"), "{}", refusal(&elastic));
    let sheared = Setup { flow: FlowSetup { shear: 1.0, ..FlowSetup::default() }, ..slips.clone() };
    assert!(refusal(&sheared).contains("wall-velocity"), "{}", refusal(&sheared));
    // A resumed run has to agree on both.
    #[cfg(feature = "toml")]
    {
        let other = slipping(Drive::ZeroFlux, [0.1, 0.3], integral());
        assert!(slips.difference(&other).is_some_and(|text| text.contains("slip")));
        assert!(Setup::default().difference(&rough).is_some_and(|text| text.contains("friction")));
    }
    assert_ne!(Setup::default().fingerprint(), rough.fingerprint());
}

/// On a grid, a droplet next to a wall with slip is refused, because the delta function continues no slip.
#[test]
fn markers_within_the_kernel_of_a_wall_with_slip_are_refused() {
    let mut setup = slipping(Drive::ZeroFlux, [0.0, 0.2], grid(0.1));
    setup.droplets[0].centre = [0.0, 0.45];
    let Built { mut scene, .. } = setup.build().expect("a scene");
    let text = scene.system_mut().evaluate().expect_err("a refusal").to_string();
    assert!(text.contains("slip"), "{text}");
    setup.droplets[0].centre = [0.0, -0.45];
    setup.build().expect("a scene").scene.system_mut().evaluate().expect("a wall without slip");
}
