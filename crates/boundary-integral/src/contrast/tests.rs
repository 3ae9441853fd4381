use num_complex::Complex64;
use stokes_grid::Drive;

use super::*;
use crate::{
    Channel, FreeSpace, PeriodicBox, domain::sealed::Region, far::Division, solver::divide, surroundings::surroundings,
};

const NODES: usize = 96;

/// Largest error of `A E = eta_out E` at the first of two interfaces and of `A E = 0` at the second, for the rigid
/// motions E of the first, relative to the mean viscosity; and whether a uniform expansion keeps its flux.
fn errors(domain: &impl Region, second: Complex64, viscosities: [f64; 2]) -> [f64; 2] {
    let tolerance = 1e-15;
    let mut surroundings = surroundings(domain.kind(), tolerance);
    let mut transforms = Transforms::new(NODES);
    let mut interfaces = vec![Interface::new(NODES), Interface::new(NODES)];
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / NODES as f64;
    let outline = |k: usize| Complex64::new(1.2 * angle(k).cos(), 0.9 * angle(k).sin()) * Complex64::cis(0.3);
    for (interface, (centre, viscosity)) in
        interfaces.iter_mut().zip([Complex64::new(0.2, 0.1), second].into_iter().zip(viscosities))
    {
        let forces = (0..NODES).map(|_| Complex64::default());
        interface.load(&mut transforms, viscosity, (0..NODES).map(|k| centre + outline(k)), forces, NODES);
    }
    surroundings.prepare(&mut interfaces, &mut transforms).unwrap();
    let (mut layers, mut near) = (Layers::new(NODES), Near::new(NODES, tolerance));
    layers.load(&interfaces, surroundings.wave());
    let mut far = surroundings.far(tolerance);
    divide(surroundings.as_ref(), &interfaces, &mut layers, &mut far, &mut Division::new());
    near.find(&mut interfaces, &mut transforms, &surroundings.images());
    near.add_forces(&interfaces, &mut transforms, true, &mut layers.out);
    layers.prepare_stress();
    let mut contrast = Contrast::default();
    contrast.load(&interfaces, 1.0);
    let normals = vec![0.0; 4 * NODES];
    let mut parts = Parts {
        interfaces: &interfaces,
        layers: &mut layers,
        far: &mut far,
        near: &near,
        surroundings: surroundings.as_mut(),
        transforms: &mut transforms,
        accuracy: tolerance,
    };
    let mut apply = |v: &[f64]| {
        let mut out = vec![0.0; 4 * NODES];
        product(&mut parts, &contrast.contrasts, &contrast.scales, &normals, &[0.0; 2], v, &mut out);
        out
    };
    let motions: [fn(Complex64) -> Complex64; 3] =
        [|_| Complex64::new(1.0, 0.0), |_| Complex64::new(0.0, 1.0), |z| Complex64::new(0.0, 1.0) * z];
    let mut rigid = 0.0f64;
    for motion in motions {
        let mut v = vec![0.0; 4 * NODES];
        for (i, z) in interfaces[0].position.iter().enumerate() {
            (v[i], v[NODES + i]) = (motion(*z).re, motion(*z).im);
        }
        let out = apply(&v);
        for (i, out) in out.iter().enumerate() {
            let expected = contrast.scales[0] * if i < 2 * NODES { v[i] } else { 0.0 };
            rigid = rigid.max((out - expected).abs());
        }
    }
    // The flux through the first curve is multiplied by its inner viscosity.
    let flux = |v: &[f64]| -> f64 {
        (0..NODES).map(|i| v[i] * interfaces[0].tangent[i].im - v[NODES + i] * interfaces[0].tangent[i].re).sum()
    };
    let smooth: Vec<f64> = (0..4 * NODES).map(|i| (3.0 * angle(i % NODES)).sin() + 0.4).collect();
    let expanded: Vec<f64> = (0..4 * NODES)
        .map(|i| {
            let t = interfaces[0].tangent[i % NODES];
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
    let kept = flux(&apply(&expanded)) - viscosities[0] * contrast.scales[0] * flux(&expanded);
    [rigid, kept.abs() / flux(&expanded)]
}

#[test]
fn rigid_motions_and_flux() {
    for viscosities in [[10.0, 3.0], [1000.0, 0.001], [0.001, 50.0]] {
        let free = errors(&FreeSpace, Complex64::new(3.1, 0.4), viscosities);
        assert!(free[0] < 1e-12 && free[1] < 1e-12, "{free:?}");
        let close = errors(&FreeSpace, Complex64::new(2.65, 0.4), viscosities);
        assert!(close[0] < 1e-11, "{close:?}");
        let square = errors(&PeriodicBox::new(6.0, 7.0).unwrap(), Complex64::new(3.2, 3.6), viscosities);
        assert!(square[0] < 1e-12, "{square:?}");
        let large = errors(&PeriodicBox::new(14.0, 15.0).unwrap(), Complex64::new(2.9, 0.6), viscosities);
        assert!(large[0] < 1e-12, "{large:?}");
        for drive in [Drive::ZeroGradient, Drive::ZeroFlux] {
            let channel = Channel::new(7.0, 4.0).unwrap().with_drive(drive).unwrap();
            let channel = errors(&channel, Complex64::new(3.5, -0.4), viscosities);
            assert!(channel[0] < 1e-11, "{channel:?}");
        }
    }
}
