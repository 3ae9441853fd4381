use std::collections::BTreeMap;

use motile::setup::Method;
use motile_cli::sweep::Trial;

use super::figure::Point;
use super::*;

fn making(quick: bool, name: &str) -> Making {
    let out = std::env::temp_dir().join(format!("motile-book-{name}-{}", std::process::id()));
    Making { quick, threads: 1, quiet: true, out }
}

fn quick(out: PathBuf) -> Common {
    Common { quick: true, write: false, pictures: false, add: false, threads: Some(1), quiet: true, out }
}

#[test]
fn every_figure_has_its_file_and_every_plan_its_scenes() {
    let numbers = numbers().expect("figures");
    assert!(numbers.len() > 60, "{numbers:?}");
    let mut data = BTreeMap::new();
    for number in &numbers {
        let figure = read(number).expect(number);
        assert!(figure.data.is_empty() || figure.verdict.is_none() || !figure.why.is_empty(), "{number}");
        figure.data.iter().for_each(|name| {
            data.insert(name.clone(), number.clone());
        });
        // Expressions are read even where there are no rows.
        let empty = |name: &String| (name.clone(), Data::default());
        let points = figure.others().map(str::to_owned).chain([POINTS.to_owned()]);
        let none: BTreeMap<String, Data> = figure.data.iter().cloned().chain(points).map(|name| empty(&name)).collect();
        figure.checks(&definitions().expect("definitions"), &none, &[]).expect(number);
    }
    for (name, number) in data {
        let source = Source::read(&name).expect(&number);
        for quick in [false, true] {
            let trials = source.trials(&name, &making(quick, "none")).expect(&name);
            for trial in trials.iter().take(2) {
                trial.setup.build().map(|_| ()).expect(&trial.label);
            }
        }
    }
}

/// Trials, each by its time and the square of its nodes, or the cells of its grid times the steps that they ask for.
fn size(trials: &[Trial]) -> f64 {
    let cost = |trial: &Trial| match (&trial.setup.method, trial.setup.method.spacing()) {
        (Method::Integral(method), _) => (method.nodes as f64).powi(2),
        (_, spacing) => spacing.expect("a grid").powi(-3),
    };
    trials.iter().map(|trial| trial.time * cost(trial)).sum()
}

#[test]
fn quick_is_faster_than_full() {
    let mut names: Vec<String> =
        numbers().expect("figures").iter().flat_map(|number| read(number).expect(number).data).collect();
    names.sort();
    names.dedup();
    for name in names {
        let source = Source::read(&name).expect(&name);
        if source.is_bisection() {
            continue;
        }
        let [full, quick] = [false, true].map(|quick| source.trials(&name, &making(quick, "size")).expect(&name));
        assert!(full.is_empty() || size(&quick) < 0.6 * size(&full), "{name}: {} of {}", size(&quick), size(&full));
    }
}

/// Short runs show no boundary: figures of boundaries are refused before any run, and left out of a chapter.
#[test]
fn figures_of_boundaries_have_no_quick_version() {
    let out = std::env::temp_dir().join(format!("motile-no-quick-{}", std::process::id()));
    let common = quick(out.clone());
    let error = make(&["E.6".to_owned()], &common).unwrap_err().to_string();
    assert!(error.starts_with("figure E.6 has no quick version, because short runs show no boundary"), "{error}");
    make(&["E.6".to_owned(), "E.7".to_owned()], &common).unwrap();
    assert!(!out.exists());
    // Numbers that nothing was found for are not taken for results.
    let check = |text: &str| Checked { name: "a number".to_owned(), text: text.to_owned() };
    assert!(check("").is_empty() && check("0.7: none (standard error none); 0.9: none").is_empty());
    assert!(!check("0.7: none; 0.9: 0.2 (standard error none)").is_empty());
}

#[test]
fn a_figure_is_made_from_its_file() {
    let (making, mut made) = (making(true, "one"), BTreeMap::new());
    let common = quick(making.out.clone());
    one("3.1", &making, &mut made, &common).expect("figure 3.1");
    let points = fs::read_to_string(making.out.join("3.1.csv")).expect("points");
    assert!(points.starts_with("panel,curve,group,x,y,deviation\n") && points.lines().count() > 4, "{points}");
    assert!(making.out.join("3.1.svg").exists() && making.out.join("3.1.png").exists());
    // Every steady state was made once: again it takes no computation.
    let first = made.clone();
    let mut again = BTreeMap::new();
    one("3.1", &making, &mut again, &common).expect("figure 3.1 again");
    for (name, data) in first {
        let same = |a: f64, b: f64| (a - b).abs() <= 1e-12 * a.abs();
        assert!(same(data.seconds, again[&name].seconds), "{name}");
        let speeds = |data: &Data| data.rows.iter().filter_map(|row| row.get("speed").copied()).collect::<Vec<_>>();
        let (first, second) = (speeds(&data), speeds(&again[&name]));
        assert!(first.len() == second.len() && first.iter().zip(&second).all(|(a, b)| same(*a, *b)), "{name}");
    }
    fs::remove_dir_all(&making.out).expect("a directory of its own");
}

#[test]
fn what_is_wrong_is_told_in_a_sentence() {
    let told = format!("{:#}", read("9.9").expect_err("no such figure"));
    assert!(told.contains("there is no figure 9.9") && told.contains("2.8"), "{told}");
    let text = "title = \"t\"\nsays = \"s\"\nwhy = \"w\"\ndata = [\"rows\"]\n[[check]]\nname = \"n\"\n\
                measure = \"mean\"\nx = \"1\"\n";
    let rows = vec![[("speed".to_owned(), 1.0)].into()];
    let data: BTreeMap<String, Data> = [("rows".to_owned(), Data { rows, wanted: 1, ..Data::default() })].into();
    for (y, expected) in [("spede", "no column spede"), ("speed +", "is missing before"), ("(speed", "')' is missing")]
    {
        let figure: Figure = toml::from_str(&format!("{text}y = \"{y}\"\n")).expect(y);
        let told = format!("{:#}", figure.checks(&Definitions::new(), &data, &[]).expect_err(y));
        assert!(told.contains(expected), "{y}: {told}");
    }
}

#[test]
fn a_single_row_is_shown_with_its_error_and_several_with_their_deviation() {
    let text = "title = \"t\"\nsays = \"s\"\nwhy = \"w\"\ndata = [\"rows\"]\n[[panel]]\nx = \"x\"\ny = \"y\"\n\
                [[panel.curve]]\nx = \"x\"\ny = \"y\"\nerror = \"2 * e\"\n";
    let figure: Figure = toml::from_str(text).expect("a figure");
    let row =
        |x: f64, y: f64, e: f64| [("x", x), ("y", y), ("e", e)].map(|(name, value)| (name.to_owned(), value)).into();
    let rows = vec![row(1.0, 5.0, 0.25), row(2.0, 1.0, 0.25), row(2.0, 3.0, 0.25)];
    let data = [("rows".to_owned(), Data { rows, ..Data::default() })].into();
    let (plots, points) = figure.panels(&Definitions::new(), &data, &[], false).expect("a panel");
    assert_eq!(plots.len(), 1);
    let deviation = 2_f64.sqrt();
    assert_eq!(points, format!("panel,curve,group,x,y,deviation\n1,,none,1,5,0.5\n1,,none,2,2,{deviation}\n"));
}

/// Data that are added to a figure leave the points and numbers of its other data as they were.
#[test]
fn what_was_found_before_stays_where_its_data_are_not_there() {
    let of = |data: &str| {
        format!(
            "[[panel]]\nx = \"x\"\ny = \"y\"\n[[panel.curve]]\ndata = \"{data}\"\nx = \"x\"\ny = \"y\"\nby = \"x\"\n\
             [[check]]\nname = \"{data}\"\nmeasure = \"mean\"\ndata = \"{data}\"\nx = \"1\"\ny = \"y\"\n"
        )
    };
    let head = "title = \"t\"\nsays = \"s\"\nwhy = \"w\"\ndata = [\"old\", \"new\"]\n";
    let figure: Figure = toml::from_str(&[head, &of("old"), &of("new")].concat()).expect("a figure");
    let data = |name: &str, y: f64| {
        let rows = [1.5, 2.0].map(|x| [("x".to_owned(), x), ("y".to_owned(), x * y)].into()).to_vec();
        (name.to_owned(), Data { rows, ..Data::default() })
    };
    let common = Definitions::new();
    let both = [data("old", 3.0), data("new", 5.0)].into();
    let (_, all) = figure.panels(&common, &both, &[], false).expect("panels");
    let checks = figure.checks(&common, &both, &[]).expect("numbers");
    let before: Vec<Point> = all.lines().skip(1).filter_map(Point::read).collect();
    let added = [data("new", 7.0)].into();
    let (plots, points) = figure.panels(&common, &added, &before, false).expect("panels");
    assert_eq!((plots.len(), points), (2, all.replace("1.5,7.5,", "1.5,10.5,").replace("2,10,", "2,14,")));
    let found = figure.checks(&common, &added, &checks).expect("numbers");
    assert_eq!(found[0], checks[0]);
    assert!(found[1].text.starts_with("12.25 ") && checks[1].text.starts_with("8.75 "), "{found:?}, {checks:?}");
    // Without what was found before, all data are needed.
    assert!(figure.panels(&common, &added, &[], false).is_err() && figure.checks(&common, &added, &[]).is_err());
}

#[test]
fn a_verdict_falls_with_its_numbers() {
    let text = "title = \"t\"\nsays = \"s\"\nwhy = \"w\"\nverdict = \"confirmed\"\ndata = [\"rows\"]\n[[check]]\n\
                name = \"speed\"\nmeasure = \"mean\"\nx = \"1\"\ny = \"speed\"\nwithin = [0.9, 1.1]\n";
    let figure: Figure = toml::from_str(text).expect("a figure");
    assert_eq!(verdict(&figure, None), "not computed yet");
    assert_eq!(verdict(&figure, Some(&figure.judged(&[]))), "not computed yet");
    for (speed, expected) in [(1.0, "confirmed"), (2.0, "open: speed is 2"), (f64::NAN, "open: speed is ")] {
        let rows = vec![[("speed".to_owned(), speed)].into()];
        let data = [("rows".to_owned(), Data { rows, wanted: 1, ..Data::default() })].into();
        let checks = figure.checks(&Definitions::new(), &data, &[]).expect("numbers");
        let found = verdict(&figure, Some(&figure.judged(&checks)));
        assert!(found.starts_with(expected), "{found}");
    }
    // A range that cannot be missed is none.
    for (opposite, lacks) in [("", true), ("opposite = 1.05\n", true), ("opposite = 0.0\n", false)] {
        let figure: Figure = toml::from_str(&(text.to_owned() + opposite)).expect("a figure");
        assert_eq!(figure.lacks().is_some(), lacks, "{opposite}");
    }
}

#[test]
fn verdicts_of_questions_follow_from_their_numbers() {
    let check = |name: &str, opposite: &str| {
        format!(
            "[[check]]\nname = \"{name}\"\nmeasure = \"mean\"\nx = \"1\"\ny = \"{name}\"\n\
                 within = [0.9, 1.1]\n{opposite}\n"
        )
    };
    let head = "title = \"t\"\nsays = \"s\"\nwhy = \"w\"\ndata = [\"rows\"]\n";
    let decisive = "opposite = 2.0";
    let text = [head, &check("a", decisive), &check("b", decisive), &check("error", "")].concat();
    let mut figure: Figure = toml::from_str(&text).expect("a figure");
    "E.1".clone_into(&mut figure.number);
    assert!(figure.lacks().is_none() && verdict(&figure, None) == "not computed yet");
    for (numbers, expected) in [
        ([1.0, 1.0, 1.0], "confirmed"),
        ([1.0, 2.0, 1.0], "confirmed in part"),
        ([0.0, 2.0, 1.0], "refuted"),
        ([1.0, 1.0, 1.2], "undecided"),
        ([f64::NAN, 2.0, 1.0], "refuted"),
    ] {
        let row = ["a", "b", "error"].map(str::to_owned).into_iter().zip(numbers).collect();
        let data = [("rows".to_owned(), Data { rows: vec![row], wanted: 1, ..Data::default() })].into();
        let checks = figure.checks(&Definitions::new(), &data, &[]).expect("numbers");
        assert_eq!(verdict(&figure, Some(&figure.judged(&checks))), expected, "{numbers:?}");
    }
    let open = [head, &check("a", "")].concat();
    for text in [open.clone(), "verdict = \"confirmed\"\n".to_owned() + &text] {
        let mut figure: Figure = toml::from_str(&text).expect("a figure");
        "E.1".clone_into(&mut figure.number);
        assert!(figure.lacks().is_some(), "{text}");
    }
}

#[test]
fn every_verdict_rests_on_a_range_that_its_contrary_is_outside_of() {
    let lacking = numbers().expect("figures").into_iter();
    let lacking = lacking.filter_map(|number| Some(format!("{number}: {}", read(&number).expect(&number).lacks()?)));
    let lacking: Vec<String> = lacking.collect();
    assert!(lacking.is_empty(), "{}", lacking.join("\n"));
}

#[test]
fn verdicts_of_the_thesis_and_of_questions_are_counted_apart() {
    let pages = pages::all().expect("pages");
    let page = |wanted: &str| &pages.iter().find(|(name, _)| name == wanted).expect(wanted).1;
    let (front, second) = (page("README.md"), page("chapter-E.md"));
    let numbers = numbers().expect("figures");
    let of_thesis = numbers.iter().filter(|number| chapter_of(number) != ENVIRONMENT).count();
    assert!(front.contains(&format!("\n{of_thesis} figures and claims: ")), "{front}");
    let (verdicts, questions) = front.split_once("## The environment").expect("two tables");
    let rows = |text: &str| text.lines().filter(|line| line.starts_with("| [")).count();
    let questions = questions.split_once("## Misprints").expect("misprints").0;
    assert_eq!((rows(verdicts), rows(questions)), (of_thesis, numbers.len() - of_thesis));
    assert_eq!(second.matches("**Statement:**").count(), numbers.len() - of_thesis);
}

/// Every check with its range and the number of its contrary is a line of a table beside the pages.
#[test]
fn tables_have_every_check_with_its_range_and_contrary() {
    let pages = pages::all().expect("pages");
    for number in numbers().expect("figures") {
        let name = format!("checks/chapter-{}.csv", chapter_of(&number));
        let text = &pages.iter().find(|(other, _)| *other == name).expect(&name).1;
        let mut table = csv::Reader::from_reader(text.as_bytes());
        let rows: Vec<csv::StringRecord> = table.records().map(|row| row.expect(&name)).collect();
        for (check, within, opposite) in read(&number).expect(&number).ranges() {
            let own = rows.iter().filter(|row| row[0] == number[..] && row[1] == *check);
            let found: Vec<[Option<f64>; 3]> = own.map(|row| [5, 6, 7].map(|k| row[k].parse().ok())).collect();
            let expected = [within.map(|range| range[0]), within.map(|range| range[1]), opposite];
            assert!(found.contains(&expected), "{number}, {check}: {found:?}");
        }
    }
}

#[test]
fn marks_of_a_text_are_filled_with_the_numbers_of_checks() {
    let filled = |text: &str| pages::filled_with_all(text);
    let kept = read("3.4").expect("a figure");
    assert!(kept.ranges().any(|(name, ..)| name == "unconfined speed at -2"));
    let text = filled("The speed is {{3.4 | unconfined speed at -2}}.").expect("a number");
    assert!(text.starts_with("The speed is 0.13") && !text.contains('{'), "{text}");
    let pairs = "E.10 | pairs of mirrored starts with more members in the wide branch, of those that differ";
    let text = filled(&format!("{{{{{pairs}}}}} of {{{{{pairs} | of}}}}, p = {{{{{pairs} | p}}}}")).expect("a test");
    assert_eq!(text, "7 of 7, p = 0.0156\n");
    // 16 of 39 went there, and one of 40 was lost.
    let share = "E.4 | share of the droplets that go to the stiff side, of those that go somewhere | bounds";
    assert_eq!(filled(&format!("{{{{{share}}}}}")).expect("bounds"), "0.4 to 0.425\n");
    // 58 are left out, of which four are points without a boundary and no runs.
    assert_eq!(filled("{{failed E.6}}").expect("failed runs"), "54 of 244\n");
    for (text, expected) in [
        ("{{3.4 | speed at -2 by width | 2 | p}}", "says no"),
        ("{{3.4 | no such check}}", "has no check"),
        ("{{3.4 | speed at -2 by width}}", "name a group"),
        ("{{3.4 | speed at -2 by width | 7}}", "found nothing"),
        ("{{9.9 | a}}", "no figure 9.9"),
        ("{{3.4 | unconfined speed at -2", "no '}}'"),
    ] {
        let told = format!("{:#}", filled(text).expect_err(text));
        assert!(told.contains(expected), "{text}: {told}");
    }
}

/// The numbers in a text, with their places after the point.
fn numbers_of(text: &str) -> Vec<(f64, i32, String)> {
    let text = text.replace('−', "-");
    let mut found = Vec::new();
    let mut before = ' ';
    let mut rest = text.as_str();
    while let Some(first) = rest.chars().next() {
        let ends = rest.find(|c: char| !c.is_ascii_digit() && c != '.' && c != 'e').unwrap_or(rest.len());
        let mut word = &rest[..ends];
        if word.ends_with('e') && rest[ends..].starts_with(['-', '+']) {
            let more = rest[ends + 1..].find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len() - ends - 1);
            word = &rest[..ends + 1 + more];
        }
        let word = word.trim_end_matches(['.', 'e', '-']);
        if !first.is_ascii_digit() || before.is_alphanumeric() || before == '.' {
            before = first;
            rest = &rest[first.len_utf8()..];
            continue;
        }
        let (digits, power) = word.split_once('e').unwrap_or((word, "0"));
        let places = digits.split_once('.').map_or(0, |(_, after)| after.len() as i32);
        found.extend(
            word.parse().ok().map(|value| (value, places - power.parse::<i32>().unwrap_or(0), word.to_owned())),
        );
        before = '0';
        rest = &rest[word.len().max(1)..];
    }
    found
}

fn numbers_in(value: &toml::Value, pool: &mut Vec<f64>) {
    match value {
        toml::Value::Table(table) => table.values().for_each(|value| numbers_in(value, pool)),
        toml::Value::Array(list) => list.iter().for_each(|value| numbers_in(value, pool)),
        toml::Value::Float(value) => pool.push(value.abs()),
        toml::Value::Integer(value) => pool.push((*value as f64).abs()),
        toml::Value::String(text) => pool.extend(numbers_of(text).into_iter().map(|(value, ..)| value)),
        _ => {}
    }
}

/// A number in the reasons of a verdict is a rounding of one that a check of its figure found (or of its percentage),
/// or one of the statement, of the set-up or of another figure.
#[test]
fn numbers_of_verdicts_are_those_of_checks() {
    let found = numbers_of("figure 3.1, at -2 (1e-5, 2.5e4): 0.50 R0.");
    let expected = [(3.1, 1), (2.0, 0), (1e-5, 5), (2.5e4, -3), (0.5, 2)];
    assert_eq!(found.iter().map(|(value, places, _)| (*value, *places)).collect::<Vec<_>>(), expected);
    let pages = pages::all().expect("pages");
    let mut typed = Vec::new();
    for number in numbers().expect("figures").into_iter() {
        let figure = read(&number).expect(&number);
        // A drawing has no checks.
        if figure.data.is_empty() {
            continue;
        }
        let name = format!("checks/chapter-{}.csv", chapter_of(&number));
        let (_, sheet) = pages.iter().find(|(other, _)| *other == name).expect(&name);
        let mut table = csv::Reader::from_reader(sheet.as_bytes());
        let rows = table.records().map(|row| row.expect(&name)).filter(|row| row[0] == number[..]);
        let text: Vec<String> = rows.map(|row| [&row[1], &row[2], &row[3], &row[4]].join(" ")).collect();
        let checked: Vec<f64> = numbers_of(&text.join(" ")).into_iter().map(|(value, ..)| value).collect();
        let mut set_up: Vec<f64> = numbers_of(&figure.says).into_iter().map(|(value, ..)| value).collect();
        for data in &figure.data {
            let path = directory().join(format!("data/{data}.toml"));
            let table: toml::Table = toml::from_str(&fs::read_to_string(path).expect(data)).expect(data);
            numbers_in(&toml::Value::Table(table), &mut set_up);
        }
        // Marks are numbers of checks already.
        let mut why = figure.why.clone();
        while let Some((start, end)) = why.find("{{").zip(why.find("}}")) {
            why.replace_range(start..end + 2, "");
        }
        for (value, places, word) in numbers_of(&why) {
            let unit = 0.5001 * 10_f64.powi(-places);
            let rounded = |found: f64| [1.0, 100.0].iter().any(|factor| (factor * found - value).abs() <= unit);
            let given = |found: &f64| (found - value).abs() <= 1e-9 * value;
            let cited = why.contains(&format!("figure {word}")) || why.contains(&format!("({word})"));
            let step = why.contains(&format!("A = {word}"));
            if !(checked.iter().any(|found| rounded(*found)) || set_up.iter().any(given) || cited || step) {
                typed.push(format!("{number}: {word}"));
            }
        }
    }
    assert!(typed.is_empty(), "numbers that no check found: {}", typed.join("; "));
}

/// The numbers of a text outside of its marks, each with what follows it.
fn typed(text: &str) -> Vec<(f64, &str, bool)> {
    let mut found = Vec::new();
    let outside = text.split("{{").enumerate().filter_map(|(k, part)| match k {
        0 => Some(part),
        _ => part.split_once("}}").map(|(_, after)| after),
    });
    for part in outside {
        let mut rest = part;
        while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
            // The number of a figure, such as E.5, or a name, such as R0, is none.
            let word = rest[..start].ends_with(|c: char| c.is_alphabetic() || c == '_' || c == '.');
            rest = &rest[start..];
            let end = rest.find(|c: char| !(c.is_ascii_digit() || c == '.' || c == 'e')).unwrap_or(rest.len());
            let number = rest[..end].trim_end_matches(['.', 'e']);
            let after = &rest[number.len()..];
            if let (false, Ok(value)) = (word, number.parse()) {
                found.push((value, after, number.contains('.')));
            }
            rest = &rest[end..];
        }
    }
    found
}

/// If the reasons of a verdict of the second part have any marks, all that was measured is a mark: other numbers are
/// those of the scenes, of the statement, or small whole ones.
#[test]
fn no_measured_number_of_a_verdict_is_typed() {
    let mut marked = 0;
    for number in numbers().expect("figures").into_iter().filter(|number| chapter_of(number) == ENVIRONMENT) {
        let figure = read(&number).expect(&number);
        for text in [&figure.why, &figure.finding].into_iter().filter(|text| text.contains("{{")) {
            marked += 1;
            let mut known = figure.says.clone();
            for name in &figure.data {
                known += &fs::read_to_string(directory().join("data").join(format!("{name}.toml"))).expect(name);
            }
            let known: Vec<f64> = typed(&known).into_iter().map(|(value, ..)| value).collect();
            for (value, after, decimal) in typed(text) {
                let told = format!("figure {number}: '{value}{after:.20}' is typed: give a mark");
                assert!(!after.starts_with(" %"), "{told}");
                assert!(!decimal || known.iter().any(|other| (other - value).abs() < 1e-9), "{told}");
            }
        }
    }
    assert!(marked > 8, "{marked}");
    let found = typed("In E.5 at 2.2 R0 {{E.1 | 0.5}} is 12 % of 1e4.");
    let found: Vec<(f64, bool, bool)> = found.iter().map(|(v, after, d)| (*v, after.starts_with(" %"), *d)).collect();
    assert_eq!(found, [(2.2, false, true), (12.0, true, false), (1e4, false, false)]);
}

/// (1.12) and (1.13), corrected as the report says, are free of divergence and have their values on the sphere; as
/// printed they do not.
#[test]
fn the_corrected_flow_of_squirmers_is_free_of_divergence_and_the_printed_one_is_not() {
    // P_n and V_n = -2/(n(n+1)) dP_n/dθ for n = 2 and 3.
    let legendre = |n: i32, theta: f64| {
        let (s, c) = theta.sin_cos();
        match n {
            2 => (1.5 * c * c - 0.5, s * c),
            _ => (2.5 * c.powi(3) - 1.5 * c, s * (7.5 * c * c - 1.5) / 6.0),
        }
    };
    let flow = |n: i32, a: f64, b: f64, corrected: bool, r: f64, theta: f64| {
        let (p, v) = legendre(n, theta);
        let (near, far, half) = (r.powi(-n), r.powi(-n - 2), 0.5 * f64::from(n));
        let other = if corrected { 1.0 } else { 0.0 };
        let radial = (half * near - (half - 1.0) * far) * a + other * (far - near) * b;
        let along = (half * far - (half - 1.0) * near) * b + other * half * (half - 1.0) * (near - far) * a;
        (radial * p, along * v)
    };
    let divergence = |n: i32, a: f64, b: f64, corrected: bool, r: f64, theta: f64| {
        let h = 1e-4;
        let radial = |r: f64| r * r * flow(n, a, b, corrected, r, theta).0;
        let along = |theta: f64| theta.sin() * flow(n, a, b, corrected, r, theta).1;
        (radial(r + h) - radial(r - h)) / (2.0 * h * r * r)
            + (along(theta + h) - along(theta - h)) / (2.0 * h * r * theta.sin())
    };
    for n in [2, 3] {
        let (p, v) = legendre(n, 0.9);
        let (radial, along) = flow(n, 0.7, -1.3, true, 1.0, 0.9);
        assert!((radial - 0.7 * p).abs() < 1e-14 && (along + 1.3 * v).abs() < 1e-14, "{n}");
        // At n = 2 the term of A_n that is missing in (1.13) vanishes.
        for (a, b) in [(1.0, 0.0), (0.0, 1.0)] {
            assert!(divergence(n, a, b, true, 1.4, 0.9).abs() < 1e-7, "{n}, {a}, {b}");
            let printed = divergence(n, a, b, false, 1.4, 0.9).abs();
            assert!(printed > 0.01 || (n == 2 && a == 1.0), "{n}, {a}, {b}: {printed}");
        }
    }
}

#[test]
fn points_are_read_back() {
    let data = Data::in_points("panel,curve,group,x,y,deviation\n1,\"a, b\",2,0.5,-1e-3,0\n2,,none,1,2,0\n");
    let value = |k: usize, name: &str| data.rows[k].get(name).copied();
    assert_eq!([value(0, "group"), value(0, "x"), value(0, "y")], [Some(2.0), Some(0.5), Some(-1e-3)]);
    assert_eq!([value(1, "group"), value(1, "panel"), value(1, "labelled")], [None, Some(2.0), Some(0.0)]);
}

#[test]
fn the_pages_are_those_that_would_be_written() {
    for (name, text) in pages::all().expect("pages") {
        let kept = fs::read_to_string(pages::folder().join(&name)).expect(&name);
        assert!(kept == text, "docs/book/{name}: run studies -- pages");
    }
}
