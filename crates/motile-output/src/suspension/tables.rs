//! Tables of a suspension: its observables over time, and the ways of its droplets.

use std::collections::HashMap;
use std::error::Error;
use std::path::Path;

use motile::analysis::suspension::{
    Member, PairAverages, PairCorrelations, cluster_sizes, heading_correlation, mean_square_displacement,
    nematic_order, polar_order,
};
use motile::base::{Region, Vec2};
use motile::scene::{Body, Handle, Hydrodynamics, Observer, System};

use crate::{CsvTable, OutputError};

/// Names of the records of the droplets at the start.
const START: &str = "suspension at the start";
/// Columns of the table over time; the last four in boxes alone.
const COLUMNS: [&str; 17] = [
    "time",
    "polar_order",
    "nematic_order",
    "speed",
    "square_displacement",
    "heading_correlation",
    "contacts",
    "largest_cluster",
    "smallest_gap",
    "film",
    "film_pressure",
    "area_change",
    "particle_change",
    "stress_xx",
    "stress_xy",
    "stress_yy",
    "contact_stress",
];
/// Columns of the table of droplets.
const MEMBERS: [&str; 12] = [
    "time",
    "droplet",
    "x",
    "y",
    "heading_x",
    "heading_y",
    "velocity_x",
    "velocity_y",
    "deformation",
    "inclination_degrees",
    "stresslet_xx_laboratory",
    "stresslet_xy_laboratory",
];

/// Observer of all droplets of a scene together, which writes `suspension.csv` and `members.csv`.
///
/// The columns of `suspension.csv`, of which fields are empty if a quantity does not exist: `time`; `polar_order` and
/// `nematic_order` of the headings ([`Member::heading`]); `speed`, the mean relative to the imposed flow (length per
/// time); `square_displacement`, the mean since the start (length squared); `heading_correlation` with the start;
/// `contacts`, pairs of bodies closer than the reach; `largest_cluster` of droplets in contact; `smallest_gap` below
/// the reach (length); `film`, the mean thickness of the films that a repulsion holds (length), and `film_pressure`,
/// the largest pressure on one (force per length); `area_change` and `particle_change`, the largest relative ones of a
/// droplet since the start; `stress_xx`, `stress_xy`, `stress_yy` of the droplets in a box, over its area, and
/// `contact_stress`, the pressure that a repulsion transmits between them (force per length). The columns of
/// `members.csv`: `time`, `droplet`, centroid, heading, velocity, deformation and inclination of the ellipse with its
/// moments, and stresslet in the axes x and y of each droplet. A droplet whose particles are uniform has no heading.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::SuspensionSetup;
/// use motile_output::suspension::SuspensionCsv;
///
/// let suspension = vec![SuspensionSetup { count: Some(3), ..SuspensionSetup::default() }];
/// let method = Method::Integral(IntegralMethod { nodes: 16, elements: 32 });
/// let Built { mut scene, .. } = Setup { method, suspension, droplets: vec![], ..Setup::default() }.build()?;
/// let directory = std::env::temp_dir();
/// let mut tables = SuspensionCsv::create(&directory, scene.system_mut(), 0.1)?;
/// scene.run(0.1).observe(Every::Time(0.1), &mut tables).go()?;
/// assert_eq!((tables.table().rows().len(), tables.members().rows().len()), (2, 6));
/// # std::fs::remove_file(directory.join("suspension.csv"))?;
/// # std::fs::remove_file(directory.join("members.csv"))?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SuspensionCsv {
    table: CsvTable,
    members: CsvTable,
    reach: f64,
    stressed: bool,
}

impl SuspensionCsv {
    /// Creates an observer that writes into a directory; bodies closer than `reach` (length) are in contact. In a
    /// resumed run, past time 0, the tables begin with the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] for a scene without droplets; [`OutputError::Write`]; [`OutputError::Scene`] for
    /// a flow that cannot be computed.
    pub fn create<H: Hydrodynamics>(
        directory: impl AsRef<Path>,
        system: &mut System<H>,
        reach: f64,
    ) -> Result<Self, OutputError> {
        let members = Member::all(system)?;
        if members.is_empty() {
            return Err(OutputError::Empty("tables of a suspension without droplets"));
        }
        let stressed = system.stress().is_ok();
        let start = system.record_mut(START);
        let count = 6 * members.len();
        if start.numbers.len() != count {
            let numbers = members.iter().flat_map(|member| {
                let Member { centroid, heading, area, particles, .. } = *member;
                [centroid.x, centroid.y, heading.x, heading.y, area, particles]
            });
            start.numbers = numbers.collect();
        }
        let columns = &COLUMNS[..COLUMNS.len() - if stressed { 0 } else { 4 }];
        let [table, members] = [("suspension", columns), ("members", &MEMBERS[..])].map(|(name, columns)| {
            let path = directory.as_ref().join(format!("{name}.csv"));
            CsvTable::of_run(path, columns, system, &format!("table {name}"))
        });
        Ok(Self { table: table?, members: members?, reach, stressed })
    }

    /// Returns the table over time, in a resumed run also of the time before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }

    /// Returns the table of the droplets.
    #[must_use]
    pub fn members(&self) -> &CsvTable {
        &self.members
    }

    /// Returns the value of a column at the last time; `None` before the first row, and if there is no such value.
    #[must_use]
    pub fn last(&self, column: &str) -> Option<f64> {
        let k = COLUMNS.iter().position(|name| *name == column)?;
        self.table.rows().last()?.get(k).copied().filter(|value| value.is_finite())
    }

    /// Returns the times from `from` on, and what pairs of columns of the table of droplets say of all of them at each
    /// (`columns` is the number of the first one).
    fn states(&self, from: f64, columns: usize) -> (Vec<f64>, Vec<Vec<Vec2>>) {
        let (mut times, mut states) = (Vec::new(), Vec::<Vec<Vec2>>::new());
        for row in self.members.rows().iter().filter(|row| row[0] >= from) {
            if times.last() != Some(&row[0]) {
                times.push(row[0]);
                states.push(Vec::new());
            }
            if let Some(state) = states.last_mut() {
                // Without a heading there are no numbers.
                let [x, y] = [row[columns], row[columns + 1]];
                state.push(if x.is_nan() { Vec2::ZERO } else { Vec2::new(x, y) });
            }
        }
        (times, states)
    }

    /// Returns the mean square displacement (length squared) and correlation of headings (no dimension) over the time
    /// between two states, from the time `from` on, all of them as far apart as on average.
    #[must_use]
    pub fn diffusion(&self, from: f64) -> Vec<[f64; 3]> {
        let ((times, places), (_, headings)) = (self.states(from, 2), self.states(from, 4));
        let count = times.len().saturating_sub(1).max(1) as f64;
        let interval = times.first().zip(times.last()).map_or(0.0, |(first, last)| (last - first) / count);
        let (squares, correlation) = (mean_square_displacement(&places), heading_correlation(&headings));
        let lags = squares.into_iter().zip(correlation).enumerate();
        lags.map(|(lag, (square, correlation))| [lag as f64 * interval, square, correlation]).collect()
    }

    /// Computes the correlations of pairs in a region, averaged over the states after the time `from`, in bins of a
    /// width up to a distance (length).
    #[must_use]
    pub fn pairs(&self, region: &Region, from: f64, bin: f64, reach: f64) -> PairCorrelations {
        let mut averages = PairAverages::new(region, bin, reach);
        let ((_, places), (_, velocities)) = (self.states(from, 2), self.states(from, 6));
        places.iter().zip(&velocities).for_each(|(places, velocities)| averages.add(places, velocities));
        averages.correlations()
    }
}

impl<H: Hydrodynamics> Observer<H> for SuspensionCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let (members, time) = (Member::all(system)?, system.time());
        let count = members.len() as f64;
        let mean = |of: &dyn Fn(&Member) -> f64| members.iter().map(of).sum::<f64>() / count;
        let headings: Vec<Vec2> = members.iter().map(|member| member.heading).collect();
        let headed = headings.iter().any(|heading| *heading != Vec2::ZERO);
        let turned = |member: &Member, start: &[f64]| member.heading.dot(Vec2::new(start[2], start[3]));
        let start = system.record(START).map(|record| record.numbers.clone()).unwrap_or_default();
        let since = |of: &dyn Fn(&Member, &[f64]) -> f64| -> Vec<f64> {
            members.iter().zip(start.chunks_exact(6)).map(|(member, start)| of(member, start)).collect()
        };
        let mean_since = |of: &dyn Fn(&Member, &[f64]) -> f64| since(of).iter().sum::<f64>() / count;
        let largest_since =
            |of: &dyn Fn(&Member, &[f64]) -> f64| since(of).iter().map(|change| change.abs()).fold(0.0, f64::max);
        let load = system.repulsion_load()?;
        let near = system.pairs_within(self.reach);
        let places: HashMap<usize, usize> =
            members.iter().enumerate().map(|(place, member)| (member.droplet.index(), place)).collect();
        let place = |body: Handle<dyn Body>| places.get(&body.index()).copied();
        let pairs: Vec<[usize; 2]> = near.iter().filter_map(|([a, b], _)| Some([place(*a)?, place(*b)?])).collect();
        let mut row = vec![
            time,
            if headed { polar_order(&headings) } else { f64::NAN },
            if headed { nematic_order(&headings) } else { f64::NAN },
            mean(&|member| member.relative_velocity.length()),
            mean_since(&|member, start| (member.centroid - Vec2::new(start[0], start[1])).length_squared()),
            if headed { mean_since(&turned) } else { f64::NAN },
            near.len() as f64,
            cluster_sizes(members.len(), &pairs).first().copied().unwrap_or_default() as f64,
            near.iter().map(|(_, gap)| *gap).reduce(f64::min).unwrap_or(f64::NAN),
            load.and_then(|load| load.mean_film).unwrap_or(f64::NAN),
            load.map_or(f64::NAN, |load| load.largest_pressure),
            largest_since(&|member, start| member.area / start[4] - 1.0),
            largest_since(&|member, start| if start[5] > 0.0 { member.particles / start[5] - 1.0 } else { 0.0 }),
        ];
        if self.stressed {
            let [[xx, xy], [_, yy]] = system.stress()?.of_particles();
            let area: f64 = system.hydrodynamics().fluid_view().domain.periods.iter().flatten().product();
            let contact = load.map_or(0.0, |load| 0.5 * (load.virial[0][0] + load.virial[1][1]) / area);
            row.extend([xx, xy, yy, contact]);
        }
        self.table.push_state(system, &row)?;
        let rows: Vec<[f64; 12]> = members
            .iter()
            .map(|member| {
                let Member { droplet, centroid, heading, velocity, shape, stresslet, .. } = *member;
                let number = droplet.index() as f64;
                let [along, up] = if heading == Vec2::ZERO { [f64::NAN; 2] } else { heading.to_array() };
                let (deformation, [xx, xy]) = (shape.deformation(), stresslet[0]);
                let angle = shape.angle.map_or(f64::NAN, f64::to_degrees);
                let Vec2 { x, y } = centroid;
                [time, number, x, y, along, up, velocity.x, velocity.y, deformation, angle, xx, xy]
            })
            .collect();
        Ok(self.members.push_rows(system, &rows)?)
    }
}
