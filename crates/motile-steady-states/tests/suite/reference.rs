//! Steady swimmers and their lateral stability against values computed independently (`tests/reference`).

use std::collections::HashMap;

use motile::active_interface::Tension;
use motile::active_interface::observables::stress_curvature;
use motile::prelude::*;
use motile::setup::DropletShape;
use motile_steady_states::{SteadyState, Symmetry};

type Row = HashMap<String, String>;

fn rows(file: &str) -> Vec<Row> {
    let path = format!("{}/../../tests/reference/{file}", env!("CARGO_MANIFEST_DIR"));
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(path).expect("as described");
    table.deserialize().map(|row| row.expect("a row")).collect()
}

fn number(row: &Row, name: &str) -> f64 {
    row[name].parse().expect("as described")
}

fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: 4 * nodes })
}

fn box_swimmer(row: &Row, count: usize) -> Setup {
    let activity = number(row, "zeta_dmu");
    let droplet = DropletSetup {
        viscosity: Some(number(row, "eta_in")),
        ..DropletSetup::contractile(activity, number(row, "A_over_zeta") * activity.abs())
    };
    let viscosity = number(row, "eta_ext");
    Setup { method: nodes(count), viscosity, droplets: vec![droplet], ..Setup::default() }
}

fn channel_swimmer(row: &Row, strength: f64, count: usize) -> Setup {
    let drive = if row["conv"] == "q0" { Drive::ZeroFlux } else { Drive::ZeroGradient };
    let region = Region::Channel { length: number(row, "l"), width: number(row, "w"), drive };
    let droplets = vec![DropletSetup::contractile(number(row, "zeta_dmu"), strength)];
    Setup { method: nodes(count), region, droplets, ..Setup::default() }
}

/// Relative errors of speed, stresslet, aspect ratio and largest concentration.
fn errors(state: &SteadyState, row: &Row) -> [f64; 4] {
    let seen = state.measured().expect("as described");
    let stresslet = if row.contains_key("Sxx_f") { "Sxx_f" } else { "Sxx" };
    let values = [seen.speed, seen.stresslet, seen.aspect_ratio, seen.concentration[0]];
    let names = ["speed", stresslet, "AR_mom", "cmax"];
    std::array::from_fn(|k| (values[k] / number(row, names[k]) - 1.0).abs())
}

#[test]
fn steady_swimmers_are_those_of_the_reference() {
    let boxes = ["steady_swimmer_box6.csv", "steady_swimmer_contrast_box6.csv"];
    let in_boxes = boxes.into_iter().flat_map(rows).map(|row| (box_swimmer(&row, 96), row));
    let in_channels = rows("channel_steady_swimmer.csv").into_iter().map(|row| (channel_swimmer(&row, 10.0, 96), row));
    for (setup, row) in in_boxes.chain(in_channels) {
        let state = SteadyState::find(&setup).unwrap();
        let errors = errors(&state, &row);
        let limits = [2e-6, 1e-4, 1e-5, 5e-5];
        assert!(errors.iter().zip(limits).all(|(error, limit)| *error < limit), "{row:?}: {errors:?}");
        assert!(state.residual() < 1e-7, "{row:?}: {}", state.residual());
    }
}

#[test]
fn errors_fall_spectrally() {
    let row = rows("channel_steady_swimmer.csv").into_iter().find(|row| row["w"] == "3").unwrap();
    let speed_error = |count| errors(&SteadyState::find(&channel_swimmer(&row, 10.0, count)).unwrap(), &row)[0];
    let [coarse, middle, fine] = [48, 72, 108].map(speed_error);
    // Faster than the tenth power of the nodes.
    assert!(middle < 0.017 * coarse && fine < 0.017 * middle, "{coarse:.1e} {middle:.1e} {fine:.1e}");
}

#[test]
fn droplets_in_channels_swing_as_the_reference_has_it() {
    for row in rows("channel_lateral_stability.csv") {
        let state = SteadyState::find(&channel_swimmer(&row, number(&row, "A"), 112)).unwrap();
        let spectrum = state.spectrum().unwrap();
        let slowest = spectrum.of(Symmetry::Antisymmetric).find(|z| z.im > 0.0).unwrap();
        let (growth, frequency) = (number(&row, "growth"), number(&row, "freq"));
        assert!((slowest.re / growth - 1.0).abs() < 3e-4, "{row:?}: {slowest}");
        assert!((slowest.im / frequency - 1.0).abs() < 1e-4, "{row:?}: {slowest}");
    }
}

#[test]
fn what_is_no_steady_state_of_one_droplet_is_refused() {
    let two = Setup { droplets: vec![DropletSetup::active(-1.0), DropletSetup::active(-1.0)], ..Setup::default() };
    let grid = Setup { method: Method::Grid(GridMethod::default()), ..Setup::default() };
    let droplets = vec![DropletSetup::passive(1.0)];
    let sheared = Setup { droplets, flow: FlowSetup { shear: 1.0, ..FlowSetup::default() }, ..Setup::default() };
    for (setup, words) in [
        (two, "the scene does not have exactly one droplet. Use one droplet"),
        (grid, "the scene is computed on a grid. Use the method of boundary integrals"),
        (sheared, "the images of a sheared box never stop moving"),
    ] {
        let error = SteadyState::find(&setup).map(drop).unwrap_err();
        let refused = matches!(error, motile_steady_states::SteadyError::Refused { .. });
        assert!(refused && error.to_string().starts_with(words), "{error}");
    }
}

#[test]
fn least_curvatures_are_those_of_the_shape() {
    // A circle of twice the radius, and a swimmer with a flat back: markers between the nodes see the same.
    let mut large = Setup { method: nodes(48), region: Region::Plane, ..Setup::default() };
    large.droplets = vec![DropletSetup { shape: DropletShape::Round { radius: 2.0 }, ..DropletSetup::active(-0.1) }];
    let circle = SteadyState::uniform(&large).unwrap().measured().unwrap();
    assert!((circle.least_curvature - 0.5).abs() < 1e-10, "{}", circle.least_curvature);
    let row = rows("channel_steady_swimmer.csv").into_iter().find(|row| row["w"] == "5").unwrap();
    let swimmer = SteadyState::find(&channel_swimmer(&row, 10.0, 96)).unwrap();
    let points = &swimmer.profile().positions;
    let count = points.len();
    let circles = (0..count).map(|k| {
        let [a, b, c] = [points[(k + count - 1) % count], points[k], points[(k + 1) % count]];
        2.0 * (b - a).perp_dot(c - b) / ((b - a).length() * (c - b).length() * (c - a).length())
    });
    let seen = circles.fold(f64::INFINITY, f64::min);
    let least = swimmer.measured().unwrap().least_curvature;
    assert!(least < 0.97 && (least - seen).abs() < 5e-3, "{least} {seen}");
}

#[test]
fn a_start_from_a_run_that_is_not_quite_straight_leads_to_the_straight_swimmer() {
    let row = rows("channel_steady_swimmer.csv").into_iter().find(|row| row["w"] == "3").unwrap();
    let setup = channel_swimmer(&row, 10.0, 64);
    let exact = SteadyState::find(&setup).unwrap();
    // Shifted across, turned a little, with another first marker, and more particles on one side.
    let profile = exact.profile();
    let count = profile.positions.len();
    let turned = |k: usize| profile.positions[(k + 3) % count].rotate(Vec2::from_angle(0.02)) + Vec2::new(0.3, 0.01);
    let lopsided = |k: usize| {
        let k = (k + 3) % count;
        profile.density[k] * (1.0 + 0.02 * (std::f64::consts::TAU * k as f64 / count as f64).sin())
    };
    let start = motile_steady_states::Profile {
        positions: (0..count).map(turned).collect(),
        density: (0..count).map(lopsided).collect(),
        nuclei: Vec::new(),
    };
    let velocity = Vec2::new(1.01, 0.01) * exact.velocity().x;
    for mirror in [true, false] {
        let found = SteadyState::near(&setup, &start, velocity, mirror).unwrap();
        assert!(found.residual() < 1e-5, "{mirror}: {:.1e}", found.residual());
        assert!((found.velocity().x / exact.velocity().x - 1.0).abs() < 1e-5, "{mirror}: {}", found.velocity());
        assert!(found.velocity().y.abs() < 1e-8, "{mirror}: {}", found.velocity());
    }
}

/// Far away in unbounded fluid the flow is that of the stresslet, u = x (x . S x)/(2 pi eta r^4), and what remains of
/// it falls by the distance; at the front of the droplet it is the droplet's.
#[test]
fn the_flow_around_a_swimmer() {
    let droplet = DropletSetup { viscosity: Some(100.0), ..DropletSetup::active(-1.5) };
    let setup = Setup {
        method: nodes(96),
        region: Region::Plane,
        viscosity: 50.0,
        droplets: vec![droplet],
        ..Setup::default()
    };
    let state = SteadyState::find(&setup).unwrap();
    let seen = state.measured().unwrap();
    let heading = state.velocity().normalize();
    let far = [20.0, 40.0, 80.0];
    let points = far.map(|r| seen.centroid + r * heading);
    let samples = state.sample(&points).unwrap();
    let errors: Vec<f64> = far
        .iter()
        .zip(&samples)
        .map(|(r, sample)| {
            let expected = seen.stresslet / (std::f64::consts::TAU * 50.0 * r);
            sample.velocity.dot(heading) / expected - 1.0
        })
        .collect();
    let [near, middle, far] = [errors[0], errors[1], errors[2]];
    assert!((near / middle - 2.0).abs() < 0.02 && (2.0 * far - middle).abs() < 1e-3, "{errors:?}");
    let front = |point: &&Vec2| (**point - seen.centroid).dot(heading);
    let foremost = state.profile().positions.iter().max_by(|a, b| front(a).total_cmp(&front(b))).unwrap();
    let there = state.sample(&[*foremost]).unwrap()[0].velocity;
    assert!((there - state.velocity()).length() < 2e-4 * seen.speed, "{there} {}", state.velocity());
    assert!(state.sample(&[Vec2::NAN]).is_err());
}

/// In unbounded fluid swimmers are circles, and the stresses on both sides say so, (2.61) of Cowley.
#[test]
fn stresses_hold_the_shape() {
    for (inside, activity) in [(50.0, -0.6), (500.0, -2.5)] {
        let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::active(activity) };
        let law = droplet.particles.as_ref().unwrap().law(droplet.tension).unwrap();
        let setup = Setup {
            method: nodes(128),
            region: Region::Plane,
            viscosity: 50.0,
            droplets: vec![droplet],
            ..Setup::default()
        };
        let state = SteadyState::find(&setup).unwrap();
        let (_, concentrations) = state.profile().concentrations().unwrap();
        let centre = state.measured().unwrap().centroid;
        for (x, c) in state.profile().positions.iter().zip(concentrations) {
            let normal = *x - centre;
            let sides = [-1e-5, 1e-5].map(|step| *x + step * normal);
            let flow = state.sample(&sides).unwrap();
            let found = stress_curvature([flow[0], flow[1]], [inside, 50.0], normal, law.value(c)).unwrap();
            assert!((found - 1.0).abs() < 2e-4, "{inside} at {x}: {found}");
        }
    }
}

/// The aspect ratio is along the motion, as in runs: a swimmer up a square box is as long as one along it.
#[test]
fn the_aspect_ratio_is_along_the_motion() {
    let of = |angle: f64| {
        let droplets = vec![DropletSetup { angle, ..DropletSetup::active(-2.0) }];
        let region = Region::Box { lengths: [3.0; 2] };
        let setup = Setup { method: nodes(48), region, droplets, ..Setup::default() };
        let state = SteadyState::find(&setup).expect("a swimmer");
        (state.measured().expect("measured").aspect_ratio, state.observables().expect("seen").aspect_ratio_moments)
    };
    let [along, up] = [0.0, std::f64::consts::FRAC_PI_2].map(of);
    assert!((along.0 - 1.0).abs() > 1e-3, "{along:?}");
    for (measured, seen) in [along, up] {
        assert!((measured - along.0).abs() < 1e-6 && (seen - along.0).abs() < 1e-4, "{along:?} {measured} {seen}");
    }
}

/// The stresslet of a swimmer along the diagonal of a box, where its components along x and across have parts in it, is
/// that of the observables of runs.
#[test]
fn the_stresslet_is_along_the_motion() {
    // Between two viscosities runs take the normals of the polygon, of second order.
    for (viscosity, tolerance) in [(None, 1e-12), (Some(300.0), 0.03)] {
        let angle = std::f64::consts::FRAC_PI_4;
        let droplets = vec![DropletSetup { angle, viscosity, ..DropletSetup::active(-2.0) }];
        let region = Region::Box { lengths: [3.0; 2] };
        let state =
            SteadyState::find(&Setup { method: nodes(48), region, droplets, ..Setup::default() }).expect("a swimmer");
        assert!((state.velocity().x / state.velocity().y - 1.0).abs() < 1e-10, "{}", state.velocity());
        let (measured, seen) = (state.measured().expect("measured"), state.observables().expect("seen"));
        let expected = seen.moments.stresslet()[0][0];
        let error = measured.stresslet / expected - 1.0;
        assert!(expected.abs() > 0.1 && error.abs() < tolerance, "{viscosity:?}: {measured:?} {expected}");
    }
}
