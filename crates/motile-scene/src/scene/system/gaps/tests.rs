use crate::error::refused;
use std::f64::consts::TAU;

use crate::hydrodynamics::tests::DragBox;
use crate::{
    Body, BodyError, FluidView, MarkerBody, MarkerKind, Observer, Scene, SceneError, StepSize,
    gap::{SolidGap, SurfaceCurve},
};
use motile_base::Vec2;

/// A box of 3.2 by 3.2 with fluid of viscosity 10 and grid spacing 0.1.
fn scene() -> Scene<DragBox> {
    Scene::new(DragBox::new(3.2, 10.0, 0.1)).with_step_size(StepSize::Fixed(0.05))
}

fn circle(centre: Vec2, radius: f64) -> Vec<Vec2> {
    let count = (TAU * radius / 0.08).ceil().max(16.0);
    (0..count as usize)
        .map(|k| centre + radius * Vec2::new((TAU * k as f64 / count).cos(), (TAU * k as f64 / count).sin()))
        .collect()
}

/// An interface without tension that moves at `velocity` with no regard to the fluid.
fn ring(name: &str, centre: Vec2, radius: f64, viscosity_inside: Option<f64>, velocity: Vec2) -> MarkerBody {
    MarkerBody::new(name, circle(centre, radius), |_, _| {})
        .with_kind(MarkerKind::Interface { viscosity_inside })
        .with_motion(move |_, _, rates| rates.fill(velocity))
}

/// A disc that stays where it is.
#[derive(Debug)]
struct Disc(Vec<Vec2>);

impl Body for Disc {
    fn name(&self) -> &str {
        "disc"
    }
    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }
    fn marker_count(&self) -> usize {
        self.0.len()
    }
    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.0);
    }
    fn write_forces(&mut self, _: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(Vec2::ZERO);
        Ok(())
    }
    fn state_len(&self) -> usize {
        0
    }
    fn write_state(&self, _: &mut [f64]) {}
    fn read_state(&mut self, _: &[f64]) -> Result<(), BodyError> {
        Ok(())
    }
    fn rate(&mut self, _: &[Vec2], _: &mut [f64]) {}
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        vec![SurfaceCurve::through(0..self.0.len(), 0)]
    }
}

/// In its middle, near its edge, and in the image of it beyond the edge of the box.
#[test]
fn bodies_know_the_fluid_around_them() {
    for place in [Vec2::ZERO, Vec2::new(0.6, 0.0), Vec2::new(-3.2, 3.2 + 0.3)] {
        let mut scene = scene();
        let inmost = scene.add(ring("inmost", place, 0.12, Some(7.0), Vec2::ZERO));
        let outer = scene.add(ring("outer", Vec2::ZERO, 1.0, Some(100.0), Vec2::ZERO));
        let inner = scene.add(ring("inner", place, 0.3, None, Vec2::ZERO));
        scene.run(0.1).go().unwrap();
        let around = [outer, inner, inmost].map(|body| scene.system().fluid_around(body).unwrap().viscosity);
        // The inner one has no viscosity of its own.
        assert_eq!(around, [10.0, 100.0, 100.0]);
        let groups = scene.system().markers().groups();
        assert_eq!([1, 2, 0].map(|k| groups[k].viscosities(10.0)), [[100.0, 10.0], [100.0; 2], [7.0, 100.0]]);
    }
}

#[test]
fn crossing_out_of_an_interface_is_the_error() {
    let mut scene = scene();
    scene.add(ring("outer", Vec2::ZERO, 1.0, None, Vec2::ZERO));
    scene.add(ring("inner", Vec2::new(0.5, 0.0), 0.3, None, Vec2::new(1.0, 0.0)));
    let error = scene.run(1.0).go().unwrap_err();
    let SceneError::Crossing { body, other, depth, .. } = error else { panic!("{error}") };
    assert_eq!((body.as_str(), other.as_str()), ("inner", "outer"));
    // The gap was 0.2.
    assert!((scene.time() - 0.2).abs() < 1e-12 && depth > 0.002, "{} {depth}", scene.time());
}

/// Each step takes them 0.01 closer.
#[test]
fn droplets_driven_into_one_another_end_the_run_where_they_cross() {
    let mut scene = scene();
    scene.add(ring("left", Vec2::new(-0.5, 0.0), 0.4, None, 0.1 * Vec2::X));
    scene.add(ring("right", Vec2::new(0.5, 0.0), 0.4, None, -0.1 * Vec2::X));
    let error = scene.run(2.0).go().unwrap_err();
    let SceneError::Crossing { depth, .. } = error else { panic!("{error}") };
    assert!((scene.time() - 1.0).abs() < 1e-12 && depth < 0.011, "{} {depth}", scene.time());
    assert!(scene.system().minimum_gap().unwrap() > -0.002);
}

/// A disc that a ring touches, as deep as is allowed, is nearer than the ring that comes into it on the other side.
#[test]
fn each_gap_is_judged_by_itself() {
    let mut scene = scene();
    scene.add(Disc(circle(Vec2::new(-0.79, 0.0), 0.4)));
    scene.add(ring("left", Vec2::ZERO, 0.4, None, Vec2::ZERO));
    scene.add(ring("right", Vec2::new(1.0, 0.0), 0.4, None, -0.1 * Vec2::X));
    let error = scene.run(4.0).go().unwrap_err();
    let SceneError::Crossing { body, other, depth, .. } = error else { panic!("{error}") };
    assert!(depth < 0.008 && scene.system().minimum_gap().unwrap() < -0.0099, "{depth}");
    assert!([&body, &other].iter().all(|name| ["left", "right"].contains(&name.as_str())), "{body} {other}");
}

#[test]
fn a_jump_into_another_interface_ends_the_run() {
    let mut scene = scene().with_step_size(StepSize::Fixed(1.0));
    scene.add(ring("outer", Vec2::ZERO, 1.0, None, Vec2::ZERO));
    scene.add(ring("third", Vec2::new(-0.3, 0.0), 0.25, Some(2.0), Vec2::ZERO));
    // It crosses the film between the two in one step, half of which would end in it.
    let inner = scene.add(ring("inner", Vec2::new(0.5, 0.0), 0.12, None, Vec2::new(-0.8, 0.0)));
    let error = scene.run(1.0).go().unwrap_err();
    let SceneError::Containment { body, before, now, .. } = &error else { panic!("{error}") };
    assert_eq!([body.as_str(), before, now], ["inner", "inside outer", "inside third"]);
    // By hand it may be moved there.
    for marker in scene.body_mut(inner).unwrap().markers_mut() {
        *marker -= Vec2::new(0.8, 0.0);
    }
    scene.system_mut().evaluate().unwrap();
    assert_eq!(scene.system().fluid_around(inner).unwrap().viscosity, 2.0);
}

#[test]
fn bodies_that_overlap_at_the_start_are_to_be_moved_apart() {
    let centre = |x: f64| Vec2::new(x, 0.0);
    let disc = |x: f64| Disc(circle(centre(x), 0.5));
    let overlap = |scene: &mut Scene<DragBox>| {
        let error = scene.run(0.1).go().unwrap_err();
        assert!(error.to_string().ends_with("Move the bodies apart"), "{error}");
        assert_eq!(scene.steps(), 0);
        let SceneError::Overlap { depth, .. } = error else { panic!("{error}") };
        depth
    };
    // Two solids, also over the edge of the box.
    for apart in [0.9, 3.2 - 0.9] {
        let mut scene = scene();
        scene.add(disc(0.0));
        scene.add(disc(apart));
        assert!((overlap(&mut scene) - 0.1).abs() < 0.001);
    }
    // Two that touch.
    let mut touching = scene();
    touching.add(disc(0.0));
    touching.add(disc(0.99));
    touching.run(0.1).go().unwrap();
    // Two interfaces, an interface and a solid.
    let mut interfaces = scene();
    interfaces.add(ring("left", centre(0.0), 0.5, None, Vec2::ZERO));
    interfaces.add(ring("right", centre(0.9), 0.5, None, Vec2::ZERO));
    assert!((overlap(&mut interfaces) - 0.1).abs() < 0.001);
    let mut mixed = scene();
    mixed.add(ring("left", centre(0.0), 0.5, None, Vec2::ZERO));
    mixed.add(disc(0.9));
    assert!((overlap(&mut mixed) - 0.1).abs() < 0.001);
    // A nucleus.
    let mut nucleus = scene();
    nucleus.add(ring("cell", centre(0.0), 1.0, None, Vec2::ZERO));
    nucleus.add(disc(0.4));
    nucleus.run(0.1).go().unwrap();
    let gap = nucleus.system().minimum_gap().unwrap();
    assert!((gap - 0.1).abs() < 3e-4, "{gap}");
}

#[test]
fn the_gap_between_any_two_bodies() {
    let mut scene = scene();
    let cell = scene.add(ring("cell", Vec2::ZERO, 1.0, None, Vec2::ZERO));
    let nucleus = scene.add(Disc(circle(Vec2::new(0.4, 0.0), 0.5)));
    let square = [(1.3, 1.3), (1.5, 1.3), (1.5, 1.5), (1.3, 1.5)].map(|(x, y)| Vec2::new(x, y));
    let island = scene.add(Disc(square.to_vec()));
    let point = scene.add(MarkerBody::new("point", vec![Vec2::new(1.4, 1.2)], |_, _| {}));
    let gap =
        |scene: &Scene<DragBox>, other: crate::Handle<dyn Body>| scene.system().gap(cell, other).unwrap().unwrap();
    // From within, and the corner of a square that stands on no marker's way; a point has no boundary but a place.
    assert!((gap(&scene, nucleus.into()) - 0.1).abs() < 3e-4);
    assert!((gap(&scene, island.into()) - (1.3 * 2.0_f64.sqrt() - 1.0)).abs() < 4e-4);
    assert!((gap(&scene, point.into()) - (1.4_f64.hypot(1.2) - 1.0)).abs() < 2e-4);
    assert!((scene.system().gap(point, island).unwrap().unwrap() - 0.1).abs() < 1e-12);
    // Over the edge of the box, overlapping.
    scene.body_mut(cell).unwrap().markers_mut().iter_mut().for_each(|marker| marker.x -= 2.3);
    assert!((scene.system().gap(cell, island).unwrap().unwrap() - (1.3_f64.hypot(0.4) - 1.0)).abs() < 4e-7);
    // A disc in a disc overlaps it: from its rim, not from within.
    let core = scene.add(Disc(circle(Vec2::new(1.4, 1.4), 0.02)));
    assert!((scene.system().gap(island, core).unwrap().unwrap() + 0.1).abs() < 0.03);
    let mut other = self::scene();
    let foreign = other.add(Disc(square.to_vec()));
    let error = scene.system().gap(cell, foreign).unwrap_err();
    assert!(refused(&error, "the handle is of a body of another scene"), "{error}");
}

/// A long interface along either diagonal of the box comes near its own image there.
#[test]
fn images_across_the_corners_are_looked_at() {
    for sign in [1.0, -1.0] {
        let tip = 2.2;
        let markers = (0..200).map(|k| TAU * f64::from(k) / 200.0).map(|t| {
            let [along, across] = [tip * t.cos(), 0.3 * t.sin()].map(|x| x * 0.5_f64.sqrt());
            Vec2::new(along - sign * across, sign * along + across)
        });
        let mut scene = scene();
        scene.add(
            MarkerBody::new("long", markers.collect(), |_, _| {})
                .with_kind(MarkerKind::Interface { viscosity_inside: None })
                .with_motion(|_, _, rates| rates.fill(Vec2::ZERO)),
        );
        scene.run(0.1).go().unwrap();
        let gap = scene.system().minimum_gap().unwrap();
        assert!((gap - (3.2 * 2.0_f64.sqrt() - 2.0 * tip)).abs() < 1e-12, "{sign}: {gap}");
    }
}

/// Of an interface that passes another one.
#[test]
fn the_smallest_gap_is_that_of_the_nearest_approach() {
    let mut scene = scene();
    scene.add(ring("still", Vec2::new(-0.4, 0.0), 0.4, None, Vec2::ZERO));
    scene.add(ring("passing", Vec2::new(0.5, -0.35), 0.4, None, Vec2::new(0.0, 1.0)));
    scene.run(0.7).go().unwrap();
    let gap = scene.system().minimum_gap().unwrap();
    assert!((gap - 0.1).abs() < 1e-12, "{gap}");
}

#[test]
fn the_minimum_gap_is_at_most_the_present_one() {
    // A sharp corner between two markers of a cell, seen from the corner alone.
    let mut scene = scene();
    let cell = scene.add(ring("cell", Vec2::ZERO, 1.0, None, Vec2::ZERO));
    let tip = [(0.93, 0.04), (0.3, 0.4), (0.3, -0.3)].map(|(x, y)| Vec2::new(x, y));
    let nucleus = scene.add(Disc(tip.to_vec()));
    scene.run(0.1).go().unwrap();
    let present = scene.system().gap(cell, nucleus).unwrap().unwrap();
    assert!(present < 0.08 && scene.system().minimum_gap().unwrap() <= present);
    // Also where nothing looks for it: here far, then nearer than ever, then far again.
    let mut far = self::scene();
    let left = far.add(ring("left", Vec2::new(-0.8, 0.0), 0.3, None, Vec2::new(0.1, 0.0)));
    let right = far.add(ring("right", Vec2::new(0.8, 0.0), 0.3, None, Vec2::ZERO));
    for until in [0.0, 1.0, 2.0] {
        far.run(until).go().unwrap();
        let present = far.system().gap(left, right).unwrap().unwrap();
        assert!((present - (1.0 - 0.1 * until)).abs() < 1e-12, "{present}");
        assert_eq!(far.system().minimum_gap(), Some(present));
    }
    // The start counts too.
    let mut parting = self::scene();
    parting.add(ring("left", Vec2::new(-0.4, 0.0), 0.3, None, Vec2::new(-0.5, 0.0)));
    parting.add(ring("right", Vec2::new(0.4, 0.0), 0.3, None, Vec2::ZERO));
    parting.run(0.5).go().unwrap();
    assert!((parting.system().minimum_gap().unwrap() - 0.2).abs() < 1e-12);
}

#[test]
fn bodies_of_the_same_name_are_told_apart() {
    let mut scene = scene();
    scene.add(Disc(circle(Vec2::ZERO, 0.5)));
    scene.add(Disc(circle(Vec2::ZERO, 0.5)));
    let error = scene.run(0.1).go().unwrap_err();
    let SceneError::Overlap { body, other, depth, .. } = &error else { panic!("{error}") };
    assert_eq!((body.as_str(), other.as_str()), ("disc (body 1)", "disc (body 0)"));
    assert!((depth - 0.5).abs() < 0.02, "{depth}");
}

/// However wide the bound is against the grid.
#[test]
fn a_wide_bound_on_gaps_ends_the_run_too() {
    let mut scene = scene().with_least_gap(0.7).unwrap();
    scene.add(ring("left", Vec2::new(-0.7, 0.0), 0.3, None, Vec2::new(0.1, 0.0)));
    scene.add(ring("right", Vec2::new(0.7, 0.0), 0.3, None, Vec2::ZERO));
    match scene.run(3.0).go().unwrap_err() {
        error @ SceneError::Gap { .. } => {
            let SceneError::Gap { time, gap, bound, x, y, .. } = error else { return };
            assert!(bound == 0.7 && (0.68..0.7).contains(&gap), "{gap}");
            assert!((x - (-0.4 + 0.1 * time)).abs() < 0.01 && y.abs() < 1e-12, "{x} {y}");
            assert!(error.to_string().contains(&format!("at ({x:.4}, {y:.4})")), "{error}");
            assert!((0.95..1.2).contains(&time), "{time}");
        }
        other => panic!("{other}"),
    }
}

#[test]
fn the_least_gap_to_solids_is_kept_with_its_time() {
    let mut scene = scene();
    scene.add(Disc(circle(Vec2::new(-1.0, 0.0), 0.3)));
    // From 0.8 to 0.3 to 0.6.
    let ring = scene.add(ring("ring", Vec2::new(0.5, 0.0), 0.4, None, Vec2::ZERO));
    let mut gap = SolidGap::new(0.1);
    for (shift, present) in [(0.0, 0.8), (-0.5, 0.3), (0.3, 0.6)] {
        for marker in scene.body_mut(ring).unwrap().markers_mut() {
            marker.x += shift;
        }
        gap.observe(scene.system_mut()).unwrap();
        assert!((gap.present().unwrap() - present).abs() < 1e-12, "{gap:?}");
        scene.step(0.05).unwrap();
    }
    let (found, time) = gap.smallest().unwrap();
    assert!((found - 0.3).abs() < 1e-12 && time == 0.05, "{found} {time}");
}

/// Bodies inside another one are given with their own viscosity and that of the fluid around them.
#[test]
fn bodies_inside_have_their_viscosities() {
    let mut scene = scene();
    let outer = scene.add(ring("outer", Vec2::ZERO, 1.0, Some(100.0), Vec2::ZERO));
    scene.add(ring("inner", Vec2::new(0.3, 0.1), 0.3, Some(7.0), Vec2::ZERO));
    scene.system_mut().evaluate().unwrap();
    let enclosed = scene.system().flow_at(outer).unwrap().enclosed();
    assert_eq!(enclosed.len(), 1);
    assert_eq!(enclosed[0].viscosities, [7.0, 100.0]);
    assert_eq!(enclosed[0].positions.len(), circle(Vec2::ZERO, 0.3).len());
}

/// Two interfaces across a box that both have their inside above would bound layers of two viscosities each.
#[test]
fn layers_of_two_viscosities_are_refused() {
    let built = |inside: Option<f64>, turned: bool| {
        let mut scene = scene();
        for (name, y, over) in [("first", -0.8, false), ("second", 0.8, turned)] {
            let line = (0..40).map(|k| Vec2::new(0.08 * f64::from(if over { 39 - k } else { k }) - 1.6, y)).collect();
            let advance = if over { -3.2 } else { 3.2 };
            let kind = MarkerKind::OpenInterface { viscosity_inside: inside, advance };
            scene.add(MarkerBody::new(name, line, |_, _| {}).with_kind(kind));
        }
        scene.system_mut().evaluate().map(drop)
    };
    assert!(built(None, false).is_ok() && built(Some(10.0), false).is_ok() && built(Some(30.0), true).is_ok());
    let error = built(Some(30.0), false).unwrap_err();
    assert!(refused(&error, "the fluid between") && error.to_string().contains("30 and 10"), "{error}");
}

/// Two rings that pass each other at 0.4, eight times the distance of their markers and four grid spacings, and are far
/// apart again at the end.
#[test]
fn the_smallest_gap_is_known_however_wide() {
    let mut scene = scene();
    scene.add(ring("left", Vec2::new(-1.0, 0.0), 0.3, None, Vec2::ZERO));
    let start = Vec2::new(0.05, -0.6);
    scene.add(ring("right", start, 0.3, None, Vec2::new(0.0, 0.5)));
    // Until it is as far above as it was below.
    scene.run(2.4).go().unwrap();
    let (least, end) = (scene.system().minimum_gap().unwrap(), f64::hypot(1.05, 0.6) - 0.6);
    // The corners of the polygons are on the circles, their sides are not.
    assert!((0.45 - 1e-9..0.453).contains(&least) && least < end - 0.1, "{least} {end}");
}

/// A bound on gaps does not end a run for two solids, which is told.
#[test]
fn solids_below_the_bound_are_told() {
    let causes = |bound: f64| {
        let mut scene = scene().with_least_gap(bound).unwrap();
        scene.add(Disc(circle(Vec2::new(-0.6, 0.0), 0.5)));
        scene.add(Disc(circle(Vec2::new(0.6, 0.0), 0.5)));
        scene.run(0.1).go().unwrap();
        let warnings = scene.system_mut().warnings();
        warnings.iter().map(|warning| (warning.cause.to_string(), warning.excess)).collect::<Vec<_>>()
    };
    assert!(causes(0.19).is_empty());
    let told = causes(0.3);
    assert!(told.len() == 1 && told[0].0 == "gap between solids" && (told[0].1 - 1.5).abs() < 0.01, "{told:?}");
}
