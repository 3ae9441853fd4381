//! Directions of droplets at rest, and observables in other frames of reference.

use motile::active_interface::observables::{FourierModes, Observables, gap_flow};
use motile::analysis::suspension::Member;
use motile::prelude::*;
use motile::setup::{
    DropletShape, FlowSetup, InterfaceSetup, InterfaceShape, MethodKind, PoiseuilleSetup, Side, Start,
};

/// A droplet below the threshold that relaxes from an ellipse.
fn relaxing(half_axes: [f64; 2], angle: f64) -> DropletSetup {
    let active = DropletSetup::active(-0.1);
    let particles = active.particles.map(|particles| Particles { start: Start::Uniform, ..particles });
    DropletSetup { shape: DropletShape::Ellipse { half_axes }, angle, particles, ..active }
}

fn integral() -> Method {
    Method::Integral(IntegralMethod { nodes: 48, elements: 192 })
}

/// Observables of the first droplet at several times, in a flow that is exact to round-off.
fn seen(setup: &Setup, times: &[f64]) -> Vec<Observables> {
    let tolerance = (setup.method.kind() == MethodKind::Integral).then_some(1e-14);
    let Built { mut scene, droplets, .. } = Setup { tolerance, ..setup.clone() }.build().expect("a valid scene");
    let at = |time: &f64| {
        scene.run(*time).go().expect("a run");
        scene.observe(droplets[0]).expect("a droplet")
    };
    times.iter().map(at).collect()
}

/// A droplet at rest has no direction: its axes are x and y, at the start, while it relaxes, and once it is round.
#[test]
fn a_droplet_at_rest_has_no_direction() {
    let turned = Setup { droplets: vec![relaxing([1.3, 0.77], 0.4)], ..Setup::default() };
    let along_x = Setup { droplets: vec![relaxing([1.3, 0.77], 0.0)], ..Setup::default() };
    let channel = Region::Channel { length: 6.0, width: 5.0, drive: Drive::ZeroFlux };
    let square = Region::Box { lengths: [6.0, 6.0] };
    let grid = Method::Grid(GridMethod::of_spacing(0.1));
    let layers = Method::Layers(LayersMethod::of_spacing(0.2));
    let contrast = DropletSetup { viscosity: Some(3.0), ..relaxing([1.3, 0.77], 0.0) };
    let between = DropletSetup { centre: [0.013, 0.027], ..relaxing([1.3, 0.77], 0.0) };
    for (setup, inclined) in [
        (Setup { region: Region::Plane, method: integral(), ..turned.clone() }, 0.4_f64),
        (Setup { region: Region::Plane, method: integral(), ..along_x.clone() }, 0.0),
        (Setup { region: Region::Plane, method: integral(), droplets: vec![contrast], ..along_x.clone() }, 0.0),
        (Setup { region: Region::Space, method: integral(), ..along_x.clone() }, 0.0),
        (Setup { region: channel, method: integral(), ..along_x.clone() }, 0.0),
        (Setup { region: square, method: grid, ..along_x.clone() }, 0.0),
        (Setup { region: square, method: grid, droplets: vec![between], ..along_x.clone() }, 0.0),
        (Setup { region: square, method: layers, ..along_x.clone() }, 0.0),
    ] {
        let seen = seen(&setup, &[0.0, 0.26, 0.63, 1.0, 3.0]);
        let about = format!("{:?} {:?}", setup.region, setup.method.kind());
        for (seen, next) in seen.iter().zip(&seen[1..]) {
            let ratios = [seen, next].map(|seen| seen.aspect_ratio_moments);
            assert!(ratios[0] > ratios[1] && ratios[1] > 1.0, "{about}: {ratios:?}");
            let sizes = [seen, next].map(|seen| -seen.get("stresslet_xx").expect("a name"));
            assert!(sizes[0] > sizes[1] && sizes[1] > 0.0, "{about}: {sizes:?}");
        }
        for seen in &seen {
            for name in ["heading_degrees", "beta", "beta_laboratory"] {
                assert_eq!(seen.get(name), None, "{about}");
            }
            assert_eq!((seen.heading(), seen.frame().heading()), (None, 0.0), "{about}");
            let angle = seen.get("inclination_degrees").expect("an ellipse").to_radians();
            assert!((angle - inclined).abs() < 0.05, "{about}: {angle}");
            assert_eq!(seen.get("stresslet_xx"), seen.get("stresslet_xx_laboratory"), "{about}");
        }
        if inclined == 0.0 && setup.region != Region::Space {
            assert!((seen[0].aspect_ratio_moments - 1.3 / 0.77).abs() < 1e-3, "{about}");
        }
        let deformation = seen[0].get("deformation").expect("a name");
        assert!((deformation - 0.53 / 2.07).abs() < 1e-3, "{about}: {deformation}");
    }
    // A long time later all speeds on the interface are round-off.
    let round =
        Setup { region: Region::Plane, method: integral(), droplets: vec![DropletSetup::passive(10.0)], ..turned };
    let round = &seen(&round, &[1.0])[0];
    assert_eq!([round.heading(), round.get("beta"), round.get("inclination_degrees")], [None; 3], "{round:?}");
    assert!(round.get("deformation").expect("a name") < 1e-9);
}

/// A uniform start has no heading in a crowd either; a swimmer has one everywhere.
#[test]
fn uniform_droplets_have_no_heading() {
    let setup = Setup {
        region: Region::Plane,
        method: integral(),
        droplets: vec![
            relaxing([1.3, 0.77], 0.0),
            DropletSetup { centre: [0.0, 4.0], angle: 0.7, ..DropletSetup::default() },
            DropletSetup { centre: [0.0, -4.0], ..DropletSetup::passive(10.0) },
        ],
        ..Setup::default()
    };
    let mut scene = setup.build().expect("a valid scene").scene;
    let members = Member::all(scene.system_mut()).expect("droplets");
    assert_eq!([members[0].heading, members[2].heading], [Vec2::ZERO; 2]);
    assert!((members[1].heading - Vec2::from_angle(0.7)).length() < 1e-3, "{members:?}");
    assert!(members[2].shape.angle.is_none() && members[0].shape.angle.is_some());
}

/// An observer who is carried along sees the same values, except for places and velocities of the whole motion.
fn assert_same(one: &Observables, other: &Observables, about: &str) {
    let scale = |name: &str| -> f64 {
        // Moments of forces, in units of the tension.
        let moment = name.starts_with("stresslet") || name.starts_with("f_") || name.contains("force");
        let quadrupole = name.starts_with("s_") || name.starts_with("n_");
        // The places of steepest slopes, in numbers of the elements' width.
        let place = name.starts_with("active");
        if moment || quadrupole {
            100.0
        } else if place {
            10.0
        } else {
            1.0
        }
    };
    for ((name, a), (_, b)) in one.entries().into_iter().zip(other.entries()) {
        if ["x", "y", "velocity_x", "velocity_y"].contains(&name) {
            continue;
        }
        assert_eq!(a.is_some(), b.is_some(), "{about}: {name} {a:?} {b:?}");
        let (a, b) = (a.unwrap_or_default(), b.unwrap_or_default());
        assert!((a - b).abs() <= 1e-10 * scale(name).max(a.abs()), "{about}: {name} {a} {b}");
    }
    assert!((one.relative_velocity - other.relative_velocity).length() < 1e-10);
}

/// A droplet is as it was if you shift it in a linear flow and look from a frame that moves with it.
#[test]
fn a_droplet_shifted_across_a_flow_is_the_same() {
    let active = DropletSetup::active(-3.0);
    let contrast = DropletSetup { viscosity: Some(300.0), angle: 2.0, ..DropletSetup::active(-3.0) };
    let start = DropletSetup { shape: DropletShape::Ellipse { half_axes: [1.2, 0.85] }, ..DropletSetup::passive(40.0) };
    for (flow, shifts) in [
        (FlowSetup { shear: 0.3, ..FlowSetup::default() }, [[0.0, 0.7], [4.0, -3.0], [-2.5, 13.0]]),
        (FlowSetup { extension: 0.1, ..FlowSetup::default() }, [[0.7, 0.0], [4.0, -3.0], [-2.5, 3.0]]),
    ] {
        for (droplet, moves) in [(&active, true), (&contrast, true), (&start, false)] {
            let at = |[x, y]: [f64; 2]| {
                let droplets = vec![DropletSetup { centre: [x, y], ..droplet.clone() }];
                let step = StepSize::Fixed(0.02);
                let setup =
                    Setup { region: Region::Plane, method: integral(), flow, droplets, step, ..Setup::default() };
                seen(&setup, &[0.0, 0.4])
            };
            let still = at([0.0, 0.0]);
            for shift in shifts {
                for (one, other) in still.iter().zip(&at(shift)) {
                    assert_same(one, other, &format!("{flow:?} {shift:?}"));
                    assert_eq!(one.moves, moves, "{one:?}");
                }
            }
            assert!(still[1].get("deformation").is_some_and(|deformation| deformation > 0.01));
        }
    }
}

/// In a parabolic flow the speed is that of the slip past the flow at the centroid, at any speed of the frame.
#[test]
fn a_drop_in_a_parabolic_flow_slips_by_its_curvature() {
    let poiseuille = Some(PoiseuilleSetup { speed: 1.0, half_width: 5.0 });
    let flow = FlowSetup { poiseuille, ..FlowSetup::default() };
    let droplets = vec![DropletSetup::passive(100.0)];
    let setup = Setup { region: Region::Plane, method: integral(), viscosity: 1.0, flow, droplets, ..Setup::default() };
    let seen = &seen(&setup, &[0.0])[0];
    // Faxen: a disc of the fluid itself moves with the mean over its area, U (1 - R^2/(4 h^2)).
    assert!((seen.velocity.x - 0.99).abs() < 1e-6 && (seen.relative_velocity.x + 0.01).abs() < 1e-6, "{seen:?}");
    assert!((seen.heading().expect("a slip").abs() - std::f64::consts::PI).abs() < 1e-6);
}

/// A droplet is as it was in another image of a sheared box, at the start and after the images have moved.
#[test]
fn a_droplet_moved_by_a_period_of_a_sheared_box_is_the_same() {
    let flow = FlowSetup { shear: 0.5, ..FlowSetup::default() };
    let region = Region::Box { lengths: [5.0, 4.0] };
    for droplet in [DropletSetup::active(-3.0), DropletSetup { viscosity: Some(20.0), ..DropletSetup::passive(60.0) }] {
        let at = |centre: [f64; 2]| {
            let droplets = vec![DropletSetup { centre, ..droplet.clone() }];
            let step = StepSize::Fixed(0.02);
            seen(&Setup { region, method: integral(), flow, droplets, step, ..Setup::default() }, &[0.0, 0.4])
        };
        let inside = at([0.3, 0.2]);
        for centre in [[0.3, 4.2], [-4.7, 0.2], [5.3, -7.8]] {
            for (one, other) in inside.iter().zip(&at(centre)) {
                assert_same(one, other, &format!("{centre:?}"));
            }
        }
        assert!(inside[1].get("deformation").is_some_and(|deformation| deformation > 0.01));
    }
}

/// The stresslet of a droplet is that of all of its force moments, turned back from the axes along the motion: minus
/// the particle stress of its scene.
#[test]
fn stresslets_in_laboratory_axes_are_those_of_the_stress() {
    let droplet = DropletSetup { angle: 0.9, viscosity: Some(30.0), ..DropletSetup::active(-3.0) };
    let method = Method::Integral(IntegralMethod { nodes: 128, elements: 512 });
    let setup = Setup { region: Region::Plane, method, droplets: vec![droplet], ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build().expect("a valid scene");
    scene.run(0.5).go().expect("a run");
    let [[xx, xy], _] = scene.system_mut().stresslets().expect("stresslets")[0];
    let seen = scene.observe(droplets[0]).expect("a droplet");
    let [found, along] = [seen.stresslet_in_laboratory[0], seen.moments.stresslet()[0]];
    let error = Vec2::new(found[0] + xx, found[1] + xy).length() / xx.hypot(xy);
    assert!(error < 2e-3, "{found:?} {xx} {xy}");
    assert!((found[0] - along[0]).abs() > 0.5 * xx.hypot(xy), "{found:?} {along:?}");
}

/// Both walls of a channel slide faster by the same: the fluid passes a droplet on the same side.
#[test]
fn retrograde_flow_does_not_depend_on_the_frame() {
    let passing = |faster: f64| {
        let droplet = |x: f64, y: f64, activity: f64| DropletSetup { centre: [x, y], ..DropletSetup::active(activity) };
        let setup = Setup {
            region: Region::Channel { length: 8.0, width: 5.0, drive: Drive::ZeroGradient },
            method: integral(),
            flow: FlowSetup { wall_velocity: Some([faster - 0.5, faster + 0.5]), ..FlowSetup::default() },
            droplets: vec![droplet(-1.0, 0.4, -2.0), droplet(1.6, -0.4, -1.0)],
            ..Setup::default()
        };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let flows =
            droplets.into_iter().map(|droplet| gap_flow(scene.system_mut(), droplet).unwrap().retrograde().unwrap());
        flows.collect::<Vec<_>>()
    };
    let [still, moving, back] = [0.0, 0.8, -0.8].map(passing);
    println!("{still:?}");
    for (k, flow) in still.iter().enumerate() {
        assert!(flow.abs() > 0.05, "{still:?}");
        for other in [moving[k], back[k]] {
            assert!((flow - other).abs() < 1e-8, "{k}: {flow} {other}");
        }
    }
}

/// Waves and particles of an interface turn together in a frame in which they move along.
#[test]
fn modes_of_heights_and_concentrations_have_one_origin() {
    let phases = |faster: f64| {
        let particles =
            Particles { activity: -1.0, start: Start::Perturbed { amplitude: 0.1, seed: 1 }, ..Particles::default() };
        let wavy = |height: f64, inside: Side| InterfaceSetup {
            height,
            inside,
            shape: InterfaceShape::Waves { cosines: vec![0.1], sines: vec![0.0, 0.05] },
            particles: Some(particles),
            ..InterfaceSetup::default()
        };
        let setup = Setup {
            region: Region::Channel { length: 6.0, width: 5.0, drive: Drive::ZeroGradient },
            method: integral(),
            flow: FlowSetup { wall_velocity: Some([faster - 0.5, faster + 0.5]), ..FlowSetup::default() },
            droplets: Vec::new(),
            interfaces: vec![wavy(-1.2, Side::Below), wavy(1.2, Side::Above)],
            ..Setup::default()
        };
        let Built { mut scene, interfaces, .. } = setup.build().unwrap();
        scene.run(0.5).go().unwrap();
        let angles = interfaces.into_iter().map(|interface| {
            let seen = scene.observe(interface).unwrap();
            let angle = |modes: &FourierModes| modes.sines[0].atan2(modes.cosines[0]);
            [angle(&seen.height_modes), angle(&seen.concentration_modes)]
        });
        angles.collect::<Vec<_>>()
    };
    let (still, moving) = (phases(0.0), phases(0.8));
    let turned = std::f64::consts::TAU * 0.8 * 0.5 / 6.0;
    for (still, moving) in still.iter().zip(&moving) {
        println!("{still:?} {moving:?} {turned}");
        for k in 0..2 {
            let off = (moving[k] - still[k] - turned).rem_euclid(std::f64::consts::TAU);
            assert!(off.min(std::f64::consts::TAU - off) < 1e-3, "{k}: {still:?} {moving:?} {turned}");
        }
    }
}
