use super::*;

impl StressKernel {
    /// Pressure at the target of the stress as a flow, for the last sums at source `first + i`: factors of
    /// `v_x n_x - v_y n_y` and of `v_x n_y + v_y n_x`.
    fn pressure(&self, i: usize) -> [f64; 2] {
        let sign = if self.transposed { 4.0 } else { -4.0 };
        [sign * self.work.axx[i], -4.0 * self.work.axy[i]]
    }
}

fn kernel(x: f64, y: Option<f64>) -> StressKernel {
    StressKernel::new(&Images { periods: [Some(x), y] }, 1e-6)
}

fn at(kernel: &mut StressKernel, d: Vec2) -> (Stress, [f64; 2]) {
    let mut sources = Sources::default();
    kernel.load([d].into_iter(), &mut sources);
    let target = kernel.target(Vec2::zeros());
    kernel.sum(&target, &sources, 0);
    (kernel.stress(0), kernel.pressure(0))
}

#[test]
fn close_to_the_source_it_is_that_of_free_space() {
    for (x, y) in [(7.0, Some(5.0)), (5.0, Some(7.0)), (6.0, None)] {
        let mut kernel = kernel(x, y);
        let d = Vec2::new(0.003, -0.002);
        let (t, _) = at(&mut kernel, d);
        let r4 = d.norm_squared().powi(2);
        for (value, product) in
            [(t.xxx, d.x * d.x * d.x), (t.xxy, d.x * d.x * d.y), (t.xyy, d.x * d.y * d.y), (t.yyy, d.y * d.y * d.y)]
        {
            assert!((value + 4.0 * product / r4).abs() < 0.02, "{value}, {}", -4.0 * product / r4);
        }
    }
}

#[test]
fn it_is_periodic_and_symmetric_under_exchange_of_the_axes() {
    let (mut wide, mut tall) = (kernel(7.0, Some(5.0)), kernel(5.0, Some(7.0)));
    let d = Vec2::new(1.3, -1.1);
    let (a, p) = at(&mut wide, d);
    for shift in [Vec2::new(7.0, 0.0), Vec2::new(-7.0, 0.0), Vec2::new(0.0, 5.0)] {
        // Two periods across are the most that sources and targets are apart.
        let (b, q) = at(&mut wide, d + shift);
        // T_xxy and T_yyy have a jump of a pressure that is uniform in the source.
        let jump = a.xxy - b.xxy;
        assert!((jump - (a.yyy - b.yyy)).abs() < 1e-5, "{a:?} {b:?}");
        assert!((a.xxx - b.xxx).abs() < 1e-5 && (a.xyy - b.xyy).abs() < 1e-5, "{a:?} {b:?}");
        assert!((p[0] - q[0]).abs() < 1e-5 && (p[1] - q[1]).abs() < 1e-5);
    }
    let (b, q) = at(&mut tall, Vec2::new(d.y, d.x));
    // The difference is the uniform pressure of the mean flow again.
    assert!((a.xxx - b.yyy - (a.xyy - b.xxy)).abs() < 1e-6, "{a:?} {b:?}");
    assert!((a.yyy - b.xxx - (a.xxy - b.xyy)).abs() < 1e-6, "{a:?} {b:?}");
    assert!((p[0] + q[0]).abs() < 0.51 && (p[1] - q[1]).abs() < 1e-6, "{p:?} {q:?}");
}

#[test]
fn as_a_flow_of_the_target_it_obeys_the_stokes_equations() {
    let e = 1e-3;
    for (x, y) in [(7.0, Some(5.0)), (5.0, Some(7.0)), (6.0, None)] {
        let mut kernel = kernel(x, y);
        let d = Vec2::new(0.9, 0.7);
        // With the dipole v n = (p, q): xx - yy part p, symmetric part q; no flux, so that pressures are periodic.
        let mut flow = |shift: Vec2| {
            let (t, pressure) = at(&mut kernel, d - shift);
            let (difference, mixed) = (0.6, -1.1);
            let u = 0.5 * difference * (t.xxx - t.xyy) + mixed * t.xxy;
            let v = 0.5 * difference * (t.xxy - t.yyy) + mixed * t.xyy;
            [u, v, pressure[0] * difference + pressure[1] * mixed]
        };
        let [c, l, r, b, t] =
            [(0.0, 0.0), (-e, 0.0), (e, 0.0), (0.0, -e), (0.0, e)].map(|(x, y)| flow(Vec2::new(x, y)));
        let laplacian = |i: usize| (l[i] + r[i] + b[i] + t[i] - 4.0 * c[i]) / (e * e);
        assert!(((r[0] - l[0] + t[1] - b[1]) / (2.0 * e)).abs() < 1e-4);
        assert!(
            (laplacian(0) - (r[2] - l[2]) / (2.0 * e)).abs() < 1e-3,
            "{} {}",
            laplacian(0),
            (r[2] - l[2]) / (2.0 * e)
        );
        assert!((laplacian(1) - (t[2] - b[2]) / (2.0 * e)).abs() < 1e-3);
    }
}
