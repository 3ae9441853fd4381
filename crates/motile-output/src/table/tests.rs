use motile::prelude::*;

use super::*;

#[test]
fn rows_are_in_the_file_and_in_memory() {
    let path = std::env::temp_dir().join(format!("motile-table-{}.csv", std::process::id()));
    let mut table = CsvTable::create(&path, &["time", "speed"]).unwrap();
    table.push(&[0.0, f64::NAN]).unwrap();
    table.push(&[0.1, 0.138_600_000_000_1]).unwrap();
    assert!(table.push(&[1.0]).is_err());
    table.flush().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    std::fs::remove_file(&path).unwrap();
    assert_eq!(text, "time,speed\n0,\n0.1,0.1386000000001\n");
    assert_eq!(table.rows()[1], [0.1, 0.138_600_000_000_1]);
    assert_eq!(table.curve("time", "speed").unwrap()[1], (0.1, 0.138_600_000_000_1));
    assert!(table.curve("time", "sped").is_err());
}

#[test]
fn equal_names_are_refused() {
    assert!(CsvTable::create(Path::new("/nowhere/t.csv"), &["time", "time"]).is_err());
}

#[test]
fn a_resumed_table_keeps_the_rows_of_its_file() {
    let path = std::env::temp_dir().join(format!("motile-file-{}.csv", std::process::id()));
    let mut table = CsvTable::create(&path, &["time", "x"]).unwrap();
    for time in [0.0, 0.1, 0.2] {
        table.push(&[time, 1.0 / (time - 0.1)]).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap();
    let table = CsvTable::resume(&path, &["time", "x"], "").unwrap();
    assert!(table.rows().len() == 3 && table.rows()[1][1].is_nan() && table.rows()[0][1] == -10.0);
    assert_eq!(std::fs::read_to_string(&path).unwrap(), written);
    // Other columns, a row that was torn, and no file at all.
    assert!(CsvTable::resume(&path, &["time", "y"], "").unwrap().rows().is_empty());
    std::fs::write(&path, "time,x\n0,1\n0.1").unwrap();
    assert_eq!(CsvTable::resume(&path, &["time", "x"], "").unwrap().rows(), [[0.0, 1.0]]);
    std::fs::remove_file(&path).unwrap();
    assert!(CsvTable::resume(&path, &["time", "x"], "").unwrap().rows().is_empty());
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn a_table_of_a_resumed_run_begins_with_the_rows_so_far() {
    let path = std::env::temp_dir().join(format!("motile-resumed-{}.csv", std::process::id()));
    let scene =
        || Setup { droplets: Vec::new(), step: StepSize::Fixed(0.125), ..Setup::default() }.build().unwrap().scene;
    let mut first = scene();
    let mut table = CsvTable::of_run(&path, &["time", "x"], first.system_mut(), "places").unwrap();
    let row = |time: f64| [time, 1.0 / (time - 0.125)];
    let mut saved = None;
    for _ in 0..4 {
        let time = first.time();
        table.push_state(first.system_mut(), &row(time)).unwrap();
        if time == 0.25 {
            saved = Some(first.checkpoint(""));
        }
        first.step(0.125).unwrap();
    }
    let written = std::fs::read_to_string(&path).unwrap();
    let origin = first.system().origin();
    let start = format!("time,x,origin\n0,-8,{origin}\n0.125,,\n0.25,8,\n");
    assert!(origin.starts_with("motile ") && written.starts_with(&start), "{written}");
    // The file may be gone, or be that of another run.
    std::fs::write(&path, "time,x\n0,1\n").unwrap();
    let mut second = scene();
    second.resume(&saved.unwrap()).unwrap();
    let mut table = CsvTable::of_run(&path, &["time", "x"], second.system_mut(), "places").unwrap();
    for _ in 0..2 {
        let time = second.time();
        table.push_state(second.system_mut(), &row(time)).unwrap();
        second.step(0.125).unwrap();
    }
    assert_eq!(std::fs::read_to_string(&path).unwrap(), written);
    // Other columns have no rows yet.
    let other = CsvTable::of_run(&path, &["time", "y"], second.system_mut(), "places").unwrap();
    assert!(other.rows().is_empty());
    std::fs::remove_file(&path).unwrap();
}

#[test]
fn the_first_row_holds_the_origin() {
    let path = std::env::temp_dir().join(format!("motile-origin-{}.csv", std::process::id()));
    let origin = "motile 1.0; scene 1f; command: motile run 'a \"b\", c'";
    let mut table = CsvTable::with_origin(&path, &["time", "x"], origin).unwrap();
    table.push(&[0.0, 1.0]).unwrap();
    table.push(&[1.0, f64::NAN]).unwrap();
    let mut again = CsvTable::resume(&path, &["time", "x"], origin).unwrap();
    assert_eq!((again.rows().len(), again.rows()[0].as_slice(), again.origin()), (2, &[0.0, 1.0][..], origin));
    again.push(&[2.0, 3.0]).unwrap();
    let mut reader = csv::Reader::from_path(&path).unwrap();
    assert_eq!(reader.headers().unwrap(), vec!["time", "x", "origin"]);
    let last: Vec<String> = reader.records().map(|row| row.unwrap()[2].to_string()).collect();
    assert_eq!(last, ["motile 1.0; scene 1f; command: motile run 'a 'b'; c'", "", ""]);
    std::fs::remove_file(&path).unwrap();
}
