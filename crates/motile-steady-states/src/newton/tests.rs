use std::f64::consts::TAU;

use motile::prelude::*;

use crate::Profile;
use crate::modes::Part;
use crate::system::System;

/// A circle of another size, or with other particles, is at rest too: it is none of the droplet's states.
#[test]
fn the_area_and_the_particles_become_those_of_the_droplet() {
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 128 });
    let droplets = vec![DropletSetup::contractile(-0.2, 10.0)];
    let setup = Setup { method, region: Region::Plane, droplets, ..Setup::default() };
    for (size, filling) in [(1.02, 1.0), (1.0, 0.97)] {
        let mut system = System::new(&setup).unwrap();
        let (nodes, mean) = (system.model.nodes(), system.model.concentration);
        let positions = (0..nodes).map(|k| size * Vec2::from_angle(TAU * k as f64 / nodes as f64)).collect();
        let profile = Profile { positions, density: vec![filling * mean; nodes], nuclei: Vec::new() };
        let mut point = system.point(&profile, [0.0; 3]).unwrap();
        system.load(&point).unwrap();
        assert!(system.model.lacks().iter().any(|lack| lack.abs() > 0.01));
        system.newton(&mut point, Part::Even, None).unwrap();
        system.load(&point).unwrap();
        assert!(system.model.lacks().iter().all(|lack| lack.abs() < 1e-9), "{:?}", system.model.lacks());
    }
}
