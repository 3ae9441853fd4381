//! Stiff elastic walls against rigid ones, without a grid.

use motile::elastic_solids::Moduli;
use motile::prelude::*;
use motile::stokes_grid::Drive;
use motile::{ElasticChannel, WallSurface};

const TIME: f64 = 3.0;

fn swimmer(activity: f64, width: f64, spacing: f64) -> Swimmer {
    Swimmer { activity, lengths: [6.0, width], spacing, ..Swimmer::default() }
}

/// Where the centre of a droplet is along the channel.
fn centre(droplet: &ActiveDroplet) -> f64 {
    let (mut area, mut moment) = (0.0, 0.0);
    let markers = droplet.markers();
    for (a, b) in markers.iter().zip(markers.iter().cycle().skip(1)) {
        area += a.perp(b);
        moment += a.perp(b) * (a.x + b.x) / 3.0;
    }
    moment / area
}

/// How far the droplet swims between rigid walls.
fn rigid(activity: f64, width: f64) -> f64 {
    let swimmer = Swimmer { method: Method::BoundaryIntegral, ..swimmer(activity, width, 0.1) };
    let (mut scene, droplet) = swimmer.build_in_channel(Drive::ZeroGradient).expect("a scene");
    scene.run(TIME).go().expect("a run");
    centre(scene.body(droplet).unwrap())
}

/// How far it swims between walls of springs of the thesis' k = 1e6, over that.
fn error(activity: f64, width: f64, spacing: f64, surface: WallSurface) -> f64 {
    let moduli = Moduli::from_thesis_spring_constant(1e6).expect("moduli");
    let channel = ElasticChannel { surface, ..ElasticChannel::new(swimmer(activity, width, spacing), moduli) };
    let (mut scene, droplet, _) = channel.build().expect("a scene");
    scene.run(TIME).go().expect("a run");
    centre(scene.body(droplet).unwrap()) / rigid(activity, width) - 1.0
}

/// Springs of 1e6 are not rigid: what is left at h = 0.05 is theirs, 0.1 and 0.3 %. The grid's part is what changes
/// with h.
#[test]
fn stiff_walls_are_where_they_are_said_to_be() {
    for activity in [-2.0, -4.0] {
        let errors = |surface| [0.1, 0.05].map(|h| error(activity, 3.0, h, surface));
        let (corrected, plain) = (errors(WallSurface::Corrected), errors(WallSurface::Plain));
        assert!(corrected[0].abs() < 6e-3 && corrected[1].abs() < 3e-3, "{activity}: {corrected:?}");
        let [change, change_plain] = [corrected, plain].map(|[coarse, fine]| (coarse - fine).abs());
        assert!(change < 0.35 * change_plain, "{activity}: {corrected:?} {plain:?}");
    }
}
