//! Droplets of revolution in runs.

use std::f64::consts::PI;

use motile::active_interface::{
    ActiveDroplet, ContractileTension, ExcludedVolume,
    theory::{RoundDroplet, Sphere},
};
use motile::base::{FlowSample, TubeShape, Vec2};
use motile::prelude::*;
use motile::scene::{Scene, StepSize, checkpoint::Checkpoint, gap::Repulsion};
use motile::setup::{DropletShape, RigidBodySetup, Squeezed};

fn scene(region: Region, [nodes, elements]: [usize; 2]) -> Setup {
    let mut setup = Setup {
        region,
        method: Method::Integral(IntegralMethod { nodes, elements }),
        droplets: vec![DropletSetup::active(-1.0)],
        ..Setup::default()
    };
    if let Some(particles) = &mut setup.droplets[0].particles {
        particles.excluded_volume = ExcludedVolume::Step(2.0);
    }
    setup
}

/// Runs from a polarised sphere end at the steady swimmer (`axisymmetric.csv`) to 1e-4 at 128 nodes. Errors of the
/// speed fall with the second power of the cells, and faster than the third of the nodes; those of aspect ratio and
/// largest concentration by more than the third where both are refined. Particles and volume stay over a long run,
/// also where the nodes are too few for the edge of the concentration.
#[test]
fn a_droplet_in_space_swims_to_the_steady_state_of_the_reference() {
    let errors = |nodes: usize, elements: usize| {
        let Built { mut scene, droplets, .. } = scene(Region::Space, [nodes, elements]).build().unwrap();
        let before = scene.observe(droplets[0]).unwrap();
        // The slowest disturbance decays at the rate of .226: at 30 it is still 1e-4 of the speed.
        scene.run(60.0).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        assert!(
            (before.particle_number / (400.0 * PI) - 1.0).abs() < 1e-12,
            "{:e}",
            before.particle_number / (400.0 * PI) - 1.0
        );
        assert!((seen.particle_number / before.particle_number - 1.0).abs() < 1e-12);
        assert!((before.area / (4.0 / 3.0 * PI) - 1.0).abs() < 1e-12, "volume {}", before.area);
        assert!((seen.area / before.area - 1.0).abs() < 1e-12, "volume {} of {}", seen.area, before.area);
        assert!(seen.moments.stresslet()[0][0] > 0.0 && seen.squirmer.beta().unwrap() < 0.0, "a pusher");
        let values = [seen.speed(), seen.aspect_ratio_moments, seen.concentration_range.unwrap()[0] / 100.0];
        let exact = [0.126_082_125_506, 0.957_859_972_447, 2.753_941_530_35];
        [0, 1, 2].map(|i| values[i] / exact[i] - 1.0_f64)
    };
    let order = |coarse: f64, fine: f64| (coarse / fine).abs().log2();
    let [few_nodes, few_cells, nodes, both] = [[32, 512], [64, 256], [64, 512], [128, 512]].map(|[n, m]| errors(n, m));
    assert!(both.iter().all(|error| error.abs() < 1e-4), "{both:?}");
    let cells = order(few_cells[0], nodes[0]);
    assert!((cells - 2.0).abs() < 0.1, "speed: order {cells} in the cells");
    let nodes = order(few_nodes[0] - both[0], nodes[0] - both[0]);
    assert!(nodes > 3.0, "speed: order {nodes} in the nodes");
    for (i, what) in [(1, "aspect ratio"), (2, "largest concentration")] {
        let order = order(few_cells[i], both[i]);
        assert!(order > 3.0, "{what}: order {order}");
    }
}

/// Strong activity makes the tension at the front a thirtieth of that at the rear: forces whose truncation leaves
/// something at a pole, or waves that pass for others, grow into needles there. Runs end at the steady swimmer.
#[test]
fn strong_swimmers_stay_smooth_at_their_poles() {
    let mut setup = scene(Region::Space, [64, 256]);
    setup.droplets[0] = DropletSetup::contractile(-4.0, 8.0);
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(20.0).go().unwrap();
    let seen = scene.observe(droplets[0]).unwrap();
    // axisymmetric.csv; the speed by Newton's method with 160 nodes is .327943.
    assert!((seen.speed() / 0.327_942_031 - 1.0).abs() < 1e-3, "{}", seen.speed());
    let largest = seen.concentration_range.unwrap()[0] / 340.970_743_5;
    assert!((largest - 1.0).abs() < 5e-3, "{largest}");
    assert!((seen.aspect_ratio_moments / 0.908_990_901 - 1.0).abs() < 5e-3, "{}", seen.aspect_ratio_moments);
}

/// Speed at a time of the start changes with the second order of the time step.
#[test]
fn runs_have_an_order_in_the_time_step() {
    let [coarse, middle, fine] = [20.0, 40.0, 80.0].map(|steps| {
        let Built { mut scene, droplets, .. } = scene(Region::Space, [48, 192]).build().unwrap();
        scene.run(2.0).step_size(StepSize::Fixed(2.0 / steps)).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        [seen.speed(), seen.aspect_ratio_moments, seen.concentration_range.unwrap()[0]]
    });
    for i in 0..3 {
        let order = ((coarse[i] - middle[i]) / (middle[i] - fine[i])).abs().log2();
        assert!((1.6..2.6).contains(&order), "order {order}");
    }
}

/// The polynomial of Legendre of a degree.
fn legendre(degree: u32, x: f64) -> f64 {
    let (mut before, mut value) = (1.0, x);
    for l in 2..=degree {
        let l = f64::from(l);
        (before, value) = (value, ((2.0 * l - 1.0) * x * value - (l - 1.0) * before) / l);
    }
    value
}

/// Concentrations with a small part of a spherical harmonic change as the matrix of linear theory has it: within .1 per
/// cent, with the second order in the time step.
#[test]
fn harmonics_of_the_concentration_grow_at_their_rates() {
    for (inside, outside, activity, time) in
        [(100.0, 100.0, -1.0, 0.4), (100.0, 10.0, -1.0, 0.4), (1.0, 10.0, -2.0, 0.01), (1000.0, 10.0, -2.0, 0.4)]
    {
        for degree in 1..=4 {
            let setup = Setup { viscosity: outside, ..scene(Region::Space, [32, 512]) };
            let theory = Sphere::new(RoundDroplet {
                radius: 1.0,
                viscosity_inside: inside,
                viscosity_outside: outside,
                tension: 10.0 - activity * 100.0,
                activity,
                concentration: 100.0,
                diffusivity: 0.1,
            })
            .unwrap();
            let grown = |steps: f64| {
                let mut parts = [0.0; 2];
                for sign in [1.0, -1.0] {
                    let count = 512;
                    let angle = |k: f64| std::f64::consts::TAU * k / f64::from(count);
                    let markers: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(angle(f64::from(k)))).collect();
                    let wave = |k: i32| legendre(degree, angle(f64::from(k) + 0.5).cos());
                    let length = 2.0 * (0.5 * angle(1.0)).sin();
                    let numbers = (0..count).map(|k| 100.0 * (1.0 + sign * 1e-4 * wave(k)) * length).collect();
                    let law = ContractileTension::new(10.0, activity, ExcludedVolume::None, 1.0).unwrap();
                    let droplet = ActiveDroplet::new(&markers, numbers, law, 0.1).unwrap();
                    let droplet = droplet.axisymmetric().unwrap().with_viscosity_inside(inside).unwrap();
                    let mut scene = Scene::new(setup.flow().unwrap());
                    let droplet = scene.add(droplet);
                    // Over the sphere, not over the surface that changes.
                    let sizes = scene.body(droplet).unwrap().element_sizes().to_vec();
                    let amplitude = |droplet: &ActiveDroplet| -> f64 {
                        let parts = sizes.iter().zip(droplet.concentrations());
                        parts.zip(0..).map(|((size, c), k)| size * c * wave(k)).sum()
                    };
                    parts[0] += sign * amplitude(scene.body(droplet).unwrap());
                    scene.run(time).step_size(StepSize::Fixed(time / steps)).go().unwrap();
                    parts[1] += sign * amplitude(scene.body(droplet).unwrap());
                }
                parts[1] / parts[0]
            };
            // exp(M t) (0, 1) by its series.
            let [[aa, ab], [ba, bb]] = theory.growth_matrix(degree).unwrap();
            let (mut term, mut exact) = ([0.0, 1.0], 1.0);
            for n in 1..30 {
                let factor = time / f64::from(n);
                term = [factor * (aa * term[0] + ab * term[1]), factor * (ba * term[0] + bb * term[1])];
                exact += term[1];
            }
            let [coarse, middle, fine] = [4.0, 8.0, 16.0].map(grown);
            let error = (fine.ln() - exact.ln()).abs() / time;
            let fastest = aa.abs().max(bb.abs());
            assert!(error < 1e-3 * fastest, "{inside}/{outside} degree {degree}: {error:e} of {fastest}");
            let order = ((coarse - middle) / (middle - fine)).abs().log2();
            assert!((1.6..2.6).contains(&order), "{inside}/{outside} degree {degree}: order {order}");
        }
    }
}

/// Two droplets on an axis, one behind the other: mirror images of one another swim apart and the other way at one
/// speed, with particles and volumes kept.
#[test]
fn two_droplets_on_an_axis_are_mirror_images() {
    let mut setup = scene(Region::tube(2.0), [32, 128]);
    setup.droplets[0].centre = [1.4, 0.0];
    let mut other = setup.droplets[0].clone();
    (other.centre, other.angle, other.name) = ([-1.4, 0.0], PI, "other".to_owned());
    setup.droplets.push(other);
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(1.0).go().unwrap();
    let [first, second] = [0, 1].map(|k| scene.observe(droplets[k]).unwrap());
    assert!((first.centroid.x + second.centroid.x).abs() < 1e-9 && first.centroid.x > 1.4, "{}", first.centroid.x);
    assert!((first.speed() - second.speed()).abs() < 1e-9);
    let gap = scene.system().gap(droplets[0], droplets[1]).unwrap().unwrap();
    assert!((0.8..1.5).contains(&gap) && scene.system_mut().wall_gap().unwrap() < 1.0 + 1e-3, "{gap}");
}

/// Two droplets one behind the other in space and in a tube: the gap between them closes, and a repulsion, whose forces
/// are equal and opposite, keeps it open.
#[test]
fn trains_keep_apart_by_repulsion() {
    for region in [Region::Space, Region::tube(1.6)] {
        let gaps = [None, Some(Repulsion::new(400.0, 0.3).unwrap())].map(|repulsion| {
            let mut setup = Setup { repulsion, ..scene(region, [48, 96]) };
            setup.droplets[0].centre = [-1.1, 0.0];
            let mut other = DropletSetup { centre: [1.1, 0.0], name: "first".to_owned(), ..setup.droplets[0].clone() };
            other.particles = None;
            setup.droplets.push(other);
            let Built { mut scene, droplets, .. } = setup.build().unwrap();
            let number = scene.observe(droplets[0]).unwrap().particle_number;
            scene.run(3.0).go().unwrap();
            let seen = [0, 1].map(|k| scene.observe(droplets[k]).unwrap());
            let force: f64 = seen.iter().map(|seen| seen.moments.force[0]).sum();
            let part = force / (1.0 + seen[1].moments.force[0].abs());
            assert!(part.abs() < if repulsion.is_some() { 2e-3 } else { 1e-12 }, "{force:e}: {part:e}");
            for seen in &seen {
                assert!((seen.area / (4.0 / 3.0 * PI) - 1.0).abs() < 1e-12);
            }
            assert!((seen[0].particle_number / number - 1.0).abs() < 1e-12);
            scene.system().gap(droplets[0], droplets[1]).unwrap().unwrap()
        });
        assert!(gaps[0] < 0.19 && gaps[1] > 1.1 * gaps[0], "{gaps:?}");
    }
}

/// Two spheres of radius R whose gap is d push one another with the force `pi R phi(d)`, phi the energy per area, for
/// ranges that are short beside R (Derjaguin 1934): the error falls with the range.
#[test]
fn spheres_push_as_the_energy_between_planes_tells() {
    let errors = [0.16, 0.08].map(|range| {
        let (strength, gap) = (400.0, 0.5 * range);
        let repulsion = Some(Repulsion::new(strength, range).unwrap());
        let at = |x: f64| DropletSetup { centre: [x, 0.0], ..DropletSetup::passive(0.0) };
        let droplets = vec![at(-1.0 - 0.5 * gap), at(1.0 + 0.5 * gap)];
        let setup = Setup { repulsion, droplets, ..scene(Region::Space, [128, 256]) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let force = scene.observe(droplets[0]).unwrap().moments.force[0].abs();
        let energy = strength * range * range * (2.0 + 2.0 * 0.5_f64.ln() - 0.5);
        force / (PI * energy) - 1.0
    });
    println!("{errors:?}");
    assert!(errors[0].abs() < 0.06 && errors[1].abs() < 0.6 * errors[0].abs(), "{errors:?}");
}

/// The shortest waves of a meridian relax at the rate that its nodes and its perimeter tell.
#[test]
fn the_stiffness_is_that_of_the_shortest_waves() {
    for radius in [1.0, 2.0] {
        let mut setup = scene(Region::Space, [32, 64]);
        setup.droplets[0] = DropletSetup::passive(1.0).with_radius(radius);
        let mut scene = setup.build().unwrap().scene;
        scene.system_mut().evaluate().unwrap();
        let count = scene.system().markers().positions().len() as f64;
        let perimeter = 2.0 * count * radius * (PI / count).sin();
        let found = scene.system().hydrodynamics().fluid_view().interface_stiffness;
        assert!((found / (0.25 * 16.0 * 2.0 * PI / perimeter) - 1.0).abs() < 1e-12, "{radius}: {found}");
    }
}

/// A run in a tube that is made anew as the droplet widens goes on from a checkpoint bit for bit.
#[test]
fn runs_in_tubes_resume_bit_for_bit() {
    let make = || scene(Region::tube(1.2), [32, 64]).build().unwrap().scene;
    let mut whole = make();
    whole.run(4.0).go().unwrap();
    let mut first = make();
    first.run(2.5).go().unwrap();
    let saved = first.checkpoint("").to_bytes().unwrap();
    let mut rest = make();
    rest.resume(&Checkpoint::from_bytes(&saved).unwrap()).unwrap();
    first.run(4.0).go().unwrap();
    rest.run(4.0).go().unwrap();
    assert!(rest.checkpoint("") == first.checkpoint(""));
    assert!(rest.time().to_bits() == whole.time().to_bits());
}

/// A tube slows a droplet down, the more the tighter it is.
/// Spheres without room in a tube start as spheroids with a film of a twentieth of the radius; these and cylinders with
/// round ends have the volume and the particles of the sphere.
#[test]
fn droplets_in_tight_tubes_start_squeezed() {
    let mut setup = scene(Region::tube(0.9), [64, 256]);
    setup.droplets[0].squeezed = true;
    let shape = |to| DropletShape::Squeezed { radius: 1.0, half_height: 0.85, to };
    for (shape, limit) in [
        (DropletShape::Round { radius: 1.0 }, 1e-9),
        (shape(Squeezed::Ellipse), 1e-9),
        (shape(Squeezed::Stadium), 1e-3),
    ] {
        setup.droplets[0].shape = shape;
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        assert!((seen.area / (4.0 / 3.0 * PI) - 1.0).abs() < limit, "volume {}", seen.area);
        assert!((seen.particle_number / (400.0 * PI) - 1.0).abs() < limit, "particles {}", seen.particle_number);
        assert!((scene.system_mut().wall_gap().unwrap() - 0.05).abs() < 3e-5);
    }
}

#[test]
fn droplets_in_tubes_are_slower() {
    let speeds = [None, Some(2.0), Some(1.4)].map(|radius| {
        let region = radius.map_or(Region::Space, Region::tube);
        let Built { mut scene, droplets, .. } = scene(region, [32, 128]).build().unwrap();
        scene.run(2.0).go().unwrap();
        scene.observe(droplets[0]).unwrap().speed()
    });
    assert!(speeds[1] < 0.9 * speeds[0] && speeds[2] < 0.9 * speeds[1] && speeds[2] > 0.0, "{speeds:?}");
}

#[test]
fn what_has_no_meaning_in_three_dimensions_is_refused() {
    let setup = scene(Region::Space, [48, 192]);
    let refused = |change: &dyn Fn(&mut Setup), words: &str| {
        let mut setup = setup.clone();
        change(&mut setup);
        let error = setup.check().unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(&|setup| setup.droplets[0].centre = [0.0, 0.3], "on the x axis");
    refused(&|setup| setup.droplets[0].angle = 1.0, "along the x axis");
    refused(&|setup| setup.method = Method::Grid(GridMethod::default()), "the grid is two-dimensional");
    refused(&|setup| setup.rigid_bodies.push(RigidBodySetup::disc(0.3)), "two dimensions");
    refused(&|setup| setup.region = Region::tube(-1.0), "region.tube.radius");
    let tube = |shape, drive, length| Region::Tube { radius: 1.5, shape, drive, length };
    let throat = |throat| TubeShape::Constriction { throat, throat_length: 2.0, ramp: 2.0 };
    let shaped = |shape| tube(shape, Drive::ZeroFlux, None);
    refused(&|setup| setup.region = shaped(throat(-1.0)), "the radius of the throat");
    refused(&|setup| setup.region = tube(throat(0.9), Drive::ZeroGradient, None), "Use zero-flux or a flux");
    refused(&|setup| setup.region = tube(throat(0.9), Drive::ZeroFlux, Some(7.0)), "throat and ramps");
    refused(&|setup| setup.region = shaped(TubeShape::Sinusoidal { amplitude: 1.5, period: 4.0 }), "amplitude");
    refused(&|setup| setup.region = tube(TubeShape::Straight, Drive::Flux(f64::NAN), None), "flux");
    assert!(scene(shaped(throat(0.8)), [48, 192]).build().is_err(), "a droplet in the throat");
    // Droplets of neighbouring lengths a radius of 1.5 apart.
    let lengths = |drive, length| scene(tube(TubeShape::Straight, drive, Some(length)), [48, 192]).build();
    for length in [1.0, 2.0, 2.2, 3.4] {
        let error = lengths(Drive::ZeroGradient, length).unwrap_err().to_string();
        assert!(error.contains("region.tube.length") && error.contains("at least 3.5"), "{error}");
        assert!(lengths(Drive::Gradient(1.0), length).is_err() && lengths(Drive::ZeroFlux, length).is_ok());
    }
    assert!(lengths(Drive::ZeroGradient, 3.51).is_ok());
}

/// Perturbed starts keep to the axis, have the particles of the uniform state, and lead to the steady swimmer.
#[test]
fn a_perturbed_start_runs_and_swims() {
    for (seed, angle) in [(1, 0.0), (2, 0.0), (3, PI)] {
        let mut setup = scene(Region::Space, [32, 128]);
        setup.droplets[0].angle = angle;
        let particles = setup.droplets[0].particles.as_mut().unwrap();
        particles.start = motile::setup::Start::Perturbed { amplitude: 0.1, seed };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        let [most, least] = seen.concentration_range.unwrap();
        println!("{seed}: {:e} {most} {least}", seen.particle_number / (400.0 * PI) - 1.0);
        assert!((seen.particle_number / (400.0 * PI) - 1.0).abs() < 1e-12 && most > 101.0 && least < 99.0);
        scene.run(60.0).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        println!("{}", seen.speed());
        assert!((seen.speed() / 0.126_082 - 1.0).abs() < 5e-3 && seen.velocity.y.abs() < 1e-12, "{}", seen.speed());
    }
}

/// The stresslet of a droplet with another one inside is the stresslet of both: the far flow on the axis is
/// `3 S_xx/(8 pi eta r^2)`.
#[test]
fn the_stresslet_counts_droplets_inside() {
    for [place, ratio] in [[0.25, 100.0], [-0.2, 0.1]] {
        let mut setup = scene(Region::Space, [64, 256]);
        let inner = DropletSetup {
            centre: [place, 0.0],
            shape: DropletShape::Round { radius: 0.5 },
            viscosity: Some(100.0 * ratio),
            particles: None,
            ..DropletSetup::default()
        };
        setup.droplets.push(inner);
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(0.2).go().unwrap();
        let [outer, inner] = [0, 1].map(|k: usize| scene.observe(droplets[k]).unwrap());
        let (r, mut flow) = (300.0, [FlowSample::default(); 2]);
        let places = [r, -r].map(|x| outer.centroid + Vec2::new(x, 0.0));
        scene.system_mut().sample(&places, &mut flow).unwrap();
        let far = 0.5 * (flow[0].velocity.x - flow[1].velocity.x) * 8.0 * PI * 100.0 * r * r / 3.0;
        let [whole, part] = [&outer, &inner].map(|seen| seen.moments.stresslet()[0][0]);
        println!("ratio {ratio}: far {far}, both {whole}, inner one {part}");
        assert!((whole / far - 1.0).abs() < 1e-4, "ratio {ratio}: {whole}, far {far}");
        assert!(part.abs() > 0.1 * far.abs(), "the inner one matters: {part}");
        assert!(outer.moments.force[0].abs() < 1e-6 * far.abs(), "{:?}", outer.moments.force);
    }
}
