//! Swimmers off the grid's axes.

use motile::Swimmer;
use motile::ib_core::{AnyKernel, Kernel};
use motile_tests::validation::Table;
use motile_tests::validation::headings::{course, on_the_grid, without_grid};

use crate::validation::{Tables, per_cent};

const KERNELS: [AnyKernel; 3] = [AnyKernel::BSpline4, AnyKernel::Gaussian6, AnyKernel::Peskin4];

pub(crate) fn headings(quick: bool) -> Tables {
    let end = if quick { 40.0 } else { 80.0 };
    let title = format!(
        "Swimmers off the axes, 6 x 6 box, A = 2 |activity|, against boundary integrals (64 nodes, 384 cells) at t = 10, 20 .. {end}: \
         turn (radians), largest error of the direction (radians), largest error of the speed (%)"
    );
    let mut table = Table::new(&title, &["kernel", "activity", "start", "turn", "h", "ds", "direction", "speed"]);
    let resolutions = [(0.1, 0.05), (0.1, 0.025), (0.05, 0.025)];
    for activity in [-2.0, -3.0, -4.0] {
        for angle in [0.2, 0.4, 0.6] {
            let base = on_the_grid(&Swimmer::default(), activity, 0.1, 0.05, angle);
            let exact = course(&without_grid(&base, 64, 384), 10.0, end)?;
            for kernel in KERNELS {
                for &(h, ds) in if quick { &resolutions[..1] } else { &resolutions[..] } {
                    let base = Swimmer { kernel, ..Swimmer::default() };
                    let found = course(&on_the_grid(&base, activity, h, ds, angle), 10.0, end)?.beyond(&exact);
                    table.push([
                        kernel.name().to_owned(),
                        activity.to_string(),
                        angle.to_string(),
                        format!("{:.3}", exact.turned()),
                        h.to_string(),
                        ds.to_string(),
                        format!("{:.4}", found.heading),
                        per_cent(found.speed),
                    ]);
                }
            }
        }
    }
    Ok(vec![table])
}
