//! Shapes of runs at some of their times, and quantities over their time.

use anyhow::{Context, Result};
use motile::base::Vec2;
use motile::setup::Built;
use motile_cli::run::Summary;
use motile_cli::sweep::Trial;
use motile_output::{Raster, Snapshot, SolidMeter};
use serde::Deserialize;
use serde_json::Value;

use super::{FIELD_CELLS, lines_around};

/// Request for shapes of a run, its times in the order of `times`, and for quantities every so often.
///
/// A row has `centre_x_K`, where the first droplet's centroid is at time number K, not wrapped, and lists of points:
/// `droplet_x_K_*` and `droplet_y_K_*` of the first droplet at time number K,
/// `wall_x_K_*_*` and `wall_y_K_*_*` of the surfaces of all solids, `mesh_x_*_*` and `mesh_y_*_*` of the triangles of
/// solids at the first time, `streamlines_x_*_*` and `streamlines_y_*_*` of the flow then. `angle_*` and
/// `concentration_*` are of the first droplet at the first time. Over time: `series_time_*`, `series_speed_*`,
/// `series_narrowest_*` and `series_widest_*`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Frames {
    /// Times of shapes, rising.
    #[serde(default)]
    times: Vec<f64>,
    /// Distance of the times of quantities (time).
    every: Option<f64>,
    #[serde(default)]
    mesh: bool,
    #[serde(default)]
    streamlines: bool,
}

/// Shapes and quantities of one run.
#[derive(Default)]
struct Film {
    centres: Vec<f64>,
    droplets: [Vec<Vec<f64>>; 2],
    walls: [Vec<Vec<Vec<f64>>>; 2],
    series: [Vec<f64>; 4],
}

impl Frames {
    /// Runs a scene and keeps what is asked for of it.
    pub(super) fn summary(&self, trial: &Trial) -> Result<Summary> {
        let started = std::time::Instant::now();
        let Built { mut scene, droplets, solids, .. } = trial.setup.build()?;
        let droplet = *droplets.first().context("shapes of no droplet")?;
        let period = trial.setup.region.lengths()[0];
        let every = self.every.unwrap_or(f64::INFINITY);
        let shapes: Vec<f64> = self.times.iter().map(|time| time.min(trial.time)).collect();
        let regular = (1..).map(|k| f64::from(k) * every).take_while(|time| *time <= trial.time);
        let mut times: Vec<f64> = shapes.iter().copied().chain(regular).collect();
        times.sort_by(f64::total_cmp);
        times.dedup();
        let (mut film, mut summary) = (Film::default(), Summary::default());
        let mut first = true;
        for time in times {
            if time > 0.0 {
                scene.run(time).go()?;
            }
            let seen = scene.observe(droplet)?;
            if self.every.is_some() && time > 0.0 {
                let widths =
                    SolidMeter::of(scene.system()).map(|mut meter| meter.measure(scene.system())).transpose()?;
                let [narrowest, widest, ..] = widths.unwrap_or([f64::NAN; 8]);
                for (list, value) in film.series.iter_mut().zip([time, seen.speed(), narrowest, widest]) {
                    list.push(value);
                }
            }
            if !shapes.contains(&time) {
                continue;
            }
            // A centroid at an edge stays at the left one.
            let back = period * (seen.centroid.x / period + 0.5 + 1e-9).floor();
            let markers = scene.body(droplet)?.markers().to_vec();
            film.centres.push(seen.centroid.x);
            put(&mut film.droplets, closed(&markers, -back));
            let mut surfaces = [Vec::new(), Vec::new()];
            let mut edges = [Vec::new(), Vec::new()];
            for solid in &solids {
                let solid = scene.body(*solid)?;
                let mesh = solid.mesh();
                for boundary in mesh.boundary_loops() {
                    let polygon =
                        mesh.boundary_polygon(boundary, solid.positions()).context("a surface of the mesh")?;
                    let around = polygon.first().zip(polygon.last());
                    let ring = around.is_some_and(|(first, last)| (*last - *first).length() < 0.5 * period);
                    put(&mut surfaces, if ring { closed(&polygon, 0.0) } else { across(&polygon, period) });
                }
                for triangle in 0..if self.mesh { mesh.triangles().len() } else { 0 } {
                    let corners = mesh.corners(triangle, solid.positions()).context("a triangle of the mesh")?;
                    put(&mut edges, closed(&corners, -back));
                }
            }
            put(&mut film.walls, surfaces);
            if !std::mem::take(&mut first) {
                continue;
            }
            if self.mesh {
                lists(&mut summary, ["mesh_x", "mesh_y"], edges);
            }
            let corner = [-0.5 * period; 2];
            let bodies =
                Snapshot::of_bodies(scene.system(), Raster::new(corner, [period; 2], [FIELD_CELLS; 2], [false; 2])?)?;
            if let Some(outline) = bodies.droplets.first() {
                let angle = |x: &Vec2| (x.y - outline.centroid.y).atan2(x.x - outline.centroid.x);
                let mut pairs: Vec<(f64, f64)> =
                    outline.markers.iter().map(angle).zip(outline.concentration.iter().copied()).collect();
                pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
                let (angles, concentrations): (Vec<f64>, Vec<f64>) = pairs.into_iter().unzip();
                lists(&mut summary, ["angle", "concentration"], [angles, concentrations]);
            }
            if self.streamlines {
                let lines = lines_around(seen.centroid, |points| {
                    let mut samples = vec![motile::base::FlowSample::default(); points.len()];
                    scene.system_mut().sample(points, &mut samples)?;
                    Ok(samples.into_iter().map(|sample| sample.velocity).collect())
                })?;
                lists(&mut summary, ["streamlines_x", "streamlines_y"], lines);
            }
        }
        lists(&mut summary, ["centre_x"], [film.centres]);
        lists(&mut summary, ["droplet_x", "droplet_y"], film.droplets);
        lists(&mut summary, ["wall_x", "wall_y"], film.walls);
        lists(&mut summary, ["series_time", "series_speed", "series_narrowest", "series_widest"], film.series);
        summary.put("seconds", started.elapsed().as_secs_f64(), "");
        Ok(summary)
    }
}

/// Adds both coordinates of a line to two lists of lines.
fn put<T>(lists: &mut [Vec<T>; 2], line: [T; 2]) {
    for (list, values) in lists.iter_mut().zip(line) {
        list.push(values);
    }
}

fn lists<const N: usize, T>(summary: &mut Summary, names: [&str; N], lists: [Vec<T>; N])
where
    Value: From<Vec<T>>,
{
    for (name, list) in names.into_iter().zip(lists) {
        summary.put(name, list, "");
    }
}

/// The coordinates of a closed polygon, moved along x, to a thousandth of a length, its first point repeated.
fn closed(polygon: &[Vec2], along: f64) -> [Vec<f64>; 2] {
    let points = || polygon.iter().chain(polygon.first());
    [points().map(|p| rounded(p.x + along)).collect(), points().map(|p| rounded(p.y)).collect()]
}

/// The coordinates of a line that is periodic along x over one whole period about x = 0.
fn across(line: &[Vec2], period: f64) -> [Vec<f64>; 2] {
    let mut points: Vec<Vec2> = line.iter().map(|p| Vec2::new(p.x - period * (p.x / period).round(), p.y)).collect();
    // From the largest step back on: a surface may lean, but not over half a period.
    let step = |k: usize| points[(k + 1) % points.len()].x - points[k].x;
    let jump = (0..points.len()).max_by(|a, b| step(*a).abs().total_cmp(&step(*b).abs())).unwrap_or(0);
    let first = (jump + 1) % points.len().max(1);
    points.rotate_left(first);
    let end = points.first().zip(points.last()).map(|(start, last)| {
        // A line may run from right to left.
        *start + Vec2::new(period * (last.x - start.x).signum(), 0.0)
    });
    points.extend(end);
    [points.iter().map(|p| rounded(p.x)).collect(), points.iter().map(|p| rounded(p.y)).collect()]
}

fn rounded(x: f64) -> f64 {
    (x * 1e3).round() * 1e-3
}

#[cfg(test)]
mod tests;
