use super::*;
use serde_json::json;

#[test]
fn files_keep_order_and_come_back() {
    let path = std::env::temp_dir().join(format!("motile-summary-{}.json", std::process::id()));
    let mut summary = Summary::default();
    summary.put("speed", 0.1, "");
    summary.put("area", f64::INFINITY, "");
    summary.put("steady", json!({ "reached": true, "time": 23.5 }), "");
    summary.put("steps", 12_000_usize, "");
    summary.put("speed", 0.2, "");
    summary.write(&path).unwrap();
    let back = Summary::read(&path).unwrap().unwrap();
    fs::remove_file(&path).unwrap();
    assert_eq!(back.values().keys().collect::<Vec<_>>(), ["speed", "area", "steady", "steps", "motile_version"]);
    assert_eq!(back.number("speed"), 0.2);
    assert!(back.number("area").is_nan() && back.number("absent").is_nan());
    assert!(Summary::read(&path).unwrap().is_none());
}

#[test]
fn tables_are_aligned() {
    let mut summary = Summary::default();
    summary.put("speed", 0.138_612_345, "length/time");
    summary.put("steps", 12_000_usize, "time steps");
    summary.put("steady", json!({ "reached": true, "time": null }), "");
    let table = summary.table();
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(lines[0], "  speed   0.138612        length/time");
    assert_eq!(lines[1], "  steps   12000           time steps");
    assert_eq!(lines[2], "  steady  reached: yes, time: not defined");
}

#[test]
fn six_figures_of_any_size() {
    let cases = [(0.0, "0"), (-2.0, "-2"), (1.25e-7, "1.25000e-7"), (12345.678, "12345.7"), (3e12, "3.00000e12")];
    for (value, text) in cases {
        assert_eq!(six_figures(value), text);
    }
}

#[test]
fn results_are_rows() {
    let path = std::env::temp_dir().join(format!("motile-results-{}.csv", std::process::id()));
    let rows: Vec<Summary> = [0.25, f64::NAN]
        .into_iter()
        .map(|speed| {
            let mut summary = Summary::default();
            summary.put("regime", "at rest, or nearly", "");
            summary.put("speed", speed, "");
            summary
        })
        .collect();
    write_results(&path, &rows).unwrap();
    let text = fs::read_to_string(&path).unwrap();
    fs::remove_file(&path).unwrap();
    assert_eq!(text, "regime,speed\n\"at rest, or nearly\",0.25\n\"at rest, or nearly\",\n");
}
