//! Droplets between elastic walls: both grid spacings, and the rigid limit without a grid.

use motile::elastic_solids::ChannelShape;
use motile::setup::{DropletSetup, IntegralMethod, LayersMethod, Material, MeshKind, Method, Setup, SolidSetup};
use motile_tests::validation::Table;
use motile_tests::validation::scene::open_channel;
use motile_tests::validation::swimmers::speeds;

use super::Tables;
use crate::tables::Measure;

/// A droplet between walls 1.5 R0 thick.
struct Case {
    walls: &'static str,
    material: Material,
    width: f64,
    length: f64,
    /// Of the droplet and of the fluid around it.
    viscosities: [f64; 2],
    activity: f64,
    nodes: usize,
    time: f64,
    /// True if it is long enough for the finer grid to be left out.
    coarse: bool,
}

impl Case {
    /// Springs of Cowley's constant k.
    fn springs(k: f64, name: &'static str, width: f64, activity: f64) -> Self {
        let material = Material::Springs { shear: 9.375e-3 * k };
        Self {
            walls: name,
            material,
            width,
            length: 12.0,
            viscosities: [100.0; 2],
            activity,
            nodes: 72,
            time: 20.0,
            coarse: false,
        }
    }

    /// Neo-Hookean walls of Poisson's ratio 1/3 in a channel narrower than the droplet.
    fn narrow(young: f64, name: &'static str, activity: f64, time: f64) -> Self {
        let [shear, bulk] = [0.375 * young, 0.75 * young];
        let material = Material::NeoHookean { shear, bulk };
        Self { material, nodes: 128, time, ..Self::springs(0.0, name, 1.0, activity) }
    }

    fn setup(&self) -> Setup {
        let [inside, viscosity] = self.viscosities;
        let mut droplet = DropletSetup { squeezed: true, ..DropletSetup::active(self.activity) };
        droplet.viscosity = (inside != viscosity).then_some(inside);
        Setup { viscosity, droplets: vec![droplet], ..Setup::default() }
    }

    fn elastic(&self, h: f64) -> Setup {
        let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: self.width }, &self.material);
        if let Material::NeoHookean { .. } = self.material {
            solids.iter_mut().for_each(|wall| wall.mesh = MeshKind::Unstructured);
        }
        let layers = LayersMethod { nodes: self.nodes, elements: 4 * self.nodes, ..LayersMethod::of_spacing(h) };
        let method = Method::Layers(layers);
        Setup { region: open_channel(self.length, self.width + 3.0), method, solids, ..self.setup() }
    }

    fn rigid(&self) -> Setup {
        let method = Method::Integral(IntegralMethod { nodes: self.nodes, elements: 4 * self.nodes });
        Setup { region: open_channel(self.length, self.width), method, ..self.setup() }
    }

    fn speed(&self, setup: &Setup) -> String {
        match speeds(setup, &[self.time]) {
            Ok(speeds) => speeds.iter().map(|speed| format!("{speed:.5}")).collect(),
            Err(error) => format!("ends: {error}"),
        }
    }
}

/// Speeds at equal times.
pub(super) fn elastic_walls() -> Tables {
    let mut cases = vec![
        Case::springs(1e6, "springs, k = 1e6", 2.0, -2.0),
        Case::springs(1e6, "springs, k = 1e6", 2.0, -4.0),
        Case { coarse: true, ..Case::springs(1e7, "springs, k = 1e7", 2.0, -4.0) },
        Case::springs(1e6, "springs, k = 1e6", 3.0, -4.0),
        Case { coarse: true, time: 5.0, ..Case::springs(1e7, "springs, k = 1e7", 3.0, -4.0) },
    ];
    for (k, name) in [(1e4, "springs, k = 1e4"), (1e6, "springs, k = 1e6")] {
        for inside in [20.0, 1000.0, 10_000.0] {
            let viscosities = [inside, 100.0];
            cases.push(Case { viscosities, length: 6.0, time: 4.0, ..Case::springs(k, name, 2.2, -4.0) });
        }
    }
    for activity in [-2.0, -4.0] {
        cases.push(Case::narrow(1e4, "neo-Hookean, E = 1e4", activity, 15.0));
        cases.push(Case::narrow(1e3, "neo-Hookean, E = 1e3", activity, 5.0));
    }
    let mut table = Table::new(
        "Droplets between elastic walls: speeds at equal times, and between rigid walls without a grid",
        "walls | width | viscosity inside | activity | t | h = 0.1 | h = 0.05 | rigid",
    );
    for case in &cases {
        let Case { walls, width, viscosities: [inside, _], activity, time, .. } = case;
        table.measure(format_args!("{walls} | {width} | {inside} | {activity} | {time}"), || {
            let coarse = case.speed(&case.elastic(0.1));
            let fine = if case.coarse { String::new() } else { case.speed(&case.elastic(0.05)) };
            // A droplet wider than the channel has no start between rigid walls.
            let rigid = if case.width < 2.0 { String::new() } else { case.speed(&case.rigid()) };
            Ok(format!("{coarse} | {fine} | {rigid}"))
        })?;
    }
    Ok(vec![table])
}
