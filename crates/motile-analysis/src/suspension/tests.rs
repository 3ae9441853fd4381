use std::f64::consts::{PI, TAU};

use motile_base::{Drive, Region, Vec2};

use super::*;
use active_interface::internal::SplitMix64;

fn directions(angles: impl Iterator<Item = f64>) -> Vec<Vec2> {
    angles.map(|angle| Vec2::new(angle.cos(), angle.sin())).collect()
}

#[test]
fn order_of_known_directions() {
    let fan = directions((0..3).map(|k| f64::from(k) * PI / 3.0));
    // |1 + e^(i pi/3) + e^(2 i pi/3)| = 2, and twice these angles go around once.
    assert!((polar_order(&fan) - 2.0 / 3.0).abs() < 1e-15);
    assert!(nematic_order(&fan) < 1e-15);
    let alike = directions((0..50).map(|_| 2.2));
    assert!((polar_order(&alike) - 1.0).abs() < 1e-14 && (nematic_order(&alike) - 1.0).abs() < 1e-14);
    // Those of no length are no directions.
    assert_eq!(polar_order(&[Vec2::ZERO, Vec2::Y]), 1.0);
    assert_eq!((polar_order(&[]), nematic_order(&[Vec2::ZERO])), (0.0, 0.0));
}

#[test]
fn neighbours_of_a_square_lattice() {
    // In a square lattice of spacing 1 each place has 4 neighbours at 1, 4 at sqrt 2, 4 at 2, 8 at sqrt 5.
    let side = 12;
    let places: Vec<Vec2> =
        (0..side * side).map(|k| Vec2::new(f64::from(k % side), f64::from(k / side)) - Vec2::splat(5.5)).collect();
    let still = vec![Vec2::ZERO; places.len()];
    let lengths = [f64::from(side); 2];
    let mut pairs = PairAverages::new(&Region::Box { lengths }, 0.1, 2.5);
    pairs.add(&places, &still);
    pairs.add(&places, &still);
    let found = pairs.correlations();
    assert_eq!(found.distances.len(), 25);
    let count = f64::from(side * side);
    for (bin, neighbours) in [(10, 4.0), (14, 4.0), (20, 4.0), (22, 8.0), (12, 0.0)] {
        let (from, to) = (0.1 * bin as f64, 0.1 * (bin + 1) as f64);
        // Round-off of distances of 1 and 2 may put them into the bin below.
        let value = found.pairs[bin] + if bin % 10 == 0 { found.pairs[bin - 1] } else { 0.0 };
        let expected = neighbours / ((count - 1.0) * PI * (to * to - from * from) / (count));
        assert!((value - expected).abs() < 1e-9 * expected.max(1.0), "{bin} {value} {expected}");
    }
}

#[test]
fn independent_places_are_not_correlated() {
    let mut random = SplitMix64::new(5);
    let lengths = [20.0, 3.0];
    for (region, reach) in [
        (Region::Box { lengths: [20.0, 12.0] }, 6.0),
        (Region::Channel { length: lengths[0], width: lengths[1], drive: Drive::ZeroFlux }, 9.0),
    ] {
        let [length, width] = region.lengths();
        let mut pairs = PairAverages::new(&region, 0.5, reach);
        for _ in 0..40 {
            let mut place = || Vec2::new(length * (random.uniform() - 0.5), width * (random.uniform() - 0.5));
            let places: Vec<Vec2> = (0..200).map(|_| place()).collect();
            // Velocities that change sign in x over half of the length.
            let velocities: Vec<Vec2> = places.iter().map(|at| Vec2::new((TAU * at.x / length).cos(), 0.0)).collect();
            pairs.add(&places, &velocities);
        }
        let found = pairs.correlations();
        for (k, g) in found.pairs.iter().enumerate() {
            // Some 40 * 19900 pairs in all, a thousandth of them in the first bin.
            assert!((g - 1.0).abs() < if k == 0 { 0.15 } else { 0.05 }, "{k} {g}");
        }
        assert!(found.velocities[0] > 0.9, "{:?}", found.velocities);
    }
}

#[test]
fn numbers_of_independent_places_fluctuate_by_their_mean() {
    let mut random = SplitMix64::new(3);
    let places: Vec<Vec2> = (0..20_000).map(|_| Vec2::new(random.uniform(), 7.0 * random.uniform())).collect();
    let [mean, variance] = number_fluctuations(&places, [1.0, 7.0], [20, 50]);
    // The variance of the variance of 1000 Poisson numbers is 2 mean^2 / 1000 and a little.
    assert!((mean - 20.0).abs() < 1e-12 && (variance / mean - 1.0).abs() < 0.2, "{mean} {variance}");
    // A lattice has none.
    let even: Vec<Vec2> = (0..100).map(|k| Vec2::new(f64::from(k % 10) + 0.5, f64::from(k / 10) + 0.5)).collect();
    assert_eq!(number_fluctuations(&even, [10.0, 10.0], [5, 5]), [4.0, 0.0]);
}

#[test]
fn directions_that_diffuse_lose_their_memory_at_the_known_rate() {
    let (rate, interval, steps, count) = (0.4, 0.05, 100, 400);
    let mut random = SplitMix64::new(11);
    let mut angles = vec![0.0_f64; count];
    let mut states = Vec::new();
    for _ in 0..steps {
        states.push(directions(angles.iter().copied()));
        for angle in &mut angles {
            // Normally distributed, of variance 2 D dt.
            let size = (-2.0 * random.uniform().ln()).sqrt();
            *angle += (2.0_f64 * rate * interval).sqrt() * size * (TAU * random.uniform()).cos();
        }
    }
    let correlation = heading_correlation(&states);
    assert!((correlation[0] - 1.0).abs() < 1e-12);
    let found = rotational_diffusion(&correlation, interval).unwrap();
    assert!((found / rate - 1.0).abs() < 0.05, "{found}");
    assert_eq!(rotational_diffusion(&[1.0], 1.0), None);
    assert_eq!(rotational_diffusion(&[1.0, -0.2], 1.0), None);
}

#[test]
fn displacements_of_steady_and_of_random_ways() {
    let steady: Vec<Vec<Vec2>> =
        (0..6).map(|k| [0.3, -0.4].iter().map(|v| Vec2::new(v * f64::from(k), 1.0)).collect()).collect();
    for (lag, square) in mean_square_displacement(&steady).into_iter().enumerate() {
        assert!((square - 0.125 * (lag * lag) as f64).abs() < 1e-14, "{lag} {square}");
    }
    let mut random = SplitMix64::new(2);
    let mut places = vec![Vec2::ZERO; 500];
    let mut states = Vec::new();
    for _ in 0..60 {
        states.push(places.clone());
        let mut step = || Vec2::new(random.uniform() - 0.5, random.uniform() - 0.5);
        places.iter_mut().for_each(|place| *place += step());
    }
    // Steps of variance 1/12 in each direction.
    for (lag, square) in mean_square_displacement(&states).into_iter().enumerate().skip(1).take(20) {
        assert!((6.0 * square / lag as f64 - 1.0).abs() < 0.1, "{lag} {square}");
    }
    // A droplet that is added ends the list.
    states[3].push(Vec2::ZERO);
    assert_eq!(mean_square_displacement(&states).len(), 3);
}

#[test]
fn the_area_is_that_of_the_smooth_curve() {
    for count in [32, 40] {
        let ellipse: Vec<Vec2> = directions((0..count).map(|k| TAU * f64::from(k) / f64::from(count)))
            .into_iter()
            .map(|n| Vec2::new(70.0 + 1.3 * n.x, 0.6 * n.y - 50.0))
            .collect();
        let area = MomentEllipse::of(&ellipse).unwrap().area;
        assert!((area / (0.78 * PI) - 1.0).abs() < 1e-13, "{area}");
    }
}

/// A droplet heads away from where its particles are, wherever it is, and counts what it carries.
#[test]
fn members_head_away_from_their_particles() {
    use active_interface::{ContractileTension, Curve, ExcludedVolume, InitialConcentration};
    use ib_core::{BSpline, ImmersedBoundary};
    use motile_scene::Scene;
    use stokes_grid::{Grid, PeriodicStokes};

    let grid = Grid::periodic(32, 32, 0.25).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(PeriodicStokes::new(grid, 1.0).unwrap(), BSpline::<4>));
    let places = [(Vec2::ZERO, 0.7), (Vec2::new(2.5, -2.0), -2.0), (Vec2::new(-2.5, 100.0), 3.0)];
    for (centre, heading) in places {
        let markers = Curve::ellipse(1.2, 0.9).unwrap().rotated(heading).translated(centre).markers(64).unwrap();
        let numbers = InitialConcentration::polarised(1.0, heading).unwrap().particle_numbers(&markers).unwrap();
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        scene.add(ActiveDroplet::new(&markers, numbers, law, 0.05).unwrap());
    }
    let members = Member::all(scene.system_mut()).unwrap();
    for (member, (centre, heading)) in members.iter().zip(places) {
        assert!(member.centroid.distance(centre) < 1e-9, "{member:?}");
        assert!((member.area / members[0].area - 1.0).abs() < 1e-9, "{member:?}");
        assert!(member.heading.distance(Vec2::from_angle(heading)) < 1e-6, "{member:?} {heading}");
        assert!((member.particles / members[0].particles - 1.0).abs() < 1e-9, "{member:?}");
    }
}
