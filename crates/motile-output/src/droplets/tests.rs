use motile::prelude::*;
use motile::setup::{DropletSetup, ExchangeSetup};

use super::*;

#[test]
fn names_that_are_missing_go_behind_the_ones_that_they_follow() {
    let mut names = Vec::new();
    for others in [&["time", "x", "gap"][..], &["time", "x", "inside", "mean", "gap"], &["time", "gap", "last"], &[]] {
        merge(&mut names, others);
    }
    assert_eq!(names, ["time", "x", "inside", "mean", "gap", "last"]);
}

/// Of two droplets, either the first or the second has particles inside.
#[test]
fn droplets_with_and_without_exchange_are_in_one_table() {
    let path = std::env::temp_dir().join(format!("droplets-with-exchange-{}.csv", std::process::id()));
    let plain = DropletSetup { centre: [-1.5, 0.0], ..DropletSetup::active(-2.0) };
    let mut exchanging = DropletSetup { centre: [1.5, 0.0], ..DropletSetup::active(-2.0) };
    let exchange = ExchangeSetup::new(0.2, 0.5);
    exchanging.particles.as_mut().unwrap().exchange = Some(exchange);
    for droplets in [vec![plain.clone(), exchanging.clone()], vec![exchanging, plain]] {
        let exchanges = [0, 1].map(|k: usize| droplets[k].particles.as_ref().unwrap().exchange.is_some());
        let method = Method::Integral(IntegralMethod { nodes: 24, elements: 48 });
        let Built { mut scene, .. } = Setup { method, droplets, ..Setup::default() }.build().unwrap();
        let mut rows = DropletsCsv::create(&path, scene.system_mut()).unwrap();
        scene.run(0.02).observe(Every::Time(0.01), &mut rows).go().unwrap();
        let table = rows.table();
        assert_eq!(table.rows().len(), 3 * 2);
        for column in ["x", "speed", "perimeter"] {
            assert!(table.curve("droplet", column).unwrap().iter().all(|(_, value)| value.is_finite()), "{column}");
        }
        // Of the observables some belong to the droplet with exchange alone.
        let text = std::fs::read_to_string(&path).unwrap();
        let empty = |line: &str| line.split(',').filter(|field| field.is_empty()).count();
        let [first, second] = [1, 2].map(|line| empty(text.lines().nth(line).unwrap()));
        assert_eq!([first < second, second < first], exchanges, "{text}");
    }
    std::fs::remove_file(path).unwrap();
}
