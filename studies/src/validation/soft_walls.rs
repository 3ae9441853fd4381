//! Soft walls: how their forces are put on the fluid, and which part of the resolution their error comes from.

use motile::elastic_solids::ChannelShape;
use motile::scene::{StepSize, integrator::IntegratorKind};
use motile::setup::{
    DropletSetup, LayersMethod, Material, MeshKind, Method, Setup, SolidSetup, SurfaceElasticitySetup,
};
use motile_tests::validation::Table;
use motile_tests::validation::scene::open_channel;
use motile_tests::validation::swimmers::speeds;

use super::Tables;
use crate::tables::Measure;
use crate::work_precision::cost::processor_time;

/// A droplet between neo-Hookean walls of Young's modulus E in a channel as wide as its radius.
#[derive(Clone, Copy)]
struct Case {
    young: f64,
    activity: f64,
    /// True if forces on inner points are spread over the triangles.
    spread: bool,
    /// Length of the channel.
    length: f64,
    /// Spacings of the method and of the mesh.
    spacings: [f64; 2],
    finer: bool,
    /// Bulk modulus over E.
    bulk: f64,
    nodes: usize,
    tolerance: f64,
    surface_elasticity: bool,
    time: f64,
}

/// Resolution from which one thing at a time is changed.
const USUAL: Case = Case {
    young: 1e3,
    activity: -4.0,
    spread: true,
    length: 12.0,
    spacings: [0.1, 0.2],
    finer: true,
    bulk: 0.75,
    nodes: 128,
    tolerance: 1e-4,
    surface_elasticity: false,
    time: 5.0,
};

/// Spacings of the method and of the mesh.
const RESOLUTIONS: [[f64; 2]; 2] = [[0.1, 0.2], [0.05, 0.1]];
/// Those of walls with a surface_elasticity: one with the finer grid alone.
const SKINNED: [[f64; 2]; 3] = [[0.1, 0.2], [0.05, 0.1], [0.05, 0.2]];

impl Case {
    /// The speed at the end (length per time), and the processor time that the run took (seconds).
    fn run(self) -> Result<[f64; 2], String> {
        let [h, mesh] = self.spacings;
        let material = Material::NeoHookean { shear: 0.375 * self.young, bulk: self.bulk * self.young };
        let walls = SolidSetup::walls(&ChannelShape::Straight { width: 1.0 }, &material).into_iter();
        let solids = walls.map(|wall| SolidSetup {
            mesh: MeshKind::Unstructured,
            mesh_spacing: Some(mesh),
            finer_surface: Some(self.finer),
            spread_over_triangles: self.spread,
            surface_elasticity: self
                .surface_elasticity
                .then_some(SurfaceElasticitySetup { stretching: 300.0, bending: 1.0 }),
            ..wall
        });
        let layers = LayersMethod { nodes: self.nodes, elements: 4 * self.nodes, ..LayersMethod::of_spacing(h) };
        let setup = Setup {
            viscosity: 100.0,
            region: open_channel(self.length, 4.0),
            method: Method::Layers(layers),
            step: StepSize::Adaptive { tolerance: self.tolerance },
            // The bending of short sides is stiff.
            integrator: if self.surface_elasticity {
                IntegratorKind::RungeKuttaChebyshev
            } else {
                IntegratorKind::default()
            },
            droplets: vec![DropletSetup { squeezed: true, ..DropletSetup::active(self.activity) }],
            solids: solids.collect(),
            ..Setup::default()
        };
        let start = processor_time().unwrap_or(f64::NAN);
        let found = speeds(&setup, &[self.time]).map_err(|error| format!("ends: {error}"))?;
        Ok([found[0], processor_time().unwrap_or(f64::NAN) - start])
    }
}

pub(super) fn soft_walls() -> Tables {
    Ok(vec![resolutions()?, parts()?, skins()?])
}

/// Texts of the runs of a case at these resolutions: speeds, the difference of the first two in per cent, seconds.
fn texts(case: Case, resolutions: &[[f64; 2]]) -> [String; 3] {
    let runs: Vec<Result<[f64; 2], String>> =
        resolutions.iter().map(|&spacings| Case { spacings, ..case }.run()).collect();
    let each = |text: &dyn Fn(&[f64; 2]) -> String| {
        let texts: Vec<String> = runs.iter().map(|run| run.as_ref().map_or_else(String::clone, text)).collect();
        texts.join(", ")
    };
    let difference = |pair: &[Result<[f64; 2], String>]| match pair {
        [Ok([coarse, _]), Ok([fine, _]), ..] => format!("{:.2}", 100.0 * (coarse / fine - 1.0).abs()),
        _ => String::new(),
    };
    [each(&|[speed, _]| format!("{speed:.5}")), difference(&runs), each(&|[_, seconds]| format!("{seconds:.1}"))]
}

fn resolutions() -> anyhow::Result<Table> {
    let mut table = Table::new(
        &format!(
            "Soft walls in a channel of width R0: speeds at t = 5 with spacings h and of the mesh of {RESOLUTIONS:?}; \
             their difference in %, processor time in seconds"
        ),
        "E | activity | forces on | speeds | difference | seconds",
    );
    let cases = [(1e3, -4.0), (1e3, -3.0), (1e3, -2.0), (1e4, -4.0)];
    for (young, activity) in cases {
        for (name, spread) in [("points", false), ("triangles", true)] {
            let case = Case { young, activity, spread, ..USUAL };
            table.measure(format_args!("{young:.0e} | {activity} | {name}"), || {
                Ok(texts(case, &RESOLUTIONS).join(" | "))
            })?;
        }
    }
    Ok(table)
}

/// One thing changed at a time.
fn parts() -> anyhow::Result<Table> {
    let usual = Case { activity: -3.0, ..USUAL };
    let mut table = Table::new(
        "E = 1e3, activity -3, forces on triangles, h = 0.1 and a mesh of 0.2: one thing changed at a time; speed, \
         processor time in seconds",
        "changed | speed | seconds",
    );
    let cases = [
        ("nothing", usual),
        ("h = 0.05", Case { spacings: [0.05, 0.2], ..usual }),
        ("h = 0.05, mesh of 0.1", Case { spacings: [0.05, 0.1], ..usual }),
        ("h = 0.025, mesh of 0.1", Case { spacings: [0.025, 0.1], ..usual }),
        ("h = 0.025, mesh of 0.05", Case { spacings: [0.025, 0.05], ..usual }),
        ("surface as coarse as the mesh", Case { finer: false, ..usual }),
        ("bulk modulus of E/100", Case { bulk: 0.01, ..usual }),
        ("bulk modulus of 3 E", Case { bulk: 3.0, ..usual }),
        ("a channel of length 6", Case { length: 6.0, ..usual }),
        ("192 nodes", Case { nodes: 192, ..usual }),
        ("tolerance of 1e-5", Case { tolerance: 1e-5, ..usual }),
        ("forces on points", Case { spread: false, ..usual }),
        ("forces on points, h = 0.05, mesh of 0.1", Case { spread: false, spacings: [0.05, 0.1], ..usual }),
        ("forces on points, h = 0.025, mesh of 0.05", Case { spread: false, spacings: [0.025, 0.05], ..usual }),
    ];
    for (name, case) in cases {
        table.measure(name, || {
            let [speed, _, seconds] = texts(case, &[case.spacings]);
            Ok(format!("{speed} | {seconds}"))
        })?;
    }
    Ok(table)
}

/// To a time when walls without a surface_elasticity have creased.
fn skins() -> anyhow::Result<Table> {
    let mut table = Table::new(
        &format!(
            "E = 1e3, forces on triangles, and a surface of stretching modulus 300 and bending modulus 1, at t = 30, \
             with spacings h and of the mesh of {SKINNED:?}, by the Runge-Kutta-Chebyshev method; the difference of \
             the first two in %"
        ),
        "activity | surface | speeds | difference | seconds",
    );
    for activity in [-3.0, -4.0] {
        for (name, finer) in [("as the mesh", false), ("finer", true)] {
            let case = Case { activity, finer, surface_elasticity: true, time: 30.0, ..USUAL };
            table.measure(format_args!("{activity} | {name}"), || Ok(texts(case, &SKINNED).join(" | ")))?;
        }
    }
    Ok(table)
}
