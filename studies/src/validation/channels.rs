//! Studies of channels.

use motile::base::Region;
use motile::scene::StepSize;
use motile::setup::{DropletSetup, GridMethod, Method, Particles, Setup};
use motile_tests::validation::Table;
use motile_tests::validation::scene::{on_grid, open_channel};
use motile_tests::validation::swimmers::steady;

use crate::tables::Measure;
use crate::validation::{SPACINGS, Tables, list};

/// A droplet of an activity in a channel, by default and by the method of Cowley with steps of 0.1 h, each with its
/// name.
fn presets(region: Region, viscosity: f64, activity: f64, h: f64) -> [(&'static str, Setup); 2] {
    let default = Setup { region, viscosity, droplets: vec![DropletSetup::active(activity)], ..on_grid(h) };
    let mut droplet = DropletSetup::thesis();
    droplet.particles = droplet.particles.map(|particles| Particles { activity, ..particles });
    let method = Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() });
    let step = StepSize::Fixed(0.1 * h);
    let thesis = Setup { region, viscosity, method, step, droplets: vec![droplet], ..Setup::thesis() };
    [("default", default), ("thesis", thesis)]
}

pub(crate) fn channel_swimmers() -> Tables {
    let mut table = Table::new(
        "Steady swimmers in channels (period 12, A = 10): errors in % of speed, aspect ratio, stresslet, beta, flux, \
         gap",
        "width | activity | preset | h | errors | area change | particle change",
    );
    for (width, activity, time) in
        [(2.0, -2.0, 160.0), (2.0, -4.0, 160.0), (3.0, -2.0, 80.0), (5.0, -2.0, 80.0), (5.0, -4.0, 60.0)]
    {
        for h in SPACINGS {
            for (name, setup) in presets(open_channel(12.0, width), 100.0, activity, h) {
                table.measure(format_args!("{width} | {activity} | {name} | {h}"), || {
                    Ok(match steady(&setup, time) {
                        Ok(e) => {
                            let [flux, gap] = [e.flux, e.gap].map(|error| error.unwrap_or(f64::NAN));
                            let errors = list([e.speed, e.aspect_ratio, e.stresslet, e.beta, flux, gap]);
                            format!("{errors} | {:.1e} | {:.0e}", e.area_change, e.particle_change)
                        }
                        Err(error) => format!("ends: {error} |  | "),
                    })
                })?;
            }
        }
    }
    Ok(vec![table])
}
