use super::*;

#[test]
fn a_step_solves_the_normal_equations() {
    let rows = [[1.0, 2.0, 0.5], [0.0, 0.0, 3.0], [-1.0, 4.0, 0.0], [2.0, -0.5, 1.0]];
    let exact = [0.7, -1.3, 2.1];
    let mut equations = NormalEquations::new();
    for (k, row) in rows.into_iter().enumerate() {
        let deviation = (0..3).map(|i| row[i] * exact[i]).sum();
        equations.add(row, 1.0 + k as f64, deviation);
    }
    let found = equations.step(0.0).unwrap();
    assert!((0..3).all(|i| (found[i] - exact[i]).abs() < 1e-14), "{found:?}");
    // Damping makes it shorter.
    assert!(equations.step(10.0).unwrap().iter().zip(found).all(|(short, long)| short.abs() < long.abs()));
}

#[test]
fn too_few_measurements_give_no_step() {
    let mut equations = NormalEquations::new();
    equations.add([1.0, 0.0], 1.0, 1.0);
    assert_eq!(equations.step(0.0), None);
    equations.add([f64::NAN, 1.0], 1.0, 1.0);
    assert_eq!(equations.step(0.0), None);
}
