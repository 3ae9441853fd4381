use super::*;

/// Kernel ln(10/r) with its derivative, bounded for close markers.
fn kernel(r: f64) -> [f64; 2] {
    if r < 1e-3 { [1e4_f64.ln(), 0.0] } else { [(10.0 / r).ln(), -1.0 / r] }
}

/// Largest error of a sum, and the largest sum.
fn error(positions: &[Vec2], forces: &[Vec2]) -> [f64; 2] {
    let mut found = vec![Vec2::ZERO; positions.len()];
    Tree::new(positions).sum(forces, kernel, &mut found);
    let exact = |i: usize| -> Vec2 {
        let others = (0..positions.len()).filter(|j| *j != i);
        others.map(|j| kernel(positions[i].distance(positions[j]))[0] * forces[j]).sum()
    };
    found.iter().enumerate().fold([0.0, 0.0], |[error, largest], (i, found)| {
        let exact = exact(i);
        [(*found - exact).length().max(error), exact.length().max(largest)]
    })
}

#[test]
fn sums_are_those_over_all_pairs() {
    let count = 2000;
    let circle: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(k as f64 * std::f64::consts::TAU / 2000.0)).collect();
    // Points without a pattern in a square.
    let square: Vec<Vec2> =
        (0..count).map(|k| Vec2::new((0.754_877_67 * k as f64).fract(), (0.569_840_29 * k as f64).fract())).collect();
    for positions in [circle, square] {
        let along = vec![Vec2::X; count];
        let against: Vec<Vec2> = (0..count).map(|k| if k % 2 == 0 { Vec2::X } else { -Vec2::X }).collect();
        for (forces, bound) in [(along, 3e-3), (against, 0.03)] {
            let [error, largest] = error(&positions, &forces);
            println!("{error} of {largest}");
            assert!(error < bound * largest, "{error} of {largest}");
        }
    }
}

#[test]
fn markers_in_one_place_and_none_at_all() {
    let places = vec![Vec2::new(0.3, 0.1); 100];
    let [error, largest] = error(&places, &[Vec2::Y; 100]);
    assert!(error < 1e-12 * largest && largest > 900.0, "{error} {largest}");
    Tree::new(&[]).sum(&[], kernel, &mut []);
}
