use super::*;
use crate::{ElasticChannel, Swimmer};
use elastic_solids::{Moduli, NeoHookean, Solid, forces::Springs, mesh::equilateral_strip};
use ib_core::Vec2;

#[test]
fn a_droplet_inside_a_wall_is_an_error() {
    let swimmer = Swimmer { lengths: [4.0, 2.2], spacing: 0.2, ..Swimmer::default() };
    let channel = ElasticChannel::new(swimmer, Moduli::new(1.0, 2.0).unwrap());
    let (mut scene, _, walls) = channel.build().unwrap();
    let mut gap = SolidGap::new(0.05).with_set_back(channel.set_back());
    gap.observe(scene.system_mut()).unwrap();
    assert!((gap.present().unwrap() - 0.1).abs() < 2e-3, "{gap:?}");
    let lower = scene.body_mut(walls[0]).unwrap();
    let raised: Vec<_> = lower.positions().iter().map(|p| p + Vec2::new(0.0, 0.3)).collect();
    Solid::set_positions(lower, &raised).unwrap();
    let error = gap.observe(scene.system_mut()).unwrap_err();
    let entered: &SolidEntered = error.downcast_ref().unwrap();
    assert!((entered.depth - 0.2).abs() < 2e-3, "{entered}");
    assert_eq!(gap.smallest(), Some((-entered.depth, 0.0)));
}

/// Walls of springs, of a hyperelastic material and with forces of one's own are all seen.
#[test]
fn solids_of_every_material_are_seen() {
    let swimmer = Swimmer { lengths: [4.0, 4.0], spacing: 0.2, ..Swimmer::default() };
    let mesh = || equilateral_strip(Vec2::new(-2.0, -2.0), 20, 4, 0.2).unwrap();
    let top = -2.0 + 4.0 * 0.2 * 0.75_f64.sqrt();
    let solids = [
        Solid::springs(mesh(), 1.0).unwrap(),
        Solid::hyperelastic(mesh(), NeoHookean::new(1.0, 2.0).unwrap()),
        Solid::with_forces(mesh(), Springs::new(&mesh(), 1.0).unwrap()).unwrap(),
    ];
    for solid in solids {
        let (mut scene, _) = swimmer.build_on_grid().unwrap();
        scene.add(solid);
        let (gap, _) = SolidGap::new(0.0).measure(scene.system()).unwrap();
        assert!((gap - (-1.0 - top)).abs() < 2e-3, "{gap}");
    }
}
