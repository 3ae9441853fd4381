//! Summaries and their tables, read by other programs.

use motile_cli::run::{Summary, write_results};

#[test]
fn summaries_and_their_tables_come_back() {
    let directory = std::env::temp_dir().join(format!("motile-cli-summary-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    let mut summary = Summary::default();
    summary.put("speed", 0.1 + 0.2, "");
    summary.put("regime", "at rest, \"nearly\"", "");
    summary.put("steps", 12_000_usize, "");
    summary.put("warnings", vec!["thin film", "long \\ step"], "");
    summary.put("beta", f64::NAN, "");
    let path = directory.join("summary.json");
    summary.write(&path).unwrap();
    let found: serde_json::Value = serde_json::from_str(&std::fs::read_to_string(&path).unwrap()).unwrap();
    let expected = serde_json::json!({
        "speed": 0.1 + 0.2, "regime": "at rest, \"nearly\"", "steps": 12_000,
        "warnings": ["thin film", "long \\ step"], "beta": null,
        "motile_version": motile::VERSION
    });
    assert_eq!(found, expected);

    let table = directory.join("results.csv");
    write_results(&table, &[summary.clone(), summary]).unwrap();
    let mut reader = csv::Reader::from_path(&table).unwrap();
    let names = reader.headers().unwrap().clone();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!((rows.len(), names.len()), (2, 5));
    let field = |name: &str| rows[1].get(names.iter().position(|known| known == name).unwrap()).unwrap();
    assert_eq!([field("regime"), field("steps"), field("beta")], ["at rest, \"nearly\"", "12000", ""]);
    assert_eq!(field("speed").parse::<f64>().unwrap(), 0.1 + 0.2);
    std::fs::remove_dir_all(&directory).unwrap();
}
