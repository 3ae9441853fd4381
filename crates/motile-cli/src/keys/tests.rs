use std::collections::BTreeSet;

use motile::setup::ExcludedVolume;

use super::*;

fn scene(text: &str) -> Value {
    table_of(text).unwrap()
}

/// Reads a scene as programs do, so that reading is not compiled here once more.
fn read(scene: &Value) -> Setup {
    Setup::read(&scene.as_table().unwrap().to_string()).unwrap()
}

/// Value of an entry.
fn get<'a>(scene: &'a Value, key: &str) -> Option<&'a Value> {
    key.split('.').try_fold(scene, |value, part| match part.parse::<usize>() {
        Ok(number) => value.get(number),
        Err(_) => value.get(part),
    })
}

fn refusal(text: &str, assigned: &str) -> String {
    let (key, value) = assignment(assigned).unwrap();
    set(&mut scene(text), &key, value).unwrap_err().to_string()
}

/// Keys and values of all entries of the annotated scene and of the other values that its lines name.
fn annotated() -> Vec<(String, Value)> {
    fn leaves(key: String, value: Value, found: &mut Vec<(String, Value)>) {
        match value {
            Value::Table(table) => {
                let dot = if key.is_empty() { "" } else { "." };
                table.into_iter().for_each(|(name, value)| leaves(format!("{key}{dot}{name}"), value, found));
            }
            // What is given by points is given by all of them.
            Value::Array(list) if list.iter().any(Value::is_table) => {
                list.into_iter().enumerate().for_each(|(k, value)| leaves(format!("{key}.{k}"), value, found));
            }
            leaf => found.push((key, leaf)),
        }
    }
    let mut found = Vec::new();
    leaves(String::new(), Value::Table(Setup::ANNOTATED.parse().unwrap()), &mut found);
    for (keys, value) in Setup::ANNOTATED.lines().filter_map(|line| line.strip_prefix("#| ")?.split_once(" = ")) {
        let (lists, value) = (["droplets", "solids", "shells", "interfaces"], assignment(&format!("x={value}")));
        let first = keys.split('.').next().unwrap();
        let is_whole_list = !keys.contains('.');
        let keys = if lists.contains(&first) && !is_whole_list {
            keys.replacen(first, &format!("{first}.0"), 1)
        } else {
            keys.to_owned()
        };
        leaves(keys, value.unwrap().1, &mut found);
    }
    found
}

#[test]
fn every_key_of_the_annotated_scene_can_be_set() {
    let (known, mut tried): (BTreeSet<String>, BTreeSet<String>) = (all().into_iter().collect(), BTreeSet::new());
    for (key, value) in annotated() {
        // In an empty scene: the tables on the way are made.
        let mut empty = Value::Table(Table::new());
        let parts: Vec<&str> = key.split('.').collect();
        for (depth, _) in parts.iter().enumerate().filter(|(_, part)| part.parse::<usize>().is_ok()) {
            for number in 0..parts[depth].parse().unwrap() {
                let before = [&parts[..depth], &[number.to_string().as_str()]].concat().join(".");
                if get(&empty, &before).is_none() {
                    let placeholder = set(&mut empty, &before, Value::Table(Table::new()));
                    placeholder.or_else(|_| set(&mut empty, &before, value.clone())).unwrap();
                }
            }
        }
        set(&mut empty, &key, value.clone()).unwrap_or_else(|error| panic!("{key} = {value}: {error}"));
        assert_eq!(get(&empty, &key), Some(&value), "{key}");
        let first: Vec<_> = parts.iter().map(|part| if part.parse::<usize>().is_ok() { "0" } else { part }).collect();
        let key = first.join(".");
        assert!(known.contains(&key) || known.contains(key.trim_end_matches(".0")), "{key}");
        tried.insert(key);
    }
    assert!(tried.len() > 150, "{}", tried.len());
}

#[test]
fn values_replace_what_excludes_them() {
    let mut scene = scene("[[droplets]]\n");
    for assigned in [
        "region.channel.width=4",
        "region.channel.length=12",
        "method.grid.spacing=0.1",
        "droplets.0.particles.activity=-4",
        "droplets[0].centre[1]=0.25",
        "droplets.1.particles=none",
        "droplets.1.centre=[3, 0]",
        "flow.wall-velocity=[-1, 1]",
        "droplets.0.particles.start.perturbed={ amplitude = 0.2, seed = 7 }",
        "droplets.0.name=my cell",
        "step.fixed=1e-3",
    ] {
        let (key, value) = assignment(assigned).unwrap();
        set(&mut scene, &key, value).unwrap();
    }
    let setup = read(&scene);
    let expected = r#"
        region.channel = { length = 12.0, width = 4.0 }
        method.grid.spacing = 0.1
        flow.wall-velocity = [-1.0, 1.0]
        step.fixed = 0.001
        [[droplets]]
        name = "my cell"
        centre = [0.0, 0.25]
        particles = { activity = -4.0, start.perturbed = { amplitude = 0.2, seed = 7 } }
        [[droplets]]
        particles = "none"
        centre = [3.0, 0.0]
    "#;
    assert_eq!(setup, Setup::read(expected).unwrap());
    // One number for both walls, and then another one for one of them.
    set(&mut scene, "region.channel.slip", Value::Float(0.2)).unwrap();
    set(&mut scene, "region.channel.slip.1", Value::Float(0.3)).unwrap();
    assert_eq!(read(&scene).region.slip(), [0.2, 0.3]);
    // A word takes the place of a table, and the other way round.
    set(&mut scene, "region", Value::String("plane".to_owned())).unwrap();
    set(&mut scene, "region.tube.radius", Value::Float(2.0)).unwrap();
    assert_eq!(read(&scene).region, motile::base::Region::tube(2.0));
    set(&mut scene, "droplets.0.particles.excluded-volume", Value::String("none".to_owned())).unwrap();
    set(&mut scene, "droplets.0.particles.excluded-volume.step", Value::Float(7.0)).unwrap();
    let particles = read(&scene).droplets[0].particles.unwrap();
    assert_eq!(particles.excluded_volume, ExcludedVolume::Step(7.0));
}

#[test]
fn wrong_keys_name_the_nearest_ones() {
    for (assigned, nearest) in [
        ("viscosty=3", "viscosity"),
        ("droplets.0.activity=-4", "droplets.0.particles.activity"),
        ("droplets.angle=1", "droplets.0.angle"),
        ("droplet.0.tension=4", "droplets.0.tension"),
        ("droplets.1.particles.actvity=-4", "droplets.1.particles.activity"),
        ("region.chanel.width=4", "region.channel.width"),
        ("shells.0.shape.ellipse.half-axs=[1, 2]", "shells.0.shape.ellipse.half-axes"),
        ("suspension.0.droplet.particles.difusion=1", "suspension.0.droplet.particles.diffusion"),
        ("method.grid.space=0.1", "method.grid.spacing"),
    ] {
        let said = refusal("[[droplets]]\n[[droplets]]\ncentre = [2.5, 0.0]\n", assigned);
        let first = said.split("The nearest keys are ").nth(1).and_then(|keys| keys.split(", ").next());
        assert_eq!(first, Some(nearest), "{said}");
    }
    // Without the way to it there are several.
    let said = refusal("[[droplets]]\n", "activity=-4");
    assert!(said.contains("suspension.0.activity, droplets.0.particles.activity, "), "{said}");
}

#[test]
fn wrong_values_name_the_key_and_what_is_expected() {
    for (assigned, words) in [
        ("viscosity=high", "viscosity = \"high\": the text \"high\" cannot be used. Use a number"),
        ("droplets.0.area-constraint=3", "the number `3` cannot be used. Use a boolean"),
        ("method.integral.nodes=3.5", "the number `3.5` cannot be used. Use a whole number that is not negative"),
        ("method.grid.kernel=best", "there is no choice `best`. Use one of `peskin4`"),
        ("interfaces.0.inside=under", "interfaces.0.inside = \"under\": there is no choice `under`. Use `"),
        ("droplets.0.centre=[1.0, 2.0, 3.0]", "droplets.0.centre = [1.0, 2.0, 3.0]: this list has 3 entries. Give 2"),
        ("droplets.0.centre=[1.0]", "centre = [1.0]: the length 1 cannot be used. Use a list of length 2"),
        (
            "region.box.lengths=[6.0]",
            "region.box.lengths = [6.0]: the length 1 cannot be used. Use two lengths, [x, y]",
        ),
        ("droplets.0.particles=many", "\"none\" for a passive droplet"),
        ("droplets.3.angle=1", "droplets has 1 entries. Use a number from 0 to 1"),
        ("droplets.0.centre.2=1", "droplets.0.centre has 2 entries. Use a number from 0 to 1"),
        ("viscosity.inside=3", "viscosity is a number, so it has no keys below it"),
        ("droplets.first.angle=1", "because droplets has no first. The nearest keys are droplets.0.angle"),
    ] {
        let said = refusal("[[droplets]]\n", assigned);
        assert!(said.contains(words), "{said}");
    }
    assert!(assignment("viscosity").unwrap_err().contains("KEY=VALUE"));
    assert!(assignment("droplets=[").unwrap_err().contains("a value as in a scene file"));
    // What belongs together is told when all of it is there.
    let mut scene = scene("");
    set(&mut scene, "region.channel.width", Value::Float(3.0)).unwrap();
    assert!(format!("{:#}", setup_of(&scene).unwrap_err()).contains("length"));
}

/// Files are read after the assignments, so that these choose the file and the outline in it.
#[test]
fn assignments_choose_files_and_their_outlines() {
    let directory = std::env::temp_dir().join(format!("motile-keys-{}", std::process::id()));
    fs::create_dir_all(&directory).unwrap();
    let square = |name: &str, side: f64| format!("<path id='{name}' d='M0 0H{side}V{side}H0Z'/>");
    let drawn =
        format!("<svg xmlns='http://www.w3.org/2000/svg'>{}{}</svg>", square("small", 2.0), square("large", 4.0));
    fs::write(directory.join("cells.svg"), drawn).unwrap();
    fs::write(directory.join("other.csv"), "0,0\n6,0\n6,6\n0,6\n").unwrap();
    let path = directory.join("scene.toml");
    let outline = "shape.outline = { file = \"cells.svg\", name = \"small\", rounding = 0.5 }";
    fs::write(&path, format!("region = \"plane\"\n[[droplets]]\nparticles = \"none\"\n{outline}\n")).unwrap();
    let area = |assigned: &[String]| -> Result<f64> {
        let assigned: Vec<_> = assigned.iter().map(|text| assignment(text).unwrap()).collect();
        Ok(scene_of(&path, &assigned)?.outlines()?[0].area)
    };
    // A square whose corners are rounded with radius r lacks (4 - π) r².
    let exact = |side: f64| side * side - (4.0 - std::f64::consts::PI) * 0.25;
    let file = |name: &str| format!("droplets.0.shape.outline.file={:?}", directory.join(name));
    for (assigned, side) in [
        (vec![], 2.0),
        (vec!["droplets.0.shape.outline.name=large".to_owned()], 4.0),
        (vec![file("cells.svg"), "droplets.0.shape.outline.name=large".to_owned()], 4.0),
    ] {
        let found = area(&assigned).unwrap();
        assert!((found / exact(side) - 1.0).abs() < 1e-6, "{assigned:?}: {found}");
    }
    let missing = format!("{:#}", area(&[file("nothing.csv")]).unwrap_err());
    assert!(missing.contains("nothing.csv"), "{missing}");
    fs::remove_dir_all(directory).unwrap();
}
