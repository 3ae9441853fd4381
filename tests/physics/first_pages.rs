//! The first pages of the four crates show the programs of `tests/alone`.
//!
//! If you change a program, run this test with `UPDATE=1` to write the program into the page.

use std::{env, fs, path::Path};

const CRATES: [&str; 4] = ["stokes-grid", "ib-core", "active-interface", "elastic-solids"];

/// Returns the first program of a page, as lines of documentation, and the page around it. Blocks of text are no
/// programs.
fn example(page: &str) -> (&str, &str, &str) {
    let fence = "//! ```";
    let mut fences = page.match_indices(fence).map(|(at, _)| at);
    while let (Some(start), Some(end)) = (fences.next(), fences.next()) {
        let first = start + fence.len() + 1;
        if page[start + fence.len()..].starts_with('\n') {
            return (&page[..first], &page[first..end], &page[end..]);
        }
    }
    panic!("no program on the page")
}

/// Returns a program without its head comment, as lines of documentation.
fn documented(program: &str) -> String {
    let (_, code) = program.split_once("\n\n").expect("a head comment and a program");
    code.lines().map(|line| format!("//! {line}").trim_end().to_owned() + "\n").collect()
}

#[test]
fn first_pages_show_the_programs_that_stand_alone() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the workspace");
    for name in CRATES {
        let program = fs::read_to_string(root.join("tests/alone").join(name).join("src/main.rs")).expect("a program");
        let path = root.join("crates").join(name).join("src/lib.rs");
        let page = fs::read_to_string(&path).expect("a page");
        let (before, shown, after) = example(&page);
        let program = documented(&program);
        if env::var_os("UPDATE").is_some() && shown != program {
            fs::write(&path, [before, &program, after].concat()).expect("the page is written");
        } else {
            assert!(shown == program, "the first page of {name} shows another program than tests/alone/{name}");
        }
        let code = program.lines().map(|line| line.strip_prefix("//! ").unwrap_or_default().to_owned() + "\n");
        let readme = fs::read_to_string(root.join("crates").join(name).join("README.md")).expect("a page");
        if let Some((_, after)) = readme.split_once("```rust\n") {
            let shown = after.split_once("```").map_or(after, |(shown, _)| shown);
            assert!(shown == code.collect::<String>(), "the README of {name} shows another program");
        } else {
            assert!(!["stokes-grid", "ib-core"].contains(&name), "the README of {name} shows no program");
        }
    }
}
