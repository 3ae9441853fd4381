//! Droplets in fields, compared with closed forms and with independent computations on the circle.

use motile_base::{Drive, Region};
use motile_scene::StepSize;

use super::*;
use crate::setup::{
    Built, DropletSetup, ExchangeSetup, ExcludedVolume, GridMethod, IntegralMethod, InterfaceSetup, Method, Start,
};

fn gradient(slope: [f64; 2], origin: [f64; 2]) -> Vec<FieldEntry> {
    vec![FieldEntry { gradient: Some(GradientSetup { slope, origin }), ..FieldEntry::default() }]
}

fn wave(amplitude: f64, wave: f64, frequency: f64) -> Vec<FieldEntry> {
    let wave = WaveSetup { amplitude, wave_vector: [wave, 0.0], frequency, phase: 0.0 };
    vec![FieldEntry { wave: Some(wave), ..FieldEntry::default() }]
}

fn of_tension(tension: Vec<FieldEntry>) -> FieldsSetup {
    FieldsSetup { tension, ..FieldsSetup::default() }
}

fn of_activity(activity: Vec<FieldEntry>) -> FieldsSetup {
    FieldsSetup { activity, ..FieldsSetup::default() }
}

/// Returns a scene of one droplet by integrals.
fn alone(region: Region, droplet: DropletSetup, [nodes, elements]: [usize; 2]) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements });
    Setup { region, method, droplets: vec![droplet], ..Setup::default() }
}

fn velocity(setup: &Setup) -> [f64; 2] {
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let velocity = scene.observe(droplets[0]).unwrap().velocity;
    [velocity.x, velocity.y]
}

#[test]
fn a_gradient_of_tension_carries_a_drop_in_the_plane_at_every_viscosity_ratio_and_in_any_units() {
    // V = -G R/(4 (eta_in + eta_ext)).
    for (radius, inside, outside, slope) in
        [(1.0, 100.0, 100.0, 1.0), (1.0, 10.0, 100.0, 1.0), (2.0, 1000.0, 100.0, 3.0), (1e-6, 1e-3, 2e-3, 1e2)]
    {
        let centre = [0.3 * radius, -0.2 * radius];
        let drop = DropletSetup {
            centre,
            viscosity: Some(inside),
            fields: of_tension(gradient([0.6 * slope, -0.8 * slope], [radius, 0.0])),
            ..DropletSetup::passive(10.0 * slope * radius)
        };
        let drop = drop.with_radius(radius);
        let setup = Setup { viscosity: outside, ..alone(Region::Plane, drop, [32, 64]) };
        let expected = slope * radius / (4.0 * (inside + outside));
        let [u, v] = velocity(&setup);
        let error = (u / expected + 0.6).abs().max((v / expected - 0.8).abs());
        let bound = if inside == outside { 1e-9 } else { 1e-7 };
        assert!(error < bound, "R {radius}, {inside}/{outside}: {error:e}");
    }
}

#[test]
fn a_gradient_of_tension_carries_a_drop_in_space() {
    // V = -2 G R/(3 (2 eta_ext + 3 eta_in)).
    for (inside, outside, expected) in [(100.0, 100.0, 1.333_333_333_33e-3), (300.0, 50.0, 6.666_666_666_67e-4)] {
        let fields = of_tension(gradient([1.0, 0.0], [0.0; 2]));
        let drop = DropletSetup { viscosity: Some(inside), fields, ..DropletSetup::passive(10.0) };
        let setup = Setup { viscosity: outside, ..alone(Region::Space, drop, [48, 96]) };
        let [u, v] = velocity(&setup);
        assert!((u / expected + 1.0).abs() < 1e-5 && v == 0.0, "{inside}/{outside}: {u:e} {v:e}");
    }
}

#[test]
fn a_drop_goes_to_the_trough_of_a_standing_wave_of_tension() {
    // sin(q x(t)) = tanh(artanh sin(q x(0)) - q W t), W = a J_1(q R)/(2 Sigma).
    for (amplitude, q, start, viscosity, time, expected, at_once) in [
        (10.0, 1.0, 0.3, 100.0, 20.0, 0.084_478_021_810_5, -0.010_509_909_540_6),
        (5.0, 0.7, 1.0, 50.5, 40.0, 0.733_141_922_552, -0.006_228_460_954_62),
    ] {
        let fields = of_tension(wave(amplitude, q, 0.0));
        let drop = DropletSetup { centre: [start, 0.0], fields, ..DropletSetup::passive(10.0) };
        let setup = Setup { viscosity, ..alone(Region::Plane, drop, [32, 64]) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let first = scene.observe(droplets[0]).unwrap().velocity.x;
        assert!((first / at_once - 1.0).abs() < 1e-9, "{first}");
        scene.run(time).step_size(StepSize::Adaptive { tolerance: 1e-6 }).go().unwrap();
        let place = scene.observe(droplets[0]).unwrap().centroid.x;
        assert!((place - expected).abs() < 2e-6, "{place}");
    }
}

#[test]
fn a_moving_wave_of_tension_drags_a_drop_along() {
    // (om - sqrt(om^2 - q^2 W^2))/q in the mean, over whole periods of the motion relative to the wave.
    let (amplitude, q, frequency, viscosity, mean) = (20.0, 2.0, 0.06, 100.0, 0.021_725_264_941_1);
    let fields = of_tension(wave(amplitude, q, frequency));
    let drop = DropletSetup { fields, ..DropletSetup::passive(10.0) };
    let setup = Setup { viscosity, ..alone(Region::Plane, drop, [32, 64]) };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let period = std::f64::consts::TAU / (frequency - q * mean);
    scene.run(period).step_size(StepSize::Adaptive { tolerance: 1e-6 }).go().unwrap();
    let place = scene.observe(droplets[0]).unwrap().centroid.x;
    assert!((place / period / mean - 1.0).abs() < 1e-4, "{}", place / period);
}

/// A round droplet with uniform particles of that activity.
fn round(activity: f64, fields: FieldsSetup) -> DropletSetup {
    let particles = Particles { activity, start: Start::Uniform, ..Particles::default() };
    DropletSetup { particles: Some(particles), fields, ..DropletSetup::default() }
}

#[test]
fn a_gradient_of_activity_carries_a_round_droplet_to_less_contractile_ground() {
    // g c0 R/(4 Sigma) at once, over 1 - zeta_eff/zeta_c later, approached at the rate (D/R^2)(1 - zeta_eff/zeta_c).
    let time = 20.0;
    for (activity, slope, at_once, later, rate) in
        [(-0.2, 0.01, 0.00125, 0.002_494_338_118_27, 0.050_113_494_672), (0.0, 0.02, 0.0025, 0.002_497_165_849_81, 0.1)]
    {
        // A gradient that moves with the droplet is the limit of a weak one.
        let weak = 1e-3;
        let fields = of_activity(gradient([weak * slope, 0.0], [0.0; 2]));
        let Built { mut scene, droplets, .. } =
            alone(Region::Plane, round(activity, fields), [32, 128]).build().unwrap();
        let first = scene.observe(droplets[0]).unwrap().velocity.x / weak;
        // The mean concentration is that along the polygon through the markers.
        assert!((first / at_once - 1.0).abs() < 2e-4, "{first}");
        scene.run(time).step_size(StepSize::Adaptive { tolerance: 1e-7 }).go().unwrap();
        let last = scene.observe(droplets[0]).unwrap().velocity.x / weak;
        let expected = later + (at_once - later) * (-rate * time).exp();
        assert!((last / expected - 1.0).abs() < 3e-4, "{activity}: {last} {expected}");
    }
}

#[test]
fn an_oscillating_activity_makes_the_polarity_grow_as_the_exponent_says() {
    // ln c_1 grows by s_1 t - c0 zeta_1 sin(om t)/(2 R Sigma om).
    let (zeta, amplitude, frequency, time) = (-0.6, 0.3, 0.8, 5.0);
    let modulation = ModulationSetup { frequency, mean: 0.0, amplitude: 1.0, phase: 0.0 };
    let beat = FieldEntry { uniform: Some(amplitude), modulation: Some(modulation), ..FieldEntry::default() };
    let mut droplet = round(zeta, of_activity(vec![beat]));
    let particles = droplet.particles.as_mut().unwrap();
    particles.excluded_volume = ExcludedVolume::None;
    particles.start = Start::Perturbed { amplitude: 1e-3, seed: 3 };
    let setup = alone(Region::Plane, droplet, [32, 256]);
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let speed = |scene: &mut motile_scene::Scene<_>| scene.observe(droplets[0]).unwrap().velocity.length();
    // Without the factor of the activity at that time, V is c_1: zeta + zeta_1 cos(om t).
    let before = speed(&mut scene) / (zeta + amplitude);
    scene.run(time).step_size(StepSize::Adaptive { tolerance: 1e-8 }).go().unwrap();
    let after = speed(&mut scene) / (zeta + amplitude * (frequency * time).cos());
    let growth = -100.0 * zeta / 400.0 - 0.1;
    let expected = growth * time - 100.0 * amplitude * (frequency * time).sin() / (400.0 * frequency);
    assert!(((after / before).ln() - expected).abs() < 3e-4, "{} {expected}", (after / before).ln());
}

#[test]
fn gradients_of_binding_and_unbinding_have_opposite_signs_and_the_size_of_the_theory() {
    // c_1 = k_off e R c0/s_1 for k_off (1 + e x), s_1 = the rate with exchange; V = zeta_eff c_1/(4 Sigma).
    let (binding, unbinding, weak, zeta) = (0.3, 0.2, 1e-4, -0.3);
    for (fields, sign) in [
        (FieldsSetup { unbinding: gradient([weak * unbinding, 0.0], [0.0; 2]), ..FieldsSetup::default() }, 1.0),
        (FieldsSetup { binding: gradient([weak * binding, 0.0], [0.0; 2]), ..FieldsSetup::default() }, -1.0),
    ] {
        let mut droplet = round(zeta, fields);
        let particles = droplet.particles.as_mut().unwrap();
        particles.exchange = Some(ExchangeSetup::new(binding, unbinding));
        particles.excluded_volume = ExcludedVolume::None;
        let Built { mut scene, droplets, .. } = alone(Region::Plane, droplet, [32, 128]).build().unwrap();
        scene.run(80.0).step_size(StepSize::Adaptive { tolerance: 1e-6 }).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        let rate = -100.0 * zeta / 400.0 - 0.1 - unbinding;
        let expected = sign * zeta * unbinding * weak * 100.0 / rate / 800.0;
        assert!((seen.velocity.x / expected - 1.0).abs() < 1e-3, "{} {expected}", seen.velocity.x);
        let body = scene.body(droplets[0]).unwrap();
        let all = body.particle_numbers().iter().sum::<f64>() + body.number_inside().unwrap();
        let start = 200.0 * std::f64::consts::PI * (1.0 + 0.5 * unbinding / binding);
        assert!((all / start - 1.0).abs() < 2e-4, "{all} {start}");
        assert!(body.exchange_flux().unwrap().abs() < 1e-3 * all, "{:?}", body.exchange_flux());
    }
}

#[test]
fn a_swimmer_turns_towards_less_contractile_ground() {
    // Turning rate per gradient across the way by a left null vector on the circle: 0.3388779990 at -0.5.
    let (slope, turning) = (1e-4, 0.338_877_999);
    let heading = |fields: FieldsSetup, time: f64| {
        let droplet = DropletSetup { fields, ..DropletSetup::active(-0.5) };
        let Built { mut scene, droplets, .. } = alone(Region::Plane, droplet, [32, 192]).build().unwrap();
        let mut headings = Vec::new();
        for part in [0.7, 1.0] {
            scene.run(part * time).step_size(StepSize::Adaptive { tolerance: 3e-5 }).go().unwrap();
            let velocity = scene.observe(droplets[0]).unwrap().velocity;
            headings.push(velocity.y.atan2(velocity.x));
        }
        (headings[1] - headings[0]) / (0.3 * time)
    };
    let found = heading(of_activity(gradient([0.0, slope], [0.0; 2])), 100.0) / slope;
    assert!((found / turning - 1.0).abs() < 0.005, "{found} {turning}");
}

#[test]
fn a_gradient_along_the_way_of_a_swimmer_changes_its_speed() {
    // dV/dg at the same activity at its centre, on the circle: 0.1558031208 at -0.5.
    let (slope, time, nodes) = (1e-4, 120.0, [32, 192]);
    let step = StepSize::Fixed(0.1);
    let setup = alone(Region::Plane, DropletSetup::active(-0.5), nodes);
    let run = |droplet: active_interface::ActiveDroplet| {
        let mut scene = Setup { droplets: Vec::new(), ..setup.clone() }.build().unwrap().scene;
        let droplet = scene.add(droplet);
        scene.run(time).step_size(step).go().unwrap();
        let seen = scene.observe(droplet).unwrap();
        (seen.velocity.x, seen.centroid.x)
    };
    let made = || setup.droplet(&setup.droplets[0]).unwrap();
    let (speed, place) = run(made());
    // The origin of the gradient moves with the droplet.
    let field = Field::of_time(move |x, t| slope * (x.x - place - speed * (t - time)));
    let (changed, _) = run(made().with_fields(Fields { activity: Some(field), ..Fields::default() }).unwrap());
    let found = (changed - speed) / slope;
    assert!((found / 0.155_803_120_8 - 1.0).abs() < 0.01, "{found}");
}

#[test]
fn a_box_by_grid_and_by_integrals_feels_the_same_fields() {
    let region = Region::Box { lengths: [6.0, 6.0] };
    let spot = SpotSetup { centre: [0.9, 0.4], radius: 0.7, amplitude: -0.5 };
    let spot = vec![FieldEntry { spot: Some(spot), ..FieldEntry::default() }];
    let fields = FieldsSetup { tension: wave(2.0, std::f64::consts::TAU / 6.0, 0.0), ..of_activity(spot) };
    let droplet = round(-0.3, fields);
    let [u, v] = velocity(&alone(region, droplet.clone(), [48, 192]));
    let grid = Method::Grid(GridMethod { spacing: 6.0 / 96.0, ..GridMethod::default() });
    let [x, y] = velocity(&Setup { region, method: grid, droplets: vec![droplet], ..Setup::default() });
    let speed = u.hypot(v);
    assert!(speed > 1e-3 && (x - u).hypot(y - v) < 0.02 * speed, "{u} {v}, {x} {y}");
}

#[test]
fn fields_that_make_no_scene_are_refused() {
    let region = Region::Box { lengths: [6.0, 6.0] };
    let channel = Region::Channel { length: 6.0, width: 6.0, drive: Drive::ZeroGradient };
    let text = |setup: Setup| setup.build().map(|_| ()).unwrap_err().to_string();
    let two = FieldEntry { uniform: Some(1.0), ..gradient([1.0, 0.0], [0.0; 2]).remove(0) };
    let off = SpotSetup { centre: [0.0, 0.5], radius: 1.0, amplitude: 1.0 };
    let off = FieldEntry { spot: Some(off), ..FieldEntry::default() };
    for (region, fields, words) in [
        (region, of_tension(wave(1.0, 1.0, 0.0)), "droplets[0].fields.tension[0].wave"),
        (region, of_tension(vec![two]), "droplets[0].fields.tension[0]"),
        (region, of_tension(vec![FieldEntry::default()]), "droplets[0].fields.tension[0]"),
        (region, of_tension(gradient([f64::NAN, 0.0], [0.0; 2])), "gradient.slope"),
        (region, FieldsSetup { binding: wave(1.0, 0.0, 0.0), ..FieldsSetup::default() }, "droplets[0].fields.binding"),
        (Region::Space, of_tension(gradient([0.0, 1.0], [0.0; 2])), "not symmetric"),
        (Region::Space, of_tension(vec![off]), "not symmetric"),
    ] {
        let droplet = DropletSetup { fields, ..DropletSetup::default() };
        let error = text(alone(region, droplet, [32, 64]));
        assert!(error.contains(words), "{words}: {error}");
    }
    let fields = of_activity(gradient([1.0, 0.0], [0.0; 2]));
    let passive = DropletSetup { fields: fields.clone(), ..DropletSetup::passive(1.0) };
    assert!(text(alone(region, passive, [32, 64])).contains("fields.activity"));
    let line = InterfaceSetup { fields, ..InterfaceSetup::active(-0.5) };
    let setup = Setup {
        interfaces: vec![line],
        droplets: Vec::new(),
        ..alone(channel, round(0.0, of_tension(vec![])), [32, 64])
    };
    assert!(text(setup).contains("slope[0]"));
}

#[test]
fn a_rate_that_a_field_makes_negative_is_an_error_with_its_place() {
    let fields = FieldsSetup { unbinding: gradient([0.5, 0.0], [0.0; 2]), ..FieldsSetup::default() };
    let mut droplet = round(-0.3, fields);
    droplet.particles.as_mut().unwrap().exchange = Some(ExchangeSetup::new(0.3, 0.2));
    let Built { mut scene, .. } = alone(Region::Plane, droplet, [32, 64]).build().unwrap();
    let error = scene.run(1.0).go().unwrap_err();
    let text = format!("{error:?}");
    assert!(text.contains("the rate of unbinding with its field is"), "{text}");
}

/// A scene with all that depends on time, and random numbers.
fn restless() -> Setup {
    let mut droplet = round(-0.5, FieldsSetup { tension: wave(1.0, 1.0, 0.4), ..of_activity(wave(0.1, 0.5, 3.0)) });
    droplet.particles.as_mut().unwrap().noise = Some(NoiseSetup { seed: 4, strength: 0.5 });
    let far = DropletSetup { centre: [4.0, 0.0], ..droplet.clone() };
    Setup { droplets: vec![droplet.clone(), far], ..alone(Region::Plane, droplet, [24, 48]) }
}

#[test]
fn runs_with_fields_and_noise_resume_bitwise() {
    let state = |scene: &motile_scene::Scene<_>, droplets: &[motile_scene::Handle<active_interface::ActiveDroplet>]| {
        let body = scene.body(droplets[1]).unwrap();
        (body.markers().to_vec(), body.particle_numbers().to_vec())
    };
    let mut whole = restless().build().unwrap();
    whole.scene.run(1.0).go().unwrap();
    let saved = whole.scene.checkpoint("half way");
    whole.scene.run(2.0).go().unwrap();
    let mut again = restless().build().unwrap();
    again.scene.resume(&saved).unwrap();
    again.scene.run(2.0).go().unwrap();
    assert_eq!(state(&whole.scene, &whole.droplets), state(&again.scene, &again.droplets));
    // Another seed or field is another scene.
    let mut other = restless();
    other.droplets[0].particles.as_mut().unwrap().noise = Some(NoiseSetup { seed: 5, strength: 0.5 });
    assert!(other.build().unwrap().scene.resume(&saved).is_err());
    let mut other = restless();
    other.droplets[0].fields.tension[0].wave.as_mut().unwrap().amplitude = 1.1;
    assert!(other.build().unwrap().scene.resume(&saved).is_err());
}

#[test]
fn droplets_of_one_seed_have_noise_of_their_own() {
    let Built { mut scene, droplets, .. } = restless().build().unwrap();
    scene.run(0.2).go().unwrap();
    let [a, b] = [0, 1].map(|k| scene.body(droplets[k]).unwrap().particle_numbers().to_vec());
    let distance: f64 = a.iter().zip(&b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    assert!(distance > 1.0, "{distance}");
}

/// Returns the variance of the first modes of droplets with noise over the closed form `(c0/(pi R))/(1 + zeta_eff c0
/// R/(2 Sigma D k))`, for each mode up to the fourth.
fn spectrum(activity: f64, droplets: u64, time: f64) -> [f64; 4] {
    let (strength, burn, mut sums, mut count) = (0.01, 40.0, [0.0; 4], 0.0);
    for seed in 0..droplets {
        // Particles that push each other apart take off 50 of the tension.
        let mut droplet = DropletSetup { tension: 60.0, ..round(activity, FieldsSetup::default()) };
        let particles = droplet.particles.as_mut().unwrap();
        particles.excluded_volume = ExcludedVolume::None;
        particles.noise = Some(NoiseSetup { seed, strength });
        let Built { mut scene, droplets, .. } = alone(Region::Plane, droplet, [24, 48]).build().unwrap();
        let mut until = burn;
        while until < time {
            scene.run(until).step_size(StepSize::Fixed(0.1)).go().unwrap();
            let c = scene.body(droplets[0]).unwrap().concentrations();
            for (mode, sum) in (1_u32..).zip(&mut sums) {
                let angle = |k: usize| f64::from(mode) * std::f64::consts::TAU * (k as f64 + 0.5) / c.len() as f64;
                for wave in [f64::sin, f64::cos] {
                    let amplitude: f64 = c.iter().enumerate().map(|(k, c)| c * wave(angle(k))).sum();
                    *sum += 0.5 * (2.0 * amplitude / c.len() as f64 / strength).powi(2);
                }
            }
            count += 1.0;
            until += 5.0;
        }
    }
    [1.0, 2.0, 3.0, 4.0].map(|mode| {
        let expected = 100.0 / std::f64::consts::PI / (1.0 + activity * 100.0 / (400.0 * 0.1 * mode));
        sums[mode as usize - 1] / count / expected
    })
}

#[test]
fn fluctuations_of_a_droplet_have_the_spectrum_of_linear_theory() {
    // Four droplets over 560 units of time have, with both phases, the relative standard error sqrt(1/(2240 s_k)), s_k
    // the rate of decay, and samples every 5 units at least sqrt(2/896).
    for activity in [-0.2, 0.5] {
        let found = spectrum(activity, 4, 600.0);
        for (mode, ratio) in (1..).zip(found) {
            let mode = f64::from(mode);
            let rate = mode * activity * 100.0 / 400.0 + 0.1 * mode * mode;
            let error = (1.0 / (2240.0 * rate)).max(2.0 / 896.0_f64).sqrt();
            assert!((ratio - 1.0).abs() < 2.5 * error, "activity {activity}, mode {mode}, error {error}: {found:?}");
        }
    }
}

#[test]
fn a_swimmer_of_few_particles_runs_with_adaptive_steps() {
    let mut droplet = DropletSetup::default();
    droplet.particles.as_mut().unwrap().noise = Some(NoiseSetup::default());
    let Built { mut scene, droplets, .. } = alone(Region::Plane, droplet, [32, 128]).build().unwrap();
    let number = scene.body(droplets[0]).unwrap().particle_numbers().iter().sum::<f64>();
    scene.run(0.1).go().unwrap();
    let now = scene.body(droplets[0]).unwrap().particle_numbers();
    assert!((now.iter().sum::<f64>() / number - 1.0).abs() < 1e-10 && now.iter().all(|n| *n >= 0.0));
    let report = scene.step_report();
    assert!(report.rejections < report.steps / 10, "{report:?}");
}
