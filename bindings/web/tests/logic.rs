//! Logic of the page, on the host.

use motile::base::{Region, Vec2};
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};
use motile_web::code::Way;
use motile_web::concise::concise;
use motile_web::knob::Knob;
use motile_web::live::Live;
use motile_web::preset::PRESETS;
use motile_web::{branch, branch::Line, dust::Dust, frame, text};

fn small() -> Setup {
    Setup {
        method: Method::Integral(IntegralMethod { nodes: 24, elements: 48 }),
        droplets: vec![DropletSetup::active(-3.0)],
        ..Setup::default()
    }
}

fn preset(name: &str) -> Setup {
    let found = PRESETS.iter().find(|preset| preset.name == name).expect("a preset");
    Setup::from_toml(found.scene).expect("a scene")
}

#[test]
fn every_preset_is_a_scene_and_its_short_text_is_the_same_one() {
    for one in PRESETS {
        let setup = Setup::from_toml(one.scene).unwrap_or_else(|error| panic!("{}: {error}", one.name));
        let text = concise(&setup).expect("a text");
        assert_eq!(Setup::from_toml(&text).expect("a scene"), setup, "{}:\n{text}", one.name);
        let words: usize = one.scene.lines().filter(|line| !line.starts_with('#')).map(str::len).sum();
        assert!(text.len() < words + 80, "{}:\n{text}", one.name);
    }
}

#[test]
fn scene_files_of_the_repository_stay_the_same_too() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../examples/scenes");
    let (mut count, mut refused) = (0, 0);
    for entry in std::fs::read_dir(folder).expect("the folder") {
        let given = std::fs::read_to_string(entry.expect("a file").path()).expect("a text");
        let setup = match Setup::from_toml(&given) {
            Ok(setup) => setup,
            // Built alone, the page has no droplets without symmetry, and says so.
            Err(error) => {
                assert!(
                    error.to_string().contains("without symmetry, which this program was built without"),
                    "{error}"
                );
                refused += 1;
                continue;
            }
        };
        let text = concise(&setup).expect("a text");
        assert_eq!(Setup::from_toml(&text).expect("a scene"), setup, "{text}");
        assert!(text.len() < given.len(), "{text}");
        count += 1;
    }
    assert!(count > 8 && refused < 5, "{count} scenes, {refused} refused");
}

#[test]
fn the_default_scene_is_one_word_and_nothing_is_left_out_that_matters() {
    assert_eq!(concise(&Setup::default()).expect("a text"), "[[droplets]]\n");
    assert_eq!(
        concise(&small()).expect("a text").lines().collect::<Vec<_>>(),
        ["method.integral = { nodes = 24, elements = 48 }", "", "[[droplets]]", "particles.activity = -3.0",]
    );
}

#[test]
fn programs_hold_the_scene() {
    let setup = preset("meeting");
    for (name, way) in Way::NAMES {
        let text = way.text(&setup, 12.5).expect("a text");
        let (_, rest) = text.split_once(["\n\"", "'\n", "\n"][0]).unwrap_or(("", &text));
        assert!(text.contains("12.5") && !rest.is_empty(), "{name}: {text}");
        let scene = concise(&setup).expect("a scene");
        assert!(text.contains(&scene), "{name}: {text}");
    }
    assert!(Way::Command.text(&preset("sixteen"), 1.0).expect("a text").contains("motile -- run scene.toml"));
    assert!(Way::named("fortran").is_err());
}

#[test]
fn steps_are_those_of_a_run() {
    let mut built = small().build().expect("a scene");
    built.scene.run(2.0).go().expect("a run");
    let expected = built.scene.observe(built.droplets[0]).expect("observables").speed();
    let mut live = Live::new(small()).expect("a scene");
    while live.step(Some(2.0)).expect("a step") {}
    assert_eq!((live.time(), live.steps()), (2.0, built.scene.steps()));
    assert_eq!(live.speed(0).expect("a flow"), Some(expected));
    assert!(!live.step(Some(2.0)).expect("no step"));
    assert_eq!(live.speed(1).expect("none"), None);
    // One row at the start and after each tenth.
    assert_eq!(live.records(), 21);
    let (series, csv) = (live.series(0), live.csv());
    assert_eq!(series.len(), 21 * 4);
    assert!(series.iter().all(|value| value.is_finite()));
    let mut lines = csv.lines();
    assert!(lines.next().expect("a head").starts_with("time,x,y,"));
    assert_eq!(lines.count(), 21);
    assert_eq!(live.series(20), series[80..]);
}

#[test]
fn tables_of_several_droplets_say_which() {
    let mut setup = small();
    setup.region = Region::Box { lengths: [8.0, 4.0] };
    setup.droplets[0].centre = [-2.0, 0.0];
    setup.droplets.push(DropletSetup { centre: [2.0, 0.0], ..DropletSetup::active(-2.0) });
    let live = Live::new(setup).expect("a scene");
    let csv = live.csv();
    let lines: Vec<&str> = csv.lines().collect();
    assert!(lines[0].starts_with("time,droplet,x,"), "{csv}");
    assert!(lines[1].starts_with("0,0,") && lines[2].starts_with("0,1,"), "{csv}");
    let place = |line: &str| line.split(',').nth(2).and_then(|x| x.parse::<f64>().ok()).expect("a number");
    assert!((place(lines[1]) + 2.0).abs() < 1e-12 && (place(lines[2]) - 2.0).abs() < 1e-12, "{csv}");
    assert_eq!(live.series(0).len(), 7);
}

#[test]
fn sliders_act_on_the_running_scene_and_on_its_text() {
    let mut live = Live::new(small()).expect("a scene");
    while live.step(Some(1.0)).expect("a step") {}
    let before = live.steps();
    for (knob, value) in
        [(Knob::Activity, -4.0), (Knob::ViscosityRatio, 2.0), (Knob::Diffusion, 0.2), (Knob::Size, 7.0)]
    {
        live.turn(knob, value).unwrap_or_else(|error| panic!("{knob:?}: {error}"));
        assert!((knob.value(live.described()).expect("a value") - value).abs() < 1e-12, "{knob:?}");
    }
    assert_eq!((live.time(), live.steps()), (1.0, before));
    for _ in 0..5 {
        live.step(None).expect("a step");
    }
    let text = concise(live.described()).expect("a text");
    for line in ["region.box.lengths = [7.0, 7.0]", "viscosity = 200.0", "activity = -4.0", "diffusion = 0.2"] {
        assert!(text.contains(line), "{text}");
    }
    // Boxes too small for the droplet, activities beyond the excluded volume: said, and nothing has changed.
    let refused = live.turn(Knob::Size, 1.5).expect_err("no room");
    assert!(!refused.message.is_empty());
    assert!(live.turn(Knob::Diffusion, f64::NAN).expect_err("no number").key.is_some());
    assert_eq!(concise(live.described()).expect("a text"), text);
    live.step(None).expect("a step");
}

/// Sliders at their ends: the scene goes on, or says why not and is what it was.
#[test]
fn sliders_at_their_ends_leave_every_preset_running() {
    for preset in PRESETS {
        let setup = Setup::from_toml(preset.scene).expect("a scene");
        for (name, knob) in Knob::NAMES {
            let (ends, _) = knob.range(&setup);
            if knob.value(&setup).is_none() {
                continue;
            }
            for value in ends {
                let mut live = Live::new(setup.clone()).expect("a scene");
                let before = concise(live.described()).expect("a text");
                match live.turn(knob, value) {
                    Ok(()) => assert!((knob.value(live.described()).expect("a value") - value).abs() < 1e-9, "{name}"),
                    Err(refused) => {
                        assert!(!refused.message.is_empty(), "{}, {name} = {value}", preset.name);
                        assert_eq!(concise(live.described()).expect("a text"), before, "{name} = {value}");
                    }
                }
                let stepped = live.step(None);
                assert!(stepped.is_ok_and(|more| more), "{}, {name} = {value}", preset.name);
                assert!(live.speed(0).expect("a flow").is_some_and(f64::is_finite), "{}, {name}", preset.name);
            }
        }
    }
}

#[test]
fn droplets_stay_between_walls() {
    for (name, away) in [("channel", [0.0, 1.5]), ("channel", [0.0, 40.0]), ("constriction", [0.0, 3.0])] {
        let mut live = Live::new(preset(name)).expect("a scene");
        let before = live.speed(0).expect("a flow");
        let refused = live.drag(0, away.into()).expect_err("a wall");
        assert!(!refused.message.is_empty(), "{name}");
        assert_eq!(live.speed(0).expect("a flow"), before, "{name}");
        live.step(None).expect("a step");
    }
    let mut live = Live::new(preset("channel")).expect("a scene");
    assert!(live.drag(0, Vec2::new(f64::NAN, 0.0)).is_err());
    // In a tube on its axis, wherever the pointer goes.
    let mut tube = Live::new(preset("tube")).expect("a scene");
    tube.drag(0, Vec2::new(0.3, 0.4)).expect("room");
    assert_eq!(tube.droplet_at(Vec2::new(1.2, 0.1)), Some(0));
    tube.step(None).expect("a step");
}

#[test]
fn several_droplets_keep_their_ratios() {
    let meeting = preset("meeting");
    let turned = Knob::ViscosityRatio.turned(&meeting, 2.0).expect("a scene");
    assert_eq!(
        turned.droplets.iter().map(|droplet| droplet.viscosity).collect::<Vec<_>>(),
        [Some(200.0), Some(1000.0)]
    );
    let sixteen = preset("sixteen");
    let turned = Knob::Activity.turned(&sixteen, -1.75).expect("a scene");
    let activities: Vec<f64> = turned.placed().expect("droplets").droplets.iter().map(DropletSetup::activity).collect();
    assert!(activities.len() == 16 && activities.iter().all(|a| (-2.0..=-1.5).contains(a)), "{activities:?}");
    // From none there are no ratios to keep.
    let none = Knob::Activity.turned(&sixteen, 0.0).expect("a scene");
    let again = Knob::Activity.turned(&none, -3.0).expect("a scene");
    assert_eq!(Knob::Activity.value(&again), Some(-3.0));
    // Droplets at places that were found for a box, and walls of their own, do not follow.
    assert!(Knob::Size.value(&sixteen).is_none() && Knob::Size.value(&preset("constriction")).is_none());
    assert!(Knob::Size.turned(&sixteen, 9.0).is_err());
    assert_eq!(Knob::Size.label(&preset("channel")), "Channel width");
}

/// The text that a reader typed keeps its comments, and is the scene with the slider's value.
#[test]
fn sliders_change_typed_texts() {
    let typed = "# mine\nregion.box.lengths = [8, 6.0] # wide\n\n[[droplets]]\n# left\ncentre = [-2, 0.0]\n\
                 particles.activity = -4\n[[droplets]]\ncentre = [2.0, 0.0]\nviscosity = 500.0\n";
    for (knob, value, expected) in [
        (
            Knob::Activity,
            -2.0,
            // The second droplet has the activity of the defaults.
            typed.replace("activity = -4\n[[droplets]]", "activity = -2.0\n[[droplets]]\nparticles.activity = -1.0"),
        ),
        (Knob::Size, 10.0, typed.replace("[8, 6.0]", "[10.0, 7.5]")),
        (
            Knob::ViscosityRatio,
            0.51,
            typed.replace("[[droplets]]\n# left", "[[droplets]]\nviscosity = 51.0\n# left").replace("500.0", "255.0"),
        ),
    ] {
        assert_eq!(text::turned(typed, knob, value).expect("a text"), expected, "{knob:?}");
    }
    // An interior as viscous as the fluid around it.
    let viscous = typed.replace("# left", "viscosity = 300.0");
    let equal = text::turned(&viscous, Knob::ViscosityRatio, 1.0).expect("a text");
    assert!(equal.contains("viscosity = 100.0") && equal.contains("viscosity = 166.67"), "{equal}");
    assert!(text::turned("no scene", Knob::Activity, -2.0).is_err());
    assert!(text::turned("", Knob::Activity, -2.0).is_err());
    // Every scene with every slider.
    for preset in PRESETS {
        let setup = Setup::from_toml(preset.scene).expect("a scene");
        for (name, knob) in Knob::NAMES {
            let Some(value) = knob.value(&setup) else { continue };
            let value = if knob == Knob::Size { value + 1.0 } else { 0.5 * value };
            let turned = text::turned(preset.scene, knob, value).expect("a text");
            let [read, wanted] =
                [Setup::from_toml(&turned).expect("a scene"), knob.turned(&setup, value).expect("a scene")];
            assert_eq!(read, wanted, "{}, {name}: {turned}", preset.name);
            // Suspensions have no lines for their droplets.
            let kept = preset.name != "sixteen" || knob == Knob::Activity;
            assert_eq!(turned.starts_with('#'), kept, "{}, {name}: {turned}", preset.name);
        }
    }
}

#[test]
fn sliders_write_round_numbers() {
    let [swimmer, sixteen] = [preset("swimmer"), preset("sixteen")];
    let viscosity = |ratio| Knob::ViscosityRatio.turned(&swimmer, ratio).expect("a scene").droplets[0].viscosity;
    assert_eq!([2.51, 1.13, 0.7].map(viscosity), [Some(251.0), Some(113.0), Some(70.0)]);
    let turned = Knob::Activity.turned(&sixteen, -2.8).expect("a scene");
    assert!(concise(&turned).expect("a text").contains("activity = [-3.0545, -2.5455]"));
    assert_eq!(Knob::Activity.value(&turned), Some(-2.8));
}

/// With no activity at once, a crowd pushes the surface apart until it has spread; the doubt goes by itself and with
/// the next change.
#[test]
fn doubts_go_with_their_cause() {
    let crowded = |end: f64| {
        let mut live = Live::new(preset("swimmer")).expect("a scene");
        while live.step(Some(6.0)).expect("a step") {}
        assert!(live.doubts().is_empty(), "{:?}", live.doubts());
        live.turn(Knob::Activity, 0.0).expect("a scene");
        while live.step(Some(end)).expect("a step") {}
        let [doubt] = live.doubts() else { panic!("{:?}", live.doubts()) };
        assert_eq!(doubt.warning.cause, "tension negative");
        (doubt.present, doubt.until, live)
    };
    let (present, until, mut live) = crowded(6.2);
    assert!(present && (until - 6.2).abs() < 0.06, "{until}");
    live.turn(Knob::Activity, -3.0).expect("a scene");
    assert!(live.doubts().is_empty());
    let (present, until, live) = crowded(20.0);
    assert!(!present && until < 15.0, "{until}");
    assert_eq!(live.time(), 20.0);
}

#[test]
fn times_that_have_gone_are_the_end_and_scenes_have_bodies() {
    let mut live = Live::new(small()).expect("a scene");
    while live.step(Some(1.0)).expect("a step") {}
    for end in [0.5, -3.0, f64::NEG_INFINITY] {
        assert!(!live.step(Some(end)).expect("no step"), "{end}");
    }
    assert!(live.step(None).expect("a step"));
    for text in ["", "# nothing", "viscosity = 2.0"] {
        let refused = Live::new(Setup::from_toml(text).expect("a text")).expect_err("no droplet");
        assert!(refused.message.contains("has no droplet"), "{refused}");
    }
}

#[test]
fn sixteen_go_on_with_another_activity() {
    let mut live = Live::new(preset("sixteen")).expect("a scene");
    live.step(None).expect("a step");
    live.turn(Knob::Activity, -2.0).expect("a scene");
    live.turn(Knob::ViscosityRatio, 3.0).expect("a scene");
    assert!(live.step(None).expect("a step"));
    assert_eq!(live.described().suspension.len(), 1);
}

#[test]
fn droplets_are_found_and_moved_with_what_is_in_them() {
    let mut live = Live::new(preset("nucleus")).expect("a scene");
    assert_eq!(live.droplet_at(Vec2::new(0.5, 0.5)), Some(0));
    assert_eq!(live.droplet_at(Vec2::new(1.5, 0.5)), None);
    live.drag(0, Vec2::new(2.0, 1.0)).expect("room");
    assert_eq!(live.droplet_at(Vec2::new(2.5, 1.5)), Some(0));
    live.step(None).expect("a step");
    assert!(live.drag(1, Vec2::X).is_err());
    // In a box every image is the droplet.
    let mut boxed = Live::new(small()).expect("a scene");
    assert_eq!(boxed.droplet_at(Vec2::new(6.2, -5.9)), Some(0));
    // Onto itself by a whole period it goes, onto another one it does not.
    boxed.drag(0, Vec2::new(6.0, 0.0)).expect("room");
    let mut meeting = Live::new(preset("meeting")).expect("a scene");
    let refused = meeting.drag(0, Vec2::new(3.5, 0.5)).expect_err("no room");
    assert!(refused.message.contains("overlap"), "{refused}");
    meeting.step(None).expect("a step");
}

/// The derivative of the tension along the interface against that of the law of the default settings (2.39), (2.41).
#[test]
fn arrows_are_the_derivative_of_the_tension() {
    let error = |elements: usize| {
        let mut setup = small();
        setup.method = Method::Integral(IntegralMethod { nodes: 24, elements });
        let mut live = Live::new(setup).expect("a scene");
        let found = live.tension_gradients();
        let seen = live.outlined().expect("shapes");
        assert_eq!(found.len(), seen.droplets[0].markers.len());
        // At the start c = 100 (1 - cos theta). B is a smooth step of height 10 at c = 200, of steepness 20.
        let law = |marker: &Vec2| {
            let (sine, cosine) = (marker.y / marker.length(), marker.x / marker.length());
            let x: f64 = 20.0 * (100.0 - 100.0 * cosine) / 200.0;
            let step = 10.0 - 10.0 * 20.0_f64.sinh() / (20.0_f64.cosh() + x.cosh());
            (3.0 - step) * 100.0 * sine
        };
        let difference = |(marker, slope): (&Vec2, &f32)| (f64::from(*slope) - law(marker)).abs();
        seen.droplets[0].markers.iter().zip(&found).map(difference).fold(0.0, f64::max) / 300.0
    };
    let errors = [96, 192].map(error);
    assert!(errors[1] < 0.02 && errors[1] < 0.6 * errors[0], "{errors:?}");
}

#[test]
fn pictures_have_all_shapes_and_tracers_stay_in_sight() {
    for (name, droplets) in [("meeting", 2), ("constriction", 1), ("nucleus", 1), ("tube", 1)] {
        let mut live = Live::new(preset(name)).expect("a scene");
        let seen = live.seen().expect("a flow");
        assert_eq!(seen.droplets.len(), droplets, "{name}");
        let outlined = live.outlined().expect("shapes");
        let list = frame::shapes(&seen);
        assert_eq!(list.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), {
            frame::shapes(&outlined).iter().map(|v| v.to_bits()).collect::<Vec<_>>()
        });
        let (mut at, mut kinds) = (0, Vec::new());
        while at < list.len() {
            kinds.push(list[at] as u8);
            at += 2 + 3 * list[at + 1] as usize;
        }
        assert_eq!(kinds.iter().filter(|kind| **kind == 0).count(), droplets, "{name}");
        assert_eq!(kinds.contains(&2), ["constriction", "nucleus"].contains(&name), "{name}: {kinds:?}");
        let lines = frame::lines(&seen, seen.raster.size()).expect("streamlines");
        assert!(lines.len() > 100, "{name}: {}", lines.len());
    }
    let mut live = Live::new(small()).expect("a scene");
    let mut dust = Dust::new(50);
    let view = [Vec2::splat(-3.0), Vec2::splat(3.0)];
    dust.see(&live.seen().expect("a flow")).expect("samples");
    for _ in 0..600 {
        dust.drift(0.5, view);
    }
    let streaks = dust.streaks();
    assert_eq!(streaks.len(), 200);
    assert!(streaks.chunks(4).all(|s| s[0].abs() <= 3.0 && s[1].abs() <= 3.0 && s[2].is_finite()));
    let fastest = streaks.chunks(4).map(|s| s[2].hypot(s[3])).fold(0.0, f32::max);
    assert!(fastest > 0.01, "{fastest}");
    assert!(live.svg().expect("a picture").starts_with("<svg"));
}

#[test]
fn the_map_has_the_speeds_of_runs() {
    assert!(branch::mapped(&preset("meeting")).is_none() && branch::mapped(&preset("constriction")).is_none());
    assert!(branch::mapped(&preset("nucleus")).is_none() && branch::mapped(&preset("channel")).is_some());
    // In a box, strong swimmers turn; in the plane they do not.
    let setup = Setup { region: Region::Box { lengths: [6.0, 6.0] }, ..preset("swimmer") };
    let mut points = Vec::new();
    branch::follow(&setup, |point| {
        points.push(point);
        true
    })
    .expect("a branch");
    let (at_rest, mut points): (Vec<_>, Vec<_>) = points.into_iter().partition(|point| point.line == Line::Rest);
    points.sort_by(|a, b| a.activity.total_cmp(&b.activity));
    // Rest is no longer stable where the swimmers begin; weak ones of them are stable, strong ones turn.
    let [_, weak, strong, _] = at_rest.as_slice() else { panic!("{at_rest:?}") };
    let slowest = points.last().expect("a swimmer");
    assert!(weak.stable && !strong.stable && (weak.activity / slowest.activity - 1.0).abs() < 0.01, "{at_rest:?}");
    assert!(slowest.stable && !points[0].stable, "{points:?}");
    assert!(points.len() > 12 && points.first().is_some_and(|point| point.activity < -7.0), "{}", points.len());
    let near = points.windows(2).find(|pair| pair[0].activity <= -3.0 && pair[1].activity >= -3.0).expect("about -3");
    let part = (-3.0 - near[0].activity) / (near[1].activity - near[0].activity);
    let of_map = near[0].speed + part * (near[1].speed - near[0].speed);
    let mut live = Live::new(setup).expect("a scene");
    while live.step(Some(40.0)).expect("a step") {}
    let of_run = live.speed(0).expect("a flow").expect("a droplet");
    assert!((of_map / of_run - 1.0).abs() < 0.01, "{of_map} {of_run}");
}

/// In the plane a droplet at rest is stable up to a Peclet number |zeta_dmu| c0 R0/(2 eta D) of 2.
#[test]
fn rest_is_stable_up_to_a_peclet_number_of_two() {
    let map = branch::mapped(&Setup { region: Region::Plane, ..preset("swimmer") }).expect("a map");
    let particles = map.droplets[0].particles.as_ref().expect("particles");
    let exact = -4.0 * map.viscosity * particles.diffusion / particles.concentration;
    let points = branch::rest(&map, -2.0, -7.5).expect("a spectrum");
    let [_, weak, strong, _] = points.as_slice() else { panic!("{points:?}") };
    assert!(weak.stable && !strong.stable && (strong.activity - weak.activity).abs() < 1e-3, "{points:?}");
    assert!((weak.activity - exact).abs() < 1e-3, "{points:?}, {exact}");
}

#[test]
fn errors_name_key_value_and_remedy() {
    let refused = motile_web::Refusal::from(Setup::from_toml("viscosity = -1.0").expect_err("negative"));
    assert_eq!((refused.key.as_deref(), refused.value.as_deref()), (Some("viscosity"), Some("-1")));
    assert!(refused.remedy.is_some());
    let refused = motile_web::Refusal::from(Setup::from_toml("viscosty = 1.0").expect_err("misspelt"));
    assert!(refused.message.contains("unknown key `viscosty`"), "{refused}");
}
