//! Droplets of another viscosity than the exterior fluid, by layers and smeared over the grid.

use motile::base::Region;
use motile_tests::validation::contrast::{Droplet, Errors, Exact};
use motile_tests::validation::{StudyError, Table};

use crate::tables::{Measure, Once};
use crate::validation::{SPACINGS, Tables, list};

/// Nodes of layers, from coarse to fine.
const NODES: [usize; 3] = [16, 32, 64];

const RATIOS: [f64; 5] = [0.01, 1.0, 10.0, 100.0, 1000.0];

/// Finds the errors at all resolutions.
type Find<'a> = &'a dyn Fn() -> Result<Vec<Errors>, StudyError>;

pub(crate) fn shapes() -> Tables {
    let mut table = Table::new(
        "Fixed ellipses of another viscosity in a 6 x 6 box, errors in % of layers with 16, 32, 64 nodes and of a \
         smeared viscosity at h = R/10, R/20, R/40: velocity of the centroid, root mean square and largest over the \
         markers",
        "shape, tension | ratio | way | centroid | rms | largest",
    );
    let region = Region::Box { lengths: [6.0; 2] };
    for ratio in RATIOS {
        let exact = Once::new();
        let exact = || exact.get(|| Exact::new(region, &[Droplet::ellipse(ratio)], 256));
        let layers = || NODES.iter().map(|&nodes| Ok(exact()?.errors(nodes)?[0])).collect::<Result<_, StudyError>>();
        let smeared = || SPACINGS.iter().map(|&h| Ok(exact()?.smeared_errors(h)?[0])).collect();
        let ways: [(&str, Find<'_>); 2] = [("layers", &layers), ("arithmetic", &smeared)];
        for (way, errors) in ways {
            table.measure(format_args!("ellipse, 1 + 0.5 cos | {ratio} | {way}"), || {
                let errors = errors()?;
                let of = |value: fn(&Errors) -> f64| list(errors.iter().map(value));
                Ok([of(|e| e.speed), of(|e| e.rms), of(|e| e.maximum)].join(" | "))
            })?;
        }
    }
    Ok(vec![table])
}
