//! The paper: what it cites is in its bibliography, and its figures exist.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

fn keys(text: &str, before: &str) -> BTreeSet<String> {
    let key = |rest: &str| rest.chars().take_while(char::is_ascii_alphanumeric).collect::<String>();
    text.split(before).skip(1).map(key).filter(|key| !key.is_empty()).collect()
}

#[test]
fn what_the_paper_cites_is_there() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../paper");
    let [paper, bibliography] = ["paper.md", "paper.bib"].map(|name| fs::read_to_string(folder.join(name)).unwrap());
    let entries: Vec<&str> = bibliography.split("\n@").collect();
    let listed: BTreeSet<String> =
        entries.iter().filter_map(|entry| entry.split(['{', ',']).nth(1)).map(str::to_owned).collect();
    assert_eq!(keys(&paper, "@"), listed);
    // A thesis has no DOI; all else has.
    for entry in entries.iter().filter(|entry| !entry.trim_start_matches('@').starts_with("phdthesis")) {
        assert!(entry.contains("doi = {10."), "{entry}");
    }
    let figures: Vec<&str> = paper.split("](").skip(1).filter_map(|rest| rest.split(')').next()).collect();
    assert!(!figures.is_empty() && figures.iter().all(|path| folder.join(path).exists()), "{figures:?}");
    // What the journal asks for, in its words.
    for heading in ["Summary", "Statement of need", "State of the field", "Acknowledgements", "References"] {
        assert!(paper.contains(&format!("\n# {heading}\n")), "{heading}");
    }
    let words = paper.split_whitespace().count();
    assert!((750..1750).contains(&words), "{words} words");
}
