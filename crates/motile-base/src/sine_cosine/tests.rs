use super::*;

/// Tiny, even, odd and prime lengths, and two that are used.
fn lengths() -> impl Iterator<Item = usize> {
    (1..40).chain([97, 128, 240])
}

fn values(len: usize) -> Vec<f64> {
    (0..len).map(|k| (0.37 * (k * k) as f64).sin() + 0.2).collect()
}

/// `f(pi a / (2 N))` with the angle reduced exactly.
fn at(f: fn(f64) -> f64, a: usize, len: usize) -> f64 {
    f(0.5 * PI * (a % (4 * len)) as f64 / len as f64)
}

#[track_caller]
fn assert_close(found: &[f64], expected: impl Fn(usize) -> f64, scale: f64, what: &str) {
    let tolerance = 1e-13 * found.len().max(8) as f64;
    for (k, found) in found.iter().enumerate() {
        let expected = scale * expected(k);
        assert!((found - expected).abs() < tolerance, "{what}, {k}: {found} and {expected}");
    }
}

#[test]
fn cosine_transforms_are_the_sums_they_say() {
    for len in lengths() {
        let (start, mut found) = (values(len), values(len));
        let mut transform = CosineTransform::new(len).unwrap();
        let cosine = |n: usize, j: usize| at(f64::cos, n * (2 * j + 1), len);
        transform.forward(&mut found).unwrap();
        let dct2 = |n: usize| (0..len).map(|j| start[j] * cosine(n, j)).sum();
        assert_close(&found, dct2, 1.0, &format!("DCT-II of {len}"));
        found.copy_from_slice(&start);
        transform.inverse(&mut found).unwrap();
        let dct3 = |j: usize| 0.5 * start[0] + (1..len).map(|n| start[n] * cosine(n, j)).sum::<f64>();
        assert_close(&found, dct3, 1.0, &format!("DCT-III of {len}"));
        transform.forward(&mut found).unwrap();
        assert_close(&found, |k| start[k], 0.5 * len as f64, &format!("both of {len}"));
    }
}

#[test]
fn sine_transforms_are_the_sums_they_say() {
    for len in lengths() {
        let (start, mut found) = (values(len), values(len));
        let mut transform = SineTransform::new(len).unwrap();
        let sine = |n: usize, j: usize| at(f64::sin, n * (2 * j + 1), len);
        transform.forward(&mut found).unwrap();
        let dst2 = |k: usize| (0..len).map(|j| start[j] * sine(k + 1, j)).sum();
        assert_close(&found, dst2, 1.0, &format!("DST-II of {len}"));
        found.copy_from_slice(&start);
        transform.inverse(&mut found).unwrap();
        let last = |j: usize| 0.5 * start[len - 1] * sine(len, j);
        let dst3 = |j: usize| last(j) + (1..len).map(|n| start[n - 1] * sine(n, j)).sum::<f64>();
        assert_close(&found, dst3, 1.0, &format!("DST-III of {len}"));
        transform.forward(&mut found).unwrap();
        assert_close(&found, |k| start[k], 0.5 * len as f64, &format!("both of {len}"));
    }
}

#[test]
fn node_sine_transforms_are_the_sums_they_say() {
    for len in lengths() {
        let (start, mut found) = (values(len), values(len));
        let mut transform = NodeSineTransform::new(len).unwrap();
        assert_eq!(transform.len(), len);
        transform.transform(&mut found).unwrap();
        let sine = |n: usize, j: usize| at(f64::sin, 2 * n * j, len + 1);
        let dst1 = |k: usize| (1..=len).map(|j| start[j - 1] * sine(k + 1, j)).sum();
        assert_close(&found, dst1, 1.0, &format!("DST-I of {len}"));
        transform.transform(&mut found).unwrap();
        assert_close(&found, |k| start[k], 0.5 * (len + 1) as f64, &format!("twice of {len}"));
    }
}

/// Their use: each diagonalises the second difference with its own ends.
#[test]
fn second_differences_become_factors() {
    let len = 11;
    let eigenvalue = |n: usize, cells: usize| -(2.0 * (0.5 * PI * n as f64 / cells as f64).sin()).powi(2);
    let difference = |f: &[f64], before: f64, after: f64| -> Vec<f64> {
        let at = |j: usize| if j == 0 { before } else { f.get(j - 1).copied().unwrap_or(after) };
        (1..=f.len()).map(|j| at(j - 1) - 2.0 * at(j) + at(j + 1)).collect()
    };
    let f = values(len);
    let (first, last) = (f[0], f[len - 1]);
    let check = |transform: &mut dyn FnMut(&mut [f64]), ends: [f64; 2], n0: usize, cells: usize| {
        let (mut of_f, mut of_difference) = (f.clone(), difference(&f, ends[0], ends[1]));
        transform(&mut of_f);
        transform(&mut of_difference);
        assert_close(&of_difference, |k| eigenvalue(k + n0, cells) * of_f[k], 1.0, &format!("{n0}, {cells}"));
    };
    let mut cosines = CosineTransform::new(len).unwrap();
    check(&mut |f| cosines.forward(f).unwrap(), [first, last], 0, len);
    let mut sines = SineTransform::new(len).unwrap();
    check(&mut |f| sines.forward(f).unwrap(), [-first, -last], 1, len);
    let mut nodes = NodeSineTransform::new(len).unwrap();
    check(&mut |f| nodes.transform(f).unwrap(), [0.0, 0.0], 1, len + 1);
}

#[test]
fn wrong_lengths_are_errors() {
    let mut five = values(5);
    let expected = |name| Err(InputError::WrongLength { name, expected: 6, found: 5 });
    let mut cosines = CosineTransform::new(6).unwrap();
    assert_eq!(cosines.forward(&mut five), expected("the numbers of a cosine transform"));
    assert_eq!(cosines.inverse(&mut five), expected("the numbers of a cosine transform"));
    let mut sines = SineTransform::new(6).unwrap();
    assert_eq!(sines.forward(&mut five), expected("the numbers of a sine transform"));
    assert_eq!(sines.inverse(&mut five), expected("the numbers of a sine transform"));
    assert_eq!(NodeSineTransform::new(6).unwrap().transform(&mut five), expected("the numbers of a sine transform"));
    assert_eq!(five, values(5));
    for len in [(1 << 26) + 1, usize::MAX] {
        assert!(matches!(CosineTransform::new(len), Err(InputError::OutOfRange { .. })));
        assert!(matches!(SineTransform::new(len), Err(InputError::OutOfRange { .. })));
        assert!(matches!(NodeSineTransform::new(len), Err(InputError::OutOfRange { .. })));
    }
}

#[test]
fn a_plan_for_no_numbers_does_nothing() {
    let (mut cosines, mut sines) = (CosineTransform::new(0).unwrap(), SineTransform::new(0).unwrap());
    let mut nodes = NodeSineTransform::new(0).unwrap();
    assert!(cosines.is_empty() && sines.is_empty() && nodes.is_empty());
    assert!(cosines.forward(&mut []).is_ok() && cosines.inverse(&mut []).is_ok());
    assert!(sines.forward(&mut []).is_ok() && sines.inverse(&mut []).is_ok());
    assert!(nodes.transform(&mut []).is_ok());
}

#[test]
fn transforms_allocate_nothing() {
    for len in [64, 97, 240] {
        let (mut cosines, mut sines) = (CosineTransform::new(len).unwrap(), SineTransform::new(len).unwrap());
        let (mut nodes, mut numbers) = (NodeSineTransform::new(len).unwrap(), values(len));
        let info = allocation_counter::measure(|| {
            cosines.forward(&mut numbers).unwrap();
            cosines.inverse(&mut numbers).unwrap();
            sines.forward(&mut numbers).unwrap();
            sines.inverse(&mut numbers).unwrap();
            nodes.transform(&mut numbers).unwrap();
        });
        assert_eq!(info.count_total, 0, "length {len}");
    }
}

/// What a transform leaves in its memory is no part of the next one.
#[test]
fn a_plan_forgets_what_it_has_transformed() {
    for len in [5, 8, 63] {
        let (mut used, mut first) = (NodeSineTransform::new(len).unwrap(), NodeSineTransform::new(len).unwrap());
        for round in 0..4 {
            let numbers: Vec<f64> = values(len).iter().map(|value| value * f64::from(1 + round)).collect();
            let [mut again, mut alone] = [numbers.clone(), numbers];
            used.transform(&mut again).unwrap();
            if round == 3 {
                first.transform(&mut alone).unwrap();
                assert_eq!(again, alone, "{len}");
            }
        }
    }
}
