//! A picture of all droplets and solids of a scene at one time.

use std::path::Path;

use anyhow::Result;
use motile::{
    active_interface::{ActiveDroplet, curve::polygon_moments},
    ib_core::{FlowSample, Hydrodynamics, System},
};

use crate::{
    ColourMap, ColourScale, Format, Limits, Picture, ScalarSamples, Vec2, VectorSamples, at_markers, domain_raster,
    solid_shape, solids,
};

/// Most cells of the fields in a direction.
const MOST_CELLS: usize = 200;
/// Distance of streamlines, as part of the smaller side.
const STREAMLINES: f64 = 0.05;

/// All droplets of a system, bodies of other kinds left out.
pub fn droplets<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = &ActiveDroplet> {
    system.bodies().map(|(_, droplet)| droplet)
}

/// Draws pressure, streamlines, all droplets coloured by their concentrations (in units of `concentration`, particles
/// per length), solids and walls to a PNG file; fields are sampled at `spacing` (length) or coarser.
///
/// # Errors
/// A flow that cannot be computed, a domain without end, a file that cannot be written.
pub fn write_scene_picture<H: Hydrodynamics>(
    system: &mut System<H>,
    spacing: f64,
    concentration: f64,
    title: &str,
    path: &Path,
) -> Result<()> {
    let domain = system.hydrodynamics().medium().domain;
    let raster = domain_raster(&domain, spacing, MOST_CELLS)?;
    let mut flow = vec![FlowSample::default(); raster.len()];
    system.sample(&raster.points(), &mut flow)?;
    let pressure: Vec<f64> = flow.iter().map(|sample| sample.pressure).collect();
    let velocity = VectorSamples::new(raster, flow.iter().map(|sample| sample.velocity).collect())?;

    let interfaces: Vec<(Vec<Vec2>, Vec<f64>)> = droplets(system)
        .map(|droplet| {
            let values = at_markers(droplet.concentrations()).iter().map(|c| c / concentration).collect();
            (droplet.markers().to_vec(), values)
        })
        .collect();
    let all: Vec<f64> = interfaces.iter().flat_map(|(_, values)| values.iter().copied()).collect();
    let anchor = match interfaces.first() {
        Some((markers, _)) => polygon_moments(markers)?.centroid,
        None => Vec2::from(raster.origin()),
    };
    let colours = ColourScale::new(ColourMap::Rainbow, Limits::Most, &pressure);
    let [width, height] = raster.size();
    let picture = Picture::new(ScalarSamples::new(raster, pressure)?, colours, "pressure p")
        .title(title)
        .streamlines(velocity, STREAMLINES * width.min(height), anchor)
        .interface_scale(ColourScale::new(ColourMap::Magma, Limits::FromZero, &all), "concentration c/c_{0}");
    let mut picture =
        interfaces.iter().try_fold(picture, |picture, (markers, values)| picture.interface(markers, values))?;
    for solid in solids(system) {
        picture = picture.solid_shape(&solid_shape(solid));
    }
    if let Some([below, above]) = domain.walls {
        picture = picture.walls(below, above);
    }
    picture.draw(&Format::full().width(900))?.write_png(path)
}

#[cfg(test)]
mod tests;
