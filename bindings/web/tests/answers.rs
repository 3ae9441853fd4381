//! Answers of the page to its questions: each number that they state is one of a table, or of a run here.

use motile::base::{Region, Vec2};
use motile::setup::Setup;
use motile_web::branch;
use motile_web::knob::{Knob, STEP};
use motile_web::live::Live;
use motile_web::preset::PRESETS;

fn lesson(name: &str) -> serde_json::Value {
    let all: serde_json::Value = serde_json::from_str(include_str!("../site/lessons.json")).expect("JSON");
    all.get(name).unwrap_or_else(|| panic!("no question about {name}")).clone()
}

/// Asserts that the answer about a scene states each of these words.
fn states(name: &str, words: &[&str]) {
    let answer = lesson(name)["answer"].as_str().expect("an answer").to_owned();
    for word in words {
        assert!(answer.contains(word), "the answer about {name} does not state {word}: {answer}");
    }
}

fn live(name: &str) -> Live {
    let found = PRESETS.iter().find(|preset| preset.name == name).expect("a preset");
    Live::new(Setup::from_toml(found.scene).expect("a scene")).expect("a scene")
}

fn run(live: &mut Live, end: f64) {
    while live.step(Some(end)).expect("a step") {}
}

fn speed(live: &mut Live, droplet: usize) -> f64 {
    live.speed(droplet).expect("a flow").expect("a droplet")
}

/// Asserts that a slider of a scene reaches these values.
fn reaches(name: &str, knob: Knob, values: &[f64]) {
    let live = live(name);
    let ([low, high], logarithmic) = knob.range(live.described());
    for value in values {
        let steps = value / STEP;
        let on_scale = !logarithmic && (steps - steps.round()).abs() < 1e-9;
        assert!(on_scale && (low..=high).contains(value), "{name}: no slider reaches {value}");
    }
}

/// Rows of a table whose first cells are these.
fn rows<'t>(table: &'t str, first: &str) -> Vec<Vec<&'t str>> {
    table.lines().filter(|line| line.starts_with(first)).map(|line| line.split(',').collect()).collect()
}

fn number(cell: &str) -> f64 {
    cell.parse().unwrap_or_else(|_| panic!("{cell} is no number"))
}

#[test]
fn every_scene_has_a_question_with_an_answer() {
    for preset in PRESETS {
        let lesson = lesson(preset.name);
        assert!(lesson["question"].as_str().is_some_and(|text| text.ends_with('?')), "{}", preset.name);
        assert!(lesson["answer"].as_str().is_some_and(|text| text.len() > 60), "{}", preset.name);
    }
}

#[test]
fn a_swimmer_stops_at_its_threshold() {
    states("swimmer", &["−0.4 ", "4 η D / c0 = 0.4", "0.18 µm/s"]);
    reaches("swimmer", Knob::Activity, &[-3.0, -0.4, 0.0]);
    let mut live = live("swimmer");
    assert_eq!(live.described().region, Region::Plane);
    let map = branch::mapped(live.described()).expect("a map");
    let points = branch::rest(&map, -2.0, -7.5).expect("a spectrum");
    assert!((points[1].activity + 0.4).abs() < 1e-3 && points[1].stable && !points[2].stable, "{points:?}");
    run(&mut live, 20.0);
    let speed = speed(&mut live, 0);
    assert!((speed - 0.18).abs() < 0.005, "{speed}");
}

#[test]
fn the_less_viscous_droplet_is_faster_and_they_do_not_touch() {
    states("meeting", &["0.19 µm/s", "0.09 µm/s", "t = 3 ", "at least 0.1 wide (1 µm)"]);
    let mut live = live("meeting");
    run(&mut live, 3.0);
    let speeds = [0, 1].map(|droplet| speed(&mut live, droplet));
    assert!((speeds[0] - 0.19).abs() < 0.005 && (speeds[1] - 0.09).abs() < 0.005, "{speeds:?}");
    // While they slide past each other, the gap stays open.
    let mut narrowest = f64::INFINITY;
    for time in 6..20 {
        run(&mut live, f64::from(time));
        let seen = live.outlined().expect("shapes");
        let [left, right] = seen.droplets.as_slice() else { panic!("{} droplets", seen.droplets.len()) };
        let period = motile::base::boxes::nearest_image(right.centroid - left.centroid, live.domain().periods)
            - (right.centroid - left.centroid);
        let gap = |a: &Vec2| right.markers.iter().map(|b| a.distance(*b + period)).fold(f64::INFINITY, f64::min);
        let gap = left.markers.iter().map(gap).fold(f64::INFINITY, f64::min);
        narrowest = narrowest.min(gap);
    }
    assert!(narrowest > 0.1 && narrowest < 0.11, "{narrowest}");
}

#[test]
fn periods_in_the_channel_are_those_of_limit_cycles() {
    states("channel", &["50 time units (8 minutes)", "85 time units (14 minutes)", "stronger than −2.6"]);
    reaches("channel", Knob::Activity, &[-5.0, -3.0, -2.6]);
    let cycles = include_str!("../../../docs/tables/steady-cycle.csv");
    for (activity, period) in [("-5.00000", 50.0), ("-3.02192", 85.0)] {
        let rows = rows(cycles, activity);
        assert!(rows.len() == 1 && (number(rows[0][2]) - period).abs() < 0.5, "{rows:?}");
    }
    let regimes = include_str!("../../../docs/tables/steady-regimes.csv");
    let rows = rows(regimes, "10,12,5,");
    assert!(rows[0].iter().any(|cell| cell.contains("-2.5972")), "{rows:?}");
    // The same channel and droplet as in the tables.
    let live = live("channel");
    let Region::Channel { length, width, .. } = live.described().region else { panic!("no channel") };
    assert_eq!([length, width, live.described().droplets[0].activity()], [12.0, 5.0, -5.0]);
}

#[test]
fn a_nucleus_makes_circles_of_that_radius() {
    states("nucleus", &["2.8 droplet radii (28 µm)", "175 time units (29 minutes)"]);
    let mut live = live("nucleus");
    let mut course = Vec::new();
    for end in [60.0, 60.5, 100.0, 100.5] {
        run(&mut live, end);
        course.push(live.outlined().expect("shapes").droplets[0].centroid);
    }
    let ways = [course[1] - course[0], course[3] - course[2]];
    let (turned, speed) = (ways[0].angle_to(ways[1]) / 40.0, speed(&mut live, 0));
    let (radius, round) = (speed / turned.abs(), std::f64::consts::TAU / turned.abs());
    assert!((radius - 2.8).abs() < 0.1 && (round - 175.0).abs() < 6.0, "{radius} {round}");
}

#[test]
fn sixteen_are_as_fast_as_one_and_do_not_line_up() {
    states("sixteen", &["0.17 µm/s", "do not line up"]);
    let mut live = live("sixteen");
    let mut means = Vec::new();
    for time in [8.0, 12.0, 16.0] {
        let places = |live: &mut Live| -> Vec<Vec2> {
            live.outlined().expect("shapes").droplets.iter().map(|droplet| droplet.centroid).collect()
        };
        run(&mut live, time - 0.1);
        let before = places(&mut live);
        run(&mut live, time);
        let ways: Vec<Vec2> = places(&mut live).iter().zip(&before).map(|(after, before)| *after - *before).collect();
        assert_eq!(ways.len(), 16);
        means.push(ways.iter().map(|way| way.length()).sum::<f64>() / 1.6);
        let order = ways.iter().map(|way| way.normalize()).sum::<Vec2>().length() / 16.0;
        // Random directions have a mean of 0.22, with a deviation of 0.12.
        assert!(order < 0.5, "{order} at {time}");
    }
    let mean = means.iter().sum::<f64>() / 3.0;
    assert!((mean - 0.17).abs() < 0.01, "{means:?}");
    assert!(live.doubts().is_empty(), "{:?}", live.doubts());
}

#[test]
fn a_droplet_passes_the_constriction() {
    states("constriction", &["before t = 60 (10 minutes)", "14.1 µm", "13.6 µm", "27 minutes"]);
    assert!(lesson("constriction")["question"].as_str().is_some_and(|text| text.contains("17 µm wide")));
    let mut live = live("constriction");
    assert!(motile_web::concise::concise(live.described()).expect("a text").contains("throat = 1.7"));
    run(&mut live, 60.0);
    let place = live.outlined().expect("shapes").droplets[0].centroid;
    assert!(place.x > 3.0, "{place:?}");
    assert!(live.doubts().is_empty(), "{:?}", live.doubts());
    let rows = rows(include_str!("../../../docs/tables/tubes-constrictions.csv"), "\"plane, no pressure drop\"");
    let cells: Vec<&str> = rows[0].iter().rev().copied().collect();
    let [_, _, _, passed, not_passed] = cells[..5] else { panic!("{rows:?}") };
    assert_eq!([number(not_passed), number(passed)], [1.36, 1.41]);
}

#[test]
fn narrow_tubes_are_slow() {
    states("tube", &["0.177 µm/s", "0.118 µm/s", "0.039 µm/s", "radius of 1.25"]);
    let table = include_str!("../../../docs/tables/steady-tubes.csv");
    for (radius, speed) in [("2,", 0.177), ("1.5,", 0.118), ("1.25,", 0.039)] {
        let rows = rows(table, radius);
        assert!(rows.len() == 2 && (number(rows[1][2]) - speed).abs() < 5e-4, "{rows:?}");
        // The coarser row shows how far the finer row can be off.
        assert!((number(rows[0][2]) / number(rows[1][2]) - 1.0).abs() < 6e-3, "{rows:?}");
    }
    // The scene of the page lies between the first two.
    let mut live = live("tube");
    run(&mut live, 15.0);
    let before = speed(&mut live, 0);
    assert!(before > 0.118 && before < 0.177, "{before}");
    // The slider gives all three while it runs.
    reaches("tube", Knob::Size, &[2.0, 1.5, 1.25]);
    assert!(lesson("tube")["question"].as_str().is_some_and(|text| text.contains("to 2, to 1.5 and to 1.25")));
    for (radius, end, expected) in [(2.0, 40.0, 0.177), (1.5, 70.0, 0.118), (1.25, 120.0, 0.039)] {
        live.turn(Knob::Size, radius).expect("room");
        run(&mut live, end);
        let found = speed(&mut live, 0);
        assert!((found / expected - 1.0).abs() < 0.015, "{radius}: {found}");
    }
    assert!(live.doubts().is_empty(), "{:?}", live.doubts());
}

/// No scene warns with the settings that it begins with; the tests above look at the others.
#[test]
fn no_preset_warns() {
    for (name, end) in [("swimmer", 40.0), ("meeting", 40.0), ("channel", 60.0), ("nucleus", 40.0), ("tube", 20.0)] {
        let mut live = live(name);
        run(&mut live, end);
        assert!(live.doubts().is_empty(), "{name}: {:?}", live.doubts());
    }
}
