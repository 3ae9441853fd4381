//! Drops, capsules, bubbles and rigid ellipses in imposed flows; emulsions, migration, and the viscosity of a box with
//! a swimmer in it.

use std::f64::consts::PI;

use motile::base::{Drive, ImposedFlow, Region, Vec2};
use motile::elastic_solids::BendingMeasure;
use motile::scene::{Every, StepSize, System};
use motile::setup::{AnyFlow, Built, DropletSetup, FlowSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_steady_states::{Continuation, Parameter, SpecialKind, SteadyError, SteadyState};
use motile_tests::validation::imposed::{
    EXTENSION, SHEAR, Seen, capsule, drop_of, ellipse, fourth_order, plane, poiseuille, reference, seen_at,
};
use motile_tests::validation::{StudyError, Table};

use super::Tables;
use crate::tables::Measure;

pub(super) fn imposed_flows() -> Tables {
    let all = [small, steady, transient, turning_points, rigid, emulsions, migration, swimmers];
    all.into_iter().map(|table| table()).collect()
}

fn drop_in(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize) -> Setup {
    Setup { droplets: vec![drop_of(ratio, capillary)], ..plane(flow, nodes, 0.01) }
}

/// A steady drop by Newton's method.
fn steady_drop(flow: FlowSetup, ratio: f64, capillary: f64, nodes: usize) -> Result<Seen, StudyError> {
    let state = SteadyState::find(&drop_in(flow, ratio, capillary, nodes))?;
    Ok(Seen { deformation: state.deformation()?, stresslet: state.particle_stress()?, strains: None })
}

fn small() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Steady drops at a capillary number of 2e-3/(1 + ratio), by Newton's method: deformation D/Ca, exactly 1 in \
         shear and 2 in extension, fall of the angle over its first order, stresslet over that of a disc of fluid",
        "ratio | shear D/Ca - 1 | angle - 1 | stresslet - 1 | extension D/Ca - 2 | stresslet - 1",
    );
    for ratio in [0.01, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0] {
        table.measure(ratio, || {
            let capillary = 2e-3 / (1.0 + ratio);
            let k = PI * (1.0 + 2.0 * ratio) / (1.0 + ratio);
            let [shear, extension] = [SHEAR, EXTENSION].map(|flow| steady_drop(flow, ratio, capillary, 32));
            let (shear, extension) = (shear?, extension?);
            let angle = shear.deformation.angle_of_moments.unwrap_or(f64::NAN);
            let errors = [
                shear.deformation.by_moments / capillary - 1.0,
                (0.25 * PI - angle) / (0.5 * (1.0 + ratio) * capillary) - 1.0,
                shear.stresslet[0][1] / k - 1.0,
                extension.deformation.by_moments / capillary - 2.0,
                extension.stresslet[0][0] / (2.0 * k) - 1.0,
            ];
            Ok(errors.map(|error| format!("{error:.1e}")).join(" | "))
        })?;
    }
    Ok(table)
}

/// Steady drops of the reference: name, flow, ratio, capillary number.
const STEADY: [(&str, FlowSetup, f64, f64); 6] = [
    ("shear_lam1_Ca0.05", SHEAR, 1.0, 0.05),
    ("shear_lam1_Ca0.1", SHEAR, 1.0, 0.1),
    ("shear_lam1_Ca0.3", SHEAR, 1.0, 0.3),
    ("shear_lam10_Ca0.1", SHEAR, 10.0, 0.1),
    ("ext_lam1_Ca0.05", EXTENSION, 1.0, 0.05),
    ("ext_lam1_Ca0.1", EXTENSION, 1.0, 0.1),
];

fn steady() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Steady drops against the reference: largest error of all its quantities, relative where they are above 1; the \
         run by the Runge-Kutta method to t = 30, 96 nodes, steps of half the stable ones",
        "case | D | Newton, 64 nodes | 80 nodes | 96 nodes | run",
    );
    for (case, flow, ratio, capillary) in STEADY {
        table.measure(format_args!("{case} | {:.6}", reference(case, "D_mom")?), || {
            let mut cells = Vec::new();
            for nodes in [64, 80, 96] {
                cells.push(format!("{:.1e}", steady_drop(flow, ratio, capillary, nodes)?.largest_error(case).0));
            }
            let run = Setup {
                droplets: vec![drop_of(ratio, capillary)],
                step: StepSize::OfLimit(0.5),
                ..fourth_order(flow, 96, 0.01)
            };
            cells.push(largest(&seen_at(&run, &[30.0])?, &[case]));
            Ok(cells.join(" | "))
        })?;
    }
    Ok(table)
}

/// The largest error of cases in the order of what is seen.
fn largest(seen: &[Seen], cases: &[&str]) -> String {
    let errors = seen.iter().zip(cases).map(|(seen, case)| seen.largest_error(case).0);
    format!("{:.1e}", errors.fold(0.0, f64::max))
}

fn transient() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Drops, bubbles and capsules by the Runge-Kutta method in shear from a circle: largest error of all quantities \
         of the reference at all its times",
        "scene | nodes | dt | times | error | at half the step",
    );
    let mut push = |name: &str, setup: &dyn Fn(f64) -> Setup, dt: f64, cases: &[(&str, f64)]| {
        let (names, times): (Vec<_>, Vec<_>) = cases.iter().copied().unzip();
        let nodes = if let Method::Integral(method) = setup(dt).method { method.nodes } else { 0 };
        let at = times.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
        table.measure(format_args!("{name} | {nodes} | {dt} | {at}"), || {
            let error = |dt: f64| Ok::<_, StudyError>(largest(&seen_at(&setup(dt), &times)?, &names));
            Ok([error(dt)?, error(0.5 * dt)?].join(" | "))
        })
    };
    let drop = |dt: f64| Setup { droplets: vec![drop_of(1.0, 0.2)], ..fourth_order(SHEAR, 80, dt) };
    let strains = [
        ("transient_Linf_lam1_Ca0.2_strain0.25", 0.25),
        ("transient_Linf_lam1_Ca0.2_strain0.5", 0.5),
        ("transient_Linf_lam1_Ca0.2_strain1", 1.0),
        ("transient_Linf_lam1_Ca0.2_strain2", 2.0),
    ];
    push("drop, ratio 1, Ca = 0.2", &drop, 0.05, &strains)?;
    let boxed = |dt: f64| Setup { region: Region::Box { lengths: [6.0; 2] }, ..drop(dt) };
    let strains = [("transient_L6_lam1_Ca0.2_strain0.5", 0.5), ("transient_L6_lam1_Ca0.2_strain2", 2.0)];
    push("the same in a sheared box of 6 x 6", &boxed, 0.05, &strains)?;
    let shell =
        |dt: f64| Setup { shells: vec![capsule(BendingMeasure::Curvature, 0.01, 0.05)], ..fourth_order(SHEAR, 64, dt) };
    let times = [
        ("capsule_transient_curvature_b0.01_Ca0.05_Gt1", 1.0),
        ("capsule_transient_curvature_b0.01_Ca0.05_Gt2", 2.0),
        ("capsule_transient_curvature_b0.01_Ca0.05_Gt5", 5.0),
    ];
    push("capsule, b = 0.01, Ca = 0.05", &shell, 0.0009, &times)?;
    push("the same, steady", &shell, 0.0009, &[("capsule_curvature_b0.01_Ca0.05", 20.0)])?;
    Ok(table)
}

fn turning_points() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Turning points of steady drops in extension, beyond which there are none: capillary number and deformation",
        "ratio | nodes | capillary number | D | curvature of the tip | tail of modes",
    );
    for (ratio, from, all) in [(0.1, 0.2, [64, 96, 128]), (1.0, 0.15, [64, 96, 128]), (10.0, 0.1, [64, 96, 128])] {
        for nodes in all {
            let fold = || -> Result<String, SteadyError> {
                let start = drop_in(FlowSetup { extension: from, ..EXTENSION }, ratio, 1.0, nodes);
                let start = SteadyState::find(&start)?;
                let step = Continuation::new(Parameter::ExtensionRate, from, 0.4);
                let branch = Continuation { largest_step: 0.1, ..step }
                    .follow(&start, |_, special| !special.iter().any(|special| special.kind == SpecialKind::Fold))?;
                let Some(special) = branch.special.iter().find(|special| special.kind == SpecialKind::Fold) else {
                    return Ok(format!("{:?} | - | - | -", branch.end));
                };
                let (state, seen) = (&special.critical.state, special.critical.state.deformation()?);
                let (value, deformation, tip) = (special.value, seen.by_moments, seen.tip_curvature);
                Ok(format!("{value:.6} | {deformation:.5} | {tip:.2} | {:.0e}", state.tail()))
            };
            table.measure(format_args!("{ratio} | {nodes}"), || {
                Ok(fold().unwrap_or_else(|error| format!("{error} | - | - | -")))
            })?;
        }
    }
    Ok(table)
}

fn rigid() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Rigid ellipses in shear: error of the period of a turn, 2 pi (r + 1/r), over it, 96 nodes",
        "aspect ratio | integrator | steps a turn | error",
    );
    for r in [1.5, 2.0, 4.0] {
        let period = 2.0 * PI * (r + 1.0 / r);
        for (name, of_fourth_order, steps) in [
            ("midpoint", false, 300.0),
            ("midpoint", false, 1200.0),
            ("runge-kutta", true, 150.0),
            ("runge-kutta", true, 300.0),
            ("runge-kutta", true, 600.0),
        ] {
            table.measure(format_args!("{r} | {name} | {steps}"), || {
                let make = if of_fourth_order { fourth_order } else { plane };
                let setup = Setup { rigid_bodies: vec![ellipse(r, 0.0)], ..make(SHEAR, 96, period / steps) };
                let Built { mut scene, rigid_bodies, .. } = setup.build()?;
                scene.run(period).go()?;
                // It is slowest at the end of a turn, where it turns by 1/(r^2 + 1) in a time.
                let late = (scene.observe(rigid_bodies[0])?.angle + 2.0 * PI) * (r * r + 1.0);
                Ok(format!("{:.1e}", late.abs() / period))
            })?;
        }
    }
    Ok(table)
}

fn emulsions() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Square lattices of drops whose images have gone once around, at vanishing capillary number: (viscosity of the \
         box/eta - 1)/phi, beside k and k/(1 - 2 m k phi) of point stresslets, m = -0.149106",
        "ratio | side | phi | found | k | point stresslets | difference over phi^2",
    );
    for ratio in [1e-3, 0.2, 1.0, 5.0, 100.0] {
        let k = (1.0 + 2.0 * ratio) / (1.0 + ratio);
        for side in [4.0, 6.0, 8.0, 16.0] {
            let phi = PI / (side * side);
            let viscosity = |capillary: f64| -> Result<f64, StudyError> {
                let dt = 0.08 * (1.0 + ratio) * capillary;
                let setup = Setup {
                    region: Region::Box { lengths: [side; 2] },
                    droplets: vec![drop_of(ratio, capillary)],
                    ..plane(SHEAR, 32, dt)
                };
                let mut scene = setup.build()?.scene;
                scene.run(1.0).go()?;
                Ok((scene.system_mut().stress()?.effective_viscosity().unwrap_or(f64::NAN) - 1.0) / phi)
            };
            table.measure(format_args!("{ratio} | {side} | {phi:.4}"), || {
                // The error of the capillary number is of second order.
                let capillary = 0.04 / (1.0 + ratio);
                let [coarse, fine] = [capillary, 0.5 * capillary].map(viscosity);
                let (coarse, fine) = (coarse?, fine?);
                let found = fine + (fine - coarse) / 3.0;
                let points = k / (1.0 + 2.0 * 0.149_105_662 * k * phi);
                let apart = (found - points) / (phi * phi);
                Ok(format!("{found:.5} | {k:.5} | {points:.5} | {apart:.3}"))
            })?;
        }
    }
    Ok(table)
}

/// Width and length of the channel of migrating drops, their distance from the middle, and the times between which the
/// migration is measured.
const WIDTH: f64 = 10.0;
const LENGTH: f64 = 12.0;
const ASIDE: f64 = 2.0;
const MIGRATION: [f64; 2] = [10.0, 12.0];

/// Speed away from the middle of a drop beside it.
fn migrates(setup: &Setup, ratio: f64) -> Result<f64, StudyError> {
    let viscosity = (ratio != 1.0).then_some(ratio);
    let drop = DropletSetup { centre: [0.0, ASIDE], viscosity, ..drop_of(ratio, 0.2) };
    let Built { mut scene, droplets, .. } = Setup { droplets: vec![drop], ..setup.clone() }.build()?;
    let mut height = |until: f64| -> Result<f64, StudyError> {
        scene.run(until).go()?;
        Ok(scene.observe(droplets[0])?.centroid.y)
    };
    let [start, end] = MIGRATION;
    let before = height(start)?;
    Ok((height(end)? - before) / (end - start))
}

/// Twice as many markers as nodes.
fn finer(setup: Setup) -> Setup {
    let Method::Integral(method) = setup.method else { return setup };
    Setup { method: Method::Integral(IntegralMethod { elements: 2 * method.nodes, ..method }), ..setup }
}

fn migration() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Migration of a drop 2 R off the middle of a Poiseuille flow of half width 5 R, capillary number 0.2 by the \
         shear rate at y = 5 R, from t = 10 to 12: speed away from the middle over R times that rate, in the plane and \
         between walls in a period of 12 R",
        "ratio | plane, 32 nodes | plane, 48 nodes | channel, 32 nodes | channel, 48 nodes | grid, h = 0.2 | \
        grid, h = 0.1",
    );
    let flux = 2.0 / 3.0 * 0.25 * WIDTH * WIDTH;
    let region = Region::Channel { length: LENGTH, width: WIDTH, drive: Drive::Flux(flux) };
    let channel = |nodes: usize| Setup { region, ..plane(FlowSetup::default(), nodes, 0.01) };
    for ratio in [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0] {
        // Contrasts that are smeared over cells, and too few nodes, may end in an interface that crosses itself.
        let entry = |setup: &Setup| migrates(setup, ratio).map_or("ends".to_owned(), |speed| format!("{speed:.5}"));
        table.measure(ratio, || {
            let mut row = Vec::from([32, 48].map(|nodes| entry(&finer(plane(poiseuille(0.5 * WIDTH), nodes, 0.01)))));
            row.extend([32, 48].map(|nodes| entry(&finer(channel(nodes)))));
            for spacing in [0.2, 0.1] {
                let corrected = ratio == 1.0;
                let method = Method::Grid(GridMethod { corrected, ..GridMethod::of_spacing(spacing) });
                row.push(entry(&Setup { method, step: StepSize::OfLimit(0.5), ..channel(32) }));
            }
            Ok(row.join(" | "))
        })?;
    }
    Ok(table)
}

/// Side of the box of swimmers, when the flow begins.
const SIDE: f64 = 6.0;
const ONSET: f64 = 40.0;

fn swimmers() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Viscosity of a box of 6 x 6 R0 with a droplet in it, of the viscosity around it, over that: mean and bounds \
         over a turn of the swimmer at half the shear rate, after a first one; and the bounds 1.5 phi + |S|/(eta G V) \
         by the stresslet S of the swimmer at rest",
        "activity | shear rate | nodes | S/(eta R0^2) | mean - 1 | least - 1 | most - 1 | by the stresslet",
    );
    let phi = PI / (SIDE * SIDE);
    for (activity, rate, nodes) in [
        (0.0, 0.1, 32),
        (-1.0, 0.1, 32),
        (-2.0, 0.05, 32),
        (-2.0, 0.1, 32),
        (-2.0, 0.1, 48),
        (-2.0, 0.2, 32),
        (-3.0, 0.1, 32),
    ] {
        let droplet = if activity == 0.0 { DropletSetup::passive(10.0) } else { DropletSetup::active(activity) };
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        let setup =
            Setup { region: Region::Box { lengths: [SIDE; 2] }, method, droplets: vec![droplet], ..Setup::default() };
        table.measure(format_args!("{activity} | {rate} | {nodes}"), || {
            let mut scene = setup.build()?.scene;
            scene.run(ONSET).go()?;
            let [[xx, xy], _] = scene.system_mut().stresslets()?[0];
            let stresslet = xx.signum() * Vec2::new(xx, xy).length() / setup.viscosity;
            scene.impose(ImposedFlow::shear(rate))?;
            let turn = 4.0 * PI / rate;
            scene.run(ONSET + turn).go()?;
            let mut seen: Vec<f64> = Vec::new();
            let mut look = |system: &mut System<AnyFlow>| {
                let viscosity = system.stress()?.effective_viscosity().unwrap_or(f64::NAN);
                seen.push(viscosity / setup.viscosity - 1.0);
                Ok::<(), motile::scene::SceneError>(())
            };
            scene.run(ONSET + 2.0 * turn).observe(Every::Time(turn / 200.0), &mut look).go()?;
            let bounds = seen.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| [a.min(*v), b.max(*v)]);
            let mean = seen.iter().sum::<f64>() / seen.len() as f64;
            let by_stresslet = 1.5 * phi + stresslet.abs() / (rate * SIDE * SIDE);
            Ok(format!("{stresslet:.4} | {mean:.4} | {:.4} | {:.4} | {by_stresslet:.4}", bounds[0], bounds[1]))
        })?;
    }
    Ok(table)
}
