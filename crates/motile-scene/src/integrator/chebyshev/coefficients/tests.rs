use super::*;

/// One step for y' = z y with the implicit part g y.
fn amplification(stages: usize, z: f64, g: f64) -> f64 {
    let mut c = Coefficients::default();
    c.set(stages);
    let implicit = 1.0 - c.first * g;
    let (mut before, mut this) = (1.0, (1.0 + c.first * z) / implicit);
    let (mut increment_before, mut increment) = (0.0, c.first * z);
    for s in &c.later {
        let free = 1.0 - s.mu - s.nu;
        let explicit = s.rate * z * this + s.first_rate * z;
        let kept = (s.first_rate - free * c.first) * g - s.nu * c.first * g * before;
        (increment_before, increment) = (increment, s.mu * increment + s.nu * increment_before + explicit);
        (before, this) = (this, (free + s.mu * this + s.nu * before + explicit + kept) / implicit);
    }
    (1.0 + increment + 0.5 * g) / (1.0 - 0.5 * g)
}

#[test]
fn stable_and_damped_on_the_interval_and_not_beyond() {
    for stages in [2, 3, 4, 5, 8, 12, 20, 40] {
        let end = interval(stages);
        for k in 0..=2000 {
            let z = -end * f64::from(k) / 2000.0;
            let r = amplification(stages, z, 0.0);
            assert!(r.abs() <= 1.0 + 1e-12, "{stages} stages, z = {z}: {r}");
            if stages > 2 && z < -2.0 {
                assert!(r.abs() < 0.97, "{stages} stages, z = {z}: {r}");
            }
        }
        assert!(amplification(stages, -1.2 * end, 0.0).abs() > 1.0, "{stages}");
        assert_eq!(stages_for(0.9999 * end), stages);
    }
}

#[test]
fn agrees_with_the_exponential_to_second_order() {
    for (stages, share) in [(2, 0.0), (3, 0.3), (5, 0.5), (9, 1.0)] {
        let error = |z: f64| (amplification(stages, (1.0 - share) * z, share * z) - z.exp()).abs();
        let order = (error(-0.02) / error(-0.01)).log2();
        assert!((order - 3.0).abs() < 0.1, "{stages} stages, implicit share {share}: {order}");
    }
}

#[test]
fn the_implicit_part_is_stable_however_stiff() {
    for stages in [2, 3, 5, 10, 20] {
        for g in [-1.0, -10.0, -1e3, -1e6] {
            for part in 0..=20 {
                let part = f64::from(part) / 20.0;
                let r = amplification(stages, -part * interval(stages), g);
                assert!(r.abs() <= 1.0, "{stages} stages, explicit {part}, implicit {g}: {r}");
            }
        }
    }
}
