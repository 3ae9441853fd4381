use super::*;
use crate::error::refused;
use crate::{ActiveDroplet, ContractileTension, Curve, InitialConcentration};
use motile_base::{FlowSample, SolveReport};
use motile_scene::{Body, Domain, FlowError, FlowWork, Hydrodynamics, Markers, Scene};

/// A converging flow, smooth (resolved by spectral accuracy) or on a grid.
#[derive(Debug)]
struct Converging {
    smooth: bool,
}

/// The smooth one, with a grid for what else there may be.
#[derive(Debug)]
struct Layers;

impl Hydrodynamics for Converging {
    fn fluid_view(&self) -> FluidView {
        FluidView {
            domain: Domain { origin: [0.0, 0.0], periods: [None, None].into(), walls: None },
            viscosity: 1.0,
            spacing: (!self.smooth).then_some(0.1),
            second_order: true,
            interface_stiffness: 1.0,
            shape_modes: self.smooth.then_some(41),
            nodes: self.smooth.then_some(41),
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let [positions, forces, velocities] = markers.lists_mut();
        for ((u, x), f) in velocities.iter_mut().zip(positions.iter()).zip(forces.iter()) {
            *u = Vec2::new(-0.2 * x.x, 0.2 * x.y + 0.05 * x.x * x.x) + 0.1 * f;
        }
        Ok(SolveReport::default())
    }

    fn sample(&mut self, _: &Markers, _: &[Vec2], _: &mut [FlowSample]) -> Result<(), FlowError> {
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}

impl Hydrodynamics for Layers {
    fn fluid_view(&self) -> FluidView {
        FluidView { spacing: Some(0.1), ..Converging { smooth: true }.fluid_view() }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        Converging { smooth: true }.velocities(markers)
    }

    fn sample(&mut self, _: &Markers, _: &[Vec2], _: &mut [FlowSample]) -> Result<(), FlowError> {
        Ok(())
    }

    fn work(&self) -> FlowWork {
        FlowWork::default()
    }
}

fn droplet(motion: Motion) -> ActiveDroplet {
    let markers = Curve::ellipse(1.2, 0.9).unwrap().rotated(0.4).markers(64).unwrap();
    let numbers = InitialConcentration::polarised(1.0, 0.4).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::thesis(1.0, -0.5, 2.0, 1.0).unwrap();
    ActiveDroplet::new(&markers, numbers, law, 0.05).unwrap().with_motion(motion)
}

const UNFILTERED: Motion = Motion::Equidistributed { relaxation: 5.0, filter: false };

/// Geometry is computed for the stage, for the new state, and once more where the filter moves its markers.
#[test]
fn a_midpoint_step_computes_each_geometry_once() {
    let cases = [(false, Motion::default(), 3), (false, UNFILTERED, 2), (true, Motion::default(), 2)];
    for (smooth, motion, expected) in cases {
        let passive = ActiveDroplet::passive(droplet(motion).markers(), 1.0).unwrap().with_motion(motion);
        for droplet in [droplet(motion), passive] {
            let mut scene = Scene::new(Converging { smooth });
            let handle = scene.add(droplet);
            // The first step also fits the geometry to the modes that the flow resolves.
            scene.step(0.01).unwrap();
            let evaluations = |scene: &Scene<Converging>| {
                let droplet = scene.body(handle).unwrap();
                droplet.interface.state.shape.evaluations + droplet.interface.scheme.other.evaluations
            };
            let before = evaluations(&scene);
            for _ in 0..10 {
                scene.step(0.01).unwrap();
            }
            assert_eq!(evaluations(&scene) - before, 10 * expected, "smooth {smooth}, {motion:?}");
        }
    }
}

/// They do not see the grid's spacing.
#[test]
fn layers_are_not_filtered() {
    let after = |hydrodynamics: Box<dyn Hydrodynamics>| {
        let mut scene = Scene::new(hydrodynamics);
        let handle = scene.add(droplet(Motion::default()));
        (0..5).for_each(|_| scene.step(0.02).unwrap());
        bits(scene.body(handle).unwrap())
    };
    let layers = after(Box::new(Layers));
    assert_eq!(layers, after(Box::new(Converging { smooth: true })));
    assert_ne!(layers, after(Box::new(Converging { smooth: false })));
}

fn bits(droplet: &ActiveDroplet) -> Vec<u64> {
    let saved = droplet.save();
    saved.reals.iter().map(|value| value.to_bits()).chain(saved.counts).collect()
}

#[test]
fn geometries_that_are_kept_are_those_of_their_markers() {
    for (smooth, motion) in [(false, Motion::default()), (true, Motion::default()), (false, Motion::WithFluid)] {
        let mut scene = Scene::new(Converging { smooth });
        let handle = scene.add(droplet(motion));
        for _ in 0..30 {
            scene.step(0.02).unwrap();
            let droplet = scene.body(handle).unwrap();
            let ActiveInterface { state, scheme, .. } = &droplet.interface;
            for kept in [&state.shape, &scheme.other] {
                let mut fresh = Shape { markers: kept.markers.clone(), ..Shape::default() };
                fresh.update(scheme.spectral.clone().as_mut());
                assert_eq!(kept.geometry, fresh.geometry, "smooth {smooth}, {motion:?}");
            }
        }
    }
}

#[test]
fn a_clone_goes_on_bitwise_identically() {
    for (smooth, motion) in [(false, Motion::default()), (true, Motion::default()), (false, Motion::WithFluid)] {
        let mut scene = Scene::new(Converging { smooth });
        let handle = scene.add(droplet(motion));
        for _ in 0..20 {
            scene.step(0.02).unwrap();
        }
        let clone = scene.body(handle).unwrap().clone();
        assert_eq!(bits(&clone), bits(scene.body(handle).unwrap()));
        let mut other = Scene::new(Converging { smooth });
        let other_handle = other.add(clone);
        for _ in 0..20 {
            scene.step(0.02).unwrap();
            other.step(0.02).unwrap();
        }
        assert_eq!(bits(other.body(other_handle).unwrap()), bits(scene.body(handle).unwrap()), "{smooth} {motion:?}");
    }
}

#[test]
fn laws_chosen_at_run_time_are_laws() {
    let markers = Curve::circle(1.0).unwrap().markers(32).unwrap();
    let law = ContractileTension::thesis(1.0, -0.5, 2.0, 1.0).unwrap();
    let tensions = |law: Box<dyn Tension>| {
        let shared: Arc<dyn Tension> = law.into();
        ActiveDroplet::new(&markers, vec![0.3; 32], shared, 0.1).unwrap().tensions().to_vec()
    };
    let direct = ActiveDroplet::new(&markers, vec![0.3; 32], law, 0.1).unwrap();
    assert_eq!(tensions(Box::new(law)), direct.tensions());
    let constant =
        ActiveDroplet::new(&markers, vec![0.3; 32], Box::new(crate::ConstantTension::new(7.0).unwrap()), 0.1);
    assert!(constant.unwrap().tensions().iter().all(|&tension| tension == 7.0));
}

#[test]
fn a_law_given_later_is_the_law_from_then_on() {
    let mut changed = droplet(Motion::default());
    let before = changed.tensions().to_vec();
    changed.set_tension(ContractileTension::thesis(10.0, -3.0, 10.0, 100.0).unwrap());
    let law = ContractileTension::thesis(10.0, -3.0, 10.0, 100.0).unwrap();
    assert!(changed.tensions().iter().zip(changed.concentrations()).all(|(tension, c)| *tension == law.value(*c)));
    assert_ne!(changed.tensions(), before);
}

/// h c max(-d gamma/dc, 0) / (4 eta): c = 4 is far above the step of B, of 2 at c_T = 2, so that d gamma/dc = 1/2 - 2
/// there; at c = 1 the tension rises.
#[test]
fn the_stabiliser_by_hand() {
    for (c, on, expected) in [(4.0, true, vec![0.15; 64]), (1.0, true, vec![0.0; 64]), (4.0, false, Vec::new())] {
        let mut droplet = droplet(Motion::default());
        let numbers = droplet.element_lengths().iter().map(|length| c * length).collect();
        let law = ContractileTension::thesis(1.0, -0.5, 2.0, 1.0).unwrap();
        droplet = ActiveDroplet::new(droplet.markers(), numbers, law, 0.05).unwrap();
        let step = StepInfo { dt: 0.01, stabilised: on };
        droplet.begin_step(&Converging { smooth: false }.fluid_view(), step).unwrap();
        assert_eq!(droplet.interface.scheme.stabiliser.len(), expected.len());
        for (found, expected) in droplet.interface.scheme.stabiliser.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-6, "{c}: {found} {expected}");
        }
    }
}

/// Forces of bending against differences of the energy, on a curve that is stretched unevenly.
#[test]
fn forces_of_bending_are_minus_the_gradient_of_the_energy() {
    let count = 24;
    let at = |k: usize| {
        let t = std::f64::consts::TAU * k as f64 / count as f64;
        Vec2::new(1.2 * t.cos() + 0.1 * (2.0 * t).sin(), 0.9 * t.sin() + 0.05 * (3.0 * t).cos())
    };
    let markers: Vec<Vec2> = (0..count).map(at).collect();
    for reference in [0.0, 1.3] {
        let mut bending = Bending::new(0.4, reference, count).unwrap();
        let mut forces = vec![Vec2::ZERO; count];
        bending.add_forces(&markers, 0.0, &mut forces).unwrap();
        for (k, force) in forces.iter().enumerate() {
            for axis in [Vec2::X, Vec2::Y] {
                let energy = |step: f64| {
                    let mut moved = markers.clone();
                    moved[k] += step * axis;
                    bending.energy(&moved, 0.0).unwrap()
                };
                let gradient = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                assert!((force.dot(axis) + gradient).abs() < 1e-7, "{k}: {force:?} {gradient}");
            }
        }
    }
    // A circle of radius R has the energy pi B (1 - kappa0 R)^2/R.
    let circle: Vec<Vec2> =
        (0..count).map(|k| 2.0 * Vec2::from_angle(std::f64::consts::TAU * k as f64 / 24.0)).collect();
    let bending = Bending::new(0.4, 0.2, count).unwrap();
    let exact = std::f64::consts::PI * 0.4 * 0.6_f64.powi(2) / 2.0;
    assert!((bending.energy(&circle, 0.0).unwrap() / exact - 1.0).abs() < 1e-12);
}

/// A membrane is at rest in the shape that it was made of, however bent.
#[test]
fn a_bent_membrane_is_at_rest_where_it_was_made() {
    let period = 3.0;
    let at = |k: usize| {
        let x = period * k as f64 / 64.0;
        Vec2::new(x, 0.4 * (std::f64::consts::TAU * x / period).sin())
    };
    let markers: Vec<Vec2> = (0..64).map(at).collect();
    let advance = Vec2::new(period, 0.0);
    let mut membrane = Membrane::new([2.0, 0.5], &markers, advance).unwrap();
    let mut forces = vec![Vec2::ZERO; 64];
    membrane.move_to(&markers, advance).unwrap();
    membrane.add_forces(&mut forces).unwrap();
    assert!(forces.iter().all(|force| force.length() < 1e-10), "{forces:?}");
    let pressed: Vec<Vec2> = markers.iter().map(|x| *x * Vec2::new(1.0, 0.5)).collect();
    membrane.move_to(&pressed, advance).unwrap();
    membrane.add_forces(&mut forces).unwrap();
    assert!(forces.iter().any(|force| force.length() > 1e-2));
}

/// An elastic interface whose points are pressed together is refused at the end of a step, with the place.
#[test]
fn crushed_interfaces_are_refused() {
    let turn = std::f64::consts::TAU;
    let body = |part: f64| {
        let flat = crate::wave(0.5, 6.0, &[], &[], 64).unwrap();
        let mut body = ActiveInterface::periodic_passive(&flat, 6.0, 1.0).unwrap().with_motion(Motion::WithFluid);
        body = body.with_elasticity(3.0, 0.1).unwrap();
        let view = Converging { smooth: true }.fluid_view();
        body.write_forces(&view, &mut [Vec2::ZERO; 64]).unwrap();
        // The stretch is 1 - part cos(2 pi x/L).
        let pressed = flat.iter().map(|x| x.x - part * 6.0 / turn * (turn * x.x / 6.0).sin());
        let state: Vec<f64> = pressed.flat_map(|x| [x, 0.5]).collect();
        body.read_state(&state).unwrap();
        body.end_step(&view, 0.01)
    };
    body(0.85).unwrap();
    let error = body(0.95).unwrap_err().to_string();
    assert!(error.contains("compressed to 0.050 of its length") && error.contains(", 0.5000)"), "{error}");
}

/// Particles of a body of revolution lie on rings: numbers that differ on the two sides of the axis are refused.
#[test]
fn particles_on_one_side_of_the_axis_are_refused() {
    let markers = Curve::circle(1.0).unwrap().markers(40).unwrap();
    let droplet = |start: InitialConcentration| {
        let numbers = start.particle_numbers(&markers).unwrap();
        let law = ContractileTension::new(10.0, -1.0, crate::ExcludedVolume::None, 1.0).unwrap();
        ActiveDroplet::new(&markers, numbers, law, 0.1).unwrap().axisymmetric()
    };
    let perturbed = || InitialConcentration::perturbed(100.0, 0.1, 3).unwrap();
    for start in [perturbed(), InitialConcentration::polarised(100.0, 0.3).unwrap()] {
        let error = droplet(start).unwrap_err();
        let text = "the particles of an axisymmetric interface are not symmetric: segment 0 has ";
        assert!(refused(&error, text), "{error}");
    }
    for start in [perturbed().axisymmetric(), InitialConcentration::polarised(100.0, std::f64::consts::PI).unwrap()] {
        assert!(droplet(start).is_ok());
    }
}

/// A view of a grid of the spacing 0.1 with corrected velocities, in a region of these periods and walls.
fn on_grid(periods: [Option<f64>; 2], walls: Option<[f64; 2]>) -> FluidView {
    let domain = Domain { origin: [0.0; 2], periods: periods.into(), walls };
    FluidView { domain, ..Converging { smooth: false }.fluid_view() }
}

/// A round swimmer that carries its particles fast enough for the stresslet not to be resolved.
fn fast_swimmer(centre: Vec2) -> ActiveDroplet {
    let markers = Curve::circle(1.0).unwrap().translated(centre).markers(64).unwrap();
    let numbers = InitialConcentration::polarised(1.0, 0.4).unwrap().particle_numbers(&markers).unwrap();
    let law = ContractileTension::thesis(1.0, -0.5, 2.0, 1.0).unwrap();
    let mut droplet = ActiveDroplet::new(&markers, numbers, law, 0.05).unwrap();
    droplet.interface.derived.slip = vec![0.2; 64];
    droplet
}

/// Excess of the warning about the stresslet.
fn excess_of_stresslet(droplet: &ActiveDroplet, view: &FluidView) -> f64 {
    let warnings = droplet.warnings(view);
    warnings.iter().find(|warning| warning.cause == "stresslet not resolved").map_or(0.0, |warning| warning.excess)
}

/// Beside the upper wall as beside the lower one, and between images above and below as between those on both sides.
#[test]
fn warnings_about_stresslets_see_both_walls_and_all_images() {
    let walls = |y: f64| excess_of_stresslet(&fast_swimmer(Vec2::new(0.0, y)), &on_grid([None; 2], Some([-2.0, 2.0])));
    let [low, middle, high] = [-0.4, 0.0, 0.4].map(walls);
    assert!(middle > 1.0 && high > 1.1 * middle && (low / high - 1.0).abs() < 1e-9, "{low} {middle} {high}");
    let images = |periods| excess_of_stresslet(&fast_swimmer(Vec2::ZERO), &on_grid(periods, None));
    let [far, beside, above] = [[None; 2], [Some(2.4), None], [None, Some(2.4)]].map(images);
    assert!(far > 1.0 && above > 1.1 * far && (beside / above - 1.0).abs() < 1e-9, "{far} {beside} {above}");
    let both = images([Some(2.4), Some(2.8)]);
    assert!((both / beside - 1.0).abs() < 1e-9, "{both} {beside}");
}

/// A body of revolution that has lost a part of its volume gets it back in one step, wherever it is.
#[test]
fn a_step_restores_the_volume_of_a_body_of_revolution() {
    let curve = Curve::ellipse(1.3, 0.8).unwrap().translated(Vec2::new(5.0, 0.0));
    let markers = curve.markers(64).unwrap();
    for factor in [0.97, 1.0, 1.04] {
        let droplet = ActiveDroplet::passive(&markers, 1.0).unwrap().axisymmetric().unwrap();
        let mut droplet = droplet.with_bounds(1.0, 1.0).unwrap();
        let volume = droplet.interface.initial_area();
        let mut state = vec![0.0; droplet.state_len()];
        droplet.write_state(&mut state);
        let size = |x: f64| 5.0 + factor * (x - 5.0);
        state.chunks_exact_mut(2).for_each(|place| (place[0], place[1]) = (size(place[0]), factor * place[1]));
        droplet.read_state(&state).unwrap();
        assert!((droplet.interface.area() / volume - factor.powi(3)).abs() < 1e-12);
        droplet.end_step(&Converging { smooth: true }.fluid_view(), 0.01).unwrap();
        assert!((droplet.interface.area() / volume - 1.0).abs() < 1e-10, "{factor}: {}", droplet.interface.area());
        let middle = 0.5 * (droplet.markers()[0] + droplet.markers()[32]);
        assert!(middle.distance(Vec2::new(5.0, 0.0)) < 1e-12, "{middle}");
    }
}

/// Implicit exchange takes from inside as many particles as it gives to the interface.
#[test]
fn implicit_exchange_keeps_the_number_of_particles() {
    let exchange = crate::Exchange::new(0.3, 0.7).unwrap();
    let mut droplet = droplet(Motion::default()).with_well_mixed_interior(exchange, 5.0).unwrap();
    droplet.begin_step(&Converging { smooth: false }.fluid_view(), motion_step()).unwrap();
    let (len, markers) = (droplet.state_len(), droplet.markers().len());
    let mut state = vec![0.0; len];
    droplet.write_state(&mut state);
    let mut change = vec![0.0; len];
    droplet.add_implicit(&state, 0.1, &mut change);
    let (gained, lost) = (change[2 * markers..len - 1].iter().sum::<f64>(), -change[len - 1]);
    let flux = droplet.exchange_flux().unwrap();
    assert!((gained - 0.1 * flux).abs() < 1e-12 && (lost - 0.1 * flux).abs() < 1e-12, "{gained} {lost} {flux}");
}

fn motion_step() -> StepInfo {
    StepInfo { dt: 0.1, stabilised: false }
}

/// Observables of a droplet in a scene are those of its own viscosity inside and of the fluid's outside.
#[test]
fn observables_know_the_viscosities_on_both_sides() {
    use crate::observables::InterfaceState;
    for inside in [None, Some(3.0)] {
        let mut scene = Scene::new(Converging { smooth: true });
        let droplet = droplet(Motion::default());
        let droplet = inside.map_or(droplet.clone(), |inside| droplet.with_viscosity_inside(inside).unwrap());
        let handle = scene.add(droplet);
        scene.system_mut().evaluate().unwrap();
        let state = InterfaceState::of(scene.system(), handle).unwrap();
        assert_eq!(state.viscosities, [inside.unwrap_or(1.0), 1.0]);
    }
}
