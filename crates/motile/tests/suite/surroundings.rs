//! Droplets in three dimensions without symmetry in tubes, slits and periodic boxes.

use motile::base::{Drive, Region, TubeShape};
use motile::prelude::*;
use motile::scene::integrator::IntegratorKind;
use motile::setup::DropletShape;
use motile::space_droplets::{Observation, PeriodicBox, Slit, SpaceDroplets};

fn swimmer() -> DropletSetup {
    DropletSetup::contractile(-1.0, 2.0)
}

fn at(position: [f64; 3], heading: [f64; 3]) -> DropletSetup {
    DropletSetup { position: Some(position), heading: Some(heading), ..swimmer() }
}

fn scene(region: Region, degree: usize, droplets: Vec<DropletSetup>) -> Setup {
    let method = Method::Harmonics(HarmonicsMethod { degree });
    let step = StepSize::Adaptive { tolerance: 1e-5 };
    Setup { region, method, droplets, step, integrator: IntegratorKind::RungeKuttaChebyshev, ..Setup::default() }
}

/// Returns the droplets at a time.
fn seen(setup: &Setup, time: f64) -> Vec<Observation> {
    let Built { mut scene, space: Some(body), .. } = setup.build().expect("a scene") else {
        panic!("no droplets in space")
    };
    if time > 0.0 {
        scene.run(time).go().expect("a run");
    }
    scene.observe(body).expect("observables")
}

/// Returns the speed along x of the axisymmetric code at a time.
fn axisymmetric(region: Region, time: f64) -> f64 {
    let method = Method::Integral(IntegralMethod { nodes: 128, elements: 1024 });
    let step = StepSize::Adaptive { tolerance: 1e-5 };
    let setup = Setup { region, method, droplets: vec![swimmer()], step, ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build().expect("a scene");
    if time > 0.0 {
        scene.run(time).go().expect("a run");
    }
    scene.observe(droplets[0]).expect("observables").velocity.x
}

fn tube(drive: Drive, length: Option<f64>) -> Region {
    Region::Tube { radius: 1.6, shape: TubeShape::Straight, drive, length }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> f64 {
    (0..3).map(|i| (a[i] - b[i]).powi(2)).sum::<f64>().sqrt()
}

/// At the start, a swimmer on the axis of a tube is as fast as by the axisymmetric code, which is another method. The
/// error falls with the degree, with and without a drive.
#[test]
fn swimmers_on_the_axis_of_a_tube_start_as_in_the_axisymmetric_code() {
    for drive in [Drive::ZeroFlux, Drive::ZeroGradient, Drive::Flux(0.4), Drive::Gradient(-5.0)] {
        let exact = axisymmetric(tube(drive, None), 0.0);
        let errors = [8, 16].map(|degree| {
            let seen = seen(&scene(tube(drive, None), degree, vec![swimmer()]), 0.0).remove(0);
            assert!(seen.velocity[1].abs().max(seen.velocity[2].abs()) < 1e-9, "{:?}", seen.velocity);
            (seen.velocity[0] / exact - 1.0).abs()
        });
        println!("{drive:?}: {exact} {errors:?}");
        assert!(errors[1] < 1e-4 && errors[1] < 0.5 * errors[0].max(1e-5), "{drive:?}: {errors:?}");
    }
}

/// A later time, at which the shape and the particles have changed.
#[test]
fn swimmers_on_the_axis_of_a_tube_run_as_in_the_axisymmetric_code() {
    let (region, time) = (tube(Drive::Flux(0.2), None), 2.0);
    let exact = axisymmetric(region, time);
    let seen = seen(&scene(region, 12, vec![swimmer()]), time).remove(0);
    println!("{exact} {} {:e}", seen.velocity[0], seen.velocity[0] / exact - 1.0);
    assert!((seen.velocity[0] / exact - 1.0).abs() < 1e-3, "{} {exact}", seen.velocity[0]);
}

/// A pressure gradient acts over a tube without end: the axisymmetric code in longer and longer tubes comes to the same
/// speed, with a difference that falls as the inverse of the length.
#[test]
fn a_gradient_is_the_limit_of_long_tubes() {
    let speed = seen(&scene(tube(Drive::ZeroGradient, None), 16, vec![swimmer()]), 0.0)[0].velocity[0];
    let differences = [20.0, 80.0].map(|length| axisymmetric(tube(Drive::ZeroGradient, Some(length)), 0.0) - speed);
    println!("{speed} {differences:?}");
    assert!((differences[0] / differences[1] - 4.0).abs() < 0.2, "{differences:?}");
}

/// Turned about the axis of the tube and mirrored, a droplet off the axis moves the same way.
#[test]
fn a_tube_has_no_preferred_side() {
    let velocity = |position: [f64; 3], heading: [f64; 3]| {
        seen(&scene(tube(Drive::Flux(0.3), None), 10, vec![at(position, heading)]), 0.4)[0].velocity
    };
    let [x, y, z] = velocity([0.5, 0.3, 0.0], [1.0, 0.4, 0.2]);
    assert!(y.abs() > 1e-3 && z.abs() > 1e-3, "{y} {z}");
    let mirrored = velocity([0.5, -0.3, 0.0], [1.0, -0.4, 0.2]);
    let turned = velocity([0.5, 0.0, 0.3], [1.0, -0.2, 0.4]);
    println!("{:e} {:e}", difference(mirrored, [x, -y, z]) / x, difference(turned, [x, -z, y]) / x);
    assert!(difference(mirrored, [x, -y, z]) < 1e-6 * x, "{mirrored:?} {:?}", [x, y, z]);
    // The grid of parameters is turned as well, to which shapes are truncated.
    assert!(difference(turned, [x, -z, y]) < 1e-3 * x, "{turned:?} {:?}", [x, y, z]);
}

/// A scene in a slit or box is what you would build from the crate by hand.
#[test]
fn scenes_are_those_of_the_crate() {
    let region = Region::Slit { lower: -1.5, upper: 2.5 };
    let setup = scene(region, 8, vec![at([0.1, 0.2, 0.3], [1.0, 0.0, 0.5]), at([3.0, 0.0, 0.8], [0.0, 1.0, -0.3])]);
    let by_hand = || {
        let droplets = setup.droplets.iter().map(|droplet| setup.space_droplet(droplet).unwrap());
        SpaceDroplets::new(droplets.collect()).unwrap()
    };
    let compare = |setup: &Setup, mut all: SpaceDroplets| {
        for (k, seen) in seen(setup, 0.0).into_iter().enumerate() {
            assert!(difference(seen.velocity, all.observe(k).unwrap().velocity) < 1e-12 * seen.speed);
        }
    };
    let speed = by_hand().observe(0).unwrap().speed;
    let mut slit = by_hand().with_surroundings(Slit::new(-1.5, 2.5).unwrap()).unwrap();
    assert!((slit.observe(0).unwrap().speed / speed - 1.0).abs() > 1e-2);
    compare(&setup, slit);
    let lengths = [7.0, 5.0, 4.0];
    let region = Region::SpaceBox { lengths };
    compare(
        &Setup { region, ..setup.clone() },
        by_hand().with_surroundings(PeriodicBox::new(lengths).unwrap()).unwrap(),
    );
}

/// Three droplets in a box, and six in one of twice the length: the same flow, by another sum.
#[test]
fn a_box_of_copies_has_the_same_flow() {
    let droplets = vec![
        DropletSetup { viscosity: Some(300.0), ..at([0.2, 0.1, 0.0], [1.0, 0.2, 0.0]) },
        at([2.5, 0.3, 0.2], [0.0, 1.0, 0.3]),
        at([1.2, 2.4, -0.3], [0.0, -0.5, 1.0]),
    ];
    let [x, y, z] = [5.0, 5.0, 4.5];
    let copies = droplets.iter().map(|droplet| {
        let place = droplet.place();
        DropletSetup { position: Some([place[0] + x, place[1], place[2]]), ..droplet.clone() }
    });
    let twice = droplets.iter().cloned().chain(copies).collect();
    let one = seen(&scene(Region::SpaceBox { lengths: [x, y, z] }, 4, droplets.clone()), 0.0);
    let two = seen(&scene(Region::SpaceBox { lengths: [2.0 * x, y, z] }, 4, twice), 0.0);
    for (k, seen) in two.iter().enumerate() {
        let error = difference(seen.velocity, one[k % 3].velocity) / seen.speed;
        assert!(error < 1e-8, "{k}: {error:e}");
    }
    // A run keeps particles and volumes, also for droplets that leave through a side.
    let later = seen(&scene(Region::SpaceBox { lengths: [x, y, z] }, 4, droplets), 0.5);
    for (before, after) in one.iter().zip(later) {
        assert!(
            (after.volume / before.volume - 1.0).abs() < 1e-9
                && (after.particles / before.particles - 1.0).abs() < 1e-9
        );
    }
}

/// Surroundings that cannot exist are refused with their key, before any work.
#[test]
fn surroundings_that_cannot_be_are_refused() {
    let refused = |region: Region, change: &dyn Fn(&mut Setup), start: &str, remedy: &str| {
        let mut setup = scene(region, 4, vec![at([0.0; 3], [1.0, 0.0, 0.3])]);
        change(&mut setup);
        let error = setup.check().unwrap_err().to_string();
        assert!(error.starts_with(start) && error.contains(remedy), "{start}: {error}");
    };
    let nothing = |_: &mut Setup| {};
    let slit = |lower, upper| Region::Slit { lower, upper };
    let cube = |x, y, z| Region::SpaceBox { lengths: [x, y, z] };
    refused(slit(f64::NAN, 2.0), &nothing, "region.slit.lower = NaN: ", "use a finite number");
    refused(slit(-2.0, f64::INFINITY), &nothing, "region.slit.upper = inf: ", "use a finite number");
    refused(slit(2.0, -2.0), &nothing, "region.slit.upper = -2: ", "Use a number above 2");
    refused(slit(-0.5, 3.0), &nothing, "droplets[0].position = ", "beyond the walls at -0.5 and 3. Move it");
    refused(cube(6.0, -6.0, 6.0), &nothing, "region.box.lengths[1] = -6: ", "positive finite number");
    refused(cube(6.0, 6.0, f64::NAN), &nothing, "region.box.lengths[2] = NaN: ", "positive finite number");
    refused(cube(600.0, 6.0, 6.0), &nothing, "region.box.lengths[1] = 6: ", "Use a wider box");
    refused(cube(6.0, 1.9, 6.0), &nothing, "droplets[0].shape.round.radius = 1: ", "shortest side is 1.9");
    refused(Region::tube(-1.0), &nothing, "region.tube.radius = -1: ", "positive finite number");
    refused(Region::tube(0.9), &nothing, "droplets[0].position = ", "Use a wider tube");
    let aside = |setup: &mut Setup| setup.droplets[0].position = Some([0.0, 0.7, 0.0]);
    refused(Region::tube(1.6), &aside, "droplets[0].position = ", "reaches 1.7000 from the axis");
    let shape = TubeShape::Constriction { throat: 1.2, throat_length: 2.0, ramp: 2.0 };
    let narrow = Region::Tube { radius: 2.0, shape, drive: Drive::ZeroFlux, length: None };
    refused(narrow, &nothing, "region.tube.shape = given: ", "Remove the shape");
    refused(tube(Drive::Gradient(-1.0), Some(12.0)), &nothing, "region.tube.length = 12: ", "prescribe the flux");
    assert!(scene(tube(Drive::ZeroFlux, Some(12.0)), 4, vec![at([0.0; 3], [1.0, 0.1, 0.0])]).check().is_ok());
    let shear = |setup: &mut Setup| setup.flow.shear = 0.1;
    refused(slit(-2.0, 2.0), &shear, "flow.shear = 0.1: ", "pass through the walls");
    refused(cube(6.0, 6.0, 6.0), &shear, "flow.shear = 0.1: ", "does not repeat");
    refused(Region::tube(2.0), &shear, "flow.shear = 0.1: ", "region.tube.drive");
    let overlapping = |setup: &mut Setup| setup.droplets.push(at([5.0, 0.0, 0.0], [1.0, 0.0, 0.0]));
    refused(cube(6.0, 6.0, 6.0), &overlapping, "droplets[1].position = ", "overlaps or touches");
    let grid = |setup: &mut Setup| setup.method = Method::Grid(GridMethod::default());
    refused(slit(-2.0, 2.0), &grid, "method = grid: ", "method.harmonics");
    // Other shapes are found out when they are made.
    let wide = DropletSetup { shape: DropletShape::Ellipse { half_axes: [2.1, 0.8] }, ..at([0.0; 3], [0.0, 0.0, 1.0]) };
    let error = scene(slit(-2.0, 2.0), 4, vec![wide]).build().unwrap_err().to_string();
    assert!(error.contains("crosses the wall at z = ") && error.contains("Move it between the walls"), "{error}");
}

#[test]
fn regions_are_read_and_written() {
    for (text, region) in [
        ("region.slit = { lower = -2, upper = 1.5 }\n", Region::Slit { lower: -2.0, upper: 1.5 }),
        ("region.box.lengths = [6, 5.0, 4]\n", Region::SpaceBox { lengths: [6.0, 5.0, 4.0] }),
        ("region.box.lengths = [6, 5]\n", Region::Box { lengths: [6.0, 5.0] }),
    ] {
        let setup = Setup::from_toml(&format!("{text}[[droplets]]\n")).unwrap();
        assert_eq!(setup.region, region);
        assert_eq!(Setup::from_toml(&setup.to_toml().unwrap()).unwrap(), setup);
    }
    let error = Setup::from_toml("region.box.lengths = [6]\n").unwrap_err().to_string();
    assert!(error.contains("two lengths, [x, y], or three"), "{error}");
    let error = Setup::from_toml("region.slit = { lower = -2 }\n").unwrap_err().to_string();
    assert!(error.contains("upper"), "{error}");
}
