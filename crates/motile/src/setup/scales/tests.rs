use super::*;
use crate::setup::{DropletSetup, FlowSetup, InterfaceSetup, RigidBodySetup};
use motile_base::Region;

#[test]
fn scales_of_scenes() {
    let bare = Setup { droplets: Vec::new(), ..Setup::default() };
    let of = |radius: f64| Setup { droplets: vec![DropletSetup::default().with_radius(radius)], ..Setup::default() };
    assert_eq!((of(1.0).length_scale(), of(1.0).length_unit()), (1.0, "R_{0}"));
    assert_eq!((of(10.0).length_scale(), of(10.0).length_unit()), (10.0, ""));
    assert_eq!((bare.length_scale(), bare.length_unit()), (1.0, ""));
    let bodies = vec![RigidBodySetup::disc(0.3)];
    assert_eq!(Setup { rigid_bodies: bodies, ..bare.clone() }.length_scale(), 0.3);
    assert_eq!(Setup { region: Region::Box { lengths: [60.0, 30.0] }, ..bare.clone() }.length_scale(), 5.0);
    assert_eq!(Setup { region: Region::Plane, ..bare.clone() }.length_scale(), 1.0);

    // 0.1 R^2/D with D = 0.1, 0.1 eta R/gamma with eta = 100, 1/G.
    assert!((of(1.0).time_scale() - 1.0).abs() < 1e-12 && (of(2.0).time_scale() - 4.0).abs() < 1e-12);
    let passive = Setup { droplets: vec![DropletSetup::passive(5.0)], ..Setup::default() };
    assert!((passive.time_scale() - 2.0).abs() < 1e-12);
    let interfaces = vec![InterfaceSetup::active(-0.5)];
    assert!((Setup { interfaces, ..bare.clone() }.time_scale() - 1.0).abs() < 1e-12);
    let flow = FlowSetup { extension: 0.5, ..FlowSetup::default() };
    assert!((Setup { flow, region: Region::Plane, ..bare.clone() }.time_scale() - 2.0).abs() < 1e-12);
    assert_eq!(bare.time_scale(), 1.0);
}
