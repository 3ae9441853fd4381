use super::*;
use motile::{ElasticChannel, Swimmer, elastic_solids::Moduli};

#[test]
fn triangles_of_both_walls_of_a_channel() {
    let swimmer = Swimmer { lengths: [4.0, 2.4], spacing: 0.2, ..Swimmer::default() };
    let channel = ElasticChannel::new(swimmer, Moduli::new(100.0, 200.0).unwrap());
    let (scene, _, _) = channel.build().unwrap();
    let thickness = 1.5 - channel.set_back();
    let system = scene.system();
    let mut pieces = Pieces::default();
    solids(system).enumerate().for_each(|(number, solid)| pieces.add(number, solid));
    let size = |t: &[usize; 3]| {
        let [a, b, c] = t.map(|k| pieces.points[k]);
        0.5 * (b - a).perp(&(c - a))
    };
    // None is stretched over the period, and together they are both walls.
    assert!(pieces.triangles.iter().all(|t| size(t) > 0.0 && size(t) < 0.03));
    assert!((pieces.triangles.iter().map(size).sum::<f64>() - 2.0 * 4.0 * thickness).abs() < 1e-9);
    assert!(pieces.stress.iter().flatten().all(|s| s.abs() < 1e-9));
}
