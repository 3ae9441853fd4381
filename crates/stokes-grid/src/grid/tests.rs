use motile_base::InputError;

use super::*;

#[test]
fn grids_that_do_not_fit_into_memory_are_refused() {
    for (nx, ny) in [(1 << 18, 1 << 18), (2, usize::MAX), (usize::MAX, usize::MAX), (1 << 13, (1 << 13) + 1)] {
        for grid in [Grid::periodic(nx, ny, 0.1), Grid::channel(nx, ny, 0.1)] {
            assert_eq!(grid, Err(StokesError::GridTooLarge { nx, ny, maximum: Grid::MAXIMUM_CELLS }));
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
