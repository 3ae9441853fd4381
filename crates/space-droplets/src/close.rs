//! The flow of a droplet at any point outside it, also close to its surface.

use std::f64::consts::{PI, TAU};

use motile_base::internal::{gauss_legendre, widely};
use sphere_harmonics::{Harmonics, HarmonicsError, Point, Tilt, count, index, turn_about_z};

use crate::SpaceError;
use crate::layers::Vectors;
use crate::surface::{Surface, at, dot};

/// Angle that a distance takes on the surface, below which more rings are needed.
const TOUCHING: f64 = 1e-3;
/// Iterations for the nearest point.
const MOST: usize = 50;
/// Part of a step that the next one takes back, above which steps are too long.
const TAKEN_BACK: f64 = 0.25;

/// The point of a surface that is nearest to a target.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearest {
    pub(crate) parameter: Point,
    /// From the surface to the target.
    pub(crate) offset: [f64; 3],
    /// Distance, negative inside.
    pub(crate) distance: f64,
    /// Length per parameter there.
    stretch: f64,
}

/// Finds the nearest point from a parameter close to it, by Gauss-Newton steps in the tangent plane. They are too long
/// for targets that are far outside, so they get shorter if one step takes back the one before.
pub(crate) fn nearest(
    positions: [&[f64]; 3],
    target: [f64; 3],
    start: Point,
    here: &mut Harmonics,
) -> Result<Nearest, SpaceError> {
    let mut direction = start.direction();
    let mut best: Option<Nearest> = None;
    let (mut shorter, mut before) = (1.0, [0.0; 3]);
    for _ in 0..MOST {
        let parameter = Point::towards(direction);
        let mut along = [[0.0; 3]; 3];
        here.place(parameter)?;
        for (i, field) in positions.iter().enumerate() {
            let [value, theta, phi] = here.derivatives(field)?;
            (along[0][i], along[1][i], along[2][i]) = (value, theta, phi);
        }
        let [place, a, b] = along;
        let offset: [f64; 3] = std::array::from_fn(|i| target[i] - place[i]);
        let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
        let distance = dot(offset, offset).sqrt();
        let (e, f, h) = (dot(a, a), dot(a, b), dot(b, b));
        let area = e * h - f * f;
        let found =
            Nearest { parameter, offset, distance: distance.copysign(dot(offset, normal)), stretch: area.powf(0.25) };
        if best.is_none_or(|best| distance < best.distance.abs()) {
            best = Some(found);
        }
        let (p, q) = (dot(offset, a), dot(offset, b));
        let step = [(h * p - f * q) / area, (e * q - f * p) / area];
        let length = step[0].hypot(step[1]);
        if length.is_nan() || length < 1e-12 {
            break;
        }
        let ((st, ct), (sp, cp)) = (parameter.theta.sin_cos(), parameter.phi.sin_cos());
        let (to_theta, to_phi) = ([ct * cp, ct * sp, -st], [-sp, cp, 0.0]);
        let step: [f64; 3] = std::array::from_fn(|i| step[0] * to_theta[i] + step[1] * to_phi[i]);
        let back = -shorter * dot(step, before) / dot(before, before).max(f64::MIN_POSITIVE);
        if back > TAKEN_BACK {
            shorter /= 1.0 + back.min(1.0);
        }
        let factor = (0.3 / length).min(shorter);
        before = step.map(|x| factor * x);
        direction = std::array::from_fn(|i| direction[i] + before[i]);
        let norm = dot(direction, direction).sqrt();
        direction = direction.map(|x| x / norm);
    }
    best.ok_or_else(|| SpaceError::Integrator("no point of a surface is near a target".to_owned()))
}

/// Returns the parameter of the fine grid whose point is nearest to a target, and their distance, negative inside.
pub(crate) fn nearest_on_grid(surface: &Surface, target: [f64; 3]) -> (Point, f64) {
    let square = |k: usize| {
        let place = at(&surface.positions, k);
        let r = [place[0] - target[0], place[1] - target[1], place[2] - target[2]];
        dot(r, r)
    };
    let (k, best) = (0..surface.weights.len())
        .map(|k| (k, square(k)))
        .fold((0, f64::INFINITY), |best, next| if next.1 < best.1 { next } else { best });
    let (row, column) = (k / surface.grid.columns(), k % surface.grid.columns());
    let phi = column as f64 * TAU / surface.grid.columns() as f64;
    let place = at(&surface.positions, k);
    let outward = dot(std::array::from_fn(|i| target[i] - place[i]), at(&surface.normals, k));
    (Point { theta: surface.grid.colatitudes()[row], phi }, best.sqrt().copysign(outward))
}

/// The polar rule about the nearest point of the surface, graded to the distance.
#[derive(Debug, Clone)]
pub(crate) struct Close {
    degree: usize,
    rule: Vec<(f64, f64)>,
    /// For targets that all but touch the surface.
    fine: Vec<(f64, f64)>,
    /// Cosines and sines of each order at all longitudes.
    waves: [Vec<f64>; 2],
}

/// Memory for close targets of droplets of one degree.
#[derive(Debug, Clone)]
pub(crate) struct Work {
    pub(crate) here: Harmonics,
    rings: RingWork,
    /// Sums over the points times the harmonics about the nearest point, component after component.
    sums: Vec<f64>,
    kernel: Vec<f64>,
    turned: Vec<f64>,
}

/// Memory for the values on rings.
#[derive(Debug, Clone)]
struct RingWork {
    functions: Harmonics,
    tilt: Tilt,
    seen: Vec<f64>,
    turned: Vec<f64>,
    values: Vec<f64>,
}

impl Work {
    /// Creates memory for a degree.
    pub(crate) fn new(degree: usize) -> Result<Self, HarmonicsError> {
        let (n, columns) = (count(degree), 2 * rings_of(degree));
        let rings = RingWork {
            functions: Harmonics::new(degree)?,
            tilt: Tilt::new(degree, 0.0)?,
            seen: vec![0.0; 6 * n],
            turned: vec![0.0; n],
            values: vec![0.0; 6 * columns],
        };
        let here = Harmonics::new(degree)?;
        Ok(Self { here, rings, sums: vec![0.0; 6 * n], kernel: vec![0.0; 6 * columns], turned: vec![0.0; n] })
    }

    /// Makes the memory fit another degree.
    pub(crate) fn fit(&mut self, degree: usize) -> Result<(), HarmonicsError> {
        if self.here.degree() != degree {
            *self = Self::new(degree)?;
        }
        Ok(())
    }
}

/// Returns the number of rings of the rule for a degree.
fn rings_of(degree: usize) -> usize {
    (3 * degree / 2).max(24)
}

impl Close {
    /// Creates the rule for droplets of one degree.
    pub(crate) fn new(degree: usize) -> Self {
        let rings = rings_of(degree);
        let columns = 2 * rings;
        let wave = |function: fn(f64) -> f64| {
            let angle = move |m: usize, j: usize| TAU * (m * j % columns) as f64 / columns as f64;
            (0..=degree).flat_map(|m| (0..columns).map(move |j| function(angle(m, j)))).collect::<Vec<f64>>()
        };
        let [rule, fine] = [rings, 2 * rings].map(gauss_legendre);
        Self { degree, rule, fine, waves: [wave(f64::cos), wave(f64::sin)] }
    }

    /// Returns `INT G f dA/(8 pi)` at a target, for the coefficients of positions and of forces per area of the unit
    /// sphere. The distance need not be known well.
    pub(crate) fn single(
        &self,
        positions: [&[f64]; 3],
        forces: [&[f64]; 3],
        target: [f64; 3],
        nearest: &Nearest,
        work: &mut Work,
    ) -> Result<[f64; 3], SpaceError> {
        let mut sums = [0.0; 3];
        self.rings(&mut work.rings, [positions, forces], nearest, |weight, _, values| {
            let columns = 2 * self.rule.len();
            let (places, forces) = values.split_at(3 * columns);
            for j in 0..columns {
                let at = |list: &[f64]| [list[j], list[columns + j], list[2 * columns + j]];
                stokeslet(weight, at(places), at(forces), target, &mut sums);
            }
        })?;
        Ok(sums.map(|sum| sum / (8.0 * PI)))
    }

    /// Writes the rows of `INT T (u - u(s0)) n dA/(8 pi)` at a target, with the nearest parameter s0: for each
    /// coefficient of u the components xx, xy, xz, yy, yz, zz. Takes the coefficients of positions and of the normal
    /// times area.
    pub(crate) fn double_row(
        &self,
        positions: [&[f64]; 3],
        normals: [&[f64]; 3],
        target: [f64; 3],
        nearest: &Nearest,
        work: &mut Work,
        rows: &mut Vec<[f64; 6]>,
    ) -> Result<(), SpaceError> {
        let (n, degree, columns) = (count(self.degree), self.degree, 2 * self.rule.len());
        let Work { here, rings, sums, kernel, turned } = work;
        sums.fill(0.0);
        let mut total = [0.0; 6];
        self.rings(rings, [positions, normals], nearest, |weight, functions, values| {
            let (places, normals) = values.split_at(3 * columns);
            for j in 0..columns {
                let at = |list: &[f64]| [list[j], list[columns + j], list[2 * columns + j]];
                let r: [f64; 3] = std::array::from_fn(|i| at(places)[i] - target[i]);
                let square = dot(r, r);
                let scale = -6.0 * weight * dot(r, at(normals)) / (8.0 * PI * square * square * square.sqrt());
                let products = [r[0] * r[0], r[0] * r[1], r[0] * r[2], r[1] * r[1], r[1] * r[2], r[2] * r[2]];
                for (f, product) in products.iter().enumerate() {
                    kernel[f * columns + j] = scale * product;
                    total[f] += scale * product;
                }
            }
            for (kernel, sums) in kernel.chunks_exact(columns).zip(sums.chunks_exact_mut(n)) {
                for m in 0..=degree {
                    let cosine = motile_base::internal::dot(kernel, &self.waves[0][m * columns..][..columns]);
                    let sine = motile_base::internal::dot(kernel, &self.waves[1][m * columns..][..columns]);
                    for l in m..=degree {
                        let function = functions[index(l, m as isize)];
                        // For m = 0, the sine is zero.
                        sums[index(l, -(m as isize))] += function * sine;
                        sums[index(l, m as isize)] += function * cosine;
                    }
                }
            }
        })?;
        // The transpose of a tilt is the tilt between two turns by pi.
        here.place(nearest.parameter)?;
        rows.clear();
        rows.resize(n, [0.0; 6]);
        for (f, sums) in sums.chunks_exact_mut(n).enumerate() {
            turn_about_z(sums, PI)?;
            rings.tilt.apply(sums, turned)?;
            turn_about_z(turned, -PI - nearest.parameter.phi)?;
            for ((row, value), here) in rows.iter_mut().zip(&*turned).zip(here.values()) {
                row[f] = value - total[f] * here;
            }
        }
        Ok(())
    }

    /// Calls `visit` for each ring with the weight of its points, the harmonics at phi = 0, and the values of six
    /// fields, field after field.
    fn rings(
        &self,
        work: &mut RingWork,
        fields: [[&[f64]; 3]; 2],
        nearest: &Nearest,
        mut visit: impl FnMut(f64, &[f64], &[f64]),
    ) -> Result<(), SpaceError> {
        let (n, degree, columns) = (count(self.degree), self.degree, 2 * self.rule.len());
        let RingWork { functions, tilt, seen, turned, values } = work;
        tilt.turn_to(nearest.parameter.theta)?;
        for (field, seen) in fields.iter().flatten().zip(seen.chunks_exact_mut(n)) {
            turned.copy_from_slice(field);
            turn_about_z(turned, nearest.parameter.phi)?;
            tilt.apply(turned, seen)?;
        }
        // theta = d sinh(y).
        let scale = (nearest.distance.abs() / nearest.stretch).max(1e-6);
        let end = (PI / scale).asinh();
        for (x, weight) in if scale < TOUCHING { &self.fine } else { &self.rule } {
            let y = 0.5 * (x + 1.0) * end;
            let theta = scale * y.sinh();
            let weight = 0.5 * weight * end * scale * y.cosh() * theta.sin() * TAU / columns as f64;
            functions.place(Point { theta, phi: 0.0 })?;
            let functions = functions.values();
            widely(
                #[inline(always)]
                || {
                    for (field, values) in seen.chunks_exact(n).zip(values.chunks_exact_mut(columns)) {
                        values.fill(0.0);
                        for m in 0..=degree {
                            let (mut c, mut s) = (0.0, 0.0);
                            for l in m..=degree {
                                let function = functions[index(l, m as isize)];
                                c += function * field[index(l, m as isize)];
                                s += function * field[index(l, -(m as isize))];
                            }
                            // For m = 0, the sines are zero.
                            let cosines = &self.waves[0][m * columns..][..columns];
                            let sines = &self.waves[1][m * columns..][..columns];
                            for ((value, cos), sin) in values.iter_mut().zip(cosines).zip(sines) {
                                *value += c * cos + s * sin;
                            }
                        }
                    }
                },
            );
            visit(weight, functions, values);
        }
        Ok(())
    }
}

/// Adds the flow of a force at a place to the velocity at the target.
#[inline(always)]
fn stokeslet(weight: f64, place: [f64; 3], force: [f64; 3], target: [f64; 3], sums: &mut [f64; 3]) {
    let r = [place[0] - target[0], place[1] - target[1], place[2] - target[2]];
    let inverse = 1.0 / dot(r, r).sqrt();
    let along = inverse * inverse * dot(r, force);
    let scale = weight * inverse;
    for i in 0..3 {
        sums[i] += scale * (force[i] + along * r[i]);
    }
}

/// Targets that are treated together.
const LANES: usize = 8;

/// Adds `SUM G f/(8 pi)` of point forces to the velocities at all targets.
pub(crate) fn add_direct(places: &Vectors, forces: &Vectors, targets: &Vectors, shift: [f64; 3], out: &mut Vectors) {
    add_sums(
        [places, forces, forces],
        targets,
        shift,
        out,
        #[inline(always)]
        |f, _, r, inverse| {
            let along = inverse * inverse * (r[0] * f[0] + r[1] * f[1] + r[2] * f[2]);
            [inverse * (f[0] + along * r[0]), inverse * (f[1] + along * r[1]), inverse * (f[2] + along * r[2])]
        },
    );
}

/// Adds `SUM T u n/(8 pi)` of stresslets, normals times area and velocities, to the velocities at all targets.
pub(crate) fn add_direct_double(
    places: &Vectors,
    [normals, velocities]: [&Vectors; 2],
    targets: &Vectors,
    shift: [f64; 3],
    out: &mut Vectors,
) {
    add_sums(
        [places, normals, velocities],
        targets,
        shift,
        out,
        #[inline(always)]
        |n, u, r, inverse| {
            let square = inverse * inverse;
            let products = (r[0] * n[0] + r[1] * n[1] + r[2] * n[2]) * (r[0] * u[0] + r[1] * u[1] + r[2] * u[2]);
            let scale = -6.0 * products * square * square * inverse;
            [scale * r[0], scale * r[1], scale * r[2]]
        },
    );
}

/// Adds the sum of `kernel(a, b, r, 1/|r|)/(8 pi)` over all places to each target, with two vectors a and b of each
/// place, and r from the target to the place.
#[inline(always)]
fn add_sums(
    [places, a, b]: [&Vectors; 3],
    targets: &Vectors,
    shift: [f64; 3],
    out: &mut Vectors,
    kernel: impl Fn([f64; 3], [f64; 3], [f64; 3], f64) -> [f64; 3] + Copy,
) {
    let factor = 1.0 / (8.0 * PI);
    let last = targets[0].len() - 1;
    for first in (0..=last).step_by(LANES) {
        let mut lanes = [[0.0; LANES]; 3];
        for (i, lanes) in lanes.iter_mut().enumerate() {
            lanes.iter_mut().enumerate().for_each(|(t, lane)| *lane = targets[i][(first + t).min(last)] + shift[i]);
        }
        let sums = widely(
            #[inline(always)]
            || {
                let mut sums = [[0.0; LANES]; 3];
                for k in 0..places[0].len() {
                    let (x, a, b) = (at(places, k), at(a, k), at(b, k));
                    for t in 0..LANES {
                        let r = [x[0] - lanes[0][t], x[1] - lanes[1][t], x[2] - lanes[2][t]];
                        let inverse = 1.0 / (r[0] * r[0] + r[1] * r[1] + r[2] * r[2]).sqrt();
                        let flow = kernel(a, b, r, inverse);
                        sums[0][t] += flow[0];
                        sums[1][t] += flow[1];
                        sums[2][t] += flow[2];
                    }
                }
                sums
            },
        );
        for (out, sums) in out.iter_mut().zip(sums) {
            for (out, sum) in out[first..].iter_mut().zip(sums) {
                *out += factor * sum;
            }
        }
    }
}
