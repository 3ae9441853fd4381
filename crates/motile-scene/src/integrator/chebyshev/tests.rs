use super::*;

/// `y' = explicit y + implicit y`, whose fastest decay is told as `decay` (all 1/time).
struct Decay {
    y: f64,
    explicit: f64,
    implicit: f64,
    decay: f64,
}

impl Dynamics for Decay {
    fn state_len(&self) -> usize {
        1
    }
    fn write_state(&self, state: &mut Vec<f64>) {
        *state = vec![self.y];
    }
    fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError> {
        self.y = state[0];
        Ok(())
    }
    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        rate[0] = self.explicit * state[0];
        Ok(())
    }
    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        rate[0] = self.explicit * self.y;
        Ok(())
    }
    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        out[0] += factor * self.implicit * state[0];
    }
    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        state[0] /= 1.0 - factor * self.implicit;
    }
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(1.0);
    }
    fn fastest_decay(&self) -> f64 {
        self.decay
    }
}

/// The error of one step is of third order, and a stiff implicit part decays, for any number of stages.
#[test]
fn steps_with_an_implicit_part_are_of_second_order_and_stable() {
    let after = |stages: usize, dt: f64, explicit: f64, implicit: f64| {
        let decay = 0.99 * interval(stages) / dt;
        let mut system = Decay { y: 1.0, explicit, implicit, decay };
        let mut method = RungeKuttaChebyshev::new().with_estimate(SpectralEstimate::Predicted);
        method.step(&mut system, dt).unwrap();
        assert_eq!(method.work().stages, stages);
        system.y
    };
    for stages in [2, 3, 5, 9] {
        for [explicit, implicit] in [[-1.0, 0.0], [-0.7, -0.3], [-0.4, -0.6], [0.0, -1.0], [0.5, -1.5]] {
            let error = |dt: f64| (after(stages, dt, explicit, implicit) - (-dt).exp()).abs();
            let order = (error(0.02) / error(0.01)).log2();
            assert!((order - 3.0).abs() < 0.1, "{stages} stages, {explicit} {implicit}: {order}");
        }
        let stiff = after(stages, 1.0, -0.5, -1e6);
        assert!(stiff.abs() <= 1.0, "{stages} stages: {stiff}");
    }
}
