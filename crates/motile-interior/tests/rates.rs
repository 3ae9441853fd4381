//! Growth rates of the director against linear theory, with the flow that it drives.

use std::f64::consts::{PI, TAU};

use active_interface::{ActiveDroplet, Curve};
use ib_core::{AnyKernel, ImmersedBoundary};
use motile_base::Vec2;
use motile_boundary_integrals::ImmersedLayers;
use motile_interior::{Anchoring, DirectorStart, GelInBox, GelInDroplet, GelMaterial};
use motile_scene::{Body, Hydrodynamics, Scene, integrator::Dynamics as _};
use stokes_grid::{Grid, PeriodicStokes};

const GEL: GelMaterial = GelMaterial {
    frank: 1.0,
    bend: None,
    spontaneous_splay: 0.0,
    rotational_viscosity: 2.0,
    alignment: -0.6,
    activity: -8.0,
};
const VISCOSITY: f64 = 1.5;
/// Zeros of J_0.
const ZEROS: [f64; 2] = [2.404_825_557_695_773, 5.520_078_110_286_311];

type Outcome<T> = Result<T, Box<dyn std::error::Error>>;

fn solver(cells: usize, length: f64, viscosity: f64) -> Outcome<PeriodicStokes> {
    Ok(PeriodicStokes::new(Grid::periodic(cells, cells, length / cells as f64)?, viscosity)?)
}

/// The rate of a wave with that wave vector on a director of that angle.
fn wave_rate(gel: GelMaterial, cells: usize, angle: f64, wave: Vec2) -> Outcome<f64> {
    let mut scene = Scene::new(ImmersedBoundary::new(solver(cells, TAU, VISCOSITY)?, AnyKernel::BSpline4));
    let size = 1e-5;
    let director = |node: Vec2| angle + size * node.dot(wave).cos();
    let gel = scene.add(GelInBox::new(gel, [TAU; 2], [cells; 2], director)?);
    let mut rate = vec![0.0; cells * cells];
    scene.system_mut().present_rate(&mut rate)?;
    let nodes = scene.body(gel)?.nodes();
    let sum: f64 = nodes.iter().zip(&rate).map(|(node, rate)| rate * node.dot(wave).cos()).sum();
    Ok(sum / (0.5 * size * (cells * cells) as f64))
}

#[test]
fn waves_on_a_uniform_director_grow_as_they_should() {
    for (angle, wave) in [
        (0.0, Vec2::X),
        (22.5, Vec2::X),
        (45.0, Vec2::X),
        (70.0, Vec2::X),
        (90.0, Vec2::X),
        (0.0, Vec2::ONE),
        (30.0, Vec2::new(1.0, -2.0)),
    ] {
        let angle = f64::to_radians(angle);
        let between = wave.angle_to(Vec2::from_angle(angle));
        let (cos, q) = ((2.0 * between).cos(), wave.length());
        let coupling = 1.0 - GEL.alignment * cos;
        let diffusion = 1.0 / GEL.rotational_viscosity + coupling * coupling / (4.0 * VISCOSITY);
        // A wave along the director bends it, a wave across splays it; spontaneous splay does nothing without boundary.
        for (bend, spontaneous_splay) in [(None, 0.0), (Some(3.0), -2.0)] {
            let gel = GelMaterial { bend, spontaneous_splay, ..GEL };
            let frank = 0.5 * (gel.frank * (1.0 - cos) + gel.bend() * (1.0 + cos));
            let exact = -frank * q * q * diffusion + gel.activity * cos * coupling / (2.0 * VISCOSITY);
            let errors = [32, 64].map(|cells| (wave_rate(gel, cells, angle, wave).unwrap() - exact).abs());
            let bound = 2e-3 * q * q * (1.0 + exact.abs());
            assert!(errors[0] < 4.0 * bound && errors[1] < bound, "{errors:?} of {exact}");
            assert!((errors[0] / errors[1]).log2() > 1.5, "{errors:?}");
        }
    }
}

/// J_0 by its integral, to round-off.
fn bessel(x: f64) -> f64 {
    let count = 64;
    let angles = (0..count).map(|k| PI * (f64::from(k) + 0.5) / f64::from(count));
    angles.map(|angle| (x * angle.sin()).cos()).sum::<f64>() / f64::from(count)
}

/// The rate of the mode J_0(zero r) around the centre of an aster or a vortex in a unit disc, the director along the
/// normal or the tangent at its boundary, in exterior fluid of that viscosity.
fn disc_rate(gel: GelMaterial, cells: usize, zero: f64, anchoring: Anchoring, exterior: f64) -> Outcome<f64> {
    // Interfaces between other viscosities are layers; the grid takes the gel.
    let mut scene = Scene::new(ImmersedLayers::new(solver(cells, 4.0, exterior)?, AnyKernel::BSpline4, 64, 1e-6)?);
    let spacing = 4.0 / cells as f64;
    let markers = (TAU / (0.5 * spacing)).round() as usize;
    let droplet = ActiveDroplet::passive(&Curve::circle(1.0)?.markers(markers)?, 10.0)?;
    let droplet = droplet.with_viscosity_inside(VISCOSITY)?;
    let host = scene.add(droplet.clone());
    let start = if anchoring == Anchoring::Planar { DirectorStart::Vortex } else { DirectorStart::Aster };
    let gel = GelInDroplet::new(&droplet, host, gel, anchoring, &start, spacing)?;
    let mode: Vec<f64> = gel.nodes()[markers..].iter().map(|node| bessel(zero * node.length())).collect();
    let mut areas = vec![0.0; gel.nodes().len()];
    for &[a, b, c] in gel.triangles() {
        let corner = gel.nodes()[a];
        let area = (gel.nodes()[b] - corner).perp_dot(gel.nodes()[c] - corner);
        [a, b, c].into_iter().for_each(|node| areas[node] += area / 6.0);
    }
    areas.drain(..markers);
    let gel = scene.add(gel);
    let before = scene.body(host)?.state_len();
    let size = 1e-3;
    let mut turned = |size: f64| -> Outcome<Vec<f64>> {
        let body = scene.body_mut(gel)?;
        let mut start = vec![0.0; body.state_len()];
        body.write_state(&mut start);
        let moved: Vec<f64> = start.iter().zip(&mode).map(|(angle, mode)| angle + size * mode).collect();
        body.read_state(&moved)?;
        let mut rate = vec![0.0; before + start.len()];
        scene.system_mut().present_rate(&mut rate)?;
        scene.body_mut(gel)?.read_state(&start)?;
        Ok(rate.split_off(before))
    };
    let [up, down] = [turned(size)?, turned(-size)?];
    let (mut sum, mut norm) = (0.0, 0.0);
    for (((up, down), mode), area) in up.iter().zip(&down).zip(&mode).zip(&areas) {
        sum += area * (up - down) / (2.0 * size) * mode;
        norm += area * mode * mode;
    }
    Ok(sum / norm)
}

#[test]
fn asters_and_vortices_turn_as_they_should() {
    for (anchoring, sign, exterior, zeros) in [
        (Anchoring::Homeotropic, 1.0, VISCOSITY, &ZEROS[..]),
        (Anchoring::Planar, -1.0, VISCOSITY, &ZEROS),
        (Anchoring::Homeotropic, 1.0, 10.0 * VISCOSITY, &ZEROS[..1]),
        (Anchoring::Homeotropic, 1.0, 0.1 * VISCOSITY, &ZEROS[..1]),
    ] {
        for &zero in zeros {
            let coupling = 1.0 - sign * GEL.alignment;
            let diffusion = 1.0 / GEL.rotational_viscosity + coupling * coupling / (4.0 * VISCOSITY);
            let exact = -GEL.frank * zero * zero * diffusion + sign * coupling * GEL.activity / (2.0 * VISCOSITY);
            // The core, where the director turns within a cell, makes the order less than two for most modes.
            let errors =
                [40, 80].map(|cells| (disc_rate(GEL, cells, zero, anchoring, exterior).unwrap() - exact).abs());
            assert!(errors[1] < 0.06 * exact.abs(), "{errors:?} of {exact}");
            assert!(errors[1] < 0.5 * errors[0] || errors[1] < 0.01 * exact.abs(), "{errors:?} of {exact}");
        }
    }
}

/// The error around a core is told as it is found for the worst of the thresholds of asters and vortices; where there
/// is no defect nothing is told.
#[test]
fn cores_of_defects_that_are_not_resolved_are_told() {
    for cells in [40, 80, 160] {
        let spacing = 4.0 / f64::from(cells);
        let mut error = 0.0_f64;
        for (anchoring, sign) in [(Anchoring::Homeotropic, 1.0), (Anchoring::Planar, -1.0)] {
            for zero in ZEROS {
                let found = threshold(|gel| disc_rate(gel, cells as usize, zero, anchoring, VISCOSITY)).unwrap();
                error = error.max(100.0 * (found / exact_threshold(sign, zero) - 1.0).abs());
            }
        }
        let markers = (TAU / (0.5 * spacing)).round() as usize;
        let droplet = ActiveDroplet::passive(&Curve::circle(1.0).unwrap().markers(markers).unwrap(), 10.0).unwrap();
        let mut scene = Scene::new(ImmersedBoundary::new(solver(40, 4.0, VISCOSITY).unwrap(), AnyKernel::BSpline4));
        let host = scene.add(droplet.clone());
        let view = scene.system().hydrodynamics().fluid_view();
        let warnings = |start: DirectorStart| {
            GelInDroplet::new(&droplet, host, GEL, Anchoring::Free, &start, spacing).unwrap().warnings(&view)
        };
        let uniform = DirectorStart::Uniform { angle: 0.3, noise: 0.0, seed: 1 };
        assert!(warnings(uniform).is_empty());
        let [core] = &warnings(DirectorStart::Aster)[..] else { panic!("{spacing}") };
        assert!((0.95..1.4).contains(&(core.excess / error)), "{spacing}: {error} {core}");
    }
}

/// The activity at which the mode J_0(zero r) around an aster (sign 1) or a vortex (-1) neither grows nor decays.
fn exact_threshold(sign: f64, zero: f64) -> f64 {
    let coupling = 1.0 - sign * GEL.alignment;
    let diffusion = 1.0 / GEL.rotational_viscosity + coupling * coupling / (4.0 * VISCOSITY);
    sign * 2.0 * VISCOSITY * GEL.frank * zero * zero * diffusion / coupling
}

/// The activity at which a rate that is linear in it is zero.
fn threshold(rate: impl Fn(GelMaterial) -> Outcome<f64>) -> Outcome<f64> {
    let [low, high] = [-4.0, 4.0].map(|activity| rate(GelMaterial { activity, ..GEL }));
    let (low, high) = (low?, high?);
    Ok(-4.0 - 8.0 * low / (high - low))
}

#[test]
fn activity_overcomes_the_elasticity_of_the_director_where_it_should() {
    let diffusion = |coupling: f64| 1.0 / GEL.rotational_viscosity + coupling * coupling / (4.0 * VISCOSITY);
    for degrees in [0.0, 30.0, 90.0] {
        let angle = f64::to_radians(degrees);
        let cos = (2.0 * angle).cos();
        let coupling = 1.0 - GEL.alignment * cos;
        let exact = 2.0 * VISCOSITY * GEL.frank * diffusion(coupling) / (cos * coupling);
        let errors = [32, 64].map(|cells| {
            let found = threshold(|gel| wave_rate(gel, cells, angle, Vec2::X)).unwrap();
            (found / exact - 1.0).abs()
        });
        assert!(errors[1] < 5e-3 && (errors[0] / errors[1]).log2() > 1.9, "{degrees}: {errors:?} of {exact}");
    }
    let zero = ZEROS[0];
    for (anchoring, sign) in [(Anchoring::Homeotropic, 1.0), (Anchoring::Planar, -1.0)] {
        let exact = exact_threshold(sign, zero);
        let errors = [40, 80].map(|cells| {
            let found = threshold(|gel| disc_rate(gel, cells, zero, anchoring, VISCOSITY)).unwrap();
            (found / exact - 1.0).abs()
        });
        // Of an order less than two, by the core.
        assert!(errors[1] < 0.03 && errors[1] < 0.6 * errors[0], "{anchoring:?}: {errors:?} of {exact}");
    }
}
