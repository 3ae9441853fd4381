use num_complex::Complex64;

use super::super::{
    arrays::NodeArrays,
    sums::{PairSums, double_layer},
};
use super::*;
use crate::greens::{FreePair, RowPair};

const NODES: usize = 20;

fn ellipse(a: f64, b: f64) -> (Vec<Complex64>, Vec<Complex64>) {
    let angles = (0..NODES).map(|k| std::f64::consts::TAU * k as f64 / NODES as f64);
    angles.map(|t| (Complex64::new(a * t.cos(), b * t.sin()), Complex64::new(-a * t.sin(), b * t.cos()))).unzip()
}

/// Values at the nodes of an ellipse.
fn arrays(a: f64, b: f64) -> NodeArrays {
    let (positions, tangents) = ellipse(a, b);
    let values: Vec<f64> = (0..NODES).map(|k| (k as f64).sin()).collect();
    let mut arrays = NodeArrays::default();
    arrays.nodes.fill(&positions, Some(1.1));
    arrays.dipoles.fill((&values, &values), &tangents, 1.0);
    arrays
}

/// Products with the stored stress and with the one recomputed.
fn compare<K: PairKernel>(kernel: &K) {
    let (target, source) = (arrays(1.2, 0.8), arrays(0.7, 0.9));
    let both = [&target, &source];
    let mut stored = StoredStress::default();
    stored.fill(kernel, both.map(|arrays| &arrays.nodes), false);
    let mut sums = PairSums::default();
    let [mut a, mut b] = [0, 1].map(|_| {
        let mut out = [Vectors::default(), Vectors::default()];
        out.iter_mut().for_each(|out| out.clear(NODES));
        out
    });
    let dipoles = both.map(|arrays| &arrays.dipoles);
    sums.visit(false, [0, 1], &mut a, |shift, near, far| stored.apply(shift, dipoles, near, far));
    sums.visit(false, [0, 1], &mut b, |shift, near, far| double_layer(kernel, shift, both, near, far));
    for (a, b) in a.iter().zip(&b) {
        let differences = a.x.iter().zip(&b.x).chain(a.y.iter().zip(&b.y)).map(|(a, b)| (a - b).abs());
        assert!(differences.fold(0.0, f64::max) < 1e-13);
    }
    // Each pair once: against the plain double sum at the targets.
    let far = &source.dipoles;
    for (i, found) in a[0].x.iter().enumerate() {
        let term = |j: usize| {
            let [xxx, xxy, xyy, _] = kernel.stress(&target.nodes.window(i, 1), &source.nodes.window(j, 1), 0);
            xxx * far.xx[j] + xxy * far.s[j] + xyy * far.yy[j]
        };
        let expected: f64 = (0..NODES).map(term).sum();
        assert!((expected - found).abs() < 1e-12);
    }
}

#[test]
fn stored_and_direct_stress_agree() {
    compare(&FreePair { offset: [2.5, 0.3] });
    compare(&RowPair::new(1.1, [2.5, 0.3]));
}
