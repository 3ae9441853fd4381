//! Rectangle, resolution and caption of the pictures of a run.

use anyhow::Result;
use motile::base::{Region, Vec2};
use motile::scene::Scene;
use motile::setup::{AnyFlow, ExcludedVolume, GridMethod, Particles, Setup};
use motile_output::Raster;

/// Most cells in a direction of the fields in pictures and files.
const MOST_CELLS: usize = 512;
/// Side of the square that pictures show of unbounded fluid (length scales of the scene).
const VIEW: f64 = 12.0;

/// Resolution and caption of the pictures of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct View {
    /// Spacing of the raster of fields in pictures (length).
    pub spacing: f64,
    /// Text about the region in the title of a picture; empty if the picture shows the region itself.
    pub region: String,
}

impl View {
    /// Creates a view with the spacing of a scene's grid, or a twentieth of its length scale if it has none, and the
    /// sizes of a channel or tube.
    #[must_use]
    pub fn of(setup: &Setup) -> Self {
        let spacing = setup.method.spacing().unwrap_or(GridMethod::default().spacing * setup.length_scale());
        let region = match setup.region {
            Region::Channel { length, width, .. } | Region::SlipChannel { length, width, .. }
                if setup.solids.is_empty() =>
            {
                format!("w = {width},  l = {length}")
            }
            Region::Tube { radius, .. } => format!("W = {radius}"),
            Region::Space => "three dimensions".to_owned(),
            Region::Slit { lower, upper } => format!("w = {}", upper - lower),
            Region::SpaceBox { lengths: [x, y, z] } => format!("{x} × {y} × {z}"),
            _ => String::new(),
        };
        Self { spacing, region }
    }
}

/// Returns the raster of that spacing (length) over a region, or over the surroundings of a centre in unbounded fluid,
/// for a scene of that length scale (length).
pub(super) fn view_of(
    region: Region,
    scene: &Scene<AnyFlow>,
    centre: Vec2,
    spacing: f64,
    scale: f64,
) -> Result<Raster> {
    let ([x, y], view) = (centre.to_array(), VIEW * scale);
    Ok(match region {
        Region::Tube { radius, .. } => {
            let half = region.half_length().map_or(0.5 * view.max(4.0 * radius), |half| half);
            let [_, height] = region.lengths();
            let (middle, sides) = (if region.half_length().is_some() { 0.0 } else { x }, [2.0 * half, height]);
            let cells = sides.map(|side| ((side / spacing).round() as usize).clamp(1, MOST_CELLS));
            Raster::new([middle - half, -0.5 * height], sides, cells, [false; 2])?
        }
        Region::Plane | Region::Space => {
            let cells = ((view / spacing).round() as usize).clamp(1, MOST_CELLS);
            Raster::new([x - 0.5 * view, y - 0.5 * view], [view; 2], [cells; 2], [false; 2])?
        }
        _ => Raster::of(scene.system(), spacing)?,
    })
}

/// Returns the title of pictures: the parameters of all particles of a scene, and the viscosities of its fluids. If
/// bodies differ, it has the smallest and the largest value.
pub(in crate::run) fn caption(setup: &Setup, region: &str) -> String {
    let droplets = || setup.droplets.iter();
    let of_interfaces = || setup.interfaces.iter().filter_map(|interface| interface.particles);
    let particles = || droplets().filter_map(|droplet| droplet.particles).chain(of_interfaces());
    let strength = |particles: Particles| match particles.excluded_volume {
        ExcludedVolume::Step(strength) => Some(strength),
        _ => None,
    };
    let mut parts = Vec::new();
    if particles().next().is_some() {
        parts.push(format!("ζΔμ = {}", range(particles().map(|particles| particles.activity))));
        if particles().all(|particles| strength(particles).is_some()) {
            parts.push(format!("A = {}", range(particles().filter_map(strength))));
        }
    }
    let inside = droplets()
        .any(|droplet| droplet.viscosity.is_some())
        .then(|| range(droplets().map(|droplet| droplet.viscosity.unwrap_or(setup.viscosity))) + " in ");
    parts.push(format!("η = {}{}", inside.unwrap_or_default(), setup.viscosity));
    if !region.is_empty() {
        parts.push(region.to_owned());
    }
    parts.join(",  ").replace('-', "−")
}

/// Returns one value that all have, or the least and the largest value.
fn range(values: impl Iterator<Item = f64>) -> String {
    let [low, high] = values.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
    if low == high { format!("{low}") } else { format!("{low} to {high}") }
}
