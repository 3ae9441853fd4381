use super::*;
use motile::prelude::*;
use motile::setup::{DropletShape, FibreHold, FibreSetup, FibreShape};

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

/// Fibres are lines with all of their nodes: held ones at rest, the end of a period as its start.
#[test]
fn fibres_are_lines_in_files_tables_and_pictures() {
    let of = |shape: FibreShape, ends: [FibreHold; 2]| FibreSetup { shape, ends, ..FibreSetup::default() };
    let setup = Setup {
        region: Region::Box { lengths: [4.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(0.25)),
        droplets: Vec::new(),
        fibres: vec![
            of(FibreShape::Points(vec![[0.0, 0.0], [0.2, 0.1], [0.4, 0.0]]), [FibreHold::Clamped, FibreHold::Free]),
            of(FibreShape::ClosedPoints(vec![[1.0, 0.0], [1.2, 0.0], [1.2, 0.2], [1.0, 0.2]]), [FibreHold::Free; 2]),
        ],
        ..Setup::default()
    };
    let setup = Setup {
        fibres: setup.fibres.into_iter().map(|f| FibreSetup { reference_curvature: Some(0.5), ..f }).collect(),
        ..setup
    };
    let Built { mut scene, fibres, .. } = setup.build().unwrap();
    let raster = Raster::of(scene.system(), 0.5).unwrap();
    let seen = Snapshot::take(scene.system_mut(), raster).unwrap();
    let lengths: Vec<usize> = seen.solids.iter().map(|shape| shape.edges[0].len()).collect();
    assert_eq!(lengths, [3, 5]);
    let flows = [fibres[0], fibres[1]].map(|fibre| scene.system().flow_at(fibre).unwrap());
    let values = |pick: fn(&motile::scene::BodyFlow<'_>) -> Vec<Vec2>| {
        let [held, ring] = [pick(&flows[0]), pick(&flows[1])];
        [vec![Vec2::ZERO], held, ring.clone(), vec![ring[0]]].concat()
    };
    let lines: Vec<Vec<Vec2>> = seen.solids.iter().map(|shape| shape.edges[0].clone()).collect();
    let expected = VtkFile::lines(&[], &lines)
        .point_vectors("velocity", values(|flow| flow.velocities.to_vec()))
        .point_vectors("force", values(|flow| flow.forces.to_vec()))
        .cell_scalars("body", [0.0, 1.0]);
    assert_eq!(curve_lines(scene.system()).unwrap(), Some(expected));
    assert_eq!(marker_points(scene.system()).unwrap(), None);
    let rows = crate::BodiesCsv::rows(scene.system_mut()).unwrap();
    let value = |row: usize, name: &str| rows[row].iter().find(|(key, _)| *key == name).unwrap().1;
    let state = scene.observe(fibres[0]).unwrap();
    assert_eq!(value(0, "torque_start"), state.end_torques[0]);
    assert!(state.end_torques[0] != 0.0 && (value(1, "length") - 0.8).abs() < 1e-12, "{rows:?}");
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
