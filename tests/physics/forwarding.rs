//! Traits that are implemented for boxes by hand forward every method: a method with a default that was forgotten would
//! silently fall back to it.

use std::{collections::BTreeSet, fs, path::Path};

/// File, head of the trait, and head of the implementation for boxes.
const TRAITS: [(&str, &str, &str); 3] = [
    (
        "crates/motile-scene/src/hydrodynamics.rs",
        "pub trait Hydrodynamics:",
        "impl<H: Hydrodynamics + ?Sized> Hydrodynamics for Box<H> {",
    ),
    (
        "crates/stokes-grid/src/solver.rs",
        "pub trait StokesSolver:",
        "impl<S: StokesSolver + ?Sized> StokesSolver for Box<S> {",
    ),
    (
        "crates/active-interface/src/tension.rs",
        "pub trait Tension:",
        "impl<T: Tension + ?Sized> Tension for $pointer<T> {",
    ),
];

/// Returns the lines of a block, from its head to the brace that closes it at the indentation of the head.
fn block<'a>(text: &'a str, head: &str) -> Vec<&'a str> {
    let mut lines = text.lines().skip_while(|line| !line.trim_start().starts_with(head));
    let first = lines.next().unwrap_or_else(|| panic!("no {head}"));
    let indent = first.len() - first.trim_start().len();
    lines.take_while(|line| line.trim().is_empty() || *line != format!("{}}}", " ".repeat(indent))).collect()
}

/// Returns the methods of a block, each with its number.
fn methods<'a>(lines: &[&'a str]) -> BTreeSet<&'a str> {
    let name = |line: &&'a str| line.trim_start().strip_prefix("fn ")?.split(['(', '<']).next();
    lines.iter().filter_map(name).collect()
}

#[test]
fn boxes_forward_every_method() {
    for (file, head, implementation) in TRAITS {
        let text = fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(file)).expect("a source");
        let wanted = methods(&block(&text, head));
        let forwarded = block(&text, implementation);
        assert!(wanted.len() > 3, "{head}: {wanted:?}");
        assert_eq!(wanted, methods(&forwarded), "{head}");
        // Each one calls the method of the same name, as the macro has it.
        let body = forwarded.join("\n");
        let by_macro = body.contains("motile_base::forwarded! {");
        for method in wanted {
            assert!(by_macro && !body.contains(").") || body.contains(&format!(").{method}(")), "{head} {method}");
        }
    }
}
