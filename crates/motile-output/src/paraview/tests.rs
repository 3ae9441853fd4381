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

/// Runs one after the other, each of which shows its first state: every time is listed once.
#[test]
fn runs_in_a_row_list_each_time_once() {
    let method = Method::Grid(GridMethod::of_spacing(0.25));
    let Built { mut scene, .. } = Setup { method, ..Setup::default() }.build().unwrap();
    let directory = std::env::temp_dir().join(format!("motile-runs-in-a-row-{}", std::process::id()));
    let mut files = ParaView::create(&directory, Raster::of(scene.system(), 0.25).unwrap()).unwrap();
    for until in [0.2, 0.5, 0.8] {
        scene.run(until).observe(Every::Time(0.3), &mut files).go().unwrap();
    }
    for name in ["fields.pvd", "interface.pvd"] {
        let list = std::fs::read_to_string(directory.join(name)).unwrap();
        let times: Vec<f64> =
            list.split("timestep=\"").skip(1).map(|rest| rest.split('"').next().unwrap().parse().unwrap()).collect();
        assert!(times.len() >= 4 && times.windows(2).all(|pair| pair[0] < pair[1]), "{name}: {times:?}");
        assert!(times.contains(&0.2) && times.contains(&0.5), "{name}: {times:?}");
    }
    let record = &scene.system_mut().record_mut(RECORD).numbers;
    assert!(record.windows(2).all(|pair| pair[0] < pair[1]), "{record:?}");
    std::fs::remove_dir_all(&directory).unwrap();
}
