use motile::base::FlowSample;
use motile::prelude::*;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
    let mut scene = Setup { region: Region::Plane, method, ..Setup::default() }.build()?.scene;
    scene.run(5.0).go()?;
    let x = |k: usize| -4.0 + 0.2 * k as f64;
    let points: Vec<Vec2> = (0..41 * 41).map(|k| Vec2::new(x(k % 41), x(k / 41))).collect();
    let mut flow = vec![FlowSample::default(); points.len()];
    scene.system_mut().sample(&points, &mut flow)?;
    let fastest = flow.iter().map(|sample| sample.velocity.length()).fold(0.0, f64::max);
    let pressures = || flow.iter().map(|sample| sample.pressure);
    let (least, most) = (pressures().fold(f64::INFINITY, f64::min), pressures().fold(f64::NEG_INFINITY, f64::max));
    println!("fastest {fastest:.3}, pressures {least:.2} to {most:.2}");
    Ok(())
}
