use super::*;
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::setup::{Material, SolidSetup};

#[test]
fn triangles_of_both_walls_of_a_channel() {
    let setup = Setup {
        region: Region::Channel { length: 4.0, width: 5.4, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { spacing: 0.1, ..LayersMethod::default() }),
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear: 100.0 }),
        ..Setup::default()
    };
    let scene = setup.build().unwrap().scene;
    let thickness = 1.5;
    let system = scene.system();
    let mut pieces = Pieces::default();
    solids_of(system).for_each(|solid| pieces.add(solid));
    let size = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| pieces.mesh.points[k]);
        0.5 * (b - a).perp_dot(c - a)
    };
    // None is stretched over the period, and together they are both walls.
    assert!(pieces.mesh.triangles.iter().all(|t| size(t) > 0.0 && size(t) < 0.03));
    assert!((pieces.mesh.triangles.iter().map(size).sum::<f64>() - 2.0 * 4.0 * thickness).abs() < 1e-9);
    assert!(pieces.stress.iter().flatten().all(|s| s.abs() < 1e-9));
}

/// The surface of a droplet of revolution goes from pole to pole: its ends on the axis, and rings between them.
#[test]
fn surfaces_of_revolution_are_closed() {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 96 });
    let setup = Setup { region: Region::Space, method, droplets: vec![DropletSetup::active(-1.0)], ..Setup::default() };
    let scene = setup.build().unwrap().scene;
    let markers = scene.system().bodies::<ActiveDroplet>().next().unwrap().1.markers().len();
    let rings = markers / 2 - 1;
    let document = surfaces(scene.system()).unwrap().document().unwrap();
    assert!(document.contains(&format!("NumberOfPoints=\"{}\"", 2 + rings * SECTORS)), "{document:.300}");
    assert!(document.contains(&format!("NumberOfPolys=\"{}\"", (rings + 1) * SECTORS)), "{document:.300}");
}
