use motile::setup::{LayersMethod, MethodKind};
use motile::{Recommendation, recommend};

use super::*;

/// Largest errors of settings in all scenes of a kind that `recommend` covers, in the table of the documents.
fn in_table(kind: SceneKind, method: Method) -> Vec<f64> {
    let (settings, grid) = match method {
        Method::Integral(IntegralMethod { nodes, elements }) | Method::Layers(LayersMethod { nodes, elements, .. }) => {
            (format!("{nodes} nodes, {elements} elements"), false)
        }
        Method::Grid(GridMethod { spacing, .. }) => (format!("h = {spacing}"), true),
        other => panic!("the table has no {other:?}"),
    };
    let text = std::fs::read_to_string(crate::tables::root().join("docs/tables/recommended.csv")).unwrap();
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
    let rows = table.records().map(Result::unwrap);
    let of = rows.filter(|row| {
        let covered = !(grid && kind == SceneKind::Channel && row[2].contains("activity -4"));
        row[0] == *format!("{kind:?}") && row[1] == *settings && covered
    });
    of.map(|row| row[4].parse::<f64>().unwrap() / 100.0).collect()
}

#[test]
fn what_is_recommended_was_measured_in_every_scene_that_is_covered() {
    for (kind, scenes) in
        [(SceneKind::Box, [9; 3]), (SceneKind::ViscosityContrast, [4, 4, 0]), (SceneKind::Channel, [3, 3, 2])]
    {
        for (method, scenes) in [MethodKind::Integral, MethodKind::Layers, MethodKind::Grid].into_iter().zip(scenes) {
            for target in [0.05, 0.02, 0.01, 0.007, 0.005, 0.003, 0.001] {
                let Ok(Recommendation { method, .. }) = recommend(kind, method, target) else { continue };
                let errors = in_table(kind, method);
                assert_eq!(errors.len(), scenes, "{kind:?} {method:?}");
                assert!(errors.iter().all(|error| *error < target), "{kind:?} {method:?} {target}: {errors:?}");
            }
            assert_eq!(recommend(kind, method, 0.01).is_ok(), scenes > 0, "{kind:?} {method:?}");
        }
    }
}
