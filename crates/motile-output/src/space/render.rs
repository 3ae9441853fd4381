//! Shaded triangles by a z-buffer.

use motile::space_droplets::SurfaceMesh;

use crate::{ColourScale, Rgb, drawing::Pixel};

/// Direction from the scene to the eye, not normalised: from above and to one side.
const TO_EYE: [f64; 3] = [-0.35, -0.75, 0.56];
/// Direction to the light, to the right of the eye and above, in the coordinates of the view.
const LIGHT: [f64; 3] = [0.45, 0.6, 0.66];
/// Parts of the light that comes from everywhere, and that is reflected as by a mirror; sharpness of the latter.
const AMBIENT: f64 = 0.42;
const GLOSS: f64 = 0.22;
const SHARPNESS: f64 = 28.0;

/// Parallel projection with the z axis upright.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Camera {
    right: [f64; 3],
    up: [f64; 3],
    towards: [f64; 3],
    centre: [f64; 3],
    /// Pixels per length, and the pixel of the centre.
    scale: f64,
    middle: Pixel,
}

fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}

fn unit(a: [f64; 3]) -> [f64; 3] {
    let length = dot(a, a).sqrt();
    if length > 0.0 { a.map(|x| x / length) } else { a }
}

impl Camera {
    /// Creates a camera that shows a place (length) in the pixel `middle`.
    pub(crate) fn new(centre: [f64; 3], scale: f64, middle: Pixel) -> Self {
        let towards = unit(TO_EYE);
        let right = unit(cross([0.0, 0.0, 1.0], towards));
        Self { right, up: cross(towards, right), towards, centre, scale, middle }
    }

    /// Returns the pixel of a place, and its distance towards the eye (length).
    pub(crate) fn place(&self, point: [f64; 3]) -> (Pixel, f64) {
        let from = [0, 1, 2].map(|i| point[i] - self.centre[i]);
        let pixel =
            [self.middle[0] + self.scale * dot(from, self.right), self.middle[1] - self.scale * dot(from, self.up)];
        (pixel, dot(from, self.towards))
    }

    /// Returns a vector in the coordinates of the view: to the right, up, towards the eye.
    fn turned(&self, vector: [f64; 3]) -> [f64; 3] {
        [dot(vector, self.right), dot(vector, self.up), dot(vector, self.towards)]
    }

    /// Returns the pixels per length.
    pub(crate) fn scale(&self) -> f64 {
        self.scale
    }
}

/// Colours and depths of pixels, each `SAMPLES` times in both directions.
#[derive(Debug)]
pub(crate) struct Canvas {
    size: [usize; 2],
    depths: Vec<f64>,
    colours: Vec<[f32; 3]>,
}

/// Samples of a pixel in each direction.
const SAMPLES: usize = 2;

impl Canvas {
    /// Creates an empty canvas of so many pixels.
    pub(crate) fn new(size: [usize; 2]) -> Self {
        let size = size.map(|side| side * SAMPLES);
        let count = size[0] * size[1];
        Self { size, depths: vec![f64::NEG_INFINITY; count], colours: vec![[0.0; 3]; count] }
    }

    /// Draws a surface coloured by its concentrations over a unit, or in one colour without a scale.
    pub(crate) fn draw(&mut self, mesh: &SurfaceMesh, camera: &Camera, scale: Option<(&ColourScale, f64)>) {
        let mut normals = vec![[0.0; 3]; mesh.points.len()];
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|k| mesh.points[k]);
            let side = |from: [f64; 3], to: [f64; 3]| [0, 1, 2].map(|i| to[i] - from[i]);
            let normal = cross(side(a, b), side(a, c));
            for &corner in corners {
                (0..3).for_each(|i| normals[corner][i] += normal[i]);
            }
        }
        let normals: Vec<[f64; 3]> = normals.into_iter().map(|normal| unit(camera.turned(normal))).collect();
        let places: Vec<(Pixel, f64)> = mesh.points.iter().map(|point| camera.place(*point)).collect();
        for corners in &mesh.triangles {
            let at = corners.map(|k| places[k].0.map(|x| x * SAMPLES as f64));
            let [a, b, c] = at;
            let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            // Pixels run downwards, so that what faces the eye is clockwise.
            if area >= 0.0 || !area.is_finite() {
                continue;
            }
            let range = |axis: usize| {
                let [low, high] = at.iter().fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], place| {
                    [low.min(place[axis]), high.max(place[axis])]
                });
                let last = self.size[axis] as f64;
                (low.floor().clamp(0.0, last) as usize)..(high.ceil().clamp(0.0, last) as usize)
            };
            for row in range(1) {
                for column in range(0) {
                    let p = [column as f64 + 0.5, row as f64 + 0.5];
                    let part = |u: Pixel, v: Pixel| (u[0] - p[0]) * (v[1] - p[1]) - (u[1] - p[1]) * (v[0] - p[0]);
                    let weights = [part(b, c) / area, part(c, a) / area, part(a, b) / area];
                    if weights.iter().any(|weight| *weight < -1e-9) {
                        continue;
                    }
                    let mean = |value: &dyn Fn(usize) -> f64| -> f64 {
                        weights.iter().zip(corners).map(|(weight, &k)| weight * value(k)).sum()
                    };
                    let (depth, place) = (mean(&|k| places[k].1), row * self.size[0] + column);
                    if depth <= self.depths[place] {
                        continue;
                    }
                    self.depths[place] = depth;
                    let normal = unit([0, 1, 2].map(|i| mean(&|k| normals[k][i])));
                    let colour = match scale {
                        Some((scale, by)) => scale.colour(mean(&|k| mesh.concentrations[k]) / by),
                        None => Rgb([170, 182, 196]),
                    };
                    self.colours[place] = lit(colour, normal);
                }
            }
        }
    }

    /// Returns the colour of a pixel over white, and whether anything is there.
    pub(crate) fn pixel(&self, column: usize, row: usize) -> Option<Rgb> {
        let (mut sum, mut hits) = ([0.0_f32; 3], 0);
        for k in 0..SAMPLES * SAMPLES {
            let (x, y) = (column * SAMPLES + k % SAMPLES, row * SAMPLES + k / SAMPLES);
            if x >= self.size[0] || y >= self.size[1] {
                continue;
            }
            let place = y * self.size[0] + x;
            if self.depths[place] > f64::NEG_INFINITY {
                hits += 1;
                (0..3).for_each(|i| sum[i] += self.colours[place][i]);
            } else {
                sum.iter_mut().for_each(|channel| *channel += 255.0);
            }
        }
        let count = (SAMPLES * SAMPLES) as f32;
        (hits > 0).then(|| Rgb(sum.map(|channel| (channel / count).round().clamp(0.0, 255.0) as u8)))
    }

    /// Returns true if a place with this pixel and depth is not behind a surface.
    pub(crate) fn shows(&self, at: Pixel, depth: f64) -> bool {
        let [x, y] = at.map(|x| x * SAMPLES as f64);
        if !(x >= 0.0 && y >= 0.0) || x >= self.size[0] as f64 || y >= self.size[1] as f64 {
            return false;
        }
        self.depths[y as usize * self.size[0] + x as usize] < depth
    }
}

/// Returns a colour in the light, for a unit normal in the coordinates of the view.
fn lit(Rgb(colour): Rgb, normal: [f64; 3]) -> [f32; 3] {
    let light = unit(LIGHT);
    let facing = dot(normal, light);
    let half = unit([light[0], light[1], light[2] + 1.0]);
    let gloss = GLOSS * dot(normal, half).max(0.0).powf(SHARPNESS);
    let bright = AMBIENT + (1.0 - AMBIENT) * (0.5 * facing + 0.5).powi(2);
    colour.map(|channel| ((f64::from(channel) * bright).mul_add(1.0 - gloss, 255.0 * gloss)).min(255.0) as f32)
}

#[cfg(test)]
mod tests;
