use super::*;

use std::path::Path;

use crate::tables::root;

const FILE: &str = "# a command\n# commit: 0\nh,kind,\"error, %\"\n0.1,a,3\n0.2,a,5\n0.1,b,7\n";

fn of(page: &str) -> Result<String> {
    filled(page, &|name| {
        ensure!(name == "errors", "no file {name}");
        Ok(FILE.to_owned())
    })
}

#[test]
fn a_page_shows_rows_and_columns_of_a_file() {
    let page = "Text\n<!-- table errors | columns: h as spacing, kind |\n where: h = 0.1 or\n 0.3; kind = b -->\nold\n\
                <!-- end of table -->\nMore\n";
    let expected = page.replace("old\n", "| spacing | kind |\n|---|---|\n| 0.1 | b |\n");
    assert_eq!(of(page).unwrap(), expected);
    // Filled again it stays.
    assert_eq!(of(&expected).unwrap(), expected);
    let whole = of("<!-- table errors -->\n<!-- end of table -->\n").unwrap();
    assert!(whole.contains("| h | kind | error, % |\n|---|---|---|\n| 0.1 | a | 3 |\n| 0.2 | a | 5 |"), "{whole}");
}

#[test]
fn requests_that_show_nothing_are_refused() {
    for request in ["other", "errors | columns: x", "errors | where: h = 9", "errors | rows: 3", "errors | where: h"] {
        assert!(of(&format!("<!-- table {request} -->\n<!-- end of table -->\n")).is_err(), "{request}");
    }
    assert!(of("<!-- table errors -->\n| 1 |\n").is_err());
    assert!(of("<!-- table errors\n<!-- end of table -->").is_err() && of("<!-- table errors\n| 1 |\n").is_err());
}

#[test]
fn the_pages_show_what_the_files_have() {
    pages(&PagesFlags { check: true }).unwrap();
}

#[test]
fn a_page_shows_scenes() {
    let read = |name: &str| Ok(format!("text of {name}\n"));
    let page = "A\n<!-- scene one -->\nold\n<!-- end of scene -->\nB <!-- scene two -->\n<!-- end of scene -->";
    let expected = "A\n<!-- scene one -->\ntext of one\n<!-- end of scene -->\nB <!-- scene two -->\ntext of two\n\
                    <!-- end of scene -->";
    assert_eq!(with_scenes(page, &read).unwrap(), expected);
    assert_eq!(with_scenes(expected, &read).unwrap(), expected);
    assert!(with_scenes("<!-- scene one -->\n", &read).is_err() && with_scenes("<!-- scene one\n", &read).is_err());
}

/// Texts of the sources of all crates, without their tests.
fn sources() -> Vec<String> {
    let (mut found, mut folders) = (Vec::new(), vec![root().join("crates")]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") && !path.ends_with("tests.rs") {
                found.push(fs::read_to_string(path).unwrap());
            }
        }
    }
    found
}

fn page_of_errors() -> String {
    fs::read_to_string(Path::new(root()).join("docs/reference/errors.md")).unwrap()
}

#[test]
fn the_page_of_errors_has_every_error() {
    let (page, mut count) = (page_of_errors(), 0);
    for text in sources() {
        for (start, _) in text.match_indices("pub enum ") {
            let body = &text[start + "pub enum ".len()..];
            let (name, body) = body.split_once(" {\n").unwrap();
            if !name.ends_with("Error") {
                continue;
            }
            assert!(page.contains(&format!("`{name}`")), "{name}");
            for line in body.lines().take_while(|line| *line != "}") {
                let Some(variant) = line.strip_prefix("    ").filter(|line| line.starts_with(char::is_uppercase))
                else {
                    continue;
                };
                let variant = variant.split([' ', '(', ',']).next().unwrap();
                assert!(page.contains(&format!("`{variant}`")), "{name}::{variant}");
                count += 1;
            }
        }
    }
    assert!(count > 70, "{count}");
}

#[test]
fn the_page_of_errors_has_the_causes_of_warnings() {
    let (page, sources) = (page_of_errors(), sources());
    let (_, section) = page.split_once("\n## Warnings\n").unwrap();
    let rows = section.split("\n## ").next().unwrap().lines().filter_map(|line| line.strip_prefix("| `"));
    let causes: Vec<&str> = rows.map(|row| row.split('`').next().unwrap()).collect();
    assert!(causes.len() > 12, "{causes:?}");
    for cause in &causes {
        assert!(sources.iter().any(|text| text.contains(&format!("\"{cause}\""))), "no warning has the cause {cause}");
    }
    // Those of the runs that were made.
    for path in (0..2).map(|number| file("warnings", number)).filter(|path| path.exists()) {
        let table = fs::read_to_string(path).unwrap();
        let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(table.as_bytes());
        let column = table.headers().unwrap().iter().position(|name| name == "warned of").unwrap();
        for row in table.records() {
            for cause in row.unwrap()[column].split(", ").filter(|cause| !cause.is_empty()) {
                assert!(causes.contains(&cause), "{cause}");
            }
        }
    }
}
