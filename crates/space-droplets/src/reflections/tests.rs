use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};

use active_interface::{ConstantTension, ContractileTension, ExcludedVolume};

use crate::surroundings::{Components, Sources, Surroundings, Targets, lists, lists_mut};
use crate::{Midpoint, PeriodicBox, Repulsion, Slit, SpaceDroplet, SpaceDroplets, SpaceError, StepSize, Tube};

/// Surroundings that count flows: with all digits, and rough ones.
#[derive(Debug)]
struct Counted<S> {
    inner: S,
    counts: Arc<[AtomicUsize; 2]>,
}

impl<S: Surroundings> Surroundings for Counted<S> {
    fn add_flow(&mut self, sources: &[Sources<'_>], targets: &mut [Targets<'_>]) -> Result<(), SpaceError> {
        self.counts[0].fetch_add(1, Ordering::Relaxed);
        self.inner.add_flow(sources, targets)
    }

    fn add_rough_flow(
        &mut self,
        sources: &[Sources<'_>],
        targets: &mut [Targets<'_>],
        accuracy: f64,
    ) -> Result<(), SpaceError> {
        self.counts[1].fetch_add(1, Ordering::Relaxed);
        self.inner.add_rough_flow(sources, targets, accuracy)
    }

    fn check(&self, time: f64, droplet: usize, places: Components<'_>) -> Result<(), SpaceError> {
        self.inner.check(time, droplet, places)
    }
}

/// A droplet whose tension grows along an oblique axis. Lengths in units of the first number, the viscosity outside in
/// units of the second, and the time in units of 1.
fn droplet(degree: usize, ratio: f64, [length, eta]: [f64; 2], position: [f64; 3]) -> SpaceDroplet {
    let tension = eta * length;
    let law = ContractileTension::new(tension, -0.5 * tension * length.powi(2), ExcludedVolume::None, 1.0).unwrap();
    let droplet = SpaceDroplet::sphere(degree, length, [ratio * eta, eta], law).unwrap();
    let particles = |s: [f64; 3]| (1.0 + 0.6 * s[0] + 0.3 * s[1] - 0.5 * s[2]) / length.powi(2);
    let droplet = droplet.with_particles(0.1 * length.powi(2), particles).unwrap();
    droplet.with_position(position.map(|x| x * length)).unwrap()
}

/// Returns flows with all digits and rough ones in eight steps after the first two, of two evaluations each.
fn flows(surroundings: impl Surroundings + 'static, ratio: f64) -> [usize; 2] {
    let counts = Arc::new([const { AtomicUsize::new(0) }; 2]);
    let surroundings = Counted { inner: surroundings, counts: Arc::clone(&counts) };
    let mut droplet = droplet(4, ratio, [1.0; 2], [0.1, 0.05, 0.0]).with_surroundings(surroundings).unwrap();
    let steps = StepSize::Fixed(0.1);
    droplet.advance(0.2, steps, &mut Midpoint::default(), |_| {}).unwrap();
    let before = counts.each_ref().map(|count| count.load(Ordering::Relaxed));
    droplet.advance(1.0, steps, &mut Midpoint::default(), |_| {}).unwrap();
    std::array::from_fn(|i| counts[i].load(Ordering::Relaxed) - before[i])
}

/// Each evaluation takes one flow with all digits, and for two viscosities a few rough ones: thirteen flows with all
/// digits each if the wall were in all iterations.
#[test]
fn walls_are_evaluated_with_all_digits_once_for_each_flow() {
    for (ratio, most) in [(1.0, 0), (5.0, 5 * 16), (0.2, 5 * 16)] {
        let all = [
            flows(Tube::new(1.7).unwrap(), ratio),
            flows(Slit::new(-1.7, 1.7).unwrap(), ratio),
            flows(PeriodicBox::new([4.0; 3]).unwrap(), ratio),
        ];
        for [exact, rough] in all {
            assert!(exact == 16 && rough <= most, "{ratio}: {all:?}");
        }
    }
}

/// The flow of the double layer of a sphere, of which a fine grid resolves all waves.
#[test]
fn rough_flows_have_the_accuracy_that_is_asked_for() {
    let grid = sphere_harmonics::Grid::gauss(20).unwrap();
    let weights: Vec<f64> = grid.weights().collect();
    let [mut places, mut normals, mut velocities] = [(); 3].map(|()| crate::surface::vectors(0));
    for (point, weight) in grid.points().zip(&weights) {
        let s = sphere_harmonics::Point::direction(point);
        let velocity = [1.0 + s[0] * s[1], s[2] - s[0] * s[0] * s[1], 0.5 * s[0]];
        for i in 0..3 {
            places[i].push([0.2, 0.1, -0.1][i] + s[i]);
            normals[i].push(weight * s[i]);
            velocities[i].push(velocity[i]);
        }
    }
    let sources =
        [Sources::Stresslets { places: lists(&places), normals: lists(&normals), velocities: lists(&velocities) }];
    let all: [Box<dyn Surroundings>; 3] = [
        Box::new(Tube::new(2.0).unwrap()),
        Box::new(Slit::new(-1.6, 1.7).unwrap()),
        Box::new(PeriodicBox::new([3.0, 4.0, 3.5]).unwrap()),
    ];
    for (k, mut surroundings) in all.into_iter().enumerate() {
        let mut flow = |accuracy: Option<f64>| {
            let mut flow = crate::surface::vectors(weights.len());
            let mut targets = [Targets { places: lists(&places), flow: lists_mut(&mut flow) }];
            match accuracy {
                Some(accuracy) => surroundings.add_rough_flow(&sources, &mut targets, accuracy).unwrap(),
                None => surroundings.add_flow(&sources, &mut targets).unwrap(),
            }
            flow
        };
        let exact = flow(None);
        let largest = exact.iter().flatten().fold(0.0_f64, |most, u| most.max(u.abs()));
        for accuracy in [3e-2, 1e-3, 1e-5, 1e-7, 1e-9] {
            let found = flow(Some(accuracy));
            let differences = found.iter().flatten().zip(exact.iter().flatten()).map(|(a, b)| (a - b).abs());
            let error = differences.fold(0.0, f64::max) / largest;
            // A box has splits of four accuracies; the last is the one with all digits.
            assert!(error < 2.0 * accuracy && (error > 0.0 || k == 2), "{k} {accuracy:e}: {error:e}");
        }
    }
}

/// Two droplets of different viscosities in surroundings, with a repulsion. In other units, all lengths and times are
/// the same up to the residual of the velocities and the waves that a tube leaves out, both below 1e-9.
#[test]
fn units_do_not_matter_in_surroundings() {
    let ends = |kind: usize, [length, eta]: [f64; 2]| {
        let units = [length, eta];
        let pair = vec![droplet(4, 5.0, units, [0.1, 0.0, -1.1]), droplet(4, 0.2, units, [-0.05, 0.1, 1.1])];
        let repulsion = Repulsion::new(2.0 * eta / length, 0.4 * length).unwrap();
        let pair = SpaceDroplets::new(pair).unwrap().with_repulsion(repulsion);
        let mut pair = match kind {
            0 => pair.with_surroundings(Tube::new(1.8 * length).unwrap()),
            1 => pair.with_surroundings(Slit::new(-2.6 * length, 2.7 * length).unwrap()),
            _ => pair.with_surroundings(PeriodicBox::new([3.5 * length, 3.5 * length, 5.0 * length]).unwrap()),
        }
        .unwrap();
        let report = pair.advance(0.2, StepSize::Fixed(0.1), &mut Midpoint::default(), |_| {}).unwrap();
        assert_eq!(report.steps, 2);
        let seen = [0, 1].map(|k| pair.observe(k).unwrap());
        seen.map(|seen| [seen.position, seen.velocity, seen.semi_axes].map(|list| list.map(|x| x / length)))
    };
    for kind in 0..3 {
        let (here, there) = (ends(kind, [1.0; 2]), ends(kind, [1e-6, 1e-3]));
        let pairs = here.iter().flatten().flatten().zip(there.iter().flatten().flatten());
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(error < 1e-9, "{kind}: {error:e} {here:?} {there:?}");
    }
}

#[test]
fn spheres_with_uniform_particles_rest_between_walls() {
    for kind in 0..3 {
        for length in [1.0, 1e-6] {
            let law = ConstantTension::new(length).unwrap();
            let droplet = SpaceDroplet::sphere(5, length, [5.0, 1.0], law).unwrap();
            let droplet = droplet.with_particles(0.1 * length.powi(2), |_| length.powi(-2)).unwrap();
            let mut droplet = match kind {
                0 => droplet.with_surroundings(Tube::new(1.5 * length).unwrap()),
                1 => droplet.with_surroundings(Slit::new(-1.5 * length, 1.6 * length).unwrap()),
                _ => droplet.with_surroundings(PeriodicBox::new([3.0 * length; 3]).unwrap()),
            }
            .unwrap();
            droplet.advance(0.2, StepSize::Fixed(0.1), &mut Midpoint::default(), |_| {}).unwrap();
            let seen = droplet.observe().unwrap();
            // The walls reflect the forces of the tension at points, up to an error of the degree.
            assert!(seen.speed < 1e-6 * length, "{kind} {length}: {seen:?}");
            assert!(seen.semi_axes.iter().all(|axis| (axis / length - 1.0).abs() < 1e-6), "{seen:?}");
            assert!(droplet.warnings().is_empty(), "{:?}", droplet.warnings());
        }
    }
}

/// A mirror image moves as the mirror image.
#[test]
fn mirrored_droplets_in_a_tube_have_mirrored_velocities() {
    let velocity = |sign: f64| {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let droplet = SpaceDroplet::sphere(5, 1.0, [10.0, 1.0], law).unwrap();
        let particles = |s: [f64; 3]| 1.0 + 0.6 * sign * s[0] + 0.3 * s[1] - 0.5 * s[2] * sign * s[0];
        let droplet = droplet.with_particles(0.1, particles).unwrap().with_position([0.3 * sign, 0.1, 0.0]).unwrap();
        droplet.with_surroundings(Tube::new(1.7).unwrap()).unwrap().observe().unwrap().velocity
    };
    let (one, other) = (velocity(1.0), velocity(-1.0));
    let speed = one.iter().map(|u| u * u).sum::<f64>().sqrt();
    for (i, sign) in [-1.0, 1.0, 1.0].into_iter().enumerate() {
        assert!((one[i] - sign * other[i]).abs() < 1e-9 * speed, "{one:?} {other:?}");
    }
}
