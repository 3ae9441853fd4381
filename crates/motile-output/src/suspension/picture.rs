//! Pictures and animations of many droplets, without the flow around them.

use std::f64::consts::{PI, TAU};
use std::path::Path;

use motile::active_interface::ActiveDroplet;
use motile::analysis::suspension::Member;
use motile::base::Vec2;
use motile::scene::{Hydrodynamics, Observer, System};

use crate::animation::Frames;
use crate::drawing::{Anchor, Drawing, Pen, Pixel, Rect, TextStyle};
use crate::picture::smooth::{between, smooth};
use crate::snapshot::at_markers;
use crate::time_label::time_label;
use crate::{ColourScale, OutputError, Rgb};

/// Colours of paper between droplets, of walls, and of droplets where the interface is coloured.
const PAPER: Rgb = Rgb([250, 250, 248]);
const WALL: Rgb = Rgb([150, 146, 138]);
const PALE: Rgb = Rgb([228, 232, 238]);
/// Mean brightness of the colours of headings, and how far a channel goes from it.
const BRIGHTNESS: f64 = 158.0;
const CHROMA: f64 = 88.0;
/// Concentration, in units of the droplet's mean, from which its interface is drawn as crowded.
const CROWDED: f64 = 1.2;
/// Corners of the wheel of colours.
const CORNERS: usize = 72;

/// Meaning of the colours of a [`SuspensionPicture`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum SuspensionColour {
    /// Headings ([`Member::heading`]): a colour for each direction, shown by a wheel; crowded parts of interfaces dark.
    #[default]
    Heading,
    /// Concentrations along the interfaces, in units of each droplet's mean.
    Concentration,
}

/// Droplets of a scene at one time.
///
/// The flow is computed at their markers only, where a run knows it already.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::SuspensionSetup;
/// use motile_output::suspension::{SuspensionPicture, SuspensionColour};
///
/// let suspension = vec![SuspensionSetup { count: Some(3), ..SuspensionSetup::default() }];
/// let method = Method::Integral(IntegralMethod { nodes: 16, elements: 32 });
/// let Built { mut scene, .. } = Setup { method, suspension, droplets: vec![], ..Setup::default() }.build()?;
/// let path = std::env::temp_dir().join("three-droplets.svg");
/// SuspensionPicture::take(scene.system_mut())?.write_picture(SuspensionColour::Heading, 600.0, &path)?;
/// assert!(std::fs::read_to_string(&path)?.starts_with("<svg"));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SuspensionPicture {
    time: f64,
    droplets: Vec<Drop>,
    /// Lower left corner and size of the region (length), and where it is periodic.
    corner: Vec2,
    size: Vec2,
    periodic: [bool; 2],
    origin: String,
}

/// Droplet of a crowd.
#[derive(Debug, Clone)]
struct Drop {
    markers: Vec<Vec2>,
    /// Concentrations at the markers over their mean; empty without particles.
    relative: Vec<f64>,
    heading: Vec2,
}

impl SuspensionPicture {
    /// Records droplets in the present state; the flow at their markers is computed if it is not known yet.
    ///
    /// # Errors
    /// Returns [`OutputError::Scene`] for a flow that cannot be computed; [`OutputError::Empty`] for a scene without
    /// droplets.
    pub fn take<H: Hydrodynamics>(system: &mut System<H>) -> Result<Self, OutputError> {
        let members = Member::all(system)?;
        let droplets: Vec<Drop> = members
            .iter()
            .zip(system.bodies::<ActiveDroplet>())
            .map(|(member, (_, droplet))| {
                let relative = at_markers(droplet.concentrations());
                let mean = relative.iter().sum::<f64>() / relative.len().max(1) as f64;
                let relative = relative.into_iter().map(|c| c / mean).collect();
                Drop { markers: droplet.markers().to_vec(), relative, heading: member.heading }
            })
            .collect();
        let far = Vec2::splat(f64::INFINITY);
        let places = || droplets.iter().flat_map(|droplet| &droplet.markers);
        let (low, high) = places().fold((far, -far), |(low, high), at| (low.min(*at), high.max(*at)));
        if droplets.is_empty() {
            return Err(OutputError::Empty("a picture of droplets that are not there"));
        }
        let domain = system.hydrodynamics().fluid_view().domain;
        let periods = *domain.periods;
        let (mut corner, mut size) = (low, high - low);
        for axis in 0..2 {
            if let Some(period) = periods[axis] {
                (corner[axis], size[axis]) = (domain.origin[axis], period);
            }
        }
        if let Some([below, above]) = domain.walls {
            (corner.y, size.y) = (below, above - below);
        }
        let (periodic, origin) = (periods.map(|period| period.is_some()), system.origin().to_owned());
        Ok(Self { time: system.time(), droplets, corner, size, periodic, origin })
    }

    /// Returns the displacements at which some of a curve is in the region.
    fn images(&self, markers: &[Vec2]) -> Vec<Vec2> {
        let axis = |k: usize| {
            if !self.periodic[k] {
                return vec![0.0];
            }
            let values = || markers.iter().map(|marker| marker[k] - self.corner[k]);
            let [low, high] = [values().fold(f64::INFINITY, f64::min), values().fold(f64::NEG_INFINITY, f64::max)];
            let [first, last] = [(-high / self.size[k]).ceil(), ((self.size[k] - low) / self.size[k]).floor()];
            (first as i64..=last as i64).map(|image| image as f64 * self.size[k]).collect()
        };
        let rows = axis(1);
        axis(0).into_iter().flat_map(|x| rows.iter().map(move |y| Vec2::new(x, *y))).collect()
    }

    /// Returns the drawing of so many pixels across.
    fn draw(&self, colour: SuspensionColour, width: f64, scale: Option<&ColourScale>) -> Drawing {
        let em = (width / 45.0).max(9.0);
        let margin = 0.8 * em;
        let unit = (width - 2.0 * margin) / self.size.x;
        let area =
            Rect { left: margin, top: 4.2 * em, width: width - 2.0 * margin, height: unit * self.size.y }.rounded();
        let mut drawing = Drawing::new([width, (area.bottom() + margin).round()]);
        drawing.origin.clone_from(&self.origin);
        drawing.fill(&[area.outline()], PAPER, 1.0);
        drawing.clip(Some(area));
        let top = self.corner.y + self.size.y;
        let line = (0.035 * unit).max(0.7);
        for Drop { markers, relative, heading } in &self.droplets {
            let fill = match colour {
                SuspensionColour::Heading if *heading != Vec2::ZERO => of_angle(heading.y.atan2(heading.x)),
                _ => PALE,
            };
            for shift in self.images(markers) {
                let place = |marker: &Vec2| {
                    let at = *marker + shift;
                    [area.left + (at.x - self.corner.x) * unit, area.top + (top - at.y) * unit]
                };
                let ring: Vec<Pixel> = smooth(markers, Vec2::ZERO).iter().map(place).collect();
                drawing.fill(std::slice::from_ref(&ring), fill, 1.0);
                let closed = || between(relative).into_iter();
                drawing.stroke(&ring, &Pen::new(Rgb::INK, line));
                match (colour, scale) {
                    (SuspensionColour::Concentration, Some(scale)) if !relative.is_empty() => {
                        let colours: Vec<Rgb> = closed().map(|c| scale.colour(c)).collect();
                        drawing.stroke_coloured(&ring, &colours, 3.0 * line);
                    }
                    _ => {
                        let crowded: Vec<bool> = closed().map(|c| c > CROWDED).collect();
                        drawing.strokes(&runs(&ring, &crowded), &Pen::new(Rgb::INK, 3.0 * line).opacity(0.8));
                    }
                }
            }
        }
        drawing.clip(None);
        let frame = if self.periodic[1] { Pen::new(Rgb::GREY, 1.0) } else { Pen::new(WALL, 0.4 * em) };
        let (left, right) = (area.left, area.right());
        for y in [area.top, area.bottom()] {
            drawing.stroke(&[[left, y], [right, y]], &frame);
        }
        for x in [left, right] {
            drawing.stroke(&[[x, area.top], [x, area.bottom()]], &Pen::new(Rgb::GREY, 1.0));
        }
        let text = format!("t = {}   {} droplets", time_label(self.time), self.droplets.len());
        drawing.text([left, 2.1 * em], &text, &TextStyle::new(1.2 * em, Anchor::Start));
        match (colour, scale) {
            (SuspensionColour::Concentration, Some(scale)) => {
                let bar = Rect { left: right - 12.0 * em, top: 2.6 * em, width: 12.0 * em, height: 0.8 * em }.rounded();
                let ends = [scale.low, scale.high];
                drawing
                    .shade(bar, |x, _| Some(scale.colour(ends[0] + (ends[1] - ends[0]) * (x - bar.left) / bar.width)));
                let label = format!("c over its mean, {:.1} to {:.1}", ends[0], ends[1]);
                drawing.text([right, 1.4 * em], &label, &TextStyle::new(em, Anchor::End));
            }
            _ => wheel(&mut drawing, [right - 1.7 * em, 2.1 * em], 1.6 * em),
        }
        drawing
    }

    /// Writes a picture so many pixels wide, as SVG or PNG by the end of the name.
    ///
    /// # Errors
    /// Returns [`OutputError::Size`] for a width outside of 100 to 8000 pixels; [`OutputError::Format`] for a name that
    /// ends in neither `.svg` nor `.png`; [`OutputError::Write`].
    pub fn write_picture(
        &self,
        colour: SuspensionColour,
        width: f64,
        path: impl AsRef<Path>,
    ) -> Result<(), OutputError> {
        OutputError::check_size("a picture with a width (pixels)", width, 100.0, 8000.0)?;
        let scale = scale(std::slice::from_ref(self));
        self.draw(colour, width, scale.as_ref()).write(path.as_ref(), 1.0)
    }
}

/// Returns the colour of a direction (radians).
fn of_angle(angle: f64) -> Rgb {
    Rgb([0.0, 1.0, 2.0].map(|k| (BRIGHTNESS + CHROMA * (angle - k * TAU / 3.0).cos()).round() as u8))
}

/// Returns the colour scale of the concentrations of some states.
fn scale(all: &[SuspensionPicture]) -> Option<ColourScale> {
    let values = all.iter().flat_map(|crowd| &crowd.droplets).flat_map(|droplet| droplet.relative.iter().copied());
    ColourScale::from_zero(values, "concentration")
}

/// Returns the parts of a path whose points are all marked.
fn runs(path: &[Pixel], marked: &[bool]) -> Vec<Vec<Pixel>> {
    let mut found: Vec<Vec<Pixel>> = vec![Vec::new()];
    for (point, marked) in path.iter().zip(marked) {
        match found.last_mut() {
            Some(run) if *marked => run.push(*point),
            _ => found.push(Vec::new()),
        }
    }
    found.retain(|run| run.len() > 1);
    found
}

/// Draws the colours of the directions around a point.
fn wheel(drawing: &mut Drawing, [x, y]: Pixel, radius: f64) {
    for k in 0..CORNERS {
        // A little wider than apart, so that no gaps show.
        let [from, to] = [k as f64 - 0.1, k as f64 + 1.1].map(|k| TAU * k / CORNERS as f64 - PI);
        let at = |angle: f64, part: f64| [x + part * radius * angle.cos(), y - part * radius * angle.sin()];
        let ring = vec![at(from, 0.45), at(from, 1.0), at(to, 1.0), at(to, 0.45)];
        drawing.fill(&[ring], of_angle(0.5 * (from + to)), 1.0);
    }
}

/// Observer that takes the [`SuspensionPicture`]s of a run and writes them as an animation when the run ends.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::suspension::{SuspensionColour, SuspensionAnimation};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let mut film = SuspensionAnimation::new(SuspensionColour::Heading, 200.0);
/// scene.run(0.2).observe(Every::Time(0.1), &mut film).go()?;
/// let path = std::env::temp_dir().join("droplets.gif");
/// film.write(&path)?;
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SuspensionAnimation {
    colour: SuspensionColour,
    width: f64,
    crowds: Vec<SuspensionPicture>,
}

impl SuspensionAnimation {
    /// Creates a film without frames yet, so many pixels wide.
    #[must_use]
    pub fn new(colour: SuspensionColour, width: f64) -> Self {
        Self { colour, width, crowds: Vec::new() }
    }

    /// Writes the animation as a GIF that repeats forever.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] if there are no frames; [`OutputError::Size`] for a width outside of 100 to 2000
    /// pixels; [`OutputError::Write`].
    pub fn write(&self, path: impl AsRef<Path>) -> Result<(), OutputError> {
        OutputError::check_size("an animation with a width (pixels)", self.width, 100.0, 2000.0)?;
        let (scale, mut frames) = (scale(&self.crowds), Frames::new());
        for crowd in &self.crowds {
            frames.push(&crowd.draw(self.colour, self.width, scale.as_ref()).pixels(1.0)?);
        }
        frames.write(path.as_ref(), self.crowds.first().map_or("", |crowd| &crowd.origin))
    }
}

impl<H: Hydrodynamics> Observer<H> for SuspensionAnimation {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.crowds.push(SuspensionPicture::take(system)?);
        Ok(())
    }
}

#[cfg(test)]
mod tests;
