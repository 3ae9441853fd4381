use std::f64::consts::TAU;

use motile_base::TubeShape;

use super::*;
use stokes_boundary_integrals::TensionPlacement;

/// Closed curve of a meridian `(x, r)` of t with its mirror image.
fn closed(count: usize, meridian: impl Fn(f64) -> (f64, f64)) -> Vec<Vec2> {
    let angle = |k: usize| TAU * k as f64 / count as f64;
    let mut points: Vec<Vec2> = (0..count).map(|k| meridian(angle(k))).map(|(x, r)| Vec2::new(x, r)).collect();
    (points[0].y, points[count / 2].y) = (0.0, 0.0);
    points
}

fn sphere(count: usize) -> Vec<Vec2> {
    closed(count, |t| (t.cos(), t.sin()))
}

fn flow(nodes: usize) -> AxisymmetricFlow {
    AxisymmetricFlow::new(1.0, Settings { nodes, ..Settings::default() }).unwrap()
}

/// Forces at the points of force densities `f(t)` per area on a sphere.
fn on_sphere(count: usize, f: impl Fn(f64) -> Vec2) -> Vec<Vec2> {
    (0..count)
        .map(|k| {
            let t = TAU * k as f64 / count as f64;
            let force = TAU * PI / count as f64 * t.sin() * f(t);
            if 2 * k > count { Vec2::new(-force.x, -force.y) } else { force }
        })
        .collect()
}

fn tensions(points: &[Vec2], gamma: impl Fn(f64) -> f64) -> Vec<Vec2> {
    let count = points.len();
    let values: Vec<f64> = (0..count).map(|k| gamma(TAU * k as f64 / count as f64)).collect();
    let mut forces = vec![Vec2::ZERO; count];
    MeridianCalculus::new(count)
        .unwrap()
        .tension_forces(points, &values, TensionPlacement::Points, &mut forces)
        .unwrap();
    forces
}

fn velocities(flow: &AxisymmetricFlow, surface: usize, count: usize) -> Vec<Vec2> {
    let mut out = vec![Vec2::ZERO; count];
    flow.velocities(surface, &mut out).unwrap();
    out
}

const RATIOS: [f64; 5] = [0.01, 0.1, 1.0, 10.0, 100.0];

/// `INT T n dS = -4 pi` on a surface: the double layer of a translation, for a sphere and a pear.
#[test]
fn double_layer_of_a_translation_is_its_jump() {
    let pear = |t: f64| {
        let radius = 1.0 + 0.2 * t.cos() + 0.1 * (3.0 * t).cos();
        (radius * t.cos(), radius * t.sin())
    };
    let errors = [32, 64, 96].map(|nodes| {
        let points = closed(nodes, pear);
        let mut flow = flow(nodes);
        let forces = vec![Vec2::ZERO; nodes];
        flow.load([Interface::closed(&points, &forces, [2.0, 1.0])].into_iter()).unwrap();
        let n = nodes / 2;
        (flow.right, flow.matrix) = (DVector::zeros(2 * n), DMatrix::zeros(2 * n, 2 * n));
        flow.add_pairs();
        let of_translation = flow.matrix.column(0);
        let error = |j: usize| (of_translation[j] + 4.0 * PI).abs().max(of_translation[n + j].abs());
        (0..n).map(error).fold(0.0, f64::max)
    });
    assert!(errors.iter().all(|error| *error < 1e-12), "{errors:?}");
}

/// Hadamard and Rybczynski: a drop with the load f = e_x/(4 pi) per area, a force of one, moves at
/// `(eta_in + eta_ext)/(2 pi eta_ext (2 eta_ext + 3 eta_in))`, here divided by the normal load alone; Marangoni: the
/// tension gamma0 + g cos moves it at `-2 g/(3 (2 eta_ext + 3 eta_in))`.
#[test]
fn drops_settle_and_swim_at_their_exact_speeds() {
    let count = 64;
    let points = sphere(count);
    let shape = |t: f64| Vec2::new(t.cos(), t.sin());
    let (mut settling, mut marangoni) = (Vec::new(), Vec::new());
    for ratio in RATIOS {
        let mut flow = flow(count);
        let load = on_sphere(count, |t| 3.0 / (2.0 * TAU) * t.cos() * shape(t));
        flow.load([Interface::closed(&points, &load, [ratio, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        let exact = (ratio + 1.0) / (TAU * (2.0 + 3.0 * ratio));
        settling.push((velocities(&flow, 0, count)[0].x / exact - 1.0).abs());

        let g = 0.5;
        let forces = tensions(&points, |t| 1.0 + g * t.cos());
        flow.load([Interface::closed(&points, &forces, [ratio, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        let speed = -2.0 * g / (3.0 * (2.0 + 3.0 * ratio));
        let surface = -(speed + g / (2.0 + 3.0 * ratio));
        let errors = velocities(&flow, 0, count).into_iter().enumerate().map(|(k, u)| {
            let t = TAU * k as f64 / count as f64;
            let u_theta = u.dot(shape(t).perp());
            (u.dot(shape(t)) - speed * t.cos()).abs().max((u_theta - surface * t.sin()).abs())
        });
        marangoni.push(errors.fold(0.0, f64::max) / speed.abs());
    }
    assert!(settling.iter().chain(&marangoni).all(|error| *error < 1e-12), "{settling:?} {marangoni:?}");
}

/// Velocities on a fixed spheroid, `x = 1.3 cos t`, of the tension exp(cos t): u_x at t = 0, pi/4, ..., pi and u_r at
/// pi/4, pi/2, 3 pi/4 from `axisymmetric_fixed_shapes.csv`, computed by another program to some 1e-12.
#[test]
fn velocities_on_a_spheroid_are_the_independent_ones_with_spectral_order() {
    let reference = [
        (
            1.0,
            [-0.321567228398753, -0.0470391285575312, 0.0455103405493707, 0.0184099921422823, 0.0173513809811626],
            [-0.0764756310276157, 0.053613430400907, 0.0473753658935238],
        ),
        (
            10.0,
            [-0.0572245192154756, -0.0116679917175824, 0.00679786063804396, 0.00769244833463978, 0.00966961424135847],
            [-0.00688870760149047, 0.010077673529866, 0.00658119545716612],
        ),
        (
            0.1,
            [-0.0699521158309059, -0.00824200108398138, 0.0131202015970868, -0.00149148204571282, -0.00714020845618032],
            [-0.0275561287370688, 0.0107901801095036, 0.0166979812454954],
        ),
    ];
    for (ratio, along, across) in reference {
        let errors = [24, 48, 96].map(|count| {
            let points = closed(count, |t| (1.3 * t.cos(), t.sin() / 1.3f64.sqrt()));
            let forces = tensions(&points, |t| t.cos().exp());
            let outside = if ratio < 1.0 { 10.0 } else { 1.0 };
            let settings = Settings { nodes: count, ..Settings::default() };
            let mut flow = AxisymmetricFlow::new(outside, settings).unwrap();
            flow.load([Interface::closed(&points, &forces, [ratio * outside, outside])].into_iter()).unwrap();
            flow.solve().unwrap();
            let u = velocities(&flow, 0, count);
            let x = (0..5).map(|k| (u[k * count / 8].x - along[k]).abs());
            let r = (1..4).map(|k| (u[k * count / 8].y - across[k - 1]).abs());
            x.chain(r).fold(0.0, f64::max)
        });
        assert!(errors[1] < 1e-3 * errors[0] && errors[2] < 1e-3 * errors[1], "ratio {ratio}: {errors:?}");
        assert!(errors[2] < 1e-11, "ratio {ratio}: {errors:?}");
    }
}

/// Stokes' sphere: velocity, pressure and gradient of the flow around it, at any distance from the surface.
#[test]
fn flow_around_a_sphere_is_that_of_stokes_at_any_distance() {
    let count = 64;
    let points = sphere(count);
    let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
    let mut flow = flow(count);
    flow.load([Interface::rigid(&points, &forces, 1.0)].into_iter()).unwrap();
    flow.solve().unwrap();
    assert!((flow.rigid_velocity(0).unwrap() - 1.0).abs() < 1e-13);
    for (distance, tolerance) in [(3.0, 1e-12), (0.4, 1e-12), (0.02, 1e-11), (1e-6, 1e-8)] {
        for t in [0.0, 0.03, 0.7, 1.9, 3.1, -2.0] {
            let r = 1.0 + distance;
            let place = r * Vec2::from_angle(t);
            let mut sample = [FlowSample::default()];
            flow.sample(&[place], &mut sample).unwrap();
            let velocity = |x: Vec2| {
                let r = x.length();
                let a = 0.75 / r + 0.25 / r.powi(3);
                let b = (0.75 / r - 0.75 / r.powi(3)) * x.x / (r * r);
                Vec2::new(a, 0.0) + b * x
            };
            let error = (sample[0].velocity - velocity(place)).length();
            assert!(error < tolerance, "velocity at {place:?}: {error:e}");
            let error = (sample[0].pressure - 1.5 * place.x / r.powi(3)).abs();
            assert!(error < tolerance, "pressure at {place:?}: {error:e}");
            let h = 1e-3;
            for k in 0..2 {
                let at =
                    |s: f64| velocity(place + s * h * if k == 0 { Vec2::new(1.0, 0.0) } else { Vec2::new(0.0, 1.0) });
                let slope =
                    (45.0 * (at(1.0) - at(-1.0)) - 9.0 * (at(2.0) - at(-2.0)) + at(3.0) - at(-3.0)) / (60.0 * h);
                for (j, exact) in [slope.x, slope.y].into_iter().enumerate() {
                    let error = (sample[0].gradient[j][k] - exact).abs();
                    assert!(error < 10.0 * tolerance.max(1e-11), "gradient {j}{k} at {place:?}: {error:e}");
                }
            }
        }
    }
}

/// Two spheres that fall along their line of centres: the drag factor of Stimson and Jeffery (Proc. R. Soc. A 111,
/// 1926) for a gap over the radius.
fn stimson_jeffery(gap: f64) -> f64 {
    let alpha = (1.0 + 0.5 * gap).acosh();
    let sum: f64 = (1..2000)
        .map(|n| {
            let n = f64::from(n);
            let m = 2.0 * n + 1.0;
            // Divided by exp(m alpha), which overflows.
            let down = (-m * alpha).exp();
            let top = 0.5 * (1.0 - down).powi(2) * 2.0 - 0.5 * (m * alpha.sinh()).powi(2) * 2.0 * down;
            let bottom = (1.0 - down * down) + m * (2.0 * alpha).sinh() * down;
            n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (1.0 - top / bottom)
        })
        .sum();
    4.0 / 3.0 * alpha.sinh() * sum
}

#[test]
fn two_spheres_fall_at_their_exact_speed_however_close() {
    for (gap, count) in [(2.0, 48), (0.5, 64), (0.1, 128), (0.02, 192)] {
        let spheres = [1.0, -1.0].map(|side| {
            let centre = side * (1.0 + 0.5 * gap);
            closed(count, |t| (centre + t.cos(), t.sin()))
        });
        let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
        let mut flow = flow(count);
        flow.load(spheres.iter().map(|points| Interface::rigid(points, &forces, 1.0))).unwrap();
        flow.solve().unwrap();
        let speeds = [0, 1].map(|k| flow.rigid_velocity(k).unwrap());
        let exact = 1.0 / stimson_jeffery(gap);
        let error = speeds.iter().map(|speed| (speed / exact - 1.0).abs()).fold(0.0, f64::max);
        assert!(error < 1e-10, "gap {gap}: {error:e}");
    }
}

/// Drag factors in a tube without flux: by multipoles of the sphere, and Bessel functions and waves along the tube for
/// what they cause, in 60 digits, with residuals of the condition on the sphere below 1e-13; `axisymmetric.csv` has
/// them to 2e-8.
#[test]
fn drag_of_a_sphere_in_a_tube_is_that_of_the_literature() {
    let count = 48;
    let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
    for (radius, factor) in [(0.1, 1.2632139053), (0.3, 2.3700948902), (0.5, 5.9473742458)] {
        let wall = 1.0 / radius;
        let mut flow = flow(count).with_tube(wall).unwrap();
        flow.load([Interface::rigid(&sphere(count), &forces, 1.0)].into_iter()).unwrap();
        flow.solve().unwrap();
        let error = 1.0 / flow.rigid_velocity(0).unwrap() / factor - 1.0;
        assert!(error.abs() < 1e-8, "radius {radius}: {error:e}");
    }
}

/// Drag of a sphere of .9 of a tube's radius against the formula of Bungay and Brenner (International Journal of
/// Multiphase Flow 1, 25, 1973), their lubrication series joined to wide tubes, which errs by 1e-3 or so in between;
/// half as many nodes change it by less than 1e-6.
#[test]
fn drag_of_a_sphere_that_fits_closely_is_that_of_bungay_and_brenner() {
    let (ratio, gap) = (0.9_f64, 0.1_f64);
    let [drag, coarse] = [128, 64].map(|count| {
        let mut flow = flow(count).with_tube(1.0 / ratio).unwrap();
        let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
        flow.load([Interface::rigid(&sphere(count), &forces, 1.0)].into_iter()).unwrap();
        flow.solve().unwrap();
        1.0 / flow.rigid_velocity(0).unwrap()
    });
    let series = 1.0 - 73.0 / 60.0 * gap + 77293.0 / 50400.0 * gap * gap;
    let wide = [-22.5083, -5.6117, -0.3363, -1.216, 1.647].into_iter().rev().fold(0.0, |sum, a| a + ratio * sum);
    let literature = (2.25 * PI * PI * 2.0_f64.sqrt() * gap.powf(-2.5) * series + wide) / (6.0 * PI);
    let error = drag / literature - 1.0;
    assert!(error.abs() < 5e-4, "{drag} against {literature}: {error:e}");
    assert!((coarse / drag - 1.0).abs() < 1e-6, "{coarse} {drag}");
}

/// No flow on the wall, none through a section; and the net force on the drop, zero, is that on the wall.
#[test]
fn a_drop_with_another_viscosity_meets_the_conditions_on_a_tube() {
    let count = 64;
    let points = sphere(count);
    let forces = tensions(&points, |t| 1.0 + 0.5 * t.cos());
    for (ratio, speed) in [(1.0, -0.051_647_950_76), (10.0, -0.008_215_588_674_6)] {
        let mut flow = flow(count).with_tube(2.0).unwrap();
        flow.load([Interface::closed(&points, &forces, [ratio, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        // Mean velocity over the volume: INT x u.n dS over the volume.
        let u = velocities(&flow, 0, count);
        let grid = Grid::new(count / 2);
        let half = Half::new(count / 2);
        let mut series = Pair::new(count / 2 + 1);
        half.analyse(count / 2, |k| (u[k].x, u[k].y), &mut series);
        let mean: f64 = (0..count / 2)
            .map(|j| {
                let (t, waves) = (grid.parameters[j], &grid.waves[j]);
                let flux =
                    waves::dot(&series.cos, &waves.cos) * t.cos() + waves::dot(&series.sin, &waves.sin) * t.sin();
                grid.weights[j] * 1.5 * t.cos() * flux * t.sin()
            })
            .sum();
        assert!((mean / speed - 1.0).abs() < 1e-7, "ratio {ratio}: {mean}");
        for x in [0.3, 3.0] {
            let mut sample = [FlowSample::default(); 2];
            flow.sample(&[Vec2::new(x, 2.0 - 1e-9), Vec2::new(x, 1.7)], &mut sample).unwrap();
            assert!(sample[0].velocity.length() < 1e-7 * speed.abs(), "at the wall: {:?}", sample[0].velocity);
        }
    }
}

/// A ratio of viscosities of 1e4 or 1e-4 keeps volume and speed; a bubble's limit is regular.
#[test]
fn extreme_ratios_of_viscosities_lose_few_digits() {
    let count = 64;
    let points = sphere(count);
    let forces = tensions(&points, |t| 1.0 + 0.5 * t.cos());
    for ratio in [1e-4, 1e4] {
        let mut flow = flow(count);
        flow.load([Interface::closed(&points, &forces, [ratio, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        let exact = -1.0 / (3.0 * (2.0 + 3.0 * ratio));
        let error = velocities(&flow, 0, count)[0].x / exact - 1.0;
        assert!(error.abs() < 1e-9, "ratio {ratio}: {error:e}");
    }
}

#[test]
fn points_that_are_no_meridian_are_refused() {
    let none = vec![Vec2::ZERO; 64];
    let mut flow = flow(64);
    let mut load = |points: &[Vec2]| {
        flow.load([Interface::closed(points, &none[..points.len()], [1.0, 1.0])].into_iter()).map_err(|e| e.to_string())
    };
    let off_axis: Vec<Vec2> = sphere(64).iter().map(|x| *x + Vec2::new(0.0, 0.1)).collect();
    assert!(load(&off_axis).unwrap_err().contains("mirror image"));
    let clockwise: Vec<Vec2> = sphere(64).iter().map(|x| Vec2::new(x.x, -x.y)).collect();
    assert!(load(&clockwise).unwrap_err().contains("clockwise"));
    let neck = |waist: f64| closed(64, |t| (1.5 * t.cos(), t.sin() * (t.cos().powi(2) + waist)));
    assert!(load(&neck(0.05)).is_ok());
    assert!(load(&neck(-0.05)).unwrap_err().contains("meets the axis between its poles, at x = "));
    assert!(load(&sphere(32)).unwrap_err().contains("Use a number from 64"));
    let mut nan = sphere(64);
    nan[3].x = f64::NAN;
    assert!(load(&nan).unwrap_err().contains("finite"));
    assert!(tube(|_| -1.0, 5.0, 100).is_err());
    let wall = tube(|_| 1.5, 6.0, 400).unwrap();
    let mut flow = AxisymmetricFlow::new(1.0, Settings::default()).unwrap().with_container(&wall, 128).unwrap();
    let large = closed(64, |t| (1.6 * t.cos(), 1.6 * t.sin()));
    let error = flow.load([Interface::closed(&large, &none, [1.0, 1.0])].into_iter()).unwrap_err();
    assert!(error.to_string().contains("beyond"), "{error}");
}

/// Lubrication in the annulus: with the gap e = 1 - radius/tube radius the drag factor is `(3 pi sqrt(2)/8) e^(-5/2)`
/// to leading order, with corrections of the order of e.
#[test]
fn drag_in_a_tight_tube_is_that_of_lubrication() {
    let count = 128;
    let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
    let errors = [0.05, 0.025].map(|gap: f64| {
        let mut flow = flow(count).with_tube(1.0 / (1.0 - gap)).unwrap();
        let shifted: Vec<Vec2> = sphere(count).iter().map(|x| *x + Vec2::new(7.3, 0.0)).collect();
        flow.load([Interface::rigid(&shifted, &forces, 1.0)].into_iter()).unwrap();
        flow.solve().unwrap();
        let leading = 3.0 * PI * 2.0f64.sqrt() / 8.0 * gap.powf(-2.5);
        1.0 / flow.rigid_velocity(0).unwrap() / leading - 1.0
    });
    let order = (errors[0] / errors[1]).log2();
    assert!(errors[0].abs() < 0.06 && (order - 1.0).abs() < 0.15, "{errors:?}, order {order}");
}

/// Disturbances of order 0 against central differences of the solution itself, for a pear at ratios 1 and 10, in space
/// and in a tube.
#[test]
fn disturbances_are_the_derivatives_of_the_flow() {
    let count = 64;
    let pear = |shift: f64| {
        closed(count, |t| {
            let radius = 1.0 + 0.15 * t.cos() + shift * (0.4 * (2.0 * t).cos() + 0.2 * (3.0 * t).cos());
            (radius * t.cos() + shift * 0.3 * t.cos().powi(2), radius * t.sin())
        })
    };
    for (ratio, tube) in [(1.0, None), (10.0, None), (10.0, Some(1.8))] {
        let at = |shift: f64| {
            let mut flow = flow(count);
            if let Some(radius) = tube {
                flow = flow.with_tube(radius).unwrap();
            }
            let points = pear(shift);
            let forces = tensions(&points, |t| (t.cos() * (0.7 + shift)).exp());
            flow.load([Interface::closed(&points, &forces, [ratio, 1.0])].into_iter()).unwrap();
            flow.solve().unwrap();
            (points, forces, velocities(&flow, 0, count), flow)
        };
        let (_, _, _, mut flow) = at(0.0);
        let disturbances = flow.disturbances(0).unwrap();
        let h = 1e-4;
        let ((p, f, u, _), (q, g, v, _)) = (at(h), at(-h));
        let slope = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (*a - *b) / (2.0 * h)).collect::<Vec<_>>();
        let mut out = vec![Vec2::ZERO; count];
        disturbances.velocities_at_points(&slope(&p, &q), &slope(&f, &g), &mut out).unwrap();
        let largest = u.iter().map(|u| u.length()).fold(0.0, f64::max);
        let error = slope(&u, &v).iter().zip(&out).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max) / largest;
        assert!(error < 1e-7, "ratio {ratio}, tube {tube:?}: {error:e}");
    }
    let mut flow = flow(count);
    assert!(flow.disturbances(0).unwrap_err().to_string().contains("one"));
}

#[test]
fn volume_and_area_of_a_sphere() {
    let mut flow = flow(32);
    let (points, forces) = (sphere(32), vec![Vec2::ZERO; 32]);
    flow.load(std::iter::once(Interface::closed(&points, &forces, [1.0; 2]))).unwrap();
    let [volume, area] = flow.measures(0).unwrap();
    assert!((volume - 2.0 / 3.0 * TAU).abs() < 1e-12 && (area - 2.0 * TAU).abs() < 1e-12, "{volume} {area}");
    assert_eq!(flow.measures(1), None);
}

/// A free sphere in the flow of Poiseuille; the pressure that a drop adds, by the reciprocal theorem and far from it; a
/// prescribed pressure gradient.
#[test]
fn tubes_are_driven_by_flux_or_pressure() {
    // Faxen's law, which walls correct by the fifth power of the ratio: the stresslet's flow falls with the square, and
    // the shear that makes it and the one that it meets again grow with the place.
    let count = 48;
    let none = vec![Vec2::ZERO; count];
    let errors = [0.1_f64, 0.05].map(|ratio| {
        let mut tube = flow(count).with_tube(1.0 / ratio).unwrap().with_drive(Drive::Flux(2.0), f64::INFINITY).unwrap();
        tube.load([Interface::rigid(&sphere(count), &none, 1.0)].into_iter()).unwrap();
        tube.solve().unwrap();
        let largest = 2.0 * 2.0 * ratio * ratio / PI;
        tube.rigid_velocity(0).unwrap() / (largest * (1.0 - 2.0 / 3.0 * ratio * ratio)) - 1.0
    });
    let order = (errors[0] / errors[1]).log2();
    assert!(errors[0].abs() < 2e-5 && order > 4.5, "{errors:?}, order {order}");

    let points = closed(64, |t| (0.9 * t.cos(), 0.7 * t.sin()));
    let forces = tensions(&points, |t| 1.0 + 0.5 * t.cos());
    let radius = 1.5;
    for drive in [Drive::ZeroFlux, Drive::Flux(0.3), Drive::ZeroGradient, Drive::Gradient(-0.7)] {
        let length = 12.0;
        let mut flow = flow(64).with_tube(radius).unwrap().with_drive(drive, length).unwrap();
        flow.load([Interface::closed(&points, &forces, [5.0, 1.0])].into_iter()).unwrap();
        flow.solve().unwrap();
        let mut samples = [FlowSample::default(); 2];
        flow.sample(&[Vec2::new(-5.0, 0.3), Vec2::new(5.0, 0.3)], &mut samples).unwrap();
        let resistance = 8.0 * flow.flux() / (PI * radius.powi(4));
        let rise = samples[1].pressure - samples[0].pressure - resistance * (length - 10.0);
        // Far from the drop the flow is Poiseuille's.
        let [speed, slope] =
            [2.0 * (1.0 - 0.04) / radius.powi(2), -4.0 * 0.3 / radius.powi(4)].map(|u| u * flow.flux() / PI);
        for sample in samples {
            let errors = [sample.velocity.x - speed, sample.velocity.y, sample.gradient[0][1] - slope];
            assert!(errors.iter().all(|error| error.abs() < 2e-6), "{drive:?}: {errors:?}");
        }
        let gradient = flow.pressure_gradient().unwrap();
        assert!((gradient * length - rise).abs() < 2e-6, "{drive:?}: {gradient} {rise}");
        if drive.flux().is_none() {
            assert!((gradient - drive.gradient()).abs() < 1e-12, "{drive:?}: {gradient}");
        }
        assert!(drive.flux().is_none_or(|flux| (flux - flow.flux()).abs() == 0.0));
    }
    assert!(flow(64).with_drive(Drive::Flux(1.0), 1.0).is_err());
    let points = sphere(64);
    let forces = vec![Vec2::ZERO; 64];
    let mut short = flow(64).with_tube(1.5).unwrap().with_drive(Drive::ZeroGradient, 3.4).unwrap();
    let error = short.load([Interface::closed(&points, &forces, [1.0, 1.0])].into_iter()).unwrap_err();
    assert!(error.to_string().contains("at least 3.49"), "{error}");
}

/// A tube of a shape with a flux: Poiseuille's flow at its ends, no slip at its throat, and the flux through it.
#[test]
fn flux_goes_through_a_constriction() {
    let shape = TubeShape::Constriction { throat: 0.6, throat_length: 1.0, ramp: 2.0 };
    let region = Region::Tube { radius: 1.5, shape, drive: Drive::Flux(0.4), length: Some(20.0) };
    let mut flow = AxisymmetricFlow::in_region(region, 2.0, Settings { nodes: 32, ..Settings::default() }).unwrap();
    let drop = closed(32, |t| (-5.0 + 0.05 * t.cos(), 0.05 * t.sin()));
    let forces = vec![Vec2::ZERO; 32];
    flow.load([Interface::closed(&drop, &forces, [2.0, 2.0])].into_iter()).unwrap();
    flow.solve().unwrap();
    for x in [-4.0, 0.0, 2.0] {
        let radius = shape.radius(1.5, 10.0, x);
        // Midpoints in r^2.
        let points: Vec<Vec2> =
            (0..400).map(|k| Vec2::new(x, radius * ((f64::from(k) + 0.5) / 400.0).sqrt())).collect();
        let mut samples = vec![FlowSample::default(); 400];
        flow.sample(&points, &mut samples).unwrap();
        let flux: f64 = samples.iter().map(|sample| sample.velocity.x * PI * radius * radius / 400.0).sum();
        assert!((flux / 0.4 - 1.0).abs() < 1e-5, "flux {flux} at {x}");
    }
    let refused = Region::Tube { radius: 1.5, shape, drive: Drive::ZeroGradient, length: Some(20.0) };
    let error = AxisymmetricFlow::in_region(refused, 2.0, Settings::default()).unwrap_err().to_string();
    assert!(error.contains("Prescribe the flux"), "{error}");
}

/// Finer nodes, which many points share, and panels, which each of a few has for itself, give one flow at any distance
/// from an interface and from the wall of a tube.
#[test]
fn flow_at_many_points_is_that_at_few() {
    let spheroid = closed(96, |t| (1.1 * t.cos(), 0.9 * t.sin()));
    let forces = tensions(&spheroid, |t| 2.0 + t.cos());
    let mut flow = flow(96).with_tube(1.8).unwrap();
    flow.load([Interface::closed(&spheroid, &forces, [5.0, 1.0])].into_iter()).unwrap();
    flow.solve().unwrap();
    let points: Vec<Vec2> = (0..150).map(|k| Vec2::new(0.013 * f64::from(k), 1.799 * f64::from(k) / 149.0)).collect();
    let mut many = vec![FlowSample::default(); points.len()];
    let mut few = many.clone();
    flow.sample(&points, &mut many).unwrap();
    for (points, out) in points.chunks(50).zip(few.chunks_mut(50)) {
        flow.sample(points, out).unwrap();
    }
    for (many, few) in many.iter().zip(&few) {
        let gradients = many.gradient.as_flattened().iter().zip(few.gradient.as_flattened());
        let slope = gradients.map(|(a, b)| (a - b).abs()).fold((many.pressure - few.pressure).abs(), f64::max);
        assert!((many.velocity - few.velocity).length() < 1e-11 && slope < 1e-9, "{many:?} {few:?}");
    }
}

/// The mirror image of a point, to round-off, has the mirror image of its flow, and bit for bit; a point beside it on
/// the same side has its own.
#[test]
fn flow_is_its_own_mirror_image() {
    let spheroid = closed(64, |t| (1.1 * t.cos(), 0.9 * t.sin()));
    let forces = tensions(&spheroid, |t| 2.0 + t.cos());
    let mut flow = flow(64);
    flow.load([Interface::closed(&spheroid, &forces, [1.0, 1.0])].into_iter()).unwrap();
    flow.solve().unwrap();
    let y = 0.05_f64;
    let points = [y, -y - 3e-16, y + 3e-15].map(|y| Vec2::new(2.0, y));
    let mut out = [FlowSample::default(); 3];
    flow.sample(&points, &mut out).unwrap();
    let [point, image, beside] = out;
    let [[xx, xy], [yx, yy]] = point.gradient;
    assert_eq!(image.velocity, Vec2::new(point.velocity.x, -point.velocity.y));
    assert_eq!((image.pressure, image.gradient), (point.pressure, [[xx, -xy], [-yx, yy]]));
    assert_ne!(beside.velocity.y, point.velocity.y);
}

/// Rows in shares: to the same bits by any number of threads, in a tube, of drops with another viscosity.
#[cfg(feature = "rayon")]
#[test]
fn velocities_do_not_depend_on_the_number_of_threads() {
    let points = closed(64, |t| (0.9 * t.cos(), 0.7 * t.sin()));
    let behind: Vec<Vec2> = points.iter().map(|x| *x - Vec2::new(2.0, 0.0)).collect();
    let forces = tensions(&points, |t| 1.0 + 0.5 * t.cos());
    let bits = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut flow = flow(64).with_tube(1.2).unwrap();
            let drops = [&points, &behind].map(|points| Interface::closed(points, &forces, [5.0, 1.0]));
            flow.load(drops.into_iter()).unwrap();
            flow.solve().unwrap();
            let values = [0, 1].map(|surface| velocities(&flow, surface, 64));
            values.map(|values| values.iter().flat_map(|u| [u.x.to_bits(), u.y.to_bits()]).collect::<Vec<_>>())
        })
    };
    let expected = bits(1);
    assert_eq!(bits(2), expected);
    assert_eq!(bits(3), expected);
}

/// Two spheres at a distance of twelve radii of the tube are each alone in it, as are those beside their ends.
#[test]
fn spheres_far_apart_in_a_tube_are_alone() {
    let (count, radius) = (48, 1.5);
    let forces = on_sphere(count, |_| Vec2::new(1.5, 0.0));
    let speeds = |places: &[f64]| -> Vec<f64> {
        let spheres: Vec<Vec<Vec2>> =
            places.iter().map(|x| sphere(count).iter().map(|at| *at + Vec2::new(*x, 0.0)).collect()).collect();
        let mut flow = flow(count).with_tube(radius).unwrap();
        flow.load(spheres.iter().map(|sphere| Interface::rigid(sphere, &forces, 1.0))).unwrap();
        flow.solve().unwrap();
        let [half_length, _] = flow.tube_resolution().unwrap();
        let extent = places.iter().map(|x| x.abs()).fold(0.0, f64::max) + 1.0;
        assert!(half_length >= extent + 5.5 * radius, "{half_length} {extent}");
        (0..places.len()).map(|number| flow.rigid_velocity(number).unwrap()).collect()
    };
    let alone = speeds(&[0.0])[0];
    for speed in speeds(&[-9.0, 9.0]) {
        assert!((speed / alone - 1.0).abs() < 1e-7, "{speed} {alone}");
    }
}
