//! The scenes and commands of README.md and of the pages in the folders of docs, as a reader would use them.
//!
//! A block `toml scene` is a whole scene: it is built and takes ten steps. A block `toml` is added to the first scene
//! of its page, and its values replace those there. A block with `file=NAME` is saved first, and blocks `sh` run in
//! order in a new folder, with `motile` on the path.

use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::{env, fs, process::Command, thread};

/// Pages in the folders of a folder and below.
fn pages(folder: &Path) -> Vec<PathBuf> {
    let inside = |path: &Path| fs::read_dir(path).expect("a folder").map(|entry| entry.expect("an entry").path());
    let folders = inside(folder).filter(|path| path.is_dir());
    let of = |below: PathBuf| [inside(&below).filter(|path| path.is_file()).collect(), pages(&below)].concat();
    folders.flat_map(of).filter(|path| path.extension().is_some_and(|extension| extension == "md")).collect()
}

/// Fences and texts of the blocks of a page.
fn blocks(page: &str) -> Vec<(Vec<&str>, String)> {
    let (mut lines, mut found) = (page.lines(), Vec::new());
    while let Some(fence) = lines.by_ref().find_map(|line| line.strip_prefix("```")) {
        let text: Vec<&str> = lines.by_ref().take_while(|line| !line.starts_with("```")).collect();
        found.push((fence.split_whitespace().collect(), text.join("\n") + "\n"));
    }
    found
}

/// A scene with the entries of a fragment: lists grow, other values are replaced.
fn with(scene: &str, fragment: &str) -> Result<String, toml::de::Error> {
    let mut whole: toml::Table = toml::from_str(scene)?;
    for (key, value) in toml::from_str::<toml::Table>(fragment)? {
        match (whole.get_mut(&key), value) {
            (Some(toml::Value::Array(list)), toml::Value::Array(more)) => list.extend(more),
            (_, value) => drop(whole.insert(key, value)),
        }
    }
    Ok(whole.to_string())
}

/// Runs commands in the folder. If they fail, returns what they wrote.
fn shell(folder: &Path, commands: &str) -> Result<(), String> {
    let program = Path::new(env!("CARGO_BIN_EXE_motile")).parent().expect("a folder");
    let path = format!("{}:{}", program.display(), env::var("PATH").unwrap_or_default());
    let output = Command::new("sh").args(["-ec", commands]).current_dir(folder).env("PATH", path).output();
    let output = output.expect("a shell");
    let wrote = String::from_utf8_lossy(&output.stderr);
    if output.status.success() { Ok(()) } else { Err(format!("{commands}{wrote}")) }
}

/// Runs what is on a page in a new folder, and returns the number of blocks.
fn run(page: &str, folder: &Path) -> Result<usize, String> {
    fs::create_dir_all(folder).expect("a folder");
    let (blocks, mut first, mut count) = (blocks(page), None, 0);
    for (fence, text) in &blocks {
        if let Some(file) = fence.iter().find_map(|word| word.strip_prefix("file=")) {
            fs::write(folder.join(file), text).expect("a file");
        }
        let scene = match fence[..] {
            ["toml", "scene", ..] => text.clone(),
            ["toml"] => with(first.as_deref().unwrap_or(""), text).map_err(|error| format!("{text}{error}"))?,
            _ => continue,
        };
        fs::write(folder.join("block.toml"), &scene).expect("a file");
        shell(folder, "motile check block.toml\n").map_err(|error| format!("{text}{error}"))?;
        first.get_or_insert(scene);
        count += 1;
    }
    for (_, text) in blocks.iter().filter(|(fence, _)| fence[..] == ["sh"]) {
        shell(folder, text)?;
        count += 1;
    }
    Ok(count)
}

#[test]
fn scenes_and_commands_of_the_pages_run() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let left = Mutex::new([pages(&root.join("docs")), vec![root.join("README.md")]].concat());
    let place = env::temp_dir().join(format!("motile-pages-{}", std::process::id()));
    let work = || {
        let (mut count, mut wrong) = (0, Vec::new());
        while let Some(page) = { left.lock().expect("pages").pop() } {
            let folder = place.join(page.strip_prefix(&root).expect("a page").with_extension(""));
            match run(&fs::read_to_string(&page).expect("a page"), &folder) {
                Ok(blocks) => count += blocks,
                Err(error) => wrong.push(format!("{}: {error}", page.display())),
            }
        }
        (count, wrong)
    };
    let [one, other] =
        thread::scope(|scope| [scope.spawn(work), scope.spawn(work)].map(|work| work.join().expect("an end")));
    fs::remove_dir_all(&place).expect("the folder is removed");
    let wrong = [one.1, other.1].concat();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(one.0 + other.0 > 40, "only {} scenes and commands", one.0 + other.0);
}

/// Words of a text, joined by one blank, with one at each end.
fn words(text: &str) -> String {
    let words = text.split(|letter: char| !letter.is_alphabetic()).filter(|word| !word.is_empty());
    format!(" {} ", words.collect::<Vec<_>>().join(" "))
}

/// Text of the sources in a folder and below it, without comments.
fn sources(folder: &Path) -> String {
    let entries = fs::read_dir(folder).expect("a folder").map(|entry| entry.expect("an entry").path());
    let read = |path: PathBuf| match path.extension() {
        _ if path.is_dir() => sources(&path),
        Some(end) if end == "rs" => fs::read_to_string(&path).expect("a source"),
        _ => String::new(),
    };
    let text: String = entries.map(read).collect();
    text.lines().filter(|line| !line.trim_start().starts_with("//")).flat_map(|line| [line, "\n"]).collect()
}

/// A message under "If something goes wrong" opens a point as code. Its words, up to numbers and `...`, are in the
/// sources.
#[test]
fn messages_that_pages_quote_exist() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let (sources, mut count, mut wrong) = (words(&sources(&root.join("crates"))), 0, Vec::new());
    for page in pages(&root.join("docs")) {
        let text = fs::read_to_string(&page).expect("a page");
        let Some((_, below)) = text.split_once("\n## If something goes wrong\n") else { continue };
        let points = below.split("\n## ").next().unwrap_or(below).split("\n* `").skip(1);
        for message in points.filter_map(|point| point.split('`').next()) {
            let parts = message.replace("...", "0").replace('\n', " ");
            let mut parts = parts.split(|letter: char| letter.is_ascii_digit() || ":=,()[]\"".contains(letter));
            if !parts.all(|part| words(part).trim().is_empty() || sources.contains(&words(part))) {
                wrong.push(format!("{}: {message}", page.display()));
            }
            count += 1;
        }
    }
    assert!(wrong.is_empty(), "no source has these messages:\n{}", wrong.join("\n"));
    assert!(count > 25, "only {count} messages");
}
