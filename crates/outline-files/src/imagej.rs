//! Regions of interest of ImageJ and Fiji.
//!
//! The layout follows `ij.io.RoiDecoder` in the source of ImageJ, which is in the public domain.

use std::f64::consts::TAU;

use motile_base::Vec2;

use crate::{Contour, OutlineError};

/// Length of the header (bytes).
const HEADER: usize = 64;
/// Bit of the options that says that coordinates are fractions of pixels.
const SUBPIXEL: u16 = 128;
/// First version with such coordinates.
const SUBPIXEL_VERSION: u16 = 222;
/// Points on an ellipse.
const ELLIPSE: u32 = 360;

/// Bytes of a file, read with their bounds.
struct Bytes<'a>(&'a [u8]);

impl Bytes<'_> {
    fn at<const N: usize>(&self, place: usize) -> Result<[u8; N], OutlineError> {
        let found = place.checked_add(N).and_then(|end| self.0.get(place..end)).and_then(|part| part.try_into().ok());
        let remedy = "Save the region again in ImageJ";
        found.ok_or_else(|| OutlineError::format("the region of interest", "the file ends too early", remedy))
    }

    fn u16(&self, place: usize) -> Result<u16, OutlineError> {
        Ok(u16::from_be_bytes(self.at(place)?))
    }

    fn i16(&self, place: usize) -> Result<f64, OutlineError> {
        Ok(i16::from_be_bytes(self.at(place)?).into())
    }

    fn i32(&self, place: usize) -> Result<i32, OutlineError> {
        Ok(i32::from_be_bytes(self.at(place)?))
    }

    fn f32(&self, place: usize) -> Result<f64, OutlineError> {
        Ok(f32::from_be_bytes(self.at(place)?).into())
    }
}

/// Returns the outline of a region.
pub(crate) fn read(bytes: &[u8]) -> Result<Contour, OutlineError> {
    let bytes = Bytes(bytes);
    let version = bytes.u16(4)?;
    let [kind] = bytes.at::<1>(6)?;
    let [top, left, bottom, right] = [bytes.i16(8)?, bytes.i16(10)?, bytes.i16(12)?, bytes.i16(14)?];
    let subpixel = bytes.u16(50)? & SUBPIXEL != 0 && version >= SUBPIXEL_VERSION;
    let name = name(&bytes).unwrap_or_default();
    let closed =
        |points: Vec<Vec2>| Contour { name: Some(name.clone()).filter(|name| !name.is_empty()), points, closed: true };
    if bytes.i32(36)? > 0 {
        let remedy = "Split it in ImageJ (More > Split in the ROI manager) and save one of its parts";
        return Err(OutlineError::format("the region of interest", "it is made of several shapes", remedy));
    }
    match kind {
        0 | 4 | 5 | 7 | 8 => {
            let points = coordinates(&bytes, subpixel, Vec2::new(left, top))?;
            Ok(Contour { closed: kind != 4 && kind != 5, ..closed(points) })
        }
        // Rectangles and ovals with bounds in fractions of pixels.
        1 | 2 => {
            let [low, size] = if subpixel {
                [Vec2::new(bytes.f32(18)?, bytes.f32(22)?), Vec2::new(bytes.f32(26)?, bytes.f32(30)?)]
            } else {
                [Vec2::new(left, top), Vec2::new(right - left, bottom - top)]
            };
            let at = |x: f64, y: f64| Vec2::new(low.x + x * size.x, low.y + y * size.y);
            let points = if kind == 1 {
                vec![at(0.0, 0.0), at(1.0, 0.0), at(1.0, 1.0), at(0.0, 1.0)]
            } else {
                let angles = (0..ELLIPSE).map(|k| TAU * f64::from(k) / f64::from(ELLIPSE));
                angles.map(|angle| at(0.5 + 0.5 * angle.cos(), 0.5 + 0.5 * angle.sin())).collect()
            };
            Ok(closed(points))
        }
        other => {
            let what = match other {
                3 => "a line".to_owned(),
                9 => "an angle".to_owned(),
                10 => "points".to_owned(),
                _ => format!("a region of the type {other}"),
            };
            let remedy = "Use a polygon, freehand, traced, rectangular or oval selection";
            Err(OutlineError::format("the region of interest", format!("it is {what}"), remedy))
        }
    }
}

/// Returns the points of a polygon or line (pixels).
fn coordinates(bytes: &Bytes<'_>, subpixel: bool, corner: Vec2) -> Result<Vec<Vec2>, OutlineError> {
    let count = match bytes.u16(16)? {
        // Of more than 65535 points, the number is elsewhere.
        0 => usize::try_from(bytes.i32(18)?).unwrap_or(0),
        count => count.into(),
    };
    // Checks the length before anything is allocated.
    let per_point = if subpixel { 12 } else { 4 };
    let last = count.checked_mul(per_point).and_then(|size| size.checked_add(HEADER)).unwrap_or(usize::MAX);
    if count > 0 {
        bytes.at::<1>(last - 1)?;
    }
    let point = |k: usize| {
        if subpixel {
            let base = HEADER + 4 * count;
            return Ok(Vec2::new(bytes.f32(base + 4 * k)?, bytes.f32(base + 4 * (count + k))?));
        }
        Ok(corner + Vec2::new(bytes.i16(HEADER + 2 * k)?, bytes.i16(HEADER + 2 * (count + k))?))
    };
    (0..count).map(point).collect()
}

/// Returns the name of a region; `None` where the file has none.
fn name(bytes: &Bytes<'_>) -> Option<String> {
    let second = usize::try_from(bytes.i32(60).ok()?).ok().filter(|place| *place >= HEADER)?;
    let place = usize::try_from(bytes.i32(second.checked_add(16)?).ok()?).ok().filter(|place| *place >= HEADER)?;
    let length = usize::try_from(bytes.i32(second.checked_add(20)?).ok()?).ok().filter(|length| *length < 1000)?;
    let units: Option<Vec<u16>> = (0..length).map(|k| bytes.u16(place.checked_add(2 * k)?).ok()).collect();
    Some(String::from_utf16_lossy(&units?))
}

#[cfg(test)]
mod tests;
