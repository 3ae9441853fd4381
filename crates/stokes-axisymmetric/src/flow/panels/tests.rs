use super::*;

/// Integrals over a half turn from any foot: of waves, and of the logarithm at the foot.
#[test]
fn panels_integrate_waves_and_the_logarithm() {
    let count = 24;
    let mut panels = Panels::new(count);
    for foot in [0.5 * PI / count as f64, 1.1, PI - 0.01] {
        for gap in [None, Some(1e-7), Some(0.3)] {
            panels.place(foot, [0.0, PI], PI / count as f64, gap);
            let sum = |f: &dyn Fn(f64) -> f64| panels.nodes.iter().map(|(s, weight)| weight * f(*s)).sum::<f64>();
            let wave = sum(&|s| (7.0 * (foot + s)).sin());
            assert!((wave - 2.0 / 7.0).abs() < 1e-13, "{wave}");
            if gap.is_none() {
                let log = sum(&|s| s.abs().ln());
                let exact = foot * (foot.ln() - 1.0) + (PI - foot) * ((PI - foot).ln() - 1.0);
                assert!((log - exact).abs() < 1e-13, "{log} {exact}");
            }
        }
    }
}

/// Points of a foot at a pole, up to round-off: rings of some radius.
#[test]
fn no_points_are_on_the_axis() {
    let mut panels = Panels::new(24);
    for foot in [4e-16, PI - 4e-16] {
        panels.place(foot, [0.0, PI], PI / 24.0, Some(0.3));
        assert!(panels.nodes.iter().all(|(s, _)| (foot + s).sin() > 1e-15), "at {foot}");
        let wave: f64 = panels.nodes.iter().map(|(s, weight)| weight * (7.0 * (foot + s)).sin()).sum();
        assert!((wave - 2.0 / 7.0).abs() < 1e-13, "{wave}");
    }
}
