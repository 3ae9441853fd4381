use super::*;
use crate::Forcing;

const NODES: usize = 96;

/// Largest error of `A E = eta_out E` at the first of two interfaces and of `A E = 0` at the second, for the rigid
/// motions E of the first, relative to the mean viscosity; and whether a uniform expansion keeps its flux.
fn errors(geometry: Geometry, second: Complex64, viscosities: [f64; 2]) -> [f64; 2] {
    let settings = Settings { nodes: NODES, tolerance: 1e-15, ..Settings::default() };
    let mut flow = InterfaceFlow::new(geometry, 1.0, settings).unwrap();
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / NODES as f64;
    let outline = |k: usize| Complex64::new(1.2 * angle(k).cos(), 0.9 * angle(k).sin()) * Complex64::cis(0.3);
    let curves = [Complex64::new(0.2, 0.1), second].map(|centre| {
        let place = |k: usize| Vec2::new((centre + outline(k)).re, (centre + outline(k)).im);
        (0..NODES).map(place).collect::<Vec<_>>()
    });
    let forces = vec![Vec2::ZERO; NODES];
    let interfaces = curves.iter().zip(viscosities);
    let given = interfaces.map(|(positions, viscosity)| Interface {
        positions,
        forces: &forces,
        viscosities: [viscosity, 1.0],
    });
    flow.load(given).unwrap();
    let InterfaceFlow { layers, contrasts, scales, .. } = &mut flow;
    layers.single_layer(true);
    let normals = vec![0.0; 4 * NODES];
    let operator = Operator { contrasts, scales, normals: &normals, deflation: &[0.0; 2] };
    let mut apply = |v: &[f64]| {
        let mut out = vec![0.0; 4 * NODES];
        operator.apply(layers, v, 1e-15, &mut out);
        out
    };
    let outlines: Vec<Complex64> = (0..NODES).map(outline).collect();
    let tangent = |k: usize| Complex64::new(-1.2 * angle(k).sin(), 0.9 * angle(k).cos()) * Complex64::cis(0.3);
    let motions: [fn(Complex64) -> Complex64; 3] =
        [|_| Complex64::new(1.0, 0.0), |_| Complex64::new(0.0, 1.0), |z| Complex64::new(0.0, 1.0) * z];
    let mut rigid = 0.0f64;
    for motion in motions {
        let mut v = vec![0.0; 4 * NODES];
        for (i, z) in outlines.iter().enumerate() {
            (v[i], v[NODES + i]) = (motion(*z).re, motion(*z).im);
        }
        let out = apply(&v);
        for (i, out) in out.iter().enumerate() {
            let expected = scales[0] * if i < 2 * NODES { v[i] } else { 0.0 };
            rigid = rigid.max((out - expected).abs());
        }
    }
    // The flux through the first curve is multiplied by its inner viscosity.
    let flux = |v: &[f64]| -> f64 { (0..NODES).map(|i| v[i] * tangent(i).im - v[NODES + i] * tangent(i).re).sum() };
    let smooth: Vec<f64> = (0..4 * NODES).map(|i| (3.0 * angle(i % NODES)).sin() + 0.4).collect();
    let expanded: Vec<f64> = (0..4 * NODES)
        .map(|i| {
            let t = tangent(i % NODES);
            smooth[i]
                + if i < NODES {
                    t.im
                } else if i < 2 * NODES {
                    -t.re
                } else {
                    0.0
                }
        })
        .collect();
    let kept = flux(&apply(&expanded)) - viscosities[0] * scales[0] * flux(&expanded);
    [rigid, kept.abs() / flux(&expanded)]
}

#[test]
fn rigid_motions_and_flux() {
    for viscosities in [[10.0, 3.0], [1000.0, 0.001], [0.001, 50.0]] {
        let free = errors(Geometry::Plane, Complex64::new(3.1, 0.4), viscosities);
        assert!(free[0] < 1e-12 && free[1] < 1e-12, "{free:?}");
        let close = errors(Geometry::Plane, Complex64::new(2.65, 0.4), viscosities);
        assert!(close[0] < 1e-11, "{close:?}");
        let square = errors(Geometry::Box { lengths: [6.0, 7.0] }, Complex64::new(3.2, 3.6), viscosities);
        assert!(square[0] < 1e-12, "{square:?}");
        let large = errors(Geometry::Box { lengths: [14.0, 15.0] }, Complex64::new(2.9, 0.6), viscosities);
        assert!(large[0] < 1e-12, "{large:?}");
        for forcing in [Forcing::Gradient(0.0), Forcing::Flux(0.0)] {
            let channel = Geometry::Channel { length: 7.0, width: 4.0, forcing };
            let channel = errors(channel, Complex64::new(3.5, -0.4), viscosities);
            assert!(channel[0] < 1e-11, "{channel:?}");
        }
    }
}
