use super::*;
use std::fs;

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
