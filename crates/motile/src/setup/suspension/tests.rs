use std::f64::consts::PI;

use motile_base::{Drive, Region, Vec2, boxes::Periods};

use super::*;
use crate::setup::{Built, IntegralMethod, Method};

fn small() -> SuspensionSetup {
    SuspensionSetup { radius: Some(Distribution::Value(0.5)), gap: 0.025, ..SuspensionSetup::default() }
}

fn of(suspension: SuspensionSetup, region: Region) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes: 16, elements: 32 });
    Setup { region, method, droplets: Vec::new(), suspension: vec![suspension], ..Setup::default() }
}

fn channel(length: f64, width: f64) -> Region {
    Region::Channel { length, width, drive: Drive::ZeroFlux }
}

fn radius(droplet: &DropletSetup) -> f64 {
    if let DropletShape::Round { radius } = droplet.shape { radius } else { f64::NAN }
}

/// The least gap between circles and from walls, over all pairs and images.
fn least_gap(setup: &Setup) -> f64 {
    let [length, width] = setup.region.lengths();
    let periodic = setup.region.periods()[1].is_some();
    let rows: &[f64] = if periodic { &[-1.0, 0.0, 1.0] } else { &[0.0] };
    let mut least = f64::INFINITY;
    for (k, one) in setup.droplets.iter().enumerate() {
        for (j, two) in setup.droplets.iter().enumerate() {
            for (x, y) in rows.iter().flat_map(|y| [-1.0, 0.0, 1.0].map(|x| (x * length, y * width))) {
                if k != j || (x, y) != (0.0, 0.0) {
                    let between = Vec2::from(one.centre) - Vec2::from(two.centre) + Vec2::new(x, y);
                    least = least.min(between.length() - radius(one) - radius(two));
                }
            }
        }
        if !periodic {
            least = least.min(0.5 * width - one.centre[1].abs() - radius(one));
        }
    }
    least
}

#[test]
fn a_part_of_the_area_is_filled_with_gaps() {
    for region in [Region::Box { lengths: [9.0, 7.0] }, channel(9.0, 7.0)] {
        let suspension = SuspensionSetup { area_fraction: Some(0.6), ..small() };
        let setup = of(suspension.clone(), region);
        let placed = setup.placed().unwrap();
        assert_eq!(placed.droplets.len(), (0.6 * 63.0 / (0.25 * PI)).round() as usize);
        assert!(least_gap(&placed) > 0.025 * (1.0 - 1e-9), "{}", least_gap(&placed));
        assert_eq!(placed, setup.placed().unwrap());
        let other = of(SuspensionSetup { seed: 2, ..suspension }, region).placed().unwrap();
        assert_ne!(placed, other);
        let Built { scene, droplets, .. } = setup.build().unwrap();
        let areas = droplets.iter().map(|&droplet| scene.body(droplet).unwrap().initial_area());
        assert!((areas.sum::<f64>() / 63.0 - 0.6).abs() < 0.01);
    }
}

#[test]
fn small_boxes_see_their_images() {
    // Two columns of cells or one, in which each neighbour counts once and every image keeps its distance.
    for (lengths, count) in [([2.2, 2.2], 3), ([1.06, 5.0], 4), ([1.5, 2.4], 2)] {
        let placed = of(SuspensionSetup { count: Some(count), ..small() }, Region::Box { lengths }).placed().unwrap();
        assert!(least_gap(&placed) > 0.025 * (1.0 - 1e-9), "{lengths:?}: {}", least_gap(&placed));
    }
}

#[test]
fn a_thousand_droplets_of_distributed_values() {
    let suspension = SuspensionSetup {
        count: Some(1000),
        radius: Some(Distribution::Between([0.8, 1.2])),
        activity: Some(Distribution::Normal { mean: -2.5, deviation: 0.2 }),
        viscosity: Some(Distribution::Between([50.0, 150.0])),
        ..SuspensionSetup::default()
    };
    let side = (1000.0 * suspension.mean_area() / 0.6).sqrt();
    let placed = of(suspension, Region::Box { lengths: [side; 2] }).placed().unwrap();
    assert!(least_gap(&placed) > 0.05 * (1.0 - 1e-9));
    let mean = |value: &dyn Fn(&DropletSetup) -> f64| placed.droplets.iter().map(value).sum::<f64>() / 1000.0;
    // Four standard errors of the mean of a thousand.
    let within = |value: f64, expected: f64, deviation: f64| {
        assert!((value - expected).abs() < 4.0 * deviation / 1000.0_f64.sqrt(), "{value} {expected}");
    };
    within(mean(&radius), 1.0, 0.4 / 12.0_f64.sqrt());
    within(mean(&DropletSetup::activity), -2.5, 0.2);
    within(mean(&|d| (d.activity() + 2.5).powi(2)), 0.04 * 0.9733, 0.06);
    within(mean(&|d| d.viscosity.unwrap()), 100.0, 100.0 / 12.0_f64.sqrt());
    within(mean(&|d| d.angle.cos()), 0.0, 0.5_f64.sqrt());
    within(mean(&|d| (2.0 * d.angle).cos()), 0.0, 0.5_f64.sqrt());
    assert!(placed.droplets.iter().all(|d| (0.8..=1.2).contains(&radius(d)) && (d.activity() + 2.5).abs() <= 0.6));
}

#[test]
fn mixtures_and_droplets_of_the_list_keep_apart() {
    let fixed = DropletSetup { centre: [0.3, -0.2], ..DropletSetup::active(-2.0) };
    let mut setup = of(SuspensionSetup { count: Some(20), ..small() }, Region::Box { lengths: [8.0, 8.0] });
    setup.suspension.push(SuspensionSetup { count: Some(6), radius: None, seed: 5, ..SuspensionSetup::default() });
    setup.droplets.push(fixed.clone());
    let placed = setup.placed().unwrap();
    assert_eq!((placed.droplets.len(), &placed.droplets[0]), (27, &fixed));
    let periods: Periods = placed.region.periods().into();
    for droplet in &placed.droplets[1..] {
        let between = periods.wrap(Vec2::from(droplet.centre) - Vec2::from(fixed.centre));
        assert!(between.length() - radius(droplet) >= 1.0 + 0.025 - 1e-9);
    }
    assert_eq!(placed.droplets[26].name, "droplet 6");
}

#[test]
fn lattices_have_the_largest_distances() {
    // The hexagonal lattice of twelve sites, and all headings alike.
    let (length, width) = (6.0, 4.0 * 3.0_f64.sqrt());
    let lattice = SuspensionSetup {
        count: Some(12),
        radius: Some(Distribution::Value(0.9)),
        headings: Headings::Aligned(0.7),
        arrangement: Arrangement::Lattice,
        ..SuspensionSetup::default()
    };
    let placed = of(lattice.clone(), Region::Box { lengths: [length, width] }).placed().unwrap();
    assert!((least_gap(&placed) - 0.2).abs() < 1e-12, "{}", least_gap(&placed));
    assert!(placed.droplets.iter().all(|droplet| droplet.angle == 0.7));
    let placed = of(SuspensionSetup { count: Some(8), ..lattice }, channel(8.0, 4.5)).placed().unwrap();
    assert!(least_gap(&placed) >= 0.05);
}

#[test]
fn what_makes_no_suspension_is_refused() {
    let region = Region::Box { lengths: [6.0, 6.0] };
    let counted = SuspensionSetup { count: Some(4), ..small() };
    let part = |fraction| SuspensionSetup { area_fraction: Some(fraction), ..small() };
    let template = |droplet: DropletSetup| SuspensionSetup { droplet, ..counted.clone() };
    let bent = DropletShape::Ellipse { half_axes: [1.0, 2.0] };
    for (suspension, region, start) in [
        (part(0.95), region, "suspension[0].area-fraction = 0.95: use a number above 0 and below 0.9069"),
        (part(0.88), region, "suspension[0].area-fraction = 0.88: no places were found in a region of 6 x 6"),
        (part(f64::NAN), region, "suspension[0].area-fraction = NaN: use a number above 0"),
        (part(-0.5), region, "suspension[0].area-fraction = -0.5: use a number above 0"),
        (part(0.01), region, "suspension[0].area-fraction = 0.01: this makes 0 droplets"),
        (part(0.5), Region::Box { lengths: [1e4, 1e4] }, "suspension[0].area-fraction = 0.5: this makes 63661977"),
        (small(), region, "suspension[0].count = none: the number of droplets is missing"),
        (SuspensionSetup { count: Some(4), ..part(0.3) }, region, "suspension[0].count = 4: area-fraction sets"),
        (SuspensionSetup { count: Some(0), ..small() }, region, "suspension[0].count = 0: use a number from 1"),
        (SuspensionSetup { count: Some(60), ..small() }, region, "suspension[0].count = 60: no places were found"),
        (SuspensionSetup { gap: -1.0, ..counted.clone() }, region, "suspension[0].gap = -1"),
        (
            SuspensionSetup { radius: Some(Distribution::Value(5.0)), ..counted.clone() },
            region,
            "suspension[0].radius = 5: a region of 6 x 6 has no room for such a droplet and a gap of 0.025",
        ),
        (counted.clone(), channel(6.0, 1.02), "suspension[0].radius = 0.5: a region of 6 x 1.02 has no room"),
        (
            SuspensionSetup { radius: Some(Distribution::Between([1.0, 0.5])), ..counted.clone() },
            region,
            "suspension[0].radius = [1, 0.5]: use a finite number",
        ),
        (
            SuspensionSetup { radius: Some(Distribution::Normal { mean: 1.0, deviation: 0.5 }), ..counted.clone() },
            region,
            "suspension[0].radius = normal around 1 with 0.5: the range contains -0.5",
        ),
        (template(DropletSetup { shape: bent, ..DropletSetup::default() }), region, "suspension[0].droplet.shape"),
        (template(DropletSetup { angle: 1.0, ..DropletSetup::default() }), region, "suspension[0].droplet.angle = 1"),
        (template(DropletSetup { tension: -1.0, ..DropletSetup::default() }), region, "suspension[0].droplet.tension"),
        (
            SuspensionSetup { activity: Some(Distribution::Value(-2.0)), ..template(DropletSetup::passive(10.0)) },
            region,
            "suspension[0].activity = -2: droplets without particles",
        ),
        (counted.clone(), Region::Plane, "region = plane: a suspension needs a box or a channel"),
    ] {
        let error = of(suspension, region).build().map(|_| ()).unwrap_err().to_string();
        assert!(error.starts_with(start), "{error} / {start}");
    }
}

#[cfg(feature = "toml")]
#[test]
fn ten_lines_are_a_thousand_droplets() {
    let text = "region.box.lengths = [102.4, 102.4]\n\
                method.integral = { nodes = 64, elements = 128 }\n\
                [[suspension]]\n\
                count = 1000\n\
                radius = [0.9, 1.1]\n\
                activity = -2.0\n\
                seed = 7\n";
    let setup = Setup::from_toml(text).unwrap();
    assert_eq!(setup.placed().unwrap().droplets.len(), 1000);
    for (values, words) in [
        ("radius = [1.0]", "a range has two numbers, [least, most]"),
        ("radius = \"large\"", "a number, [least, most] or { normal"),
        ("radius = { norm = 1.0 }", "unknown key `norm`"),
        ("radii = 1.0", "unknown key `radii`"),
    ] {
        let error = Setup::from_toml(&format!("[[suspension]]\ncount = 3\n{values}")).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
}

/// If a channel has room for one row alone, this is in the middle.
#[test]
fn one_row_in_a_channel_is_on_its_axis() {
    let row = SuspensionSetup {
        count: Some(3),
        radius: Some(Distribution::Value(1.0)),
        arrangement: Arrangement::Lattice,
        ..SuspensionSetup::default()
    };
    let placed = of(row, channel(12.0, 2.4)).placed().unwrap();
    assert!(placed.droplets.iter().all(|droplet| droplet.centre[1] == 0.0), "{:?}", placed.droplets[0].centre);
    assert_eq!(placed.droplets.len(), 3);
}

/// Part of the region's area that the circles fill.
fn filled(setup: &Setup) -> f64 {
    let [length, width] = setup.region.lengths();
    setup.placed().unwrap().droplets.iter().map(|droplet| PI * radius(droplet).powi(2)).sum::<f64>() / (length * width)
}

/// A fraction of the area is met by radii that differ, and of equal circles refused if it is off by more than 2 %.
#[test]
fn the_area_fraction_is_met_or_refused() {
    for radius_of in [Distribution::Between([0.8, 1.2]), Distribution::Normal { mean: 1.0, deviation: 0.1 }] {
        for (side, seed) in [(6.0, 1), (6.0, 2), (6.0, 3), (12.0, 4), (20.0, 5)] {
            let suspension = SuspensionSetup {
                area_fraction: Some(0.3),
                radius: Some(radius_of),
                seed,
                ..SuspensionSetup::default()
            };
            let setup = of(suspension, Region::Box { lengths: [side; 2] });
            assert!((filled(&setup) - 0.3).abs() < 1e-9, "{radius_of} {side} {seed}: {}", filled(&setup));
            assert!((setup.filled().unwrap().unwrap() - 0.3).abs() < 1e-9);
            let [least, most] = radius_of.bounds();
            assert!(setup.placed().unwrap().droplets.iter().all(|d| (least..=most).contains(&radius(d))));
        }
    }
    let alike = |fraction: f64| {
        let radius = Some(Distribution::Value(1.0));
        let suspension = SuspensionSetup { area_fraction: Some(fraction), radius, ..SuspensionSetup::default() };
        of(suspension, Region::Box { lengths: [6.0; 2] })
    };
    let error = alike(0.3).check().unwrap_err().to_string();
    assert!(error.starts_with("suspension[0].area-fraction = 0.3: 3 droplets fill 0.262 of the area"), "{error}");
    assert!(error.contains("and 4 fill 0.349"), "{error}");
    // Within 2 % the nearest one is taken, and told.
    let near = alike(0.26);
    assert!((filled(&near) / (3.0 * PI / 36.0) - 1.0).abs() < 1e-12);
    assert_eq!(near.filled().unwrap(), Some(filled(&near)));
    assert_eq!(Setup::default().filled().unwrap(), None);
}

/// Least values of zero are refused where only positive ones make sense, and not for activities.
#[test]
fn ranges_that_begin_at_zero_are_refused() {
    let region = Region::Box { lengths: [9.0, 7.0] };
    let check = |suspension: SuspensionSetup| {
        of(SuspensionSetup { count: Some(4), ..suspension }, region).placed().map(|_| ()).map_err(|e| e.to_string())
    };
    let from_zero = Some(Distribution::Between([0.0, 0.5]));
    for suspension in
        [SuspensionSetup { radius: from_zero, ..small() }, SuspensionSetup { viscosity: from_zero, ..small() }]
    {
        let error = check(suspension).unwrap_err();
        assert!(error.contains("the range contains 0. Use positive numbers only"), "{error}");
    }
    assert_eq!(check(SuspensionSetup { activity: Some(Distribution::Between([-0.5, 0.0])), ..small() }), Ok(()));
    assert_eq!(check(SuspensionSetup { radius: Some(Distribution::Between([0.25, 0.5])), ..small() }), Ok(()));
}

/// Each droplet has a perturbation of its own, whose seeds count from that of the suspension.
#[test]
fn droplets_are_perturbed_one_by_one() {
    let mut suspension = SuspensionSetup { count: Some(5), ..small() };
    suspension.droplet.particles.as_mut().unwrap().start = Start::Perturbed { amplitude: 0.1, seed: 7 };
    let placed = of(suspension, Region::Box { lengths: [9.0, 7.0] }).placed().unwrap();
    let seed = |droplet: &DropletSetup| match droplet.particles.as_ref().unwrap().start {
        Start::Perturbed { seed, .. } => seed,
        _ => panic!("it is not perturbed"),
    };
    assert_eq!(placed.droplets.iter().map(seed).collect::<Vec<_>>(), [7, 8, 9, 10, 11]);
}
