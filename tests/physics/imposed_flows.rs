//! Drops, capsules and rigid bodies in flows that are imposed from outside, against `tests/reference/imposed_flows.csv`
//! and closed forms.

use std::f64::consts::PI;

use motile::base::{FlowSample, ImposedFlow};
use motile::elastic_solids::BendingMeasure;
use motile::prelude::*;
use motile::scene::checkpoint::Checkpoint;
use motile::scene::integrator::IntegratorKind;
use motile::scene::{Deformation, Hydrodynamics, Imposed};
use motile::setup::{DropletShape, PoiseuilleSetup, RigidBodySetup};
use motile_tests::validation::imposed::{
    EXTENSION, SHEAR, Seen, capsule, drop_of, ellipse, fourth_order, plane, poiseuille, seen_at,
};

fn reference(case: &str, quantity: &str) -> f64 {
    motile_tests::validation::imposed::reference(case, quantity).expect("as described")
}

/// A clean drop of radius 1 by the midpoint rule.
fn drop_in(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize, dt: f64) -> Setup {
    Setup { droplets: vec![drop_of(ratio, capillary)], ..plane(flow, nodes, dt) }
}

/// The like in steps of fourth order.
fn drop_by_runge_kutta(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize, dt: f64) -> Setup {
    Setup { integrator: IntegratorKind::RungeKutta, ..drop_in(flow, ratio, capillary, nodes, dt) }
}

/// Deformation and stresslet of a drop at a time.
fn deformed(setup: &Setup, until: f64) -> (Deformation, [[f64; 2]; 2]) {
    let seen = seen_at(setup, &[until]).expect("as described")[0];
    (seen.deformation, seen.stresslet)
}

/// All that the reference has of a case, and a lower order of the steps for the deformation.
fn assert_seen(case: &str, [coarse, fine]: [Seen; 2], tolerance: f64, order: f64) {
    let (largest, name) = fine.largest_error(case);
    assert!(largest < tolerance, "{case} {name} {largest:e}");
    for ((name, coarse), (_, fine)) in coarse.errors(case).into_iter().zip(fine.errors(case)).take(2) {
        let falls = fine.abs() < coarse.abs() / 2.0_f64.powf(order);
        assert!(falls || coarse.abs() < tolerance, "{case} {name} {coarse:e} {fine:e}");
    }
}

/// A steady state that a run has come to: the error is that of the area, which the steps keep to their order.
#[test]
fn steady_drops_by_a_run() {
    for (case, ratio, capillary, until) in
        [("shear_lam1_Ca0.3", 1.0, 0.3, 20.0), ("shear_lam10_Ca0.1", 10.0, 0.1, 30.0)]
    {
        let at = |dt: f64| seen_at(&drop_by_runge_kutta(SHEAR, ratio, capillary, 96, dt), &[until]).unwrap()[0];
        assert_seen(case, [0.025, 0.0125].map(at), 1e-7, 3.5);
    }
    // The midpoint rule, of second order.
    let at = |dt: f64| deformed(&drop_in(SHEAR, 1.0, 0.3, 80, dt), 20.0).0.by_moments;
    let [coarse, fine] = [0.016, 0.008].map(|dt| (at(dt) - reference("shear_lam1_Ca0.3", "D_mom")).abs());
    assert!(fine < 4e-7 && fine < coarse / 3.5, "{coarse:e} {fine:e}");
}

/// On the way there.
#[test]
fn transient_drop() {
    let strains = ["0.25", "0.5", "0.75", "1", "1.5", "2"];
    let at = |dt: f64| {
        let times = strains.map(|strain| strain.parse().unwrap());
        seen_at(&drop_by_runge_kutta(SHEAR, 1.0, 0.2, 80, dt), &times).unwrap()
    };
    let [coarse, fine] = [0.05, 0.025].map(at);
    for (strain, seen) in strains.iter().zip(coarse.into_iter().zip(fine)) {
        assert_seen(&format!("transient_Linf_lam1_Ca0.2_strain{strain}"), seen.into(), 1e-6, 3.0);
    }
}

/// A drop far off the axis of a shear is carried along fast and deforms as one on the axis, with as many elements as
/// nodes or more.
#[test]
fn drops_deform_alike_wherever_they_are() {
    for elements in [48, 72] {
        let [on_axis, aside] = [0.0, 10.0].map(|y| {
            let mut setup = drop_by_runge_kutta(SHEAR, 1.0, 0.2, 48, 0.02);
            setup.method = Method::Integral(IntegralMethod { nodes: 48, elements });
            setup.droplets[0].centre[1] = y;
            deformed(&setup, 2.0).0
        });
        let difference = on_axis.by_moments - aside.by_moments;
        assert!(difference.abs() < 1e-9, "{elements} {difference:e}");
    }
}

/// Two drops in a shear, so tight that they stay round, and their way past each other: the first reflection.
/// A drop of radius 1 and ratio L adds the streamfunction `-(1/4) [(1 + 2 L) - L/r^2]/(1 + L) sin 2t` to an extension
/// at a rate of 1/2, t the angle from its axis, by vanishing normal velocities, and equal tangential velocities and
/// stresses, on both sides of the circle. The same coefficient is that of the viscosity of dilute emulsions in two
/// dimensions, twice the fraction for rigid discs (Brady, Int. J. Multiphase Flow 10, 113, 1984). What it leaves out
/// falls with the third power of the distance, the reflection itself with the first.
#[test]
fn pairs_of_drops_in_a_shear_go_by_reflections() {
    const TIME: f64 = 2.0;
    let start = |distance: f64| distance * Vec2::from_angle(120.0_f64.to_radians());
    let found = |ratio: f64, capillary: f64, distance: f64| {
        let mut setup = Setup { step: StepSize::default(), ..fourth_order(SHEAR, 24, 1.0) };
        setup.droplets = [-0.5, 0.5]
            .map(|part| DropletSetup { centre: (part * start(distance)).to_array(), ..drop_of(ratio, capillary) })
            .to_vec();
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(TIME).go().unwrap();
        let [one, other] = [0, 1].map(|droplet| scene.observe(droplets[droplet]).unwrap().centroid);
        other - one
    };
    // The way of the one from the other where their distance grows more slowly by this over its square.
    let reflected = |slower: f64, distance: f64| {
        let velocity = |x: Vec2| Vec2::new(x.y, 0.0) - slower * x.x * x.y / x.length_squared().powi(2) * x;
        let steps = 2000;
        let dt = TIME / f64::from(steps);
        (0..steps).fold(start(distance), |x, _| {
            let middle = x + 0.5 * dt * velocity(x);
            x + dt * velocity(middle)
        })
    };
    for ratio in [0.1, 1.0, 10.0] {
        let slower = 2.0 * (1.0 + 2.0 * ratio) / (1.0 + ratio);
        let [near, far] = [6.0, 12.0].map(|distance| {
            // Surfaces that are tight without bound.
            let [loose, tight] = [0.02, 0.01].map(|capillary| found(ratio, capillary, distance));
            let [alone, expected] = [0.0, slower].map(|slower| reflected(slower, distance));
            println!("{} {}", loose.distance(expected), tight.distance(expected));
            [(2.0 * tight - loose).distance(expected), expected.distance(alone)]
        });
        println!("{ratio}: {near:?} {far:?}");
        let order = (near[0] / far[0]).log2();
        assert!((2.5..3.5).contains(&order), "{ratio}: {near:?} {far:?}");
        assert!(far[0] < 0.02 * far[1], "{ratio}: {near:?} {far:?}");
    }
}

/// The area that long steps lose is restored, that of the smooth curve, and the deformation is none the worse.
#[test]
fn restored_areas_are_those_of_the_smooth_curve() {
    let at = |area_constraint: bool, step: StepSize| {
        let mut setup = drop_by_runge_kutta(SHEAR, 8.0, 0.4, 72, 0.1);
        setup.droplets[0].area_constraint = area_constraint;
        deformed(&Setup { step, ..setup }, 10.0).0
    };
    let [free, held] = [false, true].map(|held| at(held, StepSize::default()));
    let fine = at(false, StepSize::Fixed(0.02));
    let lost = |seen: &Deformation| (seen.area / PI - 1.0).abs();
    assert!(lost(&held) < 1e-13 && lost(&free) > 1e-5, "{:e} {:e}", lost(&held), lost(&free));
    let [with, without] = [held, free].map(|seen| (seen.by_moments / fine.by_moments - 1.0).abs());
    assert!(with < 2.0 * without && with < 1e-4, "{with:e} {without:e}");
}

/// A bubble, of a millionth of the viscosity outside, stays an ellipse of known axes, in time too.
#[test]
fn inviscid_bubbles_are_ellipses() {
    let times = ["0.25", "0.5", "1", "2"];
    let setup = drop_by_runge_kutta(SHEAR, 1e-6, 0.2, 64, 0.0125);
    let seen = seen_at(&setup, &times.map(|time| time.parse().unwrap())).unwrap();
    for (time, Seen { deformation: seen, .. }) in times.iter().zip(seen) {
        let case = format!("bubble_exact_transient_shear_Ca0.2_t{time}");
        for deformation in [seen.by_moments, seen.by_extents] {
            assert!((deformation - reference(&case, "D")).abs() < 1e-6, "{case} {seen:?}");
        }
        assert!((seen.angle_of_moments.unwrap().to_degrees() - reference(&case, "angle_deg")).abs() < 1e-4, "{seen:?}");
    }
    let (seen, stress) = deformed(&drop_by_runge_kutta(EXTENSION, 1e-6, 0.1, 64, 0.0125), 8.0);
    assert!((seen.by_moments - reference("bubble_exact_ext_Ca0.1", "D")).abs() < 1e-6, "{seen:?}");
    assert!((stress[0][0] - reference("bubble_exact_ext_Ca0.1", "SB_xx")).abs() < 2e-5, "{stress:?}");
}

/// At small capillary numbers D = Ca in shear and 2 Ca in extension, whatever the ratio of viscosities; the stresslet
/// is that of a disc of fluid, and the angle falls by (1 + ratio) Ca/2.
#[test]
fn first_order_at_any_ratio() {
    for ratio in [0.01, 0.3, 100.0] {
        let capillary = 0.1_f64.min(1.0 / (1.0 + ratio)) * 2e-3;
        let (dt, until) = (0.04 * (1.0 + ratio) * capillary, 20.0 * (1.0 + ratio) * capillary);
        let at = |flow| deformed(&drop_in(flow, ratio, capillary, 24, dt), until);
        let k = PI * (1.0 + 2.0 * ratio) / (1.0 + ratio);
        let (shear, stress) = at(SHEAR);
        assert!((shear.by_moments / capillary - 1.0).abs() < 1e-5, "{ratio} {shear:?}");
        let fall = (0.25 * PI - shear.angle_of_moments.unwrap()) / (0.5 * (1.0 + ratio) * capillary);
        assert!((fall - 1.0).abs() < 1e-4, "{ratio} {fall}");
        assert!((stress[0][1] / k - 1.0).abs() < 2e-5, "{ratio} {stress:?}");
        let (extension, stress) = at(EXTENSION);
        assert!((extension.by_moments / capillary - 2.0).abs() < 1e-5, "{ratio} {extension:?}");
        assert!((stress[0][0] / (2.0 * k) - 1.0).abs() < 2e-5, "{ratio} {stress:?}");
    }
}

/// Jeffery's rate of turning and the stresslet of an ellipse, and the period of a whole turn.
#[test]
fn rigid_ellipses() {
    let turning = |r: f64, angle: f64, dt: f64| {
        let nodes = if r > 2.0 { 160 } else { 96 };
        Setup { rigid_bodies: vec![ellipse(r, angle)], ..fourth_order(SHEAR, nodes, dt) }.build().unwrap()
    };
    for (name, angle) in [("0.0000", 0.0), ("0.5236", PI / 6.0), ("0.7854", PI / 4.0), ("2.0000", 2.0)] {
        let case = format!("rigid_ellipse_r2_theta{name}");
        let Built { mut scene, rigid_bodies, .. } = turning(2.0, angle, 0.01);
        let spin = scene.observe(rigid_bodies[0]).unwrap().spin;
        assert!((spin - reference(&case, "Omega")).abs() < 1e-10, "{case} {spin}");
        let [[xx, xy], _] = scene.system_mut().stresslets().unwrap()[0];
        assert!((xx - reference(&case, "SB_xx")).abs() < 1e-8, "{case} {xx}");
        assert!((xy - reference(&case, "SB_xy")).abs() < 1e-8, "{case} {xy}");
    }
    // Stresslets in body axes, pi eta (a + b)^2 of E'_xx and of 2 a b/(a^2 + b^2) E'_xy.
    for (r, angle) in [(1.5_f64, 0.4_f64), (3.0, 2.1)] {
        let Built { mut scene, .. } = turning(r, angle, 0.01);
        let [[xx, xy], _] = scene.system_mut().stresslets().unwrap()[0];
        let [cos, sin] = [(2.0 * angle).cos(), (2.0 * angle).sin()];
        let scale = PI * (r.sqrt() + 1.0 / r.sqrt()).powi(2);
        let errors = [
            cos * xx + sin * xy - 0.5 * scale * sin,
            cos * xy - sin * xx - 0.5 * scale * 2.0 * r / (r * r + 1.0) * cos,
        ];
        assert!(errors.iter().all(|error| error.abs() < 1e-8), "{r} {angle} {errors:?}");
    }
    // tan(angle) = r tan(2 pi t/T) backwards from the x axis: after the period T = 2 pi (r + 1/r) a whole turn.
    for (r, whole) in [(2.0_f64, "rigid_ellipse_r2"), (3.0, "")] {
        let period = 2.0 * PI * (r + 1.0 / r);
        assert!(whole.is_empty() || (period - reference(whole, "period")).abs() < 1e-8);
        let error = |steps: f64| {
            let Built { mut scene, rigid_bodies, .. } = turning(r, 0.0, period / steps);
            scene.run(period).go().unwrap();
            // By the slowest rate of turning, G/(r^2 + 1), at the x axis.
            (scene.observe(rigid_bodies[0]).unwrap().angle + 2.0 * PI).abs() * (r * r + 1.0)
        };
        let [coarse, fine] = [150.0, 600.0].map(error);
        assert!(fine < 1e-8 * period && fine < coarse / 200.0, "{r} {coarse:e} {fine:e}");
    }
}

/// A capsule on its way to the steady state and in it, by both measures of its deformation.
#[test]
fn capsules_in_shear() {
    let setup = |measure: BendingMeasure, nodes: usize, dt: f64| Setup {
        shells: vec![capsule(measure, 0.01, 0.05)],
        ..fourth_order(SHEAR, nodes, dt)
    };
    let seen = seen_at(&setup(BendingMeasure::Curvature, 48, 0.0012), &[1.0, 2.0, 5.0, 20.0]).unwrap();
    for (case, seen) in ["_transient_curvature_b0.01_Ca0.05_Gt1", "_transient_curvature_b0.01_Ca0.05_Gt2"]
        .iter()
        .chain(&["_transient_curvature_b0.01_Ca0.05_Gt5", "_curvature_b0.01_Ca0.05"])
        .zip(seen)
    {
        let (error, name) = seen.largest_error(&format!("capsule{case}"));
        assert!(error < 1e-5, "{case} {name} {error:e}");
    }
}

/// Capsules of the other measure of bending, and stiff ones in compression: two integrators and two resolutions agree.
#[test]
fn capsules_of_either_measure() {
    for (measure, ratio, capillary, dt) in
        [(BendingMeasure::TurningAngle, 0.01, 0.05, 0.0012), (BendingMeasure::Curvature, 0.1, 0.2, 0.0005)]
    {
        let shells = vec![capsule(measure, ratio, capillary)];
        let exact = Setup { shells: shells.clone(), ..fourth_order(SHEAR, 56, dt) };
        let stages = Setup { shells, integrator: IntegratorKind::RungeKuttaChebyshev, ..plane(SHEAR, 48, 0.0025) };
        let [exact, stages] = [exact, stages].map(|setup| seen_at(&setup, &[4.0]).unwrap()[0].by_name());
        for ((name, exact), (_, found)) in exact.into_iter().zip(stages) {
            assert!((found - exact).abs() < 1e-4 * exact.abs().max(1.0), "{measure:?} {name} {exact} {found}");
        }
    }
}

/// Implicit parts are refused by the method of fourth order.
#[test]
fn particles_by_the_runge_kutta_method() {
    let setup = Setup { integrator: IntegratorKind::RungeKutta, ..Setup::default() };
    let refused = setup.check().unwrap_err().to_string();
    assert!(refused.contains("integrator = runge-kutta") && refused.contains("midpoint"), "{refused}");
    let mut scene = Setup::default().build().unwrap().scene.advanced_by(IntegratorKind::RungeKutta);
    let refused = scene.run(1.0).go().unwrap_err().to_string();
    assert!(refused.contains("Runge-Kutta-Chebyshev"), "{refused}");
    // Steps that are told to be adaptive are those of the midpoint rule, with far smaller errors.
    let drop = Setup { step: StepSize::default(), ..drop_by_runge_kutta(SHEAR, 1.0, 0.2, 64, 0.1) };
    let error = |setup: &Setup| {
        let (error, _) = seen_at(setup, &[2.0]).unwrap()[0].largest_error("transient_Linf_lam1_Ca0.2_strain2");
        error
    };
    let [second, fourth] = [IntegratorKind::Midpoint, IntegratorKind::RungeKutta]
        .map(|integrator| error(&Setup { integrator, ..drop.clone() }));
    assert!(fourth < 2e-5 && fourth < second / 10.0, "{second:e} {fourth:e}");
}

/// Samples are those of the whole flow, in the far field with the stresslet as `u - A x = -x (x S x)/(2 pi r^4)`; the
/// pressure of a Poiseuille flow is among them.
#[test]
fn samples_show_the_whole_flow() {
    let flow = FlowSetup { extension: 0.3, rotation: -0.2, ..poiseuille(4.0) };
    let flow = FlowSetup { shear: 1.0, ..flow };
    let Built { mut scene, droplets, .. } = drop_in(flow, 5.0, 0.1, 48, 0.005).build().unwrap();
    scene.run(0.2).go().unwrap();
    let imposed = scene.system().imposed();
    let [[xx, xy], _] = scene.system_mut().stresslets().unwrap()[0];
    let centre = scene.system_mut().deformation(droplets[0]).unwrap().centroid;
    let mut before = f64::INFINITY;
    for distance in [20.0, 40.0, 80.0] {
        let away = distance * Vec2::from_angle(0.7);
        let mut samples = [FlowSample::default()];
        scene.system_mut().sample(&[centre + away], &mut samples).unwrap();
        let own = samples[0].velocity - imposed.velocity_at(centre + away);
        let pull = xx * (away.x * away.x - away.y * away.y) + 2.0 * xy * away.x * away.y;
        let error = (own + away * (pull / (2.0 * PI * distance.powi(4)))).length() * distance;
        assert!(error < before / 1.8, "{distance} {error:e} {before:e}");
        before = error;
        let pressure = samples[0].pressure - imposed.bend * (centre + away).x;
        assert!((pressure + pull / (PI * distance.powi(4))).abs() < 0.2 * pull.abs() / distance.powi(4), "{pressure}");
    }
}

/// A flow that is a function of time: the response of a drop to an oscillating extension, 2 E/(1 + ratio) over the
/// frequency of relaxation and its own; and steps of second order.
#[test]
fn oscillating_extension() {
    let (ratio, amplitude, frequency) = (2.0, 1e-3, 3.0);
    let rate = 1.0 / (1.0 + ratio);
    let exact = |time: f64| {
        let [c, s] = [(frequency * time).cos(), (frequency * time).sin()];
        let forced = 2.0 * amplitude * rate / (rate * rate + frequency * frequency);
        forced * (rate * c + frequency * s - rate * (-rate * time).exp())
    };
    let error = |dt: f64| {
        let still = FlowSetup { shear: 1e-300, extension: 0.0, ..SHEAR };
        let Built { mut scene, droplets, .. } = drop_in(still, ratio, 1.0, 24, dt).build().unwrap();
        scene.impose(Imposed::of_time(move |t| ImposedFlow::extension(amplitude * (frequency * t).cos()))).unwrap();
        scene.run(2.0).go().unwrap();
        let seen = scene.system_mut().deformation(droplets[0]).unwrap();
        (seen.by_moments * (2.0 * seen.angle_of_moments.unwrap()).cos() - exact(2.0)).abs()
    };
    let [coarse, fine] = [error(0.04), error(0.02)];
    assert!(fine < 1e-6 && fine < coarse / 3.0, "{coarse:e} {fine:e}");
}

/// A run goes on bit for bit from a checkpoint in a flow that is a function of time.
#[test]
fn checkpoints_in_time() {
    let directory = std::env::temp_dir().join(format!("motile-imposed-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let path = directory.join("drop.checkpoint");
    let make = || {
        let setup = Setup { step: StepSize::default(), ..drop_in(SHEAR, 3.0, 0.2, 32, 0.1) };
        let built = setup.build().unwrap();
        let mut scene = built.scene;
        scene.impose(Imposed::of_time(|t| ImposedFlow::shear(1.0 + t.sin()))).unwrap();
        scene
    };
    let mut scene = make();
    scene.run(0.35).go().unwrap();
    scene.checkpoint("").write(&path).unwrap();
    scene.run(0.7).go().unwrap();
    let mut again = make();
    again.resume(&Checkpoint::read(&path).unwrap()).unwrap();
    again.run(0.7).go().unwrap();
    assert_eq!(scene.system().markers().positions(), again.system().markers().positions());
    assert_eq!(scene.system().hydrodynamics().imposed(), again.system().hydrodynamics().imposed());
    let other = drop_in(FlowSetup { shear: 2.0, ..SHEAR }, 3.0, 0.2, 32, 0.1).build().unwrap().scene;
    let mut other = other;
    let mut steady = drop_in(SHEAR, 3.0, 0.2, 32, 0.1).build().unwrap().scene;
    steady.system_mut().evaluate().unwrap();
    let refused = other.resume(&steady.checkpoint("")).unwrap_err().to_string();
    assert!(refused.contains("du/dy of the imposed flow"), "{refused}");
    std::fs::remove_dir_all(&directory).unwrap();
}

/// A sheared box of 6 x 6, whose images go once around in a strain of 1: shape and stress.
#[test]
fn sheared_box() {
    let at = |dt: f64| {
        let drop = drop_by_runge_kutta(SHEAR, 1.0, 0.2, 80, dt);
        let setup = Setup { region: Region::Box { lengths: [6.0; 2] }, ..drop };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        ["0.5", "2"].map(|strain| {
            scene.run(strain.parse().unwrap()).go().unwrap();
            assert!((scene.system().hydrodynamics().strain() - scene.time()).abs() < 1e-12);
            let case = format!("transient_L6_lam1_Ca0.2_strain{strain}");
            let deformation = scene.system_mut().deformation(droplets[0]).unwrap();
            let stress = scene.system_mut().stress().unwrap();
            for (name, found) in [("mean_stress_xy", stress.mean()[0][1]), ("mean_N1", stress.normal_difference())] {
                let tolerance = if dt < 0.03 { 1e-6 } else { 1e-5 };
                assert!((found - reference(&case, name)).abs() < tolerance, "{dt} {name} {found}");
            }
            assert_eq!(stress.effective_viscosity(), Some(stress.mean()[0][1]));
            (case, Seen { deformation, stresslet: stress.stresslet, strains: None })
        })
    };
    for ((case, coarse), (_, fine)) in at(0.05).into_iter().zip(at(0.025)) {
        assert_seen(&case, [coarse, fine], 1e-6, 3.0);
    }
}

/// The viscosity of a square lattice of drops that are hardly deformed, when its images have gone once around: the
/// reference to four digits, and `1 + k phi/(1 - 2 m k phi)` of point stresslets to second order in the area fraction.
#[test]
fn dilute_emulsions() {
    let viscosity = |side: f64, ratio: f64, capillary: f64| {
        let dt = 0.08 * (1.0 + ratio) * capillary;
        let drop = drop_in(SHEAR, ratio, capillary, 24, dt);
        let setup = Setup { region: Region::Box { lengths: [side; 2] }, ..drop };
        let Built { mut scene, .. } = setup.build().unwrap();
        scene.run(1.0).go().unwrap();
        let (stress, phi) = (scene.system_mut().stress().unwrap(), PI / (side * side));
        (stress.effective_viscosity().unwrap() - 1.0) / phi
    };
    for ratio in [1.0, 5.0] {
        let k = (1.0 + 2.0 * ratio) / (1.0 + ratio);
        // The error of the capillary number is of second order.
        let at = |side: f64| {
            let [coarse, fine] = [0.02, 0.01].map(|capillary| viscosity(side, ratio, 2.0 * capillary / (1.0 + ratio)));
            fine + (fine - coarse) / 3.0
        };
        let errors = [8.0, 16.0].map(|side| {
            let phi = PI / (side * side);
            at(side) - k / (1.0 + 2.0 * 0.149_105_66 * k * phi)
        });
        assert!(errors[0].abs() < 4.0 * (PI / 64.0).powi(2), "{ratio} {errors:?}");
        assert!(errors[1].abs() < errors[0].abs() / 8.0, "{ratio} {errors:?}");
        if ratio == 1.0 {
            assert!((at(8.0) - reference("box_L8_lam1_diag", "k_eff=(eta_eff/eta-1)/phi")).abs() < 2e-4);
        }
    }
}

/// A run through several whole periods goes on bit for bit from a checkpoint.
#[test]
fn checkpoints_of_a_sheared_box() {
    let make = || {
        let region = Region::Box { lengths: [3.0, 2.5] };
        let setup = Setup { region, step: StepSize::default(), ..drop_in(SHEAR, 3.0, 0.3, 24, 0.1) };
        setup.build().unwrap().scene
    };
    let mut scene = make();
    scene.run(1.7).go().unwrap();
    let saved = scene.checkpoint("");
    scene.run(3.0).go().unwrap();
    let mut again = make();
    again.resume(&saved).unwrap();
    assert!((again.system().hydrodynamics().strain() - 1.7).abs() < 1e-12);
    again.run(3.0).go().unwrap();
    assert_eq!(scene.system().markers().positions(), again.system().markers().positions());
    assert_eq!(scene.system().hydrodynamics().strain().to_bits(), again.system().hydrodynamics().strain().to_bits());
}

/// Sliding walls of a channel: the flow of an empty one with each drive, drops in two frames, and a disc midway.
#[test]
fn sliding_walls() {
    let channel = |flow: FlowSetup, drive: Drive| Setup {
        region: Region::Channel { length: 30.0, width: 4.0, drive },
        ..plane(flow, 48, 0.01)
    };
    let walls = |below: f64, above: f64| FlowSetup { wall_velocity: Some([below, above]), ..FlowSetup::default() };
    let at = [Vec2::new(0.3, -2.0), Vec2::new(1.0, 0.5), Vec2::new(-3.0, 2.0)];
    for drive in [Drive::ZeroGradient, Drive::ZeroFlux, Drive::Gradient(-0.3)] {
        let mut scene = channel(walls(-1.0, 2.0), drive).build().unwrap().scene;
        let mut samples = [FlowSample::default(); 3];
        scene.system_mut().sample(&at, &mut samples).unwrap();
        for (place, sample) in at.iter().zip(samples) {
            let couette = 0.5 + 0.75 * place.y;
            let parabola = match drive {
                Drive::ZeroFlux => -0.75 * (1.0 - place.y * place.y / 4.0),
                _ => -0.5 * drive.gradient() * (4.0 - place.y * place.y),
            };
            assert!((sample.velocity - Vec2::new(couette + parabola, 0.0)).length() < 1e-12, "{drive:?} {sample:?}");
        }
    }
    // In a frame that moves with the upper wall everything is slower by its velocity.
    let drop = |walls: FlowSetup| {
        let drop = DropletSetup { centre: [0.0, 0.6], viscosity: Some(5.0), ..DropletSetup::passive(4.0) };
        let Built { mut scene, droplets, .. } =
            Setup { droplets: vec![drop], ..channel(walls, Drive::ZeroGradient) }.build().unwrap();
        scene.run(0.5).go().unwrap();
        (scene.system_mut().deformation(droplets[0]).unwrap(), scene.observe(droplets[0]).unwrap().velocity)
    };
    let [(seen, velocity), (other, slower)] = [walls(-1.0, 1.0), walls(-2.0, 0.0)].map(drop);
    assert!((velocity - slower - Vec2::X).length() < 1e-8, "{velocity:?} {slower:?}");
    assert!((seen.centroid - other.centroid - Vec2::new(0.5, 0.0)).length() < 1e-8);
    assert!((seen.by_moments - other.by_moments).abs() < 1e-9 && seen.by_moments > 0.05, "{seen:?}");
    // A disc between walls that slide oppositely turns by half the shear rate, but for the square of their nearness.
    let spin = |width: f64| {
        let body = RigidBodySetup { shape: DropletShape::Round { radius: 0.2 }, ..RigidBodySetup::default() };
        let region = Region::Channel { length: 30.0, width, drive: Drive::ZeroGradient };
        let slide = walls(-0.5 * width, 0.5 * width);
        let built = Setup { region, rigid_bodies: vec![body], ..plane(slide, 48, 0.01) }.build().unwrap();
        let (mut scene, body) = (built.scene, built.rigid_bodies[0]);
        (scene.observe(body).unwrap().spin + 0.5).abs()
    };
    let [narrow, wide] = [spin(2.0), spin(4.0)];
    assert!(wide < 1e-2 && wide < narrow / 3.0, "{narrow:e} {wide:e}");
}

/// A deformable drop off the middle of a Poiseuille flow migrates across it, in the plane, at a speed that two
/// resolutions agree on and that vanishes on the middle: towards it at these ratios.
#[test]
fn drops_migrate_in_a_poiseuille_flow() {
    let drift = |ratio: f64, nodes: usize, y: f64| {
        let drop = DropletSetup { centre: [0.0, y], ..drop_of(ratio, 0.2) };
        let setup = Setup { droplets: vec![drop], ..plane(poiseuille(5.0), nodes, 0.01) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let mut height = |until: f64| {
            scene.run(until).go().unwrap();
            scene.system_mut().deformation(droplets[0]).unwrap().centroid.y
        };
        let before = height(3.0);
        height(4.0) - before
    };
    for ratio in [0.2, 1.0, 5.0] {
        let [coarse, fine] = [drift(ratio, 32, 2.0), drift(ratio, 48, 2.0)];
        assert!((coarse / fine - 1.0).abs() < 1e-7 && fine.abs() > 1e-4, "migration {ratio} {coarse:e} {fine:e}");
        assert!((drift(ratio, 32, -2.0) + coarse).abs() < 1e-8, "{ratio}");
        assert!(drift(ratio, 32, 0.0).abs() < 1e-10, "{ratio}");
    }
}

/// Flows that a region or a method does not have are refused before any work, with a remedy.
#[test]
fn flows_that_are_not_there() {
    let (channel, square) =
        (Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient }, Region::Box { lengths: [6.0; 2] });
    let slide = FlowSetup { wall_velocity: Some([0.0, 1.0]), ..FlowSetup::default() };
    let poiseuille =
        FlowSetup { poiseuille: Some(PoiseuilleSetup { speed: 1.0, half_width: 2.0 }), ..FlowSetup::default() };
    for (region, flow, parts) in [
        (channel, SHEAR, ["flow.shear = 1", "wall-velocity = [-2, 2]"]),
        (channel, EXTENSION, ["flow.extension = 1", "\"plane\""]),
        (channel, poiseuille, ["flow.poiseuille.speed", "flux = 2.66"]),
        (square, EXTENSION, ["flow.extension = 1", "sheared along x only"]),
        (square, slide, ["flow.wall-velocity", "Use shear"]),
        (Region::Plane, slide, ["flow.wall-velocity", "a channel"]),
        (Region::Plane, FlowSetup { shear: f64::NAN, ..SHEAR }, ["flow.shear = NaN", "finite"]),
    ] {
        let refused = Setup { region, ..plane(flow, 48, 0.1) }.check().unwrap_err().to_string();
        assert!(parts.iter().all(|part| refused.contains(part)), "{refused}");
    }
    let method = Method::Grid(GridMethod::of_spacing(0.1));
    let refused = Setup { region: square, method, ..plane(SHEAR, 48, 0.1) }.check().unwrap_err().to_string();
    assert!(refused.contains("imposed flows") && refused.contains("integral"), "{refused}");
    let mut grid = Setup { region: square, method, ..Setup::default() }.build().unwrap().scene;
    let refused = grid.impose(ImposedFlow::shear(1.0)).unwrap_err().to_string();
    assert!(refused.contains("boundary integrals"), "{refused}");
}
