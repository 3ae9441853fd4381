use num_complex::Complex64;

use super::super::nodes::Nodes;
use super::*;

const LENGTHS: [f64; 2] = [2.0, 1.5];

/// One node at a distance (length) from its centre.
fn node(at: [f64; 2]) -> Nodes {
    let mut nodes = Nodes::default();
    nodes.fill(&[Complex64::new(at[0], at[1])], Some(std::f64::consts::TAU / LENGTHS[0]));
    nodes
}

/// The stress of a point force is that of its velocity: `T_ijk = -p_k delta_ij + d_i G_jk + d_j G_ik`. The four
/// components without the pressure, from differences of fourth order.
fn assert_of_stokeslet(kernel: &impl PairKernel) {
    let target = node([0.1, -0.2]);
    let stokeslet = |x: f64, y: f64| {
        let source = node([x, y]);
        let Stokeslet { q, xx, xy, yy } = kernel.stokeslet(&target.window(0, 1), &source.window(0, 1), 0);
        [xx - 0.5 * q.ln(), xy, yy - 0.5 * q.ln()]
    };
    for (x, y) in [(0.5, 0.3), (-0.4, 0.45), (0.9, -0.7), (0.2, 0.1), (-0.6, -0.55)] {
        let slope = |component: usize, [along, up]: [f64; 2]| {
            let at = |step: f64| stokeslet(x + step * along, y + step * up)[component];
            (8.0 * (at(1e-3) - at(-1e-3)) - at(2e-3) + at(-2e-3)) / 12e-3
        };
        let [by_x, by_y] = [[1.0, 0.0], [0.0, 1.0]].map(|way| [0, 1, 2].map(|component| slope(component, way)));
        let source = node([x, y]);
        let [xxx, xxy, xyy, yyy] = kernel.stress(&target.window(0, 1), &source.window(0, 1), 0);
        for (found, exact) in [
            (xxx - xyy, 2.0 * (by_x[0] - by_y[1])),
            (xxy, by_x[1] + by_y[0]),
            (xyy, by_x[2] + by_y[1]),
            (yyy - xxy, 2.0 * (by_y[2] - by_x[1])),
        ] {
            assert!((found - exact).abs() < 1e-8 * (1.0 + exact.abs()), "{x} {y}: {found} {exact}");
        }
    }
}

#[test]
fn stresses_are_those_of_the_flow_of_point_forces() {
    let offset = [0.15, -0.05];
    assert_of_stokeslet(&FreePair { offset });
    assert_of_stokeslet(&RowPair::new(std::f64::consts::TAU / LENGTHS[0], offset));
    assert_of_stokeslet(&LatticePair::<false>::new(LENGTHS, 0.0, offset, 1e-16));
    assert_of_stokeslet(&LatticePair::<true>::new(LENGTHS, 0.0, offset, 1e-16));
    assert_of_stokeslet(&LatticePair::<true>::new(LENGTHS, 0.37, offset, 1e-16));
}
