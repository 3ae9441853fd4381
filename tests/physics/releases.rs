//! Releases rely on one version and one address for all packages, on features that are documented, on errors that can
//! grow, and on a file of public items for each crate.

use std::fs;
use std::path::{Path, PathBuf};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace")
}

fn read(path: &Path) -> String {
    fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// Folders of the crates, in the order of their names.
fn crates() -> Vec<PathBuf> {
    let folders = fs::read_dir(root().join("crates")).expect("the crates");
    let mut paths: Vec<_> = folders.map(|folder| folder.expect("a crate").path()).collect();
    paths.sort();
    paths
}

/// The first value of a key of a file, without quotes.
fn value(text: &str, key: &str) -> String {
    let found = text.lines().find_map(|line| line.strip_prefix(key)).unwrap_or_else(|| panic!("no `{key}`"));
    found.trim().trim_matches('"').to_owned()
}

#[test]
fn all_packages_have_one_version() {
    let manifest = read(&root().join("Cargo.toml"));
    let version = value(&manifest, "version =");
    for line in manifest.lines().filter(|line| line.contains("path = \"crates/")) {
        assert!(line.contains(&format!("version = \"{version}\"")), "{line}");
    }
    for (name, key) in [
        ("bindings/python/Cargo.toml", "version ="),
        ("bindings/web/Cargo.toml", "version ="),
        ("CITATION.cff", "version:"),
    ] {
        assert_eq!(value(&read(&root().join(name)), key), version, "{name}");
    }
    let changes = read(&root().join("CHANGELOG.md"));
    let newest = changes.lines().find(|line| line.starts_with("## [")).expect("a version");
    assert!(newest.contains(&format!("[{version}]")), "CHANGELOG.md: {newest}");
}

/// The address is filled in at one place, and every package says what a registry asks for.
#[test]
fn packages_take_what_they_share_from_the_workspace() {
    for path in crates() {
        let manifest = read(&path.join("Cargo.toml"));
        let name = path.display();
        for key in ["version", "edition", "authors", "repository", "homepage"] {
            assert!(manifest.contains(&format!("\n{key}.workspace = true")), "{name}: {key}");
        }
        let (_, keywords) = manifest.split_once("\nkeywords = [").unwrap_or_else(|| panic!("{name}: no keywords"));
        let keywords: Vec<_> = keywords.split(']').next().unwrap_or_default().split(", ").collect();
        assert!(keywords.len() <= 5, "{name}: a registry takes five keywords");
        assert!(keywords.iter().all(|word| word.trim_matches('"').len() <= 20), "{name}: {keywords:?}");
        assert!(manifest.contains("\nlicense"), "{name}: no licence");
        let description = value(&manifest, "description =");
        assert!((20..=160).contains(&description.len()), "{name}: {description}");
    }
}

/// The first page of a crate names each of its features.
#[test]
fn features_are_documented() {
    for path in crates() {
        let manifest = read(&path.join("Cargo.toml"));
        let Some((_, features)) = manifest.split_once("\n[features]\n") else { continue };
        let features = features.lines().take_while(|line| !line.starts_with('['));
        let names: Vec<_> = features.filter_map(|line| line.split_once(" = ").map(|(name, _)| name)).collect();
        let source = read(&path.join("src/lib.rs"));
        let page: Vec<_> = source.lines().take_while(|line| line.starts_with("//!")).collect();
        for name in names.iter().filter(|name| **name != "default") {
            let word = format!("`{name}`");
            assert!(
                page.iter().any(|line| line.contains(&word)),
                "{}: {word} is not on the first page",
                path.display()
            );
        }
    }
}

/// Rust files below a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    entries
        .flat_map(|path| match path {
            path if path.is_dir() => sources(&path),
            path if path.extension().is_some_and(|extension| extension == "rs") => vec![path],
            _ => Vec::new(),
        })
        .collect()
}

/// Errors grow, so programs cannot match all of their variants.
#[test]
fn errors_can_grow() {
    let mut count = 0;
    for path in crates().iter().flat_map(|path| sources(&path.join("src"))) {
        let text = read(&path);
        for (at, _) in text.match_indices("\npub enum ") {
            let name = text[at + 10..].split([' ', '<']).next().unwrap_or_default();
            if !name.ends_with("Error") {
                continue;
            }
            let attributes = text[..at].rsplit("\n\n").next().unwrap_or_default();
            assert!(attributes.contains("#[non_exhaustive]"), "{}: {name} is exhaustive", path.display());
            count += 1;
        }
    }
    assert!(count >= 17, "{count} enums of errors");
}

/// `.ci/api` compares these files with what the crates have.
#[test]
fn each_crate_has_a_file_of_its_public_items() {
    for path in crates() {
        let name = path.file_name().expect("a name").to_string_lossy().into_owned();
        let items = read(&root().join("tests/api").join(format!("{name}.txt")));
        let first = format!("pub mod {}", name.replace('-', "_"));
        assert_eq!(items.lines().next(), Some(first.as_str()), "tests/api/{name}.txt");
    }
    for file in fs::read_dir(root().join("tests/api")).expect("the files of public items") {
        let path = file.expect("a file").path();
        let name = path.file_stem().expect("a name");
        assert!(root().join("crates").join(name).is_dir(), "{} is left over", path.display());
    }
}
