use super::*;

#[test]
fn entries_are_merged_into_tables_and_lists_of_tables() {
    let parse = |text: &str| toml::from_str::<Table>(text).expect(text);
    let mut table = parse("time = 1\ngrid.a = [1, 2, 3]\n[[scene.droplets]]\nangle = 1.0\nviscosity = 2.0");
    merge(&mut table, &parse("grid.a = [9]\n[[scene.droplets]]\nangle = 3.0\n[[scene.droplets]]\nangle = 5.0"));
    let expected =
        "time = 1\ngrid.a = [9]\n[[scene.droplets]]\nangle = 3.0\nviscosity = 2.0\n[[scene.droplets]]\nangle = 5.0";
    assert_eq!(table, parse(expected));
}

#[test]
fn values_become_columns() {
    let value: Value = serde_json::json!({ "a": { "b-c": 2, "list": [1.5, 2.5] }, "yes": true, "regime": "at rest" });
    let mut row = Row::new();
    flatten("", &value, &mut row);
    let expected = [("a_b_c", 2.0), ("a_list_0", 1.5), ("a_list_1", 2.5), ("regime_at_rest", 1.0), ("yes", 1.0)];
    assert_eq!(row, expected.map(|(name, value)| (name.to_owned(), value)).into());
}

#[test]
fn tables_of_the_docs_are_rows() {
    let rows = of_table("nucleus").expect("a table");
    assert_eq!(rows[0]["t_activity"], -1.0);
    assert_eq!(rows[0]["t_radius"], 0.3);
    let laws = of_table("steady-length-2").expect("a table");
    assert!(laws.iter().any(|row| row.contains_key("t_law_straight_a_b_l_c")), "{:?}", laws[0]);
}

#[test]
fn a_run_that_ends_in_an_error_is_told_each_time_and_others_have_their_speed() {
    let out = std::env::temp_dir().join(format!("motile-book-failures-{}", std::process::id()));
    let making = Making { quick: false, threads: 1, quiet: true, out };
    let text = "about = \"a\"\n[plan]\ntime = 0.02\n[plan.grid]\n\"least-gap\" = [1.5, 0.1]\n\
                [plan.scene.region.channel]\nlength = 6.0\nwidth = 4.0\ndrive = \"zero-gradient\"\n\
                [plan.scene.method.integral]\nnodes = 32\nelements = 128\n[[plan.scene.droplets]]\n";
    let source: Source = toml::from_str(text).expect("a source");
    for _ in 0..2 {
        let data = source.rows("failing", &making).expect("data");
        assert_eq!((data.wanted, data.rows.len(), data.failures.len()), (2, 1, 1), "{:?}", data.failures);
        assert!(data.failures[0].contains("1.5"), "{:?}", data.failures);
        assert!(data.rows[0]["mean_speed"].is_nan(), "no period of the channel in that time");
    }
    std::fs::remove_dir_all(&making.out).expect("a directory of its own");
}

#[test]
fn mean_velocities_are_those_of_the_track() {
    let moving: Vec<(f64, f64)> = (0..=40).map(|k| 0.5 * f64::from(k)).map(|t| (t, 1.0 - 0.25 * t)).collect();
    let [over_period, late] = means(&moving, 2.0);
    assert!(over_period.is_nan() && (late + 0.25).abs() < 1e-12, "backwards: {over_period}, {late}");
    let there: Vec<(f64, f64)> = moving.iter().map(|(t, x)| (*t, -x)).collect();
    let [over_period, late] = means(&there, 2.0);
    assert!((over_period - 0.25).abs() < 1e-12 && (late - 0.25).abs() < 1e-12, "{over_period}, {late}");
    assert!(means(&[], 1.0).iter().all(|value| value.is_nan()));
}

/// A branch that is looked at on the way has the speeds of the states there, and ends at a fold: swimmers in three
/// dimensions turn between half the threshold of polarisation and the threshold.
#[test]
fn branches_are_looked_at_on_the_way_and_end_in_folds() {
    let scene = |activity: f64, outside: f64, region: &str| -> Setup {
        let text = format!(
            "region = \"{region}\"\nviscosity = {outside}\nmethod.integral = {{ nodes = 48, elements = 192 }}\n\
             [[droplets]]\nparticles.activity = {activity}\nparticles.excluded-volume.step = 1.0\n"
        );
        Setup::from_toml(&text).expect("a scene")
    };
    let number = |summary: &Summary, name: &str| summary.number(name);
    let follow = |to: &[f64]| Follow { parameter: "activity".to_owned(), from: -0.6, at: to.to_vec() };
    let weak = scene(-0.55, 100.0, "space");
    let branch = follow(&[-0.58, -0.55]).branch(&weak).expect("a branch");
    let speeds: Vec<f64> = serde_json::from_value(branch.values()["branch_speed"].clone()).expect("speeds");
    let direct = SteadyState::find(&weak).expect("a state").measured().expect("a speed").speed;
    assert!((speeds[1] / direct - 1.0).abs() < 1e-4, "{speeds:?}, {direct}");
    assert!((number(&branch, "branch_end") + 0.55).abs() < 1e-12 && number(&branch, "fold").is_nan());
    let branch = follow(&[-0.55, -0.3]).branch(&scene(-0.3, 100.0, "space")).expect("a branch");
    let fold = number(&branch, "fold");
    // `steady-folds.csv`: -0.491459 with 40 nodes.
    assert!((fold + 0.4915).abs() < 1e-3 && (number(&branch, "branch_end") - fold).abs() < 1e-12, "{fold}");
}
