use super::*;
use motile::prelude::*;

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
    for (rows, start) in rows.iter().zip(at_start) {
        assert_eq!(rows.records().records()[0].observables.velocity, start);
    }
}
