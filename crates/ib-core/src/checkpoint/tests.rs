use stokes_grid::{Grid, PeriodicStokes};

use super::*;
use crate::{CubicQuadratic, ImmersedBoundary};

/// What is wrong here comes to light only after the flow has taken its state over.
#[test]
fn a_refusal_leaves_the_flow_as_it_was() {
    let solver = PeriodicStokes::new(Grid::periodic(16, 16, 0.25).unwrap(), 1.0).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, CubicQuadratic::default()));
    let before = scene.checkpoint("");
    let found = Found { iterations: 0, residual: 0.0, mean_pressure_gradient: [0.0; 2] };
    let other = Checkpoint {
        flow: SavedState { reals: vec![1.0; 6], counts: vec![0, 0, 0, 6] },
        known: Some((vec![[0.0; 2]], found)),
        time: 1.0,
        ..before.clone()
    };
    assert!(matches!(scene.resume(&other), Err(SceneError::ForeignCheckpoint { .. })));
    assert_eq!(scene.checkpoint(""), before);
}
