//! Lists the pages that have programs in Rust, so that rustdoc runs the programs as tests.

use std::{env, fs, io, path::Path};

/// Pages in the folder and below it that have a block of Rust.
fn pages(folder: &Path, found: &mut Vec<String>) -> io::Result<()> {
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if path.is_dir() {
            pages(&path, found)?;
        } else if path.extension().is_some_and(|extension| extension == "md")
            && fs::read_to_string(&path)?.lines().any(|line| line.starts_with("```rust"))
        {
            found.push(path.display().to_string());
        }
    }
    Ok(())
}

fn main() -> io::Result<()> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..").canonicalize()?;
    let mut found = vec![root.join("README.md").display().to_string()];
    println!("cargo::rerun-if-changed={}", root.join("README.md").display());
    for entry in fs::read_dir(root.join("docs"))? {
        let folder = entry?.path();
        if folder.is_dir() {
            println!("cargo::rerun-if-changed={}", folder.display());
            pages(&folder, &mut found)?;
        }
    }
    found.sort();
    let page = |(k, path): (usize, &String)| format!("#[doc = include_str!({path:?})]\nstruct Page{k};\n");
    let list: String = found.iter().enumerate().map(page).collect();
    let out = env::var_os("OUT_DIR").ok_or(io::ErrorKind::NotFound)?;
    fs::write(Path::new(&out).join("pages.rs"), list)
}
