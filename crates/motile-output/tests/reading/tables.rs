//! Tables as CSV files, and summaries as JSON.

use motile::prelude::*;
use motile::setup::{InterfaceSetup, Side};
use motile_output::{CsvTable, DropletsCsv, InterfacesCsv, TrajectoryCsv, suspension::SuspensionCsv};

use crate::Directory;

/// Header and rows of a CSV file; empty fields are not numbers.
fn read(path: &std::path::Path) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut reader = csv::Reader::from_path(path).expect("a table");
    let mut header: Vec<String> = reader.headers().expect("a header").iter().map(str::to_owned).collect();
    header.pop_if(|name| name == "origin");
    let number = |field: &str| if field.is_empty() { f64::NAN } else { field.parse().expect(field) };
    let rows = reader.records().map(|row| row.expect("a row").iter().take(header.len()).map(number).collect());
    let rows = rows.collect();
    (header, rows)
}

#[test]
fn numbers_come_back_bit_by_bit() {
    let directory = Directory::new("table");
    let path = directory.0.join("numbers.csv");
    let mut table = CsvTable::create(&path, &["time", "a value", "z_y"]).unwrap();
    let rows = [[0.0, 1.0 / 3.0, f64::NAN], [1e-300, -2.5e17, std::f64::consts::PI], [0.1, f64::INFINITY, -0.0]];
    rows.iter().for_each(|row| table.push(row).unwrap());
    table.flush().unwrap();
    let (header, found) = read(&path);
    assert_eq!(header, ["time", "a value", "z_y"]);
    for (found, row) in found.iter().zip(rows) {
        let written = row.map(|v| if v.is_finite() { v.to_bits() } else { f64::NAN.to_bits() });
        assert_eq!(found.iter().map(|v| v.to_bits()).collect::<Vec<_>>(), written);
    }
    assert_eq!(found.len(), 3);
}

#[test]
fn a_trajectory_comes_back() {
    let directory = Directory::new("trajectory");
    let Built { mut scene, droplets, .. } = Setup { step: StepSize::Fixed(0.025), ..Setup::default() }.build().unwrap();
    let path = directory.0.join("trajectory.csv");
    let mut rows = TrajectoryCsv::create(&path, scene.system_mut(), droplets[0]).unwrap();
    scene.run(0.5).observe(Every::Time(0.1), &mut rows).go().unwrap();
    rows.finish(scene.system_mut()).unwrap();
    let (header, found) = read(&path);
    let seen = scene.observe(droplets[0]).unwrap();
    let last = found.last().unwrap();
    let value = |name: &str| last[header.iter().position(|known| known == name).expect(name)];
    assert_eq!([value("x"), value("y")], [seen.centroid.x, seen.centroid.y]);
    assert_eq!([value("velocity_x"), value("velocity_y")], [seen.velocity.x, seen.velocity.y]);
    assert_eq!(
        [value("area"), value("perimeter"), value("speed")],
        [seen.area, seen.perimeter, seen.velocity.length()]
    );
    let times: Vec<f64> = found.iter().map(|row| row[0]).collect();
    assert!(crate::near(&times, &[0.0, 0.1, 0.2, 0.3, 0.4, 0.5], 1e-9), "{times:?}");
    assert_eq!(rows.track().last().map(|(time, at)| [*time, at.x, at.y]), Some([last[0], value("x"), value("y")]));
}

/// Rows of all droplets at all times, in a run that goes on from a checkpoint too; a droplet that leaves the box has
/// its centroid outside.
#[test]
fn all_droplets_are_in_one_table() {
    let directory = Directory::new("droplets");
    let setup = Setup {
        region: Region::Box { lengths: [6.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![
            DropletSetup { centre: [2.98, 0.0], ..DropletSetup::active(-6.0) },
            DropletSetup { centre: [0.0, 0.5], angle: 1.0, ..DropletSetup::default() },
        ],
        step: StepSize::Fixed(0.025),
        ..Setup::default()
    };
    let path = directory.0.join("droplets.csv");
    let (mut saved, mut seen) = (None, Vec::new());
    for end in [0.3, 0.6] {
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        saved.iter().for_each(|saved| scene.resume(saved).unwrap());
        let mut rows = DropletsCsv::create(&path, scene.system_mut()).unwrap();
        scene.run(end).observe(Every::Time(0.1), &mut rows).go().unwrap();
        seen = droplets.iter().map(|&droplet| scene.observe(droplet).unwrap()).collect();
        saved = Some(scene.checkpoint(""));
    }
    let (header, found) = read(&path);
    assert_eq!(header[..4], ["time", "droplet", "x", "y"]);
    let column = |name: &str| -> Vec<f64> {
        let index = header.iter().position(|known| known == name).expect(name);
        found.iter().map(|row| row[index]).collect()
    };
    let times: Vec<f64> = (0..14).map(|k| 0.1 * f64::from(k / 2)).collect();
    assert!(crate::near(&column("time"), &times, 1e-9), "{:?}", column("time"));
    assert_eq!(column("droplet"), [0.0, 1.0].repeat(7));
    let [x, y, speed] = ["x", "y", "speed"].map(|name| column(name).split_off(12));
    for (k, seen) in seen.iter().enumerate() {
        assert_eq!([x[k], y[k], speed[k]], [seen.centroid.x, seen.centroid.y, seen.velocity.length()]);
    }
    let first: Vec<f64> = column("x").into_iter().step_by(2).collect();
    assert!(first.windows(2).all(|pair| pair[1] > pair[0]) && first[0] < 3.0 && first[6] > 3.0, "{first:?}");
}

/// Rows of all interfaces across the period at all times.
#[test]
fn all_interfaces_are_in_one_table() {
    let directory = Directory::new("interfaces");
    let of = |height: f64, inside: Side| InterfaceSetup { height, inside, ..InterfaceSetup::active(-0.5) };
    let setup = Setup {
        region: Region::Channel { length: 6.0, width: 6.0, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 24, elements: 48 }),
        interfaces: vec![of(-1.0, Side::Below), of(1.25, Side::Above)],
        droplets: Vec::new(),
        step: StepSize::Fixed(0.05),
        ..Setup::default()
    };
    let Built { mut scene, interfaces, .. } = setup.build().unwrap();
    let path = directory.0.join("interfaces.csv");
    let mut rows = InterfacesCsv::create(&path, scene.system_mut()).unwrap();
    scene.run(0.3).observe(Every::Time(0.1), &mut rows).go().unwrap();
    drop(rows);
    let (header, found) = read(&path);
    let column = |name: &str| -> Vec<f64> {
        let index = header.iter().position(|known| known == name).expect(name);
        found.iter().map(|row| row[index]).collect()
    };
    let times: Vec<f64> = (0..8).map(|k| 0.1 * f64::from(k / 2)).collect();
    assert!(crate::near(&column("time"), &times, 1e-9), "{:?}", column("time"));
    let numbers: Vec<f64> = interfaces.iter().map(|interface| interface.index() as f64).collect();
    assert_eq!(column("interface"), numbers.repeat(4));
    let seen: Vec<f64> = interfaces.iter().map(|&interface| scene.observe(interface).unwrap().height).collect();
    assert_eq!(column("height")[6..], seen);
    assert!(crate::near(&seen, &[-1.0, 1.25], 1e-6));
}

/// How far many droplets move and how long they keep their headings is what their rows say.
#[test]
fn motion_of_many_droplets_is_that_of_their_rows() {
    let directory = Directory::new("suspension");
    let setup = Setup {
        region: Region::Box { lengths: [6.0, 6.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![
            DropletSetup { centre: [-1.3, 0.0], angle: 0.4, ..DropletSetup::active(-6.0) },
            DropletSetup { centre: [1.4, 0.0], angle: 2.0, ..DropletSetup::active(-4.0) },
        ],
        step: StepSize::Fixed(0.025),
        ..Setup::default()
    };
    let Built { mut scene, .. } = setup.build().unwrap();
    let mut tables = SuspensionCsv::create(&directory.0, scene.system_mut(), 0.1).unwrap();
    scene.run(0.4).observe(Every::Time(0.1), &mut tables).go().unwrap();
    let motion = tables.diffusion(0.1);
    let pairs = tables.pairs(&setup.region, 0.1, 1.0, 3.0);
    drop(tables);
    let (header, rows) = read(&directory.0.join("members.csv"));
    let vector = |row: &[f64], name: &str| {
        ["x", "y"].map(|axis| {
            let name = if name.is_empty() { axis.to_owned() } else { format!("{name}_{axis}") };
            row[header.iter().position(|known| *known == name).expect(&name)]
        })
    };
    // States from the time 0.1 on, of two rows each.
    let states: Vec<&[Vec<f64>]> = rows[2..].chunks(2).collect();
    assert_eq!((states.len(), motion.len()), (4, 4));
    for (row, angle) in rows.iter().zip([0.4_f64, 2.0]) {
        assert!(crate::near(&vector(row, "heading"), &[angle.cos(), angle.sin()], 1e-2), "{row:?}");
    }
    // The pair is from 2 to 3 apart, where its velocities are as correlated as in the rows.
    let (mut product, mut square) = (0.0, 0.0);
    for state in &states {
        let [[a, b], [c, d]] = [vector(&state[0], "velocity"), vector(&state[1], "velocity")];
        product += a * c + b * d;
        square += 0.5 * (a * a + b * b + c * c + d * d);
    }
    assert!(pairs.pairs[..2] == [0.0; 2] && pairs.pairs[2] > 0.0, "{pairs:?}");
    assert!(crate::near(&pairs.velocities[2..], &[product / square], 1e-9), "{product} {square} {pairs:?}");
    for (lag, found) in motion.iter().enumerate() {
        let pairs = states.iter().zip(&states[lag..]).flat_map(|(from, to)| from.iter().zip(*to));
        let mut sums = [0.0; 3];
        for (from, to) in pairs {
            let [[x, y], [u, v]] = [vector(from, ""), vector(to, "")];
            let [[a, b], [c, d]] = [vector(from, "heading"), vector(to, "heading")];
            for (sum, value) in sums.iter_mut().zip([1.0, (u - x).powi(2) + (v - y).powi(2), a * c + b * d]) {
                *sum += value;
            }
        }
        let [count, square, product] = sums;
        assert!(crate::near(found, &[0.1 * lag as f64, square / count, product / count], 1e-9), "{found:?} {sums:?}");
    }
    assert!(motion[3][1] > 1e-4 && (motion[0][2] - 1.0).abs() < 1e-9, "{motion:?}");
}

/// The stress that a repulsion transmits is the pressure of its forces times the distances, over the area of the box.
#[test]
fn stresses_of_contacts_are_those_of_the_repulsion() {
    let directory = Directory::new("contacts");
    let droplet = |x: f64| DropletSetup { centre: [x, 0.0], ..DropletSetup::active(-1.0) };
    let repulsion = motile::scene::gap::Repulsion::new(200.0, 0.1).ok();
    let region = Region::Box { lengths: [6.0, 5.0] };
    let setup = Setup { region, droplets: vec![droplet(-1.01), droplet(1.01)], repulsion, ..Setup::default() };
    let mut scene = setup.build().unwrap().scene;
    let mut tables = SuspensionCsv::create(&directory.0, scene.system_mut(), 0.1).unwrap();
    scene.run(0.01).observe(Every::Time(0.01), &mut tables).go().unwrap();
    let load = scene.system_mut().repulsion_load().unwrap().unwrap();
    let (header, rows) = read(&directory.0.join("suspension.csv"));
    let column = header.iter().position(|name| name == "contact_stress").unwrap();
    let expected = 0.5 * (load.virial[0][0] + load.virial[1][1]) / 30.0;
    let found = rows.last().unwrap()[column];
    assert!(expected.abs() > 1e-3 && (found / expected - 1.0).abs() < 1e-6, "{found} {expected}");
}
