use super::*;
use motile::prelude::*;
use motile::scene::checkpoint::Checkpoint;
use motile::setup::{AnyFlow, ExchangeSetup};

#[test]
fn the_rows_are_those_of_the_droplet_asked_for() {
    let setup = Setup {
        region: Region::Box { lengths: [8.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![
            DropletSetup { centre: [-2.0, 0.0], ..DropletSetup::default() },
            DropletSetup { centre: [2.0, 0.5], angle: 1.0, ..DropletSetup::active(-4.0) },
        ],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let path = |k: usize| std::env::temp_dir().join(format!("motile-rows-{k}-{}.csv", std::process::id()));
    let mut rows: Vec<TrajectoryCsv> =
        (0..2).map(|k| TrajectoryCsv::create(path(k), scene.system_mut(), droplets[k]).unwrap()).collect();
    let at_start = [0, 1].map(|k| scene.observe(droplets[k]).unwrap().velocity);
    assert!((at_start[0] - at_start[1]).length() > 0.01, "{at_start:?}");
    let [first, second] = &mut rows[..] else { unreachable!("there are two") };
    scene.run(0.1).observe(Every::Steps(1), first).observe(Every::Steps(1), second).go().unwrap();
    for (k, (rows, [x, y])) in rows.iter_mut().zip([[-2.0, 0.0], [2.0, 0.5]]).enumerate() {
        rows.finish(scene.system_mut()).unwrap();
        let (time, start) = rows.track()[0];
        assert!(time == 0.0 && (start - Vec2::new(x, y)).length() < 1e-6, "{start}");
        let text = std::fs::read_to_string(path(k)).unwrap();
        assert_eq!(text.lines().count(), rows.table().rows().len() + 1);
        // A box has no walls.
        assert!(text.starts_with("time,x,y,") && !text.contains("gap"));
        std::fs::remove_file(path(k)).unwrap();
    }
    // Without walls heights are those from the first one.
    for (rows, y) in rows.iter().zip([0.0, 0.5]) {
        let (heights, track) = (rows.trajectory().unwrap(), rows.track());
        let origin = track[0].1.y;
        assert!((origin - y).abs() < 1e-6 && track.len() == heights.heights().len());
        assert!(heights.heights().iter().zip(&track).all(|(height, (_, place))| *height == place.y - origin));
    }
    for (rows, start) in rows.iter().zip(at_start) {
        let [x, y] = ["velocity_x", "velocity_y"].map(|name| rows.table().curve("time", name).unwrap()[0].1);
        assert_eq!(Vec2::new(x, y), start);
    }
}

/// A run that goes on in another program leaves the file that it would have left without the break, rows of times that
/// were due and no other.
#[test]
fn a_run_that_was_cut_leaves_the_same_file() {
    let setup = Setup {
        method: Method::Integral(IntegralMethod { nodes: 24, elements: 48 }),
        step: StepSize::Fixed(0.01),
        ..Setup::default()
    };
    let path = |name: &str| std::env::temp_dir().join(format!("motile-cut-{name}-{}.csv", std::process::id()));
    let every = Every::StepAfter(0.035);
    for cut in [0.2, 0.21] {
        let mut texts = Vec::new();
        for (name, ends) in [("whole", vec![0.5]), ("parts", vec![cut, 0.5])] {
            let mut saved: Option<Checkpoint> = None;
            for end in ends {
                let Built { mut scene, droplets, .. } = setup.build().unwrap();
                saved.iter().for_each(|saved| scene.resume(saved).unwrap());
                let mut rows = TrajectoryCsv::create(path(name), scene.system_mut(), droplets[0]).unwrap();
                // Cut as by a signal: what is saved is in the middle of a run to 0.5.
                let mut cut = |system: &mut System<AnyFlow>| {
                    let due = (system.time() - end).abs() < 1e-9 && end < 0.5;
                    if due { Err("cut") } else { Ok(()) }
                };
                let ended = scene.run(0.5).observe(every, &mut rows).observe(Every::Steps(1), &mut cut).go();
                assert_eq!(ended.is_err(), end < 0.5);
                saved = Some(scene.checkpoint(""));
            }
            texts.push(std::fs::read_to_string(path(name)).unwrap());
            std::fs::remove_file(path(name)).unwrap();
        }
        assert_eq!(texts[0], texts[1], "cut at {cut}");
        assert!(texts[0].lines().count() > 14);
    }
}

#[test]
fn a_run_from_the_start_leaves_nothing_of_another_one() {
    let path = std::env::temp_dir().join(format!("motile-again-{}.csv", std::process::id()));
    for x in [0.5, -0.25] {
        let method = Method::Integral(IntegralMethod { nodes: 24, elements: 48 });
        let droplets = vec![DropletSetup { centre: [x, 0.0], ..DropletSetup::default() }];
        let Built { mut scene, droplets, .. } = Setup { method, droplets, ..Setup::default() }.build().unwrap();
        let mut rows = TrajectoryCsv::create(&path, scene.system_mut(), droplets[0]).unwrap();
        scene.run(0.05).observe(Every::Steps(1), &mut rows).go().unwrap();
        rows.finish(scene.system_mut()).unwrap();
        let starts = rows.table().curve("time", "x").unwrap();
        assert!(starts[0].0 == 0.0 && (starts[0].1 - x).abs() < 1e-9 && starts[1].0 > 0.0, "{starts:?}");
    }
    std::fs::remove_file(path).unwrap();
}

/// In the same columns as what a well-mixed inside has.
#[test]
fn what_is_inside_has_its_columns() {
    let inside = |diffusion_inside| {
        let exchange = Some(ExchangeSetup { diffusion_inside, ..ExchangeSetup::new(0.6, 0.4) });
        let particles = Particles { exchange, ..Particles::default() };
        let droplets = vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }];
        let method = Method::Integral(IntegralMethod { nodes: 24, elements: 48 });
        let setup = Setup { method, droplets, step: StepSize::Fixed(0.002), ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        let name = format!("motile-inside-{}-{}.csv", diffusion_inside.is_some(), std::process::id());
        let path = std::env::temp_dir().join(name);
        let mut rows = TrajectoryCsv::create(&path, scene.system_mut(), droplets[0]).unwrap();
        scene.run(0.2).observe(Every::Steps(1), &mut rows).go().unwrap();
        let text = std::fs::read_to_string(&path).unwrap();
        std::fs::remove_file(path).unwrap();
        let column = |name: &str| rows.table().curve("time", name).unwrap();
        let totals: Vec<f64> =
            column("number_inside").iter().zip(column("particle_number")).map(|(a, b)| a.1 + b.1).collect();
        assert!(totals.iter().all(|total| (total / totals[0] - 1.0).abs() < 1e-12), "{totals:?}");
        let flux = column("exchange_flux");
        // The interface gains what binds, by the trapezoidal rule, from the second row on: at the start the field has
        // not yet met the concentration.
        let gained: f64 = flux[1..].windows(2).map(|w| 0.5 * (w[0].1 + w[1].1) * (w[1].0 - w[0].0)).sum();
        let numbers = column("particle_number");
        let gain = numbers.last().unwrap().1 - numbers[1].1;
        assert!((gained - gain).abs() < 5e-3 * gain.abs(), "{diffusion_inside:?} {gained} {gain} {flux:?} {numbers:?}");
        (text.lines().next().unwrap().split(',').count(), numbers.len())
    };
    let (pool, field) = (inside(None), inside(Some(0.5)));
    assert!(pool.0 == field.0 && pool.1 > 2 && field.1 > 2, "{pool:?} {field:?}");
}
