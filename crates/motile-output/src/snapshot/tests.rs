use super::*;
use crate::{Animation, Look, ParaView};
use motile::elastic_solids::ChannelShape;
use motile::prelude::*;
use motile::scene::MarkerBody;
use motile::setup::{Hold, Material, ShellSetup, SolidOutline, SolidSetup};

#[test]
fn a_snapshot_of_a_box_and_of_a_channel() {
    let setup = Setup {
        region: Region::Box { lengths: [6.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![DropletSetup { centre: [1.0, 0.5], ..DropletSetup::default() }],
        ..Setup::default()
    };
    let mut scene = setup.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    assert_eq!((raster.cells(), raster.periodic), ([24, 16], [true, true]));
    assert_eq!(raster.coarsened(12).cells(), [12, 8]);
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    assert!((seen.droplets[0].centroid - Vec2::new(1.0, 0.5)).length() < 1e-9);
    // The pressure inside is above that outside, the droplet moves to the right.
    let at = |x: f64, y: f64| {
        let near = |p: &&(Vec2, FlowSample)| (p.0 - Vec2::new(x, y)).length() < 0.2;
        let all: Vec<_> = raster.points().into_iter().zip(seen.flow.iter().copied()).collect();
        all.iter().find(near).unwrap().1
    };
    assert!(at(1.0, 0.5).pressure > at(-2.0, -1.0).pressure);
    assert!(at(1.0, 0.5).velocity.x > 0.0);

    let region = Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient };
    let scene = Setup { region, ..setup }.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    assert_eq!((raster.origin, raster.size), ([-3.0, -2.0], [6.0, 4.0]));
    assert_eq!(raster.periodic, [true, false]);
}

#[test]
fn all_droplets_and_solids_of_any_material_are_seen() {
    let disc = SolidOutline::Disc { centre: [0.0, 0.0], radius: 0.5 };
    let nucleus = SolidSetup::new(disc, Material::NeoHookean { shear: 100.0, bulk: 200.0 });
    let springs = Material::Springs { shear: 100.0 };
    let mut solids = SolidSetup::walls(&ChannelShape::Straight { width: 3.0 }, &springs);
    solids.push(SolidSetup { hold: Hold::Free, ..nucleus });
    let setup = Setup {
        region: Region::Channel { length: 8.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod { spacing: 0.1, ..LayersMethod::default() }),
        droplets: [-2.0, 2.0].map(|x| DropletSetup { centre: [x, 0.0], ..DropletSetup::default() }).to_vec(),
        solids,
        ..Setup::default()
    };
    let mut scene = setup.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 0.2).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    for (droplet, x) in seen.droplets.iter().zip([-2.0, 2.0]) {
        assert!((droplet.centroid - Vec2::new(x, 0.0)).length() < 1e-6, "{}", droplet.centroid);
    }
    // The same without the flow, of which no picture is drawn.
    let bodies = Snapshot::of_bodies(scene.system(), raster).unwrap();
    assert!(bodies.droplets == seen.droplets && bodies.solids == seen.solids && bodies.walls == seen.walls);
    assert!(bodies.flow.is_empty() && Look::default().svg(&bodies, &[]).is_err());
    // Areas are those of the setup, of the disc's polygon a little less.
    let areas: Vec<f64> = seen.solids.iter().map(|solid| polygon_moments(&solid.area[0]).unwrap().area).collect();
    let exact = [8.0, 8.0, 0.25 * std::f64::consts::PI];
    assert_eq!((seen.droplets.len(), areas.len()), (2, 3));
    assert!(areas.iter().zip(exact).all(|(area, exact)| (0.95..1.001).contains(&(area / exact))), "{areas:?}");
}

/// Bodies of types that this crate does not know are dots in pictures and points in files.
#[test]
fn bodies_of_your_own_are_seen() {
    let method = Method::Grid(GridMethod::of_spacing(0.25));
    let mut scene = Setup { method, droplets: Vec::new(), ..Setup::default() }.build().unwrap().scene;
    let places = vec![Vec2::new(-1.0, 0.5), Vec2::new(0.0, 0.7), Vec2::new(1.0, 0.2)];
    scene.add(MarkerBody::new("cilium", places.clone(), |_, forces| forces.fill(Vec2::new(1.0, 0.0))));
    let raster = Raster::of(scene.system(), 0.5).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    assert_eq!(seen.solids.len(), 1);
    assert_eq!(seen.solids[0].edges, places.iter().map(|place| vec![*place; 2]).collect::<Vec<_>>());
    let look = Look { streamlines: false, ..Look::default() };
    let edge = "#5c544a";
    assert_eq!(look.svg(&seen, &[]).unwrap().matches(edge).count(), 1);

    let directory = std::env::temp_dir().join(format!("motile-own-body-{}", std::process::id()));
    let mut files = ParaView::create(&directory, raster).unwrap();
    scene.run(0.1).observe(Every::Time(0.1), &mut files).go().unwrap();
    let text = std::fs::read_to_string(directory.join("points_0001.vtp")).unwrap();
    assert!(text.contains("NumberOfVerts=\"3\"") && text.contains("Name=\"force\""), "{text}");
    std::fs::remove_dir_all(&directory).unwrap();
}

/// The outline of a shell shows in a periodic box as in unbounded fluid.
#[test]
fn shells_are_seen_in_any_region() {
    for region in [Region::Plane, Region::Box { lengths: [4.0, 4.0] }] {
        let shells = vec![ShellSetup::default()];
        let mut scene = Setup { region, shells, droplets: Vec::new(), ..Setup::default() }.build().unwrap().scene;
        let raster = Raster::new([-2.0; 2], [4.0; 2], [8; 2], [region != Region::Plane; 2]).unwrap();
        let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
        let svg = Look { streamlines: false, ..Look::default() }.svg(&seen, &[]).unwrap();
        assert_eq!(svg.matches("#5c544a").count(), 1, "{region:?}");
    }
}

#[test]
fn names_of_other_formats_are_refused() {
    let mut scene = Setup { droplets: Vec::new(), ..Setup::default() }.build().unwrap().scene;
    let raster = Raster::of(scene.system(), 1.0).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    for name in ["picture.jpg", "picture.pdf", "picture", "svg"] {
        let refused = Look::default().write_picture(&seen, &[], name).unwrap_err();
        assert!(refused.to_string().ends_with("Use a name that ends in .svg or .png"), "{refused}");
        let refused = Animation::new(Look::default(), raster).write(&[], name).unwrap_err();
        assert!(refused.to_string().ends_with("Use a name that ends in .gif"), "{refused}");
    }
}

#[test]
fn markers_lie_between_their_segments() {
    assert_eq!(at_markers(&[1.0, 3.0, 5.0]), [3.0, 2.0, 4.0]);
    assert!(at_markers(&[]).is_empty());
}
