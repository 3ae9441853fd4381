//! A strong swimmer between rigid walls swings from wall to wall.
//!
//! `cargo run --release --example rigid_channel` starts the droplet a thousandth of its radius away from the axis. With
//! activity -5, swimming straight along the axis is unstable. The spectrum of the steady state predicts the growth rate
//! and the frequency of the swings, and the run shows them.

use motile::prelude::*;
use motile_steady_states::{SteadyState, Symmetry};

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut setup = Setup {
        region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Integral(IntegralMethod { nodes: 64, elements: 256 }),
        droplets: vec![DropletSetup::active(-5.0)],
        ..Setup::default()
    };
    let spectrum = SteadyState::find(&setup)?.spectrum()?;
    let swing = spectrum.leading().ok_or("a spectrum without modes")?;
    println!("predicted: swings grow at {:.4} and turn at {:.4} per time", swing.value.re, swing.value.im);
    assert!(swing.symmetry == Symmetry::Antisymmetric && swing.value.re > 0.0);

    // Once the start is forgotten, heights at equal times t, t + T, t + 2 T are on a growing wave:
    // y3 = 2 e^(s T) cos(w T) y2 - e^(2 s T) y1, with the growth rate s and the frequency w.
    setup.droplets[0].centre = [0.0, 0.001];
    let Built { mut scene, droplets, .. } = setup.build()?;
    let interval = 15.0;
    let mut heights = [0.0; 3];
    for (height, time) in heights.iter_mut().zip([60.0, 60.0 + interval, 60.0 + 2.0 * interval]) {
        scene.run(time).go()?;
        *height = scene.observe(droplets[0])?.centroid.y;
    }
    let growth = (swing.value.re * interval).exp();
    let expected = 2.0 * growth * (swing.value.im * interval).cos() * heights[1] - growth.powi(2) * heights[0];
    println!("heights {heights:.6?}, the last one by the spectrum {expected:.6}");
    assert!((heights[2] - expected).abs() < 0.02 * heights[0].abs().max(heights[2].abs()));
    Ok(())
}
