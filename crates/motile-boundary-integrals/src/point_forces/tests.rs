use super::*;

const FORCES: PointForces = PointForces { radius: 0.3, viscosity: 2.0 };

fn sample(at: Vec2) -> FlowSample {
    let mut out = [FlowSample::default()];
    FORCES.add_samples(&[Vec2::new(0.1, -0.2)], &[Vec2::new(1.5, 0.7)], &[at], &mut out);
    out[0]
}

/// The flow has no divergence, and its stress balances the blob of force: `eta lap(v) - grad p + F phi = 0`.
#[test]
fn the_flow_of_a_blob_is_a_stokes_flow() {
    let step = 1e-3;
    for at in [Vec2::new(0.5, 0.1), Vec2::new(0.15, -0.1), Vec2::new(-1.0, 2.0)] {
        let seen = sample(at);
        let mut velocity = [Vec2::ZERO];
        FORCES.add_velocities(&[Vec2::new(0.1, -0.2)], &[Vec2::new(1.5, 0.7)], &[at], &mut velocity);
        assert_eq!(velocity[0], seen.velocity);
        let slope = |value: &dyn Fn(Vec2) -> f64, along: Vec2| {
            let pair = |k: f64| value(at + k * step * along) - value(at - k * step * along);
            (8.0 * pair(1.0) - pair(2.0)) / (12.0 * step)
        };
        let axes = [Vec2::X, Vec2::Y];
        let distance = (at - Vec2::new(0.1, -0.2)).length_squared() + 0.09;
        let blob = 3.0 * 0.027 / (2.0 * PI) * distance.powf(-2.5);
        for (i, force) in [1.5, 0.7].into_iter().enumerate() {
            let mut balance = force * blob - slope(&|x| sample(x).pressure, axes[i]);
            for (k, axis) in axes.into_iter().enumerate() {
                let exact = slope(&|x| sample(x).velocity.to_array()[i], axis);
                assert!((seen.gradient[i][k] - exact).abs() < 1e-9, "{i} {k}: {exact} {:?}", seen.gradient);
                balance += 2.0 * slope(&|x| sample(x).gradient[i][k], axis);
            }
            assert!(balance.abs() < 1e-8, "{i}: {balance}");
        }
        assert!((seen.gradient[0][0] + seen.gradient[1][1]).abs() < 1e-14);
    }
}
