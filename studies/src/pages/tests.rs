use super::*;

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
