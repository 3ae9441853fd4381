//! Fluxes along channels that several droplets share.

use motile::active_interface::observables::{BranchFlow, branch_flows, gap_flow, net_flux};
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::setup::{Material, SolidOutline, SolidSetup, WallSetup};

/// The line through droplets above each other meets four interfaces, at each of which the shear jumps.
#[test]
fn no_fluid_passes_through_a_closed_channel() {
    let droplet = |y| DropletSetup { centre: [0.0, y], ..DropletSetup::active(-2.0) };
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroFlux },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: vec![droplet(1.3), droplet(-1.3)],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(0.1).go().unwrap();
    let flow = gap_flow(scene.system_mut(), droplets[0]).unwrap();
    assert!(flow.net().abs() < 1e-6 && flow.retrograde().is_some_and(|flux| flux > 0.1), "{flow:?}");
    // Through images of the droplets too.
    for x in [-12.2, 0.4, 12.7] {
        let flux = net_flux(scene.system_mut(), x).unwrap();
        assert!(flux.abs() < 1e-6, "{x}: {flux:e}");
    }
}

/// A channel of the width 5 in which a long straight island leaves branches of these widths (length), from bottom up.
fn divided(widths: [f64; 2], drive: Drive) -> Scene<AnyFlow> {
    let [low, high] = [widths[0] - 2.5, 2.5 - widths[1]];
    let corners = vec![[-10.0, low], [10.0, low], [10.0, high], [-10.0, high]];
    let outline = SolidOutline::Polygon { corners, rounding: 0.0 };
    let setup = Setup {
        viscosity: 3.0,
        tolerance: Some(1e-10),
        region: Region::Channel { length: 26.0, width: 5.0, drive },
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
        droplets: Vec::new(),
        walls: vec![WallSetup { outline, spacing: 0.15, grading: 1.0, rounding: 0.2 }],
        ..Setup::default()
    };
    setup.build().expect("a valid scene").scene
}

/// Both branches resist as plates do, `12 eta L/w^3`, so that fluxes are as the cubes of their widths where the same
/// pressure drives both.
#[test]
fn straight_branches_have_the_resistance_of_poiseuille() {
    for (widths, drive) in [([1.5, 2.5], Drive::Gradient(-0.7)), ([2.0, 2.2], Drive::Flux(0.3))] {
        let mut scene = divided(widths, drive);
        let [from, to] = [-2.0, 3.0];
        let branches = branch_flows(scene.system_mut(), [from, to]).unwrap();
        assert_eq!(branches.len(), 2);
        for (branch, width) in branches.iter().zip(widths) {
            let [low, high] = branch.openings[0];
            assert!((high - low - width).abs() < 1e-9, "{branch:?}");
            let exact = 12.0 * 3.0 * (to - from) / f64::powi(width, 3);
            let error = branch.resistance().unwrap() / exact - 1.0;
            assert!(error.abs() < 1e-5, "{widths:?} {drive:?}: {error:e}");
        }
        // What enters the branches passes the undivided channel, which is a branch, too.
        let total: f64 = branches.iter().map(|branch| branch.flux).sum();
        let whole = branch_flows(scene.system_mut(), [-12.0, 12.0]).unwrap();
        let [BranchFlow { flux, openings, pressure_drop, .. }] = whole[..] else { panic!("{whole:?}") };
        assert!((total - flux).abs() < 1e-6 * flux && openings == [[-2.5, 2.5]; 2], "{total} {flux} {openings:?}");
        // Longer than the branches, and shorter than a period.
        assert!(pressure_drop > branches[0].pressure_drop * 4.0, "{pressure_drop}");
        let error = branch_flows(scene.system_mut(), [0.0, 12.0]).unwrap_err();
        assert!(error.to_string().contains("branches of which 2 start and 1 end"), "{error}");
    }
}

/// A straight channel without anything in it.
#[test]
fn an_empty_channel_is_one_branch() {
    for drive in [Drive::Gradient(-0.7), Drive::Flux(0.3)] {
        let setup = Setup {
            viscosity: 3.0,
            region: Region::Channel { length: 8.0, width: 2.0, drive },
            droplets: Vec::new(),
            ..Setup::default()
        };
        let mut scene = setup.build().unwrap().scene;
        let branches = branch_flows(scene.system_mut(), [-3.0, 1.0]).unwrap();
        let [branch] = branches[..] else { panic!("{branches:?}") };
        // 12 times 3 times 4 over 2 cubed.
        assert!((branch.resistance().unwrap() - 18.0).abs() < 1e-10, "{drive:?}: {branch:?}");
        assert!((branch.flux - drive.flux().unwrap_or(0.7 * 8.0 / 36.0)).abs() < 1e-12, "{drive:?}: {branch:?}");
    }
}

/// The openings between elastic walls and their island.
#[test]
fn elastic_walls_divide_a_channel() {
    let shape = ChannelShape::Branching {
        width: 2.4,
        branches: [1.0, 0.7],
        island_length: 4.0,
        island_thickness: 1.2,
        ramp: 2.0,
    };
    let material = Material::Springs { shear: 100.0 };
    let setup = Setup {
        region: Region::Channel { length: 12.0, width: 6.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(0.1)),
        droplets: Vec::new(),
        solids: SolidSetup::walls(&shape, &material),
        ..Setup::default()
    };
    assert_eq!(setup.solids.len(), 3);
    let mut scene = setup.build().unwrap().scene;
    // The whole island, whose sides are -0.6 and 0.6 in the middle; channels of 2.4 before and behind it.
    for (x, expected) in [(0.0, vec![[-1.6, -0.6], [0.6, 1.3]]), (-5.0, vec![[-1.2, 1.2]]), (17.0, vec![[-1.2, 1.2]])] {
        let found: Vec<_> = branch_flows(scene.system_mut(), [x, x]).unwrap().iter().map(|b| b.openings[0]).collect();
        assert_eq!(found.len(), expected.len(), "{x}: {found:?}");
        let errors = found.iter().flatten().zip(expected.iter().flatten()).map(|(a, b)| (a - b).abs());
        assert!(errors.fold(0.0, f64::max) < 2e-3, "{x}: {found:?} {expected:?}");
    }
}
