//! The solid as a body, and what is measured on it.

use crate::error::refused;
use motile_base::InputError;
use motile_scene::{
    Body, BodyError, Domain, FluidView, MarkerBody, MarkerKind, Scene, Substrate,
    gap::{Boundary, Repulsion, SurfacePoint},
};

use super::*;
use crate::channel::{ChannelShape, width_between};
use crate::material::Mat2;
use crate::mesh::{equilateral_block, equilateral_strip};
use crate::{Mesher, NeoHookean};

pub(crate) fn fluid_view() -> FluidView {
    let domain = Domain { origin: [-2.0, -2.0], periods: [Some(4.0), None].into(), walls: Some([-2.0, 2.0]) };
    FluidView {
        domain,
        viscosity: 10.0,
        spacing: Some(0.2),
        second_order: true,
        shape_modes: None,
        nodes: None,
        interface_stiffness: 1.0,
    }
}

fn block() -> TriangleMesh {
    equilateral_block(Vec2::new(-1.0, -1.0), 8, 8, 0.2).unwrap()
}

fn shear(s: Vec2) -> Vec2 {
    Vec2::new(s.x + 0.2 * s.y, s.y)
}

#[test]
fn pinned_points_are_no_markers() {
    let bottom = |s: Vec2| s.y < -0.99;
    let mut solid = Solid::springs(block(), 1.0).unwrap().pinned(bottom).unwrap().deformed(shear).unwrap();
    let (all, free) = (solid.mesh().points().len(), solid.free_points().len());
    assert_eq!(all - free, 9);
    assert_eq!((solid.marker_count(), solid.state_len(), solid.kind()), (free, 2 * free, MarkerKind::Points));
    let mut markers = vec![Vec2::ZERO; free];
    solid.write_markers(&mut markers);
    assert!(markers.iter().all(|marker| marker.y > -0.99));
    // Free points feel the pinned ones, so their forces alone do not sum to zero.
    let mut forces = vec![Vec2::ZERO; free];
    solid.write_forces(&fluid_view(), &mut forces).unwrap();
    assert!(forces.iter().sum::<Vec2>().length() > 0.1);
    // Move all by the state: pinned points stay.
    let before = solid.positions().to_vec();
    let mut state = vec![0.0; 2 * free];
    solid.write_state(&mut state);
    state.iter_mut().for_each(|x| *x += 0.5);
    solid.read_state(&state).unwrap();
    for (point, (old, new)) in before.iter().zip(solid.positions()).enumerate() {
        let expected = if bottom(solid.mesh().points()[point]) { *old } else { old + Vec2::splat(0.5) };
        assert_eq!(*new, expected);
    }
    assert!(matches!(
        Solid::springs(block(), 1.0).unwrap().pinned(|_| true),
        Err(SolidError::Input(InputError::TooFew { .. }))
    ));
}

/// Overdamped motion along the forces: the energy falls to zero and the shape returns.
#[test]
fn a_deformed_solid_relaxes() {
    let mut solid = Solid::hyperelastic(block(), NeoHookean::new(1.0, 2.0).unwrap())
        .pinned(|s| s.y < -0.99)
        .unwrap()
        .deformed(shear)
        .unwrap();
    let count = solid.marker_count();
    let (mut forces, mut state, mut rate) = (vec![Vec2::ZERO; count], vec![0.0; 2 * count], vec![0.0; 2 * count]);
    // The pinned row was sheared too; put it back.
    let points: Vec<Vec2> = solid.mesh().points().to_vec();
    let back: Vec<Vec2> =
        points.iter().zip(solid.positions()).map(|(s, x)| if s.y < -0.99 { *s } else { *x }).collect();
    solid.set_positions(&back).unwrap();
    let mut energy = solid.elastic_energy().unwrap();
    let start = energy;
    for _ in 0..4000 {
        solid.write_forces(&fluid_view(), &mut forces).unwrap();
        solid.rate(&forces, &mut rate);
        solid.write_state(&mut state);
        state.iter_mut().zip(&rate).for_each(|(x, r)| *x += 0.1 * r);
        solid.read_state(&state).unwrap();
        solid.end_step(&fluid_view(), 0.1).unwrap();
        let now = solid.elastic_energy().unwrap();
        assert!(now <= energy);
        energy = now;
    }
    assert!(energy < 1e-6 * start, "{start} {energy}");
    assert!(Deformation::of(&solid).largest_displacement < 1e-3);
}

#[test]
fn tethers_pull_back_to_their_anchors() {
    let mut solid = Solid::springs(block(), 1.0)
        .unwrap()
        .tethered(3.0, |s| s.y < -0.99)
        .unwrap()
        .deformed(|s| s + Vec2::new(0.1, 0.0))
        .unwrap();
    assert_eq!(solid.tethers().len(), 9);
    assert!((solid.tether_energy() - 9.0 * 0.5 * 3.0 * 0.01).abs() < 1e-14);
    assert!(solid.elastic_energy().unwrap() < 1e-20);
    let mut forces = vec![Vec2::ZERO; solid.marker_count()];
    solid.write_forces(&fluid_view(), &mut forces).unwrap();
    assert!((forces.iter().sum::<Vec2>() - Vec2::new(-9.0 * 0.3, 0.0)).length() < 1e-12);
    // Nine tethers over 1.6 + 0.2 in a channel of height 4, shorter than half of which they do not count: 27/2 (1 -
    // 0.148 * 0.2).
    let held = 13.5 * (1.0 - 0.148 * 0.2);
    let elastic = 1.0 + 0.015 * 2.0;
    assert!((limit(&solid, &fluid_view()) - 20.0 / (held + elastic)).abs() < 1e-12);
    // A column in a box of height 1.6: as long as it is high, 30/(1.6 + 0.2) 1.6/12 of its nine rows and a spacing.
    let domain = Domain { origin: [0.0; 2], periods: [Some(1.6); 2].into(), walls: None };
    let count = 1.0 / block().points().iter().filter(|s| s.x < -0.79).count() as f64;
    let column = Solid::springs(block(), 1.0).unwrap().tethered(30.0 * count, |s| s.x < -0.79).unwrap();
    let height = block().points().iter().map(|s| s.y + 1.0).fold(0.0, f64::max) + column.spacing;
    let held = 30.0 / height * 1.6 / 12.0;
    assert!((limit(&column, &FluidView { domain, ..fluid_view() }) - 20.0 / (held + elastic)).abs() < 1e-12);
    for bad in [0.0, -1.0, f64::NAN] {
        assert!(matches!(
            solid.clone().tethered(bad, |_| true),
            Err(SolidError::Input(InputError::NotPositive { .. }))
        ));
    }
    assert!(matches!(solid.tethered(1.0, |_| false), Err(SolidError::Input(InputError::TooFew { .. }))));
}

/// The one stable step that a solid states.
pub(crate) fn limit(solid: &Solid, view: &FluidView) -> f64 {
    let mut dt = f64::NAN;
    solid.step_limits(view, &mut |limit| dt = limit.dt);
    dt
}

#[test]
fn step_limits_follow_the_moduli() {
    let of = |shear: f64, bulk: f64, grid: Option<f64>| {
        let solid = Solid::hyperelastic(block(), NeoHookean::new(shear, bulk).unwrap());
        limit(&solid, &FluidView { spacing: grid, ..fluid_view() })
    };
    assert!((of(4.0, 8.0, Some(0.2)) - 20.0 / (4.0 + 0.12)).abs() < 1e-12);
    // Without a grid, nothing says that the fluid keeps areas.
    assert!((of(4.0, 8.0, None) - 20.0 / 12.0).abs() < 1e-12);
    // Coarser than the grid, the bulk modulus counts.
    assert!((of(4.0, 80.0, Some(0.1)) - 20.0 / (4.0 + 0.015 * 320.0)).abs() < 1e-12);
    let graded = Solid::springs_graded(block(), |s| 2.0 + s.x).unwrap();
    // The rightmost triangle's centroid stands less than 0.6 right of the origin.
    let dt = limit(&graded, &fluid_view());
    assert!(dt > 20.0 / 2.6 && dt < 20.0 / 2.3, "{dt}");
}

#[test]
fn bad_states_are_refused() {
    let mut solid = Solid::springs(block(), 1.0).unwrap();
    let mut state = vec![0.0; solid.state_len()];
    solid.write_state(&mut state);
    state[5] = f64::NAN;
    assert!(matches!(solid.read_state(&state), Err(BodyError::NonFinite { index: 5, .. })));
    assert!(matches!(solid.set_positions(&[]), Err(SolidError::Input(InputError::WrongLength { .. }))));
    assert!(matches!(solid.clone().deformed(|s| s / 0.0), Err(SolidError::Input(InputError::EntryNotFinite { .. }))));
    // Springs do not mind a mirror image, the step does, unless it may be.
    let mirrored = solid.deformed(|s| Vec2::new(-s.x, s.y)).unwrap();
    assert!(mirrored.elastic_energy().unwrap() < 1e-20);
    assert!((mirrored.smallest_jacobian().0 + 1.0).abs() < 1e-12);
    assert!(mirrored.clone().end_step(&fluid_view(), 0.1).is_err());
    assert!(matches!(mirrored.stresses(), Err(SolidError::Inverted { .. })));
    assert!(mirrored.allow_inversion().end_step(&fluid_view(), 0.1).is_ok());
    let other = Springs::new(&equilateral_strip(Vec2::ZERO, 5, 3, 1.0).unwrap(), 1.0).unwrap();
    assert!(matches!(Solid::with_forces(block(), other), Err(SolidError::Input(InputError::WrongLength { .. }))));
}

#[test]
fn observables_of_a_uniform_deformation() {
    let a = Mat2::from_rows_array(&[1.1, 0.2, 0.0, 0.9]);
    let shift = Vec2::new(0.3, -0.2);
    let solid = Solid::hyperelastic(block(), NeoHookean::new(2.0, 5.0).unwrap()).deformed(|s| a * s + shift).unwrap();
    assert!(solid.jacobians().all(|jacobian| (jacobian - 0.99).abs() < 1e-12));
    let gradient = crate::material::DeformationGradient::new(a).unwrap();
    let material = NeoHookean::new(2.0, 5.0).unwrap();
    let expected = material.cauchy_stress(&gradient);
    for (triangle, stress) in solid.stresses().unwrap().iter().enumerate() {
        for difference in [*stress - expected, solid.gradient(triangle).unwrap() - a] {
            assert!(difference.to_cols_array().iter().all(|entry| entry.abs() <= 5e-13));
        }
    }
    let energy = material.energy(&gradient) * solid.mesh().area();
    assert!((solid.elastic_energy().unwrap() - energy).abs() < 1e-12);
    // The mean displacement is that of the centre of area.
    let centre: Vec2 =
        (0..solid.mesh().triangles().len()).map(|t| solid.mesh().centroid(t) * solid.mesh().areas()[t]).sum::<Vec2>()
            / solid.mesh().area();
    let seen = Deformation::of(&solid);
    assert!((seen.drift - (a * centre + shift - centre)).length() < 1e-13);
    assert!((seen.centroid - (a * centre + shift)).length() < 1e-13);
    assert!((seen.smallest_jacobian - 0.99).abs() < 1e-12 && (seen.elastic_energy - energy).abs() < 1e-12);
    let flat = solid.deformed(|s| Vec2::new(s.x, 0.0)).unwrap();
    assert_eq!(Deformation::of(&flat).elastic_energy, f64::INFINITY);
}

#[test]
fn displacements_along_and_across_a_surface() {
    let strip = equilateral_strip(Vec2::ZERO, 20, 5, 0.1).unwrap();
    let slid = Solid::springs(strip.clone(), 1.0).unwrap().deformed(|s| s + Vec2::new(0.4, 0.0)).unwrap();
    let seen = Deformation::of(&slid);
    assert!((seen.largest_displacement - 0.4).abs() < 1e-14 && seen.largest_normal_displacement < 1e-14);
    let top = 5.0 * 0.1 * 0.75_f64.sqrt();
    // The top row is an odd one, half a spacing off.
    let bulged = |s: Vec2| s + Vec2::new(0.4, if (s.x - 0.55).abs() < 1e-9 { 0.05 * s.y / top } else { 0.0 });
    let seen = Deformation::of(&Solid::springs(strip, 1.0).unwrap().deformed(bulged).unwrap());
    assert!((seen.largest_normal_displacement - 0.05).abs() < 1e-12);
    assert!((seen.largest_displacement - 0.4_f64.hypot(0.05)).abs() < 1e-12);
}

#[test]
fn the_width_of_a_channel_between_deformed_walls() {
    // Chords of the ramp, of curvature pi^2/4, are off it by less than 0.05^2/8 pi^2/4 = 8e-4 on either side.
    let walls = ChannelShape::THESIS.channel(12.0).unwrap().walls(-2.5, 2.5, &Mesher::new(0.05).unwrap()).unwrap();
    let lower = Solid::springs(walls.lower, 1.0).unwrap();
    let upper = Solid::hyperelastic(walls.upper, NeoHookean::new(1.0, 2.0).unwrap());
    let width = width_between(&lower, &upper).unwrap();
    assert!((width.minimum - 1.0).abs() < 1e-12 && (width.maximum - 2.0).abs() < 1e-12);
    // The upper wall rises by 0.1 at x = 0 and slides on by many periods.
    let moved =
        upper.deformed(|s| Vec2::new(s.x + 120.0, s.y + 0.1 * (s.x * std::f64::consts::PI / 6.0).cos())).unwrap();
    let width = width_between(&lower, &moved).unwrap();
    let exact = |x: f64| {
        let ramp = (x.abs() - 2.0).clamp(0.0, 1.0);
        1.5 - 0.5 * (std::f64::consts::PI * ramp).cos() + 0.1 * (x * std::f64::consts::PI / 6.0).cos()
    };
    let narrowest = (0..1000).map(|k| 0.003 * f64::from(k)).min_by(|a, b| exact(*a).total_cmp(&exact(*b))).unwrap();
    assert!((width.minimum - exact(narrowest)).abs() < 2e-3, "{width:?} {}", exact(narrowest));
    let at = width.minimum_at - 12.0 * (width.minimum_at / 12.0).round();
    assert!((at.abs() - narrowest).abs() < 0.1, "{width:?} {narrowest}");
    let error = width_between(&moved, &Solid::springs(block(), 1.0).unwrap()).unwrap_err();
    assert!(refused(&error, "outlines have different periods"), "{error}");
}

#[test]
fn distances_from_a_wall_over_its_seam() {
    let wall = Solid::springs(equilateral_strip(Vec2::ZERO, 20, 10, 0.1).unwrap(), 1.0).unwrap();
    let periods = [Some(2.0), None];
    let boundary = Boundary::of(&wall, periods);
    let top = 0.75_f64.sqrt();
    for k in 0..200 {
        let x = -7.0 + 0.07 * f64::from(k);
        for height in [0.3, 0.01, -0.01, -0.3] {
            let [above, below] = [Vec2::new(x, top + height), Vec2::new(x, -height)];
            assert!((boundary.distance(above, periods) - height).abs() < 1e-12, "{x} {height}");
            assert!((boundary.distance(below, periods) - height).abs() < 1e-12, "{x} {height}");
        }
    }
    // Where the wall is now.
    let moved = Boundary::of(&wall.deformed(|s| Vec2::new(s.x + 3.3, 2.0 * s.y)).unwrap(), periods);
    assert!((moved.distance(Vec2::new(0.4, 2.0 * top + 0.05), periods) - 0.05).abs() < 1e-12);
}

/// A ring that sinks onto a block, whose upper side is pinned on the right: above the free half, where both meet, and
/// above the pinned half.
#[test]
fn surfaces_that_are_pinned_in_part_have_gaps_and_films() {
    let top = block().points().iter().map(|point| point.y).fold(f64::NEG_INFINITY, f64::max);
    let block = Solid::springs(block(), 1.0).unwrap().pinned(|s| s.x > -0.25 && s.y > top - 0.01).unwrap();
    let curves = block.surfaces();
    let fixed = curves[0].points.iter().filter(|(point, _)| matches!(point, SurfacePoint::Fixed(_))).count();
    assert_eq!((curves.len(), fixed), (1, block.mesh().points().len() - block.free_points().len()));
    assert!(fixed > 3 && fixed < 6, "{fixed}");
    for x in [-0.6, -0.25, 0.2] {
        let mut scene = Scene::new(Substrate::new(1.0).unwrap()).with_repulsion(Repulsion::new(1.0, 0.2).unwrap());
        let centre = Vec2::new(x, top + 0.5);
        let ring = (0..32).map(|k| centre + 0.4 * Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / 32.0));
        let ring = MarkerBody::new("ring", ring.collect(), |_, forces| forces.fill(-0.1 * Vec2::Y));
        let ring = scene.add(ring.with_kind(MarkerKind::Interface { viscosity_inside: None }));
        let solid = scene.add(block.clone());
        let system = scene.system_mut();
        system.evaluate().unwrap();
        let gap = system.gap(ring, solid).unwrap().unwrap();
        assert!((gap - 0.1).abs() < 1e-12, "{x}: {gap}");
        let pushed: Vec2 = system.flow_at(ring).unwrap().forces.iter().sum();
        assert!(pushed.y > -3.19, "{x}: {pushed}");
        let mut reasons = Vec::new();
        system.each_limit(&mut |limit, _| reasons.push(limit.reason));
        assert!(reasons.contains(&"the closing of a film"), "{x}: {reasons:?}");
    }
}

/// Sizes of the entries of the state: the radius of a disc of the same area, or the mean thickness of a periodic solid.
#[test]
fn scales_are_the_sizes_of_the_solid() {
    let of = |mesh: TriangleMesh| {
        let solid = Solid::springs(mesh, 1.0).unwrap();
        let mut scales = vec![0.0; solid.state_len()];
        solid.write_scales(&mut scales);
        scales
    };
    for unit in [1.0, 1e-3] {
        let block = equilateral_block(Vec2::ZERO, 8, 8, 0.2 * unit).unwrap();
        let radius = (block.area() / std::f64::consts::PI).sqrt();
        assert!(of(block).iter().all(|scale| (scale / radius - 1.0).abs() < 1e-12));
        // Six rows of triangles of the side 0.2, whatever the period.
        for columns in [10, 40] {
            let thickness = 6.0 * 0.2 * unit * 0.75_f64.sqrt();
            let scales = of(equilateral_strip(Vec2::ZERO, columns, 6, 0.2 * unit).unwrap());
            assert!(scales.iter().all(|scale| (scale / thickness - 1.0).abs() < 1e-12), "{scales:?}");
        }
    }
}
