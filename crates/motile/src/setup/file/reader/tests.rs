use super::*;

/// Values of all kinds.
#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(deny_unknown_fields)]
struct Kinds {
    truth: bool,
    whole: i64,
    count: usize,
    large: u64,
    hexadecimal: u32,
    number: f64,
    text: String,
    given: Option<f64>,
    missing: Option<f64>,
    point: [f64; 2],
    pair: (usize, String),
    list: Vec<Vec<f64>>,
    table: std::collections::BTreeMap<String, f64>,
    #[serde(default)]
    choices: Vec<Choices>,
    wrapped: Wrapped,
}

#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
struct Wrapped(f64);

#[derive(Debug, PartialEq, serde::Serialize, serde::Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Choices {
    Alone,
    Value(f64),
    Pair(f64, f64),
    Settings { first: f64, second: Option<f64> },
}

const TEXT: &str = r#"
    truth = true
    whole = -9_223_372_036_854_775_808
    count = +7
    large = 18446744073709551615
    hexadecimal = 0xff
    number = -1_0.5e-1
    text = "a\u00e9\n"
    given = 3
    point = [1, inf]
    pair = [3, "three"]
    list = [[], [1, 2.5]]
    wrapped = 2.0
    choices = ["alone", { alone = {} }, { value = 1 }, { pair = [1, 2] }, { settings = { first = 1 } }]
    [table]
    one = 1
    "the second" = 2
"#;

#[test]
fn values_of_all_kinds_are_those_of_the_other_reader() {
    let read: Kinds = read(TEXT).unwrap();
    assert_eq!(read, toml::from_str(TEXT).unwrap());
    assert_eq!((read.large, read.hexadecimal, read.number), (u64::MAX, 255, -1.05));
    assert_eq!(read.choices[4], Choices::Settings { first: 1.0, second: None });
}

#[test]
fn values_of_all_kinds_are_written_as_by_the_other_writer() {
    let kinds: Kinds = read(&TEXT.replace("18446744073709551615", "1")).unwrap();
    let table = super::super::writer::table(&kinds).unwrap();
    assert_eq!(table, toml::Table::try_from(&kinds).unwrap());
    assert_eq!(read::<Kinds>(&table.to_string()).unwrap(), kinds);
    // TOML has no number for it.
    let error = super::super::writer::table(&Kinds { large: u64::MAX, ..kinds }).unwrap_err().to_string();
    assert_eq!(error, "the number 18446744073709551615 is above 9223372036854775807");
}

/// Each line of the text with something else in it is refused by both readers, in the same place.
#[test]
fn what_is_refused_is_refused_in_the_place_where_the_other_reader_sees_it() {
    let place = |error: toml::de::Error| error.to_string().lines().next().unwrap().to_owned();
    let mut refused = 0;
    for line in TEXT.lines().filter(|line| line.contains(" = ")) {
        let (key, _) = line.split_once(" = ").unwrap();
        for other in ["\"word\"", "false", "-1.5", "99999999999999999999", "[[true]]", "{ none = [] }", "1979-05-27"] {
            let text = TEXT.replace(line, &format!("{key} = {other}"));
            let (read, expected) = (read::<Kinds>(&text), toml::from_str::<Kinds>(&text));
            match (read, expected) {
                (Ok(read), Ok(expected)) => assert_eq!(read, expected, "{text}"),
                (Err(read), Err(expected)) => {
                    assert_eq!(place(read), place(expected), "{text}");
                    refused += 1;
                }
                (read, expected) => panic!("{text}: {read:?}, {expected:?}"),
            }
        }
        // Without the line, or with another key.
        for text in [TEXT.replace(line, ""), TEXT.replace(key, "    other")] {
            let (read, expected) = (read::<Kinds>(&text), toml::from_str::<Kinds>(&text));
            assert_eq!(read.map_err(place), expected.map_err(place), "{text}");
        }
    }
    assert!(refused > 70, "{refused}");
}

/// The other reader passes over what is left of some lists.
#[test]
fn lists_that_are_too_long_are_refused() {
    for (list, longer, said) in [
        ("[1, inf]", "[1, inf, 2]", "this list has 3 entries. Give 2"),
        ("[3, \"three\"]", "[3, \"three\", 1, 2]", "this list has 4 entries. Give 2"),
        ("{ pair = [1, 2] }", "{ pair = [1, 2, 3] }", "this list has 3 entries. Give 2"),
    ] {
        let text = TEXT.replace(list, longer);
        let error = read::<Kinds>(&text).unwrap_err().to_string();
        assert!(error.contains(said) && error.contains(longer), "{error}");
    }
}

#[test]
fn unknown_settings_of_a_choice_are_refused() {
    let text = TEXT.replace("first = 1", "first = 1, third = 3");
    let error = read::<Kinds>(&text).unwrap_err().to_string();
    assert!(error.contains("unknown field `third`, expected `first` or `second`"), "{error}");
    assert!(error.contains("line 14"), "{error}");
}
