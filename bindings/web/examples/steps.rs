//! Steps a second of scenes of 1, 4 and 16 droplets on the host, as `tests/speed.mjs` measures them in Chromium:
//! `cargo run --release -p motile-web --example steps`.

use std::time::Instant;

use motile::setup::Setup;
use motile_web::live::Live;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    for (count, side) in [(1, 6.0), (4, 8.0), (16, 13.0)] {
        let scene = format!(
            "region.box.lengths = [{side:?}, {side:?}]\nmethod.integral = {{ nodes = 32, elements = 96 }}\n\
             repulsion = {{ strength = 1000.0, range = 0.26 }}\n[[suspension]]\ncount = {count}\nactivity = -3.0\n"
        );
        let mut live = Live::new(Setup::from_toml(&scene)?)?;
        for _ in 0..20 {
            live.step(None)?;
        }
        let (began, steps) = (Instant::now(), 1600 / count);
        for _ in 0..steps {
            live.step(None)?;
        }
        let rate = steps as f64 / began.elapsed().as_secs_f64();
        println!("{count} droplets: {rate:.0} steps a second, speed {:?}", live.speed(0)?);
    }
    Ok(())
}
