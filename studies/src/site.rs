//! The site that `mdbook build docs` makes: what it does to pages, and checks that need no mdBook.
//!
//! mdBook runs `studies -- site` between reading and rendering the pages (`docs/book.toml`): formulas in `math` blocks
//! become MathML, which browsers show without scripts and fonts of its own, `README.md` becomes the first page, and
//! links to files of the repository that are no part of the site become their names.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io::{Read, stdin};
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile_cli::run::say;
use pulldown_latex::config::{DisplayMode, RenderConfig};
use pulldown_latex::{Parser, Storage, push_mathml};
use serde_json::Value;

use crate::tables::{pages_of, root};

/// Turns the pages that mdBook gives on standard input into those that it renders.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// `supports RENDERER`, as mdBook asks first
    question: Vec<String>,
}

/// The page that shows README.md, and the list of pages.
const FRONT: &str = "index.md";
const SUMMARY: &str = "SUMMARY.md";
const BEGIN: &str = "```math\n";
const END: &str = "```\n";

pub(crate) fn run(flags: &Flags) -> Result<()> {
    if !flags.question.is_empty() {
        return Ok(());
    }
    let mut text = String::new();
    stdin().read_to_string(&mut text)?;
    let mut given: Value = serde_json::from_str(&text)?;
    let book = given.get_mut(1).context("mdBook gives a context and a book")?;
    turn(book)?;
    say(book);
    Ok(())
}

/// Turns every chapter in a value and below it.
fn turn(value: &mut Value) -> Result<()> {
    match value {
        Value::Object(map) => {
            let path = map.get("path").and_then(Value::as_str).map(str::to_owned);
            if let (Some(path), Some(content)) = (path, map.get("content").and_then(Value::as_str)) {
                let page = if path == FRONT { front()? } else { content.to_owned() };
                let turned = typeset(&page).with_context(|| path.clone())?;
                map.insert("content".to_owned(), within(&turned, Path::new(&path)).into());
            }
            map.values_mut().try_for_each(turn)
        }
        Value::Array(list) => list.iter_mut().try_for_each(turn),
        _ => Ok(()),
    }
}

/// README.md as a page of docs.
fn front() -> Result<String> {
    Ok(from_docs(&fs::read_to_string(root().join("README.md"))?))
}

/// A page of the repository's root with its links as they are from docs.
fn from_docs(page: &str) -> String {
    let up = page.replace("](", "](../");
    [("../docs/", ""), ("../#", "#"), ("../http", "http")]
        .iter()
        .fold(up, |page, (from, to)| page.replace(&format!("]({from}"), &format!("]({to}")))
}

/// A page with its formulas as MathML.
fn typeset(page: &str) -> Result<String> {
    let mut out = String::new();
    let mut rest = page;
    while let Some(start) = rest.find(BEGIN) {
        out += &rest[..start];
        let formula = &rest[start + BEGIN.len()..];
        let end = formula.find(END).with_context(|| format!("no end of the formula: {formula:.60}"))?;
        out += &formula_as_mathml(formula[..end].trim())?;
        out.push('\n');
        rest = &formula[end + END.len()..];
    }
    Ok(out + rest)
}

fn formula_as_mathml(formula: &str) -> Result<String> {
    let storage = Storage::new();
    let events = Parser::new(formula, &storage).collect::<Result<Vec<_>, _>>();
    let events = events.map_err(|error| anyhow::anyhow!("formula {formula}: {error}"))?;
    let mut out = String::new();
    let config = RenderConfig { display_mode: DisplayMode::Block, ..RenderConfig::default() };
    push_mathml(&mut out, events.into_iter().map(Ok::<_, std::io::Error>), config)?;
    // A space in upright text (`\ `) would be shown as the name of its character.
    ensure!(
        !out.contains("&amp;nbsp;"),
        "formula {formula}: write words as `\\text{{...}}`, and `\\quad` between them"
    );
    // An empty line would end the block.
    Ok(out.replace('\n', " "))
}

/// A page at `path` without links to what is outside of docs.
fn within(page: &str, path: &Path) -> String {
    let mut out = String::new();
    let mut rest = page;
    while let Some(middle) = rest.find("](") {
        let target = &rest[middle + 2..];
        let Some(end) = target.find(')') else { break };
        let (place, after) = (&target[..end], &target[end + 1..]);
        let outside = !place.contains("://") && (below(path, place).is_none() || lists(path, place));
        match rest[..middle].rfind('[').filter(|_| outside) {
            Some(start) if place.split('#').next().is_some_and(|file| file.ends_with("../README.md")) => {
                out += &rest[..start];
                let up = "../".repeat(path.components().count() - 1);
                let anchor = place.split_once('#').map(|(_, anchor)| format!("#{anchor}")).unwrap_or_default();
                out += &format!("{}]({up}{FRONT}{anchor})", &rest[start..middle]);
            }
            Some(start) => {
                out += &rest[..start];
                out += &rest[start + 1..middle];
            }
            // mdBook makes the index of a folder of its README.md.
            None => out += &format!("{}{})", &rest[..middle + 2], place.replace("README.md", FRONT)),
        }
        rest = after;
    }
    out + rest
}

/// The file that a link on the page at `path` leads to, if it is below the folder that paths begin in.
fn below(path: &Path, link: &str) -> Option<PathBuf> {
    let file = link.split('#').next().unwrap_or(link);
    let base = if file.is_empty() { path.to_owned() } else { path.parent()?.join(file) };
    let mut found = PathBuf::new();
    for part in base.components() {
        match part {
            Component::ParentDir if !found.pop() => return None,
            Component::Normal(name) => found.push(name),
            _ => {}
        }
    }
    Some(found)
}

/// A link that leads to no page and no file of the site: to the list of pages, which the site has as its menu, or to a
/// folder, which a Git host lists.
fn lists(path: &Path, link: &str) -> bool {
    let file = link.split('#').next().unwrap_or(link);
    let folder = || below(path, file).is_some_and(|found| root().join("docs").join(found).is_dir());
    file.ends_with(SUMMARY) || (!file.is_empty() && folder())
}

/// Checks that every page is in SUMMARY.md, that tutorials, explanations and evidence have a picture, that links lead
/// somewhere and that formulas can be typeset.
///
/// # Errors
/// All that is wrong, a line each.
pub(crate) fn check() -> Result<()> {
    let mut pages: BTreeMap<PathBuf, String> = BTreeMap::new();
    let beside = ["CHANGELOG.md", "CONTRIBUTING.md"].map(|name| root().join(name));
    for path in pages_of()?.into_iter().chain(beside) {
        pages.insert(path.strip_prefix(root())?.to_owned(), fs::read_to_string(&path)?);
    }
    let wrong = faults(&pages, &|path| root().join(path).exists())?;
    ensure!(wrong.is_empty(), "{}", wrong.join("\n"));
    Ok(())
}

/// Folders whose pages need no picture: instructions and lists.
const WITHOUT_PICTURES: [&str; 2] = ["docs/how-to", "docs/reference"];

/// Faults of pages by their paths, and of links to files for which `exists` is false.
fn faults(pages: &BTreeMap<PathBuf, String>, exists: &dyn Fn(&Path) -> bool) -> Result<Vec<String>> {
    let mut wrong = Vec::new();
    let summary = pages.get(Path::new("docs").join(SUMMARY).as_path()).context("docs/SUMMARY.md is missing")?;
    let listed: BTreeSet<PathBuf> = links(summary).filter_map(|link| below(Path::new("docs/x"), link)).collect();
    for (path, page) in pages {
        let inside = path.starts_with("docs") && !path.ends_with(SUMMARY);
        if inside && !listed.contains(path) {
            wrong.push(format!("{} is not in docs/{SUMMARY}", path.display()));
        }
        let plain = path.ends_with(FRONT) || WITHOUT_PICTURES.iter().any(|folder| path.starts_with(folder));
        if inside && !plain && !page.contains("![") {
            wrong.push(format!("{} has no picture", path.display()));
        }
        if let Err(error) = typeset(page) {
            wrong.push(format!("{}: {error:#}", path.display()));
        }
        for link in links(page).filter(|link| !link.contains("://")) {
            let Some(target) = below(path, link) else {
                wrong.push(format!("{}: {link} leaves the repository", path.display()));
                continue;
            };
            let anchor = link.split_once('#').map(|(_, anchor)| anchor);
            let found = match (pages.get(&target), anchor) {
                (Some(page), Some(anchor)) => anchors(page).any(|one| one == anchor),
                (Some(_), None) => true,
                (None, _) => exists(&target),
            };
            if !found {
                wrong.push(format!("{}: {link} leads nowhere", path.display()));
            }
        }
    }
    Ok(wrong)
}

/// Lines of a page that are no code.
fn prose(page: &str) -> impl Iterator<Item = &str> {
    let mut code = false;
    page.lines().filter(move |line| {
        let fence = line.starts_with("```");
        code ^= fence;
        !code && !fence
    })
}

fn links(page: &str) -> impl Iterator<Item = &str> {
    prose(page).flat_map(|line| line.split("](").skip(1).filter_map(|rest| Some(rest.split_once(')')?.0)))
}

/// Anchors of the headings of a page, as GitHub and mdBook make them.
fn anchors(page: &str) -> impl Iterator<Item = String> {
    let named = prose(page).filter_map(|line| line.strip_prefix("<a id=\"")?.strip_suffix("\"></a>"));
    let headings = prose(page).filter(|line| line.starts_with('#'));
    let headings = headings.map(|line| {
        let title = line.trim_start_matches('#').trim().to_lowercase();
        let kept = title.chars().filter(|c| c.is_alphanumeric() || [' ', '-', '_'].contains(c));
        kept.map(|c| if c == ' ' { '-' } else { c }).collect::<String>()
    });
    named.map(str::to_owned).chain(headings)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn formulas_become_mathml() {
        let page = typeset("a\n\n```math\n\\frac{1}{2} \\eta\n```\n\nb\n").expect("a formula");
        assert!(page.contains("<mfrac>") && page.contains("η") && !page.contains("```"), "{page}");
        assert!(typeset("```math\n\\frac{1\n```\n").is_err());
        assert!(typeset("```math\n\\mathrm{a\\ b}\n```\n").is_err());
        assert!(typeset("```math\n\\text{a b} \\quad c\n```\n").is_ok());
    }

    #[test]
    fn links_stay_on_the_site() {
        let turned = |page: &str| within(page, Path::new("book/a.md"));
        assert_eq!(
            turned("[x](../explanation/model.md#a) [y](https://z)"),
            "[x](../explanation/model.md#a) [y](https://z)"
        );
        assert_eq!(turned("see [x](../../crates/y.toml)."), "see x.");
        assert_eq!(turned("[x](../../README.md#z)"), "[x](../index.md#z)");
        assert_eq!(turned("[x](README.md) ![p](a.svg)"), "[x](index.md) ![p](a.svg)");
        let deep = |page: &str| within(page, Path::new("evidence/results/a.md"));
        assert_eq!(deep("[x](../accuracy.md) [y](../../../README.md)"), "[x](../accuracy.md) [y](../../index.md)");
        assert_eq!(deep("[x](../../book/README.md#a) [y](../../../crates/z)"), "[x](../../book/index.md#a) y");
        let front = |page: &str| within(&from_docs(page), Path::new(FRONT));
        assert_eq!(front("[a](docs/a.md#b) [c](CHANGELOG.md) [d](#e)"), "[a](a.md#b) c [d](#e)");
        assert_eq!(front("[a](docs/book/README.md) [c](https://x)"), "[a](book/index.md) [c](https://x)");
        // The list of pages and folders are for a Git host.
        assert_eq!(front("[a](docs/SUMMARY.md) [b](docs/tables)"), "a b");
    }

    #[test]
    fn faults_of_pages_are_found() {
        let of = |pages: &[(&str, &str)]| {
            let pages = pages.iter().map(|(path, page)| (PathBuf::from(path), (*page).to_owned())).collect();
            faults(&pages, &|path| path == Path::new("docs/images/a.svg")).expect("a summary")
        };
        let summary = ("docs/SUMMARY.md", "[a](evidence/results/a.md) [b](how-to/b.md)");
        let a = "# A b\n![](../../images/a.svg) [b](../../how-to/b.md#c-d)";
        let b = "## C d\n[a](../evidence/results/a.md#a-b)";
        assert_eq!(of(&[summary, ("docs/evidence/results/a.md", a), ("docs/how-to/b.md", b)]), [""; 0]);
        let wrong = of(&[summary, ("docs/evidence/results/a.md", "[b](../b.md)\n"), ("docs/how-to/c.md", "")]);
        let expected = [
            "docs/SUMMARY.md: how-to/b.md leads nowhere",
            "docs/evidence/results/a.md has no picture",
            "docs/evidence/results/a.md: ../b.md leads nowhere",
            "docs/how-to/c.md is not in docs/SUMMARY.md",
        ];
        assert_eq!(wrong, expected);
        let wrong = of(&[summary, ("docs/evidence/results/a.md", a), ("docs/how-to/b.md", "[x](../../../y)\n")]);
        let expected = [
            "docs/evidence/results/a.md: ../../how-to/b.md#c-d leads nowhere",
            "docs/how-to/b.md: ../../../y leaves the repository",
        ];
        assert_eq!(wrong, expected);
    }

    #[test]
    fn the_pages_of_the_repository_are_a_site() {
        check().expect("pages");
    }
}
