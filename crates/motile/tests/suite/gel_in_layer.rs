//! Gels between interfaces along a channel and its walls.

use std::f64::consts::PI;

use motile::interior::{DirectorStart, GelInLayer, GelMaterial};
use motile::prelude::*;
use motile::scene::Body as _;
use motile::scene::integrator::Dynamics as _;
use motile::setup::{GelSetup, InterfaceSetup, Side};

const GEL: GelMaterial = GelMaterial {
    frank: 3.0,
    bend: Some(40.0),
    spontaneous_splay: 0.0,
    rotational_viscosity: 70.0,
    alignment: 0.4,
    activity: -60.0,
};
const VISCOSITY: f64 = 50.0;
const WIDTH: f64 = 5.0;

/// A channel with gels of these depths (length) at its lower and its upper wall, none where a depth is 0.
fn channel(depths: [f64; 2], spacing: f64) -> Setup {
    let start = DirectorStart::Uniform { angle: 0.0, noise: 0.0, seed: 1 };
    let gel = Some(GelSetup { material: GEL, start, spacing: Some(spacing), ..GelSetup::default() });
    let sides = [(-0.5 * WIDTH + depths[0], Side::Below), (0.5 * WIDTH - depths[1], Side::Above)];
    let interface = |(height, inside)| InterfaceSetup { height, inside, gel, ..InterfaceSetup::passive(10.0) };
    let present = sides.into_iter().zip(depths).filter(|(_, depth)| *depth > 0.0).map(|(side, _)| side);
    Setup {
        viscosity: VISCOSITY,
        region: Region::Channel { length: 4.0, width: WIDTH, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { nodes: 32, elements: 40, ..LayersMethod::of_spacing(spacing) }),
        droplets: Vec::new(),
        interfaces: present.map(interface).collect(),
        ..Setup::default()
    }
}

/// The growth rate of each gel's director if it is tilted by `size * tilt(y)`, as the mean of rate times tilt.
fn growth(setup: &Setup, tilt: impl Fn(f64) -> f64) -> Vec<f64> {
    let mut scene = setup.build().expect("a valid scene").scene;
    let handles: Vec<_> = scene.system().bodies::<GelInLayer>().map(|(handle, _)| handle).collect();
    let size = 1e-6;
    for &handle in &handles {
        let gel = scene.body_mut(handle).expect("a gel");
        let angles: Vec<f64> = gel.nodes().iter().map(|node| size * tilt(node.y)).collect();
        gel.read_state(&angles).expect("as many angles");
    }
    let lengths: Vec<usize> = scene.system().all_bodies().map(|(_, body)| body.state_len()).collect();
    let mut rate = vec![0.0; lengths.iter().sum()];
    scene.system_mut().present_rate(&mut rate).expect("rates");
    let of = |&handle: &Handle<GelInLayer>| {
        let start: usize = lengths[..handle.index()].iter().sum();
        let gel = scene.body(handle).expect("a gel");
        let pairs = gel.nodes().iter().zip(&rate[start..]).map(|(node, rate)| (tilt(node.y), rate / size));
        let [sum, norm] = pairs.fold([0.0; 2], |[sum, norm], (tilt, rate)| [sum + tilt * rate, norm + tilt * tilt]);
        sum / norm
    };
    handles.iter().map(of).collect()
}

/// A gel of depth d in a channel of width w, its director along x and tilted alike everywhere, pulls the fluid along,
/// which turns the director: `-(1 + nu1) zeta (1 - d/w)/(2 eta)`. Two gels tilted alike share the channel, so that 2d
/// takes the place of d; two that mirror each other pull against each other, and nothing opposes.
#[test]
fn a_tilted_director_turns_as_it_should() {
    let full = -(1.0 + GEL.alignment) * GEL.activity / (2.0 * VISCOSITY);
    let cases: [([f64; 2], f64, f64); 4] = [
        ([0.0, 2.0], 1.0, 1.0 - 2.0 / WIDTH),
        ([1.5, 0.0], 1.0, 1.0 - 1.5 / WIDTH),
        ([1.5, 1.5], 1.0, 1.0 - 3.0 / WIDTH),
        ([1.5, 1.5], -1.0, 1.0),
    ];
    for (depths, mirror, part) in cases {
        let found = growth(&channel(depths, 0.1), |y| if y < 0.0 { mirror } else { 1.0 });
        assert!(!found.is_empty());
        for rate in found {
            assert!((rate / (full * part) - 1.0).abs() < 1e-3, "{depths:?} {mirror}: {rate} of {}", full * part);
        }
    }
}

/// A tilt `cos(pi s/d)` over the depth splays the gel and leaves the fluid outside at rest:
/// `-K1 q^2/gamma1 - (1 + nu1)/(2 eta) (zeta + (1 + nu1)/2 K1 q^2)`, with an error of second order in the spacing.
#[test]
fn a_splayed_director_turns_as_it_should() {
    let depth = 2.0;
    let (q, coupling) = (PI / depth, 0.5 * (1.0 + GEL.alignment));
    let stiffness = GEL.frank * q * q;
    let exact = -stiffness / GEL.rotational_viscosity - coupling / VISCOSITY * (GEL.activity + coupling * stiffness);
    let errors = [0.2, 0.1].map(|spacing| {
        let found = growth(&channel([0.0, depth], spacing), |y| (q * (0.5 * WIDTH - y)).cos());
        (found[0] / exact - 1.0).abs()
    });
    assert!(errors[1] < 0.02 && errors[0] > 2.5 * errors[1], "{errors:?} of {exact}");
}

/// A droplet between two gels that active interfaces enclose: particles and areas stay, the gels turn.
#[test]
fn a_droplet_swims_between_active_walls_with_gels() {
    let mut setup = channel([1.0, 1.0], 0.2);
    setup.region = Region::Channel { length: 6.0, width: 6.0, drive: Drive::ZeroGradient };
    setup.viscosity = 100.0;
    for interface in &mut setup.interfaces {
        let active = InterfaceSetup::active(-0.3);
        interface.particles = active.particles;
        interface.height += 0.5 * interface.height.signum();
    }
    setup.droplets = vec![DropletSetup::active(-2.0)];
    let Built { mut scene, droplets, interfaces, .. } = setup.build().unwrap();
    let before = scene.observe(interfaces[0]).unwrap();
    scene.run(2.0).go().unwrap();
    let after = scene.observe(interfaces[0]).unwrap();
    assert!((after.particle_number / before.particle_number - 1.0).abs() < 1e-9);
    assert!((after.height - before.height).abs() < 1e-6, "{} {}", before.height, after.height);
    assert!(scene.observe(droplets[0]).unwrap().speed() > 0.02);
    let gels: Vec<_> = scene.system().bodies::<GelInLayer>().collect();
    assert_eq!(gels.len(), 2);
    let turned = |gel: &GelInLayer| gel.angles().iter().fold(0.0, |most: f64, angle| most.max(angle.abs()));
    assert!(gels.iter().all(|(_, gel)| turned(gel) > 1e-3));
}
