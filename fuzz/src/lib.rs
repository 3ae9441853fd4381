//! Targets of fuzzing: the readers of checkpoints, of Gmsh files and of command lines. Each function takes any bytes
//! and must neither panic nor run out of memory or time.

use active_interface::{ActiveDroplet, ContractileTension, Curve, InitialConcentration};
use clap::Parser;
use elastic_solids::mesh::{GmshMesh, equilateral_block};
use ib_core::{BSpline, ImmersedBoundary};
use motile::setup::{IntegralMethod, Method, Setup};
use motile_cli::keys::{SceneFlags, set, setup_of, table_of};
use motile_cli::run::OutputFlags;
use motile_scene::{Scene, checkpoint::Checkpoint};
use stokes_grid::{Grid, PeriodicStokes};

type Small = Scene<ImmersedBoundary<PeriodicStokes, BSpline<4>>>;

/// A scene that checkpoints are resumed in.
///
/// # Panics
/// Never: its numbers are good ones.
#[must_use]
pub fn scene() -> Small {
    let make = || -> Result<Small, Box<dyn std::error::Error>> {
        let solver = PeriodicStokes::new(Grid::periodic(16, 16, 0.25)?, 10.0)?;
        let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
        let markers = Curve::circle(1.0)?.markers(32)?;
        let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
        let tension = ContractileTension::thesis(10.0, -2.0, 10.0, 100.0)?;
        scene.add(ActiveDroplet::new(&markers, numbers, tension, 0.1)?);
        Ok(scene)
    };
    make().expect("a scene of good numbers")
}

/// Reads a checkpoint, as a whole file and as contents whose checksum is right, and goes on from it where a scene takes
/// it.
pub fn checkpoint(bytes: &[u8]) {
    let file = Checkpoint::from_bytes(bytes);
    let contents = Checkpoint::from_contents(bytes);
    for checkpoint in [file, contents].into_iter().flatten() {
        // What is read is written as it was.
        let again = checkpoint.to_bytes().expect("a checkpoint has bytes");
        let twice = Checkpoint::from_bytes(&again).expect("what was written can be read");
        assert_eq!(twice.to_bytes().expect("a checkpoint has bytes"), again);
        let mut scene = scene();
        let before = scene.checkpoint("");
        if scene.resume(&checkpoint).is_err() {
            assert!(scene.checkpoint("") == before, "a refused checkpoint leaves the scene as it was");
        } else {
            let _ = scene.step(1e-3);
        }
    }
}

/// Reads a Gmsh file, plain and periodic; what is a mesh is written and read again.
pub fn gmsh(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let _ = GmshMesh::from_periodic_text(text, 2.0);
    if let Ok(mesh) = GmshMesh::from_text(text) {
        let Ok(written) = mesh.to_text() else { return };
        let again = GmshMesh::from_text(&written).expect("what was written can be read");
        assert_eq!(again.mesh.triangles().len(), mesh.mesh.triangles().len());
    }
}

/// All flags of a run.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags,
    #[command(flatten)]
    output: OutputFlags,
}

/// Parses a command line of `motile run`, one flag or value a line or between spaces, sets its keys in a scene of one
/// droplet, and makes the droplet where that is cheap.
pub fn flags(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let words = std::iter::once("motile").chain(text.split_whitespace());
    let Ok(Flags { scene, output }) = Flags::try_parse_from(words) else { return };
    let _ = output.check(&scene.name(), Some(&scene.file));
    let mut table = table_of("[[droplets]]\n").expect("a scene");
    for (key, value) in scene.set {
        if set(&mut table, &key, value).is_err() {
            return;
        }
    }
    let Ok(setup) = setup_of(table) else { return };
    if let (Method::Integral(IntegralMethod { elements: 0..=4096, .. }), Some(droplet)) =
        (&setup.method, setup.droplets.first())
    {
        let _ = setup.droplet(droplet);
    }
}

/// Reads a scene file; what is read is written and read again as it was, and its droplets are made where that is cheap.
pub fn scene_file(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    let Ok(setup) = Setup::from_toml(text) else { return };
    let again = setup.to_toml().expect("a description that was read can be written");
    assert_eq!(Setup::from_toml(&again).expect("what was written can be read"), setup);
    if matches!(setup.method, Method::Integral(IntegralMethod { elements: 0..=4096, .. })) {
        for droplet in &setup.droplets {
            let _ = setup.droplet(droplet);
        }
    }
}

/// Inputs to start from: valid ones.
#[must_use]
pub fn corpus(target: &str) -> Vec<Vec<u8>> {
    match target {
        "checkpoint" => {
            let mut scene = scene();
            let fresh = scene.checkpoint("fresh").to_bytes();
            let stepped = scene.step(0.01).ok().map(|()| scene.checkpoint("stepped").to_bytes());
            let files: Vec<Vec<u8>> = [Some(fresh), stepped].into_iter().flatten().flatten().collect();
            let contents = files.iter().map(|file| file[24..].to_vec());
            files.clone().into_iter().chain(contents).collect()
        }
        "gmsh" => {
            let strip = |columns, rows| equilateral_block(motile_base::Vec2::ZERO, columns, rows, 0.5);
            let meshes = [strip(2, 2), strip(4, 3)].into_iter().flatten();
            let texts = meshes.flat_map(|mesh| GmshMesh { mesh, groups: Vec::new() }.to_text());
            texts.map(String::into_bytes).collect()
        }
        "scene" => [Setup::default(), Setup::thesis()]
            .into_iter()
            .filter_map(|setup| setup.to_toml().ok())
            .map(String::into_bytes)
            .collect(),
        _ => [
            "scene.toml --set droplets.0.particles.activity=-4 --set viscosity=10 --set method.grid.spacing=0.1",
            "scene.toml --set region.channel={length=8,width=2} --set step.fixed=0.01 --no-pictures --out somewhere",
            "scene.toml --set=droplets.0.centre=[-0.03,0.01] --checkpoint file --checkpoint-every 10 --resume other",
            "scene.toml --set method.integral.nodes=64 --set droplets.0.viscosity=1e3 --set droplets.1.centre=[3,0]",
        ]
        .map(|line| line.as_bytes().to_vec())
        .to_vec(),
    }
}
