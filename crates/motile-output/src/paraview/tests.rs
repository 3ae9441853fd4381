use super::*;
use motile::prelude::*;
use motile::setup::DropletShape;

#[test]
fn each_droplet_has_its_own_forces_and_velocities() {
    // The second droplet has more markers, so that forces by wrong ranges could not be missed.
    let small = DropletShape::Round { radius: 0.8 };
    let setup = Setup {
        region: Region::Box { lengths: [8.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: vec![
            DropletSetup { centre: [-2.0, 0.0], shape: small, ..DropletSetup::default() },
            DropletSetup { centre: [2.0, 0.0], ..DropletSetup::active(-4.0) },
        ],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    let handles = [droplets[0], droplets[1]];
    let raster = Raster::of(scene.system(), 0.25).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    assert_ne!(seen.droplets[0].markers.len(), seen.droplets[1].markers.len());

    let states = handles.map(|handle| InterfaceState::of(scene.system(), handle).unwrap());
    for state in &states {
        // Tension alone puts no net force on the fluid.
        let (sum, largest) = state.forces.iter().fold((Vec2::ZERO, 0.0_f64), |(s, m), f| (s + f, m.max(f.length())));
        assert!(sum.length() < 1e-10 * largest, "{sum} of {largest}");
    }
    let both = |pick: fn(&InterfaceState<'_>) -> Vec<Vec2>| states.iter().flat_map(pick).collect::<Vec<Vec2>>();
    let tensions: Vec<f64> =
        handles.iter().flat_map(|&handle| at_markers(scene.body(handle).unwrap().tensions())).collect();
    let expected = VtkFile::closed_lines(&[states[0].markers.to_vec(), states[1].markers.to_vec()])
        .point_scalars("concentration", seen.droplets.iter().flat_map(|droplet| droplet.concentration.clone()))
        .point_scalars("tension", tensions)
        .point_vectors("velocity", both(|state| state.velocities.to_vec()))
        .point_vectors("force", both(|state| state.forces.to_vec()))
        .cell_scalars("droplet", [0.0, 1.0]);
    assert_eq!(interfaces(scene.system(), &seen).unwrap(), expected);
}
