//! Drops, capsules and rigid bodies in flows that are imposed from outside, against `tests/reference/imposed_flows.csv`
//! and closed forms.

use std::f64::consts::PI;

use motile::motile_base::{FlowSample, ImposedFlow};
use motile::motile_scene::checkpoint::Checkpoint;
use motile::motile_scene::{Deformation, Hydrodynamics, Imposed};
use motile::prelude::*;
use motile::setup::{DropletShape, PoiseuilleSetup, RigidBodySetup, ShellSetup};
use motile_tests::validation::{Reference, ReferenceFile};

const SHEAR: FlowSetup = FlowSetup { shear: 1.0, extension: 0.0, rotation: 0.0, poiseuille: None, wall_velocity: None };
const EXTENSION: FlowSetup = FlowSetup { shear: 0.0, extension: 1.0, ..SHEAR };

/// A reference value.
fn reference(case: &str, quantity: &str) -> f64 {
    let file = Reference::read(ReferenceFile::ImposedFlows).expect("as described");
    file.select("case", case).select("quantity", quantity).value("value").expect("as described")
}

/// An empty plane of unit viscosity with a flow.
fn plane(flow: FlowSetup, nodes: usize, dt: f64) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, cells: nodes });
    let step = StepSize::Fixed(dt);
    Setup { region: Region::Plane, viscosity: 1.0, flow, method, step, droplets: Vec::new(), ..Setup::default() }
}

/// A clean drop of radius 1.
fn drop_in(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize, dt: f64) -> Setup {
    let drop = DropletSetup { viscosity: Some(ratio), ..DropletSetup::passive(1.0 / capillary) };
    Setup { droplets: vec![drop], ..plane(flow, nodes, dt) }
}

/// Deformation and stresslet of a drop at a time.
fn deformed(setup: &Setup, until: f64) -> (Deformation, [[f64; 2]; 2]) {
    let Built { mut scene, droplets, .. } = setup.build().expect("as described");
    scene.run(until).go().expect("as described");
    let seen = scene.system_mut().deformation(droplets[0]).expect("as described");
    (seen, scene.system_mut().stresslets().expect("as described")[0])
}

/// Errors against all quantities of a case, by their names.
fn errors(case: &str, (seen, stress): (Deformation, [[f64; 2]; 2])) -> Vec<(&'static str, f64)> {
    let known = [
        ("D_mom", seen.by_moments),
        ("D_ext", seen.by_extents),
        ("L_max", seen.extents[0]),
        ("B_min", seen.extents[1]),
        ("length", seen.perimeter),
        ("tip_speed", seen.tip_speed),
        ("waist_speed", seen.waist_speed),
        ("max_speed", seen.largest_speed),
        ("kappa_tip", seen.tip_curvature),
        ("SB_xx", stress[0][0]),
        ("SB_xy", stress[0][1]),
    ];
    let mut errors: Vec<_> = known.map(|(name, found)| (name, found - reference(case, name))).to_vec();
    for (name, found) in [("angle_mom_deg", seen.angle_of_moments), ("angle_ext_deg", seen.angle_of_extents)] {
        errors.push((name, found - reference(case, name).to_radians()));
    }
    errors
}

/// A steady state that a run has come to: the error is that of the area, which the steps keep to second order.
#[test]
fn steady_drops_by_a_run() {
    for (case, ratio, capillary, until) in
        [("shear_lam1_Ca0.3", 1.0, 0.3, 20.0), ("shear_lam10_Ca0.1", 10.0, 0.1, 30.0)]
    {
        let at = |dt: f64| deformed(&drop_in(SHEAR, ratio, capillary, 80, dt), until);
        let [coarse, fine] = [at(0.008), at(0.004)];
        for (found, period) in [(coarse, 3e-5), (fine, 1e-5)] {
            assert!((found.0.period.unwrap() / reference(case, "period") - 1.0).abs() < period, "{found:?}");
        }
        for ((name, coarse), (_, fine)) in errors(case, coarse).into_iter().zip(errors(case, fine)) {
            assert!(fine.abs() < 1e-5, "{case} {name} {fine:e}");
            assert!(fine.abs() < coarse.abs() / 2.0 || fine.abs() < 1e-6, "{case} {name} {coarse:e} {fine:e}");
        }
        let [coarse, fine] = [coarse, fine].map(|found| (found.0.by_moments - reference(case, "D_mom")).abs());
        assert!(fine < 1e-7 && fine < coarse / 3.5, "{case} {coarse:e} {fine:e}");
    }
}

/// On the way, with errors of second order in the step.
#[test]
fn transient_drop() {
    for strain in ["0.5", "2"] {
        let case = format!("transient_Linf_lam1_Ca0.2_strain{strain}");
        let at = |dt: f64| errors(&case, deformed(&drop_in(SHEAR, 1.0, 0.2, 64, dt), strain.parse().unwrap()));
        for ((name, coarse), (_, fine)) in at(0.005).into_iter().zip(at(0.0025)) {
            assert!(fine.abs() < 2e-5, "{case} {name} {fine:e}");
            assert!(fine.abs() < coarse.abs() / 3.0 || fine.abs() < 1e-6, "{case} {name} {coarse:e} {fine:e}");
        }
    }
}

/// A bubble, of a millionth of the viscosity outside, stays an ellipse of known axes, in time too.
#[test]
fn inviscid_bubbles_are_ellipses() {
    for (time, tolerance) in [("0.5", 4e-6), ("2", 1e-6)] {
        let case = format!("bubble_exact_transient_shear_Ca0.2_t{time}");
        let (seen, _) = deformed(&drop_in(SHEAR, 1e-6, 0.2, 64, 0.005), time.parse().unwrap());
        for deformation in [seen.by_moments, seen.by_extents] {
            assert!((deformation - reference(&case, "D")).abs() < tolerance, "{case} {seen:?}");
        }
        assert!((seen.angle_of_moments.to_degrees() - reference(&case, "angle_deg")).abs() < 1e-3, "{seen:?}");
    }
    let (seen, stress) = deformed(&drop_in(EXTENSION, 1e-6, 0.1, 64, 0.0025), 8.0);
    assert!((seen.by_moments - reference("bubble_exact_ext_Ca0.1", "D")).abs() < 1e-6, "{seen:?}");
    assert!((stress[0][0] - reference("bubble_exact_ext_Ca0.1", "SB_xx")).abs() < 4e-5, "{stress:?}");
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
        let fall = (0.25 * PI - shear.angle_of_moments) / (0.5 * (1.0 + ratio) * capillary);
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
    let ellipse = |r: f64, angle: f64, dt: f64| {
        let half_axes = [r.sqrt(), 1.0 / r.sqrt()];
        let body = RigidBodySetup { angle, shape: DropletShape::Ellipse { half_axes }, ..RigidBodySetup::default() };
        Setup { rigid_bodies: vec![body], ..plane(SHEAR, 96, dt) }.build().unwrap()
    };
    for (name, angle) in [("0.0000", 0.0), ("0.5236", PI / 6.0), ("0.7854", PI / 4.0), ("2.0000", 2.0)] {
        let case = format!("rigid_ellipse_r2_theta{name}");
        let Built { mut scene, rigid_bodies, .. } = ellipse(2.0, angle, 0.01);
        let spin = scene.observe(rigid_bodies[0]).unwrap().spin;
        assert!((spin - reference(&case, "Omega")).abs() < 1e-10, "{case} {spin}");
        let [[xx, xy], _] = scene.system_mut().stresslets().unwrap()[0];
        assert!((xx - reference(&case, "SB_xx")).abs() < 1e-8, "{case} {xx}");
        assert!((xy - reference(&case, "SB_xy")).abs() < 1e-8, "{case} {xy}");
    }
    // tan(angle) = r tan(2 pi t/T) backwards from the x axis, T = 2 pi (r + 1/r).
    let r = 3.0_f64;
    let error = |dt: f64| {
        let Built { mut scene, rigid_bodies, .. } = ellipse(r, 0.5 * PI, dt);
        let quarter = 0.5 * PI * (r + 1.0 / r);
        scene.run(quarter).go().unwrap();
        (scene.observe(rigid_bodies[0]).unwrap().angle + 0.5 * PI).abs()
    };
    let [coarse, fine] = [error(0.04), error(0.02)];
    assert!(fine < 2e-5 && fine < coarse / 3.5, "{coarse:e} {fine:e}");
}

/// A capsule on its way, by both measures of its deformation.
#[test]
fn capsule_in_shear() {
    let shell = ShellSetup {
        shape: DropletShape::Round { radius: 1.0 },
        stretching: 20.0,
        bending: 0.2,
        ..ShellSetup::default()
    };
    let setup = Setup { shells: vec![shell], ..plane(SHEAR, 48, 0.001) };
    let Built { mut scene, shells, .. } = setup.build().unwrap();
    scene.run(1.0).go().unwrap();
    let (case, seen) =
        ("capsule_transient_curvature_b0.01_Ca0.05_Gt1", scene.system_mut().deformation(shells[0]).unwrap());
    assert!((seen.by_moments - reference(case, "D_mom")).abs() < 1e-6, "{seen:?}");
    assert!((seen.by_extents - reference(case, "D_ext")).abs() < 1e-6, "{seen:?}");
    assert!((seen.angle_of_moments.to_degrees() - reference(case, "angle_mom_deg")).abs() < 1e-5, "{seen:?}");
    let stress = scene.system_mut().stresslets().unwrap()[0];
    assert!((stress[0][1] - reference(case, "SB_xy")).abs() < 1e-5, "{stress:?}");
}

/// Samples are those of the whole flow, in the far field with the stresslet as `u - A x = -x (x S x)/(2 pi r^4)`; the
/// pressure of a Poiseuille flow is among them.
#[test]
fn samples_show_the_whole_flow() {
    let poiseuille = Some(PoiseuilleSetup { speed: 2.0, half_width: 4.0 });
    let flow = FlowSetup { extension: 0.3, rotation: -0.2, poiseuille, ..SHEAR };
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
        (seen.by_moments * (2.0 * seen.angle_of_moments).cos() - exact(2.0)).abs()
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
        let setup = Setup { region: Region::Box { lengths: [6.0; 2] }, ..drop_in(SHEAR, 1.0, 0.2, 64, dt) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        ["0.5", "2"].map(|strain| {
            scene.run(strain.parse().unwrap()).go().unwrap();
            assert!((scene.system().hydrodynamics().strain() - scene.time()).abs() < 1e-12);
            let case = format!("transient_L6_lam1_Ca0.2_strain{strain}");
            let seen = scene.system_mut().deformation(droplets[0]).unwrap();
            let stress = scene.system_mut().stress().unwrap();
            let mut errors = errors(&case, (seen, stress.stresslet));
            errors.push(("mean_stress_xy", stress.mean()[0][1] - reference(&case, "mean_stress_xy")));
            errors.push(("mean_N1", stress.normal_difference() - reference(&case, "mean_N1")));
            assert_eq!(stress.effective_viscosity(), Some(stress.mean()[0][1]));
            errors
        })
    };
    for (coarse, fine) in at(0.005).into_iter().zip(at(0.0025)) {
        for ((name, coarse), (_, fine)) in coarse.into_iter().zip(fine) {
            let tolerance = if ["D_mom", "D_ext", "mean_stress_xy", "mean_N1"].contains(&name) { 1e-6 } else { 1e-5 };
            assert!(fine.abs() < tolerance, "{name} {fine:e}");
            assert!(fine.abs() < coarse.abs() / 3.0 || fine.abs() < 3e-7, "{name} {coarse:e} {fine:e}");
        }
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
    let poiseuille =
        FlowSetup { poiseuille: Some(PoiseuilleSetup { speed: 2.5, half_width: 5.0 }), ..FlowSetup::default() };
    let drift = |ratio: f64, nodes: usize, y: f64| {
        let drop = DropletSetup { centre: [0.0, y], viscosity: Some(ratio), ..DropletSetup::passive(5.0) };
        let setup = Setup { droplets: vec![drop], ..plane(poiseuille, nodes, 0.01) };
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
        assert!((coarse / fine - 1.0).abs() < 1e-3 && fine.abs() > 1e-4, "migration {ratio} {coarse:e} {fine:e}");
        assert!((drift(ratio, 32, -2.0) + coarse).abs() < 1e-8, "{ratio}");
        assert!(drift(ratio, 32, 0.0).abs() < 1e-10, "{ratio}");
    }
}

/// What a region or a method does not have is refused before any work, with a remedy.
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
        (square, slide, ["flow.wall-velocity", "give shear"]),
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
