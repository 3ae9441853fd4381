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
fn a_resumed_table_keeps_the_rows_so_far() {
    let path = std::env::temp_dir().join(format!("motile-resumed-{}.csv", std::process::id()));
    let mut table = CsvTable::create(&path, &["time", "x"]).unwrap();
    for time in [0.0, 0.1, 0.2, 0.3] {
        table.push(&[time, 1.0 / (time - 0.1)]).unwrap();
    }
    table.flush().unwrap();
    let written = std::fs::read_to_string(&path).unwrap();
    let mut table = CsvTable::resume(&path, &["time", "x"], 0.2).unwrap();
    assert_eq!(table.rows().len(), 3);
    assert!(table.rows()[1][1].is_nan() && table.rows()[0][1] == -10.0);
    table.push(&[0.3, 1.0 / (0.3 - 0.1)]).unwrap();
    table.flush().unwrap();
    assert_eq!(std::fs::read_to_string(&path).unwrap(), written);
    // Other columns, a row that was torn, and no file at all.
    assert!(CsvTable::resume(&path, &["time", "y"], 0.2).unwrap().rows().is_empty());
    std::fs::write(&path, "time,x\n0,1\n0.1").unwrap();
    assert_eq!(CsvTable::resume(&path, &["time", "x"], 0.2).unwrap().rows(), [[0.0, 1.0]]);
    std::fs::remove_file(&path).unwrap();
    assert!(CsvTable::resume(&path, &["time", "x"], 0.2).unwrap().rows().is_empty());
    std::fs::remove_file(&path).unwrap();
}
