//! The picture of the regimes of a droplet over its dimensionless numbers, drawn from what the library computes. The
//! drawings of model and methods beside it in `docs/images` are SVG files, to be edited as such.

use std::fs;

use anyhow::{Context, Result};
use motile::active_interface::Tension;
use motile::prelude::*;
use motile::setup::ExcludedVolume;
use motile_output::plot::{AxisScale, Figure, Marker, Plot, Series};

use crate::tables::root;

/// Draws the picture of the regimes.
#[derive(Debug, clap::Args)]
pub(crate) struct Flags {
    /// Write it to docs/images
    #[arg(long)]
    write: bool,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let picture = picture()?;
    if flags.write {
        fs::write(root().join("docs/images/regimes.svg"), picture)?;
    }
    Ok(())
}

/// Strength of the excluded volume of the swimmers of figure 2.23 (force times length).
const A: f64 = 10.0;
/// The threshold of swimming as a Péclet number.
const THRESHOLD: f64 = 2.0;

/// Where droplets rest, swim as pullers or pushers, and collapse, over Péclet number and excluded volume; and, over the
/// ratio of viscosities, how fast swimming along the axis of a box of 6 R0 becomes unstable.
fn picture() -> Result<String> {
    // Swimmers of figure 2.23: activity, squirmer parameter, sum of the viscosities.
    let kept = fs::read_to_string(root().join("docs/book/figures/2.23.csv"))?;
    let numbers = |line: &str| -> Option<[f64; 3]> {
        let mut parts = line.rsplitn(5, ',').skip(1).map(str::parse);
        let (y, x, group) = (parts.next()?.ok()?, parts.next()?.ok()?, parts.next()?.ok()?);
        Some([group, x, y])
    };
    let place = |[sum, activity, _]: [f64; 3]| -> Result<(f64, f64)> {
        let setup = Setup { viscosity: 0.5 * sum, ..Setup::default() };
        let numbers = setup.numbers(&DropletSetup::contractile(activity, A))?.context("particles")?;
        Ok((numbers.peclet, numbers.excluded_volume.context("an excluded volume")?))
    };
    let (mut pullers, mut pushers) = (Vec::new(), Vec::new());
    for point in kept.lines().skip(1).filter_map(numbers) {
        if point[2] > 0.0 { pullers.push(place(point)?) } else { pushers.push(place(point)?) }
    }
    // The exact threshold: the slope of the tension at c0, excluded volume included, is that of the activity there.
    let threshold = |ratio: f64| -> Result<(f64, f64)> {
        let activity = -1.0;
        let particles = Particles { activity, excluded_volume: ExcludedVolume::Step(ratio), ..Particles::default() };
        let slope = particles.law(10.0)?.slope(particles.concentration);
        Ok((THRESHOLD / slope * activity.abs(), ratio))
    };
    let ratios = (0..16).map(|k| 10_f64.powf(0.2 * f64::from(k)));
    let border: Vec<(f64, f64)> = ratios.map(threshold).collect::<Result<_>>()?;
    let collapse = [(1.0, 1.0), (100.0, 1.0)];
    let first = Plot::new("")
        .x_axis("Péclet number |ζΔμ| c_{0} R_{0} / (η_{in} + η_{ext}) D", AxisScale::Logarithmic)
        .y_axis("A / |ζΔμ|", AxisScale::Logarithmic)
        .series(Series::line("rests to the left", border))
        .series(Series::line("collapses below", collapse).dashed())
        .series(Series::points("puller", pullers).marker(Marker::Disc))
        .series(Series::points("pusher", pushers).marker(Marker::Disc));
    let kept = fs::read_to_string(root().join("docs/tables/steady-contrast.csv"))?;
    let rate = |line: &str| -> Option<(f64, f64)> {
        let cells: Vec<&str> = line.split(',').collect();
        let rate = cells.get(5)?.split(' ').next()?.parse().ok()?;
        Some((cells.first()?.parse().ok()?, rate))
    };
    let mut rates: Vec<(f64, f64)> = kept.lines().filter(|line| !line.starts_with('#')).filter_map(rate).collect();
    rates.sort_by(|a, b| a.0.total_cmp(&b.0));
    let second = Plot::new("")
        .x_axis("η_{in} / η_{ext}", AxisScale::Logarithmic)
        .y_axis("growth rate of a turn", AxisScale::Linear)
        .series(Series::line("Péclet number 10, A/|ζΔμ| = 5", rates))
        .horizontal(0.0, "turns above");
    Ok(Figure::new(2).panel(first).panel(second).svg()?)
}
