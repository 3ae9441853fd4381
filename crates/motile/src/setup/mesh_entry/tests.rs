//! Solids on meshes of files: as those that are meshed here, stiffer in groups, pinned along lines.

use elastic_solids::mesh::GmshMesh;
use motile_base::{Drive, Region};

use super::*;
use crate::setup::{DropletSetup, GridMethod, Hold, Material, Method, Setup, SolidOutline, SolidSetup};

const MATERIAL: Material = Material::NeoHookean { shear: 10.0, bulk: 20.0 };

/// A droplet and a solid in a channel.
fn scene(solid: SolidSetup) -> Setup {
    let droplet = DropletSetup { centre: [-1.6, 0.0], ..DropletSetup::active(-3.0) };
    Setup {
        region: Region::Channel { length: 6.0, width: 4.0, drive: Drive::ZeroGradient },
        method: Method::Grid(GridMethod { spacing: 0.1, corrected: false, ..GridMethod::default() }),
        droplets: vec![droplet],
        solids: vec![solid],
        ..Setup::default()
    }
}

fn after_steps(setup: &Setup) -> Vec<Vec2> {
    let mut scene = setup.build().unwrap().scene;
    match scene.run(1e3).most_steps(3).go() {
        Ok(()) | Err(motile_scene::SceneError::TooManySteps { .. }) => {}
        Err(error) => panic!("{error}"),
    }
    scene.system().markers().positions().to_vec()
}

/// The mesh of an ellipse that motile makes, by way of a file of Gmsh in another unit: the same steps.
#[test]
fn a_mesh_of_a_file_moves_as_the_mesh_in_it() {
    let outline = SolidOutline::Ellipse { centre: [1.0, 0.2], half_axes: [0.8, 0.6] };
    let of_outline = SolidSetup { hold: Hold::Free, mesh_spacing: Some(0.15), ..SolidSetup::new(outline, MATERIAL) };
    let meshed = scene(of_outline.clone());
    let built = meshed.build().unwrap();
    let mesh = built.scene.body(built.solids[0]).unwrap().mesh().clone();
    let area = mesh.area();
    // In units of 2^-20, so that lengths are the same to the last bit.
    let scale = 2.0_f64.powi(-20);
    let points = mesh.points().iter().map(|point| *point / scale).collect();
    let mesh = TriangleMesh::new(points, mesh.triangles().to_vec()).unwrap();
    let text = GmshMesh { mesh, groups: Vec::new() }.to_text().unwrap();
    let directory = std::env::temp_dir().join(format!("motile-mesh-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    std::fs::write(directory.join("nucleus.msh"), text).unwrap();
    let outline = SolidOutline::Mesh(MeshSetup { scale, ..MeshSetup::of_file("nucleus.msh") });
    let solid = SolidSetup { outline, mesh_spacing: None, ..of_outline };
    let from_file = scene(solid.clone()).with_files(&directory).unwrap();
    let SolidOutline::Mesh(read) = &from_file.solids[0].outline else { panic!("no mesh") };
    assert!(read.file.is_none() && read.points.len() > 60);
    let built = from_file.build().unwrap();
    assert_eq!(built.scene.body(built.solids[0]).unwrap().mesh().area(), area);
    let [one, other] = [after_steps(&meshed), after_steps(&from_file)];
    let apart = one.iter().zip(&other).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(one.len() == other.len() && apart < 1e-12, "{apart}");
    let missing = scene(solid).with_files(Path::new("nowhere")).unwrap_err().to_string();
    assert!(missing.starts_with("solids[0].outline.mesh: the file") && missing.contains("no such file"), "{missing}");
    std::fs::remove_dir_all(directory).unwrap();
}

/// A block of 2 x 1 in two groups with a base.
fn block() -> MeshSetup {
    let points = (0..3).flat_map(|y| (0..5).map(move |x| [0.5 * f64::from(x), 0.5 * f64::from(y)])).collect();
    let cell = |x: usize, y: usize| {
        let a = 5 * y + x;
        [[a, a + 1, a + 6], [a, a + 6, a + 5]]
    };
    let triangles: Vec<[usize; 3]> = (0..2).flat_map(|y| (0..4).flat_map(move |x| cell(x, y))).collect();
    // Cells 2 and 3 of each row are on the right.
    let right = (0..16).filter(|triangle| triangle % 8 >= 4).collect();
    MeshSetup {
        points,
        triangles,
        groups: vec![MeshGroup { name: "right".into(), members: right }],
        boundaries: vec![MeshGroup { name: "base".into(), members: (0..5).collect() }],
        place: [0.5, -0.5],
        ..MeshSetup::default()
    }
}

/// A group four times as stiff has four times the energy at the same strain, and pinned points do not move.
#[test]
fn groups_are_stiffer_and_lines_are_pinned() {
    let factors = vec![GroupFactor { group: "right".into(), factor: 4.0 }];
    let mesh = MeshSetup { factors, pinned: vec!["base".into()], ..block() };
    for material in [MATERIAL, Material::SaintVenantKirchhoff { shear: 10.0, bulk: 20.0 }] {
        let energy = |mesh: &MeshSetup| {
            let setup = scene(SolidSetup::new(SolidOutline::Mesh(mesh.clone()), material));
            let built = setup.build().unwrap();
            let solid = built.scene.body(built.solids[0]).unwrap();
            assert_eq!(solid.free_points().len(), 10);
            // Stretched by a tenth along y, away from the base at y = -0.5.
            let stretch = |s: Vec2| Vec2::new(s.x, -0.5 + 1.1 * (s.y + 0.5));
            solid.clone().deformed(stretch).unwrap().elastic_energy().unwrap()
        };
        let plain = MeshSetup { factors: Vec::new(), ..mesh.clone() };
        let ratio = energy(&mesh) / energy(&plain);
        assert!((ratio - 2.5).abs() < 1e-12, "{ratio}");
    }
}

/// A member that is named twice counts once, and groups of one name are one group.
#[test]
fn members_of_groups_count_once() {
    let factors = vec![GroupFactor { group: "right".into(), factor: 4.0 }];
    let plain = MeshSetup { factors, place: [0.0; 2], ..block() };
    let [right] = plain.groups.as_slice() else { panic!("one group") };
    let half = |members: &[usize]| MeshGroup { name: "right".into(), members: members.to_vec() };
    let twice = half(&[&right.members[..], &right.members].concat());
    let (first, second) = right.members.split_at(3);
    for groups in [vec![twice], vec![half(first), half(second)]] {
        let parts = MeshSetup { groups: groups.clone(), ..plain.clone() }.parts().unwrap();
        for k in 0..50 {
            let place = Vec2::new(2.0 * (f64::from(k) * 0.618).fract(), (f64::from(k) * 0.414).fract());
            assert_eq!(parts.factor(place), if place.x < 1.0 { 1.0 } else { 4.0 }, "{groups:?} {place:?}");
        }
    }
}

#[test]
fn places_of_groups() {
    let factors = vec![GroupFactor { group: "right".into(), factor: 4.0 }];
    for scale in [1.0, 1e-6] {
        let parts = MeshSetup { factors: factors.clone(), scale, place: [0.0; 2], ..block() }.parts().unwrap();
        for k in 0..200 {
            let place = Vec2::new(2.0 * (f64::from(k) * 0.618).fract(), (f64::from(k) * 0.414).fract());
            assert_eq!(parts.factor(place * scale), if place.x < 1.0 { 1.0 } else { 4.0 }, "{place:?}");
        }
    }
}

#[test]
fn meshes_that_cannot_be_are_refused_with_their_keys() {
    let with = |mesh: MeshSetup| SolidSetup::new(SolidOutline::Mesh(mesh), MATERIAL);
    let pinned = MeshSetup { pinned: vec!["base".into()], ..block() };
    let factor = |group: &str, factor| vec![GroupFactor { group: group.into(), factor }];
    for (said, solid) in [
        ("solids[0].outline.mesh.file = not given", with(MeshSetup::default())),
        (
            "solids[0].outline.mesh.file = given with points",
            with(MeshSetup { file: Some("a".into()), ..pinned.clone() }),
        ),
        ("solids[0].hold = pinned: only walls touch", with(block())),
        ("solids[0].outline.mesh.pinned = given", SolidSetup { hold: Hold::Free, ..with(pinned.clone()) }),
        (
            "solids[0].mesh-spacing = given: the mesh is given",
            SolidSetup { mesh_spacing: Some(0.1), ..with(pinned.clone()) },
        ),
        ("solids[0].outline.mesh.scale = -1", with(MeshSetup { scale: -1.0, ..pinned.clone() })),
        ("factors[0].factor = 0", with(MeshSetup { factors: factor("right", 0.0), ..pinned.clone() })),
        (
            "has no group \"left\": the groups of triangles are: \"right\"",
            with(MeshSetup { factors: factor("left", 2.0), ..pinned.clone() }),
        ),
        (
            "has no group \"top\": the groups of lines are: \"base\"",
            with(MeshSetup { pinned: vec!["top".into()], ..block() }),
        ),
    ] {
        let error = scene(solid).build().unwrap_err().to_string();
        assert!(error.contains(said) && error.starts_with("solids[0]"), "{error}");
    }
}

#[cfg(feature = "toml")]
#[test]
fn scenes_with_meshes_and_outlines_are_read_back() {
    let mut setup =
        scene(SolidSetup::new(SolidOutline::Mesh(MeshSetup { pinned: vec!["base".into()], ..block() }), MATERIAL));
    let outline = crate::setup::OutlineSetup {
        origin: Some(crate::setup::OutlineOrigin::Point([1.0, 2.0])),
        smooth: Some(0.01),
        ..crate::setup::OutlineSetup::of_points(vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    };
    setup.droplets[0].shape = crate::setup::DropletShape::Outline(outline);
    assert_eq!(Setup::from_toml(&setup.to_toml().unwrap()).unwrap(), setup);
}
