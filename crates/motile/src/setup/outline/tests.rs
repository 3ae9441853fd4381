//! Outlines of exact area and perimeter, from files of several formats, as bodies of all kinds.

use std::f64::consts::{PI, TAU};
use std::path::PathBuf;

use super::*;
use crate::setup::{
    DropletSetup, DropletShape, IntegralMethod, InterfaceSetup, InterfaceShape, Method, RigidBodySetup, Setup,
    SolidOutline, WallSetup,
};
use motile_base::{Drive, Region};

/// Perimeter of the ellipse with the half axes 1.5 and 0.8: 8 (a + b) E of the nome series, by the arithmetic-geometric
/// mean.
fn ellipse_perimeter(a: f64, b: f64) -> f64 {
    let (mut x, mut y, mut sum, mut power) = (a, b, 0.5 * (a * a - b * b), 0.5);
    for _ in 0..10 {
        let (mean, root) = (0.5 * (x + y), (x * y).sqrt());
        power *= 2.0;
        sum += power * (0.5 * (x - y)).powi(2);
        (x, y) = (mean, root);
    }
    TAU * (a * a - sum) / x
}

fn ellipse(count: usize, scale: f64) -> Vec<[f64; 2]> {
    let angle = |k: usize| TAU * (k as f64 + 0.3) / count as f64;
    (0..count).map(|k| [scale * 1.5 * angle(k).cos(), scale * 0.8 * angle(k).sin()]).collect()
}

fn droplet(outline: OutlineSetup) -> Setup {
    let droplets = vec![DropletSetup { shape: DropletShape::Outline(outline), ..DropletSetup::passive(10.0) }];
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    Setup { droplets, method, region: Region::Plane, ..Setup::default() }
}

fn report_of(outline: OutlineSetup) -> OutlineReport {
    droplet(outline).outlines().unwrap().remove(0)
}

/// A directory of files for a test.
fn directory(name: &str, files: &[(&str, &[u8])]) -> PathBuf {
    let directory = std::env::temp_dir().join(format!("motile-outlines-{name}-{}", std::process::id()));
    std::fs::create_dir_all(&directory).unwrap();
    files.iter().for_each(|(file, bytes)| std::fs::write(directory.join(file), bytes).unwrap());
    directory
}

#[test]
fn the_reference_perimeter_is_right() {
    assert!((ellipse_perimeter(2.0, 2.0) - 2.0 * TAU).abs() < 1e-14);
    // Sum of chords of a fine polygon.
    let fine = ellipse(100_000, 1.0);
    let chord = |k: usize| {
        let [[a, b], [c, d]] = [fine[k], fine[(k + 1) % fine.len()]];
        (c - a).hypot(d - b)
    };
    assert!(((0..fine.len()).map(chord).sum::<f64>() / ellipse_perimeter(1.5, 0.8) - 1.0).abs() < 1e-9);
}

/// The spline through points of an ellipse is of fourth order, in any unit, given in either direction.
#[test]
fn an_ellipse_converges_at_the_order_of_the_spline() {
    for (scale, reversed) in [(1.0, false), (1e-6, true)] {
        let errors = [40, 80].map(|count| {
            let mut points = ellipse(count, scale);
            points.push(points[0]);
            if reversed {
                points.reverse();
            }
            let report = report_of(OutlineSetup::of_points(points));
            assert_eq!((report.points, report.repeated, report.was_clockwise), (count, 1, reversed));
            let sagitta = report.distance / scale;
            assert!(sagitta < 0.5 * (TAU * 1.5 / count as f64).powi(2), "{sagitta}");
            let area = report.area / (PI * 1.2 * scale * scale) - 1.0;
            let perimeter = report.perimeter / (ellipse_perimeter(1.5, 0.8) * scale) - 1.0;
            println!("{count} points: area {area:.2e}, perimeter {perimeter:.2e}, distance {sagitta:.2e}");
            [area.abs(), perimeter.abs()]
        });
        for (coarse, fine) in errors[0].into_iter().zip(errors[1]) {
            assert!((13.0..20.0).contains(&(coarse / fine)) && fine < 2e-5, "{coarse} {fine}");
        }
    }
}

/// A square has the area of the closed form once it is rounded, wherever it lies in its file.
#[test]
fn rounded_squares_are_exact() {
    for scale in [1.0, 1e-6] {
        let points = vec![[10.0, 10.0], [10.0, 12.0], [12.0, 12.0], [12.0, 10.0]];
        let outline = OutlineSetup { scale, rounding: Some(0.3 * scale), ..OutlineSetup::of_points(points) };
        let report = report_of(outline.clone());
        let square = scale * scale;
        assert!((report.area / square - (4.0 - (4.0 - PI) * 0.09)).abs() < 1e-13);
        assert!((report.polygon_area / square - 4.0).abs() < 1e-13 && report.was_clockwise);
        // The corner is cut by (sqrt(2) - 1) r.
        assert!((report.distance / scale - 0.3 * (2.0_f64.sqrt() - 1.0)).abs() < 1e-3, "{}", report.distance);
        assert!(report.centroid[0].hypot(report.centroid[1]) < 1e-12 * scale);
        let mut droplet = droplet(outline).build().unwrap();
        let seen = droplet.scene.observe(droplet.droplets[0]).unwrap();
        assert!((seen.area / report.area - 1.0).abs() < 2e-3, "{} {}", seen.area, report.area);
    }
}

/// Pixels whose middle lies within 50 pixels of a place, as a chain of their sides.
fn traced_circle() -> Vec<[f64; 2]> {
    let half = |y: i32| (2500.0 - (f64::from(y) + 0.5).powi(2)).sqrt().round();
    let right = (-50..50).flat_map(|y| [[half(y), f64::from(y)], [half(y), f64::from(y + 1)]]);
    let left = (-50..50).rev().flat_map(|y| [[-half(y), f64::from(y + 1)], [-half(y), f64::from(y)]]);
    right.chain(left).map(|[x, y]| [x + 200.0, y + 300.0]).collect()
}

/// A circle of 50 pixels that was traced along pixels: its area to 0.5 %. A droplet of that shape has almost no flow:
/// its steps are gone.
#[test]
fn a_traced_circle_is_quiet() {
    for scale in [0.02, 2e-8] {
        let outline = OutlineSetup { scale, smooth: Some(scale), ..OutlineSetup::of_points(traced_circle()) };
        let report = report_of(outline.clone());
        let radius = 50.0 * scale;
        assert!((report.area / (PI * radius * radius) - 1.0).abs() < 5e-3);
        assert!(report.distance < 1.5 * scale && report.polygon_perimeter > 1.2 * report.perimeter);
        let setup = Setup { step: motile_scene::StepSize::OfLimit(0.5), ..droplet(outline) };
        let mut scene = setup.build().unwrap().scene;
        // In units of the tension over the viscosity.
        let fastest = |scene: &mut motile_scene::Scene<crate::setup::AnyFlow>| {
            let markers = scene.system_mut().evaluate().unwrap();
            markers.velocities().iter().map(|v| v.length()).fold(0.0, f64::max) * 100.0 / 10.0
        };
        let before = fastest(&mut scene);
        scene.run(20.0 * 100.0 * radius / 10.0).most_steps(400).go().unwrap();
        let after = fastest(&mut scene);
        println!("speeds {before:.2e}, {after:.2e}");
        assert!(before < 2e-2 && after < 1e-5, "{before} {after}");
    }
}

/// Eight points that were clicked around a circle: the curve through them is rounder than their polygon, and the report
/// says by how much.
#[test]
fn a_clicked_octagon_is_reported() {
    let points = (0..8).map(|k| Vec2::from_angle(TAU * f64::from(k) / 8.0).into()).collect();
    let report = report_of(OutlineSetup::of_points(points));
    let octagon = 2.0 * 2.0_f64.sqrt();
    assert!((report.polygon_area - octagon).abs() < 1e-14);
    assert!((report.area / PI - 1.0).abs() < 5e-3, "{}", report.area / PI);
    let sagitta = 1.0 - (PI / 8.0).cos();
    assert!((report.distance / sagitta - 1.0).abs() < 0.05, "{} {sagitta}", report.distance);
}

/// The centroid of the shape is the centre of the body, not that of the polygon, which bulges elsewhere.
#[test]
fn the_centroid_of_the_shape_is_the_centre() {
    let bean = vec![[0.0, 0.0], [2.0, -0.2], [2.6, 0.8], [2.0, 1.6], [1.2, 1.0], [0.4, 1.7], [-0.4, 0.9]];
    for smooth in [None, Some(0.05)] {
        let setup = droplet(OutlineSetup { smooth, ..OutlineSetup::of_points(bean.clone()) });
        let curve = setup.droplets[0].shape.curve().unwrap().0;
        let found = centroid(&curve);
        assert!(found.length() < 1e-9, "{smooth:?}: {found:?}");
        let report = &setup.outlines().unwrap()[0];
        assert!(smooth.is_some() || report.centroid[0].hypot(report.centroid[1]) > 1e-3, "{:?}", report.centroid);
    }
}

#[test]
fn lines_over_half_of_a_channel_are_told() {
    let of = |scale: f64| {
        let points = (0..16).map(|k| [0.25 * f64::from(k) - 2.0, 0.3 * (0.8 * f64::from(k)).sin() - 1.5]).collect();
        let outline = SolidOutline::WallBelowLine(OutlineSetup { scale, ..OutlineSetup::of_points(points) });
        let walls = vec![WallSetup::new(outline, 0.2)];
        let region = Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient };
        Setup { region, walls, ..droplet(OutlineSetup::of_points(ellipse(60, 1.0))) }.hints()
    };
    let hints = of(1.0);
    assert!(hints.len() == 1 && hints[0].contains("cover only 47 % of the length of the region"), "{hints:?}");
    assert!(of(2.0).is_empty(), "{:?}", of(2.0));
}

/// What a user sees only in the report is told: a curve that bulges, and steps of pixels that the nodes do not carry.
#[test]
fn shapes_that_differ_from_their_outline_are_told() {
    let octagon: Vec<[f64; 2]> = (0..8).map(|k| Vec2::from_angle(TAU * f64::from(k) / 8.0).into()).collect();
    let hints = droplet(OutlineSetup::of_points(octagon.clone())).hints();
    assert!(hints.len() == 1 && hints[0].contains("through its 8 points is 10.9 % larger"), "{hints:?}");
    assert!(hints[0].starts_with("droplets[0].shape.outline: "), "{hints:?}");
    assert!(droplet(OutlineSetup { rounding: Some(0.1), ..OutlineSetup::of_points(octagon) }).hints().is_empty());
    // A staircase of 600 steps around a circle.
    let pixel = 0.02;
    let corner = |k: usize| {
        let point = Vec2::from_angle(TAU * k as f64 / 600.0);
        [(point.x / pixel).round() * pixel, (point.y / pixel).round() * pixel]
    };
    let mut steps: Vec<[f64; 2]> = Vec::new();
    for k in 0..600 {
        let [x, y] = corner(k);
        let before = steps.last().copied().unwrap_or([x, y]);
        if before[0] != x && before[1] != y {
            steps.push([x, before[1]]);
        }
        steps.push([x, y]);
    }
    let of = |smooth| OutlineSetup { smooth, ..OutlineSetup::of_points(steps.clone()) };
    let report = report_of(of(None));
    // The perimeter of the steps is 8 radii, and that of the droplet of 32 nodes all but the circle's.
    assert!(report.perimeter > 7.0 && (report.resolved_perimeter / TAU - 1.0).abs() < 0.02, "{report:?}");
    let hints = droplet(of(None)).hints();
    assert!(hints.len() == 1 && hints[0].contains("set `smooth` to the length of one or two pixels"), "{hints:?}");
    assert!(droplet(of(Some(pixel))).hints().is_empty());
}

#[test]
fn files_are_found_next_to_the_scene() {
    let square = "<svg><path id=\"a\" d=\"M0 0h2v1h-2z\"/><path id=\"b\" d=\"M0 0h4v3l-2-1-2 1z\"/></svg>";
    let vertex = "4\n0 0\n0 3\n2 3\n2 0\n";
    let directory = directory("found", &[("two.svg", square.as_bytes()), ("cell.vertex", vertex.as_bytes())]);
    let outline = OutlineSetup { name: Some("b".into()), scale: 0.5, ..OutlineSetup::of_file("two.svg") };
    let setup = droplet(outline.clone());
    let read = setup.clone().with_files(&directory).unwrap();
    let DropletShape::Outline(found) = &read.droplets[0].shape else { panic!("no outline") };
    // What was chosen is no longer needed, and y runs up again.
    assert_eq!((found.file.as_deref(), &found.name, found.flip, found.points.len()), (None, &None, Some(true), 5));
    let report = &read.outlines().unwrap()[0];
    assert_eq!((report.key.as_str(), report.polygon_area), ("droplets[0].shape.outline", 2.5));
    // The notch was at the bottom of the picture, so the centroid is nearer to the top.
    let prepared = OutlineSetup { origin: Some(OutlineOrigin::File), ..found.clone() };
    let prepared = prepared.prepared(None, OutlineOrigin::Centroid).unwrap();
    assert!(prepared.given.centroid.y > -0.75 && prepared.points.iter().all(|point| point.y <= 0.0));
    let vertex = droplet(OutlineSetup::of_file("cell.vertex")).with_files(&directory).unwrap();
    assert_eq!(vertex.outlines().unwrap()[0].polygon_area, 6.0);
    // A literal reads the file when it is built.
    let path = directory.join("two.svg").display().to_string();
    let literal = droplet(OutlineSetup { file: Some(path.clone()), ..outline.clone() });
    assert_eq!(literal.outlines().unwrap()[0].area, report.area);
    let said = |outline: OutlineSetup| droplet(outline).with_files(&directory).unwrap_err().to_string();
    let several = said(OutlineSetup::of_file("two.svg"));
    assert!(several.starts_with("droplets[0].shape.outline: the file has 2 outlines (\"a\", \"b\")"), "{several}");
    let missing = said(OutlineSetup::of_file("none.csv"));
    assert!(missing.contains("none.csv cannot be read: there is no such file"), "{missing}");
    std::fs::remove_dir_all(directory).unwrap();
}

#[test]
fn origins_and_places() {
    let points = vec![[1.0, 1.0], [3.0, 1.0], [3.0, 2.0], [1.0, 2.0]];
    for (origin, flip, expected) in [
        (None, None, [0.5, -1.0]),
        (Some(OutlineOrigin::Centroid), Some(true), [0.5, -1.0]),
        (Some(OutlineOrigin::File), None, [4.5, 2.0]),
        (Some(OutlineOrigin::File), Some(true), [4.5, -4.0]),
        (Some(OutlineOrigin::Point([1.0, 2.0])), None, [2.5, -2.0]),
        (Some(OutlineOrigin::Point([1.0, 2.0])), Some(true), [2.5, 0.0]),
    ] {
        let outline =
            OutlineSetup { scale: 2.0, origin, flip, place: [0.5, -1.0], ..OutlineSetup::of_points(points.clone()) };
        let found = report_of(outline).centroid;
        let apart = Vec2::from(found).distance(expected.into());
        assert!(apart < 1e-12, "{origin:?} {flip:?}: {found:?}");
    }
}

#[test]
fn entries_that_cannot_be_are_refused_with_their_keys() {
    let square = OutlineSetup::of_points(vec![[0.0, 0.0], [2.0, 0.0], [2.0, 2.0], [0.0, 2.0]]);
    let bow = vec![[0.0, 0.0], [2.0, 2.0], [2.0, 0.0], [0.0, 1.9]];
    let rounding = |rounding| OutlineSetup { rounding: Some(rounding), ..square.clone() };
    for (said, outline) in [
        ("droplets[0].shape.outline.file = not given: an outline has either", OutlineSetup::default()),
        (
            "droplets[0].shape.outline.file = given with points",
            OutlineSetup { file: Some("a".into()), ..square.clone() },
        ),
        ("droplets[0].shape.outline.index = given with points", OutlineSetup { index: Some(1), ..square.clone() }),
        ("droplets[0].shape.outline.scale = 0", OutlineSetup { scale: 0.0, ..square.clone() }),
        ("droplets[0].shape.outline.smooth = -1", OutlineSetup { smooth: Some(-1.0), ..square.clone() }),
        ("droplets[0].shape.outline.rounding = 0", rounding(0.0)),
        ("corners cannot be rounded with the radius 1.1: the side at", rounding(1.1)),
        ("given with smooth", OutlineSetup { smooth: Some(0.1), ..rounding(0.1) }),
        ("the outline crosses or touches itself near", OutlineSetup::of_points(bow)),
        ("encloses no area", OutlineSetup::of_points(vec![[0.0, 0.0], [1.0, 1.0], [2.0, 2.0]])),
    ] {
        let error = droplet(outline).build().unwrap_err().to_string();
        assert!(error.contains(said) && error.starts_with("droplets[0]"), "{error}");
    }
}

/// One outline as the shape of every kind of body.
#[test]
fn bodies_of_every_kind_have_outlines() {
    let region = Region::Channel { length: 8.0, width: 6.0, drive: Drive::ZeroGradient };
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let pixel = 0.01;
    let circle = |x: f64, y: f64| OutlineSetup {
        scale: pixel,
        smooth: Some(pixel),
        place: [x, y],
        origin: Some(OutlineOrigin::Centroid),
        ..OutlineSetup::of_points(traced_circle())
    };
    let floor = vec![[800.0, 50.0], [600.0, 20.0], [400.0, 50.0], [200.0, 80.0], [0.0, 50.0]];
    let line = OutlineSetup { scale: pixel, place: [-4.0, -3.0], smooth: Some(0.05), ..OutlineSetup::of_points(floor) };
    let body =
        RigidBodySetup { centre: [2.0, 0.0], shape: DropletShape::Outline(circle(0.0, 0.0)), ..Default::default() };
    let setup = Setup {
        region,
        method,
        droplets: Vec::new(),
        rigid_bodies: vec![body],
        walls: vec![
            WallSetup::new(SolidOutline::Closed(circle(-1.5, 0.5)), 0.1),
            WallSetup::new(SolidOutline::WallBelowLine(line.clone()), 0.2),
        ],
        ..Setup::default()
    };
    let reports = setup.outlines().unwrap();
    let keys: Vec<&str> = reports.iter().map(|report| report.key.as_str()).collect();
    let expected = ["rigid-bodies[0].shape.outline", "walls[0].outline.closed", "walls[1].outline.wall-below-line"];
    assert_eq!(keys, expected);
    assert!(reports[..2].iter().all(|report| (report.area / (PI * 0.25) - 1.0).abs() < 5e-3));
    // The mean height of the floor is 0.5 above y = -3.
    assert!((reports[2].area + 8.0 * 2.5).abs() < 0.05 && reports[2].distance < 0.051, "{:?}", reports[2]);
    let walls = setup.rigid_walls().unwrap();
    let radii = walls[0].points().iter().map(|point| point.distance(Vec2::new(-1.5, 0.5)));
    assert!(radii.map(|radius| (radius - 0.5).abs()).fold(0.0, f64::max) < pixel);
    setup.build().unwrap();

    let points: Vec<[f64; 2]> =
        (0..40).map(|k| [0.15 * f64::from(k), 0.3 * (TAU * f64::from(k) / 40.0).sin()]).collect();
    let shape = InterfaceShape::Line(OutlineSetup { place: [-3.0, 0.0], ..OutlineSetup::of_points(points) });
    let interfaces = vec![InterfaceSetup { height: 1.0, shape, ..InterfaceSetup::passive(10.0) }];
    let setup =
        Setup { region: Region::Channel { length: 6.0, width: 6.0, drive: Drive::ZeroGradient }, ..Setup::default() };
    let setup = Setup { droplets: Vec::new(), interfaces, ..setup };
    let built = setup.build().unwrap();
    let markers = built.scene.system().markers().positions().to_vec();
    let off = |p: &Vec2| p.y - 1.0 - 0.3 * (TAU * (p.x + 3.0) / 6.0).sin();
    assert!(markers.iter().all(|marker| off(marker).abs() < 1e-5));
}
