//! What each of the four crates builds: the number of packages behind it, and packages that it does without.

use std::{collections::BTreeSet, path::Path, process::Command};

/// Crate, number of packages that `cargo tree` lists for it (its own included), and packages that are not among them.
const CRATES: [(&str, usize, &[&str]); 4] = [
    ("stokes-grid", 28, &["nalgebra", "motile-scene"]),
    ("ib-core", 33, &["nalgebra", "stokes-boundary-integrals"]),
    ("active-interface", 32, &["nalgebra", "stokes-grid", "stokes-boundary-integrals"]),
    ("elastic-solids", 43, &["nalgebra", "stokes-grid", "stokes-boundary-integrals"]),
];

/// Returns the names of the packages that a crate of the workspace builds.
fn packages(name: &str) -> BTreeSet<String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let flags = ["tree", "--offline", "--package", name, "--edges", "normal", "--prefix", "none", "--no-dedupe"];
    let target = ["--target", "x86_64-unknown-linux-gnu"];
    let output = Command::new(env!("CARGO")).args(flags).args(target).current_dir(root).output().expect("cargo runs");
    let errors = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "cargo tree failed: {errors}");
    let lines = String::from_utf8(output.stdout).expect("text");
    lines.lines().filter_map(|line| line.split(' ').next()).map(str::to_owned).collect()
}

#[test]
fn each_crate_builds_no_more_than_it_uses() {
    for (name, count, without) in CRATES {
        let found = packages(name);
        assert_eq!(found.len(), count, "{name} builds {found:?}");
        for package in without {
            assert!(!found.contains(*package), "{name} builds {package}");
        }
    }
}

/// Packages ship the texts of the licences, not links to them.
#[test]
fn each_crate_ships_the_licences() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    let font = std::fs::read(root.join("crates/motile-output/fonts/OFL.txt")).expect("the licence of the font");
    assert!(std::fs::read(root.join("bindings/python/LICENSE-OFL")).is_ok_and(|found| found == font));
    for name in ["LICENSE-APACHE", "LICENSE-MIT"] {
        let text = std::fs::read(root.join(name)).expect("a licence");
        assert!(text.len() > 1000, "{name}");
        let crates = std::fs::read_dir(root.join("crates")).expect("the crates");
        let crates = crates.map(|folder| folder.expect("a crate").path());
        for folder in crates.chain([root.join("bindings/python")]) {
            let path = folder.join(name);
            assert!(std::fs::read(&path).is_ok_and(|found| found == text), "{} differs", path.display());
        }
    }
}

/// What the user's design card names, see CONTRIBUTING.md.
#[test]
fn the_workspace_has_what_the_design_card_names() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    for name in ["Cargo.toml", "crates", "examples", "tests", "benches", "docs", "LICENSE"] {
        assert!(root.join(name).exists(), "no {name} at the top level");
    }
    let manifest = std::fs::read_to_string(root.join("Cargo.toml")).expect("a manifest");
    for name in ["nalgebra", "rustfft", "realfft", "num-complex", "approx", "proptest", "criterion"] {
        assert!(manifest.lines().any(|line| line.starts_with(&format!("{name} = "))), "no dependency {name}");
    }
    // The names compile, so that they exist.
    let grid = motile::stokes_grid::Grid::periodic(8, 8, 0.1).expect("a grid");
    let projection = motile::stokes_grid::ProjectionStokes::new(grid, 1.0).expect("a solver");
    let _: &dyn motile::stokes_grid::StokesSolver = &projection;
    let _ = (motile::stokes_grid::SineTransform::new(8), motile::stokes_grid::CosineTransform::new(8));
    let _ = motile::ib_core::Transfer::new(grid, motile::ib_core::Peskin4);
    let _ = motile::active_interface::ExcludedVolume::Step(10.0);
    let _ = motile::elastic_solids::NeoHookean::new(1.0, 2.0);
}
