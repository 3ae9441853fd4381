//! Not a number, infinity, negative numbers and zero in every parameter of the constructors: an error or something that
//! works, never a panic, and never something that is made of a value that is not finite.

use motile::active_interface::{
    ActiveDroplet, ConstantTension, ContractileTension, Curve, ExcludedVolume, InitialConcentration, Motion, Units,
    observables::Frame,
    theory::{LinearTheory, RoundDroplet, SquirmerFlow},
};
use motile::base::{Drive, Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::mesh::{equilateral_block, equilateral_strip, fitted_strip};
use motile::elastic_solids::{Mesher, Moduli, MooneyRivlin, NeoHookean, Outline, SaintVenantKirchhoff, Solid};
use motile::ib_core::{BSpline, ImmersedBoundary, SmearedContrast};
use motile::scene::{Scene, StepSize, gap::Repulsion};
use motile::setup::{
    Axis, Built, DropletSetup, DropletShape, Grading, GridMethod, Hold, IntegralMethod, Material, Method, Particles,
    Setup, SolidOutline, SolidSetup, Squeezed, Start,
};
use motile::stokes_grid::{ChannelStokes, Grid, PeriodicStokes, TwoPhaseStokes, WallMotion};
use proptest::prelude::*;

/// A constructor: good values of its parameters, whether each may be zero or negative, and whether it takes values.
struct Maker {
    name: &'static str,
    good: &'static [f64],
    /// `+` for above zero only, `0` for zero too, `-` for any sign.
    signs: &'static str,
    make: fn(&[f64]) -> bool,
}

fn markers() -> Vec<Vec2> {
    Curve::circle(1.0).and_then(|curve| curve.markers(32)).expect("markers")
}

fn grid() -> Grid {
    Grid::periodic(8, 8, 0.5).expect("a grid")
}

fn channel_grid() -> Grid {
    Grid::channel(8, 8, 0.5).expect("a grid")
}

fn settings() -> Settings {
    Settings { nodes: 16, ..Settings::default() }
}

fn coarse() -> Setup {
    Setup { method: Method::Grid(GridMethod::uncorrected(0.25)), ..Setup::default() }
}

/// True if a scene can be built. What is built takes a step, which may fail but not panic. What is that fine that it
/// would take long is only checked.
fn builds(setup: &Setup) -> bool {
    if let Method::Grid(GridMethod { spacing, marker_spacing, .. }) = setup.method {
        let finest =
            setup.solids.iter().filter_map(|solid| solid.mesh_spacing).chain(marker_spacing).fold(spacing, f64::min);
        if setup.region.lengths().iter().map(|length| length / finest).product::<f64>() > 2e6 {
            return setup.check().is_ok();
        }
    }
    let Ok(Built { mut scene, .. }) = setup.build() else { return false };
    let _ = scene.step(1e-4);
    true
}

/// True if scenes with such a droplet can be built by both methods.
fn droplet_builds(change: impl Fn(&mut DropletSetup)) -> bool {
    let mut droplet = DropletSetup::default();
    change(&mut droplet);
    let droplets = vec![droplet];
    [Method::Integral(IntegralMethod { nodes: 16, elements: 32 }), coarse().method]
        .into_iter()
        .all(|method| builds(&Setup { method, droplets: droplets.clone(), ..Setup::default() }))
}

fn particles_build(particles: Particles) -> bool {
    droplet_builds(|droplet| droplet.particles = Some(particles))
}

fn shape_builds(shape: &DropletShape) -> bool {
    droplet_builds(|droplet| droplet.shape = shape.clone())
}

fn region_builds(region: Region) -> bool {
    let integrals = Method::Integral(IntegralMethod { nodes: 16, elements: 32 });
    let region_of = |method| Setup { region, method, ..Setup::default() };
    builds(&region_of(integrals)) && builds(&region_of(coarse().method))
}

/// A channel of 8 x 6 with one solid and no droplet.
fn with_solid(solid: SolidSetup) -> Setup {
    Setup {
        region: Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient },
        droplets: Vec::new(),
        solids: vec![solid],
        ..coarse()
    }
}

const SPRINGS: Material = Material::Springs { shear: 100.0 };

fn solid_builds(change: impl Fn(&mut SolidSetup)) -> bool {
    let outline = SolidOutline::Disc { centre: [0.3, 0.2], radius: 1.0 };
    let mut solid = SolidSetup { hold: Hold::Free, ..SolidSetup::new(outline, SPRINGS) };
    change(&mut solid);
    builds(&with_solid(solid))
}

fn walls_build(shape: ChannelShape) -> bool {
    SolidSetup::walls(&shape, &SPRINGS).into_iter().all(|wall| builds(&with_solid(wall)))
}

fn makers() -> Vec<Maker> {
    let maker = |name, good, signs, make| Maker { name, good, signs, make };
    vec![
        maker("Grid::periodic", &[0.5], "+", |v| Grid::periodic(8, 8, v[0]).is_ok()),
        maker("Grid::channel", &[0.5], "+", |v| Grid::channel(8, 8, v[0]).is_ok()),
        maker("PeriodicStokes", &[1.0], "+", |v| PeriodicStokes::new(grid(), v[0]).is_ok()),
        maker("ChannelStokes", &[1.0], "+", |v| ChannelStokes::new(channel_grid(), v[0]).is_ok()),
        maker("Drive::Gradient", &[1.0], "-", |v| {
            ChannelStokes::new(channel_grid(), 1.0).and_then(|mut s| s.set_drive(Drive::Gradient(v[0]))).is_ok()
        }),
        maker("Drive::Flux", &[1.0], "-", |v| {
            ChannelStokes::new(channel_grid(), 1.0).and_then(|mut s| s.set_drive(Drive::Flux(v[0]))).is_ok()
        }),
        maker("WallMotion::uniform", &[1.0, 0.5], "--", |v| WallMotion::uniform(&channel_grid(), v[0], v[1]).is_ok()),
        maker("TwoPhaseStokes tolerance", &[1e-6], "+", |v| {
            PeriodicStokes::new(grid(), 1.0)
                .and_then(TwoPhaseStokes::new)
                .and_then(|solver| solver.with_tolerance(v[0]))
                .is_ok()
        }),
        maker("TwoPhaseStokes viscosity", &[2.0], "+", |v| {
            PeriodicStokes::new(grid(), 1.0)
                .and_then(TwoPhaseStokes::new)
                .and_then(|mut solver| solver.set_viscosity(|x, _| if x > 0.0 { v[0] } else { 1.0 }))
                .is_ok()
        }),
        maker("SmearedContrast tolerance", &[1e-6], "+", |v| {
            let solver = PeriodicStokes::new(grid(), 1.0).expect("a solver");
            SmearedContrast::with_tolerance(solver, BSpline::<4>, v[0]).is_ok()
        }),
        maker("Repulsion", &[1.0, 0.2], "++", |v| Repulsion::new(v[0], v[1]).is_ok()),
        maker("Scene::with_least_gap", &[0.1], "-", |v| {
            let solver = PeriodicStokes::new(grid(), 1.0).expect("a solver");
            Scene::new(ImmersedBoundary::new(solver, BSpline::<4>)).with_least_gap(v[0]).is_ok()
        }),
        maker("StepSize::Fixed and the time of a run", &[0.01, 0.02], "+0", |v| {
            let solver = PeriodicStokes::new(grid(), 1.0).expect("a solver");
            let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
            scene.run(v[1]).step_size(StepSize::Fixed(v[0])).most_steps(10).go().is_ok()
        }),
        maker("StepSize::Adaptive", &[1e-4], "+", |v| {
            let mut scene = coarse().build().expect("a scene").scene;
            scene.run(0.02).step_size(StepSize::Adaptive { tolerance: v[0] }).most_steps(1000).go().is_ok()
        }),
        maker("Curve::circle", &[1.0], "+", |v| Curve::circle(v[0]).is_ok()),
        maker("Curve::ellipse", &[1.0, 0.5], "++", |v| Curve::ellipse(v[0], v[1]).is_ok()),
        maker("Curve::fourier", &[1.0, 0.1, 0.1], "+--", |v| Curve::fourier(v[0], &[0.0, v[1]], &[v[2]]).is_ok()),
        maker("markers of a moved curve", &[0.5, 0.1, 0.2], "---", |v| {
            let curve = Curve::circle(1.0).expect("a curve").rotated(v[0]).translated(Vec2::new(v[1], v[2]));
            curve.markers(16).is_ok()
        }),
        maker("markers_with_spacing", &[0.1], "+", |v| {
            Curve::circle(1.0).and_then(|curve| curve.markers_with_spacing(v[0])).is_ok()
        }),
        maker("ConstantTension", &[1.0], "0", |v| ConstantTension::new(v[0]).is_ok()),
        maker("ContractileTension", &[10.0, -1.0], "0-", |v| {
            ContractileTension::new(v[0], v[1], ExcludedVolume::None, 1.0).is_ok()
        }),
        maker("ContractileTension::thesis", &[10.0, -1.0, 10.0, 100.0], "0-0+", |v| {
            ContractileTension::thesis(v[0], v[1], v[2], v[3]).is_ok()
        }),
        maker("ExcludedVolume::Step", &[10.0, 200.0, 0.1], "0++", |v| {
            let excluded_volume = ExcludedVolume::StepAt { strength: v[0], threshold: v[1], steepness: v[2] };
            ContractileTension::new(10.0, -1.0, excluded_volume, 1.0).is_ok()
        }),
        maker("ExcludedVolume::Quadratic", &[0.1], "0", |v| {
            ContractileTension::new(10.0, -1.0, ExcludedVolume::Quadratic(v[0]), 1.0).is_ok()
        }),
        maker("InitialConcentration::uniform", &[100.0], "0", |v| InitialConcentration::uniform(v[0]).is_ok()),
        maker("InitialConcentration::polarised", &[100.0, 0.3], "0-", |v| {
            InitialConcentration::polarised(v[0], v[1]).is_ok()
        }),
        maker("InitialConcentration::perturbed", &[100.0, 0.1], "00", |v| {
            InitialConcentration::perturbed(v[0], v[1], 1).is_ok()
        }),
        maker("ActiveDroplet", &[1.0, 0.1], "00", |v| {
            let tension = ConstantTension::new(1.0).expect("a tension");
            ActiveDroplet::new(&markers(), vec![v[0]; 32], tension, v[1]).is_ok()
        }),
        maker("ActiveDroplet::with_viscosity_inside", &[10.0], "+", |v| {
            ActiveDroplet::passive(&markers(), 1.0).and_then(|droplet| droplet.with_viscosity_inside(v[0])).is_ok()
        }),
        maker("Frame", &[0.1, 0.2, 0.3], "---", |v| Frame::new(Vec2::new(v[0], v[1]), v[2]).is_ok()),
        maker("SquirmerFlow", &[1.0, 0.5, -0.5], "+--", |v| SquirmerFlow::new(v[0], v[1], v[2]).is_ok()),
        maker("Units", &[1e-5, 1.0, 1.0], "+++", |v| Units::new(v[0], v[1], v[2]).is_ok()),
        maker("LinearTheory", &[1.0, 1.0, 2.0, 10.0, -1.0, 100.0, 0.1], "+++--+0", |v| {
            LinearTheory::new(RoundDroplet {
                radius: v[0],
                viscosity_inside: v[1],
                viscosity_outside: v[2],
                tension: v[3],
                activity: v[4],
                concentration: v[5],
                diffusivity: v[6],
            })
            .is_ok()
        }),
        maker("Region::Box", &[4.0, 4.0], "++", |v| {
            BoundaryIntegral::new(Region::Box { lengths: [v[0], v[1]] }, 1.0, settings()).is_ok()
        }),
        maker("Region::Channel", &[4.0, 4.0, 0.1], "++-", |v| {
            let region = Region::Channel { length: v[0], width: v[1], drive: Drive::Flux(v[2]) };
            BoundaryIntegral::new(region, 1.0, settings()).is_ok()
        }),
        maker("BoundaryIntegral", &[1.0, 1e-8, 6.0], "+++", |v| {
            let settings = Settings { tolerance: v[1], ..settings() };
            let flow = BoundaryIntegral::new(Region::Plane, v[0], settings);
            flow.and_then(|flow| flow.with_reference_perimeter(v[2])).is_ok()
        }),
        maker("Moduli", &[1.0, 2.0], "++", |v| Moduli::new(v[0], v[1]).is_ok()),
        maker("Moduli::of_springs", &[1.0], "+", |v| Moduli::of_springs(v[0]).is_ok()),
        maker("Moduli::from_thesis_spring_constant", &[1e4], "+", |v| {
            Moduli::from_thesis_spring_constant(v[0]).is_ok()
        }),
        maker("Moduli::from_young", &[1.0, 0.3], "+-", |v| Moduli::from_young(v[0], v[1]).is_ok()),
        maker("NeoHookean", &[1.0, 2.0], "++", |v| NeoHookean::new(v[0], v[1]).is_ok()),
        maker("SaintVenantKirchhoff", &[1.0, 2.0], "++", |v| SaintVenantKirchhoff::new(v[0], v[1]).is_ok()),
        maker("MooneyRivlin", &[1.0, 2.0, 0.5], "++0", |v| MooneyRivlin::new(v[0], v[1], v[2]).is_ok()),
        maker("Solid::springs", &[1.0], "+", |v| {
            let mesh = equilateral_block(Vec2::ZERO, 3, 3, 0.5).expect("a mesh");
            Solid::springs(mesh, v[0]).is_ok()
        }),
        maker("equilateral_strip", &[0.0, 0.0, 0.5], "--+", |v| {
            equilateral_strip(Vec2::new(v[0], v[1]), 4, 3, v[2]).is_ok()
        }),
        maker("fitted_strip", &[2.0, 1.0], "++", |v| fitted_strip(Vec2::ZERO, [v[0], v[1]], 0.5).is_ok()),
        maker("Mesher", &[0.1], "+", |v| Mesher::new(v[0]).is_ok()),
        maker("Outline::circle", &[0.0, 0.0, 1.0], "--+", |v| Outline::circle(Vec2::new(v[0], v[1]), v[2]).is_ok()),
        maker("StraightChannel", &[6.0, 2.0], "++", |v| ChannelShape::Straight { width: v[1] }.channel(v[0]).is_ok()),
        maker("SinusoidalChannel", &[6.0, 2.0, 0.3, 0.1], "++--", |v| {
            ChannelShape::Sinusoidal { width: v[1], amplitude: v[2], phase: v[3], waves: 2 }.channel(v[0]).is_ok()
        }),
        maker("Constriction", &[8.0, 2.0, 1.0, 1.0, 1.0, 2.0, 0.0], "++++++-", |v| {
            ChannelShape::Constriction {
                width: v[1],
                throat: v[2],
                throat_length: v[3],
                ramp: v[4],
                exit_ramp: Some(v[5]),
                centre: v[6],
            }
            .channel(v[0])
            .is_ok()
        }),
        maker("Valve", &[8.0, 3.0, 1.0, 2.0, 0.1, 0.0], "++++0-", |v| {
            ChannelShape::Valve { width: v[1], gap: v[2], base: v[3], rounding: v[4], centre: v[5] }
                .channel(v[0])
                .is_ok()
        }),
        maker("Setup viscosity", &[100.0], "+", |v| builds(&Setup { viscosity: v[0], ..coarse() })),
        maker("Setup step.fixed", &[1e-3], "+", |v| builds(&Setup { step: StepSize::Fixed(v[0]), ..coarse() })),
        maker("Setup step.of-limit", &[0.5], "+", |v| builds(&Setup { step: StepSize::OfLimit(v[0]), ..coarse() })),
        maker("Setup step.adaptive", &[1e-4], "+", |v| {
            builds(&Setup { step: StepSize::Adaptive { tolerance: v[0] }, ..coarse() })
        }),
        maker("Setup repulsion", &[1.0, 0.2], "++", |v| {
            let droplets = [-1.5, 1.5].map(|x| DropletSetup { centre: [x, 0.0], ..DropletSetup::default() });
            let Ok(repulsion) = Repulsion::new(v[0], v[1]) else { return false };
            builds(&Setup { repulsion: Some(repulsion), droplets: droplets.to_vec(), ..coarse() })
        }),
        maker("Setup region.box", &[6.0, 6.0], "++", |v| region_builds(Region::Box { lengths: [v[0], v[1]] })),
        maker("Setup region.channel", &[6.0, 3.0, 1.0], "++-", |v| {
            region_builds(Region::Channel { length: v[0], width: v[1], drive: Drive::Gradient(v[2]) })
                && region_builds(Region::Channel { length: v[0], width: v[1], drive: Drive::Flux(v[2]) })
        }),
        maker("Setup method.grid", &[0.25, 0.1], "++", |v| {
            let grid = GridMethod { marker_spacing: Some(v[1]), ..GridMethod::of_spacing(v[0]) };
            builds(&Setup { method: Method::Grid(grid), ..Setup::default() })
        }),
        maker("Setup droplet.centre", &[0.3, 0.2], "--", |v| droplet_builds(|d| d.centre = [v[0], v[1]])),
        maker("Setup droplet.angle", &[0.3], "-", |v| droplet_builds(|d| d.angle = v[0])),
        maker("Setup droplet.viscosity", &[10.0], "+", |v| droplet_builds(|d| d.viscosity = Some(v[0]))),
        maker("Setup droplet.tension", &[10.0], "0", |v| droplet_builds(|d| d.tension = v[0])),
        maker("Setup droplet.motion.relaxation", &[5.0], "0", |v| {
            droplet_builds(|d| d.motion = Motion::Equidistributed { relaxation: v[0], filter: true })
        }),
        maker("Setup shape.round", &[1.0], "+", |v| shape_builds(&DropletShape::Round { radius: v[0] })),
        maker("Setup shape.squeezed", &[1.0, 0.8], "++", |v| {
            [Squeezed::Ellipse, Squeezed::Stadium]
                .into_iter()
                .all(|to| shape_builds(&DropletShape::Squeezed { radius: v[0], half_height: v[1], to }))
        }),
        maker("Setup shape.ellipse", &[1.2, 0.8], "++", |v| {
            shape_builds(&DropletShape::Ellipse { half_axes: [v[0], v[1]] })
        }),
        maker("Setup shape.modes", &[1.0, 0.1, 0.05], "+--", |v| {
            shape_builds(&DropletShape::Modes { radius: v[0], cosines: vec![0.0, v[1]], sines: vec![v[2]] })
        }),
        maker("Setup shape.points", &[1.0, 0.1], "--", |v| {
            let mut points: Vec<[f64; 2]> =
                (0..16_u8).map(|k| std::f64::consts::FRAC_PI_8 * f64::from(k)).map(|t| [t.cos(), t.sin()]).collect();
            points[0] = [v[0], v[1]];
            shape_builds(&DropletShape::Points(points))
        }),
        maker("Setup particles", &[-2.0, 10.0, 0.1, 100.0], "-00+", |v| {
            particles_build(Particles {
                activity: v[0],
                excluded_volume: ExcludedVolume::Step(v[1]),
                diffusion: v[2],
                concentration: v[3],
                ..Particles::default()
            })
        }),
        maker("Setup particles, quadratic", &[0.1], "0", |v| {
            particles_build(Particles { excluded_volume: ExcludedVolume::Quadratic(v[0]), ..Particles::default() })
        }),
        maker("Setup particles, perturbed", &[0.1], "0", |v| {
            let start = Start::Perturbed { amplitude: v[0], seed: 3 };
            particles_build(Particles { start, ..Particles::default() })
        }),
        maker("Setup solid.mesh-spacing", &[0.5], "+", |v| solid_builds(|s| s.mesh_spacing = Some(v[0]))),
        maker("Setup solid.hold.tethered", &[10.0], "+", |v| {
            solid_builds(|s| s.hold = Hold::Tethered { stiffness: v[0] })
        }),
        maker("Setup solid.outline.disc", &[0.3, 0.2, 1.0], "--+", |v| {
            solid_builds(|s| s.outline = SolidOutline::Disc { centre: [v[0], v[1]], radius: v[2] })
        }),
        maker("Setup solid.outline.ellipse", &[0.3, 0.2, 1.0, 0.8], "--++", |v| {
            solid_builds(|s| {
                s.outline = SolidOutline::Ellipse { centre: [v[0], v[1]], half_axes: [v[2], v[3]] };
            })
        }),
        maker("Setup solid.outline.polygon", &[0.0, 1.2, 0.1], "--0", |v| {
            let corners = vec![[-1.0, -1.0], [1.0, -1.0], [v[0], v[1]]];
            solid_builds(|s| s.outline = SolidOutline::Polygon { corners: corners.clone(), rounding: v[2] })
        }),
        maker("Setup solid.material.springs", &[100.0], "+", |v| {
            solid_builds(|s| s.material = Material::Springs { shear: v[0] })
        }),
        maker("Setup solid.material", &[100.0, 200.0], "++", |v| {
            let [shear, bulk] = [v[0], v[1]];
            solid_builds(|s| s.material = Material::NeoHookean { shear, bulk })
                && solid_builds(|s| s.material = Material::SaintVenantKirchhoff { shear, bulk })
        }),
        maker("Setup solid.material.mooney-rivlin", &[100.0, 200.0, 0.5], "++0", |v| {
            solid_builds(|s| s.material = Material::MooneyRivlin { shear: v[0], bulk: v[1], fraction: v[2] })
        }),
        maker("Setup solid.grading", &[-1.0, 1.0, 2.0], "-++", |v| {
            let factors = vec![[v[0], v[1]], [3.0, v[2]]];
            solid_builds(|s| s.grading = Grading::Along { axis: Axis::X, factors: factors.clone() })
        }),
        maker("Setup solid.outline, straight", &[3.0], "+", |v| walls_build(ChannelShape::Straight { width: v[0] })),
        maker("Setup solid.outline, constriction", &[3.0, 2.0, 2.0, 1.0, 0.5, 0.5], "+++++-", |v| {
            walls_build(ChannelShape::Constriction {
                width: v[0],
                throat: v[1],
                throat_length: v[2],
                ramp: v[3],
                exit_ramp: Some(v[4]),
                centre: v[5],
            })
        }),
        maker("Setup solid.outline, valve", &[3.0, 2.0, 2.0, 0.1, 0.5], "+++0-", |v| {
            walls_build(ChannelShape::Valve { width: v[0], gap: v[1], base: v[2], rounding: v[3], centre: v[4] })
        }),
        maker("Setup solid.outline, ratchet", &[3.0, 2.0, 0.6], "+++", |v| {
            [true, false].into_iter().all(|sharp| {
                walls_build(ChannelShape::Ratchet { width: v[0], throat: v[1], teeth: 2, rise: v[2], sharp })
            })
        }),
        maker("Setup solid.outline, sinusoidal", &[3.0, 0.3, 0.2], "+--", |v| {
            walls_build(ChannelShape::Sinusoidal { width: v[0], amplitude: v[1], waves: 2, phase: v[2] })
        }),
        maker("Setup solid.outline, branching", &[1.5, 1.0, 1.0, 2.0, 1.0, 1.0], "++++++", |v| {
            walls_build(ChannelShape::Branching {
                width: v[0],
                branches: [v[1], v[2]],
                island_length: v[3],
                island_thickness: v[4],
                ramp: v[5],
            })
        }),
    ]
}

#[test]
fn good_values_are_taken_and_bad_ones_refused() {
    let mut wrong = Vec::new();
    for Maker { name, good, signs, make } in makers() {
        assert_eq!(good.len(), signs.len(), "{name}");
        if !make(good) {
            wrong.push(format!("{name} does not take {good:?}"));
        }
        for (index, sign) in signs.chars().enumerate() {
            let mut bad = vec![f64::NAN, f64::INFINITY, f64::NEG_INFINITY];
            bad.extend((sign != '-').then_some(-1.0));
            bad.extend((sign == '+').then_some([0.0, -0.0]).into_iter().flatten());
            for value in bad {
                let mut values = good.to_vec();
                values[index] = value;
                if make(&values) {
                    wrong.push(format!("{name} takes {value} for parameter {index}"));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Constructors whose work does not grow with their parameters.
fn cheap() -> Vec<Maker> {
    let dear = ["markers_with", "StepSize", "fitted_strip", "Drive"];
    makers().into_iter().filter(|maker| !dear.iter().any(|name| maker.name.starts_with(name))).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, ..ProptestConfig::default() })]

    /// Any numbers at all, also tiny and huge ones.
    #[test]
    fn nothing_panics(which in any::<prop::sample::Index>(), values in prop::collection::vec(any::<f64>(), 8)) {
        let makers = cheap();
        let Maker { good, make, .. } = &makers[which.index(makers.len())];
        make(&values[..good.len()]);
    }

    /// One number out of its usual size.
    #[test]
    fn extreme_numbers_do_not_panic(
        which in any::<prop::sample::Index>(),
        parameter in any::<prop::sample::Index>(),
        exponent in -320_i32..308,
        negative in any::<bool>(),
    ) {
        let makers = cheap();
        let Maker { good, make, .. } = &makers[which.index(makers.len())];
        let mut values = good.to_vec();
        let size = 10_f64.powi(exponent);
        values[parameter.index(good.len())] = if negative { -size } else { size };
        make(&values);
    }
}
