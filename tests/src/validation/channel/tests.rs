use motile::stokes_grid::StokesSolver;

use super::*;

#[test]
fn solver_has_the_drive() {
    let solver = solver([4.0, 2.0], 0.25, Drive::ZeroFlux, 1.0).unwrap();
    assert_eq!(solver.drive(), Drive::ZeroFlux);
    assert!(solver.grid().has_walls());
}
