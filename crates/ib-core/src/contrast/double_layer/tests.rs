use super::*;

fn droplets(layer: &DoubleLayer) -> Vec<Droplet> {
    let mut first = 0;
    [(Vec2::new(0.1, 0.2), 40, 3.0), (Vec2::new(2.2, 2.7), 24, -0.8)]
        .into_iter()
        .map(|(centre, nodes, contrast)| {
            let mut droplet = Droplet { first, contrast, ..Droplet::default() };
            let positions: Vec<Vec2> = (0..nodes)
                .map(|k| std::f64::consts::TAU * k as f64 / nodes as f64)
                .map(|t| centre + Vec2::new(0.9 * t.cos(), 0.6 * t.sin()))
                .collect();
            droplet.load(layer.kernel(), &positions).unwrap();
            first += nodes;
            droplet
        })
        .collect()
}

fn layers() -> [DoubleLayer; 4] {
    let walls = |zero_flux| Some(RigidWalls::new(5.0, [-1.0, 4.0], zero_flux, 1e-3));
    let images = |across| Images { along: 5.0, across };
    [
        DoubleLayer::new(images(Some(5.0)), None, 1.0),
        DoubleLayer::new(images(Some(4.8)), None, 1.0),
        DoubleLayer::new(images(None), walls(false), 1.0),
        DoubleLayer::new(images(None), walls(true), 1.0),
    ]
}

fn vector(len: usize, seed: f64) -> Vec<f64> {
    (0..len).map(|k| (seed * (k * k + 1) as f64).sin()).collect()
}

#[test]
fn the_transposed_product_is_that_of_the_transposed_matrix() {
    for mut layer in layers() {
        let droplets = droplets(&layer);
        layer.build(&droplets);
        let (v, q) = (vector(128, 0.7), vector(128, 1.3));
        let (mut av, mut aq) = (vec![0.0; 128], vec![0.0; 128]);
        layer.product(&droplets, &v, &mut av);
        layer.transposed_product(&droplets, &q, &mut aq);
        let (left, right) = (dot(&q, &av), dot(&aq, &v));
        // The walls' modes are truncated for each distance on its own.
        assert!((left - right).abs() < 1e-5 * left.abs().max(1.0), "{left} {right}");
    }
}

#[test]
fn rigid_motions_are_multiplied_by_the_viscosity_of_the_surroundings() {
    for mut layer in layers() {
        let mut droplets = droplets(&layer);
        // Far from each other the trapezoidal rule is exact.
        droplets.truncate(1);
        layer.build(&droplets);
        let mut out = vec![0.0; 80];
        for motion in [|_: Vec2| Vec2::new(1.0, 0.0), |_| Vec2::new(0.0, 1.0), |r: Vec2| Vec2::new(-r.y, r.x)] {
            let values: Vec<Vec2> = droplets[0].positions.iter().map(|r| motion(*r)).collect();
            let v: Vec<f64> = values.iter().map(|v| v.x).chain(values.iter().map(|v| v.y)).collect();
            layer.product(&droplets, &v, &mut out);
            for (out, v) in out.iter().zip(&v) {
                assert!((out - v).abs() < 1e-4, "{out} {v}");
            }
        }
    }
}
