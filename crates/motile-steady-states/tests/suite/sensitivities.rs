//! Sensitivities of steady states against exact values, scaling laws and differences of states.

use motile::active_interface::Cortex;
use motile::base::TubeShape;
use motile::prelude::*;
use motile::setup::{ExchangeSetup, RigidBodySetup};
use motile_steady_states::{Continuation, Eigenmode, Parameter as P, Sensitivities, SteadyState, Symmetry};

fn setup(region: Region, activity: f64, nodes: usize) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
    Setup { method, region, droplets: vec![DropletSetup::contractile(activity, 10.0)], ..Setup::default() }
}

fn of(sensitivities: &Sensitivities, observable: &str, parameter: P) -> f64 {
    sensitivities.derivative(observable, parameter).unwrap_or_else(|| panic!("{observable} by {}", parameter.name()))
}

fn value(sensitivities: &Sensitivities, observable: &str) -> f64 {
    sensitivities.observables.iter().find(|(name, _)| *name == observable).expect("as described").1
}

#[test]
fn a_swimmer_in_a_box_agrees_with_differences_of_converged_states() {
    // Central differences of steady states at 0.5, 1 and 2 % with Richardson's extrapolation, at 128 and 160 nodes.
    // They redistribute their nodes, which is seen in the derivatives by the tension: those are of 256 nodes.
    let state = SteadyState::find(&setup(Region::Box { lengths: [6.0; 2] }, -2.0, 128)).unwrap();
    let found = state.sensitivities().unwrap();
    assert!((value(&found, "speed") - 0.1302737388689).abs() < 1e-9);
    for (observable, parameter, value, error) in [
        ("speed", P::Activity, -0.049534872154, 1e-7),
        ("speed", P::ViscosityInside, -3.9994862307e-4, 1e-7),
        ("speed", P::Tension, 6.98180608e-6, 3e-7),
        ("stresslet", P::Activity, -11.07171, 3e-7),
        ("stresslet", P::ViscosityInside, 0.1452885064, 1e-7),
        ("stresslet", P::Tension, 0.00251311667, 5e-6),
        ("aspect_ratio", P::Activity, 0.0104625894, 1e-6),
        ("aspect_ratio", P::ViscosityInside, -1.592932746e-4, 1e-6),
        ("aspect_ratio", P::Tension, -2.64302941e-4, 1e-6),
    ] {
        let ours = of(&found, observable, parameter);
        println!("{observable} {}: {ours} {:.1e}", parameter.name(), ours / value - 1.0);
        assert!((ours / value - 1.0).abs() < error, "{observable} by {}: {ours}", parameter.name());
    }
}

#[test]
fn a_swimmer_in_the_plane_agrees_with_exact_one_dimensional_equations() {
    // Newton's method on c_t = -(c v)_th/R + D c_thth/R^2, an independent program.
    for (activity, by_activity) in [(-0.5, -0.1144916239), (-2.0, -0.04985108)] {
        let state = SteadyState::find(&setup(Region::Plane, activity, 96)).unwrap();
        let found = state.sensitivities().unwrap();
        let ours = of(&found, "speed", P::Activity);
        println!("{activity}: {ours} {:.1e}", ours - by_activity);
        assert!((ours - by_activity).abs() < 2e-8, "{ours}");
        // The droplet stays round, and its viscosities count by their sum.
        assert!(of(&found, "aspect_ratio", P::Activity).abs() < 1e-7);
        let [inside, outside] = [P::ViscosityInside, P::ViscosityOutside].map(|p| of(&found, "speed", p));
        assert!((inside / outside - 1.0).abs() < 1e-6, "{inside} {outside}");
    }
}

/// Turning and speed by gradients of the activity, and rotational diffusion by the noise of the particles, of the same
/// program for the circle.
#[test]
fn gradients_and_noise_guide_a_swimmer_as_exact_one_dimensional_equations_have_it() {
    for (activity, nodes, [turning, speed, diffusion], error) in [
        (-0.41, 32, [0.5606201287, 1.0369713237, 0.0015361582547], 1e-6),
        (-0.5, 64, [0.338877999, 0.1558031208, 0.0006436627898], 1e-6),
        (-2.0, 128, [0.08045977, 0.02027236, 0.0002081379], 1e-5),
    ] {
        let state = SteadyState::find(&setup(Region::Plane, activity, nodes)).unwrap();
        let found = state.guidance().unwrap();
        println!("{activity}: {found:?} against {turning} {speed} {diffusion}");
        for (found, exact) in [(found.turning, turning), (found.speed, speed), (found.rotational_diffusion, diffusion)]
        {
            assert!((found / exact - 1.0).abs() < error, "{activity}: {found} {exact}");
        }
    }
    // In other units: lengths times 1e-6, viscosities times 1e-3, times as they are.
    let state = SteadyState::find(&setup(Region::Plane, -0.5, 48)).unwrap();
    let mut small = setup(Region::Plane, -0.5, 48);
    let (length, viscosity) = (1e-6, 1e-3);
    let force = viscosity * length;
    small.viscosity *= viscosity;
    let droplet = &mut small.droplets[0];
    droplet.viscosity = droplet.viscosity.map(|inside| inside * viscosity);
    droplet.shape = motile::setup::DropletShape::Round { radius: length };
    droplet.tension *= force;
    let particles = droplet.particles.as_mut().unwrap();
    particles.diffusion *= length * length;
    particles.concentration /= length;
    particles.activity *= force * length;
    if let motile::setup::ExcludedVolume::Step(strength) = &mut particles.excluded_volume {
        *strength *= force * length;
    }
    let [own, other] = [state, SteadyState::find(&small).unwrap()].map(|state| state.guidance().unwrap());
    // The slope is an activity over a length.
    let slope = force;
    assert!((other.turning * slope / own.turning - 1.0).abs() < 1e-6, "{own:?} {other:?}");
    assert!((other.speed * slope / (length * own.speed) - 1.0).abs() < 1e-6, "{own:?} {other:?}");
    assert!((other.rotational_diffusion / own.rotational_diffusion - 1.0).abs() < 1e-6, "{own:?} {other:?}");
    let in_box = SteadyState::find(&setup(Region::Box { lengths: [6.0; 2] }, -0.5, 40)).unwrap();
    assert!(in_box.guidance().unwrap_err().to_string().contains("plane"));
    let at_rest = SteadyState::uniform(&setup(Region::Plane, -0.2, 32)).unwrap();
    assert!(at_rest.guidance().unwrap_err().to_string().contains("at rest"));
}

/// Largest defects of the scaling laws in units of force, time and number of particles, and in the unit of length,
/// relative to the observables.
///
/// In other units of force, for example, all parameters change by powers of a factor, and an observable changes by its
/// own power: the sum of power times parameter times derivative is that power times the observable. Nodes stay where
/// they are if the radius changes, so that the law of lengths holds up to the errors of nodes.
fn defects(found: &Sensitivities, space: bool) -> [f64; 2] {
    let dimensions = if space { 2 } else { 1 };
    // Powers of force, time, length and particles. Tensions are forces in two dimensions, and forces per length in
    // three.
    let of_parameter = |parameter: P| match parameter {
        P::Activity | P::ExcludedVolume => [1, 0, 1, -1],
        P::Diffusion => [0, -1, 2, 0],
        P::Tension => [1, 0, 1 - dimensions, 0],
        P::ViscosityInside | P::ViscosityOutside => [1, 1, -dimensions, 0],
        P::Cortex | P::CortexShear => [1, 1, 1 - dimensions, 0],
        P::CortexPerConcentration => [1, 1, 1, -1],
        P::Friction => [1, 1, -1 - dimensions, 0],
        P::Concentration => [0, 0, -dimensions, 1],
        P::Binding => [0, -1, 1, 0],
        P::Unbinding | P::ShearRate | P::ExtensionRate => [0, -1, 0, 0],
        P::PressureGradient => [1, 0, -1 - dimensions, 0],
        P::Radius | P::Width | P::Length | P::BoxX | P::BoxY | P::TubeRadius => [0, 0, 1, 0],
        other => panic!("{}", other.name()),
    };
    let of_observable = |name: &str| match name {
        "speed" => [0, -1, 1, 0],
        "stresslet" => [1, 0, 1, 0],
        "perimeter" => [0, 0, dimensions, 0],
        _ => [0; 4],
    };
    let mut worst = [0.0_f64; 2];
    // A droplet at rest has no speed, and one without particles no concentrations.
    for (name, value) in found.observables.iter().filter(|(_, value)| *value != 0.0) {
        for unit in 0..4 {
            let term = |parameter: P, parameter_value: f64| {
                f64::from(of_parameter(parameter)[unit]) * parameter_value * of(found, name, parameter)
            };
            let sum: f64 = found.parameters.iter().map(|entry| term(entry.parameter, entry.value)).sum();
            let kind = &mut worst[usize::from(unit == 2)];
            *kind = kind.max((sum / value - f64::from(of_observable(name)[unit])).abs());
        }
    }
    worst
}

/// Derivatives by lengths that the nodes do not resolve are told, with the defect of the scaling law, and others not.
#[test]
fn derivatives_by_lengths_that_nodes_do_not_resolve_are_told() {
    let channel = Region::Channel { length: 8.0, width: 4.0, drive: Drive::Gradient(-0.5) };
    let mut told = [false; 2];
    for (nodes, bound) in [(48, 0.01), (160, 0.01)] {
        let found = SteadyState::find(&setup(channel, -2.0, nodes)).unwrap().sensitivities().unwrap();
        let [_, defect] = defects(&found, false);
        println!("{nodes}: {defect:.1e} {:?}", found.warning);
        let warned = found.warning.as_ref().is_some_and(|warning| warning.contains("derivatives by lengths"));
        assert_eq!(warned, defect > bound, "{nodes}: {defect:.1e} {:?}", found.warning);
        told[usize::from(nodes > 100)] = warned;
    }
    assert_eq!(told, [true, false]);
}

/// A cortex, or friction, of exactly zero has a derivative from above: as differences of states on that side have it.
#[test]
fn resistances_of_zero_have_derivatives_from_above() {
    let in_space = setup(Region::Space, -1.0, 32);
    let in_box = setup(Region::Box { lengths: [6.0; 2] }, -1.0, 40);
    for (start, parameter) in
        [(&in_box, P::Cortex), (&in_box, P::Friction), (&in_space, P::Cortex), (&in_space, P::CortexShear)]
    {
        let state = SteadyState::find(start).unwrap();
        let found = state.sensitivities().unwrap();
        assert_eq!(parameter.get(start), Some(0.0));
        let step = 2.0;
        let [near, middle, far] = [1.0, 2.0, 3.0]
            .map(|steps| state.follow(&parameter.with(start, steps * step).unwrap()).unwrap().velocity().length());
        let speed = state.velocity().length();
        let expected = (18.0 * near - 9.0 * middle + 2.0 * far - 11.0 * speed) / (6.0 * step);
        let ours = of(&found, "speed", parameter);
        println!("{} {:?}: {ours} {:.1e}", parameter.name(), start.region, ours / expected - 1.0);
        assert!((ours / expected - 1.0).abs() < 1e-3 && ours.abs() > 1e-7, "{ours} {expected}");
    }
    assert!(P::Friction.get(&in_space).is_none() && P::CortexShear.get(&in_box).is_none());
}

#[test]
fn derivatives_obey_the_laws_of_scaling() {
    let cortex = Cortex { per_concentration: 0.3, ..Cortex::new(40.0) };
    let in_space = Cortex { shear_viscosity: 20.0, ..Cortex::new(40.0) };
    let channel = |drive| Region::Channel { length: 8.0, width: 4.0, drive };
    for (region, cortex, friction) in [
        (Region::Plane, cortex, 0.0),
        (Region::Box { lengths: [5.0, 7.0] }, Cortex::default(), 10.0),
        (channel(Drive::ZeroGradient), cortex, 0.0),
        (channel(Drive::Gradient(-0.3)), Cortex::default(), 0.0),
        (Region::Space, in_space, 0.0),
    ] {
        let mut setup = setup(region, -0.8, if region == Region::Space { 32 } else { 40 });
        setup.viscosity = 140.0;
        let droplet = &mut setup.droplets[0];
        (droplet.viscosity, droplet.cortex, droplet.friction) = (Some(60.0), cortex, friction);
        let mut found = SteadyState::find(&setup).unwrap().sensitivities().unwrap();
        let [units, lengths] = defects(&found, region.is_axisymmetric());
        println!("{region:?}: {units:.1e}, {lengths:.1e}");
        assert!(units < 1e-9, "{units}");
        assert!(lengths < 0.04, "{lengths}");
        // A fault shows, except for parameters that are zero, which have no part in the laws.
        for k in (0..found.parameters.len()).filter(|k| found.parameters[*k].value != 0.0).collect::<Vec<_>>() {
            let right = found.parameters[k].derivatives.clone();
            let value = found.parameters[k].value;
            let sizes = found.observables.iter().map(|(_, size)| 0.1 * size / value);
            found.parameters[k].derivatives.iter_mut().zip(sizes).for_each(|(derivative, fault)| *derivative += fault);
            let worst = defects(&found, region.is_axisymmetric());
            assert!(worst[0] > 1e-2 || worst[1] > 2.0 * lengths, "{}", found.parameters[k].parameter.name());
            found.parameters[k].derivatives = right;
        }
    }
}

#[test]
fn the_law_of_lengths_holds_better_with_more_nodes() {
    let lengths = [48, 96].map(|nodes| {
        let state = SteadyState::find(&setup(Region::Box { lengths: [5.0, 7.0] }, -0.8, nodes)).unwrap();
        defects(&state.sensitivities().unwrap(), false)[1]
    });
    println!("{lengths:?}");
    assert!(lengths[1] < 0.01 * lengths[0] && lengths[1] < 1e-5, "{lengths:?}");
}

/// Checks the sensitivities of a state against differences of states, of fourth order, and of a growth rate if there
/// is a tolerance for it, the noise of Jacobians.
fn agrees_with_differences(setup: &Setup, of_growth: Option<f64>) {
    let state = SteadyState::find(setup).expect("as described");
    let symmetric = |state: &SteadyState| {
        let mut modes = state.spectrum().expect("as described").modes.into_iter();
        modes.find(|mode| mode.symmetry == Symmetry::Symmetric).expect("as described")
    };
    let modes: Vec<Eigenmode> = of_growth.iter().map(|_| symmetric(&state)).collect();
    let found = state.sensitivities_with(&modes).expect("as described");
    let names = ["speed", "stresslet", "aspect_ratio", "c_max", "c_min", "perimeter"];
    assert_eq!(found.observables.iter().map(|(name, _)| *name).take(6).collect::<Vec<_>>(), names);
    // At zero there is no other side.
    for entry in found.parameters.iter().filter(|entry| entry.value != 0.0) {
        let at = |by: f64| {
            let state = state.at(entry.parameter, entry.value + by).expect("as described");
            let seen = state.measured().expect("as described");
            let [most, least] = seen.concentration;
            let rate = of_growth.map_or(state.turning_rate(), |_| symmetric(&state).value.re);
            [seen.speed, seen.stresslet, seen.aspect_ratio, most, least, seen.perimeter, rate]
        };
        let step = 1e-3 * entry.value.abs();
        let slope = |step: f64| {
            let (above, below) = (at(step), at(-step));
            std::array::from_fn::<_, 7, _>(|k| (above[k] - below[k]) / (2.0 * step))
        };
        let (fine, coarse) = (slope(step), slope(2.0 * step));
        for (k, (name, value)) in found.observables.iter().enumerate() {
            let error = (entry.derivatives[k] - (4.0 * fine[k] - coarse[k]) / 3.0) * entry.value;
            let error = error / value.abs().max((entry.derivatives[k] * entry.value).abs()).max(1e-4);
            println!("{} {name}: {error:.1e}", entry.parameter.name());
            let tolerance = of_growth.filter(|_| k == 6).unwrap_or(3e-8);
            assert!(error.abs() < tolerance, "{name} by {}: {error}", entry.parameter.name());
        }
    }
}

#[test]
fn derivatives_agree_with_differences_of_states() {
    let mut in_box = setup(Region::Box { lengths: [5.0, 7.0] }, -0.8, 32);
    in_box.droplets[0].cortex = Cortex { per_concentration: 0.3, ..Cortex::new(40.0) };
    let channel = Region::Channel { length: 8.0, width: 4.0, drive: Drive::Gradient(-0.3) };
    let mut in_channel = setup(channel, -0.8, 32);
    in_channel.droplets[0].viscosity = Some(60.0);
    let mut in_space = setup(Region::Space, -0.7, 28);
    in_space.droplets[0].viscosity = Some(60.0);
    agrees_with_differences(&in_box, None);
    agrees_with_differences(&in_channel, Some(3e-6));
    agrees_with_differences(&in_space, None);
}

#[test]
fn derivatives_with_exchange_and_nucleus_agree_with_differences_of_states() {
    // Exchange with an inside that holds other particles than at rest, which diffuse there or do not.
    let mut exchanging = setup(Region::Plane, -1.0, 32);
    let exchange = ExchangeSetup { number_inside: Some(60.0), ..ExchangeSetup::new(0.2, 0.02) };
    exchanging.droplets[0].particles.as_mut().unwrap().exchange = Some(exchange);
    agrees_with_differences(&exchanging, None);
    // A nucleus aside, which makes the droplet swim in circles.
    let mut nucleated = setup(Region::Plane, -2.0, 48);
    nucleated.rigid_bodies = vec![RigidBodySetup { centre: [0.0, 0.4], ..RigidBodySetup::disc(0.5) }];
    agrees_with_differences(&nucleated, None);
}

/// A drop without particles that tank-treads in shear.
#[test]
fn derivatives_of_a_drop_in_shear_obey_the_laws_of_scaling() {
    let flow = FlowSetup { shear: 1.0, ..FlowSetup::default() };
    let drop = DropletSetup { viscosity: Some(2.0), ..DropletSetup::passive(5.0) };
    let sheared = Setup { flow, viscosity: 1.0, droplets: vec![drop], ..setup(Region::Plane, 0.0, 48) };
    let found = SteadyState::find(&sheared).unwrap().sensitivities().unwrap();
    let [units, lengths] = defects(&found, false);
    println!("{found}\n{units:.1e} {lengths:.1e}");
    assert!(units < 1e-8 && lengths < 1e-4, "{units} {lengths}");
    assert!(of(&found, "stresslet", P::ShearRate).abs() > 1e-3 && value(&found, "speed") == 0.0);
}

#[test]
fn thresholds_and_growth_rates_at_rest_agree_with_linear_theory() {
    let mut setup = setup(Region::Plane, -0.41, 24);
    setup.droplets[0].viscosity = Some(60.0);
    setup.droplets[0].cortex = Cortex::new(50.0);
    let rest = SteadyState::uniform(&setup).unwrap();
    // s = -(zeta + B(c0)) c0/(2 R E) - D/R^2 with E = eta_in + eta_ext + eta_s/(2 R), and B(c0)/A for c_T = 2 c0.
    let (sum, pressure) = (185.0, 4.539787e-5);
    let effective = -0.41 + 10.0 * pressure;
    let rate = -effective * 100.0 / (2.0 * sum) - 0.1;
    let by_sum = effective * 100.0 / (2.0 * sum * sum);
    for symmetry in [Symmetry::Symmetric, Symmetry::Antisymmetric] {
        let spectrum = rest.spectrum().unwrap();
        let mode = spectrum.modes.iter().find(|mode| mode.symmetry == symmetry).unwrap().clone();
        let critical = rest.critical(&mode, P::Activity).unwrap().sensitivities(P::Activity).unwrap();
        let rates = rest.sensitivities_with(&[mode]).unwrap();
        assert!((value(&rates, "growth_rate") - rate).abs() < 1e-9);
        let threshold = -2.0 * 0.1 / 100.0 * sum - 10.0 * pressure;
        assert!((value(&critical, "activity") - threshold).abs() < 1e-8);
        for (parameter, of_threshold, of_rate) in [
            (P::Activity, f64::NAN, -50.0 / sum),
            (P::ExcludedVolume, -pressure, -50.0 / sum * pressure),
            (P::Diffusion, -3.7, -1.0),
            (P::Tension, 0.0, 0.0),
            (P::ViscosityInside, -2e-3, by_sum),
            (P::ViscosityOutside, -2e-3, by_sum),
            (P::Cortex, -1e-3, 0.5 * by_sum),
            (P::Concentration, 3.7e-3, -effective / (2.0 * sum)),
            (P::Radius, 0.42, effective * 50.0 / sum - 25.0 * by_sum + 0.2),
        ] {
            let error = of(&rates, "growth_rate", parameter) - of_rate;
            println!("{} {error:.1e}", parameter.name());
            assert!(error.abs() < 1e-8, "{}: {error}", parameter.name());
            // A droplet at rest stays at rest.
            assert!(of(&rates, "speed", parameter).abs() < 1e-9);
            if parameter != P::Activity {
                let error = of(&critical, "activity", parameter) - of_threshold;
                assert!(error.abs() < 1e-8, "{}: {error}", parameter.name());
            }
        }
    }
}

/// The wall of a tube has errors of its own, which change a little where it is made anew.
#[test]
#[ignore = "takes half a minute"]
fn derivatives_in_a_tube_obey_the_laws_of_scaling() {
    let region = Region::Tube { radius: 2.0, shape: TubeShape::default(), drive: Drive::ZeroFlux, length: None };
    let mut setup = setup(region, -1.0, 40);
    setup.droplets[0].viscosity = Some(60.0);
    let [units, lengths] = defects(&SteadyState::find(&setup).unwrap().sensitivities().unwrap(), true);
    println!("{units:.1e} {lengths:.1e}");
    assert!(units < 1e-6 && lengths < 0.1, "{units} {lengths}");
}

/// A branch along the radius leads to the droplet that is found there.
#[test]
fn branches_along_radius_and_concentration_lead_to_the_states_there() {
    let start = SteadyState::find(&setup(Region::Box { lengths: [6.0; 2] }, -0.8, 40)).unwrap();
    for (parameter, from, to) in [(P::Radius, 1.0, 1.1), (P::Concentration, 100.0, 110.0), (P::BoxX, 6.0, 5.5)] {
        let branch = Continuation::new(parameter, from, to).follow(&start, |_, _| true).unwrap();
        let last = branch.points.last().unwrap();
        assert!((last.value - to).abs() < 1e-9 * to, "{}", last.value);
        let direct = SteadyState::find(&parameter.with(start.setup(), to).unwrap()).unwrap();
        let speeds = [&last.state, &direct].map(|state| state.measured().unwrap().speed);
        println!("{} {} {speeds:?}", parameter.name(), branch.points.len());
        assert!((speeds[0] / speeds[1] - 1.0).abs() < 1e-4, "{speeds:?}");
    }
}

#[test]
fn shapes_and_concentrations_agree_with_differences_of_followed_states() {
    let start = setup(Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroGradient }, -0.7, 48);
    let state = SteadyState::find(&start).unwrap();
    let parameters = [P::Activity, P::ViscosityOutside, P::Width];
    let some = state.sensitivities_by(&parameters, &[]).unwrap();
    let all = state.sensitivities().unwrap();
    for change in state.profile_sensitivities(&parameters).unwrap() {
        let parameter = change.parameter;
        assert_eq!(of(&some, "speed", parameter), of(&all, "speed", parameter));
        // Nodes move along fixed normals, so that differences of places at nodes are derivatives.
        let value = parameter.get(&start).unwrap();
        let step = 1e-3 * value.abs();
        let [below, above] = [-step, step].map(|by| {
            let moved = parameter.with(&start, value + by).unwrap();
            let moved = state.follow(&moved).unwrap();
            let (_, concentrations) = moved.profile().concentrations().unwrap();
            (moved.profile().positions.clone(), concentrations)
        });
        let slope = |k: usize| (above.0[k] - below.0[k]) / (2.0 * step);
        let (most, most_c) = (0..48).fold((0.0_f64, 0.0_f64), |(x, c), k| {
            (x.max(change.positions[k].length()), c.max(change.concentrations[k].abs()))
        });
        assert!(most > 0.0 && most_c > 0.0);
        for k in 0..48 {
            let off = (change.positions[k] - slope(k)).length() / most;
            let off_c = (change.concentrations[k] - (above.1[k] - below.1[k]) / (2.0 * step)).abs() / most_c;
            assert!(off < 1e-3 && off_c < 1e-3, "{} at {k}: {off:.1e} {off_c:.1e}", parameter.name());
        }
    }
    assert!(state.profile_sensitivities(&[P::TubeRadius]).is_err() && state.sensitivities_by(&[P::BoxX], &[]).is_err());
    // With another number of nodes, the state is found on these.
    let finer = state.follow(&setup(start.region, -0.7, 64)).unwrap();
    assert!(
        finer.profile().nodes() == 64 && (finer.measured().unwrap().speed / value(&all, "speed") - 1.0).abs() < 1e-5
    );
}
