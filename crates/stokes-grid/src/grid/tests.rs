use motile_base::InputError;

use super::*;
use crate::error::refused;

#[test]
fn grids_that_do_not_fit_into_memory_are_refused() {
    for (nx, ny) in [(1 << 18, 1 << 18), (2, usize::MAX), (usize::MAX, usize::MAX), (1 << 13, (1 << 13) + 1)] {
        for grid in [Grid::periodic(nx, ny, 0.1), Grid::channel(nx, ny, 0.1)] {
            let text = format!("too large for the memory: {nx} x {ny} cells. Use at most {}", Grid::MAXIMUM_CELLS);
            assert!(refused(&grid, &text), "{grid:?}");
        }
    }
    assert!(Grid::periodic(1 << 13, 1 << 13, 0.1).is_ok());
}

#[test]
fn extents_are_finite() {
    assert!(matches!(
        Grid::periodic(1_000_000, 4, 1e303),
        Err(StokesError::Input(InputError::EntryNotFinite { index: 0, .. }))
    ));
    assert!(matches!(
        Grid::channel(4, 1_000_000, 1e303),
        Err(StokesError::Input(InputError::EntryNotFinite { index: 1, .. }))
    ));
    let largest = Grid::periodic(4, 4, 4e307).unwrap();
    assert!(largest.origin().iter().all(|x| x.is_finite()));
}
