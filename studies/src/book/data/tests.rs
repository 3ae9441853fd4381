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
    assert!(laws.iter().any(|row| row.get("t_law_straight_a_b_l_c") == Some(&1.0)), "{laws:?}");
}
