//! Tables of droplets in three dimensions without symmetry.

use std::error::Error;
use std::path::Path;

use motile::scene::{Handle, Hydrodynamics, Observer, System};
use motile::space_droplets::{Observation, SpaceBody};

use crate::{CsvTable, OutputError};

/// Observer that measures droplets in three dimensions without symmetry and writes their observables to a CSV file: of
/// one droplet, or of all, with a row for each of them at each call.
///
/// * `time`, and in tables of all the number of the `droplet`.
/// * `x`, `y`, `z`: the centroid (length).
/// * `velocity_x`, `velocity_y`, `velocity_z`, `speed`: its velocity and the magnitude (length per time).
/// * `heading_x`, `heading_y`, `heading_z`: the unit vector along the velocity, zero at rest.
/// * `volume`, `area` (length cubed, length squared).
/// * `semi_axis_long`, `semi_axis_middle`, `semi_axis_short`: of the ellipsoid with the same second moments (length).
/// * `deformation`: (long - short)/(long + short).
/// * `particle_number`, `concentration_max`, `concentration_min` (number; particles per area).
/// * `stresslet`: `h . S h` with the stresslet S and the heading h (force times length). It is negative for a puller.
/// * `gap`: the smallest gap to another droplet, a periodic image or a wall (length), if there is one.
/// * `tail_shape`, `tail_particles`: the size of the two highest degrees over all. They measure what is not resolved.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::SpaceCsv;
///
/// let droplet = DropletSetup { heading: Some([0.0, 1.0, 1.0]), ..DropletSetup::contractile(-1.0, 2.0) };
/// let method = Method::Harmonics(HarmonicsMethod { degree: 5 });
/// let setup = Setup { region: Region::Space, method, droplets: vec![droplet], ..Setup::default() };
/// let Built { mut scene, space: Some(droplets), .. } = setup.build()? else { panic!("no droplets in space") };
/// let path = std::env::temp_dir().join("a-droplet-in-space.csv");
/// let mut rows = SpaceCsv::create(&path, scene.system_mut(), droplets, Some(0))?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut rows).go()?;
/// let text = std::fs::read_to_string(&path)?;
/// assert!(text.starts_with("time,x,y,z,velocity_x,") && text.lines().count() == 1 + 3);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SpaceCsv {
    body: Handle<SpaceBody>,
    /// Number of the droplet; none for a table of all.
    only: Option<usize>,
    table: CsvTable,
}

/// Columns of one droplet.
const COLUMNS: [&str; 22] = [
    "time",
    "x",
    "y",
    "z",
    "velocity_x",
    "velocity_y",
    "velocity_z",
    "speed",
    "heading_x",
    "heading_y",
    "heading_z",
    "volume",
    "area",
    "semi_axis_long",
    "semi_axis_middle",
    "semi_axis_short",
    "deformation",
    "particle_number",
    "concentration_max",
    "concentration_min",
    "stresslet",
    "gap",
];
const TAILS: [&str; 2] = ["tail_shape", "tail_particles"];

impl SpaceCsv {
    /// Creates an observer that writes to `path`, of the droplet of a number, or of all droplets. In a resumed run, the
    /// table begins with the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] if the file cannot be written.
    pub fn create<H: Hydrodynamics>(
        path: impl AsRef<Path>,
        system: &mut System<H>,
        body: Handle<SpaceBody>,
        only: Option<usize>,
    ) -> Result<Self, OutputError> {
        let columns = Self::columns(only.is_some());
        let record =
            only.map_or_else(|| "table of all droplets".to_owned(), |number| format!("table of droplet {number}"));
        Ok(Self { body, only, table: CsvTable::of_run(path, &columns, system, &record)? })
    }

    /// Returns the names of the columns, of one droplet or of all.
    #[must_use]
    pub fn columns(of_one: bool) -> Vec<&'static str> {
        let mut names: Vec<&str> = COLUMNS.into_iter().chain(TAILS).collect();
        if !of_one {
            names.insert(1, "droplet");
        }
        names
    }

    /// Returns the values of the columns of one droplet at a time, from its measurements and its gap to others.
    #[must_use]
    pub fn row(time: f64, seen: &Observation, gap: Option<f64>) -> Vec<f64> {
        let [long, middle, short] = seen.semi_axes;
        let h = seen.heading;
        let stresslet: f64 = (0..3).map(|i| (0..3).map(|j| h[i] * seen.stresslet[i][j] * h[j]).sum::<f64>()).sum();
        let mut row = vec![time];
        row.extend(seen.position);
        row.extend(seen.velocity);
        row.push(seen.speed);
        row.extend(h);
        row.extend([seen.volume, seen.area, long, middle, short, (long - short) / (long + short), seen.particles]);
        row.extend([seen.concentrations[1], seen.concentrations[0], stresslet, gap.unwrap_or(f64::NAN)]);
        row.extend(seen.tails);
        row
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for SpaceCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let (time, all) = (system.time(), system.observe(self.body)?);
        let droplets = system.body(self.body)?.droplets();
        let mut rows = Vec::new();
        for (number, seen) in all.iter().enumerate().filter(|(number, _)| self.only.is_none_or(|only| only == *number))
        {
            let mut row = Self::row(time, seen, droplets.smallest_gap(number)?);
            if self.only.is_none() {
                row.insert(1, number as f64);
            }
            rows.push(row);
        }
        Ok(self.table.push_rows(system, &rows)?)
    }
}

#[cfg(test)]
mod tests;
