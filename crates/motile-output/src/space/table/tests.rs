use motile::prelude::*;

use crate::SpaceCsv;

/// Passive drops in a rotation: rows have as many values as columns, gaps are measured, and volumes stay.
#[test]
fn rows_have_all_columns() {
    let droplets = [[0.0, 0.0, 0.0], [2.5, 0.0, 0.0]];
    let droplets = droplets.map(|at| DropletSetup { position: Some(at), ..DropletSetup::passive(10.0) }).to_vec();
    let flow = FlowSetup { rotation: 0.01, ..FlowSetup::default() };
    let method = Method::Harmonics(HarmonicsMethod { degree: 4 });
    let setup = Setup { region: Region::Space, method, flow, droplets, ..Setup::default() };
    let Built { mut scene, space: Some(body), .. } = setup.build().unwrap() else { panic!("no droplets in space") };
    let path = std::env::temp_dir().join(format!("motile-space-table-{}.csv", std::process::id()));
    let mut rows = SpaceCsv::create(&path, scene.system_mut(), body, None).unwrap();
    scene.run(1.0).observe(Every::Time(0.5), &mut rows).go().unwrap();
    let text = std::fs::read_to_string(&path).unwrap();
    let names = SpaceCsv::columns(false);
    assert_eq!(text.lines().count(), 1 + 3 * 2);
    let column = |name: &str| names.iter().position(|known| *known == name).unwrap();
    let [first, last] = [&rows.table().rows()[0], &rows.table().rows()[5]];
    assert_eq!((first.len(), first[column("droplet")], last[column("droplet")]), (names.len(), 0.0, 1.0));
    // A point of the grid lies on the line between the droplets.
    assert!((first[column("gap")] - 0.5).abs() < 1e-9, "{}", first[column("gap")]);
    // The outer one drifts with the flow.
    assert!(last[column("y")] > 0.02 && (last[column("volume")] / first[column("volume")] - 1.0).abs() < 1e-9);
    std::fs::remove_file(&path).unwrap();
}
