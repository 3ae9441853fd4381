use super::*;
use crate::{
    pair_kernel::{FreePair, Row, RowPair},
    pair_sums::PairSums,
};

const NODES: usize = 20;

fn ellipse(a: f64, b: f64) -> (Vec<Complex64>, Vec<Complex64>) {
    let angles = (0..NODES).map(|k| std::f64::consts::TAU * k as f64 / NODES as f64);
    angles.map(|t| (Complex64::new(a * t.cos(), b * t.sin()), Complex64::new(-a * t.sin(), b * t.cos()))).unzip()
}

/// Products with the stored stress and with the one computed anew.
fn compare<K: PairKernel + Copy>(kernel: K) {
    let ((first, first_tangents), (second, second_tangents)) = (ellipse(1.2, 0.8), ellipse(0.7, 0.9));
    let (mut target, mut source) = (Planes::default(), Planes::default());
    target.fill(&first, Some(1.1), false);
    source.fill(&second, Some(1.1), false);
    let values: Vec<f64> = (0..NODES).map(|k| (k as f64).sin()).collect();
    let (mut near, mut far) = (Dipoles::default(), Dipoles::default());
    near.fill(&values, &values, &first_tangents, 1.0);
    far.fill(&values, &values, &second_tangents, 1.0);
    let planes = Both { target: &target, source: &source };
    let mut stored = StoredStress::default();
    stored.fill(&kernel, &planes, NODES, false);
    let direct = DirectStress { kernel, planes };
    let mut sums = PairSums::new(NODES);
    let mut run = |stress: &dyn StressSource| {
        let mut out = [Vectors::default(), Vectors::default()];
        out.iter_mut().for_each(|out| out.clear(NODES));
        let [a, b] = &mut out;
        sums.double_layer(stress, &Both { target: &near, source: &far }, a, b);
        out
    };
    let (a, b) = (run(&stored), run(&direct));
    for (a, b) in a.iter().zip(&b) {
        let differences = a.x.iter().zip(&b.x).chain(a.y.iter().zip(&b.y)).map(|(a, b)| (a - b).abs());
        assert!(differences.fold(0.0, f64::max) < 1e-13);
    }
    // Each pair once: against the plain double sum at the targets.
    for (i, found) in a[0].x.iter().enumerate() {
        let term = |j: usize| {
            let [xxx, xxy, xyy, _] = kernel.stress(&target.window(i, 1), &source.window(j, 1), 0);
            xxx * far.xx[j] + xxy * far.s[j] + xyy * far.yy[j]
        };
        let expected: f64 = (0..NODES).map(term).sum();
        assert!((expected - found).abs() < 1e-12);
    }
}

#[test]
fn stored_and_direct_stress_agree() {
    compare(FreePair { offset: [2.5, 0.3] });
    compare(RowPair { row: Row::new(1.1, [2.5, 0.3], false) });
}
