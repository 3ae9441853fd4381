//! Swimmers off the grid's axes.

use motile::ib_core::{AnyKernel, Kernel};
use motile::scene::StepSize;
use motile::setup::{GridMethod, Method, Setup};
use motile_tests::validation::Table;
use motile_tests::validation::headings::{course, off_axis};
use motile_tests::validation::scene::without_grid;

use crate::validation::{Tables, per_cent};

const KERNELS: [AnyKernel; 3] = [AnyKernel::BSpline4, AnyKernel::Gaussian6, AnyKernel::Peskin4];

pub(crate) fn headings(quick: bool) -> Tables {
    let end = if quick { 40.0 } else { 80.0 };
    let title = format!(
        "Swimmers off the axes, 6 x 6 box, A = 2 |activity|: against boundary integrals (64 nodes, 384 elements) at t \
         = 10, 20 .. {end}: turn (radians), largest error of the direction (radians), largest error of the speed (%)"
    );
    let mut table = Table::new(&title, &["kernel", "activity", "start", "turn", "h", "ds", "direction", "speed"]);
    let resolutions = [(0.1, 0.05), (0.1, 0.025), (0.05, 0.025)];
    for activity in [-2.0, -3.0, -4.0] {
        for angle in [0.2, 0.4, 0.6] {
            let exact = off_axis(without_grid(64, 384).method, activity, angle);
            let exact = course(&Setup { step: StepSize::OfLimit(0.5), ..exact }, 10.0, end)?;
            for kernel in KERNELS {
                for &(h, ds) in if quick { &resolutions[..1] } else { &resolutions[..] } {
                    let grid = GridMethod { kernel, marker_spacing: Some(ds), ..GridMethod::of_spacing(h) };
                    let found = course(&off_axis(Method::Grid(grid), activity, angle), 10.0, end)?.beyond(&exact);
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
