use std::f64::consts::TAU;

use crate::{
    ContractileTension, ExcludedVolume, PeriodicBox, Slit, SpaceDroplet, SpaceDroplets, SpaceError, Surroundings, Tube,
};

/// The flow of a sphere with a gradient of tension: a dipole outside, and `(2.5 - 1.5 r^2) U` along the axis inside.
#[test]
fn a_marangoni_sphere_has_its_flow_on_both_sides() {
    for ratio in [1.0, 5.0] {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let axis = [0.6, 0.0, 0.8];
        let along = |s: [f64; 3]| s[0] * axis[0] + s[2] * axis[2];
        let sphere = SpaceDroplet::sphere(12, 1.0, [ratio, 1.0], law).unwrap();
        let sphere = sphere.with_particles(0.1, |s| 1.0 + along(s)).unwrap().with_position([3.0, 1.0, 0.0]).unwrap();
        let mut all = SpaceDroplets::new(vec![sphere]).unwrap();
        all.evaluate().unwrap();
        let speed = -1.0 / (3.0 * (2.0 + 3.0 * ratio));
        let radii = [0.0, 0.3, 0.9, 0.999, 1.001, 1.1, 2.0, 6.0];
        let place = |r: f64| [3.0 + r * axis[0], 1.0, r * axis[2]];
        let found = all.velocities_at(&radii.map(place), 1e-10).unwrap();
        for (r, u) in radii.into_iter().zip(found) {
            let exact = if r < 1.0 { (2.5 - 1.5 * r * r) * speed } else { speed / r.powi(3) };
            assert!((along(u) - exact).abs() < 1e-9 && u[1].abs() < 1e-9, "ratio {ratio}, r {r}: {u:?} {exact}");
        }
        // Across the axis, the dipole flows backwards.
        let beside = all.velocities_at(&[[3.0, 3.0, 0.0]], 1e-10).unwrap()[0];
        assert!((along(beside) + 0.5 * speed / 8.0).abs() < 1e-9, "{beside:?}");
    }
}

/// Far from a droplet, there is the imposed flow alone.
#[test]
fn the_imposed_flow_is_part_of_it() {
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, 1.0).unwrap();
    let shear = [[0.0, 2.0, 0.0], [0.0; 3], [0.0; 3]];
    let droplet = SpaceDroplet::sphere(6, 1.0, [3.0, 1.0], law).unwrap().with_imposed_flow(shear).unwrap();
    let all = SpaceDroplets::new(vec![droplet]).unwrap();
    let [far, nothing] = [[1e4, 2e4, 0.0], [0.0; 3]];
    let found = all.velocities_at(&[far, nothing], 1e-3).unwrap();
    assert!((found[0][0] / 4e4 - 1.0).abs() < 1e-9 && found[1][0].abs() < 1e-9, "{found:?}");
    assert!(all.velocities_at(&[nothing], 1.0).is_err());
    assert!(
        all.velocities_at(&[[f64::NAN, 0.0, 0.0]], 1e-3).is_err() && all.velocities_at(&[], 1e-3).unwrap().is_empty()
    );
}

/// A droplet of a viscosity ratio that is not round, with a gradient of tension in general position.
fn droplet(degree: usize, ratio: f64, position: [f64; 3]) -> SpaceDroplet {
    let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
    let shape = |s: [f64; 3]| [1.1 * s[0], s[1], 0.95 * s[2]];
    let droplet = SpaceDroplet::shaped(degree, shape, [ratio, 1.0], law).unwrap();
    let droplet = droplet.with_particles(0.1, |s| 1.0 + 0.6 * s[0] + 0.5 * s[1] * s[2] - 0.4 * s[2]).unwrap();
    droplet.with_position(position).unwrap()
}

fn pair(degree: usize, around: impl Surroundings + 'static) -> SpaceDroplets {
    let droplets = vec![droplet(degree, 4.0, [0.0, 0.2, -0.1]), droplet(degree, 1.0, [2.8, -0.3, 0.2])];
    let mut pair = SpaceDroplets::new(droplets).unwrap().with_surroundings(around).unwrap();
    pair.evaluate().unwrap();
    pair
}

fn largest(velocities: &[[f64; 3]]) -> f64 {
    velocities.iter().flatten().fold(0.0, |most, u| most.max(u.abs()))
}

/// Returns the largest difference between the velocities of all surfaces and the flow there, at shifted places.
fn slip(all: &SpaceDroplets, shift: [f64; 3]) -> f64 {
    let places = (0..24).map(|k| (f64::from(k) * TAU / 24.0, (0.4 * f64::from(k)).sin()));
    let places: Vec<[f64; 3]> =
        places.map(|(phi, z)| [(1.0 - z * z).sqrt() * phi.cos(), (1.0 - z * z).sqrt() * phi.sin(), z]).collect();
    let mut most = 0.0_f64;
    for (droplet, source) in all.droplets().iter().zip(&all.sources) {
        let seen = places.iter().map(|s| droplet.at(*s).unwrap());
        let (points, velocities): (Vec<[f64; 3]>, Vec<[f64; 3]>) = seen
            .map(|(place, velocity, _)| (std::array::from_fn(|i| place[i] + source.position[i] + shift[i]), velocity))
            .unzip();
        let found = all.velocities_at(&points, 1e-8).unwrap();
        let differences = found.iter().flatten().zip(velocities.iter().flatten()).map(|(a, b)| (a - b).abs());
        most = differences.fold(most, f64::max);
    }
    most
}

/// Between walls, the fluid is at rest on the walls, and moves with the surfaces of the droplets. That error falls
/// exponentially with the degree.
#[test]
fn the_flow_between_walls_fits_droplets_and_walls() {
    let slit = || Slit::new(-2.1, 1.9).unwrap();
    let tube = || Tube::new(2.2).unwrap().along([1.0, 0.0, 0.0]).unwrap().with_mean_flow(0.02).unwrap();
    let across = |k: usize| (0.3 * k as f64 - 1.0, TAU * k as f64 / 17.0);
    let on_slit = |k: usize| [across(k).0, across(k).1.sin(), if k.is_multiple_of(2) { -2.1 } else { 1.9 }];
    let on_tube = |k: usize| [across(k).0, 2.2 * across(k).1.cos(), 2.2 * across(k).1.sin()];
    let errors = |degree: usize| {
        let (slit, tube) = (pair(degree, slit()), pair(degree, tube()));
        let middle = [[1.2, 0.0, 0.0]];
        let scale = [&slit, &tube].map(|all| largest(&all.velocities_at(&middle, 1e-8).unwrap()));
        assert!(scale.iter().all(|scale| *scale > 0.01), "{scale:?}");
        let walls = [
            largest(&slit.velocities_at(&(0..17).map(on_slit).collect::<Vec<_>>(), 1e-8).unwrap()),
            largest(&tube.velocities_at(&(0..17).map(on_tube).collect::<Vec<_>>(), 1e-8).unwrap()),
        ];
        let surfaces = [slip(&slit, [0.0; 3]), slip(&tube, [0.0; 3])];
        println!("{degree}: walls {walls:?}, surfaces {surfaces:?}, middle {scale:?}");
        [walls, surfaces]
    };
    let [coarse, fine] = [8, 14].map(errors);
    for k in 0..2 {
        // The walls reflect the sums over points to round-off.
        assert!(coarse[0][k].max(fine[0][k]) < 1e-10, "{coarse:?} {fine:?}");
        assert!(fine[1][k] < 1e-5 && fine[1][k] < 0.05 * coarse[1][k], "{coarse:?} {fine:?}");
    }
    // Beyond the walls, nothing flows.
    let beyond = [[0.0, 0.0, 1.9 + 1e-9], [0.0, 2.3, 0.0], [5.0, 0.0, -3.0]];
    assert_eq!(pair(4, slit()).velocities_at(&beyond[..1], 1e-3).unwrap(), [[0.0; 3]]);
    assert_eq!(pair(4, tube()).velocities_at(&beyond[1..], 1e-3).unwrap(), [[0.0; 3]; 2]);
}

/// In a box, the flow repeats, and images of the droplets move with it, to the error of the surfaces themselves.
#[test]
fn the_flow_in_a_box_repeats() {
    let size = [5.8, 3.1, 3.4];
    let all = pair(14, PeriodicBox::new(size).unwrap());
    let scattered = |k: usize| {
        let noise = |i: usize| (12.9898 * k as f64 + 78.233 * i as f64).sin();
        [0, 1, 2].map(|i| 2.0 * size[i] * noise(i))
    };
    let points: Vec<[f64; 3]> = (0..60).map(scattered).collect();
    let shifted = points.iter().map(|x| [x[0] + size[0], x[1] - 2.0 * size[1], x[2] + size[2]]);
    let here = all.velocities_at(&points, 1e-8).unwrap();
    let there = all.velocities_at(&shifted.collect::<Vec<_>>(), 1e-8).unwrap();
    let difference = here.iter().flatten().zip(there.iter().flatten()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let surfaces = [[0.0; 3], [size[0], 0.0, 0.0], [-size[0], 0.0, 3.0 * size[2]]].map(|shift| slip(&all, shift));
    println!("{difference:e} of {}, surfaces {surfaces:?}", largest(&here));
    assert!(largest(&here) > 0.01 && difference < 1e-7, "{difference:e}");
    assert!(surfaces.iter().all(|slip| *slip < 1e-5), "{surfaces:?}");
    // Images that are close to a point, and not the nearest ones.
    let points: Vec<[f64; 3]> = (0..20).map(|k| [1.39, 0.05 * f64::from(k) - 0.6, 0.05]).collect();
    let below = points.iter().map(|x| [x[0] - size[0], x[1], x[2]]).collect::<Vec<_>>();
    let [here, there] = [points, below].map(|points| all.velocities_at(&points, 1e-8).unwrap());
    assert!(here.iter().flatten().zip(there.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-7));
    // The mean over the box is zero, by the trapezoidal rule, whose error is due to the kinks at surfaces.
    let n = 16;
    let lattice = (0..n * n * n).map(|k| [k % n, k / n % n, k / n / n]);
    let lattice = lattice.map(|k| std::array::from_fn(|i| (k[i] as f64 + 0.3) / n as f64 * size[i]));
    let flow = all.velocities_at(&lattice.collect::<Vec<_>>(), 1e-3).unwrap();
    let mean = [0, 1, 2].map(|i| flow.iter().map(|u| u[i]).sum::<f64>() / flow.len() as f64);
    assert!(mean.iter().all(|mean| mean.abs() < 2e-3 * largest(&flow)), "{mean:?} {}", largest(&flow));
}

/// Sampling uses the memory of a run and leaves its results as they are, to the last bit. Surroundings of your own have
/// a flow as well.
#[test]
fn sampling_does_not_change_a_run() {
    #[derive(Debug)]
    struct Nothing;
    impl Surroundings for Nothing {
        fn add_flow(&mut self, _: &[crate::Sources<'_>], _: &mut [crate::Targets<'_>]) -> Result<(), SpaceError> {
            Ok(())
        }

        fn check(&self, _: f64, _: usize, _: crate::Components<'_>) -> Result<(), SpaceError> {
            Ok(())
        }
    }
    let rates = |all: &mut SpaceDroplets| {
        all.known = false;
        all.start_from(None);
        all.evaluate().unwrap();
        all.droplets().iter().flat_map(|droplet| droplet.flow.rates.clone()).collect::<Vec<f64>>()
    };
    let far = [[9.0, 0.1, 0.2], [-3.0, 0.3, 0.1], [0.2, 0.1, 1.5]];
    let tube = Tube::new(2.2).unwrap().along([1.0, 0.0, 0.0]).unwrap();
    let around: [SpaceDroplets; 4] = [
        pair(6, Slit::new(-2.1, 1.9).unwrap()),
        pair(6, tube),
        pair(6, PeriodicBox::new([5.8, 3.1, 3.4]).unwrap()),
        pair(6, Nothing),
    ];
    for mut all in around {
        let before = rates(&mut all);
        all.velocities_at(&far, 1e-6).unwrap();
        assert_eq!(before, rates(&mut all));
    }
    let mut free = SpaceDroplets::new(vec![droplet(6, 4.0, [0.0; 3])]).unwrap();
    free.evaluate().unwrap();
    let same = free.velocities_at(&far, 1e-6).unwrap();
    let mut around = free.with_surroundings(Nothing).unwrap();
    around.evaluate().unwrap();
    let found = around.velocities_at(&far, 1e-6).unwrap();
    assert!(largest(&same) > 1e-4);
    for (a, b) in same.iter().flatten().zip(found.iter().flatten()) {
        assert!((a - b).abs() < 1e-10, "{a} {b}");
    }
}

/// Points that would take too long are refused in words.
#[test]
fn points_that_are_too_far_are_refused() {
    let far = [[1e4, 0.0, 0.0]];
    let message = |all: SpaceDroplets| all.velocities_at(&far, 1e-3).unwrap_err().to_string();
    let slit = message(pair(4, Slit::new(-2.1, 1.9).unwrap()));
    assert!(slit.contains("so far apart along the walls") && slit.contains("Bring them closer"), "{slit}");
    let tube = message(pair(4, Tube::new(2.2).unwrap().along([1.0, 0.0, 0.0]).unwrap()));
    assert!(tube.contains("too far apart along the tube") && tube.contains("Use at most 400"), "{tube}");
    assert!(pair(4, PeriodicBox::new([5.8, 3.1, 3.4]).unwrap()).velocities_at(&far, 1e-3).is_ok());
}

/// Gaps count walls, other droplets, and images of both.
#[test]
fn gaps_count_walls_and_images() {
    let sphere = |x: f64| {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        SpaceDroplet::sphere(10, 1.0, [1.0, 1.0], law).unwrap().with_position([x, 0.0, 0.0]).unwrap()
    };
    let gap = |droplets: Vec<SpaceDroplet>, around: Box<dyn FnOnce(SpaceDroplets) -> SpaceDroplets>| {
        let mut all = around(SpaceDroplets::new(droplets).unwrap());
        all.evaluate().unwrap();
        all.smallest_gap(0).unwrap().unwrap_or(f64::INFINITY)
    };
    let slit = |all: SpaceDroplets| all.with_surroundings(Slit::new(-1.5, 3.0).unwrap()).unwrap();
    let tube = |all: SpaceDroplets| all.with_surroundings(Tube::new(1.7).unwrap().along([1.0, 0.0, 0.0]).unwrap());
    let cube = |side: f64| move |all: SpaceDroplets| all.with_surroundings(PeriodicBox::new([side; 3]).unwrap());
    for (found, exact) in [
        (gap(vec![sphere(0.0)], Box::new(slit)), 0.5),
        (gap(vec![sphere(0.0), sphere(2.2)], Box::new(slit)), 0.2),
        (gap(vec![sphere(0.0)], Box::new(move |all| tube(all).unwrap())), 0.7),
        (gap(vec![sphere(0.0)], Box::new(move |all| cube(5.0)(all).unwrap())), 3.0),
        (gap(vec![sphere(0.0), sphere(4.7)], Box::new(move |all| cube(7.0)(all).unwrap())), 0.3),
        (gap(vec![sphere(0.0)], Box::new(|all| all)), f64::INFINITY),
    ] {
        assert!(found == exact || (found - exact).abs() < 1e-9, "{found} {exact}");
    }
}
