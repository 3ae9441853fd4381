use super::*;
use crate::prelude::*;

/// A swimmer in unbounded fluid in three dimensions.
fn swimmer() -> DropletSetup {
    DropletSetup::contractile(-1.0, 2.0)
}

fn scene(degree: usize, droplets: Vec<DropletSetup>) -> Setup {
    let method = Method::Harmonics(HarmonicsMethod { degree });
    Setup { region: Region::Space, method, droplets, ..Setup::default() }
}

fn heading(heading: [f64; 3]) -> DropletSetup {
    DropletSetup { heading: Some(heading), ..swimmer() }
}

#[test]
fn the_description_decides() {
    let usual = |droplet: DropletSetup| Setup { region: Region::Space, droplets: vec![droplet], ..Setup::default() };
    let symmetric = usual(DropletSetup { angle: PI, centre: [2.0, 0.0], ..swimmer() });
    assert!(!symmetric.lacks_symmetry() && symmetric.build().unwrap().space.is_none());
    let flow = FlowSetup { shear: 0.1, ..FlowSetup::default() };
    for setup in [
        usual(heading([1.0, 0.0, 0.0])),
        usual(DropletSetup { position: Some([1.0, 0.0, 0.0]), ..swimmer() }),
        usual(DropletSetup { angle: 0.5, ..swimmer() }),
        usual(DropletSetup { centre: [0.0, 0.5], ..swimmer() }),
        scene(4, vec![swimmer()]),
        Setup { flow, ..symmetric.clone() },
    ] {
        assert!(setup.lacks_symmetry() && setup.check().is_ok(), "{setup:?}");
    }
    // In the plane, such droplets are as ever.
    let planar = Setup { region: Region::Plane, ..usual(DropletSetup { angle: 0.5, ..swimmer() }) };
    assert!(!planar.lacks_symmetry());
}

#[test]
fn what_it_does_not_have_is_refused_with_its_key() {
    let refused = |change: &dyn Fn(&mut Setup), start: &str| {
        let mut setup = scene(6, vec![heading([0.0, 0.0, 1.0])]);
        change(&mut setup);
        let error = setup.build().unwrap_err().to_string();
        assert!(error.starts_with(start), "{start}: {error}");
        let remedy =
            ["Use", "Remove", "Add", "Move"].iter().any(|word| error.contains(word)) || error.contains(": use ");
        assert!(remedy, "{error}");
    };
    let droplet = |change: fn(&mut DropletSetup)| move |setup: &mut Setup| change(&mut setup.droplets[0]);
    refused(
        &|setup| setup.method = Method::Integral(IntegralMethod { nodes: 48, elements: 96 }),
        "method = integral: ",
    );
    refused(&|setup| setup.method = Method::Grid(GridMethod::default()), "method = grid: ");
    refused(&|setup| setup.method = Method::Harmonics(HarmonicsMethod { degree: 1 }), "method.harmonics.degree = 1: ");
    refused(&|setup| setup.rigid_bodies.push(super::super::RigidBodySetup::disc(0.3)), "rigid-bodies = 1: ");
    refused(&|setup| setup.droplets.clear(), "droplets = []: ");
    refused(&|setup| setup.tolerance = Some(1e-6), "tolerance = 0.000001: ");
    refused(&|setup| setup.friction = 1.0, "friction = 1: ");
    refused(&|setup| setup.mirror_symmetric = true, "mirror-symmetric = true: ");
    refused(&|setup| setup.least_gap = Some(0.1), "least-gap = 0.1: ");
    refused(&|setup| setup.flow.wall_velocity = Some([1.0, 2.0]), "flow.wall-velocity = given: ");
    refused(&|setup| setup.flow.shear = f64::NAN, "flow.shear = NaN: ");
    refused(&|setup| setup.step = StepSize::Fixed(-1.0), "step.fixed = -1: ");
    refused(&|setup| setup.integrator = motile_scene::integrator::IntegratorKind::RungeKutta, "integrator = ");
    refused(&droplet(|droplet| droplet.heading = Some([0.0; 3])), "droplets[0].heading = [0.0, 0.0, 0.0]: ");
    refused(&droplet(|droplet| droplet.angle = 0.1), "droplets[0].heading = [0.0, 0.0, 1.0]: ");
    refused(&droplet(|droplet| droplet.bending = 0.1), "droplets[0].bending = given: ");
    refused(&droplet(|droplet| droplet.cortex.viscosity = 1.0), "droplets[0].cortex = given: ");
    refused(&droplet(|droplet| droplet.body_force = [0.0, 1.0]), "droplets[0].body-force = given: ");
    refused(&droplet(|droplet| droplet.area_constraint = true), "droplets[0].area-constraint = true: ");
    refused(&droplet(|droplet| droplet.motion = Motion::WithFluid), "droplets[0].motion = given: ");
    refused(&droplet(|droplet| droplet.shape = DropletShape::Points(Vec::new())), "droplets[0].shape = given: ");
    refused(&droplet(|droplet| droplet.viscosity = Some(0.0)), "droplets[0].viscosity = 0: ");
    refused(
        &droplet(|droplet| droplet.particles = droplet.particles.map(|it| Particles { flux: Flux::Upwind, ..it })),
        "droplets[0].particles.flux = given: ",
    );
    refused(
        &droplet(|droplet| droplet.particles = droplet.particles.map(|it| Particles { activity: -3.0, ..it })),
        "droplets[0].particles.activity = -3: ",
    );
    refused(&|setup| setup.droplets.push(DropletSetup { centre: [0.0, 1.9], ..swimmer() }), "droplets[1].centre = ");
    // In other regions, the keys have no meaning.
    refused(&|setup| setup.region = Region::Plane, "method = harmonics: ");
    refused(
        &|setup| (setup.region, setup.method) = (Region::Plane, Method::default()),
        "droplets[0].heading = [0.0, 0.0, 1.0]: three numbers need a region",
    );
}

/// At the start, a turned swimmer is as fast as the axisymmetric one: 1e-5 at degree 24, by another method.
#[test]
fn the_start_agrees_with_the_axisymmetric_code() {
    let method = Method::Integral(IntegralMethod { nodes: 128, elements: 1024 });
    for viscosity in [None, Some(300.0)] {
        let droplet = DropletSetup { viscosity, ..swimmer() };
        let axisymmetric = Setup { region: Region::Space, method, droplets: vec![droplet.clone()], ..Setup::default() };
        let Built { mut scene, droplets, .. } = axisymmetric.build().unwrap();
        let exact = scene.observe(droplets[0]).unwrap().speed();
        let degree = if viscosity.is_some() { 16 } else { 24 };
        let turned = self::scene(degree, vec![DropletSetup { heading: Some([0.3, -0.5, 0.8]), ..droplet }]);
        let Built { mut scene, space: Some(body), .. } = turned.build().unwrap() else { panic!("no droplets") };
        let seen = scene.observe(body).unwrap().remove(0);
        let along: f64 = turned.droplets[0].direction().iter().zip(seen.heading).map(|(a, b)| a * b).sum();
        println!("{exact} {} {:e}", seen.speed, seen.speed / exact - 1.0);
        assert!((seen.speed / exact - 1.0).abs() < 1e-5 && (along - 1.0).abs() < 1e-9, "{} {exact}", seen.speed);
    }
}

/// Runs do not depend on the direction: speed, area and particles after a turn.
#[test]
fn runs_are_isotropic() {
    let end = |direction: [f64; 3]| {
        let Built { mut scene, space, .. } = scene(8, vec![heading(direction)]).build().unwrap();
        scene.run(1.0).step_size(StepSize::Adaptive { tolerance: 1e-5 }).go().unwrap();
        let seen = scene.observe(space.unwrap()).unwrap().remove(0);
        let along: f64 = heading(direction).direction().iter().zip(seen.heading).map(|(a, b)| a * b).sum();
        [seen.speed, seen.area, seen.particles, along, seen.concentrations[1]]
    };
    let [along, across, oblique] = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [1.0, -2.0, 0.5]].map(end);
    println!("{along:?}\n{across:?}\n{oblique:?}");
    for other in [across, oblique] {
        for (k, (one, other)) in along.iter().zip(&other).enumerate() {
            // The largest concentration is on the grid, whose points are elsewhere.
            let within = if k == 4 { 1e-2 } else { 3e-4 };
            assert!((other / one - 1.0).abs() < within, "{k}: {one} {other}");
        }
    }
}

/// Shapes are turned around the heading, and keep the mean of the particles.
#[test]
fn shapes_and_starts_turn_with_the_heading() {
    let observed = |droplet: DropletSetup| {
        let Built { mut scene, space, .. } = scene(12, vec![droplet]).build().unwrap();
        let body = space.unwrap();
        let seen = scene.observe(body).unwrap().remove(0);
        (seen, scene.body(body).unwrap().droplets().droplets()[0].at([0.0, 0.6, 0.8]).unwrap().0)
    };
    let shape = DropletShape::Ellipse { half_axes: [1.3, 0.9] };
    let (seen, tip) = observed(DropletSetup { shape, ..heading([0.0, 3.0, 4.0]) });
    assert!((seen.volume / (4.0 / 3.0 * PI * 1.3 * 0.81) - 1.0).abs() < 1e-12);
    assert!((seen.semi_axes[0] - 1.3).abs() < 1e-12 && (seen.semi_axes[2] - 0.9).abs() < 1e-12);
    assert!((tip[1] - 0.78).abs() < 1e-12 && (tip[2] - 1.04).abs() < 1e-12, "{tip:?}");
    assert!((seen.particles / (100.0 * seen.area) - 1.0).abs() < 1e-9);
    let shape = DropletShape::Modes { radius: 1.0, cosines: vec![0.0, 0.1], sines: Vec::new() };
    let (_, tip) = observed(DropletSetup { shape, ..heading([0.0, 3.0, 4.0]) });
    // The centroid of this shape is its centre.
    assert!((tip[1].hypot(tip[2]) - 1.1).abs() < 1e-6, "{tip:?}");
}

/// Noise is bounded, keeps the number of particles, and depends on the seed; it breaks the symmetry.
#[test]
fn noise_is_bounded_and_without_symmetry() {
    let of = |amplitude: f64, seed: u64| {
        let start = Start::Perturbed { amplitude, seed };
        let particles =
            Particles { start, activity: -1.0, excluded_volume: ExcludedVolume::Step(2.0), ..Particles::default() };
        let setup = scene(6, vec![DropletSetup { particles: Some(particles), ..heading([1.0, 1.0, 0.0]) }]);
        let Built { mut scene, space, .. } = setup.build().unwrap();
        scene.observe(space.unwrap()).unwrap().remove(0)
    };
    let [one, other, none] = [of(0.3, 1), of(0.3, 2), of(0.0, 1)];
    assert!((one.particles / (400.0 * PI) - 1.0).abs() < 1e-12 && one.concentrations[0] > 70.0);
    assert!(one.concentrations[1] > 103.0 && one.concentrations[1] < 130.0, "{:?}", one.concentrations);
    assert!(one.heading != other.heading && none.speed < 1e-12 && none.concentrations[1] < 100.0 + 1e-9);
    // Not along an axis of the description.
    assert!(one.heading.iter().all(|x| x.abs() > 1e-3), "{:?}", one.heading);
}

/// The smallest degrees and large ones start, and steps of a coarse droplet end with a warning, not a failure.
#[test]
fn coarse_and_fine_droplets_start() {
    for degree in [2, 4, 48] {
        let Built { mut scene, space, .. } = scene(degree, vec![heading([1.0, 1.0, 1.0])]).build().unwrap();
        let seen = scene.observe(space.unwrap()).unwrap().remove(0);
        // The closed form of a sphere, without the excluded volume, which is 2 % here.
        assert!((seen.speed / 0.13 - 1.0).abs() < 0.2, "{degree}: {}", seen.speed);
        if degree == 4 {
            scene.run(2.0).step_size(StepSize::Adaptive { tolerance: 1e-3 }).go().unwrap();
            let warnings = scene.system_mut().warnings();
            assert!(warnings.iter().any(|warning| warning.message.contains("Use a degree above 4")), "{warnings:?}");
        }
    }
}

#[cfg(feature = "toml")]
#[test]
fn three_numbers_are_read_and_written() {
    let text = "region = \"space\"\n[[droplets]]\nposition = [0.5, 0, -1]\nheading = [0.0, 1.0, 1.0]\n";
    let setup = Setup::from_toml(text).unwrap();
    assert_eq!((setup.droplets[0].place(), setup.droplets[0].heading), ([0.5, 0.0, -1.0], Some([0.0, 1.0, 1.0])));
    let written = setup.to_toml().unwrap();
    assert_eq!(Setup::from_toml(&written).unwrap(), setup, "{written}");
    assert!(!Setup::default().to_toml().unwrap().contains("position"));
    let error = Setup::from_toml(&text.replace("[0.0, 1.0, 1.0]", "[0.0, 1.0]")).unwrap_err().to_string();
    assert!(error.contains("heading"), "{error}");
}
