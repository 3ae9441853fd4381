//! Droplets of another viscosity than the exterior fluid on a grid, against boundary integrals.

use allocation_counter::measure;
use motile::ib_core::{
    CubicQuadratic, FlowError, FlowSample, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, Vec2,
};
use motile::stokes_grid::{Drive, Grid, InputError, PeriodicStokes};
use motile::{DropletSetup, GridMethod, IntegralMethod, Method, Region, Setup};
use motile_tests::validation::contrast::{Droplet, Errors, Exact, exact_flow, field_errors};
use motile_tests::validation::scene::{flow, on_grid, open_channel, reference};
use motile_tests::validation::swimmers::{speeds, steady};
use motile_tests::validation::{Reference, ReferenceFile, order, relaxation};

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];
const RATIOS: [f64; 5] = [0.01, 1.0, 10.0, 100.0, 1000.0];
const SQUARE: Region = Region::Box { lengths: [6.0; 2] };

/// Errors of each droplet at the three spacings.
fn errors(region: Region, droplets: &[Droplet]) -> Vec<[Errors; 3]> {
    let exact = Exact::new(region, droplets, 256).expect("a valid scene");
    let all = SPACINGS.map(|h| exact.errors(h).expect("a valid scene"));
    (0..droplets.len()).map(|k| [all[0][k], all[1][k], all[2][k]]).collect()
}

fn orders(errors: &[Errors; 3]) -> [f64; 2] {
    [order(&SPACINGS, &errors.map(|e| e.speed)), order(&SPACINGS, &errors.map(|e| e.rms))]
}

/// The boundary integrals that the tests below compare with, against a table that is independent of them.
#[test]
fn the_exact_velocities_are_those_of_the_table() {
    for (name, gamma, droplet) in
        [("circle", "1+0.5cos", Droplet::circle(1, 10.0)), ("ellipse", "1+0.5cos", Droplet::ellipse(10.0))]
    {
        let table = Reference::read(ReferenceFile::FixedShapesRatio10).unwrap();
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

#[test]
fn a_circle_at_every_ratio() {
    for ratio in RATIOS {
        let [errors] = errors(SQUARE, &[Droplet::circle(1, ratio)])[..] else { unreachable!() };
        assert!(errors[1].speed < 1e-3 && errors[1].maximum < 1.4e-3, "{ratio}: {errors:?}");
        assert!(errors[2].rms < 2e-4, "{ratio}: {errors:?}");
        let [speed, rms] = orders(&errors);
        assert!(speed > 1.75 && rms > 1.6, "{ratio}: {speed} {rms} {errors:?}");
    }
}

#[test]
fn higher_modes_on_a_circle() {
    for (mode, ratio) in [(2, 0.01), (2, 100.0), (3, 10.0), (3, 1000.0)] {
        let [errors] = errors(SQUARE, &[Droplet::circle(mode, ratio)])[..] else { unreachable!() };
        assert!(errors[1].rms < 8e-4 && errors[2].rms < 3e-4, "{mode} {ratio}: {errors:?}");
        assert!(orders(&errors)[1] > 1.4, "{mode} {ratio}: {errors:?}");
    }
}

#[test]
fn an_ellipse_at_every_ratio() {
    for ratio in RATIOS {
        let [errors] = errors(SQUARE, &[Droplet::ellipse(ratio)])[..] else { unreachable!() };
        assert!(errors[1].speed < 3e-3 && errors[1].maximum < 3e-3, "{ratio}: {errors:?}");
        let [speed, rms] = orders(&errors);
        assert!(speed > 1.8 && rms > 1.8, "{ratio}: {speed} {rms} {errors:?}");
    }
}

/// What Cowley's way is kept for: it is of first order, and its errors grow with the ratio.
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

/// What the contrast adds to the mean pressure gradient that keeps the flux at zero.
#[test]
fn the_mean_pressure_gradient_is_that_of_the_contrast() {
    let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroFlux };
    let gradient = |method: Method, spacing: f64, ratio: f64| {
        let mut markers = Markers::new();
        Droplet::ellipse(ratio).at(0.1, 0.2).push_even(spacing, &mut markers).unwrap();
        flow(region, method, 1.0, 1e-10).unwrap().velocities(&mut markers).unwrap().mean_pressure_gradient[0]
    };
    let integral = Method::Integral(IntegralMethod { nodes: 128, cells: 512 });
    for ratio in [0.05, 20.0] {
        let exact = gradient(integral, 0.0125, ratio);
        let errors =
            SPACINGS.map(|h| (gradient(Method::Grid(GridMethod::of_spacing(h)), 0.5 * h, ratio) - exact).abs());
        // The contrast changes it by more than that.
        let change = (gradient(integral, 0.0125, 1.0) - exact).abs();
        assert!(errors[2] < 1e-3 * change && order(&SPACINGS, &errors) > 1.9, "{ratio}: {errors:?} {exact} {change}");
    }
}

/// One and a half cells of the middle spacing from a wall.
#[test]
fn beside_a_wall() {
    let height = 1.5 - 0.075 - 1.0 / 1.3;
    let droplet = Droplet::ellipse(100.0).at(0.1, height);
    let [errors] = errors(open_channel(6.0, 3.0), &[droplet])[..] else { unreachable!() };
    assert!(errors[1].speed < 0.01 && errors[1].rms < 0.01, "{errors:?}");
    assert!(orders(&errors).iter().all(|order| *order > 1.8), "{errors:?}");
}

/// The gap is one and a half cells of the middle spacing.
#[test]
fn two_droplets_close_to_each_other() {
    let droplets = [Droplet::circle(1, 10.0).at(-1.0375, 0.02), Droplet::circle(1, 100.0).at(1.0375, -0.01)];
    for errors in errors(SQUARE, &droplets) {
        assert!(errors[1].speed < 3e-3 && errors[1].rms < 3e-3, "{errors:?}");
        assert!(orders(&errors).iter().all(|order| *order > 1.7), "{errors:?}");
    }
}

/// The forces of the interface of equal viscosity push the droplet around: that part must not be removed with the
/// droplet's own net force.
#[test]
fn beside_an_interface_of_equal_viscosity() {
    for gap in [0.5, 0.075] {
        let x = 1.0 + 0.5 * gap;
        let droplets = [Droplet::circle(1, 100.0).at(-x, 0.02), Droplet::circle(1, 1.0).at(x, -0.01)];
        let all = errors(SQUARE, &droplets);
        for errors in &all {
            assert!(errors[1].speed < 3e-3 && errors[1].rms < 3e-3, "{gap}: {errors:?}");
            assert!(orders(errors)[1] > 1.7, "{gap}: {errors:?}");
        }
        assert!(orders(&all[0])[0] > 1.7 && all[1][1..].iter().all(|e| e.speed < 1e-3), "{gap}: {all:?}");
    }
}

#[test]
fn a_thin_and_a_thick_droplet_in_a_channel() {
    let droplets = [Droplet::circle(1, 0.01).at(-1.25, 0.2), Droplet::circle(1, 1000.0).at(1.25, -0.1)];
    for errors in errors(open_channel(8.0, 3.0), &droplets) {
        assert!(errors[1].speed < 3e-3 && errors[1].rms < 3e-3, "{errors:?}");
        assert!(orders(&errors).iter().all(|order| *order > 1.7), "{errors:?}");
    }
}

/// Its errors are of second order at any distance from the interface, on both sides, and do not grow with the ratio.
#[test]
fn the_flow_beside_the_markers() {
    for region in [SQUARE, open_channel(6.0, 4.0)] {
        for ratio in [0.01, 10.0, 1000.0] {
            let droplet = Droplet::ellipse(ratio).at(0.02, 0.03);
            let [coarse, middle, fine] = SPACINGS.map(|h| field_errors(region, &droplet, h).unwrap());
            for (class, ((coarse, middle), fine)) in coarse.iter().zip(&middle).zip(&fine).enumerate() {
                let velocities = [coarse, middle, fine].map(|errors| errors.velocity);
                let [both, last] = [velocities[0] / velocities[2], velocities[1] / velocities[2]];
                assert!(both > 7.0 && last > 2.3, "{region:?} {ratio} {class}: {velocities:?}");
                assert!(velocities[0] < 0.0135 && velocities[2] < 1.1e-3, "{region:?} {ratio} {class}: {velocities:?}");
                assert!(
                    fine.pressure < 0.01 && fine.pressure < coarse.pressure,
                    "{region:?} {ratio} {class}: {fine:?}"
                );
                assert!(fine.gradient < if class < 2 { 0.15 } else { 0.01 }, "{region:?} {ratio} {class}: {fine:?}");
            }
        }
    }
}

/// Points of a solid, say, move with the flow of a droplet of another viscosity, however close they are to it and
/// however many.
#[test]
fn other_markers_move_with_the_flow() {
    for (ratio, h, bound) in [(0.01, 0.05, 4.5e-3), (1000.0, 0.05, 3e-3), (0.01, 0.025, 2e-3)] {
        let cells = (6.0_f64 / h).round() as usize;
        let grid = Grid::periodic(cells, cells, h).unwrap().with_origin([-3.0; 2]).unwrap();
        let mut flow = ImmersedBoundary::new(PeriodicStokes::new(grid, 1.0).unwrap(), CubicQuadratic::default());
        let mut markers = Markers::new();
        Droplet::ellipse(ratio).push_even(0.5 * h, &mut markers).unwrap();
        let droplet = markers.len();
        let places: Vec<Vec2> = (0..60)
            .map(|k| (k, f64::from(k) * 0.7))
            .map(|(k, t): (i32, f64)| {
                let distance = 0.01 * f64::from(k) - 0.1;
                Vec2::new((1.3 + distance) * t.cos(), (1.0 / 1.3 + distance) * t.sin())
            })
            .collect();
        markers.push_group(places.len(), MarkerKind::Points);
        markers.positions_mut()[droplet..].copy_from_slice(&places);
        flow.velocities(&mut markers).unwrap();
        let largest = markers.velocities()[..droplet].iter().map(|v| v.length()).fold(0.0, f64::max);
        let exact = exact_flow(SQUARE, &Droplet::ellipse(ratio), &places).unwrap();
        let worst = |found: &mut dyn Iterator<Item = Vec2>| {
            found.zip(&exact).map(|(found, exact)| (found - exact).length() / largest).fold(0.0, f64::max)
        };
        let moved = worst(&mut markers.velocities_mut()[droplet..].iter().copied());
        assert!(moved < bound, "{ratio}, {h}: {moved}");
        let solves = flow.work().stokes_solves;
        assert!(solves <= 12, "{solves} solves from nothing");
        // A sample is of the same flow.
        let mut samples = vec![FlowSample::default(); places.len()];
        flow.sample(&markers, &places, &mut samples).unwrap();
        let sampled = worst(&mut samples.iter().map(|sample| sample.velocity));
        assert!(sampled < bound, "{ratio}, {h}: {sampled}");
        let before = flow.work().stokes_solves;
        for _ in 0..3 {
            flow.velocities(&mut markers).unwrap();
        }
        let allocated = measure(|| assert!(flow.velocities(&mut markers).is_ok()));
        assert_eq!(allocated.count_total, 0);
        assert!(flow.work().stokes_solves - before <= 12, "a solve for the forces and one for the flow each");
    }
}

#[test]
fn an_ellipse_relaxes() {
    let coarse = relaxation::run_with_ratio(0.1, 0.05, 10).unwrap();
    let fine = relaxation::run_with_ratio(0.05, 0.02, 10).unwrap();
    assert!(coarse.aspect_ratio_error.abs() < 1e-3 && fine.aspect_ratio_error.abs() < 2e-4, "{coarse:?} {fine:?}");
    assert!(fine.area_change.abs() < 1e-6, "{fine:?}");
}

/// A droplet of activity -1 and a viscosity, with A = 2, in fluid of viscosity 10.
fn swimmer(viscosity: f64, h: f64) -> Setup {
    let droplet = DropletSetup { viscosity: Some(viscosity), ..DropletSetup::default() };
    reference(Setup { viscosity: 10.0, droplets: vec![droplet], ..on_grid(h) }, -1.0)
}

#[test]
fn a_steady_swimmer() {
    let errors = steady(&swimmer(100.0, 0.05), 40.0).unwrap();
    assert!(errors.speed.abs() < 3e-3, "{errors:?}");
    assert!(errors.area_change.abs() < 1e-5, "{errors:?}");
}

/// From exact theory: this droplet decays to rest.
#[test]
fn a_stiff_droplet_of_little_activity_stops() {
    let speeds = speeds(&swimmer(1000.0, 0.1), &[20.0, 40.0]).unwrap();
    assert!(speeds[1] < 0.8 * speeds[0], "{speeds:?}");
}

#[test]
fn work_is_counted_and_nothing_is_allocated() {
    let mut scene = swimmer(10.0, 0.1).build().unwrap().scene;
    (0..3).for_each(|_| scene.step(0.01).unwrap());
    let work = scene.system().hydrodynamics().work();
    // Two evaluations a step, and that of the state the last one led to.
    assert_eq!((work.iterations, work.stokes_solves, work.evaluations), (0, 7, 7));

    let mut scene = swimmer(1000.0, 0.1).build().unwrap().scene;
    (0..3).for_each(|_| scene.step(0.01).unwrap());
    let before = scene.system().hydrodynamics().work();
    assert_eq!((before.stokes_solves, before.evaluations), (7, 7));
    assert_eq!(measure(|| (0..10).for_each(|_| scene.step(0.01).unwrap())).count_total, 0);
    let after = scene.system().hydrodynamics().work();
    let iterations = (after.iterations - before.iterations) as f64 / (after.evaluations - before.evaluations) as f64;
    assert!((1.0..20.0).contains(&iterations), "{iterations} iterations an evaluation");
}

#[test]
fn viscosities_are_checked() {
    let mut flow = ImmersedBoundary::new(
        PeriodicStokes::new(Grid::periodic(32, 32, 0.1).unwrap(), 1.0).unwrap(),
        CubicQuadratic::default(),
    );
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let mut markers = Markers::new();
        markers.push_group(16, MarkerKind::Interface { viscosity_inside: Some(value) });
        let found = flow.velocities(&mut markers);
        assert!(matches!(found, Err(FlowError::Input(InputError::NotPositive { .. }))), "{value}: {found:?}");
    }
    // All markers at one point: no area.
    let mut markers = Markers::new();
    markers.push_group(16, MarkerKind::Interface { viscosity_inside: Some(2.0) });
    assert!(matches!(flow.velocities(&mut markers), Err(FlowError::Unsupported { .. })));
}

/// Not the small difference of large numbers: the error of the stresslet falls with h and does not grow with the ratio.
#[test]
fn the_stresslet_at_every_ratio() {
    let channel = open_channel(5.0, 3.0);
    let scenes = [
        (SQUARE, vec![Droplet::ellipse(300.0)]),
        (SQUARE, vec![Droplet::ellipse(0.05).turned(1.0)]),
        (SQUARE, vec![Droplet::circle(2, 300.0)]),
        (channel, vec![Droplet::ellipse(300.0).turned(0.7)]),
        (channel, vec![Droplet::circle(2, 0.05).turned(0.7)]),
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
        let all = SPACINGS.map(|h| exact.stresslet_errors(h).unwrap());
        for (k, droplet) in droplets.iter().enumerate() {
            let (errors, of_moments) = (all.each_ref().map(|e| e[k].observed), all.each_ref().map(|e| e[k].of_moments));
            assert!(order(&SPACINGS, &errors) > 1.9, "{droplet:?}: {errors:?}");
            assert!(errors[0] < 1.5e-2 && errors[1] < 4e-3, "{droplet:?}: {errors:?}");
            if droplet.ratio <= 1.0 {
                assert_eq!(errors, of_moments);
            } else if droplets.len() == 1 {
                assert!(errors[1] < 0.05 * of_moments[1], "{droplet:?}: {errors:?} {of_moments:?}");
            }
        }
    }
}

/// Where viscosities become equal nothing jumps.
#[test]
fn the_stresslet_of_almost_equal_viscosities() {
    let observed = |ratio: f64| {
        let exact = Exact::new(SQUARE, &[Droplet::ellipse(ratio).turned(0.7)], 64).unwrap();
        exact.stresslet_errors(0.1).unwrap()[0].observed
    };
    let equal = observed(1.0);
    for ratio in [1.0 - 1e-6, 1.0 + 1e-6] {
        assert!((observed(ratio) - equal).abs() < 1e-5, "{ratio}: {} {equal}", observed(ratio));
    }
}
