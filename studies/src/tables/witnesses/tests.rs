use motile_tests::validation::Table;

use super::super::rows::{self, Measure, Once};
use super::{Kept, WitnessFlags, choose, close, pieces, same, witnesses};

#[test]
fn cells_are_the_same_up_to_one_in_the_last_digit() {
    for (a, b) in
        [("0.123", "0.123"), ("0.123", "0.124"), ("1.2e-5", "1.3e-5"), ("3.1e-15", "8e-13"), ("-0.50", "-0.49")]
    {
        assert!(same(a, b), "{a} {b}");
    }
    for (a, b) in [("0.123", "0.125"), ("1.2e-5", "1.4e-5"), ("41", "42"), ("0.12", "-0.12"), ("yes", "no"), ("", "1")]
    {
        assert!(!same(a, b), "{a} {b}");
    }
    assert!(same("0.12 / 0.034 (fold)", "0.12 / 0.035 (fold)"));
    assert!(!same("0.12 / 0.034 (fold)", "0.12 / 0.034 (Hopf)"));
    assert!(!same("0.12 / 0.034", "0.12"));
    assert_eq!(pieces("1.2e-5, then"), ["1.2e-5", ", then"]);
    assert!(!close("1.0", "NaN"));
}

fn table(shift: f64, asked: &mut Vec<String>) -> Table {
    let mut table = Table::new("Squares", "kind | x | square | seconds");
    let shared = Once::new();
    for x in [1.0, 2.0, 3.0] {
        let row = || {
            asked.push(x.to_string());
            let shift = shared.get(|| Ok(shift))?;
            Ok(format!("{:.2} | {}", x * x + shift, x))
        };
        table.measure(format_args!("plain | {x}"), row).unwrap();
    }
    table
}

fn kept(witnesses: &[&str]) -> Kept {
    let rows = [["plain", "1", "1.00", "9"], ["plain", "2", "4.00", "9"], ["plain", "3", "9.00", "9"]];
    Kept {
        path: "squares.csv".into(),
        command: Vec::new(),
        title: "Squares".to_owned(),
        header: ["kind", "x", "square", "seconds"].map(str::to_owned).to_vec(),
        rows: rows.map(|row| row.map(str::to_owned).to_vec()).to_vec(),
        witnesses: witnesses.iter().map(|&name| name.to_owned()).collect(),
    }
}

/// Only the witnesses are found, times are not compared, and another digit is an error.
#[test]
fn only_witnesses_are_found_and_compared() {
    let kept = kept(&["plain | 2"]);
    rows::want_only(vec![["Squares".to_owned(), "plain | 2".to_owned()]]);
    let mut asked = Vec::new();
    assert_eq!(kept.compare(&table(0.0, &mut asked)).unwrap(), 1);
    assert_eq!(asked, ["2"]);
    rows::want_only(vec![["Squares".to_owned(), "plain | 2".to_owned()]]);
    let text = format!("{:#}", kept.compare(&table(0.1, &mut asked)).unwrap_err());
    assert!(
        text.contains("row 'plain | 2', column 'square': the file shows 4.00, and the program finds 4.10"),
        "{text}"
    );
}

/// A study that was stopped goes on: rows in the file of this program are not found again.
#[test]
fn rows_are_kept_and_chosen() {
    let path = std::env::temp_dir().join(format!("motile-rows-{}", std::process::id()));
    let mut asked = Vec::new();
    rows::keep_in(&path).unwrap();
    let first = table(0.0, &mut asked);
    assert_eq!(asked, ["1", "2", "3"]);
    // As if the last line had been written by half.
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::write(&path, &text[..text.rfind('\t').unwrap()]).unwrap();
    rows::keep_in(&path).unwrap();
    assert_eq!(table(0.0, &mut asked), first);
    assert_eq!(asked, ["1", "2", "3", "3"]);
    assert_eq!(choose(&first).len(), 3);
    // Rows of another build are found again.
    std::fs::write(&path, text.replacen(&rows::program().unwrap(), "another", 1)).unwrap();
    rows::keep_in(&path).unwrap();
    table(0.0, &mut asked);
    assert_eq!(asked.len(), 7);
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn two_rows_of_a_name_are_an_error() {
    rows::want_only(vec![["Squares".to_owned(), "plain | 1".to_owned()]]);
    let mut table = table(0.0, &mut Vec::new());
    let again = table.measure("plain | 1", || Ok("1 | 1".to_owned()));
    assert!(again.unwrap_err().to_string().contains("two rows"));
}

/// Every witness is the name of one row of its file, and every file has a title of its own.
#[test]
fn witnesses_name_rows() {
    let all = Kept::all().unwrap();
    for kept in &all {
        for name in &kept.witnesses {
            let first = Table::cells(name);
            let rows = kept.rows.iter().filter(|row| row.starts_with(&first)).count();
            assert_eq!(rows, 1, "{}: {name}", kept.path.display());
        }
        let same = all.iter().filter(|other| other.title == kept.title).count();
        assert_eq!(same, 1, "{}: {}", kept.path.display(), kept.title);
    }
}

/// A few rows of every table and single runs of figures, computed again: half a minute, and not at the same time as
/// other tests.
#[test]
#[ignore = "takes half a minute; .ci/run runs it"]
fn tables_and_figures_are_current() {
    witnesses(&WitnessFlags { only: None, slow: false, choose: false }).unwrap();
}
