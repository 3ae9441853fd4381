//! Droplets of another viscosity than the exterior fluid, by layers and smeared over the grid, against boundary
//! integrals and tables.

use std::f64::consts::TAU;

use allocation_counter::measure;
use motile::active_interface::observables::{Convention, Frame, InterfaceState, force_moments, observe};
use motile::base::{Drive, FlowSample, ImposedFlow, InputError, Region, Vec2};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{FlowError, Hydrodynamics, MarkerKind, Markers};
use motile::setup::{AnyFlow, DropletSetup, IntegralMethod, LayersMethod, Method, Setup};
use motile::stokes_grid::{Grid, PeriodicStokes};
use motile_tests::validation::contrast::{Droplet, Exact};
use motile_tests::validation::scene::{by_layers, flow, open_channel, reference};
use motile_tests::validation::swimmers::speeds;
use motile_tests::validation::{Reference, order};

use crate::net_forces::{beside_a_point, layers};

const RATIOS: [f64; 5] = [0.01, 1.0, 10.0, 100.0, 1000.0];
const SQUARE: Region = Region::Box { lengths: [6.0; 2] };

/// The boundary integrals that the tests below compare with, against a table that is independent of them.
#[test]
fn the_exact_velocities_are_those_of_the_table() {
    for (name, gamma, droplet) in
        [("circle", "1+0.5cos", Droplet::circle(1, 10.0)), ("ellipse", "1+0.5cos", Droplet::ellipse(10.0))]
    {
        let table = Reference::read("fixed_shape_velocities_ratio_10").unwrap();
        let table = table.select("shape", name).select("gamma", gamma).select("L", "6").select("kind", "marker");
        let (vx, vy) = (table.column("vx").unwrap(), table.column("vy").unwrap());
        assert_eq!(vx.len(), 8);
        let exact = Exact::new(SQUARE, &[droplet], 256).unwrap();
        for (j, (vx, vy)) in vx.iter().zip(&vy).enumerate() {
            let v = exact.velocities(0)[32 * j];
            assert!((v.x - vx).abs() < 1e-9 && (v.y - vy).abs() < 1e-9, "{name} {j}: {v} {vx} {vy}");
        }
    }
}

/// Errors fall faster than any power of the nodes, to the tolerance.
#[test]
fn shapes_at_every_ratio() {
    for ratio in RATIOS {
        let shapes = [Droplet::circle(1, ratio), Droplet::circle(3, ratio), Droplet::ellipse(ratio)];
        for droplet in shapes {
            let exact = Exact::new(SQUARE, &[droplet], 256).expect("a valid scene");
            let errors = [16, 32, 64].map(|nodes| exact.errors(nodes).expect("a valid scene")[0].maximum);
            println!("{droplet:?}: {errors:?}");
            assert!(errors[0] < 0.02 && errors[1] < 2e-4 && errors[2] < 2e-6, "{droplet:?}: {errors:?}");
        }
    }
}

/// Scenes with gaps of 0.075, one and a half cells of 0.05: beside the wall of a channel, two droplets, and one
/// beside a passive interface. Tensions vary where the gap is.
fn close_scenes() -> Vec<(&'static str, Region, Vec<Droplet>)> {
    let (quarter, x) = (0.25 * TAU, 1.0 + 0.0375);
    let height = 1.5 - 0.075 - 1.0 / 1.3;
    let pair = |left: f64, right: f64| {
        vec![
            Droplet::circle(1, left).at(-x, 0.02).turned(quarter),
            Droplet::circle(1, right).at(x, -0.01).turned(quarter),
        ]
    };
    let (channel, square) = (open_channel(6.0, 3.0), Region::Box { lengths: [6.0; 2] });
    let beside = |ratio| Droplet::ellipse(ratio).at(0.1, height);
    vec![
        ("beside a wall, tension along it", channel, vec![beside(100.0)]),
        ("beside a wall, tension across", channel, vec![beside(100.0).turned(quarter)]),
        ("off the centre, gap 0.3", channel, vec![Droplet::circle(1, 100.0).at(0.1, 0.2)]),
        ("beside a wall, equal viscosities", channel, vec![beside(1.0).turned(quarter)]),
        ("two droplets, equal viscosities", square, pair(1.0, 1.0)),
        ("two droplets", square, pair(10.0, 100.0)),
        ("beside a passive interface", square, pair(100.0, 1.0)),
    ]
}

/// Films of 0.075 beside walls and between droplets.
#[test]
fn films() {
    for (name, region, droplets) in close_scenes() {
        let exact = Exact::new(region, &droplets, 256).expect("a valid scene");
        let [coarse, fine] = [64, 128].map(|nodes| exact.errors(nodes).expect("a valid scene"));
        for (coarse, fine) in coarse.iter().zip(&fine) {
            println!("{name}: {coarse:?} {fine:?}");
            assert!(coarse.speed < 7e-5 && fine.speed < 1e-4 && fine.maximum < 1e-4, "{name}: {coarse:?} {fine:?}");
        }
    }
}

/// Second and third moments of a droplet ten times as viscous as the exterior fluid.
#[test]
fn force_moments_are_those_of_the_table() {
    for (name, droplet) in [("circle", Droplet::circle(1, 10.0)), ("ellipse", Droplet::ellipse(10.0))] {
        let mut markers = Markers::new();
        droplet.push_exact(256, &mut markers);
        layers(SQUARE, 0.1).velocities(&mut markers).unwrap();
        let table = Reference::read("fixed_shape_moments_ratio_10").unwrap().select("shape", name);
        let table = table.select("gamma", "1+0.5cos").select("L", "6").select("conv", "farfield");
        let (positions, forces, velocities) = (markers.positions(), markers.forces(), markers.velocities());
        let frame = Frame::new(Vec2::ZERO, 0.0).unwrap();
        let found = force_moments(positions, forces, velocities, [10.0, 1.0], Convention::FarField, &frame).unwrap();
        let axes = [(0, "x"), (1, "y")];
        let [mut second, mut third] = [[0.0_f64; 2]; 2];
        let compare = |kind: &mut [f64; 2], found: f64, key: String| {
            let exact = table.value(&key).unwrap();
            *kind = [kind[0].max((found - exact).abs()), kind[1].max(exact.abs())];
        };
        for (i, a) in axes {
            for (j, b) in axes {
                compare(&mut second, found.dipole[i][j], format!("F2{a}{b}"));
                for (k, c) in axes {
                    compare(&mut third, found.quadrupole.unwrap()[i][j][k], format!("F3{a}{b}{c}"));
                }
            }
        }
        println!("{name}: {second:?} {third:?}");
        assert!([second, third].iter().all(|[error, largest]| *error < 1e-4 * largest), "{name}: {second:?} {third:?}");
    }
}

/// Cowley's way and its limits: it is of first order, and its errors grow with the ratio.
#[test]
fn a_smeared_viscosity_is_first_order() {
    for region in [SQUARE, open_channel(8.0, 5.0)] {
        let mut last = 0.0;
        for ratio in [1.0, 10.0, 100.0] {
            let exact = Exact::new(region, &[Droplet::circle(1, ratio)], 128).unwrap();
            let [coarse, fine] = [0.1, 0.05].map(|h| exact.smeared_errors(h).unwrap()[0]);
            println!("{region:?}, ratio {ratio}: {:.4} {:.4}", coarse.speed, fine.speed);
            assert!(fine.speed > 1.5 * last, "{ratio}: {coarse:?} {fine:?}");
            if ratio > 1.0 {
                let order = (coarse.speed / fine.speed).log2();
                assert!((0.7..1.3).contains(&order), "{ratio}: order {order}, {coarse:?} {fine:?}");
                assert!((0.1..0.4).contains(&fine.speed), "{ratio}: {fine:?}");
            }
            last = fine.speed;
        }
    }
}

/// Part of the mean pressure gradient at zero flux that comes from the contrast; with a force on a point, however
/// small, it comes from the grid.
#[test]
fn the_mean_pressure_gradient_is_that_of_the_contrast() {
    const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];
    let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroFlux };
    let markers = |ratio: f64| {
        let mut markers = Markers::new();
        Droplet::ellipse(ratio).at(0.1, 0.2).push_even(0.0125, &mut markers).unwrap();
        markers
    };
    let gradient =
        |mut flow: AnyFlow, mut markers: Markers| flow.velocities(&mut markers).unwrap().mean_pressure_gradient[0];
    let integral = || {
        flow(region, Method::Integral(IntegralMethod { nodes: 128, elements: 512 }), 1.0, 1e-10).expect("a valid scene")
    };
    for ratio in [0.05, 20.0] {
        let exact = gradient(integral(), markers(ratio));
        let errors = SPACINGS.map(|h| (gradient(layers(region, h), beside_a_point(markers(ratio))) - exact).abs());
        // The contrast changes it by more than that.
        let change = (gradient(integral(), markers(1.0)) - exact).abs();
        println!("{ratio}: {errors:?} {exact} {change}");
        assert!(errors[2] < 1e-3 * change && order(&SPACINGS, &errors) > 1.9, "{ratio}: {errors:?} {exact} {change}");
        assert!((gradient(layers(region, 0.1), markers(ratio)) - exact).abs() < 1e-6 * exact.abs(), "{ratio}");
    }
}

/// A droplet of activity -1 and a viscosity, with A = 2, in fluid of viscosity 10.
fn swimmer(viscosity: f64, h: f64) -> Setup {
    let droplet = DropletSetup { viscosity: Some(viscosity), ..DropletSetup::default() };
    reference(Setup { viscosity: 10.0, droplets: vec![droplet], ..by_layers(h) }, -1.0)
}

/// From exact theory: this droplet decays to rest.
#[test]
fn a_stiff_droplet_of_little_activity_stops() {
    let speeds = speeds(&swimmer(1000.0, 0.1), &[20.0, 40.0]).unwrap();
    assert!(speeds[1] < 0.8 * speeds[0], "{speeds:?}");
}

#[test]
fn work_is_counted_and_nothing_is_allocated() {
    for viscosity in [10.0, 1000.0] {
        let mut scene = swimmer(viscosity, 0.1).build().unwrap().scene;
        (0..3).for_each(|_| scene.step(0.01).unwrap());
        let before = scene.system().hydrodynamics().work();
        // Two evaluations a step, and that of the state the last one led to.
        assert_eq!((before.stokes_solves, before.evaluations), (0, 7));
        assert_eq!(measure(|| (0..10).for_each(|_| scene.step(0.01).unwrap())).count_total, 0);
        let after = scene.system().hydrodynamics().work();
        let each = (after.iterations - before.iterations) as f64 / (after.evaluations - before.evaluations) as f64;
        assert!(if viscosity == 10.0 { each == 0.0 } else { (1.0..20.0).contains(&each) }, "{each} iterations");
    }
}

#[test]
fn viscosities_are_checked() {
    let mut flow =
        ImmersedBoundary::new(PeriodicStokes::new(Grid::periodic(32, 32, 0.1).unwrap(), 1.0).unwrap(), BSpline::<4>);
    let mut found = |value: f64| {
        let mut markers = Markers::new();
        markers.push_group(16, MarkerKind::Interface { viscosity_inside: Some(value) });
        (flow.velocities(&mut markers), flow.sample(&markers, &[Vec2::ZERO], &mut [FlowSample::default()]))
    };
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let (found, _) = found(value);
        assert!(matches!(found, Err(FlowError::Input(InputError::NotPositive { .. }))), "{value}: {found:?}");
    }
    // A grid of one viscosity has no other.
    let (velocities, samples) = found(2.0);
    for error in [velocities.map(drop).unwrap_err(), samples.map(drop).unwrap_err()] {
        let refused = matches!(error, FlowError::Refused { .. });
        assert!(refused && error.to_string().starts_with("an interface to another viscosity on a grid"), "{error}");
    }
}

/// Distance over the size of the second.
fn relative([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    (a - c).hypot(b - d) / c.hypot(d)
}

/// The stresslet (S_xx, S_xy) of a droplet, from exact forces and velocities.
fn stresslet(droplet: &Droplet, velocities: &[Vec2]) -> [f64; 2] {
    let ([a, b], step) = (droplet.axes, TAU / velocities.len() as f64);
    let mut sum = [0.0; 2];
    for (k, v) in velocities.iter().enumerate() {
        let t = step * k as f64;
        let place = droplet.point(t) - Vec2::from(droplet.centre);
        let (force, normal) = (droplet.force(t), Vec2::new(b * t.cos(), a * t.sin()));
        let viscous = 1.0 - droplet.ratio;
        sum[0] += 0.5 * (force.x * place.x - force.y * place.y) + viscous * (v.x * normal.x - v.y * normal.y);
        sum[1] += 0.5 * (force.x * place.y + force.y * place.x) + viscous * (v.x * normal.y + v.y * normal.x);
    }
    sum.map(|sum| step * sum)
}

/// The errors of the stresslets relative to them, as observed from forces and velocities of layers with `nodes`
/// nodes, droplet by droplet.
fn stresslet_errors(region: Region, droplets: &[Droplet], exact: &Exact, nodes: usize) -> Vec<f64> {
    let method = LayersMethod { nodes, elements: nodes, ..LayersMethod::of_spacing(0.05) };
    let mut flow = flow(region, Method::Layers(method), 1.0, 1e-6).expect("a valid scene");
    let mut markers = Markers::new();
    droplets.iter().for_each(|droplet| droplet.push_exact(4 * nodes, &mut markers));
    flow.velocities(&mut markers).expect("a flow");
    let errors = markers.groups().iter().enumerate().map(|(index, group)| {
        let range = group.range.clone();
        let [markers, forces, velocities] =
            [markers.positions(), markers.forces(), markers.velocities()].map(|list| &list[range.clone()]);
        let viscosities = [droplets[index].ratio, 1.0];
        let (numbers, inside, enclosed) = (&[][..], None, Vec::new());
        let state = InterfaceState {
            markers,
            forces,
            velocities,
            imposed: ImposedFlow::NONE,
            numbers,
            viscosities,
            inside,
            membrane: None,
            enclosed,
            axisymmetric: false,
            on_grid: false,
        };
        let seen = observe(&state, Convention::FarField).expect("observables");
        relative(seen.stresslet_in_laboratory[0], stresslet(&droplets[index], exact.velocities(index)))
    });
    errors.collect()
}

/// Of second order in the distance of the markers, though at large ratios it is a small difference of large numbers.
#[test]
fn the_stresslet_at_every_ratio() {
    let scenes = [
        (SQUARE, vec![Droplet::ellipse(300.0)]),
        (SQUARE, vec![Droplet::ellipse(0.05).turned(1.0)]),
        (open_channel(5.0, 3.0), vec![Droplet::ellipse(300.0).turned(0.7)]),
        (
            Region::Box { lengths: [9.0, 6.0] },
            vec![
                Droplet::ellipse(300.0).at(-3.0, 0.3),
                Droplet::circle(2, 0.05).turned(0.4).at(0.0, -0.2),
                Droplet::ellipse(1.0).at(2.9, 0.1),
            ],
        ),
    ];
    for (region, droplets) in scenes {
        let exact = Exact::new(region, &droplets, 256).unwrap();
        let [coarse, fine] = [32, 64].map(|nodes| stresslet_errors(region, &droplets, &exact, nodes));
        println!("{droplets:?}: {coarse:?} {fine:?}");
        for (coarse, fine) in coarse.iter().zip(&fine) {
            assert!(*fine < 1e-12 || *fine < 1.2e-2 && coarse / fine > 3.5, "{droplets:?}: {coarse} {fine}");
        }
    }
}
