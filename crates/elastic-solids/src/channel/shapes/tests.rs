//! Areas and widths of the ready channels, and their meshes.

use crate::error::refused;
use motile_base::InputError;

use super::*;
use crate::Mesher;
use crate::channel::Walls;
use crate::mesh::TriangleMesh;

const BOTTOM: f64 = -2.6;
const TOP: f64 = 2.4;

/// Meshes both walls and compares their area with the box less the channel's.
fn walls(channel: &Channel, spacing: f64, channel_area: f64, tolerance: f64) -> Walls {
    let walls = channel.walls(BOTTOM, TOP, &Mesher::new(spacing).unwrap()).unwrap();
    let solid = walls.lower.area() + walls.upper.area();
    let expected = channel.period() * (TOP - BOTTOM) - channel_area;
    assert!((solid - expected).abs() < tolerance, "{solid} {expected}");
    for mesh in [&walls.lower, &walls.upper] {
        assert_eq!(mesh.period(), Some(channel.period()));
        let mut advances: Vec<i32> = mesh.boundary_loops().iter().map(|l| l.periods).collect();
        advances.sort_unstable();
        assert_eq!(advances, [-1, 1]);
    }
    walls
}

fn highest(mesh: &TriangleMesh) -> Vec2 {
    mesh.points().iter().copied().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap()
}

fn constriction(throat: f64, throat_length: f64, centre: f64) -> ChannelShape {
    ChannelShape::Constriction { width: 2.0, throat, throat_length, ramp: 1.0, exit_ramp: None, centre }
}

#[test]
fn a_straight_channel() {
    let channel = ChannelShape::Straight { width: 2.0 }.channel(6.0).unwrap();
    let walls = walls(&channel, 0.1, 12.0, 1e-12);
    assert!((highest(&walls.lower).y + 1.0).abs() < 1e-14);
}

#[test]
fn the_constriction_of_the_thesis() {
    let channel = ChannelShape::THESIS.channel(12.0).unwrap();
    // 6 x 2 + 4 x 1 + two ramps of mean width 1.5.
    let walls = walls(&channel, 0.1, 19.0, 0.01);
    assert!((highest(&walls.lower).y + 0.5).abs() < 1e-12);
    for mesh in [&walls.lower, &walls.upper] {
        let quality = mesh.quality();
        assert!(quality.edge_deviation < 0.04 && quality.smallest_angle > 33.0, "{quality}");
    }
    // The same half a period further, across the seam.
    let moved = constriction(1.0, 4.0, 6.0).channel(12.0).unwrap();
    let seam = moved.walls(BOTTOM, TOP, &Mesher::new(0.1).unwrap()).unwrap();
    assert!((seam.lower.area() - walls.lower.area()).abs() < 1e-3);
}

#[test]
fn a_constriction_has_different_ramps_for_entry_and_exit() {
    let (width, throat, throat_length, period) = (2.0, 1.0, 2.0, 12.0);
    let channel = |ramp, exit_ramp, centre| {
        let shape = ChannelShape::Constriction { width, throat, throat_length, ramp, exit_ramp, centre };
        shape.channel(period)
    };
    // Half the width at a distance from the middle of one passage, by the formula of the documentation.
    let half_width = |distance: f64, [entry, exit]: [f64; 2]| {
        let (ramp, s) = (if distance < 0.0 { entry } else { exit }, distance.abs() - 0.5 * throat_length);
        if s <= 0.0 {
            0.5 * throat
        } else if s >= ramp {
            0.5 * width
        } else {
            0.5 * throat + 0.25 * (width - throat) * (1.0 - (PI * s / ramp).cos())
        }
    };
    // In the middle, across the seam, and ramps that fill all but a small part of the period.
    for (ramps, centre) in [([1.0, 4.0], 0.0), ([1.0, 4.0], -5.5), ([4.0, 1.0], 6.0), ([0.5, 9.4], 3.0)] {
        let channel = channel(ramps[0], Some(ramps[1]), centre).unwrap();
        // Ramps have the mean of both widths.
        let both = ramps[0] + ramps[1];
        let area = 0.5 * (width + throat) * both + throat * throat_length + width * (period - throat_length - both);
        walls(&channel, 0.1, area, 0.01);
        for point in channel.lower().resampled(0.01).unwrap() {
            let images = [-2.0, -1.0, 0.0, 1.0, 2.0].map(|k| half_width(point.x - centre - period * k, ramps));
            let expected = images.into_iter().fold(f64::INFINITY, f64::min);
            assert!((point.y + expected).abs() < 1e-12, "{ramps:?} {centre}: {point} {expected}");
        }
    }
    // Without the key both are equal.
    let points = |exit| channel(1.5, exit, 0.3).unwrap().lower().resampled(0.01).unwrap();
    assert_eq!(points(None), points(Some(1.5)));
    let refusal = |exit| channel(1.0, Some(exit), 0.0).unwrap_err();
    assert!(matches!(refusal(9.1), SolidError::Input(InputError::OutOfRange { .. })));
    assert!(matches!(refusal(0.0), SolidError::Input(InputError::NotPositive { .. })));
}

#[test]
fn a_valve_keeps_its_sharp_tips_and_rounds_them_on_request() {
    let valve = |rounding: f64| ChannelShape::Valve { width: 2.0, gap: 0.2, base: 1.2, rounding, centre: 0.5 };
    // The channel less two triangles of base 1.2 and height 0.9.
    let sharp = walls(&valve(0.0).channel(8.0).unwrap(), 0.07, 16.0 - 1.08, 1e-10);
    assert!((highest(&sharp.lower) - Vec2::new(0.5, -0.1)).length() < 1e-12);
    let rounded = valve(0.1).channel(8.0).unwrap();
    let rounded = rounded.walls(BOTTOM, TOP, &Mesher::new(0.05).unwrap()).unwrap();
    let tip = highest(&rounded.lower).y;
    // A circle of radius r in a tip of half angle a stands off it by r (1/sin a - 1).
    let expected = -0.1 - 0.1 * ((0.6_f64.hypot(0.9)) / 0.6 - 1.0);
    assert!((tip - expected).abs() < 2e-4, "{tip} {expected}");
}

#[test]
fn ratchets_narrow_over_their_rise() {
    let ratchet = |sharp: bool| {
        let shape = ChannelShape::Ratchet { width: 2.0, throat: 1.0, teeth: 3, rise: 0.75, sharp };
        shape.channel(12.0).unwrap()
    };
    // Means of the cosine ramps and of the straight flanks are both 1.5.
    let smooth_walls = walls(&ratchet(false), 0.1, 18.0, 0.02);
    let sharp_walls = walls(&ratchet(true), 0.1, 18.0, 1e-10);
    for mesh in [&smooth_walls.lower, &sharp_walls.lower] {
        let tip = highest(mesh);
        assert!((tip.y + 0.5).abs() < 3e-6 && ((tip.x + 6.0).rem_euclid(4.0) - 3.0).abs() < 0.003, "{tip}");
        let quality = mesh.quality();
        assert!(quality.edge_deviation < 0.06 && quality.smallest_angle > 28.0, "{quality}");
    }
}

#[test]
fn a_sinusoidal_channel() {
    let shape =
        |amplitude: f64, phase: f64| ChannelShape::Sinusoidal { width: 2.0, amplitude, waves: 2, phase }.channel(10.0);
    let narrowing = walls(&shape(0.3, 0.0).unwrap(), 0.1, 20.0, 0.01);
    assert!((highest(&narrowing.lower).y + 0.7).abs() < 2e-3);
    walls(&shape(0.3, PI).unwrap(), 0.1, 20.0, 0.01);
    assert!(refused(&shape(1.1, 0.0).unwrap_err(), "outlines cross or touch near ("));
}

#[test]
fn a_channel_that_branches_around_an_island() {
    let shape = ChannelShape::Branching {
        width: 2.0,
        branches: [1.0, 0.6],
        island_length: 5.0,
        island_thickness: 1.2,
        ramp: 1.5,
    };
    let channel = shape.channel(14.0).unwrap();
    let walls = channel.walls(-3.0, 3.0, &Mesher::new(0.08).unwrap()).unwrap();
    assert_eq!(walls.islands.len(), 1);
    let island = &walls.islands[0];
    assert_eq!((island.boundary_loops().len(), island.period()), (1, None));
    // int sqrt(1 - u^4) du over -1..1 is 1.74803836953.
    assert!((island.area() - 2.0 * 2.5 * 0.6 * 1.748_038_37).abs() < 0.01, "{}", island.area());
    for (mesh, deviation) in [(&walls.lower, 0.05), (&walls.upper, 0.05), (island, 0.08)] {
        let quality = mesh.quality();
        assert!(quality.edge_deviation < deviation && quality.smallest_angle > 30.0, "{quality}");
    }
    let lowest = walls.lower.points().iter().filter(|p| p.x.abs() < 0.1).map(|p| p.y).fold(-9.0, f64::max);
    assert!((lowest + 1.6).abs() < 1e-12);
    // Each alone is the same mesh.
    let mesher = Mesher::new(0.08).unwrap();
    assert_eq!(channel.lower_wall(-3.0, &mesher).unwrap(), walls.lower);
    assert_eq!(channel.upper_wall(3.0, &mesher).unwrap(), walls.upper);
    assert_eq!(channel.island(0).unwrap().mesh(0.08).unwrap(), walls.islands[0]);
    let error = channel.island(1).unwrap_err();
    assert!(refused(&error, "island 1 does not exist: the channel has 1, counted from 0"), "{error}");
}

#[test]
fn bad_shapes_are_refused() {
    let long = constriction(1.0, 11.0, 0.0);
    assert!(matches!(long.channel(12.0), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    let closed = constriction(0.0, 4.0, 0.0);
    assert!(matches!(closed.channel(12.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    let straight = ChannelShape::Straight { width: 1.0 };
    assert!(matches!(straight.channel(f64::NAN), Err(SolidError::Input(InputError::NotPositive { .. }))));
    let valve = |gap, rounding| ChannelShape::Valve { width: 2.0, gap, base: 1.2, rounding, centre: 0.0 }.channel(8.0);
    assert!(matches!(valve(2.5, 0.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
    assert!(refused(&valve(0.1, 5.0).unwrap_err(), "does not fit on the side from ("));
    for (teeth, rise) in [(0, 0.5), (2, 1.0)] {
        let ratchet = ChannelShape::Ratchet { width: 2.0, throat: 1.0, teeth, rise, sharp: true };
        assert!(matches!(ratchet.channel(12.0), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    }
    let (flat, circle) = (|y| Outline::flat(0.0, 4.0, y).unwrap(), Outline::circle(Vec2::ZERO, 0.2).unwrap());
    let outside = "is not between the two sides of the channel";
    let refusal = |lower, upper| Channel::new(lower, upper).unwrap_err();
    assert!(refused(&refusal(flat(1.0), flat(-1.0)), outside));
    assert!(refused(&refusal(flat(-1.0), circle.clone()), "outlines have different periods: 4 and 0"));
    assert!(refused(&refusal(circle.clone(), flat(1.0)), "a closed outline as the side of a channel is not possible"));
    let island = circle.translated(Vec2::new(0.0, 3.0)).unwrap();
    let error = Channel::with_islands(flat(-1.0), flat(1.0), vec![island]).unwrap_err();
    assert!(refused(&error, outside), "{error}");
    let channel = Channel::new(flat(-1.0), flat(1.0)).unwrap();
    let height = |line: &Outline| line.resampled(0.5).unwrap()[0].y;
    let gap = |channel: &Channel| height(channel.upper()) - height(channel.lower());
    assert!((gap(&channel.widened(0.5).unwrap()) - 2.5).abs() < 1e-12);
    let error = channel.widened(-2.5).unwrap_err();
    assert!(refused(&error, outside) || refused(&error, "outlines cross or touch near ("), "{error}");
    let error = channel.walls(-1.05, 3.0, &Mesher::new(0.1).unwrap()).unwrap_err();
    assert!(refused(&error, "is too thin for the mesh"), "{error}");
}

#[test]
fn errors_name_what_is_wrong() {
    let sides = |amplitude| ChannelShape::Sinusoidal { width: 2.0, amplitude, waves: 1, phase: 0.0 };
    for (shape, name) in [
        (ChannelShape::Straight { width: -1.0 }, "the width of the channel"),
        (ChannelShape::Straight { width: 0.0 }, "the width of the channel"),
        (sides(f64::NAN), "the amplitude of the sides"),
        (sides(f64::INFINITY), "the amplitude of the sides"),
    ] {
        let text = shape.channel(6.0).expect_err("refused").to_string();
        assert!(text.contains(name), "{text}");
    }
}
