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
